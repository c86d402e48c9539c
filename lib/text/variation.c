#include "text/variation.h"

#include <math.h>

#include "base/hash.h"
#include "base/number.h"
#include "base/random.h"
#include "base/text.h"
#include "text/json_scan.h"

struct variation {
    struct json_scan scan;
    struct random_address address;
    struct text path;  /* of the value that is being read */
    struct text drawn; /* the line so far */
};

static int draw_value(struct variation *variation);

/* Draws a value whose path goes on from outside by what was added to it. */
static int draw_part(struct variation *variation, size_t outside)
{
    int result = draw_value(variation);
    variation->path.length = outside;
    return result;
}

/* Reads the key of a member, copies it, and adds it to the path. */
static int copy_key(struct variation *variation)
{
    struct json_string key;
    if (json_scan_string(&variation->scan, &key) != 0)
        return -1;
    text_add_json(&variation->drawn, key.text, key.length);
    text_add(&variation->drawn, ":", 1);
    json_scan_take(&variation->scan, ':');
    text_format(&variation->path, "%s%.*s", variation->path.length > 0 ? "." : "", (int)key.length,
                key.text);
    return 0;
}

/* Draws the values within an array or an object, which ends with this character. */
static int draw_within(struct variation *variation, char end)
{
    struct json_scan *scan = &variation->scan;
    size_t outside = variation->path.length;
    text_add(&variation->drawn, scan->at++, 1);
    for (size_t i = 0; !json_scan_take(scan, end); i++) {
        if (json_scan_take(scan, ','))
            text_add(&variation->drawn, ",", 1);
        if (end == ']')
            text_format(&variation->path, "[%zu]", i);
        else if (copy_key(variation) != 0)
            return -1;
        if (draw_part(variation, outside) != 0)
            return -1;
    }
    text_add(&variation->drawn, &end, 1);
    return 0;
}

/* Reads an array of two numbers; false if it is something else. */
static bool read_pair(struct json_scan values, double pair[2])
{
    struct diag unread = {0};
    values.diag = &unread;
    return json_scan_take(&values, '[') && json_scan_number(&values, &pair[0]) == 0 &&
           json_scan_take(&values, ',') && json_scan_number(&values, &pair[1]) == 0 &&
           json_scan_take(&values, ']') && fabs(pair[0]) < 1e300 && fabs(pair[1]) < 1e300;
}

static void add_number(struct variation *variation, double value)
{
    struct text *drawn = &variation->drawn;
    drawn->length += number_write(value, text_room(drawn, NUMBER_SIZE));
}

/* A law draws from its values: 1, or 0 if they are not what it expects, or -1 after a message. */
static int draw_uniform(struct variation *variation, struct json_scan values)
{
    double pair[2];
    if (!read_pair(values, pair) || pair[0] > pair[1])
        return 0;
    struct random_sequence sequence = random_sequence_at(variation->address, RANDOM_VARIATION);
    add_number(variation, random_sequence_between(&sequence, pair[0], pair[1]));
    return 1;
}

static int draw_normal(struct variation *variation, struct json_scan values)
{
    double pair[2], gaussian[2];
    if (!read_pair(values, pair) || pair[1] < 0)
        return 0;
    random_gaussian_pair(&variation->address, RANDOM_VARIATION, 0, gaussian);
    add_number(variation, pair[0] + pair[1] * gaussian[0]);
    return 1;
}

static int draw_choice(struct variation *variation, struct json_scan values)
{
    struct json_scan begin = values;
    struct json_string item;
    int64_t count = 0;
    if (!json_scan_take(&values, '[') || json_scan_peek(&values) == ']')
        return 0;
    do {
        json_scan_value(&values, &item);
        count++;
    } while (json_scan_take(&values, ','));
    struct random_sequence sequence = random_sequence_at(variation->address, RANDOM_VARIATION);
    int64_t chosen = random_sequence_whole(&sequence, 0, count - 1);
    json_scan_take(&begin, '[');
    for (int64_t i = 0; i < chosen; i++) {
        json_scan_value(&begin, &item);
        json_scan_take(&begin, ',');
    }
    struct json_scan behind = variation->scan;
    variation->scan = begin;
    size_t outside = variation->path.length;
    text_format(&variation->path, ".choice[%d]", (int)chosen);
    int result = draw_part(variation, outside);
    variation->scan = behind;
    return result == 0 ? 1 : -1;
}

static const struct law {
    const char *name, *expected;
    int (*draw)(struct variation *variation, struct json_scan values);
} laws[] = {
    {"uniform", "[low, high], numbers, low not above high", draw_uniform},
    {"normal", "[mean, sd], numbers, sd not below 0", draw_normal},
    {"choice", "an array of one value or more", draw_choice},
};

/* The law that an object names by its first member; NULL if it is no distribution. The cursor of
 * the scan, a copy, is then at the values of the law. */
static const struct law *find_law(struct json_scan *scan)
{
    struct json_string key;
    if (!json_scan_take(scan, '{') || json_scan_peek(scan) != '"' ||
        json_scan_string(scan, &key) != 0 || !json_scan_take(scan, ':'))
        return NULL;
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++)
        if (strlen(laws[i].name) == key.length && memcmp(laws[i].name, key.text, key.length) == 0)
            return &laws[i];
    return NULL;
}

static int draw_law(struct variation *variation, const struct law *law, struct json_scan values)
{
    struct json_scan *scan = &variation->scan;
    struct json_string whole, bytes;
    json_scan_value(scan, &whole);
    variation->address.item = hash_bytes(HASH_START, variation->path.bytes, variation->path.length);
    struct json_scan behind = values;
    json_scan_value(&behind, &bytes);
    int result = json_scan_take(&behind, '}') ? law->draw(variation, values) : 0;
    if (result != 0)
        return result > 0 ? 0 : -1;
    return diag_fail(scan->diag, DIAG_CONFIG, "%.*s: %.*s; expected {\"%s\": %s}",
                     (int)variation->path.length, variation->path.bytes,
                     whole.length < 200 ? (int)whole.length : 200, whole.text, law->name,
                     law->expected);
}

static int draw_value(struct variation *variation)
{
    struct json_scan *scan = &variation->scan, values = *scan;
    struct json_string bytes;
    const struct law *law = find_law(&values);
    if (law != NULL)
        return draw_law(variation, law, values);
    if (json_scan_peek(scan) == '{' || *scan->at == '[')
        return draw_within(variation, *scan->at == '{' ? '}' : ']');
    if (json_scan_value(scan, &bytes) != 0)
        return -1;
    text_add(&variation->drawn, bytes.text, bytes.length);
    return 0;
}

const char *variation_draw(const char *line, struct random_address address, struct arena *arena,
                           struct diag *diag)
{
    struct variation variation = {{line, line + strlen(line), arena, diag}, .address = address};
    int result = draw_value(&variation);
    const char *drawn =
        result == 0 ? arena_text(arena, variation.drawn.bytes, variation.drawn.length) : NULL;
    text_free(&variation.path);
    text_free(&variation.drawn);
    return drawn;
}
