/* Scenes: members that share shapes, answers that name them, normals, life cycle in any order. */
#include "samples.h"

enum { POINTS = 400, MEMBERS = 5 };

/* The bilinear square [0,1] x [0,1] at height 0. */
static fpt_surface_data square_surface(void) {
    static const double knots[] = {0, 0, 1, 1};
    static const double poles[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
    return surface_data(1, 1, 2, 2, knots, knots, poles, NULL);
}

static const double aside[12] = {1, 0, 0, 300, 0, 1, 0, 20, 0, 0, 1, -40};
static const double turned[12] = {0, -1, 0, 100, 0.6, 0, -0.8, 50, 0.8, 0, 0.6, 200};

static fpt_scene_member member(const fpt_curve *curve, const fpt_surface *surface, const double *placement) {
    fpt_scene_member out;
    memset(&out, 0, sizeof out);
    out.struct_size = sizeof out;
    out.curve = curve;
    out.surface = surface;
    out.placement = placement;
    return out;
}

static fpt_scene *make_scene(const fpt_scene_member *members, size_t count) {
    fpt_scene_data data;
    fpt_scene *scene = NULL;
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.member_count = count;
    data.members = members;
    CHECK_OK(fpt_scene_new(&data, &scene));
    CHECK(scene != NULL);
    return scene;
}

/* Three surfaces of one handle, a cone, a curve. The handles are freed before the scene is used. */
static fpt_scene *sample_scene(void) {
    fpt_surface *paper = make_surface(paper_surface(1)), *cone = make_surface(cone_surface());
    fpt_curve *curve = make_curve(cubic_curve());
    const fpt_scene_member members[MEMBERS] = {member(NULL, paper, NULL), member(NULL, paper, aside),
                                               member(NULL, cone, turned), member(curve, NULL, aside),
                                               member(NULL, paper, turned)};
    fpt_scene *scene = make_scene(members, MEMBERS);
    fpt_surface_free(paper);
    fpt_curve_free(curve);
    fpt_surface_free(cone);
    return scene;
}

static void null_may_be_freed(void) { fpt_scene_free(NULL); }

static void members_come_back(void) {
    fpt_scene *scene = sample_scene();
    size_t count = 0, before = 0, after = 0;
    double placement[12], box[6];
    fpt_curve *curve;
    fpt_surface *surface;
    CHECK_OK(fpt_scene_count(scene, &count));
    CHECK(count == MEMBERS);
    CHECK_OK(fpt_scene_placement(scene, 0, placement));
    CHECK(placement[0] == 1 && placement[1] == 0 && placement[3] == 0 && placement[10] == 1 && placement[11] == 0);
    CHECK_OK(fpt_scene_placement(scene, 1, placement));
    CHECK_SAME_BITS(placement, aside, sizeof placement);
    CHECK_OK(fpt_scene_box(scene, box));
    CHECK(box[0] < box[3] && box[1] < box[4] && box[2] < box[5]);
    CHECK_OK(fpt_scene_memory(scene, &before));
    CHECK_OK(fpt_scene_prepare(scene));
    CHECK_OK(fpt_scene_prepare(scene));
    CHECK_OK(fpt_scene_memory(scene, &after));
    CHECK(before > 1000 && after > before + 1000);
    CHECK_OK(fpt_scene_shape(scene, 3, &curve, &surface));
    CHECK(curve != NULL && surface == NULL);
    fpt_curve_free(curve);
    CHECK_OK(fpt_scene_shape(scene, 4, &curve, &surface));
    CHECK(curve == NULL && surface != NULL);
    /* The handle shares the shape, and keeps it when the scene goes. */
    fpt_scene_free(scene);
    CHECK_OK(fpt_surface_pole_count_u(surface, &count));
    CHECK(count == 7);
    fpt_surface_free(surface);
}

/* The nearest of the members' own answers, by the functions for one shape. */
static void answers_are_the_nearest_members(void) {
    static fpt_foot_point feet[POINTS], again[POINTS];
    static uint32_t members[POINTS];
    const double low[3] = {-50, -50, -100}, high[3] = {900, 600, 900};
    double *points = scattered_points(POINTS, low, high, 0.2), box[6], diagonal = 0;
    fpt_scene *scene = sample_scene();
    fpt_query_options options = default_options();
    size_t seen[MEMBERS] = {0};
    CHECK_OK(fpt_scene_box(scene, box));
    for (int k = 0; k < 3; k++) diagonal += (box[k + 3] - box[k]) * (box[k + 3] - box[k]);
    diagonal = sqrt(diagonal);
    CHECK_OK(fpt_scene_closest(scene, points, POINTS, NULL, NULL, feet, members));
    options.threads = 1;
    CHECK_OK(fpt_scene_closest(scene, points, POINTS, &options, NULL, again, NULL));
    CHECK_SAME_BITS(feet, again, sizeof feet);
    options.accuracy = 1e-10 * diagonal;
    for (size_t i = 0; i < POINTS; i++) {
        double least = INFINITY, there[3];
        CHECK(members[i] < MEMBERS);
        CHECK(!(feet[i].flags & FPT_FOOT_NOT_PROVEN) && feet[i].lower_bound <= feet[i].distance);
        CHECK_NEAR(distance_between(points + 3 * i, feet[i].point), feet[i].distance, 1e-12);
        CHECK_OK(fpt_scene_evaluate(scene, members[i], feet[i].u, feet[i].v, 0, there));
        CHECK_SAME_BITS(there, feet[i].point, sizeof there);
        seen[members[i]]++;
        for (uint32_t k = 0; k < MEMBERS; k++) {
            double m[12], q[3], y[3];
            fpt_curve *curve;
            fpt_surface *surface;
            fpt_foot_point foot;
            CHECK_OK(fpt_scene_placement(scene, k, m));
            for (int c = 0; c < 3; c++) y[c] = points[3 * i + (size_t)c] - m[4 * c + 3];
            for (int c = 0; c < 3; c++) q[c] = m[c] * y[0] + m[4 + c] * y[1] + m[8 + c] * y[2];
            CHECK_OK(fpt_scene_shape(scene, k, &curve, &surface));
            if (curve) CHECK_OK(fpt_curve_closest(curve, q, 1, &options, &foot));
            if (surface) CHECK_OK(fpt_surface_closest(surface, q, 1, &options, &foot));
            fpt_curve_free(curve);
            fpt_surface_free(surface);
            if (foot.distance < least) least = foot.distance;
            CHECK(feet[i].lower_bound <= foot.distance + 1e-11);
        }
        CHECK_NEAR(feet[i].distance, least, 1e-10 * diagonal + 1e-11);
    }
    for (size_t k = 0; k < MEMBERS; k++) CHECK(seen[k] > 0);
    fpt_scene_free(scene);
    free(points);
}

static void hints_name_members(void) {
    const double points[12] = {0.5, 0.5, 1, 5.5, 0.5, 2, 0.25, 0.5, 3, 0.5, 0.5, 4};
    const double away[12] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
    const double hints[8] = {0.4, 0.4, NAN, NAN, 0.1, 0.9, 0, 0};
    const uint32_t hint_members[4] = {0, 1, 1, UINT32_MAX};
    fpt_surface *square = make_surface(square_surface());
    const fpt_scene_member both[2] = {member(NULL, square, NULL), member(NULL, square, away)};
    fpt_scene *scene = make_scene(both, 2);
    fpt_query_options options = default_options();
    fpt_foot_point feet[4];
    uint32_t members[4];
    options.hints = hints;
    CHECK_OK(fpt_scene_closest(scene, points, 4, &options, hint_members, feet, members));
    for (int i = 0; i < 4; i++) {
        CHECK(members[i] == (i == 1 ? 1u : 0u));
        CHECK_NEAR(feet[i].distance, 1 + i, 1e-12);
        CHECK(((feet[i].flags & FPT_FOOT_HINT_USED) != 0) == (i < 3));
    }
    options.hints = NULL;
    CHECK_OK(fpt_scene_closest(scene, points, 4, &options, hint_members, feet, members));
    CHECK(members[1] == 1 && (feet[2].flags & FPT_FOOT_HINT_USED) && !(feet[3].flags & FPT_FOOT_HINT_USED));
    options.scope = FPT_SCOPE_LOCAL;
    CHECK_OK(fpt_scene_closest(scene, points, 4, &options, hint_members, feet, members));
    CHECK(members[0] == 0 && members[2] == 1 && members[3] == 0 && feet[2].lower_bound == 0);
    fpt_scene_free(scene);
    fpt_surface_free(square);
}

static void points_off_the_scene_and_bad_ones_are_marked(void) {
    const double points[9] = {0.5, 0.5, 1e-9, 0.5, 0.5, 1e-3, NAN, 0, 0};
    fpt_surface *square = make_surface(square_surface());
    const fpt_scene_member one = member(NULL, square, NULL);
    fpt_scene *scene = make_scene(&one, 1);
    fpt_foot_point feet[3];
    uint32_t members[3] = {9, 9, 9};
    CHECK_OK(fpt_scene_invert(scene, points, 3, NULL, NULL, feet, members));
    CHECK(!(feet[0].flags & FPT_FOOT_NOT_ON_SHAPE) && (feet[1].flags & FPT_FOOT_NOT_ON_SHAPE));
    CHECK((feet[2].flags & FPT_FOOT_BAD_QUERY) && isnan(feet[2].u));
    CHECK(members[0] == 0 && members[1] == 0 && members[2] == UINT32_MAX);
    CHECK_OK(fpt_scene_invert(scene, NULL, 0, NULL, NULL, NULL, NULL));
    fpt_scene_free(scene);
    fpt_surface_free(square);
}

static void normals_turn_with_their_members(void) {
    const double points[9] = {0.5, 0.5, -2, 99.5, 50.3, 203, 300.5, 22, -40};
    fpt_surface *square = make_surface(square_surface());
    fpt_curve *curve = make_curve(cubic_curve());
    const fpt_scene_member members[3] = {member(NULL, square, NULL), member(NULL, square, turned),
                                         member(curve, NULL, aside)};
    fpt_scene *scene = make_scene(members, 3);
    fpt_foot_point feet[3];
    uint32_t named[3], flags[3];
    double normals[9], distances[3], again[9];
    CHECK_OK(fpt_scene_closest(scene, points, 3, NULL, NULL, feet, named));
    CHECK(named[0] == 0 && named[1] == 1 && named[2] == 2);
    CHECK_OK(fpt_scene_normals(scene, points, feet, named, 3, normals, distances, flags));
    CHECK(normals[0] == 0 && normals[1] == 0 && normals[2] == 1 && distances[0] == -2);
    CHECK_NEAR(normals[3], 0, 1e-15);
    CHECK_NEAR(normals[4], -0.8, 1e-15);
    CHECK_NEAR(normals[5], 0.6, 1e-15);
    CHECK(distances[1] == feet[1].distance);
    CHECK(isnan(normals[6]) && (flags[2] & FPT_NORMAL_UNDEFINED) && distances[2] == feet[2].distance);
    CHECK_OK(fpt_scene_normals(scene, NULL, feet, named, 3, again, NULL, NULL));
    CHECK_SAME_BITS(again, normals, 6 * sizeof(double));
    CHECK_OK(fpt_scene_normals(scene, NULL, NULL, NULL, 0, NULL, NULL, NULL));
    fpt_scene_free(scene);
    fpt_curve_free(curve);
    fpt_surface_free(square);
}

static void derivatives_turn_and_curves_have_one_parameter(void) {
    fpt_scene *scene = sample_scene();
    double out[3 * 6];
    CHECK_OK(fpt_scene_evaluate(scene, 4, 0.5, 0.5, 2, out));
    CHECK_OK(fpt_scene_evaluate(scene, 3, 0.5, NAN, 3, out));
    fpt_scene_free(scene);
}

static int stop_now(void *user) {
    (void)user;
    return 1;
}

static void told(void *user, size_t done, size_t total) { *(size_t *)user = 1000 * total + done; }

static void a_call_can_be_stopped_and_tells_its_progress(void) {
    static fpt_foot_point feet[POINTS];
    static uint32_t members[POINTS];
    const double low[3] = {0, 0, 0}, high[3] = {500, 500, 500};
    double *points = scattered_points(POINTS, low, high, 0);
    fpt_scene *scene = sample_scene();
    fpt_query_options options = default_options();
    size_t heard = 0;
    options.should_stop = stop_now;
    CHECK_STATUS(fpt_scene_closest(scene, points, POINTS, &options, NULL, feet, members), FPT_CANCELLED);
    CHECK(isnan(feet[0].u) && feet[0].lower_bound == 0 && members[0] == UINT32_MAX);
    options.should_stop = NULL;
    options.progress = told;
    options.user = &heard;
    CHECK_OK(fpt_scene_closest(scene, points, POINTS, &options, NULL, feet, members));
    CHECK(heard == 1000 * POINTS + POINTS && members[POINTS - 1] < MEMBERS);
    fpt_scene_free(scene);
    free(points);
}

int main(void) {
    RUN(null_may_be_freed);
    RUN(members_come_back);
    RUN(answers_are_the_nearest_members);
    RUN(hints_name_members);
    RUN(points_off_the_scene_and_bad_ones_are_marked);
    RUN(normals_turn_with_their_members);
    RUN(derivatives_turn_and_curves_have_one_parameter);
    RUN(a_call_can_be_stopped_and_tells_its_progress);
    return check_report("scene");
}
