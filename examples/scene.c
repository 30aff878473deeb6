/* A scene: one shape placed three times, searched together; each answer names its member.
 *
 *   cc -std=c99 -O2 scene.c -o scene -lfootpoint -lm
 */
#include <footpoint.h>
#include <stdio.h>

int main(void) {
    /* A square of 30 mm with a hill in its middle: lying, standing on its edge, and 50 mm aside. */
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
    const double standing[12] = {0, 0, 1, -20,   0, 1, 0, 0,   -1, 0, 0, 30};
    const double aside[12] = {1, 0, 0, 50,   0, 1, 0, 0,   0, 0, 1, 0};
    const float points[3 * 3] = {12, 17, 9,   -15, 10, 20,   70, 5, -3};

    fpt_surface *hill = NULL;
    fpt_scene *scene = NULL;
    fpt_foot_point feet[3];
    uint32_t members[3];
    fpt_status status = fpt_surface_new(&data, &hill);
    if (status == FPT_OK) {
        const fpt_scene_member all[3] = {
            {.struct_size = sizeof all[0], .surface = hill},
            {.struct_size = sizeof all[0], .surface = hill, .placement = standing},
            {.struct_size = sizeof all[0], .surface = hill, .placement = aside},
        };
        const fpt_scene_data parts = {.struct_size = sizeof parts, .member_count = 3, .members = all};
        status = fpt_scene_new(&parts, &scene);
    }
    fpt_surface_free(hill); /* The scene keeps the shape. */
    if (status == FPT_OK) status = fpt_scene_closest_f32(scene, points, 3, NULL, NULL, feet, members);
    if (status == FPT_OK) {
        for (int i = 0; i < 3; i++) {
            printf("member %u at (%.6f, %.6f): %.6f mm, nothing nearer than %.6f mm\n", (unsigned)members[i], feet[i].u,
                   feet[i].v, feet[i].distance, feet[i].lower_bound);
        }
    } else {
        fprintf(stderr, "%s: %s\n", fpt_status_name(status), fpt_last_error());
    }
    fpt_scene_free(scene);
    return status == FPT_OK ? 0 : 1;
}
