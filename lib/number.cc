#include "number.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

size_t number_write(double value, char *text)
{
    return static_cast<size_t>(std::to_chars(text, text + NUMBER_SIZE, value).ptr - text);
}

bool number_read(const char *begin, const char *end, double *value)
{
    auto result = std::from_chars(begin, end, *value);
    if (result.ptr != end)
        return false;
    if (result.ec == std::errc())
        return true;
    // from_chars does not say whether it left the doubles above or below; strtod does.
    *value = std::strtod(std::string(begin, end).c_str(), nullptr);
    return std::isfinite(*value);
}
