/* Plane vectors by value. A heading is a unit vector (cos, sin): rotating by it costs no
 * trigonometry and needs no wrapping. Counter-clockwise is positive. */
#ifndef VEC2_H
#define VEC2_H

#include <math.h>

#include "elementary.h"

struct vec2 {
    double x, y;
};

static inline struct vec2 vec2_add(struct vec2 a, struct vec2 b)
{
    return (struct vec2){a.x + b.x, a.y + b.y};
}

static inline struct vec2 vec2_sub(struct vec2 a, struct vec2 b)
{
    return (struct vec2){a.x - b.x, a.y - b.y};
}

static inline struct vec2 vec2_scale(double factor, struct vec2 a)
{
    return (struct vec2){factor * a.x, factor * a.y};
}

static inline double vec2_dot(struct vec2 a, struct vec2 b)
{
    return a.x * b.x + a.y * b.y;
}

/* a · b within 2 ulp even where the products cancel (NUMERICS 35): for signs and for speeds that
 * are nearly tangential. */
static inline double vec2_dot_accurate(struct vec2 a, struct vec2 b)
{
    double product = a.y * b.y;
    double error = fma(a.y, b.y, -product);
    return fma(a.x, b.x, product) + error;
}

/* The z component of a × b: positive if b lies counter-clockwise of a. */
static inline double vec2_cross(struct vec2 a, struct vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/* Good for lengths from 1e-150 to 1e150; glint's coordinates are bounded by 1e7 m. */
static inline double vec2_length(struct vec2 a)
{
    return sqrt(vec2_dot(a, a));
}

static inline struct vec2 vec2_heading(double angle_rad)
{
    struct elementary_sincos angle = elementary_sincos(angle_rad);
    return (struct vec2){angle.cos, angle.sin};
}

/* Turns a by a heading: from the heading's own frame into the frame that the heading is given in.
 */
static inline struct vec2 vec2_turn(struct vec2 a, struct vec2 heading)
{
    return (struct vec2){a.x * heading.x - a.y * heading.y, a.x * heading.y + a.y * heading.x};
}

/* The inverse of vec2_turn. */
static inline struct vec2 vec2_turn_back(struct vec2 a, struct vec2 heading)
{
    return (struct vec2){a.x * heading.x + a.y * heading.y, a.y * heading.x - a.x * heading.y};
}

/* A quarter turn counter-clockwise. ω × r in the plane is vec2_scale(ω, vec2_left(r)). */
static inline struct vec2 vec2_left(struct vec2 a)
{
    return (struct vec2){-a.y, a.x};
}

#endif
