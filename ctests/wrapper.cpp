// The C++17 layer: owners that move, errors that are thrown, vectors that are checked, answers that are the C API's.
#include <footpoint.hpp>

#include "samples.h"

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using footpoint::curve;
using footpoint::surface;

static_assert(!std::is_copy_constructible_v<curve> && !std::is_copy_assignable_v<surface>);
static_assert(std::is_nothrow_move_constructible_v<curve> && std::is_nothrow_move_assignable_v<surface>);
static_assert(std::is_trivially_copyable_v<fpt_foot_point>);

// A call must throw the status, with a text that contains the words.
template <class Call> void check_thrown(Call call, fpt_status status, const std::string &words) {
    try {
        call();
        CHECK_MESSAGE(false, "nothing was thrown, expected %s", words.c_str());
    } catch (const footpoint::error &error) {
        CHECK_MESSAGE(error.status() == status, "%s instead of %s", error.status_name(), fpt_status_name(status));
        CHECK_MESSAGE(std::string(error.what()).find(words) != std::string::npos, "the text is \"%s\"", error.what());
    }
}

struct description {
    std::vector<double> knots_u, knots_v, poles, weights;
};

description paper_vectors() {
    const fpt_surface_data data = paper_surface(1);
    return {{data.knots_u, data.knots_u + 11},
            {data.knots_v, data.knots_v + 8},
            {data.poles, data.poles + 84},
            {data.weights, data.weights + 28}};
}

surface paper() {
    const description d = paper_vectors();
    return surface(3, 3, d.knots_u, d.knots_v, d.poles, d.weights);
}

curve circle() {
    return curve(circle_curve());
}

bool same(const fpt_foot_point &a, const fpt_foot_point &b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void answers_are_those_of_the_c_api() {
    const surface shape = paper();
    const curve round = circle();
    const std::vector<double> points{300, 250, 100, 0, 0, 0, 575, 400, 0};
    fpt_foot_point c[3];
    CHECK_OK(fpt_surface_closest(shape.get(), points.data(), 3, nullptr, c));
    const auto feet = shape.closest(points);
    CHECK(feet.size() == 3 && same(feet[0], c[0]) && same(feet[1], c[1]) && same(feet[2], c[2]));
    CHECK_OK(fpt_surface_invert(shape.get(), points.data(), 3, nullptr, c));
    const auto inverted = shape.invert(points);
    CHECK(inverted.size() == 3 && same(inverted[0], c[0]) && same(inverted[2], c[2]));
    CHECK(inverted[0].flags & FPT_FOOT_NOT_ON_SHAPE);
    CHECK_OK(fpt_curve_closest(round.get(), points.data(), 3, nullptr, c));
    CHECK(same(round.closest(points)[1], c[1]));
    CHECK_OK(fpt_curve_invert(round.get(), points.data(), 3, nullptr, c));
    CHECK(same(round.invert(points)[2], c[2]));
    CHECK(shape.closest({}).empty());
    footpoint::query_options options;
    options.point_stride = 6 * sizeof(double);
    options.threads = 1;
    const std::vector<double> with_normals{300, 250, 100, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    const auto strided = shape.closest(with_normals, options);
    CHECK(strided.size() == 2 && same(strided[0], feet[0]) && same(strided[1], feet[1]));
}

void the_callers_own_records_are_filled() {
    const surface shape = paper();
    const curve round = circle();
    const double point[3] = {300, 250, 100};
    fpt_foot_point foot, again;
    shape.closest(point, 1, nullptr, &foot);
    CHECK(same(foot, shape.closest({300, 250, 100})[0]));
    shape.invert(point, 1, nullptr, &again);
    CHECK(again.distance == foot.distance);
    round.closest(point, 1, nullptr, &foot);
    round.invert(point, 1, nullptr, &again);
    CHECK(again.distance == foot.distance);
}

void inputs_come_back() {
    const description d = paper_vectors();
    const surface shape = paper();
    CHECK(shape.degree_u() == 3 && shape.degree_v() == 3 && shape.pole_count_u() == 7 && shape.pole_count_v() == 4);
    CHECK(shape.knots_u() == d.knots_u && shape.knots_v() == d.knots_v);
    CHECK(shape.poles() == d.poles && shape.weights() == d.weights);
    CHECK(shape.is_rational() && !shape.is_closed_u() && !shape.is_closed_v());
    CHECK(shape.domain()[1] == 1 && shape.box()[3] == 575);
    const surface cone(cone_surface());
    CHECK(cone.is_closed_u() && cone.collapsed_edges()[3] && !cone.collapsed_edges()[0]);
    const curve round = circle();
    CHECK(round.degree() == 2 && round.pole_count() == 9 && round.knots().size() == 12);
    CHECK(round.poles()[0] == 3 && round.weights()[0] == 1);
    CHECK(round.is_rational() && round.is_closed() && round.domain()[1] == 4 && round.box()[0] == -1);
}

void evaluations_are_those_of_the_c_api() {
    const surface shape = paper();
    const curve round = circle();
    shape.prepare();
    round.prepare();
    double out[18];
    CHECK_OK(fpt_surface_evaluate(shape.get(), 0.3, 0.7, 2, out));
    const auto partials = shape.evaluate(0.3, 0.7, 2);
    CHECK(partials.size() == 18 && std::memcmp(partials.data(), out, sizeof out) == 0);
    const auto twice = shape.evaluate_many({0.1, 0.2, 0.3, 0.7}, 2);
    CHECK(twice.size() == 36 && std::memcmp(twice.data() + 18, out, sizeof out) == 0);
    CHECK_OK(fpt_curve_evaluate(round.get(), 1.5, 1, out));
    const auto derivatives = round.evaluate(1.5, 1);
    CHECK(derivatives.size() == 6 && std::memcmp(derivatives.data(), out, 6 * sizeof *out) == 0);
    CHECK(round.evaluate_many({0.5, 1.5, 2.5}).size() == 9);
    CHECK(round.evaluate(0).size() == 3);
}

void handles_move_and_are_handed_over() {
    surface first = paper();
    surface second = std::move(first);
    CHECK(first.get() == nullptr && second.get() != nullptr);
    check_thrown([&] { first.domain(); }, FPT_NULL_ARGUMENT, "surface");
    first = std::move(second);
    CHECK(first.domain()[1] == 1);
    fpt_surface *raw = first.release();
    CHECK(raw != nullptr && first.get() == nullptr);
    const surface third(raw);
    CHECK(third.pole_count_u() == 7);
    std::vector<curve> many;
    for (int i = 0; i < 10; i++) many.push_back(circle());
    many.erase(many.begin() + 3);
    CHECK(many.size() == 9 && many.back().closest({6, 0, 0})[0].distance == 3);
}

void failures_are_thrown() {
    const description d = paper_vectors();
    const surface shape = paper();
    auto knots = d.knots_u;
    knots[5] = 0.1;
    check_thrown([&] { surface(3, 3, knots, d.knots_v, d.poles, d.weights); }, FPT_INVALID_ARGUMENT, "knots_u");
    auto poles = d.poles;
    poles[3 * 17 + 1] = NAN;
    check_thrown([&] { surface(3, 3, d.knots_u, d.knots_v, poles); }, FPT_INVALID_ARGUMENT, "(4, 1)");
    poles.pop_back();
    check_thrown([&] { surface(3, 3, d.knots_u, d.knots_v, poles); }, FPT_INVALID_ARGUMENT, "poles");
    check_thrown([&] { surface(3, 3, d.knots_u, d.knots_v, d.poles, {1, 1}); }, FPT_INVALID_ARGUMENT, "weights");
    check_thrown([&] { surface(3, 3, {0, 1}, d.knots_v, d.poles); }, FPT_INVALID_ARGUMENT, "knots_u");
    check_thrown([&] { surface(3, SIZE_MAX, d.knots_u, d.knots_v, d.poles); }, FPT_INVALID_ARGUMENT, "knots_v");
    check_thrown([&] { curve(3, {0, 0, 1, 1}, {0, 0, 0}); }, FPT_INVALID_ARGUMENT, "knots");
    check_thrown([&] { curve(1, {0, 0, 1, 1}, {0, 0, 0, 1}); }, FPT_INVALID_ARGUMENT, "poles");
    check_thrown([&] { shape.evaluate(2, 0); }, FPT_INVALID_ARGUMENT, "u");
    check_thrown([&] { shape.evaluate(0, 0, 32); }, FPT_INVALID_ARGUMENT, "derivatives");
    check_thrown([&] { shape.evaluate_many({0.5}); }, FPT_INVALID_ARGUMENT, "parameters");
    check_thrown([&] { shape.closest({1, 2}); }, FPT_INVALID_ARGUMENT, "points");
    footpoint::query_options options;
    options.method = 77;
    check_thrown([&] { shape.closest({1, 2, 3}, options); }, FPT_INVALID_ARGUMENT, "method");
}

void a_stop_is_thrown_and_the_records_stay() {
    const surface shape = paper();
    footpoint::query_options options;
    options.should_stop = [](void *) { return 1; };
    const double point[3] = {300, 250, 100};
    fpt_foot_point foot;
    check_thrown([&] { shape.closest(point, 1, &options, &foot); }, FPT_CANCELLED, "");
    CHECK(std::isnan(foot.distance) && foot.lower_bound == 0 && (foot.flags & FPT_FOOT_NOT_PROVEN));
}

// A function may hold anything and throw; its copy goes with the handle.
void functions_make_shapes() {
    const auto held = std::make_shared<double>(2.0);
    {
        const curve round = curve::from_function(
            [held](double u, std::uint32_t, double *out) {
                if (u > 3 && u < 3.01) throw std::runtime_error("a hole");
                out[0] = *held * std::cos(u);
                out[1] = *held * std::sin(u);
                out[2] = 0;
                return 0;
            },
            {0, 6.283185307179586}, 0, 2);
        CHECK(held.use_count() > 1 && round.is_closed());
        CHECK_NEAR(round.closest({3, 0, 0})[0].distance, 1, 1e-12);
        check_thrown([&] { round.evaluate(3.005); }, FPT_INVALID_ARGUMENT, "failed at");
        check_thrown([&] { round.degree(); }, FPT_UNSUPPORTED, "given by a function");
    }
    CHECK(held.use_count() == 1);
    const surface plane = surface::from_function(
        [](double u, double v, std::uint32_t, double *out) {
            out[0] = u;
            out[1] = v;
            out[2] = 0;
            return 0;
        },
        {0, 1, 0, 1}, {}, {1e-9, 0, 0});
    const fpt_foot_point foot = plane.closest({0.5, 2, 0})[0];
    CHECK(foot.v == 1 && (foot.flags & FPT_FOOT_NOT_PROVEN) == 0);
    check_thrown([] { curve::from_function(nullptr, {0, 1}); }, FPT_NULL_ARGUMENT, "evaluate");
    const auto fails = [](double, std::uint32_t, double *) { return -1; };
    check_thrown([&] { curve::from_function(fails, {0, 1}); }, FPT_INVALID_ARGUMENT, "finite");
}

void sets_are_those_of_the_c_api() {
    const surface cone(cone_surface());
    const curve round = circle();
    const footpoint::point apex{1, 0, 3}, seam{3, 0, 0}, beside{4, 0, 2};
    const footpoint::foot_set tip = cone.preimage(apex);
    CHECK(tip.size() == 1 && !tip.empty() && tip.is_complete() && tip[0].kind == FPT_MEMBER_ARC_U);
    CHECK(round.preimage(seam).size() == 2 && round.preimage({9, 9, 9}).empty());
    const auto all = cone.extrema(beside);
    fpt_foot_set *raw = nullptr;
    CHECK_OK(fpt_surface_extrema(cone.get(), beside.data(), nullptr, &raw));
    const footpoint::foot_set same_set(raw);
    CHECK(all.size() == same_set.size() && all.undecided().empty());
    std::size_t count = 0;
    for (const fpt_foot_member &member : all) {
        const fpt_foot_member other = same_set[count++];
        CHECK(std::memcmp(&member, &other, sizeof member) == 0);
    }
    CHECK(count == all.size());
    footpoint::extrema_options options;
    options.nearest = 1;
    CHECK(cone.extrema(beside, options).size() == 1 && round.extrema(beside, options).size() == 1);
    const auto line = round.on_line({-9, 0, 0}, {1, 0, 0});
    CHECK(line.size() == 3 && line[0].foot.u == 2);
    CHECK(round.on_line({-9, 0, 0}, {1, 0, 0}, {10, 13}).size() == 2);
    CHECK(cone.on_line({-9, 0, 1.5}, {1, 0, 0}).size() == 3);
    const auto below = cone.project({2, 0, 9, 0, 0, 9}, {0, 0, 1});
    CHECK(below.size() == 2 && below[0].distance > 7.4 && below[0].distance < 7.6);
    CHECK(round.project({-7, 0, 0}, {1, 0, 0})[0].distance == 6);
}

void an_incomplete_set_is_a_set_and_other_failures_are_thrown() {
    const surface shape = paper();
    const curve round = circle();
    footpoint::extrema_options few;
    few.budget = 1;
    const auto part = shape.extrema({300, 250, 100}, few);
    CHECK(!part.is_complete() && !part.undecided().empty());
    check_thrown([&] { part[part.size()]; }, FPT_INVALID_ARGUMENT, "index");
    check_thrown([&] { shape.preimage({NAN, 0, 0}); }, FPT_INVALID_ARGUMENT, "point");
    check_thrown([&] { shape.preimage({0, 0, 0}, -1); }, FPT_INVALID_ARGUMENT, "tolerance");
    check_thrown([&] { round.on_line({0, 0, 0}, {0, 0, 0}); }, FPT_INVALID_ARGUMENT, "direction");
    check_thrown([&] { round.on_line({0, 0, 0}, {0, 0, 1}, {1, 0}); }, FPT_INVALID_ARGUMENT, "reach");
    check_thrown([&] { round.project({0, 0}, {0, 0, 1}); }, FPT_INVALID_ARGUMENT, "points");
    few.radius = -1;
    check_thrown([&] { round.extrema({0, 0, 0}, few); }, FPT_INVALID_ARGUMENT, "radius");
    footpoint::foot_set moved = round.preimage({3, 0, 0});
    footpoint::foot_set other = std::move(moved);
    CHECK(other.size() == 2);
    check_thrown([&] { moved.size(); }, FPT_NULL_ARGUMENT, "set");
    fpt_foot_set *raw = other.release();
    CHECK(raw != nullptr && other.get() == nullptr);
    fpt_foot_set_free(raw);
}

void normals_and_paths_are_those_of_the_c_api() {
    const surface shape = paper();
    const curve round = circle();
    const std::vector<double> points{300, 250, 100, 320, 260, 100, 575, 400, 0};
    const auto feet = shape.closest(points);
    double normals[9], distances[3], extents[6];
    uint32_t flags[3];
    CHECK_OK(fpt_surface_normals(shape.get(), points.data(), feet.data(), 3, normals, distances, flags));
    const footpoint::directions found = shape.normals(points, feet);
    CHECK_SAME_BITS(found.vectors.data(), normals, sizeof normals);
    CHECK_SAME_BITS(found.signed_distances.data(), distances, sizeof distances);
    CHECK_SAME_BITS(found.flags.data(), flags, sizeof flags);
    CHECK_OK(fpt_surface_uncertainty(shape.get(), feet.data(), 3, 0, extents));
    CHECK_SAME_BITS(shape.uncertainty(feet).data(), extents, sizeof extents);
    CHECK(shape.path(points).unwrapped.size() == 6 && shape.path(points).feet[2].u == feet[2].u);
    CHECK(shape.unwrap({5, 5}, {0.5, 0.25})[1] == 0.25);
    CHECK(shape.evaluate_sided(0.25, 0.5, -1, 1).size() == 9);
    const auto on_circle = round.closest({5, 1, 0, -1, 5, 0});
    CHECK(round.tangents(on_circle).vectors.size() == 6 && round.uncertainty(on_circle, 1e-3)[0] < 1e-2);
    CHECK(round.unwrap(9, 0.5) == 8.5 && round.evaluate_sided(1, -1, 0) == round.evaluate_sided(1, -1, 0));
    CHECK(round.path({5, 1, 0, -1, 5, 0}).changes.size() == 2);
    check_thrown([&] { shape.normals({1, 2, 3}, feet); }, FPT_INVALID_ARGUMENT, "points");
}

void scenes_are_those_of_the_c_api() {
    const footpoint::placement aside{1, 0, 0, 700, 0, 1, 0, 0, 0, 0, 1, 0};
    std::vector<fpt_scene_member> members;
    footpoint::scene scene(static_cast<fpt_scene *>(nullptr));
    {
        const surface shape = paper();
        const curve round = circle();
        members = {footpoint::scene::member(shape), footpoint::scene::member(shape, aside),
                   footpoint::scene::member(round, aside)};
        scene = footpoint::scene(members);
    }
    scene.prepare();
    CHECK(scene.size() == 3 && scene.memory() > 10000 && scene.box()[3] > 1000);
    CHECK(scene.placement_of(1) == aside && scene.shape_of(0).second.degree_u() == 3);
    CHECK(scene.shape_of(2).first.get() != nullptr && scene.shape_of(2).second.get() == nullptr);
    const std::vector<double> points{300, 250, 90, 1000, 250, 90, 701, 5, 0};
    const footpoint::scene_feet found = scene.closest(points);
    CHECK(found.members == std::vector<std::uint32_t>({0, 1, 2}));
    CHECK_NEAR(found.feet[0].distance, found.feet[1].distance, 1e-9);
    CHECK(scene.evaluate(1, found.feet[1].u, found.feet[1].v)[0] == found.feet[1].point[0]);
    const footpoint::scene_feet single = scene.closest_f32(std::vector<float>(points.begin(), points.end()));
    for (std::size_t i = 0; i < 3; i++) CHECK(same(found.feet[i], single.feet[i]));
    const std::vector<float> near{300, 250, 90};
    CHECK(same(scene.shape_of(0).second.closest_f32(near)[0], scene.shape_of(0).second.closest({300, 250, 90})[0]));
    CHECK(same(circle().invert_f32(near)[0], circle().invert({300, 250, 90})[0]));
    const footpoint::scene_feet hinted = scene.invert(points, footpoint::query_options(), found.members);
    CHECK(hinted.feet[2].flags & FPT_FOOT_HINT_USED && hinted.feet[2].flags & FPT_FOOT_NOT_ON_SHAPE);
    const footpoint::directions normals = scene.normals(points, found);
    CHECK(std::isnan(normals.vectors[6]) && std::fabs(normals.signed_distances[1]) == found.feet[1].distance);
    CHECK(scene.invert_f32({300, 250, 90}).members[0] == 0);
    check_thrown([&] { scene.closest(points, footpoint::query_options(), {0}); }, FPT_INVALID_ARGUMENT, "hint_members");
    check_thrown([&] { footpoint::scene empty(std::vector<fpt_scene_member>{}); }, FPT_INVALID_ARGUMENT, "members");
}

void arrays_of_all_kinds_are_spans() {
    const surface shape = paper();
    const std::vector<double> vector{300, 250, 100, 0, 0, 0};
    const std::array<double, 6> array{300, 250, 100, 0, 0, 0};
    const double plain[6] = {300, 250, 100, 0, 0, 0};
    const auto feet = shape.closest(vector);
    for (const auto &other : {shape.closest(array), shape.closest(plain), shape.closest({300, 250, 100, 0, 0, 0}),
                              shape.closest(footpoint::span<const double>(plain, 6)), shape.closest({plain, 6})}) {
        CHECK(other.size() == 2 && same(other[0], feet[0]) && same(other[1], feet[1]));
    }
    CHECK(shape.closest(footpoint::span<const double>()).empty());
    check_thrown([&] { shape.closest(footpoint::span<const double>(plain, 5)); }, FPT_INVALID_ARGUMENT, "points");
    double sum = 0;
    for (const double x : footpoint::span<const double>(plain)) sum += x;
    CHECK(sum == 650 && footpoint::span<const double>(vector)[1] == 250);
}

void normals_without_sides_and_derivatives_in_scenes() {
    const surface shape = paper();
    const curve round = circle();
    const std::vector<double> points{300, 250, 100, 100, 100, -50};
    const auto feet = shape.closest(points);
    const footpoint::directions with = shape.normals(points, feet), without = shape.normals(feet);
    CHECK(with.vectors == without.vectors && without.signed_distances.empty());
    const footpoint::scene scene({footpoint::scene::member(shape), footpoint::scene::member(round)});
    const auto found = scene.closest(points);
    CHECK(scene.normals(points, found).vectors.size() == 6 && scene.normals(found).signed_distances.empty());
    CHECK(scene.evaluate(0, feet[0].u, feet[0].v, 2) == shape.evaluate(feet[0].u, feet[0].v, 2));
    CHECK(scene.evaluate(1, 0.25, 0, 3) == round.evaluate(0.25, 3));
    check_thrown([&] { scene.evaluate(2, 0, 0, 1); }, FPT_INVALID_ARGUMENT, "member");
    check_thrown([&] { scene.evaluate(0, 0.5, 0.5, 32); }, FPT_INVALID_ARGUMENT, "derivatives");
    fpt_foot_point records[2];
    std::uint32_t members[2];
    scene.closest(points.data(), 2, nullptr, nullptr, records, members);
    CHECK(same(records[1], found.feet[1]) && members[1] == found.members[1]);
}

// Ten thousand calls with any numbers at all: footpoint::error or an answer.
void misuse_throws() {
    const double odd[] = {0, -0.0, 1, -1, 0.5, 1e-300, 1e300, -1e300, NAN, HUGE_VAL, -HUGE_VAL, 250, 1e100};
    unsigned state = 1;
    const auto next = [&](unsigned limit) {
        state = state * 1664525u + 1013904223u;
        return (state >> 8) % limit;
    };
    const auto some = [&] { return odd[next(13)]; };
    const auto list = [&](unsigned most) {
        std::vector<double> out(next(most));
        for (double &x : out) x = some();
        return out;
    };
    // Three in four are whole points.
    const auto points = [&] {
        std::vector<double> out(3 * next(4) + (next(4) == 0 ? 1 : 0));
        for (double &x : out) x = some();
        return out;
    };
    const surface shape = paper();
    const curve round = circle();
    int answers = 0, refusals = 0;
    for (int i = 0; i < 10000; i++) {
        try {
            switch (i % 10) {
            case 0: curve(next(6), list(12), list(20), list(7)); break;
            case 1: surface(next(4), next(4), list(9), list(9), list(40), list(12)); break;
            case 2: (void)shape.evaluate(some(), some(), next(40)); break;
            case 3: (void)round.evaluate_many(list(6), next(40)); break;
            case 4: (void)shape.closest(points()); break;
            case 5: (void)round.preimage({some(), some(), some()}, some()); break;
            case 6: (void)shape.on_line({some(), some(), some()}, {some(), some(), some()}, {some(), some()}, some()); break;
            case 7: {
                footpoint::query_options options;
                options.accuracy = some(), options.tolerance = some(), options.method = next(6), options.scope = next(4);
                options.point_stride = next(60), options.reserved = next(20) == 0, options.struct_size = next(9) == 0 ? next(sizeof options + 1) : sizeof options;
                for (double &x : options.domain) x = next(3) == 0 ? some() : 0;
                (void)shape.invert(points(), options);
                break;
            }
            case 8: (void)round.path(points()); (void)round.unwrap(some(), some()); break;
            default: {
                std::vector<fpt_foot_point> feet(next(3));
                for (fpt_foot_point &foot : feet) foot.u = some(), foot.v = some();
                (void)shape.normals(points(), feet);
            }
            }
            answers++;
        } catch (const footpoint::error &failure) {
            CHECK(failure.status() != FPT_OK && failure.status() != FPT_INTERNAL && failure.what()[0] != 0);
            refusals++;
        }
    }
    CHECK(answers > 1000 && refusals > 1000);
}

void weights_are_those_of_the_c_api() {
    const footpoint::curve corner(2, {0, 0, 0, 1, 1, 1}, {1, 0, 0, 1, 1, 0, 0, 1, 0});
    const double half = std::sqrt(0.5);
    const auto report = footpoint::weights_report::refine(corner, {{1, std::sqrt(2.0) - 1}});
    CHECK(report.size() == 3 && report.is_met());
    CHECK_NEAR(report.weights()[1], half, 1e-12);
    CHECK(report[1].state == FPT_WISH_MET && report.summary().met == 1);
    CHECK_NEAR(footpoint::conic({1, 0, 0, 1, 1, 0, 0, 1, 0}, {1, report.weights()[1], 1}).eccentricity, 0, 1e-6);
    CHECK(report.as_curve().is_rational());
    CHECK_NEAR(footpoint::weights_report::general(corner, {0.5, 0.25, 0.5}).weights()[1], 3, 1e-14);
    CHECK_NEAR(footpoint::weights_report::interpolated(corner, 0.2, 0.2).weights()[1], half / 0.2 - 1, 1e-12);
    CHECK_NEAR(footpoint::weights_report::network(corner, {{1, 0.2}}, 0.1, 0.3).weights()[1], half / 0.2 - 1, 1e-12);
    fpt_weights_constraint at{};
    at.kind = FPT_CONSTRAINT_POINT;
    at.vector[0] = at.vector[1] = 0.8;
    CHECK(footpoint::weights_report::refine(corner, {}, {at}).constraint(0).met == 1);
    const auto edit = footpoint::weight_through_point(corner, 1, {0.8, 0.8, 0});
    CHECK(edit.foot.distance < 1e-12 && edit.weight > 1);
    CHECK_NEAR(footpoint::move_point(corner, 0.5, 1, std::sqrt(2.0) * 0.05), edit.weight, 1e-12);
    CHECK_NEAR(footpoint::weight_of_rho(0.5), 1, 0);
    CHECK(footpoint::weights_of_eccentricity({1, 0, 0, 1, 1, 0, 0, 1, 0}, 1).size() == 1);
    CHECK(footpoint::normalised_weights({2, 4}, FPT_UNIT_FIRST)[1] == 2);
    CHECK(footpoint::bounded_weights({1, 9}, 1)[0] == footpoint::bounded_weights({1, 9}, 1)[1]);
    CHECK(footpoint::standard_form(report.as_curve()).weights()[2] == 1);
    const auto rest = footpoint::positive_form(2, {0, 0, 0, 1, 1, 1}, {1, 0, 0, 1, -half, -half, 0, -half, 0, 1, 0, 1});
    CHECK(rest.weights()[1] > 0);
}

void trims_are_those_of_the_c_api() {
    const double pi = 3.14159265358979323846;
    footpoint::elementary_data data(FPT_ELEMENTARY_SPHERE, {0, 2 * pi, -pi / 2, pi / 2});
    data.first = 2;
    const footpoint::support sphere(data);
    CHECK(sphere.domain()[1] == 2 * pi && sphere.evaluate({0, 0})[0] == 2);
    const footpoint::circle_forms arcs{0, 2};
    const footpoint::support form(sphere.spline(arcs));
    const footpoint::transform exact = sphere.spline_transform(arcs), found = sphere.match(form);
    CHECK(exact.keeps_direction() && exact.image()[1] == 1 && exact.domain()[3] == pi / 2);
    const auto there = exact({1, 0.5}), back = exact.inverse()(there), also = found({1, 0.5});
    CHECK_NEAR(back[0], 1, 1e-14);
    CHECK_NEAR(also[0], there[0], 1e-12);
    CHECK_NEAR(exact.then(exact.inverse())({1, 0.5})[1], 0.5, 1e-15);
    CHECK_NEAR(sphere.match(form, {1, 0.5}).front().v, there[1], 1e-12);
    CHECK(sphere.spline().domain()[1] == 1 && sphere.spline_transform().image()[1] == 1);
    const footpoint::trimmed_surface face(sphere);
    CHECK(face.edge_count() == 3 && face.loop_count() == 1 && face.coedge_count(0) == 4);
    CHECK(!face.is_inner(0) && !face.is_flipped() && face.coedge(0, 0).kind == FPT_PCURVE_ISOLINE);
    CHECK(face.edge_point(0)[2] == -2);
    CHECK_NEAR(face.evaluate(0, 1, 0.5)[0], 2, 1e-15);
    fpt_change_summary summary{};
    const auto nurbs = face.to_nurbs(arcs, footpoint::change_options(), &summary);
    CHECK(summary.proven == 1 && summary.deviation == 0);
    CHECK(nurbs.to_elementary(sphere, arcs).report().findings.empty());
    CHECK(face.change(exact, form).report().summary.finding_count == 0);
    const footpoint::relation turn = footpoint::relation::linear({0, 1}, {1, 0});
    const footpoint::relation stay = footpoint::relation::through({0, 0.5, 1}, {0, 0.5, 1});
    CHECK(turn.then(turn)(0.25) == 0.25 && turn.inverse()(0.25) == 0.75);
    CHECK(nurbs.reparametrise(footpoint::transform(turn, stay)).is_flipped());
    CHECK(face.follow(form).loop_count() == 1);
    CHECK(footpoint::trimmed_surface::from_json(face.json()).json() == face.json());
    CHECK(face.picture("whole").find("whole") != std::string::npos);
    CHECK(face.support().domain() == sphere.domain());
    const auto half = footpoint::relation::circle(0, pi, {0, 1}, {0, 1});
    const fpt_relation *const pieces[] = {half.get()};
    CHECK(footpoint::relation::piecewise(pieces).domain().second[1] == 1);
    CHECK_NEAR(half(0.25), 2 / pi * std::atan2(0.25, 0.75), 1e-15);
    const auto square = footpoint::relation::from_function([](double x) { return x * x; },
                                                           [](double y) { return std::sqrt(y); }, {1, 3});
    CHECK(square(2) == 4);
    data.domain[2] = -1;
    data.domain[3] = 1;
    footpoint::elementary_data left = data, right = data;
    left.domain[1] = right.domain[0] = 2;
    const footpoint::trimmed_surface a{footpoint::support(left)}, b{footpoint::support(right)};
    CHECK(a.merge(b, 0, footpoint::support(data)).coedge_count(0) == 6);
}

void fits_and_constructions_are_those_of_the_c_api() {
    using namespace footpoint;
    const double pi = 3.14159265358979323846;
    std::vector<double> points, grid;
    for (int i = 0; i < 30; i++) {
        points.insert(points.end(), {i * 0.1, std::sin(i * 0.2), 0.5});
        for (int j = 0; j < 20; j++) grid.insert(grid.end(), {i * 0.1, j * 0.1, std::sin(i * 0.2) * std::cos(j * 0.1)});
    }
    const auto parameters = fit_parameters(points);
    CHECK_NEAR(interpolate(points).evaluate(parameters[7])[1], std::sin(1.4), 1e-12);
    CHECK(interpolate(points, parameters).pole_count() == 30);
    CHECK(least_squares(1, {0, 0, 1, 1}, parameters, points).result.worst > 0.5);
    CHECK(fit_curve(points, fit_options(1e-3)).result.worst <= 1e-3);
    CHECK(interpolate_grid(grid, 30).pole_count_v() == 20);
    CHECK(fit_grid(grid, 30, fit_options(1e-3)).result.worst <= 1e-3);
    CHECK(fit_surface(grid, fit_options(1e-3)).result.unproven == 0);
    const curve low = line({1, 0, 0}, {2, 0, 0}), high = line({1, 0, 1}, {2, 1, 1});
    const curve left = line({1, 0, 0}, {1, 0, 1}), right = line({2, 0, 0}, {2, 1, 1});
    const std::array<const curve *, 2> in_u{&low, &high}, in_v{&left, &right};
    const std::array<const curve *, 4> borders{&left, &right, &low, &high};
    CHECK(coons(borders).degree_u() >= 1 && ruled(low, high).degree_v() == 1);
    CHECK(gordon(in_u, {0, left.domain()[1]}, in_v, {0, low.domain()[1]}).degree_u() >= 1);
    CHECK(skinned(in_u, 1).degree_v() == 1 && extruded(low, {0, 0, 1}).degree_v() == 1);
    CHECK(revolved(low, {0, 0, 0}, {0, 0, 1}, {0, 2 * pi}).is_closed_u());
    CHECK_NEAR(translational(low, left).evaluate(0.5, 0.5)[2], 0.5, 1e-15);
    const curve round = circle_arc(standard_axes, 2, 0, 2 * pi, FPT_ARC_QUINTIC);
    CHECK(round.degree() == 5 && ellipse_arc(standard_axes, 2, 1, 0, 1).degree() == 2);
    CHECK(arc_through({1, 0, 0, 0, 1, 0, -1, 0, 0}).is_rational() && conic_arc({0, 0, 0, 1, 1, 0, 2, 0, 0}, 0.4).is_rational());
    CHECK(parabola(standard_axes, 1, 0, 1).degree() == 2 && hyperbola(standard_axes, 1, 1, 0, 1).degree() == 2);
    const surface ball = quadric_patch(FPT_PATCH_ELLIPSOID, standard_axes, {1, 1, 1}, {0, 1}, {-0.5, 0.5});
    CHECK(torus(standard_axes, 3, 1, {0, 2 * pi}, {0, 2 * pi}).is_closed_v());
    CHECK(saddle(standard_axes, 1, 1, {0, 1, 0, 1}).degree_u() == 2 && plane(standard_axes, {0, 1, 0, 1}).degree_u() == 1);
    CHECK(ferguson({0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0}, {}, {}).degree_u() == 3);
    const curve x0(1, {0, 0, 1, 1}, {0, 0, 0, 0, 1, 0}), x1(1, {0, 0, 1, 1}, {1, 0, 0, 1, 1, 0});
    const curve y0(1, {0, 0, 1, 1}, {0, 0, 0, 1, 0, 0}), y1(1, {0, 0, 1, 1}, {0, 1, 0, 1, 1, 0});
    const curve right_way(1, {0, 0, 1, 1}, {1, 0, 0, 1, 0, 0}), up(1, {0, 0, 1, 1}, {0, 1, 0, 0, 1, 0});
    CHECK_NEAR(coons_bicubic({&x0, &x1, &y0, &y1}, {&right_way, &right_way, &up, &up}).evaluate(0.25, 0.5)[0], 0.25, 1e-15);
    const auto pipe = swept(line({2, 0, 0}, {2.5, 0, 0}), round, sweep_options(1e-5));
    CHECK(pipe.error <= 1e-5 && std::fabs(pipe.holonomy) < 1e-9);
    CHECK_NEAR(offset(ball, 1).evaluate(0.5, 0.5)[0], 2 * std::cos(0.5), 1e-12);
    CHECK(std::hypot(offset(round, 1, {0, 0, 1}).evaluate(0.1)[0], offset(round, 1, {0, 0, 1}).evaluate(0.1)[1]) > 2.999);
    CHECK(fit_offset(ball, 0.5, 3, 3, 1e-4).proven <= 1e-4 && fit_offset(round, 0.5, {0, 0, 1}, 3, 1e-4).proven <= 1e-4);
    check_thrown([&] { (void)fit_curve(points, fit_options()); }, FPT_INVALID_ARGUMENT, "tolerance");
}

void pcurves_and_faces_are_those_of_the_c_api() {
    const std::vector<double> knots{0, 0, 0, 0, 1, 1, 1, 1};
    std::vector<double> poles;
    for (int i = 0; i < 16; i++) poles.insert(poles.end(), {double(i / 4), double(i % 4), i == 5 || i == 10 ? 2.0 : 0.0});
    const surface hill(3, 3, knots, knots, poles);
    const curve line(1, {0, 0, 1, 1}, {0.1, 0.2, 0, 0.9, 0.7, 0});
    const footpoint::proven_curve image = footpoint::lift(hill, line);
    CHECK(image.deviation.flags == FPT_DEVIATION_EXACT && image.shape.degree() == 6);
    const std::vector<footpoint::proven_curve> back = footpoint::pull(hill, image.shape);
    CHECK(back.size() == 1 && back[0].shape.degree() == 1 && back[0].deviation.flags == 0);
    CHECK(footpoint::deviation(hill, back[0].shape, image.shape).bound < 1e-6);
    const curve outline(1, {0, 0, 1, 2, 3, 3}, {0.1, 0.1, 0, 0.9, 0.1, 0, 0.1, 0.9, 0, 0.1, 0.1, 0});
    const std::vector<std::vector<const curve *>> loops{{&outline}};
    const footpoint::face face(hill, loops);
    CHECK(face.classify({0.3, 0.3, 0.8, 0.8}).at(0).standing == FPT_FACE_INSIDE);
    CHECK(face.classify({0.3, 0.3, 0.8, 0.8}).at(1).standing == FPT_FACE_OUTSIDE);
    const footpoint::face_feet found = face.closest({3, 3, 1});
    CHECK(found.places.at(0).standing == FPT_FACE_ON_EDGE && found.feet.at(0).lower_bound <= found.feet.at(0).distance);
    const std::vector<double> inside = hill.evaluate(0.3, 0.3, 0);
    CHECK(face.preimage({inside[0], inside[1], inside[2]}).size() == 1);
    const footpoint::trimmed_surface whole{footpoint::support(hill)};
    CHECK(whole.prepared().classify({0.8, 0.8}).at(0).standing == FPT_FACE_INSIDE);
    check_thrown([&] { face.classify({0.5}); }, FPT_INVALID_ARGUMENT, "uv");
    const std::vector<std::vector<const curve *>> missing{{nullptr}};
    check_thrown([&] { footpoint::face(hill, missing); }, FPT_INVALID_ARGUMENT, "pcurve 0 of loop 0");
}

void surfaces_meet_in_branches() {
    const std::vector<double> knots{0, 0, 1, 1};
    const footpoint::surface flat(1, 1, knots, knots, {-2, -2, 0, -2, 2, 0, 2, -2, 0, 2, 2, 0});
    const footpoint::surface saddle(1, 1, knots, knots, {-1, -1, 1, -1, 1, -0.5, 1, -1, -0.5, 1, 1, 1});
    const footpoint::surface_intersection found(saddle, flat);
    const auto summary = found.summary();
    CHECK(found.size() == 2 && summary.is_proven == 1 && summary.contact_count == 0 && summary.undecided_count == 0);
    for (std::size_t i = 0; i < found.size(); i++) {
        const auto branch = found.branch(i);
        CHECK(branch.is_closed == 0 && branch.end_kind[0] == FPT_BRANCH_END_BORDER && branch.end_index[0] < 4);
        for (const auto &p : found.points(i)) CHECK_NEAR(p.point[2], 0, 1e-15);
        const auto curves = found.curves(saddle, flat, i, 1e-7);
        CHECK(curves.error < 1e-7 && curves.part_count == 1 && curves.uv.degree() == 3);
    }
    const footpoint::support a(saddle), b(flat);
    const footpoint::trimmed_surface first(a), second(b);
    const footpoint::surface_intersection faces(first, second);
    CHECK(faces.size() == found.size() && faces.split(first, 0, 1e-6).size() >= 2);
    const footpoint::surface_intersection same(flat, flat);
    CHECK(same.summary().overlap_count >= 1 && same.overlap(0)[1] > 0);
    bool refused = false;
    try {
        same.contact(0);
    } catch (const footpoint::error &) {
        refused = true;
    }
    CHECK(refused);
    footpoint::intersect_surfaces_options few;
    few.budget = 1;
    const footpoint::surface_intersection part(saddle, flat, few);
    CHECK(part.summary().is_exhausted == 1 && part.undecided(0)[1] > 0);
    footpoint::intersect_surfaces_options stopping;
    stopping.should_stop = [](void *) { return 1; };
    const footpoint::surface_intersection stopped(saddle, flat, stopping);
    CHECK(stopped.summary().is_stopped == 1 && stopped.summary().is_proven == 0 && stopped.summary().undecided_count > 0);
    /* Each method by name, beside the search. */
    const fpt_intersection_point p = found.points(0)[1];
    const std::array<double, 4> start{p.uv[0] + 0.01, p.uv[1], p.st[0], p.st[1] - 0.01};
    footpoint::intersect_surfaces_options asked;
    for (std::uint32_t corrector = FPT_CORRECTOR_AUTO; corrector <= FPT_CORRECTOR_MAF; corrector++) {
        asked.corrector = corrector;
        const footpoint::corrected place = footpoint::correct(saddle, flat, start, asked);
        CHECK(place.gap < 1e-11 && place.steps > 0 && std::fabs(place.place.point[2]) < 1e-11);
    }
    asked.corrector = FPT_CORRECTOR_MAF;
    const auto walk = footpoint::surface_intersection::march(saddle, flat, start, 0, asked);
    CHECK(walk.size() == 1 && walk.summary().is_proven == 0 && walk.branch(0).end_kind[0] == FPT_BRANCH_END_BORDER);
    for (const auto &q : walk.points(0)) CHECK_NEAR(q.point[2], 0, 1e-5);
    std::vector<std::array<double, 4>> places;
    for (const auto &q : {walk.points(0).front(), walk.points(0).back()}) places.push_back({q.uv[0], q.uv[1], q.st[0], q.st[1]});
    asked.chord = 1e-4;
    CHECK(footpoint::surface_intersection::bisect(saddle, flat, places, asked).branch(0).point_count > 4);
    for (const std::uint32_t method : {FPT_INTERSECT_SUBDIVISION, FPT_INTERSECT_MESH}) {
        asked.method = method;
        asked.levels = 8;
        const footpoint::surface_intersection lines(saddle, flat, asked);
        CHECK(lines.size() == 2 && lines.summary().is_proven == 0 && lines.branch(0).gap < 0.1);
    }
    check_thrown([&] { footpoint::surface_intersection::march(saddle, flat, {0, 0, NAN, 0}); }, FPT_INVALID_ARGUMENT, "uvst");
}

void fairing_and_inspection_are_those_of_the_c_api() {
    const double half = std::sqrt(0.5);
    const surface quarter(2, 1, {0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}, {2, 0, 0, 2, 0, 1, 2, 2, 0, 2, 2, 1, 0, 2, 0, 0, 2, 1},
                          {1, 1, half, half, 1, 1});
    const fpt_inspect_range range = footpoint::curvature_range(quarter);
    CHECK(range.proven == 1 && range.least[0] <= 0.5 && range.greatest[1] >= 0.5);
    CHECK(footpoint::curvatures(quarter, {0.3, 0.5})[0].is_singular == 0 && footpoint::umbilics(quarter).empty());
    const surface tip(2, 1, {0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 1, 0, -1, 0, 0, 0, 1, 1, -1.3, 0, 0, 0, 0, 1, -1});
    const footpoint::range_with_places sharp = footpoint::curvature_range_places(tip);
    CHECK((sharp.range.flags & FPT_RANGE_GREATEST_UNBOUNDED) != 0 && sharp.places.at(0).kind == FPT_PLACE_UNBOUNDED);
    const footpoint::hausdorff_distance apart = footpoint::hausdorff(quarter, quarter);
    CHECK(apart.forward.lower == 0 && apart.backward.proven == 1);
    CHECK(footpoint::border(quarter, 2, quarter, 2).gap.upper < 1e-4);
    footpoint::picture_options small;
    small.width = 40, small.height = 30;
    CHECK(footpoint::picture(quarter, small).size() == 3600);
    const curve wave(3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3}, {0, 0, 0, 1, 1, 0, 2, -1, 0, 3, 1, 0, 4, -1, 0, 5, 0, 0});
    CHECK(footpoint::curvature_range(wave).proven == 1 && footpoint::comb(wave, {0, 1.5, 3}).size() == 3);
    CHECK(footpoint::monotone_pieces(wave).size() > 2 && footpoint::inflections(wave).size() > 1);
    CHECK(footpoint::inflections(wave, {0, 0, 1}).size() == footpoint::inflections(wave).size());
    footpoint::fair_options options(0.5);
    const footpoint::fair_report report(wave, options);
    const std::vector<double> energies = report.energies();
    CHECK(report.summary().deviation <= 0.5 && energies.back() < energies.front());
    CHECK(report.as_curve().poles() != wave.poles());
    footpoint::fair_report flat(quarter, options);
    CHECK(flat.as_surface().weights() == quarter.weights());
    CHECK(flat.get() != nullptr);
    fpt_fair_report_free(flat.release());
    options.deviation = 0;
    check_thrown([&] { footpoint::fair_report(wave, options); }, FPT_INVALID_ARGUMENT, "deviation");
}

void intersections_are_those_of_the_c_api() {
    const std::vector<double> ends = {0, 0, 1, 1};
    const curve a(1, ends, std::vector<double>{0, 0, 0, 2, 2, 0}), b(1, ends, std::vector<double>{0, 2, 0, 2, 0, 0});
    const auto crossing = footpoint::intersect(a, b);
    CHECK(crossing.hits.size() == 1 && crossing.undecided.empty() && crossing.hits[0].multiplicity == 1 && !crossing.is_stopped);
    footpoint::hit_options stopping;
    stopping.should_stop = [](void *) { return 1; };
    const auto stopped = footpoint::intersect(a, b, stopping);
    CHECK(stopped.is_stopped && stopped.hits.empty() && stopped.undecided.size() == 1 && stopped.undecided[0][1] == 1);
    const surface flat(1, 1, ends, ends, std::vector<double>{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0});
    const curve rod(1, ends, std::vector<double>{0.25, 0.5, -1, 0.25, 0.5, 1});
    const auto through = footpoint::intersect(flat, rod);
    CHECK(through.hits.size() == 1);
    CHECK_NEAR(through.hits.at(0).w, 0.5, 1e-15);
    CHECK(footpoint::intersect(rod, footpoint::quadric::plane({0, 0, 0.5}, {0, 0, 1})).hits.size() == 1);
    const std::vector<footpoint::quadric> cuts = {footpoint::quadric::cylinder({0.5, 0.5, 3}, {0, 0, 1}, 0.25),
                                                  footpoint::quadric::plane({0, 0, 0}, {0, 0, 1}),
                                                  footpoint::quadric::cone({0.5, 0.5, 1}, {0, 0, 1}, 0.25)};
    const auto sections = footpoint::sections(flat, cuts);
    CHECK(sections.size() == 3 && sections[0].branches.size() == 1 && sections[1].regions.size() == 1);
    CHECK(sections[0].branches.at(0).head.ends[0] == FPT_SECTION_END_CLOSED);
    for (const auto &p : sections[2].branches.at(0).points) CHECK_NEAR(std::hypot(p[0] - 0.5, p[1] - 0.5), 0.25, 1e-14);
    const auto rings = footpoint::conics(footpoint::quadric::sphere({0, 0, 0}, 1), footpoint::quadric::sphere({1, 0, 0}, 1), 1e-9);
    CHECK(rings.size() == 1 && rings.at(0).kind == FPT_CONIC_ELLIPSE);
    const footpoint::caster caster(flat);
    const std::vector<double> origins = {0.5, 0.5, 5, 3, 3, 3}, down = {0, 0, -2, 0, 0, -2};
    const auto first = caster.first(origins, down);
    CHECK(first.size() == 2 && first[0].count == 1 && first[1].count == 0);
    CHECK_NEAR(first[0].t, 5, 1e-15);
    const auto all = caster.all(origins, down);
    CHECK(all.size() == 2 && all[0].size() == 1 && all[1].empty() && all[0][0].t == first[0].t);
    check_thrown([&] { caster.first(origins, std::vector<double>{1}); }, FPT_INVALID_ARGUMENT, "directions");
    check_thrown([&] { footpoint::conics(cuts[0], cuts[0], 1e-9); }, FPT_UNSUPPORTED, "same");
}

void versions_agree() {
    CHECK(footpoint::version() == FPT_VERSION && footpoint::abi_version() == FPT_ABI_VERSION);
}

void operations_are_those_of_the_c_api() {
    namespace operate = footpoint::operate;
    const curve cubic(cubic_curve());
    const std::vector<double> added = {0.1, 0.6};
    const curve finer = operate::refine(cubic, added);
    CHECK(finer.pole_count() == cubic.pole_count() + 2);
    CHECK(operate::difference(cubic, finer).bound < 1e-12);
    const auto thin = operate::simplify(finer, 1e-9);
    CHECK(thin.error < 1e-9 && thin.shape.pole_count() == cubic.pole_count());
    CHECK(operate::reduce(operate::elevate(cubic)).error < 1e-12);
    const auto halves = operate::split(cubic, 0.4);
    CHECK(operate::difference(cubic, operate::join({&halves.first, &halves.second}, 1e-9).shape).bound < 1e-12);
    CHECK(operate::difference(cubic, operate::reverse(operate::reverse(cubic))).bound < 1e-12);
    CHECK(operate::make_compatible({&cubic, &finer})[0].pole_count() == finer.pole_count());
    const operate::arc_length length(cubic);
    const fpt_estimate u = length.parameter(0.5 * length.total().value);
    CHECK_NEAR(length.at(u.value).value, 0.5 * length.total().value, u.error + length.total().error);
    CHECK(operate::continuity(cubic).size() == 3 && operate::frame(cubic, 0.5).speed > 0);
    const std::vector<double> powers = operate::power(halves.first);
    const std::vector<double> first(powers.begin(), powers.begin() + 4 * (long(cubic.degree()) + 1));
    CHECK(operate::difference(operate::from_power(first, 0, 1), operate::from_power(first, 0, 1)).bound < 1e-12);
    check_thrown([&] { operate::elevate(cubic, 40); }, FPT_INVALID_ARGUMENT, "degree");
    check_thrown([&] { operate::from_power(added, 0, 1); }, FPT_INVALID_ARGUMENT, "coefficients");
}

void operations_on_surfaces_are_those_of_the_c_api() {
    namespace operate = footpoint::operate;
    const surface ring = footpoint::torus(footpoint::standard_axes, 3, 1, {0, 6}, {0, 6});
    const auto same = [&](const surface &other) { return operate::difference(ring, other).bound < 1e-12; };
    for (const std::uint32_t direction : {FPT_DIRECTION_U, FPT_DIRECTION_V}) {
        const auto halves = operate::split(ring, direction, 0.5);
        CHECK(same(operate::join({&halves.first, &halves.second}, direction, 1e-9).shape));
        const auto open = operate::unclamp(ring, direction);
        CHECK(operate::difference(ring, open.shape).bound <= open.error + 1e-12);
        const surface faster = operate::reparametrise(ring, direction, 2);
        CHECK(faster.is_rational() && same(operate::reparametrise(faster, direction, 0.5)));
        const auto lines = operate::continuity(ring, direction);
        // The homogeneous pieces of a circle merely join.
        CHECK(!lines.empty() && lines[0].multiplicity == 2 && lines[0].gap < 1e-12);
    }
    CHECK(same(operate::bezier_form(ring)) && same(operate::with_domain(ring, ring.domain())));
    CHECK(same(operate::affine(ring, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0})));
    CHECK(same(operate::projective(ring, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1})));
    const surface flat = footpoint::plane(footpoint::standard_axes, {0, 1, 0, 1});
    CHECK(operate::make_compatible({&flat, &ring})[0].degree_u() == ring.degree_u());
    CHECK(operate::difference(flat, operate::from_power(1, 1, operate::power(flat), {0, 1, 0, 1})).bound < 1e-13);
    check_thrown([&] { operate::continuity(flat, 2); }, FPT_INVALID_ARGUMENT, "direction");
    check_thrown([&] { operate::from_power(40, 1, {}, {0, 1, 0, 1}); }, FPT_INVALID_ARGUMENT, "coefficients");
}

} // namespace

int main() {
    RUN(answers_are_those_of_the_c_api);
    RUN(the_callers_own_records_are_filled);
    RUN(inputs_come_back);
    RUN(evaluations_are_those_of_the_c_api);
    RUN(handles_move_and_are_handed_over);
    RUN(failures_are_thrown);
    RUN(a_stop_is_thrown_and_the_records_stay);
    RUN(functions_make_shapes);
    RUN(sets_are_those_of_the_c_api);
    RUN(an_incomplete_set_is_a_set_and_other_failures_are_thrown);
    RUN(normals_and_paths_are_those_of_the_c_api);
    RUN(scenes_are_those_of_the_c_api);
    RUN(arrays_of_all_kinds_are_spans);
    RUN(normals_without_sides_and_derivatives_in_scenes);
    RUN(misuse_throws);
    RUN(weights_are_those_of_the_c_api);
    RUN(trims_are_those_of_the_c_api);
    RUN(operations_are_those_of_the_c_api);
    RUN(operations_on_surfaces_are_those_of_the_c_api);
    RUN(fits_and_constructions_are_those_of_the_c_api);
    RUN(pcurves_and_faces_are_those_of_the_c_api);
    RUN(surfaces_meet_in_branches);
    RUN(fairing_and_inspection_are_those_of_the_c_api);
    RUN(intersections_are_those_of_the_c_api);
    RUN(versions_agree);
    return check_report("wrapper");
}
