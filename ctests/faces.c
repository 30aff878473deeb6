/* Pcurves and faces: pulled back, lifted, classified, nearest points; and what is refused. */
#include "samples.h"

/* A bilinear plane over the unit square, 4 x 4 large. */
static fpt_surface *plane(void) {
    static const double knots[] = {0, 0, 1, 1};
    static const double poles[] = {0, 0, 0, 0, 4, 0, 4, 0, 0, 4, 4, 0};
    return make_surface(surface_data(1, 1, 2, 2, knots, knots, poles, NULL));
}

/* A hill over the square of 3 x 3. */
static fpt_surface *hill(void) {
    static const double knots[] = {0, 0, 0, 0, 1, 1, 1, 1};
    static double poles[48];
    for (int i = 0; i < 16; i++) {
        poles[3 * i] = i / 4;
        poles[3 * i + 1] = i % 4;
        poles[3 * i + 2] = i == 5 || i == 10 ? 2 : 0;
    }
    return make_surface(surface_data(3, 3, 4, 4, knots, knots, poles, NULL));
}

static fpt_curve *polygon(const double *poles, size_t count) {
    static double knots[16];
    for (size_t i = 0; i < count + 2; i++) knots[i] = i == 0 ? 0 : i > count ? (double)count - 1 : (double)i - 1;
    return make_curve(curve_data(1, count, knots, poles, NULL));
}

static fpt_face *triangle_with_hole(void) {
    static const double outer[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0};
    static const double inner[] = {0.1, 0.1, 0, 0.1, 0.3, 0, 0.3, 0.1, 0, 0.1, 0.1, 0};
    fpt_surface *surface = plane();
    fpt_curve *loops[2];
    const fpt_curve *pcurves[2];
    const size_t counts[2] = {1, 1};
    fpt_face_data data;
    fpt_face *face = NULL;
    pcurves[0] = loops[0] = polygon(outer, 4);
    pcurves[1] = loops[1] = polygon(inner, 4);
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.surface = surface;
    data.loop_count = 2;
    data.coedge_counts = counts;
    data.pcurves = pcurves;
    CHECK_OK(fpt_face_new(&data, NULL, &face));
    /* What it was made from may go. */
    fpt_curve_free(loops[0]);
    fpt_curve_free(loops[1]);
    fpt_surface_free(surface);
    return face;
}

static void places_are_told_apart(void) {
    const double uv[] = {0.5, 0.2, 0.15, 0.15, 0.9, 0.9, 0.5, 0.5, 0.1, 0.2, 2, 2, NAN, 0};
    fpt_face_place places[7];
    fpt_face *face = triangle_with_hole();
    CHECK_OK(fpt_face_classify(face, uv, 7, NULL, places));
    CHECK(places[0].standing == FPT_FACE_INSIDE && places[0].loop_index == UINT32_MAX);
    CHECK(places[1].standing == FPT_FACE_OUTSIDE && places[2].standing == FPT_FACE_OUTSIDE);
    CHECK(places[3].standing == FPT_FACE_ON_EDGE && places[3].loop_index == 0 && places[3].coedge_index == 0);
    CHECK_NEAR(places[3].parameter, 1.5, 1e-9);
    CHECK(places[4].standing == FPT_FACE_ON_EDGE && places[4].loop_index == 1);
    CHECK(places[5].standing == FPT_FACE_OUTSIDE && places[6].standing == FPT_FACE_UNKNOWN);
    CHECK_OK(fpt_face_classify(face, NULL, 0, NULL, NULL));
    fpt_face_free(face);
}

static void nearest_points_stay_on_the_face(void) {
    const double points[] = {2, 0.8, 3, 4, 4, 0, 0.8, 0.8, 1, NAN, 0, 0};
    fpt_foot_point feet[4], same[4];
    fpt_face_place places[4];
    fpt_face *face = triangle_with_hole();
    CHECK_OK(fpt_face_closest(face, points, 4, NULL, feet, places));
    CHECK_NEAR(feet[0].distance, 3, 1e-12);
    CHECK(places[0].standing == FPT_FACE_INSIDE);
    CHECK_NEAR(feet[1].distance, sqrt(8.0), 1e-12);
    CHECK(places[1].standing == FPT_FACE_ON_EDGE && places[1].loop_index == 0);
    /* Over the slanted side of the hole. */
    CHECK(places[2].standing == FPT_FACE_ON_EDGE && places[2].loop_index == 1);
    CHECK_NEAR(feet[2].distance, 1, 1e-12);
    CHECK(feet[3].flags & FPT_FOOT_BAD_QUERY && places[3].standing == FPT_FACE_UNKNOWN);
    for (int i = 0; i < 3; i++) CHECK(!(feet[i].flags & FPT_FOOT_NOT_PROVEN) && feet[i].lower_bound <= feet[i].distance);
    CHECK_OK(fpt_face_closest(face, points, 4, NULL, same, NULL));
    CHECK_SAME_BITS(feet, same, 3 * sizeof *feet);
    fpt_face_free(face);
}

static void preimages_are_those_of_the_face(void) {
    const double inside[] = {2, 0.8, 0}, in_hole[] = {0.5, 0.5, 0};
    fpt_foot_set *set = NULL;
    size_t count = 9;
    fpt_face *face = triangle_with_hole();
    CHECK_OK(fpt_face_preimage(face, inside, 0, NULL, &set));
    CHECK_OK(fpt_foot_set_count(set, &count));
    CHECK(count == 1);
    fpt_foot_set_free(set);
    CHECK_OK(fpt_face_preimage(face, in_hole, 0, NULL, &set));
    CHECK_OK(fpt_foot_set_count(set, &count));
    CHECK(count == 0);
    fpt_foot_set_free(set);
    fpt_face_free(face);
}

static void a_lifted_curve_is_pulled_back_to_itself(void) {
    static const double knots[] = {0, 0, 0, 0, 1, 1, 1, 1};
    static const double poles[] = {0.1, 0.2, 0, 0.5, 0.9, 0, 0.7, 0.1, 0, 0.9, 0.6, 0};
    fpt_curve *pcurve = make_curve(curve_data(3, 4, knots, poles, NULL)), *image = NULL, *back = NULL;
    fpt_surface *surface = hill();
    fpt_pcurve_set *set = NULL;
    fpt_deviation told, again;
    fpt_lift_options lift;
    fpt_pull_options pull;
    const double hint[2] = {0.1, 0.2};
    double domain[2];
    size_t count = 0;
    fpt_lift_options_init(&lift, sizeof lift);
    lift.tolerance = 1e-8;
    CHECK_OK(fpt_pcurve_lift(surface, pcurve, &lift, &image, &told));
    CHECK(told.bound <= 1e-8 && told.reached <= told.bound && !(told.flags & (FPT_DEVIATION_EXACT | FPT_DEVIATION_NOT_PROVEN)));
    CHECK_OK(fpt_pcurve_deviation(surface, pcurve, image, &again));
    CHECK(again.bound <= 1e-8 && again.flags == 0);
    fpt_pull_options_init(&pull, sizeof pull);
    pull.tolerance = 1e-6;
    pull.hint = hint;
    CHECK_OK(fpt_pcurve_pull(surface, image, &pull, &set));
    CHECK_OK(fpt_pcurve_set_count(set, &count));
    CHECK(count == 1);
    CHECK_OK(fpt_pcurve_set_get(set, 0, &back, &told));
    CHECK(told.bound <= 1e-6 && told.flags == 0);
    CHECK_OK(fpt_curve_domain(back, domain));
    CHECK(domain[0] == 0 && domain[1] == 1);
    for (int i = 0; i <= 10; i++) {
        double a[3], b[3];
        CHECK_OK(fpt_curve_evaluate(back, i / 10.0, 0, a));
        CHECK_OK(fpt_curve_evaluate(pcurve, i / 10.0, 0, b));
        CHECK(fabs(a[0] - b[0]) + fabs(a[1] - b[1]) < 1e-5);
    }
    CHECK_ERROR(fpt_pcurve_set_get(set, 1, &back, NULL), FPT_INVALID_ARGUMENT, "index");
    fpt_pcurve_set_free(set);
    fpt_pcurve_set_free(NULL);
    fpt_curve_free(back);
    fpt_curve_free(image);
    fpt_curve_free(pcurve);
    fpt_surface_free(surface);
}

static void faces_of_trimmed_surfaces_are_those_of_their_splines(void) {
    const double uv[] = {0.5, 0.5, 0, 0.3, 1, 1}, point[] = {1.5, 1.5, 4};
    fpt_surface *surface = hill();
    fpt_support *spline = NULL;
    fpt_trim *trim = NULL;
    fpt_face *face = NULL;
    fpt_face_place places[3];
    fpt_foot_point foot, same;
    CHECK_OK(fpt_support_new(surface, &spline));
    CHECK_OK(fpt_trim_whole(spline, &trim));
    CHECK_OK(fpt_face_of_trim(trim, NULL, &face));
    CHECK_OK(fpt_face_classify(face, uv, 3, NULL, places));
    CHECK(places[0].standing == FPT_FACE_INSIDE && places[1].standing == FPT_FACE_ON_EDGE);
    CHECK(places[2].standing == FPT_FACE_ON_EDGE);
    CHECK_OK(fpt_face_closest(face, point, 1, NULL, &foot, places));
    CHECK_OK(fpt_surface_closest(surface, point, 1, NULL, &same));
    CHECK(foot.distance == same.distance && foot.lower_bound == same.lower_bound);
    fpt_trim_free(trim);
    fpt_support_free(spline);
    fpt_surface_free(surface);
    fpt_face_free(face);
}

static const double turn = 6.28318530717958647693;

static void faces_of_elementary_surfaces_answer_in_angles(void) {
    const double uv[] = {1, 0.3, 0, 0.5, 2, 1.57079632679489661923, 1, 3}, point[] = {0.6, 0.8, 0.5};
    fpt_elementary_data data;
    fpt_support *sphere = NULL;
    fpt_trim *trim = NULL;
    fpt_face *face = NULL;
    fpt_face_place places[4];
    fpt_foot_point foot;
    fpt_foot_set *set = NULL;
    size_t count = 0;
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.kind = FPT_ELEMENTARY_SPHERE;
    data.domain[1] = turn;
    data.domain[2] = -turn / 4;
    data.domain[3] = turn / 4;
    data.x[0] = data.y[1] = data.z[2] = data.first = 1;
    CHECK_OK(fpt_support_elementary(&data, &sphere));
    CHECK_OK(fpt_trim_whole(sphere, &trim));
    CHECK_OK(fpt_face_of_trim(trim, NULL, &face));
    fpt_trim_free(trim);
    fpt_support_free(sphere);
    CHECK_OK(fpt_face_classify(face, uv, 4, NULL, places));
    CHECK(places[0].standing == FPT_FACE_INSIDE && places[0].flags == 0);
    CHECK(places[1].standing == FPT_FACE_ON_EDGE && places[2].standing == FPT_FACE_ON_EDGE);
    CHECK(places[3].standing == FPT_FACE_OUTSIDE);
    CHECK_OK(fpt_face_closest(face, point, 1, NULL, &foot, places));
    CHECK_NEAR(foot.u, atan2(0.8, 0.6), 1e-12);
    CHECK_NEAR(foot.v, atan2(0.5, 1), 1e-12);
    CHECK_NEAR(foot.distance, sqrt(1.25) - 1, 1e-12);
    CHECK(!(foot.flags & FPT_FOOT_NOT_PROVEN) && places[0].standing == FPT_FACE_INSIDE);
    CHECK_OK(fpt_face_preimage(face, foot.point, 0, NULL, &set));
    CHECK_OK(fpt_foot_set_count(set, &count));
    CHECK(count == 1);
    fpt_foot_set_free(set);
    fpt_face_free(face);
}

/* A paraboloid z = u^2 + v^2 over the square of 2 x 2. */
static int32_t bowl(void *user, double u, double v, uint32_t order, double *out) {
    const double values[] = {u, v, u * u + v * v, 1, 0, 2 * u, 0, 1, 2 * v, 0, 0, 2, 0, 0, 0, 0, 0, 2};
    const size_t rows[] = {1, 3, 6};
    (void)user;
    memcpy(out, values, 3 * rows[order] * sizeof(double));
    return (int32_t)order;
}

static void faces_of_functions_say_what_is_proven(void) {
    static const double outer[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0};
    const double uv[] = {0.3, 0.3, 0.9, 0.9, 0.5, 0.5}, point[] = {0.2, 0.3, 2};
    for (int with_bounds = 0; with_bounds < 2; with_bounds++) {
        fpt_surface_callback data;
        fpt_surface *surface = NULL;
        fpt_curve *loop = polygon(outer, 4);
        const fpt_curve *pcurves[1];
        const size_t counts[] = {1};
        fpt_face_data face_data;
        fpt_face *face = NULL;
        fpt_face_place places[3];
        fpt_foot_point foot;
        memset(&data, 0, sizeof data);
        data.struct_size = sizeof data;
        data.evaluate = bowl;
        data.domain[0] = data.domain[2] = -1;
        data.domain[1] = data.domain[3] = 1;
        if (with_bounds) {
            data.speed_bounds[0] = data.speed_bounds[1] = 2.3;
            data.second_bounds[0] = data.second_bounds[2] = 2;
            data.second_bounds[1] = 0.001;
        }
        CHECK_OK(fpt_surface_from_callback(&data, &surface));
        memset(&face_data, 0, sizeof face_data);
        face_data.struct_size = sizeof face_data;
        face_data.surface = surface;
        face_data.loop_count = 1;
        face_data.coedge_counts = counts;
        face_data.pcurves = pcurves;
        pcurves[0] = loop;
        CHECK_OK(fpt_face_new(&face_data, NULL, &face));
        fpt_surface_free(surface);
        fpt_curve_free(loop);
        CHECK_OK(fpt_face_classify(face, uv, 3, NULL, places));
        CHECK(places[0].standing == FPT_FACE_INSIDE && places[1].standing == FPT_FACE_OUTSIDE);
        CHECK(places[2].standing == FPT_FACE_ON_EDGE);
        CHECK(with_bounds ? places[0].flags == 0 : places[0].flags == FPT_STANDING_NOT_PROVEN || places[0].flags == 0);
        CHECK_OK(fpt_face_closest(face, point, 1, NULL, &foot, places));
        CHECK(with_bounds || (foot.flags & FPT_FOOT_NOT_PROVEN && places[0].flags == FPT_STANDING_NOT_PROVEN));
        CHECK(foot.lower_bound <= foot.distance);
        fpt_face_free(face);
    }
}

static int told_times, told_total;
static void tell(void *user, size_t done, size_t total) {
    CHECK(user == &told_times && done <= total);
    told_times++;
    told_total = (int)total;
}
static int stop_later(void *user) { return user == &told_times && told_times > 1; }

static void making_a_face_can_be_stopped_watched_and_limited(void) {
    fpt_surface *surface = hill();
    fpt_support *support = NULL;
    fpt_trim *trim = NULL;
    fpt_face *face = NULL;
    fpt_face_options options;
    CHECK_OK(fpt_support_new(surface, &support));
    CHECK_OK(fpt_trim_whole(support, &trim));
    fpt_face_options_init(&options, sizeof options);
    CHECK(options.struct_size == sizeof options && options.budget == 0 && options.should_stop == NULL);
    options.progress = tell;
    options.user = &told_times;
    CHECK_OK(fpt_face_of_trim(trim, &options, &face));
    CHECK(told_times >= 5 && told_total == 4);
    fpt_face_free(face);
    face = NULL;
    told_times = 0;
    options.should_stop = stop_later;
    CHECK_STATUS(fpt_face_of_trim(trim, &options, &face), FPT_CANCELLED);
    CHECK(face == NULL);
    fpt_face_options_init(&options, sizeof options);
    options.budget = 1;
    CHECK_ERROR(fpt_face_of_trim(trim, &options, &face), FPT_UNSUPPORTED, "budget: 1");
    options.struct_size = 3;
    CHECK_ERROR(fpt_face_of_trim(trim, &options, &face), FPT_INVALID_ARGUMENT, "struct_size");
    /* A caller of a shorter struct. */
    options.struct_size = offsetof(fpt_face_options, should_stop);
    options.budget = 0;
    CHECK_OK(fpt_face_of_trim(trim, &options, &face));
    fpt_face_free(face);
    CHECK_ERROR(fpt_face_of_trim(NULL, NULL, &face), FPT_NULL_ARGUMENT, "trim");
    CHECK_ERROR(fpt_face_of_trim(trim, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    fpt_face_options_init(NULL, 100);
    fpt_trim_free(trim);
    fpt_support_free(support);
    fpt_surface_free(surface);
}

static int stop_at_once(void *user) {
    (void)user;
    return 1;
}

static void what_is_wrong_is_named(void) {
    static const double outside[] = {0.5, 0.5, 0, 1.5, 0.5, 0};
    static const double lifted[] = {0, 0, 0, 1, 1, 1};
    static const double flat[] = {0, 0, 0, 1, 1, 0};
    fpt_surface *surface = plane();
    fpt_curve *leaves = polygon(outside, 2), *in_space = polygon(lifted, 2), *line = polygon(flat, 2), *out = NULL;
    fpt_pcurve_set *set = NULL;
    fpt_face *face = NULL, *good = triangle_with_hole();
    fpt_pull_options pull;
    fpt_lift_options lift;
    fpt_query_options query;
    fpt_face_data data;
    fpt_deviation told;
    fpt_foot_set *feet = NULL;
    const fpt_curve *pcurves[2];
    size_t counts[2] = {1, 1};
    const double nowhere[3] = {INFINITY, 0, 0}, bad_hint[2] = {NAN, 0};
    double uv[2] = {0.2, 0.2};
    fpt_face_place place;

    CHECK_ERROR(fpt_pcurve_pull(NULL, line, NULL, &set), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_pcurve_pull(surface, NULL, NULL, &set), FPT_NULL_ARGUMENT, "edge");
    CHECK_ERROR(fpt_pcurve_pull(surface, line, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    fpt_pull_options_init(&pull, sizeof pull);
    pull.tolerance = -1;
    CHECK_ERROR(fpt_pcurve_pull(surface, line, &pull, &set), FPT_INVALID_ARGUMENT, "tolerance");
    fpt_pull_options_init(&pull, sizeof pull);
    pull.degree = 10;
    CHECK_ERROR(fpt_pcurve_pull(surface, line, &pull, &set), FPT_INVALID_ARGUMENT, "degree");
    fpt_pull_options_init(&pull, sizeof pull);
    pull.hint = bad_hint;
    CHECK_ERROR(fpt_pcurve_pull(surface, line, &pull, &set), FPT_INVALID_ARGUMENT, "hint: entry 0");
    fpt_pull_options_init(&pull, sizeof pull);
    pull.should_stop = stop_at_once;
    CHECK_STATUS(fpt_pcurve_pull(surface, line, &pull, &set), FPT_CANCELLED);
    CHECK(set == NULL);
    pull.struct_size = 3;
    CHECK_STATUS(fpt_pcurve_pull(surface, line, &pull, &set), FPT_INVALID_ARGUMENT);
    CHECK_ERROR(fpt_pcurve_set_count(NULL, counts), FPT_NULL_ARGUMENT, "set");

    CHECK_ERROR(fpt_pcurve_lift(surface, in_space, NULL, &out, NULL), FPT_INVALID_ARGUMENT, "pcurve: poles: pole 1");
    CHECK_ERROR(fpt_pcurve_lift(surface, leaves, NULL, &out, NULL), FPT_INVALID_ARGUMENT, "leaves the domain");
    CHECK_ERROR(fpt_pcurve_lift(surface, NULL, NULL, &out, NULL), FPT_NULL_ARGUMENT, "pcurve");
    fpt_lift_options_init(&lift, sizeof lift);
    lift.exact_degree = 32;
    CHECK_ERROR(fpt_pcurve_lift(surface, line, &lift, &out, NULL), FPT_INVALID_ARGUMENT, "exact_degree");
    lift.exact_degree = 0;
    lift.tolerance = NAN;
    CHECK_ERROR(fpt_pcurve_lift(surface, line, &lift, &out, NULL), FPT_INVALID_ARGUMENT, "tolerance");
    CHECK(out == NULL);
    CHECK_ERROR(fpt_pcurve_deviation(surface, line, NULL, &told), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_pcurve_deviation(surface, leaves, line, &told), FPT_INVALID_ARGUMENT, "leaves the domain");

    memset(&data, 0, sizeof data);
    CHECK_STATUS(fpt_face_new(&data, NULL, &face), FPT_INVALID_ARGUMENT);
    data.struct_size = sizeof data;
    CHECK_ERROR(fpt_face_new(&data, NULL, &face), FPT_NULL_ARGUMENT, "surface");
    data.surface = surface;
    CHECK_ERROR(fpt_face_new(&data, NULL, &face), FPT_INVALID_ARGUMENT, "loops");
    data.loop_count = 2;
    CHECK_ERROR(fpt_face_new(&data, NULL, &face), FPT_NULL_ARGUMENT, "coedge_counts");
    data.coedge_counts = counts;
    CHECK_ERROR(fpt_face_new(&data, NULL, &face), FPT_NULL_ARGUMENT, "pcurves");
    data.pcurves = pcurves;
    pcurves[0] = line;
    pcurves[1] = NULL;
    CHECK_ERROR(fpt_face_new(&data, NULL, &face), FPT_INVALID_ARGUMENT, "pcurve 0 of loop 1 is NULL");
    pcurves[1] = in_space;
    CHECK_ERROR(fpt_face_new(&data, NULL, &face), FPT_INVALID_ARGUMENT, "pcurve 0 of loop 1");
    pcurves[1] = leaves;
    CHECK_ERROR(fpt_face_new(&data, NULL, &face), FPT_INVALID_ARGUMENT, "loop 1");
    counts[1] = SIZE_MAX;
    CHECK_ERROR(fpt_face_new(&data, NULL, &face), FPT_INVALID_ARGUMENT, "coedge_counts");
    counts[0] = 0;
    CHECK_STATUS(fpt_face_new(&data, NULL, &face), FPT_INVALID_ARGUMENT);
    CHECK(face == NULL);

    fpt_query_options_init(&query, sizeof query);
    query.domain[1] = query.domain[3] = 1;
    CHECK_ERROR(fpt_face_classify(good, uv, 1, &query, &place), FPT_UNSUPPORTED, "domain");
    fpt_query_options_init(&query, sizeof query);
    query.scope = FPT_SCOPE_LOCAL;
    CHECK_ERROR(fpt_face_classify(good, uv, 1, &query, &place), FPT_UNSUPPORTED, "scope");
    CHECK_ERROR(fpt_face_classify(good, NULL, 1, NULL, &place), FPT_NULL_ARGUMENT, "uv");
    CHECK_ERROR(fpt_face_classify(good, uv, SIZE_MAX, NULL, &place), FPT_INVALID_ARGUMENT, "uv");
    CHECK_ERROR(fpt_face_classify(NULL, uv, 1, NULL, &place), FPT_NULL_ARGUMENT, "face");
    CHECK_ERROR(fpt_face_closest(good, uv, 1, NULL, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_face_preimage(good, nowhere, 0, NULL, &feet), FPT_INVALID_ARGUMENT, "point: entry 0");
    CHECK_ERROR(fpt_face_preimage(good, uv, -1, NULL, &feet), FPT_INVALID_ARGUMENT, "");
    fpt_query_options_init(&query, sizeof query);
    query.should_stop = stop_at_once;
    CHECK_STATUS(fpt_face_classify(good, uv, 1, &query, &place), FPT_CANCELLED);
    CHECK(place.standing == FPT_FACE_UNKNOWN);
    fpt_face_free(good);
    fpt_face_free(NULL);
    fpt_curve_free(leaves);
    fpt_curve_free(in_space);
    fpt_curve_free(line);
    fpt_surface_free(surface);
}

int main(void) {
    RUN(places_are_told_apart);
    RUN(nearest_points_stay_on_the_face);
    RUN(preimages_are_those_of_the_face);
    RUN(faces_of_trimmed_surfaces_are_those_of_their_splines);
    RUN(faces_of_elementary_surfaces_answer_in_angles);
    RUN(faces_of_functions_say_what_is_proven);
    RUN(making_a_face_can_be_stopped_watched_and_limited);
    RUN(a_lifted_curve_is_pulled_back_to_itself);
    RUN(what_is_wrong_is_named);
    return check_report("faces");
}
