/* The measuring job: every scan point against every member of the part, with proof. */
#ifndef PROPELLER_MEASURE_H
#define PROPELLER_MEASURE_H

#include <stddef.h>

#include "part.h"

typedef struct measurement {
    size_t count;
    fpt_foot_point *feet;  /* on the nearest member; lower_bound and NOT_PROVEN speak of the whole part */
    unsigned char *member; /* the nearest member */
    double *deviation;     /* mm, signed: + outside the material */
    size_t queries;        /* asked of single members, >= count */
    double seconds;        /* for the projection alone */
} measurement;

/* `progress` hears the points done; `should_stop` may end the job with FPT_CANCELLED. Both may be NULL. */
typedef struct watcher {
    void (*progress)(void *user, size_t done, size_t total);
    int (*should_stop)(void *user);
    void *user;
} watcher;

fpt_status measurement_new(const part *p, const double *points, size_t count, const watcher *w, measurement *out);
void measurement_free(measurement *m);

#endif
