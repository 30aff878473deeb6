// SPDX-License-Identifier: MIT OR Apache-2.0
#include "ours.h"

#include "clock.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace {

void need(fpt_status status) {
    if (status != FPT_OK) {
        throw std::runtime_error(fpt_last_error());
    }
}

} // namespace

Shape::Shape(const Geometry &g) {
    const double *weights = g.rational ? g.weights.data() : nullptr;
    const double start = now();
    double box[6];
    if (g.is_curve) {
        const fpt_curve_data data = {sizeof data, size_t(g.degree[0]), size_t(g.count[0]),
                                     g.knots[0].data(), g.poles.data(), weights};
        need(fpt_curve_new(&data, &curve_));
        need(fpt_curve_prepare(curve_));
    } else {
        const fpt_surface_data data = {sizeof data, size_t(g.degree[0]), size_t(g.degree[1]),
                                       size_t(g.count[0]), size_t(g.count[1]), g.knots[0].data(),
                                       g.knots[1].data(), g.poles.data(), weights};
        need(fpt_surface_new(&data, &surface_));
        need(fpt_surface_prepare(surface_));
    }
    set_up_seconds_ = (now() - start) * 1e-9;
    size_t held = 0;
    need(g.is_curve ? fpt_curve_memory(curve_, &held) : fpt_surface_memory(surface_, &held));
    memory_ = double(held);
    need(g.is_curve ? fpt_curve_box(curve_, box) : fpt_surface_box(surface_, box));
    need(g.is_curve ? fpt_curve_domain(curve_, domain_) : fpt_surface_domain(surface_, domain_));
    diagonal_ = norm({box[3] - box[0], box[4] - box[1], box[5] - box[2]});
    for (double x : box) {
        largest_ = std::max(largest_, std::fabs(x));
    }
}

Shape::~Shape() {
    fpt_curve_free(curve_);
    fpt_surface_free(surface_);
}

void Shape::closest(const double *points, size_t count, const fpt_query_options *options, fpt_foot_point *out) const {
    need(surface_ ? fpt_surface_closest(surface_, points, count, options, out)
                  : fpt_curve_closest(curve_, points, count, options, out));
}

double Shape::distance(const Pair &at, const Vec &point) const {
    const double u = std::clamp(at[0], domain_[0], domain_[1]);
    const double v = surface_ ? std::clamp(at[1], domain_[2], domain_[3]) : 0.0;
    Vec place;
    const fpt_status status = surface_ ? fpt_surface_evaluate(surface_, u, v, 0, place.data())
                                       : fpt_curve_evaluate(curve_, u, 0, place.data());
    return status == FPT_OK ? norm(minus(place, point)) : HUGE_VAL;
}

double Shape::rounding(const Vec &point, double distance) const {
    double largest = largest_;
    for (double x : point) {
        largest = std::max(largest, std::fabs(x));
    }
    return 4e-15 * (largest + distance);
}

double Shape::excess(const Answer &answer, const Query &query) const {
    const double found = answer.has_place ? distance(answer.at, query.point) : answer.distance;
    const double off = std::fabs(found - query.distance) - rounding(query.point, query.distance);
    return std::max(off, 0.0) / diagonal_;
}

fpt_query_options plain_options(uint32_t threads) {
    fpt_query_options options;
    fpt_query_options_init(&options, sizeof options);
    options.threads = threads;
    return options;
}

Ours::Ours(const Shape &shape, bool hinted) : shape_(shape), hinted_(hinted), options_(plain_options()) {
    options_.hint_stride = sizeof(Pair);
}

Answer Ours::ask(const Vec &point, const Pair &hint) {
    fpt_foot_point foot;
    options_.hints = hinted_ ? hint.data() : nullptr;
    const fpt_status status = shape_.surface() ? fpt_surface_closest(shape_.surface(), point.data(), 1, &options_, &foot)
                                               : fpt_curve_closest(shape_.curve(), point.data(), 1, &options_, &foot);
    return {status == FPT_OK, true, {foot.u, foot.v}, foot.distance};
}

Pair hint_beside(const Geometry &geometry, const Query &query, double share) {
    Pair hint = query.at;
    for (int k = 0; k < geometry.dimensions(); k++) {
        const double low = geometry.low(k), high = geometry.high(k);
        const unsigned draw = unsigned(query.row) * 2654435761u >> (30 + k);
        const double way = (draw & 1u) != 0 ? 1.0 : -1.0;
        const double moved = hint[k] + way * share * (high - low);
        hint[k] = moved < low || moved > high ? hint[k] - way * share * (high - low) : moved;
    }
    return hint;
}
