/* The frame reader against jansson: the same lines are taken and refused, with the same values.
 *
 * jansson reads the line in its strict mode, and the field tables are laid over its tree, by code
 * of this file alone. Where the two differ RFC 8259 leaves it open:
 *   - integers beyond 64 bits are an error to jansson unless it reads all numbers as reals, which
 *     it is told to here; RFC 8259 sets no limit
 *   - a key that stands twice is refused in a frame and by jansson's strict mode, but not inside
 *     `extra`, which is passed on unread; RFC 8259 says only that keys should be unique
 *   - jansson takes 2,047 levels, a frame JSON_SCAN_DEPTH of them in `extra`
 *   - a line feed is white space to jansson, the end of a line to us
 *   - -0 is 0 to us in members that begin at 0
 * Both refuse U+0000 in strings, a byte order mark and numbers beyond the doubles, as they may.
 *
 *     CASES=LINES build/unit/frame test_frame_oracle    mutates so many lines, not 10^5, with the
 *                                                       time left
 */
#define _GNU_SOURCE
#include "check.h"

#include <errno.h>

#include <jansson.h>

#include "frame/frame_text.h"
#include "run/progress.h"
#include "sample.h"
#include "text/json_scan.h"

#define LOAD(type, member) (*(type *)memcpy(&(type){0}, (member), sizeof(type)))

enum { LINE_SIZE = 1000 };

static bool record_fits(const struct record *record, json_t *tree);

static bool is_seed(const char *text, size_t length)
{
    char *end;
    errno = 0;
    (void)strtoull(text, &end, 10);
    return length > 0 && length <= 20 && strspn(text, "0123456789") == length && errno == 0;
}

static bool is_name(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)text[i] < 0x20 || text[i] == 0x7f)
            return false;
    return length > 0 && length <= FIELD_NAME_SIZE;
}

static int choice_of(const struct field *field, json_t *tree)
{
    for (int i = 0; json_is_string(tree) && field->choices[i] != NULL; i++)
        if (strcmp(field->choices[i], json_string_value(tree)) == 0)
            return i;
    return -1;
}

static bool list_fits(const struct field *field, json_t *tree)
{
    uint64_t set = 0;
    for (size_t i = 0; i < json_array_size(tree); i++) {
        json_t *item = json_array_get(tree, i);
        int choice = field->kind == FIELD_SET ? choice_of(field, item) : 0;
        bool fits = field->kind == FIELD_LIST ? record_fits(field->record, item)
                    : field->kind == FIELD_SET
                        ? choice >= 0 && (set >> choice & 1) == 0
                        : json_is_string(item) &&
                              is_name(json_string_value(item), json_string_length(item));
        if (!fits)
            return false;
        set |= UINT64_C(1) << choice;
    }
    return json_is_array(tree);
}

static bool value_fits(const struct field *field, json_t *tree)
{
    double value = json_number_value(tree);
    const char *text = json_string_value(tree);
    size_t length = json_string_length(tree);
    switch (field->kind) {
    case FIELD_REAL:
        return json_is_number(tree) && value >= field->low && value <= field->high;
    case FIELD_INTEGER:
        return json_is_number(tree) && value >= field->low && value <= field->high &&
               value == floor(value);
    case FIELD_FLAG:
        return json_is_boolean(tree);
    case FIELD_NAME:
        return json_is_string(tree) && is_name(text, length);
    case FIELD_CHOICE:
        return choice_of(field, tree) >= 0;
    case FIELD_SEED:
        return json_is_string(tree) && is_seed(text, length);
    case FIELD_SET:
    case FIELD_NAMES:
    case FIELD_LIST:
        return list_fits(field, tree);
    case FIELD_RECORD:
        return record_fits(field->record, tree);
    case FIELD_RAW:
        return true;
    case FIELD_NOTES:
        return false;
    }
    return false;
}

/* Every key is known, every value fits, nothing that must be there is missing. */
static bool record_fits(const struct record *record, json_t *tree)
{
    size_t known = 0;
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        json_t *value = json_object_get(tree, field->name);
        if (value == NULL ? !field->optional : !value_fits(field, value))
            return false;
        known += value != NULL;
    }
    return json_is_object(tree) && known == json_object_size(tree);
}

static bool same_record(const struct record *record, const void *base, json_t *tree);

static bool same_list(const struct field *field, const void *base, json_t *tree)
{
    struct field_list list = field_list(field, base);
    bool same = list.count == json_array_size(tree);
    for (size_t i = 0; same && i < list.count; i++) {
        json_t *item = json_array_get(tree, i);
        same = field->kind == FIELD_LIST
                   ? same_record(field->record, (const char *)list.items + i * field->record->size,
                                 item)
                   : strcmp(((const char *const *)list.items)[i], json_string_value(item)) == 0;
    }
    return same;
}

static bool same_set(const struct field *field, uint64_t set, json_t *tree)
{
    for (size_t i = 0; i < json_array_size(tree); i++)
        set ^= UINT64_C(1) << choice_of(field, json_array_get(tree, i));
    return set == 0;
}

/* The bytes of an extra are JSON that means the same. */
static bool same_raw(const char *bytes, json_t *tree)
{
    json_t *again = json_loads(bytes, JSON_DECODE_ANY | JSON_DECODE_INT_AS_REAL, NULL);
    bool same = json_equal(again, tree);
    json_decref(again);
    return same;
}

static bool same_number(const struct field *field, double ours, double number)
{
    double expected = number == 0 && field->low == 0 ? 0 : number;
    return memcmp(&ours, &expected, sizeof ours) == 0;
}

static bool same_value(const struct field *field, const void *base, json_t *tree)
{
    const void *member = (const char *)base + field->offset;
    switch (field->kind) {
    case FIELD_REAL:
        return same_number(field, LOAD(double, member), json_number_value(tree));
    case FIELD_INTEGER:
        return LOAD(int64_t, member) == (int64_t)json_number_value(tree);
    case FIELD_FLAG:
        return LOAD(bool, member) == json_is_true(tree);
    case FIELD_NAME:
        return strcmp(LOAD(const char *, member), json_string_value(tree)) == 0;
    case FIELD_CHOICE:
        return LOAD(int, member) == choice_of(field, tree);
    case FIELD_SEED:
        return LOAD(uint64_t, member) == strtoull(json_string_value(tree), NULL, 10);
    case FIELD_SET:
        return same_set(field, LOAD(uint64_t, member), tree);
    case FIELD_NAMES:
    case FIELD_LIST:
        return same_list(field, base, tree);
    case FIELD_RECORD:
        return same_record(field->record, member, tree);
    case FIELD_RAW:
        return same_raw(LOAD(const char *, member), tree);
    case FIELD_NOTES:
        return false;
    }
    return false;
}

static bool same_record(const struct record *record, const void *base, json_t *tree)
{
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        json_t *value = json_object_get(tree, field->name);
        /* What is absent is not written, so it must not count as present either. A member that is
         * there may spell out what absence stands for. */
        if (value == NULL ? field_present(record, field, base) : !same_value(field, base, value))
            return false;
    }
    return true;
}

/* Blanks what stands in the line for an extra that reaches over the position of an error, if one
 * of the record's does: true, and the length stays. */
static bool blank_extra(const struct record *record, const void *base, char *line, size_t length,
                        size_t position)
{
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        const void *member = (const char *)base + field->offset;
        const char *bytes = field->kind == FIELD_RAW ? LOAD(const char *, member) : NULL;
        struct field_list list =
            field->kind == FIELD_LIST ? field_list(field, base) : (struct field_list){0};
        for (char *at = line; bytes != NULL; at++) {
            at = memmem(at, length - (size_t)(at - line), bytes, strlen(bytes));
            if (at == NULL)
                break;
            size_t from = (size_t)(at - line);
            if (position < from || position > from + strlen(bytes))
                continue;
            memset(at, ' ', strlen(bytes));
            *at = '0';
            return true;
        }
        for (size_t i = 0; i < list.count; i++)
            if (blank_extra(field->record, (const char *)list.items + i * field->record->size, line,
                            length, position))
                return true;
    }
    return false;
}

/* jansson's strict verdict, but for keys that stand twice inside an extra of the frame. */
static json_t *load_strictly(const char *line, size_t length, const struct frame *frame, bool taken)
{
    char blanked[4 * LINE_SIZE];
    memcpy(blanked, line, length);
    for (;;) {
        json_error_t error;
        json_t *tree =
            json_loadb(blanked, length, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &error);
        if (tree != NULL || !taken || json_error_code(&error) != json_error_duplicate_key)
            return tree;
        if (!blank_extra(&frame_record, frame, blanked, length, (size_t)error.position))
            return NULL;
    }
}

/* Both verdicts, and the values, agree. Was the line taken? */
static bool check_line(const char *line, size_t length)
{
    struct frame frame = {.arena = check_arena()};
    struct diag diag = {0};
    bool taken = frame_text_read(line, length, &frame, &diag) == 0;
    json_t *strict = load_strictly(line, length, &frame, taken);
    bool expected = strict != NULL && record_fits(&frame_record, strict);
    if (taken != expected)
        fail_msg("%.*s: we say %s, jansson and the tables %s", (int)length, line,
                 taken ? "yes" : diag.text, expected ? "yes" : "no");
    json_t *tree = taken ? json_loadb(line, length, JSON_DECODE_INT_AS_REAL, NULL) : NULL;
    if (taken && !same_record(&frame_record, &frame, tree))
        fail_msg("%.*s: other values than jansson's", (int)length, line);
    json_decref(strict);
    json_decref(tree);
    return taken;
}

#define HEAD                                                                                       \
    "{\"version\":1,\"scene\":\"cut-in\",\"frame\":7,\"time_s\":0.28,\"interval_s\":0.04,"         \
    "\"last\":true,\"seed\":\"18446744073709551615\",\"ego\":\"e\",\"sections\":[\"account\"]"
#define ECHO                                                                                       \
    "\"object\":\"e\",\"reflector\":\"p\",\"path\":\"direct\",\"range_m\":12.25,"                  \
    "\"azimuth_rad\":-0.014320000000000001,\"range_rate_mps\":-1e-07,\"ercs\":2,\"time_s\":0.27"

/* Of every record and every kind of member; together with its head each is a line. */
static const char *const parts[] = {
    ",\"origin_x_m\":500000.25,\"objects\":[{\"id\":\"e\",\"class\":\"car\",\"x_m\":-0.0,"
    "\"y_m\":1e-7,\"yaw_rad\":0.1,\"vx_mps\":5e-324,\"vy_mps\":-2.5,\"yaw_rate_radps\":0,"
    "\"length_m\":4.5,\"width_m\":1.8,\"height_m\":1.5,\"travelled_m\":123456.789,\"extra\":"
    "{\"b\" : [1.0, 2e0 ],\"\\u0061\":0}}],\"lost\":[]}",
    ",\"reflectors\":[{\"model\":\"car\",\"objects\":[\"a\\\"b\",\"\xc3\xa9\"],\"blocks\":true,"
    "\"points\":[{\"name\":\"p\",\"x\":0.5,\"y\":-0.5,\"inset_m\":0.1,\"facing_rad\":0,"
    "\"full_rad\":0.5,\"zero_rad\":1.5,\"shape\":\"linear\",\"ercs\":0.7}],\"planes\":[],"
    "\"rows\":[]}],\"extra\":null}",
    ",\"sensors\":{\"suite\":\"s\",\"digest\":\"01\",\"list\":[{"
    "\"name\":\"f\",\"mount_x_m\":2,\"mount_y_m\":0,\"mount_yaw_rad\":0,\"field_of_view_rad\":3,"
    "\"range_max_m\":30,\"cell_range_m\":0.3,\"cell_range_rate_mps\":0.5,\"measured\":false}]},"
    "\"conditions\":{\"rain_mmph\":10},\"extra\":\"\\ud83d\\ude00\"}",
    ",\"echoes\":[{\"sensor\":\"f\"," ECHO ",\"effects\":[\"visibility\",\"occlusion\"],"
    "\"margins\":{\"sight_m\":0,\"sign\":1e-14},\"extra\":[true,{\"k\":1,\"k\":[]}]}]}",
    ",\"targets\":[{\"sensor\":\"f\",\"range_m\":1,\"azimuth_rad\":0,\"range_rate_mps\":0,"
    "\"amplitude_db\":-10.5,\"cell_range_m\":1,\"cell_azimuth_rad\":0,\"cell_range_rate_mps\":0,"
    "\"cell_amplitude\":2e0,\"contributors\":[{" ECHO ",\"weight\":1}]}]}",
    ",\"lost\":[{\"sensor\":\"f\",\"stage\":\"ideal\",\"reason\":\"blocked\",\"echoes\":[{"
    "\"object\":\"e\",\"reflector\":\"p\",\"path\":\"wall_object\",\"mirror\":\"w\",\"number\":2,"
    "\"by\":\"e\",\"shortfall_db\":3}]}],\"counts\":[{\"sensor\":\"f\",\"pairs\":2,\"paths\":[{"
    "\"path\":\"direct\",\"echoes\":1}]}]}",
};

/* Fragments by category: y is JSON, n is not, to RFC 8259 and to both readers. */
static const struct {
    const char *category, *fragments;
} valid[] =
    {
        {"literals", "null\ntrue\nfalse"},
        {"whole numbers", "0\n-0\n7\n-12\n10\n9007199254740993\n18446744073709551616\n"
                          "12345678901234567890\n100000000000000000000000000000000000000000000"},
        {"fractions",
         "0.0\n-0.0\n0.5\n-0.28\n1.000000000000000000000000000001\n0.28000000000000002665\n"
         "0.1000000000000000055511151231257827021181583404541015625\n123.456"},
        {"exponents", "1e5\n1E5\n1e+5\n1E-05\n0e0\n-0e+0\n0e400\n1e-400\n-1e-400\n5e-324\n2e-324\n"
                      "1.7976931348623157e308\n0.00001e309\n1e0000000000000001\n28e-2"},
        {"strings", "\"\"\n\"a\"\n\"cut in\"\n\"\x7f\"\n\"/\"\n\"a longer string of many words\"\n"
                    "\"exactly\"\n\"eight by\"\n\"nine byte\""},
        {"escapes", "\"\\\"\\\\\\/\\b\\f\\n\\r\\t\"\n\"\\u0041\"\n\"\\u00e9\\u20AC\"\n\"\\u007f\"\n"
                    "\"\\u0001\"\n\"\\uFFFF\"\n\"\\uFEFF\"\n\"\\u2028\"\n\"\\\\u0000\""},
        {"surrogate pairs",
         "\"\\ud83d\\ude00\"\n\"\\uD800\\uDC00\"\n\"\\udbff\\udfff\"\n\"x\\ud800\\udc00y\""},
        {"UTF-8",
         "\"\xc2\x80\"\n\"\xdf\xbf\"\n\"\xe0\xa0\x80\"\n\"\xed\x9f\xbf\"\n\"\xee\x80\x80\"\n"
         "\"\xef\xbf\xbf\"\n\"\xf0\x90\x80\x80\"\n\"\xf4\x8f\xbf\xbf\"\n\"seven77\xc3\xa9\"\n"
         "\"\xef\xbb\xbf\"\n\"\xe2\x80\xa8\""},
        {"white space",
         " 1\n1 \n\t1\r\n \t\r true \t\r\n[ ]\n{\t}\n[ 1\t,\r2 ]\n{ \"a\" : 1 , \"b\" : 2 }"},
        {"structure",
         "[]\n{}\n[[]]\n[[],{},[{}]]\n{\"\":{}}\n{\"a\":{\"b\":[1,{\"c\":null}]}}\n"
         "[\"]\",\"}\",\",\",\":\"]\n[1,2,3]\n{\"a\":1,\"b\":1}\n{\"extra\":{}}\n[0,-0,1e1]"},
},
  invalid[] = {
      {"literals",
       "nul\nnulll\nTrue\nTRUE\ntru\ntruefalse\nnil\nundefined\nNaN\n-NaN\nnan\nInfinity\n"
       "-Infinity\ninf\n-inf"},
      {"whole numbers", "-\n+1\n--1\n-a\n01\n-01\n00\n-00\n0x10\n0b1\n1_000\n1 2\n1a\n0a\n- "
                        "1\n\xef\xbc\x91\n012345678901234567890"},
      {"fractions", "1.\n.5\n-.5\n-1.\n1..2\n1.2.3\n1.e5\n0.\n.\n-."},
      {"exponents", "1e\n1E\n1e+\n1E-\n1e1.5\n1ee5\n1e5e5\n1e++5\ne5\n1e "
                    "5\n1e309\n-1e400\n1e99999999999999999999\n"
                    "1.7976931348623159e308\n123456789e301"},
      {"strings",
       "'a'\na\n\"\n\"a\n\"a\"b\n\"a\"\"b\"\n\\\"a\\\"\n\"a\tb\"\n\"\x1f\"\n\"\x01\"\n\"eight "
       "by\x1f\""},
      {"escapes", "\"\\\"\n\"\\\n\"\\x41\"\n\"\\a\"\n\"\\'"
                  "\"\n\"\\0\"\n\"\\U0041\"\n\"\\u\"\n\"\\u12\"\n\"\\u123\"\n"
                  "\"\\u12g4\"\n\"\\u+123\"\n\"\\u 123\"\n\"\\u0000\"\n\\u0031\n\"\\u00A\""},
      {"surrogate pairs",
       "\"\\ud800\"\n\"\\ud800a\"\n\"\\ud800\\n\"\n\"\\ud800\\ud800\"\n\"\\ud800\\u0041\"\n"
       "\"\\ud800\\udc0\"\n\"\\udc00\"\n\"\\udfff\\ud800\"\n\"\\ud800\\\"\n\"\\ud83d\xf0\x9f\x98"
       "\x80\""},
      {"UTF-8",
       "\"\x80\"\n\"\xbf\"\n\"\xc0\x80\"\n\"\xc1\xbf\"\n\"\xc2\"\n\"\xc2\x41\"\n\"\xe0\x9f\xbf\"\n"
       "\"\xe0\x80\x80\"\n\"\xe2\x82\"\n\"\xe2\x82\x41\"\n\"\xed\xa0\x80\"\n\"\xed\xbf\xbf\"\n"
       "\"\xed\xa0\xbd\xed\xb8\x80\"\n\"\xf0\x8f\xbf\xbf\"\n\"\xf0\x9f\x98\"\n\"\xf4\x90\x80\x80\""
       "\n"
       "\"\xf5\x80\x80\x80\"\n\"\xf8\x88\x80\x80\x80\"\n\"\xfe\"\n\"\xff\"\n\"\xe9\"\n\"seven77\xff"
       "\"\n"
       "\xc3\xa9\n\xff"},
      {"white space", "\v1\n\f1\n\xa0"
                      "1\n1\xc2\xa0\n\xe2\x81\xa0"
                      "1\n[\v]\n[1,\f2]\n\x1e{}"},
      {"byte order marks", "\xef\xbb\xbf[]\n\xef\xbb\xbf\"a\"\n\xef\xbb\xbf"
                           "1\n\xff\xfe[\x01]"},
      {"structure",
       "[\n]\n[1\n[1,\n[1}\n{\"a\":1]\n[1]]\n[]]\n{\n}\n{]\n{}}\n[1 "
       "2]\n[1;2]\n[\"a\"1]\n[:]\n[\"a\":1]\n"
       "{\"a\"}\n{\"a\":}\n{\"a\",1}\n{\"a\" 1}\n{\"a\"::1}\n{\"a\":1\n{a:1}\n{'a':1}\n{1:1}\n"
       "{null:1}\n{[]:1}\n{\"a\":1 \"b\":2}\n{\"a\":1}#\n[1]//\n[/**/]\n[1]x\n[-]\n<null>\n*\n"
       "{\"a\":1}{\"b\":2}\n[\"a\\\"]\n["},
      {"commas", "[,]\n[1,]\n[,1]\n[1,,2]\n{,}\n{\"a\":1,}\n{,\"a\":1}\n{\"a\":1,,\"b\":2}\n{\"a\":"
                 "1,,}\n,\n1,"},
};

/* Where a fragment is put: for a value of each kind, among the keys, inside extra, and outside. */
static const char *const places[] = {
    "{\"version\":1,\"scene\":\"s\",\"frame\":0,\"time_s\":@,\"interval_s\":1,\"seed\":\"1\","
    "\"ego\":\"e\"}",
    "{\"version\":@,\"scene\":\"s\",\"frame\":0,\"time_s\":1,\"interval_s\":1,\"seed\":\"1\","
    "\"ego\":\"e\"}",
    "{\"version\":1,\"scene\":@,\"frame\":0,\"time_s\":1,\"interval_s\":1,\"seed\":\"1\",\"ego\":"
    "\"e\"}",
    "{\"version\":1,\"scene\":\"s\",\"frame\":@,\"time_s\":1,\"interval_s\":1,\"seed\":\"1\","
    "\"ego\":\"e\"}",
    "{\"version\":1,\"scene\":\"s\",\"frame\":0,\"time_s\":1,\"interval_s\":1,\"seed\":@,\"ego\":"
    "\"e\"}",
    HEAD ",\"margins\":@}",
    HEAD ",\"objects\":@}",
    HEAD ",\"sensors\":@}",
    HEAD ",\"conditions\":@}",
    HEAD ",\"echoes\":[@]}",
    HEAD ",@:1}",
    HEAD ",@}",
    HEAD "}@",
    "@" HEAD "}",
    "@",
    HEAD ",\"extra\":@}",
    HEAD ",\"extra\":[@]}",
    HEAD ",\"extra\":[1,@,2]}",
    HEAD ",\"extra\":{\"k\":@}}",
    HEAD ",\"extra\":{\"k\":[@],\"l\":{}}}",
};

enum { IN_EXTRA = 5 }; /* the last of the places */

static bool check_place(const char *place, const char *fragment, size_t length)
{
    char line[2 * LINE_SIZE];
    size_t before = strcspn(place, "@");
    int size = snprintf(line, sizeof line, "%.*s%.*s%s", (int)before, place, (int)length, fragment,
                        place + before + 1);
    assert_in_range(size, 0, sizeof line - 1);
    return check_line(line, (size_t)size);
}

static void check_category(const char *fragments, bool is_json)
{
    for (const char *at = fragments; *at != '\0'; at += *at == '\n') {
        size_t length = strcspn(at, "\n");
        for (size_t i = 0; i < COUNT(places); i++) {
            bool taken = check_place(places[i], at, length);
            if (i >= COUNT(places) - IN_EXTRA && taken != is_json)
                fail_msg("%.*s was %s inside extra", (int)length, at, taken ? "taken" : "refused");
        }
        at += length;
    }
}

TEST(every_category_is_judged_as_jansson_judges_it)
{
    for (size_t i = 0; i < COUNT(valid); i++)
        check_category(valid[i].fragments, true);
    for (size_t i = 0; i < COUNT(invalid); i++)
        check_category(invalid[i].fragments, false);
}

TEST(the_lines_to_be_mutated_are_frames)
{
    for (size_t i = 0; i < COUNT(parts); i++) {
        char line[LINE_SIZE];
        int length = snprintf(line, sizeof line, "%s%s", HEAD, parts[i]);
        assert_in_range(length, 0, LINE_SIZE - 1);
        if (!check_line(line, (size_t)length))
            fail_msg("%s was refused", line);
    }
}

TEST(values_nest_in_extra_to_our_own_limit)
{
    for (size_t depth = JSON_SCAN_DEPTH - 1; depth <= 2 * JSON_SCAN_DEPTH; depth++) {
        struct frame frame = {.arena = check_arena()};
        struct diag diag = {0};
        struct text line = {0};
        text_add_word(&line, HEAD ",\"extra\":");
        memset(text_room(&line, depth), '[', depth);
        line.length += depth;
        memset(text_room(&line, depth), ']', depth);
        line.length += depth;
        text_add_word(&line, "}");
        bool taken = frame_text_read(line.bytes, line.length, &frame, &diag) == 0;
        json_t *tree = json_loadb(line.bytes, line.length, 0, NULL);
        assert_non_null(tree);
        assert_int_equal(taken, depth <= JSON_SCAN_DEPTH);
        json_decref(tree);
        text_free(&line);
    }
}

TEST(a_key_may_stand_twice_inside_extra_alone)
{
    static const char *const taken[] = {HEAD ",\"extra\":{\"k\":1,\"k\":2}}",
                                        HEAD ",\"extra\":[{\"k\":[{\"a\":0,\"\\u0061\":1}]}]}"};
    static const char *const refused[] = {
        HEAD ",\"last\":true}", HEAD ",\"l\\u0061st\":true}", HEAD ",\"extra\":1,\"extra\":1}",
        HEAD ",\"extra\":{\"k\":1,\"k\":2},\"ego\":\"e\"}",
        HEAD ",\"sensors\":{\"suite\":\"s\",\"suite\":\"s\",\"digest\":\"1\",\"list\":[]}}"};
    for (size_t i = 0; i < COUNT(taken); i++)
        assert_true(check_line(taken[i], strlen(taken[i])));
    for (size_t i = 0; i < COUNT(refused); i++)
        assert_false(check_line(refused[i], strlen(refused[i])));
}

static size_t pick(uint64_t *random, size_t count)
{
    return (size_t)(sample_bits(random) % count);
}

/* Puts size bytes in the place of removed ones, if the line has room. */
static size_t splice(char *line, size_t length, size_t at, size_t removed, const char *bytes,
                     size_t size)
{
    if (at + removed > length || length - removed + size > LINE_SIZE)
        return length;
    memmove(line + at + size, line + at + removed, length - at - removed);
    memcpy(line + at, bytes, size);
    return length - removed + size;
}

/* A fragment of a random category. */
static const char *any_fragment(uint64_t *random, size_t *size)
{
    bool good = pick(random, 2) == 0;
    const char *all = good ? valid[pick(random, COUNT(valid))].fragments
                           : invalid[pick(random, COUNT(invalid))].fragments;
    const char *from = all + pick(random, strlen(all));
    while (from > all && from[-1] != '\n')
        from--;
    *size = strcspn(from, "\n");
    return from;
}

/* The value, or the rest of one, behind a random colon. */
static size_t replace_value(char *line, size_t length, uint64_t *random)
{
    size_t at = pick(random, length), size;
    while (at > 0 && line[at - 1] != ':')
        at--;
    size_t end = at;
    while (end < length && line[end] != ',' && line[end] != '}' && line[end] != ']')
        end++;
    const char *fragment = any_fragment(random, &size);
    return splice(line, length, at, end - at, fragment, size);
}

/* Bytes of the line again at another place, or instead of others: keys that stand twice, values of
 * other members. */
static size_t copy_part(char *line, size_t length, uint64_t *random)
{
    char part[40];
    size_t size = pick(random, sizeof part), from = pick(random, length);
    size = from + size <= length ? size : length - from;
    memcpy(part, line + from, size);
    return splice(line, length, pick(random, length), pick(random, 2) * size, part, size);
}

static size_t change(char *line, size_t length, uint64_t *random)
{
    static const char bytes[] =
        "{}[]:,\"\\ \t\r0123456789-+.eEtfnu/bdD8cC\x80\xbf\xc2\xe2\xed\xf0\x9f\x01\x7f";
    static const char numbers[] = "01234567890.5e2-1e9";
    const char *byte = &bytes[pick(random, sizeof bytes - 1)];
    size_t at = pick(random, length);
    size_t digit = at + strcspn(line + at, "0123456789");
    switch (pick(random, 8)) {
    case 0:
        return splice(line, length, at, 1, byte, 1);
    case 1:
        return splice(line, length, at, 1, byte, 0);
    case 2:
        return splice(line, length, at, 0, byte, 1);
    case 3:
        return splice(line, length, digit, 1, byte, 1);
    case 4:
    case 5:
        return splice(line, length, digit, pick(random, 2),
                      &numbers[pick(random, sizeof numbers - 3)], pick(random, 3));
    case 6:
        return replace_value(line, length, random);
    default:
        return copy_part(line, length, random);
    }
}

TEST(mutated_lines_are_judged_as_jansson_judges_them)
{
    int64_t lines = (int64_t)check_cases(100000), taken = 0;
    struct progress progress;
    progress_begin(&progress, "lines");
    uint64_t random = 5;
    for (int64_t i = 0; i < lines; i++) {
        char line[LINE_SIZE + 1] = "";
        size_t length =
            (size_t)snprintf(line, sizeof line, "%s%s", HEAD, parts[pick(&random, COUNT(parts))]);
        assert_in_range(length, 0, LINE_SIZE);
        for (size_t changes = 1 + pick(&random, 2); changes > 0 && length > 0; changes--)
            length = change(line, length, &random);
        taken += check_line(line, length);
        if (progress_step(&progress))
            progress_show(&progress, (double)progress.count / (double)lines);
    }
    progress_end(&progress);
    print_message("%lld of %lld lines were taken\n", (long long)taken, (long long)lines);
    assert_in_range(taken, lines / 20, lines / 2);
}
