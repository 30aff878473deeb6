// N bumps under a plane: exactly N closed loops of radius sqrt(3/4 gap). Ours, GeomAPI_IntSS and s1859 in turns, tolerance 1e-7.
// SPDX-License-Identifier: MIT OR Apache-2.0
//
//   loops [runs]       one line for each N and gap: what each found, and the median of its times
#include <footpoint.hpp>

#ifdef WITH_OCCT
#include <GeomAPI_IntSS.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#endif
#ifdef WITH_SISL
#include <sisl.h>
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace {

constexpr double TOLERANCE = 1e-7;

struct Sheet {
    int count;
    std::vector<double> knots, poles;
};

// Bumps: poles of height 1, five poles apart, among those of height 0; bicubic, unit spans.
Sheet bumps(int n) {
    const int side = int(std::ceil(std::sqrt(double(n)))), count = 5 * side + 4;
    Sheet s{count, {}, {}};
    for (int i = 0; i < count + 4; i++) s.knots.push_back(i - 3.0);
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            const bool on = i % 5 == 4 && j % 5 == 4 && i / 5 < side && j / 5 < side && (i / 5) * side + j / 5 < n;
            s.poles.insert(s.poles.end(), {i - 1.0, j - 1.0, on ? 1.0 : 0.0});
        }
    }
    return s;
}

Sheet lid(int n, double z) {
    const double size = 5 * std::ceil(std::sqrt(double(n))) + 2.5;
    Sheet s{4, {0, 0, 0, 0, 1, 1, 1, 1}, {}};
    for (int k = 0; k < 16; k++) s.poles.insert(s.poles.end(), {-0.5 + size * (k / 4) / 3, -0.5 + size * (k % 4) / 3, z});
    return s;
}

struct Result {
    int loops = 0, others = 0;
    double seconds = 0;
};

template <class Work>
double timed(Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Result ours(const Sheet &a, const Sheet &b) {
    Result out;
    const footpoint::surface p(3, 3, a.knots, a.knots, a.poles), q(3, 3, b.knots, b.knots, b.poles);
    out.seconds = timed([&] {
        const footpoint::surface_intersection found(p, q);
        const auto s = found.summary();
        for (std::size_t i = 0; i < s.branch_count; i++) found.branch(i).is_closed ? out.loops++ : out.others++;
        out.others += int(s.contact_count + s.undecided_count + (s.is_proven ? 0 : 1000));
    });
    return out;
}

#ifdef WITH_OCCT
Handle(Geom_BSplineSurface) shape(const Sheet &s) {
    TColgp_Array2OfPnt poles(1, s.count, 1, s.count);
    for (int i = 0; i < s.count; i++) {
        for (int j = 0; j < s.count; j++) {
            const double *p = s.poles.data() + 3 * (i * s.count + j);
            poles.SetValue(i + 1, j + 1, gp_Pnt(p[0], p[1], p[2]));
        }
    }
    std::vector<double> values;
    std::vector<int> times;
    for (double k : s.knots) {
        if (!values.empty() && values.back() == k) {
            times.back()++;
        } else {
            values.push_back(k);
            times.push_back(1);
        }
    }
    TColStd_Array1OfReal knots(1, int(values.size()));
    TColStd_Array1OfInteger mults(1, int(values.size()));
    for (std::size_t i = 0; i < values.size(); i++) {
        knots.SetValue(int(i) + 1, values[i]);
        mults.SetValue(int(i) + 1, times[i]);
    }
    return new Geom_BSplineSurface(poles, knots, knots, mults, mults, 3, 3);
}

Result occt(const Sheet &a, const Sheet &b) {
    Result out;
    Handle(Geom_BSplineSurface) p = shape(a), q = shape(b);
    // The domain of the unclamped sheet: OpenCASCADE wants clamped ends.
    p->Segment(a.knots[3], a.knots[a.knots.size() - 4], a.knots[3], a.knots[a.knots.size() - 4]);
    out.seconds = timed([&] {
        GeomAPI_IntSS found(p, q, TOLERANCE);
        for (int i = 1; found.IsDone() && i <= found.NbLines(); i++) {
            const Handle(Geom_Curve) &line = found.Line(i);
            const bool closed = line->Value(line->FirstParameter()).Distance(line->Value(line->LastParameter())) < 1e-5;
            closed ? out.loops++ : out.others++;
        }
    });
    return out;
}
#endif

#ifdef WITH_SISL
SISLSurf *sheet(const Sheet &s) {
    std::vector<double> poles;
    for (int j = 0; j < s.count; j++) {
        for (int i = 0; i < s.count; i++) {
            const double *p = s.poles.data() + 3 * (i * s.count + j);
            poles.insert(poles.end(), p, p + 3);
        }
    }
    std::vector<double> u = s.knots, v = s.knots;
    return newSurf(s.count, s.count, 4, 4, u.data(), v.data(), poles.data(), 1, 3, 1);
}

Result sisl(const Sheet &a, const Sheet &b) {
    Result out;
    SISLSurf *p = sheet(a), *q = sheet(b);
    double *first = nullptr, *second = nullptr;
    SISLIntcurve **curves = nullptr;
    int points = 0, count = 0, status = 0;
    out.seconds = timed([&] { s1859(p, q, TOLERANCE, TOLERANCE, &points, &first, &second, &count, &curves, &status); });
    out.loops = count;
    out.others = points;
    if (curves) freeIntcrvlist(curves, count);
    std::free(first);
    std::free(second);
    freeSurf(p);
    freeSurf(q);
    return out;
}
#endif

double median(std::vector<double> x) {
    std::sort(x.begin(), x.end());
    return x[x.size() / 2];
}

} // namespace

int main(int argc, char **argv) {
    const int runs = argc > 1 ? std::atoi(argv[1]) : 3;
    using Method = std::function<Result(const Sheet &, const Sheet &)>;
    std::vector<std::pair<std::string, Method>> methods{{"footpoint", ours}};
#ifdef WITH_OCCT
    methods.emplace_back("GeomAPI_IntSS", occt);
#endif
#ifdef WITH_SISL
    methods.emplace_back("s1859", sisl);
#endif
    for (int n : {1, 16, 100}) {
        for (double gap : {1e-2, 1e-4, 1e-6, 1e-8}) {
            const Sheet a = bumps(n), b = lid(n, 4.0 / 9.0 - gap);
            std::vector<std::vector<double>> times(methods.size());
            std::vector<Result> last(methods.size());
            for (int run = 0; run < (n == 100 ? 1 : runs); run++) {
                for (std::size_t k = 0; k < methods.size(); k++) {
                    last[k] = methods[k].second(a, b);
                    times[k].push_back(last[k].seconds);
                }
            }
            std::printf("%3d bumps, gap %.0e", n, gap);
            for (std::size_t k = 0; k < methods.size(); k++) {
                std::printf("   %s: %d loops + %d, %.4f s", methods[k].first.c_str(), last[k].loops, last[k].others, median(times[k]));
            }
            std::printf("\n");
            std::fflush(stdout);
        }
    }
}
