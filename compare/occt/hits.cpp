// Compares hits of curves with curves, planes and surfaces, and of lines with surfaces, with OpenCASCADE and SISL.
//
//   compare_hits [PAIRS] [SEED]
//
// Random cubic curves and bicubic surfaces of several spans. Each place that the others find and that is one (both shapes within
// 1e-6 of each other there) must be one of ours, within 1e-4; the table counts hits, places that we miss and places that they miss,
// and the medians of the times, taken in turns.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include <footpoint.hpp>

#include <Geom2dAPI_InterCurveCurve.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <GeomAPI_ExtremaCurveCurve.hxx>
#include <GeomAPI_IntCS.hxx>
#include <GeomAPI_IntSS.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#ifdef WITH_SISL
#include <sisl.h>
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

using Point = std::array<double, 3>;
constexpr int POLES = 7;
constexpr double NEAR = 1e-4;

std::mt19937_64 generator(1);

double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); }

std::vector<double> knots() { return {0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1}; }

struct Curve {
    std::vector<double> poles;
    footpoint::curve ours;
    Handle(Geom_BSplineCurve) occt;

    explicit Curve(std::vector<double> given)
        : poles(std::move(given)), ours(3, knots(), poles), occt(made(poles)) {}

    static Handle(Geom_BSplineCurve) made(const std::vector<double> &p) {
        TColgp_Array1OfPnt points(1, POLES);
        for (int i = 0; i < POLES; i++) points(i + 1) = gp_Pnt(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
        TColStd_Array1OfReal values(1, 5);
        TColStd_Array1OfInteger times(1, 5);
        for (int k = 0; k < 5; k++) {
            values(k + 1) = 0.25 * k;
            times(k + 1) = k == 0 || k == 4 ? 4 : 1;
        }
        return new Geom_BSplineCurve(points, values, times, 3);
    }
};

Curve wave(bool flat) {
    std::vector<double> p;
    for (int i = 0; i < POLES; i++)
        p.insert(p.end(), {between(-1, 1), between(-1, 1), flat ? 0 : between(-1, 1)});
    return Curve(p);
}

struct Surface {
    std::vector<double> poles;
    footpoint::surface ours;
    Handle(Geom_BSplineSurface) occt;

    explicit Surface(std::vector<double> given)
        : poles(std::move(given)), ours(3, 3, knots(), knots(), poles), occt(made(poles)) {}

    static Handle(Geom_BSplineSurface) made(const std::vector<double> &p) {
        TColgp_Array2OfPnt points(1, POLES, 1, POLES);
        for (int i = 0; i < POLES; i++)
            for (int j = 0; j < POLES; j++) {
                const double *x = p.data() + 3 * (i * POLES + j);
                points(i + 1, j + 1) = gp_Pnt(x[0], x[1], x[2]);
            }
        TColStd_Array1OfReal values(1, 5);
        TColStd_Array1OfInteger times(1, 5);
        for (int k = 0; k < 5; k++) {
            values(k + 1) = 0.25 * k;
            times(k + 1) = k == 0 || k == 4 ? 4 : 1;
        }
        return new Geom_BSplineSurface(points, values, values, times, times, 3, 3);
    }
};

Surface sheet() {
    std::vector<double> p;
    for (int i = 0; i < POLES; i++)
        for (int j = 0; j < POLES; j++)
            p.insert(p.end(), {i / 3.0 - 1 + between(-0.1, 0.1), j / 3.0 - 1 + between(-0.1, 0.1), between(-0.6, 0.6)});
    return Surface(p);
}

double median(std::vector<double> list) {
    if (list.empty()) return 0;
    std::nth_element(list.begin(), list.begin() + list.size() / 2, list.end());
    return list[list.size() / 2];
}

struct Table {
    Table(const char *what, const char *who) : name(what), peer(who) {}

    const char *name;
    const char *peer;
    size_t ours = 0, theirs = 0, missed = 0, more = 0;
    std::vector<double> our_times, their_times;

    void compare(const std::vector<Point> &mine, const std::vector<Point> &others) {
        ours += mine.size();
        theirs += others.size();
        const auto has = [](const std::vector<Point> &list, const Point &x) {
            return std::any_of(list.begin(), list.end(), [&](const Point &y) {
                return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]) < NEAR;
            });
        };
        for (const Point &x : others) missed += !has(mine, x);
        for (const Point &x : mine) more += !has(others, x);
    }
    void print() const {
        std::printf("%-26s %-28s ours %6zu theirs %6zu missed by us %zu by them %zu  median %8.1f us, %8.1f us\n", name, peer, ours,
                    theirs, missed, more, 1e6 * median(our_times), 1e6 * median(their_times));
    }
};

template <class Call> auto timed(std::vector<double> &times, Call call) {
    const auto begin = std::chrono::steady_clock::now();
    auto out = call();
    times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    return out;
}

std::vector<Point> points(const footpoint::curve_hits &found) {
    std::vector<Point> out;
    for (const fpt_curve_hit &hit : found.hits) out.push_back({hit.point[0], hit.point[1], hit.point[2]});
    if (!found.undecided.empty()) std::printf("undecided: %zu\n", found.undecided.size());
    return out;
}

Point of(const gp_Pnt &p) { return {p.X(), p.Y(), p.Z()}; }

} // namespace

int main(int argc, char **argv) {
    const int pairs = argc > 1 ? std::atoi(argv[1]) : 200;
    generator.seed(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
    Table plane_curves{"curve-curve, plane", "Geom2dAPI_InterCurveCurve"}, space{"curve-curve, space", "GeomAPI_ExtremaCurveCurve"},
        surfaces{"curve-surface", "GeomAPI_IntCS"}, lines{"line-surface", "GeomAPI_IntCS"};
#ifdef WITH_SISL
    Table sisl_curves{"curve-curve, plane", "SISL s1857"}, sisl_surfaces{"curve-surface", "SISL s1858"};
#endif
    for (int pair = 0; pair < pairs; pair++) {
        const Curve a = wave(true), b = wave(true);
        const auto mine = points(timed(plane_curves.our_times, [&] { return footpoint::intersect(a.ours, b.ours); }));
        const auto flat = [](const Curve &c) {
            TColgp_Array1OfPnt2d points(1, POLES);
            for (int i = 0; i < POLES; i++) points(i + 1) = gp_Pnt2d(c.poles[3 * i], c.poles[3 * i + 1]);
            TColStd_Array1OfReal values(1, 5);
            TColStd_Array1OfInteger times(1, 5);
            c.occt->Knots(values);
            c.occt->Multiplicities(times);
            return Handle(Geom2d_BSplineCurve)(new Geom2d_BSplineCurve(points, values, times, 3));
        };
        const auto c = flat(a), d = flat(b);
        plane_curves.compare(mine, timed(plane_curves.their_times, [&] {
            Geom2dAPI_InterCurveCurve inter(c, d, 1e-7);
            std::vector<Point> out;
            for (int k = 1; k <= inter.NbPoints(); k++) out.push_back({inter.Point(k).X(), inter.Point(k).Y(), 0});
            return out;
        }));
#ifdef WITH_SISL
        const auto as_sisl = [](const Curve &x) {
            std::vector<double> k = knots();
            return newCurve(POLES, 4, k.data(), const_cast<double *>(x.poles.data()), 1, 3, 1);
        };
        SISLCurve *p = as_sisl(a), *q = as_sisl(b);
        sisl_curves.our_times = plane_curves.our_times;
        sisl_curves.compare(mine, timed(sisl_curves.their_times, [&] {
            int count = 0, curves = 0, status = 0;
            double *first = nullptr, *second = nullptr;
            SISLIntcurve **list = nullptr;
            s1857(p, q, 1e-15, 1e-8, &count, &first, &second, &curves, &list, &status);
            std::vector<Point> out;
            for (int k = 0; k < count; k++) {
                const auto at = a.ours.evaluate(first[k]);
                out.push_back({at[0], at[1], at[2]});
            }
            std::free(first);
            std::free(second);
            if (list) freeIntcrvlist(list, curves);
            return out;
        }));
        freeCurve(p);
        freeCurve(q);
#endif
        // In space two curves meet where they are made to: the second one passes through a point of the first.
        Curve e = wave(false);
        std::vector<double> moved = wave(false).poles;
        const auto from = Curve(moved).ours.evaluate(between(0.1, 0.9)), to = e.ours.evaluate(between(0.1, 0.9));
        for (int i = 0; i < 3 * POLES; i++) moved[i] += to[i % 3] - from[i % 3];
        const Curve f(moved);
        const auto in_space = points(timed(space.our_times, [&] { return footpoint::intersect(e.ours, f.ours); }));
        space.compare(in_space, timed(space.their_times, [&] {
            GeomAPI_ExtremaCurveCurve extrema(e.occt, f.occt);
            std::vector<Point> out;
            for (int k = 1; k <= extrema.NbExtrema(); k++) {
                gp_Pnt x, y;
                extrema.Points(k, x, y);
                if (x.Distance(y) < 1e-7) out.push_back(of(x));
            }
            return out;
        }));
        const Surface s = sheet();
        const Curve g = wave(false);
        const auto on_sheet = points(timed(surfaces.our_times, [&] { return footpoint::intersect(s.ours, g.ours); }));
        surfaces.compare(on_sheet, timed(surfaces.their_times, [&] {
            GeomAPI_IntCS inter(g.occt, s.occt);
            std::vector<Point> out;
            for (int k = 1; k <= inter.NbPoints(); k++) out.push_back(of(inter.Point(k)));
            return out;
        }));
#ifdef WITH_SISL
        SISLCurve *line = as_sisl(g);
        std::vector<double> k = knots(), net(3 * POLES * POLES);
        for (int i = 0; i < POLES; i++)
            for (int j = 0; j < POLES; j++)
                for (int x = 0; x < 3; x++) net[3 * (j * POLES + i) + x] = s.poles[3 * (i * POLES + j) + x];
        SISLSurf *face = newSurf(POLES, POLES, 4, 4, k.data(), k.data(), net.data(), 1, 3, 1);
        sisl_surfaces.our_times = surfaces.our_times;
        sisl_surfaces.compare(on_sheet, timed(sisl_surfaces.their_times, [&] {
            int count = 0, curves = 0, status = 0;
            double *first = nullptr, *second = nullptr;
            SISLIntcurve **list = nullptr;
            s1858(face, line, 1e-15, 1e-8, &count, &first, &second, &curves, &list, &status);
            std::vector<Point> out;
            for (int n = 0; n < count; n++) {
                const auto at = g.ours.evaluate(second[n]);
                out.push_back({at[0], at[1], at[2]});
            }
            std::free(first);
            std::free(second);
            if (list) freeIntcrvlist(list, curves);
            return out;
        }));
        freeCurve(line);
        freeSurf(face);
#endif
        const footpoint::caster caster(s.ours);
        const double o[3] = {between(-1, 1), between(-1, 1), 3}, w[3] = {between(-0.5, 0.5), between(-0.5, 0.5), -1};
        const auto rays = timed(lines.our_times, [&] {
            return caster.all(footpoint::span<const double>(o, 3), footpoint::span<const double>(w, 3), footpoint::whole_line);
        });
        std::vector<Point> hits;
        for (const fpt_ray_hit &hit : rays[0]) hits.push_back({hit.point[0], hit.point[1], hit.point[2]});
        lines.compare(hits, timed(lines.their_times, [&] {
            GeomAPI_IntCS inter(new Geom_Line(gp_Pnt(o[0], o[1], o[2]), gp_Dir(w[0], w[1], w[2])), s.occt);
            std::vector<Point> out;
            for (int n = 1; n <= inter.NbPoints(); n++) out.push_back(of(inter.Point(n)));
            return out;
        }));
    }
    size_t missed = 0;
    std::vector<const Table *> all = {&plane_curves, &space, &surfaces, &lines};
#ifdef WITH_SISL
    all.insert(all.end(), {&sisl_curves, &sisl_surfaces});
#endif
    for (const Table *table : all) {
        table->print();
        missed += table->missed;
    }
    return missed > 0;
}
