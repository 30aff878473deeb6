// Our extrema, and checks of them that use nothing but points and derivatives. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef COMPARE_VERIFY_H
#define COMPARE_VERIFY_H

#include "shape.h"

#include <array>
#include <string>
#include <vector>

struct Ours {
    std::vector<fpt_foot_member> members;
    std::vector<std::array<double, 4>> undecided;
    // Of the processor, the least of up to five runs when it is more than a millisecond.
    double seconds = 0;
};

Ours our_extrema(const Shape &shape, const Vec &query);

// How a stationary place is found among ours.
enum class Match {
    PARAMETERS, // a member's parameters, seam included
    INTERVALS,  // inside the intervals of a continuum
    SPACE,      // the same point in space
    LEVEL,      // the distance stays within the accuracy on the way to a member: one member by the documentation
    UNDECIDED,  // inside a box that the set names as undecided
    MISSING,
};

Match match(const Shape &shape, const Vec &query, const Pair &at, const Ours &ours);

// Whether a place is a member, by parameters or intervals.
bool belongs(const Shape &shape, const Pair &at, const fpt_foot_member &member);

enum class Verdict { STATIONARY, LEVEL, WRONG };

// Whether a member is what it says. LEVEL: the slope is not zero, but the distance stays within the accuracy.
Verdict verify(const Shape &shape, const Vec &query, const fpt_foot_member &member, std::string &reason);

// The collapsed side on which a place lies, or -1.
int collapsed_side(const Shape &shape, const Pair &at);

// Whether the point of a collapsed side is the nearest or the farthest along every line that leaves it; slopes up to
// `least` (cosines) count as none.
bool collapsed_is_extreme(const Shape &shape, const Vec &query, int side, double least);

// Whether nearer places around a minimum or farther ones around a maximum contradict its nature.
bool nature_is_wrong(const Shape &shape, const Vec &query, const fpt_foot_member &member);

// Stationary places that Newton's method finds from `starts` places spread over the domain, and from some on its
// borders and creases; their crossings too.
std::vector<Pair> multi_start(const Shape &shape, const Vec &query, int starts);

#endif
