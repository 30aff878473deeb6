/* Deviation maps: for each member a grid over its parameters with the mean deviation of the points that fell there. */
#ifndef PROPELLER_MAP_H
#define PROPELLER_MAP_H

#include "measure.h"
#include "part.h"

enum { MAP_SIZE = 176 }; /* cells in u and in v: about 0.8 mm on a blade, a dozen points each */

typedef struct deviation_map {
    float mean[MEMBER_COUNT][MAP_SIZE][MAP_SIZE];
} deviation_map;

/* Returns 0, or -1 when memory is short. */
int map_new(const part *p, const measurement *m, deviation_map **out);
void map_free(deviation_map *map);

/* Interpolated between cell centres. */
double map_at(const deviation_map *map, const part *p, site at);

#endif
