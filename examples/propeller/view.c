/* Drawing: the members become meshes, the meshes triangles, the triangles samples. */
#include "view.h"

#include <stdlib.h>
#include <string.h>

enum { MESH_U = 480, MESH_V = 360 }; /* quads of a member; small enough to need no smoothing of outlines */

typedef struct vertex {
    vec3 screen; /* x, y in samples, nearness */
    float normal[3], deviation;
} vertex;

camera camera_new(vec3 eye, vec3 target, vec3 up, double field, int width, int height, int is_parallel) {
    camera c;
    vec3 sight = vec3_sub(target, eye);
    c.eye = eye;
    c.forward = vec3_unit(sight);
    c.right = vec3_unit(vec3_cross(c.forward, up));
    c.up = vec3_cross(c.right, c.forward);
    c.scale = width / field * (is_parallel ? 1 : vec3_length(sight));
    c.centre_x = 0.5 * width, c.centre_y = 0.5 * height;
    c.is_parallel = is_parallel;
    return c;
}

/* The nearness of a parallel camera is 1 at its eye and falls by one in a metre, to stay positive on the part. */
vec3 camera_project(const camera *c, vec3 point) {
    vec3 off = vec3_sub(point, c->eye);
    double depth = vec3_dot(off, c->forward), zoom = c->is_parallel ? c->scale : c->scale / depth;
    return vec3_new(c->centre_x + zoom * vec3_dot(off, c->right), c->centre_y - zoom * vec3_dot(off, c->up),
                    c->is_parallel ? 1 - depth / 1000 : 1 / depth);
}

vec3 camera_unproject(const camera *c, vec3 screen) {
    double depth = c->is_parallel ? (1 - screen.z) * 1000 : 1 / screen.z;
    double unit = c->is_parallel ? 1 / c->scale : depth / c->scale;
    vec3 across = vec3_add(vec3_scale((screen.x - c->centre_x) * unit, c->right),
                           vec3_scale((c->centre_y - screen.y) * unit, c->up));
    return vec3_add(c->eye, vec3_add(vec3_scale(depth, c->forward), across));
}

/* Twice the signed area of the triangle a, b, (x, y). */
static double area2(vec3 a, vec3 b, double x, double y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

static void draw_sample(view *v, int x, int y, const vertex *corners[3], const double weight[3]) {
    sample *s = &v->samples[(size_t)y * (size_t)v->width + (size_t)x];
    double nearness = 0;
    for (int i = 0; i < 3; i++) nearness += weight[i] * corners[i]->screen.z;
    if (nearness <= s->nearness) return;
    s->nearness = (float)nearness;
    for (int k = 0; k < 3; k++)
        s->normal[k] = (float)(weight[0] * corners[0]->normal[k] + weight[1] * corners[1]->normal[k] +
                               weight[2] * corners[2]->normal[k]);
    s->deviation = (float)(weight[0] * corners[0]->deviation + weight[1] * corners[1]->deviation +
                           weight[2] * corners[2]->deviation);
}

static void draw_triangle(view *v, const vertex *a, const vertex *b, const vertex *c) {
    const vertex *corners[3] = {a, b, c};
    double total = area2(a->screen, b->screen, c->screen.x, c->screen.y);
    if (total == 0) return;
    int x0 = (int)fmax(0, ceil(fmin(fmin(a->screen.x, b->screen.x), c->screen.x) - 0.5));
    int y0 = (int)fmax(0, ceil(fmin(fmin(a->screen.y, b->screen.y), c->screen.y) - 0.5));
    int x1 = (int)fmin(v->width - 1, floor(fmax(fmax(a->screen.x, b->screen.x), c->screen.x) - 0.5));
    int y1 = (int)fmin(v->height - 1, floor(fmax(fmax(a->screen.y, b->screen.y), c->screen.y) - 0.5));
    for (int y = y0; y <= y1; y++)
        for (int x = x0; x <= x1; x++) {
            double weight[3];
            weight[0] = area2(b->screen, c->screen, x + 0.5, y + 0.5) / total;
            weight[1] = area2(c->screen, a->screen, x + 0.5, y + 0.5) / total;
            weight[2] = 1 - weight[0] - weight[1];
            if (weight[0] >= 0 && weight[1] >= 0 && weight[2] >= 0) draw_sample(v, x, y, corners, weight);
        }
}

static void make_vertex(const view *v, const member *m, const double d[9], double deviation, vertex *out) {
    vec3 normal = vec3_unit(vec3_scale(m->outward, vec3_cross(vec3_of(d + 3), vec3_of(d + 6))));
    out->screen = camera_project(&v->camera, vec3_of(d));
    out->normal[0] = (float)normal.x, out->normal[1] = (float)normal.y, out->normal[2] = (float)normal.z;
    out->deviation = (float)deviation;
}

/* One line of vertices along v within a smooth piece. Its ends stay a little inside, where the normal is the piece's
 * own (creases) and exists (collapsed edges). */
static fpt_status make_line(const view *v, const part *p, const deviation_map *map, site from, double length,
                            vertex out[MESH_V + 1]) {
    double uv[MESH_V + 1][2], d[MESH_V + 1][9];
    const member *m = &p->members[from.member];
    for (int j = 0; j <= MESH_V; j++) {
        double t = fmin(fmax((double)j / MESH_V, 1e-6), 1 - 1e-6);
        uv[j][0] = from.u, uv[j][1] = from.v + t * length;
    }
    fpt_status status = fpt_surface_evaluate_many(m->surface, &uv[0][0], MESH_V + 1, 1, &d[0][0]);
    for (int j = 0; j <= MESH_V && status == FPT_OK; j++) {
        site at = {from.member, uv[j][0], uv[j][1]};
        make_vertex(v, m, d[j], map ? map_at(map, p, at) : 0, &out[j]);
    }
    return status;
}

static void draw_strip(view *v, const vertex *line, const vertex *next) {
    for (int j = 0; j < MESH_V; j++) {
        draw_triangle(v, &line[j], &next[j], &next[j + 1]);
        draw_triangle(v, &line[j], &next[j + 1], &line[j + 1]);
    }
}

static fpt_status draw_member(view *v, const part *p, const deviation_map *map, int index) {
    const member *m = &p->members[index];
    double length = (m->domain[3] - m->domain[2]) / m->pieces;
    vertex lines[2][MESH_V + 1];
    for (int piece = 0; piece < m->pieces; piece++)
        for (int i = 0; i <= MESH_U; i++) {
            double t = (double)i / MESH_U;
            site from = {index, (1 - t) * m->domain[0] + t * m->domain[1], m->domain[2] + piece * length};
            fpt_status status = make_line(v, p, map, from, length, lines[i % 2]);
            if (status != FPT_OK) return status;
            if (i > 0) draw_strip(v, lines[(i + 1) % 2], lines[i % 2]);
        }
    return FPT_OK;
}

fpt_status view_new(const part *p, const deviation_map *map, camera c, int width, int height, view *out) {
    out->camera = c;
    out->width = width, out->height = height;
    out->samples = calloc((size_t)width * (size_t)height, sizeof *out->samples);
    fpt_status status = out->samples ? FPT_OK : FPT_OUT_OF_MEMORY;
    for (int i = 0; i < MEMBER_COUNT && status == FPT_OK; i++) status = draw_member(out, p, map, i);
    return status;
}

void view_free(view *v) {
    free(v->samples);
}
