#include "check.h"

#include "text/record_write.h"

enum { IN_LATER = 1 << 0, IN_PARTS = 1 << 1 };

struct part {
    double width_m;
    const char *name;
    int64_t number;
};

struct thing {
    const char *name;
    const char *alias;
    double gain;
    double later_s;
    LIST_OF(const char *) names;
    struct part part;
    LIST_OF(struct part) parts, more;
    unsigned present;
    const struct thing *document;
};

static const struct field part_fields[] = {
    {FIELD_REAL_IN(struct part, width_m, 1, 10, "width"), FIELD_OPTIONAL},
    {FIELD_NAME_OF(struct part, name, "name"), FIELD_OPTIONAL},
    {FIELD_INTEGER_IN(struct part, number, -5, 5, "number")},
    {0},
};
static const struct record part_record = {
    .name = "part", .size = sizeof(struct part), .fields = part_fields};

enum { NAMES = 4, PARTS = 6, MORE = 7 };

static const struct field fields[] = {
    {FIELD_NAME_OF(struct thing, name, "name")},
    {FIELD_NAME_OF(struct thing, alias, "alias"), FIELD_OPTIONAL},
    {FIELD_REAL_IN(struct thing, gain, 0, 0.1, "gain")},
    {FIELD_REAL_IN(struct thing, later_s, 0, 1, "later"), FIELD_OPTIONAL, .group = IN_LATER},
    [NAMES] = {FIELD_NAMES_OF(struct thing, names, "names"), FIELD_OPTIONAL},
    {FIELD_RECORD_OF(struct thing, part, &part_record, "part")},
    [PARTS] = {FIELD_LIST_OF(struct thing, parts, &part_record, "parts"), FIELD_OPTIONAL,
               .group = IN_PARTS},
    [MORE] = {FIELD_LIST_OF(struct thing, more, &part_record, "more"), FIELD_OPTIONAL,
              FIELD_STEADY},
    {0},
};
static const struct record record = {
    .name = "thing",
    .size = sizeof(struct thing),
    .fields = fields,
    .present_offset = offsetof(struct thing, present),
    .document_offset = offsetof(struct thing, document),
};

static struct thing good_thing(void)
{
    return (struct thing){.name = "a"};
}

/* The message of the check, "" if it passes. */
static const char *fault(const struct thing *thing)
{
    static struct diag diag;
    diag = (struct diag){0};
    int result = record_write_check(&record, thing, ~0U, &diag);
    assert_int_equal(result, diag.text[0] == '\0' ? 0 : -1);
    return diag.text;
}

TEST(a_missing_name_is_refused_unless_it_is_optional)
{
    struct thing thing = good_thing();
    assert_string_equal(fault(&thing), "");
    thing.name = NULL;
    assert_string_equal(fault(&thing), "name: missing");
    thing = good_thing();
    thing.alias = "";
    assert_string_equal(fault(&thing), "alias: a name of 0 bytes; expected 1 to 1024");
}

TEST(a_number_out_of_bounds_is_refused_with_its_path)
{
    struct thing thing = good_thing();
    thing.gain = 0.2;
    assert_string_equal(fault(&thing), "gain: 0.2 is outside [0, 0.1]");
    thing.gain = (double)NAN;
    assert_string_equal(fault(&thing), "gain: nan is outside [0, 0.1]");
    thing.gain = 0.1;
    thing.part.width_m = 11;
    assert_string_equal(fault(&thing), "part.width_m: 11 is outside [1, 10] m");
    thing.part.width_m = 10;
    for (int i = 0; i < 20; i++)
        field_list_add(&fields[MORE], &thing, check_arena());
    assert_string_equal(fault(&thing), "");
    thing.more.items[17].number = -6;
    assert_string_equal(fault(&thing), "more[17].number: -6 is outside [-5, 5]");
    thing.more.items[19].width_m = 0.5;
    assert_string_equal(fault(&thing), "more[19].width_m: 0.5 is outside [1, 10] m");
}

/* 0 is outside [1, 10], but is the value of the optional member when it is absent. */
TEST(the_value_of_an_absent_member_passes_although_it_is_out_of_bounds)
{
    struct thing thing = good_thing();
    thing.part.width_m = 0;
    assert_string_equal(fault(&thing), "");
    thing.part.width_m = -0.0;
    assert_string_equal(fault(&thing), "part.width_m: -0.0 is outside [1, 10] m");
}

TEST(a_group_is_checked_only_if_it_is_present_and_wanted)
{
    struct thing thing = good_thing();
    struct part *part = field_list_add(&fields[PARTS], &thing, check_arena());
    part->width_m = -1;
    thing.later_s = 2;
    assert_string_equal(fault(&thing), "");
    thing.present = IN_PARTS;
    assert_string_equal(fault(&thing), "parts[0].width_m: -1 is outside [1, 10] m");
    assert_done(record_write_check, &record, &thing, IN_LATER);
    thing.present |= IN_LATER;
    assert_refused(DIAG_DATA, "later_s: 2 is outside [0, 1] s", record_write_check, &record, &thing,
                   IN_LATER);
}

TEST(members_of_no_group_are_checked_if_they_are_wanted)
{
    struct thing thing = good_thing();
    thing.gain = 1;
    assert_done(record_write_check, &record, &thing, IN_LATER | IN_PARTS);
    assert_refused(DIAG_DATA, "gain: 1 is outside [0, 0.1]", record_write_check, &record, &thing,
                   FIELD_UNGROUPED);
}

/* A 0 of a group that is present is a value like any other. */
TEST(a_group_that_is_present_is_not_absent_at_zero)
{
    struct thing thing = good_thing();
    static const struct field bounded[] = {
        {FIELD_REAL_IN(struct thing, later_s, 1, 2, "later"), FIELD_OPTIONAL, .group = IN_LATER},
        {0}};
    struct record own = record;
    own.fields = bounded;
    assert_done(record_write_check, &own, &thing, ~0U);
    thing.present = IN_LATER;
    assert_refused(DIAG_DATA, "later_s: 0 is outside [1, 2] s", record_write_check, &own, &thing,
                   ~0U);
}

/* The bad name follows the same name that is good, and precedes another one. */
TEST(among_items_the_bad_name_is_found)
{
    struct thing thing = good_thing();
    for (int i = 0; i < 20; i++)
        ((struct part *)field_list_add(&fields[MORE], &thing, check_arena()))->name =
            i == 3 ? NULL : "b";
    assert_string_equal(fault(&thing), "");
    thing.more.items[18].name = "\n";
    assert_string_equal(fault(&thing), "more[18].name: control character 0x0a in a name");
    thing.more.items[4].name = thing.more.items[5].name = "\xff";
    assert_string_equal(fault(&thing), "more[4].name: byte 0xff in a name is not UTF-8");
}

TEST(lists_of_a_document_are_not_checked_again)
{
    struct thing document = good_thing();
    struct part *part = field_list_add(&fields[MORE], &document, check_arena());
    part->number = 6;
    struct thing thing = document;
    assert_string_equal(fault(&thing), "more[0].number: 6 is outside [-5, 5]");
    thing.document = &document;
    assert_string_equal(fault(&thing), "");
    thing.more.items = (struct part[]){{.number = 7}};
    assert_string_equal(fault(&thing), "more[0].number: 7 is outside [-5, 5]");
}

static bool names_pass(const char *name, struct arena *arena)
{
    struct thing thing = good_thing();
    for (int i = 0; i < 5; i++)
        *(const char **)field_list_add(&fields[NAMES], &thing, arena) = i == 3 ? name : "good";
    const char *message = fault(&thing);
    assert_true(message[0] == '\0' || strncmp(message, "names[3]: ", 10) == 0);
    return message[0] == '\0';
}

TEST(every_byte_of_a_name_is_checked)
{
    struct arena *arena = check_arena();
    char name[FIELD_NAME_SIZE + 2] = "";
    assert_false(names_pass(name, arena));
    for (size_t length = 1; length <= 40; length++) {
        memset(name, '~', length);
        assert_true(names_pass(name, arena));
        for (size_t i = 0; i < length; i++) {
            static const char bad[] = {1, 0x1f, 0x7f, (char)0x80, (char)0xff};
            for (size_t j = 0; j < sizeof bad; j++) {
                name[i] = bad[j];
                assert_false(names_pass(name, arena));
            }
            name[i] = ' ';
            assert_true(names_pass(name, arena));
            name[i] = '~';
        }
    }
    assert_true(names_pass("Straße", arena));
    memset(name, 'a', FIELD_NAME_SIZE);
    assert_true(names_pass(name, arena));
    name[FIELD_NAME_SIZE] = 'a';
    assert_false(names_pass(name, arena));
}
