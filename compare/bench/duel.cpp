// One library against footpoint, in turns on the same queries, a case after the other.
//   bench_LIBRARY PEER FILE [--queries N] [--seconds S] [--hint SHARE] CASE_DIR...
// Each case runs in a child process. FILE gets a line for each case and each query, see `write_case`.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "clock.h"
#include "ours.h"
#include "watch.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

namespace {

// So many queries in turn; each is asked up to REPEATS times, but only until a turn has taken SLOW nanoseconds. The least
// time counts.
constexpr size_t TURN = 32;
constexpr int REPEATS = 4;
constexpr double SLOW = 4e7;
// Processes for one case: after so many crashes and hangs the rest is left out.
constexpr int TRIES = 6;

struct Settings {
    std::string peer, file;
    size_t queries = 400;
    Limits limits;
    double hint = 0;
    std::vector<std::string> cases;
};

enum State : int { OPEN, ANSWERED, NOTHING_FOUND, CRASHED, HUNG };
constexpr const char *STATE_NAMES[] = {"open", "answered", "nothing", "crashed", "hung"};

struct Result {
    State state;
    bool complete;
    double time, excess;
    double our_time, our_excess;
};

// In shared memory, with the results behind it.
struct Board {
    std::atomic<unsigned long> beat;
    std::atomic<size_t> asked;
    bool takes_shape;
    double diagonal, set_up, our_set_up;
    // Nanoseconds per query of one call for all queries, with one thread and with two.
    double batch[2];
    Result *results;
};

struct Case {
    std::string name;
    Geometry geometry;
    std::vector<Query> queries;
    std::vector<Pair> hints;
};

Case read_case(const std::string &folder, const Settings &settings) {
    Case c;
    c.name = folder.substr(folder.find_last_of('/') + 1);
    c.geometry = read_geometry(folder + "/geometry.txt");
    // In mixed order: what is done when time runs out stands for all.
    c.queries = sample(read_queries(folder + "/queries.csv"), settings.queries);
    for (const Query &query : c.queries) {
        c.hints.push_back(hint_beside(c.geometry, query, settings.hint));
    }
    return c;
}

Answer ask(Peer &peer, const Case &c, size_t i) {
    try {
        return peer.ask(c.queries[i].point, c.hints[i]);
    } catch (...) {
        return {};
    }
}

void turn(const Case &c, const Shape &shape, Peer &theirs, Peer &ours, const std::vector<size_t> &chunk, Board &board) {
    const double cost = clock_cost(), start = now();
    std::vector<Answer> answers(chunk.size()), our_answers(chunk.size());
    std::vector<double> times(chunk.size(), std::numeric_limits<double>::infinity()), our_times = times;
    for (int repeat = 0; repeat < REPEATS && now() - start < SLOW; repeat++) {
        for (size_t k = 0; k < chunk.size(); k++) {
            board.asked = chunk[k];
            board.beat++;
            const auto call = [&] { answers[k] = ask(theirs, c, chunk[k]); };
            times[k] = std::min(times[k], call_time_of(cost, times[k], call));
        }
        for (size_t k = 0; k < chunk.size(); k++) {
            const auto call = [&] { our_answers[k] = ask(ours, c, chunk[k]); };
            our_times[k] = std::min(our_times[k], call_time_of(cost, our_times[k], call));
        }
    }
    for (size_t k = 0; k < chunk.size(); k++) {
        const Query &query = c.queries[chunk[k]];
        const auto excess = [&](const Answer &a) { return a.found ? shape.excess(a, query) : INFINITY; };
        board.results[chunk[k]] = {answers[k].found ? ANSWERED : NOTHING_FOUND, true, times[k],
                                   excess(answers[k]), our_times[k], excess(our_answers[k])};
    }
}

double batch_time(const Case &c, const Shape &shape, uint32_t threads, bool hinted) {
    std::vector<double> points;
    for (const Query &query : c.queries) {
        points.insert(points.end(), query.point.begin(), query.point.end());
    }
    std::vector<fpt_foot_point> feet(c.queries.size());
    fpt_query_options options = plain_options(threads);
    options.hints = hinted ? c.hints[0].data() : nullptr;
    options.hint_stride = sizeof(Pair);
    double least = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        const auto ask = [&] { shape.closest(points.data(), feet.size(), &options, feet.data()); };
        least = std::min(least, batch_time_of(threads, ask));
    }
    return least / double(feet.size());
}

// What the child does: everything that is not complete.
void work(const Case &c, const Settings &settings, Board &board) {
    const Shape shape(c.geometry);
    board.diagonal = shape.diagonal();
    board.our_set_up = shape.set_up_seconds();
    const double start = now();
    const std::unique_ptr<Peer> theirs = make_peer(settings.peer, c.geometry);
    board.set_up = (now() - start) * 1e-9;
    board.takes_shape = theirs != nullptr;
    if (!theirs) {
        return;
    }
    Ours ours(shape, settings.hint > 0);
    std::vector<size_t> open;
    for (size_t i = 0; i < c.queries.size(); i++) {
        if (!board.results[i].complete) {
            open.push_back(i);
        }
    }
    for (size_t i = 0; i < open.size(); i += TURN) {
        const auto end = open.begin() + long(std::min(i + TURN, open.size()));
        turn(c, shape, *theirs, ours, {open.begin() + long(i), end}, board);
    }
    for (uint32_t threads : {1u, 2u}) {
        board.beat++;
        board.batch[threads - 1] = batch_time(c, shape, threads, settings.hint > 0);
    }
}

// Processes until the case is through; a query at which one ends is marked.
void run_case(const Case &c, const Settings &settings, Board &board) {
    board.takes_shape = true;
    for (int process = 0; process < TRIES; process++) {
        const unsigned long before = board.beat;
        const End end = watched([&] { work(c, settings, board); }, board.beat, settings.limits);
        if (end == End::DONE || end == End::LATE) {
            return;
        }
        const State state = end == End::HUNG ? HUNG : CRASHED;
        const Result none = {state, true, NAN, INFINITY, NAN, 0};
        if (board.beat == before) {
            std::fill_n(board.results, c.queries.size(), none);
            return;
        }
        board.results[board.asked] = none;
    }
}

// case,NAME,CURVE OR SURFACE,DIAGONAL,SET-UP s,OUR SET-UP s,BATCH ns,BATCH OF TWO THREADS ns
// query,CLASS,STATE,TIME ns,EXCESS in diagonals,OUR TIME ns,OUR EXCESS
void write_case(std::FILE *file, const Case &c, const Board &board) {
    std::fprintf(file, "case,%s,%s,%.9g,%.9g,%.9g,%.4g,%.4g\n", c.name.c_str(), c.geometry.is_curve ? "curve" : "surface",
                 board.diagonal, board.set_up, board.our_set_up, board.batch[0], board.batch[1]);
    for (size_t i = 0; i < c.queries.size(); i++) {
        const Result &r = board.results[i];
        if (r.complete) {
            std::fprintf(file, "query,%s,%s,%.0f,%.3g,%.0f,%.3g\n", c.queries[i].kind.c_str(), STATE_NAMES[r.state],
                         r.time, r.excess, r.our_time, r.our_excess);
        }
    }
}

bool read_settings(int argc, char **argv, Settings &settings) {
    if (argc < 4) {
        return false;
    }
    settings.peer = argv[1];
    settings.file = argv[2];
    for (int k = 3; k < argc; k++) {
        const std::string word = argv[k];
        if (word.rfind("--", 0) != 0) {
            settings.cases.push_back(word);
            continue;
        }
        const char *value = ++k < argc ? argv[k] : "0";
        if (word == "--queries") {
            settings.queries = size_t(std::atol(value));
        } else if (word == "--seconds") {
            settings.limits.seconds = std::atof(value);
        } else if (word == "--hint") {
            settings.hint = std::atof(value);
        } else {
            return false;
        }
    }
    return true;
}

} // namespace

int main(int argc, char **argv) {
    Settings settings;
    std::FILE *file = nullptr;
    if (!read_settings(argc, argv, settings) || !(file = std::fopen(settings.file.c_str(), "w"))) {
        std::fprintf(stderr, "usage: %s PEER FILE [--queries N] [--seconds S] [--hint SHARE] CASE_DIR...\n", argv[0]);
        return 2;
    }
    constexpr size_t MOST = 100000;
    const size_t bytes = sizeof(Board) + MOST * sizeof(Result);
    void *memory = shared_memory(bytes);
    settings.queries = std::min(settings.queries, MOST);
    for (const std::string &folder : settings.cases) {
        const Case c = read_case(folder, settings);
        std::memset(memory, 0, bytes);
        Board &board = *new (memory) Board;
        board.results = reinterpret_cast<Result *>(&board + 1);
        run_case(c, settings, board);
        if (board.takes_shape) {
            write_case(file, c, board);
        }
    }
    std::fclose(file);
    return 0;
}
