// Operations of footpoint beside those of SISL on the case folders: insertion of knots, degree elevation, splitting, parts, joining, reversal,
// Bezier form, derivatives, exchange of directions, isocurves, removal of knots, length. The same shapes, and the same poles where the
// result is unique. Each case runs in a process of its own: what SISL does not survive is counted, not followed.
// SPDX-License-Identifier: MIT OR Apache-2.0
//
//   reference_sisl_operations [folder of cases...]
#include "geometry.h"

#include <footpoint.hpp>

#include <sisl.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>

namespace {

namespace operate = footpoint::operate;

/** What both may differ by, relative to the size; de Boor in homogeneous coordinates, as SISL does it, loses more with wild weights. */
constexpr double LIMIT = 1e-12;

struct Counts {
    int checked, failed, refused;
    double worst;
};
Counts counts = {0, 0, 0, 0};

void expect(double off, double limit, const std::string &name, const char *what) {
    counts.checked++;
    if (off <= limit) {
        counts.worst = std::max(counts.worst, off);
        return;
    }
    counts.failed++;
    std::fprintf(stderr, "%s: %s: %g\n", name.c_str(), what, off);
}

struct Release {
    void operator()(SISLCurve *c) const { freeCurve(c); }
    void operator()(SISLSurf *s) const { freeSurf(s); }
};
using Curve = std::unique_ptr<SISLCurve, Release>;
using Surface = std::unique_ptr<SISLSurf, Release>;

/** u runs fastest, rational poles are multiplied by the weight, which follows. */
std::vector<double> poles_of(const Geometry &g) {
    std::vector<double> poles;
    for (int j = 0; j < g.count[1]; j++) {
        for (int i = 0; i < g.count[0]; i++) {
            const std::size_t k = std::size_t(i) * std::size_t(g.count[1]) + std::size_t(j);
            const double w = g.rational ? g.weights[k] : 1.0;
            poles.insert(poles.end(), {g.poles[3 * k] * w, g.poles[3 * k + 1] * w, g.poles[3 * k + 2] * w});
            if (g.rational) poles.push_back(w);
        }
    }
    return poles;
}

double size_of(const Geometry &g) {
    double most = 0;
    for (const double x : g.poles) most = std::max(most, std::fabs(x));
    return most;
}

double apart(const double *a, const double *b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

double low(const SISLCurve *c) { return c->et[c->ik - 1]; }
double high(const SISLCurve *c) { return c->et[c->in]; }

/** The greatest distance of samples, over the size. */
double apart(SISLCurve *theirs, const footpoint::curve &ours, double size) {
    const double a = std::max(low(theirs), ours.domain()[0]), b = std::min(high(theirs), ours.domain()[1]);
    double most = std::max(std::fabs(a - ours.domain()[0]), std::fabs(b - ours.domain()[1])) > 1e-12 * (b - a) ? INFINITY : 0;
    for (int i = 0; i <= 60; i++) {
        const double u = i == 60 ? b : a + (b - a) * i / 60;
        double point[3];
        int left = 0, status = 0;
        s1221(theirs, 0, u, &left, point, &status);
        if (status < 0) return INFINITY;
        most = std::max(most, apart(point, ours.evaluate(u).data()));
    }
    return most / size;
}

double apart(SISLSurf *theirs, const footpoint::surface &ours, double size) {
    const auto d = ours.domain();
    double most = 0;
    for (int i = 0; i <= 12; i++) {
        for (int j = 0; j <= 12; j++) {
            double at[2] = {i == 12 ? d[1] : d[0] + (d[1] - d[0]) * i / 12, j == 12 ? d[3] : d[2] + (d[3] - d[2]) * j / 12}, out[3], normal[3];
            int left[2] = {0, 0}, status = 0;
            s1421(theirs, 0, at, &left[0], &left[1], out, normal, &status);
            if (status < 0) return INFINITY;
            most = std::max(most, apart(out, ours.evaluate(at[0], at[1]).data()));
        }
    }
    return most / size;
}

double poles_apart(const SISLCurve *theirs, const footpoint::curve &ours, double size) {
    if (std::size_t(theirs->in) != ours.pole_count()) return INFINITY;
    const std::vector<double> poles = ours.poles();
    double most = 0;
    for (std::size_t i = 0; i < ours.pole_count(); i++) most = std::max(most, apart(&theirs->ecoef[3 * i], &poles[3 * i]));
    return most / size;
}

/** SISL's result of a call, nothing when it refuses. */
Curve curve_by(const std::function<void(SISLCurve **, int *)> &call) {
    SISLCurve *out = nullptr;
    int status = 0;
    call(&out, &status);
    if (status >= 0 && out != nullptr) return Curve(out);
    counts.refused++;
    return nullptr;
}
Surface surface_by(const std::function<void(SISLSurf **, int *)> &call) {
    SISLSurf *out = nullptr;
    int status = 0;
    call(&out, &status);
    if (status >= 0 && out != nullptr) return Surface(out);
    counts.refused++;
    return nullptr;
}

std::vector<double> middles(const Geometry &g, int k) {
    std::vector<double> out;
    for (int i = g.degree[k]; i < g.count[k]; i++) {
        const double a = g.knots[k][std::size_t(i)], b = g.knots[k][std::size_t(i) + 1];
        // SISL takes knots that are nearer than its tolerance for one.
        if (b - a > 1e-6 * (g.high(k) - g.low(k))) out.push_back(0.5 * a + 0.5 * b);
    }
    return out;
}

void curve_case(const Geometry &g, const std::string &name) {
    std::vector<double> knots = g.knots[0], scaled = poles_of(g);
    const Curve theirs(newCurve(g.count[0], g.degree[0] + 1, knots.data(), scaled.data(), g.rational ? 2 : 1, 3, 1));
    const footpoint::curve ours(std::size_t(g.degree[0]), g.knots[0], g.poles, g.rational ? g.weights : std::vector<double>());
    const double size = size_of(g), a = g.low(0), b = g.high(0);
    SISLCurve *const c = theirs.get();
    // In place, last.
    const auto reversed = [&] {
        s1706(c);
        expect(apart(c, operate::reverse(ours), size), 10 * LIMIT, name, "s1706: reversal");
    };
    // Where SISL's own evaluation is farther off there is nothing to compare.
    const double own = apart(c, ours, size);
    expect(own, LIMIT, name, "the curve itself");
    if (own > LIMIT) return;
    std::vector<double> added = middles(g, 0);
    if (const Curve finer = curve_by([&](SISLCurve **out, int *status) { s1018(c, added.data(), int(added.size()), out, status); })) {
        const footpoint::curve refined = operate::refine(ours, added);
        expect(apart(finer.get(), refined, size), LIMIT, name, "s1018: insertion");
        expect(poles_apart(finer.get(), refined, size), LIMIT, name, "s1018: poles");
    }
    for (const int by : {1, 2}) {
        if (g.degree[0] + by > 12) continue;
        if (const Curve raised = curve_by([&](SISLCurve **out, int *status) { s1750(c, g.degree[0] + 1 + by, out, status); })) {
            const footpoint::curve elevated = operate::elevate(ours, std::size_t(by));
            expect(apart(raised.get(), elevated, size), 10 * LIMIT, name, "s1750: elevation");
            if (std::size_t(raised->in) == elevated.pole_count()) expect(poles_apart(raised.get(), elevated, size), 100 * LIMIT, name, "s1750: poles");
        }
    }
    const double middle = a + 0.4375 * (b - a);
    SISLCurve *first = nullptr, *second = nullptr;
    int status = 0;
    s1710(c, middle, &first, &second, &status);
    const Curve before(first), behind(second);
    if (status >= 0 && before && behind) {
        const auto halves = operate::split(ours, middle);
        expect(apart(before.get(), halves.first, size), LIMIT, name, "s1710: before");
        expect(apart(behind.get(), halves.second, size), LIMIT, name, "s1710: behind");
        // Joined again: SISL scales the second domain, so places are compared, not parameters.
        if (const Curve whole = curve_by([&](SISLCurve **out, int *s) { s1715(before.get(), behind.get(), 1, 0, out, s); })) {
            const auto joined = operate::join({&halves.first, &halves.second}, 1e-9 * size);
            expect(operate::difference(ours, joined.shape).bound / size, joined.error / size + LIMIT, name, "join");
            double end[3], start[3];
            int left = 0;
            s1221(whole.get(), 0, high(whole.get()), &left, end, &status);
            s1221(whole.get(), 0, low(whole.get()), &left, start, &status);
            expect(std::max(apart(end, ours.evaluate(b).data()), apart(start, ours.evaluate(a).data())) / size, LIMIT, name, "s1715: ends");
        }
    } else {
        counts.refused++;
    }
    if (const Curve part = curve_by([&](SISLCurve **out, int *s) { s1712(c, a + 0.25 * (b - a), a + 0.75 * (b - a), out, s); }))
        expect(apart(part.get(), operate::part(ours, low(part.get()), high(part.get())), size), LIMIT, name, "s1712: part");
    if (const Curve pieces = curve_by([&](SISLCurve **out, int *s) { s1730(c, out, s); })) {
        const footpoint::curve form = operate::bezier_form(ours);
        expect(apart(pieces.get(), form, size), LIMIT, name, "s1730: Bezier form");
        // SISL repeats the pole between two pieces.
        const std::vector<double> poles = form.poles();
        const std::size_t p = ours.degree(), spans = (form.pole_count() - 1) / p;
        double most = std::size_t(pieces->in) == spans * (p + 1) ? 0 : INFINITY;
        for (std::size_t i = 0; i < spans && most < INFINITY; i++)
            for (std::size_t k = 0; k <= p; k++) most = std::max(most, apart(&pieces->ecoef[3 * (i * (p + 1) + k)], &poles[3 * (i * p + k)]));
        if (most < INFINITY) expect(most / size, LIMIT, name, "s1730: poles");
    }
    if (!g.rational && g.degree[0] > 1) {
        if (const Curve slope = curve_by([&](SISLCurve **out, int *s) { s1720(c, 1, out, s); })) {
            try {
                const footpoint::curve derived = operate::derivative(ours);
                double most = 0;
                for (const double x : derived.poles()) most = std::max(most, std::fabs(x));
                expect(apart(slope.get(), derived, std::max(most, size)), 10 * LIMIT, name, "s1720: derivative");
            } catch (const footpoint::error &error) {
                // A corner has none.
                expect(error.status() == FPT_UNSUPPORTED ? 0 : 1, 0, name, error.what());
            }
        }
    }
    double length = 0;
    s1240(c, 1e-9 * size, &length, &status);
    if (status >= 0) {
        const fpt_estimate exact = operate::arc_length(ours).total();
        // SISL's number comes without a bound: it is only asked to be of this order.
        expect(std::fabs(length - exact.value) / std::max(exact.value, size), 1e-3, name, "s1240: length");
    }
    // SISL's removal takes as many tolerances as the poles have coordinates; of rational curves it reads beyond them.
    double tolerance[3] = {1e-4 * size, 1e-4 * size, 1e-4 * size}, errors[3] = {0, 0, 0};
    if (g.rational) return reversed();
    if (const Curve thin = curve_by([&](SISLCurve **out, int *s) { s1940(c, tolerance, g.degree[0], g.degree[0], 1, 10, out, errors, s); })) {
        const auto simpler = operate::simplify(ours, 1e-4 * size);
        const double both = std::sqrt(3.0) * 1e-4 + simpler.error / size;
        expect(apart(thin.get(), simpler.shape, size), both + LIMIT, name, "s1940: both within their tolerance");
    }
    reversed();
}

void surface_case(const Geometry &g, const std::string &name) {
    std::vector<double> u = g.knots[0], v = g.knots[1], scaled = poles_of(g);
    const Surface theirs(newSurf(g.count[0], g.count[1], g.degree[0] + 1, g.degree[1] + 1, u.data(), v.data(), scaled.data(), g.rational ? 2 : 1, 3, 1));
    const footpoint::surface ours(std::size_t(g.degree[0]), std::size_t(g.degree[1]), g.knots[0], g.knots[1], g.poles,
                                  g.rational ? g.weights : std::vector<double>());
    const double size = size_of(g);
    SISLSurf *const s = theirs.get();
    const double own = apart(s, ours, size);
    expect(own, LIMIT, name, "the surface itself");
    if (own > LIMIT) return;
    std::vector<double> added[2] = {middles(g, 0), middles(g, 1)};
    if (const Surface finer = surface_by([&](SISLSurf **out, int *status) {
            s1025(s, added[0].data(), int(added[0].size()), added[1].data(), int(added[1].size()), out, status);
        })) {
        const footpoint::surface refined = operate::refine(operate::refine(ours, FPT_DIRECTION_U, added[0]), FPT_DIRECTION_V, added[1]);
        expect(apart(finer.get(), refined, size), LIMIT, name, "s1025: insertion");
        const std::vector<double> poles = refined.poles();
        double most = std::size_t(finer->in1) == refined.pole_count_u() && std::size_t(finer->in2) == refined.pole_count_v() ? 0 : INFINITY;
        for (std::size_t i = 0; i < refined.pole_count_u() && most < INFINITY; i++)
            for (std::size_t j = 0; j < refined.pole_count_v(); j++)
                most = std::max(most, apart(&finer->ecoef[3 * (j * refined.pole_count_u() + i)], &poles[3 * (i * refined.pole_count_v() + j)]));
        expect(most / size, LIMIT, name, "s1025: poles");
    }
    if (std::max(g.degree[0], g.degree[1]) <= 8) {
        if (const Surface raised = surface_by([&](SISLSurf **out, int *status) { s1387(s, g.degree[0] + 2, g.degree[1] + 2, out, status); }))
            expect(apart(raised.get(), operate::elevate(operate::elevate(ours, FPT_DIRECTION_U), FPT_DIRECTION_V), size), 10 * LIMIT, name, "s1387: elevation");
    }
    for (const int k : {0, 1}) {
        const auto direction = std::uint32_t(k);
        const double at = g.low(k) + 0.4375 * (g.high(k) - g.low(k));
        SISLSurf *first = nullptr, *second = nullptr;
        int status = 0;
        s1711(s, k + 1, at, &first, &second, &status);
        const Surface before(first), behind(second);
        if (status >= 0 && before && behind) {
            const auto halves = operate::split(ours, direction, at);
            expect(apart(before.get(), halves.first, size), LIMIT, name, "s1711: before");
            expect(apart(behind.get(), halves.second, size), LIMIT, name, "s1711: behind");
        } else {
            counts.refused++;
        }
        if (const Curve iso = curve_by([&](SISLCurve **out, int *st) { s1439(s, at, k + 1, out, st); }))
            expect(apart(iso.get(), operate::isocurve(ours, direction, at), size), LIMIT, name, "s1439: isocurve");
    }
    const std::array<double, 4> d = ours.domain();
    const std::array<double, 4> sub = {d[0] + 0.25 * (d[1] - d[0]), d[0] + 0.75 * (d[1] - d[0]), d[2] + 0.125 * (d[3] - d[2]), d[2] + 0.5 * (d[3] - d[2])};
    if (const Surface part = surface_by([&](SISLSurf **out, int *status) { s1001(s, sub[0], sub[2], sub[1], sub[3], out, status); }))
        expect(apart(part.get(), operate::part(ours, sub), size), LIMIT, name, "s1001: part");
    if (const Surface turned = surface_by([&](SISLSurf **out, int *status) { s1440(s, out, status); }))
        expect(apart(turned.get(), operate::swap(ours), size), LIMIT, name, "s1440: exchange");
    if (const Surface pieces = surface_by([&](SISLSurf **out, int *status) { s1731(s, out, status); }))
        expect(apart(pieces.get(), operate::bezier_form(ours), size), LIMIT, name, "s1731: Bezier form");
}

/** One case in a process of its own; its counts come through a pipe. */
bool in_child(const Geometry &g, const std::string &name) {
    int ends[2];
    if (pipe(ends) != 0) std::exit(2);
    const pid_t child = fork();
    if (child == 0) {
        alarm(30);
        counts = Counts{0, 0, 0, 0};
        try {
            g.is_curve ? curve_case(g, name) : surface_case(g, name);
        } catch (const footpoint::error &error) {
            counts.failed++;
            std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
        }
        const bool told = write(ends[1], &counts, sizeof counts) == ssize_t(sizeof counts);
        _exit(told ? 0 : 1);
    }
    close(ends[1]);
    Counts own;
    const bool whole = read(ends[0], &own, sizeof own) == ssize_t(sizeof own);
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (!whole) return false;
    counts.checked += own.checked;
    counts.failed += own.failed;
    counts.refused += own.refused;
    counts.worst = std::max(counts.worst, own.worst);
    return true;
}

} // namespace

int main(int count, char **words) {
    int shapes = 0, lost = 0;
    for (int i = 1; i < count; i++) {
        if (!std::filesystem::is_directory(words[i])) continue;
        std::vector<std::filesystem::path> folders;
        for (const auto &entry : std::filesystem::directory_iterator(words[i])) folders.push_back(entry.path());
        std::sort(folders.begin(), folders.end());
        for (const auto &folder : folders) {
            if (!std::filesystem::exists(folder / "geometry.txt")) continue;
            const Geometry g = read_geometry((folder / "geometry.txt").string());
            if (g.poles.size() > 3 * 2500) continue;
            shapes++;
            if (in_child(g, folder.filename().string())) continue;
            lost++;
            std::fprintf(stderr, "%s: SISL ended the process\n", folder.filename().c_str());
        }
    }
    std::printf("%d shapes: %d checks, %d failed, worst agreement %.2g; SISL refused %d calls and ended the process on %d shapes\n", shapes,
                counts.checked, counts.failed, counts.worst, counts.refused, lost);
    return counts.failed != 0 || counts.checked == 0;
}
