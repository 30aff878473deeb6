/* Runs case folders through the library and holds the answers against the proven distances in them.
 *     cases FOLDER...
 * A folder with geometry.txt is a case; in any other folder, each folder inside is tried. A folder that does
 * not exist is reported and passed over; no case at all is a failure.
 * geometry.txt: "curve DEGREE POLES RATIONAL DIMENSION" or "surface DEGREE_U DEGREE_V POLES_U POLES_V RATIONAL",
 * the knots, then x y z w of each pole. queries.csv: x,y,z,class,u,v,distance under a line of headings.
 * Not proven may be 1 % of a case and 0.1 % of a class, and nothing among on, near, edge and far. */
#define _POSIX_C_SOURCE 200809L
#include "samples.h"

#include <dirent.h>
#include <sys/stat.h>

enum { CLASSES_MAX = 32, NAME_MAX_LENGTH = 32 };

struct row {
    double point[3], u, v, distance;
    char class_name[NAME_MAX_LENGTH];
};

struct shape {
    int is_surface, is_rational;
    size_t degree_u, degree_v, pole_count_u, pole_count_v;
    double *knots_u, *knots_v, *poles, *weights;
    double diagonal, largest;
    fpt_curve *curve;
    fpt_surface *surface;
};

struct tally {
    char name[NAME_MAX_LENGTH];
    long queries, wrong, unsound, not_proven;
};

static struct tally classes[CLASSES_MAX];
static size_t class_count;
static long case_count;

static struct tally *class_of(const char *name) {
    for (size_t i = 0; i < class_count; i++) {
        if (strcmp(classes[i].name, name) == 0) return &classes[i];
    }
    if (class_count == CLASSES_MAX) return &classes[CLASSES_MAX - 1];
    snprintf(classes[class_count].name, NAME_MAX_LENGTH, "%s", name);
    return &classes[class_count++];
}

static double *read_numbers(FILE *file, size_t count) {
    double *numbers = (double *)malloc((count + 1) * sizeof *numbers);
    for (size_t i = 0; numbers && i < count; i++) {
        if (fscanf(file, "%lf", &numbers[i]) != 1) {
            free(numbers);
            return NULL;
        }
    }
    return numbers;
}

/* Reads poles as rows x y z w and measures their box. */
static int read_poles(FILE *file, struct shape *shape, size_t count) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double *rows = read_numbers(file, 4 * count);
    if (!rows) return 0;
    shape->poles = (double *)malloc(3 * count * sizeof(double));
    shape->weights = (double *)malloc(count * sizeof(double));
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < 3; k++) {
            double x = rows[4 * i + k];
            shape->poles[3 * i + k] = x;
            low[k] = fmin(low[k], x);
            high[k] = fmax(high[k], x);
            shape->largest = fmax(shape->largest, fabs(x));
        }
        shape->weights[i] = rows[4 * i + 3];
    }
    shape->diagonal = distance_between(low, high);
    free(rows);
    return 1;
}

static int read_shape(const char *path, struct shape *shape) {
    char kind[16];
    int dimension, ok;
    FILE *file = fopen(path, "r");
    if (!file) return 0;
    ok = fscanf(file, "%15s", kind) == 1;
    shape->is_surface = ok && strcmp(kind, "surface") == 0;
    shape->pole_count_v = 1;
    if (shape->is_surface) {
        ok = fscanf(file, "%zu %zu %zu %zu %d", &shape->degree_u, &shape->degree_v, &shape->pole_count_u,
                    &shape->pole_count_v, &shape->is_rational) == 5;
    } else {
        ok = ok && fscanf(file, "%zu %zu %d %d", &shape->degree_u, &shape->pole_count_u, &shape->is_rational,
                          &dimension) == 4;
    }
    if (ok) shape->knots_u = read_numbers(file, shape->pole_count_u + shape->degree_u + 1);
    if (ok && shape->is_surface) shape->knots_v = read_numbers(file, shape->pole_count_v + shape->degree_v + 1);
    ok = ok && shape->knots_u && (shape->knots_v || !shape->is_surface) &&
         read_poles(file, shape, shape->pole_count_u * shape->pole_count_v);
    fclose(file);
    return ok;
}

static fpt_status create(struct shape *shape, double domain[4]) {
    const double *weights = shape->is_rational ? shape->weights : NULL;
    fpt_status status;
    if (shape->is_surface) {
        fpt_surface_data data = surface_data(shape->degree_u, shape->degree_v, shape->pole_count_u, shape->pole_count_v,
                                             shape->knots_u, shape->knots_v, shape->poles, weights);
        status = fpt_surface_new(&data, &shape->surface);
        return status ? status : fpt_surface_domain(shape->surface, domain);
    }
    fpt_curve_data data = curve_data(shape->degree_u, shape->pole_count_u, shape->knots_u, shape->poles, weights);
    status = fpt_curve_new(&data, &shape->curve);
    return status ? status : fpt_curve_domain(shape->curve, domain);
}

static void release(struct shape *shape) {
    fpt_curve_free(shape->curve);
    fpt_surface_free(shape->surface);
    free(shape->knots_u);
    free(shape->knots_v);
    free(shape->poles);
    free(shape->weights);
}

/* Splits "x,y,z,class,u,v,distance"; an empty field is NaN. */
static int parse_row(char *line, struct row *row) {
    double *numbers[7] = {&row->point[0], &row->point[1], &row->point[2], NULL, &row->u, &row->v, &row->distance};
    for (int field = 0; field < 7; field++) {
        char *end = line + strcspn(line, ",\r\n");
        int last = *end != ',';
        *end = '\0';
        if (numbers[field]) {
            *numbers[field] = *line ? strtod(line, NULL) : NAN;
        } else {
            snprintf(row->class_name, NAME_MAX_LENGTH, "%.31s", line);
        }
        if (last) return field == 6;
        line = end + 1;
    }
    return 1;
}

static struct row *read_rows(const char *path, size_t *count) {
    char line[1024];
    size_t room = 0;
    struct row *rows = NULL;
    FILE *file = fopen(path, "r");
    *count = 0;
    if (!file) return NULL;
    for (int first = 1; fgets(line, sizeof line, file); first = 0) {
        if (first) continue;
        if (*count == room) {
            room = room ? 2 * room : 1024;
            rows = (struct row *)realloc(rows, room * sizeof *rows);
        }
        if (parse_row(line, &rows[*count])) ++*count;
    }
    fclose(file);
    return rows;
}

static fpt_status ask(const struct shape *shape, const double *points, size_t count, const fpt_query_options *options,
                      fpt_foot_point *out) {
    return shape->is_surface ? fpt_surface_closest(shape->surface, points, count, options, out)
                             : fpt_curve_closest(shape->curve, points, count, options, out);
}

/* The rounding of the stored distance and of the query point itself. */
static double rounding_of(const struct shape *shape, const struct row *row) {
    double largest = shape->largest;
    for (size_t k = 0; k < 3; k++) largest = fmax(largest, fabs(row->point[k]));
    return 4e-15 * (largest + row->distance);
}

/* One answer against its row; what is wrong with it, or NULL. */
static const char *fault_of(const struct shape *shape, const double domain[4], const struct row *row,
                            const fpt_foot_point *foot) {
    double rounding = rounding_of(shape, row), limit = 1e-9 * shape->diagonal + rounding, at[3];
    fpt_status status = shape->is_surface ? fpt_surface_evaluate(shape->surface, foot->u, foot->v, 0, at)
                                          : fpt_curve_evaluate(shape->curve, foot->u, 0, at);
    if (status != FPT_OK) return "parameters outside the domain";
    if (foot->u < domain[0] || foot->u > domain[1]) return "u outside the domain";
    if (shape->is_surface ? foot->v < domain[2] || foot->v > domain[3] : foot->v != 0) return "v outside the domain";
    if (memcmp(at, foot->point, sizeof at) != 0) return "point is not the shape at (u,v)";
    if (!(fabs(foot->distance - distance_between(row->point, at)) <= rounding)) return "distance is not |query - point|";
    if (!(foot->distance <= row->distance + limit)) return "farther than the truth";
    if (!(foot->lower_bound >= 0 && foot->lower_bound <= foot->distance)) return "lower bound out of order";
    if (!(foot->lower_bound <= row->distance + 1e-12 * shape->diagonal + rounding)) return "lower bound above the truth";
    if (!(foot->flags & FPT_FOOT_NOT_PROVEN) && !(foot->distance - foot->lower_bound <= 1e-9 * shape->diagonal + limit)) {
        return "gap without its flag";
    }
    return NULL;
}

/* The same queries with the stored parameters as hints: the same distances, as well proven. */
static void check_hinted(const char *name, const struct shape *shape, const struct row *rows, const double *points,
                         size_t count, const fpt_query_options *plain, const fpt_foot_point *expected) {
    size_t width = shape->is_surface ? 2 : 1;
    double *hints = (double *)malloc(width * count * sizeof *hints);
    fpt_foot_point *out = (fpt_foot_point *)malloc(count * sizeof *out);
    fpt_query_options options = *plain;
    options.hints = hints;
    for (size_t i = 0; i < count; i++) {
        hints[width * i] = rows[i].u;
        if (width == 2) hints[2 * i + 1] = rows[i].v;
    }
    CHECK_OK(ask(shape, points, count, &options, out));
    for (size_t i = 0; i < count; i++) {
        double limit = plain->accuracy + rounding_of(shape, &rows[i]);
        CHECK_MESSAGE(fabs(out[i].distance - expected[i].distance) <= limit, "%s row %zu: a hint changed %.17g to %.17g",
                      name, i, expected[i].distance, out[i].distance);
        CHECK_MESSAGE(((out[i].flags ^ expected[i].flags) & FPT_FOOT_NOT_PROVEN) == 0,
                      "%s row %zu: a hint changed %s to %s", name, i,
                      expected[i].flags & FPT_FOOT_NOT_PROVEN ? "not proven" : "proven",
                      out[i].flags & FPT_FOOT_NOT_PROVEN ? "not proven" : "proven");
    }
    free(out);
    free(hints);
}

static void check_answers(const char *name, const struct shape *shape, const double domain[4], const struct row *rows,
                          size_t count, const fpt_foot_point *out) {
    long not_proven = 0;
    for (size_t i = 0; i < count; i++) {
        struct tally *tally = class_of(rows[i].class_name);
        const char *fault = fault_of(shape, domain, &rows[i], &out[i]);
        int unproven = (out[i].flags & FPT_FOOT_NOT_PROVEN) != 0;
        tally->queries++;
        tally->not_proven += unproven;
        not_proven += unproven;
        if (fault) strncmp(fault, "lower", 5) == 0 ? tally->unsound++ : tally->wrong++;
        CHECK_MESSAGE(fault == NULL, "%s row %zu (%s): %s: truth %.12g found %.12g bound %.12g", name, i,
                      rows[i].class_name, fault, rows[i].distance, out[i].distance, out[i].lower_bound);
    }
    CHECK_MESSAGE(100 * not_proven <= (long)count, "%s: %ld of %zu not proven", name, not_proven, count);
}

static void run_rows(const char *name, const struct shape *shape, const double domain[4], const struct row *rows,
                     size_t count) {
    double *points = (double *)malloc(3 * count * sizeof *points);
    fpt_foot_point *out = (fpt_foot_point *)malloc(count * sizeof *out);
    fpt_query_options options = default_options();
    options.accuracy = 1e-9 * shape->diagonal;
    for (size_t i = 0; i < count; i++) memcpy(points + 3 * i, rows[i].point, sizeof rows[i].point);
    CHECK_OK(ask(shape, points, count, &options, out));
    check_answers(name, shape, domain, rows, count, out);
    check_hinted(name, shape, rows, points, count, &options, out);
    free(out);
    free(points);
}

static void run_case(const char *folder) {
    char path[4096];
    struct shape shape;
    double domain[4] = {0, 0, 0, 0};
    size_t count = 0;
    struct row *rows;
    memset(&shape, 0, sizeof shape);
    snprintf(path, sizeof path, "%s/geometry.txt", folder);
    CHECK_MESSAGE(read_shape(path, &shape), "%s cannot be read", path);
    snprintf(path, sizeof path, "%s/queries.csv", folder);
    rows = read_rows(path, &count);
    CHECK_MESSAGE(count > 0, "%s has no queries", path);
    if (shape.poles && count > 0) {
        fpt_status status = create(&shape, domain);
        CHECK_MESSAGE(status == FPT_OK, "%s was refused: %s", folder, fpt_last_error());
        if (status == FPT_OK) run_rows(folder, &shape, domain, rows, count);
    }
    case_count++;
    free(rows);
    release(&shape);
}

static int exists(const char *path) {
    struct stat info;
    return stat(path, &info) == 0;
}

static void run_folder(const char *folder) {
    char path[4096];
    struct dirent *entry;
    DIR *directory;
    snprintf(path, sizeof path, "%s/geometry.txt", folder);
    if (exists(path)) {
        run_case(folder);
        return;
    }
    directory = opendir(folder);
    if (!directory) {
        printf("not here: %s\n", folder);
        return;
    }
    while ((entry = readdir(directory)) != NULL) {
        snprintf(path, sizeof path, "%s/%s/geometry.txt", folder, entry->d_name);
        if (entry->d_name[0] == '.' || !exists(path)) continue;
        path[strlen(path) - strlen("/geometry.txt")] = '\0';
        run_case(path);
    }
    closedir(directory);
}

static void classes_are_proven(void) {
    static const char *const always[] = {"on", "near", "edge", "far"};
    printf("%-8s %8s %6s %8s %10s\n", "class", "queries", "wrong", "unsound", "not proven");
    for (size_t i = 0; i < class_count; i++) {
        const struct tally *t = &classes[i];
        printf("%-8s %8ld %6ld %8ld %10ld\n", t->name, t->queries, t->wrong, t->unsound, t->not_proven);
        CHECK_MESSAGE(1000 * t->not_proven <= t->queries, "class %s: %ld not proven", t->name, t->not_proven);
        for (size_t k = 0; k < COUNT_OF(always); k++) {
            CHECK_MESSAGE(strcmp(t->name, always[k]) != 0 || t->not_proven == 0, "class %s: %ld not proven", t->name,
                          t->not_proven);
        }
    }
}

int main(int argc, char **argv) {
    for (int i = 1; i < argc; i++) run_folder(argv[i]);
    CHECK_MESSAGE(case_count > 0, "no case was found");
    RUN(classes_are_proven);
    printf("%ld cases\n", case_count);
    return check_report("cases");
}
