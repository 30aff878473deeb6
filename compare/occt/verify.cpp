// SPDX-License-Identifier: MIT OR Apache-2.0
#include "verify.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace {

// Parameters that agree to this share of the domain are the same.
constexpr double SAME = 1e-6;
// Points in space that agree to this share of the diagonal are the same.
constexpr double SAME_POINT = 1e-7;
// A place this close to a collapsed side is on it.
constexpr double SAME_SIDE = 1e-7;
// Slopes (cosines) of our members may be this large.
constexpr double LEAST_SLOPE = 1e-7;

double now() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

Pair foot_of(const fpt_foot_member &m) { return {m.foot.u, m.foot.v}; }

// How far distances may differ on a flat member: the documented accuracy, and rounding.
double accuracy(const Shape &shape, const Vec &query) {
    return 2e-10 * shape.diagonal() + 2.0 * shape.floor(query);
}

bool inside(const Shape &shape, int k, double x, double low, double high) {
    const double grain = SAME * shape.width(k);
    const double turn = shape.closed(k) ? shape.width(k) : 0.0;
    for (double t : {-turn, 0.0, turn}) {
        if (x + t >= low - grain && x + t <= high + grain) {
            return true;
        }
    }
    return false;
}

// Places on a grid over the intervals of a member, ends included.
std::vector<Pair> samples(const Shape &shape, const fpt_foot_member &m, int steps) {
    std::vector<Pair> list;
    const int rows = m.v[0] < m.v[1] && !shape.is_curve() ? steps : 0;
    const int columns = m.u[0] < m.u[1] ? steps : 0;
    for (int i = 0; i <= columns; i++) {
        for (int j = 0; j <= rows; j++) {
            list.push_back({m.u[0] + (columns ? double(i) / columns : 0.0) * (m.u[1] - m.u[0]),
                            m.v[0] + (rows ? double(j) / rows : 0.0) * (m.v[1] - m.v[0])});
        }
    }
    return list;
}

} // namespace

int collapsed_side(const Shape &shape, const Pair &at) {
    for (int side = 0; side < 2 * shape.dimensions(); side++) {
        const int k = side / 2;
        const double end = side % 2 == 0 ? shape.low(k) : shape.high(k);
        if (shape.collapsed(side) && std::fabs(at[k] - end) <= SAME_SIDE * shape.width(k)) {
            return side;
        }
    }
    return -1;
}

bool collapsed_is_extreme(const Shape &shape, const Vec &query, int side, double cosine) {
    bool rises = true, falls = true;
    const int k = side / 2, other = 1 - k;
    const double inward = side % 2 == 0 ? 1.0 : -1.0;
    for (int i = 0; i <= 64; i++) {
        Pair at;
        at[k] = side % 2 == 0 ? shape.low(k) : shape.high(k);
        at[other] = shape.low(other) + i / 64.0 * shape.width(other);
        const std::array<int, 2> sides = {at[0] == shape.high(0) ? -1 : 1, at[1] == shape.high(1) ? -1 : 1};
        const Jet j = shape.jet(at, 1, sides);
        const Vec r = minus(j.point, query);
        const double slope = inward * dot(r, j.first[k]);
        const double least = norm(j.first[k]) * (cosine * norm(r) + shape.floor(query));
        rises = rises && slope >= -least;
        falls = falls && slope <= least;
    }
    return rises || falls;
}

Ours our_extrema(const Shape &shape, const Vec &query) {
    Ours ours;
    for (int turn = 0; turn < 5; turn++) {
        fpt_foot_set *set = nullptr;
        const double start = now();
        const fpt_status status = shape.is_curve()
                                      ? fpt_curve_extrema(shape.curve(), query.data(), nullptr, &set)
                                      : fpt_surface_extrema(shape.surface(), query.data(), nullptr, &set);
        const double seconds = now() - start;
        if (status != FPT_OK && status != FPT_BUDGET_EXHAUSTED) {
            std::fprintf(stderr, "extrema: %s\n", fpt_last_error());
            return ours;
        }
        size_t count = 0, open = 0;
        if (turn == 0) {
            bool read = fpt_foot_set_count(set, &count) == FPT_OK;
            ours.members.resize(count);
            for (size_t k = 0; k < count; k++) {
                read = read && fpt_foot_set_get(set, k, &ours.members[k]) == FPT_OK;
            }
            read = read && fpt_foot_set_undecided_count(set, &open) == FPT_OK;
            ours.undecided.resize(open);
            for (size_t k = 0; k < open; k++) {
                read = read && fpt_foot_set_undecided_get(set, k, ours.undecided[k].data()) == FPT_OK;
            }
            if (!read) {
                std::fprintf(stderr, "set: %s\n", fpt_last_error());
            }
        }
        fpt_foot_set_free(set);
        ours.seconds = turn == 0 ? seconds : std::min(ours.seconds, seconds);
        if (ours.seconds < 1e-3) {
            break;
        }
    }
    return ours;
}

bool belongs(const Shape &shape, const Pair &at, const fpt_foot_member &m) {
    return shape.apart(at, foot_of(m)) <= SAME ||
           (inside(shape, 0, at[0], m.u[0], m.u[1]) &&
            (shape.is_curve() || inside(shape, 1, at[1], m.v[0], m.v[1])));
}

Match match(const Shape &shape, const Vec &query, const Pair &at, const Ours &ours) {
    Match best = Match::MISSING;
    const Vec point = shape.jet(at, 0).point;
    const double here = shape.distance(at, query);
    for (const auto &m : ours.members) {
        const Pair foot = foot_of(m);
        if (shape.apart(at, foot) <= SAME) {
            return Match::PARAMETERS;
        }
        if (belongs(shape, at, m)) {
            best = std::min(best, Match::INTERVALS);
        }
        if (norm(minus(point, {m.foot.point[0], m.foot.point[1], m.foot.point[2]})) <=
            SAME_POINT * shape.diagonal()) {
            best = std::min(best, Match::SPACE);
        }
        Pair way = {foot[0] - at[0], foot[1] - at[1]};
        for (int k = 0; k < shape.dimensions(); k++) {
            const double turn = shape.closed(k) ? shape.width(k) : 0.0;
            way[k] -= std::fabs(way[k]) > 0.5 * shape.width(k) ? std::copysign(turn, way[k]) : 0.0;
        }
        bool level = std::fabs(m.foot.distance - here) <= accuracy(shape, query);
        for (int i = 1; level && i < 32; i++) {
            Pair x = {at[0] + way[0] * i / 32, at[1] + way[1] * i / 32};
            for (int k = 0; k < shape.dimensions(); k++) {
                x[k] += x[k] < shape.low(k) ? shape.width(k) : x[k] > shape.high(k) ? -shape.width(k) : 0.0;
            }
            level = std::fabs(shape.distance(x, query) - here) <= accuracy(shape, query);
        }
        if (level) {
            best = std::min(best, Match::LEVEL);
        }
    }
    for (const auto &box : ours.undecided) {
        if (inside(shape, 0, at[0], box[0], box[1]) &&
            (shape.is_curve() || inside(shape, 1, at[1], box[2], box[3]))) {
            best = std::min(best, Match::UNDECIDED);
        }
    }
    return best;
}

Verdict verify(const Shape &shape, const Vec &query, const fpt_foot_member &m, std::string &reason) {
    const double wanted = shape.distance(foot_of(m), query);
    char text[120];
    if (!(std::fabs(wanted - m.foot.distance) <= shape.floor(query))) {
        std::snprintf(text, sizeof text, "distance %.17g is %.17g", m.foot.distance, wanted);
        reason = text;
        return Verdict::WRONG;
    }
    const int side = collapsed_side(shape, foot_of(m));
    if (side >= 0 && collapsed_is_extreme(shape, query, side, LEAST_SLOPE)) {
        reason = "collapsed edge";
        return Verdict::STATIONARY;
    }
    double change = 0.0;
    for (const Pair &at : samples(shape, m, 8)) {
        change = std::max(change, std::fabs(shape.distance(at, query) - m.foot.distance));
    }
    const double slope = shape.stationarity(foot_of(m), query).slope;
    std::snprintf(text, sizeof text, "slope %.3g, change %.3g diag, width %.3g %.3g", slope,
                  change / shape.diagonal(), m.u[1] - m.u[0], m.v[1] - m.v[0]);
    reason = text;
    if (change > accuracy(shape, query)) {
        return Verdict::WRONG;
    }
    if (slope <= LEAST_SLOPE) {
        return Verdict::STATIONARY;
    }
    const bool wide = m.u[0] < m.u[1] || m.v[0] < m.v[1];
    return wide ? Verdict::LEVEL : Verdict::WRONG;
}

bool nature_is_wrong(const Shape &shape, const Vec &query, const fpt_foot_member &m) {
    if (m.kind != FPT_MEMBER_POINT || m.nature > FPT_NATURE_MAXIMUM) {
        return false;
    }
    const double here = m.foot.distance;
    const double rounding = 2.0 * shape.floor(query) - 2e-12 * shape.diagonal();
    const double sign = m.nature == FPT_NATURE_MINIMUM ? 1.0 : -1.0;
    int contradictions = 0;
    for (double reach : {1e-4, 1e-5}) {
        bool seen = false;
        for (int i = 0; i < 16; i++) {
            const double angle = 0.392699081698724 * i;
            const Pair turn = {std::cos(angle), shape.is_curve() ? 0.0 : std::sin(angle)};
            Pair at;
            bool outside = false;
            for (int k = 0; k < 2; k++) {
                at[k] = foot_of(m)[k] + turn[k] * reach * shape.width(k);
                if (k < shape.dimensions() && (at[k] < shape.low(k) || at[k] > shape.high(k))) {
                    outside = outside || !shape.closed(k);
                    at[k] += at[k] < shape.low(k) ? shape.width(k) : -shape.width(k);
                }
            }
            // A slope or bend the right way at the place itself is no contradiction, however soon it turns.
            outside = outside || sign * shape.trend(foot_of(m), turn, query) > 0.0;
            seen = seen || (!outside && sign * (shape.distance(at, query) - here) < -rounding);
        }
        contradictions += seen;
    }
    return contradictions == 2;
}

namespace {

// At most `most` of a list, evenly.
std::vector<double> some(const std::vector<double> &list, size_t most) {
    std::vector<double> chosen;
    const size_t count = std::min(most, list.size());
    for (size_t k = 0; k < count; k++) {
        chosen.push_back(list[count == 1 ? 0 : k * (list.size() - 1) / (count - 1)]);
    }
    return chosen;
}

} // namespace

std::vector<Pair> multi_start(const Shape &shape, const Vec &query, int starts) {
    std::vector<Pair> list;
    const auto take = [&](Pair at, int held) {
        const auto known = [&](const Pair &other) { return shape.apart(at, other) <= SAME; };
        if (shape.refine(at, query, 2.0, held) && std::none_of(list.begin(), list.end(), known)) {
            list.push_back(at);
        }
    };
    const auto at_share = [&](int k, double x) { return shape.low(k) + x * shape.width(k); };
    for (int i = 0; i < starts; i++) {
        // Additive recurrences of the plastic number: evenly spread for any count.
        const double a = std::fmod(0.5 + 0.7548776662466927 * i, 1.0);
        const double b = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
        take({at_share(0, a), shape.is_curve() ? 0.0 : at_share(1, b)}, -1);
    }
    constexpr size_t LINES = 12;
    constexpr int ON_LINE = 8;
    for (int k = 0; k < shape.dimensions(); k++) {
        for (double x : some(shape.breaks(k), LINES)) {
            for (int i = 0; i < ON_LINE && !shape.is_curve(); i++) {
                Pair at;
                at[k] = x;
                at[1 - k] = at_share(1 - k, (i + 0.5) / ON_LINE);
                take(at, k);
            }
        }
    }
    const std::vector<double> none = {0.0};
    for (double u : some(shape.breaks(0), LINES)) {
        for (double v : shape.is_curve() ? none : some(shape.breaks(1), LINES)) {
            if (shape.stationarity({u, v}, query).slope <= 1e-10) {
                list.push_back({u, v});
            }
        }
    }
    return list;
}
