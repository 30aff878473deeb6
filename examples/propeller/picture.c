#include "picture.h"

#include <stdio.h>
#include <stdlib.h>

#include "map.h"
#include "view.h"

enum { WIDTH = 1600, HEIGHT = 960 };
enum { LIGHT_SIZE = 2200 };

static const colour INK = {28, 36, 46}, PALE_INK = {98, 108, 120}, WHITE = {255, 255, 255};

/* One view of the part in the picture. */
typedef struct panel {
    const char *title;
    int x, y, width, height;
    vec3 eye, target, up;
    double field; /* mm across the panel at the target */
    int is_framed;
} panel;

/* A label: a box at (x, y) in the picture and a line to a place of the part. */
typedef struct note {
    int panel;
    int defect;       /* its place and its measured height, or -1: */
    const char *text; /* this text */
    site at;          /* and this place */
    int x, y;
} note;

enum { PANEL_COUNT = 3, NOTE_COUNT = 11 };

static const panel PANELS[PANEL_COUNT] = {
    {"Pressure side", 0, 96, 900, 854, {110, -230, 420}, {0, -3, 4}, {0, 1, 0}, 258, 0},
    {"Suction side", 900, 96, 570, 440, {-150, -190, -430}, {0, 0, 0}, {0, 1, 0}, 325, 0},
    {"Tip of blade 1", 912, 548, 546, 380, {150, -70, 330}, {80, 31, 0}, {0, 1, 0}, 112, 1},
};

static const note NOTES[NOTE_COUNT] = {
    {0, 0, NULL, {0, 0, 0}, 800, 250},
    {0, 1, NULL, {0, 0, 0}, 560, 190},
    {0, 2, NULL, {0, 0, 0}, 240, 890},
    {0, 3, NULL, {0, 0, 0}, 560, 890},
    {0, 6, NULL, {0, 0, 0}, 150, 330},
    {0, 7, NULL, {0, 0, 0}, 64, 836},
    {1, 4, NULL, {0, 0, 0}, 990, 200},
    {1, 5, NULL, {0, 0, 0}, 1000, 490},
    {2, -1, "collapsed tip", {0, 0.5, 1.0}, 1386, 628},
    {2, -1, "sharp edge and seam", {0, 0.0, 0.70}, 1030, 650},
    {2, 0, NULL, {0, 0, 0}, 1400, 840},
};

static void paint_background(image *picture) {
    for (int y = 0; y < picture->height; y++) {
        double t = (double)y / picture->height;
        colour c = {(unsigned char)(250 - 22 * t), (unsigned char)(251 - 18 * t), (unsigned char)(253 - 14 * t)};
        for (int x = 0; x < picture->width; x++) image_blend(picture, x, y, c, 1);
    }
}

static camera panel_camera(const panel *q) {
    return camera_new(q->eye, q->target, q->up, q->field, q->width * VIEW_SAMPLES, q->height * VIEW_SAMPLES, 0);
}

static void paint_frame(image *picture, const panel *q) {
    double x0 = q->x + 0.5, y0 = q->y + 0.5, x1 = q->x + q->width - 0.5, y1 = q->y + q->height - 0.5;
    image_line(picture, x0, y0, x1, y0, 1, PALE_INK);
    image_line(picture, x1, y0, x1, y1, 1, PALE_INK);
    image_line(picture, x1, y1, x0, y1, 1, PALE_INK);
    image_line(picture, x0, y1, x0, y0, 1, PALE_INK);
}

static fpt_status paint_panel(const part *p, const deviation_map *map, const panel *q, image *picture) {
    view seen = {0}, light = {0};
    camera c = panel_camera(q);
    vec3 above = vec3_sub(vec3_scale(0.80, c.up), vec3_scale(0.95, c.forward));
    vec3 lamp_eye = vec3_scale(400, vec3_unit(vec3_add(vec3_scale(-0.55, c.right), above)));
    camera lamp = camera_new(lamp_eye, vec3_new(0, 0, 0), c.right, 270, LIGHT_SIZE, LIGHT_SIZE, 1);
    fpt_status status = view_new(p, map, c, q->width * VIEW_SAMPLES, q->height * VIEW_SAMPLES, &seen);
    if (status == FPT_OK) status = view_new(p, NULL, lamp, LIGHT_SIZE, LIGHT_SIZE, &light);
    if (status == FPT_OK && view_paint(&seen, &light, picture, q->x, q->y) != 0)
        status = FPT_OUT_OF_MEMORY;
    view_free(&seen);
    view_free(&light);
    if (q->is_framed) paint_frame(picture, q);
    image_text(picture, q->x + 32, q->y + 40, 14, 1.7, -1, INK, q->title);
    return status;
}

static void paint_label(image *picture, double x, double y, const char *text) {
    double half = 0.5 * image_text_width(13, text) + 9;
    image_rectangle(picture, x - half, y - 14, x + half, y + 14, INK, 1);
    image_rectangle(picture, x - half + 1, y - 13, x + half - 1, y + 13, WHITE, 1);
    image_text(picture, x, y + 6.5, 13, 1.6, 0, INK, text);
}

static fpt_status paint_note(const part *p, const scan *s, const report *r, const note *n, image *picture) {
    const panel *q = &PANELS[n->panel];
    const site *at = n->defect < 0 ? &n->at : &s->defects[n->defect].at;
    double point[3];
    fpt_status status = fpt_surface_evaluate(p->members[at->member].surface, at->u, at->v, 0, point);
    if (status != FPT_OK) return status;
    camera c = panel_camera(q);
    vec3 screen = camera_project(&c, vec3_of(point));
    double x = q->x + screen.x / VIEW_SAMPLES, y = q->y + screen.y / VIEW_SAMPLES;
    char measured[32];
    if (n->defect >= 0) snprintf(measured, sizeof measured, "%+.3f", r->found[n->defect]);
    image_line(picture, n->x, n->y, x, y, 1.2, INK);
    image_disc(picture, x, y, 3, INK);
    paint_label(picture, n->x, n->y, n->defect < 0 ? n->text : measured);
    return FPT_OK;
}

static void paint_colour_bar(image *picture) {
    enum { LEFT = 1482, TOP = 150, BAR_WIDTH = 26, BAR_HEIGHT = 690 };
    for (int y = 0; y < BAR_HEIGHT; y++) {
        double rgb[3];
        map_colour(1 - 2 * (y + 0.5) / BAR_HEIGHT, rgb);
        colour c = {(unsigned char)(255 * rgb[0]), (unsigned char)(255 * rgb[1]), (unsigned char)(255 * rgb[2])};
        image_rectangle(picture, LEFT, TOP + y, LEFT + BAR_WIDTH, TOP + y + 1, c, 1);
    }
    for (int i = -6; i <= 6; i++) {
        double value = 0.05 * i, y = TOP + 0.5 * BAR_HEIGHT * (1 - value / VIEW_LIMIT);
        char text[16];
        snprintf(text, sizeof text, i == 0 ? "0" : "%+.2f", value);
        image_line(picture, LEFT + BAR_WIDTH + 1, y, LEFT + BAR_WIDTH + 7, y, 1.2, INK);
        image_text(picture, LEFT + BAR_WIDTH + 14, y + 6, 12, 1.4, -1, INK, text);
    }
    image_text(picture, LEFT, TOP - 18, 12, 1.4, -1, INK, "mm");
}

static void paint_heading(const measurement *m, const report *r, image *picture) {
    char text[200], count[32];
    image_text(picture, 32, 52, 22, 2.8, -1, INK, "Propeller, diameter 240 mm: deviation from nominal");
    snprintf(text, sizeof text,
             "%s scan points, %.3f %% projected with proof.  sigma %.4f mm,  %.2f %% within ~%.2f mm",
             report_count(m->count, count), 100.0 * (double)r->whole.proven / (double)m->count, r->whole.sigma,
             100.0 * (double)r->whole.within / (double)m->count, REPORT_TOLERANCE);
    image_text(picture, 32, 84, 12.5, 1.4, -1, PALE_INK, text);
}

fpt_status picture_new(const part *p, const scan *s, const measurement *m, const report *r, image *out) {
    image picture = {0};
    deviation_map *map = NULL;
    fpt_status status = FPT_OUT_OF_MEMORY;
    if (image_new(WIDTH, HEIGHT, &picture) == 0 && map_new(p, m, &map) == 0) status = FPT_OK;
    if (status == FPT_OK) paint_background(&picture);
    for (int i = 0; i < PANEL_COUNT && status == FPT_OK; i++) status = paint_panel(p, map, &PANELS[i], &picture);
    for (int i = 0; i < NOTE_COUNT && status == FPT_OK; i++)
        status = paint_note(p, s, r, &NOTES[i], &picture);
    if (status == FPT_OK) {
        paint_colour_bar(&picture);
        paint_heading(m, r, &picture);
        *out = picture;
    } else {
        image_free(&picture);
    }
    map_free(map);
    return status;
}
