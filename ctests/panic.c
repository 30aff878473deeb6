/* A panic inside the library, provoked through a function that no shipped library has, ends at the fence. */
#include "samples.h"

fpt_status fpt_panic_test(uint32_t threads);

static void a_panic_becomes_a_status(void) {
    static const uint32_t threads[] = {1, 2, 8, 0};
    const double points[] = {300, 250, 100, 0, 0, 0};
    fpt_surface *surface = make_surface(paper_surface(1)), *unprepared = make_surface(paper_surface(1));
    fpt_foot_point before[2], after[2];
    CHECK_OK(fpt_surface_closest(surface, points, 2, NULL, before));
    for (size_t i = 0; i < COUNT_OF(threads); i++) {
        CHECK_ERROR(fpt_panic_test(threads[i]), FPT_INTERNAL, "internal error");
        CHECK_OK(fpt_surface_closest(surface, points, 2, NULL, after));
        CHECK_SAME_BITS(before, after, sizeof before);
    }
    CHECK_OK(fpt_surface_closest(unprepared, points, 2, NULL, after));
    CHECK_SAME_BITS(before, after, sizeof before);
    fpt_surface_free(surface);
    fpt_surface_free(unprepared);
}

int main(void) {
    RUN(a_panic_becomes_a_status);
    return check_report("panic");
}
