/* One figure: the drawing above, the table below. */
#include "drawing.h"

#include <math.h>

enum { SCALE = 60, LEFT = 40, TOP = 70, HEIGHT = 420, STEPS = 400, ROW = 20 };

/* Coordinates of the page. */
static double page_x(double x) { return LEFT + SCALE * x; }
static double page_y(double y) { return TOP + HEIGHT - SCALE * y; }

static void draw_polygon(FILE *out, const double *poles, size_t count) {
    fprintf(out, "<polyline fill='none' stroke='#888' stroke-width='1' stroke-dasharray='6 4' points='");
    for (size_t i = 0; i < count; i++) fprintf(out, "%.2f,%.2f ", page_x(poles[3 * i]), page_y(poles[3 * i + 1]));
    fprintf(out, "'/>\n");
    for (size_t i = 0; i < count; i++) {
        const double x = page_x(poles[3 * i]), y = page_y(poles[3 * i + 1]);
        fprintf(out, "<rect x='%.2f' y='%.2f' width='6' height='6' fill='#444'/>\n", x - 3, y - 3);
        fprintf(out, "<text x='%.2f' y='%.2f' font-size='13'>P%u</text>\n", x + 8, y - 8, (unsigned)i);
    }
}

static void draw_curve(FILE *out, const method *by) {
    double domain[2], point[3];
    if (fpt_curve_domain(by->curve, domain) != FPT_OK) return;
    fprintf(out, "<polyline fill='none' stroke='%s' stroke-width='2' points='", by->colour);
    for (int i = 0; i <= STEPS; i++) {
        const double u = i == STEPS ? domain[1] : domain[0] + (domain[1] - domain[0]) * i / STEPS;
        if (fpt_curve_evaluate(by->curve, u, 0, point) == FPT_OK) {
            fprintf(out, "%.2f,%.2f ", page_x(point[0]), page_y(point[1]));
        }
    }
    fprintf(out, "'/>\n");
}

/* A circle of the wished distance around each pole with a wish, and the way to the nearest point. */
static void draw_wishes(FILE *out, const double *poles, size_t count, const method *by) {
    for (size_t i = 0; i < count; i++) {
        const double x = page_x(poles[3 * i]), y = page_y(poles[3 * i + 1]);
        fpt_weights_pole pole;
        double foot[3];
        if (fpt_weights_report_pole(by->report, i, &pole) != FPT_OK || isnan(pole.wish)) continue;
        if (fpt_curve_evaluate(by->curve, pole.u, 0, foot) != FPT_OK) continue;
        fprintf(out, "<circle cx='%.2f' cy='%.2f' r='%.2f' fill='none' stroke='#d90' stroke-width='1'/>\n", x, y,
                SCALE * pole.wish);
        fprintf(out, "<line x1='%.2f' y1='%.2f' x2='%.2f' y2='%.2f' stroke='%s' stroke-width='1'/>\n", x, y,
                page_x(foot[0]), page_y(foot[1]), by->colour);
    }
}

static const char *state_name(uint32_t state) {
    static const char *const names[] = {"", "met", "not met", "impossible"};
    return state < 4 ? names[state] : "?";
}

/* A row for each pole with a wish, a column for each method. */
static void draw_table(FILE *out, const double *top, size_t count, const method *methods, size_t method_count) {
    double y = *top;
    fprintf(out, "<text x='%d' y='%.0f'>pole</text><text x='%d' y='%.0f'>wish</text>\n", LEFT, y, LEFT + 60, y);
    for (size_t m = 0; m < method_count; m++) {
        if (methods[m].report == NULL) continue;
        fprintf(out, "<text x='%d' y='%.0f' fill='%s'>%s: weight, distance</text>\n", LEFT + 130 + 290 * (int)(m - 1), y,
                methods[m].colour, methods[m].name);
    }
    for (size_t i = 0; i < count; i++) {
        fpt_weights_pole pole;
        if (fpt_weights_report_pole(methods[method_count - 1].report, i, &pole) != FPT_OK) continue;
        y += ROW;
        fprintf(out, "<text x='%d' y='%.0f'>P%u</text>\n", LEFT, y, (unsigned)i);
        if (!isnan(pole.wish)) fprintf(out, "<text x='%d' y='%.0f'>%.4f</text>\n", LEFT + 60, y, pole.wish);
        for (size_t m = 0; m < method_count; m++) {
            if (methods[m].report == NULL || fpt_weights_report_pole(methods[m].report, i, &pole) != FPT_OK) continue;
            fprintf(out, "<text x='%d' y='%.0f' fill='%s'>%.4f, %.4f %s</text>\n", LEFT + 130 + 290 * (int)(m - 1), y,
                    methods[m].colour, pole.weight, pole.distance, state_name(pole.state));
        }
    }
}

int draw_figure(const char *path, const char *title, const double *poles, size_t pole_count, const method *methods,
                size_t method_count) {
    const double width = LEFT * 2 + SCALE * 13.0, table = TOP + HEIGHT + 50.0;
    FILE *out = fopen(path, "w");
    if (out == NULL) return -1;
    fprintf(out, "<svg xmlns='http://www.w3.org/2000/svg' width='%.0f' height='%.0f' font-family='sans-serif' "
                 "font-size='13'>\n<rect width='100%%' height='100%%' fill='white'/>\n",
            width, table + ROW * (double)(pole_count + 1));
    fprintf(out, "<text x='%d' y='28' font-size='17'>%s</text>\n", LEFT, title);
    for (size_t m = 0; m < method_count; m++) {
        const int x = LEFT + 200 * (int)m;
        fprintf(out, "<line x1='%d' y1='48' x2='%d' y2='48' stroke='%s' stroke-width='2'/>\n", x, x + 24, methods[m].colour);
        fprintf(out, "<text x='%d' y='52'>%s</text>\n", x + 30, methods[m].name);
    }
    draw_polygon(out, poles, pole_count);
    for (size_t m = 0; m < method_count; m++) {
        draw_curve(out, &methods[m]);
        if (m + 1 == method_count) draw_wishes(out, poles, pole_count, &methods[m]);
    }
    draw_table(out, &table, pole_count, methods, method_count);
    fprintf(out, "</svg>\n");
    return fclose(out);
}
