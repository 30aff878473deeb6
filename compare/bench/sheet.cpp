// SPDX-License-Identifier: MIT OR Apache-2.0
#include "sheet.h"

#include "spline.h"

#include <random>

namespace {

constexpr double HEIGHT = 0.5, OFF = 0.25;

// The same numbers with every library.
class Random {
public:
    explicit Random(unsigned seed) : draw_(seed) {}
    double unit() { return double(draw_()) / 4294967296.0; }
    double around() { return 2.0 * unit() - 1.0; }

private:
    std::mt19937 draw_;
};

std::vector<double> uniform_knots(int degree, int spans) {
    std::vector<double> knots(size_t(degree), 0.0);
    for (int i = 0; i <= spans; i++) {
        knots.push_back(i);
    }
    knots.insert(knots.end(), size_t(degree), double(spans));
    return knots;
}

// Where a pole has to be for the parameter to be the coordinate.
double abscissa(const std::vector<double> &knots, int degree, int i) {
    double sum = 0.0;
    for (int k = 1; k <= degree; k++) {
        sum += knots[size_t(i + k)];
    }
    return sum / degree;
}

} // namespace

Geometry bumpy_sheet(int degree, int rows, int columns) {
    Random random(unsigned(degree) * 1000003u + unsigned(rows) * 1009u + unsigned(columns));
    Geometry g;
    g.is_curve = rows == 0;
    const int spans[2] = {g.is_curve ? columns : rows, columns};
    for (int k = 0; k < g.dimensions(); k++) {
        g.degree[k] = degree;
        g.count[k] = spans[k] + degree;
        g.knots[k] = uniform_knots(degree, spans[k]);
    }
    for (int i = 0; i < g.count[0]; i++) {
        const double x = abscissa(g.knots[0], degree, i);
        for (int j = 0; j < g.count[1]; j++) {
            const double y = g.is_curve ? HEIGHT * random.around() : abscissa(g.knots[1], degree, j);
            g.poles.insert(g.poles.end(), {x, y, HEIGHT * random.around()});
            g.weights.push_back(1.0);
        }
    }
    return g;
}

std::vector<double> points_near(const Geometry &g, size_t count) {
    const Spline shape(g);
    Random random(7);
    std::vector<double> points;
    for (size_t i = 0; i < count; i++) {
        const Pair at = {shape.high(0) * random.unit(), shape.high(1) * random.unit()};
        const Derivatives s = shape.derivatives(at, 1);
        const Vec &a = s[1], b = g.is_curve ? Vec{random.around(), random.around(), random.around()} : s[2];
        const Vec normal = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        const double off = OFF * random.around() / norm(normal);
        for (size_t c = 0; c < 3; c++) {
            points.push_back(s[0][c] + off * normal[c]);
        }
    }
    return points;
}
