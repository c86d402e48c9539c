/* Finds where a condition on a number ends, by bisection. */
#pragma once

#include <stdbool.h>

/* Two numbers between which the condition ends. */
struct root {
    double low, high; /* it holds at low, and not at high */
};

/* Narrows finite bounds, low < high, between which the condition ends once, down to this width. A
 * width of 0 asks for neighbouring numbers. The condition is not asked about the bounds themselves.
 */
struct root root_between(double low, double high, double width,
                         bool (*holds)(const void *of, double x), const void *of);
