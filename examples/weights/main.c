/* Weights from wished distances: the published methods beside the refined weights, drawn.
 *
 *   weights [directory]     writes weights_figure_2.svg (linear interpolation) and weights_figure_3.svg (network)
 *
 * One polygon of seven poles, degree 3. The published methods hit the wishes roughly, because a chord stands for the curve;
 * the refined weights hit them to the last digits, and the report proves it.
 */
#include "drawing.h"

#include <math.h>

enum { POLES = 7 };

static const double knots[POLES + 4] = {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4};
static const double poles[3 * POLES] = {0, 0.5, 0, 1, 4, 0, 3.5, 6, 0, 6, 2, 0, 8.5, 6, 0, 11.5, 4.5, 0, 12, 0.5, 0};

static int check(fpt_status status) {
    if (status == FPT_OK) return 1;
    fprintf(stderr, "%s: %s\n", fpt_status_name(status), fpt_last_error());
    return 0;
}

static void print_report(const char *name, const fpt_weights_report *report) {
    fpt_weights_summary summary;
    if (!check(fpt_weights_report_summary(report, &summary))) return;
    printf("%-22s %u wishes met, %u not met, %u impossible; largest miss ", name, (unsigned)summary.met,
           (unsigned)summary.not_met, (unsigned)summary.impossible);
    double worst = 0;
    for (size_t i = 0; i < POLES; i++) {
        fpt_weights_pole pole;
        if (check(fpt_weights_report_pole(report, i, &pole)) && !isnan(pole.wish)) {
            worst = fmax(worst, fabs(pole.distance - pole.wish));
        }
    }
    printf("%.2e\n", worst);
}

/* The wishes of a report again, for the refined weights. */
static size_t wishes_of(const fpt_weights_report *report, size_t *numbers, double *distances) {
    size_t count = 0;
    for (size_t i = 0; i < POLES; i++) {
        fpt_weights_pole pole;
        if (check(fpt_weights_report_pole(report, i, &pole)) && !isnan(pole.wish)) {
            numbers[count] = i;
            distances[count++] = pole.wish;
        }
    }
    return count;
}

/* Refines the wishes of a published method and draws both over the curve with weights 1. */
static int figure(const fpt_curve *curve, const char *path, const char *title, const char *name,
                  fpt_weights_report *published) {
    size_t numbers[POLES];
    double distances[POLES];
    const size_t count = wishes_of(published, numbers, distances);
    fpt_weights_report *refined = NULL;
    fpt_curve *by_formula = NULL, *by_distance = NULL;
    int good = check(fpt_weights_refine_curve(curve, numbers, distances, count, NULL, 0, NULL, &refined)) &&
               check(fpt_weights_report_curve(published, &by_formula)) &&
               check(fpt_weights_report_curve(refined, &by_distance));
    if (good) {
        const method methods[] = {{"weights 1", "#999", NULL, curve},
                                  {name, "#06c", published, by_formula},
                                  {"refined", "#c22", refined, by_distance}};
        print_report(name, published);
        print_report("  refined", refined);
        good = draw_figure(path, title, poles, POLES, methods, 3) == 0;
        if (!good) fprintf(stderr, "%s cannot be written\n", path);
    }
    fpt_curve_free(by_formula);
    fpt_curve_free(by_distance);
    fpt_weights_report_free(refined);
    fpt_weights_report_free(published);
    return good;
}

int main(int argc, char **argv) {
    static const size_t wished[] = {1, 3, 5};
    static const double distances[] = {0.9, 0.7, 0.6};
    const char *directory = argc > 1 ? argv[1] : ".";
    char path[2][1024];
    fpt_curve_data data = {.struct_size = sizeof data, .degree = 3, .pole_count = POLES, .knots = knots, .poles = poles};
    fpt_curve *curve = NULL;
    fpt_weights_report *run = NULL, *trained = NULL;
    snprintf(path[0], sizeof path[0], "%s/weights_figure_2.svg", directory);
    snprintf(path[1], sizeof path[1], "%s/weights_figure_3.svg", directory);
    int good = check(fpt_curve_new(&data, &curve)) && check(fpt_weights_interpolated(curve, 1.1, 0.6, NULL, &run)) &&
               figure(curve, path[0], "Distances that run evenly from 1.1 to 0.6", "linear interpolation", run) &&
               check(fpt_weights_network(curve, wished, distances, 3, 0.4, 2.0, NULL, &trained)) &&
               figure(curve, path[1], "Three wishes, the other distances between 0.4 and 2", "network", trained);
    fpt_curve_free(curve);
    return good ? 0 : 1;
}
