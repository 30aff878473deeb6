/* The measured part: a ship model's propeller, four blades on a hub, 240 mm in diameter, in mm.
 *
 *            blade 2                 member       kind          what makes it interesting
 *              |                     blade 1..4   bicubic       closed, its seam is the sharp trailing edge;
 *    blade 3 --O-- blade 1                                      the tip is a collapsed edge
 *              |                     barrel       rational      exact surface of revolution, two creases
 *            blade 4                 nose cap     rational      collapsed at the nose
 *                                    bore         rational      an exact cylinder
 *
 * The axis is z, the nose points along +z. Every member is one fpt_surface. A blade starts inside the barrel, so a
 * part of either is covered by the other; part_is_covered() tells. */
#ifndef PROPELLER_PART_H
#define PROPELLER_PART_H

#include <footpoint.h>

#include "vec3.h"

enum { BLADE_COUNT = 4, BARREL = BLADE_COUNT, NOSE_CAP, BORE, MEMBER_COUNT };
enum { ROOT_CORNERS = 96 }; /* corners of the outline of a blade's root on the barrel */

typedef struct member {
    const char *name;
    fpt_surface *surface;
    double domain[4]; /* u0, u1, v0, v1 */
    double box[6];    /* x0, y0, z0, x1, y1, z1 */
    double outward;   /* +1 or -1: makes Su x Sv point out of the material */
    int pieces;       /* smooth pieces along v, of equal length in v, with creases between */
    int is_smooth;    /* across the seam */
} member;

typedef struct part {
    member members[MEMBER_COUNT];
    double root[BLADE_COUNT][ROOT_CORNERS][2]; /* angle and z of the blade's outline on the barrel */
} part;

/* Where on the part. */
typedef struct site {
    int member;
    double u, v;
} site;

/* On failure the part holds what was made so far; part_free() is right after both. */
fpt_status part_new(part *out);
void part_free(part *p);

/* Unit normal out of the material. Where one normal does not exist (collapsed edge, crease, border) it is the mean of
 * those around. */
fpt_status part_normal(const part *p, site at, vec3 *out);

/* Is this point of the member inside the material of another one? */
int part_is_covered(const part *p, int member_index, vec3 point);

/* The two constructors behind part_new(). */
fpt_status blade_new(double angle, fpt_surface **out);
fpt_status barrel_new(fpt_surface **out);
fpt_status nose_cap_new(fpt_surface **out);
fpt_status bore_new(fpt_surface **out);
double barrel_radius(double z);

#endif
