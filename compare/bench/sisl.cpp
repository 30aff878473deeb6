// SISL: s1953 and s1954 search everywhere, s1774 and s1775 iterate from a start. SPDX-License-Identifier: MIT OR Apache-2.0
#include "peer.h"

#include <sisl.h>

#include <cmath>
#include <cstdlib>
#include <vector>

namespace {

// Its geometric resolution, as a share of the diagonal of the poles.
constexpr double RESOLUTION = 1e-9;

double diagonal_of(const Geometry &g) {
    Vec low = {g.poles[0], g.poles[1], g.poles[2]}, high = low;
    for (size_t i = 0; i < g.poles.size(); i++) {
        low[i % 3] = std::fmin(low[i % 3], g.poles[i]);
        high[i % 3] = std::fmax(high[i % 3], g.poles[i]);
    }
    return norm(minus(high, low));
}

// Poles as SISL wants them: u runs fastest, rational ones multiplied by the weight, which follows.
std::vector<double> poles_of(const Geometry &g) {
    std::vector<double> poles;
    for (int j = 0; j < g.count[1]; j++) {
        for (int i = 0; i < g.count[0]; i++) {
            const size_t k = size_t(i) * size_t(g.count[1]) + size_t(j);
            const double w = g.rational ? g.weights[k] : 1.0;
            poles.insert(poles.end(), {g.poles[3 * k] * w, g.poles[3 * k + 1] * w, g.poles[3 * k + 2] * w});
            if (g.rational) {
                poles.push_back(w);
            }
        }
    }
    return poles;
}

// SISL's answers: isolated parameters, and curves whose first points stand for them.
struct Found {
    int status = 0, count = 0, curve_count = 0;
    double *parameters = nullptr;
    SISLIntcurve **curves = nullptr;

    ~Found() {
        std::free(parameters);
        if (curves != nullptr) {
            freeIntcrvlist(curves, curve_count);
        }
    }

    Answer first(int width) const {
        Answer answer;
        const double *at = count > 0 ? parameters : curve_count > 0 ? curves[0]->epar1 : nullptr;
        answer.found = status >= 0 && at != nullptr;
        for (int k = 0; answer.found && k < width; k++) {
            answer.at[size_t(k)] = at[k];
        }
        return answer;
    }
};

class Curve : public Peer {
public:
    Curve(const Geometry &g, bool hinted)
        : hinted_(hinted), low_(g.low(0)), high_(g.high(0)), resolution_(RESOLUTION * diagonal_of(g)) {
        std::vector<double> knots = g.knots[0], poles = poles_of(g);
        curve_ = newCurve(g.count[0], g.degree[0] + 1, knots.data(), poles.data(), g.rational ? 2 : 1, 3, 1);
    }
    ~Curve() override { freeCurve(curve_); }

    Answer ask(const Vec &point, const Pair &hint) override {
        Vec p = point;
        if (hinted_) {
            Answer answer;
            int status = 0;
            s1774(curve_, p.data(), 3, resolution_, low_, high_, hint[0], &answer.at[0], &status);
            answer.found = status >= 0;
            return answer;
        }
        Found found;
        s1953(curve_, p.data(), 3, 0.0, resolution_, &found.count, &found.parameters, &found.curve_count, &found.curves,
              &found.status);
        return found.first(1);
    }

private:
    SISLCurve *curve_;
    bool hinted_;
    double low_, high_, resolution_;
};

class Surface : public Peer {
public:
    Surface(const Geometry &g, bool hinted)
        : hinted_(hinted), low_{g.low(0), g.low(1)}, high_{g.high(0), g.high(1)},
          resolution_(RESOLUTION * diagonal_of(g)) {
        std::vector<double> u = g.knots[0], v = g.knots[1], poles = poles_of(g);
        surface_ = newSurf(g.count[0], g.count[1], g.degree[0] + 1, g.degree[1] + 1, u.data(), v.data(), poles.data(),
                           g.rational ? 2 : 1, 3, 1);
    }
    ~Surface() override { freeSurf(surface_); }

    Answer ask(const Vec &point, const Pair &hint) override {
        Vec p = point;
        if (hinted_) {
            Pair start = hint;
            Answer answer;
            int status = 0;
            s1775(surface_, p.data(), 3, resolution_, low_.data(), high_.data(), start.data(), answer.at.data(), &status);
            answer.found = status >= 0;
            return answer;
        }
        Found found;
        s1954(surface_, p.data(), 3, 0.0, resolution_, &found.count, &found.parameters, &found.curve_count,
              &found.curves, &found.status);
        return found.first(2);
    }

private:
    SISLSurf *surface_;
    bool hinted_;
    Pair low_, high_;
    double resolution_;
};

} // namespace

std::unique_ptr<Peer> make_peer(const std::string &name, const Geometry &g) {
    const bool hinted = name == "sisl_hint";
    if (!hinted && name != "sisl") {
        return nullptr;
    }
    if (g.is_curve) {
        return std::make_unique<Curve>(g, hinted);
    }
    return std::make_unique<Surface>(g, hinted);
}
