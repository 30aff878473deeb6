/* A program of somebody else, in C99: the nearest point of a parabola (degree 2), known in closed form.
 * SPDX-License-Identifier: MIT OR Apache-2.0 */
#include <footpoint.h>

#include <math.h>
#include <stdio.h>

int main(void) {
    const double knots[6] = {0, 0, 0, 1, 1, 1};
    const double poles[9] = {-1, 1, 0, 0, -1, 0, 1, 1, 0};
    const double point[3] = {0, -2, 0};
    const fpt_curve_data data = {.struct_size = sizeof data, .degree = 2, .pole_count = 3, .knots = knots, .poles = poles};
    fpt_curve *curve = NULL;
    fpt_foot_point foot;
    fpt_status status;

    if (fpt_version() != FPT_VERSION || fpt_abi_version() != FPT_ABI_VERSION) {
        fprintf(stderr, "header and library differ\n");
        return 1;
    }
    status = fpt_curve_new(&data, &curve);
    if (status == FPT_OK) status = fpt_curve_closest(curve, point, 1, NULL, &foot);
    fpt_curve_free(curve);
    if (status != FPT_OK) {
        fprintf(stderr, "%s: %s\n", fpt_status_name(status), fpt_last_error());
        return 1;
    }
    /* The parabola is y = x^2 with x = 2u - 1: its nearest point to (0, -2) is the vertex. */
    if (fabs(foot.u - 0.5) > 1e-12 || fabs(foot.distance - 2.0) > 1e-14 || (foot.flags & FPT_FOOT_NOT_PROVEN)) {
        fprintf(stderr, "u %.17g, distance %.17g, flags %u\n", foot.u, foot.distance, (unsigned)foot.flags);
        return 1;
    }
    return 0;
}
