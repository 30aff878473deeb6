// Cases as OpenCASCADE has them. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef COMPARE_OPENCASCADE_H
#define COMPARE_OPENCASCADE_H

#include "geometry.h"

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>

Handle(Geom_BSplineCurve) curve_of(const Geometry &g);
Handle(Geom_BSplineSurface) surface_of(const Geometry &g);

#endif
