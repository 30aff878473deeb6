/* Figures of a measurement and their table. */
#ifndef PROPELLER_REPORT_H
#define PROPELLER_REPORT_H

#include "measure.h"
#include "scan.h"

#define REPORT_TOLERANCE 0.10 /* mm, the part's profile tolerance to either side */
#define REPORT_PROVEN_LEAST 0.999 /* share of the points; fewer would be a defect of the library */

/* The histogram: BINS bins from -HISTOGRAM_LIMIT to HISTOGRAM_LIMIT. */
#define HISTOGRAM_LIMIT 0.42 /* mm */
enum { BINS = 140, PERCENTILE_COUNT = 7 };

typedef struct summary {
    size_t count, proven, within; /* proven feet; deviations within the tolerance */
    double low, high, mean, rms, sigma;
} summary;

typedef struct report {
    summary whole, members[MEMBER_COUNT];
    double percentiles[PERCENTILE_COUNT];
    size_t edges, seams, collapsed, creases, ties;
    double found[DEFECT_COUNT]; /* mean deviation measured around each defect's centre */
    size_t bins[BINS], outside; /* outside: beyond the histogram's ends */
} report;

/* Returns 0, or -1 when memory is short. */
int report_new(const scan *s, const measurement *m, report *out);
void report_print(const report *r, const part *p, const scan *s, const measurement *m);

/* Were the planted defects found at their heights, and (nearly) all feet proven? */
int report_is_as_planted(const report *r, const scan *s);

/* A count with commas between the thousands, in `out`, which is returned. */
char *report_count(size_t n, char out[32]);

#endif
