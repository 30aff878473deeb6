/* A test harness in one header. A program is a list of RUN(function) between two lines:
 *     int main(void) { RUN(first_law); RUN(second_law); return check_report("name"); }
 * A failed CHECK prints its place and what it saw; the test goes on and the program ends with 1. */
#ifndef CHECK_H
#define CHECK_H

#include <stdint.h>
#include <stdio.h>
#include <string.h>

static long check_count, check_failed, check_tests, check_tests_failed;

/* Counts one check; after 20 failures the rest is only counted. */
#define CHECK_MESSAGE(condition, ...)                                                              \
    do {                                                                                           \
        check_count++;                                                                             \
        if (!(condition) && ++check_failed <= 20) {                                                \
            fprintf(stderr, "%s:%d: ", __FILE__, __LINE__);                                        \
            fprintf(stderr, __VA_ARGS__);                                                          \
            fputc('\n', stderr);                                                                   \
        }                                                                                          \
    } while (0)

#define CHECK(condition) CHECK_MESSAGE(condition, "failed: %s", #condition)

/* |found - expected| <= limit; a NaN fails. */
#define CHECK_NEAR(found, expected, limit)                                                         \
    do {                                                                                           \
        double near_a = (found), near_b = (expected), near_d = near_a - near_b;                    \
        CHECK_MESSAGE(near_d <= (limit) && -near_d <= (limit), "%s = %.17g, expected %.17g",       \
                      #found, near_a, near_b);                                                     \
    } while (0)

#define CHECK_SAME_BITS(a, b, bytes)                                                               \
    CHECK_MESSAGE(memcmp((a), (b), (bytes)) == 0, "%s and %s differ", #a, #b)

/* A status, with the library's own text when it is not the expected one. */
#define CHECK_STATUS(call, expected)                                                               \
    do {                                                                                           \
        fpt_status status_found = (call);                                                          \
        CHECK_MESSAGE(status_found == (expected), "%s gave %s, expected %s; last error: %s",       \
                      #call, fpt_status_name(status_found), #expected, fpt_last_error());          \
    } while (0)

#define CHECK_OK(call) CHECK_STATUS(call, FPT_OK)

/* A refusal whose text contains the given words. */
#define CHECK_ERROR(call, expected, words)                                                         \
    do {                                                                                           \
        CHECK_STATUS(call, expected);                                                              \
        CHECK_MESSAGE(strstr(fpt_last_error(), (words)) != NULL, "%s: the text is \"%s\", not \"%s\"", \
                      #call, fpt_last_error(), (words));                                           \
    } while (0)

#define RUN(test)                                                                                  \
    do {                                                                                           \
        long before = check_failed;                                                                \
        test();                                                                                    \
        check_tests++;                                                                             \
        if (check_failed != before) {                                                              \
            check_tests_failed++;                                                                  \
            printf("FAILED %s\n", #test);                                                          \
        }                                                                                          \
    } while (0)

/* The closing line; the program's exit status. */
static inline int check_report(const char *name) {
    printf("%s: %ld tests, %ld checks, %ld tests failed, %ld checks failed\n", name, check_tests,
           check_count, check_tests_failed, check_failed);
    return check_failed != 0;
}

#endif
