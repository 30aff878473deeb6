/* The first query: which parameters does this point of a surface have, and is that certain?
 *
 *   cc -std=c99 -O2 first_query.c -o first_query -lfootpoint -lm
 */
#include <footpoint.h>
#include <stdio.h>

int main(void) {
    /* A bicubic Bezier patch: a square of 30 mm with a hill in its middle. */
    const double knots[8] = {0, 0, 0, 0, 1, 1, 1, 1};
    const double poles[16 * 3] = {
        0,  0, 0,   0,  10, 0,    0,  20, 0,    0,  30, 0,
        10, 0, 0,   10, 10, 12,   10, 20, 12,   10, 30, 0,
        20, 0, 0,   20, 10, 12,   20, 20, 12,   20, 30, 0,
        30, 0, 0,   30, 10, 0,    30, 20, 0,    30, 30, 0,
    };
    const fpt_surface_data data = {.struct_size = sizeof data,
                                   .degree_u = 3, .degree_v = 3, .pole_count_u = 4, .pole_count_v = 4,
                                   .knots_u = knots, .knots_v = knots, .poles = poles};
    const double point[3] = {12, 17, 9};

    fpt_surface *surface = NULL;
    fpt_foot_point foot;
    fpt_status status = fpt_surface_new(&data, &surface);
    if (status == FPT_OK) status = fpt_surface_closest(surface, point, 1, NULL, &foot);
    if (status == FPT_OK) {
        printf("nearest point   S(%.12f, %.12f) = (%.9f, %.9f, %.9f)\n", foot.u, foot.v, foot.point[0],
               foot.point[1], foot.point[2]);
        printf("distance        %.15f mm\n", foot.distance);
        printf("nothing nearer  %.15f mm %s\n", foot.lower_bound,
               foot.flags & FPT_FOOT_NOT_PROVEN ? "(not proven)" : "(proven)");
    } else {
        fprintf(stderr, "%s: %s\n", fpt_status_name(status), fpt_last_error());
    }
    fpt_surface_free(surface);
    return status == FPT_OK ? 0 : 1;
}
