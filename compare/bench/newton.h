// The textbook's Newton iteration for the nearest point: The NURBS Book, 6.1. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef BENCH_NEWTON_H
#define BENCH_NEWTON_H

#include "spline.h"

// From `at`, kept in the domain (closed directions wrap); stops when the residual is perpendicular or nothing moves.
Pair newton(const Spline &shape, Pair at, const Vec &query);

#endif
