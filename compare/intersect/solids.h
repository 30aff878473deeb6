// Solids that OpenCASCADE makes, as designers make them. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef COMPARE_SOLIDS_H
#define COMPARE_SOLIDS_H

#include <TopoDS_Shape.hxx>

#include <string>
#include <vector>

struct Solid {
    std::string name;
    TopoDS_Shape shape;
};

std::vector<Solid> solids();

#endif
