/* Vectors of three doubles, by value. */
#ifndef PROPELLER_VEC3_H
#define PROPELLER_VEC3_H

#include <math.h>

typedef struct vec3 {
    double x, y, z;
} vec3;

static inline vec3 vec3_of(const double p[3]) {
    vec3 a = {p[0], p[1], p[2]};
    return a;
}

static inline vec3 vec3_new(double x, double y, double z) {
    vec3 a = {x, y, z};
    return a;
}

static inline vec3 vec3_add(vec3 a, vec3 b) {
    return vec3_new(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline vec3 vec3_sub(vec3 a, vec3 b) {
    return vec3_new(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline vec3 vec3_scale(double s, vec3 a) {
    return vec3_new(s * a.x, s * a.y, s * a.z);
}

static inline double vec3_dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec3 vec3_cross(vec3 a, vec3 b) {
    return vec3_new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double vec3_length(vec3 a) {
    return sqrt(vec3_dot(a, a));
}

/* The zero vector has no direction and stays zero. */
static inline vec3 vec3_unit(vec3 a) {
    double length = vec3_length(a);
    return length > 0 ? vec3_scale(1 / length, a) : a;
}

#endif
