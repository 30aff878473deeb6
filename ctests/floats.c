/* Query points in floats, anywhere in records; and the bytes that handles hold. */
#include "samples.h"

enum { POINTS = 500 };

/* A record as scanners write them: the point after a tag, no alignment in the file. */
struct record {
    unsigned char tag[5], xyz[12], rest[7];
};

/* The same numbers as floats, as doubles, and inside records of 24 bytes that begin anywhere. */
static float floats[3 * POINTS];
static double doubles[3 * POINTS];
static struct record records[POINTS];

static void fill(const double low[3], const double high[3]) {
    double *points = scattered_points(POINTS, low, high, 0.3);
    for (size_t i = 0; i < 3 * POINTS; i++) {
        floats[i] = (float)points[i];
        doubles[i] = (double)floats[i];
    }
    floats[3] = NAN;
    floats[7] = INFINITY;
    doubles[3] = NAN;
    doubles[7] = INFINITY;
    for (size_t i = 0; i < POINTS; i++) memcpy(records[i].xyz, floats + 3 * i, sizeof records[i].xyz);
    free(points);
}

static fpt_foot_point expected[POINTS], found[POINTS];

static void floats_on_a_curve_answer_as_doubles(void) {
    const double low[3] = {-1, -1, -1}, high[3] = {3, 3, 3};
    fpt_curve *curve = make_curve(circle_curve());
    fpt_query_options options = default_options();
    fill(low, high);
    CHECK_OK(fpt_curve_closest(curve, doubles, POINTS, NULL, expected));
    CHECK(expected[1].flags & FPT_FOOT_BAD_QUERY);
    CHECK_OK(fpt_curve_closest_f32(curve, floats, POINTS, NULL, found));
    CHECK_SAME_BITS(found, expected, sizeof found);
    CHECK_OK(fpt_curve_invert(curve, doubles, POINTS, NULL, expected));
    options.point_stride = sizeof records[0];
    CHECK_OK(fpt_curve_invert_f32(curve, (const float *)(const void *)records[0].xyz, POINTS, &options, found));
    CHECK_SAME_BITS(found, expected, sizeof found);
    fpt_curve_free(curve);
}

static void floats_on_a_surface_answer_as_doubles(void) {
    const double low[3] = {100, 100, -50}, high[3] = {500, 400, 100};
    const double none = NAN;
    fpt_surface *surface = make_surface(paper_surface(1));
    fpt_query_options options = default_options();
    double hints[2 * POINTS];
    fill(low, high);
    for (size_t i = 0; i < 2 * POINTS; i++) hints[i] = i % 7 ? 0.5 : none;
    options.hints = hints;
    CHECK_OK(fpt_surface_closest(surface, doubles, POINTS, &options, expected));
    options.point_stride = sizeof records[0];
    CHECK_OK(fpt_surface_closest_f32(surface, (const float *)(const void *)records[0].xyz, POINTS, &options, found));
    CHECK_SAME_BITS(found, expected, sizeof found);
    CHECK_OK(fpt_surface_invert(surface, doubles, POINTS, NULL, expected));
    CHECK_OK(fpt_surface_invert_f32(surface, floats, POINTS, NULL, found));
    CHECK_SAME_BITS(found, expected, sizeof found);
    CHECK_OK(fpt_surface_closest_f32(surface, NULL, 0, NULL, NULL));
    fpt_surface_free(surface);
}

static void floats_in_a_scene_answer_as_doubles(void) {
    const double low[3] = {-1, -1, -1}, high[3] = {3, 3, 3};
    fpt_curve *curve = make_curve(circle_curve());
    fpt_surface *cone = make_surface(cone_surface());
    fpt_scene_member members[2];
    fpt_scene_data data;
    fpt_scene *scene = NULL;
    uint32_t named[POINTS], also[POINTS];
    memset(members, 0, sizeof members);
    memset(&data, 0, sizeof data);
    members[0].struct_size = members[1].struct_size = sizeof members[0];
    members[0].curve = curve;
    members[1].surface = cone;
    data.struct_size = sizeof data;
    data.member_count = 2;
    data.members = members;
    fill(low, high);
    CHECK_OK(fpt_scene_new(&data, &scene));
    CHECK_OK(fpt_scene_closest(scene, doubles, POINTS, NULL, NULL, expected, named));
    CHECK_OK(fpt_scene_closest_f32(scene, floats, POINTS, NULL, NULL, found, also));
    CHECK_SAME_BITS(found, expected, sizeof found);
    CHECK_SAME_BITS(named, also, sizeof named);
    CHECK_OK(fpt_scene_invert(scene, doubles, POINTS, NULL, NULL, expected, named));
    CHECK_OK(fpt_scene_invert_f32(scene, floats, POINTS, NULL, NULL, found, also));
    CHECK_SAME_BITS(found, expected, sizeof found);
    fpt_scene_free(scene);
    fpt_curve_free(curve);
    fpt_surface_free(cone);
}

static void strides_of_floats_are_checked(void) {
    const size_t bad[] = {1, 4, 8, 11, 13, 14, 15, 22};
    fpt_curve *curve = make_curve(cubic_curve());
    fpt_query_options options = default_options();
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        options.point_stride = bad[i];
        CHECK_ERROR(fpt_curve_closest_f32(curve, floats, 2, &options, found), FPT_INVALID_ARGUMENT, "point_stride");
        CHECK_ERROR(fpt_curve_closest(curve, doubles, 2, &options, found), FPT_INVALID_ARGUMENT, "point_stride");
    }
    options.point_stride = 12;
    CHECK_OK(fpt_curve_closest_f32(curve, floats, 2, &options, found));
    CHECK_ERROR(fpt_curve_closest(curve, doubles, 2, &options, found), FPT_INVALID_ARGUMENT, "multiple of 8");
    options.point_stride = (size_t)1 << 60;
    CHECK_ERROR(fpt_curve_closest_f32(curve, floats, 2, &options, found), FPT_INVALID_ARGUMENT, "points");
    CHECK_ERROR(fpt_curve_invert_f32(NULL, floats, 2, NULL, found), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_surface_closest_f32(NULL, floats, 2, NULL, found), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_surface_invert_f32(NULL, floats, 2, NULL, found), FPT_NULL_ARGUMENT, "surface");
    fpt_curve_free(curve);
}

static void memory_grows_with_the_index(void) {
    fpt_curve *curve = make_curve(circle_curve());
    fpt_surface *surface = make_surface(paper_surface(1));
    size_t shape = 0, all = 0;
    CHECK_OK(fpt_curve_memory(curve, &shape));
    CHECK_OK(fpt_curve_prepare(curve));
    CHECK_OK(fpt_curve_memory(curve, &all));
    CHECK(shape > 9 * 4 * 8 + 12 * 8 && shape < 2000 && all > shape + 4 * 3 * 4 * 8 && all < 20000);
    CHECK_OK(fpt_surface_memory(surface, &shape));
    CHECK_OK(fpt_surface_prepare(surface));
    CHECK_OK(fpt_surface_memory(surface, &all));
    CHECK(shape > 28 * 4 * 8 && shape < 4000 && all > shape + 4 * 16 * 4 * 8);
    // 28 KiB, some 100 bytes for each of at most 144 cells, see src/index/reach/rings.rs, and some 200 for each of 48 on a side.
    CHECK(all < 28 * 1024 + 144 * 112 + 48 * 208);
    fpt_surface_free(surface);
    fpt_curve_free(curve);
}

int main(void) {
    RUN(floats_on_a_curve_answer_as_doubles);
    RUN(floats_on_a_surface_answer_as_doubles);
    RUN(floats_in_a_scene_answer_as_doubles);
    RUN(strides_of_floats_are_checked);
    RUN(memory_grows_with_the_index);
    return check_report("floats");
}
