// What scan-to-CAD tools do: CGAL's tree on a mesh at 1e-3 of the diagonal ("mesh"), and what a good engineer makes of it in
// a day: parameters interpolated on the triangle, then Newton's method ("mesh_newton").
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "mesh.h"
#include "newton.h"
#include "peer.h"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <type_traits>

namespace {

constexpr double DEFLECTION = 1e-3;

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;

Vec vec_of(const Point &p) { return {p.x(), p.y(), p.z()}; }
Point point_of(const Vec &p) { return Point(p[0], p[1], p[2]); }

// Weights of the second and third corner of the face at a point on it.
Pair shares(const Vec &a, const Vec &b, const Vec &c, const Vec &p) {
    const Vec x = minus(b, a), y = minus(c, a), r = minus(p, a);
    const double xx = dot(x, x), xy = dot(x, y), yy = dot(y, y), rx = dot(r, x), ry = dot(r, y);
    const double area = xx * yy - xy * xy;
    return area > 0.0 ? Pair{(rx * yy - ry * xy) / area, (ry * xx - rx * xy) / area} : Pair{rx / xx, 0.0};
}

template <class Datum, template <class, class, class> class Primitive>
class Lookup : public Peer {
    using Iterator = typename std::vector<Datum>::const_iterator;
    using Traits = CGAL::AABB_traits<Kernel, Primitive<Kernel, Iterator, CGAL::Tag_false>>;

public:
    Lookup(const Geometry &g, bool iterate)
        : shape_(g), mesh_(mesh_of(shape_, DEFLECTION * shape_.diagonal())), iterate_(iterate) {}

    Answer ask(const Vec &query, const Pair &) override {
        const auto [point, face] = tree_.closest_point_and_primitive(point_of(query));
        const Vec foot = vec_of(point);
        if (!iterate_) {
            return {true, false, {0, 0}, norm(minus(foot, query))};
        }
        const auto &corners = mesh_.faces[size_t(face - data_.begin())];
        const auto corner = [&](size_t k) { return mesh_.points[size_t(corners[k])]; };
        const auto place = [&](size_t k) { return mesh_.places[size_t(corners[k])]; };
        const Pair share = shares(corner(0), corner(1), corner(2), foot);
        Pair at;
        for (size_t k = 0; k < 2; k++) {
            at[k] = place(0)[k] + share[0] * (place(1)[k] - place(0)[k]) + share[1] * (place(2)[k] - place(0)[k]);
            at[k] = std::clamp(at[k], std::min({place(0)[k], place(1)[k], place(2)[k]}),
                               std::max({place(0)[k], place(1)[k], place(2)[k]}));
        }
        return {true, true, newton(shape_, at, query), 0.0};
    }

    // False when there is no mesh.
    bool build() {
        for (const auto &face : mesh_.faces) {
            data_.push_back(datum(face));
        }
        tree_.insert(data_.begin(), data_.end());
        tree_.build();
        tree_.accelerate_distance_queries();
        return !data_.empty();
    }

private:
    Datum datum(const std::array<int, 3> &face) const {
        const Point a = point_of(mesh_.points[size_t(face[0])]), b = point_of(mesh_.points[size_t(face[1])]);
        if constexpr (std::is_same_v<Datum, Kernel::Segment_3>) {
            return Datum(a, b);
        } else {
            return Datum(a, b, point_of(mesh_.points[size_t(face[2])]));
        }
    }

    Spline shape_;
    Mesh mesh_;
    bool iterate_;
    std::vector<Datum> data_;
    CGAL::AABB_tree<Traits> tree_;
};

template <class Made>
std::unique_ptr<Peer> built(const Geometry &g, bool iterate) {
    auto peer = std::make_unique<Made>(g, iterate);
    return peer->build() ? std::move(peer) : nullptr;
}

} // namespace

std::unique_ptr<Peer> make_peer(const std::string &name, const Geometry &g) {
    const bool iterate = name == "mesh_newton";
    if (!iterate && name != "mesh") {
        return nullptr;
    }
    return g.is_curve ? built<Lookup<Kernel::Segment_3, CGAL::AABB_segment_primitive>>(g, iterate)
                      : built<Lookup<Kernel::Triangle_3, CGAL::AABB_triangle_primitive>>(g, iterate);
}
