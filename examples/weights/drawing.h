/* A figure as SVG: a polygon, curves over it, wished distances as circles, and a table of what was achieved. */
#ifndef WEIGHTS_DRAWING_H
#define WEIGHTS_DRAWING_H

#include <footpoint.h>
#include <stdio.h>

/* A curve of the figure, by one method. */
typedef struct method {
    const char *name, *colour;
    fpt_weights_report *report; /* NULL: weights 1 */
    const fpt_curve *curve;
} method;

/* Writes the figure; `poles` are x,y,z. Returns 0 when it is written. */
int draw_figure(const char *path, const char *title, const double *poles, size_t pole_count, const method *methods,
                size_t method_count);

#endif
