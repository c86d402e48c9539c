#include "check.h"

#include "export/csv_columns.h"

enum colour { COLOUR_NONE, COLOUR_RED };
static const char *const colours[] = {"none", "red", NULL};
static const char *const things[] = {"wheel", "door", "roof", NULL};

struct inner {
    double size_m, weight;
};

struct outer {
    double x_m, known_m;
    int64_t whole, absent;
    bool flag;
    const char *name;
    enum colour colour;
    uint64_t seed, set;
    LIST_OF(const char *) names;
    const char *extra;
    struct inner inner;
};

static const struct field inner_fields[] = {
    {FIELD_REAL_IN(struct inner, size_m, 0, 9, "size"), FIELD_OPTIONAL},
    {FIELD_REAL_IN(struct inner, weight, 0, 9, "weight"), FIELD_OPTIONAL},
    {0},
};
static const struct record inner_record = {
    FIELD_TABLE(struct inner, inner_fields, "inner", "For tests.")};

static const struct field outer_fields[] = {
    {FIELD_REAL_IN(struct outer, x_m, -9, 9, "place")},
    {FIELD_REAL_IN(struct outer, known_m, 0, 9, "0: not known"), FIELD_OPTIONAL},
    {FIELD_INTEGER_IN(struct outer, whole, -1e15, 1e15, "whole")},
    {FIELD_INTEGER_IN(struct outer, absent, 0, 9, "absent: -1"), FIELD_OPTIONAL, .absent = -1},
    {FIELD_FLAG_OF(struct outer, flag, "flag"), FIELD_OPTIONAL},
    {FIELD_NAME_OF(struct outer, name, "name"), FIELD_OPTIONAL},
    {FIELD_CHOICE_OF(struct outer, colour, colours, "colour")},
    {FIELD_SEED_OF(struct outer, seed, "seed")},
    {FIELD_SET_OF(struct outer, set, things, "set"), FIELD_OPTIONAL},
    {FIELD_NAMES_OF(struct outer, names, "no column")},
    {FIELD_RAW_OF(struct outer, extra, "no column")},
    {FIELD_RECORD_OF(struct outer, inner, &inner_record, "inner"), FIELD_OPTIONAL},
    {0},
};
static const struct record outer_record = {
    FIELD_TABLE(struct outer, outer_fields, "outer", "For tests.")};

static const char *const none[] = {NULL};

static void check_columns(struct csv_columns columns, const struct outer *outer,
                          const char *const *without, const char *expected)
{
    struct text *row = check_text();
    csv_columns_add(&columns, &outer_record, without, check_arena());
    if (outer != NULL)
        csv_columns_write(&columns, outer, row);
    else
        csv_columns_write_names(&columns, row);
    csv_columns_end_row(row);
    text_add(row, "", 1);
    assert_string_equal(row->bytes, expected);
}

static void check_row(const struct outer *outer, const char *const *without, const char *expected)
{
    check_columns((struct csv_columns){0}, outer, without, expected);
}

TEST(members_are_columns_and_those_of_structs_have_its_name_before_theirs)
{
    check_row(NULL, none,
              "x_m,known_m,whole,absent,flag,name,colour,seed,set,inner_size_m,inner_weight\n");
    static const char *const without[] = {"whole", "inner", NULL};
    check_row(NULL, without, "x_m,known_m,absent,flag,name,colour,seed,set\n");
}

TEST(values_are_written_as_in_json_and_absent_ones_not_at_all)
{
    struct outer outer = {.x_m = 0.1 + 0.2, .whole = -INT64_C(9007199254740993), .absent = -1};
    check_row(&outer, none, "0.30000000000000004,,-9007199254740993,,false,,none,0,,,\n");
    outer = (struct outer){.x_m = -0.0,
                           .known_m = 1e-7,
                           .flag = true,
                           .name = "plain",
                           .colour = COLOUR_RED,
                           .seed = UINT64_MAX,
                           .set = 5,
                           .inner.weight = 2};
    check_row(&outer, none, "-0.0,1e-07,0,0,true,plain,red,18446744073709551615,wheel roof,,2\n");
}

TEST(zeros_stand_for_absent_numbers_where_they_are_wanted_but_not_in_an_absent_struct)
{
    check_columns((struct csv_columns){.zeros = true}, &(struct outer){0}, none,
                  "0,0,0,0,false,,none,0,,,\n");
    check_columns((struct csv_columns){.zeros = true}, &(struct outer){.inner.weight = 2}, none,
                  "0,0,0,0,false,,none,0,,0,2\n");
}

TEST(a_choice_has_its_word_where_a_line_would_lack_it_and_none_if_it_has_no_word)
{
    struct choices {
        enum colour usual;
        int shade;
    };
    static const struct field fields[] = {
        {OPTIONAL_CHOICE(struct choices, usual, colours, "absent: none")},
        {OPTIONAL_CHOICE(struct choices, shade, colours, "absent: no word"), .absent = 2},
        {0},
    };
    static const struct record record = {
        FIELD_TABLE(struct choices, fields, "choices", "For tests.")};
    struct csv_columns columns = {0};
    struct text *row = check_text();
    csv_columns_add(&columns, &record, none, check_arena());
    csv_columns_write(&columns, &(struct choices){COLOUR_NONE, 2}, row);
    text_add(row, "", 1);
    assert_string_equal(row->bytes, "none,,");
}

TEST(names_are_quoted_where_they_must_be)
{
    static const char *const without[] = {"x_m",    "known_m", "whole", "absent", "flag",
                                          "colour", "seed",    "set",   "inner",  NULL};
    check_row(&(struct outer){.name = "a, \"b\""}, without, "\"a, \"\"b\"\"\"\n");
    check_row(&(struct outer){.name = "two\nlines"}, without, "\"two\nlines\"\n");
}

TEST(the_longest_name_has_room_if_all_of_it_is_quotes)
{
    char name[FIELD_NAME_SIZE + 1] = {0}, expected[2 * FIELD_NAME_SIZE + 4] = {0};
    memset(name, '"', FIELD_NAME_SIZE);
    memset(expected, '"', 2 * FIELD_NAME_SIZE + 2);
    expected[2 * FIELD_NAME_SIZE + 2] = '\n';
    static const char *const without[] = {"x_m",    "known_m", "whole", "absent", "flag",
                                          "colour", "seed",    "set",   "inner",  NULL};
    check_row(&(struct outer){.name = name}, without, expected);
}
