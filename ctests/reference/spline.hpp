// B-splines over any field of numbers, by de Boor's algorithm on homogeneous poles: with rationals they are exact. Plain on purpose:
// nothing of it comes from footpoint. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef FOOTPOINT_REFERENCE_SPLINE_HPP
#define FOOTPOINT_REFERENCE_SPLINE_HPP

#include <array>
#include <cstddef>
#include <vector>

namespace reference {

/** x*w, y*w, z*w, w. */
template <class N>
using Pole = std::array<N, 4>;
template <class N>
using Vector = std::array<N, 3>;

template <class N>
N dot(const Vector<N> &a, const Vector<N> &b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class N>
Vector<N> minus(const Vector<N> &a, const Vector<N> &b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/** A curve in four dimensions. */
template <class N>
struct Spline {
    std::size_t degree;
    std::vector<N> knots;
    std::vector<Pole<N>> poles;

    Pole<N> at(const N &u) const {
        std::size_t span = degree;
        while (span + 1 < poles.size() && knots[span + 1] <= u) span++;
        std::vector<Pole<N>> d(poles.begin() + std::ptrdiff_t(span - degree), poles.begin() + std::ptrdiff_t(span + 1));
        for (std::size_t level = 1; level <= degree; level++) {
            for (std::size_t j = degree; j >= level; j--) {
                const std::size_t i = span - degree + j;
                const N a = (u - knots[i]) / (knots[i + degree - level + 1] - knots[i]);
                for (std::size_t k = 0; k < 4; k++) d[j][k] = (N(1) - a) * d[j - 1][k] + a * d[j][k];
            }
        }
        return d[degree];
    }

    /** Poles that belong to a knot span without length do not act; they become 0. */
    Spline derivative() const {
        Spline out{degree - 1, std::vector<N>(knots.begin() + 1, knots.end() - 1), {}};
        for (std::size_t i = 0; i + 1 < poles.size(); i++) {
            const N length = knots[i + degree + 1] - knots[i + 1];
            Pole<N> d{N(0), N(0), N(0), N(0)};
            if (length > N(0))
                for (std::size_t k = 0; k < 4; k++) d[k] = N(int(degree)) * (poles[i + 1][k] - poles[i][k]) / length;
            out.poles.push_back(d);
        }
        return out;
    }
};

/** C, C', C'' of a rational curve. */
template <class N>
std::array<Vector<N>, 3> curve_at(const Spline<N> &c, const N &u, int orders = 2) {
    Pole<N> a[3];
    Spline<N> d = c;
    for (int k = 0; k <= orders; k++) {
        if (d.degree == 0 && k > 0 && std::size_t(k) > c.degree) {
            a[k] = {N(0), N(0), N(0), N(0)};
            continue;
        }
        a[k] = d.at(u);
        if (d.degree > 0) d = d.derivative();
    }
    std::array<Vector<N>, 3> out{};
    for (std::size_t k = 0; k < 3; k++) {
        out[0][k] = a[0][k] / a[0][3];
        if (orders > 0) out[1][k] = (a[1][k] - a[1][3] * out[0][k]) / a[0][3];
        if (orders > 1) out[2][k] = (a[2][k] - N(2) * a[1][3] * out[1][k] - a[2][3] * out[0][k]) / a[0][3];
    }
    return out;
}

/** Pole (i,j) is number i*count_v + j. */
template <class N>
struct Net {
    std::size_t degree[2];
    std::vector<N> knots[2];
    std::vector<Pole<N>> poles;

    std::size_t count(int k) const { return knots[k].size() - degree[k] - 1; }
    Spline<N> row(std::size_t i) const {
        const auto first = poles.begin() + std::ptrdiff_t(i * count(1));
        return {degree[1], knots[1], std::vector<Pole<N>>(first, first + std::ptrdiff_t(count(1)))};
    }
};

/** S; Su, Sv; Suu, Suv, Svv of a rational surface. */
template <class N>
std::array<Vector<N>, 6> surface_at(const Net<N> &s, const N &u, const N &v, int orders = 2) {
    // a[i][j]: derivative i in u and j in v.
    Pole<N> a[3][3];
    for (int j = 0; j <= orders; j++) {
        Spline<N> column{s.degree[0], s.knots[0], {}};
        for (std::size_t i = 0; i < s.count(0); i++) {
            Spline<N> row = s.row(i);
            for (int k = 0; k < j; k++) row = row.degree == 0 ? Spline<N>{0, row.knots, {Pole<N>{N(0), N(0), N(0), N(0)}}} : row.derivative();
            column.poles.push_back(std::size_t(j) > s.degree[1] ? Pole<N>{N(0), N(0), N(0), N(0)} : row.at(v));
        }
        for (int i = 0; i + j <= orders; i++) {
            a[i][j] = std::size_t(i) > s.degree[0] ? Pole<N>{N(0), N(0), N(0), N(0)} : column.at(u);
            if (column.degree > 0) column = column.derivative();
        }
    }
    std::array<Vector<N>, 6> out{};
    for (std::size_t k = 0; k < 3; k++) {
        const N w = a[0][0][3];
        const N p = a[0][0][k] / w;
        out[0][k] = p;
        if (orders < 1) continue;
        const N pu = (a[1][0][k] - a[1][0][3] * p) / w, pv = (a[0][1][k] - a[0][1][3] * p) / w;
        out[1][k] = pu;
        out[2][k] = pv;
        if (orders < 2) continue;
        out[3][k] = (a[2][0][k] - N(2) * a[1][0][3] * pu - a[2][0][3] * p) / w;
        out[4][k] = (a[1][1][k] - a[1][0][3] * pv - a[0][1][3] * pu - a[1][1][3] * p) / w;
        out[5][k] = (a[0][2][k] - N(2) * a[0][1][3] * pv - a[0][2][3] * p) / w;
    }
    return out;
}

} // namespace reference

#endif
