/* PNG: each row is stored as differences to its neighbours, by the filter that leaves the smallest ones, and the whole
 * is compressed. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "deflate.h"
#include "image.h"

enum { BYTES = 3, FILTERS = 5 };

static uint32_t crc32(uint32_t crc, const unsigned char *data, size_t size) {
    crc = ~crc;
    for (size_t i = 0; i < size; i++) {
        crc ^= data[i];
        for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (0xEDB88320u & (0u - (crc & 1u)));
    }
    return ~crc;
}

static void big_endian(uint32_t value, unsigned char out[4]) {
    for (int i = 0; i < 4; i++) out[i] = (unsigned char)(value >> (24 - 8 * i));
}

static int write_chunk(FILE *file, const char *type, const unsigned char *data, size_t size) {
    unsigned char length[4], name[4], check[4];
    memcpy(name, type, 4);
    big_endian((uint32_t)size, length);
    big_endian(crc32(crc32(0, name, 4), data, size), check);
    return fwrite(length, 1, 4, file) == 4 && fwrite(name, 1, 4, file) == 4 && fwrite(data, 1, size, file) == size &&
           fwrite(check, 1, 4, file) == 4;
}

/* What the filter predicts from the bytes left, above and above left. */
static int predict(int filter, int left, int above, int corner) {
    int to_left = abs(above - corner), to_above = abs(left - corner), to_corner = abs(left + above - 2 * corner);
    switch (filter) {
    case 1: return left;
    case 2: return above;
    case 3: return (left + above) / 2;
    case 4: return to_left <= to_above && to_left <= to_corner ? left : to_above <= to_corner ? above : corner;
    default: return 0;
    }
}

/* Returns the sum of the differences' sizes. */
static long filter_row(int filter, const unsigned char *row, const unsigned char *above, int size, unsigned char *out) {
    long sum = 0;
    out[0] = (unsigned char)filter;
    for (int i = 0; i < size; i++) {
        int left = i >= BYTES ? row[i - BYTES] : 0, up = above ? above[i] : 0;
        int corner = above && i >= BYTES ? above[i - BYTES] : 0;
        out[i + 1] = (unsigned char)(row[i] - predict(filter, left, up, corner));
        sum += abs((signed char)out[i + 1]);
    }
    return sum;
}

/* All rows with their filters; NULL when memory is short. */
static unsigned char *filter_rows(const image *picture, size_t *out_size) {
    int size = picture->width * BYTES;
    size_t stride = (size_t)size + 1;
    unsigned char *rows = malloc(stride * (size_t)picture->height), *trial = malloc(stride);
    *out_size = stride * (size_t)picture->height;
    for (int y = 0; y < picture->height && rows && trial; y++) {
        const unsigned char *row = picture->rgb + (size_t)y * (size_t)size;
        const unsigned char *above = y > 0 ? row - size : NULL;
        long best = -1;
        for (int filter = 0; filter < FILTERS; filter++) {
            long sum = filter_row(filter, row, above, size, trial);
            if (best >= 0 && sum >= best) continue;
            best = sum;
            memcpy(rows + (size_t)y * stride, trial, stride);
        }
    }
    if (!trial) {
        free(rows);
        rows = NULL;
    }
    free(trial);
    return rows;
}

static int write_file(FILE *file, const image *picture, const unsigned char *data, size_t size) {
    static const unsigned char signature[8] = {137, 'P', 'N', 'G', 13, 10, 26, 10};
    unsigned char header[13] = {0};
    big_endian((uint32_t)picture->width, header);
    big_endian((uint32_t)picture->height, header + 4);
    header[8] = 8; /* bits */
    header[9] = 2; /* RGB */
    return fwrite(signature, 1, 8, file) == 8 && write_chunk(file, "IHDR", header, 13) &&
           write_chunk(file, "IDAT", data, size) && write_chunk(file, "IEND", header, 0);
}

int image_write_png(const image *picture, const char *path) {
    size_t raw_size, size = 0;
    unsigned char *raw = filter_rows(picture, &raw_size);
    unsigned char *data = raw ? deflate_zlib(raw, raw_size, &size) : NULL;
    FILE *file = data ? fopen(path, "wb") : NULL;
    int written = file && write_file(file, picture, data, size);
    if (file && fclose(file) != 0) written = 0;
    free(raw);
    free(data);
    return written ? 0 : -1;
}
