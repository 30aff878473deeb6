// Shapes of any size for the growth experiments, and queries near them. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef BENCH_SHEET_H
#define BENCH_SHEET_H

#include "geometry.h"

// A sheet of rows x columns patches of side 1 with random heights, uniform knots. Rows = 0: a curve of so many segments.
Geometry bumpy_sheet(int degree, int rows, int columns);

// Packed points at uniformly random places, at most a quarter of a patch off along the normal.
std::vector<double> points_near(const Geometry &geometry, size_t count);

#endif
