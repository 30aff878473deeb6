/* A software renderer: a camera and a depth buffer with the surface's normal and deviation in every sample. */
#ifndef PROPELLER_VIEW_H
#define PROPELLER_VIEW_H

#include "image.h"
#include "map.h"
#include "vec3.h"

enum { VIEW_SAMPLES = 3 }; /* samples per pixel and direction */

#define VIEW_LIMIT 0.3 /* mm: the deviation at the ends of the colours */

typedef struct camera {
    vec3 eye, right, up, forward;
    double scale, centre_x, centre_y; /* samples per unit at depth 1 (perspective) or per mm (parallel) */
    int is_parallel;
} camera;

typedef struct sample {
    float nearness; /* grows towards the eye, linear on the screen; 0 or less: nothing hit */
    float normal[3];
    float deviation;
} sample;

typedef struct view {
    camera camera;
    int width, height; /* in samples */
    sample *samples;
} view;

/* A camera at `eye` that looks at `target`; `field` mm at the target's depth fill the width. */
camera camera_new(vec3 eye, vec3 target, vec3 up, double field, int width, int height, int is_parallel);
/* Returns x and y in samples and the nearness. */
vec3 camera_project(const camera *c, vec3 point);
vec3 camera_unproject(const camera *c, vec3 screen);

/* Draws the part into a new view. Colours of the map are only fetched when one is given. */
fpt_status view_new(const part *p, const deviation_map *map, camera c, int width, int height, view *out);
void view_free(view *v);

/* Lights the view and puts it on the picture with its upper left corner at (x, y); `light` is a view of the same part
 * from the main light with a parallel camera. Returns 0, or -1 when memory is short. */
int view_paint(const view *v, const view *light, image *picture, int x, int y);

/* The colour of a deviation of t times VIEW_LIMIT, -1 <= t <= 1; red, green, blue in 0..1. */
void map_colour(double t, double rgb[3]);

#endif
