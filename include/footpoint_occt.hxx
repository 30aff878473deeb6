/*
 * footpoint for OpenCASCADE 7.6 and newer, C++17, header only. SPDX-License-Identifier: MIT OR Apache-2.0
 *
 *   footpoint::occt::curve, surface      a Geom_Curve, Geom_Surface, TopoDS_Edge or TopoDS_Face, asked through footpoint; answers
 *                                        in OCCT's own parameters and types
 *   footpoint::occt::GeomAPI_ProjectPointOnCurve, GeomAPI_ProjectPointOnSurf, ShapeAnalysis_Surface
 *   footpoint::occt::GeomAPI_IntCS       the classes of these names with the same methods; a caller changes its include and
 *                                        writes `using footpoint::occt::GeomAPI_ProjectPointOnSurf;` in its namespace or function
 *
 * What comes how:
 *   exact   B-splines and Beziers (pole by pole; periodic ones unrolled), lines, conics, planes, cylinders, cones, spheres, tori,
 *           surfaces of revolution and extrusion of all these, trimmed ones; offsets of elementary surfaces. Angles are rational
 *           arcs in footpoint and come back as angles. Answers are proven.
 *   by      offset curves and surfaces, plates and what else derives from Geom_Curve and Geom_Surface: OCCT evaluates. Answers
 *   call    are found and carry FPT_FOOT_NOT_PROVEN. They must be bounded.
 * Unbounded directions (planes, cylinders, lines, ...) are converted where a query needs them, and again when one lies farther out.
 * Revolutions of unbounded lines and conics work too; an extrusion of an unbounded conic must be given a range.
 *
 * Failures are OCCT's exceptions with footpoint's text: Standard_NullObject (no shape), Standard_ConstructionError (a bad shape
 * or range), Standard_OutOfRange (an index), StdFail_NotDone (no answer: a query that is not finite), Standard_OutOfMemory.
 * An object belongs to one thread at a time; several threads take a copy each, which shares the search index.
 * Proofs are about the converted shape. Splines are converted bit for bit; arcs and conics lie within rounding (1e-15 of the largest
 * coordinate) of what OCCT evaluates.
 *
 * What the drop-in classes do otherwise than OCCT's own:
 *   - borders count: the nearest point exists for each query, on an edge or corner too. OCCT lists orthogonal projections only and
 *     has none where the nearest point is on a border;
 *   - the lists are complete or IsComplete() is false; nearest first; with borders, saddles, and the apex of a cone. An arc or
 *     region of equally near points is one entry;
 *   - tolerances, precisions and Extrema_ExtAlgo change nothing: every answer is refined to the limit of the arithmetic;
 *   - GeomAPI_IntCS: points of contact are points too, each place once (also on a seam); segments are where the curve lies in the
 *     surface within 1e-7. Where both are unbounded, or one is a shape by call, the answer is OCCT's own and IsProven() is false;
 *   - Extrema() is missing: there is no Extrema_ExtPC or Extrema_ExtPS behind. IsProven(), LowerBound(), IsComplete() are new.
 */
#ifndef FOOTPOINT_OCCT_HXX
#define FOOTPOINT_OCCT_HXX

#include "footpoint_occt_shapes.hxx"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <BndLib_Add3dCurve.hxx>
#include <BndLib_AddSurface.hxx>
#include <Bnd_Box.hxx>
#include <Extrema_ExtAlgo.hxx>
#include <Extrema_ExtFlag.hxx>
#include <GeomAPI_IntCS.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <Standard_NullObject.hxx>
#include <Standard_OutOfRange.hxx>
#include <StdFail_NotDone.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt2d.hxx>

#include <cmath>
#include <memory>

namespace footpoint::occt {

/** A foot in OCCT's parameters. */
struct foot {
    /** On a curve V is 0. */
    Standard_Real U = 0, V = 0;
    /** The shape there, as footpoint evaluates it. */
    gp_Pnt Point;
    Standard_Real Distance = 0;
    /** Nothing on the shape is nearer; 0 without proof. */
    Standard_Real LowerBound = 0;
    /** Sum of fpt_foot_flag values. EDGE and CORNER are those of the shape and range that were given, as far as it is bounded. */
    std::uint32_t Flags = 0;

    bool IsProven() const noexcept { return (Flags & (FPT_FOOT_NOT_PROVEN | FPT_FOOT_BAD_QUERY)) == 0; }
};

/** A member of a set: its foot, and the parameters that belong to it. */
struct member : foot {
    std::array<Standard_Real, 2> URange{}, VRange{};
    /** A value of fpt_member_kind. */
    std::uint32_t Kind = FPT_MEMBER_POINT;
    /** A value of fpt_member_nature. */
    std::uint32_t Nature = FPT_NATURE_MINIMUM;
};

/** A set: complete, or what was found of it. */
struct members {
    std::vector<member> List;
    bool IsComplete = true;
};

/** What curve and surface share. */
template <class Shape, int Directions>
class asked_shape {
public:
    /** The nearest point; proven unless Flags says otherwise. A query that is not finite has FPT_FOOT_BAD_QUERY. */
    foot closest(const gp_Pnt &query, const fpt_query_options &options = single()) {
        cover(&query, 1);
        const double where[3] = {query.X(), query.Y(), query.Z()};
        fpt_query_options used = restricted(options);
        used.hints = nullptr;
        used.point_stride = 0;
        fpt_foot_point found;
        detail::asked([&] { shape_->closest(where, 1, &used, &found); return 0; });
        return foot_of(found);
    }

    /** The same for many points, on all cores by default; the order is kept. Hints are not passed on. */
    std::vector<foot> closest_many(const std::vector<gp_Pnt> &queries,
                                   const fpt_query_options &options = query_options()) {
        std::vector<std::size_t> order(queries.size());
        for (std::size_t i = 0; i < order.size(); i++) order[i] = i;
        if (is_open()) {
            std::vector<double> far;
            for (const gp_Pnt &q : queries) far.push_back(away(q));
            std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return far[a] < far[b]; });
        }
        std::vector<foot> out(queries.size());
        for (std::size_t begin = 0, end = 0; begin < order.size() || queries.empty(); begin = end) {
            // Queries that one window serves well: those about as far away.
            const double most = is_open() && end < order.size() ? 8 * away(queries[order[end]]) : HUGE_VAL;
            std::vector<gp_Pnt> some;
            for (; end < order.size() && (is_open() ? away(queries[order[end]]) <= most : true); end++) some.push_back(queries[order[end]]);
            cover(some.data(), some.size());
            std::vector<double> points;
            for (const gp_Pnt &q : some) points.insert(points.end(), {q.X(), q.Y(), q.Z()});
            fpt_query_options used = restricted(options);
            used.hints = nullptr;
            used.point_stride = 0;
            const std::vector<fpt_foot_point> found = detail::asked([&] { return shape_->closest(points, used); });
            for (std::size_t i = 0; i < found.size(); i++) out[order[begin + i]] = foot_of(found[i]);
            if (queries.empty()) break;
        }
        return out;
    }

    /** The nearest point, found faster from parameters that are near. */
    foot closest_from(const gp_Pnt &query, Standard_Real u, Standard_Real v = 0) {
        cover(&query, 1);
        fpt_query_options used = restricted(single());
        const double hint[2] = {along_[0].from_occt(u), Directions == 2 ? along_[Directions - 1].from_occt(v) : 0};
        used.hints = hint;
        const double where[3] = {query.X(), query.Y(), query.Z()};
        fpt_foot_point found;
        detail::asked([&] { shape_->closest(where, 1, &used, &found); return 0; });
        return foot_of(found);
    }

    /** Every parameter whose point lies within the tolerance (0: 1e-7 x the diagonal of the box). */
    members preimage(const gp_Pnt &query, Standard_Real tolerance = 0) {
        cover(&query, 1);
        const point where{query.X(), query.Y(), query.Z()};
        return members_of(detail::asked([&] { return shape_->preimage(where, tolerance, restricted(single())); }));
    }

    /** Every point where the distance is stationary, borders included; nearest first. */
    members extrema(const gp_Pnt &query, const fpt_extrema_options &options = extrema_options()) {
        cover(&query, 1);
        fpt_extrema_options used = options;
        restrict(used.domain);
        const point where{query.X(), query.Y(), query.Z()};
        return members_of(detail::asked([&] { return shape_->extrema(where, used); }));
    }

    /** Footpoint's shape as it is now, in its own parameters; a shape with unbounded directions: what the queries needed. */
    const Shape &shape() {
        cover(nullptr, 0);
        return *shape_;
    }

protected:
    /** Defaults on the calling thread. */
    static query_options single() {
        query_options out;
        out.threads = 1;
        return out;
    }

    virtual ~asked_shape() = default;
    asked_shape() = default;
    asked_shape(const asked_shape &) = default;
    asked_shape(asked_shape &&) = default;
    asked_shape &operator=(const asked_shape &) = default;
    asked_shape &operator=(asked_shape &&) = default;

    /** The finite part that is to be converted for a query; the ranges come as the bounds and are open where they are open. */
    virtual void needed(const gp_Pnt &query, detail::range *ranges) const = 0;
    /** Converts between finite parameters. */
    virtual void convert(const detail::range *ranges) = 0;

    bool is_open() const { return is_open(0) || (Directions == 2 && is_open(Directions - 1)); }

    bool is_open(int k) const { return detail::open(bounds_[k].low) || detail::open(bounds_[k].high); }

    /** How far a query is from the place of the shape, before it is placed; 0 for one that is not finite. */
    double away(gp_Pnt query) const {
        query.Transform(back_);
        return detail::finite(query) ? query.Distance(centre_) : 0;
    }

    /** Converts a bounded shape; one that is not waits for its first query, but must be of a kind that can be converted. */
    void begin() {
        if (!is_open()) return cover(nullptr, 0);
        detail::range ranges[Directions];
        for (int k = 0; k < Directions; k++) ranges[k] = bounds_[k];
        needed(centre_, ranges);
    }

    /** Converts what the queries need. An open direction is kept when it covers the feet and is not so long that its rounding would
     *  be felt; it grows while it is no longer than 32 times what the query needs, and begins anew otherwise. */
    void cover(const gp_Pnt *queries, std::size_t count) {
        if (!is_open()) {
            if (!shape_) detail::asked([&] { convert(bounds_); return 0; });
            return;
        }
        for (std::size_t i = 0; i < count; i++) {
            gp_Pnt query = queries[i].Transformed(back_);
            const double far = away(queries[i]);
            if (!detail::finite(query)) query = centre_;
            detail::range ranges[Directions], old[Directions];
            for (int k = 0; k < Directions; k++) ranges[k] = bounds_[k];
            needed(query, ranges);
            bool covered = shape_ != nullptr, keep = shape_ != nullptr;
            double room[Directions];
            for (int k = 0; k < Directions; k++) {
                old[k] = along_[k].used;
                const double width = ranges[k].high - ranges[k].low;
                room[k] = curved_ ? 0.25 * width : far > 0 ? far : 1;
                if (!is_open(k)) continue;
                covered = covered && detail::covers(bounds_[k], old[k], ranges[k]);
                keep = keep && old[k].high - old[k].low <= (curved_ ? 2 : 32) * (2 * room[k] + width);
            }
            if (covered && keep) continue;
            for (int k = 0; k < Directions; k++)
                ranges[k] = is_open(k) ? detail::window(bounds_[k], ranges[k], keep ? &old[k] : nullptr, room[k]) : bounds_[k];
            detail::asked([&] { convert(ranges); return 0; });
        }
        const gp_Pnt some = centre_.Transformed(place_);
        if (!shape_) cover(&some, 1);
    }

    /** Whether a parameter of footpoint is an end that only the conversion has. */
    bool is_cut(int k, double t) const {
        return (detail::open(bounds_[k].low) && t <= along_[k].whole.low)
            || (detail::open(bounds_[k].high) && t >= along_[k].whole.high);
    }

    void restrict(double *domain) const {
        bool whole = true;
        for (int k = 0; k < Directions; k++) {
            domain[2 * k] = along_[k].from_occt(along_[k].used.low);
            domain[2 * k + 1] = along_[k].from_occt(along_[k].used.high);
            whole = whole && domain[2 * k] <= along_[k].whole.low && domain[2 * k + 1] >= along_[k].whole.high;
        }
        if (whole) std::fill(domain, domain + 2 * Directions, 0.0);
    }
    fpt_query_options restricted(const fpt_query_options &options) const {
        fpt_query_options out = options;
        restrict(out.domain);
        return out;
    }

    foot foot_of(const fpt_foot_point &found) const {
        foot out;
        const bool good = (found.flags & FPT_FOOT_BAD_QUERY) == 0 && !std::isnan(found.u);
        out.U = good ? along_[0].to_occt(found.u) : found.u;
        out.V = Directions == 1 ? 0 : good ? along_[Directions - 1].to_occt(found.v) : found.v;
        out.Point = gp_Pnt(found.point[0], found.point[1], found.point[2]);
        out.Distance = found.distance;
        out.LowerBound = found.lower_bound;
        out.Flags = found.flags;
        return out;
    }

    /** The members but for those that only lie where an unbounded direction was cut. */
    members members_of(const foot_set &set) const {
        members out;
        out.IsComplete = set.is_complete();
        for (const fpt_foot_member &found : set) {
            if (is_cut(0, found.foot.u) || (Directions == 2 && is_cut(1, found.foot.v))) continue;
            member next;
            static_cast<foot &>(next) = foot_of(found.foot);
            for (int k = 0; k < 2; k++) {
                next.URange[std::size_t(k)] = along_[0].to_occt(found.u[k]);
                next.VRange[std::size_t(k)] = Directions == 1 ? 0 : along_[Directions - 1].to_occt(found.v[k]);
            }
            next.Kind = found.kind;
            next.Nature = found.nature;
            out.List.push_back(next);
        }
        return out;
    }

    /** OCCT's parameters that were given, perhaps without end. */
    detail::range bounds_[2] = {{0, 1}, {0, 1}};
    gp_Trsf place_, back_;
    /** A point of the shape before it is placed, from which windows are measured. */
    gp_Pnt centre_;
    /** The open direction goes along a conic: its parameter is no length. */
    bool curved_ = false;
    std::shared_ptr<const Shape> shape_;
    detail::direction along_[2];
};

/** A Geom_Curve, or an edge where it lies. */
class curve : public asked_shape<footpoint::curve, 1> {
public:
    explicit curve(const Handle(Geom_Curve) &shape) : curve(shape, detail::everything(), gp_Trsf()) {}
    /** The part between two parameters; on a periodic curve any two, at most a period apart. */
    curve(const Handle(Geom_Curve) &shape, Standard_Real Umin, Standard_Real Usup)
        : curve(shape, detail::range{Umin, Usup}, gp_Trsf()) {}
    /** The edge's curve between its ends, where its location puts it. An edge without a curve in space is refused. */
    explicit curve(const TopoDS_Edge &edge) {
        if (edge.IsNull()) throw Standard_NullObject("edge: null");
        TopLoc_Location place;
        detail::range part{};
        const Handle(Geom_Curve) shape = BRep_Tool::Curve(edge, place, part.low, part.high);
        if (shape.IsNull()) detail::refuse("edge: it has no curve in space");
        *this = curve(shape, part, place.Transformation());
    }

private:
    curve(const Handle(Geom_Curve) &shape, const detail::range &part, const gp_Trsf &place) {
        if (shape.IsNull()) throw Standard_NullObject("curve: null");
        base_ = detail::basis(shape);
        place_ = place;
        back_ = place.Inverted();
        const bool is_periodic = base_ == shape && shape->IsPeriodic();
        bounds_[0] = detail::common({shape->FirstParameter(), shape->LastParameter()}, part,
                                    is_periodic ? shape->Period() : 0, "U");
        if (is_open()) {
            curved_ = base_->IsKind(STANDARD_TYPE(Geom_Conic));
            const detail::range &u = bounds_[0];
            centre_ = base_->Value(!detail::open(u.low) ? u.low : !detail::open(u.high) ? u.high : 0);
        }
        begin();
    }

    void needed(const gp_Pnt &query, detail::range *ranges) const override {
        ranges[0] = detail::feet_on(base_, query, nullptr);
    }
    void convert(const detail::range *ranges) override {
        if (const auto found = detail::profile_of(base_, ranges[0])) {
            shape_ = std::make_shared<const footpoint::curve>(detail::made(*found, place_));
            along_[0] = found->along;
            return;
        }
        shape_ = std::make_shared<const footpoint::curve>(detail::called(base_, ranges[0], place_));
        along_[0].used = along_[0].whole = ranges[0];
    }

    Handle(Geom_Curve) base_;
};

/** A Geom_Surface, or a face where it lies. */
class surface : public asked_shape<footpoint::surface, 2> {
public:
    explicit surface(const Handle(Geom_Surface) &shape)
        : surface(shape, detail::everything(), detail::everything(), gp_Trsf()) {}
    /** The part between parameters; in a periodic direction any two, at most a period apart. */
    surface(const Handle(Geom_Surface) &shape, Standard_Real Umin, Standard_Real Usup, Standard_Real Vmin,
            Standard_Real Vsup)
        : surface(shape, detail::range{Umin, Usup}, detail::range{Vmin, Vsup}, gp_Trsf()) {}
    /** The face's surface where its location puts it, in the rectangle of parameters that holds the face; what the wires cut
     *  off is there. */
    explicit surface(const TopoDS_Face &face) {
        if (face.IsNull()) throw Standard_NullObject("face: null");
        TopLoc_Location place;
        const Handle(Geom_Surface) shape = BRep_Tool::Surface(face, place);
        detail::range u{}, v{};
        BRepTools::UVBounds(face, u.low, u.high, v.low, v.high);
        *this = surface(shape, u, v, place.Transformation());
    }

    /** As closest_from, and the parameters go on from the ones before: past the ends of a period, to the nearer side of a seam,
     *  and on a collapsed edge the parameter along it stays. */
    foot next(const gp_Pnt2d &before, const gp_Pnt &query) {
        const double old[2] = {before.X(), before.Y()};
        double hint[2];
        for (int k = 0; k < 2; k++)
            hint[k] = period_[k] > 0 && std::isfinite(old[k])
                ? old[k] - std::floor((old[k] - bounds_[k].low) / period_[k]) * period_[k] : old[k];
        foot out = closest_from(query, hint[0], hint[1]);
        if ((out.Flags & FPT_FOOT_BAD_QUERY) != 0) return out;
        Standard_Real *found[2] = {&out.U, &out.V};
        for (int k = 0; k < 2; k++) {
            const bool is_finite = std::isfinite(old[k]), at_ends = out.Flags & (FPT_FOOT_EDGE | FPT_FOOT_CORNER);
            const detail::range &ends = bounds_[k];
            if (is_finite && period_[k] > 0)
                *found[k] += std::round((old[k] - *found[k]) / period_[k]) * period_[k];
            else if (is_finite && at_ends && closed_[k] && (*found[k] == ends.low || *found[k] == ends.high))
                *found[k] = std::abs(old[k] - ends.low) <= std::abs(old[k] - ends.high) ? ends.low : ends.high;
        }
        if ((out.Flags & FPT_FOOT_COLLAPSED) != 0) {
            const auto on = [&](int k, int edge) {
                return collapsed_[std::size_t(2 * k + edge)] && *found[k] == (edge == 0 ? bounds_[k].low : bounds_[k].high);
            };
            for (int k = 0; k < 2; k++) {
                const int other = 1 - k;
                if ((on(k, 0) || on(k, 1)) && std::isfinite(old[other]))
                    *found[other] = period_[other] > 0 ? old[other]
                                                       : std::clamp(old[other], bounds_[other].low, bounds_[other].high);
            }
        }
        return out;
    }

private:
    surface(const Handle(Geom_Surface) &shape, const detail::range &u, const detail::range &v, const gp_Trsf &place) {
        if (shape.IsNull()) throw Standard_NullObject("surface: null");
        base_ = detail::plain(detail::basis(shape));
        place_ = place;
        back_ = place.Inverted();
        const bool is_whole = detail::basis(shape) == shape;
        detail::range whole[2];
        shape->Bounds(whole[0].low, whole[0].high, whole[1].low, whole[1].high);
        const double turn[2] = {is_whole && shape->IsUPeriodic() ? shape->UPeriod() : 0,
                                is_whole && shape->IsVPeriodic() ? shape->VPeriod() : 0};
        bounds_[0] = detail::common(whole[0], u, turn[0], "U");
        bounds_[1] = detail::common(whole[1], v, turn[1], "V");
        for (int k = 0; k < 2; k++) {
            const bool all = turn[k] > 0 && bounds_[k].high - bounds_[k].low >= turn[k] * (1 - 1e-15);
            period_[k] = all ? turn[k] : 0;
        }
        if (is_open()) {
            const auto turned = detail::turned_of(base_);
            curved_ = turned && detail::basis(turned->meridian)->IsKind(STANDARD_TYPE(Geom_Conic));
            const auto some = [](const detail::range &r) { return !detail::open(r.low) ? r.low : !detail::open(r.high) ? r.high : 0; };
            centre_ = base_->Value(some(bounds_[0]), some(bounds_[1]));
        }
        begin();
    }

    void needed(const gp_Pnt &query, detail::range *ranges) const override {
        detail::feet_on(base_, query, ranges[0], ranges[1]);
    }
    void convert(const detail::range *ranges) override {
        if (const auto found = detail::net_of(base_, ranges[0], ranges[1])) {
            shape_ = std::make_shared<const footpoint::surface>(detail::made(*found, place_));
            along_[0] = found->along[0];
            along_[1] = found->along[1];
        } else {
            shape_ = std::make_shared<const footpoint::surface>(detail::called(base_, ranges[0], ranges[1], place_));
            for (int k = 0; k < 2; k++) along_[k].used = along_[k].whole = ranges[k];
        }
        closed_ = {shape_->is_closed_u(), shape_->is_closed_v()};
        collapsed_ = shape_->collapsed_edges();
    }

    Handle(Geom_Surface) base_;
    double period_[2] = {0, 0};
    std::array<bool, 2> closed_{};
    std::array<bool, 4> collapsed_{};
};

/** What both projecting classes share. */
template <class Shape>
class projection {
public:
    void Perform(const gp_Pnt &P) {
        if (!shape_) throw StdFail_NotDone("Perform: Init was not called");
        query_ = P;
        nearest_ = shape_->closest(P);
        listed_.reset();
    }

    Standard_Integer NbPoints() const { return is_done() ? Standard_Integer(list().size()) : 0; }
    operator Standard_Integer() const { return NbPoints(); }
    gp_Pnt Point(const Standard_Integer Index) const { return at(Index).Point; }
    Standard_Real Distance(const Standard_Integer Index) const { return at(Index).Distance; }
    gp_Pnt NearestPoint() const { return lowest().Point; }
    operator gp_Pnt() const { return NearestPoint(); }
    Standard_Real LowerDistance() const { return lowest().Distance; }
    operator Standard_Real() const { return LowerDistance(); }

    /** Nothing on the shape is nearer than this. */
    Standard_Real LowerBound() const { return nearest().LowerBound; }
    /** Whether the nearest point is proven. */
    Standard_Boolean IsProven() const { return nearest().IsProven(); }
    /** Whether NbPoints counts all. */
    Standard_Boolean IsComplete() const {
        list();
        return listed_->IsComplete;
    }

protected:
    projection() = default;

    void load(Shape &&shape) {
        shape_.emplace(std::move(shape));
        nearest_.reset();
        listed_.reset();
    }
    bool is_done() const { return nearest_ && (nearest_->Flags & FPT_FOOT_BAD_QUERY) == 0; }
    const foot &nearest() const {
        if (!is_done()) throw StdFail_NotDone("no answer: nothing was asked, or the point is not finite");
        return *nearest_;
    }
    /** The nearest point; when only maxima are wanted, the nearest of those. */
    const foot &lowest() const { return wanted_ == Extrema_ExtFlag_MAX ? at(1) : nearest(); }

    /** All extrema, asked for when somebody wants them. */
    const std::vector<member> &list() const {
        const foot &first = nearest();
        if (!listed_) {
            extrema_options options;
            options.minima_only = wanted_ == Extrema_ExtFlag_MIN ? 1 : 0;
            listed_ = shape_->extrema(query_, options);
            std::vector<member> &all = listed_->List;
            // A list that is not complete may miss the nearest point.
            if (!listed_->IsComplete && (all.empty() || all.front().Distance > first.Distance)) {
                member added;
                static_cast<foot &>(added) = first;
                added.URange = {first.U, first.U};
                added.VRange = {first.V, first.V};
                all.insert(all.begin(), added);
            }
            if (wanted_ == Extrema_ExtFlag_MAX)
                all.erase(std::remove_if(all.begin(), all.end(), [](const member &m) { return m.Nature != FPT_NATURE_MAXIMUM; }),
                          all.end());
        }
        return listed_->List;
    }
    const foot &at(Standard_Integer index) const {
        const std::vector<member> &all = list();
        if (index < 1 || index > Standard_Integer(all.size())) throw Standard_OutOfRange("Index: less than 1 or more than NbPoints()");
        return all[std::size_t(index - 1)];
    }

    Extrema_ExtFlag wanted_ = Extrema_ExtFlag_MINMAX;
    mutable std::optional<Shape> shape_;
    gp_Pnt query_;
    std::optional<foot> nearest_;
    mutable std::optional<members> listed_;
};

/** The class of this name, see the head of this file. */
class GeomAPI_ProjectPointOnCurve : public projection<curve> {
public:
    GeomAPI_ProjectPointOnCurve() = default;
    GeomAPI_ProjectPointOnCurve(const gp_Pnt &P, const Handle(Geom_Curve) &Curve) { Init(P, Curve); }
    GeomAPI_ProjectPointOnCurve(const gp_Pnt &P, const Handle(Geom_Curve) &Curve, const Standard_Real Umin,
                                const Standard_Real Usup) {
        Init(P, Curve, Umin, Usup);
    }

    void Init(const gp_Pnt &P, const Handle(Geom_Curve) &Curve) {
        load(curve(Curve));
        Perform(P);
    }
    void Init(const gp_Pnt &P, const Handle(Geom_Curve) &Curve, const Standard_Real Umin, const Standard_Real Usup) {
        Init(Curve, Umin, Usup);
        Perform(P);
    }
    void Init(const Handle(Geom_Curve) &Curve, const Standard_Real Umin, const Standard_Real Usup) {
        load(curve(Curve, Umin, Usup));
    }

    Standard_Real Parameter(const Standard_Integer Index) const { return at(Index).U; }
    void Parameter(const Standard_Integer Index, Standard_Real &U) const { U = at(Index).U; }
    Standard_Real LowerDistanceParameter() const { return lowest().U; }
};

/** The class of this name, see the head of this file. */
class GeomAPI_ProjectPointOnSurf : public projection<surface> {
public:
    GeomAPI_ProjectPointOnSurf() = default;
    GeomAPI_ProjectPointOnSurf(const gp_Pnt &P, const Handle(Geom_Surface) &Surface,
                               const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface);
    }
    GeomAPI_ProjectPointOnSurf(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real,
                               const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface);
    }
    GeomAPI_ProjectPointOnSurf(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real Umin,
                               const Standard_Real Usup, const Standard_Real Vmin, const Standard_Real Vsup,
                               const Standard_Real, const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface, Umin, Usup, Vmin, Vsup);
    }
    GeomAPI_ProjectPointOnSurf(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real Umin,
                               const Standard_Real Usup, const Standard_Real Vmin, const Standard_Real Vsup,
                               const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface, Umin, Usup, Vmin, Vsup);
    }

    void Init(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real,
              const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface);
    }
    void Init(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        load(surface(Surface));
        Perform(P);
    }
    void Init(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real Umin, const Standard_Real Usup,
              const Standard_Real Vmin, const Standard_Real Vsup, const Standard_Real,
              const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface, Umin, Usup, Vmin, Vsup);
    }
    void Init(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real Umin, const Standard_Real Usup,
              const Standard_Real Vmin, const Standard_Real Vsup, const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(Surface, Umin, Usup, Vmin, Vsup);
        Perform(P);
    }
    void Init(const Handle(Geom_Surface) &Surface, const Standard_Real Umin, const Standard_Real Usup,
              const Standard_Real Vmin, const Standard_Real Vsup, const Standard_Real,
              const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(Surface, Umin, Usup, Vmin, Vsup);
    }
    void Init(const Handle(Geom_Surface) &Surface, const Standard_Real Umin, const Standard_Real Usup,
              const Standard_Real Vmin, const Standard_Real Vsup, const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        load(surface(Surface, Umin, Usup, Vmin, Vsup));
    }

    void SetExtremaAlgo(const Extrema_ExtAlgo) {}
    void SetExtremaFlag(const Extrema_ExtFlag theExtFlag) {
        wanted_ = theExtFlag;
        listed_.reset();
    }
    Standard_Boolean IsDone() const { return is_done(); }
    void Parameters(const Standard_Integer Index, Standard_Real &U, Standard_Real &V) const {
        const foot &found = at(Index);
        U = found.U, V = found.V;
    }
    void LowerDistanceParameters(Standard_Real &U, Standard_Real &V) const {
        const foot &found = lowest();
        U = found.U, V = found.V;
    }
};

/** The class of this name: everything of OCCT's, with projections by footpoint. See the head of this file. */
class ShapeAnalysis_Surface : public ::ShapeAnalysis_Surface {
public:
    explicit ShapeAnalysis_Surface(const Handle(Geom_Surface) &S) : ::ShapeAnalysis_Surface(S), shape_(S) {}

    void Init(const Handle(Geom_Surface) &S) {
        shape_ = surface(S);
        ::ShapeAnalysis_Surface::Init(S);
    }
    void Init(const Handle(::ShapeAnalysis_Surface) &other) {
        if (other.IsNull()) throw Standard_NullObject("other: null");
        shape_ = surface(other->Surface());
        ::ShapeAnalysis_Surface::Init(other);
    }
    void SetDomain(const Standard_Real U1, const Standard_Real U2, const Standard_Real V1, const Standard_Real V2) {
        shape_ = surface(Surface(), U1, U2, V1, V2);
        ::ShapeAnalysis_Surface::SetDomain(U1, U2, V1, V2);
    }

    /** The parameters of the nearest point. */
    gp_Pnt2d ValueOfUV(const gp_Pnt &P3D, const Standard_Real) { return taken(shape_.closest(P3D)); }
    /** The same, going on from the parameters before, as surface::next. */
    gp_Pnt2d NextValueOfUV(const gp_Pnt2d &p2dPrev, const gp_Pnt &P3D, const Standard_Real, const Standard_Real = -1.0) {
        return taken(shape_.next(p2dPrev, P3D));
    }

    /** Nothing on the surface is nearer to the point asked last than this. */
    Standard_Real LowerBound() const { return last_.LowerBound; }
    /** Whether the last answer is proven. */
    Standard_Boolean IsProven() const { return last_.IsProven(); }

private:
    gp_Pnt2d taken(const foot &found) {
        if ((found.Flags & FPT_FOOT_BAD_QUERY) != 0) throw StdFail_NotDone("P3D: not finite");
        last_ = found;
        myGap = found.Distance;
        return gp_Pnt2d(found.U, found.V);
    }

    surface shape_;
    foot last_;
};

/**
 * The class of this name: the curves that two bounded surfaces have in common, as B-splines within the tolerance; where a fit misses
 * it, and the chords between the points of the branch are proven to be nearer, as the polyline of these points. IsDone is false
 * when the budget ran out or something is left undecided: nothing is lost silently. Unbounded surfaces (planes, cylinders of
 * infinite length) must be trimmed, offsets of free forms are refused (Standard_ConstructionError). Contacts in points and areas
 * are in Intersection().
 */
class GeomAPI_IntSS {
public:
    GeomAPI_IntSS() = default;
    GeomAPI_IntSS(const Handle(Geom_Surface) &S1, const Handle(Geom_Surface) &S2, const Standard_Real Tol) { Perform(S1, S2, Tol); }

    void Perform(const Handle(Geom_Surface) &S1, const Handle(Geom_Surface) &S2, const Standard_Real Tol) {
        lines_.clear();
        found_.reset();
        const footpoint::surface a = bounded(S1, "S1"), b = bounded(S2, "S2");
        found_ = std::make_unique<surface_intersection>(a, b);
        for (std::size_t i = 0; i < found_->size(); i++) {
            const std::size_t before = lines_.size();
            for (std::size_t part = 0, count = 1; part < count; part++) {
                const Standard_Real tolerance = Tol > 0 ? Tol : Precision::Confusion();
                const branch_curves curves = found_->curves(a, b, i, tolerance, part);
                if (curves.error > tolerance && curves.error > found_->branch(i).chord) {
                    lines_.resize(before);
                    lines_.push_back(polyline(found_->points(i)));
                    break;
                }
                lines_.push_back(spline(curves.space));
                count = curves.part_count;
            }
        }
    }

    Standard_Boolean IsDone() const { return found_ && !found_->summary().is_exhausted && !found_->summary().undecided_count; }
    Standard_Integer NbLines() const {
        if (!found_) throw StdFail_NotDone("GeomAPI_IntSS: not performed");
        return Standard_Integer(lines_.size());
    }
    const Handle(Geom_Curve) &Line(const Standard_Integer Index) const {
        if (Index < 1 || Index > NbLines()) throw Standard_OutOfRange("Index: beyond NbLines");
        return lines_[std::size_t(Index) - 1];
    }
    /** Branches with parameters, contacts, overlaps, and whether all is proven. */
    const surface_intersection &Intersection() const {
        if (!found_) throw StdFail_NotDone("GeomAPI_IntSS: not performed");
        return *found_;
    }

private:
    static footpoint::surface bounded(const Handle(Geom_Surface) &shape, const char *name) {
        if (shape.IsNull()) throw Standard_NullObject((std::string(name) + ": null").c_str());
        detail::range u{}, v{};
        shape->Bounds(u.low, u.high, v.low, v.high);
        if (detail::open(u.low) || detail::open(u.high) || detail::open(v.low) || detail::open(v.high))
            detail::refuse(std::string(name) + ": is unbounded; trim it");
        const auto net = detail::net_of(detail::plain(detail::basis(shape)), u, v);
        if (!net) detail::refuse(std::string(name) + ": has no form with poles");
        return detail::made(*net, gp_Trsf());
    }

    static Handle(Geom_Curve) polyline(const std::vector<fpt_intersection_point> &list) {
        std::vector<gp_Pnt> places;
        for (const fpt_intersection_point &p : list) {
            const gp_Pnt place(p.point[0], p.point[1], p.point[2]);
            if (places.empty() || place.Distance(places.back()) > 0) places.push_back(place);
        }
        const Standard_Integer count = Standard_Integer(places.size());
        if (count < 2) detail::refuse("a branch in one point");
        TColgp_Array1OfPnt points(1, count);
        TColStd_Array1OfReal knots(1, count);
        TColStd_Array1OfInteger times(1, count);
        for (Standard_Integer k = 1; k <= count; k++) {
            points.SetValue(k, places[std::size_t(k) - 1]);
            knots.SetValue(k, k - 1);
            times.SetValue(k, k == 1 || k == count ? 2 : 1);
        }
        return new Geom_BSplineCurve(points, knots, times, 1);
    }

    static Handle(Geom_Curve) spline(const footpoint::curve &curve) {
        const std::vector<double> knots = curve.knots(), poles = curve.poles();
        TColgp_Array1OfPnt points(1, Standard_Integer(poles.size() / 3));
        for (std::size_t i = 0; i < poles.size() / 3; i++)
            points.SetValue(Standard_Integer(i) + 1, gp_Pnt(poles[3 * i], poles[3 * i + 1], poles[3 * i + 2]));
        std::vector<double> values;
        std::vector<int> times;
        for (const double k : knots) {
            if (!values.empty() && values.back() == k) times.back()++;
            else values.push_back(k), times.push_back(1);
        }
        TColStd_Array1OfReal places(1, Standard_Integer(values.size()));
        TColStd_Array1OfInteger repeats(1, Standard_Integer(values.size()));
        for (std::size_t i = 0; i < values.size(); i++)
            places.SetValue(Standard_Integer(i) + 1, values[i]), repeats.SetValue(Standard_Integer(i) + 1, times[i]);
        return new Geom_BSplineCurve(points, places, repeats, Standard_Integer(curve.degree()));
    }

    std::unique_ptr<surface_intersection> found_;
    std::vector<Handle(Geom_Curve)> lines_;
};

/** The class of this name, see the head of this file. */
class GeomAPI_IntCS {
public:
    GeomAPI_IntCS() = default;
    GeomAPI_IntCS(const Handle(Geom_Curve) &C, const Handle(Geom_Surface) &S) { Perform(C, S); }

    void Perform(const Handle(Geom_Curve) &C, const Handle(Geom_Surface) &S) {
        if (C.IsNull()) throw Standard_NullObject("C: null");
        if (S.IsNull()) throw Standard_NullObject("S: null");
        *this = GeomAPI_IntCS();
        curve_ = C;
        detail::range w{C->FirstParameter(), C->LastParameter()}, u{}, v{};
        S->Bounds(u.low, u.high, v.low, v.high);
        if (!bound(C, S, w, u, v) || !proven(C, S, w, u, v)) own_ = std::make_shared<::GeomAPI_IntCS>(C, S);
    }

    Standard_Boolean IsDone() const { return !curve_.IsNull() && (!own_ || own_->IsDone()); }
    Standard_Integer NbPoints() const { return own_ ? own_->NbPoints() : Standard_Integer(done(points_).size()); }
    const gp_Pnt &Point(const Standard_Integer Index) const { return own_ ? own_->Point(Index) : at(points_, Index).place; }
    void Parameters(const Standard_Integer Index, Standard_Real &U, Standard_Real &V, Standard_Real &W) const {
        if (own_) return own_->Parameters(Index, U, V, W);
        const hit &one = at(points_, Index);
        U = one.u[0], V = one.v[0], W = one.w[0];
    }
    Standard_Integer NbSegments() const { return own_ ? own_->NbSegments() : Standard_Integer(done(segments_).size()); }
    Handle(Geom_Curve) Segment(const Standard_Integer Index) const {
        if (own_) return own_->Segment(Index);
        const hit &one = at(segments_, Index);
        return new Geom_TrimmedCurve(curve_, one.w[0], one.w[1]);
    }
    /** Parameters on the surface at the ends of a segment. */
    void Parameters(const Standard_Integer Index, Standard_Real &U1, Standard_Real &V1, Standard_Real &U2, Standard_Real &V2) const {
        if (own_) return own_->Parameters(Index, U1, V1, U2, V2);
        const hit &one = at(segments_, Index);
        U1 = one.u[0], V1 = one.v[0], U2 = one.u[1], V2 = one.v[1];
    }

    /** Whether nothing is missing, with proof. */
    Standard_Boolean IsProven() const { return IsDone() && !own_ && is_complete_; }
    /** 1 at an angle, 2 or 3 where they touch; 0 when that is not known. */
    Standard_Integer Multiplicity(const Standard_Integer Index) const { return own_ ? 0 : at(points_, Index).multiplicity; }

private:
    struct hit {
        gp_Pnt place;
        std::array<Standard_Real, 2> u{}, v{}, w{};
        Standard_Integer multiplicity = 0;
    };

    const std::vector<hit> &done(const std::vector<hit> &list) const {
        if (!IsDone()) throw StdFail_NotDone("GeomAPI_IntCS: nothing was performed");
        return list;
    }
    const hit &at(const std::vector<hit> &list, Standard_Integer index) const {
        if (index < 1 || std::size_t(index) > done(list).size()) throw Standard_OutOfRange("Index: not between 1 and the number");
        return list[std::size_t(index - 1)];
    }

    /** Bounds the one that is not by the box of the other; false when neither is bounded. */
    static bool bound(const Handle(Geom_Curve) &C, const Handle(Geom_Surface) &S, detail::range &w, detail::range &u, detail::range &v) {
        const bool open_curve = detail::open(w.low) || detail::open(w.high);
        const bool open_surface = detail::open(u.low) || detail::open(u.high) || detail::open(v.low) || detail::open(v.high);
        if (!open_curve && !open_surface) return true;
        if (open_curve && open_surface) return false;
        Bnd_Box box;
        if (open_curve) {
            BndLib_AddSurface::Add(GeomAdaptor_Surface(S), 0, box);
        } else {
            BndLib_Add3dCurve::Add(GeomAdaptor_Curve(C), 0, box);
        }
        const gp_Pnt low = box.CornerMin(), high = box.CornerMax();
        const gp_Pnt centre((low.XYZ() + high.XYZ()) / 2);
        const Standard_Real reach = 1.001 * low.Distance(high) / 2 + 1e-6;
        const auto within = [](detail::range &r, Standard_Real middle, Standard_Real by) {
            r.low = std::max(r.low, middle - by);
            r.high = std::min(r.high, middle + by);
            return r.low < r.high;
        };
        if (open_curve) {
            const Handle(Geom_Line) line = Handle(Geom_Line)::DownCast(detail::basis(C));
            if (line.IsNull()) return false;
            const gp_Ax1 axis = line->Position();
            return within(w, gp_Vec(axis.Location(), centre).Dot(gp_Vec(axis.Direction())), reach);
        }
        const Handle(Geom_ElementarySurface) form = Handle(Geom_ElementarySurface)::DownCast(detail::basis(S));
        if (form.IsNull()) return false;
        const gp_Ax3 place = form->Position();
        const gp_Vec from(place.Location(), centre);
        if (form->IsKind(STANDARD_TYPE(Geom_Plane)))
            return within(u, from.Dot(gp_Vec(place.XDirection())), reach) && within(v, from.Dot(gp_Vec(place.YDirection())), reach);
        if (form->IsKind(STANDARD_TYPE(Geom_CylindricalSurface))) return within(v, from.Dot(gp_Vec(place.Direction())), reach);
        const Handle(Geom_ConicalSurface) cone = Handle(Geom_ConicalSurface)::DownCast(form);
        if (cone.IsNull()) return false;
        // Along a generatrix heights grow by the cosine of the half angle.
        const Standard_Real c = std::cos(cone->SemiAngle());
        return within(v, from.Dot(gp_Vec(place.Direction())) / c, reach / c);
    }

    bool proven(const Handle(Geom_Curve) &C, const Handle(Geom_Surface) &S, const detail::range &w, const detail::range &u,
                const detail::range &v) {
        const auto line = detail::profile_of(detail::basis(C), w);
        const auto sheet = detail::net_of(detail::plain(detail::basis(S)), u, v);
        if (!line || !sheet) return false;
        const auto found = detail::asked([&] {
            hit_options options;
            options.tolerance = Precision::Confusion();
            return intersect(detail::made(*sheet, gp_Trsf()), detail::made(*line, gp_Trsf()), options);
        });
        is_complete_ = found.undecided.empty();
        for (const fpt_curve_hit &one : found.hits) {
            hit out;
            out.place = gp_Pnt(one.point[0], one.point[1], one.point[2]);
            out.multiplicity = Standard_Integer(one.multiplicity);
            const bool runs = one.nature == FPT_HIT_OVERLAP;
            for (std::size_t k = 0; k < 2; k++) {
                out.u[k] = sheet->along[0].to_occt(runs ? one.u_range[k] : one.u);
                out.v[k] = sheet->along[1].to_occt(runs ? one.v_range[k] : one.v);
                out.w[k] = line->along.to_occt(runs ? one.w_range[k] : one.w);
            }
            if (runs && out.w[1] > out.w[0]) {
                // Which corner of the box of parameters belongs to which end.
                const gp_Pnt first = C->Value(out.w[0]);
                const auto swap_if_nearer = [&](std::array<Standard_Real, 2> &x, const gp_Pnt &here, const gp_Pnt &there) {
                    if (there.Distance(first) < here.Distance(first)) std::swap(x[0], x[1]);
                };
                swap_if_nearer(out.u, S->Value(out.u[0], out.v[0]), S->Value(out.u[1], out.v[0]));
                swap_if_nearer(out.v, S->Value(out.u[0], out.v[0]), S->Value(out.u[0], out.v[1]));
                segments_.push_back(out);
            } else {
                points_.push_back(out);
            }
        }
        return true;
    }

    Handle(Geom_Curve) curve_;
    std::vector<hit> points_, segments_;
    std::shared_ptr<const ::GeomAPI_IntCS> own_;
    bool is_complete_ = false;
};

} // namespace footpoint::occt

#endif
