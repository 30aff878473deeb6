// footpoint against exact rational arithmetic (CGAL's Gmpq): evaluation and derivatives of curves and surfaces to degree 25, rational
// too; foot points by the exact signs of the orthogonality conditions around the returned parameters; the proven bound against
// the exact distance. SPDX-License-Identifier: MIT OR Apache-2.0
#include "check.hpp"
#include "spline.hpp"

#include <footpoint.hpp>

#include <CGAL/Gmpq.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <random>

namespace {

using Q = CGAL::Gmpq;
using reference::Net;
using reference::Pole;
using reference::Spline;
using reference::Vector;

std::mt19937 random_numbers(11);
double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_numbers); }

/** Clamped knots, some of them double. */
std::vector<double> knots(std::size_t degree, std::size_t spans) {
    std::vector<double> out(degree + 1, -1.0);
    double x = -1;
    for (std::size_t i = 1; i < spans; i++) {
        x += between(0.3, 1);
        out.insert(out.end(), i % 3 == 0 && degree > 1 ? 2 : 1, x);
    }
    out.insert(out.end(), degree + 1, x + 0.7);
    return out;
}

std::vector<Q> exact(const std::vector<double> &numbers) { return {numbers.begin(), numbers.end()}; }

std::vector<Pole<Q>> exact_poles(const std::vector<double> &poles, const std::vector<double> &weights) {
    std::vector<Pole<Q>> out;
    for (std::size_t i = 0; i < poles.size() / 3; i++) {
        const Q w = weights.empty() ? Q(1) : Q(weights[i]);
        out.push_back({Q(poles[3 * i]) * w, Q(poles[3 * i + 1]) * w, Q(poles[3 * i + 2]) * w, w});
    }
    return out;
}

struct Curve {
    footpoint::curve ours;
    Spline<Q> exact;
};
Curve curve(std::size_t degree, std::size_t spans, bool is_rational) {
    const std::vector<double> t = knots(degree, spans);
    std::vector<double> poles, weights;
    for (std::size_t i = 0; i + degree + 1 < t.size(); i++) {
        poles.insert(poles.end(), {double(i) + between(-0.5, 0.5), between(-3, 3), between(-3, 3)});
        if (is_rational) weights.push_back(between(0.4, 2.5));
    }
    return {footpoint::curve(degree, t, poles, weights), {degree, exact(t), exact_poles(poles, weights)}};
}

struct Surface {
    footpoint::surface ours;
    Net<Q> exact;
};
Surface surface(std::size_t p, std::size_t q, std::size_t spans, bool is_rational) {
    const std::vector<double> s = knots(p, spans), t = knots(q, spans);
    std::vector<double> poles, weights;
    for (std::size_t i = 0; i + p + 1 < s.size(); i++) {
        for (std::size_t j = 0; j + q + 1 < t.size(); j++) {
            poles.insert(poles.end(), {double(i) + between(-0.3, 0.3), double(j) + between(-0.3, 0.3), between(-1.5, 1.5)});
            if (is_rational) weights.push_back(between(0.4, 2.5));
        }
    }
    return {footpoint::surface(p, q, s, t, poles, weights), {{p, q}, {exact(s), exact(t)}, exact_poles(poles, weights)}};
}

double away(const double *ours, const Vector<Q> &exact) {
    double out = 0;
    for (std::size_t k = 0; k < 3; k++) out = std::max(out, std::abs(CGAL::to_double(Q(ours[k]) - exact[k])));
    return out;
}

double worst[3] = {0, 0, 0};

/**
 * De Boor's algorithm makes five roundings a level, all of numbers that are at most the largest pole; a derivative is made of poles that
 * grow by 2 degree / span with each order. The quotient of rational shapes multiplies by the ratio of the weights, each order again.
 */
double allowed(std::size_t degree, std::size_t order, double pole, double span, double weights) {
    double scale = pole * std::pow(weights, double(order) + 1);
    for (std::size_t k = 0; k < order; k++) scale *= 2 * double(degree > k ? degree - k : 1) / span;
    return 5 * double(degree + 1) * DBL_EPSILON * scale;
}

void evaluation_of_curves() {
    for (std::size_t degree = 1; degree <= 25; degree++) {
        for (const bool is_rational : {false, true}) {
            const Curve c = curve(degree, 4, is_rational);
            const auto domain = c.ours.domain();
            for (int i = 0; i <= 12; i++) {
                const double u = i == 0 ? domain[0] : i == 12 ? domain[1] : between(domain[0], domain[1]);
                const std::vector<double> ours = c.ours.evaluate(u, 2);
                const auto theirs = reference::curve_at<Q>(c.exact, Q(u));
                for (std::size_t k = 0; k < 3; k++) {
                    const double off = away(&ours[3 * k], theirs[k]);
                    const double most = allowed(degree, k, double(degree) + 8, 0.3, is_rational ? 2.5 / 0.4 : 1);
                    worst[k] = std::max(worst[k], off / most);
                    expect(off <= most, "curve", "derivative of order", double(degree), double(k), off);
                }
            }
        }
    }
}

void evaluation_of_surfaces() {
    const std::size_t degrees[][2] = {{1, 1}, {1, 3}, {2, 2}, {3, 3}, {3, 5}, {4, 2}, {7, 6}, {12, 9}, {25, 3}, {25, 25}};
    for (const auto &degree : degrees) {
        for (const bool is_rational : {false, true}) {
            const Surface s = surface(degree[0], degree[1], degree[0] == 25 && degree[1] == 25 ? 1 : 3, is_rational);
            const auto domain = s.ours.domain();
            for (int i = 0; i < (degree[0] > 20 ? 2 : 8); i++) {
                const double u = i == 0 ? domain[0] : between(domain[0], domain[1]), v = i == 1 ? domain[3] : between(domain[2], domain[3]);
                const std::vector<double> ours = s.ours.evaluate(u, v, 2);
                const auto theirs = reference::surface_at<Q>(s.exact, Q(u), Q(v));
                const std::size_t most_degree = std::max(degree[0], degree[1]);
                for (std::size_t k = 0; k < 6; k++) {
                    const std::size_t order = k == 0 ? 0 : k < 3 ? 1 : 2;
                    const double off = away(&ours[3 * k], theirs[k]);
                    const double most = 2 * allowed(most_degree, order, double(most_degree) + 5, 0.3, is_rational ? 2.5 / 0.4 : 1);
                    worst[order] = std::max(worst[order], off / most);
                    expect(off <= most, "surface", "derivative", double(degree[0]), double(k), off);
                }
            }
        }
    }
}

int steps[64];

/** The exact distance: the bound is below it, and the distance that was told is it up to rounding. */
void distances(const char *about, const fpt_foot_point &foot, const Vector<Q> &to) {
    const Q square = reference::dot(to, to), bound(foot.lower_bound);
    expect(bound * bound <= square, about, "the bound is above the exact distance at the foot", foot.lower_bound,
           std::sqrt(CGAL::to_double(square)));
    const double off = std::abs(foot.distance - std::sqrt(CGAL::to_double(square)));
    expect(off <= 1e-13 * (1 + foot.distance), about, "distance", foot.distance, off);
    expect((foot.flags & FPT_FOOT_NOT_PROVEN) == 0, about, "not proven", foot.flags);
}

/** Stationary between u - d and u + d: (C - q).C' is exactly negative below and exactly positive above. The least 2^-k that shows it
 *  is recorded; flat minima need larger steps, by the square root of the rounding at most. */
void feet_on_curves() {
    for (int i = 0; i < 240; i++) {
        const Curve c = curve(std::size_t(1 + i % 9), 4, i % 2 == 1);
        const auto domain = c.ours.domain();
        const std::vector<double> query{between(-1, 9), between(-4, 4), between(-4, 4)};
        const Vector<Q> q{Q(query[0]), Q(query[1]), Q(query[2])};
        const fpt_foot_point foot = c.ours.closest(query).at(0);
        const auto side = [&](double u) {
            const auto x = reference::curve_at<Q>(c.exact, Q(u), 1);
            return CGAL::sign(reference::dot(reference::minus(x[0], q), x[1]));
        };
        distances("curve", foot, reference::minus(reference::curve_at<Q>(c.exact, Q(foot.u), 0)[0], q));
        const double length = domain[1] - domain[0];
        int k = 50;
        for (; k >= 26; k--) {
            const double d = std::ldexp(length, -k);
            const bool below = foot.u - d < domain[0] || side(foot.u - d) == CGAL::NEGATIVE;
            const bool above = foot.u + d > domain[1] || side(foot.u + d) == CGAL::POSITIVE;
            if (below && above) break;
        }
        expect(k >= 26, "curve", "no sign change around the foot", foot.u, foot.distance);
        if (k >= 26) steps[k]++;
    }
}

/** On surfaces the two conditions, turned by the inverse of their derivatives so that each belongs to one direction, have the right
 *  exact signs at three places of each side of a square around the foot; beyond the border of the domain nothing is asked. */
void feet_on_surfaces() {
    for (int i = 0; i < 60; i++) {
        const Surface s = surface(std::size_t(2 + i % 4), std::size_t(2 + i % 3), 3, i % 2 == 1);
        const auto domain = s.ours.domain();
        const std::vector<double> query{between(0, 5), between(0, 5), between(-3, 3)};
        const Vector<Q> q{Q(query[0]), Q(query[1]), Q(query[2])};
        const fpt_foot_point foot = s.ours.closest(query).at(0);
        distances("surface", foot, reference::minus(reference::surface_at<Q>(s.exact, Q(foot.u), Q(foot.v), 0)[0], q));
        // Half the Hessian of the squared distance, in doubles: only the directions of the test depend on it.
        const std::vector<double> x = s.ours.evaluate(foot.u, foot.v, 2);
        const auto product = [&](std::size_t a, std::size_t b) { return x[3 * a] * x[3 * b] + x[3 * a + 1] * x[3 * b + 1] + x[3 * a + 2] * x[3 * b + 2]; };
        const auto bend = [&](std::size_t a) {
            double out = 0;
            for (std::size_t k = 0; k < 3; k++) out += (x[k] - query[k]) * x[3 * a + k];
            return out;
        };
        const double huu = product(1, 1) + bend(3), huv = product(1, 2) + bend(4), hvv = product(2, 2) + bend(5);
        const bool u_free = foot.u > domain[0] && foot.u < domain[1], v_free = foot.v > domain[2] && foot.v < domain[3];
        const auto conditions = [&](double u, double v) {
            const auto y = reference::surface_at<Q>(s.exact, Q(u), Q(v), 1);
            const Vector<Q> to = reference::minus(y[0], q);
            return std::array<Q, 2>{reference::dot(to, y[1]), reference::dot(to, y[2])};
        };
        const double along[2] = {domain[1] - domain[0], domain[3] - domain[2]};
        int k = 46;
        for (; k >= 26; k--) {
            const double d[2] = {std::ldexp(along[0], -k), std::ldexp(along[1], -k)};
            bool holds = true;
            if (u_free && v_free) {
                for (int side = 0; side < 4 && holds; side++) {
                    const int direction = side / 2, sign = side % 2 == 0 ? -1 : 1;
                    for (const double t : {-1.0, 0.0, 1.0}) {
                        const double u = foot.u + d[0] * (direction == 0 ? sign : t), v = foot.v + d[1] * (direction == 1 ? sign : t);
                        if (u < domain[0] || u > domain[1] || v < domain[2] || v > domain[3]) continue;
                        const auto f = conditions(u, v);
                        // Row of the adjoint matrix; its determinant is positive at a minimum.
                        const Q turned = direction == 0 ? Q(hvv) * f[0] - Q(huv) * f[1] : Q(huu) * f[1] - Q(huv) * f[0];
                        holds = holds && CGAL::sign(turned) == sign;
                    }
                }
            } else {
                // On the border: stationary along it, and rising inwards.
                for (int direction = 0; direction < 2; direction++) {
                    const bool is_free = direction == 0 ? u_free : v_free;
                    const double at = direction == 0 ? foot.u : foot.v;
                    for (const int sign : {-1, 1}) {
                        const double moved = at + sign * d[direction];
                        if (moved < domain[std::size_t(2 * direction)] || moved > domain[std::size_t(2 * direction + 1)]) continue;
                        if (!is_free && sign == (at == domain[std::size_t(2 * direction)] ? -1 : 1)) continue;
                        const auto f = direction == 0 ? conditions(moved, foot.v) : conditions(foot.u, moved);
                        holds = holds && CGAL::sign(f[std::size_t(direction)]) == sign;
                    }
                }
            }
            if (holds) break;
        }
        expect(k >= 26, "surface", "the signs around the foot are wrong", foot.u, foot.v, double(foot.flags));
        if (k >= 26) steps[k]++;
    }
}

} // namespace

int main() {
    evaluation_of_curves();
    evaluation_of_surfaces();
    std::printf("largest error over what rounding allows: points %.2g, first derivatives %.2g, second %.2g\n", worst[0], worst[1], worst[2]);
    feet_on_curves();
    feet_on_surfaces();
    std::printf("feet enclosed by exact signs within 2^-k of the domain:");
    for (int k = 63; k >= 0; k--)
        if (steps[k] > 0) std::printf(" %d: %d", k, steps[k]);
    std::printf("\n");
    return verdict();
}
