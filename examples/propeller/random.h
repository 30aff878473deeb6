/* A small generator of our own (xorshift64*), so that every machine scans the same points. */
#ifndef PROPELLER_RANDOM_H
#define PROPELLER_RANDOM_H

#include <math.h>
#include <stdint.h>

typedef struct random_source {
    uint64_t state; /* not zero */
} random_source;

/* Uniform in [0, 1). */
static inline double random_uniform(random_source *r) {
    r->state ^= r->state >> 12;
    r->state ^= r->state << 25;
    r->state ^= r->state >> 27;
    return (double)((r->state * UINT64_C(2685821657736338717)) >> 11) / 9007199254740992.0;
}

/* Gaussian with mean 0 and standard deviation 1. */
static inline double random_gaussian(random_source *r) {
    double radius = sqrt(-2 * log(1 - random_uniform(r)));
    return radius * cos(2 * acos(-1.0) * random_uniform(r));
}

#endif
