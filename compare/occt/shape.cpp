// SPDX-License-Identifier: MIT OR Apache-2.0
#include "shape.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace {

void need(fpt_status status) {
    if (status != FPT_OK) {
        throw std::runtime_error(fpt_last_error());
    }
}

// Relative size of second derivatives below which a direction counts as flat.
constexpr double FLAT = 1e-9;

} // namespace

Shape::Shape(const Geometry &g) {
    const double *weights = g.rational ? g.weights.data() : nullptr;
    double box[6];
    if (g.is_curve) {
        const fpt_curve_data data = {sizeof data, size_t(g.degree[0]), size_t(g.count[0]),
                                     g.knots[0].data(), g.poles.data(), weights};
        need(fpt_curve_new(&data, &curve_));
        need(fpt_curve_domain(curve_, domain_));
        need(fpt_curve_box(curve_, box));
        int32_t closed = 0;
        need(fpt_curve_is_closed(curve_, &closed));
        closed_[0] = closed != 0;
        need(fpt_curve_prepare(curve_));
    } else {
        const fpt_surface_data data = {sizeof data, size_t(g.degree[0]), size_t(g.degree[1]),
                                       size_t(g.count[0]), size_t(g.count[1]), g.knots[0].data(),
                                       g.knots[1].data(), g.poles.data(), weights};
        need(fpt_surface_new(&data, &surface_));
        need(fpt_surface_domain(surface_, domain_));
        need(fpt_surface_box(surface_, box));
        int32_t closed[2], collapsed[4];
        need(fpt_surface_is_closed_u(surface_, &closed[0]));
        need(fpt_surface_is_closed_v(surface_, &closed[1]));
        need(fpt_surface_collapsed_edges(surface_, collapsed));
        std::copy(closed, closed + 2, closed_);
        std::copy(collapsed, collapsed + 4, collapsed_);
        need(fpt_surface_prepare(surface_));
    }
    for (int k = 0; k < dimensions(); k++) {
        for (size_t i = 0; i < g.knots[k].size(); i++) {
            const double x = g.knots[k][i];
            const auto repeats = std::count(g.knots[k].begin(), g.knots[k].end(), x);
            const bool inside = x > low(k) && x < high(k);
            if (inside && repeats >= g.degree[k] && (breaks_[k].empty() || breaks_[k].back() != x)) {
                breaks_[k].push_back(x);
            }
        }
        breaks_[k].insert(breaks_[k].begin(), low(k));
        breaks_[k].push_back(high(k));
    }
    diagonal_ = norm({box[3] - box[0], box[4] - box[1], box[5] - box[2]});
    for (double x : box) {
        largest_ = std::max(largest_, std::fabs(x));
    }
}

Shape::~Shape() {
    fpt_curve_free(curve_);
    fpt_surface_free(surface_);
}

Jet Shape::jet(Pair at, int order, const std::array<int, 2> &sides) const {
    for (int k = 0; k < dimensions(); k++) {
        at[k] = std::clamp(at[k], low(k), high(k));
        if (sides[k] < 0) {
            // The neighbour number lies in the piece below; at the start of a closed direction that is the last one.
            const double x = at[k] == low(k) ? high(k) : at[k];
            at[k] = std::nextafter(x, low(k));
        } else if (at[k] == high(k) && closed_[k]) {
            at[k] = low(k);
        }
    }
    double n[18] = {0};
    if (is_curve()) {
        need(fpt_curve_evaluate(curve_, at[0], uint32_t(order), n));
    } else {
        need(fpt_surface_evaluate(surface_, at[0], at[1], uint32_t(order), n));
    }
    const auto vec = [&](int k) { return Vec{n[3 * k], n[3 * k + 1], n[3 * k + 2]}; };
    if (is_curve()) {
        return {vec(0), {vec(1), {0, 0, 0}}, {vec(2), {0, 0, 0}, {0, 0, 0}}};
    }
    return {vec(0), {vec(1), vec(2)}, {vec(3), vec(4), vec(5)}};
}

double Shape::distance(Pair at, const Vec &query) const { return norm(minus(jet(at, 0).point, query)); }

double Shape::floor(const Vec &query) const {
    const double far = std::max({std::fabs(query[0]), std::fabs(query[1]), std::fabs(query[2])});
    return 2e-14 * (largest_ + far) + 1e-12 * diagonal_;
}

double Shape::apart(int k, double a, double b) const {
    if (is_curve() && k == 1) {
        return 0.0;
    }
    const double share = std::fabs(a - b) / width(k);
    return closed_[k] ? std::min(share, std::fabs(1.0 - share)) : share;
}

double Shape::apart(const Pair &a, const Pair &b) const {
    return std::max(apart(0, a[0], b[0]), apart(1, a[1], b[1]));
}

Pair Shape::snapped(Pair at) const {
    for (int k = 0; k < dimensions(); k++) {
        for (double x : breaks_[k]) {
            if (std::fabs(at[k] - x) <= 1e-9 * width(k)) {
                at[k] = x;
            }
        }
    }
    return at;
}

// The derivative of the distance along direction k as a cosine, from the given sides.
double Shape::directed(int k, const Pair &at, const std::array<int, 2> &sides, const Vec &query) const {
    const Jet jet = this->jet(at, 1, sides);
    const Vec r = minus(jet.point, query);
    // Where the derivative vanishes the direction says nothing.
    const double speed = std::max(norm(jet.first[k]), 1e-7 * diagonal_ / width(k));
    const double slope = dot(r, jet.first[k]) / speed;
    const double rounding = floor(query);
    return std::fabs(slope) <= rounding ? 0.0 : slope / std::max(norm(r), rounding);
}

double Shape::slope_across(int k, const Pair &at, const Vec &query, bool &border) const {
    const bool at_end = at[k] == low(k) || at[k] == high(k);
    border = at_end && !closed_[k];
    if (border) {
        return 0.0;
    }
    double worst = 0.0;
    for (int other_side : {-1, 1}) {
        const int o = 1 - k;
        const bool open = o < dimensions() && !closed_[o];
        if (open && ((other_side < 0 && at[o] == low(o)) || (other_side > 0 && at[o] == high(o)))) {
            continue;
        }
        double slope[2];
        for (int side : {0, 1}) {
            std::array<int, 2> sides = {other_side, other_side};
            sides[k] = 2 * side - 1;
            slope[side] = directed(k, at, sides, query);
        }
        const bool passes = slope[0] * slope[1] > 0.0;
        worst = std::max(worst, passes ? std::min(std::fabs(slope[0]), std::fabs(slope[1])) : 0.0);
    }
    return worst;
}

Stationarity Shape::stationarity(const Pair &at, const Vec &query) const {
    Stationarity s = {0.0, {false, false}};
    for (int k = 0; k < dimensions(); k++) {
        s.slope = std::max(s.slope, slope_across(k, at, query, s.border[k]));
    }
    return s;
}

// The shortest step to where the second-order model is stationary, in lengths of the tangents; flat directions are left.
bool Shape::step(const Pair &at, const Vec &query, const std::array<int, 2> &sides, int held, Pair &out) const {
    const Jet j = jet(at, 2, sides);
    const Vec r = minus(j.point, query);
    const double least = 1e-12 * diagonal_;
    if (is_curve() || held >= 0) {
        const int k = is_curve() ? 0 : 1 - held;
        const double speed = std::max(norm(j.first[k]), least / width(k));
        const double bend = dot(r, j.second[2 * k]) / (speed * speed);
        const double a = dot(j.first[k], j.first[k]) / (speed * speed) + bend;
        out = {0.0, 0.0};
        out[k] = std::fabs(a) < FLAT * (1.0 + std::fabs(bend)) ? 0.0 : -dot(r, j.first[k]) / (a * speed * speed);
        return std::isfinite(out[k]);
    }
    const double p = std::max(norm(j.first[0]), least / width(0));
    const double a = (dot(j.first[0], j.first[0]) + dot(r, j.second[0])) / (p * p);
    const double x = dot(r, j.first[0]) / p;
    const double q = std::max(norm(j.first[1]), least / width(1));
    const double b = (dot(j.first[0], j.first[1]) + dot(r, j.second[1])) / (p * q);
    const double c = (dot(j.first[1], j.first[1]) + dot(r, j.second[2])) / (q * q);
    const double y = dot(r, j.first[1]) / q;
    const double middle = 0.5 * (a + c), half = 0.5 * (a - c), spread = std::hypot(half, b);
    const double size = std::max(1.0, std::fabs(middle) + spread);
    double s = 0.0, t = 0.0;
    for (double value : {middle - spread, middle + spread}) {
        if (std::fabs(value) < FLAT * size) {
            continue;
        }
        // An eigenvector of [[a, b], [b, c]].
        double e = a - value, f = c - value;
        double m = std::fabs(e) > std::fabs(f) ? -b : f, n = std::fabs(e) > std::fabs(f) ? e : -b;
        const double length = std::hypot(m, n);
        if (length == 0.0) {
            out = {-x / a / p, -y / c / q};
            return true;
        }
        const double along = (m * x + n * y) / (length * length * value);
        s -= along * m;
        t -= along * n;
    }
    out = {s / p, t / q};
    return std::isfinite(s) && std::isfinite(t);
}

bool Shape::refine(Pair &at, const Vec &query, double reach, int held) const {
    Pair x = snapped(at);
    const Pair start = x;
    double box[2][2] = {{0, 0}, {0, 0}};
    for (int k = 0; k < dimensions(); k++) {
        const auto &list = breaks_[k];
        auto above = std::upper_bound(list.begin(), list.end(), x[k]);
        above = above == list.end() ? above - 1 : above;
        box[k][0] = *(above - 1);
        box[k][1] = *above;
    }
    for (int turn = 0; turn < 30; turn++) {
        std::array<int, 2> sides = {1, 1};
        for (int k = 0; k < dimensions(); k++) {
            sides[k] = x[k] == box[k][1] ? -1 : 1;
        }
        Pair move;
        if (!step(x, query, sides, held, move)) {
            return false;
        }
        double size = 0.0;
        for (int k = 0; k < dimensions(); k++) {
            double next = x[k] + std::clamp(move[k], -0.1 * width(k), 0.1 * width(k));
            if (k != held && closed_[k] && breaks_[k].size() == 2) {
                next = next < low(k) ? next + width(k) : next > high(k) ? next - width(k) : next;
            }
            next = std::clamp(next, box[k][0], box[k][1]);
            size = std::max(size, apart(k, next, x[k]));
            x[k] = next;
        }
        if (size < 1e-15) {
            break;
        }
    }
    x = snapped(x);
    if (apart(x, start) > reach || stationarity(x, query).slope > 1e-10) {
        return false;
    }
    at = x;
    return true;
}

int Shape::trend(const Pair &at, const Pair &way, const Vec &query) const {
    std::array<int, 2> sides = {1, 1};
    for (int k = 0; k < dimensions(); k++) {
        sides[k] = way[k] < 0.0 ? -1 : way[k] > 0.0 || at[k] != high(k) ? 1 : -1;
    }
    const Jet j = jet(at, 2, sides);
    const Vec r = minus(j.point, query);
    Vec first, second;
    for (int i = 0; i < 3; i++) {
        first[i] = way[0] * j.first[0][i] + way[1] * j.first[1][i];
        second[i] = way[0] * way[0] * j.second[0][i] + 2.0 * way[0] * way[1] * j.second[1][i] +
                    way[1] * way[1] * j.second[2][i];
    }
    const double speed = norm(first);
    const double slope = dot(r, first), bend = dot(first, first) + dot(r, second);
    if (std::fabs(slope) > speed * (1e-9 * norm(r) + 1e-14 * (largest_ + norm(query)))) {
        return slope > 0.0 ? 1 : -1;
    }
    return std::fabs(bend) <= 1e-6 * speed * speed ? 0 : bend > 0.0 ? 1 : -1;
}

std::string Shape::flat_text(const Pair &at, const Vec &query) const {
    const Jet j = jet(at, 2);
    const Vec r = minus(j.point, query);
    double h[3], m[3];
    for (int k = 0; k < 3; k++) {
        m[k] = dot(j.first[k / 2], j.first[(k + 1) / 2]);
        h[k] = m[k] + dot(r, j.second[k]);
    }
    char text[160];
    const double area = std::max(m[0] * m[2] - m[1] * m[1], 1e-300);
    const double mean = 0.5 * (h[0] * m[2] - 2 * h[1] * m[1] + h[2] * m[0]) / area;
    const double product = (h[0] * h[2] - h[1] * h[1]) / area;
    const double spread = std::sqrt(std::max(mean * mean - product, 0.0));
    if (is_curve()) {
        std::snprintf(text, sizeof text, "bend %.3g", h[0] / std::max(m[0], 1e-300));
    } else {
        std::snprintf(text, sizeof text, "bends %.3g %.3g", mean - spread, mean + spread);
    }
    return text;
}
