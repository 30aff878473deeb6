/* Scenes that cannot be, and calls on scenes that are refused: each with a text that names parameter and index. */
#include "samples.h"

static const double unit[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

static int failing(void *user, double u, uint32_t derivatives, double *out) {
    (void)user;
    (void)derivatives;
    out[0] = u;
    out[1] = out[2] = 0;
    return 0;
}

static void trace_nothing(void *user, size_t query, uint32_t step, double u, double v, double residual) {
    (void)user;
    (void)query;
    (void)step;
    (void)u;
    (void)v;
    (void)residual;
}

/* What `out` holds before each call; a refusal leaves it there. */
static char sentinel;

static void refuse(const fpt_scene_data *data, fpt_status expected, const char *words) {
    fpt_scene *out = (fpt_scene *)(void *)&sentinel;
    CHECK_ERROR(fpt_scene_new(data, &out), expected, words);
    CHECK((void *)out == (void *)&sentinel);
}

/* Three members over a curve; `k` of them is the caller's. */
static fpt_scene_member members[3];

static fpt_scene_data three(const fpt_curve *curve) {
    fpt_scene_data data;
    memset(&data, 0, sizeof data);
    memset(members, 0, sizeof members);
    for (int i = 0; i < 3; i++) {
        members[i].struct_size = sizeof members[i];
        members[i].curve = curve;
    }
    data.struct_size = sizeof data;
    data.member_count = 3;
    data.members = members;
    return data;
}

static void members_that_cannot_be_are_named(void) {
    fpt_curve *curve = make_curve(cubic_curve()), *function = NULL;
    fpt_surface *surface = make_surface(paper_surface(0));
    fpt_curve_callback callback;
    fpt_scene_data data = three(curve);
    fpt_scene *scene = NULL;
    refuse(NULL, FPT_NULL_ARGUMENT, "data");
    CHECK_ERROR(fpt_scene_new(&data, NULL), FPT_NULL_ARGUMENT, "out");
    data.member_count = 0;
    refuse(&data, FPT_INVALID_ARGUMENT, "members: a scene needs at least one");
    data.member_count = SIZE_MAX / 2;
    refuse(&data, FPT_INVALID_ARGUMENT, "members: ");
    data = three(curve);
    data.members = NULL;
    refuse(&data, FPT_NULL_ARGUMENT, "members");
    data = three(curve);
    members[2].curve = NULL;
    refuse(&data, FPT_INVALID_ARGUMENT, "members: member 2 has neither");
    data = three(curve);
    members[1].surface = surface;
    refuse(&data, FPT_INVALID_ARGUMENT, "members: member 1 has a curve and a surface");
    memset(&callback, 0, sizeof callback);
    callback.struct_size = sizeof callback;
    callback.evaluate = failing;
    callback.domain[1] = 1;
    CHECK_OK(fpt_curve_from_callback(&callback, &function));
    data = three(curve);
    members[1].curve = function;
    refuse(&data, FPT_UNSUPPORTED, "members: member 1 is given by a function");
    data = three(curve);
    CHECK_OK(fpt_scene_new(&data, &scene));
    fpt_scene_free(scene);
    fpt_curve_free(function);
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

static void sizes_of_structs_are_checked(void) {
    fpt_curve *curve = make_curve(cubic_curve());
    fpt_scene_data data = three(curve);
    struct {
        fpt_scene_member member;
        uint64_t tail;
    } longer[2];
    fpt_scene *scene = NULL;
    data.struct_size = sizeof data - 8;
    refuse(&data, FPT_INVALID_ARGUMENT, "data: struct_size");
    data.struct_size = SIZE_MAX;
    refuse(&data, FPT_INVALID_ARGUMENT, "data: struct_size");
    data = three(curve);
    members[0].struct_size = sizeof members[0] - 8;
    refuse(&data, FPT_INVALID_ARGUMENT, "members: struct_size");
    data = three(curve);
    members[2].struct_size = 0;
    refuse(&data, FPT_INVALID_ARGUMENT, "members: struct_size");
    /* Members of a newer header: longer, and fine while the rest is zero. */
    data = three(curve);
    memset(longer, 0, sizeof longer);
    for (int i = 0; i < 2; i++) {
        longer[i].member = members[i];
        longer[i].member.struct_size = sizeof longer[i];
    }
    data.member_count = 2;
    data.members = &longer[0].member;
    CHECK_OK(fpt_scene_new(&data, &scene));
    fpt_scene_free(scene);
    longer[1].tail = 1;
    refuse(&data, FPT_UNSUPPORTED, "members: struct_size");
    longer[1].tail = 0;
    longer[1].member.struct_size = sizeof longer[1].member;
    refuse(&data, FPT_INVALID_ARGUMENT, "members: member 1 has struct_size");
    fpt_curve_free(curve);
}

static void placements_that_are_not_rigid_are_named(void) {
    fpt_curve *curve = make_curve(cubic_curve());
    fpt_scene_data data = three(curve);
    const double bad[3] = {NAN, INFINITY, 1e101};
    double placement[12];
    char text[64];
    fpt_scene *scene = NULL;
    members[1].placement = placement;
    for (int i = 0; i < 12; i++) {
        for (int k = 0; k < 3; k++) {
            memcpy(placement, unit, sizeof placement);
            placement[i] = bad[k];
            snprintf(text, sizeof text, "members: member 1: placement[%d] is", i);
            refuse(&data, FPT_INVALID_ARGUMENT, text);
        }
    }
    memcpy(placement, unit, sizeof placement);
    placement[5] = 1 + 1e-8;
    refuse(&data, FPT_INVALID_ARGUMENT, "members: member 1: placement is not rigid");
    placement[5] = -1;
    refuse(&data, FPT_INVALID_ARGUMENT, "members: member 1: placement mirrors");
    memset(placement, 0, sizeof placement);
    refuse(&data, FPT_INVALID_ARGUMENT, "members: member 1: placement is not rigid");
    memcpy(placement, unit, sizeof placement);
    placement[5] = 1 + 4e-10;
    placement[3] = 1e100;
    CHECK_OK(fpt_scene_new(&data, &scene));
    fpt_scene_free(scene);
    fpt_curve_free(curve);
}

static void queries_that_cannot_be_are_refused(void) {
    fpt_curve *curve = make_curve(cubic_curve());
    fpt_scene_data data = three(curve);
    const double point[6] = {0, 0, 0, 1, 1, 1}, hints[4] = {0, 0, INFINITY, 0};
    const float single[3] = {0, 0, 0};
    const uint32_t numbers[2] = {0, 3}, good[2] = {0, UINT32_MAX};
    fpt_query_options options = default_options();
    fpt_foot_point feet[2], before[2];
    uint32_t named[2] = {7, 7};
    fpt_scene *scene = NULL;
    CHECK_OK(fpt_scene_new(&data, &scene));
    memset(feet, 0x55, sizeof feet);
    memcpy(before, feet, sizeof feet);
    CHECK_ERROR(fpt_scene_closest(NULL, point, 1, NULL, NULL, feet, named), FPT_NULL_ARGUMENT, "scene");
    CHECK_ERROR(fpt_scene_closest(scene, NULL, 1, NULL, NULL, feet, named), FPT_NULL_ARGUMENT, "points");
    CHECK_ERROR(fpt_scene_closest(scene, point, 1, NULL, NULL, NULL, named), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_scene_invert(NULL, point, 1, NULL, NULL, feet, named), FPT_NULL_ARGUMENT, "scene");
    CHECK_ERROR(fpt_scene_closest_f32(NULL, single, 1, NULL, NULL, feet, named), FPT_NULL_ARGUMENT, "scene");
    CHECK_ERROR(fpt_scene_invert_f32(scene, NULL, 1, NULL, NULL, feet, named), FPT_NULL_ARGUMENT, "points");
    CHECK_ERROR(fpt_scene_closest(scene, point, SIZE_MAX, NULL, NULL, feet, named), FPT_INVALID_ARGUMENT, "points");
    CHECK_ERROR(fpt_scene_closest(scene, point, 2, NULL, numbers, feet, named), FPT_INVALID_ARGUMENT,
                "hint_members: entry 1 is 3, the scene has 3 members");
    options.hints = hints;
    CHECK_ERROR(fpt_scene_closest(scene, point, 1, &options, NULL, feet, named), FPT_NULL_ARGUMENT, "hint_members");
    CHECK_ERROR(fpt_scene_closest(scene, point, 2, &options, good, feet, named), FPT_INVALID_ARGUMENT, "hints: hint 1");
    options = default_options();
    options.domain[1] = 1;
    CHECK_ERROR(fpt_scene_closest(scene, point, 1, &options, NULL, feet, named), FPT_UNSUPPORTED, "domain");
    options = default_options();
    options.trace = trace_nothing;
    CHECK_ERROR(fpt_scene_closest(scene, point, 1, &options, NULL, feet, named), FPT_UNSUPPORTED, "trace");
    options = default_options();
    options.accuracy = -1;
    CHECK_ERROR(fpt_scene_closest(scene, point, 1, &options, NULL, feet, named), FPT_INVALID_ARGUMENT, "accuracy");
    options = default_options();
    options.point_stride = 10;
    CHECK_ERROR(fpt_scene_closest_f32(scene, single, 1, &options, NULL, feet, named), FPT_INVALID_ARGUMENT,
                "point_stride: 10 is not a multiple of 4 of at least 12");
    CHECK_SAME_BITS(feet, before, sizeof feet);
    CHECK(named[0] == 7 && named[1] == 7);
    fpt_scene_free(scene);
    fpt_curve_free(curve);
}

static void the_other_functions_check_their_arguments(void) {
    fpt_curve *curve = make_curve(cubic_curve()), *out_curve;
    fpt_surface *out_surface;
    fpt_scene_data data = three(curve);
    const double point[3] = {0, 0, 1};
    double out[36], normals[3], distance;
    size_t size;
    uint32_t named = 0, wrong = 3;
    fpt_foot_point foot;
    fpt_scene *scene = NULL;
    CHECK_OK(fpt_scene_new(&data, &scene));
    CHECK_ERROR(fpt_scene_count(NULL, &size), FPT_NULL_ARGUMENT, "scene");
    CHECK_ERROR(fpt_scene_count(scene, NULL), FPT_NULL_ARGUMENT, "out_count");
    CHECK_ERROR(fpt_scene_box(scene, NULL), FPT_NULL_ARGUMENT, "out_box");
    CHECK_ERROR(fpt_scene_memory(NULL, &size), FPT_NULL_ARGUMENT, "scene");
    CHECK_ERROR(fpt_scene_memory(scene, NULL), FPT_NULL_ARGUMENT, "out_memory");
    CHECK_ERROR(fpt_curve_memory(curve, NULL), FPT_NULL_ARGUMENT, "out_memory");
    CHECK_ERROR(fpt_surface_memory(NULL, &size), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_scene_prepare(NULL), FPT_NULL_ARGUMENT, "scene");
    CHECK_ERROR(fpt_scene_placement(scene, 3, out), FPT_INVALID_ARGUMENT, "member: 3 is not below the count of 3");
    CHECK_ERROR(fpt_scene_placement(scene, 0, NULL), FPT_NULL_ARGUMENT, "out_placement");
    CHECK_ERROR(fpt_scene_shape(scene, UINT32_MAX, &out_curve, &out_surface), FPT_INVALID_ARGUMENT, "member: ");
    CHECK_ERROR(fpt_scene_shape(scene, 0, NULL, &out_surface), FPT_NULL_ARGUMENT, "out_curve");
    CHECK_ERROR(fpt_scene_shape(scene, 0, &out_curve, NULL), FPT_NULL_ARGUMENT, "out_surface");
    CHECK_ERROR(fpt_scene_evaluate(scene, 3, 0, 0, 0, out), FPT_INVALID_ARGUMENT, "member");
    CHECK_ERROR(fpt_scene_evaluate(scene, 0, NAN, 0, 0, out), FPT_INVALID_ARGUMENT, "u: ");
    CHECK_ERROR(fpt_scene_evaluate(scene, 0, 0, 0, 32, out), FPT_INVALID_ARGUMENT, "derivatives");
    CHECK_ERROR(fpt_scene_evaluate(scene, 0, 0, 0, 0, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_OK(fpt_scene_closest(scene, point, 1, NULL, NULL, &foot, &named));
    CHECK_ERROR(fpt_scene_normals(NULL, point, &foot, &named, 1, normals, &distance, NULL), FPT_NULL_ARGUMENT, "scene");
    CHECK_ERROR(fpt_scene_normals(scene, point, NULL, &named, 1, normals, NULL, NULL), FPT_NULL_ARGUMENT, "feet");
    CHECK_ERROR(fpt_scene_normals(scene, point, &foot, NULL, 1, normals, NULL, NULL), FPT_NULL_ARGUMENT, "members");
    CHECK_ERROR(fpt_scene_normals(scene, NULL, &foot, &named, 1, normals, &distance, NULL), FPT_NULL_ARGUMENT, "points");
    CHECK_ERROR(fpt_scene_normals(scene, point, &foot, &named, 1, NULL, NULL, NULL), FPT_NULL_ARGUMENT, "out_normals");
    CHECK_ERROR(fpt_scene_normals(scene, point, &foot, &wrong, 1, normals, NULL, NULL), FPT_INVALID_ARGUMENT,
                "members: entry 0 is 3");
    foot.u = 77;
    CHECK_ERROR(fpt_scene_normals(scene, point, &foot, &named, 1, normals, NULL, NULL), FPT_INVALID_ARGUMENT,
                "feet: u of entry 0");
    fpt_scene_free(scene);
    fpt_curve_free(curve);
}

int main(void) {
    RUN(members_that_cannot_be_are_named);
    RUN(sizes_of_structs_are_checked);
    RUN(placements_that_are_not_rigid_are_named);
    RUN(queries_that_cannot_be_are_refused);
    RUN(the_other_functions_check_their_arguments);
    return check_report("misuse_scene");
}
