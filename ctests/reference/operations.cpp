// Operations of footpoint on the case folders against exact rational arithmetic (CGAL's Gmpq). The shape before and the shape after are
// both evaluated exactly from their knots, poles and weights, at parameters that are mapped exactly: what is left is what the operation
// moved. Exact operations leave the shape, approximate ones keep the error that they prove. SPDX-License-Identifier: MIT OR Apache-2.0
//
//   reference_operations [folder of cases...]
#include "check.hpp"
#include "geometry.h"
#include "spline.hpp"

#include <footpoint.hpp>

#include <CGAL/Gmpq.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>

namespace {

namespace operate = footpoint::operate;
using Q = CGAL::Gmpq;
using Point = reference::Vector<Q>;

/** What "leaves the shape" means: relative to the largest coordinate. */
constexpr double EXACT = 1e-13;

/** Numbers of a shape; a curve has one direction. */
struct Shape {
    std::size_t directions = 1;
    std::size_t degree[2] = {0, 0}, count[2] = {1, 1};
    std::vector<double> knots[2], poles, weights;

    double low(std::size_t k) const { return knots[k][degree[k]]; }
    double high(std::size_t k) const { return knots[k][count[k]]; }
    double size() const {
        double most = 0;
        for (const double x : poles) most = std::max(most, std::fabs(x));
        return most;
    }
};

Shape shape_of(const footpoint::curve &c) {
    Shape out;
    out.degree[0] = c.degree();
    out.count[0] = c.pole_count();
    out.knots[0] = c.knots();
    out.poles = c.poles();
    if (c.is_rational()) out.weights = c.weights();
    return out;
}

Shape shape_of(const footpoint::surface &s) {
    Shape out;
    out.directions = 2;
    out.degree[0] = s.degree_u(), out.degree[1] = s.degree_v();
    out.count[0] = s.pole_count_u(), out.count[1] = s.pole_count_v();
    out.knots[0] = s.knots_u(), out.knots[1] = s.knots_v();
    out.poles = s.poles();
    if (s.is_rational()) out.weights = s.weights();
    return out;
}

/** The span of a parameter; at the end of the domain the last one that has length. */
std::size_t span_of(const Shape &s, std::size_t k, const Q &u) {
    const auto first = s.knots[k].begin() + long(s.degree[k]) + 1, last = s.knots[k].begin() + long(s.count[k]);
    const auto above = std::upper_bound(first, last, u, [](const Q &a, double b) { return a < Q(b); });
    std::size_t span = std::size_t(above - s.knots[k].begin()) - 1;
    while (span > s.degree[k] && s.knots[k][span] == s.knots[k][span + 1]) span--;
    return span;
}

/** Point and first derivatives, exact, of the piece that a parameter lies in. */
std::array<Point, 3> at(const Shape &s, const Q &u, const Q &v, int orders) {
    const auto local = [&](std::size_t k, std::size_t span) {
        return std::vector<Q>(s.knots[k].begin() + long(span - s.degree[k]), s.knots[k].begin() + long(span + s.degree[k]) + 2);
    };
    const auto pole = [&](std::size_t index) {
        const Q w = s.weights.empty() ? Q(1) : Q(s.weights[index]);
        return reference::Pole<Q>{Q(s.poles[3 * index]) * w, Q(s.poles[3 * index + 1]) * w, Q(s.poles[3 * index + 2]) * w, w};
    };
    const std::size_t i = span_of(s, 0, u) - s.degree[0];
    if (s.directions == 1) {
        reference::Spline<Q> c{s.degree[0], local(0, i + s.degree[0]), {}};
        for (std::size_t k = 0; k <= s.degree[0]; k++) c.poles.push_back(pole(i + k));
        const auto x = reference::curve_at<Q>(c, u, orders);
        return {x[0], x[1], Point{}};
    }
    const std::size_t j = span_of(s, 1, v) - s.degree[1];
    reference::Net<Q> net{{s.degree[0], s.degree[1]}, {local(0, i + s.degree[0]), local(1, j + s.degree[1])}, {}};
    for (std::size_t k = 0; k <= s.degree[0]; k++)
        for (std::size_t l = 0; l <= s.degree[1]; l++) net.poles.push_back(pole((i + k) * s.count[1] + j + l));
    const auto x = reference::surface_at<Q>(net, u, v, orders);
    return {x[0], x[1], x[2]};
}

double apart(const Point &a, const Point &b) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; k++) {
        const double d = CGAL::to_double(a[k] - b[k]);
        sum += d * d;
    }
    return std::sqrt(sum);
}

/** Parameters: two in each of some spans, and the ends. */
std::vector<double> places(const Shape &s, std::size_t k, std::size_t most) {
    std::vector<double> out{s.low(k), s.high(k)};
    std::vector<std::size_t> spans;
    for (std::size_t i = s.degree[k]; i < s.count[k]; i++)
        if (s.knots[k][i] < s.knots[k][i + 1]) spans.push_back(i);
    const std::size_t step = std::max<std::size_t>(1, spans.size() / std::max<std::size_t>(1, most / 2));
    for (std::size_t i = 0; i < spans.size(); i += step) {
        const double a = s.knots[k][spans[i]], b = s.knots[k][spans[i] + 1];
        for (const double share : {0.31, 0.77}) out.push_back(std::clamp(a + share * (b - a), a, b));
    }
    return out;
}

/** What the rounding of the knots of the new shape may move, as a share of its size. */
double moved_by_knots(const Shape &s) {
    double out = 0;
    for (std::size_t k = 0; k < s.directions; k++) {
        double far = 0, step = INFINITY, least = 1, most = 1;
        for (std::size_t i = 0; i < s.knots[k].size(); i++) {
            far = std::max(far, std::fabs(s.knots[k][i]));
            if (i > 0 && s.knots[k][i] > s.knots[k][i - 1]) step = std::min(step, s.knots[k][i] - s.knots[k][i - 1]);
        }
        for (const double w : s.weights) least = std::min(least, w), most = std::max(most, w);
        const double p = double(s.degree[k]);
        out += 32 * DBL_EPSILON * p * p * far / step * (most / least);
    }
    return out;
}

/** Maps of parameters and points, exact. */
using Move = std::function<std::array<Q, 2>(const Q &, const Q &)>;
using Image = std::function<Point(const Point &)>;

struct Record {
    int checks = 0;
    double worst = 0;
};
std::map<std::string, Record> records;
int refused = 0;

/** The names of what is being checked. */
struct Case {
    std::string name;
    Shape old;
    std::vector<std::array<double, 2>> grid;

    Case(std::string named, Shape shape) : name(std::move(named)), old(std::move(shape)) {
        const std::vector<double> u = places(old, 0, old.directions == 1 ? 24 : 8);
        const std::vector<double> v = old.directions == 1 ? std::vector<double>{0} : places(old, 1, 8);
        for (std::size_t i = 0; i < u.size(); i++)
            for (std::size_t j = i % 2; j < v.size(); j += old.directions) grid.push_back({u[i], v[j]});
    }

    double greatest(const Shape &after, const Move &move, const Image &image) const {
        double most = 0;
        for (const auto &place : grid) {
            const auto to = move ? move(Q(place[0]), Q(place[1])) : std::array<Q, 2>{Q(place[0]), Q(place[1])};
            bool inside = true;
            for (std::size_t k = 0; k < after.directions; k++) inside = inside && Q(after.low(k)) <= to[k] && to[k] <= Q(after.high(k));
            if (!inside) continue;
            const Point before = at(old, Q(place[0]), Q(place[1]), 0)[0];
            most = std::max(most, apart(image ? image(before) : before, at(after, to[0], to[1], 0)[0]));
        }
        return most;
    }

    /** Exact up to `limit` of the size, the larger one of both shapes. */
    void exact(const char *what, const Shape &after, double limit = EXACT, const Move &move = {}, const Image &image = {}) const {
        const double off = greatest(after, move, image) / std::max(old.size(), after.size());
        Record &record = records[what];
        record.checks++;
        record.worst = std::max(record.worst, off);
        expect(off <= limit, name.c_str(), what, off, limit);
    }

    /** Not farther away than the error that is claimed to be proven. Not an ulp more is allowed. */
    void within(const char *what, const Shape &after, double error) const {
        const double off = greatest(after, {}, {});
        Record &record = records[what];
        record.checks++;
        record.worst = std::max(record.worst, error > 0 ? off / error : 0);
        expect(off <= error, name.c_str(), what, off, error);
    }
};

/** An operation that a shape may refuse, with a status and a text. */
template <class Step>
void unless_refused(Step step) {
    try {
        step();
    } catch (const footpoint::error &error) {
        refused++;
        expect(error.status() == FPT_UNSUPPORTED || error.status() == FPT_INVALID_ARGUMENT, error.what(), "refused by name", error.status());
    }
}

std::vector<double> middles(const Shape &s, std::size_t k) {
    std::vector<double> out;
    for (std::size_t i = s.degree[k]; i < s.count[k]; i++) {
        const double a = s.knots[k][i], b = s.knots[k][i + 1], u = 0.5 * a + 0.5 * b;
        if (a < u && u < b) out.push_back(u);
    }
    return out;
}

constexpr std::array<double, 12> AFFINE = {0.5, -1, 0.25, 3, 2, 0.125, -0.5, -1, 1, 1, -2, 0.75};

Point affine_image(const Point &p) {
    Point out;
    for (std::size_t r = 0; r < 3; r++) out[r] = Q(AFFINE[4 * r]) * p[0] + Q(AFFINE[4 * r + 1]) * p[1] + Q(AFFINE[4 * r + 2]) * p[2] + Q(AFFINE[4 * r + 3]);
    return out;
}

/** A lens whose vanishing plane is far from the shape. */
std::array<double, 16> lens(double size) {
    const double s = std::ldexp(1, -int(std::ceil(std::log2(16 * size))));
    return {1, 0, 0.5, 0, 0, 1, 0, 0, 0.25, 0, 1, 0, s, -s, s, 1};
}
Image lens_image(const std::array<double, 16> &m) {
    return [m](const Point &p) {
        const auto row = [&](std::size_t r) { return Q(m[4 * r]) * p[0] + Q(m[4 * r + 1]) * p[1] + Q(m[4 * r + 2]) * p[2] + Q(m[4 * r + 3]); };
        const Q w = row(3);
        return Point{row(0) / w, row(1) / w, row(2) / w};
    };
}

Q moebius(const Q &u, double low, double high, double speed) {
    const Q x = (u - Q(low)) / (Q(high) - Q(low)), c(speed);
    return Q(low) + (Q(high) - Q(low)) * c * x / (Q(1) + (c - Q(1)) * x);
}

/** The largest coordinate of what a derivative is made of. */
void derivative_of(const Case &c, const char *what, const Shape &after, std::size_t direction) {
    double most = 0, size = after.size();
    for (const auto &place : c.grid) {
        const Point exact = at(c.old, Q(place[0]), Q(place[1]), 1)[1 + direction];
        most = std::max(most, apart(exact, at(after, Q(place[0]), Q(place[1]), 0)[0]));
    }
    Record &record = records[what];
    record.checks++;
    record.worst = std::max(record.worst, size > 0 ? most / size : 0);
    // The differences of poles lose what their coordinates have in common.
    double step = INFINITY;
    const auto &t = c.old.knots[direction];
    for (std::size_t i = 1; i < t.size(); i++)
        if (t[i] > t[i - 1]) step = std::min(step, t[i] - t[i - 1]);
    double least = 1, greatest = 1;
    for (const double w : c.old.weights) least = std::min(least, w), greatest = std::max(greatest, w);
    const double scale = double(c.old.degree[direction]) * c.old.size() / step * std::pow(greatest / least, 2);
    expect(most <= EXACT * std::max(size, scale), c.name.c_str(), what, most / std::max(size, scale), size);
}

/** Powers of local parameters against the piece, at a few places; digits go with 3^degree. */
void powers_of(const Case &c, const std::vector<double> &powers) {
    const std::size_t p = c.old.degree[0], q = c.old.directions == 2 ? c.old.degree[1] : 0;
    std::vector<std::array<double, 2>> spans[2] = {{}, {{0, 1}}};
    for (std::size_t k = 0; k < c.old.directions; k++) {
        spans[k].clear();
        for (std::size_t i = c.old.degree[k]; i < c.old.count[k]; i++)
            if (c.old.knots[k][i] < c.old.knots[k][i + 1]) spans[k].push_back({c.old.knots[k][i], c.old.knots[k][i + 1]});
    }
    expect(powers.size() == 4 * spans[0].size() * spans[1].size() * (p + 1) * (q + 1), c.name.c_str(), "count of powers", double(powers.size()));
    double worst = 0;
    for (std::size_t i = 0; i < spans[0].size(); i += 1 + spans[0].size() / 6) {
        for (std::size_t j = 0; j < spans[1].size(); j += 1 + spans[1].size() / 6) {
            const double *a = &powers[4 * (i * spans[1].size() + j) * (p + 1) * (q + 1)];
            const double u = 0.5 * spans[0][i][0] + 0.5 * spans[0][i][1], v = 0.5 * spans[1][j][0] + 0.5 * spans[1][j][1];
            const Q s = (Q(u) - Q(spans[0][i][0])) / (Q(spans[0][i][1]) - Q(spans[0][i][0]));
            const Q t = (Q(v) - Q(spans[1][j][0])) / (Q(spans[1][j][1]) - Q(spans[1][j][0]));
            reference::Pole<Q> h{Q(0), Q(0), Q(0), Q(0)};
            Q along(1);
            for (std::size_t k = 0; k <= p; k++, along *= s) {
                Q both = along;
                for (std::size_t l = 0; l <= q; l++, both *= t)
                    for (std::size_t x = 0; x < 4; x++) h[x] += Q(a[4 * (k * (q + 1) + l) + x]) * both;
            }
            worst = std::max(worst, apart(at(c.old, Q(u), Q(v), 0)[0], Point{h[0] / h[3], h[1] / h[3], h[2] / h[3]}));
        }
    }
    double least = 1, greatest = 1;
    for (const double w : c.old.weights) least = std::min(least, w), greatest = std::max(greatest, w);
    Record &record = records["power form, over 3^degree"];
    const double off = worst / c.old.size() / std::pow(3.0, double(p + q)) / (greatest / least);
    record.checks++;
    record.worst = std::max(record.worst, off);
    expect(off <= EXACT, c.name.c_str(), "power form", off);
}

void ask_curve(const std::string &name, const footpoint::curve &ours) {
    const Case c(name, shape_of(ours));
    const double size = c.old.size(), low = c.old.low(0), high = c.old.high(0), mid = 0.5 * low + 0.5 * high;
    c.exact("clamp", shape_of(operate::clamp(ours)));
    c.exact("Bezier form", shape_of(operate::bezier_form(ours)));
    const footpoint::curve finer = operate::refine(ours, middles(c.old, 0));
    c.exact("refine", shape_of(finer));
    for (const std::size_t by : {1u, 3u})
        if (c.old.degree[0] + by <= 31) c.exact(by == 1 ? "elevate" : "elevate by 3", shape_of(operate::elevate(ours, by)));
    c.exact("part", shape_of(operate::part(ours, low + 0.21 * (high - low), low + 0.68 * (high - low))));
    const auto halves = operate::split(ours, mid);
    c.exact("split", shape_of(halves.first));
    c.exact("split", shape_of(halves.second));
    unless_refused([&] {
        const auto joined = operate::join({&halves.first, &halves.second}, 1e-9 * size);
        // The second half is moved behind the first: knots may be rounded.
        c.exact("join, beyond its error", shape_of(joined.shape), joined.error / size + EXACT + moved_by_knots(c.old));
    });
    const footpoint::curve back = operate::reverse(ours);
    c.exact("reverse", shape_of(back), EXACT + moved_by_knots(c.old), [&](const Q &u, const Q &v) { return std::array<Q, 2>{Q(low) + Q(high) - u, v}; });
    unless_refused([&] {
        const footpoint::curve other = operate::with_domain(ours, -1, 2);
        const Shape after = shape_of(other);
        c.exact("other domain", after, EXACT + moved_by_knots(c.old) + moved_by_knots(after), [&](const Q &u, const Q &v) {
            return std::array<Q, 2>{Q(-1) + Q(3) * (u - Q(low)) / (Q(high) - Q(low)), v};
        });
    });
    unless_refused([&] {
        const Shape after = shape_of(operate::reparametrise(ours, 1.75));
        c.exact("Moebius", after, EXACT + moved_by_knots(c.old) + moved_by_knots(after),
                [&](const Q &u, const Q &v) { return std::array<Q, 2>{moebius(u, low, high, 1.75), v}; });
    });
    c.exact("affine map", shape_of(operate::affine(ours, AFFINE)), EXACT, {}, affine_image);
    const auto matrix = lens(size);
    c.exact("projective map", shape_of(operate::projective(ours, matrix)), EXACT, {}, lens_image(matrix));
    unless_refused([&] { derivative_of(c, "derivative", shape_of(operate::derivative(ours)), 0); });
    if (c.old.degree[0] <= 15) powers_of(c, operate::power(ours));

    const auto thin = operate::simplify(ours, 1e-3 * size);
    c.within("simplify, of its error", shape_of(thin.shape), thin.error);
    if (c.old.degree[0] > 1)
        unless_refused([&] {
            const auto lower = operate::reduce(ours);
            c.within("reduce, of its error", shape_of(lower.shape), lower.error);
        });
    const std::vector<double> inner = middles(c.old, 0);
    if (c.old.degree[0] < 31) {
        const auto raised = operate::elevate(ours);
        const auto same = operate::reduce(raised);
        Case(name, shape_of(raised)).within("reduce again, of its error", shape_of(same.shape), same.error);
    }
    if (!inner.empty()) {
        const auto same = operate::remove_knot(finer, inner[inner.size() / 2]);
        Case(name, shape_of(finer)).within("remove again, of its error", shape_of(same.shape), same.error);
    }
    for (std::size_t i = c.old.degree[0] + 1; i < c.old.count[0]; i += 1 + c.old.count[0] / 5) {
        if (c.old.knots[0][i] <= low || c.old.knots[0][i] >= high) continue;
        unless_refused([&] {
            const auto fewer = operate::remove_knot(ours, c.old.knots[0][i]);
            c.within("remove a knot, of its error", shape_of(fewer.shape), fewer.error);
        });
    }
    unless_refused([&] {
        const auto open = operate::unclamp(ours);
        c.within("unclamp, of its error", shape_of(open.shape), open.error);
    });
    unless_refused([&] {
        const auto ring = operate::periodic(ours, 1e-2 * size);
        c.within("periodic, of its error", shape_of(ring.shape), ring.error);
    });
    const fpt_difference difference = operate::difference(ours, thin.shape);
    c.within("difference, of its bound", shape_of(thin.shape), difference.bound);
}

void ask_surface(const std::string &name, const footpoint::surface &ours) {
    const Case c(name, shape_of(ours));
    const double size = c.old.size();
    const std::array<double, 4> domain = ours.domain();
    c.exact("clamp", shape_of(operate::clamp(ours)));
    c.exact("Bezier form", shape_of(operate::bezier_form(ours)));
    c.exact("swap", shape_of(operate::swap(ours)), 0, [](const Q &u, const Q &v) { return std::array<Q, 2>{v, u}; });
    const std::array<double, 4> sub = {domain[0] + 0.2 * (domain[1] - domain[0]), domain[0] + 0.7 * (domain[1] - domain[0]),
                                       domain[2] + 0.1 * (domain[3] - domain[2]), domain[2] + 0.8 * (domain[3] - domain[2])};
    c.exact("part", shape_of(operate::part(ours, sub)));
    c.exact("affine map", shape_of(operate::affine(ours, AFFINE)), EXACT, {}, affine_image);
    const auto matrix = lens(size);
    c.exact("projective map", shape_of(operate::projective(ours, matrix)), EXACT, {}, lens_image(matrix));
    for (const std::uint32_t along : {FPT_DIRECTION_U, FPT_DIRECTION_V}) {
        const double low = domain[2 * along], high = domain[2 * along + 1];
        const auto moved = [along](const Q &u, const Q &v, const Q &to) { return along == 0 ? std::array<Q, 2>{to, v} : std::array<Q, 2>{u, to}; };
        const auto own = [along](const Q &u, const Q &v) { return along == 0 ? u : v; };
        const footpoint::surface finer = operate::refine(ours, along, middles(c.old, along));
        c.exact("refine", shape_of(finer));
        if (c.old.degree[along] < 31) {
            const footpoint::surface raised = operate::elevate(ours, along);
            c.exact("elevate", shape_of(raised));
            const auto same = operate::reduce(raised, along);
            Case(name, shape_of(raised)).within("reduce again, of its error", shape_of(same.shape), same.error);
        }
        const auto halves = operate::split(ours, along, 0.5 * low + 0.5 * high);
        c.exact("split", shape_of(halves.first));
        c.exact("split", shape_of(halves.second));
        unless_refused([&] {
            const auto joined = operate::join({&halves.first, &halves.second}, along, 1e-9 * size);
            c.exact("join, beyond its error", shape_of(joined.shape), joined.error / size + EXACT + moved_by_knots(c.old));
        });
        c.exact("reverse", shape_of(operate::reverse(ours, along)), EXACT + moved_by_knots(c.old),
                [&](const Q &u, const Q &v) { return moved(u, v, Q(low) + Q(high) - own(u, v)); });
        unless_refused([&] {
            const Shape after = shape_of(operate::reparametrise(ours, along, 0.6));
            c.exact("Moebius", after, EXACT + moved_by_knots(c.old) + moved_by_knots(after),
                    [&](const Q &u, const Q &v) { return moved(u, v, moebius(own(u, v), low, high, 0.6)); });
        });
        unless_refused([&] { derivative_of(c, "derivative", shape_of(operate::derivative(ours, along)), along); });
        const double fixed = low + 0.37 * (high - low);
        const Shape iso = shape_of(operate::isocurve(ours, along, fixed));
        double most = 0;
        for (const double t : places(iso, 0, 12)) {
            const Point exact = along == 0 ? at(c.old, Q(fixed), Q(t), 0)[0] : at(c.old, Q(t), Q(fixed), 0)[0];
            most = std::max(most, apart(exact, at(iso, Q(t), Q(0), 0)[0]));
        }
        Record &record = records["isocurve"];
        record.checks++;
        record.worst = std::max(record.worst, most / size);
        expect(most <= EXACT * size, name.c_str(), "isocurve", most / size);
        if (c.old.degree[along] > 1)
            unless_refused([&] {
                const auto lower = operate::reduce(ours, along);
                c.within("reduce, of its error", shape_of(lower.shape), lower.error);
            });
        unless_refused([&] {
            const auto open = operate::unclamp(ours, along);
            c.within("unclamp, of its error", shape_of(open.shape), open.error);
        });
        unless_refused([&] {
            const auto ring = operate::periodic(ours, along, 1e-2 * size);
            c.within("periodic, of its error", shape_of(ring.shape), ring.error);
        });
    }
    if (c.old.degree[0] + c.old.degree[1] <= 12) powers_of(c, operate::power(ours));
    if (c.old.poles.size() <= 3 * 400) {
        const auto thin = operate::simplify(ours, 1e-3 * size);
        c.within("simplify, of its error", shape_of(thin.shape), thin.error);
        c.within("difference, of its bound", shape_of(thin.shape), operate::difference(ours, thin.shape).bound);
    }
}

} // namespace

int main(int count, char **words) {
    int shapes = 0;
    for (int i = 1; i < count; i++) {
        if (!std::filesystem::is_directory(words[i])) continue;
        std::vector<std::filesystem::path> folders;
        for (const auto &entry : std::filesystem::directory_iterator(words[i])) folders.push_back(entry.path());
        std::sort(folders.begin(), folders.end());
        for (const auto &folder : folders) {
            if (!std::filesystem::exists(folder / "geometry.txt")) continue;
            const Geometry g = read_geometry((folder / "geometry.txt").string());
            // Large nets hold no other kinds of pieces.
            if (g.poles.size() > 3 * 2500) continue;
            shapes++;
            const std::vector<double> weights = g.rational ? g.weights : std::vector<double>();
            const std::string name = folder.filename().string();
            try {
                if (g.is_curve)
                    ask_curve(name, footpoint::curve(std::size_t(g.degree[0]), g.knots[0], g.poles, weights));
                else
                    ask_surface(name, footpoint::surface(std::size_t(g.degree[0]), std::size_t(g.degree[1]), g.knots[0], g.knots[1], g.poles, weights));
            } catch (const footpoint::error &error) {
                expect(false, name.c_str(), error.what());
            }
        }
    }
    for (const auto &[what, record] : records) std::printf("%-32s %6d  worst %.2g\n", what.c_str(), record.checks, record.worst);
    std::printf("%d shapes; exact operations relative to the size of the shape; %d refused\n", shapes, refused);
    return verdict();
}
