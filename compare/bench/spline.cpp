// SPDX-License-Identifier: MIT OR Apache-2.0
#include "spline.h"

#include <algorithm>

namespace {

// Derivatives of the functions of degree q from those of the degree below: q * (N[r-1] / length - N[r] / next length).
void lift(const std::vector<double> &knots, int span, int q, const double *below, double *derivative) {
    double from_left = 0.0;
    for (int r = 0; r <= q; r++) {
        const size_t first = size_t(span - q + r + 1);
        const double next = r < q ? q * below[r] / (knots[first + size_t(q)] - knots[first]) : 0.0;
        derivative[r] = from_left - next;
        from_left = next;
    }
}

// Numbers of derivatives up to an order.
constexpr int COUNT[3] = {1, 3, 6};

// Places from homogeneous ones, in the order of Derivatives.
Derivatives projected(const double a[6][4], int order) {
    Derivatives s{};
    const double w = a[0][3];
    for (size_t c = 0; c < 3; c++) {
        s[0][c] = a[0][c] / w;
        if (order >= 1) {
            s[1][c] = (a[1][c] - a[1][3] * s[0][c]) / w;
            s[2][c] = (a[2][c] - a[2][3] * s[0][c]) / w;
        }
        if (order >= 2) {
            s[3][c] = (a[3][c] - 2 * a[1][3] * s[1][c] - a[3][3] * s[0][c]) / w;
            s[4][c] = (a[4][c] - a[1][3] * s[2][c] - a[2][3] * s[1][c] - a[4][3] * s[0][c]) / w;
            s[5][c] = (a[5][c] - 2 * a[2][3] * s[2][c] - a[5][3] * s[0][c]) / w;
        }
    }
    return s;
}

} // namespace

Spline::Spline(const Geometry &geometry) : geometry_(geometry) {
    Vec least = {1e300, 1e300, 1e300}, most = {-1e300, -1e300, -1e300};
    for (size_t i = 0; i < geometry.weights.size(); i++) {
        const double *p = &geometry.poles[3 * i], w = geometry.rational ? geometry.weights[i] : 1.0;
        poles_.push_back({p[0] * w, p[1] * w, p[2] * w, w});
        for (size_t k = 0; k < 3; k++) {
            least[k] = std::min(least[k], p[k]);
            most[k] = std::max(most[k], p[k]);
        }
    }
    diagonal_ = norm(minus(most, least));
    for (int k = 0; k < geometry.dimensions(); k++) {
        double apart = 0;
        for (int i = 0; i <= 16; i++) {
            const double other = geometry.is_curve ? 0.0 : low(1 - k) + (high(1 - k) - low(1 - k)) * i / 16.0;
            const Pair start = k == 0 ? Pair{low(0), other} : Pair{other, low(1)};
            const Pair end = k == 0 ? Pair{high(0), other} : Pair{other, high(1)};
            apart = std::max(apart, norm(minus(point(start), point(end))));
        }
        closed_[k] = apart <= 1e-9 * diagonal_;
    }
}

// Values and derivatives of the functions that count at t; the number of the first one is returned.
size_t Spline::basis(int k, double t, int order, Basis &out) const {
    const std::vector<double> &knots = geometry_.knots[k];
    const int p = geometry_.degree[k], n = geometry_.count[k];
    const auto above = std::upper_bound(knots.begin() + p + 1, knots.begin() + n, t);
    const int span = int(above - knots.begin()) - 1;
    double left[32], right[32];
    // Rows of lower degree: `one` of p - 1, `two` of p - 2.
    double row[32] = {1.0}, one[32] = {0}, two[32] = {0};
    for (int j = 1; j <= p; j++) {
        std::copy(one, one + j, two);
        std::copy(row, row + j, one);
        left[j] = t - knots[size_t(span + 1 - j)];
        right[j] = knots[size_t(span + j)] - t;
        double saved = 0.0;
        for (int r = 0; r < j; r++) {
            const double part = row[r] / (right[r + 1] + left[j - r]);
            row[r] = saved + right[r + 1] * part;
            saved = left[j - r] * part;
        }
        row[j] = saved;
    }
    std::copy(row, row + p + 1, out[0].begin());
    if (order >= 1) {
        lift(knots, span, p, one, out[1].data());
    }
    if (order >= 2) {
        double slope[32] = {0};
        if (p >= 2) {
            lift(knots, span, p - 1, two, slope);
        }
        lift(knots, span, p, slope, out[2].data());
    }
    return size_t(span - p);
}

Derivatives Spline::derivatives(const Pair &at, int order) const {
    Basis bu, bv;
    const size_t columns = size_t(geometry_.count[1]);
    const size_t i0 = basis(0, at[0], order, bu);
    size_t j0 = 0, q = 0;
    if (is_curve()) {
        bv = {{{1.0}, {0.0}, {0.0}}};
    } else {
        j0 = basis(1, at[1], order, bv);
        q = size_t(geometry_.degree[1]);
    }
    // In the order of Derivatives: which derivative in u and in v.
    constexpr int DU[6] = {0, 1, 0, 2, 1, 0}, DV[6] = {0, 0, 1, 0, 1, 2};
    double a[6][4] = {{0}};
    for (size_t i = 0; i <= size_t(geometry_.degree[0]); i++) {
        double part[3][4] = {{0}};
        for (size_t j = 0; j <= q; j++) {
            const auto &pole = poles_[(i0 + i) * columns + j0 + j];
            for (int d = 0; d <= order; d++) {
                for (int c = 0; c < 4; c++) {
                    part[d][c] += bv[size_t(d)][j] * pole[size_t(c)];
                }
            }
        }
        for (int d = 0; d < COUNT[order]; d++) {
            for (int c = 0; c < 4; c++) {
                a[d][c] += bu[size_t(DU[d])][i] * part[DV[d]][c];
            }
        }
    }
    return projected(a, order);
}
