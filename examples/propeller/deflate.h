/* Compression for the pictures: one zlib stream (RFC 1950, RFC 1951). */
#ifndef PROPELLER_DEFLATE_H
#define PROPELLER_DEFLATE_H

#include <stddef.h>

/* Returns a new buffer for free(), or NULL when memory is short. */
unsigned char *deflate_zlib(const unsigned char *data, size_t size, size_t *out_size);

#endif
