// Surfaces near grids of points: footpoint beside GeomAPI_PointsToBSplineSurface, in turns in one run.
//
//   compare_fit [points along a side] [repetitions]
//
// Every result, ours and OpenCASCADE's, is measured in the same way: by the certified distance of every point from it. A line is a data set
// and a tolerance: medians of the times, poles, and the greatest distance of a point. Times are those of the processor, all threads together,
// so that other programs on the machine do not count: ours runs on all cores, OpenCASCADE on one. "Scattered" are the same points
// in a random order, with their parameters, fitted at their feet and certified.
#include <footpoint.hpp>

#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

namespace {

using Function = std::function<std::array<double, 3>(double, double)>;

struct DataSet {
    const char *name;
    Function at;
};

struct Result {
    double seconds = 0, worst = NAN;
    std::size_t poles = 0;
};

double now() { return double(std::clock()) / CLOCKS_PER_SEC; }

// Multiplicities written out.
std::vector<double> flat(const TColStd_Array1OfReal &knots, const TColStd_Array1OfInteger &times) {
    std::vector<double> out;
    for (int i = knots.Lower(); i <= knots.Upper(); i++) out.insert(out.end(), static_cast<std::size_t>(times(i)), knots(i));
    return out;
}

footpoint::surface taken_over(const Geom_BSplineSurface &s) {
    std::vector<double> poles;
    for (int i = 1; i <= s.NbUPoles(); i++) {
        for (int j = 1; j <= s.NbVPoles(); j++) {
            const gp_Pnt p = s.Pole(i, j);
            poles.insert(poles.end(), {p.X(), p.Y(), p.Z()});
        }
    }
    return footpoint::surface(static_cast<std::size_t>(s.UDegree()), static_cast<std::size_t>(s.VDegree()),
                              flat(s.UKnots(), s.UMultiplicities()), flat(s.VKnots(), s.VMultiplicities()), poles);
}

double worst(const footpoint::surface &surface, const std::vector<double> &points) {
    double most = 0;
    for (const fpt_foot_point &foot : surface.closest(points)) most = std::max(most, foot.distance);
    return most;
}

double median(std::vector<double> times) {
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

Result ours(const std::vector<double> &points, std::size_t side, double tolerance, bool certify) {
    footpoint::fit_options options(tolerance);
    options.certify = certify;
    Result result;
    const double start = now();
    const auto fit = footpoint::fit_grid(points, side, options);
    result.seconds = now() - start;
    result.poles = fit.shape.pole_count_u() * fit.shape.pole_count_v();
    result.worst = worst(fit.shape, points);
    return result;
}

/** Points in a random order. */
Result scattered(const std::vector<double> &points, std::size_t side, double tolerance) {
    std::vector<std::size_t> order(side * side);
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    std::vector<double> list, at;
    for (const std::size_t k : order) {
        list.insert(list.end(), {points[3 * k], points[3 * k + 1], points[3 * k + 2]});
        at.insert(at.end(), {double(k / side) / double(side - 1), double(k % side) / double(side - 1)});
    }
    Result result;
    const double start = now();
    const auto fit = footpoint::fit_surface(list, footpoint::fit_options(tolerance), at);
    result.seconds = now() - start;
    result.poles = fit.shape.pole_count_u() * fit.shape.pole_count_v();
    result.worst = fit.result.worst;
    return result;
}

Result theirs(const TColgp_Array2OfPnt &points, const std::vector<double> &list, double tolerance) {
    Result result;
    const double start = now();
    try {
        const GeomAPI_PointsToBSplineSurface fit(points, 3, 3, GeomAbs_C2, tolerance);
        result.seconds = now() - start;
        if (!fit.IsDone()) return result;
        const footpoint::surface surface = taken_over(*fit.Surface());
        result.poles = surface.pole_count_u() * surface.pole_count_v();
        result.worst = worst(surface, list);
    } catch (const Standard_Failure &failure) {
        result.seconds = now() - start;
        std::printf("  OpenCASCADE failed: %s\n", failure.GetMessageString());
    }
    return result;
}

} // namespace

int main(int count, char **arguments) {
    const int side = count > 1 ? std::atoi(arguments[1]) : 317;
    const int repetitions = count > 2 ? std::atoi(arguments[2]) : 3;
    const DataSet sets[] = {
        {"wave", [](double u, double v) { return std::array<double, 3>{100 * u, 80 * v, 6 * std::sin(7 * u) * std::cos(5 * v)}; }},
        {"ripples", [](double u, double v) {
             return std::array<double, 3>{100 * u, 80 * v, 6 * std::sin(7 * u) * std::cos(5 * v) + 3 * std::sin(15 * u * v)};
         }},
        {"half torus", [](double u, double v) {
             const double a = 3.1 * u, b = 3.1 * v, r = 30 + 10 * std::cos(b);
             return std::array<double, 3>{r * std::cos(a), r * std::sin(a), 10 * std::sin(b)};
         }},
    };
    std::printf("%d points; processor seconds, medians of %d, in turns\n", side * side, repetitions);
    std::printf("%-11s %9s | %9s %9s %6s %10s | %9s %6s %10s | %9s %6s %10s\n", "data", "tolerance", "ours s", "certified", "poles", "worst",
                "OCCT s", "poles", "worst", "scattered", "poles", "worst");
    for (const DataSet &set : sets) {
        std::vector<double> list;
        TColgp_Array2OfPnt points(1, side, 1, side);
        for (int i = 0; i < side; i++) {
            for (int j = 0; j < side; j++) {
                const auto p = set.at(double(i) / (side - 1), double(j) / (side - 1));
                list.insert(list.end(), p.begin(), p.end());
                points.SetValue(i + 1, j + 1, gp_Pnt(p[0], p[1], p[2]));
            }
        }
        for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
            std::vector<double> times[4];
            Result a, b, c;
            for (int k = 0; k < repetitions; k++) {
                a = ours(list, static_cast<std::size_t>(side), tolerance, false);
                times[0].push_back(a.seconds);
                times[1].push_back(ours(list, static_cast<std::size_t>(side), tolerance, true).seconds);
                b = theirs(points, list, tolerance);
                times[2].push_back(b.seconds);
                c = scattered(list, static_cast<std::size_t>(side), tolerance);
                times[3].push_back(c.seconds);
            }
            std::printf("%-11s %9.0e | %9.3f %9.3f %6zu %10.2e | %9.3f %6zu %10.2e | %9.3f %6zu %10.2e\n", set.name, tolerance, median(times[0]),
                        median(times[1]), a.poles, a.worst, median(times[2]), b.poles, b.worst, median(times[3]), c.poles, c.worst);
            std::fflush(stdout);
        }
    }
    return 0;
}
