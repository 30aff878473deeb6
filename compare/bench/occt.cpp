// OpenCASCADE, made once for a shape and asked again and again. SPDX-License-Identifier: MIT OR Apache-2.0
#include "opencascade.h"
#include "peer.h"

#include <Extrema_ExtPC.hxx>
#include <Extrema_POnCurv.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <Standard_Failure.hxx>

#include <vector>

namespace {

gp_Pnt point_of(const Vec &p) { return gp_Pnt(p[0], p[1], p[2]); }

// 1e-7 of the diagonal of the poles: what the bench counts as right.
double precision_of(const Geometry &g) {
    Vec low = {g.poles[0], g.poles[1], g.poles[2]}, high = low;
    for (size_t i = 0; i < g.poles.size(); i++) {
        low[i % 3] = std::min(low[i % 3], g.poles[i]);
        high[i % 3] = std::max(high[i % 3], g.poles[i]);
    }
    return 1e-7 * norm(minus(high, low));
}

// All zeros that Extrema_ExtPC finds on a curve, and both ends.
class CurveAndEnds {
public:
    explicit CurveAndEnds(const Handle(Geom_Curve) & curve)
        : adaptor_(curve), first_(adaptor_.FirstParameter()), last_(adaptor_.LastParameter()),
          start_(adaptor_.Value(first_)), end_(adaptor_.Value(last_)) {
        extrema_.Initialize(adaptor_, first_, last_);
    }

    // The square of the distance; `parameter` is where.
    double nearest(const gp_Pnt &p, double &parameter) {
        double least = p.SquareDistance(start_);
        parameter = first_;
        const auto take = [&](double square, double at) {
            if (square < least) {
                least = square;
                parameter = at;
            }
        };
        take(p.SquareDistance(end_), last_);
        try {
            extrema_.Perform(p);
            for (int k = 1; extrema_.IsDone() && k <= extrema_.NbExt(); k++) {
                take(extrema_.SquareDistance(k), extrema_.Point(k).Parameter());
            }
        } catch (const Standard_Failure &) {
        }
        return least;
    }

private:
    GeomAdaptor_Curve adaptor_;
    double first_, last_;
    gp_Pnt start_, end_;
    Extrema_ExtPC extrema_;
};

class CurveExtrema : public Peer {
public:
    explicit CurveExtrema(const Geometry &g) : curve_(curve_of(g)) {}
    Answer ask(const Vec &point, const Pair &) override {
        Answer answer;
        answer.found = true;
        curve_.nearest(point_of(point), answer.at[0]);
        return answer;
    }

private:
    CurveAndEnds curve_;
};

class ProjectOnCurve : public Peer {
public:
    explicit ProjectOnCurve(const Geometry &g) {
        const Handle(Geom_BSplineCurve) curve = curve_of(g);
        project_.Init(curve, curve->FirstParameter(), curve->LastParameter());
    }
    Answer ask(const Vec &point, const Pair &) override {
        project_.Perform(point_of(point));
        Answer answer;
        answer.found = project_.NbPoints() > 0;
        answer.at[0] = answer.found ? project_.LowerDistanceParameter() : 0.0;
        return answer;
    }

private:
    GeomAPI_ProjectPointOnCurve project_;
};

// With `edges`, the four boundary curves and their ends are looked at as well.
class ProjectOnSurface : public Peer {
public:
    ProjectOnSurface(const Geometry &g, bool edges) : surface_(surface_of(g)) {
        surface_->Bounds(box_[0], box_[1], box_[2], box_[3]);
        project_.Init(surface_, box_[0], box_[1], box_[2], box_[3], Extrema_ExtAlgo_Tree);
        for (int side = 0; edges && side < 4; side++) {
            const Handle(Geom_Curve) edge = side < 2 ? surface_->UIso(box_[side]) : surface_->VIso(box_[side]);
            edges_.push_back(std::make_unique<CurveAndEnds>(edge));
        }
    }
    Answer ask(const Vec &point, const Pair &) override {
        const gp_Pnt p = point_of(point);
        Answer answer;
        project_.Perform(p);
        answer.found = project_.IsDone() && project_.NbPoints() > 0;
        double least = HUGE_VAL;
        if (answer.found) {
            project_.LowerDistanceParameters(answer.at[0], answer.at[1]);
            least = project_.LowerDistance() * project_.LowerDistance();
        }
        for (size_t side = 0; side < edges_.size(); side++) {
            double parameter;
            const double square = edges_[side]->nearest(p, parameter);
            if (square < least) {
                least = square;
                answer.found = true;
                answer.at = side < 2 ? Pair{box_[side], parameter} : Pair{parameter, box_[side]};
            }
        }
        return answer;
    }

private:
    Handle(Geom_BSplineSurface) surface_;
    double box_[4];
    GeomAPI_ProjectPointOnSurf project_;
    std::vector<std::unique_ptr<CurveAndEnds>> edges_;
};

class Analysis : public Peer {
public:
    Analysis(const Geometry &g, bool hinted)
        : surface_(new ShapeAnalysis_Surface(surface_of(g))), precision_(precision_of(g)), hinted_(hinted) {}
    Answer ask(const Vec &point, const Pair &hint) override {
        const gp_Pnt p = point_of(point);
        const gp_Pnt2d at = hinted_ ? surface_->NextValueOfUV(gp_Pnt2d(hint[0], hint[1]), p, precision_)
                                    : surface_->ValueOfUV(p, precision_);
        return {true, true, {at.X(), at.Y()}, 0.0};
    }

private:
    Handle(ShapeAnalysis_Surface) surface_;
    double precision_;
    bool hinted_;
};

} // namespace

std::unique_ptr<Peer> make_peer(const std::string &name, const Geometry &g) {
    if (g.is_curve) {
        if (name == "occt_extpc") {
            return std::make_unique<CurveExtrema>(g);
        }
        return name == "occt_project" ? std::make_unique<ProjectOnCurve>(g) : nullptr;
    }
    if (name == "occt_project" || name == "occt_edges") {
        return std::make_unique<ProjectOnSurface>(g, name == "occt_edges");
    }
    if (name == "occt_value" || name == "occt_next") {
        return std::make_unique<Analysis>(g, name == "occt_next");
    }
    return nullptr;
}
