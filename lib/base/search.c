#include "base/search.h"

#include <string.h>

struct numbers {
    const double *first;
    size_t stride;
    double at;
};

static double number_of(const struct numbers *numbers, size_t row)
{
    double number;
    memcpy(&number, (const char *)numbers->first + row * numbers->stride, sizeof number);
    return number;
}

static bool is_reached(const void *of, size_t row)
{
    const struct numbers *numbers = of;
    return number_of(numbers, row) <= numbers->at;
}

/* The row at or before the place if all steps are even; the last row is beyond the place. */
static size_t guess_row(const struct numbers *numbers, size_t count)
{
    double from = number_of(numbers, 0), to = number_of(numbers, count - 1);
    size_t guess = (size_t)((numbers->at - from) / (to - from) * (double)(count - 1));
    return guess < count - 1 ? guess : count - 2;
}

size_t search_row(const double *first, size_t stride, size_t count, double at)
{
    const struct numbers numbers = {first, stride, at};
    if (count == 0 || !is_reached(&numbers, 0))
        return 0;
    if (is_reached(&numbers, count - 1))
        return count - 1;
    size_t guess = guess_row(&numbers, count);
    if (!is_reached(&numbers, guess))
        return search_last(0, guess, is_reached, &numbers);
    if (!is_reached(&numbers, guess + 1))
        return guess;
    return search_last(guess + 1, count - 1, is_reached, &numbers);
}
