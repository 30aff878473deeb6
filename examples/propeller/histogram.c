#include "histogram.h"

#include <math.h>
#include <stdio.h>

#include "view.h"

/* The frame of the diagram in pixels; counts are on a logarithmic scale from 1 to 10^DECADES. */
enum { WIDTH = 900, HEIGHT = 420, LEFT = 84, RIGHT = 870, TOP = 70, BOTTOM = 350, DECADES = 6 };

static double x_of(double deviation) {
    return LEFT + (RIGHT - LEFT) * (deviation + HISTOGRAM_LIMIT) / (2 * HISTOGRAM_LIMIT);
}

static double y_of(double count) {
    return BOTTOM - (BOTTOM - TOP) * log10(fmax(count, 1)) / DECADES;
}

static void write_axes(FILE *file) {
    for (int decade = 0; decade <= DECADES; decade++) {
        double y = y_of(pow(10, decade));
        fprintf(file, "<line x1='%d' x2='%d' y1='%.1f' y2='%.1f' stroke='#dfe4ea'/>\n", LEFT, RIGHT, y, y);
        fprintf(file, "<text x='%d' y='%.1f' text-anchor='end'>10<tspan dy='-5' font-size='9'>%d</tspan></text>\n",
                LEFT - 10, y + 5, decade);
    }
    for (int i = -4; i <= 4; i++) {
        double x = x_of(0.1 * i);
        fprintf(file, "<line x1='%.1f' x2='%.1f' y1='%d' y2='%d' stroke='#1c242e'/>\n", x, x, BOTTOM, BOTTOM + 6);
        fprintf(file, "<text x='%.1f' y='%d' text-anchor='middle'>%s%.1f</text>\n", x, BOTTOM + 22,
                i < 0 ? "&#8722;" : i > 0 ? "+" : "", fabs(0.1 * i));
    }
    fprintf(file, "<text x='%d' y='%d' text-anchor='middle'>deviation from nominal (mm)</text>\n", (LEFT + RIGHT) / 2,
            BOTTOM + 50);
    fprintf(file, "<text transform='translate(26 %d) rotate(-90)' text-anchor='middle'>points per %.3f mm</text>\n",
            (TOP + BOTTOM) / 2, 2 * HISTOGRAM_LIMIT / BINS);
}

static void write_bars(FILE *file, const report *r) {
    for (int i = 0; i < BINS; i++) {
        double low = HISTOGRAM_LIMIT * (2.0 * i / BINS - 1), high = HISTOGRAM_LIMIT * (2.0 * (i + 1) / BINS - 1);
        double rgb[3], top = y_of((double)r->bins[i]);
        if (r->bins[i] == 0) continue;
        map_colour(0.5 * (low + high) / VIEW_LIMIT, rgb);
        fprintf(file, "<rect x='%.2f' y='%.2f' width='%.2f' height='%.2f' fill='#%02x%02x%02x'/>\n", x_of(low), top,
                x_of(high) - x_of(low) - 0.6, BOTTOM - top + 0.5, (unsigned)(255 * rgb[0]), (unsigned)(255 * rgb[1]),
                (unsigned)(255 * rgb[2]));
    }
}

/* What the noise alone would give: the bell of its standard deviation. */
static void write_noise(FILE *file, const report *r) {
    double peak = (double)r->whole.count * 2 * HISTOGRAM_LIMIT / BINS / (SCAN_NOISE * sqrt(2 * acos(-1.0)));
    double reach = SCAN_NOISE * sqrt(2 * log(fmax(peak, 2)));
    fprintf(file, "<polyline fill='none' stroke='#1c242e' stroke-width='1.6' points='");
    for (int i = -60; i <= 60; i++) {
        double x = reach * i / 60;
        fprintf(file, "%.2f,%.2f ", x_of(x), y_of(peak * exp(-0.5 * x * x / (SCAN_NOISE * SCAN_NOISE))));
    }
    fprintf(file, "'/>\n");
}

static void write_tolerance(FILE *file, const report *r) {
    for (int side = -1; side <= 1; side += 2) {
        double x = x_of(side * REPORT_TOLERANCE);
        fprintf(file, "<line x1='%.1f' x2='%.1f' y1='%d' y2='%d' stroke='#b01e28' stroke-width='1.4' "
                      "stroke-dasharray='6 4'/>\n", x, x, TOP - 6, BOTTOM);
        fprintf(file, "<text x='%.1f' y='%d' fill='#b01e28' text-anchor='%s'>tolerance %s%.2f</text>\n", x + 6 * side,
                TOP + 6, side < 0 ? "end" : "start", side < 0 ? "&#8722;" : "+", REPORT_TOLERANCE);
    }
    fprintf(file, "<text x='%d' y='%d' text-anchor='end'>%.2f %% within, &#963; %.4f mm</text>\n", RIGHT, TOP - 28,
            100.0 * (double)r->whole.within / (double)r->whole.count, r->whole.sigma);
    fprintf(file, "<text x='%d' y='%d' text-anchor='end' fill='#626c78'>line: the scanner&#8217;s noise alone, "
                  "&#963; %.3f mm</text>\n", RIGHT, TOP - 46, SCAN_NOISE);
}

int histogram_write(const report *r, const char *path) {
    char count[32];
    FILE *file = fopen(path, "w");
    if (!file) return -1;
    fprintf(file, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %d %d' width='%d' height='%d' "
                  "font-family='Helvetica, Arial, sans-serif' font-size='14' fill='#1c242e'>\n", WIDTH, HEIGHT, WIDTH,
            HEIGHT);
    fprintf(file, "<rect width='%d' height='%d' fill='#fbfcfd'/>\n", WIDTH, HEIGHT);
    fprintf(file, "<text x='%d' y='36' font-size='18' font-weight='bold'>Deviations of %s scan points</text>\n", LEFT,
            report_count(r->whole.count, count));
    write_axes(file);
    write_bars(file, r);
    write_noise(file, r);
    write_tolerance(file, r);
    fprintf(file, "<line x1='%d' x2='%d' y1='%d' y2='%d' stroke='#1c242e'/>\n</svg>\n", LEFT, RIGHT, BOTTOM, BOTTOM);
    int failed = ferror(file);
    return fclose(file) != 0 || failed ? -1 : 0;
}
