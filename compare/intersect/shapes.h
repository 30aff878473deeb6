// Surfaces of the comparison as nets of poles: elementary ones as exact NURBS, sheets with bumps, waves.
// SPDX-License-Identifier: MIT OR Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

struct Net {
    int p, q, nu, nv;
    std::vector<double> u, v, poles, weights; // poles by rows of v; no weights: polynomial
};

using Point = std::array<double, 3>;

// A rotation about an axis through the origin, and a shift.
struct Motion {
    double rows[3][3];
    Point shift;

    Motion(double w, double x, double y, double z, Point by) : shift(by) {
        const double n = std::sqrt(w * w + x * x + y * y + z * z);
        w /= n, x /= n, y /= n, z /= n;
        const double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                                {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) rows[i][k] = r[i][k];
    }
};

inline Net moved(Net s, const Motion &m) {
    for (std::size_t k = 0; k < s.poles.size(); k += 3) {
        const Point p{s.poles[k], s.poles[k + 1], s.poles[k + 2]};
        for (int i = 0; i < 3; i++) s.poles[k + i] = m.rows[i][0] * p[0] + m.rows[i][1] * p[1] + m.rows[i][2] * p[2] + m.shift[i];
    }
    return s;
}

// (x, y, z) / (1 + a x + b y): rational, planes stay planes, what meets stays.
inline Net in_perspective(Net s, double a, double b) {
    for (std::size_t k = 0; k < s.poles.size(); k += 3) {
        const double w = 1 + a * s.poles[k] + b * s.poles[k + 1];
        for (int i = 0; i < 3; i++) s.poles[k + i] /= w;
        s.weights.push_back(w);
    }
    return s;
}

// Revolution of a profile (r, z, weight) about z.
inline Net revolved(const std::vector<Point> &profile, int degree, const std::vector<double> &knots) {
    const double h = std::sqrt(0.5), corner[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    Net s{2, degree, 9, int(profile.size()), {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1}, knots, {}, {}};
    for (int i = 0; i < 9; i++) {
        for (const Point &p : profile) {
            s.poles.insert(s.poles.end(), {p[0] * corner[i][0], p[0] * corner[i][1], p[1]});
            s.weights.push_back(p[2] * (i % 2 ? h : 1));
        }
    }
    return s;
}

inline Net sphere(double r) {
    const double h = std::sqrt(0.5);
    return revolved({{0, -r, 1}, {r, -r, h}, {r, 0, 1}, {r, r, h}, {0, r, 1}}, 2, {0, 0, 0, 0.5, 0.5, 1, 1, 1});
}

inline Net torus(double big, double r) {
    const double h = std::sqrt(0.5), corner[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    std::vector<Point> profile;
    for (int i = 0; i < 9; i++) profile.push_back({big + r * corner[i][0], r * corner[i][1], i % 2 ? h : 1});
    return revolved(profile, 2, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1});
}

inline Net cone(double z0, double r0, double z1, double r1) { return revolved({{r0, z0, 1}, {r1, z1, 1}}, 1, {0, 0, 1, 1}); }

inline Net plane(Point o, Point x, Point y) {
    Net s{1, 1, 2, 2, {0, 0, 1, 1}, {0, 0, 1, 1}, {}, {}};
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 3; i++) s.poles.push_back(o[i] + (k / 2) * x[i] + (k % 2) * y[i]);
    return s;
}

inline Net level(double z) { return plane({-3.1, -3, z}, {6, 0, 0}, {0, 6.2, 0}); }

// Bumps of height 4/9: poles of height 1, five poles apart, among those of height 0; bicubic, unit spans.
inline Net bumps(int n) {
    const int side = int(std::ceil(std::sqrt(double(n)))), count = 5 * side + 4;
    Net s{3, 3, count, count, {}, {}, {}, {}};
    for (int i = 0; i < count + 4; i++) s.u.push_back(i - 3.0);
    s.v = s.u;
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            const bool on = i % 5 == 4 && j % 5 == 4 && i / 5 < side && j / 5 < side && (i / 5) * side + j / 5 < n;
            s.poles.insert(s.poles.end(), {i - 1.0, j - 1.0, on ? 1.0 : 0.0});
        }
    }
    return s;
}

inline Net lid(int n, double z) {
    const double size = 5 * std::ceil(std::sqrt(double(n))) + 2.5;
    Net s{3, 3, 4, 4, {0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}, {}, {}};
    for (int k = 0; k < 16; k++) s.poles.insert(s.poles.end(), {-0.5 + size * (k / 4) / 3, -0.5 + size * (k % 4) / 3, z});
    return s;
}

// A bicubic sheet with waves.
inline Net wave(int count, double phase) {
    Net s{3, 3, count, count, {0, 0, 0, 0}, {}, {}, {}};
    for (int i = 1; i <= count - 4; i++) s.u.push_back(double(i) / (count - 3));
    s.u.insert(s.u.end(), 4, 1.0);
    s.v = s.u;
    for (int k = 0; k < count * count; k++) {
        const double x = -3 + 6.0 * (k / count) / (count - 1), y = -3 + 6.0 * (k % count) / (count - 1);
        s.poles.insert(s.poles.end(), {x, y, 0.9 * std::sin(1.3 * x + phase) * std::cos(1.1 * y - 0.7 * phase)});
    }
    return s;
}
