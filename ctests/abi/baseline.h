#ifndef FOOTPOINT_H
#define FOOTPOINT_H 
#include <stddef.h>
#include <stdint.h>
#define FPT_VERSION_MAJOR 0
#define FPT_VERSION_MINOR 1
#define FPT_VERSION_PATCH 0
#define FPT_VERSION (FPT_VERSION_MAJOR * 1000000 + FPT_VERSION_MINOR * 1000 + FPT_VERSION_PATCH)
#define FPT_ABI_VERSION 1
#if defined(__GNUC__) || defined(__clang__)
#define FPT_MUST_USE __attribute__((warn_unused_result))
#elif defined(_MSC_VER)
#define FPT_MUST_USE _Check_return_
#else
#define FPT_MUST_USE 
#endif
typedef enum fpt_status_code {
    FPT_OK = 0,
    FPT_NULL_ARGUMENT = 1,
    FPT_INVALID_ARGUMENT = 2,
    FPT_BUDGET_EXHAUSTED = 3,
    FPT_CANCELLED = 4,
    FPT_UNSUPPORTED = 5,
    FPT_OUT_OF_MEMORY = 6,
    FPT_INTERNAL = 99,
} fpt_status_code;
typedef enum fpt_foot_flag {
    FPT_FOOT_NOT_PROVEN = 1,
    FPT_FOOT_EDGE = 2,
    FPT_FOOT_CORNER = 4,
    FPT_FOOT_SEAM = 8,
    FPT_FOOT_COLLAPSED = 16,
    FPT_FOOT_TIE = 32,
    FPT_FOOT_CONTINUUM = 64,
    FPT_FOOT_NOT_ON_SHAPE = 128,
    FPT_FOOT_BAD_QUERY = 256,
    FPT_FOOT_HINT_USED = 512,
    FPT_FOOT_BUDGET = 1024,
    FPT_FOOT_CREASE = 2048,
} fpt_foot_flag;
typedef enum fpt_method {
    FPT_METHOD_AUTO = 0,
    FPT_METHOD_MAF = 1,
    FPT_METHOD_NEWTON = 2,
    FPT_METHOD_OSCULATING = 3,
} fpt_method;
typedef enum fpt_scope {
    FPT_SCOPE_GLOBAL = 0,
    FPT_SCOPE_LOCAL = 1,
} fpt_scope;
typedef enum fpt_member_kind {
    FPT_MEMBER_POINT = 0,
    FPT_MEMBER_ARC_U = 1,
    FPT_MEMBER_ARC_V = 2,
    FPT_MEMBER_REGION = 3,
} fpt_member_kind;
typedef enum fpt_member_nature {
    FPT_NATURE_MINIMUM = 0,
    FPT_NATURE_MAXIMUM = 1,
    FPT_NATURE_SADDLE = 2,
    FPT_NATURE_FLAT = 3,
} fpt_member_nature;
typedef enum fpt_normal_flag {
    FPT_NORMAL_AMBIGUOUS_SIDE = 1,
    FPT_NORMAL_CREASE = 2,
    FPT_NORMAL_LIMIT = 4,
    FPT_NORMAL_UNDEFINED = 8,
} fpt_normal_flag;
typedef enum fpt_path_change {
    FPT_PATH_JUMP = 1,
    FPT_PATH_SEAM_CROSSED = 2,
    FPT_PATH_THROUGH_COLLAPSED = 4,
    FPT_PATH_TIE = 8,
} fpt_path_change;
typedef enum fpt_weights_state {
    FPT_WISH_NONE = 0,
    FPT_WISH_MET = 1,
    FPT_WISH_NOT_MET = 2,
    FPT_WISH_IMPOSSIBLE = 3,
} fpt_weights_state;
typedef enum fpt_weights_flag {
    FPT_WEIGHT_ON_CHORD = 1,
    FPT_WEIGHT_LIMITED = 2,
    FPT_WEIGHT_AT_LIMIT = 4,
    FPT_WEIGHT_UNTRAINED = 8,
} fpt_weights_flag;
typedef enum fpt_weights_constraint_kind {
    FPT_CONSTRAINT_POINT_AT = 0,
    FPT_CONSTRAINT_POINT = 1,
    FPT_CONSTRAINT_TANGENT_AT = 2,
    FPT_CONSTRAINT_TANGENT_KEPT = 3,
} fpt_weights_constraint_kind;
typedef enum fpt_weights_unit {
    FPT_UNIT_FIRST = 0,
    FPT_UNIT_GREATEST = 1,
    FPT_UNIT_MIDDLE = 2,
} fpt_weights_unit;
typedef struct fpt_curve fpt_curve;
typedef struct fpt_foot_set fpt_foot_set;
typedef struct fpt_scene fpt_scene;
typedef struct fpt_surface fpt_surface;
typedef struct fpt_weights_report fpt_weights_report;
typedef int32_t fpt_status;
typedef struct fpt_query_options {
    size_t struct_size;
    double tolerance;
    double accuracy;
    uint32_t method;
    uint32_t scope;
    const double *hints;
    size_t point_stride;
    size_t hint_stride;
    double domain[4];
    uint32_t threads;
    uint32_t reserved;
    uint64_t budget;
    int (*should_stop)(void *user);
    void (*progress)(void *user, size_t done, size_t total);
    void (*trace)(void *user, size_t query, uint32_t step, double u, double v, double residual);
    void *user;
} fpt_query_options;
typedef struct fpt_curve_data {
    size_t struct_size;
    size_t degree;
    size_t pole_count;
    const double *knots;
    const double *poles;
    const double *weights;
} fpt_curve_data;
typedef struct fpt_surface_data {
    size_t struct_size;
    size_t degree_u;
    size_t degree_v;
    size_t pole_count_u;
    size_t pole_count_v;
    const double *knots_u;
    const double *knots_v;
    const double *poles;
    const double *weights;
} fpt_surface_data;
typedef struct fpt_curve_callback {
    size_t struct_size;
    int32_t (*evaluate)(void *user, double u, uint32_t derivatives, double *out);
    void *user;
    void (*release)(void *user);
    double domain[2];
    double speed_bound;
    double second_bound;
} fpt_curve_callback;
typedef struct fpt_surface_callback {
    size_t struct_size;
    int32_t (*evaluate)(void *user, double u, double v, uint32_t derivatives, double *out);
    void *user;
    void (*release)(void *user);
    double domain[4];
    double speed_bounds[2];
    double second_bounds[3];
} fpt_surface_callback;
typedef struct fpt_foot_point {
    double u;
    double v;
    double point[3];
    double distance;
    double lower_bound;
    uint32_t flags;
    uint32_t iterations;
} fpt_foot_point;
typedef struct fpt_extrema_options {
    size_t struct_size;
    double accuracy;
    double radius;
    size_t nearest;
    uint32_t minima_only;
    uint32_t reserved;
    double domain[4];
    uint64_t budget;
    int (*should_stop)(void *user);
    void *user;
} fpt_extrema_options;
typedef struct fpt_foot_member {
    struct fpt_foot_point foot;
    double u[2];
    double v[2];
    uint32_t kind;
    uint32_t nature;
} fpt_foot_member;
typedef struct fpt_scene_member {
    size_t struct_size;
    const struct fpt_curve *curve;
    const struct fpt_surface *surface;
    const double *placement;
} fpt_scene_member;
typedef struct fpt_scene_data {
    size_t struct_size;
    size_t member_count;
    const struct fpt_scene_member *members;
} fpt_scene_data;
typedef struct fpt_weights_options {
    size_t struct_size;
    double weight_min;
    double weight_max;
    double ratio_limit;
    double tolerance;
    uint32_t symmetric;
    uint32_t steps;
    uint32_t starts;
    uint32_t reserved;
    uint64_t seed;
    int (*should_stop)(void *user);
    void *user;
} fpt_weights_options;
typedef struct fpt_weights_constraint {
    uint32_t kind;
    uint32_t reserved;
    double u;
    double v;
    double vector[3];
} fpt_weights_constraint;
typedef struct fpt_weights_pole {
    double wish;
    double chord_distance;
    double first_guess;
    double weight;
    double distance;
    double lower_bound;
    double u;
    double v;
    uint32_t state;
    uint32_t flags;
} fpt_weights_pole;
typedef struct fpt_weights_outcome {
    double error;
    double u;
    double v;
    uint32_t met;
    uint32_t reserved;
} fpt_weights_outcome;
typedef struct fpt_weights_summary {
    double tolerance;
    uint64_t iterations;
    uint32_t starts;
    uint32_t is_met;
    uint64_t met;
    uint64_t not_met;
    uint64_t impossible;
} fpt_weights_summary;
typedef struct fpt_weights_conic_shape {
    double weight;
    double rho;
    double eccentricity;
} fpt_weights_conic_shape;
#ifdef __cplusplus
extern "C" {
#endif
const char *fpt_last_error(void);
const char *fpt_status_name(fpt_status status);
uint32_t fpt_version(void);
uint32_t fpt_abi_version(void);
void fpt_query_options_init(struct fpt_query_options *options, size_t struct_size);
FPT_MUST_USE fpt_status fpt_curve_new(const struct fpt_curve_data *data, struct fpt_curve **out);
void fpt_curve_free(struct fpt_curve *curve);
FPT_MUST_USE fpt_status fpt_curve_domain(const struct fpt_curve *curve, double *out_u);
FPT_MUST_USE
fpt_status fpt_curve_evaluate(const struct fpt_curve *curve,
                              double u,
                              uint32_t derivatives,
                              double *out);
FPT_MUST_USE
fpt_status fpt_curve_evaluate_many(const struct fpt_curve *curve,
                                   const double *parameters,
                                   size_t count,
                                   uint32_t derivatives,
                                   double *out);
FPT_MUST_USE fpt_status fpt_curve_degree(const struct fpt_curve *curve, size_t *out_degree);
FPT_MUST_USE fpt_status fpt_curve_pole_count(const struct fpt_curve *curve, size_t *out_pole_count);
FPT_MUST_USE
fpt_status fpt_curve_knots(const struct fpt_curve *curve,
                           size_t capacity,
                           double *out_knots);
FPT_MUST_USE
fpt_status fpt_curve_poles(const struct fpt_curve *curve,
                           size_t capacity,
                           double *out_poles);
FPT_MUST_USE
fpt_status fpt_curve_weights(const struct fpt_curve *curve,
                             size_t capacity,
                             double *out_weights);
FPT_MUST_USE
fpt_status fpt_curve_box(const struct fpt_curve *curve,
                         double *out_box);
FPT_MUST_USE
fpt_status fpt_curve_is_rational(const struct fpt_curve *curve,
                                 int32_t *out_is_rational);
FPT_MUST_USE fpt_status fpt_curve_is_closed(const struct fpt_curve *curve, int32_t *out_is_closed);
FPT_MUST_USE
fpt_status fpt_curve_prepare(const struct fpt_curve *curve);
FPT_MUST_USE
fpt_status fpt_curve_memory(const struct fpt_curve *curve,
                            size_t *out_memory);
FPT_MUST_USE
fpt_status fpt_surface_new(const struct fpt_surface_data *data,
                           struct fpt_surface **out);
void fpt_surface_free(struct fpt_surface *surface);
FPT_MUST_USE fpt_status fpt_surface_domain(const struct fpt_surface *surface, double *out_uv);
FPT_MUST_USE
fpt_status fpt_surface_evaluate(const struct fpt_surface *surface,
                                double u,
                                double v,
                                uint32_t derivatives,
                                double *out);
FPT_MUST_USE
fpt_status fpt_surface_evaluate_many(const struct fpt_surface *surface,
                                     const double *parameters,
                                     size_t count,
                                     uint32_t derivatives,
                                     double *out);
FPT_MUST_USE
fpt_status fpt_surface_degree_u(const struct fpt_surface *surface,
                                size_t *out_degree_u);
FPT_MUST_USE
fpt_status fpt_surface_degree_v(const struct fpt_surface *surface,
                                size_t *out_degree_v);
FPT_MUST_USE
fpt_status fpt_surface_pole_count_u(const struct fpt_surface *surface,
                                    size_t *out_pole_count_u);
FPT_MUST_USE
fpt_status fpt_surface_pole_count_v(const struct fpt_surface *surface,
                                    size_t *out_pole_count_v);
FPT_MUST_USE
fpt_status fpt_surface_knots_u(const struct fpt_surface *surface,
                               size_t capacity,
                               double *out_knots_u);
FPT_MUST_USE
fpt_status fpt_surface_knots_v(const struct fpt_surface *surface,
                               size_t capacity,
                               double *out_knots_v);
FPT_MUST_USE
fpt_status fpt_surface_poles(const struct fpt_surface *surface,
                             size_t capacity,
                             double *out_poles);
FPT_MUST_USE
fpt_status fpt_surface_weights(const struct fpt_surface *surface,
                               size_t capacity,
                               double *out_weights);
FPT_MUST_USE
fpt_status fpt_surface_box(const struct fpt_surface *surface,
                           double *out_box);
FPT_MUST_USE
fpt_status fpt_surface_is_rational(const struct fpt_surface *surface,
                                   int32_t *out_is_rational);
FPT_MUST_USE
fpt_status fpt_surface_is_closed_u(const struct fpt_surface *surface,
                                   int32_t *out_is_closed_u);
FPT_MUST_USE
fpt_status fpt_surface_is_closed_v(const struct fpt_surface *surface,
                                   int32_t *out_is_closed_v);
FPT_MUST_USE
fpt_status fpt_surface_collapsed_edges(const struct fpt_surface *surface,
                                       int32_t *out_collapsed);
FPT_MUST_USE
fpt_status fpt_surface_prepare(const struct fpt_surface *surface);
FPT_MUST_USE
fpt_status fpt_surface_memory(const struct fpt_surface *surface,
                              size_t *out_memory);
FPT_MUST_USE
fpt_status fpt_curve_from_callback(const struct fpt_curve_callback *callback,
                                   struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_surface_from_callback(const struct fpt_surface_callback *callback,
                                     struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_curve_closest(const struct fpt_curve *curve,
                             const double *points,
                             size_t count,
                             const struct fpt_query_options *options,
                             struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_curve_invert(const struct fpt_curve *curve,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_closest(const struct fpt_surface *surface,
                               const double *points,
                               size_t count,
                               const struct fpt_query_options *options,
                               struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_invert(const struct fpt_surface *surface,
                              const double *points,
                              size_t count,
                              const struct fpt_query_options *options,
                              struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_curve_closest_f32(const struct fpt_curve *curve,
                                 const float *points,
                                 size_t count,
                                 const struct fpt_query_options *options,
                                 struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_curve_invert_f32(const struct fpt_curve *curve,
                                const float *points,
                                size_t count,
                                const struct fpt_query_options *options,
                                struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_closest_f32(const struct fpt_surface *surface,
                                   const float *points,
                                   size_t count,
                                   const struct fpt_query_options *options,
                                   struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_invert_f32(const struct fpt_surface *surface,
                                  const float *points,
                                  size_t count,
                                  const struct fpt_query_options *options,
                                  struct fpt_foot_point *out);
void fpt_extrema_options_init(struct fpt_extrema_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_curve_preimage(const struct fpt_curve *curve,
                              const double *point,
                              double tolerance,
                              const struct fpt_query_options *options,
                              struct fpt_foot_set **out);
FPT_MUST_USE
fpt_status fpt_surface_preimage(const struct fpt_surface *surface,
                                const double *point,
                                double tolerance,
                                const struct fpt_query_options *options,
                                struct fpt_foot_set **out);
FPT_MUST_USE
fpt_status fpt_curve_extrema(const struct fpt_curve *curve,
                             const double *point,
                             const struct fpt_extrema_options *options,
                             struct fpt_foot_set **out);
FPT_MUST_USE
fpt_status fpt_surface_extrema(const struct fpt_surface *surface,
                               const double *point,
                               const struct fpt_extrema_options *options,
                               struct fpt_foot_set **out);
FPT_MUST_USE fpt_status fpt_foot_set_count(const struct fpt_foot_set *set, size_t *out_count);
FPT_MUST_USE
fpt_status fpt_foot_set_get(const struct fpt_foot_set *set,
                            size_t index,
                            struct fpt_foot_member *out);
FPT_MUST_USE
fpt_status fpt_foot_set_undecided_count(const struct fpt_foot_set *set,
                                        size_t *out_count);
FPT_MUST_USE
fpt_status fpt_foot_set_undecided_get(const struct fpt_foot_set *set,
                                      size_t index,
                                      double *out_uv);
void fpt_foot_set_free(struct fpt_foot_set *set);
FPT_MUST_USE
fpt_status fpt_curve_on_line(const struct fpt_curve *curve,
                             const double *origin,
                             const double *direction,
                             const double *reach,
                             double tolerance,
                             const struct fpt_query_options *options,
                             struct fpt_foot_set **out);
FPT_MUST_USE
fpt_status fpt_surface_on_line(const struct fpt_surface *surface,
                               const double *origin,
                               const double *direction,
                               const double *reach,
                               double tolerance,
                               const struct fpt_query_options *options,
                               struct fpt_foot_set **out);
FPT_MUST_USE
fpt_status fpt_curve_project(const struct fpt_curve *curve,
                             const double *points,
                             size_t count,
                             const double *direction,
                             const struct fpt_query_options *options,
                             struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_project(const struct fpt_surface *surface,
                               const double *points,
                               size_t count,
                               const double *direction,
                               const struct fpt_query_options *options,
                               struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_normals(const struct fpt_surface *surface,
                               const double *points,
                               const struct fpt_foot_point *feet,
                               size_t count,
                               double *out_normals,
                               double *out_signed,
                               uint32_t *out_flags);
FPT_MUST_USE
fpt_status fpt_curve_tangents(const struct fpt_curve *curve,
                              const struct fpt_foot_point *feet,
                              size_t count,
                              double *out_tangents,
                              uint32_t *out_flags);
FPT_MUST_USE
fpt_status fpt_curve_evaluate_sided(const struct fpt_curve *curve,
                                    double u,
                                    int32_t side,
                                    uint32_t derivatives,
                                    double *out);
FPT_MUST_USE
fpt_status fpt_surface_evaluate_sided(const struct fpt_surface *surface,
                                      double u,
                                      double v,
                                      int32_t side_u,
                                      int32_t side_v,
                                      uint32_t derivatives,
                                      double *out);
FPT_MUST_USE
fpt_status fpt_curve_uncertainty(const struct fpt_curve *curve,
                                 const struct fpt_foot_point *feet,
                                 size_t count,
                                 double accuracy,
                                 double *out);
FPT_MUST_USE
fpt_status fpt_surface_uncertainty(const struct fpt_surface *surface,
                                   const struct fpt_foot_point *feet,
                                   size_t count,
                                   double accuracy,
                                   double *out);
FPT_MUST_USE
fpt_status fpt_curve_unwrap(const struct fpt_curve *curve,
                            double previous,
                            double u,
                            double *out_u);
FPT_MUST_USE
fpt_status fpt_surface_unwrap(const struct fpt_surface *surface,
                              const double *previous,
                              const double *uv,
                              double *out_uv);
FPT_MUST_USE
fpt_status fpt_curve_path(const struct fpt_curve *curve,
                          const double *points,
                          size_t count,
                          const struct fpt_query_options *options,
                          struct fpt_foot_point *out,
                          double *out_unwrapped,
                          uint32_t *out_changes);
FPT_MUST_USE
fpt_status fpt_surface_path(const struct fpt_surface *surface,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            struct fpt_foot_point *out,
                            double *out_unwrapped,
                            uint32_t *out_changes);
FPT_MUST_USE
fpt_status fpt_scene_new(const struct fpt_scene_data *data,
                         struct fpt_scene **out);
void fpt_scene_free(struct fpt_scene *scene);
FPT_MUST_USE fpt_status fpt_scene_count(const struct fpt_scene *scene, size_t *out_count);
FPT_MUST_USE
fpt_status fpt_scene_shape(const struct fpt_scene *scene,
                           uint32_t member,
                           struct fpt_curve **out_curve,
                           struct fpt_surface **out_surface);
FPT_MUST_USE
fpt_status fpt_scene_placement(const struct fpt_scene *scene,
                               uint32_t member,
                               double *out_placement);
FPT_MUST_USE
fpt_status fpt_scene_box(const struct fpt_scene *scene,
                         double *out_box);
FPT_MUST_USE
fpt_status fpt_scene_memory(const struct fpt_scene *scene,
                            size_t *out_memory);
FPT_MUST_USE
fpt_status fpt_scene_prepare(const struct fpt_scene *scene);
FPT_MUST_USE
fpt_status fpt_scene_evaluate(const struct fpt_scene *scene,
                              uint32_t member,
                              double u,
                              double v,
                              uint32_t derivatives,
                              double *out);
FPT_MUST_USE
fpt_status fpt_scene_closest(const struct fpt_scene *scene,
                             const double *points,
                             size_t count,
                             const struct fpt_query_options *options,
                             const uint32_t *hint_members,
                             struct fpt_foot_point *out,
                             uint32_t *out_members);
FPT_MUST_USE
fpt_status fpt_scene_invert(const struct fpt_scene *scene,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            const uint32_t *hint_members,
                            struct fpt_foot_point *out,
                            uint32_t *out_members);
FPT_MUST_USE
fpt_status fpt_scene_closest_f32(const struct fpt_scene *scene,
                                 const float *points,
                                 size_t count,
                                 const struct fpt_query_options *options,
                                 const uint32_t *hint_members,
                                 struct fpt_foot_point *out,
                                 uint32_t *out_members);
FPT_MUST_USE
fpt_status fpt_scene_invert_f32(const struct fpt_scene *scene,
                                const float *points,
                                size_t count,
                                const struct fpt_query_options *options,
                                const uint32_t *hint_members,
                                struct fpt_foot_point *out,
                                uint32_t *out_members);
FPT_MUST_USE
fpt_status fpt_scene_normals(const struct fpt_scene *scene,
                             const double *points,
                             const struct fpt_foot_point *feet,
                             const uint32_t *members,
                             size_t count,
                             double *out_normals,
                             double *out_signed,
                             uint32_t *out_flags);
void fpt_weights_options_init(struct fpt_weights_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_weights_general(const struct fpt_curve *curve,
                               const double *lambdas,
                               size_t lambda_count,
                               const struct fpt_weights_options *options,
                               struct fpt_weights_report **out);
FPT_MUST_USE
fpt_status fpt_weights_interpolated(const struct fpt_curve *curve,
                                    double first_distance,
                                    double last_distance,
                                    const struct fpt_weights_options *options,
                                    struct fpt_weights_report **out);
FPT_MUST_USE
fpt_status fpt_weights_network(const struct fpt_curve *curve,
                               const size_t *wish_poles,
                               const double *wish_distances,
                               size_t wish_count,
                               double min_distance,
                               double max_distance,
                               const struct fpt_weights_options *options,
                               struct fpt_weights_report **out);
FPT_MUST_USE
fpt_status fpt_weights_refine_curve(const struct fpt_curve *curve,
                                    const size_t *wish_poles,
                                    const double *wish_distances,
                                    size_t wish_count,
                                    const struct fpt_weights_constraint *constraints,
                                    size_t constraint_count,
                                    const struct fpt_weights_options *options,
                                    struct fpt_weights_report **out);
FPT_MUST_USE
fpt_status fpt_weights_refine_surface(const struct fpt_surface *surface,
                                      const size_t *wish_poles,
                                      const double *wish_distances,
                                      size_t wish_count,
                                      const struct fpt_weights_constraint *constraints,
                                      size_t constraint_count,
                                      const struct fpt_weights_options *options,
                                      struct fpt_weights_report **out);
FPT_MUST_USE
fpt_status fpt_weights_report_pole_count(const struct fpt_weights_report *report,
                                         size_t *out_count);
FPT_MUST_USE
fpt_status fpt_weights_report_pole(const struct fpt_weights_report *report,
                                   size_t index,
                                   struct fpt_weights_pole *out);
FPT_MUST_USE
fpt_status fpt_weights_report_weights(const struct fpt_weights_report *report,
                                      size_t capacity,
                                      double *out_weights);
FPT_MUST_USE
fpt_status fpt_weights_report_constraint(const struct fpt_weights_report *report,
                                         size_t index,
                                         struct fpt_weights_outcome *out);
FPT_MUST_USE
fpt_status fpt_weights_report_summary(const struct fpt_weights_report *report,
                                      struct fpt_weights_summary *out);
FPT_MUST_USE
fpt_status fpt_weights_report_curve(const struct fpt_weights_report *report,
                                    struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_weights_report_surface(const struct fpt_weights_report *report,
                                      struct fpt_surface **out);
void fpt_weights_report_free(struct fpt_weights_report *report);
FPT_MUST_USE
fpt_status fpt_weights_move_point(const struct fpt_curve *curve,
                                  double u,
                                  size_t pole,
                                  double distance,
                                  double *out_weight);
FPT_MUST_USE
fpt_status fpt_weights_through_point(const struct fpt_curve *curve,
                                     size_t pole,
                                     const double *point,
                                     double tolerance,
                                     double *out_weight,
                                     struct fpt_foot_point *out_foot);
FPT_MUST_USE
fpt_status fpt_weights_conic(const double *poles,
                             const double *weights,
                             struct fpt_weights_conic_shape *out);
FPT_MUST_USE
fpt_status fpt_weights_of_rho(double rho,
                              double *out_weight);
FPT_MUST_USE
fpt_status fpt_weights_of_eccentricity(const double *poles,
                                       double eccentricity,
                                       double *out_weights,
                                       size_t *out_count);
FPT_MUST_USE
fpt_status fpt_weights_normalise(const double *weights,
                                 size_t count,
                                 uint32_t unit,
                                 double *out_weights);
FPT_MUST_USE
fpt_status fpt_weights_bound(const double *weights,
                             size_t count,
                             double ratio,
                             double *out_weights);
FPT_MUST_USE
fpt_status fpt_weights_standard_form(const struct fpt_curve *curve,
                                     struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_weights_positive_form(size_t degree,
                                     size_t pole_count,
                                     const double *knots,
                                     const double *poles,
                                     struct fpt_curve **out);
#ifdef __cplusplus
}
#endif
#endif
