/* An RGB picture: drawing with smooth edges, and the PNG file. Coordinates are pixels, y down. */
#ifndef PROPELLER_IMAGE_H
#define PROPELLER_IMAGE_H

typedef struct colour {
    unsigned char r, g, b;
} colour;

typedef struct image {
    int width, height;
    unsigned char *rgb;
} image;

/* Both return 0, or -1 when memory or the file fails. */
int image_new(int width, int height, image *out);
int image_write_png(const image *picture, const char *path);
void image_free(image *picture);

/* Mixes a colour over a pixel; outside the picture nothing happens. */
void image_blend(image *picture, int x, int y, colour c, double opacity);
void image_rectangle(image *picture, double x0, double y0, double x1, double y1, colour c, double opacity);
void image_line(image *picture, double x0, double y0, double x1, double y1, double width, colour c);
void image_disc(image *picture, double x, double y, double radius, colour c);

/* A stroke font of our own. `height` is that of a capital; x is the left end, the middle or the right end for
 * alignment -1, 0, 1; y is the baseline. '~' prints as a plus-minus sign, '^' as a degree sign. */
void image_text(image *picture, double x, double y, double height, double weight, int alignment, colour c,
                const char *text);
double image_text_width(double height, const char *text);

#endif
