/*
 * footpoint for C++17: owners, vectors and exceptions around footpoint.h, and nothing else.
 * SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * Every rule of footpoint.h holds here too: units, threads, lengths and order of the numbers. What differs:
 *   - a curve, a surface, a scene and a report are released by their destructor; they move and do not copy;
 *   - a status that is not FPT_OK is thrown as footpoint::error, with the text of fpt_last_error();
 *   - array arguments are spans, which vectors, arrays and lists in braces become by themselves; their lengths are checked
 *     before the call;
 *   - FPT_BUDGET_EXHAUSTED is not thrown: the set that comes says so with is_complete().
 * Moved-from objects may be assigned to and destroyed; anything else throws FPT_NULL_ARGUMENT.
 * Callbacks in options must not throw; the functions of from_function may, that is a failure there.
 *
 *     footpoint::surface blade(3, 3, knots_u, knots_v, poles, weights);
 *     for (const fpt_foot_point &foot : blade.closest(points)) use(foot.u, foot.v, foot.distance);
 *     for (const fpt_foot_member &member : blade.preimage({x, y, z})) use(member.foot.u, member.foot.v);
 */
#ifndef FOOTPOINT_HPP
#define FOOTPOINT_HPP

#include "footpoint.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace footpoint {

/** Elements that somebody else owns, as std::span of C++20: the argument of a call, never kept. */
template <class T>
class span {
    using value = std::remove_const_t<T>;

public:
    constexpr span() noexcept = default;
    constexpr span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    span(const std::vector<value> &elements) noexcept : span(elements.data(), elements.size()) {}
    template <std::size_t N>
    constexpr span(const std::array<value, N> &elements) noexcept : span(elements.data(), N) {}
    template <std::size_t N>
    constexpr span(const value (&elements)[N]) noexcept : span(elements, N) {}
    /** Lives as long as the call that it is written in. */
    constexpr span(std::initializer_list<value> elements) noexcept : span(elements.begin(), elements.size()) {}

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr T &operator[](std::size_t index) const noexcept { return data_[index]; }

private:
    static_assert(std::is_const_v<T>, "only of elements that are read");
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/** A call that failed. what() names the parameter and the index. */
class error : public std::runtime_error {
public:
    error(fpt_status status, const std::string &text) : std::runtime_error(text), status_(status) {}

    /** The status, never FPT_OK. */
    fpt_status status() const noexcept { return status_; }
    /** Its name, for example "FPT_INVALID_ARGUMENT". */
    const char *status_name() const noexcept { return fpt_status_name(status_); }

private:
    fpt_status status_;
};

/** Throws unless the status is FPT_OK. */
inline void check(fpt_status status) {
    if (status != FPT_OK) throw error(status, fpt_last_error());
}

/** Version of the library in use, as fpt_version(). */
inline std::uint32_t version() noexcept { return fpt_version(); }
/** Binary interface of the library in use, as fpt_abi_version(). */
inline std::uint32_t abi_version() noexcept { return fpt_abi_version(); }

/** fpt_query_options that begin as the defaults. */
struct query_options : fpt_query_options {
    query_options() noexcept : fpt_query_options() {
        fpt_query_options_init(this, sizeof(fpt_query_options));
    }
};

/** fpt_curve_callback.evaluate without its user: u, derivatives, out. */
using curve_function = std::function<int(double, std::uint32_t, double *)>;
/** fpt_surface_callback.evaluate without its user: u, v, derivatives, out. */
using surface_function = std::function<int(double, double, std::uint32_t, double *)>;

/** fpt_extrema_options that begin as the defaults. */
struct extrema_options : fpt_extrema_options {
    extrema_options() noexcept : fpt_extrema_options() {
        fpt_extrema_options_init(this, sizeof(fpt_extrema_options));
    }
};

/** x,y,z of a point or direction. */
using point = std::array<double, 3>;

/** Least and greatest length along a line's direction; a ray has 0 and infinity. */
using reach = std::array<double, 2>;

/** The whole line. */
inline constexpr reach whole_line{-std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::infinity()};

/** A set of feet: owner of an fpt_foot_set. */
class foot_set {
public:
    /** Takes a handle over. */
    explicit foot_set(fpt_foot_set *handle) noexcept : handle_(handle) {}

    /** The handle, still owned here. */
    const fpt_foot_set *get() const noexcept { return handle_.get(); }
    /** The handle, owned by the caller from now on. */
    fpt_foot_set *release() noexcept { return handle_.release(); }

    std::size_t size() const {
        std::size_t out = 0;
        check(fpt_foot_set_count(get(), &out));
        return out;
    }
    bool empty() const { return size() == 0; }

    /** A member; an index beyond the size is thrown. */
    fpt_foot_member operator[](std::size_t index) const {
        fpt_foot_member out;
        check(fpt_foot_set_get(get(), index, &out));
        return out;
    }

    /** Boxes u0,u1,v0,v1 that the budget left undecided. */
    std::vector<std::array<double, 4>> undecided() const {
        std::size_t count = 0;
        check(fpt_foot_set_undecided_count(get(), &count));
        std::vector<std::array<double, 4>> out(count);
        for (std::size_t i = 0; i < count; i++) check(fpt_foot_set_undecided_get(get(), i, out[i].data()));
        return out;
    }
    /** Whether nothing is missing. */
    bool is_complete() const {
        std::size_t count = 0;
        check(fpt_foot_set_undecided_count(get(), &count));
        return count == 0;
    }

    /** Members one by one, as copies. Valid while the set lives where it is. */
    class iterator {
    public:
        using iterator_category = std::input_iterator_tag;
        using value_type = fpt_foot_member;
        using difference_type = std::ptrdiff_t;
        using pointer = void;
        using reference = fpt_foot_member;

        iterator(const foot_set *set, std::size_t index) noexcept : set_(set), index_(index) {}
        fpt_foot_member operator*() const { return (*set_)[index_]; }
        iterator &operator++() noexcept {
            index_++;
            return *this;
        }
        iterator operator++(int) noexcept {
            iterator before = *this;
            index_++;
            return before;
        }
        bool operator==(const iterator &other) const noexcept { return index_ == other.index_; }
        bool operator!=(const iterator &other) const noexcept { return index_ != other.index_; }

    private:
        const foot_set *set_;
        std::size_t index_;
    };

    iterator begin() const noexcept { return iterator(this, 0); }
    iterator end() const { return iterator(this, size()); }

private:
    struct deleter {
        void operator()(fpt_foot_set *handle) const noexcept { fpt_foot_set_free(handle); }
    };

    std::unique_ptr<fpt_foot_set, deleter> handle_;
};

/** Unit normals with sides, or unit tangents, one per foot. */
struct directions {
    /** x,y,z each; NaN where there is none. */
    std::vector<double> vectors;
    /** Signed distances of the queries; empty for tangents. */
    std::vector<double> signed_distances;
    /** Sums of fpt_normal_flag values. */
    std::vector<std::uint32_t> flags;
};

/** A polyline of points on a shape, as a path. */
struct path {
    std::vector<fpt_foot_point> feet;
    /** u, on a surface u,v per foot; NaN for a bad point. */
    std::vector<double> unwrapped;
    /** Sums of fpt_path_change values. */
    std::vector<std::uint32_t> changes;
};

/** What the classes below share; not for callers. */
namespace detail {

/** Calls the function behind `user`; what it throws is a failure. */
template <class Function, class... Arguments>
std::int32_t called(void *user, Arguments... arguments) noexcept {
    try {
        return (*static_cast<Function *>(user))(arguments...);
    } catch (...) {
        return -1;
    }
}

template <class Function>
void released(void *user) noexcept {
    delete static_cast<Function *>(user);
}

inline void require(bool holds, const char *text) {
    if (!holds) throw error(FPT_INVALID_ARGUMENT, text);
}

/** Poles that a knot vector of this length belongs to. */
inline std::size_t pole_count(span<const double> knots, std::size_t degree, const char *text) {
    require(knots.size() > degree && knots.size() - degree > 1, text);
    return knots.size() - degree - 1;
}

inline const double *weights(span<const double> weights, std::size_t pole_count) {
    require(weights.empty() || weights.size() == pole_count, "weights: need one per pole, or none");
    return weights.empty() ? nullptr : weights.data();
}

/** Query points in a vector that is packed or has the stride of the options. */
template <class Number>
std::size_t point_count(span<const Number> points, const fpt_query_options &options) {
    const std::size_t stride = options.point_stride == 0 ? 3 * sizeof(Number) : options.point_stride;
    const std::size_t bytes = points.size() * sizeof(Number);
    require(bytes % stride == 0, "points: the length is not a multiple of the stride of one point");
    return bytes / stride;
}

template <class Shape, class Value>
Value value(fpt_status (*get)(const Shape *, Value *), const Shape *shape) {
    Value out{};
    check(get(shape, &out));
    return out;
}

template <std::size_t N, class Shape, class Number>
std::array<Number, N> array(fpt_status (*get)(const Shape *, Number *), const Shape *shape) {
    std::array<Number, N> out{};
    check(get(shape, out.data()));
    return out;
}

template <class Shape>
std::vector<double> vector(fpt_status (*get)(const Shape *, std::size_t, double *), const Shape *shape,
                           std::size_t size) {
    std::vector<double> out(size);
    check(get(shape, out.size(), out.data()));
    return out;
}

template <class Shape, class Number>
using query = fpt_status (*)(const Shape *, const Number *, std::size_t, const fpt_query_options *,
                             fpt_foot_point *);

template <class Shape, class Number>
std::vector<fpt_foot_point> feet(query<Shape, Number> ask, const Shape *shape, span<const Number> points,
                                 const fpt_query_options &options) {
    std::vector<fpt_foot_point> out(point_count(points, options));
    check(ask(shape, points.data(), out.size(), &options, out.data()));
    return out;
}

/** The set that a call made; one that is not complete is a set too. */
template <class Call>
foot_set set(Call call) {
    fpt_foot_set *out = nullptr;
    const fpt_status status = call(&out);
    if (status != FPT_BUDGET_EXHAUSTED) check(status);
    return foot_set(out);
}

template <class Shape>
using projection = fpt_status (*)(const Shape *, const double *, std::size_t, const double *,
                                  const fpt_query_options *, fpt_foot_point *);

template <class Shape>
std::vector<fpt_foot_point> projected(projection<Shape> ask, const Shape *shape, span<const double> points,
                                      const point &direction, const fpt_query_options &options) {
    std::vector<fpt_foot_point> out(point_count(points, options));
    check(ask(shape, points.data(), out.size(), direction.data(), &options, out.data()));
    return out;
}

template <class Shape>
using walk = fpt_status (*)(const Shape *, const double *, std::size_t, const fpt_query_options *,
                            fpt_foot_point *, double *, std::uint32_t *);

template <class Shape>
path joined(walk<Shape> ask, const Shape *shape, span<const double> points,
            const fpt_query_options &options, std::size_t parameters) {
    const std::size_t count = point_count(points, options);
    path out{std::vector<fpt_foot_point>(count), std::vector<double>(parameters * count),
             std::vector<std::uint32_t>(count)};
    check(ask(shape, points.data(), count, &options, out.feet.data(), out.unwrapped.data(),
              out.changes.data()));
    return out;
}

} // namespace detail

/** A curve: owner of an fpt_curve. */
class curve {
public:
    /** As fpt_curve_new. */
    explicit curve(const fpt_curve_data &data) : handle_(make(data)) {}

    /** The pole count follows from the knots; poles hold x,y,z each; no weights: polynomial. */
    curve(std::size_t degree, span<const double> knots, span<const double> poles,
          span<const double> weights = {})
        : handle_(make(degree, knots, poles, weights)) {}

    /** Takes a handle over. */
    explicit curve(fpt_curve *handle) noexcept : handle_(handle) {}

    /** A curve given by a function, as fpt_curve_from_callback; bounds of 0: unknown. The function is called on
     *  any thread, on several at a time. */
    static curve from_function(curve_function function, const std::array<double, 2> &domain,
                               double speed_bound = 0, double second_bound = 0) {
        auto kept = std::make_unique<curve_function>(std::move(function));
        fpt_curve_callback callback{};
        callback.struct_size = sizeof callback;
        if (*kept) callback.evaluate = detail::called<curve_function, double, std::uint32_t, double *>;
        callback.user = kept.get();
        callback.release = detail::released<curve_function>;
        for (std::size_t i = 0; i < 2; i++) callback.domain[i] = domain[i];
        callback.speed_bound = speed_bound;
        callback.second_bound = second_bound;
        fpt_curve *out = nullptr;
        check(fpt_curve_from_callback(&callback, &out));
        kept.release();
        return curve(out);
    }

    /** The handle, still owned here. */
    const fpt_curve *get() const noexcept { return handle_.get(); }
    /** The handle, owned by the caller from now on. */
    fpt_curve *release() noexcept { return handle_.release(); }

    std::size_t degree() const { return detail::value(fpt_curve_degree, get()); }
    std::size_t pole_count() const { return detail::value(fpt_curve_pole_count, get()); }
    std::vector<double> knots() const {
        return detail::vector(fpt_curve_knots, get(), pole_count() + degree() + 1);
    }
    std::vector<double> poles() const { return detail::vector(fpt_curve_poles, get(), 3 * pole_count()); }
    /** All 1 for a polynomial curve. */
    std::vector<double> weights() const { return detail::vector(fpt_curve_weights, get(), pole_count()); }
    /** Start and end of u. */
    std::array<double, 2> domain() const { return detail::array<2>(fpt_curve_domain, get()); }
    /** Least x,y,z, then greatest x,y,z. */
    std::array<double, 6> box() const { return detail::array<6>(fpt_curve_box, get()); }
    bool is_rational() const { return detail::value(fpt_curve_is_rational, get()) != 0; }
    bool is_closed() const { return detail::value(fpt_curve_is_closed, get()) != 0; }

    /** C, C', C'', ... up to `derivatives`, x,y,z each. */
    std::vector<double> evaluate(double u, std::uint32_t derivatives = 0) const {
        std::vector<double> out(values(derivatives));
        check(fpt_curve_evaluate(get(), u, derivatives, out.data()));
        return out;
    }

    /** The same of the piece below (-1) or above (+1) the parameter. */
    std::vector<double> evaluate_sided(double u, std::int32_t side, std::uint32_t derivatives = 1) const {
        std::vector<double> out(values(derivatives));
        check(fpt_curve_evaluate_sided(get(), u, side, derivatives, out.data()));
        return out;
    }

    /** The values of evaluate for each parameter, one after the other. */
    std::vector<double> evaluate_many(span<const double> parameters,
                                      std::uint32_t derivatives = 0) const {
        std::vector<double> out(parameters.size() * values(derivatives));
        check(fpt_curve_evaluate_many(get(), parameters.data(), parameters.size(), derivatives, out.data()));
        return out;
    }

    /** Builds the search index now. */
    void prepare() const { check(fpt_curve_prepare(get())); }
    /** Bytes held, as fpt_curve_memory. */
    std::size_t memory() const { return detail::value(fpt_curve_memory, get()); }

    /** One record per query point, x,y,z each. */
    std::vector<fpt_foot_point> closest(span<const double> points,
                                        const fpt_query_options &options = query_options()) const {
        return detail::feet(fpt_curve_closest, get(), points, options);
    }
    /** The same for points in single precision. */
    std::vector<fpt_foot_point> closest_f32(span<const float> points,
                                            const fpt_query_options &options = query_options()) const {
        return detail::feet(fpt_curve_closest_f32, get(), points, options);
    }
    /** As fpt_curve_closest: the records stay with the caller, also when FPT_CANCELLED is thrown. */
    void closest(const double *points, std::size_t count, const fpt_query_options *options,
                 fpt_foot_point *out) const {
        check(fpt_curve_closest(get(), points, count, options, out));
    }
    /** One record per query point, x,y,z each. */
    std::vector<fpt_foot_point> invert(span<const double> points,
                                       const fpt_query_options &options = query_options()) const {
        return detail::feet(fpt_curve_invert, get(), points, options);
    }
    /** The same for points in single precision. */
    std::vector<fpt_foot_point> invert_f32(span<const float> points,
                                           const fpt_query_options &options = query_options()) const {
        return detail::feet(fpt_curve_invert_f32, get(), points, options);
    }
    /** As fpt_curve_invert: the records stay with the caller, also when FPT_CANCELLED is thrown. */
    void invert(const double *points, std::size_t count, const fpt_query_options *options,
                fpt_foot_point *out) const {
        check(fpt_curve_invert(get(), points, count, options, out));
    }

    /** As fpt_curve_preimage. */
    foot_set preimage(const point &where, double tolerance = 0,
                      const fpt_query_options &options = query_options()) const {
        return detail::set([&](fpt_foot_set **out) {
            return fpt_curve_preimage(get(), where.data(), tolerance, &options, out);
        });
    }
    /** As fpt_curve_extrema. */
    foot_set extrema(const point &where, const fpt_extrema_options &options = extrema_options()) const {
        return detail::set(
            [&](fpt_foot_set **out) { return fpt_curve_extrema(get(), where.data(), &options, out); });
    }
    /** As fpt_curve_on_line. */
    foot_set on_line(const point &origin, const point &direction, const reach &part = whole_line,
                     double tolerance = 0, const fpt_query_options &options = query_options()) const {
        return detail::set([&](fpt_foot_set **out) {
            return fpt_curve_on_line(get(), origin.data(), direction.data(), part.data(), tolerance, &options, out);
        });
    }
    /** As fpt_curve_project: one record per query point, x,y,z each. */
    std::vector<fpt_foot_point> project(span<const double> points, const point &direction,
                                        const fpt_query_options &options = query_options()) const {
        return detail::projected<fpt_curve>(fpt_curve_project, get(), points, direction, options);
    }

    /** The points in the order of a path, joined, as fpt_curve_path. */
    footpoint::path path(span<const double> points,
                         const fpt_query_options &options = query_options()) const {
        return detail::joined<fpt_curve>(fpt_curve_path, get(), points, options, 1);
    }
    /** u and the whole turns that bring it nearest to the previous one. */
    double unwrap(double previous, double u) const {
        double out = 0;
        check(fpt_curve_unwrap(get(), previous, u, &out));
        return out;
    }

    /** The unit tangent at each foot. */
    directions tangents(span<const fpt_foot_point> feet) const {
        directions out{std::vector<double>(3 * feet.size()), {}, std::vector<std::uint32_t>(feet.size())};
        check(fpt_curve_tangents(get(), feet.data(), feet.size(), out.vectors.data(), out.flags.data()));
        return out;
    }
    /** How far u may move while the point moves by the accuracy (0: the default), for each foot. */
    std::vector<double> uncertainty(span<const fpt_foot_point> feet, double accuracy = 0) const {
        std::vector<double> out(feet.size());
        check(fpt_curve_uncertainty(get(), feet.data(), feet.size(), accuracy, out.data()));
        return out;
    }

private:
    struct deleter {
        void operator()(fpt_curve *handle) const noexcept { fpt_curve_free(handle); }
    };

    /** Numbers in one evaluation; an order that the library refuses is left to it. */
    static std::size_t values(std::uint32_t derivatives) {
        return derivatives > 31 ? 0 : 3 * (std::size_t(derivatives) + 1);
    }

    static fpt_curve *make(const fpt_curve_data &data) {
        fpt_curve *out = nullptr;
        check(fpt_curve_new(&data, &out));
        return out;
    }

    static fpt_curve *make(std::size_t degree, span<const double> knots,
                           span<const double> poles, span<const double> weights) {
        fpt_curve_data data{};
        data.struct_size = sizeof data;
        data.degree = degree;
        data.pole_count = detail::pole_count(knots, degree, "knots: too few for the degree");
        detail::require(poles.size() % 3 == 0 && poles.size() / 3 == data.pole_count,
                        "poles: need x,y,z for each of knots - degree - 1 poles");
        data.knots = knots.data();
        data.poles = poles.data();
        data.weights = detail::weights(weights, data.pole_count);
        return make(data);
    }

    std::unique_ptr<fpt_curve, deleter> handle_;
};

/** A surface: owner of an fpt_surface. */
class surface {
public:
    /** As fpt_surface_new. */
    explicit surface(const fpt_surface_data &data) : handle_(make(data)) {}

    /** The pole counts follow from the knots; pole (i,j) is number i*pole_count_v + j, x,y,z each; no
     *  weights: polynomial. */
    surface(std::size_t degree_u, std::size_t degree_v, span<const double> knots_u,
            span<const double> knots_v, span<const double> poles,
            span<const double> weights = {})
        : handle_(make(degree_u, degree_v, knots_u, knots_v, poles, weights)) {}

    /** Takes a handle over. */
    explicit surface(fpt_surface *handle) noexcept : handle_(handle) {}

    /** A surface given by a function, as fpt_surface_from_callback; bounds that are all 0: unknown. The function
     *  is called on any thread, on several at a time. */
    static surface from_function(surface_function function, const std::array<double, 4> &domain,
                                 const std::array<double, 2> &speed_bounds = {},
                                 const std::array<double, 3> &second_bounds = {}) {
        auto kept = std::make_unique<surface_function>(std::move(function));
        fpt_surface_callback callback{};
        callback.struct_size = sizeof callback;
        if (*kept) callback.evaluate = detail::called<surface_function, double, double, std::uint32_t, double *>;
        callback.user = kept.get();
        callback.release = detail::released<surface_function>;
        for (std::size_t i = 0; i < 4; i++) callback.domain[i] = domain[i];
        for (std::size_t i = 0; i < 2; i++) callback.speed_bounds[i] = speed_bounds[i];
        for (std::size_t i = 0; i < 3; i++) callback.second_bounds[i] = second_bounds[i];
        fpt_surface *out = nullptr;
        check(fpt_surface_from_callback(&callback, &out));
        kept.release();
        return surface(out);
    }

    /** The handle, still owned here. */
    const fpt_surface *get() const noexcept { return handle_.get(); }
    /** The handle, owned by the caller from now on. */
    fpt_surface *release() noexcept { return handle_.release(); }

    std::size_t degree_u() const { return detail::value(fpt_surface_degree_u, get()); }
    std::size_t degree_v() const { return detail::value(fpt_surface_degree_v, get()); }
    std::size_t pole_count_u() const { return detail::value(fpt_surface_pole_count_u, get()); }
    std::size_t pole_count_v() const { return detail::value(fpt_surface_pole_count_v, get()); }
    std::vector<double> knots_u() const {
        return detail::vector(fpt_surface_knots_u, get(), pole_count_u() + degree_u() + 1);
    }
    std::vector<double> knots_v() const {
        return detail::vector(fpt_surface_knots_v, get(), pole_count_v() + degree_v() + 1);
    }
    std::vector<double> poles() const {
        return detail::vector(fpt_surface_poles, get(), 3 * pole_count_u() * pole_count_v());
    }
    /** All 1 for a polynomial surface. */
    std::vector<double> weights() const {
        return detail::vector(fpt_surface_weights, get(), pole_count_u() * pole_count_v());
    }
    /** Start and end of u, start and end of v. */
    std::array<double, 4> domain() const { return detail::array<4>(fpt_surface_domain, get()); }
    /** Least x,y,z, then greatest x,y,z. */
    std::array<double, 6> box() const { return detail::array<6>(fpt_surface_box, get()); }
    bool is_rational() const { return detail::value(fpt_surface_is_rational, get()) != 0; }
    bool is_closed_u() const { return detail::value(fpt_surface_is_closed_u, get()) != 0; }
    bool is_closed_v() const { return detail::value(fpt_surface_is_closed_v, get()) != 0; }
    /** Edges that are a point: start of u, end of u, start of v, end of v. */
    std::array<bool, 4> collapsed_edges() const {
        const auto edges = detail::array<4>(fpt_surface_collapsed_edges, get());
        return {edges[0] != 0, edges[1] != 0, edges[2] != 0, edges[3] != 0};
    }

    /** S; Su,Sv; Suu,Suv,Svv; ... up to the total order `derivatives`, x,y,z each. */
    std::vector<double> evaluate(double u, double v, std::uint32_t derivatives = 0) const {
        std::vector<double> out(values(derivatives));
        check(fpt_surface_evaluate(get(), u, v, derivatives, out.data()));
        return out;
    }

    /** The same of the piece below (-1) or above (+1) in each direction. */
    std::vector<double> evaluate_sided(double u, double v, std::int32_t side_u, std::int32_t side_v,
                                       std::uint32_t derivatives = 1) const {
        std::vector<double> out(values(derivatives));
        check(fpt_surface_evaluate_sided(get(), u, v, side_u, side_v, derivatives, out.data()));
        return out;
    }

    /** The values of evaluate for each pair u,v of `parameters`, one after the other. */
    std::vector<double> evaluate_many(span<const double> parameters,
                                      std::uint32_t derivatives = 0) const {
        detail::require(parameters.size() % 2 == 0, "parameters: need pairs u,v");
        const std::size_t count = parameters.size() / 2;
        std::vector<double> out(count * values(derivatives));
        check(fpt_surface_evaluate_many(get(), parameters.data(), count, derivatives, out.data()));
        return out;
    }

    /** Builds the search index now. */
    void prepare() const { check(fpt_surface_prepare(get())); }
    /** Bytes held, as fpt_surface_memory. */
    std::size_t memory() const { return detail::value(fpt_surface_memory, get()); }

    /** One record per query point, x,y,z each. */
    std::vector<fpt_foot_point> closest(span<const double> points,
                                        const fpt_query_options &options = query_options()) const {
        return detail::feet(fpt_surface_closest, get(), points, options);
    }
    /** The same for points in single precision. */
    std::vector<fpt_foot_point> closest_f32(span<const float> points,
                                            const fpt_query_options &options = query_options()) const {
        return detail::feet(fpt_surface_closest_f32, get(), points, options);
    }
    /** As fpt_surface_closest: the records stay with the caller, also when FPT_CANCELLED is thrown. */
    void closest(const double *points, std::size_t count, const fpt_query_options *options,
                 fpt_foot_point *out) const {
        check(fpt_surface_closest(get(), points, count, options, out));
    }
    /** One record per query point, x,y,z each. */
    std::vector<fpt_foot_point> invert(span<const double> points,
                                       const fpt_query_options &options = query_options()) const {
        return detail::feet(fpt_surface_invert, get(), points, options);
    }
    /** The same for points in single precision. */
    std::vector<fpt_foot_point> invert_f32(span<const float> points,
                                           const fpt_query_options &options = query_options()) const {
        return detail::feet(fpt_surface_invert_f32, get(), points, options);
    }
    /** As fpt_surface_invert: the records stay with the caller, also when FPT_CANCELLED is thrown. */
    void invert(const double *points, std::size_t count, const fpt_query_options *options,
                fpt_foot_point *out) const {
        check(fpt_surface_invert(get(), points, count, options, out));
    }

    /** As fpt_surface_preimage. */
    foot_set preimage(const point &where, double tolerance = 0,
                      const fpt_query_options &options = query_options()) const {
        return detail::set([&](fpt_foot_set **out) {
            return fpt_surface_preimage(get(), where.data(), tolerance, &options, out);
        });
    }
    /** As fpt_surface_extrema. */
    foot_set extrema(const point &where, const fpt_extrema_options &options = extrema_options()) const {
        return detail::set(
            [&](fpt_foot_set **out) { return fpt_surface_extrema(get(), where.data(), &options, out); });
    }
    /** As fpt_surface_on_line. */
    foot_set on_line(const point &origin, const point &direction, const reach &part = whole_line,
                     double tolerance = 0, const fpt_query_options &options = query_options()) const {
        return detail::set([&](fpt_foot_set **out) {
            return fpt_surface_on_line(get(), origin.data(), direction.data(), part.data(), tolerance, &options, out);
        });
    }
    /** As fpt_surface_project: one record per query point, x,y,z each. */
    std::vector<fpt_foot_point> project(span<const double> points, const point &direction,
                                        const fpt_query_options &options = query_options()) const {
        return detail::projected<fpt_surface>(fpt_surface_project, get(), points, direction, options);
    }

    /** The points in the order of a path, joined, as fpt_surface_path. */
    footpoint::path path(span<const double> points,
                         const fpt_query_options &options = query_options()) const {
        return detail::joined<fpt_surface>(fpt_surface_path, get(), points, options, 2);
    }
    /** u, v and the whole turns that bring them nearest to the previous ones. */
    std::array<double, 2> unwrap(const std::array<double, 2> &previous, const std::array<double, 2> &uv) const {
        std::array<double, 2> out{};
        check(fpt_surface_unwrap(get(), previous.data(), uv.data(), out.data()));
        return out;
    }

    /** The unit normal at each foot and the signed distance of its query; packed points x,y,z, one per foot. */
    directions normals(span<const double> points, span<const fpt_foot_point> feet) const {
        detail::require(points.size() == 3 * feet.size(), "points: need x,y,z for each foot");
        directions out{std::vector<double>(3 * feet.size()), std::vector<double>(feet.size()),
                       std::vector<std::uint32_t>(feet.size())};
        check(fpt_surface_normals(get(), points.data(), feet.data(), feet.size(), out.vectors.data(),
                                  out.signed_distances.data(), out.flags.data()));
        return out;
    }
    /** The unit normals alone, without sides. */
    directions normals(span<const fpt_foot_point> feet) const {
        directions out{std::vector<double>(3 * feet.size()), {}, std::vector<std::uint32_t>(feet.size())};
        check(fpt_surface_normals(get(), nullptr, feet.data(), feet.size(), out.vectors.data(), nullptr, out.flags.data()));
        return out;
    }
    /** How far u and v may move while the point moves by the accuracy (0: the default), for each foot. */
    std::vector<double> uncertainty(span<const fpt_foot_point> feet, double accuracy = 0) const {
        std::vector<double> out(2 * feet.size());
        check(fpt_surface_uncertainty(get(), feet.data(), feet.size(), accuracy, out.data()));
        return out;
    }

private:
    struct deleter {
        void operator()(fpt_surface *handle) const noexcept { fpt_surface_free(handle); }
    };

    /** Numbers in one evaluation; an order that the library refuses is left to it. */
    static std::size_t values(std::uint32_t derivatives) {
        const std::size_t order = derivatives;
        return order > 31 ? 0 : 3 * (order + 1) * (order + 2) / 2;
    }

    static fpt_surface *make(const fpt_surface_data &data) {
        fpt_surface *out = nullptr;
        check(fpt_surface_new(&data, &out));
        return out;
    }

    static fpt_surface *make(std::size_t degree_u, std::size_t degree_v, span<const double> knots_u,
                             span<const double> knots_v, span<const double> poles,
                             span<const double> weights) {
        fpt_surface_data data{};
        data.struct_size = sizeof data;
        data.degree_u = degree_u;
        data.degree_v = degree_v;
        data.pole_count_u = detail::pole_count(knots_u, degree_u, "knots_u: too few for the degree");
        data.pole_count_v = detail::pole_count(knots_v, degree_v, "knots_v: too few for the degree");
        const std::size_t count = poles.size() / 3;
        detail::require(poles.size() % 3 == 0 && count % data.pole_count_v == 0
                            && count / data.pole_count_v == data.pole_count_u,
                        "poles: need x,y,z for each of (knots_u - degree_u - 1) x (knots_v - degree_v - 1)");
        data.knots_u = knots_u.data();
        data.knots_v = knots_v.data();
        data.poles = poles.data();
        data.weights = detail::weights(weights, count);
        return make(data);
    }

    std::unique_ptr<fpt_surface, deleter> handle_;
};

/** Three rows of rotation and translation, as fpt_scene_member.placement. */
using placement = std::array<double, 12>;

/** Feet in a scene, and whose they are. */
struct scene_feet {
    std::vector<fpt_foot_point> feet;
    /** The member of each foot; UINT32_MAX: none. */
    std::vector<std::uint32_t> members;
};

/** Many curves and surfaces searched together: owner of an fpt_scene. */
class scene {
public:
    /** As fpt_scene_new; the shapes may go before the scene does. */
    explicit scene(span<const fpt_scene_member> members) : handle_(make(members)) {}

    /** Takes a handle over. */
    explicit scene(fpt_scene *handle) noexcept : handle_(handle) {}

    /** A member where it stands; the shape must live until the scene is made. */
    static fpt_scene_member member(const curve &shape) { return member(shape.get(), nullptr, nullptr); }
    /** A member where it stands; the shape must live until the scene is made. */
    static fpt_scene_member member(const surface &shape) { return member(nullptr, shape.get(), nullptr); }
    /** A placed member; shape and placement must live until the scene is made. */
    static fpt_scene_member member(const curve &shape, const placement &place) {
        return member(shape.get(), nullptr, place.data());
    }
    /** A placed member; shape and placement must live until the scene is made. */
    static fpt_scene_member member(const surface &shape, const placement &place) {
        return member(nullptr, shape.get(), place.data());
    }
    static fpt_scene_member member(const curve &shape, placement &&place) = delete;
    static fpt_scene_member member(const surface &shape, placement &&place) = delete;

    /** The handle, still owned here. */
    const fpt_scene *get() const noexcept { return handle_.get(); }
    /** The handle, owned by the caller from now on. */
    fpt_scene *release() noexcept { return handle_.release(); }

    std::size_t size() const { return detail::value(fpt_scene_count, get()); }
    /** Least x,y,z, then greatest x,y,z. */
    std::array<double, 6> box() const { return detail::array<6>(fpt_scene_box, get()); }
    /** Bytes held, as fpt_scene_memory. */
    std::size_t memory() const { return detail::value(fpt_scene_memory, get()); }
    /** Where a member stands. */
    placement placement_of(std::uint32_t member) const {
        placement out{};
        check(fpt_scene_placement(get(), member, out.data()));
        return out;
    }
    /** A member's shape, shared; one of both is an owner of nothing. */
    std::pair<curve, surface> shape_of(std::uint32_t member) const {
        fpt_curve *as_curve = nullptr;
        fpt_surface *as_surface = nullptr;
        check(fpt_scene_shape(get(), member, &as_curve, &as_surface));
        return {curve(as_curve), surface(as_surface)};
    }
    /** The point of a member where it stands. */
    point evaluate(std::uint32_t member, double u, double v = 0) const {
        point out{};
        check(fpt_scene_evaluate(get(), member, u, v, 0, out.data()));
        return out;
    }

    /** The point and its derivatives, as curve::evaluate and surface::evaluate. */
    std::vector<double> evaluate(std::uint32_t member, double u, double v, std::uint32_t derivatives) const {
        const std::size_t order = derivatives > 31 ? 0 : derivatives;
        const bool is_curve = shape_of(member).first.get() != nullptr;
        std::vector<double> out(3 * (order + 1) * (is_curve ? 2 : order + 2) / 2);
        check(fpt_scene_evaluate(get(), member, u, v, derivatives, out.data()));
        return out;
    }

    /** Builds the search indexes now, on all cores. */
    void prepare() const { check(fpt_scene_prepare(get())); }

    /** One record per query point, x,y,z each, and its member. Hints: members per query, and options.hints. */
    scene_feet closest(span<const double> points, const fpt_query_options &options = query_options(),
                       span<const std::uint32_t> hint_members = {}) const {
        return ask<double>(fpt_scene_closest, points, options, hint_members);
    }
    /** As fpt_scene_closest: the records stay with the caller, also when FPT_CANCELLED is thrown; hint_members and out_members may
     *  be null. */
    void closest(const double *points, std::size_t count, const fpt_query_options *options,
                 const std::uint32_t *hint_members, fpt_foot_point *out, std::uint32_t *out_members) const {
        check(fpt_scene_closest(get(), points, count, options, hint_members, out, out_members));
    }
    /** The same for points in single precision. */
    scene_feet closest_f32(span<const float> points, const fpt_query_options &options = query_options(),
                           span<const std::uint32_t> hint_members = {}) const {
        return ask<float>(fpt_scene_closest_f32, points, options, hint_members);
    }
    /** As closest, and points proven to be off every member are marked. */
    scene_feet invert(span<const double> points, const fpt_query_options &options = query_options(),
                      span<const std::uint32_t> hint_members = {}) const {
        return ask<double>(fpt_scene_invert, points, options, hint_members);
    }
    /** The same for points in single precision. */
    scene_feet invert_f32(span<const float> points, const fpt_query_options &options = query_options(),
                          span<const std::uint32_t> hint_members = {}) const {
        return ask<float>(fpt_scene_invert_f32, points, options, hint_members);
    }

    /** The unit normals alone, without sides. */
    directions normals(const scene_feet &found) const {
        const std::size_t count = found.feet.size();
        detail::require(found.members.size() == count, "members: need one for each foot");
        directions out{std::vector<double>(3 * count), {}, std::vector<std::uint32_t>(count)};
        check(fpt_scene_normals(get(), nullptr, found.feet.data(), found.members.data(), count, out.vectors.data(),
                                nullptr, out.flags.data()));
        return out;
    }
    /** The unit normal at each foot and the signed distance of its query; packed points x,y,z, one per foot. */
    directions normals(span<const double> points, const scene_feet &found) const {
        const std::size_t count = found.feet.size();
        detail::require(points.size() == 3 * count, "points: need x,y,z for each foot");
        detail::require(found.members.size() == count, "members: need one for each foot");
        directions out{std::vector<double>(3 * count), std::vector<double>(count),
                       std::vector<std::uint32_t>(count)};
        check(fpt_scene_normals(get(), points.data(), found.feet.data(), found.members.data(), count,
                                out.vectors.data(), out.signed_distances.data(), out.flags.data()));
        return out;
    }

private:
    struct deleter {
        void operator()(fpt_scene *handle) const noexcept { fpt_scene_free(handle); }
    };

    template <class Number>
    using query = fpt_status (*)(const fpt_scene *, const Number *, std::size_t, const fpt_query_options *,
                                 const std::uint32_t *, fpt_foot_point *, std::uint32_t *);

    template <class Number>
    scene_feet ask(query<Number> call, span<const Number> points, const fpt_query_options &options,
                   span<const std::uint32_t> hint_members) const {
        const std::size_t count = detail::point_count(points, options);
        detail::require(hint_members.empty() || hint_members.size() == count,
                        "hint_members: need one per query point, or none");
        scene_feet out{std::vector<fpt_foot_point>(count), std::vector<std::uint32_t>(count)};
        check(call(get(), points.data(), count, &options, hint_members.empty() ? nullptr : hint_members.data(),
                   out.feet.data(), out.members.data()));
        return out;
    }

    static fpt_scene_member member(const fpt_curve *as_curve, const fpt_surface *as_surface,
                                   const double *place) noexcept {
        fpt_scene_member out{};
        out.struct_size = sizeof out;
        out.curve = as_curve;
        out.surface = as_surface;
        out.placement = place;
        return out;
    }

    static fpt_scene *make(span<const fpt_scene_member> members) {
        fpt_scene_data data{};
        data.struct_size = sizeof data;
        data.member_count = members.size();
        data.members = members.data();
        fpt_scene *out = nullptr;
        check(fpt_scene_new(&data, &out));
        return out;
    }

    std::unique_ptr<fpt_scene, deleter> handle_;
};

/** fpt_pull_options that begin as the defaults. */
struct pull_options : fpt_pull_options {
    pull_options() noexcept : fpt_pull_options() { fpt_pull_options_init(this, sizeof(fpt_pull_options)); }
};

/** fpt_lift_options that begin as the defaults. */
struct lift_options : fpt_lift_options {
    lift_options() noexcept : fpt_lift_options() { fpt_lift_options_init(this, sizeof(fpt_lift_options)); }
};

/** fpt_face_options that begin as the defaults. */
struct face_options : fpt_face_options {
    face_options() noexcept : fpt_face_options() { fpt_face_options_init(this, sizeof(fpt_face_options)); }
};

/** A pcurve that was pulled back, or the image of one, and how far it is proven to be from what it stands for. */
struct proven_curve {
    curve shape;
    fpt_deviation deviation;
};

/** The pcurves of an edge on a surface, in its order, as fpt_pcurve_pull. */
inline std::vector<proven_curve> pull(const surface &shape, const curve &edge,
                                      const fpt_pull_options &options = pull_options()) {
    struct deleter {
        void operator()(fpt_pcurve_set *handle) const noexcept { fpt_pcurve_set_free(handle); }
    };
    fpt_pcurve_set *made = nullptr;
    check(fpt_pcurve_pull(shape.get(), edge.get(), &options, &made));
    const std::unique_ptr<fpt_pcurve_set, deleter> set(made);
    const std::size_t count = detail::value<fpt_pcurve_set, std::size_t>(fpt_pcurve_set_count, set.get());
    std::vector<proven_curve> out;
    for (std::size_t i = 0; i < count; i++) {
        fpt_curve *piece = nullptr;
        fpt_deviation told{};
        check(fpt_pcurve_set_get(set.get(), i, &piece, &told));
        out.push_back({curve(piece), told});
    }
    return out;
}
/** The image of a pcurve, as fpt_pcurve_lift. */
inline proven_curve lift(const surface &shape, const curve &pcurve, const fpt_lift_options &options = lift_options()) {
    fpt_curve *image = nullptr;
    fpt_deviation told{};
    check(fpt_pcurve_lift(shape.get(), pcurve.get(), &options, &image, &told));
    return {curve(image), told};
}
/** How far a curve in space is from the image of a pcurve, as fpt_pcurve_deviation. */
inline fpt_deviation deviation(const surface &shape, const curve &pcurve, const curve &image) {
    fpt_deviation out{};
    check(fpt_pcurve_deviation(shape.get(), pcurve.get(), image.get(), &out));
    return out;
}

/** Feet on a face, and where on it they are. */
struct face_feet {
    std::vector<fpt_foot_point> feet;
    std::vector<fpt_face_place> places;
};

/** A surface bounded by loops of pcurves: owner of an fpt_face. */
class face {
public:
    /** As fpt_face_new: the pcurves of each loop in order; surface and pcurves may go before the face does. */
    face(const surface &shape, span<const std::vector<const curve *>> loops, const fpt_face_options &options = face_options())
        : handle_(make(shape, loops, options)) {}

    /** Takes a handle over. */
    explicit face(fpt_face *handle) noexcept : handle_(handle) {}

    /** The handle, still owned here. */
    const fpt_face *get() const noexcept { return handle_.get(); }
    /** The handle, owned by the caller from now on. */
    fpt_face *release() noexcept { return handle_.release(); }

    /** On which side of the edges places u,v are. */
    std::vector<fpt_face_place> classify(span<const double> uv, const fpt_query_options &options = query_options()) const {
        detail::require(uv.size() % 2 == 0, "uv: the length is not even");
        std::vector<fpt_face_place> out(uv.size() / 2);
        check(fpt_face_classify(get(), uv.data(), out.size(), &options, out.data()));
        return out;
    }
    /** One record per query point, x,y,z each, and where on the face it is. */
    face_feet closest(span<const double> points, const fpt_query_options &options = query_options()) const {
        const std::size_t count = detail::point_count(points, options);
        face_feet out{std::vector<fpt_foot_point>(count), std::vector<fpt_face_place>(count)};
        check(fpt_face_closest(get(), points.data(), count, &options, out.feet.data(), out.places.data()));
        return out;
    }
    /** All parameters of the face within a tolerance of a point; 0: the default. */
    foot_set preimage(const point &query, double tolerance = 0, const fpt_query_options &options = query_options()) const {
        return detail::set([&](fpt_foot_set **out) {
            return fpt_face_preimage(get(), query.data(), tolerance, &options, out);
        });
    }

private:
    struct deleter {
        void operator()(fpt_face *handle) const noexcept { fpt_face_free(handle); }
    };

    static fpt_face *make(const surface &shape, span<const std::vector<const curve *>> loops, const fpt_face_options &options) {
        std::vector<std::size_t> counts;
        std::vector<const fpt_curve *> pcurves;
        for (const std::vector<const curve *> &loop : loops) {
            counts.push_back(loop.size());
            for (const curve *pcurve : loop) pcurves.push_back(pcurve == nullptr ? nullptr : pcurve->get());
        }
        fpt_face_data data{};
        data.struct_size = sizeof data;
        data.surface = shape.get();
        data.loop_count = counts.size();
        data.coedge_counts = counts.data();
        data.pcurves = pcurves.data();
        fpt_face *out = nullptr;
        check(fpt_face_new(&data, &options, &out));
        return out;
    }

    std::unique_ptr<fpt_face, deleter> handle_;
};

/** fpt_weights_options that begin as the defaults. */
struct weights_options : fpt_weights_options {
    weights_options() noexcept : fpt_weights_options() {
        fpt_weights_options_init(this, sizeof(fpt_weights_options));
    }
};

/** A wished distance of a shape from one of its poles. */
struct weights_wish {
    std::size_t pole;
    double distance;
};

/** What a method for weights found: owner of an fpt_weights_report. */
class weights_report {
public:
    /** Takes a handle over. */
    explicit weights_report(fpt_weights_report *handle) noexcept : handle_(handle) {}

    /** As fpt_weights_general. */
    static weights_report general(const curve &shape, span<const double> lambdas,
                                  const fpt_weights_options &options = weights_options()) {
        fpt_weights_report *out = nullptr;
        check(fpt_weights_general(shape.get(), lambdas.data(), lambdas.size(), &options, &out));
        return weights_report(out);
    }
    /** As fpt_weights_interpolated. */
    static weights_report interpolated(const curve &shape, double first_distance, double last_distance,
                                       const fpt_weights_options &options = weights_options()) {
        fpt_weights_report *out = nullptr;
        check(fpt_weights_interpolated(shape.get(), first_distance, last_distance, &options, &out));
        return weights_report(out);
    }
    /** As fpt_weights_network. */
    static weights_report network(const curve &shape, span<const weights_wish> wishes, double min_distance,
                                  double max_distance, const fpt_weights_options &options = weights_options()) {
        const split list(wishes);
        fpt_weights_report *out = nullptr;
        check(fpt_weights_network(shape.get(), list.poles.data(), list.distances.data(), wishes.size(), min_distance,
                                  max_distance, &options, &out));
        return weights_report(out);
    }
    /** As fpt_weights_refine_curve. */
    static weights_report refine(const curve &shape, span<const weights_wish> wishes,
                                 span<const fpt_weights_constraint> constraints = {},
                                 const fpt_weights_options &options = weights_options()) {
        return refined(fpt_weights_refine_curve, shape.get(), wishes, constraints, options);
    }
    /** As fpt_weights_refine_surface. */
    static weights_report refine(const surface &shape, span<const weights_wish> wishes,
                                 span<const fpt_weights_constraint> constraints = {},
                                 const fpt_weights_options &options = weights_options()) {
        return refined(fpt_weights_refine_surface, shape.get(), wishes, constraints, options);
    }

    /** The handle, still owned here. */
    const fpt_weights_report *get() const noexcept { return handle_.get(); }
    /** The handle, owned by the caller from now on. */
    fpt_weights_report *release() noexcept { return handle_.release(); }

    /** Poles. */
    std::size_t size() const { return detail::value(fpt_weights_report_pole_count, get()); }
    /** A pole's part; an index beyond the size is thrown. */
    fpt_weights_pole operator[](std::size_t index) const {
        fpt_weights_pole out;
        check(fpt_weights_report_pole(get(), index, &out));
        return out;
    }
    std::vector<double> weights() const { return detail::vector(fpt_weights_report_weights, get(), size()); }
    fpt_weights_outcome constraint(std::size_t index) const {
        fpt_weights_outcome out;
        check(fpt_weights_report_constraint(get(), index, &out));
        return out;
    }
    fpt_weights_summary summary() const { return detail::value(fpt_weights_report_summary, get()); }
    /** Whether every wish and every constraint is met. */
    bool is_met() const { return summary().is_met == 1; }
    /** The curve with the weights found; thrown for a report of a surface. */
    curve as_curve() const { return curve(detail::value(fpt_weights_report_curve, get())); }
    /** The surface with the weights found; thrown for a report of a curve. */
    surface as_surface() const { return surface(detail::value(fpt_weights_report_surface, get())); }

private:
    struct deleter {
        void operator()(fpt_weights_report *handle) const noexcept { fpt_weights_report_free(handle); }
    };

    /** Wishes as the two arrays of C. */
    struct split {
        explicit split(span<const weights_wish> wishes) {
            for (const weights_wish &wish : wishes) {
                poles.push_back(wish.pole);
                distances.push_back(wish.distance);
            }
        }
        std::vector<std::size_t> poles;
        std::vector<double> distances;
    };

    template <class Call, class Shape>
    static weights_report refined(Call call, const Shape *shape, span<const weights_wish> wishes,
                                  span<const fpt_weights_constraint> constraints,
                                  const fpt_weights_options &options) {
        const split list(wishes);
        fpt_weights_report *out = nullptr;
        check(call(shape, list.poles.data(), list.distances.data(), wishes.size(), constraints.data(),
                   constraints.size(), &options, &out));
        return weights_report(out);
    }

    std::unique_ptr<fpt_weights_report, deleter> handle_;
};

/** A weight of a pole and the nearest point of the curve with it. */
struct weights_edit {
    double weight;
    fpt_foot_point foot;
};

/** As fpt_weights_move_point. */
inline double move_point(const curve &shape, double u, std::size_t pole, double distance) {
    double out = 0;
    check(fpt_weights_move_point(shape.get(), u, pole, distance, &out));
    return out;
}
/** As fpt_weights_through_point; tolerance 0: the default. */
inline weights_edit weight_through_point(const curve &shape, std::size_t pole, const point &target, double tolerance = 0) {
    weights_edit out{};
    check(fpt_weights_through_point(shape.get(), pole, target.data(), tolerance, &out.weight, &out.foot));
    return out;
}
/** As fpt_weights_conic: three poles x,y,z each. */
inline fpt_weights_conic_shape conic(const std::array<double, 9> &poles, const std::array<double, 3> &weights) {
    fpt_weights_conic_shape out{};
    check(fpt_weights_conic(poles.data(), weights.data(), &out));
    return out;
}
/** As fpt_weights_of_rho. */
inline double weight_of_rho(double rho) {
    double out = 0;
    check(fpt_weights_of_rho(rho, &out));
    return out;
}
/** As fpt_weights_of_eccentricity: none, one or two weights. */
inline std::vector<double> weights_of_eccentricity(const std::array<double, 9> &poles, double eccentricity) {
    std::vector<double> out(2);
    std::size_t count = 0;
    check(fpt_weights_of_eccentricity(poles.data(), eccentricity, out.data(), &count));
    out.resize(count);
    return out;
}
/** As fpt_weights_normalise; unit is a value of fpt_weights_unit. */
inline std::vector<double> normalised_weights(span<const double> weights, std::uint32_t unit) {
    std::vector<double> out(weights.size());
    check(fpt_weights_normalise(weights.data(), weights.size(), unit, out.data()));
    return out;
}
/** As fpt_weights_bound. */
inline std::vector<double> bounded_weights(span<const double> weights, double ratio) {
    std::vector<double> out(weights.size());
    check(fpt_weights_bound(weights.data(), weights.size(), ratio, out.data()));
    return out;
}
/** As fpt_weights_standard_form. */
inline curve standard_form(const curve &shape) { return curve(detail::value(fpt_weights_standard_form, shape.get())); }
/** As fpt_weights_positive_form: wx,wy,wz,w a pole. */
inline curve positive_form(std::size_t degree, span<const double> knots, span<const double> homogeneous) {
    const std::size_t count = detail::pole_count(knots, degree, "knots: too few for the degree");
    detail::require(homogeneous.size() == 4 * count, "poles: need wx,wy,wz,w for each pole");
    fpt_curve *out = nullptr;
    check(fpt_weights_positive_form(degree, count, knots.data(), homogeneous.data(), &out));
    return curve(out);
}

/** u,v of a place in a domain. */
using parameters = std::array<double, 2>;

/** A monotone function of one parameter with its inverse: owner of an fpt_relation. */
class relation {
public:
    /** Takes a handle over. */
    explicit relation(fpt_relation *handle) noexcept : handle_(handle) {}

    /** As fpt_relation_linear. */
    static relation linear(const parameters &from, const parameters &to) {
        fpt_relation *out = nullptr;
        check(fpt_relation_linear(from.data(), to.data(), &out));
        return relation(out);
    }
    /** As fpt_relation_circle. */
    static relation circle(std::uint32_t arcs, double sweep, const parameters &from, const parameters &to) {
        fpt_relation *out = nullptr;
        check(fpt_relation_circle(arcs, sweep, from.data(), to.data(), &out));
        return relation(out);
    }
    /** As fpt_relation_through. */
    static relation through(span<const double> places, span<const double> values) {
        detail::require(places.size() == values.size(), "values: need one per place");
        fpt_relation *out = nullptr;
        check(fpt_relation_through(places.data(), values.data(), places.size(), &out));
        return relation(out);
    }
    /** As fpt_relation_piecewise. */
    static relation piecewise(span<const fpt_relation *const> pieces) {
        fpt_relation *out = nullptr;
        check(fpt_relation_piecewise(pieces.data(), pieces.size(), &out));
        return relation(out);
    }
    /** A function and its inverse; what they throw is a value that is no number. */
    static relation from_function(std::function<double(double)> forward, std::function<double(double)> backward,
                                  const parameters &domain) {
        using pair = std::pair<std::function<double(double)>, std::function<double(double)>>;
        auto both = std::make_unique<pair>(std::move(forward), std::move(backward));
        fpt_relation_callback data{};
        data.struct_size = sizeof data;
        data.forward = [](void *user, double x) { return valued(static_cast<pair *>(user)->first, x); };
        data.backward = [](void *user, double y) { return valued(static_cast<pair *>(user)->second, y); };
        data.user = both.get();
        data.release = detail::released<pair>;
        data.domain[0] = domain[0];
        data.domain[1] = domain[1];
        fpt_relation *out = nullptr;
        check(fpt_relation_from_callback(&data, &out));
        both.release();
        return relation(out);
    }

    const fpt_relation *get() const noexcept { return handle_.get(); }
    fpt_relation *release() noexcept { return handle_.release(); }

    relation inverse() const {
        fpt_relation *out = nullptr;
        check(fpt_relation_inverse(get(), &out));
        return relation(out);
    }
    relation then(const relation &next) const {
        fpt_relation *out = nullptr;
        check(fpt_relation_then(get(), next.get(), &out));
        return relation(out);
    }
    /** First and last place, and the values there. */
    std::pair<parameters, parameters> domain() const {
        std::pair<parameters, parameters> out{};
        check(fpt_relation_domain(get(), out.first.data(), out.second.data()));
        return out;
    }
    double operator()(double place) const {
        double out = 0;
        check(fpt_relation_apply(get(), &place, 1, &out));
        return out;
    }
    std::vector<double> operator()(span<const double> places) const {
        std::vector<double> out(places.size());
        check(fpt_relation_apply(get(), places.data(), places.size(), out.data()));
        return out;
    }

private:
    struct deleter {
        void operator()(fpt_relation *handle) const noexcept { fpt_relation_free(handle); }
    };

    static double valued(const std::function<double(double)> &function, double x) noexcept {
        try {
            return function(x);
        } catch (...) {
            return std::numeric_limits<double>::quiet_NaN();
        }
    }

    std::unique_ptr<fpt_relation, deleter> handle_;
};

/** A change of both parameters: owner of an fpt_transform. */
class transform {
public:
    /** Takes a handle over. */
    explicit transform(fpt_transform *handle) noexcept : handle_(handle) {}
    /** As fpt_transform_new. */
    transform(const relation &u, const relation &v, bool swap = false) {
        fpt_transform *out = nullptr;
        check(fpt_transform_new(u.get(), v.get(), swap, &out));
        handle_.reset(out);
    }

    const fpt_transform *get() const noexcept { return handle_.get(); }
    fpt_transform *release() noexcept { return handle_.release(); }

    transform inverse() const {
        fpt_transform *out = nullptr;
        check(fpt_transform_inverse(get(), &out));
        return transform(out);
    }
    transform then(const transform &next) const {
        fpt_transform *out = nullptr;
        check(fpt_transform_then(get(), next.get(), &out));
        return transform(out);
    }
    /** u0, u1, v0, v1. */
    std::array<double, 4> domain() const { return bounds().domain; }
    std::array<double, 4> image() const { return bounds().image; }
    /** Whether loops keep their direction. */
    bool keeps_direction() const { return bounds().keeps != 0; }
    parameters operator()(const parameters &uv) const {
        parameters out{};
        check(fpt_transform_apply(get(), uv.data(), 1, out.data()));
        return out;
    }

private:
    struct deleter {
        void operator()(fpt_transform *handle) const noexcept { fpt_transform_free(handle); }
    };
    struct all {
        std::array<double, 4> domain, image;
        std::int32_t keeps;
    };

    all bounds() const {
        all out{};
        check(fpt_transform_domain(get(), out.domain.data(), out.image.data(), &out.keeps));
        return out;
    }

    std::unique_ptr<fpt_transform, deleter> handle_;
};

/** Circle forms of u and v, as fpt_support_spline has them. */
using circle_forms = std::array<std::uint32_t, 2>;

/** An arc with its angle as parameter, as fpt_curve_arc_by_angle. */
inline curve arc_by_angle(const point &center, const point &first, const point &second, const std::array<double, 2> &angles) {
    fpt_curve *out = nullptr;
    check(fpt_curve_arc_by_angle(center.data(), first.data(), second.data(), angles.data(), &out));
    return curve(out);
}

/** fpt_elementary_data with the coordinate axes. */
struct elementary_data : fpt_elementary_data {
    explicit elementary_data(fpt_elementary_kind kind, const std::array<double, 4> &domain) noexcept
        : fpt_elementary_data() {
        this->struct_size = sizeof(fpt_elementary_data);
        this->kind = kind;
        for (int k = 0; k < 4; k++) this->domain[k] = domain[k];
        this->x[0] = this->y[1] = this->z[2] = 1;
    }
};

/** The surface under a face: owner of an fpt_support. */
class support {
public:
    /** Takes a handle over. */
    explicit support(fpt_support *handle) noexcept : handle_(handle) {}
    explicit support(const surface &shape) {
        fpt_support *out = nullptr;
        check(fpt_support_new(shape.get(), &out));
        handle_.reset(out);
    }
    explicit support(const fpt_elementary_data &data) {
        fpt_support *out = nullptr;
        check(fpt_support_elementary(&data, &out));
        handle_.reset(out);
    }

    const fpt_support *get() const noexcept { return handle_.get(); }
    fpt_support *release() noexcept { return handle_.release(); }

    std::array<double, 4> domain() const { return detail::array<4>(fpt_support_domain, get()); }
    point evaluate(const parameters &uv) const {
        point out{};
        check(fpt_support_evaluate(get(), uv.data(), 1, out.data()));
        return out;
    }
    /** The NURBS form; with no forms arcs of at most a quarter turn. */
    surface spline() const { return spline_in(nullptr); }
    surface spline(const circle_forms &arcs) const { return spline_in(arcs.data()); }
    transform spline_transform() const { return transform_in(nullptr); }
    transform spline_transform(const circle_forms &arcs) const { return transform_in(arcs.data()); }
    /** As fpt_support_match. */
    transform match(const support &to, double tolerance = 0) const {
        fpt_transform *out = nullptr;
        check(fpt_support_match(get(), to.get(), tolerance, &out));
        return transform(out);
    }
    /** As fpt_support_match_many: u,v of each place. */
    std::vector<fpt_foot_point> match(const support &to, span<const double> uv, double tolerance = 0,
                                      std::uint32_t threads = 0) const {
        detail::require(uv.size() % 2 == 0, "uv: the length is odd");
        std::vector<fpt_foot_point> out(uv.size() / 2);
        check(fpt_support_match_many(get(), to.get(), tolerance, uv.data(), out.size(), threads, out.data()));
        return out;
    }

private:
    struct deleter {
        void operator()(fpt_support *handle) const noexcept { fpt_support_free(handle); }
    };

    surface spline_in(const std::uint32_t *arcs) const {
        fpt_surface *out = nullptr;
        check(fpt_support_spline(get(), arcs, &out));
        return surface(out);
    }
    transform transform_in(const std::uint32_t *arcs) const {
        fpt_transform *out = nullptr;
        check(fpt_support_spline_transform(get(), arcs, &out));
        return transform(out);
    }

    std::unique_ptr<fpt_support, deleter> handle_;
};

/** fpt_change_options that begin as the defaults. */
struct change_options : fpt_change_options {
    change_options() noexcept : fpt_change_options() {
        fpt_change_options_init(this, sizeof(fpt_change_options));
    }
};

/** What fpt_trim_report_new finds. */
struct trim_report {
    fpt_trim_summary summary;
    std::vector<fpt_trim_finding> findings;
};

/** A trimmed surface: owner of an fpt_trim. Calls that change a face write how well to `summary` when it is given. */
class trimmed_surface {
public:
    /** Takes a handle over. */
    explicit trimmed_surface(fpt_trim *handle) noexcept : handle_(handle) {}
    explicit trimmed_surface(const fpt_trim_data &data) {
        fpt_trim *out = nullptr;
        check(fpt_trim_new(&data, &out));
        handle_.reset(out);
    }
    /** As fpt_trim_whole. */
    explicit trimmed_surface(const support &shape) {
        fpt_trim *out = nullptr;
        check(fpt_trim_whole(shape.get(), &out));
        handle_.reset(out);
    }
    /** As fpt_trim_from_json. */
    static trimmed_surface from_json(const std::string &text) {
        fpt_trim *out = nullptr;
        check(fpt_trim_from_json(text.data(), text.size(), &out));
        return trimmed_surface(out);
    }

    const fpt_trim *get() const noexcept { return handle_.get(); }
    fpt_trim *release() noexcept { return handle_.release(); }

    /** Prepared for point queries, as fpt_face_of_trim. */
    face prepared(const fpt_face_options &options = face_options()) const {
        fpt_face *out = nullptr;
        check(fpt_face_of_trim(get(), &options, &out));
        return face(out);
    }

    footpoint::support support() const {
        fpt_support *out = nullptr;
        check(fpt_trim_support(get(), &out));
        return footpoint::support(out);
    }
    std::size_t edge_count() const { return counts().edges; }
    std::size_t loop_count() const { return counts().loops; }
    bool is_flipped() const { return counts().flipped != 0; }
    std::size_t coedge_count(std::size_t loop) const { return loop_of(loop).second; }
    bool is_inner(std::size_t loop) const { return loop_of(loop).first != 0; }
    /** As fpt_trim_coedge. */
    fpt_coedge_data coedge(std::size_t loop, std::size_t index) const {
        fpt_coedge_data out;
        check(fpt_trim_coedge(get(), loop, index, &out, nullptr));
        return out;
    }
    /** u,v of the points of a polyline. */
    std::vector<double> points(std::size_t loop, std::size_t index) const {
        std::vector<double> out(2 * coedge(loop, index).point_count);
        check(fpt_trim_coedge_points(get(), loop, index, out.size() / 2, out.data(), nullptr));
        return out;
    }
    /** The spline of a coedge. */
    curve pcurve(std::size_t loop, std::size_t index) const {
        fpt_curve *out = nullptr;
        check(fpt_trim_coedge_curve(get(), loop, index, &out));
        return curve(out);
    }
    /** The image of a coedge at a share of its domain. */
    point evaluate(std::size_t loop, std::size_t index, double share) const {
        point out{};
        check(fpt_trim_coedge_evaluate(get(), loop, index, &share, 1, nullptr, out.data(), nullptr));
        return out;
    }
    /** Where an edge begins, or the point that it is. */
    point edge_point(std::size_t index) const {
        fpt_curve *handle = nullptr;
        std::uint32_t reversed = 0;
        point out{};
        check(fpt_trim_edge(get(), index, &handle, out.data(), &reversed));
        fpt_curve_free(handle);
        return out;
    }

    trimmed_surface change(const transform &by, const footpoint::support &to,
                           const fpt_change_options &options = change_options(),
                           fpt_change_summary *summary = nullptr) const {
        return made([&](fpt_trim **out) {
            return fpt_trim_change(get(), by.get(), to.get(), &options, out, summary);
        });
    }
    trimmed_surface reparametrise(const transform &by, const fpt_change_options &options = change_options(),
                                  fpt_change_summary *summary = nullptr) const {
        return made([&](fpt_trim **out) {
            return fpt_trim_reparametrise(get(), by.get(), &options, out, summary);
        });
    }
    trimmed_surface to_nurbs(const circle_forms &arcs, const fpt_change_options &options = change_options(),
                             fpt_change_summary *summary = nullptr) const {
        return made([&](fpt_trim **out) {
            return fpt_trim_to_nurbs(get(), arcs.data(), &options, out, summary);
        });
    }
    trimmed_surface to_elementary(const footpoint::support &to, const circle_forms &arcs,
                                  const fpt_change_options &options = change_options(),
                                  fpt_change_summary *summary = nullptr) const {
        return made([&](fpt_trim **out) {
            return fpt_trim_to_elementary(get(), to.get(), arcs.data(), &options, out, summary);
        });
    }
    trimmed_surface follow(const footpoint::support &to, const fpt_change_options &options = change_options(),
                           fpt_change_summary *summary = nullptr) const {
        return made([&](fpt_trim **out) { return fpt_trim_follow(get(), to.get(), &options, out, summary); });
    }
    /** direction: 0 in u, 1 in v. */
    trimmed_surface merge(const trimmed_surface &next, std::uint32_t direction, const footpoint::support &whole,
                          const fpt_change_options &options = change_options()) const {
        return made([&](fpt_trim **out) {
            return fpt_trim_merge(get(), next.get(), direction, whole.get(), &options, out);
        });
    }

    trim_report report(double tolerance = 0) const {
        fpt_trim_report *handle = nullptr;
        check(fpt_trim_report_new(get(), tolerance, &handle));
        const std::unique_ptr<fpt_trim_report, void (*)(fpt_trim_report *)> owner(handle, fpt_trim_report_free);
        trim_report out{};
        check(fpt_trim_report_summary(handle, &out.summary));
        out.findings.resize(out.summary.finding_count);
        for (std::size_t i = 0; i < out.findings.size(); i++) check(fpt_trim_report_get(handle, i, &out.findings[i]));
        return out;
    }
    std::string json() const {
        return text([&](std::size_t capacity, char *out, std::size_t *length) {
            return fpt_trim_to_json(get(), capacity, out, length);
        });
    }
    /** A picture of this face alone, as SVG text. */
    std::string picture(const std::string &title = std::string()) const {
        const fpt_trim *const list[] = {get()};
        const char *const titles[] = {title.c_str()};
        return text([&](std::size_t capacity, char *out, std::size_t *length) {
            return fpt_trim_picture(list, titles, 1, nullptr, capacity, out, length);
        });
    }

private:
    struct deleter {
        void operator()(fpt_trim *handle) const noexcept { fpt_trim_free(handle); }
    };
    struct numbers {
        std::size_t edges, loops;
        std::uint32_t flipped;
    };

    numbers counts() const {
        numbers out{};
        check(fpt_trim_counts(get(), &out.edges, &out.loops, &out.flipped));
        return out;
    }
    std::pair<std::uint32_t, std::size_t> loop_of(std::size_t index) const {
        std::pair<std::uint32_t, std::size_t> out{};
        check(fpt_trim_loop(get(), index, &out.first, &out.second));
        return out;
    }
    template <class Call>
    static trimmed_surface made(Call call) {
        fpt_trim *out = nullptr;
        check(call(&out));
        return trimmed_surface(out);
    }
    template <class Call>
    static std::string text(Call call) {
        std::size_t length = 0;
        check(call(0, nullptr, &length));
        std::string out(length + 1, '\0');
        check(call(out.size(), out.data(), &length));
        out.resize(length);
        return out;
    }

    std::unique_ptr<fpt_trim, deleter> handle_;
};

/** Operations that make new shapes; `operate::bounded` is a shape and a proven error. Directions are FPT_DIRECTION_U and FPT_DIRECTION_V. */
namespace operate {

template <class Shape>
struct bounded {
    Shape shape;
    /** No point is farther from the old one at the same parameters. */
    double error;
};

/** The curve that a call makes, given room for a handle. */
template <class Call>
curve make_curve(Call call) {
    fpt_curve *out = nullptr;
    check(call(&out));
    return curve(out);
}

template <class Call>
surface make_surface(Call call) {
    fpt_surface *out = nullptr;
    check(call(&out));
    return surface(out);
}

/** The curve and the error that a call makes. */
template <class Call>
bounded<curve> bound_curve(Call call) {
    double error = 0;
    fpt_curve *out = nullptr;
    check(call(&error, &out));
    return {curve(out), error};
}

template <class Call>
bounded<surface> bound_surface(Call call) {
    double error = 0;
    fpt_surface *out = nullptr;
    check(call(&error, &out));
    return {surface(out), error};
}

inline curve refine(const curve &c, span<const double> values) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_refine(c.get(), values.data(), values.size(), out); });
}
inline bounded<curve> remove_knot(const curve &c, double u, std::size_t times = 1) {
    return bound_curve([&](double *error, fpt_curve **out) { return fpt_curve_remove_knot(c.get(), u, times, error, out); });
}
inline bounded<curve> simplify(const curve &c, double tolerance) {
    return bound_curve([&](double *error, fpt_curve **out) { return fpt_curve_simplify(c.get(), tolerance, error, out); });
}
inline curve part(const curve &c, double start, double end) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_part(c.get(), start, end, out); });
}
inline std::pair<curve, curve> split(const curve &c, double u) {
    fpt_curve *before = nullptr, *behind = nullptr;
    check(fpt_curve_split(c.get(), u, &before, &behind));
    return {curve(before), curve(behind)};
}
inline curve clamp(const curve &c) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_clamp(c.get(), out); });
}
inline bounded<curve> unclamp(const curve &c) {
    return bound_curve([&](double *error, fpt_curve **out) { return fpt_curve_unclamp(c.get(), error, out); });
}
inline bounded<curve> periodic(const curve &c, double tolerance) {
    return bound_curve([&](double *error, fpt_curve **out) { return fpt_curve_periodic(c.get(), tolerance, error, out); });
}
inline curve elevate(const curve &c, std::size_t by = 1) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_elevate(c.get(), by, out); });
}
inline bounded<curve> reduce(const curve &c) {
    return bound_curve([&](double *error, fpt_curve **out) { return fpt_curve_reduce(c.get(), error, out); });
}
inline curve reverse(const curve &c) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_reverse(c.get(), out); });
}
inline curve with_domain(const curve &c, double start, double end) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_with_domain(c.get(), start, end, out); });
}
inline curve reparametrise(const curve &c, double speed) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_reparametrise(c.get(), speed, out); });
}
inline curve affine(const curve &c, const std::array<double, 12> &matrix) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_affine(c.get(), matrix.data(), out); });
}
inline curve projective(const curve &c, const std::array<double, 16> &matrix) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_projective(c.get(), matrix.data(), out); });
}
inline curve derivative(const curve &c) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_derivative(c.get(), out); });
}
inline curve bezier_form(const curve &c) {
    return make_curve([&](fpt_curve **out) { return fpt_curve_bezier_form(c.get(), out); });
}
inline fpt_difference difference(const curve &a, const curve &b) {
    fpt_difference out{};
    check(fpt_curve_difference(a.get(), b.get(), &out));
    return out;
}
inline bounded<curve> join(const std::vector<const curve *> &curves, double tolerance) {
    std::vector<const fpt_curve *> list;
    for (const curve *c : curves) list.push_back(c->get());
    return bound_curve([&](double *error, fpt_curve **out) { return fpt_curve_join(list.data(), list.size(), tolerance, error, out); });
}
inline std::vector<curve> make_compatible(const std::vector<const curve *> &curves) {
    std::vector<const fpt_curve *> list;
    for (const curve *c : curves) list.push_back(c->get());
    std::vector<fpt_curve *> out(list.size());
    check(fpt_curve_make_compatible(list.data(), list.size(), out.data()));
    std::vector<curve> owned;
    owned.reserve(out.size());
    for (fpt_curve *c : out) owned.emplace_back(c);
    return owned;
}
inline std::vector<curve> make_compatible(std::initializer_list<const curve *> curves) {
    return make_compatible(std::vector<const curve *>(curves));
}
inline fpt_curve_frame_record frame(const curve &c, double u, std::int32_t side = 1) {
    fpt_curve_frame_record out{};
    check(fpt_curve_frame(c.get(), u, side, &out));
    return out;
}
inline std::vector<fpt_joint> continuity(const curve &c, double tolerance = 1e-9) {
    std::vector<fpt_joint> out(c.pole_count() + c.degree() + 1);
    std::size_t count = 0;
    check(fpt_curve_continuity(c.get(), tolerance, out.size(), out.data(), &count));
    out.resize(count);
    return out;
}

inline surface refine(const surface &s, std::uint32_t direction, span<const double> values) {
    return make_surface([&](fpt_surface **out) {
        return fpt_surface_refine(s.get(), direction, values.data(), values.size(), out);
    });
}
inline bounded<surface> remove_knot(const surface &s, std::uint32_t direction, double value, std::size_t times = 1) {
    return bound_surface([&](double *error, fpt_surface **out) {
        return fpt_surface_remove_knot(s.get(), direction, value, times, error, out);
    });
}
inline bounded<surface> simplify(const surface &s, double tolerance) {
    return bound_surface([&](double *error, fpt_surface **out) { return fpt_surface_simplify(s.get(), tolerance, error, out); });
}
inline surface part(const surface &s, const std::array<double, 4> &domain) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_part(s.get(), domain.data(), out); });
}
inline surface clamp(const surface &s) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_clamp(s.get(), out); });
}
inline bounded<surface> periodic(const surface &s, std::uint32_t direction, double tolerance) {
    return bound_surface([&](double *error, fpt_surface **out) {
        return fpt_surface_periodic(s.get(), direction, tolerance, error, out);
    });
}
inline surface elevate(const surface &s, std::uint32_t direction, std::size_t by = 1) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_elevate(s.get(), direction, by, out); });
}
inline bounded<surface> reduce(const surface &s, std::uint32_t direction) {
    return bound_surface([&](double *error, fpt_surface **out) { return fpt_surface_reduce(s.get(), direction, error, out); });
}
inline surface reverse(const surface &s, std::uint32_t direction) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_reverse(s.get(), direction, out); });
}
inline surface swap(const surface &s) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_swap(s.get(), out); });
}
inline surface derivative(const surface &s, std::uint32_t direction) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_derivative(s.get(), direction, out); });
}
inline curve isocurve(const surface &s, std::uint32_t direction, double at) {
    return make_curve([&](fpt_curve **out) { return fpt_surface_isocurve(s.get(), direction, at, out); });
}
inline fpt_difference difference(const surface &a, const surface &b) {
    fpt_difference out{};
    check(fpt_surface_difference(a.get(), b.get(), &out));
    return out;
}

inline bounded<surface> unclamp(const surface &s, std::uint32_t direction) {
    return bound_surface([&](double *error, fpt_surface **out) { return fpt_surface_unclamp(s.get(), direction, error, out); });
}
inline std::pair<surface, surface> split(const surface &s, std::uint32_t direction, double at) {
    fpt_surface *before = nullptr, *behind = nullptr;
    check(fpt_surface_split(s.get(), direction, at, &before, &behind));
    return {surface(before), surface(behind)};
}
inline surface with_domain(const surface &s, const std::array<double, 4> &domain) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_with_domain(s.get(), domain.data(), out); });
}
inline surface reparametrise(const surface &s, std::uint32_t direction, double speed) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_reparametrise(s.get(), direction, speed, out); });
}
inline surface affine(const surface &s, const std::array<double, 12> &matrix) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_affine(s.get(), matrix.data(), out); });
}
inline surface projective(const surface &s, const std::array<double, 16> &matrix) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_projective(s.get(), matrix.data(), out); });
}
inline surface bezier_form(const surface &s) {
    return make_surface([&](fpt_surface **out) { return fpt_surface_bezier_form(s.get(), out); });
}
inline bounded<surface> join(const std::vector<const surface *> &surfaces, std::uint32_t direction, double tolerance) {
    std::vector<const fpt_surface *> list;
    for (const surface *s : surfaces) list.push_back(s->get());
    return bound_surface([&](double *error, fpt_surface **out) {
        return fpt_surface_join(list.data(), list.size(), direction, tolerance, error, out);
    });
}
inline std::vector<surface> make_compatible(const std::vector<const surface *> &surfaces) {
    std::vector<const fpt_surface *> list;
    for (const surface *s : surfaces) list.push_back(s->get());
    std::vector<fpt_surface *> out(list.size());
    check(fpt_surface_make_compatible(list.data(), list.size(), out.data()));
    std::vector<surface> owned;
    owned.reserve(out.size());
    for (fpt_surface *s : out) owned.emplace_back(s);
    return owned;
}
inline std::vector<surface> make_compatible(std::initializer_list<const surface *> surfaces) {
    return make_compatible(std::vector<const surface *>(surfaces));
}
/** As fpt_surface_continuity. */
inline std::vector<fpt_knot_line> continuity(const surface &s, std::uint32_t direction, double tolerance = 1e-9) {
    const auto knots = direction == FPT_DIRECTION_U ? s.pole_count_u() + s.degree_u() : s.pole_count_v() + s.degree_v();
    std::vector<fpt_knot_line> out(knots + 1);
    std::size_t count = 0;
    check(fpt_surface_continuity(s.get(), direction, tolerance, out.size(), out.data(), &count));
    out.resize(count);
    return out;
}
/** As fpt_curve_power. */
inline std::vector<double> power(const curve &c) {
    std::vector<double> out(4 * (c.pole_count() - c.degree()) * (c.degree() + 1));
    std::size_t count = 0;
    check(fpt_curve_power(c.get(), out.size(), out.data(), &count));
    out.resize(count);
    return out;
}
/** As fpt_curve_from_power; the degree is that of the coefficients. */
inline curve from_power(span<const double> coefficients, double start, double end) {
    detail::require(coefficients.size() % 4 == 0 && coefficients.size() >= 8, "coefficients: four for each power, two powers at least");
    return make_curve([&](fpt_curve **out) {
        return fpt_curve_from_power(coefficients.size() / 4 - 1, start, end, coefficients.data(), out);
    });
}
/** As fpt_surface_power. */
inline std::vector<double> power(const surface &s) {
    const std::size_t u = (s.pole_count_u() - s.degree_u()) * (s.degree_u() + 1), v = (s.pole_count_v() - s.degree_v()) * (s.degree_v() + 1);
    std::vector<double> out(4 * u * v);
    std::size_t count = 0;
    check(fpt_surface_power(s.get(), out.size(), out.data(), &count));
    out.resize(count);
    return out;
}
/** As fpt_surface_from_power. */
inline surface from_power(std::size_t degree_u, std::size_t degree_v, span<const double> coefficients, const std::array<double, 4> &domain) {
    detail::require(degree_u <= 31 && degree_v <= 31 && coefficients.size() == 4 * (degree_u + 1) * (degree_v + 1),
                    "coefficients: four for each pair of powers");
    return make_surface([&](fpt_surface **out) {
        return fpt_surface_from_power(degree_u, degree_v, domain.data(), coefficients.data(), out);
    });
}

/** The arc length of a curve: owner of an fpt_arc_length. */
class arc_length {
public:
    explicit arc_length(const curve &c, double tolerance = 0) {
        fpt_arc_length *out = nullptr;
        check(fpt_arc_length_new(c.get(), tolerance, &out));
        handle_.reset(out);
    }
    fpt_estimate total() const {
        fpt_estimate out{};
        check(fpt_arc_length_total(handle_.get(), &out));
        return out;
    }
    /** The length from the start to `u`. */
    fpt_estimate at(double u) const {
        fpt_estimate out{};
        check(fpt_arc_length_at(handle_.get(), &u, 1, &out));
        return out;
    }
    /** The parameter of a length; its error is a length. */
    fpt_estimate parameter(double length) const {
        fpt_estimate out{};
        check(fpt_arc_length_parameters(handle_.get(), &length, 1, &out));
        return out;
    }

private:
    struct deleter {
        void operator()(fpt_arc_length *handle) const noexcept { fpt_arc_length_free(handle); }
    };
    std::unique_ptr<fpt_arc_length, deleter> handle_;
};

} // namespace operate

/** fpt_fit_options that begin as the defaults, with a tolerance. */
struct fit_options : fpt_fit_options {
    explicit fit_options(double wished = 0) noexcept : fpt_fit_options() {
        fpt_fit_options_init(this, sizeof(fpt_fit_options));
        tolerance = wished;
    }
};

/** fpt_sweep_options that begin as the defaults, with a tolerance. */
struct sweep_options : fpt_sweep_options {
    explicit sweep_options(double wished) noexcept : fpt_sweep_options() {
        fpt_sweep_options_init(this, sizeof(fpt_sweep_options));
        tolerance = wished;
    }
};

/** A fitted shape and the distances of the data points from it. */
template <class Shape>
struct fitted {
    Shape shape;
    fpt_fit_result result;
};

/** An offset as a spline: greatest distance from the exact one, at samples and proven. */
template <class Shape>
struct offset_spline {
    Shape shape;
    double measured, proven;
};

/** As fpt_surface_swept. */
struct swept_surface {
    surface shape;
    double error, holonomy;
};

namespace detail {
inline std::size_t point_count(span<const double> points) {
    require(points.size() % 3 == 0, "points: need x,y,z for each point");
    return points.size() / 3;
}
inline std::vector<const fpt_curve *> handles(span<const curve *const> curves) {
    std::vector<const fpt_curve *> out;
    for (const curve *each : curves) out.push_back(each ? each->get() : nullptr);
    return out;
}
inline const double *optional(span<const double> numbers, std::size_t count, const char *text) {
    require(numbers.empty() || numbers.size() == count, text);
    return numbers.empty() ? nullptr : numbers.data();
}
} // namespace detail

/** Nine numbers: origin, axis, direction of X; as fpt_curve_arc. */
using axes = std::array<double, 9>;
inline constexpr axes standard_axes{0, 0, 0, 0, 0, 1, 1, 0, 0};

/** As fpt_fit_parameters. */
inline std::vector<double> fit_parameters(span<const double> points, std::uint32_t spacing = FPT_SPACING_CHORDAL) {
    std::vector<double> out(detail::point_count(points));
    check(fpt_fit_parameters(points.data(), out.size(), spacing, out.data()));
    return out;
}
/** As fpt_curve_interpolate. */
inline curve interpolate(span<const double> points, span<const double> parameters = {},
                         const fpt_fit_options &options = fit_options()) {
    const std::size_t count = detail::point_count(points);
    const std::size_t needed = count + (options.condition == FPT_FIT_PERIODIC ? 1 : 0);
    fpt_curve *out = nullptr;
    check(fpt_curve_interpolate(points.data(), count, detail::optional(parameters, needed, "parameters: one a point, periodic one more"),
                                &options, &out));
    return curve(out);
}
/** As fpt_curve_least_squares. */
inline fitted<curve> least_squares(std::size_t degree, span<const double> knots, span<const double> parameters,
                                   span<const double> points, bool free_ends = false) {
    const std::size_t count = detail::point_count(points);
    detail::require(parameters.size() == count, "parameters: one a point");
    fpt_curve *out = nullptr;
    fpt_fit_result result;
    check(fpt_curve_least_squares(points.data(), count, parameters.data(), degree, knots.data(), knots.size(), free_ends, &out, &result));
    return {curve(out), result};
}
/** As fpt_curve_fit. */
inline fitted<curve> fit_curve(span<const double> points, const fpt_fit_options &options, span<const double> parameters = {}) {
    const std::size_t count = detail::point_count(points);
    fpt_curve *out = nullptr;
    fpt_fit_result result;
    check(fpt_curve_fit(points.data(), count, detail::optional(parameters, count, "parameters: one a point"), &options, &out, &result));
    return {curve(out), result};
}
/** As fpt_surface_interpolate; count_v is what is left of the points. */
inline surface interpolate_grid(span<const double> points, std::size_t count_u, const fpt_fit_options &options = fit_options()) {
    detail::require(count_u > 0 && detail::point_count(points) % count_u == 0, "points: not count_u equal rows");
    fpt_surface *out = nullptr;
    check(fpt_surface_interpolate(points.data(), count_u, points.size() / 3 / count_u, &options, &out));
    return surface(out);
}
/** As fpt_surface_fit_grid; count_v is what is left of the points. */
inline fitted<surface> fit_grid(span<const double> points, std::size_t count_u, const fpt_fit_options &options) {
    detail::require(count_u > 0 && detail::point_count(points) % count_u == 0, "points: not count_u equal rows");
    fpt_surface *out = nullptr;
    fpt_fit_result result;
    check(fpt_surface_fit_grid(points.data(), count_u, points.size() / 3 / count_u, &options, &out, &result));
    return {surface(out), result};
}
/** As fpt_surface_fit; parameters are u,v each. */
inline fitted<surface> fit_surface(span<const double> points, const fpt_fit_options &options, span<const double> parameters = {}) {
    const std::size_t count = detail::point_count(points);
    fpt_surface *out = nullptr;
    fpt_fit_result result;
    check(fpt_surface_fit(points.data(), count, detail::optional(parameters, 2 * count, "parameters: u,v for each point"), &options, &out,
                          &result));
    return {surface(out), result};
}

/** As fpt_curve_line. */
inline curve line(const point &start, const point &end) {
    fpt_curve *out = nullptr;
    check(fpt_curve_line(start.data(), end.data(), &out));
    return curve(out);
}
/** As fpt_curve_arc. */
inline curve ellipse_arc(const axes &place, double radius_x, double radius_y, double start, double end,
                         std::uint32_t form = FPT_ARC_QUARTERS) {
    fpt_curve *out = nullptr;
    check(fpt_curve_arc(place.data(), radius_x, radius_y, start, end, form, &out));
    return curve(out);
}
/** As fpt_curve_arc, of a circle. */
inline curve circle_arc(const axes &place, double radius, double start, double end, std::uint32_t form = FPT_ARC_QUARTERS) {
    return ellipse_arc(place, radius, radius, start, end, form);
}
/** As fpt_curve_arc_through. */
inline curve arc_through(const std::array<double, 9> &points) {
    fpt_curve *out = nullptr;
    check(fpt_curve_arc_through(points.data(), &out));
    return curve(out);
}
/** As fpt_curve_conic. */
inline curve conic_arc(const std::array<double, 9> &poles, double rho) {
    fpt_curve *out = nullptr;
    check(fpt_curve_conic(poles.data(), rho, &out));
    return curve(out);
}
/** As fpt_curve_parabola. */
inline curve parabola(const axes &place, double focal, double start, double end) {
    fpt_curve *out = nullptr;
    check(fpt_curve_parabola(place.data(), focal, start, end, &out));
    return curve(out);
}
/** As fpt_curve_hyperbola. */
inline curve hyperbola(const axes &place, double radius_x, double radius_y, double start, double end) {
    fpt_curve *out = nullptr;
    check(fpt_curve_hyperbola(place.data(), radius_x, radius_y, start, end, &out));
    return curve(out);
}
/** As fpt_surface_quadric; kind is a value of fpt_quadric_patch. */
inline surface quadric_patch(std::uint32_t kind, const axes &place, const std::array<double, 3> &semi_axes,
                       const std::array<double, 2> &angles, const std::array<double, 2> &profile,
                       std::uint32_t form = FPT_ARC_QUARTERS) {
    fpt_surface *out = nullptr;
    check(fpt_surface_quadric(kind, place.data(), semi_axes.data(), angles.data(), profile.data(), form, &out));
    return surface(out);
}
/** As fpt_surface_saddle. */
inline surface saddle(const axes &place, double radius_x, double radius_y, const std::array<double, 4> &domain) {
    fpt_surface *out = nullptr;
    check(fpt_surface_saddle(place.data(), radius_x, radius_y, domain.data(), &out));
    return surface(out);
}
/** As fpt_surface_plane. */
inline surface plane(const axes &place, const std::array<double, 4> &domain) {
    fpt_surface *out = nullptr;
    check(fpt_surface_plane(place.data(), domain.data(), &out));
    return surface(out);
}
/** As fpt_surface_torus. */
inline surface torus(const axes &place, double major, double minor, const std::array<double, 2> &angles_u,
                     const std::array<double, 2> &angles_v, std::uint32_t form = FPT_ARC_QUARTERS) {
    fpt_surface *out = nullptr;
    check(fpt_surface_torus(place.data(), major, minor, angles_u.data(), angles_v.data(), form, &out));
    return surface(out);
}
/** As fpt_surface_ruled. */
inline surface ruled(const curve &first, const curve &second) {
    fpt_surface *out = nullptr;
    check(fpt_surface_ruled(first.get(), second.get(), &out));
    return surface(out);
}
/** As fpt_surface_extruded. */
inline surface extruded(const curve &shape, const point &direction) {
    fpt_surface *out = nullptr;
    check(fpt_surface_extruded(shape.get(), direction.data(), &out));
    return surface(out);
}
/** As fpt_surface_revolved. */
inline surface revolved(const curve &shape, const point &origin, const point &axis, const std::array<double, 2> &angles,
                        std::uint32_t form = FPT_ARC_QUARTERS) {
    fpt_surface *out = nullptr;
    check(fpt_surface_revolved(shape.get(), origin.data(), axis.data(), angles.data(), form, &out));
    return surface(out);
}
/** As fpt_surface_translational. */
inline surface translational(const curve &shape, const curve &spine) {
    fpt_surface *out = nullptr;
    check(fpt_surface_translational(shape.get(), spine.get(), &out));
    return surface(out);
}
/** As fpt_surface_coons. */
inline surface coons(const std::array<const curve *, 4> &borders) {
    fpt_surface *out = nullptr;
    check(fpt_surface_coons(detail::handles(borders).data(), &out));
    return surface(out);
}
/** As fpt_surface_coons_bicubic. */
inline surface coons_bicubic(const std::array<const curve *, 4> &borders, const std::array<const curve *, 4> &slopes) {
    fpt_surface *out = nullptr;
    check(fpt_surface_coons_bicubic(detail::handles(borders).data(), detail::handles(slopes).data(), &out));
    return surface(out);
}
/** As fpt_surface_ferguson. */
inline surface ferguson(const std::array<double, 12> &points, const std::array<double, 12> &slopes_u,
                        const std::array<double, 12> &slopes_v, const std::array<double, 12> &twists = {}) {
    fpt_surface *out = nullptr;
    check(fpt_surface_ferguson(points.data(), slopes_u.data(), slopes_v.data(), twists.data(), &out));
    return surface(out);
}
/** As fpt_surface_gordon. */
inline surface gordon(span<const curve *const> curves_u, span<const double> parameters_v, span<const curve *const> curves_v,
                      span<const double> parameters_u) {
    detail::require(curves_u.size() == parameters_v.size() && curves_v.size() == parameters_u.size(), "parameters: one a curve");
    fpt_surface *out = nullptr;
    check(fpt_surface_gordon(detail::handles(curves_u).data(), parameters_v.data(), curves_u.size(), detail::handles(curves_v).data(),
                             parameters_u.data(), curves_v.size(), &out));
    return surface(out);
}
/** As fpt_surface_skinned. */
inline surface skinned(span<const curve *const> sections, std::size_t degree, span<const double> parameters = {}) {
    fpt_surface *out = nullptr;
    check(fpt_surface_skinned(detail::handles(sections).data(), sections.size(), degree,
                              detail::optional(parameters, sections.size(), "parameters: one a section"), &out));
    return surface(out);
}
/** As fpt_surface_swept. */
inline swept_surface swept(const curve &profile, const curve &spine, const fpt_sweep_options &options) {
    fpt_surface *out = nullptr;
    double error = 0, holonomy = 0;
    check(fpt_surface_swept(profile.get(), spine.get(), &options, &out, &error, &holonomy));
    return {surface(out), error, holonomy};
}
/** As fpt_curve_offset. */
inline curve offset(const curve &shape, double distance, const point &plane_normal) {
    fpt_curve *out = nullptr;
    check(fpt_curve_offset(shape.get(), distance, plane_normal.data(), &out));
    return curve(out);
}
/** As fpt_surface_offset. */
inline surface offset(const surface &shape, double distance) {
    fpt_surface *out = nullptr;
    check(fpt_surface_offset(shape.get(), distance, &out));
    return surface(out);
}
/** As fpt_curve_offset_fit. */
inline offset_spline<curve> fit_offset(const curve &shape, double distance, const point &plane_normal, std::size_t degree,
                                       double tolerance) {
    fpt_curve *out = nullptr;
    double measured = 0, proven = 0;
    check(fpt_curve_offset_fit(shape.get(), distance, plane_normal.data(), degree, tolerance, &out, &measured, &proven));
    return {curve(out), measured, proven};
}
/** As fpt_surface_offset_fit. */
inline offset_spline<surface> fit_offset(const surface &shape, double distance, std::size_t degree_u, std::size_t degree_v,
                                         double tolerance) {
    fpt_surface *out = nullptr;
    double measured = 0, proven = 0;
    check(fpt_surface_offset_fit(shape.get(), distance, degree_u, degree_v, tolerance, &out, &measured, &proven));
    return {surface(out), measured, proven};
}

/** fpt_intersect_surfaces_options that begin as the defaults. */
struct intersect_surfaces_options : fpt_intersect_surfaces_options {
    intersect_surfaces_options() noexcept : fpt_intersect_surfaces_options() {
        fpt_intersect_surfaces_options_init(this, sizeof(fpt_intersect_surfaces_options));
    }
};

/** A place on two surfaces, the distance of its two surface points, and the steps that it took. */
struct corrected {
    fpt_intersection_point place;
    double gap;
    std::uint32_t steps;
};

/** As fpt_intersect_correct: u, v of a, u, v of b. */
inline corrected correct(const surface &a, const surface &b, const std::array<double, 4> &uvst,
                         const fpt_intersect_surfaces_options &options = intersect_surfaces_options()) {
    corrected out{};
    check(fpt_intersect_correct(a.get(), b.get(), uvst.data(), &options, &out.place, &out.gap, &out.steps));
    return out;
}

/** A branch as curves in space and in both domains, and the proven error. */
struct branch_curves {
    curve space, uv, st;
    double error;
    std::size_t part_count;
};

/** All that two surfaces have in common: owner of an fpt_surface_intersection. */
class surface_intersection {
public:
    /** As fpt_intersect_surfaces; a budget that runs out gives a result that is exhausted, should_stop one that is stopped. */
    surface_intersection(const surface &a, const surface &b,
                         const fpt_intersect_surfaces_options &options = intersect_surfaces_options()) {
        fpt_surface_intersection *out = nullptr;
        const fpt_status status = fpt_intersect_surfaces(a.get(), b.get(), &options, &out);
        handle_.reset(given(out, status));
    }

    /** As fpt_intersect_trims. */
    surface_intersection(const trimmed_surface &a, const trimmed_surface &b,
                         const fpt_intersect_surfaces_options &options = intersect_surfaces_options()) {
        fpt_surface_intersection *out = nullptr;
        const fpt_status status = fpt_intersect_trims(a.get(), b.get(), &options, &out);
        handle_.reset(given(out, status));
    }

    /** As fpt_intersect_march: u, v of a, u, v of b. */
    static surface_intersection march(const surface &a, const surface &b, const std::array<double, 4> &uvst, double step = 0,
                                      const fpt_intersect_surfaces_options &options = intersect_surfaces_options()) {
        fpt_surface_intersection *out = nullptr;
        const fpt_status status = fpt_intersect_march(a.get(), b.get(), uvst.data(), step, &options, &out);
        return surface_intersection(given(out, status));
    }
    /** As fpt_intersect_bisect: u, v of a, u, v of b of each place. */
    static surface_intersection bisect(const surface &a, const surface &b, span<const std::array<double, 4>> uvst,
                                       const fpt_intersect_surfaces_options &options = intersect_surfaces_options()) {
        fpt_surface_intersection *out = nullptr;
        const double *first = uvst.size() == 0 ? nullptr : uvst.data()->data();
        const fpt_status status = fpt_intersect_bisect(a.get(), b.get(), first, uvst.size(), &options, &out);
        return surface_intersection(given(out, status));
    }

    /** The handle, still owned here. */
    const fpt_surface_intersection *get() const noexcept { return handle_.get(); }

    fpt_intersection_summary summary() const {
        fpt_intersection_summary out{};
        check(fpt_surface_intersection_summary(get(), &out));
        return out;
    }
    /** The number of branches. */
    std::size_t size() const { return summary().branch_count; }
    fpt_intersection_branch branch(std::size_t index) const {
        fpt_intersection_branch out{};
        check(fpt_surface_intersection_branch(get(), index, &out));
        return out;
    }
    std::vector<fpt_intersection_point> points(std::size_t index) const {
        std::vector<fpt_intersection_point> out(branch(index).point_count);
        check(fpt_surface_intersection_points(get(), index, out.size(), out.data()));
        return out;
    }
    fpt_intersection_contact contact(std::size_t index) const {
        fpt_intersection_contact out{};
        check(fpt_surface_intersection_contact(get(), index, &out));
        return out;
    }
    /** Ends of u, v of A, of u, v of B. */
    std::array<double, 8> overlap(std::size_t index) const {
        std::array<double, 8> out{};
        check(fpt_surface_intersection_overlap(get(), index, out.data()));
        return out;
    }
    std::array<double, 8> undecided(std::size_t index) const {
        std::array<double, 8> out{};
        check(fpt_surface_intersection_undecided(get(), index, out.data()));
        return out;
    }
    /** As fpt_surface_intersection_curves. */
    branch_curves curves(const surface &a, const surface &b, std::size_t index, double tolerance, std::size_t part = 0,
                         const fpt_intersect_surfaces_options *options = nullptr) const {
        fpt_curve *out[3] = {nullptr, nullptr, nullptr};
        std::size_t count = 0;
        double error = 0;
        check(fpt_surface_intersection_curves(get(), a.get(), b.get(), index, tolerance, part, options, &count, out, &error));
        return {curve(out[0]), curve(out[1]), curve(out[2]), error, count};
    }
    /** As fpt_surface_intersection_split. */
    std::vector<trimmed_surface> split(const trimmed_surface &face, std::uint32_t which, double tolerance,
                                       const fpt_intersect_surfaces_options *options = nullptr) const {
        std::vector<fpt_trim *> out(16);
        std::size_t count = 0;
        fpt_status status = fpt_surface_intersection_split(get(), face.get(), which, tolerance, options, out.size(), out.data(), &count);
        if (status == FPT_INVALID_ARGUMENT && count > out.size()) {
            out.resize(count);
            status = fpt_surface_intersection_split(get(), face.get(), which, tolerance, options, out.size(), out.data(), &count);
        }
        check(status);
        std::vector<trimmed_surface> parts;
        for (std::size_t i = 0; i < count; i++) parts.emplace_back(out[i]);
        return parts;
    }

private:
    explicit surface_intersection(fpt_surface_intersection *handle) noexcept : handle_(handle) {}

    /** A result that is complete, or that says that it is not. */
    static fpt_surface_intersection *given(fpt_surface_intersection *out, fpt_status status) {
        if (out == nullptr) check(status);
        return out;
    }

    struct deleter {
        void operator()(fpt_surface_intersection *handle) const noexcept { fpt_surface_intersection_free(handle); }
    };

    std::unique_ptr<fpt_surface_intersection, deleter> handle_;
};

/** fpt_fair_options that begin as the defaults, with the deviation that must be set. */
struct fair_options : fpt_fair_options {
    explicit fair_options(double length) noexcept : fpt_fair_options() {
        fpt_fair_options_init(this, sizeof(fpt_fair_options));
        deviation = length;
    }
};

/** A faired shape: owner of an fpt_fair_report. */
class fair_report {
public:
    /** Takes a handle over. */
    explicit fair_report(fpt_fair_report *handle) noexcept : handle_(handle) {}
    /** As fpt_fair_curve. */
    fair_report(const curve &shape, const fpt_fair_options &options) : handle_(made(fpt_fair_curve, shape.get(), options)) {}
    /** As fpt_fair_surface. */
    fair_report(const surface &shape, const fpt_fair_options &options)
        : handle_(made(fpt_fair_surface, shape.get(), options)) {}

    /** The handle, still owned here. */
    const fpt_fair_report *get() const noexcept { return handle_.get(); }
    /** The handle, owned by the caller from now on. */
    fpt_fair_report *release() noexcept { return handle_.release(); }

    fpt_fair_summary summary() const { return detail::value(fpt_fair_report_summary, get()); }
    /** The energy before the first step and after each. */
    std::vector<double> energies() const {
        return detail::vector(fpt_fair_report_energies, get(), static_cast<std::size_t>(summary().steps) + 1);
    }
    /** The faired curve; thrown when a surface was faired. */
    curve as_curve() const { return curve(detail::value(fpt_fair_report_curve, get())); }
    /** The faired surface; thrown when a curve was faired. */
    surface as_surface() const { return surface(detail::value(fpt_fair_report_surface, get())); }

private:
    struct deleter {
        void operator()(fpt_fair_report *handle) const noexcept { fpt_fair_report_free(handle); }
    };

    template <class Call, class Shape>
    static fpt_fair_report *made(Call call, const Shape *shape, const fpt_fair_options &options) {
        fpt_fair_report *out = nullptr;
        check(call(shape, &options, &out));
        return out;
    }

    std::unique_ptr<fpt_fair_report, deleter> handle_;
};

/** fpt_inspect_options that begin as the defaults. */
struct inspect_options : fpt_inspect_options {
    inspect_options() noexcept : fpt_inspect_options() { fpt_inspect_options_init(this, sizeof(fpt_inspect_options)); }
};

/** fpt_inspect_picture_options that begin as the defaults. */
struct picture_options : fpt_inspect_picture_options {
    picture_options() noexcept : fpt_inspect_picture_options() {
        fpt_inspect_picture_options_init(this, sizeof(fpt_inspect_picture_options));
    }
};

namespace detail {
/** The places of a set, which is released. */
inline std::vector<fpt_inspect_place> places(fpt_inspect_set *set) {
    struct deleter {
        void operator()(fpt_inspect_set *handle) const noexcept { fpt_inspect_set_free(handle); }
    };
    const std::unique_ptr<fpt_inspect_set, deleter> owner(set);
    std::vector<fpt_inspect_place> out(value(fpt_inspect_set_count, static_cast<const fpt_inspect_set *>(set)));
    for (std::size_t i = 0; i < out.size(); i++) check(fpt_inspect_set_get(set, i, &out[i]));
    return out;
}
} // namespace detail

/** As fpt_inspect_curve_range. */
inline fpt_inspect_range curvature_range(const curve &shape, const fpt_inspect_options &options = inspect_options()) {
    fpt_inspect_range out{};
    check(fpt_inspect_curve_range(shape.get(), &options, &out));
    return out;
}
/** As fpt_inspect_surface_range. */
inline fpt_inspect_range curvature_range(const surface &shape, fpt_inspect_quantity quantity = FPT_QUANTITY_SHARPEST,
                                         const fpt_inspect_options &options = inspect_options()) {
    fpt_inspect_range out{};
    check(fpt_inspect_surface_range(shape.get(), static_cast<std::uint32_t>(quantity), &options, &out));
    return out;
}
/** A range with the boxes that it excludes: kinds FPT_PLACE_UNBOUNDED and FPT_PLACE_EXCLUDED. */
struct range_with_places {
    fpt_inspect_range range{};
    std::vector<fpt_inspect_place> places;
};

/** As fpt_inspect_surface_range_places. */
inline range_with_places curvature_range_places(const surface &shape, fpt_inspect_quantity quantity = FPT_QUANTITY_SHARPEST,
                                                const fpt_inspect_options &options = inspect_options()) {
    range_with_places out;
    fpt_inspect_set *set = nullptr;
    check(fpt_inspect_surface_range_places(shape.get(), static_cast<std::uint32_t>(quantity), &options, &out.range, &set));
    out.places = detail::places(set);
    return out;
}
/** As fpt_inspect_comb. */
inline std::vector<fpt_inspect_tooth> comb(const curve &shape, span<const double> parameters) {
    std::vector<fpt_inspect_tooth> out(parameters.size());
    check(fpt_inspect_comb(shape.get(), parameters.data(), parameters.size(), out.data()));
    return out;
}
/** As fpt_inspect_curvatures: u,v of each place. */
inline std::vector<fpt_inspect_curvature> curvatures(const surface &shape, span<const double> parameters) {
    detail::require(parameters.size() % 2 == 0, "parameters: need u,v each");
    std::vector<fpt_inspect_curvature> out(parameters.size() / 2);
    check(fpt_inspect_curvatures(shape.get(), parameters.data(), out.size(), out.data()));
    return out;
}

/** As fpt_inspect_monotone_pieces. */
inline std::vector<fpt_inspect_place> monotone_pieces(const curve &shape) {
    fpt_inspect_set *out = nullptr;
    check(fpt_inspect_monotone_pieces(shape.get(), &out));
    return detail::places(out);
}
/** As fpt_inspect_inflections across the plane of the poles. */
inline std::vector<fpt_inspect_place> inflections(const curve &shape) {
    fpt_inspect_set *out = nullptr;
    check(fpt_inspect_inflections(shape.get(), nullptr, &out));
    return detail::places(out);
}
/** As fpt_inspect_inflections seen along a direction. */
inline std::vector<fpt_inspect_place> inflections(const curve &shape, const point &normal) {
    fpt_inspect_set *out = nullptr;
    check(fpt_inspect_inflections(shape.get(), normal.data(), &out));
    return detail::places(out);
}
/** As fpt_inspect_umbilics. */
inline std::vector<fpt_inspect_place> umbilics(const surface &shape, const fpt_inspect_options &options = inspect_options()) {
    fpt_inspect_set *out = nullptr;
    check(fpt_inspect_umbilics(shape.get(), &options, &out));
    return detail::places(out);
}

/** Both directions of a Hausdorff distance. */
struct hausdorff_distance {
    fpt_inspect_distance forward;
    fpt_inspect_distance backward;
};

namespace detail {
inline const fpt_curve *curve_of(const curve &shape) noexcept { return shape.get(); }
inline const fpt_curve *curve_of(const surface &) noexcept { return nullptr; }
inline const fpt_surface *surface_of(const curve &) noexcept { return nullptr; }
inline const fpt_surface *surface_of(const surface &shape) noexcept { return shape.get(); }
} // namespace detail

/** As fpt_inspect_hausdorff; each shape is a curve or a surface. */
template <class First, class Second>
hausdorff_distance hausdorff(const First &first, const Second &second, const fpt_inspect_options &options = inspect_options()) {
    hausdorff_distance out{};
    check(fpt_inspect_hausdorff(detail::curve_of(first), detail::surface_of(first), detail::curve_of(second),
                                detail::surface_of(second), &options, &out.forward, &out.backward));
    return out;
}
/** As fpt_inspect_border. */
inline fpt_inspect_continuity border(const surface &a, std::uint32_t side_a, const surface &b, std::uint32_t side_b,
                                     const fpt_inspect_options &options = inspect_options()) {
    fpt_inspect_continuity out{};
    check(fpt_inspect_border(a.get(), side_a, b.get(), side_b, &options, &out));
    return out;
}
/** As fpt_inspect_picture: red, green and blue of each pixel, row by row from above. */
inline std::vector<std::uint8_t> picture(const surface &shape, const fpt_inspect_picture_options &options = picture_options()) {
    detail::require(options.width <= 8192 && options.height <= 8192, "width, height: 1 to 8192 accepted");
    std::vector<std::uint8_t> out(std::size_t(3) * options.width * options.height);
    check(fpt_inspect_picture(shape.get(), &options, out.size(), out.data(), nullptr));
    return out;
}

/** fpt_hit_options that begin as the defaults. */
struct hit_options : fpt_hit_options {
    hit_options() noexcept : fpt_hit_options() { fpt_hit_options_init(this, sizeof(fpt_hit_options)); }
};

/** A plane or quadric: fpt_quadric with constructors. */
struct quadric : fpt_quadric {
    static quadric plane(const point &origin, const point &normal) { return made(FPT_QUADRIC_PLANE, origin, normal, 0); }
    static quadric sphere(const point &center, double radius) { return made(FPT_QUADRIC_SPHERE, center, point{}, radius); }
    static quadric cylinder(const point &origin, const point &axis, double radius) {
        return made(FPT_QUADRIC_CYLINDER, origin, axis, radius);
    }
    /** slope: radius per unit of height. */
    static quadric cone(const point &apex, const point &axis, double slope) {
        return made(FPT_QUADRIC_CONE, apex, axis, slope);
    }

private:
    static quadric made(std::uint32_t kind, const point &origin, const point &axis, double size) {
        quadric out{};
        out.kind = kind;
        out.size = size;
        for (std::size_t k = 0; k < 3; k++) {
            out.origin[k] = origin[k];
            out.axis[k] = axis[k];
        }
        return out;
    }
};

/** Where a curve meets another shape. */
struct curve_hits {
    std::vector<fpt_curve_hit> hits;
    /** Boxes u0,u1,v0,v1,w0,w1 that are undecided: more hits may lie in them. */
    std::vector<std::array<double, 6>> undecided;
    /** Whether should_stop ended the call: what was not looked at by then is undecided. */
    bool is_stopped = false;
};

/** A branch of a section. */
struct branch {
    fpt_branch head;
    /** x,y,z,u,v of each point. */
    std::vector<std::array<double, 5>> points;
};

/** Where a surface meets a plane or quadric. */
struct section {
    std::vector<branch> branches;
    std::vector<fpt_section_point> points;
    std::vector<fpt_section_region> regions;
};

namespace detail {

template <class Call>
curve_hits hits(Call call) {
    fpt_curve_hits *handle = nullptr;
    const fpt_status status = call(&handle);
    if (handle == nullptr) check(status);
    const std::unique_ptr<fpt_curve_hits, void (*)(fpt_curve_hits *)> owner(handle, fpt_curve_hits_free);
    curve_hits out;
    out.is_stopped = status == FPT_CANCELLED;
    std::size_t count = 0;
    check(fpt_curve_hits_count(handle, &count));
    out.hits.resize(count);
    for (std::size_t k = 0; k < count; k++) check(fpt_curve_hits_get(handle, k, &out.hits[k]));
    check(fpt_curve_hits_undecided_count(handle, &count));
    out.undecided.resize(count);
    for (std::size_t k = 0; k < count; k++) check(fpt_curve_hits_undecided_get(handle, k, out.undecided[k].data()));
    return out;
}

inline section read_section(const fpt_sections *all, std::size_t number) {
    section out;
    std::array<std::size_t, 3> counts{};
    check(fpt_sections_counts(all, number, counts.data()));
    out.branches.resize(counts[0]);
    out.points.resize(counts[1]);
    out.regions.resize(counts[2]);
    for (std::size_t k = 0; k < counts[0]; k++) {
        branch &one = out.branches[k];
        check(fpt_sections_branch_get(all, number, k, &one.head));
        one.points.resize(one.head.point_count);
        check(fpt_sections_branch_points(all, number, k, 5 * one.points.size(), one.points.front().data()));
    }
    for (std::size_t k = 0; k < counts[1]; k++) check(fpt_sections_point_get(all, number, k, &out.points[k]));
    for (std::size_t k = 0; k < counts[2]; k++) check(fpt_sections_region_get(all, number, k, &out.regions[k]));
    return out;
}

} // namespace detail

/** As fpt_intersect_curves. */
inline curve_hits intersect(const curve &first, const curve &second, const fpt_hit_options &options = hit_options()) {
    return detail::hits([&](fpt_curve_hits **out) { return fpt_intersect_curves(first.get(), second.get(), &options, out); });
}
/** As fpt_intersect_surface_curve. */
inline curve_hits intersect(const surface &first, const curve &second, const fpt_hit_options &options = hit_options()) {
    return detail::hits(
        [&](fpt_curve_hits **out) { return fpt_intersect_surface_curve(first.get(), second.get(), &options, out); });
}
/** As fpt_intersect_curve_quadric. */
inline curve_hits intersect(const curve &first, const fpt_quadric &second, const fpt_hit_options &options = hit_options()) {
    return detail::hits(
        [&](fpt_curve_hits **out) { return fpt_intersect_curve_quadric(first.get(), &second, &options, out); });
}
/** As fpt_intersect_surface_quadrics: one section per quadric. After should_stop, those that were not begun have all of the domain as an
 * undecided region. */
inline std::vector<section> sections(const surface &shape, span<const quadric> quadrics,
                                     const fpt_hit_options &options = hit_options()) {
    static_assert(sizeof(quadric) == sizeof(fpt_quadric), "a quadric adds nothing");
    fpt_sections *handle = nullptr;
    const fpt_status status =
        fpt_intersect_surface_quadrics(shape.get(), quadrics.data(), quadrics.size(), &options, &handle);
    if (handle == nullptr) check(status);
    const std::unique_ptr<fpt_sections, void (*)(fpt_sections *)> owner(handle, fpt_sections_free);
    std::vector<section> out;
    for (std::size_t k = 0; k < quadrics.size(); k++) out.push_back(detail::read_section(handle, k));
    return out;
}
/** As fpt_intersect_quadrics. */
inline std::vector<fpt_conic> conics(const fpt_quadric &first, const fpt_quadric &second, double tolerance) {
    std::vector<fpt_conic> out(4);
    std::size_t count = 0;
    check(fpt_intersect_quadrics(&first, &second, tolerance, out.data(), &count));
    out.resize(count);
    return out;
}

/** A surface prepared for rays: owner of an fpt_caster. */
class caster {
public:
    /** As fpt_caster_new. */
    explicit caster(const surface &shape, const fpt_hit_options &options = hit_options()) {
        fpt_caster *handle = nullptr;
        check(fpt_caster_new(shape.get(), &options, &handle));
        handle_.reset(handle);
    }
    /** The handle, still owned here. */
    const fpt_caster *get() const noexcept { return handle_.get(); }

    /** As fpt_caster_first: origins and directions as x,y,z each. */
    std::vector<fpt_ray_hit> first(span<const double> origins, span<const double> directions,
                                   const reach &part = {0, std::numeric_limits<double>::infinity()},
                                   const fpt_hit_options &options = hit_options()) const {
        std::vector<fpt_ray_hit> out(count_of(origins, directions));
        check(fpt_caster_first(get(), origins.data(), directions.data(), out.size(), part.data(), &options, out.data()));
        return out;
    }
    /** As fpt_caster_nearest: origins and directions as x,y,z each. */
    std::vector<fpt_ray_hit> nearest(span<const double> origins, span<const double> directions,
                                     const reach &part = {0, std::numeric_limits<double>::infinity()},
                                     const fpt_hit_options &options = hit_options()) const {
        std::vector<fpt_ray_hit> out(count_of(origins, directions));
        check(fpt_caster_nearest(get(), origins.data(), directions.data(), out.size(), part.data(), &options, out.data()));
        return out;
    }
    /** As fpt_caster_all: the hits of each ray; thrown when should_stop ended the call. */
    std::vector<std::vector<fpt_ray_hit>> all(span<const double> origins, span<const double> directions,
                                              const reach &part = {0, std::numeric_limits<double>::infinity()},
                                              const fpt_hit_options &options = hit_options()) const {
        const std::size_t count = count_of(origins, directions);
        fpt_ray_hits *handle = nullptr;
        const fpt_status status = fpt_caster_all(get(), origins.data(), directions.data(), count, part.data(), &options, &handle);
        const std::unique_ptr<fpt_ray_hits, void (*)(fpt_ray_hits *)> owner(handle, fpt_ray_hits_free);
        check(status);
        std::size_t total = 0;
        check(fpt_ray_hits_count(handle, &total));
        std::vector<fpt_ray_hit> hits(total);
        std::vector<std::size_t> starts(count + 1);
        check(fpt_ray_hits_get(handle, total, hits.data()));
        check(fpt_ray_hits_starts(handle, starts.size(), starts.data()));
        std::vector<std::vector<fpt_ray_hit>> out(count);
        for (std::size_t k = 0; k < count; k++)
            out[k].assign(hits.begin() + std::ptrdiff_t(starts[k]), hits.begin() + std::ptrdiff_t(starts[k + 1]));
        return out;
    }

private:
    static std::size_t count_of(span<const double> origins, span<const double> directions) {
        detail::require(origins.size() == directions.size() && origins.size() % 3 == 0,
                        "directions: need x,y,z for each origin");
        return origins.size() / 3;
    }
    struct deleter {
        void operator()(fpt_caster *handle) const noexcept { fpt_caster_free(handle); }
    };

    std::unique_ptr<fpt_caster, deleter> handle_;
};

} // namespace footpoint

#endif
