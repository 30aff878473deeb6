// Pairs of surfaces, intersected by us, GeomAPI_IntSS and s1859 in turns, tolerance 1e-7: loops, other findings, median time on the
// processor. Each method runs in a child process with a limit of time.
// SPDX-License-Identifier: MIT OR Apache-2.0
//
//   pairs [runs]       a table in Markdown, and the medians of the ratios of times
#include "shapes.h"

#ifdef WITH_OCCT
#include <GeomAPI_IntSS.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#endif
#ifdef WITH_SISL
#include <sisl.h>
#endif
#include <footpoint.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sys/wait.h>
#include <ctime>
#include <unistd.h>
#include <utility>

namespace {

constexpr double TOLERANCE = 1e-7;
constexpr unsigned LIMIT = 120; // seconds

struct Result {
    int loops = 0, others = 0, proven = 0;
    double seconds = -1;
};

double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

template <class Work>
double timed(Work work) {
    const double start = now();
    work();
    return now() - start;
}

footpoint::surface ours_of(const Net &s) {
    if (s.weights.empty()) return footpoint::surface(s.p, s.q, s.u, s.v, s.poles);
    return footpoint::surface(s.p, s.q, s.u, s.v, s.poles, s.weights);
}

Result ours(const Net &a, const Net &b) {
    Result out;
    const footpoint::surface p = ours_of(a), q = ours_of(b);
    out.seconds = timed([&] {
        const footpoint::surface_intersection found(p, q);
        const auto s = found.summary();
        for (std::size_t i = 0; i < s.branch_count; i++) found.branch(i).is_closed ? out.loops++ : out.others++;
        out.others += int(s.contact_count + s.undecided_count);
        out.proven = int(s.is_proven);
    });
    return out;
}

#ifdef WITH_OCCT
void split(const std::vector<double> &knots, std::vector<double> &values, std::vector<int> &times) {
    for (double k : knots) {
        if (!values.empty() && values.back() == k) {
            times.back()++;
        } else {
            values.push_back(k);
            times.push_back(1);
        }
    }
}

Handle(Geom_BSplineSurface) occt_of(const Net &s) {
    TColgp_Array2OfPnt poles(1, s.nu, 1, s.nv);
    TColStd_Array2OfReal weights(1, s.nu, 1, s.nv);
    for (int i = 0; i < s.nu; i++) {
        for (int j = 0; j < s.nv; j++) {
            const double *p = s.poles.data() + 3 * (i * s.nv + j);
            poles.SetValue(i + 1, j + 1, gp_Pnt(p[0], p[1], p[2]));
            weights.SetValue(i + 1, j + 1, s.weights.empty() ? 1 : s.weights[i * s.nv + j]);
        }
    }
    std::vector<double> values[2];
    std::vector<int> times[2];
    split(s.u, values[0], times[0]);
    split(s.v, values[1], times[1]);
    const TColStd_Array1OfReal u(values[0][0], 1, int(values[0].size())), v(values[1][0], 1, int(values[1].size()));
    const TColStd_Array1OfInteger m(times[0][0], 1, int(times[0].size())), n(times[1][0], 1, int(times[1].size()));
    Handle(Geom_BSplineSurface) made = new Geom_BSplineSurface(poles, weights, u, v, m, n, s.p, s.q);
    // OpenCASCADE wants clamped ends.
    if (times[0][0] <= s.p) made->Segment(s.u[s.p], s.u[s.u.size() - s.p - 1], s.v[s.q], s.v[s.v.size() - s.q - 1]);
    return made;
}

Result occt(const Net &a, const Net &b) {
    Result out;
    const Handle(Geom_BSplineSurface) p = occt_of(a), q = occt_of(b);
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
SISLSurf *sisl_of(const Net &s) {
    std::vector<double> poles;
    const bool rational = !s.weights.empty();
    for (int j = 0; j < s.nv; j++) {
        for (int i = 0; i < s.nu; i++) {
            const int k = i * s.nv + j;
            const double w = rational ? s.weights[k] : 1;
            for (int c = 0; c < 3; c++) poles.push_back(w * s.poles[3 * k + c]);
            if (rational) poles.push_back(w);
        }
    }
    std::vector<double> u = s.u, v = s.v;
    return newSurf(s.nu, s.nv, s.p + 1, s.q + 1, u.data(), v.data(), poles.data(), rational ? 2 : 1, 3, 1);
}

Result sisl(const Net &a, const Net &b) {
    Result out;
    SISLSurf *p = sisl_of(a), *q = sisl_of(b);
    double *first = nullptr, *second = nullptr;
    SISLIntcurve **curves = nullptr;
    int points = 0, count = 0, status = 0;
    out.seconds = timed([&] { s1859(p, q, TOLERANCE, TOLERANCE, &points, &first, &second, &count, &curves, &status); });
    // What comes back in pieces is a loop for us where its ends meet.
    for (int i = 0; i < count; i++) {
        const SISLIntcurve *c = curves[i];
        const int n = c->ipoint;
        bool closed = n > 2;
        for (int k = 0; closed && k < 2; k++) closed = std::abs(c->epar1[k] - c->epar1[2 * (n - 1) + k]) < 1e-6;
        closed ? out.loops++ : out.others++;
    }
    out.others += points;
    if (curves) freeIntcrvlist(curves, count);
    std::free(first);
    std::free(second);
    freeSurf(p);
    freeSurf(q);
    return out;
}
#endif

using Method = Result (*)(const Net &, const Net &);

// In a child process: a crash or a hang is a result without time.
Result watched(Method method, const Net &a, const Net &b) {
    int ends[2];
    Result out;
    if (pipe(ends)) return out;
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        alarm(LIMIT);
        const Result r = method(a, b);
        if (write(ends[1], &r, sizeof r) != sizeof r) _exit(1);
        _exit(0);
    }
    close(ends[1]);
    if (read(ends[0], &out, sizeof out) != sizeof out) out = Result();
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return out;
}

double median(std::vector<double> x) {
    std::sort(x.begin(), x.end());
    const size_t n = x.size();
    return n == 0 ? 0 : 0.5 * (x[(n - 1) / 2] + x[n / 2]);
}

} // namespace

int main(int argc, char **argv) {
    const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 3;
    struct Case {
        std::string name;
        Net a, b;
        int loops; // of the small-loop test; 0: not counted
    };
    std::vector<Case> cases;
    char name[80];
    const Motion turn(0.3, -0.5, 0.7, 0.2, {0.3, -0.2, 0.5});
    for (int n : {1, 16, 100}) {
        for (double gap : {1e-2, 1e-4, 1e-6, 1e-8}) {
            std::snprintf(name, sizeof name, "%d bumps, gap %.0e", n, gap);
            cases.push_back({name, bumps(n), lid(n, 4.0 / 9.0 - gap), n});
        }
    }
    for (double gap : {1e-2, 1e-4, 1e-6, 1e-8}) {
        std::snprintf(name, sizeof name, "16 bumps, rational, turned, gap %.0e", gap);
        cases.push_back({name, moved(in_perspective(bumps(16), 0.02, 0.01), turn), moved(in_perspective(lid(16, 4.0 / 9.0 - gap), 0.02, 0.01), turn), 16});
    }
    const Motion across(0.5, 0.5, 0.5, 0.5, {0, 0, 0});
    cases.push_back({"sphere, plane", sphere(1), level(0.3), 0});
    cases.push_back({"sphere, sphere", sphere(1), moved(sphere(1), turn), 0});
    cases.push_back({"cylinder, cylinder", cone(-2, 1, 2, 1), moved(cone(-2, 0.6, 2, 0.6), across), 0});
    cases.push_back({"cylinder, turned plane", cone(-2, 1, 2, 1), moved(level(0.2), turn), 0});
    cases.push_back({"torus, plane", torus(2, 0.5), level(0.1), 0});
    cases.push_back({"torus, turned torus", torus(2, 0.5), moved(torus(2, 0.5), turn), 0});
    cases.push_back({"torus, sphere", torus(2, 0.5), moved(sphere(1.5), turn), 0});
    cases.push_back({"cone, sphere", cone(-2, 0.2, 2, 1), sphere(1.2), 0});
    cases.push_back({"wave, wave", wave(12, 0), wave(12, 1), 0});
    cases.push_back({"wave, sphere", wave(12, 0), sphere(2), 0});

    std::vector<std::pair<std::string, Method>> methods{{"footpoint", ours}};
#ifdef WITH_OCCT
    methods.emplace_back("GeomAPI_IntSS", occt);
#endif
#ifdef WITH_SISL
    methods.emplace_back("s1859", sisl);
#endif
    std::printf("| pair |");
    for (const auto &m : methods) std::printf(" %s: loops + others, ms |", m.first.c_str());
    std::printf("\n|---|");
    for (std::size_t k = 0; k < methods.size(); k++) std::printf("---|");
    std::printf("\n");
    std::vector<std::vector<double>> ratios(methods.size()), complete(methods.size());
    for (const Case &c : cases) {
        std::vector<std::vector<double>> times(methods.size());
        std::vector<Result> last(methods.size());
        for (int run = 0; run < runs; run++) {
            for (std::size_t k = 0; k < methods.size(); k++) {
                if (run > 0 && last[k].seconds < 0) continue;
                last[k] = watched(methods[k].second, c.a, c.b);
                if (last[k].seconds >= 0) times[k].push_back(last[k].seconds);
            }
        }
        std::printf("| %s |", c.name.c_str());
        for (std::size_t k = 0; k < methods.size(); k++) {
            const double t = median(times[k]);
            if (times[k].empty()) std::printf(" none (crash, or %u s) |", LIMIT);
            else std::printf(" %d + %d%s, %.2f |", last[k].loops, last[k].others, k == 0 ? (last[k].proven ? ", proven" : ", not proven") : "", 1e3 * t);
            if (times[k].empty()) continue;
            ratios[k].push_back(t / median(times[0]));
            if (c.loops ? last[k].loops == c.loops : last[k].loops + last[k].others > 0) complete[k].push_back(t / median(times[0]));
        }
        std::printf("\n");
        std::fflush(stdout);
    }
    for (std::size_t k = 1; k < methods.size(); k++) {
        std::sort(ratios[k].begin(), ratios[k].end());
        if (ratios[k].empty()) continue;
        std::printf("\n%s takes %.2f to %.1f times as long, median %.1f (%zu pairs); where it loses no loop: median %.1f (%zu pairs)\n", methods[k].first.c_str(),
                    ratios[k].front(), ratios[k].back(), median(ratios[k]), ratios[k].size(), median(complete[k]), complete[k].size());
    }
}
