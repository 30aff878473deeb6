/* A made-up scan of the part: points in the order of scan lines, with noise and with planted defects. */
#ifndef PROPELLER_SCAN_H
#define PROPELLER_SCAN_H

#include <stddef.h>

#include "part.h"

#define SCAN_NOISE 0.02 /* mm, standard deviation of each coordinate */

enum { DEFECT_COUNT = 8 };

/* A bell-shaped bump (height > 0) or dent around a place of the part. */
typedef struct defect {
    const char *name;
    site at;
    double height, radius;     /* mm; the radius is the bell's standard deviation */
    double expected;           /* mm: what a measurement should find at the centre */
    vec3 centre, normal;
} defect;

typedef struct scan {
    size_t count;
    double *points; /* x, y, z */
    defect defects[DEFECT_COUNT];
} scan;

/* Besides the defects, blade 3 is bent: its tip stands off by this much along the axis. */
#define SCAN_BEND 0.20 /* mm */
enum { SCAN_BENT_BLADE = 2 };

fpt_status scan_new(const part *p, size_t count, scan *out);
void scan_free(scan *s);

#endif
