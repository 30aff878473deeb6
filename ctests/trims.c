/* Trimmed surfaces and parameter transforms: every function, then what is refused. */
#include "samples.h"

#include <stdlib.h>

static const double pi = 3.14159265358979323846;

static fpt_elementary_data sphere_data(double radius) {
    fpt_elementary_data data;
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.kind = FPT_ELEMENTARY_SPHERE;
    data.domain[1] = 2 * pi;
    data.domain[2] = -pi / 2;
    data.domain[3] = pi / 2;
    data.x[0] = data.y[1] = data.z[2] = 1;
    data.first = radius;
    return data;
}

static fpt_support *elementary(fpt_elementary_data data) {
    fpt_support *out = NULL;
    CHECK_OK(fpt_support_elementary(&data, &out));
    return out;
}

static fpt_relation *linear(double a, double b, double c, double d) {
    const double from[] = {a, b}, to[] = {c, d};
    fpt_relation *out = NULL;
    CHECK_OK(fpt_relation_linear(from, to, &out));
    return out;
}

static fpt_coedge_data isoline(double fixed, double at, double from, double to) {
    fpt_coedge_data data;
    memset(&data, 0, sizeof data);
    data.kind = FPT_PCURVE_ISOLINE;
    data.edge = SIZE_MAX;
    data.values[0] = fixed;
    data.values[1] = at;
    data.values[2] = from;
    data.values[3] = to;
    return data;
}

/* A rectangle of a surface with a round hole and a seven-cornered one. */
static fpt_trim *patch(const fpt_support *support) {
    static const double corners[] = {2.0, 0.0, 2.1, 0.3, 2.4, 0.2, 2.0, 0.0};
    static const double knots[] = {0, 0, 0, 1, 1, 1}, poles[] = {1, -1, 0, 2, -1.2, 0, 3, -1, 0};
    fpt_curve *low = make_curve(curve_data(2, 3, knots, poles, NULL));
    fpt_coedge_data outer[4], arc, polygon;
    fpt_loop_data loops[3];
    fpt_trim_data data;
    fpt_trim *out = NULL;
    outer[0] = isoline(0, 0, 0, 0);
    outer[0].kind = FPT_PCURVE_SPLINE;
    outer[0].curve = low;
    outer[1] = isoline(0, 3, -1, 1);
    outer[2] = isoline(1, 1, 3, 1);
    outer[3] = isoline(0, 1, 1, -1);
    arc = isoline(0, 0, 0, 0);
    arc.kind = FPT_PCURVE_ARC;
    arc.values[0] = 1.5;
    arc.values[2] = 0.2;
    arc.values[5] = -0.3;
    arc.values[7] = 2 * pi;
    polygon = isoline(0, 0, 0, 0);
    polygon.kind = FPT_PCURVE_POLYLINE;
    polygon.points = corners;
    polygon.point_count = 4;
    memset(loops, 0, sizeof loops);
    loops[0].coedges = outer;
    loops[0].coedge_count = 4;
    loops[1].is_inner = loops[2].is_inner = 1;
    loops[1].coedges = &arc;
    loops[2].coedges = &polygon;
    loops[1].coedge_count = loops[2].coedge_count = 1;
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.support = support;
    data.loops = loops;
    data.loop_count = 3;
    CHECK_OK(fpt_trim_new(&data, &out));
    fpt_curve_free(low);
    return out;
}

static size_t findings(const fpt_trim *trim) {
    fpt_trim_report *report = NULL;
    fpt_trim_summary summary;
    memset(&summary, 0, sizeof summary);
    CHECK_OK(fpt_trim_report_new(trim, 0, &report));
    CHECK_OK(fpt_trim_report_summary(report, &summary));
    for (size_t i = 0; i < summary.finding_count; i++) {
        fpt_trim_finding finding;
        CHECK_OK(fpt_trim_report_get(report, i, &finding));
        CHECK(finding.kind <= FPT_FINDING_UNDECIDED);
    }
    fpt_trim_report_free(report);
    return summary.finding_count;
}

static void null_may_be_freed(void) {
    fpt_relation_free(NULL);
    fpt_transform_free(NULL);
    fpt_support_free(NULL);
    fpt_trim_free(NULL);
    fpt_trim_report_free(NULL);
}

static double square(void *user, double x) { return *(double *)user * x * x; }
static double root(void *user, double y) { return sqrt(y / *(double *)user); }
static int released;
static void release(void *user) { released += *(double *)user == 2; }

static void relations_map_both_ways(void) {
    static const double unit[] = {0, 1}, places[] = {0, 0.25, 0.5, 1}, broken[] = {5, 3, 2.5, -1};
    double factor = 2, from[2], to[2], there[4], back[4];
    fpt_relation *circle = NULL, *steps = NULL, *inverse = NULL, *function = NULL, *both = NULL, *joined = NULL;
    fpt_relation *first = linear(0, 1, 2, 3), *second = linear(1, 4, 3, 10);
    const fpt_relation *pieces[2];
    fpt_relation_callback callback;
    CHECK_OK(fpt_relation_circle(0, 2 * pi, unit, unit, &circle));
    CHECK_OK(fpt_relation_inverse(circle, &inverse));
    CHECK_OK(fpt_relation_apply(circle, places, 4, there));
    CHECK_OK(fpt_relation_apply(inverse, there, 4, back));
    for (int i = 0; i < 4; i++) CHECK_NEAR(back[i], places[i], 1e-15);
    CHECK(there[0] == 0 && there[2] == 0.5 && there[3] == 1);
    CHECK_NEAR(there[1], 0.25, 1e-15);
    CHECK_OK(fpt_relation_through(places, broken, 4, &steps));
    CHECK_OK(fpt_relation_domain(steps, from, to));
    CHECK(from[0] == 0 && from[1] == 1 && to[0] == 5 && to[1] == -1);
    CHECK_OK(fpt_relation_then(circle, steps, &both));
    CHECK_OK(fpt_relation_apply(both, places, 4, there));
    CHECK(there[0] == 5 && there[2] == 2.5 && there[3] == -1);
    pieces[0] = first;
    pieces[1] = second;
    CHECK_OK(fpt_relation_piecewise(pieces, 2, &joined));
    CHECK_OK(fpt_relation_domain(joined, from, to));
    CHECK(from[1] == 4 && to[1] == 10);
    memset(&callback, 0, sizeof callback);
    callback.struct_size = sizeof callback;
    callback.forward = square;
    callback.backward = root;
    callback.user = &factor;
    callback.release = release;
    callback.domain[0] = 1;
    callback.domain[1] = 3;
    CHECK_OK(fpt_relation_from_callback(&callback, &function));
    CHECK_OK(fpt_relation_domain(function, from, to));
    CHECK(to[0] == 2 && to[1] == 18 && released == 0);
    fpt_relation_free(function);
    CHECK(released == 1);
    fpt_relation_free(circle);
    fpt_relation_free(steps);
    fpt_relation_free(inverse);
    fpt_relation_free(both);
    fpt_relation_free(joined);
    fpt_relation_free(first);
    fpt_relation_free(second);
}

static void transforms_map_both_ways(void) {
    static const double uv[] = {0.25, 0.5, 1, 0};
    double domain[4], image[4], there[4], back[4];
    int32_t keeps = -1;
    fpt_relation *u = linear(0, 1, 3, 1), *v = linear(0, 1, -1, 1);
    fpt_transform *transform = NULL, *inverse = NULL, *both = NULL;
    CHECK_OK(fpt_transform_new(u, v, 1, &transform));
    fpt_relation_free(u);
    fpt_relation_free(v);
    CHECK_OK(fpt_transform_inverse(transform, &inverse));
    CHECK_OK(fpt_transform_then(transform, inverse, &both));
    CHECK_OK(fpt_transform_domain(transform, domain, image, &keeps));
    CHECK(image[0] == -1 && image[1] == 1 && image[2] == 1 && image[3] == 3 && keeps == 1);
    CHECK_OK(fpt_transform_apply(transform, uv, 2, there));
    CHECK(there[0] == 0 && there[1] == 2.5 && there[2] == -1 && there[3] == 1);
    CHECK_OK(fpt_transform_apply(both, uv, 2, back));
    for (int i = 0; i < 4; i++) CHECK_NEAR(back[i], uv[i], 1e-15);
    fpt_transform_free(transform);
    fpt_transform_free(inverse);
    fpt_transform_free(both);
}

static void supports_evaluate_and_match(void) {
    static const uint32_t arcs[] = {0, 2};
    static const double uv[] = {0, 0, 1, 0.5, 2, -1.57079632679489661923};
    double domain[4], points[9], images[6];
    fpt_support *sphere = elementary(sphere_data(2)), *other = NULL;
    fpt_surface *form = NULL;
    fpt_transform *exact = NULL, *found = NULL;
    fpt_foot_point feet[3];
    CHECK_OK(fpt_support_domain(sphere, domain));
    CHECK(domain[1] == 2 * pi && domain[3] == pi / 2);
    CHECK_OK(fpt_support_evaluate(sphere, uv, 3, points));
    CHECK(points[0] == 2 && points[1] == 0 && points[2] == 0 && points[6] == 0 && points[8] == -2);
    CHECK_OK(fpt_support_spline(sphere, arcs, &form));
    CHECK_OK(fpt_support_new(form, &other));
    CHECK_OK(fpt_support_spline_transform(sphere, arcs, &exact));
    CHECK_OK(fpt_transform_apply(exact, uv, 3, images));
    CHECK_OK(fpt_support_match_many(sphere, other, 0, uv, 3, 1, feet));
    for (int i = 0; i < 3; i++) {
        CHECK(feet[i].flags == 0);
        CHECK_NEAR(feet[i].u, images[2 * i], 1e-12);
        CHECK_NEAR(feet[i].v, images[2 * i + 1], 1e-12);
    }
    CHECK_OK(fpt_support_match(sphere, other, 0, &found));
    CHECK_ERROR(fpt_support_spline_transform(other, arcs, &exact), FPT_INVALID_ARGUMENT, "not elementary");
    fpt_transform_free(exact);
    fpt_transform_free(found);
    fpt_surface_free(form);
    fpt_support_free(sphere);
    fpt_support_free(other);
}

static void a_whole_face_comes_apart(void) {
    static const double shares[] = {0, 0.5, 1};
    size_t edges = 0, loops = 0, coedges = 0;
    uint32_t flipped = 7, inner = 7, reversed = 7;
    double domain[2], uv[6], points[9], edge_points[9], pole[3];
    fpt_coedge_data coedge;
    fpt_curve *curve = NULL;
    fpt_support *sphere = elementary(sphere_data(2)), *again = NULL;
    fpt_trim *trim = NULL;
    CHECK_OK(fpt_trim_whole(sphere, &trim));
    fpt_support_free(sphere);
    CHECK_OK(fpt_trim_support(trim, &again));
    fpt_support_free(again);
    CHECK_OK(fpt_trim_counts(trim, &edges, &loops, &flipped));
    CHECK(edges == 3 && loops == 1 && flipped == 0);
    CHECK_OK(fpt_trim_loop(trim, 0, &inner, &coedges));
    CHECK(inner == 0 && coedges == 4);
    CHECK_OK(fpt_trim_coedge(trim, 0, 3, &coedge, domain));
    CHECK(coedge.kind == FPT_PCURVE_ISOLINE && coedge.edge == 1 && (coedge.flags & FPT_COEDGE_REVERSED));
    CHECK(coedge.values[0] == 0 && coedge.values[1] == 0 && domain[0] == -pi / 2 && domain[1] == pi / 2);
    CHECK_OK(fpt_trim_coedge_evaluate(trim, 0, 3, shares, 3, uv, points, edge_points));
    for (int i = 0; i < 9; i++) CHECK_NEAR(points[i], edge_points[i], 1e-14);
    CHECK_OK(fpt_trim_edge(trim, 1, &curve, pole, &reversed));
    CHECK(curve != NULL && reversed == 0);
    fpt_curve_free(curve);
    CHECK_OK(fpt_trim_edge(trim, 0, &curve, pole, &reversed));
    CHECK(curve == NULL && pole[2] == -2);
    CHECK(findings(trim) == 0);
    fpt_trim_free(trim);
}

static void a_face_goes_to_nurbs_and_back(void) {
    static const uint32_t arcs[] = {0, 2};
    fpt_support *sphere = elementary(sphere_data(2)), *form_support = NULL;
    fpt_surface *form = NULL;
    fpt_trim *trim = patch(sphere), *there = NULL, *back = NULL, *turned = NULL, *followed = NULL, *changed = NULL;
    fpt_change_options options;
    fpt_change_summary summary;
    fpt_relation *u = linear(0, 1, 1, 0), *v = linear(0, 1, 0, 1);
    fpt_transform *turn = NULL, *exact = NULL;
    fpt_coedge_data coedge;
    fpt_curve *curve = NULL;
    uint32_t flipped = 0;
    size_t count = 0;
    double points[8], parameters[4];
    CHECK(findings(trim) == 0);
    fpt_change_options_init(&options, sizeof options);
    options.tolerance = 1e-6;
    options.replacement = FPT_REPLACEMENT_SPLINE;
    CHECK_OK(fpt_trim_to_nurbs(trim, arcs, &options, &there, &summary));
    CHECK(summary.proven == 1 && summary.deviation <= 1e-6 && summary.deviation > 0);
    CHECK(findings(there) == 0);
    CHECK_OK(fpt_trim_coedge(there, 0, 0, &coedge, NULL));
    CHECK(coedge.kind == FPT_PCURVE_SPLINE);
    CHECK_OK(fpt_trim_coedge_curve(there, 0, 0, &curve));
    fpt_curve_free(curve);
    CHECK_ERROR(fpt_trim_coedge_curve(there, 0, 1, &curve), FPT_INVALID_ARGUMENT, "no spline");
    options.replacement = FPT_REPLACEMENT_VERTICES;
    fpt_trim_free(there);
    CHECK_OK(fpt_trim_to_nurbs(trim, arcs, &options, &there, NULL));
    CHECK_OK(fpt_trim_to_elementary(there, sphere, arcs, &options, &back, &summary));
    CHECK_OK(fpt_trim_coedge(back, 2, 0, &coedge, NULL));
    CHECK(coedge.kind == FPT_PCURVE_POLYLINE && coedge.point_count == 4);
    CHECK_OK(fpt_trim_coedge_points(back, 2, 0, 4, points, parameters));
    CHECK_NEAR(points[2], 2.1, 1e-14);
    CHECK_ERROR(fpt_trim_coedge_points(back, 2, 0, 3, points, NULL), FPT_INVALID_ARGUMENT, "capacity");
    CHECK_OK(fpt_transform_new(u, v, 0, &turn));
    CHECK_OK(fpt_trim_reparametrise(there, turn, &options, &turned, &summary));
    CHECK_OK(fpt_trim_counts(turned, &count, &count, &flipped));
    CHECK(flipped == 1 && summary.deviation == 0);
    CHECK(findings(turned) == 0);
    options.tolerance = 1e-4;
    CHECK_OK(fpt_support_spline(sphere, arcs, &form));
    CHECK_OK(fpt_support_new(form, &form_support));
    CHECK_OK(fpt_trim_follow(trim, form_support, &options, &followed, &summary));
    CHECK(summary.proven == 1 && summary.deviation <= 1e-4);
    CHECK_OK(fpt_support_spline_transform(sphere, arcs, &exact));
    CHECK_OK(fpt_trim_change(trim, exact, form_support, NULL, &changed, NULL));
    fpt_trim_free(changed);
    CHECK_ERROR(fpt_trim_change(trim, turn, form_support, NULL, &changed, NULL), FPT_INVALID_ARGUMENT, "transform");
    options.replacement = 9;
    CHECK_ERROR(fpt_trim_to_nurbs(trim, arcs, &options, &changed, NULL), FPT_INVALID_ARGUMENT, "replacement");
    fpt_surface_free(form);
    fpt_support_free(form_support);
    fpt_support_free(sphere);
    fpt_relation_free(u);
    fpt_relation_free(v);
    fpt_transform_free(turn);
    fpt_transform_free(exact);
    fpt_trim_free(trim);
    fpt_trim_free(there);
    fpt_trim_free(back);
    fpt_trim_free(turned);
    fpt_trim_free(followed);
}

static void two_faces_are_merged(void) {
    fpt_elementary_data data = sphere_data(2);
    fpt_support *supports[3];
    fpt_trim *faces[2] = {NULL, NULL}, *whole = NULL;
    size_t edges = 0, loops = 0, coedges = 0;
    uint32_t flag = 0;
    const double ends[] = {0, 2, 5};
    data.domain[2] = -1;
    data.domain[3] = 1;
    for (int i = 0; i < 3; i++) {
        data.domain[0] = i == 2 ? 0 : ends[i];
        data.domain[1] = i == 2 ? 5 : ends[i + 1];
        supports[i] = elementary(data);
        if (i < 2) CHECK_OK(fpt_trim_whole(supports[i], &faces[i]));
    }
    CHECK_OK(fpt_trim_merge(faces[0], faces[1], 0, supports[2], NULL, &whole));
    CHECK_OK(fpt_trim_counts(whole, &edges, &loops, &flag));
    CHECK_OK(fpt_trim_loop(whole, 0, &flag, &coedges));
    CHECK(edges == 6 && loops == 1 && coedges == 6);
    fpt_trim_free(whole);
    CHECK_ERROR(fpt_trim_merge(faces[0], faces[1], 2, supports[2], NULL, &whole), FPT_INVALID_ARGUMENT, "direction");
    CHECK_ERROR(fpt_trim_merge(faces[1], faces[0], 0, supports[2], NULL, &whole), FPT_INVALID_ARGUMENT, "other");
    for (int i = 0; i < 2; i++) fpt_trim_free(faces[i]);
    for (int i = 0; i < 3; i++) fpt_support_free(supports[i]);
}

static void text_and_pictures_tell_their_length_first(void) {
    static const char *const titles[] = {"a <face>"};
    fpt_support *sphere = elementary(sphere_data(2));
    fpt_trim *trim = patch(sphere), *again = NULL;
    const fpt_trim *list[] = {trim};
    size_t length = 0, picture_length = 0;
    char *text, *picture;
    CHECK_OK(fpt_trim_to_json(trim, 0, NULL, &length));
    text = malloc(length + 1);
    CHECK_ERROR(fpt_trim_to_json(trim, length, text, &length), FPT_INVALID_ARGUMENT, "capacity");
    CHECK_OK(fpt_trim_to_json(trim, length + 1, text, &length));
    CHECK(strlen(text) == length);
    CHECK_OK(fpt_trim_from_json(text, length, &again));
    CHECK(findings(again) == 0);
    fpt_trim_free(again);
    CHECK_ERROR(fpt_trim_from_json(text, length - 1, &again), FPT_INVALID_ARGUMENT, "json: ");
    CHECK_ERROR(fpt_trim_from_json("\xff", 1, &again), FPT_INVALID_ARGUMENT, "UTF-8");
    CHECK_OK(fpt_trim_picture(list, titles, 1, NULL, 0, NULL, &picture_length));
    picture = malloc(picture_length + 1);
    CHECK_OK(fpt_trim_picture(list, titles, 1, NULL, picture_length + 1, picture, &picture_length));
    CHECK(strstr(picture, "a &lt;face>") != NULL && strncmp(picture, "<svg", 4) == 0);
    CHECK_ERROR(fpt_trim_picture(list, NULL, 0, NULL, 0, NULL, &length), FPT_INVALID_ARGUMENT, "faces");
    free(text);
    free(picture);
    fpt_trim_free(trim);
    fpt_support_free(sphere);
}

static void what_is_wrong_is_refused_by_name(void) {
    static const double up[] = {0, 1}, down[] = {1, 0}, nan_pair[] = {0, NAN};
    fpt_elementary_data data = sphere_data(-1);
    fpt_support *support = NULL, *sphere = elementary(sphere_data(1));
    fpt_relation *relation = NULL;
    fpt_trim *trim = NULL;
    fpt_trim_data face;
    fpt_loop_data chain;
    fpt_edge_data edge;
    fpt_coedge_data coedge = isoline(0, 0, 0, 1);
    CHECK_ERROR(fpt_support_elementary(&data, &support), FPT_INVALID_ARGUMENT, "radius: -1");
    data.kind = 99;
    CHECK_ERROR(fpt_support_elementary(&data, &support), FPT_INVALID_ARGUMENT, "kind: 99");
    data.kind = FPT_ELEMENTARY_REVOLUTION;
    CHECK_ERROR(fpt_support_elementary(&data, &support), FPT_NULL_ARGUMENT, "curve");
    data.struct_size = 8;
    CHECK_ERROR(fpt_support_elementary(&data, &support), FPT_INVALID_ARGUMENT, "struct_size");
    CHECK_ERROR(fpt_support_elementary(NULL, &support), FPT_NULL_ARGUMENT, "data");
    CHECK_ERROR(fpt_relation_linear(down, up, &relation), FPT_INVALID_ARGUMENT, "from");
    CHECK_ERROR(fpt_relation_linear(up, nan_pair, &relation), FPT_INVALID_ARGUMENT, "to: entry 1");
    CHECK_ERROR(fpt_relation_circle(0, 1, up, up, &relation), FPT_INVALID_ARGUMENT, "form");
    CHECK_ERROR(fpt_relation_linear(up, up, NULL), FPT_NULL_ARGUMENT, "out");
    memset(&face, 0, sizeof face);
    memset(&chain, 0, sizeof chain);
    memset(&edge, 0, sizeof edge);
    face.struct_size = sizeof face;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_NULL_ARGUMENT, "support");
    face.support = sphere;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "loops: none");
    face.loops = &chain;
    face.loop_count = SIZE_MAX;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "loops");
    face.loop_count = 1;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "loop 0 has no coedges");
    chain.coedge_count = 1;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "loops: loop 0: coedges: must not be NULL");
    chain.coedges = &coedge;
    coedge.kind = 9;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "loops: loop 0: coedge 0: kind: 9");
    coedge.kind = FPT_PCURVE_POLYLINE;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "points: 0 given");
    coedge.kind = FPT_PCURVE_SPLINE;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "curve: must not be NULL");
    coedge = isoline(0, NAN, 0, 1);
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "at: is not finite");
    coedge = isoline(0, 0, 0, 1);
    coedge.edge = 0;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "uses edge 0, there are 0");
    face.edges = &edge;
    face.edge_count = 1;
    edge.point[1] = INFINITY;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "the point of edge 0");
    edge.point[1] = 0;
    face.flipped = 2;
    CHECK_ERROR(fpt_trim_new(&face, &trim), FPT_INVALID_ARGUMENT, "flipped: 2");
    face.flipped = 1;
    CHECK_OK(fpt_trim_new(&face, &trim));
    CHECK(findings(trim) > 0);
    CHECK_ERROR(fpt_trim_coedge(trim, 1, 0, &coedge, NULL), FPT_INVALID_ARGUMENT, "loop_index: 1");
    CHECK_ERROR(fpt_trim_edge(trim, 1, NULL, NULL, NULL), FPT_INVALID_ARGUMENT, "index: 1");
    fpt_trim_free(trim);
    fpt_support_free(sphere);
}

/* A plane of 10 x 10, and loops of one polyline each; corners of all of them one after the other, each loop closed by its first one. */
static fpt_trim *polygons(const double *corners, const size_t *counts, size_t loop_count) {
    fpt_elementary_data plane = sphere_data(0);
    fpt_support *support;
    fpt_coedge_data coedges[4];
    fpt_loop_data loops[4];
    fpt_trim_data data;
    fpt_trim *out = NULL;
    plane.kind = FPT_ELEMENTARY_PLANE;
    plane.domain[0] = plane.domain[2] = 0;
    plane.domain[1] = plane.domain[3] = 10;
    support = elementary(plane);
    memset(loops, 0, sizeof loops);
    for (size_t i = 0; i < loop_count; i++) {
        coedges[i] = isoline(0, 0, 0, 0);
        coedges[i].kind = FPT_PCURVE_POLYLINE;
        coedges[i].points = corners;
        coedges[i].point_count = counts[i];
        corners += 2 * counts[i];
        loops[i].is_inner = i > 0;
        loops[i].coedges = &coedges[i];
        loops[i].coedge_count = 1;
    }
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.support = support;
    data.loops = loops;
    data.loop_count = loop_count;
    CHECK_OK(fpt_trim_new(&data, &out));
    fpt_support_free(support);
    return out;
}

/* The first finding of a kind; its number is SIZE_MAX when there is none. */
static fpt_trim_finding finding_of(const fpt_trim *trim, uint32_t kind) {
    fpt_trim_report *report = NULL;
    fpt_trim_summary summary;
    fpt_trim_finding found, none;
    memset(&none, 0, sizeof none);
    none.kind = UINT32_MAX;
    CHECK_OK(fpt_trim_report_new(trim, 1e-6, &report));
    CHECK_OK(fpt_trim_report_summary(report, &summary));
    CHECK(summary.tolerance == 1e-6 && summary.proven == 1);
    for (size_t i = 0; i < summary.finding_count; i++) {
        CHECK_OK(fpt_trim_report_get(report, i, &found));
        if (found.kind == kind) none = found;
    }
    CHECK_ERROR(fpt_trim_report_get(report, summary.finding_count, &found), FPT_INVALID_ARGUMENT, "index");
    CHECK_ERROR(fpt_trim_report_get(report, SIZE_MAX, &found), FPT_INVALID_ARGUMENT, "index");
    CHECK_ERROR(fpt_trim_report_get(report, 0, NULL), FPT_NULL_ARGUMENT, "out");
    fpt_trim_report_free(report);
    return none;
}

static void every_defect_is_reported_with_its_numbers(void) {
    static const double good[] = {1, 1, 9, 1, 9, 9, 1, 9, 1, 1, 2, 2, 2, 4, 4, 4, 4, 2, 2, 2};
    static const double open[] = {1, 1, 9, 1, 9, 9, 1, 1.1};
    static const double turned[] = {1, 1, 1, 9, 9, 9, 9, 1, 1, 1};
    static const double crossing[] = {1, 1, 9, 1, 9, 9, 1, 9, 1, 1, 2, 2, 2, 5, 5, 5, 5, 2, 2, 2, 4, 4, 4, 7, 7, 7, 7, 4, 4, 4};
    static const double touching[] = {1, 1, 9, 1, 9, 9, 1, 9, 1, 1, 2, 2, 2, 5, 5, 5, 5, 2, 2, 2, 5, 5, 5, 7, 7, 7, 7, 5, 5, 5};
    static const double outside[] = {-0.5, 1, 9, 1, 9, 9, -0.5, 9, -0.5, 1};
    static const double away[] = {1, 1, 5, 1, 5, 5, 1, 5, 1, 1, 6, 6, 6, 8, 8, 8, 8, 6, 6, 6};
    static const double flat[] = {1, 1, 9, 9, 1, 1};
    const size_t two[] = {5, 5}, three[] = {5, 5, 5}, four[] = {4}, five[] = {5}, line[] = {3};
    fpt_trim_finding found;
    fpt_trim *trim = polygons(good, two, 2);
    fpt_trim_report *report = NULL;
    fpt_trim_summary summary;
    CHECK_OK(fpt_trim_report_new(trim, 1e-6, &report));
    CHECK_OK(fpt_trim_report_summary(report, &summary));
    CHECK(summary.finding_count == 0 && summary.largest_opening == 0 && summary.largest_gap == 0 && summary.gap_bound == 0);
    CHECK_ERROR(fpt_trim_report_summary(report, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_trim_report_summary(NULL, &summary), FPT_NULL_ARGUMENT, "report");
    fpt_trim_report_free(report);
    CHECK_ERROR(fpt_trim_report_new(trim, NAN, &report), FPT_INVALID_ARGUMENT, "tolerance");
    CHECK_ERROR(fpt_trim_report_new(trim, INFINITY, &report), FPT_INVALID_ARGUMENT, "tolerance");
    CHECK_ERROR(fpt_trim_report_new(trim, -1, &report), FPT_INVALID_ARGUMENT, "tolerance");
    CHECK_ERROR(fpt_trim_report_new(NULL, 0, &report), FPT_NULL_ARGUMENT, "trim");
    CHECK_ERROR(fpt_trim_report_new(trim, 0, NULL), FPT_NULL_ARGUMENT, "out");
    fpt_trim_free(trim);
    found = finding_of(trim = polygons(open, four, 1), FPT_FINDING_OPEN);
    CHECK(found.kind == FPT_FINDING_OPEN && found.loop_index == 0 && found.coedge == 0);
    CHECK_NEAR(found.numbers[0], 0.1, 1e-12);
    fpt_trim_free(trim);
    found = finding_of(trim = polygons(turned, five, 1), FPT_FINDING_DIRECTION);
    CHECK(found.kind == FPT_FINDING_DIRECTION && found.numbers[0] == -64);
    fpt_trim_free(trim);
    found = finding_of(trim = polygons(flat, line, 1), FPT_FINDING_NO_DIRECTION);
    CHECK(found.kind == FPT_FINDING_NO_DIRECTION);
    fpt_trim_free(trim);
    found = finding_of(trim = polygons(crossing, three, 3), FPT_FINDING_CROSSING);
    CHECK(found.kind == FPT_FINDING_CROSSING && found.loop_index == 1 && found.other_loop == 2);
    fpt_trim_free(trim);
    found = finding_of(trim = polygons(touching, three, 3), FPT_FINDING_TOUCHING);
    CHECK(found.kind == FPT_FINDING_TOUCHING && found.numbers[0] < 1e-12);
    fpt_trim_free(trim);
    found = finding_of(trim = polygons(outside, five, 1), FPT_FINDING_OUTSIDE);
    CHECK(found.kind == FPT_FINDING_OUTSIDE && found.numbers[0] == 0.5);
    fpt_trim_free(trim);
    found = finding_of(trim = polygons(away, two, 2), FPT_FINDING_CONTAINMENT);
    CHECK(found.kind == FPT_FINDING_CONTAINMENT && found.loop_index == 1 && found.numbers[0] == 0);
    fpt_trim_free(trim);
}

static void gaps_of_edges_are_lengths_with_a_bound(void) {
    static const double knots[] = {0, 0, 1, 1}, straight[] = {1, 1, 0, 9, 1, 0}, lifted[] = {1, 1, 0, 9, 1, 0.3};
    for (int k = 0; k < 2; k++) {
        fpt_elementary_data plane = sphere_data(0);
        fpt_support *support;
        fpt_curve *curve = make_curve(curve_data(1, 2, knots, k == 0 ? straight : lifted, NULL));
        fpt_edge_data edge;
        fpt_coedge_data coedges[4];
        fpt_loop_data loop;
        fpt_trim_data data;
        fpt_trim *trim = NULL;
        fpt_trim_finding found;
        fpt_trim_report *report = NULL;
        fpt_trim_summary summary;
        plane.kind = FPT_ELEMENTARY_PLANE;
        plane.domain[0] = plane.domain[2] = 0;
        plane.domain[1] = plane.domain[3] = 10;
        support = elementary(plane);
        coedges[0] = isoline(1, 1, 1, 9);
        coedges[1] = isoline(0, 9, 1, 9);
        coedges[2] = isoline(1, 9, 9, 1);
        coedges[3] = isoline(0, 1, 9, 1);
        coedges[0].edge = 0;
        coedges[0].flags = FPT_COEDGE_SAME_PARAMETER;
        memset(&edge, 0, sizeof edge);
        edge.curve = curve;
        memset(&loop, 0, sizeof loop);
        loop.coedges = coedges;
        loop.coedge_count = 4;
        memset(&data, 0, sizeof data);
        data.struct_size = sizeof data;
        data.support = support;
        data.edges = &edge;
        data.edge_count = 1;
        data.loops = &loop;
        data.loop_count = 1;
        CHECK_OK(fpt_trim_new(&data, &trim));
        CHECK_OK(fpt_trim_report_new(trim, 1e-6, &report));
        CHECK_OK(fpt_trim_report_summary(report, &summary));
        fpt_trim_report_free(report);
        CHECK(summary.largest_gap <= summary.gap_bound);
        if (k == 0) {
            CHECK(summary.finding_count == 0 && summary.gap_bound < 1e-12);
        } else {
            CHECK(summary.largest_gap == 0.3 && summary.gap_bound < 0.301);
            found = finding_of(trim, FPT_FINDING_EDGE_GAP);
            CHECK(found.kind == FPT_FINDING_EDGE_GAP && found.coedge == 0 && found.numbers[0] == 0.3);
        }
        fpt_trim_free(trim);
        fpt_curve_free(curve);
        fpt_support_free(support);
    }
}

static void arcs_have_their_angle_as_parameter(void) {
    const double center[] = {1, 2, 3}, first[] = {2, 0, 0}, second[] = {0, 0, 1}, angles[] = {0.5, 2.5}, wrong[] = {1, 1};
    const double nan_center[] = {1, NAN, 3};
    double domain[2], point[3];
    fpt_curve *arc = NULL, *none = NULL;
    CHECK_OK(fpt_curve_arc_by_angle(center, first, second, angles, &arc));
    CHECK_OK(fpt_curve_domain(arc, domain));
    CHECK(domain[0] == 0.5 && domain[1] == 2.5);
    CHECK_OK(fpt_curve_evaluate(arc, 1.3, 0, point));
    CHECK_NEAR(point[0], 1 + 2 * cos(1.3), 4e-15);
    CHECK_NEAR(point[2], 3 + sin(1.3), 4e-15);
    CHECK_ERROR(fpt_curve_arc_by_angle(center, first, second, wrong, &none), FPT_INVALID_ARGUMENT, "angles");
    CHECK_ERROR(fpt_curve_arc_by_angle(nan_center, first, second, angles, &none), FPT_INVALID_ARGUMENT, "center: entry 1");
    CHECK_ERROR(fpt_curve_arc_by_angle(NULL, first, second, angles, &none), FPT_NULL_ARGUMENT, "center");
    CHECK_ERROR(fpt_curve_arc_by_angle(center, first, second, angles, NULL), FPT_NULL_ARGUMENT, "out");
    fpt_curve_free(arc);
}

/* The sphere with its poles and its seam elsewhere: the patch is cut there and has no defects. */
static void a_face_over_a_new_seam_is_cut(void) {
    fpt_elementary_data other = sphere_data(2);
    fpt_support *sphere = elementary(sphere_data(2)), *tilted;
    fpt_trim *trim = patch(sphere), *followed = NULL;
    fpt_change_options options;
    fpt_change_summary summary;
    size_t edges = 0, loops = 0, old_loops = 0;
    uint32_t flipped = 0;
    /* The new seam runs through the patch. */
    memset(other.x, 0, sizeof other.x);
    memset(other.y, 0, sizeof other.y);
    other.x[0] = other.y[1] = cos(1.5);
    other.x[1] = sin(1.5);
    other.y[0] = -sin(1.5);
    tilted = elementary(other);
    fpt_change_options_init(&options, sizeof options);
    options.tolerance = 1e-5;
    CHECK_OK(fpt_trim_follow(trim, tilted, &options, &followed, &summary));
    CHECK(summary.proven == 1 && summary.deviation <= 1e-5);
    CHECK_OK(fpt_trim_counts(trim, &edges, &old_loops, &flipped));
    CHECK_OK(fpt_trim_counts(followed, &edges, &loops, &flipped));
    CHECK(edges >= 1 && flipped == 0 && loops >= 2);
    fpt_trim_free(trim);
    fpt_trim_free(followed);
    fpt_support_free(sphere);
    fpt_support_free(tilted);
}

int main(void) {
    RUN(every_defect_is_reported_with_its_numbers);
    RUN(gaps_of_edges_are_lengths_with_a_bound);
    RUN(arcs_have_their_angle_as_parameter);
    RUN(a_face_over_a_new_seam_is_cut);
    RUN(null_may_be_freed);
    RUN(relations_map_both_ways);
    RUN(transforms_map_both_ways);
    RUN(supports_evaluate_and_match);
    RUN(a_whole_face_comes_apart);
    RUN(a_face_goes_to_nurbs_and_back);
    RUN(two_faces_are_merged);
    RUN(text_and_pictures_tell_their_length_first);
    RUN(what_is_wrong_is_refused_by_name);
    return check_report("trims");
}
