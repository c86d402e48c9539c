#include "text/variation.h"

#include <math.h>

#include "base/hash.h"
#include "base/number.h"
#include "base/text.h"
#include "text/json_scan.h"

#define LAW(names, laws)                                                                           \
    "{\"description\": \"" names "\", \"type\": \"object\", \"minProperties\": 1, "                \
    "\"maxProperties\": 1, \"additionalProperties\": false, "                                      \
    "\"properties\": {\"choice\": {\"type\": \"array\", \"minItems\": 1}" laws "}}"
#define PAIR                                                                                       \
    "{\"type\": \"array\", \"items\": {\"type\": \"number\"}, \"minItems\": 2, \"maxItems\": 2}"
const char variation_schema[] = "{\"drawn\": " LAW("choice", "") ", \"drawn_number\": " LAW(
    "uniform, normal or choice", ", \"uniform\": " PAIR ", \"normal\": " PAIR) "}";

/* Where a value stands: in which other one, and by which key or number there. */
struct place {
    const struct place *outer; /* NULL: none */
    struct json_string key;    /* without text: an item of an array */
    const char *dot;           /* before the key */
    size_t index;
};

struct variation {
    struct json_scan scan;
    struct random_address address;
    const char *copied; /* up to here the line is in drawn */
    struct text drawn;
};

static int draw_value(struct variation *variation, const struct place *place);

static void add_place(const struct place *place, struct text *path)
{
    if (place == NULL)
        return;
    add_place(place->outer, path);
    if (place->key.text == NULL)
        text_format(path, "[%zu]", place->index);
    else
        text_format(path, "%s%.*s", place->dot, (int)place->key.length, place->key.text);
}

/* Copies the line up to this place. */
static void copy_to(struct variation *variation, const char *end)
{
    text_add(&variation->drawn, variation->copied, (size_t)(end - variation->copied));
    variation->copied = end;
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

/* Each law draws from the values at the cursor: 1, or 0 if they are not as expected, or -1 after a
 * message. */
static int draw_uniform(struct variation *variation, const struct place *place)
{
    double pair[2];
    (void)place;
    if (!read_pair(variation->scan, pair) || pair[0] > pair[1])
        return 0;
    struct random_sequence sequence = random_sequence_at(variation->address, RANDOM_VARIATION);
    add_number(variation, random_sequence_between(&sequence, pair[0], pair[1]));
    return 1;
}

static int draw_normal(struct variation *variation, const struct place *place)
{
    double pair[2], gaussian[2];
    (void)place;
    if (!read_pair(variation->scan, pair) || pair[1] < 0)
        return 0;
    random_gaussian_pair(&variation->address, RANDOM_VARIATION, 0, gaussian);
    add_number(variation, pair[0] + pair[1] * gaussian[0]);
    return 1;
}

static size_t count_items(struct json_scan values)
{
    struct json_string item;
    size_t count = 0;
    json_scan_take(&values, '[');
    while (json_scan_peek(&values) != ']') {
        json_scan_value(&values, &item);
        json_scan_take(&values, ',');
        count++;
    }
    return count;
}

static int draw_choice(struct variation *variation, const struct place *place)
{
    struct json_scan *scan = &variation->scan;
    if (json_scan_peek(scan) != '[' || scan->at[1] == ']')
        return 0;
    int64_t count = (int64_t)count_items(*scan);
    struct random_sequence sequence = random_sequence_at(variation->address, RANDOM_VARIATION);
    size_t chosen = (size_t)random_sequence_whole(&sequence, 0, count - 1);
    struct json_string item;
    scan->at++;
    for (size_t i = 0; i < chosen; i++) {
        json_scan_value(scan, &item);
        json_scan_take(scan, ',');
    }
    struct place choices = {.outer = place, .key = {"choice", strlen("choice")}, .dot = "."};
    struct place part = {.outer = &choices, .index = chosen};
    variation->copied = scan->at;
    if (draw_value(variation, &part) != 0)
        return -1;
    copy_to(variation, scan->at);
    return 1;
}

static const struct law {
    const char *name, *begin, *expected;
    int (*draw)(struct variation *variation, const struct place *place);
} laws[] = {
    {"uniform", "{\"uniform\":", "[low, high], numbers, low not above high", draw_uniform},
    {"normal", "{\"normal\":", "[mean, sd], numbers, sd not below 0", draw_normal},
    {"choice", "{\"choice\":", "an array of one value or more", draw_choice},
};

/* The law named by the first member of an object; NULL if the value is no distribution. */
static const struct law *find_law(const char *value)
{
    if (*value != '{')
        return NULL;
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++)
        if (strncmp(value, laws[i].begin, strlen(laws[i].begin)) == 0)
            return &laws[i];
    return NULL;
}

static int draw_law(struct variation *variation, const struct law *law, const struct place *place)
{
    struct json_scan *scan = &variation->scan, behind = *scan, values = *scan;
    struct json_string whole, value;
    struct text path = {0};
    add_place(place, &path);
    variation->address.item = hash_bytes(HASH_START, path.bytes, path.length);
    copy_to(variation, scan->at);
    json_scan_value(&behind, &whole);
    scan->at += strlen(law->begin);
    values.at = scan->at;
    json_scan_value(&values, &value);
    /* The values are all that the object has. */
    int result = values.at + 1 == behind.at ? law->draw(variation, place) : 0;
    if (result == 0)
        diag_fail(scan->diag, DIAG_CONFIG, "%.*s: %.*s; expected {\"%s\": %s}", (int)path.length,
                  path.bytes, whole.length < 200 ? (int)whole.length : 200, whole.text, law->name,
                  law->expected);
    text_free(&path);
    *scan = behind;
    variation->copied = behind.at;
    return result > 0 ? 0 : -1;
}

/* Draws the values within an array or an object. The line is known to be JSON, so that marks
 * between values need no check. */
static int draw_within(struct variation *variation, const struct place *outer)
{
    struct json_scan *scan = &variation->scan;
    struct place place = {.outer = outer, .dot = outer == NULL ? "" : "."};
    const char end = *scan->at++ == '{' ? '}' : ']';
    for (; !json_scan_take(scan, end); place.index++) {
        json_scan_take(scan, ',');
        if (end == '}' && json_scan_string(scan, &place.key) != 0)
            return -1;
        if (end == '}')
            json_scan_take(scan, ':');
        if (draw_value(variation, &place) != 0)
            return -1;
    }
    return 0;
}

/* Moves past a value, and copies the line with a draw in place of every distribution in it. */
static int draw_value(struct variation *variation, const struct place *place)
{
    struct json_scan *scan = &variation->scan;
    struct json_string bytes;
    const struct law *law = find_law(scan->at);
    if (law != NULL)
        return draw_law(variation, law, place);
    if (*scan->at == '{' || *scan->at == '[')
        return draw_within(variation, place);
    return json_scan_value(scan, &bytes);
}

/* May the document have a distribution? A string with the same text has a backslash before each
 * quote, so it does not count. */
static bool names_law(const char *line)
{
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++)
        if (strstr(line, laws[i].begin) != NULL)
            return true;
    return false;
}

const char *variation_draw(const char *line, struct random_address address, struct arena *arena,
                           struct diag *diag)
{
    if (!names_law(line))
        return line;
    struct variation variation = {
        .scan = {line, line + strlen(line), arena, diag}, .address = address, .copied = line};
    int result = draw_value(&variation, NULL);
    copy_to(&variation, variation.scan.at);
    const char *drawn =
        result == 0 ? arena_text(arena, variation.drawn.bytes, variation.drawn.length) : NULL;
    text_free(&variation.drawn);
    return drawn;
}
