#include "report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PERCENTILES[PERCENTILE_COUNT] = {0.1, 1, 5, 50, 95, 99, 99.9};

static void add(summary *s, const fpt_foot_point *foot, double deviation) {
    if (s->count == 0) s->low = s->high = deviation;
    s->count++;
    s->proven += !(foot->flags & FPT_FOOT_NOT_PROVEN);
    s->within += fabs(deviation) <= REPORT_TOLERANCE;
    s->low = fmin(s->low, deviation);
    s->high = fmax(s->high, deviation);
    s->mean += deviation;             /* the sum, until finish() */
    s->rms += deviation * deviation;
}

static void finish(summary *s) {
    if (s->count == 0) return;
    s->mean /= (double)s->count;
    s->rms = sqrt(s->rms / (double)s->count);
    s->sigma = sqrt(fmax(0, s->rms * s->rms - s->mean * s->mean));
}

static void count_flags(report *r, uint32_t flags) {
    r->edges += (flags & FPT_FOOT_EDGE) != 0;
    r->seams += (flags & FPT_FOOT_SEAM) != 0;
    r->collapsed += (flags & FPT_FOOT_COLLAPSED) != 0;
    r->creases += (flags & FPT_FOOT_CREASE) != 0;
    r->ties += (flags & FPT_FOOT_TIE) != 0;
}

static void count_bin(report *r, double deviation) {
    double at = (deviation + HISTOGRAM_LIMIT) / (2 * HISTOGRAM_LIMIT) * BINS;
    if (at >= 0 && at < BINS) r->bins[(int)at]++;
    else r->outside++;
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int find_percentiles(const measurement *m, double out[PERCENTILE_COUNT]) {
    double *sorted = malloc(m->count * sizeof *sorted);
    if (!sorted) return -1;
    memcpy(sorted, m->deviation, m->count * sizeof *sorted);
    qsort(sorted, m->count, sizeof *sorted, by_value);
    for (int i = 0; i < PERCENTILE_COUNT; i++)
        out[i] = sorted[(size_t)(PERCENTILES[i] / 100 * (double)(m->count - 1) + 0.5)];
    free(sorted);
    return 0;
}

/* Mean deviation close around a defect's centre: within a fifth of its radius, on its member. */
static double mean_around(const measurement *m, const defect *d) {
    double sum = 0, count = 0, reach = 0.2 * d->radius;
    for (size_t i = 0; i < m->count; i++) {
        if (m->member[i] != d->at.member) continue;
        vec3 off = vec3_sub(vec3_of(m->feet[i].point), d->centre);
        if (vec3_dot(off, off) < reach * reach && fabs(vec3_dot(off, d->normal)) < 0.2 * reach + 0.05)
            sum += m->deviation[i], count++;
    }
    return count > 0 ? sum / count : 0;
}

int report_new(const scan *s, const measurement *m, report *out) {
    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < m->count; i++) {
        add(&out->whole, &m->feet[i], m->deviation[i]);
        add(&out->members[m->member[i]], &m->feet[i], m->deviation[i]);
        count_flags(out, m->feet[i].flags);
        count_bin(out, m->deviation[i]);
    }
    finish(&out->whole);
    for (int i = 0; i < MEMBER_COUNT; i++) finish(&out->members[i]);
    for (int i = 0; i < DEFECT_COUNT; i++) out->found[i] = mean_around(m, &s->defects[i]);
    return find_percentiles(m, out->percentiles);
}

char *report_count(size_t n, char out[32]) {
    char digits[24];
    int length = snprintf(digits, sizeof digits, "%zu", n), k = 0;
    for (int i = 0; i < length; i++) {
        if (i > 0 && (length - i) % 3 == 0) out[k++] = ',';
        out[k++] = digits[i];
    }
    out[k] = 0;
    return out;
}

static double percent(size_t share, size_t whole) {
    return whole > 0 ? 100.0 * (double)share / (double)whole : 0;
}

static void print_line(const char *name, const summary *s) {
    char count[32];
    printf("  %-10s %10s   %7.3f %%   %+8.4f   %+8.4f   %+8.4f   %7.4f   %7.4f   %6.2f %%\n", name,
           report_count(s->count, count), percent(s->proven, s->count), s->low, s->high, s->mean, s->rms, s->sigma,
           percent(s->within, s->count));
}

static void print_members(const report *r, const part *p) {
    printf("\n  deviation in mm     proven        min        max       mean       rms     sigma   in +-%.2f\n",
           REPORT_TOLERANCE);
    for (int i = 0; i < MEMBER_COUNT; i++) print_line(p->members[i].name, &r->members[i]);
    print_line("part", &r->whole);
    printf("\n  percentiles ");
    for (int i = 0; i < PERCENTILE_COUNT; i++) printf("   %g %%: %+.3f", PERCENTILES[i], r->percentiles[i]);
    printf("\n");
}

static void print_defects(const report *r, const part *p, const scan *s) {
    printf("\n  planted defect           expected   measured (mm)\n");
    for (int i = 0; i < DEFECT_COUNT; i++)
        printf("  %-10s %-10s   %+8.3f   %+8.3f\n", s->defects[i].name, p->members[s->defects[i].at.member].name,
               s->defects[i].expected, r->found[i]);
}

static void print_histogram(const report *r) {
    enum { JOIN = 5, ROWS = BINS / JOIN, LENGTH = 60 };
    size_t rows[ROWS] = {0}, most = 1;
    for (int i = 0; i < ROWS * JOIN; i++) rows[i / JOIN] += r->bins[i];
    for (int i = 0; i < ROWS; i++) most = rows[i] > most ? rows[i] : most;
    printf("\n  deviation (mm)        points (bars in logarithmic scale)\n");
    for (int i = 0; i < ROWS; i++) {
        double low = HISTOGRAM_LIMIT * (2.0 * i / ROWS - 1), high = HISTOGRAM_LIMIT * (2.0 * (i + 1) / ROWS - 1);
        int length = rows[i] > 0 ? 1 + (int)(LENGTH * log((double)rows[i]) / log((double)most)) : 0;
        printf("  %+.2f .. %+.2f  %9zu  ", low, high, rows[i]);
        for (int k = 0; k < length; k++) putchar('#');
        putchar('\n');
    }
    printf("  outside         %9zu\n", r->outside);
}

void report_print(const report *r, const part *p, const scan *s, const measurement *m) {
    char points[32], rate[32], queries[32];
    printf("  points          %s on %d surfaces, noise sigma %.3f mm\n", report_count(m->count, points), MEMBER_COUNT,
           SCAN_NOISE);
    printf("  projection      %.2f s, %s points/s, %s queries\n", m->seconds,
           report_count((size_t)((double)m->count / m->seconds), rate), report_count(m->queries, queries));
    printf("  proven nearest  %.4f %%\n", percent(r->whole.proven, r->whole.count));
    printf("  feet on         edges %zu, seams %zu, creases %zu, collapsed edges %zu; ties %zu\n", r->edges, r->seams,
           r->creases, r->collapsed, r->ties);
    print_members(r, p);
    print_defects(r, p, s);
    print_histogram(r);
}

int report_is_as_planted(const report *r, const scan *s) {
    for (int i = 0; i < DEFECT_COUNT; i++)
        if (fabs(r->found[i] - s->defects[i].expected) > 0.02) return 0;
    return (double)r->whole.proven >= REPORT_PROVEN_LEAST * (double)r->whole.count;
}
