// SPDX-License-Identifier: MIT OR Apache-2.0
#include "opencascade.h"

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>

namespace {

struct Knots {
    std::vector<double> values;
    std::vector<int> repeats;

    explicit Knots(const std::vector<double> &flat) {
        for (double x : flat) {
            if (values.empty() || x > values.back()) {
                values.push_back(x);
                repeats.push_back(0);
            }
            repeats.back()++;
        }
    }

    TColStd_Array1OfReal reals() const {
        TColStd_Array1OfReal list(1, int(values.size()));
        for (int i = 0; i < int(values.size()); i++) {
            list(i + 1) = values[i];
        }
        return list;
    }

    TColStd_Array1OfInteger integers() const {
        TColStd_Array1OfInteger list(1, int(repeats.size()));
        for (int i = 0; i < int(repeats.size()); i++) {
            list(i + 1) = repeats[i];
        }
        return list;
    }
};

} // namespace

Handle(Geom_BSplineCurve) curve_of(const Geometry &g) {
    TColgp_Array1OfPnt poles(1, g.count[0]);
    TColStd_Array1OfReal weights(1, g.count[0]);
    for (int i = 0; i < g.count[0]; i++) {
        poles(i + 1) = gp_Pnt(g.poles[3 * i], g.poles[3 * i + 1], g.poles[3 * i + 2]);
        weights(i + 1) = g.weights[i];
    }
    const Knots knots(g.knots[0]);
    return g.rational ? new Geom_BSplineCurve(poles, weights, knots.reals(), knots.integers(), g.degree[0])
                      : new Geom_BSplineCurve(poles, knots.reals(), knots.integers(), g.degree[0]);
}

Handle(Geom_BSplineSurface) surface_of(const Geometry &g) {
    TColgp_Array2OfPnt poles(1, g.count[0], 1, g.count[1]);
    TColStd_Array2OfReal weights(1, g.count[0], 1, g.count[1]);
    for (int i = 0; i < g.count[0]; i++) {
        for (int j = 0; j < g.count[1]; j++) {
            const int k = i * g.count[1] + j;
            poles(i + 1, j + 1) = gp_Pnt(g.poles[3 * k], g.poles[3 * k + 1], g.poles[3 * k + 2]);
            weights(i + 1, j + 1) = g.weights[k];
        }
    }
    const Knots u(g.knots[0]), v(g.knots[1]);
    return g.rational ? new Geom_BSplineSurface(poles, weights, u.reals(), v.reals(), u.integers(), v.integers(),
                                                g.degree[0], g.degree[1])
                      : new Geom_BSplineSurface(poles, u.reals(), v.reals(), u.integers(), v.integers(),
                                                g.degree[0], g.degree[1]);
}
