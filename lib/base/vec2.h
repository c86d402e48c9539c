/* Plane vectors by value. A heading is a unit vector (cos, sin): rotating by it costs no
 * trigonometry and needs no wrapping. Counter-clockwise is positive. */
#pragma once

#include <stdbool.h>

#include "base/elementary.h"

struct vec2 {
    double x, y;
};

static inline bool vec2_same(struct vec2 a, struct vec2 b)
{
    return a.x == b.x && a.y == b.y;
}

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

/* The rounding error of product = a b, a b - product, exact for sizes from 1e-140 to 1e140
 * (Dekker's splitting). fma gives the same, but takes fifty times as long where the CPU has
 * none. */
static inline double vec2_product_rest(double a, double b, double product)
{
    double a_shifted = a * 0x1.0000002p27, b_shifted = b * 0x1.0000002p27;
    double a_head = a_shifted - (a_shifted - a), a_tail = a - a_head;
    double b_head = b_shifted - (b_shifted - b), b_tail = b - b_head;
    double rest = (a_head * b_head - product) + a_head * b_tail + a_tail * b_head;
    return rest + a_tail * b_tail;
}

/* a · b within 2 ulp even where the products cancel, as for speeds that are nearly tangential. */
static inline double vec2_dot_accurate(struct vec2 a, struct vec2 b)
{
    double x = a.x * b.x, y = a.y * b.y;
    double sum = x + y;
    double part = sum - x;
    double lost = (x - (sum - part)) + (y - part);
    return (sum + (lost + vec2_product_rest(a.x, b.x, x))) + vec2_product_rest(a.y, b.y, y);
}

/* The z component of a × b: positive if b lies counter-clockwise of a. */
static inline double vec2_cross(struct vec2 a, struct vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/* For lengths from 1e-150 to 1e150; glint's coordinates are bounded by 1e7 m. */
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
