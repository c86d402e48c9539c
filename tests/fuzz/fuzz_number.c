/* Numbers: what is read agrees with the C library, and what is written reads back to the same bits.
 */
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "fuzz/fuzz.h"

static void write_and_read(double value)
{
    char text[NUMBER_SIZE + 1];
    double again = 0;
    size_t length = number_write(value, text);
    fuzz_must(length <= NUMBER_SIZE && number_read(text, text + length, &again),
              "a number that was written is not read");
    fuzz_must(memcmp(&value, &again, sizeof value) == 0, "a number reads back as another");
}

/* The whole text, if it has the form of JSON. */
static bool has_the_form(const char *text)
{
    text += *text == '-';
    size_t digits = strspn(text, "0123456789"), places;
    if (digits == 0 || (digits > 1 && text[0] == '0'))
        return false;
    text += digits;
    if (*text == '.' && (places = strspn(text + 1, "0123456789")) > 0)
        text += 1 + places;
    if (*text == 'e' || *text == 'E') {
        text += 1 + (text[1] == '+' || text[1] == '-');
        digits = strspn(text, "0123456789");
        text += digits;
        return digits > 0 && *text == '\0';
    }
    return *text == '\0';
}

static void read_as_the_library_does(const char *text, size_t length)
{
    double value = 0, other = strtod(text, NULL), taken = 0;
    bool read = number_read(text, text + length, &value);
    fuzz_must(read == (other - other == 0), "a number is refused, or one too large is not");
    fuzz_must(!read || memcmp(&value, &other, sizeof value) == 0, "a number is read as another");
    const char *end = number_take(text, text + length, &taken);
    fuzz_must(end != text + length || memcmp(&value, &taken, sizeof value) == 0,
              "a number is taken as another");
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char text[1000] = "";
    double value;
    if (size >= sizeof value) {
        memcpy(&value, bytes, sizeof value);
        if (value - value == 0)
            write_and_read(value);
    }
    if (size < sizeof text) {
        memcpy(text, bytes, size);
        if (strlen(text) == size && has_the_form(text))
            read_as_the_library_does(text, size);
    }
    return 0;
}
