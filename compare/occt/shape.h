// A case as the library has it, and what the comparison computes with: points, one-sided derivatives, stationarity.
// Curves are treated as surfaces without v. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef COMPARE_SHAPE_H
#define COMPARE_SHAPE_H

#include "geometry.h"

#include <footpoint.h>

#include <array>
#include <string>
#include <vector>

// Value and derivatives, with the residual to a point.
struct Jet {
    Vec point;
    Vec first[2];
    Vec second[3];
};

// How a place fares as a stationary point.
struct Stationarity {
    // Greatest slope that the distance has through the place in a direction, as a cosine; 0 at a turn of sign.
    double slope;
    // On an open end of the domain in u, in v.
    bool border[2];
};

class Shape {
public:
    explicit Shape(const Geometry &geometry);
    ~Shape();
    Shape(const Shape &) = delete;
    Shape &operator=(const Shape &) = delete;

    bool is_curve() const { return curve_ != nullptr; }
    int dimensions() const { return is_curve() ? 1 : 2; }
    const fpt_curve *curve() const { return curve_; }
    const fpt_surface *surface() const { return surface_; }
    double low(int k) const { return domain_[2 * k]; }
    double high(int k) const { return domain_[2 * k + 1]; }
    double width(int k) const { return is_curve() && k == 1 ? 1.0 : high(k) - low(k); }
    bool closed(int k) const { return closed_[k]; }
    bool collapsed(int side) const { return collapsed_[side]; }
    double diagonal() const { return diagonal_; }

    // Derivatives from the given sides (-1: from below, 1: from above), up to `order`.
    Jet jet(Pair at, int order, const std::array<int, 2> &sides = {1, 1}) const;
    double distance(Pair at, const Vec &query) const;
    // Lengths that the rounding of points and query can make.
    double floor(const Vec &query) const;
    // Difference of two parameters as a share of the domain, around the seam too.
    double apart(int k, double a, double b) const;
    double apart(const Pair &a, const Pair &b) const;
    Stationarity stationarity(const Pair &at, const Vec &query) const;
    // Newton's method from `at` inside its smooth piece, at most `reach` of the domain away; parameter `held` stays.
    bool refine(Pair &at, const Vec &query, double reach, int held = -1) const;
    // Moves a parameter that is next to a knot where the shape is only continuous onto it.
    Pair snapped(Pair at) const;
    // Ends of the pieces and of the domain.
    const std::vector<double> &breaks(int k) const { return breaks_[k]; }
    // Whether the distance bends or slopes towards `way` at first: +1 away from the query, -1 to it, 0 not clear.
    int trend(const Pair &at, const Pair &way, const Vec &query) const;
    std::string flat_text(const Pair &at, const Vec &query) const;

private:
    double slope_across(int k, const Pair &at, const Vec &query, bool &border) const;
    double directed(int k, const Pair &at, const std::array<int, 2> &sides, const Vec &query) const;
    bool step(const Pair &at, const Vec &query, const std::array<int, 2> &sides, int held, Pair &out) const;

    fpt_curve *curve_ = nullptr;
    fpt_surface *surface_ = nullptr;
    double domain_[4] = {0, 0, 0, 0};
    bool closed_[2] = {false, false};
    bool collapsed_[4] = {false, false, false, false};
    // Ends of the pieces that are at least once differentiable.
    std::vector<double> breaks_[2];
    double diagonal_ = 0;
    double largest_ = 0;
};

#endif
