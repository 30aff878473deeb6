/*
 * A face on a sphere under four parametrisations of it: by angles, as NURBS, with the parameters exchanged, and with its poles and its seam
 * elsewhere, where the face is cut at the seam. Writes trims.svg into the folder that is named: above, the domain with the loops; below, the
 * face in space, which stays what it is.
 */
#include <footpoint.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double turn = 6.28318530717958647693;

static void check(fpt_status status) {
    if (status == FPT_OK) return;
    fprintf(stderr, "%s: %s\n", fpt_status_name(status), fpt_last_error());
    exit(1);
}

/* A sphere of radius 2 by longitude and latitude. */
static fpt_support *sphere(const double *x, const double *y, const double *z) {
    fpt_elementary_data data;
    fpt_support *out = NULL;
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.kind = FPT_ELEMENTARY_SPHERE;
    data.first = 2;
    data.domain[1] = turn;
    data.domain[2] = -turn / 4;
    data.domain[3] = turn / 4;
    memcpy(data.x, x, sizeof data.x);
    memcpy(data.y, y, sizeof data.y);
    memcpy(data.z, z, sizeof data.z);
    check(fpt_support_elementary(&data, &out));
    return out;
}

static fpt_coedge_data coedge(uint32_t kind, const double *values, size_t count) {
    fpt_coedge_data data;
    memset(&data, 0, sizeof data);
    data.kind = kind;
    data.edge = SIZE_MAX;
    if (count > 0) memcpy(data.values, values, count * sizeof(double));
    return data;
}

/* A patch with a wavy side, a round hole and a triangular one. */
static fpt_trim *patch(const fpt_support *support) {
    static const double wave[] = {1.2, -0.9, 0, 2.2, -1.4, 0, 3.2, 0, 0, 4.2, -1.4, 0, 5, -0.9, 0};
    static const double knots[] = {0, 0, 0, 0, 0.5, 1, 1, 1, 1};
    static const double corners[] = {3.6, -0.2, 3.9, 0.5, 4.5, 0.1, 3.6, -0.2};
    const double right[] = {0, 5, -0.9, 0.9}, top[] = {1, 0.9, 5, 1.2}, left[] = {0, 1.2, 0.9, -0.9};
    const double round[] = {2.2, 0.2, 0.6, 0, 0, -0.4, 0, turn};
    fpt_curve_data spline;
    fpt_curve *low = NULL;
    fpt_coedge_data outer[4], hole, triangle;
    fpt_loop_data loops[3];
    fpt_trim_data data;
    fpt_trim *out = NULL;
    memset(&spline, 0, sizeof spline);
    spline.struct_size = sizeof spline;
    spline.degree = 3;
    spline.pole_count = 5;
    spline.knots = knots;
    spline.poles = wave;
    check(fpt_curve_new(&spline, &low));
    outer[0] = coedge(FPT_PCURVE_SPLINE, NULL, 0);
    outer[0].curve = low;
    outer[1] = coedge(FPT_PCURVE_ISOLINE, right, 4);
    outer[2] = coedge(FPT_PCURVE_ISOLINE, top, 4);
    outer[3] = coedge(FPT_PCURVE_ISOLINE, left, 4);
    hole = coedge(FPT_PCURVE_ARC, round, 8);
    triangle = coedge(FPT_PCURVE_POLYLINE, NULL, 0);
    triangle.points = corners;
    triangle.point_count = 4;
    memset(loops, 0, sizeof loops);
    loops[0].coedges = outer;
    loops[0].coedge_count = 4;
    loops[1].coedges = &hole;
    loops[2].coedges = &triangle;
    loops[1].coedge_count = loops[2].coedge_count = 1;
    loops[1].is_inner = loops[2].is_inner = 1;
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.support = support;
    data.loops = loops;
    data.loop_count = 3;
    check(fpt_trim_new(&data, &out));
    fpt_curve_free(low);
    return out;
}

static void tell(const char *name, const fpt_trim *trim, const fpt_change_summary *summary) {
    fpt_trim_report *report = NULL;
    fpt_trim_summary found;
    size_t edges = 0, loops = 0;
    uint32_t flipped = 0;
    check(fpt_trim_report_new(trim, 1e-3, &report));
    check(fpt_trim_report_summary(report, &found));
    check(fpt_trim_counts(trim, &edges, &loops, &flipped));
    printf("%-22s %u loops, %u defects, normal %s", name, (unsigned)loops, (unsigned)found.finding_count, flipped ? "turned" : "kept");
    if (summary != NULL) printf(", curves off by at most %.1e (%s)", summary->deviation, summary->proven ? "proven" : "measured");
    printf("\n");
    fpt_trim_report_free(report);
}

int main(int count, char **words) {
    static const double x[] = {1, 0, 0}, y[] = {0, 1, 0}, z[] = {0, 0, 1};
    static const char *const titles[] = {"angles", "NURBS", "NURBS, u and v exchanged", "angles about another axis"};
    static const double unit[] = {0, 1}, view[] = {0.9, 0.35, -0.35};
    static const uint32_t arcs[] = {0, 2};
    const char *const folder = count > 1 ? words[1] : ".";
    fpt_support *here = sphere(x, y, z), *tilted = sphere(y, z, x);
    fpt_trim *faces[4] = {NULL, NULL, NULL, NULL};
    fpt_relation *stay = NULL;
    fpt_transform *exchange = NULL;
    fpt_change_options options;
    fpt_change_summary summary;
    char path[1024], *picture;
    size_t length = 0;
    FILE *file;

    faces[0] = patch(here);
    tell(titles[0], faces[0], NULL);
    fpt_change_options_init(&options, sizeof options);
    options.tolerance = 1e-4;
    options.replacement = FPT_REPLACEMENT_SPLINE;
    check(fpt_trim_to_nurbs(faces[0], arcs, &options, &faces[1], &summary));
    tell(titles[1], faces[1], &summary);
    check(fpt_relation_linear(unit, unit, &stay));
    check(fpt_transform_new(stay, stay, 1, &exchange));
    check(fpt_trim_reparametrise(faces[1], exchange, &options, &faces[2], &summary));
    tell(titles[2], faces[2], &summary);
    check(fpt_trim_follow(faces[0], tilted, &options, &faces[3], &summary));
    tell(titles[3], faces[3], &summary);

    check(fpt_trim_picture((const fpt_trim *const *)faces, titles, 4, view, 0, NULL, &length));
    picture = malloc(length + 1);
    if (picture == NULL) return 1;
    check(fpt_trim_picture((const fpt_trim *const *)faces, titles, 4, view, length + 1, picture, &length));
    snprintf(path, sizeof path, "%s/trims.svg", folder);
    file = fopen(path, "w");
    if (file == NULL || fwrite(picture, 1, length, file) != length || fclose(file) != 0) {
        fprintf(stderr, "%s: cannot be written\n", path);
        return 1;
    }
    printf("%s\n", path);
    free(picture);
    for (int i = 0; i < 4; i++) fpt_trim_free(faces[i]);
    fpt_transform_free(exchange);
    fpt_relation_free(stay);
    fpt_support_free(here);
    fpt_support_free(tilted);
    return 0;
}
