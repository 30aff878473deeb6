// SPDX-License-Identifier: MIT OR Apache-2.0
#include "geometry.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>

double norm(const Vec &a) { return std::sqrt(dot(a, a)); }

Geometry read_geometry(const std::string &path) {
    std::ifstream file(path);
    std::string kind;
    Geometry g;
    file >> kind;
    g.is_curve = kind == "curve";
    const int directions = g.is_curve ? 1 : 2;
    int rational = 0, dimension = 3;
    if (g.is_curve) {
        file >> g.degree[0] >> g.count[0] >> rational >> dimension;
    } else {
        file >> g.degree[0] >> g.degree[1] >> g.count[0] >> g.count[1] >> rational;
    }
    g.rational = rational != 0;
    for (int k = 0; k < directions; k++) {
        g.knots[k].resize(g.count[k] + g.degree[k] + 1);
        for (double &x : g.knots[k]) {
            file >> x;
        }
    }
    for (int i = 0; i < g.count[0] * g.count[1]; i++) {
        double x, y, z, w;
        file >> x >> y >> z >> w;
        g.poles.insert(g.poles.end(), {x, y, z});
        g.weights.push_back(w);
    }
    if (!file) {
        throw std::runtime_error("cannot read " + path);
    }
    return g;
}

std::vector<Query> read_queries(const std::string &path) {
    std::ifstream file(path);
    std::string line;
    std::vector<Query> list;
    std::getline(file, line);
    for (int row = 0; std::getline(file, line); row++) {
        std::vector<std::string> cells;
        std::stringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) {
            cells.push_back(cell);
        }
        if (cells.size() < 7) {
            continue;
        }
        const auto number = [&](size_t k) { return std::strtod(cells[k].c_str(), nullptr); };
        list.push_back({{number(0), number(1), number(2)}, cells[3], number(6), {number(4), number(5)}, row});
    }
    return list;
}

std::vector<Query> spread(const std::vector<Query> &all, size_t most) {
    std::map<std::string, std::vector<Query>> classes;
    for (const Query &query : all) {
        classes[query.kind].push_back(query);
    }
    std::vector<Query> chosen;
    const size_t share = classes.empty() ? 0 : std::max<size_t>(1, most / classes.size());
    for (const auto &[kind, list] : classes) {
        const size_t count = std::min(share, list.size());
        for (size_t k = 0; k < count; k++) {
            chosen.push_back(list[k * list.size() / count]);
        }
    }
    return chosen;
}

std::vector<Query> sample(std::vector<Query> all, size_t most) {
    std::stable_sort(all.begin(), all.end(), [](const Query &a, const Query &b) { return a.kind < b.kind; });
    std::vector<Query> chosen;
    const size_t count = std::min(most, all.size());
    for (size_t k = 0; k < count; k++) {
        chosen.push_back(all[k * all.size() / count]);
    }
    std::mt19937 random(1);
    for (size_t k = count; k > 1; k--) {
        std::swap(chosen[k - 1], chosen[random() % k]);
    }
    return chosen;
}
