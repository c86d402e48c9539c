#include "check.h"

#include "text/field.h"
#include "text/record_read.h"
#include "text/record_write.h"

enum colour { RED, GREEN, BLUE };
static const char *const colours[] = {"red", "green", "blue", NULL};

struct part {
    double width_m;
};

struct thing {
    double range_m;
    double gain;
    int64_t number;
    bool flag;
    const char *name;
    enum colour colour;
    uint64_t seed;
    LIST_OF(const char *) names;
    struct part part;
    LIST_OF(struct part) parts;
    const char *extra;
    double maybe_s;
    enum colour tint;
    LIST_OF(struct part) group;
    unsigned present;
};

static const struct field part_fields[] = {
    {FIELD_REAL_IN(struct part, width_m, 0, 10, "width"), .absent = 2}, {0}};
static const struct record part_record = {
    .name = "part", .size = sizeof(struct part), .fields = part_fields};

enum {
    RANGE,
    GAIN,
    NUMBER,
    FLAG,
    NAME,
    COLOUR,
    SEED,
    NAMES,
    PART,
    PARTS,
    EXTRA,
    MAYBE,
    TINT,
    IN_GROUP
};

static const struct field fields[] = {
    [RANGE] = {FIELD_REAL_IN(struct thing, range_m, -1.5, 1e6, "range")},
    [GAIN] = {FIELD_REAL_IN(struct thing, gain, 0, 0.1, "gain")},
    [NUMBER] = {FIELD_INTEGER_IN(struct thing, number, -5, 9007199254740991, "number")},
    [FLAG] = {FIELD_FLAG_OF(struct thing, flag, "flag"), FIELD_OPTIONAL},
    [NAME] = {FIELD_NAME_OF(struct thing, name, "name")},
    [COLOUR] = {FIELD_CHOICE_OF(struct thing, colour, colours, "colour")},
    [SEED] = {FIELD_SEED_OF(struct thing, seed, "seed")},
    [NAMES] = {FIELD_NAMES_OF(struct thing, names, "names")},
    [PART] = {FIELD_RECORD_OF(struct thing, part, &part_record, "part")},
    [PARTS] = {FIELD_LIST_OF(struct thing, parts, &part_record, "parts"), FIELD_OPTIONAL},
    [EXTRA] = {FIELD_RAW_OF(struct thing, extra, "extra")},
    [MAYBE] = {FIELD_REAL_IN(struct thing, maybe_s, -10, 10, "maybe"), FIELD_OPTIONAL,
               .absent = 0.5},
    [TINT] = {FIELD_CHOICE_OF(struct thing, tint, colours, "tint"), FIELD_OPTIONAL,
              .absent = GREEN},
    [IN_GROUP] = {FIELD_LIST_OF(struct thing, group, &part_record, "group"), FIELD_OPTIONAL,
                  .group = 4},
    {0}};
static const struct record record = {.name = "thing",
                                     .size = sizeof(struct thing),
                                     .fields = fields,
                                     .present_offset = offsetof(struct thing, present)};

TEST(the_ending_of_a_name_is_its_unit)
{
    static const char *const cases[][2] = {{"range_m", "m"},
                                           {"time_s", "s"},
                                           {"range_rate_mps", "m/s"},
                                           {"acceleration_mps2", "m/s²"},
                                           {"azimuth_rad", "rad"},
                                           {"yaw_rate_radps", "rad/s"},
                                           {"carrier_hz", "Hz"},
                                           {"threshold_db", "dB"},
                                           {"ercs", ""},
                                           {"m", ""},
                                           {"_m", ""},
                                           {"stream", ""},
                                           {"class", ""},
                                           {"m_x", ""}};
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_string_equal(field_unit(cases[i][0]), cases[i][1]);
}

TEST(members_are_found_by_their_whole_name)
{
    for (size_t i = 0; fields[i].name != NULL; i++)
        assert_ptr_equal(field_find(&record, fields[i].name, strlen(fields[i].name)), &fields[i]);
    assert_ptr_equal(field_find(&record, "names", 4), &fields[NAME]);
    assert_null(field_find(&record, "namesx", 6));
    assert_null(field_find(&record, "nam", 3));
    assert_null(field_find(&record, "", 0));
    assert_null(field_find(&record, "Name", 4));
}

TEST(absent_members_have_their_value_and_are_recognized)
{
    struct thing thing;
    memset(&thing, 0xff, sizeof thing);
    field_clear(&record, &thing);
    assert_close(thing.maybe_s, 0.5, 0);
    assert_int_equal(thing.tint, GREEN);
    assert_close(thing.part.width_m, 2, 0);
    assert_null(thing.name);
    static const int optional[] = {FLAG, PARTS, EXTRA, MAYBE, TINT, IN_GROUP};
    for (size_t i = 0; i < COUNT(optional); i++)
        assert_false(field_present(&record, &fields[optional[i]], &thing));
    static const int needed[] = {RANGE, NUMBER, NAME, COLOUR, SEED, NAMES, PART};
    for (size_t i = 0; i < COUNT(needed); i++)
        assert_true(field_present(&record, &fields[needed[i]], &thing));
    thing.flag = true;
    thing.extra = "1";
    thing.maybe_s = 0;
    thing.tint = RED;
    field_list_add(&fields[PARTS], &thing, check_arena());
    field_mark_present(&record, &fields[IN_GROUP], &thing);
    field_mark_present(&record, &fields[RANGE], &thing);
    assert_int_equal(thing.present, 4);
    for (size_t i = 0; i < COUNT(optional); i++)
        assert_true(field_present(&record, &fields[optional[i]], &thing));
}

static struct thing whole_thing(struct arena *arena)
{
    struct thing thing;
    field_clear(&record, &thing);
    thing.gain = 0.01;
    thing.name = arena_text(arena, "a", 1);
    thing.part.width_m = 1;
    thing.extra = arena_text(arena, "[1]", 3);
    *list_add(&thing.names, arena) = arena_text(arena, "ab", 2);
    *list_add(&thing.parts, arena) = thing.part;
    *list_add(&thing.group, arena) = thing.part;
    field_mark_present(&record, &fields[IN_GROUP], &thing);
    return thing;
}

/* So many things of which each differs from a whole one in another member. */
enum { CHANGES = 17 };

static void make_changed(struct thing changed[CHANGES], struct arena *arena)
{
    for (int i = 0; i < CHANGES; i++)
        changed[i] = whole_thing(arena);
    changed[0].range_m = -0.0;
    changed[1].gain = 0.02;
    changed[2].number = 1;
    changed[3].flag = true;
    changed[4].name = "b";
    changed[5].colour = BLUE;
    changed[6].seed = UINT64_MAX;
    changed[7].names.items[0] = "ac";
    changed[8].names.count = 0;
    changed[9].part.width_m = 2;
    changed[10].parts.items[0].width_m = 2;
    changed[11].parts.count = 0;
    changed[12].extra = "[2]";
    changed[13].extra = NULL;
    changed[14].maybe_s = 0;
    changed[15].tint = RED;
    changed[16].present = 0;
}

static const char *text_of(const struct thing *thing)
{
    struct text *text = check_text();
    record_write(&record, thing, NULL, text);
    text_add(text, "", 1);
    return text->bytes;
}

TEST(structs_are_the_same_if_their_texts_are)
{
    struct arena *arena = check_arena();
    struct thing one = whole_thing(arena), other = whole_thing(arena);
    struct thing changed[CHANGES], again[CHANGES];
    assert_true(field_same(&record, &one, &other));
    make_changed(changed, arena);
    make_changed(again, arena);
    for (int i = 0; i < CHANGES; i++)
        for (int k = 0; k < CHANGES; k++) {
            bool same_text = strcmp(text_of(&changed[i]), text_of(&again[k])) == 0;
            assert_int_equal(same_text, i == k);
            assert_int_equal(field_same(&record, &changed[i], &again[k]), i == k);
        }
    /* Of a group that is absent no member counts. */
    one.present = other.present = 0;
    other.group.count = 0;
    assert_true(field_same(&record, &one, &other));
}

TEST(an_optional_record_with_groups_is_present_with_any_of_them)
{
    static const struct field inner_fields[] = {
        {FIELD_REAL_IN(struct thing, gain, 0, 1, "zero is a gain"), FIELD_OPTIONAL, .group = 1},
        {FIELD_REAL_IN(struct thing, range_m, 0, 1, "range"), FIELD_OPTIONAL, .group = 2},
        {0}};
    static const struct record inner = {.name = "inner",
                                        .size = sizeof(struct thing),
                                        .fields = inner_fields,
                                        .present_offset = offsetof(struct thing, present)};
    const struct field outer = {.name = "outer",
                                .kind = FIELD_RECORD,
                                FIELD_OPTIONAL,
                                .offset = sizeof(struct thing),
                                .record = &inner};
    struct thing things[2] = {{.gain = 0.5, .present = 1}, {.gain = 0.5}};
    assert_false(field_present(&record, &outer, things));
    things[1] = (struct thing){.gain = 0, .present = 1};
    assert_true(field_present(&record, &outer, things));
    things[1].present = 2;
    assert_true(field_present(&record, &outer, things));
}

/* The lower half of 0.5 is all zeros. */
TEST(an_optional_record_without_groups_is_present_with_any_member)
{
    static const struct field inner_fields[] = {
        {FIELD_REAL_IN(struct thing, gain, 0, 1, "gain"), FIELD_OPTIONAL},
        {FIELD_REAL_IN(struct thing, range_m, 0, 1, "range"), FIELD_OPTIONAL},
        {0}};
    static const struct record inner = {
        .name = "inner", .size = sizeof(struct thing), .fields = inner_fields};
    static const struct field outer = {.name = "inner",
                                       .kind = FIELD_RECORD,
                                       FIELD_OPTIONAL,
                                       .offset = sizeof(struct thing),
                                       .record = &inner};
    struct thing things[2] = {{.gain = 0.5}, {.gain = 0}};
    assert_false(field_present(&record, &outer, things));
    things[1].gain = 0.5;
    assert_true(field_present(&record, &outer, things));
    things[1] = (struct thing){.range_m = 0.25};
    assert_true(field_present(&record, &outer, things));
}

TEST(numbers_are_taken_between_their_bounds)
{
    static const struct {
        int field;
        double value;
        const char *message;
    } cases[] = {
        {RANGE, -1.5, NULL},
        {RANGE, 1e6, NULL},
        {GAIN, 0.1, NULL},
        {GAIN, 0, NULL},
        {GAIN, -0.0, NULL},
        {NUMBER, -5, NULL},
        {NUMBER, 9007199254740991, NULL},
        {RANGE, -1.5000000000000002, "range_m: -1.5000000000000002 is outside [-1.5, 1e6] m"},
        {RANGE, 1000000.0000000001, "range_m: 1000000.0000000001 is outside [-1.5, 1e6] m"},
        {GAIN, 0.10000000000000002, "gain: 0.10000000000000002 is outside [0, 0.1]"},
        {GAIN, -5e-324, "gain: -5e-324 is outside [0, 0.1]"},
        {RANGE, (double)NAN, "range_m: nan is outside [-1.5, 1e6] m"},
        {RANGE, (double)INFINITY, "range_m: inf is outside [-1.5, 1e6] m"},
        {NUMBER, 0.5, "number: 0.5 is not a whole number"},
        {NUMBER, -6, "number: -6 is outside [-5, 9007199254740991]"},
        {NUMBER, 9007199254740992, "number: 9007199254740992 is outside [-5, 9007199254740991]"},
        {NAME, 1, "name: a number; expected a name"},
        {FLAG, 1, "flag: a number; expected true or false"},
        {SEED, 1, "seed: a number; expected a string of digits"},
        {COLOUR, 1, "colour: a number; expected one of red, green, blue"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct thing thing = {0};
        struct diag diag = {0};
        int result = field_set_number(&fields[cases[i].field], &thing, cases[i].value, &diag);
        assert_int_equal(result, cases[i].message == NULL ? 0 : -1);
        assert_string_equal(diag.text, cases[i].message != NULL ? cases[i].message : "");
        if (result == 0)
            assert_close(cases[i].field == NUMBER  ? (double)thing.number
                         : cases[i].field == RANGE ? thing.range_m
                                                   : thing.gain,
                         cases[i].value, 0);
    }
}

TEST(minus_zero_is_zero_where_numbers_begin_at_zero)
{
    static const char *const texts[] = {"-0", "-0.0", "-0e3", "-1e-400"};
    static const struct field signed_fields[] = {
        {FIELD_REAL_IN(struct part, width_m, -10, 10, "width")}, {0}};
    static const struct record signed_record = {
        .name = "part", .size = sizeof(struct part), .fields = signed_fields};
    for (size_t i = 0; i < COUNT(texts); i++) {
        struct arena arena = {0};
        struct part part = {0};
        char line[32];
        int length = snprintf(line, sizeof line, "{\"width_m\":%s}", texts[i]);
        assert_done(record_read, line, (size_t)length, &part_record, &part, &arena, NULL);
        assert_false(signbit(part.width_m));
        assert_done(record_read, line, (size_t)length, &signed_record, &part, &arena, NULL);
        assert_true(signbit(part.width_m));
        arena_free(&arena);
    }
}

static int set_text(int field, struct thing *thing, const char *text, struct arena *arena,
                    struct diag *diag)
{
    *diag = (struct diag){0};
    return field_set_text(&fields[field], thing, text, strlen(text), arena, diag);
}

TEST(seeds_have_64_bits)
{
    static const struct {
        const char *text;
        uint64_t seed;
    } good[] = {{"0", 0},
                {"1", 1},
                {"007", 7},
                {"9007199254740993", 9007199254740993},
                {"18446744073709551615", UINT64_MAX},
                {"18446744073709551609", UINT64_MAX - 6}};
    struct thing thing = {0};
    for (size_t i = 0; i < COUNT(good); i++) {
        assert_done(set_text, SEED, &thing, good[i].text, check_arena());
        assert_true(thing.seed == good[i].seed);
    }
    static const char *const bad[] = {"",
                                      "-1",
                                      "+1",
                                      " 1",
                                      "1 ",
                                      "1.0",
                                      "0x1",
                                      "1e3",
                                      "a",
                                      "18446744073709551616",
                                      "18446744073709551620",
                                      "99999999999999999999",
                                      "100000000000000000000",
                                      "000000000000000000001"};
    for (size_t i = 0; i < COUNT(bad); i++) {
        char message[160];
        snprintf(message, sizeof message,
                 "seed: \"%s\" is no seed; expected decimal digits up to 18446744073709551615",
                 bad[i]);
        assert_refused(DIAG_DATA, message, set_text, SEED, &thing, bad[i], check_arena());
    }
}

TEST(names_and_choices_are_checked)
{
    struct arena *arena = check_arena();
    struct thing thing = {0};
    struct diag diag;
    char name[FIELD_NAME_SIZE + 2];
    memset(name, 'n', sizeof name);
    name[FIELD_NAME_SIZE + 1] = '\0';
    assert_refused(DIAG_DATA, "name: a name of 1025 bytes; expected 1 to 1024", set_text, NAME,
                   &thing, name, arena);
    name[FIELD_NAME_SIZE] = '\0';
    assert_done(set_text, NAME, &thing, name, arena);
    assert_string_equal(thing.name, name);
    assert_true(thing.name != name);
    assert_int_equal(set_text(NAME, &thing, "", arena, &diag), -1);
    assert_refused(DIAG_DATA, "name: control character 0x7f in a name", set_text, NAME, &thing,
                   "a\x7f", arena);
    assert_int_equal(set_text(NAME, &thing, "\t", arena, &diag), -1);
    for (int i = 0; colours[i] != NULL; i++) {
        assert_done(set_text, COLOUR, &thing, colours[i], arena);
        assert_int_equal(thing.colour, i);
    }
    static const char *const wrong[] = {"", "Red", "re", "redd", "red "};
    for (size_t i = 0; i < COUNT(wrong); i++)
        assert_int_equal(set_text(COLOUR, &thing, wrong[i], arena, &diag), -1);
    assert_string_equal(
        diag.text,
        "colour: \"red \" is unknown (did you mean red?); expected one of red, green, blue");
    assert_refused(DIAG_DATA, "range_m: a string; expected a number in [-1.5, 1e6] m", set_text,
                   RANGE, &thing, "1", arena);
}

TEST(a_text_is_a_number_only_as_a_whole)
{
    static const char *const bad[] = {"",      " ",        "1 ",    " 1", "nan", "inf",
                                      "-inf",  "infinity", "0x10",  "1e", "-",   "e5",
                                      "1e999", "1,5",      "12abc", "+1", "--1"};
    double value;
    for (size_t i = 0; i < COUNT(bad); i++)
        if (field_read_number(bad[i], strlen(bad[i]), &value) == 0)
            fail_msg("\"%s\" was taken", bad[i]);
    assert_int_equal(field_read_number("-1.5e-3", 7, &value), 0);
    assert_close(value, -1.5e-3, 0);
}

TEST(a_missing_member_is_named_with_what_it_may_be)
{
    static const struct {
        int field;
        const char *message;
    } cases[] = {{RANGE, "range_m: missing; expected a number in [-1.5, 1e6] m"},
                 {NUMBER, "number: missing; expected a whole number in [-5, 9007199254740991]"},
                 {NAME, "name: missing; expected a name"},
                 {COLOUR, "colour: missing; expected one of red, green, blue"},
                 {SEED, "seed: missing; expected a string of digits"},
                 {NAMES, "names: missing; expected an array of names"},
                 {PART, "part: missing; expected an object"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        assert_refused(DIAG_DATA, cases[i].message, field_refuse, &fields[cases[i].field],
                       "missing");
    }
    assert_refused(DIAG_DATA,
                   "with_m: unknown key (did you mean width_m?); expected one of width_m",
                   field_unknown, &part_record, "with_m", 6);
    assert_refused(DIAG_DATA, "name: the key stands twice", field_twice, &fields[NAME]);
}

/* Seventy numbers: m00 to m68 may be absent, and are 3 then; m69 must be there. */
#define TEN(EACH, tens)                                                                            \
    EACH(tens##0)                                                                                  \
    EACH(tens##1)                                                                                  \
    EACH(tens##2)                                                                                  \
    EACH(tens##3)                                                                                  \
    EACH(tens##4)                                                                                  \
    EACH(tens##5) EACH(tens##6) EACH(tens##7) EACH(tens##8) EACH(tens##9)
#define SEVENTY(EACH)                                                                              \
    TEN(EACH, m0)                                                                                  \
    TEN(EACH, m1) TEN(EACH, m2) TEN(EACH, m3) TEN(EACH, m4) TEN(EACH, m5) TEN(EACH, m6)
#define MEMBER(name) double name;
#define FIELD(name) {FIELD_REAL_IN(struct wide, name, 0, 9, ""), FIELD_OPTIONAL, .absent = 3},
struct wide {
    SEVENTY(MEMBER)
};

TEST(a_table_may_have_more_than_64_members)
{
    struct field wide_fields[] = {SEVENTY(FIELD){0}};
    wide_fields[69].optional = false;
    const struct record wide_record = {.size = sizeof(struct wide), .fields = wide_fields};
    static const char good[] = "{\"m68\":1,\"m69\":2,\"m02\":4}", last[] = "{\"m02\":4,\"m68\":1}",
                      twice[] = "{\"m68\":1,\"m69\":2,\"m68\":1}";
    struct arena *arena = check_arena();
    struct wide wide = {0};
    assert_done(record_read, good, strlen(good), &wide_record, &wide, arena, NULL);
    assert_true(wide.m68 == 1 && wide.m69 == 2 && wide.m02 == 4);
    assert_true(wide.m00 == 3 && wide.m63 == 3 && wide.m64 == 3 && wide.m67 == 3);
    assert_refused(DIAG_DATA, "m69: missing; expected a number in [0, 9]", record_read, last,
                   strlen(last), &wide_record, &wide, arena, NULL);
    assert_refused(DIAG_DATA, "m68: the key stands twice", record_read, twice, strlen(twice),
                   &wide_record, &wide, arena, NULL);
}

TEST(a_number_is_that_of_the_fields_kind)
{
    struct thing thing = {.gain = 0.05, .number = -4, .flag = true, .colour = BLUE, .name = "n"};
    assert_close(field_number(&fields[GAIN], &thing), 0.05, 0);
    assert_close(field_number(&fields[NUMBER], &thing), -4, 0);
    assert_close(field_number(&fields[FLAG], &thing), 1, 0);
    assert_close(field_number(&fields[COLOUR], &thing), 2, 0);
    assert_close(field_number(&fields[NAME], &thing), 0, 0);
}
