/* The nearest point of a part of several surfaces, with proof, at little more than one query a point.
 *
 * Asking every member about every point would be right and slow. A member's box settles most of it: nothing on the
 * member is nearer than its box is. So each point asks the member that looks nearest first, and then only those whose
 * box is nearer than the distance found. The proof stays whole:
 *
 *     lower bound for the part = min over the members of { the query's lower_bound   if it was asked
 *                                                        { the distance to its box   if not
 *
 * A member not asked has a box at least as far as the distance found, so it takes nothing away. */
#include "measure.h"

#include <stdlib.h>
#include <string.h>

#include "clock.h"

enum { CHUNK = 1 << 16 }; /* points in one go: 5 MB of records, enough to keep all cores busy */

/* What is known about one point of the chunk. */
typedef struct state {
    double box_distance[MEMBER_COUNT];
    double bound;      /* least lower bound of the members asked */
    double weak_bound; /* the same among the answers that were not proven */
    unsigned asked;    /* bit set of the members asked */
    int first;         /* the member to ask first */
} state;

typedef struct job {
    const part *part;
    const double *points; /* of the chunk */
    fpt_foot_point *feet;
    unsigned char *member;
    size_t count;
    state states[CHUNK];
    double asked_points[3 * CHUNK];
    size_t asked_index[CHUNK];
    fpt_foot_point answers[CHUNK];
    double parameters[2 * CHUNK], derivatives[9 * CHUNK];
    size_t queries;
    const watcher *watcher;
    size_t done_before, answered, total;
    int asks_first;
} job;

static double box_distance(const double box[6], const double *x, double *to_centre) {
    double outside = 0, centre = 0;
    for (int axis = 0; axis < 3; axis++) {
        double low = box[axis], high = box[3 + axis];
        double gap = fmax(fmax(low - x[axis], x[axis] - high), 0);
        double off = x[axis] - 0.5 * (low + high);
        outside += gap * gap;
        centre += off * off;
    }
    *to_centre = centre;
    return sqrt(outside) * (1 - 1e-15); /* rounded down: it is a bound */
}

/* The nearest box is asked first; among boxes that hold the point, the one whose centre is nearest. */
static void look_at_boxes(const part *p, const double *x, state *s) {
    double best = HUGE_VAL, best_centre = HUGE_VAL;
    s->bound = s->weak_bound = HUGE_VAL;
    s->asked = 0;
    for (int i = 0; i < MEMBER_COUNT; i++) {
        double centre, distance = box_distance(p->members[i].box, x, &centre);
        s->box_distance[i] = distance;
        if (distance < best || (distance == best && centre < best_centre))
            s->first = i, best = distance, best_centre = centre;
    }
}

static void take_answer(job *j, size_t point, int index, const fpt_foot_point *answer) {
    state *s = &j->states[point];
    if (s->asked == 0 || answer->distance < j->feet[point].distance) {
        j->feet[point] = *answer;
        j->member[point] = (unsigned char)index;
    }
    s->asked |= 1u << index;
    s->bound = fmin(s->bound, answer->lower_bound);
    if (answer->flags & FPT_FOOT_NOT_PROVEN) s->weak_bound = fmin(s->weak_bound, answer->lower_bound);
}

static void report_progress(void *user, size_t done, size_t total) {
    job *j = user;
    (void)total;
    if (j->watcher->progress && j->asks_first)
        j->watcher->progress(j->watcher->user, j->done_before + j->answered + done, j->total);
}

static int pass_on_stop(void *user) {
    job *j = user;
    return j->watcher->should_stop ? j->watcher->should_stop(j->watcher->user) : 0;
}

/* One batch: the chosen points of the chunk against one member, on all cores. */
static fpt_status ask_member(job *j, int index, size_t count) {
    fpt_query_options options;
    fpt_query_options_init(&options, sizeof options);
    options.threads = 0;
    options.progress = report_progress;
    options.should_stop = pass_on_stop;
    options.user = j;
    fpt_status status =
        fpt_surface_closest(j->part->members[index].surface, j->asked_points, count, &options, j->answers);
    if (status != FPT_OK) return status;
    for (size_t k = 0; k < count; k++) take_answer(j, j->asked_index[k], index, &j->answers[k]);
    j->queries += count;
    return FPT_OK;
}

/* Should this point ask this member, in the first round or in the second? */
static int is_wanted(const job *j, size_t point, int index) {
    const state *s = &j->states[point];
    if (j->asks_first) return s->first == index;
    return !(s->asked >> index & 1u) && s->box_distance[index] < j->feet[point].distance;
}

static fpt_status ask_round(job *j, int asks_first) {
    j->asks_first = asks_first;
    j->answered = 0;
    for (int index = 0; index < MEMBER_COUNT; index++) {
        size_t count = 0;
        for (size_t i = 0; i < j->count; i++) {
            if (!is_wanted(j, i, index)) continue;
            memcpy(&j->asked_points[3 * count], &j->points[3 * i], 3 * sizeof(double));
            j->asked_index[count++] = i;
        }
        fpt_status status = count > 0 ? ask_member(j, index, count) : FPT_OK;
        if (status != FPT_OK) return status;
        j->answered += count;
    }
    return FPT_OK;
}

/* Makes the certificate of each foot point speak of the whole part. */
static void conclude(job *j) {
    for (size_t i = 0; i < j->count; i++) {
        const state *s = &j->states[i];
        fpt_foot_point *foot = &j->feet[i];
        foot->lower_bound = fmin(s->bound, foot->distance);
        foot->flags &= ~(uint32_t)FPT_FOOT_NOT_PROVEN;
        if (s->weak_bound < foot->distance) foot->flags |= FPT_FOOT_NOT_PROVEN;
    }
}

static fpt_status measure_chunk(job *j) {
    for (size_t i = 0; i < j->count; i++) look_at_boxes(j->part, &j->points[3 * i], &j->states[i]);
    fpt_status status = ask_round(j, 1);
    if (status == FPT_OK) status = ask_round(j, 0);
    if (status == FPT_OK) conclude(j);
    return status;
}

/* Distance with the sign of the side, from S, Su, Sv at the foot. */
static fpt_status signed_distance(const job *j, size_t point, const double d[9], double *out) {
    const fpt_foot_point *foot = &j->feet[point];
    const uint32_t special = FPT_FOOT_EDGE | FPT_FOOT_CREASE | FPT_FOOT_COLLAPSED | FPT_FOOT_SEAM;
    int index = j->member[point];
    vec3 normal = vec3_scale(j->part->members[index].outward, vec3_cross(vec3_of(d + 3), vec3_of(d + 6)));
    if (foot->flags & special) { /* no single normal here, or none at all */
        site at = {index, foot->u, foot->v};
        fpt_status status = part_normal(j->part, at, &normal);
        if (status != FPT_OK) return status;
    }
    vec3 off = vec3_sub(vec3_of(&j->points[3 * point]), vec3_of(foot->point));
    *out = vec3_dot(off, normal) < 0 ? -foot->distance : foot->distance;
    return FPT_OK;
}

static fpt_status sign_chunk(job *j, double *deviation) {
    for (int index = 0; index < MEMBER_COUNT; index++) {
        size_t count = 0;
        for (size_t i = 0; i < j->count; i++) {
            if (j->member[i] != index) continue;
            j->parameters[2 * count] = j->feet[i].u, j->parameters[2 * count + 1] = j->feet[i].v;
            j->asked_index[count++] = i;
        }
        if (count == 0) continue;
        fpt_status status = fpt_surface_evaluate_many(j->part->members[index].surface, j->parameters, count, 1,
                                                      j->derivatives);
        for (size_t k = 0; k < count && status == FPT_OK; k++)
            status = signed_distance(j, j->asked_index[k], &j->derivatives[9 * k], &deviation[j->asked_index[k]]);
        if (status != FPT_OK) return status;
    }
    return FPT_OK;
}

static fpt_status measure_all(job *j, const double *points, measurement *out) {
    fpt_status status = FPT_OK;
    for (size_t first = 0; first < out->count && status == FPT_OK; first += CHUNK) {
        double start = clock_seconds();
        j->points = points + 3 * first;
        j->feet = out->feet + first;
        j->member = out->member + first;
        j->count = out->count - first < CHUNK ? out->count - first : CHUNK;
        j->done_before = first;
        status = measure_chunk(j);
        out->seconds += clock_seconds() - start;
        if (status == FPT_OK) status = sign_chunk(j, out->deviation + first);
    }
    out->queries = j->queries;
    return status;
}

fpt_status measurement_new(const part *p, const double *points, size_t count, const watcher *w, measurement *out) {
    static const watcher nobody = {NULL, NULL, NULL};
    memset(out, 0, sizeof *out);
    out->count = count;
    out->feet = malloc(count * sizeof *out->feet);
    out->member = malloc(count * sizeof *out->member);
    out->deviation = malloc(count * sizeof *out->deviation);
    job *j = calloc(1, sizeof *j);
    fpt_status status = FPT_OUT_OF_MEMORY;
    if (out->feet && out->member && out->deviation && j) {
        j->part = p;
        j->watcher = w ? w : &nobody;
        j->total = count;
        status = measure_all(j, points, out);
    }
    free(j);
    return status;
}

void measurement_free(measurement *m) {
    free(m->feet);
    free(m->member);
    free(m->deviation);
}
