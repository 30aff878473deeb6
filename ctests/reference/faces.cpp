// Sides of faces against exact rational arithmetic (CGAL's Gmpq): crossings of a ray with the loops, by halving of exact Bezier pieces.
// Points all over, on edges and vertices, and beside them down to 1e-15; on a plane as spline, and on a cylinder and a sphere by their
// angles, where the lengths in space are known from those in the domain. SPDX-License-Identifier: MIT OR Apache-2.0
//
//   reference_faces [points]      20,000 points by default
#include "check.hpp"

#include <footpoint.hpp>

#include <CGAL/Gmpq.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace {

using Q = CGAL::Gmpq;

std::mt19937 random_numbers(23);
double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_numbers); }

/** Homogeneous Bezier coefficients x*w, y*w, w. */
struct Piece {
    std::vector<Q> x, y, w;
};

/** Exact Bezier pieces of a spline by blossoms. */
std::vector<Piece> pieces(std::size_t degree, const std::vector<double> &knots, const std::vector<double> &poles,
                          const std::vector<double> &weights) {
    std::vector<Piece> out;
    const std::size_t count = poles.size() / 3;
    const std::vector<Q> t(knots.begin(), knots.end());
    for (std::size_t span = degree; span < count; span++) {
        if (knots[span] == knots[span + 1]) continue;
        Piece piece;
        for (std::size_t i = 0; i <= degree; i++) {
            std::vector<std::array<Q, 3>> d;
            for (std::size_t j = 0; j <= degree; j++) {
                const std::size_t at = span - degree + j;
                const Q w = weights.empty() ? Q(1) : Q(weights[at]);
                d.push_back({Q(poles[3 * at]) * w, Q(poles[3 * at + 1]) * w, w});
            }
            for (std::size_t level = 1; level <= degree; level++) {
                const Q a = level <= degree - i ? t[span] : t[span + 1];
                for (std::size_t j = degree; j >= level; j--) {
                    const Q low = t[span - degree + j], high = t[span + 1 + j - level];
                    const Q share = (a - low) / (high - low);
                    for (std::size_t k = 0; k < 3; k++) d[j][k] = (Q(1) - share) * d[j - 1][k] + share * d[j][k];
                }
            }
            piece.x.push_back(d[degree][0]);
            piece.y.push_back(d[degree][1]);
            piece.w.push_back(d[degree][2]);
        }
        out.push_back(piece);
    }
    return out;
}

enum class Side { inside, outside, on };

/** Halves f and g in place; the upper halves come back. */
std::pair<std::vector<Q>, std::vector<Q>> halve(std::vector<Q> &f, std::vector<Q> &g) {
    const auto one = [](std::vector<Q> &c) {
        const std::size_t n = c.size() - 1;
        std::vector<Q> high(n + 1);
        for (std::size_t k = 0; k <= n; k++) {
            high[n - k] = c[n];
            for (std::size_t i = n; i > k; i--) c[i] = (c[i] + c[i - 1]) / Q(2);
        }
        return high;
    };
    auto upper = one(f);
    return {std::move(upper), one(g)};
}

/** Whether a ray to the right crosses an odd number of times; f = x - u w, g = y - v w. */
int crossings(std::vector<Q> f, std::vector<Q> g, int depth) {
    const auto is = [](const std::vector<Q> &c, auto test) { return std::all_of(c.begin(), c.end(), test); };
    const auto positive = [](const Q &x) { return x > Q(0); };
    const auto not_positive = [](const Q &x) { return x <= Q(0); };
    const auto negative = [](const Q &x) { return x < Q(0); };
    if (is(g, positive) || is(g, not_positive)) {
        // Without a crossing, unless the place is on it.
        const auto zero = [](const Q &x) { return x == Q(0); };
        if (!std::any_of(g.begin(), g.end(), zero)) return 0;
        if (is(f, negative) || is(f, positive)) return 0;
    }
    if (is(f, negative)) return 0;
    if (is(f, positive)) return (g.front() <= Q(0)) != (g.back() <= Q(0)) ? 1 : 0;
    if (depth == 0) return -1;
    const auto high = halve(f, g);
    const int a = crossings(f, g, depth - 1);
    if (a < 0) return a;
    const int b = crossings(high.first, high.second, depth - 1);
    return b < 0 ? b : a ^ b;
}

Side exact_side(const std::vector<Piece> &all, double u, double v) {
    int odd = 0;
    const Q qu(u), qv(v);
    for (const Piece &piece : all) {
        std::vector<Q> f, g;
        for (std::size_t i = 0; i < piece.x.size(); i++) {
            f.push_back(piece.x[i] - qu * piece.w[i]);
            g.push_back(piece.y[i] - qv * piece.w[i]);
        }
        const int found = crossings(f, g, 62);
        if (found < 0) return Side::on;
        odd ^= found;
    }
    return odd ? Side::inside : Side::outside;
}

/** A closed loop: polygon, cubic, or rational quadratic. */
struct Loop {
    std::size_t degree;
    std::vector<double> knots, poles, weights;
};
Loop loop(std::size_t degree, double x, double y, double size, bool is_rational) {
    Loop out{degree, {}, {}, {}};
    const int count = 6 + int(between(0, 8));
    for (int i = 0; i < count; i++) {
        const double angle = 2 * 3.14159265358979 * i / count, r = size * between(0.4, 1);
        out.poles.insert(out.poles.end(), {x + r * std::cos(angle), y + r * std::sin(angle), 0});
    }
    out.poles.insert(out.poles.end(), {out.poles[0], out.poles[1], 0});
    const std::size_t poles = std::size_t(count) + 1;
    out.knots.assign(degree + 1, 0.0);
    double t = 0;
    for (std::size_t i = degree + 1; i < poles; i++) out.knots.push_back(t += between(0.2, 1));
    out.knots.insert(out.knots.end(), degree + 1, t + 0.5);
    if (is_rational)
        for (std::size_t i = 0; i < poles; i++) out.weights.push_back(between(0.3, 3));
    return out;
}

double distance(const footpoint::curve &curve, double u, double v) {
    const double query[3] = {u, v, 0};
    return curve.closest(footpoint::span<const double>(query, 3))[0].distance;
}

/** A face with two loops on the unit square of the parameters of a plane, a cylinder or a sphere of radius 1. */
footpoint::face face_on(int kind, const std::vector<footpoint::curve> &curves) {
    if (kind == 0) {
        const std::vector<double> line = {0, 0, 1, 1};
        const std::vector<double> square = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
        const footpoint::surface plane(1, 1, line, line, square);
        const std::vector<std::vector<const footpoint::curve *>> chains = {{&curves[0]}, {&curves[1]}};
        return footpoint::face(plane, chains);
    }
    footpoint::elementary_data data(kind == 1 ? FPT_ELEMENTARY_CYLINDER : FPT_ELEMENTARY_SPHERE, {0, 1, 0, 1});
    data.first = 1;
    const footpoint::support support(data);
    fpt_coedge_data coedges[2] = {};
    fpt_loop_data loops[2] = {};
    for (int k = 0; k < 2; k++) {
        coedges[k].kind = FPT_PCURVE_SPLINE;
        coedges[k].curve = curves[std::size_t(k)].get();
        coedges[k].edge = SIZE_MAX;
        loops[k].is_inner = std::uint32_t(k);
        loops[k].coedges = &coedges[k];
        loops[k].coedge_count = 1;
    }
    fpt_trim_data trim{};
    trim.struct_size = sizeof trim;
    trim.support = support.get();
    trim.loops = loops;
    trim.loop_count = 2;
    return footpoint::trimmed_surface(trim).prepared();
}

void faces(int points) {
    const int count = 30, each = points / count + 1;
    std::size_t asked = 0, on_edge = 0, on_vertex = 0, decided = 0, unknown = 0;
    for (int n = 0; n < count; n++) {
        // Lengths in space are between `least` and 1 times those in the domain.
        const int kind = n / 2 % 3;
        const double least = kind == 2 ? std::cos(1.0) : 1;
        const std::size_t degree = std::size_t(n) % 4 + 1;
        std::vector<Loop> loops = {loop(degree, 0.5, 0.5, 0.48, n % 3 == 0), loop(1 + degree % 3, 0.5, 0.5, 0.17, n % 2 == 0)};
        std::vector<footpoint::curve> curves;
        std::vector<Piece> exact;
        for (const Loop &l : loops) {
            curves.emplace_back(l.degree, l.knots, l.poles, l.weights);
            for (const Piece &piece : pieces(l.degree, l.knots, l.poles, l.weights)) exact.push_back(piece);
        }
        const footpoint::face face = face_on(kind, curves);
        std::vector<double> uv;
        for (int i = 0; i < each; i++) {
            const footpoint::curve &curve = curves[std::size_t(i / 5) % 2];
            const std::array<double, 2> range = curve.domain();
            const std::vector<double> at = curve.evaluate(between(range[0], range[1]), 1);
            const double length = std::hypot(at[3], at[4]), off = std::pow(10.0, between(-15, -2)) * (i % 2 ? 1 : -1);
            switch (i % 5) {
            case 0: uv.insert(uv.end(), {between(0, 1), between(0, 1)}); break;
            case 1: { // vertices: ends of curves, corners of polygons
                const Loop &l = loops[std::size_t(i) % 2];
                const std::size_t k = l.degree == 1 ? std::size_t(between(0, double(l.poles.size() / 3) - 0.5)) : 0;
                uv.insert(uv.end(), {l.poles[3 * k], l.poles[3 * k + 1]});
                on_vertex++;
                break;
            }
            case 2: uv.insert(uv.end(), {at[0], at[1]}); break;
            case 3: uv.insert(uv.end(), {at[0] - off * at[4] / length, at[1] + off * at[3] / length}); break;
            default: { // a pole's height, where the ray passes ends of pieces
                const std::vector<double> &poles = loops[std::size_t(i) % 2].poles;
                const std::size_t k = std::size_t(between(0, double(poles.size() / 3) - 0.5));
                uv.insert(uv.end(), {i % 3 ? between(0, 1) : poles[3 * k], poles[3 * k + 1]});
            }
            }
        }
        footpoint::query_options options;
        // Images on the cylinder and the sphere are fitted: places so near to the tolerance are not decided there.
        const double band = kind == 0 ? 0 : 1e-10;
        options.tolerance = n % 2 || kind != 0 ? 1e-9 : 3e-13;
        const std::vector<fpt_face_place> found = face.classify(uv, options);
        for (std::size_t i = 0; i < found.size(); i++) {
            const double u = uv[2 * i], v = uv[2 * i + 1];
            const Side side = exact_side(exact, u, v);
            const double nearest = std::min(distance(curves[0], u, v), distance(curves[1], u, v));
            asked++;
            on_edge += found[i].standing == FPT_FACE_ON_EDGE;
            decided += found[i].standing == FPT_FACE_INSIDE || found[i].standing == FPT_FACE_OUTSIDE;
            switch (found[i].standing) {
            case FPT_FACE_INSIDE:
            case FPT_FACE_OUTSIDE:
                expect((side == Side::inside) == (found[i].standing == FPT_FACE_INSIDE) && side != Side::on, "side", "as in exact numbers", u, v, nearest);
                expect(nearest > options.tolerance * (1 - 1e-6) - 1e-15, "side", "not within the tolerance of an edge", u, v, nearest);
                break;
            case FPT_FACE_ON_EDGE: {
                expect(least * nearest <= options.tolerance * (1 + 1e-6) + 1e-15, "edge", "within the tolerance", u, v, nearest);
                const std::vector<double> at = curves[found[i].loop_index].evaluate(found[i].parameter);
                expect(least * std::hypot(at[0] - u, at[1] - v) <= options.tolerance * (1 + 1e-6) + 1e-15, "edge", "the place named", u, v);
                break;
            }
            default:
                unknown++;
                expect(nearest >= options.tolerance - band && least * nearest <= options.tolerance + band && band > 0, "standing", "decided", u, v, nearest);
            }
        }
    }
    std::printf("%zu places, %zu of them vertices: %zu on an edge, %zu inside or outside, %zu within 1e-10 of the tolerance unknown\n", asked,
                on_vertex, on_edge, decided, unknown);
}

} // namespace

int main(int count, char **words) {
    faces(count > 1 ? std::atoi(words[1]) : 20000);
    return verdict();
}
