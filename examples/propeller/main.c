/* The measuring job of a user, start to end: a propeller with its nominal surfaces, a million scan points with noise
 * and defects, every point projected with proof, a table, a histogram and a picture.
 *
 *   cc -std=c99 -O2 propeller/[a-z]*.c -o propeller_demo -lfootpoint -lm
 *   ./propeller_demo demo-out [points]
 *
 * Reading order: part.h, blade.c, hub.c (making surfaces), measure.c (projecting), and the rest as you like. Ctrl-C
 * stops the projection cleanly. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

#include "clock.h"
#include "histogram.h"
#include "measure.h"
#include "picture.h"
#include "report.h"
#include "scan.h"

static volatile sig_atomic_t interrupted = 0;

static void interrupt(int signal_number) {
    (void)signal_number;
    interrupted = 1;
}

static int should_stop(void *user) {
    (void)user;
    return interrupted;
}

typedef struct progress_bar {
    double start;
    int shown; /* last percentage drawn */
} progress_bar;

static void draw_bar(void *user, size_t done, size_t total) {
    enum { LENGTH = 40 };
    progress_bar *bar = user;
    char cells[LENGTH + 1], rate[32];
    int percent = (int)(100.0 * (double)done / (double)total);
    if (percent <= bar->shown) return;
    bar->shown = percent;
    for (int i = 0; i < LENGTH; i++) cells[i] = 100 * (i + 1) <= percent * LENGTH ? '#' : '.';
    cells[LENGTH] = 0;
    fprintf(stderr, "\r  projecting  [%s] %3d %%  %s points/s  ", cells, percent,
            report_count((size_t)((double)done / (clock_seconds() - bar->start)), rate));
    if (done == total) fputc('\n', stderr);
}

/* Says which file was written, or was not; returns 0 or -1. */
static int tell(int result, const char *path) {
    if (result == 0) printf("  %s\n", path);
    else fprintf(stderr, "  cannot write %s\n", path);
    return result;
}

/* Sets *good when both files were written. */
static fpt_status write_pictures(const part *p, const scan *s, const measurement *m, const report *r,
                                 const char *directory, int *good) {
    char path[1024];
    image picture;
    fpt_status status = picture_new(p, s, m, r, &picture);
    if (status != FPT_OK) return status;
    putchar('\n');
    snprintf(path, sizeof path, "%s/deviation_map.png", directory);
    int map = tell(image_write_png(&picture, path), path);
    image_free(&picture);
    snprintf(path, sizeof path, "%s/deviation_histogram.svg", directory);
    int histogram = tell(histogram_write(r, path), path);
    *good = map == 0 && histogram == 0;
    return FPT_OK;
}

/* Sets *good when the result is what the planted defects ask for and the files were written. */
static fpt_status run(const char *directory, size_t count, part *p, scan *s, measurement *m, int *good) {
    progress_bar bar = {0, -1};
    watcher w = {draw_bar, should_stop, &bar};
    report r;
    fpt_status status = part_new(p);
    if (status == FPT_OK) status = scan_new(p, count, s);
    bar.start = clock_seconds();
    if (status == FPT_OK) status = measurement_new(p, s->points, s->count, &w, m);
    if (status != FPT_OK) return status;
    if (report_new(s, m, &r) != 0) return FPT_OUT_OF_MEMORY;
    report_print(&r, p, s, m);
    status = write_pictures(p, s, m, &r, directory, good);
    int as_planted = report_is_as_planted(&r, s);
    printf("\n  %s\n", as_planted ? "Every planted defect was found." : "NOT as planted: look at the table.");
    *good = *good && as_planted;
    return status;
}

int main(int argc, char **argv) {
    size_t count = argc > 2 ? (size_t)strtoul(argv[2], NULL, 10) : 1000000;
    if (argc < 2 || count < 1000) {
        fprintf(stderr, "usage: %s DIRECTORY [POINTS, at least 1000]\n", argv[0]);
        return 2;
    }
    part p = {0};
    scan s = {0};
    measurement m = {0};
    int good = 0;
    double start = clock_seconds();
    signal(SIGINT, interrupt);
    fpt_status status = run(argv[1], count, &p, &s, &m, &good);
    if (status != FPT_OK) fprintf(stderr, "\n%s: %s\n", fpt_status_name(status), fpt_last_error());
    else printf("  %.1f s in all.\n", clock_seconds() - start);
    measurement_free(&m);
    scan_free(&s);
    part_free(&p);
    return status == FPT_OK && good ? 0 : 1;
}
