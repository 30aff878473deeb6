/* Memory that cannot be had is a status. The address space is limited so that copies of large inputs do not fit. */
#define _POSIX_C_SOURCE 200809L
#include "samples.h"

#include <sys/resource.h>
#include <unistd.h>

enum { POLES = 4000000 };

static double *poles, *knots;

/* The size of this process in bytes, from the first number of /proc/self/statm; 0 where there is none. */
static size_t process_size(void) {
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file) return 0;
    if (fscanf(file, "%lu", &pages) != 1) pages = 0;
    fclose(file);
    return (size_t)pages * (size_t)sysconf(_SC_PAGESIZE);
}

/* Leaves `room` bytes more than the process has now; SIZE_MAX takes the limit away. */
static void leave_room(size_t room) {
    struct rlimit limit;
    CHECK(getrlimit(RLIMIT_AS, &limit) == 0);
    limit.rlim_cur = room == SIZE_MAX ? limit.rlim_max : (rlim_t)(process_size() + room);
    CHECK(setrlimit(RLIMIT_AS, &limit) == 0);
}

/* Wherever memory runs out, the call says so, creates nothing, and the library works afterwards. */
static void a_shape_that_does_not_fit_is_refused(void) {
    const double point[3] = {0.5, 0.25, 0};
    fpt_curve_data data = curve_data(1, POLES, knots, poles, NULL);
    fpt_foot_point foot;
    for (size_t room = (size_t)1 << 20; room <= (size_t)1 << 27; room *= 2) {
        fpt_curve *large = NULL, *small;
        leave_room(room);
        fpt_status status = fpt_curve_new(&data, &large);
        CHECK(status == FPT_OUT_OF_MEMORY || status == FPT_OK);
        CHECK((large != NULL) == (status == FPT_OK));
        if (room <= (size_t)1 << 25) CHECK_STATUS(status, FPT_OUT_OF_MEMORY);
        small = make_curve(cubic_curve());
        CHECK_OK(fpt_curve_closest(small, point, 1, NULL, &foot));
        leave_room(SIZE_MAX);
        fpt_curve_free(small);
        fpt_curve_free(large);
    }
}

/* The index is larger than the shape; without room for it the shape stays good, and answers when there is room. */
static void an_index_that_does_not_fit_can_be_built_later(void) {
    enum { FEW = 200000 };
    const double point[3] = {10.5, 0.25, 0};
    fpt_curve *curve = make_curve(curve_data(1, FEW, knots, poles, NULL));
    fpt_foot_point foot;
    leave_room((size_t)1 << 22);
    CHECK_STATUS(fpt_curve_prepare(curve), FPT_OUT_OF_MEMORY);
    CHECK_STATUS(fpt_curve_closest(curve, point, 1, NULL, &foot), FPT_OUT_OF_MEMORY);
    leave_room(SIZE_MAX);
    CHECK_OK(fpt_curve_prepare(curve));
    CHECK_OK(fpt_curve_closest(curve, point, 1, NULL, &foot));
    CHECK_NEAR(foot.distance, 0.25, 1e-12);
    fpt_curve_free(curve);
}

int main(void) {
    poles = (double *)calloc(3 * POLES, sizeof *poles);
    knots = (double *)calloc(POLES + 2, sizeof *knots);
    if (!poles || !knots || process_size() == 0) {
        printf("memory: this machine cannot be asked\n");
        return 1;
    }
    for (size_t i = 0; i < POLES; i++) poles[3 * i] = (double)i;
    for (size_t i = 0; i < POLES + 2; i++) knots[i] = i == 0 ? 0 : i > POLES ? POLES - 1 : (double)(i - 1);
    RUN(a_shape_that_does_not_fit_is_refused);
    RUN(an_index_that_does_not_fit_can_be_built_later);
    free(poles);
    free(knots);
    return check_report("memory");
}
