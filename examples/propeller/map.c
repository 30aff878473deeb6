#include "map.h"

#include <stdlib.h>
#include <string.h>

enum { SMOOTHINGS = 2 };

/* Sums and counts; smoothing spreads both, so that cells with many points count more and gaps are filled. */
typedef struct grid {
    double sum[MAP_SIZE][MAP_SIZE], count[MAP_SIZE][MAP_SIZE];
    int is_smooth; /* across the seam */
} grid;

/* Cell number outside the grid: round the seam where it is smooth, else the border's. */
static int neighbour(int i, int is_smooth) {
    if (is_smooth) return (i + MAP_SIZE) % MAP_SIZE;
    return i < 0 ? 0 : i >= MAP_SIZE ? MAP_SIZE - 1 : i;
}

static void smooth(double cells[MAP_SIZE][MAP_SIZE], double spare[MAP_SIZE][MAP_SIZE], int is_smooth) {
    for (int i = 0; i < MAP_SIZE; i++)
        for (int j = 0; j < MAP_SIZE; j++)
            spare[i][j] = 0.25 * cells[neighbour(i - 1, is_smooth)][j] + 0.5 * cells[i][j] +
                          0.25 * cells[neighbour(i + 1, is_smooth)][j];
    for (int i = 0; i < MAP_SIZE; i++)
        for (int j = 0; j < MAP_SIZE; j++)
            cells[i][j] =
                0.25 * spare[i][neighbour(j - 1, 0)] + 0.5 * spare[i][j] + 0.25 * spare[i][neighbour(j + 1, 0)];
}

/* Empty cells (parts that are covered) take the mean of the filled ones around, ring after ring. */
static void fill_gaps(grid *g) {
    for (int ring = 0; ring < MAP_SIZE; ring++) {
        int gaps = 0;
        for (int i = 0; i < MAP_SIZE; i++)
            for (int j = 0; j < MAP_SIZE; j++) {
                if (g->count[i][j] > 1e-9) continue;
                double sum = 0, count = 0;
                for (int k = 0; k < 9; k++) {
                    int a = neighbour(i + k / 3 - 1, g->is_smooth), b = neighbour(j + k % 3 - 1, 0);
                    if (g->count[a][b] > 1e-9) sum += g->sum[a][b], count += g->count[a][b];
                }
                if (count > 0) g->sum[i][j] = 1e-8 * sum / count, g->count[i][j] = 1e-8;
                else gaps++;
            }
        if (gaps == 0) return;
    }
}

static int cell_of(double x, double low, double high) {
    int i = (int)((x - low) / (high - low) * MAP_SIZE);
    return i < 0 ? 0 : i >= MAP_SIZE ? MAP_SIZE - 1 : i;
}

static void collect(const measurement *m, const part *p, int index, grid *g) {
    const double *d = p->members[index].domain;
    memset(g, 0, sizeof *g);
    g->is_smooth = p->members[index].is_smooth;
    for (size_t i = 0; i < m->count; i++) {
        if (m->member[i] != index) continue;
        int a = cell_of(m->feet[i].u, d[0], d[1]), b = cell_of(m->feet[i].v, d[2], d[3]);
        g->sum[a][b] += m->deviation[i];
        g->count[a][b] += 1;
    }
}

int map_new(const part *p, const measurement *m, deviation_map **out) {
    deviation_map *map = malloc(sizeof *map);
    grid *g = malloc(2 * sizeof *g); /* the second one is room for smoothing */
    for (int index = 0; index < MEMBER_COUNT && map && g; index++) {
        collect(m, p, index, g);
        for (int pass = 0; pass < SMOOTHINGS; pass++) {
            smooth(g->sum, g[1].sum, g->is_smooth);
            smooth(g->count, g[1].count, g->is_smooth);
        }
        fill_gaps(g);
        for (int i = 0; i < MAP_SIZE; i++)
            for (int j = 0; j < MAP_SIZE; j++) map->mean[index][i][j] = (float)(g->sum[i][j] / g->count[i][j]);
    }
    int made = map && g;
    free(g);
    if (!made) {
        free(map);
        map = NULL;
    }
    *out = map;
    return made ? 0 : -1;
}

void map_free(deviation_map *map) {
    free(map);
}

double map_at(const deviation_map *map, const part *p, site at) {
    const member *m = &p->members[at.member];
    double x = (at.u - m->domain[0]) / (m->domain[1] - m->domain[0]) * MAP_SIZE - 0.5;
    double y = (at.v - m->domain[2]) / (m->domain[3] - m->domain[2]) * MAP_SIZE - 0.5;
    int i = (int)floor(x), j = (int)floor(y);
    double s = x - i, t = y - j, value = 0;
    for (int k = 0; k < 4; k++) {
        double weight = (k & 1 ? s : 1 - s) * (k & 2 ? t : 1 - t);
        value += weight * map->mean[at.member][neighbour(i + (k & 1), m->is_smooth)][neighbour(j + (k >> 1), 0)];
    }
    return value;
}
