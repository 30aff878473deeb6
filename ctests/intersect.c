/* Intersections: hits of curves, sections, conics, rays; every function, closed forms, misuse, cancelling. */
#include "samples.h"
#include <math.h>

enum { RAYS = 500 };

static fpt_surface *square(void) {
    static const double knots[] = {0, 0, 1, 1};
    static const double poles[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
    return make_surface(surface_data(1, 1, 2, 2, knots, knots, poles, NULL));
}

static fpt_curve *line(double x0, double y0, double z0, double x1, double y1, double z1) {
    static const double knots[] = {0, 0, 1, 1};
    double poles[6] = {0};
    poles[0] = x0, poles[1] = y0, poles[2] = z0, poles[3] = x1, poles[4] = y1, poles[5] = z1;
    return make_curve(curve_data(1, 2, knots, poles, NULL));
}

static fpt_quadric quadric(uint32_t kind, double x, double y, double z, double a, double b, double c, double size) {
    fpt_quadric out;
    memset(&out, 0, sizeof out);
    out.kind = kind;
    out.origin[0] = x, out.origin[1] = y, out.origin[2] = z;
    out.axis[0] = a, out.axis[1] = b, out.axis[2] = c;
    out.size = size;
    return out;
}

static fpt_hit_options defaults(void) {
    fpt_hit_options options;
    fpt_hit_options_init(&options, sizeof options);
    CHECK(options.struct_size == sizeof options);
    return options;
}

static int stop(void *user) {
    ++*(int *)user;
    return 1;
}

static void null_may_be_freed(void) {
    fpt_curve_hits_free(NULL);
    fpt_sections_free(NULL);
    fpt_caster_free(NULL);
    fpt_ray_hits_free(NULL);
    fpt_hit_options_init(NULL, sizeof(fpt_hit_options));
}

static size_t hits_of(fpt_curve_hits *hits) {
    size_t count = 99, left = 99;
    CHECK_OK(fpt_curve_hits_count(hits, &count));
    CHECK_OK(fpt_curve_hits_undecided_count(hits, &left));
    CHECK(left == 0);
    return count;
}

static void curves_meet(void) {
    fpt_curve *a = line(0, 0, 0, 2, 2, 0), *b = line(0, 2, 0, 2, 0, 0);
    fpt_curve_hits *hits = NULL;
    fpt_curve_hit hit;
    CHECK_OK(fpt_intersect_curves(a, b, NULL, &hits));
    fpt_curve_free(b);
    CHECK(hits_of(hits) == 1);
    CHECK_OK(fpt_curve_hits_get(hits, 0, &hit));
    CHECK_NEAR(hit.u, 0.5, 1e-15);
    CHECK_NEAR(hit.w, 0.5, 1e-15);
    CHECK_NEAR(hit.point[1], 1, 1e-15);
    CHECK(hit.nature == FPT_HIT_TRANSVERSAL && hit.multiplicity == 1 && hit.v == 0);
    CHECK_ERROR(fpt_curve_hits_get(hits, 1, &hit), FPT_INVALID_ARGUMENT, "index: 1");
    fpt_curve_hits_free(hits);
    CHECK_OK(fpt_intersect_curves(a, a, NULL, &hits));
    CHECK(hits_of(hits) == 1);
    CHECK_OK(fpt_curve_hits_get(hits, 0, &hit));
    CHECK(hit.nature == FPT_HIT_OVERLAP && hit.w_range[0] == 0 && hit.w_range[1] == 1);
    fpt_curve_hits_free(hits);
    fpt_curve_free(a);
}

static void a_spent_budget_lists_boxes(void) {
    fpt_curve *circle = make_curve(circle_curve());
    fpt_hit_options options = defaults();
    fpt_curve_hits *hits = NULL;
    size_t left = 0;
    double box[6];
    options.budget = 5;
    CHECK_STATUS(fpt_intersect_curves(circle, circle, &options, &hits), FPT_BUDGET_EXHAUSTED);
    CHECK(hits != NULL);
    CHECK_OK(fpt_curve_hits_undecided_count(hits, &left));
    CHECK(left > 0);
    CHECK_OK(fpt_curve_hits_undecided_get(hits, left - 1, box));
    CHECK(box[4] <= box[5]);
    CHECK_ERROR(fpt_curve_hits_undecided_get(hits, left, box), FPT_INVALID_ARGUMENT, "index:");
    fpt_curve_hits_free(hits);
    fpt_curve_free(circle);
}

static void surface_and_quadrics_meet_a_curve(void) {
    fpt_surface *flat = square();
    fpt_curve *rod = line(0.25, 0.5, -1, 0.25, 0.5, 3);
    fpt_quadric ball = quadric(FPT_QUADRIC_SPHERE, 0.25, 0.5, 0, 0, 0, 0, 0.5);
    fpt_curve_hits *hits = NULL;
    fpt_curve_hit hit;
    CHECK_OK(fpt_intersect_surface_curve(flat, rod, NULL, &hits));
    CHECK(hits_of(hits) == 1);
    CHECK_OK(fpt_curve_hits_get(hits, 0, &hit));
    CHECK_NEAR(hit.u, 0.25, 1e-15);
    CHECK_NEAR(hit.v, 0.5, 1e-15);
    CHECK_NEAR(hit.w, 0.25, 1e-15);
    fpt_curve_hits_free(hits);
    CHECK_OK(fpt_intersect_curve_quadric(rod, &ball, NULL, &hits));
    CHECK(hits_of(hits) == 2);
    CHECK_OK(fpt_curve_hits_get(hits, 1, &hit));
    CHECK_NEAR(hit.point[2], 0.5, 1e-15);
    fpt_curve_hits_free(hits);
    fpt_curve_free(rod);
    fpt_surface_free(flat);
}

static void a_surface_is_cut(void) {
    fpt_surface *flat = square();
    fpt_quadric cuts[3] = {quadric(FPT_QUADRIC_CYLINDER, 0.5, 0.5, 7, 0, 0, 1, 0.25),
                           quadric(FPT_QUADRIC_PLANE, 0, 0, 0, 0, 0, 1, 0),
                           quadric(FPT_QUADRIC_SPHERE, 0.5, 0.5, 1, 0, 0, 0, 1)};
    fpt_sections *sections = NULL;
    size_t counts[3], k;
    fpt_branch branch;
    fpt_section_point point;
    fpt_section_region region;
    double points[5000];
    CHECK_OK(fpt_intersect_surface_quadrics(flat, cuts, 3, NULL, &sections));
    fpt_surface_free(flat);
    CHECK_OK(fpt_sections_counts(sections, 0, counts));
    CHECK(counts[0] == 1 && counts[1] == 0 && counts[2] == 0);
    CHECK_OK(fpt_sections_branch_get(sections, 0, 0, &branch));
    CHECK(branch.ends[0] == FPT_SECTION_END_CLOSED && branch.ends[1] == FPT_SECTION_END_CLOSED && branch.tangential == 0);
    CHECK(branch.point_count > 20 && branch.point_count <= 1000);
    CHECK_OK(fpt_sections_branch_points(sections, 0, 0, 5000, points));
    for (k = 0; k < branch.point_count && k < 1000; k++)
        CHECK_NEAR(hypot(points[5 * k] - 0.5, points[5 * k + 1] - 0.5), 0.25, 1e-14);
    CHECK_ERROR(fpt_sections_branch_points(sections, 0, 0, 5 * branch.point_count - 1, points), FPT_INVALID_ARGUMENT, "capacity");
    CHECK_ERROR(fpt_sections_branch_get(sections, 0, 1, &branch), FPT_INVALID_ARGUMENT, "index");
    CHECK_OK(fpt_sections_counts(sections, 1, counts));
    CHECK(counts[0] == 0 && counts[2] == 1);
    CHECK_OK(fpt_sections_region_get(sections, 1, 0, &region));
    CHECK(region.overlaps == 1 && region.domain[1] == 1);
    CHECK_ERROR(fpt_sections_region_get(sections, 1, 1, &region), FPT_INVALID_ARGUMENT, "index");
    CHECK_OK(fpt_sections_counts(sections, 2, counts));
    CHECK(counts[0] == 0 && counts[1] == 1);
    CHECK_OK(fpt_sections_point_get(sections, 2, 0, &point));
    CHECK(point.arms == 0);
    CHECK_NEAR(point.u, 0.5, 1e-6);
    CHECK_ERROR(fpt_sections_point_get(sections, 2, 1, &point), FPT_INVALID_ARGUMENT, "index");
    CHECK_ERROR(fpt_sections_counts(sections, 3, counts), FPT_INVALID_ARGUMENT, "section: 3");
    fpt_sections_free(sections);
}

static void quadrics_meet_in_conics(void) {
    fpt_quadric ball = quadric(FPT_QUADRIC_SPHERE, 0, 0, 0, 0, 0, 0, 1);
    fpt_quadric other = quadric(FPT_QUADRIC_SPHERE, 1, 0, 0, 0, 0, 0, 1);
    fpt_quadric tube = quadric(FPT_QUADRIC_CYLINDER, 0.3, 0, 0, 0, 1, 1, 0.9);
    fpt_conic conics[4];
    size_t count = 9;
    CHECK_OK(fpt_intersect_quadrics(&ball, &other, 1e-9, conics, &count));
    CHECK(count == 1 && conics[0].kind == FPT_CONIC_ELLIPSE);
    CHECK_NEAR(conics[0].center[0], 0.5, 1e-14);
    CHECK_NEAR(conics[0].lengths[1], sqrt(0.75), 1e-14);
    CHECK_ERROR(fpt_intersect_quadrics(&ball, &ball, 1e-9, conics, &count), FPT_UNSUPPORTED, "same");
    CHECK_ERROR(fpt_intersect_quadrics(&ball, &tube, 1e-9, conics, &count), FPT_UNSUPPORTED, "conics");
    other.kind = 77;
    CHECK_ERROR(fpt_intersect_quadrics(&ball, &other, 1e-9, conics, &count), FPT_INVALID_ARGUMENT, "kind 77");
}

static void rays_hit(void) {
    static double origins[3 * RAYS], directions[3 * RAYS];
    static fpt_ray_hit one[RAYS], many[RAYS], all[4 * RAYS];
    static size_t starts[RAYS + 1];
    static uint32_t flags[RAYS];
    fpt_surface *cone = make_surface(cone_surface());
    fpt_caster *caster = NULL;
    fpt_ray_hits *hits = NULL;
    fpt_hit_options options = defaults();
    size_t total = 0, sum = 0, k;
    double reach[2] = {-1e9, 1e9};
    int asked = 0;
    for (k = 0; k < RAYS; k++) {
        origins[3 * k] = 30.0 * cos((double)k), origins[3 * k + 1] = 30.0 * sin((double)k), origins[3 * k + 2] = 0.01 * (double)k;
        directions[3 * k] = -cos(1.01 * (double)k), directions[3 * k + 1] = -sin(1.01 * (double)k), directions[3 * k + 2] = 0.02;
    }
    directions[3 * 7] = NAN;
    CHECK_OK(fpt_caster_new(cone, NULL, &caster));
    fpt_surface_free(cone);
    options.threads = 1;
    CHECK_OK(fpt_caster_first(caster, origins, directions, RAYS, reach, &options, one));
    options.threads = 3;
    CHECK_OK(fpt_caster_first(caster, origins, directions, RAYS, reach, &options, many));
    CHECK_SAME_BITS(one, many, sizeof one);
    CHECK(one[7].flags == (FPT_RAY_BAD_RAY | FPT_RAY_NOT_PROVEN) && one[7].count == 0);
    CHECK_OK(fpt_caster_nearest(caster, origins, directions, RAYS, reach, &options, many));
    for (k = 0; k < RAYS; k++) {
        CHECK(many[k].count == (one[k].count > 0));
        many[k].count = one[k].count;
    }
    CHECK_SAME_BITS(one, many, sizeof one);
    CHECK_OK(fpt_caster_all(caster, origins, directions, RAYS, reach, &options, &hits));
    CHECK_OK(fpt_ray_hits_count(hits, &total));
    CHECK(total > 0 && total <= 4 * RAYS);
    CHECK_OK(fpt_ray_hits_get(hits, 4 * RAYS, all));
    CHECK_OK(fpt_ray_hits_starts(hits, RAYS + 1, starts));
    CHECK_OK(fpt_ray_hits_flags(hits, RAYS, flags));
    for (k = 0; k < RAYS; k++) {
        sum += one[k].count;
        CHECK(starts[k + 1] - starts[k] == one[k].count);
        if (one[k].count > 0) CHECK(all[starts[k]].t == one[k].t);
        CHECK(flags[k] == (k == 7 ? (uint32_t)(FPT_RAY_BAD_RAY | FPT_RAY_NOT_PROVEN) : 0));
    }
    CHECK(sum == total);
    CHECK_ERROR(fpt_ray_hits_get(hits, total - 1, all), FPT_INVALID_ARGUMENT, "capacity");
    CHECK_ERROR(fpt_ray_hits_starts(hits, RAYS, starts), FPT_INVALID_ARGUMENT, "capacity");
    CHECK_ERROR(fpt_ray_hits_flags(hits, 1, flags), FPT_INVALID_ARGUMENT, "capacity");
    fpt_ray_hits_free(hits);
    options.threads = 1;
    options.should_stop = stop;
    options.user = &asked;
    CHECK_STATUS(fpt_caster_first(caster, origins, directions, RAYS, NULL, &options, one), FPT_CANCELLED);
    CHECK(asked > 0 && isnan(one[RAYS - 1].t) && one[RAYS - 1].flags == FPT_RAY_NOT_PROVEN);
    asked = 0;
    CHECK_STATUS(fpt_caster_nearest(caster, origins, directions, RAYS, NULL, &options, many), FPT_CANCELLED);
    CHECK(asked > 0 && isnan(many[RAYS - 1].t) && many[RAYS - 1].flags == FPT_RAY_NOT_PROVEN);
    asked = 0;
    CHECK_STATUS(fpt_caster_all(caster, origins, directions, RAYS, NULL, &options, &hits), FPT_CANCELLED);
    CHECK_OK(fpt_ray_hits_flags(hits, RAYS, flags));
    CHECK(asked > 0 && flags[RAYS - 1] == FPT_RAY_NOT_PROVEN);
    fpt_ray_hits_free(hits);
    CHECK_OK(fpt_caster_first(caster, NULL, NULL, 0, NULL, NULL, NULL));
    CHECK_OK(fpt_caster_nearest(caster, NULL, NULL, 0, NULL, NULL, NULL));
    fpt_caster_free(caster);
}

static void misuse_is_named(void) {
    fpt_curve *rod = line(0, 0, 0, 1, 0, 0);
    fpt_surface *flat = square();
    fpt_curve_hits *hits = NULL;
    fpt_sections *sections = NULL;
    fpt_caster *caster = NULL;
    fpt_ray_hit record;
    fpt_ray_hits *all = NULL;
    fpt_quadric bad = quadric(FPT_QUADRIC_PLANE, 0, 0, 0, 0, 0, 0, 0);
    fpt_quadric level = quadric(FPT_QUADRIC_PLANE, 0.5, 0.5, 0, 1, 0.1, 0, 0);
    fpt_section_region region;
    fpt_hit_options options = defaults();
    size_t count, counts[3];
    int asked = 0;
    CHECK_ERROR(fpt_intersect_curves(NULL, rod, NULL, &hits), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_intersect_curves(rod, rod, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_intersect_surface_curve(flat, NULL, NULL, &hits), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_intersect_curve_quadric(rod, NULL, NULL, &hits), FPT_NULL_ARGUMENT, "quadric");
    CHECK_ERROR(fpt_intersect_curve_quadric(rod, &bad, NULL, &hits), FPT_INVALID_ARGUMENT, "normal");
    CHECK_ERROR(fpt_intersect_surface_quadrics(flat, &bad, 1, NULL, &sections), FPT_INVALID_ARGUMENT, "quadric 0");
    CHECK_ERROR(fpt_intersect_surface_quadrics(flat, &bad, 0, NULL, &sections), FPT_INVALID_ARGUMENT, "count");
    CHECK_ERROR(fpt_intersect_surface_quadrics(flat, &bad, (size_t)-1, NULL, &sections), FPT_INVALID_ARGUMENT, "quadrics");
    options.tolerance = -1;
    CHECK_ERROR(fpt_intersect_curves(rod, rod, &options, &hits), FPT_INVALID_ARGUMENT, "tolerance");
    options = defaults();
    options.chord = NAN;
    CHECK_ERROR(fpt_intersect_curves(rod, rod, &options, &hits), FPT_INVALID_ARGUMENT, "chord");
    options = defaults();
    options.reserved = 3;
    CHECK_ERROR(fpt_intersect_curves(rod, rod, &options, &hits), FPT_INVALID_ARGUMENT, "reserved");
    options = defaults();
    options.struct_size = 3;
    CHECK_ERROR(fpt_intersect_curves(rod, rod, &options, &hits), FPT_INVALID_ARGUMENT, "struct_size");
    options = defaults();
    options.should_stop = stop;
    options.user = &asked;
    CHECK_STATUS(fpt_intersect_curves(rod, rod, &options, &hits), FPT_CANCELLED);
    CHECK(hits != NULL && asked > 0);
    CHECK_OK(fpt_curve_hits_count(hits, &count));
    CHECK(count == 0);
    CHECK_OK(fpt_curve_hits_undecided_count(hits, &count));
    CHECK(count == 1);
    fpt_curve_hits_free(hits);
    asked = 0;
    options.threads = 1;
    CHECK_STATUS(fpt_intersect_surface_quadrics(flat, &level, 1, &options, &sections), FPT_CANCELLED);
    CHECK(sections != NULL && asked > 0);
    CHECK_OK(fpt_sections_counts(sections, 0, counts));
    CHECK(counts[0] == 0 && counts[2] == 1);
    CHECK_OK(fpt_sections_region_get(sections, 0, 0, &region));
    CHECK(region.overlaps == 0 && region.domain[1] > region.domain[0]);
    fpt_sections_free(sections);
    sections = NULL;
    CHECK_ERROR(fpt_caster_new(NULL, NULL, &caster), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_caster_first(NULL, NULL, NULL, 0, NULL, NULL, &record), FPT_NULL_ARGUMENT, "caster");
    CHECK_ERROR(fpt_caster_nearest(NULL, NULL, NULL, 0, NULL, NULL, &record), FPT_NULL_ARGUMENT, "caster");
    CHECK_OK(fpt_caster_new(flat, NULL, &caster));
    CHECK_ERROR(fpt_caster_first(caster, NULL, NULL, 1, NULL, NULL, &record), FPT_NULL_ARGUMENT, "origins");
    CHECK_ERROR(fpt_caster_all(caster, NULL, NULL, 1, NULL, NULL, &all), FPT_NULL_ARGUMENT, "origins");
    CHECK_ERROR(fpt_curve_hits_count(NULL, &count), FPT_NULL_ARGUMENT, "hits");
    CHECK_ERROR(fpt_ray_hits_count(NULL, &count), FPT_NULL_ARGUMENT, "hits");
    CHECK(sections == NULL && all == NULL);
    fpt_caster_free(caster);
    fpt_surface_free(flat);
    fpt_curve_free(rod);
}

int main(void) {
    RUN(null_may_be_freed);
    RUN(curves_meet);
    RUN(a_spent_budget_lists_boxes);
    RUN(surface_and_quadrics_meet_a_curve);
    RUN(a_surface_is_cut);
    RUN(quadrics_meet_in_conics);
    RUN(rays_hit);
    RUN(misuse_is_named);
    return check_report("intersect");
}
