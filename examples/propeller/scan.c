#include "scan.h"

#include <stdlib.h>

#include "random.h"

enum { GRID = 320 }; /* cells of a member in u and in v */

/* The last one has no height of its own: a place to look at the bend. */
static const defect PLANTED[DEFECT_COUNT] = {
    {.name = "bump", .at = {0, 0.74, 0.62}, .height = 0.32, .radius = 7.0},
    {.name = "dent", .at = {1, 0.72, 0.50}, .height = -0.28, .radius = 8.5},
    {.name = "dent", .at = {3, 0.64, 0.66}, .height = -0.20, .radius = 6.0},
    {.name = "bump", .at = {3, 0.80, 0.42}, .height = 0.16, .radius = 5.0},
    {.name = "dent", .at = {0, 0.26, 0.58}, .height = -0.38, .radius = 7.5},
    {.name = "bump", .at = {3, 0.24, 0.62}, .height = 0.24, .radius = 6.0},
    {.name = "bump", .at = {NOSE_CAP, 3.30, 0.55}, .height = 0.14, .radius = 4.0},
    {.name = "bent tip", .at = {SCAN_BENT_BLADE, 0.72, 0.90}, .height = 0, .radius = 8.0},
};

/* The member cut into cells of parameters, with the running sum of their areas. Cells that the scanner cannot see
 * because another member covers them have area zero. */
typedef struct cells {
    double nodes[GRID + 1][GRID + 1][3];
    unsigned char covered[GRID + 1][GRID + 1];
    double area_up_to[GRID * GRID];
} cells;

static fpt_status locate_nodes(const part *p, int index, cells *c) {
    const member *m = &p->members[index];
    double row[GRID + 1][2];
    for (int i = 0; i <= GRID; i++) {
        for (int j = 0; j <= GRID; j++) {
            row[j][0] = m->domain[0] + (m->domain[1] - m->domain[0]) * i / GRID;
            row[j][1] = m->domain[2] + (m->domain[3] - m->domain[2]) * j / GRID;
        }
        fpt_status status = fpt_surface_evaluate_many(m->surface, &row[0][0], GRID + 1, 0, &c->nodes[i][0][0]);
        if (status != FPT_OK) return status;
        for (int j = 0; j <= GRID; j++)
            c->covered[i][j] = (unsigned char)part_is_covered(p, index, vec3_of(c->nodes[i][j]));
    }
    return FPT_OK;
}

static double cell_area(const cells *c, int i, int j) {
    if (c->covered[i][j] || c->covered[i + 1][j] || c->covered[i][j + 1] || c->covered[i + 1][j + 1]) return 0;
    vec3 one = vec3_sub(vec3_of(c->nodes[i + 1][j + 1]), vec3_of(c->nodes[i][j]));
    vec3 other = vec3_sub(vec3_of(c->nodes[i][j + 1]), vec3_of(c->nodes[i + 1][j]));
    return 0.5 * vec3_length(vec3_cross(one, other));
}

static double sum_areas(cells *c) {
    double sum = 0;
    for (int k = 0; k < GRID * GRID; k++) c->area_up_to[k] = sum += cell_area(c, k / GRID, k % GRID);
    return sum;
}

/* Parameters of `count` points spread evenly over the area, cell after cell. */
static void spread(const member *m, const cells *c, size_t count, random_source *r, double *uv) {
    double total = c->area_up_to[GRID * GRID - 1];
    int k = 0;
    for (size_t i = 0; i < count; i++) {
        double target = total * ((double)i + random_uniform(r)) / (double)count;
        while (k < GRID * GRID - 1 && c->area_up_to[k] <= target) k++;
        double s = (k / GRID + random_uniform(r)) / GRID, t = (k % GRID + random_uniform(r)) / GRID;
        uv[2 * i] = m->domain[0] + s * (m->domain[1] - m->domain[0]);
        uv[2 * i + 1] = m->domain[2] + t * (m->domain[3] - m->domain[2]);
    }
}

/* How far the made part stands off the nominal one: along the normal, and for the bent blade along the axis. */
static vec3 displacement(const scan *s, int index, vec3 point, vec3 normal) {
    double height = 0;
    for (int i = 0; i < DEFECT_COUNT; i++) {
        const defect *d = &s->defects[i];
        vec3 off = vec3_sub(point, d->centre);
        double x = vec3_dot(off, off) / (2 * d->radius * d->radius);
        int same_side = d->at.member == index && vec3_dot(normal, d->normal) > 0;
        if (same_side && x < 20) height += d->height * exp(-x);
    }
    vec3 moved = vec3_scale(height, normal);
    double beyond = (hypot(point.x, point.y) - 60) / 60;
    if (index == SCAN_BENT_BLADE && beyond > 0) moved.z += SCAN_BEND * beyond * beyond;
    return moved;
}

/* Turns exact points into scanned ones. `d` holds S, Su, Sv of each. */
static void disturb(const scan *s, const part *p, int index, const double *d, size_t count, random_source *r,
                    double *points) {
    for (size_t i = 0; i < count; i++, d += 9, points += 3) {
        vec3 point = vec3_of(d);
        vec3 normal = vec3_unit(vec3_cross(vec3_of(d + 3), vec3_of(d + 6)));
        vec3 moved = displacement(s, index, point, vec3_scale(p->members[index].outward, normal));
        points[0] = point.x + moved.x + SCAN_NOISE * random_gaussian(r);
        points[1] = point.y + moved.y + SCAN_NOISE * random_gaussian(r);
        points[2] = point.z + moved.z + SCAN_NOISE * random_gaussian(r);
    }
}

static fpt_status scan_member(const scan *s, const part *p, int index, const cells *c, size_t count, double *points) {
    random_source r = {UINT64_C(0x9E3779B97F4A7C15) + (uint64_t)index};
    double *uv = malloc((count + 1) * 2 * sizeof *uv), *d = malloc((count + 1) * 9 * sizeof *d);
    fpt_status status = uv && d ? FPT_OK : FPT_OUT_OF_MEMORY;
    if (status == FPT_OK) {
        spread(&p->members[index], c, count, &r, uv);
        status = fpt_surface_evaluate_many(p->members[index].surface, uv, count, 1, d);
    }
    if (status == FPT_OK) disturb(s, p, index, d, count, &r, points);
    free(uv);
    free(d);
    return status;
}

static fpt_status plant_defects(const part *p, scan *s) {
    for (int i = 0; i < DEFECT_COUNT; i++) {
        defect *d = &s->defects[i];
        double centre[3];
        *d = PLANTED[i];
        fpt_status status =
            fpt_surface_evaluate(p->members[d->at.member].surface, d->at.u, d->at.v, 0, centre);
        if (status == FPT_OK) status = part_normal(p, d->at, &d->normal);
        if (status != FPT_OK) return status;
        d->centre = vec3_of(centre);
    }
    for (int i = 0; i < DEFECT_COUNT; i++) {
        defect *d = &s->defects[i];
        d->expected = vec3_dot(d->normal, displacement(s, d->at.member, d->centre, d->normal));
    }
    return FPT_OK;
}

static fpt_status fill(const part *p, cells *members, scan *out) {
    double area[MEMBER_COUNT], total = 0, before = 0;
    fpt_status status = plant_defects(p, out);
    for (int i = 0; i < MEMBER_COUNT && status == FPT_OK; i++) {
        status = locate_nodes(p, i, &members[i]);
        if (status == FPT_OK) total += area[i] = sum_areas(&members[i]);
    }
    for (int i = 0; i < MEMBER_COUNT && status == FPT_OK; i++) {
        double share = (before + area[i]) / total;
        size_t first = (size_t)((double)out->count * (before / total));
        size_t next = i == MEMBER_COUNT - 1 ? out->count : (size_t)((double)out->count * share);
        status = scan_member(out, p, i, &members[i], next - first, out->points + 3 * first);
        before += area[i];
    }
    return status;
}

fpt_status scan_new(const part *p, size_t count, scan *out) {
    cells *members = malloc(MEMBER_COUNT * sizeof *members);
    out->count = count;
    out->points = malloc(3 * count * sizeof *out->points);
    fpt_status status = members && out->points ? fill(p, members, out) : FPT_OUT_OF_MEMORY;
    free(members);
    return status;
}

void scan_free(scan *s) {
    free(s->points);
}
