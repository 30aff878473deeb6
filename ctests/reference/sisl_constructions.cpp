// Constructions of footpoint beside those of SISL: conic arcs, cylinder, cone, sphere, torus, revolved and translational surfaces, lofted and
// Coons surfaces, interpolation, offsets. Where the parameters are the same, points at equal parameters are compared; else samples
// of each are asked for on the other, with proof. SPDX-License-Identifier: MIT OR Apache-2.0
#include "check.hpp"

#include <footpoint.hpp>

#include <sisl.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>

namespace {

std::mt19937 random_numbers(3);
double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_numbers); }

struct Release {
    void operator()(SISLCurve *c) const { freeCurve(c); }
    void operator()(SISLSurf *s) const { freeSurf(s); }
};
using Curve = std::unique_ptr<SISLCurve, Release>;
using Surface = std::unique_ptr<SISLSurf, Release>;
constexpr double PI = 3.14159265358979323846;

std::vector<double> weights_of(const double *scaled, std::size_t count) {
    std::vector<double> out;
    for (std::size_t i = 0; i < count; i++) out.push_back(scaled[4 * i + 3]);
    return out;
}

footpoint::curve ours_of(const SISLCurve *c) {
    const auto count = std::size_t(c->in), order = std::size_t(c->ik);
    const bool is_rational = c->ikind == 2 || c->ikind == 4;
    return footpoint::curve(order - 1, std::vector<double>(c->et, c->et + count + order), std::vector<double>(c->ecoef, c->ecoef + 3 * count),
                            is_rational ? weights_of(c->rcoef, count) : std::vector<double>());
}

/** u of SISL is v here: its first direction runs fastest. */
footpoint::surface ours_of(const SISLSurf *s) {
    const auto n1 = std::size_t(s->in1), n2 = std::size_t(s->in2), k1 = std::size_t(s->ik1), k2 = std::size_t(s->ik2);
    const bool is_rational = s->ikind == 2 || s->ikind == 4;
    return footpoint::surface(k2 - 1, k1 - 1, std::vector<double>(s->et2, s->et2 + n2 + k2), std::vector<double>(s->et1, s->et1 + n1 + k1),
                              std::vector<double>(s->ecoef, s->ecoef + 3 * n1 * n2), is_rational ? weights_of(s->rcoef, n1 * n2) : std::vector<double>());
}

/** A polynomial spline for SISL, with the poles of ours. */
Curve theirs_of(const footpoint::curve &c) {
    std::vector<double> knots = c.knots(), poles = c.poles();
    return Curve(newCurve(int(c.pole_count()), int(c.degree()) + 1, knots.data(), poles.data(), 1, 3, 1));
}

std::vector<double> samples(const footpoint::curve &c) {
    std::vector<double> out;
    const auto d = c.domain();
    for (int i = 0; i <= 50; i++) {
        const auto p = c.evaluate(i == 50 ? d[1] : d[0] + (d[1] - d[0]) * i / 50);
        out.insert(out.end(), p.begin(), p.end());
    }
    return out;
}
std::vector<double> samples(const footpoint::surface &s) {
    std::vector<double> out;
    const auto d = s.domain();
    for (int i = 0; i <= 16; i++) {
        for (int j = 0; j <= 16; j++) {
            const auto p = s.evaluate(i == 16 ? d[1] : d[0] + (d[1] - d[0]) * i / 16, j == 16 ? d[3] : d[2] + (d[3] - d[2]) * j / 16);
            out.insert(out.end(), p.begin(), p.end());
        }
    }
    return out;
}

template <class Shape>
double greatest(const Shape &shape, const std::vector<double> &points) {
    double most = 0;
    for (const fpt_foot_point &foot : shape.closest(points)) most = std::max(most, foot.distance);
    return most;
}

template <class Shape>
void same_set(const char *about, const Shape &ours, const Shape &theirs, double tolerance) {
    const double there = greatest(theirs, samples(ours)), here = greatest(ours, samples(theirs));
    expect(there <= tolerance && here <= tolerance, about, "the same set", there, here);
}

footpoint::curve wave(std::size_t degree, std::size_t count, double x, double z) {
    std::vector<double> knots(degree + 1, 0.0), poles;
    for (std::size_t i = 1; i + degree < count; i++) knots.push_back(double(i) / double(count - degree));
    knots.insert(knots.end(), degree + 1, 1.0);
    for (std::size_t i = 0; i < count; i++) poles.insert(poles.end(), {x + double(i), 2 + between(0, 2), z + between(-0.4, 0.4)});
    return footpoint::curve(degree, knots, poles);
}

void conics() {
    for (int i = 0; i < 20; i++) {
        double poles[9];
        for (int k = 0; k < 3; k++) poles[3 * k] = 3 * k + between(-1, 1), poles[3 * k + 1] = (k == 1 ? 4 : 0) + between(-1, 1), poles[3 * k + 2] = between(-1, 1);
        const double rho = between(0.15, 0.85);
        SISLCurve *made = nullptr;
        int status = 0;
        s1011(poles, poles + 3, poles + 6, rho, 3, &made, &status);
        const Curve theirs(made);
        expect(status >= 0 && theirs, "conic", "made by SISL", status);
        if (status < 0 || !theirs) continue;
        std::array<double, 9> own;
        std::copy(poles, poles + 9, own.begin());
        same_set("conic", footpoint::conic_arc(own, rho), ours_of(theirs.get()), 1e-12);
    }
}

void quadrics() {
    const double tolerance = 1e-12;
    for (int i = 0; i < 6; i++) {
        double centre[3] = {between(-3, 3), between(-3, 3), between(-3, 3)};
        // X, and Z at right angles to it.
        const double angle = between(0, 6);
        const double x[3] = {std::cos(angle), std::sin(angle), 0}, tilt = between(-1, 1);
        double z[3] = {-std::sin(angle) * std::sin(tilt), std::cos(angle) * std::sin(tilt), std::cos(tilt)};
        const footpoint::axes at = {centre[0], centre[1], centre[2], z[0], z[1], z[2], x[0], x[1], x[2]};
        const double radius = between(1, 3), height = between(1, 4);
        double equator[3] = {radius * x[0], radius * x[1], radius * x[2]}, pole[3] = {radius * z[0], radius * z[1], radius * z[2]};
        const std::array<double, 2> turn = {0, 2 * PI};
        SISLSurf *made = nullptr;
        int status = 0;
        // SISL's ratio is that of the axes of the ellipse: the other one is radius / ratio or times it; a circle is the same for both.
        s1021(centre, equator, 1.0, z, height, &made, &status);
        expect(status >= 0 && made != nullptr, "cylinder", "made by SISL", status);
        if (made != nullptr)
            same_set("cylinder", footpoint::quadric_patch(FPT_PATCH_CYLINDER, at, {radius, radius, 1}, turn, {0, height}), ours_of(Surface(made).get()), tolerance);
        made = nullptr;
        s1023(centre, pole, equator, 2, 4, &made, &status);
        expect(status >= 0 && made != nullptr, "sphere", "made by SISL", status);
        if (made != nullptr)
            same_set("sphere", footpoint::quadric_patch(FPT_PATCH_ELLIPSOID, at, {radius, radius, radius}, turn, {-PI / 2, PI / 2}), ours_of(Surface(made).get()), tolerance);
        made = nullptr;
        const double inner = between(0.2, 0.9) * radius;
        s1024(centre, z, equator, inner, 1, 4, 4, &made, &status);
        expect(status >= 0 && made != nullptr, "torus", "made by SISL", status);
        if (made != nullptr) {
            // Major radius: the length of the equator.
            same_set("torus", footpoint::torus(at, radius, inner, turn, turn), ours_of(Surface(made).get()), tolerance);
        }
    }
}

void moved_curves() {
    for (int i = 0; i < 8; i++) {
        const footpoint::curve a = wave(std::size_t(2 + i % 3), 6, 1, 0), spine = wave(3, 5, -2, 1);
        const Curve c = theirs_of(a), d = theirs_of(spine);
        SISLSurf *made = nullptr;
        int status = 0;
        // The translational surface C(u) + D(v) - D(start).
        const std::vector<double> start = spine.evaluate(0);
        double from[3] = {start[0], start[1], start[2]};
        s1332(c.get(), d.get(), 1e-9, from, &made, &status);
        expect(status >= 0 && made != nullptr, "translational", "made by SISL", status);
        if (made != nullptr) same_set("translational", footpoint::translational(a, spine), ours_of(Surface(made).get()), 1e-12);
        // SISL approximates circles within its tolerance, or writes them exactly.
        made = nullptr;
        double point[3] = {0, 0, 0}, axis[3] = {1, 0, 0.1};
        const double angle = between(0.5, 6), allowed = 1e-6;
        s1302(c.get(), allowed, angle, point, axis, &made, &status);
        expect(status >= 0 && made != nullptr, "revolved", "made by SISL", status);
        if (made != nullptr) same_set("revolved", footpoint::revolved(a, {0, 0, 0}, {1, 0, 0.1}, {0, angle}), ours_of(Surface(made).get()), allowed + 1e-12);
    }
}

void lofts() {
    for (int i = 0; i < 8; i++) {
        // Four sections, a cubic across: one polynomial, whatever the knots are chosen by.
        std::vector<footpoint::curve> sections;
        std::vector<Curve> kept;
        SISLCurve *list[4];
        const footpoint::curve *own[4];
        for (std::size_t k = 0; k < 4; k++) sections.push_back(wave(3, 6, 0, 2.0 * double(k)));
        for (std::size_t k = 0; k < 4; k++) {
            kept.push_back(theirs_of(sections[k]));
            list[k] = kept[k].get();
            own[k] = &sections[k];
        }
        int types[4] = {1, 1, 1, 1}, status = 0;
        SISLSurf *made = nullptr;
        double *parameters = nullptr;
        s1538(4, list, types, 0.0, 1, 4, 0, &made, &parameters, &status);
        expect(status >= 0 && made != nullptr && parameters != nullptr, "lofted", "made by SISL", status);
        if (made != nullptr && parameters != nullptr) {
            const std::vector<double> at(parameters, parameters + 4);
            const footpoint::surface ours = footpoint::skinned(footpoint::span<const footpoint::curve *const>(own, 4), 3, at);
            same_set("lofted", ours, ours_of(Surface(made).get()), 1e-11);
        }
        std::free(parameters);
    }
}

void interpolation() {
    for (int i = 0; i < 20; i++) {
        const int count = 5 + i;
        std::vector<double> points;
        for (int k = 0; k < count; k++) points.insert(points.end(), {k + between(-0.3, 0.3), 3 * std::sin(0.8 * k), between(-1, 1)});
        std::vector<int> kinds(std::size_t(count), 1);
        std::vector<double> at = footpoint::fit_parameters(points);
        // The natural cubic with knots at the parameters is one and only; SISL: curvature zero at both ends.
        SISLCurve *made = nullptr;
        double *used = nullptr;
        int number = 0, status = 0;
        double end = 0;
        s1357(points.data(), count, 3, kinds.data(), at.data(), 1, 1, 1, 4, at[0], &end, &made, &used, &number, &status);
        const Curve theirs(made);
        std::free(used);
        expect(status >= 0 && theirs, "interpolation", "made by SISL", status);
        if (status >= 0 && theirs) {
            footpoint::fit_options options;
            options.condition = FPT_FIT_NATURAL;
            const footpoint::curve ours = footpoint::interpolate(points, at, options), other = ours_of(theirs.get());
            double most = 0;
            for (int k = 0; k <= 100; k++) {
                const double share = k / 100.0, u = other.domain()[0] + (other.domain()[1] - other.domain()[0]) * share;
                const auto p = ours.evaluate(share), q = other.evaluate(std::min(u, other.domain()[1]));
                most = std::max(most, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
            }
            expect(most <= 1e-10, "interpolation", "the natural cubic", most, other.domain()[1]);
        }
        // Both pass through the points for each spacing and degree.
        for (const std::size_t degree : {2u, 3u, 4u, 5u}) {
            if (std::size_t(count) <= degree + 1) continue;
            for (const std::uint32_t spacing : {FPT_SPACING_CHORDAL, FPT_SPACING_CENTRIPETAL, FPT_SPACING_UNIFORM}) {
                footpoint::fit_options options;
                options.degree_u = std::uint32_t(degree);
                options.spacing = spacing;
                const footpoint::curve ours = footpoint::interpolate(points, {}, options);
                expect(greatest(ours, points) <= 1e-11, "interpolation", "through the points", greatest(ours, points));
            }
        }
    }
}

void offsets() {
    for (int i = 0; i < 8; i++) {
        footpoint::curve base = wave(3, 7, 0, 0);
        std::vector<double> knots = base.knots(), poles = base.poles();
        for (std::size_t k = 2; k < poles.size(); k += 3) poles[k] = 0;
        base = footpoint::curve(3, knots, poles);
        const Curve c = theirs_of(base);
        SISLCurve *made = nullptr;
        int status = 0;
        double normal[3] = {0, 0, 1};
        const double distance = 0.2, allowed = 1e-5;
        s1360(c.get(), distance, allowed, normal, 0.0, 3, &made, &status);
        const Curve theirs(made);
        expect(status >= 0 && theirs, "offset curve", "made by SISL", status);
        if (status < 0 || !theirs) continue;
        const auto left = footpoint::fit_offset(base, distance, {0, 0, 1}, 3, 1e-7), right = footpoint::fit_offset(base, -distance, {0, 0, 1}, 3, 1e-7);
        const std::vector<double> there = samples(ours_of(theirs.get()));
        const double off = std::min(greatest(left.shape, there), greatest(right.shape, there));
        // SISL's exceeds its own tolerance, by a factor of 2.4 here.
        expect(off <= 10 * allowed && left.proven <= 2e-7, "offset curve", "SISL's on ours", off, left.proven);
    }
}

} // namespace

int main() {
    conics();
    quadrics();
    moved_curves();
    lofts();
    interpolation();
    offsets();
    return verdict();
}
