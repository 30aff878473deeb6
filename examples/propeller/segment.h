/* Distance of a point to a line segment in the plane: what strokes and glyphs are drawn with. */
#ifndef PROPELLER_SEGMENT_H
#define PROPELLER_SEGMENT_H

#include <math.h>

static inline double segment_distance(double x, double y, double x0, double y0, double x1, double y1) {
    double dx = x1 - x0, dy = y1 - y0, square = dx * dx + dy * dy;
    double t = square > 0 ? ((x - x0) * dx + (y - y0) * dy) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(x - x0 - t * dx, y - y0 - t * dy);
}

#endif
