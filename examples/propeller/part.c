/* Assembly of the members and the questions asked about the whole part. */
#include "part.h"

#include <string.h>

/* The place on the section line u of a blade where it comes out of the barrel: bisection in v. */
static fpt_status find_root_corner(const member *blade, double u, double out[2]) {
    double low = blade->domain[2], high = blade->domain[3], point[3];
    for (int step = 0; step < 40; step++) {
        double v = 0.5 * (low + high);
        fpt_status status = fpt_surface_evaluate(blade->surface, u, v, 0, point);
        if (status != FPT_OK) return status;
        *(hypot(point[0], point[1]) < barrel_radius(point[2]) ? &low : &high) = v;
    }
    out[0] = atan2(point[1], point[0]);
    out[1] = point[2];
    return FPT_OK;
}

static fpt_status find_root(const member *blade, double out[ROOT_CORNERS][2]) {
    double u0 = blade->domain[0], width = blade->domain[1] - u0;
    for (int i = 0; i < ROOT_CORNERS; i++) {
        fpt_status status = find_root_corner(blade, u0 + width * i / ROOT_CORNERS, out[i]);
        if (status != FPT_OK) return status;
    }
    return FPT_OK;
}

static fpt_status finish_member(member *m, const char *name, double outward, int pieces, int is_smooth) {
    m->name = name;
    m->outward = outward;
    m->pieces = pieces;
    m->is_smooth = is_smooth;
    fpt_status status = fpt_surface_domain(m->surface, m->domain);
    if (status == FPT_OK) status = fpt_surface_box(m->surface, m->box);
    if (status == FPT_OK) status = fpt_surface_prepare(m->surface); /* optional: the first query would do it */
    return status;
}

fpt_status part_new(part *out) {
    static const char *const blade_names[BLADE_COUNT] = {"blade 1", "blade 2", "blade 3", "blade 4"};
    memset(out, 0, sizeof *out);
    member *m = out->members;
    fpt_status status = FPT_OK;
    for (int i = 0; i < BLADE_COUNT && status == FPT_OK; i++) {
        status = blade_new(2 * acos(-1.0) * i / BLADE_COUNT, &m[i].surface);
        if (status == FPT_OK) status = finish_member(&m[i], blade_names[i], 1, 1, 0);
        if (status == FPT_OK) status = find_root(&m[i], out->root[i]);
    }
    if (status == FPT_OK) status = barrel_new(&m[BARREL].surface);
    if (status == FPT_OK) status = finish_member(&m[BARREL], "barrel", -1, 3, 1);
    if (status == FPT_OK) status = nose_cap_new(&m[NOSE_CAP].surface);
    if (status == FPT_OK) status = finish_member(&m[NOSE_CAP], "nose cap", -1, 1, 1);
    if (status == FPT_OK) status = bore_new(&m[BORE].surface);
    if (status == FPT_OK) status = finish_member(&m[BORE], "bore", -1, 2, 1);
    return status;
}

void part_free(part *p) {
    for (int i = 0; i < MEMBER_COUNT; i++) fpt_surface_free(p->members[i].surface);
}

static fpt_status unit_normal(const member *m, double u, double v, vec3 *out) {
    double d[9]; /* S, Su, Sv */
    fpt_status status = fpt_surface_evaluate(m->surface, u, v, 1, d);
    if (status == FPT_OK) *out = vec3_unit(vec3_scale(m->outward, vec3_cross(vec3_of(d + 3), vec3_of(d + 6))));
    return status;
}

/* All members are closed in u: parameters wrap there; in v they stop at the border. */
static double wrapped(double u, double low, double high) {
    return u < low ? u + (high - low) : u > high ? u - (high - low) : u;
}

fpt_status part_normal(const part *p, site at, vec3 *out) {
    const member *m = &p->members[at.member];
    const double *d = m->domain;
    double step_u = 1e-4 * (d[1] - d[0]), step_v = 1e-4 * (d[3] - d[2]);
    vec3 sum = {0, 0, 0};
    for (int corner = 0; corner < 4; corner++) {
        double u = wrapped(at.u + (corner & 1 ? step_u : -step_u), d[0], d[1]);
        double v = fmin(fmax(at.v + (corner & 2 ? step_v : -step_v), d[2] + step_v), d[3] - step_v);
        vec3 normal;
        fpt_status status = unit_normal(m, u, v, &normal);
        if (status != FPT_OK) return status;
        sum = vec3_add(sum, normal);
    }
    *out = vec3_unit(sum);
    return FPT_OK;
}

/* Even-odd rule in (angle, z), angles taken relative to the point's. */
static int is_in_root(const double root[ROOT_CORNERS][2], double angle, double z) {
    int inside = 0;
    for (int i = 0, j = ROOT_CORNERS - 1; i < ROOT_CORNERS; j = i++) {
        double turn = 2 * acos(-1.0);
        double a = remainder(root[i][0] - angle, turn), b = remainder(root[j][0] - angle, turn);
        if (fabs(a - b) > turn / 2) continue; /* the outline's far side of the axis */
        if ((root[i][1] > z) != (root[j][1] > z)) {
            double t = (z - root[i][1]) / (root[j][1] - root[i][1]);
            if (a + t * (b - a) > 0) inside = !inside;
        }
    }
    return inside;
}

int part_is_covered(const part *p, int member_index, vec3 point) {
    if (member_index < BLADE_COUNT) return hypot(point.x, point.y) < barrel_radius(point.z);
    if (member_index != BARREL || fabs(point.z) > 27) return 0;
    for (int i = 0; i < BLADE_COUNT; i++)
        if (is_in_root(p->root[i], atan2(point.y, point.x), point.z)) return 1;
    return 0;
}
