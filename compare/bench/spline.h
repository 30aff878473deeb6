// A textbook evaluator of NURBS, for the mesh and for Newton's method on it: The NURBS Book, A2.2, A2.3, A3.6, A4.4.
// SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef BENCH_SPLINE_H
#define BENCH_SPLINE_H

#include "geometry.h"

// S; Su, Sv; Suu, Suv, Svv. Of a curve 0, 1 and 3.
using Derivatives = std::array<Vec, 6>;

class Spline {
public:
    // Degrees up to 31.
    explicit Spline(const Geometry &geometry);

    bool is_curve() const { return geometry_.is_curve; }
    double low(int k) const { return k < geometry_.dimensions() ? geometry_.low(k) : 0.0; }
    double high(int k) const { return k < geometry_.dimensions() ? geometry_.high(k) : 0.0; }
    bool closed(int k) const { return closed_[k]; }
    double diagonal() const { return diagonal_; }
    const Geometry &geometry() const { return geometry_; }

    Vec point(const Pair &at) const { return derivatives(at, 0)[0]; }
    // Up to `order` 2.
    Derivatives derivatives(const Pair &at, int order) const;

private:
    using Basis = std::array<std::array<double, 32>, 3>;
    size_t basis(int k, double t, int order, Basis &out) const;

    Geometry geometry_;
    // Multiplied by the weight, which is the fourth.
    std::vector<std::array<double, 4>> poles_;
    bool closed_[2] = {false, false};
    double diagonal_ = 0;
};

#endif
