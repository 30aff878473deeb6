/* Twenty thousand calls with any arguments at all: NULL here and there, odd numbers, wrong counts, truncated options. Each returns a
 * status of the list, tells why when it refuses, and hands out nothing when it does; nothing crashes, nothing leaks (valgrind). */
#include <footpoint.h>

#include "check.h"
#include "samples.h"

#include <math.h>
#include <stdlib.h>

enum { ROOM = 4096 };

static uint64_t state = 7;
static size_t below(size_t limit) { return (size_t)(next_random(&state) * (double)limit); }

static double odd(void) {
    static const double all[] = {0, -0.0, 1, -1, 0.5, 0.25, 1e-300, 1e300, -1e300, NAN, HUGE_VAL, -HUGE_VAL, 250, 1e100, 2e100, 1e-7};
    return all[below(sizeof all / sizeof *all)];
}

/* The pointer, or NULL once in twelve times. */
static void *perhaps(void *pointer) { return below(12) == 0 ? NULL : pointer; }

/* Sorted now and then, so that shapes come to be as well. */
static void fill(double *out, size_t count, int sorted) {
    double x = odd();
    for (size_t i = 0; i < count; i++) {
        out[i] = sorted ? x : odd();
        if (below(3) == 0) x += 1;
    }
}

static long refused, answered;

static int is_ok(fpt_status status) {
    const int listed = status >= FPT_OK && status <= FPT_OUT_OF_MEMORY;
    CHECK_MESSAGE(listed, "status %d: %s", (int)status, fpt_last_error());
    if (status != FPT_OK) CHECK_MESSAGE(fpt_last_error()[0] != 0, "no text for %s", fpt_status_name(status));
    if (status == FPT_OK) answered++;
    else refused++;
    return status == FPT_OK || status == FPT_BUDGET_EXHAUSTED;
}

static fpt_query_options odd_options(void) {
    fpt_query_options out = default_options();
    if (below(8) == 0) out.struct_size = below(sizeof out + 1);
    if (below(4) == 0) out.tolerance = odd();
    if (below(4) == 0) out.accuracy = odd();
    if (below(4) == 0) out.method = (uint32_t)below(6);
    if (below(4) == 0) out.scope = (uint32_t)below(4);
    if (below(4) == 0) out.point_stride = below(64);
    if (below(4) == 0) out.reserved = (uint32_t)below(2);
    if (below(4) == 0) fill(out.domain, 4, below(2) == 0);
    if (below(4) == 0) out.budget = below(50);
    out.threads = (uint32_t)below(3);
    return out;
}

static fpt_extrema_options odd_extrema(void) {
    fpt_extrema_options out;
    fpt_extrema_options_init(&out, sizeof out);
    if (below(8) == 0) out.struct_size = below(sizeof out + 1);
    if (below(4) == 0) out.radius = odd();
    if (below(4) == 0) out.accuracy = odd();
    if (below(4) == 0) out.nearest = below(4);
    if (below(4) == 0) out.minima_only = (uint32_t)below(3);
    if (below(4) == 0) fill(out.domain, 4, 1);
    return out;
}

static double numbers[ROOM], results[ROOM], more[ROOM];
static fpt_foot_point feet[64];
static uint32_t flags[64];

static void a_set(fpt_status status, fpt_foot_set **set) {
    size_t count = 0;
    fpt_foot_member member;
    if (is_ok(status)) {
        CHECK_OK(fpt_foot_set_count(*set, &count));
        (void)is_ok(fpt_foot_set_get(*set, below(count + 2), &member));
        fpt_foot_set_free(*set);
    } else {
        CHECK(*set == NULL);
    }
}

static void shapes_of_anything(void) {
    for (int i = 0; i < 4000; i++) {
        fpt_curve *curve = NULL;
        fpt_surface *surface = NULL;
        const int sorted = below(4) != 0;
        fill(numbers, 64, sorted);
        fill(more, 64, sorted);
        fill(results, 512, 0);
        if (below(2) == 0)
            for (int k = 0; k < 512; k++) results[k] = next_random(&state);
        fpt_curve_data c = curve_data(below(5), below(8), perhaps(numbers), perhaps(results), below(3) == 0 ? more : NULL);
        if (below(9) == 0) c.struct_size = below(sizeof c);
        if (is_ok(fpt_curve_new(perhaps(&c), perhaps(&curve)))) fpt_curve_free(curve);
        else CHECK(curve == NULL);
        fpt_surface_data s = surface_data(below(4), below(4), below(6), below(6), perhaps(numbers), perhaps(more), perhaps(results), NULL);
        if (below(9) == 0) s.struct_size = below(sizeof s);
        if (is_ok(fpt_surface_new(perhaps(&s), perhaps(&surface)))) fpt_surface_free(surface);
        else CHECK(surface == NULL);
    }
}

static void queries_of_anything(void) {
    fpt_curve *round = make_curve(circle_curve());
    fpt_surface *paper = make_surface(paper_surface(1));
    fpt_scene *scene = NULL;
    fpt_scene_member members[2] = {{.struct_size = sizeof members[0], .curve = round}, {.struct_size = sizeof members[0], .surface = paper}};
    const fpt_scene_data both = {.struct_size = sizeof both, .member_count = 2, .members = members};
    CHECK_OK(fpt_scene_new(&both, &scene));
    for (int i = 0; i < 12000; i++) {
        const fpt_curve *c = perhaps(round);
        const fpt_surface *s = perhaps(paper);
        const fpt_scene *all = perhaps(scene);
        const size_t count = below(3);
        const fpt_query_options some = odd_options();
        const fpt_query_options *options = perhaps((void *)&some);
        const fpt_extrema_options extrema = odd_extrema();
        fpt_foot_set *set = NULL;
        fill(numbers, 64, 0);
        double *points = perhaps(numbers), *out = perhaps(results);
        fpt_foot_point *found = perhaps(feet);
        for (size_t k = 0; k < count; k++) feet[k].u = odd(), feet[k].v = odd();
        switch (i % 20) {
        case 0: is_ok(fpt_curve_evaluate(c, odd(), (uint32_t)below(40), out)); break;
        case 1: is_ok(fpt_surface_evaluate(s, odd(), odd(), (uint32_t)below(40), out)); break;
        case 2: is_ok(fpt_curve_evaluate_many(c, points, count, (uint32_t)below(5), out)); break;
        case 3: is_ok(fpt_surface_evaluate_many(s, points, count, (uint32_t)below(5), out)); break;
        case 4: is_ok(fpt_curve_closest(c, points, count, options, found)); break;
        case 5: is_ok(fpt_surface_closest(s, points, count, options, found)); break;
        case 6: is_ok(fpt_surface_invert_f32(s, (const float *)points, count, options, found)); break;
        case 7: is_ok(fpt_scene_closest(all, points, count, options, NULL, found, perhaps(flags))); break;
        case 8: a_set(fpt_curve_preimage(c, points, odd(), options, &set), &set); break;
        case 9: a_set(fpt_surface_preimage(s, points, odd(), options, &set), &set); break;
        case 10: a_set(fpt_curve_extrema(c, points, perhaps((void *)&extrema), &set), &set); break;
        case 11: a_set(fpt_surface_extrema(s, points, perhaps((void *)&extrema), &set), &set); break;
        case 12: a_set(fpt_surface_on_line(s, points, numbers + 3, numbers + 6, odd(), options, &set), &set); break;
        case 13: is_ok(fpt_curve_project(c, points, count, numbers + 9, options, found)); break;
        case 14: is_ok(fpt_surface_normals(s, points, feet, count, out, perhaps(more), perhaps(flags))); break;
        case 15: is_ok(fpt_curve_tangents(c, feet, count, out, perhaps(flags))); break;
        case 16: is_ok(fpt_surface_uncertainty(s, feet, count, odd(), out)); break;
        case 17: is_ok(fpt_curve_path(c, points, count, options, found, perhaps(results), perhaps(flags))); break;
        case 18: is_ok(fpt_surface_unwrap(s, points, numbers + 2, out)); break;
        default: is_ok(fpt_scene_evaluate(all, (uint32_t)below(4), odd(), odd(), (uint32_t)below(40), out)); break;
        }
    }
    fpt_scene_free(scene);
    fpt_curve_free(round);
    fpt_surface_free(paper);
}

int main(void) {
    RUN(shapes_of_anything);
    RUN(queries_of_anything);
    printf("%ld answers, %ld refusals\n", answered, refused);
    CHECK(answered > 1000 && refused > 1000);
    return check_report("misuse_random");
}
