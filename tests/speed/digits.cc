#include "digits.h"

#include <charconv>

char *digits_write(double value, char *at)
{
    return std::to_chars(at, at + 32, value).ptr;
}

const char *digits_read(const char *at, const char *end, double *value)
{
    return std::from_chars(at, end, *value).ptr;
}
