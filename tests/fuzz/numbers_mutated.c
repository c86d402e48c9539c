/* Mutates input by its numbers: half of the time a number of the text takes another value, so that
 * the text stays what it is and its bounds, ties and cancellations are tried. Else libFuzzer
 * changes bytes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "fuzz/fuzz.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

enum { NUMBERS = 4096 };

/* Both are libFuzzer's. */
size_t LLVMFuzzerMutate(uint8_t *bytes, size_t size, size_t room);
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size, size_t room, unsigned seed);

struct span {
    size_t begin, end;
};

static uint64_t draw(uint64_t *random)
{
    *random = *random * 6364136223846793005U + 1442695040888963407U;
    return *random >> 33;
}

static bool is_part(char character)
{
    return strchr("0123456789+-.eE", character) != NULL && character != '\0';
}

/* Where the numbers of the text stand: runs of characters of numbers that have a digit first or
 * second. */
static size_t find_numbers(const char *text, size_t size, struct span *spans)
{
    size_t count = 0;
    for (size_t i = 0, begin; i < size && count < NUMBERS; i++) {
        for (begin = i; i < size && is_part(text[i]); i++)
            ;
        bool letters = begin > 0 && strchr("\",: \n[;", text[begin - 1]) == NULL;
        if (i > begin && !letters && text[begin] != 'e' && text[begin] != 'E')
            spans[count++] = (struct span){begin, i};
    }
    return count;
}

/* Another value for a number: an extreme, a multiple, a neighbour, its negative, or one more. */
static size_t write_other(double value, char *text, uint64_t *random)
{
    static const char *const extremes[] = {"0",
                                           "-0.0",
                                           "1",
                                           "-1",
                                           "1e-308",
                                           "5e-324",
                                           "1e308",
                                           "-1e308",
                                           "1e-12",
                                           "1e6",
                                           "-1e6",
                                           "1e9",
                                           "1e12",
                                           "0.5",
                                           "100000",
                                           "3.141592653589793",
                                           "-1e-16",
                                           "1e300",
                                           "-1e-300",
                                           "2",
                                           "9007199254740993",
                                           "-1e10",
                                           "1e-6",
                                           "6.283185307179586"};
    static const double factors[] = {10, 0.1, 1e3, 1e-3, 2, 0.5, -1, 1 + 0x1p-52, 1 - 0x1p-53};
    uint64_t kind = draw(random) % 4;
    const char *extreme = extremes[draw(random) % COUNT(extremes)];
    double other = kind == 1 ? value + (double)(draw(random) % 3) - 1
                             : value * factors[draw(random) % COUNT(factors)];
    if (kind == 0 || !(other - other == 0))
        return strlen(strcpy(text, extreme));
    return number_write(other, text);
}

static size_t replace(uint8_t *bytes, size_t size, size_t room, struct span span, uint64_t *random)
{
    char text[NUMBER_SIZE];
    double value = 1;
    const char *begin = (const char *)bytes;
    number_read(begin + span.begin, begin + span.end, &value);
    size_t length = write_other(value, text, random), rest = size - span.end;
    if (span.begin + length + rest > room)
        return size;
    memmove(bytes + span.begin + length, bytes + span.end, rest);
    memcpy(bytes + span.begin, text, length);
    return span.begin + length + rest;
}

size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size, size_t room, unsigned seed)
{
    uint64_t random = seed;
    draw(&random);
    struct span *spans = memory_get(NUMBERS * sizeof *spans);
    for (uint64_t changes = draw(&random) % 2 * (1 + draw(&random) % 3), all = changes;
         changes > 0 || all == 0; changes--) {
        size_t count = find_numbers((const char *)bytes, size, spans);
        if (all == 0 || count == 0) {
            size = LLVMFuzzerMutate(bytes, size, room);
            break;
        }
        size = replace(bytes, size, room, spans[draw(&random) % count], &random);
    }
    free(spans);
    return size;
}
