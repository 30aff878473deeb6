/* Sets of feet: preimages, extrema, points on a line: what they hold, what they refuse, who owns them. */
#define _POSIX_C_SOURCE 200809L
#include "samples.h"

#include <pthread.h>

static const double zero[3] = {0, 0, 0};

static fpt_extrema_options extrema_options(void) {
    fpt_extrema_options options;
    fpt_extrema_options_init(&options, sizeof options);
    return options;
}

static size_t count_of(const fpt_foot_set *set) {
    size_t count = SIZE_MAX;
    CHECK_OK(fpt_foot_set_count(set, &count));
    return count;
}

static fpt_foot_member member(const fpt_foot_set *set, size_t index) {
    fpt_foot_member out;
    memset(&out, 0, sizeof out);
    CHECK_OK(fpt_foot_set_get(set, index, &out));
    return out;
}

static int is_complete(const fpt_foot_set *set) {
    size_t count = SIZE_MAX;
    CHECK_OK(fpt_foot_set_undecided_count(set, &count));
    return count == 0;
}

/* What holds for each member of each set: its point is the evaluation, its intervals hold its parameters. */
static void check_members(const fpt_foot_set *set, const fpt_curve *curve, const fpt_surface *surface) {
    for (size_t i = 0; i < count_of(set); i++) {
        fpt_foot_member m = member(set, i);
        double point[3];
        if (curve) CHECK_OK(fpt_curve_evaluate(curve, m.foot.u, 0, point));
        if (surface) CHECK_OK(fpt_surface_evaluate(surface, m.foot.u, m.foot.v, 0, point));
        CHECK_SAME_BITS(point, m.foot.point, sizeof point);
        CHECK(m.u[0] <= m.foot.u && m.foot.u <= m.u[1]);
        CHECK(m.v[0] <= m.foot.v && m.foot.v <= m.v[1]);
        CHECK(m.foot.lower_bound == 0 && !(m.foot.flags & FPT_FOOT_NOT_PROVEN));
        CHECK(m.kind <= FPT_MEMBER_REGION && m.nature <= FPT_NATURE_FLAT);
    }
}

/* The circle of radius 2 about (1,0,0): its seam is at (3,0,0). */
static void a_seam_has_two_parameters_and_a_point_off_the_curve_none(void) {
    fpt_curve *curve = make_curve(circle_curve());
    const double seam[3] = {3, 0, 0}, top[3] = {1, 2, 0}, off[3] = {1, 2.1, 0};
    fpt_foot_set *set = NULL;
    CHECK_OK(fpt_curve_preimage(curve, seam, 0, NULL, &set));
    CHECK(count_of(set) == 2 && is_complete(set));
    check_members(set, curve, NULL);
    CHECK(member(set, 0).foot.u == 0 && member(set, 1).foot.u == 4);
    CHECK(member(set, 0).foot.flags == (FPT_FOOT_EDGE | FPT_FOOT_SEAM));
    CHECK(member(set, 0).kind == FPT_MEMBER_POINT && member(set, 0).v[1] == 0);
    fpt_foot_set_free(set);
    CHECK_OK(fpt_curve_preimage(curve, top, 1e-9, NULL, &set));
    CHECK(count_of(set) == 1);
    CHECK_NEAR(member(set, 0).foot.u, 1, 1e-9);
    fpt_foot_set_free(set);
    CHECK_OK(fpt_curve_preimage(curve, off, 0, NULL, &set));
    CHECK(set != NULL && count_of(set) == 0 && is_complete(set));
    fpt_foot_set_free(set);
    CHECK_OK(fpt_curve_preimage(curve, off, 0.2, NULL, &set));
    CHECK(count_of(set) == 1);
    CHECK(member(set, 0).u[0] < 0.99 && member(set, 0).u[1] > 1.01);
    fpt_foot_set_free(set);
    fpt_curve_free(curve);
}

/* The cone's apex is every u at v = 1; a point of its seam is two places. */
static void collapsed_edges_are_arcs_and_restrictions_count(void) {
    fpt_surface *surface = make_surface(cone_surface());
    const double apex[3] = {1, 0, 3}, seam[3] = {2, 0, 1.5};
    fpt_query_options options = default_options();
    fpt_foot_set *set = NULL;
    CHECK_OK(fpt_surface_preimage(surface, apex, 0, NULL, &set));
    CHECK(count_of(set) == 1);
    check_members(set, NULL, surface);
    fpt_foot_member m = member(set, 0);
    CHECK(m.kind == FPT_MEMBER_ARC_U && m.u[0] == 0 && m.u[1] == 4 && m.foot.v == 1);
    CHECK(m.foot.flags & FPT_FOOT_COLLAPSED);
    fpt_foot_set_free(set);
    CHECK_OK(fpt_surface_preimage(surface, seam, 0, NULL, &set));
    CHECK(count_of(set) == 2);
    CHECK(member(set, 0).foot.u == 0 && member(set, 1).foot.u == 4);
    CHECK_NEAR(member(set, 1).foot.v, 0.5, 1e-9);
    fpt_foot_set_free(set);
    options.domain[0] = 1;
    options.domain[1] = 4;
    options.domain[3] = 1;
    CHECK_OK(fpt_surface_preimage(surface, seam, 0, &options, &set));
    CHECK(count_of(set) == 1 && member(set, 0).foot.u == 4);
    fpt_foot_set_free(set);
    fpt_surface_free(surface);
}

static void extrema_come_nearest_first_with_their_nature(void) {
    fpt_curve *curve = make_curve(circle_curve());
    const double point[3] = {1, 5, 0}, centre[3] = {1, 0, 0};
    fpt_foot_set *set = NULL;
    CHECK_OK(fpt_curve_extrema(curve, point, NULL, &set));
    CHECK(count_of(set) == 2 && is_complete(set));
    check_members(set, curve, NULL);
    CHECK(member(set, 0).nature == FPT_NATURE_MINIMUM && member(set, 1).nature == FPT_NATURE_MAXIMUM);
    CHECK_NEAR(member(set, 0).foot.distance, 3, 1e-12);
    CHECK_NEAR(member(set, 1).foot.distance, 7, 1e-12);
    CHECK_NEAR(member(set, 1).foot.u, 3, 1e-12);
    fpt_foot_set_free(set);
    CHECK_OK(fpt_curve_extrema(curve, centre, NULL, &set));
    CHECK(count_of(set) == 1);
    fpt_foot_member all = member(set, 0);
    CHECK(all.kind == FPT_MEMBER_ARC_U && all.nature == FPT_NATURE_FLAT && all.u[0] == 0 && all.u[1] == 4);
    CHECK(all.foot.flags & FPT_FOOT_CONTINUUM);
    CHECK_NEAR(all.foot.distance, 2, 1e-12);
    fpt_foot_set_free(set);
    fpt_curve_free(curve);
}

/* The cone with apex (1,0,3): a foot inside, the nearest and the farthest place of the border. The apex is neither. */
static void a_surface_has_feet_and_borders(void) {
    fpt_surface *surface = make_surface(cone_surface());
    const double point[3] = {4, 0, 2};
    fpt_foot_set *set = NULL;
    CHECK_OK(fpt_surface_extrema(surface, point, NULL, &set));
    check_members(set, NULL, surface);
    CHECK(is_complete(set) && count_of(set) == 3);
    /* The foot on the generator from (3,0,0) to (1,0,3). */
    CHECK_NEAR(member(set, 0).foot.v, 4 / 13.0, 1e-12);
    CHECK(member(set, 0).nature == FPT_NATURE_MINIMUM && member(set, 0).foot.u == 0);
    CHECK(member(set, 1).nature == FPT_NATURE_SADDLE && member(set, 1).foot.v == 0);
    CHECK_NEAR(member(set, 1).foot.distance, sqrt(5), 1e-12);
    CHECK(member(set, 2).nature == FPT_NATURE_MAXIMUM && member(set, 2).foot.v == 0);
    CHECK_NEAR(member(set, 2).foot.distance, sqrt(29), 1e-12);
    fpt_foot_set_free(set);
    fpt_surface_free(surface);
}

static void options_of_extrema_leave_members_out(void) {
    fpt_surface *surface = make_surface(paper_surface(0));
    const double point[3] = {300, 250, 500};
    fpt_extrema_options options = extrema_options();
    fpt_foot_set *all = NULL, *set = NULL;
    CHECK_OK(fpt_surface_extrema(surface, point, NULL, &all));
    CHECK_OK(fpt_surface_extrema(surface, point, &options, &set));
    CHECK(count_of(all) > 4 && count_of(set) == count_of(all));
    fpt_foot_set_free(set);
    options.nearest = 3;
    CHECK_OK(fpt_surface_extrema(surface, point, &options, &set));
    CHECK(count_of(set) == 3);
    for (size_t i = 0; i < 3; i++) {
        fpt_foot_member a = member(all, i), b = member(set, i);
        CHECK_SAME_BITS(&a, &b, sizeof a);
    }
    fpt_foot_set_free(set);
    options = extrema_options();
    options.minima_only = 1;
    CHECK_OK(fpt_surface_extrema(surface, point, &options, &set));
    for (size_t i = 0; i < count_of(set); i++) {
        CHECK(member(set, i).nature == FPT_NATURE_MINIMUM || member(set, i).nature == FPT_NATURE_FLAT);
    }
    fpt_foot_set_free(set);
    options = extrema_options();
    options.radius = member(all, 1).foot.distance;
    CHECK_OK(fpt_surface_extrema(surface, point, &options, &set));
    CHECK(count_of(set) == 2);
    fpt_foot_set_free(set);
    options = extrema_options();
    options.domain[0] = options.domain[2] = 0.25;
    options.domain[1] = options.domain[3] = 0.5;
    CHECK_OK(fpt_surface_extrema(surface, point, &options, &set));
    CHECK(count_of(set) >= 4);
    for (size_t i = 0; i < count_of(set); i++) {
        fpt_foot_member m = member(set, i);
        CHECK(m.u[0] >= 0.25 && m.u[1] <= 0.5 && m.v[0] >= 0.25 && m.v[1] <= 0.5);
    }
    fpt_foot_set_free(set);
    fpt_foot_set_free(all);
    fpt_surface_free(surface);
}

static void lines_meet_in_their_order(void) {
    fpt_curve *curve = make_curve(circle_curve());
    fpt_surface *surface = make_surface(cone_surface());
    const double origin[3] = {-9, 0, 0}, direction[3] = {0.5, 0, 0}, ray[2] = {9, INFINITY};
    const double high[3] = {-9, 0, 1.5};
    fpt_foot_set *set = NULL;
    CHECK_OK(fpt_curve_on_line(curve, origin, direction, NULL, 0, NULL, &set));
    check_members(set, curve, NULL);
    CHECK(count_of(set) == 3);
    CHECK_NEAR(member(set, 0).foot.u, 2, 1e-9);
    CHECK(member(set, 1).foot.u == 0 && member(set, 2).foot.u == 4);
    fpt_foot_set_free(set);
    CHECK_OK(fpt_curve_on_line(curve, origin, direction, ray, 0, NULL, &set));
    CHECK(count_of(set) == 2);
    fpt_foot_set_free(set);
    CHECK_OK(fpt_surface_on_line(surface, high, direction, NULL, 0, NULL, &set));
    check_members(set, NULL, surface);
    CHECK(count_of(set) == 3);
    CHECK_NEAR(member(set, 0).foot.point[0], 0, 1e-9);
    CHECK_NEAR(member(set, 2).foot.point[0], 2, 1e-9);
    fpt_foot_set_free(set);
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

static void projections_follow_the_direction(void) {
    fpt_surface *surface = make_surface(cone_surface());
    fpt_curve *curve = make_curve(circle_curve());
    const double points[6] = {2, 0, 9, 1, 50, 0}, down[3] = {0, 0, -3}, right[3] = {1, 0, 0};
    const double beside[3] = {-7, 0, 0};
    fpt_foot_point out[2];
    CHECK_OK(fpt_surface_project(surface, points, 2, down, NULL, out));
    CHECK_NEAR(out[0].point[2], 1.5, 1e-9);
    CHECK_NEAR(out[0].distance, 7.5, 1e-9);
    CHECK(out[1].flags & FPT_FOOT_NOT_ON_SHAPE);
    CHECK_OK(fpt_curve_project(curve, beside, 1, right, NULL, out));
    CHECK_NEAR(out[0].u, 2, 1e-9);
    CHECK_NEAR(out[0].distance, 6, 1e-9);
    fill_pattern(out, sizeof out);
    CHECK_ERROR(fpt_curve_project(NULL, beside, 1, right, NULL, out), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_surface_project(NULL, beside, 1, right, NULL, out), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_curve_project(curve, NULL, 1, right, NULL, out), FPT_NULL_ARGUMENT, "points");
    CHECK_ERROR(fpt_surface_project(surface, beside, 1, NULL, NULL, out), FPT_NULL_ARGUMENT, "direction");
    CHECK_ERROR(fpt_surface_project(surface, beside, 1, zero, NULL, out), FPT_INVALID_ARGUMENT, "direction");
    CHECK_ERROR(fpt_surface_project(surface, beside, 1, right, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK(is_pattern(out, sizeof out));
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

/* Boxes of a set that is not complete lie in the unit square (curves: on its lower side). */
static void check_undecided(const fpt_foot_set *set) {
    size_t left = 0;
    double box[4];
    CHECK(set != NULL && !is_complete(set));
    CHECK_OK(fpt_foot_set_undecided_count(set, &left));
    for (size_t i = 0; i < left; i++) {
        CHECK_OK(fpt_foot_set_undecided_get(set, i, box));
        CHECK(0 <= box[0] && box[0] <= box[1] && box[1] <= 1 && 0 <= box[2] && box[2] <= box[3] && box[3] <= 1);
    }
    fill_pattern(box, sizeof box);
    CHECK_ERROR(fpt_foot_set_undecided_get(set, left, box), FPT_INVALID_ARGUMENT, "index");
    CHECK_ERROR(fpt_foot_set_undecided_get(set, 0, NULL), FPT_NULL_ARGUMENT, "out_uv");
    CHECK(is_pattern(box, sizeof box));
}

/* The set comes with the failure, and says where more may be. */
static void a_budget_that_runs_out_hands_over_what_is_known(void) {
    fpt_surface *surface = make_surface(paper_surface(1));
    fpt_curve *curve = make_curve(cubic_curve());
    fpt_extrema_options few = extrema_options();
    fpt_query_options few_boxes = default_options();
    const double point[3] = {300, 250, 100}, beside[3] = {2.5, 0.5, 0}, near[3] = {2, 1, 0.5};
    fpt_foot_set *set = NULL;
    few.budget = few_boxes.budget = 1;
    CHECK_ERROR(fpt_surface_extrema(surface, point, &few, &set), FPT_BUDGET_EXHAUSTED, "budget");
    check_undecided(set);
    fpt_foot_set_free(set);
    set = NULL;
    CHECK_ERROR(fpt_curve_extrema(curve, beside, &few, &set), FPT_BUDGET_EXHAUSTED, "budget");
    check_undecided(set);
    fpt_foot_set_free(set);
    set = NULL;
    CHECK_ERROR(fpt_surface_preimage(surface, point, 150, &few_boxes, &set), FPT_BUDGET_EXHAUSTED, "budget");
    check_undecided(set);
    fpt_foot_set_free(set);
    set = NULL;
    CHECK_ERROR(fpt_curve_preimage(curve, near, 1, &few_boxes, &set), FPT_BUDGET_EXHAUSTED, "budget");
    check_undecided(set);
    fpt_foot_set_free(set);
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

static int stop_at_once(void *user) {
    ++*(int *)user;
    return 1;
}

static void a_stop_leaves_no_set(void) {
    fpt_surface *surface = make_surface(paper_surface(1));
    fpt_curve *curve = make_curve(cubic_curve());
    CHECK_OK(fpt_surface_prepare(surface));
    CHECK_OK(fpt_curve_prepare(curve));
    const double point[3] = {300, 250, 100}, up[3] = {0, 0, 1};
    int asked = 0;
    fpt_query_options stopping = default_options();
    fpt_extrema_options stopping_too = extrema_options();
    fpt_foot_set *set = NULL, *untouched;
    stopping.should_stop = stopping_too.should_stop = stop_at_once;
    stopping.user = stopping_too.user = &asked;
    fill_pattern(&set, sizeof set);
    untouched = set;
    CHECK_STATUS(fpt_surface_preimage(surface, point, 0, &stopping, &set), FPT_CANCELLED);
    CHECK_STATUS(fpt_surface_extrema(surface, point, &stopping_too, &set), FPT_CANCELLED);
    CHECK_STATUS(fpt_surface_on_line(surface, point, up, NULL, 0, &stopping, &set), FPT_CANCELLED);
    CHECK_STATUS(fpt_curve_preimage(curve, point, 0, &stopping, &set), FPT_CANCELLED);
    CHECK_STATUS(fpt_curve_extrema(curve, point, &stopping_too, &set), FPT_CANCELLED);
    CHECK_STATUS(fpt_curve_on_line(curve, point, up, NULL, 0, &stopping, &set), FPT_CANCELLED);
    CHECK(set == untouched && asked >= 6);
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

/* A set does not need its shape; NULL may be released. */
static void sets_and_shapes_go_in_any_order(void) {
    for (int order = 0; order < 2; order++) {
        fpt_surface *surface = make_surface(cone_surface());
        fpt_foot_set *set = NULL;
        CHECK_OK(fpt_surface_extrema(surface, zero, NULL, &set));
        if (order) fpt_surface_free(surface);
        fpt_foot_member m = member(set, 0);
        CHECK(m.foot.distance > 0 && count_of(set) > 0);
        fpt_foot_set_free(set);
        if (!order) fpt_surface_free(surface);
    }
    fpt_foot_set_free(NULL);
    fpt_extrema_options_init(NULL, sizeof(fpt_extrema_options));
}

enum { THREADS = 8, ROUNDS = 50 };

struct reader {
    const fpt_foot_set *set;
    const fpt_surface *surface;
    fpt_foot_member first;
    size_t count;
    int right;
};

/* Reads one set again and again, and asks for one of its own. */
static void *read_often(void *argument) {
    struct reader *job = (struct reader *)argument;
    job->right = 1;
    for (int round = 0; round < ROUNDS; round++) {
        fpt_foot_member m;
        fpt_foot_set *own = NULL;
        size_t count = 0;
        job->right &= fpt_foot_set_count(job->set, &count) == FPT_OK && count == job->count;
        job->right &= fpt_foot_set_get(job->set, 0, &m) == FPT_OK && memcmp(&m, &job->first, sizeof m) == 0;
        job->right &= fpt_foot_set_get(job->set, count, &m) == FPT_INVALID_ARGUMENT;
        job->right &= fpt_surface_extrema(job->surface, zero, NULL, &own) == FPT_OK;
        job->right &= fpt_foot_set_get(own, 0, &m) == FPT_OK && memcmp(&m, &job->first, sizeof m) == 0;
        fpt_foot_set_free(own);
    }
    return NULL;
}

static void threads_share_a_set(void) {
    fpt_surface *surface = make_surface(cone_surface()), *fresh = make_surface(cone_surface());
    fpt_foot_set *set = NULL;
    pthread_t threads[THREADS];
    struct reader jobs[THREADS];
    CHECK_OK(fpt_surface_extrema(surface, zero, NULL, &set));
    for (int i = 0; i < THREADS; i++) {
        struct reader job = {set, fresh, member(set, 0), count_of(set), 0};
        jobs[i] = job;
        CHECK(pthread_create(&threads[i], NULL, read_often, &jobs[i]) == 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        CHECK(jobs[i].right);
    }
    fpt_foot_set_free(set);
    fpt_surface_free(surface);
    fpt_surface_free(fresh);
}

int main(void) {
    RUN(a_seam_has_two_parameters_and_a_point_off_the_curve_none);
    RUN(collapsed_edges_are_arcs_and_restrictions_count);
    RUN(extrema_come_nearest_first_with_their_nature);
    RUN(a_surface_has_feet_and_borders);
    RUN(options_of_extrema_leave_members_out);
    RUN(lines_meet_in_their_order);
    RUN(projections_follow_the_direction);
    RUN(a_budget_that_runs_out_hands_over_what_is_known);
    RUN(a_stop_leaves_no_set);
    RUN(sets_and_shapes_go_in_any_order);
    RUN(threads_share_a_set);
    return check_report("sets");
}
