/* Text with a stroke font. A glyph is a list of strokes on a grid: x is a digit, y a letter from 'a' (3 below the
 * baseline) over 'd' (the baseline) and 'k' (height of an x) to 'n' (height of a capital). A stroke is a polyline, or,
 * after '~', the quadratic B-spline of its points, clamped at both ends. */
#include <math.h>
#include <string.h>

#include "image.h"
#include "segment.h"

enum { CAPITAL = 10, SEGMENTS_MAX = 256, CURVE_STEPS = 6 };

#define ROUND "~3n5n6l6f5d1d0f0l1n3n"
#define BOWL "~5h5i4k1k0i0f1d4d5f5h"

static const char *glyph(char c) {
    static const char *const digits[] = {
        ROUND, "1l3n3d 1d5d", "~0k0m1n5n6m6i0f0d 0d6d", "~0l1n5n6l6j4i2i ~2i5i6g6f5d1d0f", "5d5n0g6g",
        "6n1n0i ~0i1j5j6h6f5d1d0f", "~5n2n0k0f1d5d6f6h5j1j0g", "0n6n2d",
        "~3j1j0k0m1n5n6m6k5j3j ~3j1j0h0f1d5d6f6h5j3j", "~1d4d6g6l5n1n0l0j1h5h6k"};
    static const char *const capitals[] = {
        "0d3n6d 1g5g", "0d0n ~0n4n6m6j4i0i ~0i5i6h6e5d0d", "~6l5n1n0l0f1d5d6f", "0d0n ~0n4n6l6f4d0d",
        "6n0n0d6d 0i5i", "6n0n0d 0i5i", "~6l5n1n0l0f1d5d6f6i 6i3i", "0d0n 6d6n 0i6i", "0d0n", "~5n5f4d1d0f",
        "0d0n 6n0h 2j6d", "0n0d5d", "0d0n4f8n8d", "0d0n6d6n", ROUND, "0d0n ~0n4n6m6i4h0h", ROUND " 4g7c",
        "0d0n ~0n4n6m6i4h0h 3h6d", "~6l5n1n0m0j1i5i6h6e5d1d0f", "0n6n 3n3d", "~0n0f1d5d6f6n", "0n3d6n", "0n2d4k6d8n",
        "0n6d 6n0d", "0n3i6n 3i3d", "0n6n0d6d"};
    static const char *const small[] = {
        "5k5d " BOWL, "0n0d ~0h0i1k4k5i5f4d1d0f0h", "~5j4k1k0i0f1d4d5e", "5n5d " BOWL, "0h5h ~5h5i4k1k0i0f1d4d5e",
        "~3n1n1k1d 0k3k", "~5k5c4a1a0b " BOWL, "0n0d ~0i1k4k5i5d", "0k0d 0n0n", "~2k2b1a0a 2n2n", "0d0n 4k0g 1h4d",
        "0n0d", "0k0d ~0i1k3k4i4d ~4i5k7k8i8d", "0k0d ~0i1k4k5i5d", BOWL, "0k0a ~0h0i1k4k5i5f4d1d0f0h", "5k5a " BOWL,
        "0k0d ~0h1k3k", "~5j4k1k0j0i1h4h5g5e4d1d0e", "~1n1f2d3d 0k3k", "5k5d ~0k0f1d4d5f", "0k3d5k", "0k2d4j6d8k",
        "0k5d 5k0d", "0k3d 5k2a", "0k5k0d5d"};
    if (c >= '0' && c <= '9') return digits[c - '0'];
    if (c >= 'A' && c <= 'Z') return capitals[c - 'A'];
    if (c >= 'a' && c <= 'z') return small[c - 'a'];
    switch (c) {
    case '.': return "0d0d";
    case ',': return "1d0b";
    case ':': return "0d0d 0j0j";
    case '+': return "3f3l 0i6i";
    case '-': return "0i6i";
    case '=': return "0g5g 0j5j";
    case '/': return "0b5n";
    case '(': return "~2n0l0f2b";
    case ')': return "~0n2l2f0b";
    case '<': return "5l0i5f";
    case '>': return "0l5i0f";
    case '%': return "6n1d ~1n0n0k2k2n1n ~6g5g5d7d7g6g";
    case '~': return "3f3n 0j6j 0d6d";
    case '^': return "~1n0n0k2k2n1n";
    default: return "";
    }
}

static double glyph_width(char c) {
    const char *strokes = glyph(c);
    int width = c == ' ' ? 2 : 0;
    for (; *strokes; strokes++)
        if (*strokes >= '0' && *strokes <= '9' && *strokes - '0' > width) width = *strokes - '0';
    return width;
}

static const double SPACING = 2.9; /* grid units between glyphs */

double image_text_width(double height, const char *text) {
    double width = 0;
    for (; *text; text++) width += glyph_width(*text) + SPACING;
    return width > 0 ? (width - SPACING) * height / CAPITAL : 0;
}

typedef struct outline {
    double segments[SEGMENTS_MAX][4];
    int count;
} outline;

static void add_segment(outline *o, const double a[2], const double b[2]) {
    if (o->count == SEGMENTS_MAX) return;
    double *s = o->segments[o->count++];
    s[0] = a[0], s[1] = a[1], s[2] = b[0], s[3] = b[1];
}

/* The parabola from a to b with the pole m between. */
static void add_parabola(outline *o, const double a[2], const double m[2], const double b[2]) {
    double last[2] = {a[0], a[1]};
    for (int i = 1; i <= CURVE_STEPS; i++) {
        double t = (double)i / CURVE_STEPS, next[2];
        for (int k = 0; k < 2; k++) next[k] = (1 - t) * (1 - t) * a[k] + 2 * t * (1 - t) * m[k] + t * t * b[k];
        add_segment(o, last, next);
        last[0] = next[0], last[1] = next[1];
    }
}

static void add_curve(outline *o, double p[][2], int count) {
    double start[2] = {p[0][0], p[0][1]};
    for (int i = 1; i + 1 < count; i++) {
        double end[2] = {p[i + 1][0], p[i + 1][1]};
        if (i + 2 < count) end[0] = 0.5 * (p[i][0] + end[0]), end[1] = 0.5 * (p[i][1] + end[1]);
        add_parabola(o, start, p[i], end);
        start[0] = end[0], start[1] = end[1];
    }
}

/* Strokes of a glyph in pixels. */
static void trace(char c, double x, double y, double unit, outline *o) {
    const char *s = glyph(c);
    o->count = 0;
    while (*s) {
        double p[16][2];
        int count = 0, curved = *s == '~';
        if (curved) s++;
        for (; *s && *s != ' ' && count < 16; s += 2, count++)
            p[count][0] = x + unit * (s[0] - '0'), p[count][1] = y - unit * (s[1] - 'd');
        if (curved) add_curve(o, p, count);
        for (int i = 0; i + 1 < count && !curved; i++) add_segment(o, p[i], p[i + 1]);
        if (*s == ' ') s++;
    }
}

static double distance(const outline *o, double x, double y) {
    double best = 1e9;
    for (int i = 0; i < o->count; i++) {
        const double *s = o->segments[i];
        best = fmin(best, segment_distance(x, y, s[0], s[1], s[2], s[3]));
    }
    return best;
}

void image_text(image *picture, double x, double y, double height, double weight, int alignment, colour c,
                const char *text) {
    double unit = height / CAPITAL;
    outline o;
    x -= 0.5 * (alignment + 1) * image_text_width(height, text);
    for (; *text; text++) {
        double width = glyph_width(*text) * unit;
        trace(*text, x, y, unit, &o);
        for (int j = (int)(y - 12 * unit) - 1; j <= (int)(y + 4 * unit) + 1; j++)
            for (int i = (int)(x - 2) - 1; i <= (int)(x + width + 2) + 1; i++)
                image_blend(picture, i, j, c, 0.5 * weight + 0.5 - distance(&o, i + 0.5, j + 0.5));
        x += width + SPACING * unit;
    }
}
