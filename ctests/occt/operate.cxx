// Operations of footpoint against those of OCCT's Geom_BSplineCurve, Geom_BSplineSurface and GeomConvert on the case folders: the same points, the
// same poles where the result is unique, the same lengths. SPDX-License-Identifier: MIT OR Apache-2.0
//
//   operate [folder of cases...]      fails when the two disagree by more than 1e-12 of the size of a shape
#include "opencascade.h"

#include <footpoint.hpp>

#include <GeomConvert_BSplineCurveToBezierCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Standard_Failure.hxx>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace {

namespace operate = footpoint::operate;
int failed = 0, checked = 0, refused = 0;
int removals = 0, nearer = 0, rings = 0;
double worst = 0;

double size_of(const Geometry &g) {
    double most = 0;
    for (double x : g.poles) most = std::max(most, std::fabs(x));
    return most;
}

void expect(double error, double limit, const std::string &about, const char *what) {
    checked++;
    if (error <= limit) {
        if (limit <= 1e-11) worst = std::max(worst, error);
        return;
    }
    failed++;
    std::printf("%s: %s: %g\n", about.c_str(), what, error);
}

double apart(const gp_Pnt &a, const double *b) { return a.Distance(gp_Pnt(b[0], b[1], b[2])); }

/** The greatest distance of sampled points, over the size. */
double apart(const Handle(Geom_BSplineCurve) & theirs, const footpoint::curve &ours, double size) {
    const auto [low, high] = ours.domain();
    double most = 0;
    for (int i = 0; i <= 100; i++) {
        const double u = i == 100 ? high : low + (high - low) * i / 100;
        most = std::max(most, apart(theirs->Value(u), ours.evaluate(u).data()));
    }
    return most / size;
}

double apart(const Handle(Geom_BSplineSurface) & theirs, const footpoint::surface &ours, double size) {
    const auto d = ours.domain();
    double most = 0;
    for (int i = 0; i <= 20; i++) {
        for (int j = 0; j <= 20; j++) {
            const double u = i == 20 ? d[1] : d[0] + (d[1] - d[0]) * i / 20, v = j == 20 ? d[3] : d[2] + (d[3] - d[2]) * j / 20;
            most = std::max(most, apart(theirs->Value(u, v), ours.evaluate(u, v).data()));
        }
    }
    return most / size;
}

/** The greatest distance of poles, over the size; infinite when there are not as many. */
double poles_apart(const Handle(Geom_BSplineCurve) & theirs, const footpoint::curve &ours, double size) {
    const std::vector<double> poles = ours.poles();
    if (size_t(theirs->NbPoles()) != ours.pole_count()) return INFINITY;
    double most = 0;
    for (int i = 0; i < theirs->NbPoles(); i++) most = std::max(most, apart(theirs->Pole(i + 1), &poles[3 * size_t(i)]));
    return most / size;
}

Handle(Geom_BSplineCurve) copy(const Handle(Geom_BSplineCurve) & c) { return Handle(Geom_BSplineCurve)::DownCast(c->Copy()); }
Handle(Geom_BSplineSurface) copy(const Handle(Geom_BSplineSurface) & s) {
    return Handle(Geom_BSplineSurface)::DownCast(s->Copy());
}

std::vector<double> middles(const std::vector<double> &knots, int degree, int count) {
    std::vector<double> out;
    for (int i = degree; i < count; i++) {
        const double a = knots[size_t(i)], b = knots[size_t(i) + 1];
        // OCCT takes knots that are nearer than its tolerance for one.
        if (b - a > 1e-6 * (knots[size_t(count)] - knots[size_t(degree)])) out.push_back(0.5 * a + 0.5 * b);
    }
    return out;
}

/** A curve of OCCT's as ours. */
footpoint::curve part_of(const Handle(Geom_BSplineCurve) & c) {
    std::vector<double> knots, poles, weights;
    for (int i = 1; i <= c->NbKnots(); i++) knots.insert(knots.end(), size_t(c->Multiplicity(i)), c->Knot(i));
    for (int i = 1; i <= c->NbPoles(); i++) {
        const gp_Pnt p = c->Pole(i);
        poles.insert(poles.end(), {p.X(), p.Y(), p.Z()});
        weights.push_back(c->Weight(i));
    }
    return footpoint::curve(size_t(c->Degree()), knots, poles, weights);
}

/** RemoveKnot: of a knot that was inserted, back to the curve; of one that is needed, within what we prove. */
void removed_knots(const Handle(Geom_BSplineCurve) & theirs, const footpoint::curve &ours, const Handle(Geom_BSplineCurve) & finer,
                   const footpoint::curve &refined, const std::vector<double> &added, const std::string &name, double size) {
    if (!added.empty()) {
        const double u = added[added.size() / 2];
        Handle(Geom_BSplineCurve) less = copy(finer);
        Standard_Integer from = 0, to = 0;
        less->LocateU(u, 0, from, to);
        const auto removed = operate::remove_knot(refined, u);
        // OCCT forms the poles of either side by recurrences that grow what rounding left; where it says no there is nothing to compare.
        if (from == to && less->RemoveKnot(from, less->Multiplicity(from) - 1, 1e-9 * size)) {
            expect(apart(less, removed.shape, size), removed.error / size + 2e-9, name, "RemoveKnot of an inserted knot");
            removals++;
        }
        expect(apart(theirs, removed.shape, size), removed.error / size + 1e-12, name, "an inserted knot removed");
    }
    for (int i = theirs->FirstUKnotIndex() + 1; i < theirs->LastUKnotIndex(); i++) {
        Handle(Geom_BSplineCurve) less = copy(theirs);
        if (!less->RemoveKnot(i, less->Multiplicity(i) - 1, 1e3 * size)) continue;
        std::optional<operate::bounded<footpoint::curve>> removed;
        try {
            removed.emplace(operate::remove_knot(ours, theirs->Knot(i)));
        } catch (const footpoint::error &error) {
            // OCCT's result has a weight that is not positive as well, or poles far away.
            if (error.status() != FPT_UNSUPPORTED) throw;
            continue;
        }
        const double far = apart(theirs, removed->shape, size), other = apart(theirs, part_of(less), size);
        expect(far, removed->error / size + 1e-12, name, "a knot removed, within its error");
        removals++;
        if (far <= other + 1e-12) nearer++;
    }
}

/** SetPeriodic, and SetNotPeriodic as the way back. */
void closed_case(const Handle(Geom_BSplineCurve) & theirs, const footpoint::curve &ours, const std::string &name, double size) {
    Handle(Geom_BSplineCurve) ring = copy(theirs);
    ring->SetPeriodic();
    const auto round = operate::periodic(ours, 1e-9 * size);
    expect(apart(ring, round.shape, size), round.error / size + 1e-9, name, "SetPeriodic");
    expect(apart(theirs, round.shape, size), round.error / size + 1e-12, name, "the periodic form within its error");
    ring->SetNotPeriodic();
    expect(apart(ring, operate::clamp(round.shape), size), round.error / size + 1e-9, name, "SetNotPeriodic");
    rings++;
}

void curve_case(const Geometry &g, const std::string &name) {
    const Handle(Geom_BSplineCurve) theirs = curve_of(g);
    const footpoint::curve ours(size_t(g.degree[0]), g.knots[0], g.poles, g.rational ? g.weights : std::vector<double>());
    // Weights of many sizes are beyond what OCCT's homogeneous arithmetic keeps.
    const double size = size_of(g), limit = 1e-12;
    const double low = g.low(0), high = g.high(0);
    expect(apart(theirs, ours, size), limit, name, "the curve itself");
    if (g.degree[0] < 20) {
        Handle(Geom_BSplineCurve) raised = copy(theirs);
        raised->IncreaseDegree(g.degree[0] + 2);
        const footpoint::curve elevated = operate::elevate(ours, 2);
        expect(apart(raised, elevated, size), limit, name, "degree elevation");
        expect(poles_apart(raised, operate::clamp(elevated), size), 100 * limit, name, "poles of the elevated curve");
        const auto reduced = operate::reduce(elevated);
        expect(apart(raised, reduced.shape, size), reduced.error / size + limit, name, "reduction within its error");
    }
    const std::vector<double> added = middles(g.knots[0], g.degree[0], g.count[0]);
    Handle(Geom_BSplineCurve) finer = copy(theirs);
    for (double u : added) finer->InsertKnot(u, 1, 0, false);
    const footpoint::curve refined = operate::refine(ours, added);
    expect(apart(finer, refined, size), limit, name, "refinement");
    expect(poles_apart(finer, refined, size), limit, name, "poles of the refined curve");
    removed_knots(theirs, ours, finer, refined, added, name, size);
    if (theirs->IsClosed() && !theirs->IsPeriodic()) closed_case(theirs, ours, name, size);
    const auto thin = operate::simplify(refined, 1e-9 * size);
    expect(apart(finer, thin.shape, size), thin.error / size + limit, name, "simplification within its error");
    Handle(Geom_BSplineCurve) back = copy(theirs);
    back->Reverse();
    // Both round the mirrored knots, each in its way: on long domains that is seen.
    expect(apart(back, operate::reverse(ours), size), 10 * limit, name, "reversal");
    Handle(Geom_BSplineCurve) segment = copy(theirs);
    const double a = low + 0.2 * (high - low), b = low + 0.7 * (high - low);
    segment->Segment(a, b);
    const footpoint::curve part = operate::part(ours, segment->FirstParameter(), segment->LastParameter());
    expect(apart(theirs, part, size), limit, name, "part of the curve");
    // OCCT moves ends onto knots that are nearer than its tolerance; where its part left its own curve there is nothing to compare.
    if (apart(theirs, part_of(segment), size) <= limit) expect(apart(segment, part, size), limit, name, "part");
    GeomConvert_BSplineCurveToBezierCurve pieces(theirs);
    const footpoint::curve form = operate::bezier_form(ours);
    const std::vector<double> poles = form.poles();
    double most = 0;
    const size_t p = size_t(g.degree[0]);
    if (size_t(pieces.NbArcs()) * p + 1 == form.pole_count()) {
        for (int i = 0; i < pieces.NbArcs(); i++) {
            for (size_t k = 0; k <= p; k++) {
                most = std::max(most, apart(pieces.Arc(i + 1)->Pole(int(k) + 1), &poles[3 * (size_t(i) * p + k)]));
            }
        }
        expect(most / size, limit, name, "Bezier pieces");
    }
    // OCCT's length is a quadrature without a bound, off by up to 40 % on wild knots: chords of its points judge instead.
    const fpt_estimate length = operate::arc_length(ours).total();
    double chords = 0;
    gp_Pnt last = theirs->Value(low);
    for (int i = 1; i <= 2000; i++) {
        const gp_Pnt next = theirs->Value(i == 2000 ? high : low + (high - low) * i / 2000);
        chords += last.Distance(next);
        last = next;
    }
    expect(std::max(0.0, chords - length.value - length.error) / size, limit, name, "chords are not longer");
}

void surface_case(const Geometry &g, const std::string &name) {
    const Handle(Geom_BSplineSurface) theirs = surface_of(g);
    const footpoint::surface ours(size_t(g.degree[0]), size_t(g.degree[1]), g.knots[0], g.knots[1], g.poles,
                                  g.rational ? g.weights : std::vector<double>());
    const double size = size_of(g), limit = 1e-12;
    expect(apart(theirs, ours, size), limit, name, "the surface itself");
    if (std::max(g.degree[0], g.degree[1]) < 20) {
        Handle(Geom_BSplineSurface) raised = copy(theirs);
        raised->IncreaseDegree(g.degree[0] + 1, g.degree[1] + 1);
        expect(apart(raised, operate::elevate(operate::elevate(ours, FPT_DIRECTION_U), FPT_DIRECTION_V), size), limit, name, "degree elevation");
    }
    Handle(Geom_BSplineSurface) turned = copy(theirs);
    turned->ExchangeUV();
    expect(apart(turned, operate::swap(ours), size), limit, name, "swap");
    for (int k = 0; k < 2; k++) {
        const std::uint32_t along = k == 0 ? FPT_DIRECTION_U : FPT_DIRECTION_V;
        if (k == 0 ? !theirs->IsUClosed() : !theirs->IsVClosed()) continue;
        Handle(Geom_BSplineSurface) ring = copy(theirs);
        k == 0 ? ring->SetUPeriodic() : ring->SetVPeriodic();
        const auto round = operate::periodic(ours, along, 1e-9 * size);
        expect(apart(ring, round.shape, size), round.error / size + 1e-9, name, "SetUPeriodic, SetVPeriodic");
        expect(apart(theirs, round.shape, size), round.error / size + 1e-12, name, "the periodic form within its error");
        rings++;
    }
    const std::vector<double> added = middles(g.knots[0], g.degree[0], g.count[0]);
    if (!added.empty()) {
        const double knot = added[added.size() / 2];
        Handle(Geom_BSplineSurface) finer = copy(theirs);
        finer->InsertUKnot(knot, 1, 0, false);
        const footpoint::surface refined = operate::refine(ours, FPT_DIRECTION_U, {&knot, 1});
        expect(apart(finer, refined, size), limit, name, "refinement along u");
        const auto removed = operate::remove_knot(refined, FPT_DIRECTION_U, knot);
        expect(apart(theirs, removed.shape, size), removed.error / size + limit, name, "an inserted knot removed");
    }
    turned = copy(theirs);
    turned->UReverse();
    expect(apart(turned, operate::reverse(ours, FPT_DIRECTION_U), size), limit, name, "reversal along u");
    const double u = g.low(0) + 0.37 * (g.high(0) - g.low(0));
    const Handle(Geom_BSplineCurve) iso = Handle(Geom_BSplineCurve)::DownCast(theirs->UIso(u));
    expect(apart(iso, operate::isocurve(ours, FPT_DIRECTION_U, u), size), limit, name, "isocurve");
    const double v = g.low(1) + 0.61 * (g.high(1) - g.low(1));
    turned = copy(theirs);
    turned->Segment(g.low(0), u, g.low(1), v);
    double d[4];
    turned->Bounds(d[0], d[1], d[2], d[3]);
    expect(apart(theirs, operate::part(ours, {d[0], d[1], d[2], d[3]}), size), limit, name, "part");
}

} // namespace

int main(int count, char **words) {
    for (int i = 1; i < count; i++) {
        if (!std::filesystem::is_directory(words[i])) continue;
        for (const auto &entry : std::filesystem::directory_iterator(words[i])) {
            const std::string file = entry.path().string() + "/geometry.txt", name = entry.path().filename().string();
            if (!std::filesystem::exists(file)) continue;
            const Geometry g = read_geometry(file);
            if (g.poles.size() > 3 * 5000) continue;
            try {
                g.is_curve ? curve_case(g, name) : surface_case(g, name);
            } catch (const Standard_Failure &failure) {
                // What OCCT does not take (knots nearer than its tolerance, degrees above 25).
                refused++;
            } catch (const footpoint::error &error) {
                failed++;
                std::printf("%s: %s\n", name.c_str(), error.what());
            }
        }
    }
    std::printf("operate: %d checks, %d failed, %d shapes refused by OCCT, worst agreement %.2g\n", checked, failed, refused, worst);
    std::printf("RemoveKnot: %d compared, of those that are needed %d moved less by us; closed in a direction: %d\n", removals, nearer, rings);
    return failed != 0;
}
