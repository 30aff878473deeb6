// SPDX-License-Identifier: MIT OR Apache-2.0
#include "reference.h"

#include "opencascade.h"

#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Standard_Failure.hxx>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

struct Head {
    int32_t index;
    int32_t count;
    double seconds;
};

double clock_of(clockid_t clock) {
    timespec t;
    clock_gettime(clock, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

void put(int out, const void *bytes, size_t count) {
    const char *from = static_cast<const char *>(bytes);
    while (count > 0) {
        const ssize_t n = write(out, from, count);
        if (n <= 0) {
            _exit(3);
        }
        from += n;
        count -= size_t(n);
    }
}

void answer(int out, int index, double seconds, bool done, const std::vector<Pair> &list) {
    const Head head = {index, done ? int32_t(list.size()) : -1, seconds};
    put(out, &head, sizeof head);
    if (done && !list.empty()) {
        put(out, list.data(), list.size() * sizeof(Pair));
    }
}

// One projection with a project object made once; `solve` fills the list.
template <class Solve>
void run(int out, const std::vector<Query> &queries, size_t first, Solve solve) {
    for (size_t i = first; i < queries.size(); i++) {
        std::vector<Pair> list;
        bool done = false;
        const double start = clock_of(CLOCK_PROCESS_CPUTIME_ID);
        try {
            const Vec &p = queries[i].point;
            solve(gp_Pnt(p[0], p[1], p[2]), list);
            done = true;
        } catch (const Standard_Failure &) {
        }
        answer(out, int(i), clock_of(CLOCK_PROCESS_CPUTIME_ID) - start, done, list);
    }
}

void child(int out, const Geometry &g, Algorithm algorithm, const std::vector<Query> &queries, size_t first) {
    if (g.is_curve) {
        const Handle(Geom_BSplineCurve) curve = curve_of(g);
        GeomAPI_ProjectPointOnCurve project;
        project.Init(curve, curve->FirstParameter(), curve->LastParameter());
        run(out, queries, first, [&](const gp_Pnt &p, std::vector<Pair> &list) {
            project.Perform(p);
            for (int k = 1; k <= project.NbPoints(); k++) {
                list.push_back({project.Parameter(k), 0.0});
            }
        });
        return;
    }
    const Handle(Geom_BSplineSurface) surface = surface_of(g);
    const Extrema_ExtAlgo how = algorithm == Algorithm::TREE ? Extrema_ExtAlgo_Tree : Extrema_ExtAlgo_Grad;
    Standard_Real u0, u1, v0, v1;
    surface->Bounds(u0, u1, v0, v1);
    GeomAPI_ProjectPointOnSurf project;
    project.Init(surface, u0, u1, v0, v1, how);
    run(out, queries, first, [&](const gp_Pnt &p, std::vector<Pair> &list) {
        project.Perform(p);
        if (!project.IsDone()) {
            throw Standard_Failure("not done");
        }
        for (int k = 1; k <= project.NbPoints(); k++) {
            Pair at;
            project.Parameters(k, at[0], at[1]);
            list.push_back(at);
        }
    });
}

// False at the end of the stream or when nothing came in time.
bool take(int in, void *bytes, size_t count, double deadline, bool &late) {
    char *to = static_cast<char *>(bytes);
    while (count > 0) {
        const double left = deadline - clock_of(CLOCK_MONOTONIC);
        pollfd wait = {in, POLLIN, 0};
        if (left <= 0 || poll(&wait, 1, int(1000 * left) + 1) <= 0) {
            late = true;
            return false;
        }
        const ssize_t n = read(in, to, count);
        if (n <= 0) {
            return false;
        }
        to += n;
        count -= size_t(n);
    }
    return true;
}

// Answers from `first` on until the process is through, stuck or dead; the index that comes next.
size_t round_of(const Geometry &g, Algorithm algorithm, const std::vector<Query> &queries, size_t first,
                double query_seconds, double case_end, std::vector<ReferenceAnswer> &answers) {
    int ends[2];
    if (pipe(ends) != 0) {
        return queries.size();
    }
    const pid_t process = fork();
    if (process == 0) {
        close(ends[0]);
        // Should this process be left alone, it ends by itself.
        alarm(unsigned(query_seconds + case_end - clock_of(CLOCK_MONOTONIC)) + 10);
        try {
            child(ends[1], g, algorithm, queries, first);
        } catch (const Standard_Failure &) {
            _exit(2);
        }
        _exit(0);
    }
    close(ends[1]);
    size_t next = first;
    bool late = false;
    while (next < queries.size() && clock_of(CLOCK_MONOTONIC) < case_end) {
        Head head;
        const double deadline = clock_of(CLOCK_MONOTONIC) + query_seconds;
        if (!take(ends[0], &head, sizeof head, deadline, late)) {
            answers[next].state = late ? ReferenceAnswer::HUNG : ReferenceAnswer::CRASHED;
            next++;
            break;
        }
        ReferenceAnswer &a = answers[size_t(head.index)];
        a.state = head.count < 0 ? ReferenceAnswer::FAILED : ReferenceAnswer::DONE;
        a.seconds = head.seconds;
        a.solutions.resize(size_t(std::max(head.count, 0)));
        if (!a.solutions.empty()) {
            take(ends[0], a.solutions.data(), a.solutions.size() * sizeof(Pair), deadline, late);
        }
        next = size_t(head.index) + 1;
    }
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
    close(ends[0]);
    return next;
}

} // namespace

std::vector<ReferenceAnswer> reference_answers(const Geometry &geometry, Algorithm algorithm,
                                               const std::vector<Query> &queries, double query_seconds,
                                               double case_seconds) {
    std::vector<ReferenceAnswer> answers(queries.size());
    const double case_end = clock_of(CLOCK_MONOTONIC) + case_seconds;
    for (size_t next = 0; next < queries.size() && clock_of(CLOCK_MONOTONIC) < case_end;) {
        next = round_of(geometry, algorithm, queries, next, query_seconds, case_end, answers);
    }
    return answers;
}
