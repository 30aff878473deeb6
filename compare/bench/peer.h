// What the bench asks of a library: the nearest point of one shape, one query at a time.
// SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef BENCH_PEER_H
#define BENCH_PEER_H

#include "geometry.h"

#include <memory>
#include <string>

struct Answer {
    bool found = false;
    // The place; a library that gives none (a mesh) says its distance.
    bool has_place = true;
    Pair at = {0, 0};
    double distance = 0;
};

class Peer {
public:
    virtual ~Peer() = default;
    // `hint` is a start for peers that take one, else it is not looked at. May throw: then nothing was found.
    virtual Answer ask(const Vec &point, const Pair &hint) = 0;
};

// The peer of that name of the library that is linked in; null when it cannot take such a shape. May throw, crash and hang.
std::unique_ptr<Peer> make_peer(const std::string &name, const Geometry &geometry);

#endif
