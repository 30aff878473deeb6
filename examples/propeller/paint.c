/* Light: an overcast sky with ambient occlusion, a main light with soft shadows, a fill light and a highlight. The sums
 * are made in linear light, the samples of a pixel averaged there, and then brought to sRGB. */
#include <stdlib.h>

#include "random.h"
#include "view.h"

enum { OCCLUSION_RAYS = 20, OCCLUSION_STEPS = 4 };

static const double OCCLUSION_REACH = 14; /* mm */
static const double SHADOW_SLACK = 0.9;   /* mm, against a surface shading itself */

void map_colour(double t, double rgb[3]) {
    static const double stops[9][3] = {{0.16, 0.13, 0.50}, {0.12, 0.32, 0.77}, {0.14, 0.58, 0.87}, {0.33, 0.78, 0.78},
                                       {0.47, 0.76, 0.44}, {0.93, 0.87, 0.30}, {0.98, 0.63, 0.18}, {0.90, 0.30, 0.14},
                                       {0.58, 0.05, 0.13}};
    double x = 4 * (fmin(fmax(t, -1), 1) + 1);
    int i = x < 7 ? (int)x : 7;
    for (int k = 0; k < 3; k++) rgb[k] = stops[i][k] + (x - i) * (stops[i + 1][k] - stops[i][k]);
}

static double to_linear(double c) {
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double to_srgb(double c) {
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(fmin(c, 1), 1 / 2.4) - 0.055;
}

/* Only even values: nobody sees the difference, and the file is a sixth smaller. */
static unsigned char to_byte(double linear) {
    return (unsigned char)(2 * (int)(127 * to_srgb(linear) + 0.5));
}

static const sample *sample_at(const view *v, int x, int y) {
    if (x < 0 || y < 0 || x >= v->width || y >= v->height) return NULL;
    const sample *s = &v->samples[(size_t)y * (size_t)v->width + (size_t)x];
    return s->nearness > 0 ? s : NULL;
}

static vec3 position(const view *v, int x, int y, const sample *s) {
    return camera_unproject(&v->camera, vec3_new(x + 0.5, y + 0.5, s->nearness));
}

/* The normal, on the side of the eye. */
static vec3 facing_normal(const sample *s, vec3 to_eye) {
    vec3 n = vec3_unit(vec3_new(s->normal[0], s->normal[1], s->normal[2]));
    return vec3_dot(n, to_eye) < 0 ? vec3_scale(-1, n) : n;
}

/* Is something drawn in front of this point, yet not far in front? */
static int is_hidden(const view *v, vec3 point, double reach) {
    vec3 screen = camera_project(&v->camera, point);
    int x = (int)floor(screen.x), y = (int)floor(screen.y);
    const sample *s = sample_at(v, x, y);
    if (!s || s->nearness <= screen.z) return 0;
    double gap = vec3_length(vec3_sub(position(v, x, y, s), point));
    return gap > 0.15 && gap < reach;
}

/* Share of the sky that a point sees. */
static double sky_share(const view *v, vec3 point, vec3 normal, random_source *r) {
    int hidden = 0;
    for (int ray = 0; ray < OCCLUSION_RAYS; ray++) {
        vec3 way = vec3_new(random_gaussian(r), random_gaussian(r), random_gaussian(r));
        way = vec3_unit(vec3_add(vec3_unit(way), vec3_scale(1.02, normal)));
        for (int step = 1; step <= OCCLUSION_STEPS; step++) {
            double at = OCCLUSION_REACH * (step - random_uniform(r)) / OCCLUSION_STEPS + 0.3;
            if (!is_hidden(v, vec3_add(point, vec3_scale(at, way)), OCCLUSION_REACH)) continue;
            hidden++;
            break;
        }
    }
    return 1 - (double)hidden / OCCLUSION_RAYS;
}

/* Share of the main light that arrives: the mean over a small patch of its depth buffer. */
static double light_share(const view *light, vec3 point, vec3 normal) {
    vec3 lifted = vec3_add(point, vec3_scale(SHADOW_SLACK, normal));
    vec3 screen = camera_project(&light->camera, lifted);
    int seen = 0, tried = 0;
    for (int y = -3; y <= 3; y++)
        for (int x = -3; x <= 3; x++, tried++) {
            const sample *s = sample_at(light, (int)floor(screen.x) + x, (int)floor(screen.y) + y);
            seen += !s || s->nearness <= screen.z + SHADOW_SLACK / 1000;
        }
    return (double)seen / tried;
}

/* Drawn lines where the depth jumps or the normal breaks: outlines and creases. */
static double ink(const view *v, int x, int y, const sample *s, vec3 normal) {
    static const int steps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    double depth = 1 / s->nearness, most = 0;
    for (int i = 0; i < 4; i++) {
        const sample *other = sample_at(v, x + 2 * steps[i][0], y + 2 * steps[i][1]);
        if (!other) {
            most = fmax(most, 0.45);
            continue;
        }
        vec3 n = vec3_unit(vec3_new(other->normal[0], other->normal[1], other->normal[2]));
        if (1 / other->nearness - depth > 2.5) most = fmax(most, 0.45);
        if (fabs(vec3_dot(n, normal)) < 0.8) most = fmax(most, 0.22);
    }
    return 1 - most;
}

typedef struct painter {
    const view *view, *light;
    double *sky; /* per pixel */
    int columns, rows;
} painter;

/* Linear light from one sample. */
static void shade(const painter *q, int x, int y, const sample *s, double rgb[3]) {
    const camera *c = &q->view->camera;
    vec3 point = position(q->view, x, y, s), to_eye = vec3_unit(vec3_sub(c->eye, point));
    vec3 normal = facing_normal(s, to_eye), main_way = vec3_scale(-1, q->light->camera.forward);
    vec3 fill_way = vec3_unit(vec3_add(vec3_scale(0.9, c->right), vec3_sub(vec3_scale(0.2, c->up), c->forward)));
    double sky = q->sky[(size_t)(y / VIEW_SAMPLES) * (size_t)q->columns + (size_t)(x / VIEW_SAMPLES)];
    if (sky < 0) sky = 1; /* only corners of this pixel are covered */
    double facing = vec3_dot(normal, main_way);
    double main_light = facing > 0 ? facing * light_share(q->light, point, normal) : 0;
    double fill = fmax(0, vec3_dot(normal, fill_way));
    double diffuse = sky * (0.50 + 0.14 * vec3_dot(normal, c->up)) + 0.62 * main_light + 0.20 * fill * sky;
    double shine = pow(fmax(0, vec3_dot(normal, vec3_unit(vec3_add(main_way, to_eye)))), 48);
    double highlight = main_light > 0 ? 0.16 * shine * fmin(1, 4 * main_light) : 0;
    double line = ink(q->view, x, y, s, normal);
    map_colour(s->deviation / VIEW_LIMIT, rgb);
    for (int k = 0; k < 3; k++) rgb[k] = line * (to_linear(rgb[k]) * diffuse + highlight);
}

static void paint_pixel(const painter *q, int column, int row, image *picture, int x, int y) {
    double sum[3] = {0, 0, 0};
    int hits = 0;
    for (int j = 0; j < VIEW_SAMPLES; j++)
        for (int i = 0; i < VIEW_SAMPLES; i++) {
            int sx = column * VIEW_SAMPLES + i, sy = row * VIEW_SAMPLES + j;
            const sample *s = sample_at(q->view, sx, sy);
            double rgb[3];
            if (!s) continue;
            shade(q, sx, sy, s, rgb);
            for (int k = 0; k < 3; k++) sum[k] += rgb[k];
            hits++;
        }
    if (hits == 0) return;
    colour c = {to_byte(sum[0] / hits), to_byte(sum[1] / hits), to_byte(sum[2] / hits)};
    image_blend(picture, x + column, y + row, c, (double)hits / (VIEW_SAMPLES * VIEW_SAMPLES));
}

/* The sky's share at the middle sample of every pixel, -1 where nothing is drawn. */
static void find_sky(painter *q) {
    random_source r = {UINT64_C(88172645463325252)};
    for (int row = 0; row < q->rows; row++)
        for (int column = 0; column < q->columns; column++) {
            int x = column * VIEW_SAMPLES + VIEW_SAMPLES / 2, y = row * VIEW_SAMPLES + VIEW_SAMPLES / 2;
            const sample *s = sample_at(q->view, x, y);
            double *sky = &q->sky[(size_t)row * (size_t)q->columns + (size_t)column];
            *sky = -1;
            if (!s) continue;
            vec3 point = position(q->view, x, y, s);
            *sky = sky_share(q->view, point, facing_normal(s, vec3_sub(q->view->camera.eye, point)), &r);
        }
}

/* The rays are few and random, so the shares are noisy: mean over the neighbours, along rows and then columns. */
static void smooth_line(double *line, int count, int stride, double *spare) {
    enum { REACH = 4 };
    for (int i = 0; i < count; i++) {
        double sum = 0, weight = 0;
        for (int k = -REACH; k <= REACH; k++) {
            if (i + k < 0 || i + k >= count || line[(i + k) * stride] < 0) continue;
            sum += line[(i + k) * stride];
            weight += 1;
        }
        spare[i] = weight > 0 ? sum / weight : -1;
    }
    for (int i = 0; i < count; i++) line[i * stride] = spare[i];
}

int view_paint(const view *v, const view *light, image *picture, int x, int y) {
    painter q = {v, light, NULL, v->width / VIEW_SAMPLES, v->height / VIEW_SAMPLES};
    double *spare = malloc((size_t)(q.columns + q.rows) * sizeof *spare);
    q.sky = malloc((size_t)q.columns * (size_t)q.rows * sizeof *q.sky);
    int ready = spare && q.sky;
    if (ready) {
        find_sky(&q);
        for (int pass = 0; pass < 2; pass++) {
            for (int i = 0; i < q.rows; i++) smooth_line(q.sky + (size_t)i * (size_t)q.columns, q.columns, 1, spare);
            for (int i = 0; i < q.columns; i++) smooth_line(q.sky + i, q.rows, q.columns, spare);
        }
        for (int row = 0; row < q.rows; row++)
            for (int column = 0; column < q.columns; column++) paint_pixel(&q, column, row, picture, x, y);
    }
    free(q.sky);
    free(spare);
    return ready ? 0 : -1;
}
