/* The histogram of the deviations as an SVG file. */
#ifndef PROPELLER_HISTOGRAM_H
#define PROPELLER_HISTOGRAM_H

#include "report.h"

/* Returns 0, or -1 when the file could not be written. */
int histogram_write(const report *r, const char *path);

#endif
