// Compares fpt_curve_extrema and fpt_surface_extrema with OpenCASCADE and with Newton's method from many starts.
//
//   compare_extrema CASES [--queries N] [--seconds S] [--starts N] [--only NAME] [--list FILE] [--bicubic]
//
// Each stationary place that the others find inside the domain must be one of ours; each of ours that OpenCASCADE
// does not have is verified. The table counts; the list names what is missing or not verified. A member that the set
// itself marks as not proven claims nothing: where it is not verified it is counted on its own.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "reference.h"
#include "verify.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <map>
#include <string>

namespace {

// Slope (cosine) below which a solution of the others counts as stationary as it is.
constexpr double STATIONARY = 1e-6;
// How far Newton's method may move a solution of theirs, as a share of the domain.
constexpr double REACH = 1e-4;
// A parameter this close to an open end is on the border.
constexpr double ON_BORDER = 1e-7;
constexpr size_t SHOWN = 20;

struct Settings {
    std::string cases;
    std::string only;
    std::string list;
    size_t queries = 150;
    double seconds = 60;
    int starts = 64;
    bool bicubic = false;
};

struct Times {
    std::vector<double> values;
    double worst = 0;
    std::string where;

    void add(double x, const std::string &place) {
        values.push_back(x);
        if (x > worst) {
            worst = x;
            where = place;
        }
    }

    std::string text() const {
        if (values.empty()) {
            return "-";
        }
        std::vector<double> sorted = values;
        std::sort(sorted.begin(), sorted.end());
        char line[200];
        std::snprintf(line, sizeof line, "median %.1f us, 99 %% below %.1f us, worst %.1f us (%s)",
                      1e6 * sorted[sorted.size() / 2], 1e6 * sorted[sorted.size() * 99 / 100], 1e6 * worst,
                      where.c_str());
        return line;
    }
};

// Solutions of another program against ours.
struct Theirs {
    size_t queries = 0, failed = 0, crashed = 0, hung = 0, skipped = 0;
    size_t solutions = 0, repeated = 0, loose = 0, not_stationary = 0;
    size_t on_border = 0, border_wanted = 0, border_missing = 0, nearly = 0;
    std::map<Match, size_t> found;
    Times times;

    size_t of(Match m) const {
        const auto at = found.find(m);
        return at == found.end() ? 0 : at->second;
    }
};

struct Mine {
    size_t cases = 0, queries = 0, members = 0, kind[4] = {0}, nature[4] = {0};
    size_t border = 0, in_theirs = 0, undecided_sets = 0, undecided_boxes = 0;
    size_t extra = 0, extra_inside = 0, verified = 0, level = 0, wrong = 0, all_wrong = 0, nature_wrong = 0;
    // Members that the set marks as not proven, and those of them that are not verified.
    size_t marked = 0, extra_not_claimed = 0, not_claimed = 0;
    // Pairs of members whose feet are one place.
    size_t doubled = 0;
    Times times;
};

struct Report {
    Mine curves, surfaces;
    std::map<std::string, Theirs> theirs;
    std::vector<std::string> order;
    std::map<std::string, std::vector<std::string>> lists;
    FILE *list = nullptr;

    Theirs &of(const std::string &name) {
        if (theirs.find(name) == theirs.end()) {
            order.push_back(name);
        }
        return theirs[name];
    }

    void note(const std::string &what, const std::string &line) {
        lists[what].push_back(line);
        if (list != nullptr) {
            std::fprintf(list, "%s: %s\n", what.c_str(), line.c_str());
            std::fflush(list);
        }
    }
};

struct Place {
    std::string name;
    const Query *query;

    std::string text() const { return name + " row " + std::to_string(query->row) + " " + query->kind; }
};

std::string describe(const Shape &shape, const Pair &at, const Query &query, const Ours &ours) {
    double nearest = 1e300, level = 0;
    for (const auto &m : ours.members) {
        const double apart = shape.apart(at, {m.foot.u, m.foot.v});
        if (apart < nearest) {
            nearest = apart;
            level = m.foot.distance - shape.distance(at, query.point);
        }
    }
    char text[400];
    std::snprintf(text, sizeof text,
                  " at %.17g %.17g slope %.3g distance %.3g diag, %s; our nearest %.3g of the domain away, distance "
                  "%+.3g diag; %zu members",
                  at[0], at[1], shape.stationarity(at, query.point).slope,
                  shape.distance(at, query.point) / shape.diagonal(), shape.flat_text(at, query.point).c_str(), nearest,
                  level / shape.diagonal(), ours.members.size());
    return text;
}

bool on_border(const Shape &shape, const Pair &at) {
    for (int k = 0; k < shape.dimensions(); k++) {
        const double end = std::min(at[k] - shape.low(k), shape.high(k) - at[k]) / shape.width(k);
        if (!shape.closed(k) && end < ON_BORDER) {
            return true;
        }
    }
    return collapsed_side(shape, at) >= 0;
}

// Whether a place on a border counts: the slope along it is zero, or it is a collapsed point that is an extremum.
bool counts_on_border(const Shape &shape, const Pair &at, const Vec &query) {
    const int side = collapsed_side(shape, at);
    return side < 0 ? shape.stationarity(at, query).slope <= 1e-10 : collapsed_is_extreme(shape, query, side, 1e-9);
}

// Looks for each solution among ours.
void compare(const Shape &shape, const Place &place, const std::string &whose, const std::vector<Pair> &solutions,
             const Ours &ours, Report &report) {
    Theirs &theirs = report.of(whose);
    std::vector<Pair> known;
    for (const Pair &given : solutions) {
        theirs.solutions++;
        const auto same = [&](const Pair &other) { return shape.apart(given, other) <= 1e-7; };
        if (std::any_of(known.begin(), known.end(), same)) {
            theirs.repeated++;
            continue;
        }
        known.push_back(given);
        const Vec &query = place.query->point;
        Pair at = shape.snapped(given);
        const bool stationary = shape.stationarity(at, query).slope <= STATIONARY;
        const bool refined = shape.refine(at, query, REACH);
        if (on_border(shape, given) || on_border(shape, at)) {
            theirs.on_border++;
            const bool wanted = counts_on_border(shape, at, query);
            theirs.border_wanted += wanted;
            const bool missing = wanted && match(shape, query, at, ours) == Match::MISSING;
            theirs.border_missing += missing;
            if (missing) {
                report.note("border, missing", whose + " " + place.text() + describe(shape, at, *place.query, ours));
            }
            continue;
        }
        if (!stationary && !refined) {
            theirs.not_stationary++;
            continue;
        }
        theirs.loose += !stationary;
        Match how = match(shape, query, at, ours);
        const std::string line = whose + " " + place.text() + describe(shape, at, *place.query, ours);
        if (!refined && how == Match::MISSING) {
            theirs.nearly++;
            report.note("nearly stationary, no zero near", line);
            continue;
        }
        theirs.found[how]++;
        if (how == Match::MISSING) {
            report.note("MISSING", line);
        } else if (how == Match::SPACE || how == Match::UNDECIDED) {
            report.note(how == Match::SPACE ? "same point in space only" : "in an undecided box", line);
        }
    }
}

// Counts ours, and verifies those that are not in `theirs`.
void examine(const Shape &shape, const Place &place, const Ours &ours, const std::vector<Pair> &theirs, Mine &mine,
             Report &report) {
    const Vec &query = place.query->point;
    mine.queries++;
    mine.times.add(ours.seconds, place.text());
    mine.undecided_sets += !ours.undecided.empty();
    mine.undecided_boxes += ours.undecided.size();
    if (!ours.undecided.empty()) {
        report.note("undecided", place.text() + " " + std::to_string(ours.undecided.size()) + " boxes");
    }
    for (const auto &m : ours.members) {
        mine.members++;
        mine.kind[m.kind & 3]++;
        mine.nature[m.nature & 3]++;
        const Pair foot = {m.foot.u, m.foot.v};
        const bool border = on_border(shape, foot);
        mine.border += border;
        for (const auto *other = ours.members.data(); other != &m; other++) {
            if (shape.apart(foot, {other->foot.u, other->foot.v}) <= 1e-7) {
                mine.doubled++;
                report.note("two members at one place", place.text() + " at " + std::to_string(foot[0]) + " " +
                                                            std::to_string(foot[1]) + " kinds " +
                                                            std::to_string(other->kind) + " " + std::to_string(m.kind));
            }
        }
        const auto same = [&](const Pair &at) { return belongs(shape, at, m); };
        const bool known = std::any_of(theirs.begin(), theirs.end(), same);
        mine.in_theirs += known;
        std::string reason;
        const Verdict verdict = verify(shape, query, m, reason);
        char text[160];
        std::snprintf(text, sizeof text, " at %.17g %.17g kind %u nature %u flags %u distance %.3g diag: ", foot[0],
                      foot[1], m.kind, m.nature, m.foot.flags, m.foot.distance / shape.diagonal());
        const std::string line = place.text() + text + reason + "; " + shape.flat_text(foot, query);
        const bool marked = (m.foot.flags & FPT_FOOT_NOT_PROVEN) != 0;
        const bool wrong = verdict == Verdict::WRONG && !marked;
        const bool not_claimed = verdict == Verdict::WRONG && marked;
        mine.marked += marked;
        mine.all_wrong += wrong;
        mine.not_claimed += not_claimed;
        if (wrong || not_claimed) {
            report.note(wrong ? "NOT VERIFIED" : "not verified and marked NOT_PROVEN", line);
        }
        if (nature_is_wrong(shape, query, m)) {
            mine.nature_wrong++;
            report.note("nature contradicted", line);
        }
        if (!known) {
            mine.extra++;
            mine.extra_inside += !border;
            mine.verified += verdict == Verdict::STATIONARY;
            mine.level += verdict == Verdict::LEVEL;
            mine.wrong += wrong;
            mine.extra_not_claimed += not_claimed;
        }
    }
}

void count(Theirs &theirs, const ReferenceAnswer &answer, const Place &place) {
    theirs.queries++;
    theirs.failed += answer.state == ReferenceAnswer::FAILED;
    theirs.crashed += answer.state == ReferenceAnswer::CRASHED;
    theirs.hung += answer.state == ReferenceAnswer::HUNG;
    theirs.skipped += answer.state == ReferenceAnswer::SKIPPED;
    if (answer.state == ReferenceAnswer::DONE) {
        theirs.times.add(answer.seconds, place.text());
    }
}

void run_case(const Settings &settings, const std::string &name, Report &report) {
    const Geometry geometry = read_geometry(settings.cases + "/" + name + "/geometry.txt");
    const auto queries = spread(read_queries(settings.cases + "/" + name + "/queries.csv"), settings.queries);
    const Shape shape(geometry);
    const bool curve = geometry.is_curve;
    std::vector<std::pair<std::string, Algorithm>> ways;
    if (curve) {
        ways = {{"OCCT curves", Algorithm::CURVE}};
    } else {
        ways = {{"OCCT surfaces, grad", Algorithm::GRAD}, {"OCCT surfaces, tree", Algorithm::TREE}};
    }
    std::vector<std::vector<ReferenceAnswer>> answers;
    for (const auto &way : ways) {
        answers.push_back(reference_answers(geometry, way.second, queries, 10.0, settings.seconds));
    }
    Mine &mine = curve ? report.curves : report.surfaces;
    mine.cases++;
    Mine before = mine;
    before.times = {};
    for (size_t i = 0; i < queries.size(); i++) {
        const Place place = {name, &queries[i]};
        const Ours ours = our_extrema(shape, queries[i].point);
        std::vector<Pair> all;
        for (size_t k = 0; k < ways.size(); k++) {
            const ReferenceAnswer &answer = answers[k][i];
            count(report.of(ways[k].first), answer, place);
            compare(shape, place, ways[k].first, answer.solutions, ours, report);
            all.insert(all.end(), answer.solutions.begin(), answer.solutions.end());
        }
        if (settings.starts > 0) {
            const std::string whose = curve ? "Newton from many starts, curves" : "Newton from many starts, surfaces";
            report.of(whose).queries++;
            compare(shape, place, whose, multi_start(shape, queries[i].point, settings.starts), ours, report);
        }
        examine(shape, place, ours, all, mine, report);
    }
    const size_t done = mine.times.values.size() - queries.size();
    std::vector<double> own(mine.times.values.begin() + long(done), mine.times.values.end());
    std::sort(own.begin(), own.end());
    const double median = own.empty() ? 0 : own[own.size() / 2], worst = own.empty() ? 0 : own.back();
    std::printf("%s queries %zu members %zu in theirs %zu not verified %zu natures contradicted %zu undecided %zu; "
                "ours median %.1f us worst %.1f us\n",
                name.c_str(), queries.size(), mine.members - before.members, mine.in_theirs - before.in_theirs,
                mine.all_wrong - before.all_wrong, mine.nature_wrong - before.nature_wrong,
                mine.undecided_sets - before.undecided_sets, 1e6 * median, 1e6 * worst);
    std::fflush(stdout);
}

void print(const std::string &name, const Theirs &t) {
    std::printf("\n%s\n  queries %zu (failed %zu, crashed %zu, hung %zu, left out for time %zu)\n", name.c_str(),
                t.queries, t.failed, t.crashed, t.hung, t.skipped);
    std::printf("  solutions %zu: repeated %zu, not stationary %zu, on borders %zu (stationary there %zu, of these missing in ours "
                "%zu)\n",
                t.solutions, t.repeated, t.not_stationary, t.on_border, t.border_wanted, t.border_missing);
    const size_t found = t.of(Match::PARAMETERS) + t.of(Match::INTERVALS) + t.of(Match::SPACE) + t.of(Match::LEVEL);
    std::printf("  inside and stationary %zu (only after Newton %zu)\n", found + t.of(Match::UNDECIDED) + t.of(Match::MISSING),
                t.loose);
    std::printf("  found in ours %zu (by parameters %zu, in intervals %zu, same point %zu, within the accuracy %zu)\n",
                found, t.of(Match::PARAMETERS), t.of(Match::INTERVALS), t.of(Match::SPACE), t.of(Match::LEVEL));
    std::printf("  in undecided boxes %zu, nearly stationary without a zero %zu, MISSING %zu\n",
                t.of(Match::UNDECIDED), t.nearly, t.of(Match::MISSING));
    std::printf("  time: %s\n", t.times.text().c_str());
}

void print(const std::string &name, const Mine &m) {
    if (m.queries == 0) {
        return;
    }
    std::printf("\n%s\n  cases %zu, queries %zu, undecided sets %zu (%zu boxes)\n", name.c_str(), m.cases, m.queries,
                m.undecided_sets, m.undecided_boxes);
    std::printf("  members %zu: points %zu, arcs in u %zu, arcs in v %zu, regions %zu\n", m.members, m.kind[0],
                m.kind[1], m.kind[2], m.kind[3]);
    std::printf("    minima %zu, maxima %zu, saddles %zu, flat %zu; on borders %zu\n", m.nature[0], m.nature[1],
                m.nature[2], m.nature[3], m.border);
    std::printf("  in OCCT %zu, not in OCCT %zu (%zu inside): stationary %zu, level %zu, marked and not verified %zu, "
                "NOT VERIFIED %zu\n",
                m.in_theirs, m.extra, m.extra_inside, m.verified, m.level, m.extra_not_claimed, m.wrong);
    std::printf("  all members: not verified %zu, natures contradicted %zu, pairs at one place %zu\n", m.all_wrong,
                m.nature_wrong, m.doubled);
    std::printf("  marked NOT_PROVEN %zu, of these not verified %zu\n", m.marked, m.not_claimed);
    std::printf("  time: %s\n", m.times.text().c_str());
}

// Polynomial bicubic patches of one piece with uneven poles: the time of a call.
void time_bicubic() {
    uint64_t state = 12345;
    const auto random = [&] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return double(state >> 11) * 0x1p-53;
    };
    for (double roughness : {0.2, 1.0}) {
        Times times;
        size_t members = 0, undecided = 0;
        for (int patch = 0; patch < 200; patch++) {
            Geometry g;
            g.degree[0] = g.degree[1] = 3;
            g.count[0] = g.count[1] = 4;
            g.knots[0] = g.knots[1] = {0, 0, 0, 0, 1, 1, 1, 1};
            for (int k = 0; k < 16; k++) {
                const double bent[3] = {random() - 0.5, random() - 0.5, random() - 0.5};
                g.poles.insert(g.poles.end(), {k / 4 + roughness * bent[0], k % 4 + roughness * bent[1],
                                               2 * roughness * bent[2]});
                g.weights.push_back(1.0);
            }
            const Shape shape(g);
            for (int k = 0; k < 25; k++) {
                const Vec query = {5 * random() - 1, 5 * random() - 1, 4 * random() - 2};
                const Ours ours = our_extrema(shape, query);
                times.add(ours.seconds, "patch " + std::to_string(patch));
                members += ours.members.size();
                undecided += !ours.undecided.empty();
            }
        }
        std::printf("bicubic patches, poles moved by %.1f of their spacing: 5000 queries, %zu members, %zu undecided; %s\n",
                    roughness / 2, members, undecided, times.text().c_str());
    }
}

std::vector<std::string> case_names(const Settings &settings) {
    std::vector<std::string> names;
    DIR *folder = opendir(settings.cases.c_str());
    while (const dirent *entry = folder == nullptr ? nullptr : readdir(folder)) {
        const std::string name = entry->d_name;
        if (settings.only.empty() ? name.rfind("real_", 0) == 0 : name == settings.only) {
            names.push_back(name);
        }
    }
    if (folder != nullptr) {
        closedir(folder);
    }
    std::sort(names.begin(), names.end());
    return names;
}

bool read_settings(int argc, char **argv, Settings &settings) {
    for (int k = 1; k < argc; k++) {
        const std::string word = argv[k];
        const char *value = k + 1 < argc ? argv[k + 1] : "";
        if (word == "--bicubic") {
            settings.bicubic = true;
            continue;
        }
        if (word.rfind("--", 0) != 0) {
            settings.cases = word;
            continue;
        }
        k++;
        if (word == "--queries") {
            settings.queries = size_t(std::atol(value));
        } else if (word == "--seconds") {
            settings.seconds = std::atof(value);
        } else if (word == "--starts") {
            settings.starts = std::atoi(value);
        } else if (word == "--only") {
            settings.only = value;
        } else if (word == "--list") {
            settings.list = value;
        } else {
            return false;
        }
    }
    return settings.bicubic || !settings.cases.empty();
}

} // namespace

int main(int argc, char **argv) {
    Settings settings;
    if (!read_settings(argc, argv, settings)) {
        std::fprintf(stderr, "usage: compare_extrema CASES [--queries N] [--seconds S] [--starts N] [--only NAME] "
                             "[--list FILE] [--bicubic]\n");
        return 2;
    }
    if (settings.bicubic) {
        time_bicubic();
    }
    if (settings.cases.empty()) {
        return 0;
    }
    const auto names = case_names(settings);
    if (names.empty()) {
        std::fprintf(stderr, "no cases in %s\n", settings.cases.c_str());
        return 2;
    }
    Report report;
    report.list = settings.list.empty() ? nullptr : std::fopen(settings.list.c_str(), "w");
    for (const auto &name : names) {
        run_case(settings, name, report);
    }
    print("Ours, curves", report.curves);
    print("Ours, surfaces", report.surfaces);
    for (const auto &name : report.order) {
        print(name, report.theirs[name]);
    }
    for (const auto &[what, lines] : report.lists) {
        std::printf("\n%s: %zu\n", what.c_str(), lines.size());
        for (size_t k = 0; k < std::min(SHOWN, lines.size()); k++) {
            std::printf("  %s\n", lines[k].c_str());
        }
    }
    if (report.list != nullptr) {
        std::fclose(report.list);
    }
    bool wrong = report.curves.all_wrong + report.surfaces.all_wrong > 0;
    for (const auto &[name, theirs] : report.theirs) {
        wrong = wrong || theirs.of(Match::MISSING) > 0;
    }
    return wrong ? 1 : 0;
}
