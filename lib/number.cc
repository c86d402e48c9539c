#include "number.h"

#include <charconv>
#include <cmath>
#include <string>

#include <locale.h>
#include <stdlib.h>

size_t number_write(double value, char *text)
{
    size_t length = static_cast<size_t>(std::to_chars(text, text + NUMBER_SIZE, value).ptr - text);
    // "-0" would lose its sign in every reader that takes it for an integer.
    if (length == 2 && text[0] == '-' && text[1] == '0') {
        text[2] = '.';
        text[3] = '0';
        return 4;
    }
    return length;
}

bool number_read(const char *begin, const char *end, double *value)
{
    auto result = std::from_chars(begin, end, *value);
    if (result.ptr != end)
        return false;
    if (result.ec == std::errc())
        return true;
    // from_chars does not say whether it left the doubles above or below; strtod does, but by the
    // locale of whoever calls.
    locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
    *value = strtod_l(std::string(begin, end).c_str(), nullptr, plain);
    freelocale(plain);
    return std::isfinite(*value);
}
