#include "image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "segment.h"

int image_new(int width, int height, image *out) {
    out->width = width, out->height = height;
    out->rgb = malloc((size_t)width * (size_t)height * 3);
    if (!out->rgb) return -1;
    memset(out->rgb, 255, (size_t)width * (size_t)height * 3);
    return 0;
}

void image_free(image *picture) {
    free(picture->rgb);
}

static unsigned char mix(unsigned char below, unsigned char above, double opacity) {
    return (unsigned char)(below + (above - below) * opacity + 0.5);
}

void image_blend(image *picture, int x, int y, colour c, double opacity) {
    if (x < 0 || y < 0 || x >= picture->width || y >= picture->height || !(opacity > 0)) return;
    unsigned char *p = picture->rgb + 3 * ((size_t)y * (size_t)picture->width + (size_t)x);
    double o = opacity < 1 ? opacity : 1;
    p[0] = mix(p[0], c.r, o), p[1] = mix(p[1], c.g, o), p[2] = mix(p[2], c.b, o);
}

/* Share of the pixel [i, i+1] that lies inside [low, high]. */
static double cover(int i, double low, double high) {
    return fmin(high, i + 1.0) - fmax(low, i);
}

void image_rectangle(image *picture, double x0, double y0, double x1, double y1, colour c, double opacity) {
    for (int y = (int)floor(y0); y < y1; y++)
        for (int x = (int)floor(x0); x < x1; x++)
            image_blend(picture, x, y, c, opacity * cover(x, x0, x1) * cover(y, y0, y1));
}

void image_line(image *picture, double x0, double y0, double x1, double y1, double width, colour c) {
    double reach = 0.5 * width + 1;
    for (int y = (int)floor(fmin(y0, y1) - reach); y <= fmax(y0, y1) + reach; y++)
        for (int x = (int)floor(fmin(x0, x1) - reach); x <= fmax(x0, x1) + reach; x++) {
            double distance = segment_distance(x + 0.5, y + 0.5, x0, y0, x1, y1);
            image_blend(picture, x, y, c, 0.5 * width + 0.5 - distance);
        }
}

void image_disc(image *picture, double x, double y, double radius, colour c) {
    image_line(picture, x, y, x, y, 2 * radius, c);
}
