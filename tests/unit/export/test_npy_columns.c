#include "check.h"

#include "export/npy_columns.h"

struct thing {
    double size_m, far_m;
    int64_t whole, absent;
    bool flag;
    const char *name, *none;
    uint64_t seed, set;
};

static const char *const words[] = {"wheel", "door", "roof", NULL};

static const struct field thing_fields[] = {
    {FIELD_REAL_IN(struct thing, size_m, -9, 9, "size")},
    {FIELD_REAL_IN(struct thing, far_m, 0, 9, "0: not known"), FIELD_OPTIONAL},
    {FIELD_INTEGER_IN(struct thing, whole, -9, 9, "whole")},
    {FIELD_INTEGER_IN(struct thing, absent, 0, 9, "absent: 5"), FIELD_OPTIONAL, .absent = 5},
    {FIELD_FLAG_OF(struct thing, flag, "flag"), FIELD_OPTIONAL},
    {FIELD_NAME_OF(struct thing, name, "name")},
    {FIELD_NAME_OF(struct thing, none, "no name"), FIELD_OPTIONAL},
    {FIELD_SEED_OF(struct thing, seed, "seed")},
    {FIELD_SET_OF(struct thing, set, words, "set"), FIELD_OPTIONAL},
    {0},
};
static const struct record thing_record = {
    FIELD_TABLE(struct thing, thing_fields, "thing", "For tests.")};

static const char *const none[] = {NULL};

static struct csv_columns columns_of_thing(void)
{
    struct csv_columns columns = {0};
    csv_columns_add(&columns, &thing_record, none, check_arena());
    return columns;
}

TEST(a_head_names_types_and_rows_and_its_length_does_not_depend_on_their_number)
{
    static const char expected[] =
        "{'descr': [('size_m', '<f8'), ('far_m', '<f8'), ('whole', '<i8'), ('absent', '<i8'), "
        "('flag', '|b1'), ('', '|V7'), ('name', '<u8'), ('none', '<u8'), ('seed', '<u8'), "
        "('set', '<u8'), ], 'fortran_order': False, 'shape': (                   7,)}";
    struct csv_columns columns = columns_of_thing();
    struct text *few = check_text(), *many = check_text();
    npy_columns_write_head(&columns, 1, 7, few);
    npy_columns_write_head(&columns, 1, INT64_C(1000000000), many);
    assert_int_equal(few->length, many->length);
    assert_int_equal(few->length % 64, 0);
    assert_memory_equal(few->bytes, "\x93NUMPY\x01\x00", 8);
    assert_int_equal((unsigned char)few->bytes[8] + 256 * (unsigned char)few->bytes[9],
                     few->length - 10);
    assert_memory_equal(few->bytes + 10, expected, sizeof expected - 1);
    for (size_t i = 10 + sizeof expected - 1; i < few->length - 1; i++)
        assert_int_equal(few->bytes[i], ' ');
    assert_int_equal(few->bytes[few->length - 1], '\n');
}

/* Eight bytes, the lowest first, and zeros behind those that are given. */
#define CELL(bytes) ((const char[8]){bytes})

static void check_cells(struct npy_names *names, const struct thing *thing,
                        const char *const *cells)
{
    struct csv_columns columns = columns_of_thing();
    struct text *row = check_text();
    npy_columns_write(&columns, thing, names, row);
    assert_int_equal(row->length, 9 * 8);
    for (size_t i = 0; i < 9; i++)
        assert_memory_equal(row->bytes + 8 * i, cells[i], 8);
}

static const char two[8] = {0, 0, 0, 0, 0, 0, 0, 0x40},
                  not_a_number[8] = {0, 0, 0, 0, 0, 0, -8, 0x7f},
                  minus_one[8] = {-1, -1, -1, -1, -1, -1, -1, -1};

TEST(cells_are_numbers_of_eight_bytes_and_names_count_from_one_in_order)
{
    struct npy_names names = npy_columns_begin(check_arena());
    struct thing thing = {2, 2, -1, 3, true, "first", "\"2\"", UINT64_MAX, 5};
    check_cells(&names, &thing,
                (const char *const[]){two, two, minus_one, CELL("\3"), CELL("\1"), CELL("\1"),
                                      CELL("\2"), CELL("\3"), CELL("\4")});
    thing.name = "\"2\"";
    check_cells(&names, &thing,
                (const char *const[]){two, two, minus_one, CELL("\3"), CELL("\1"), CELL("\2"),
                                      CELL("\2"), CELL("\3"), CELL("\4")});
    struct text *list = check_text();
    npy_columns_write_names(&names, list);
    text_add(list, "", 1);
    assert_string_equal(list->bytes, "[\"\",\n\"first\",\n\"\\\"2\\\"\",\n\"18446744073709551615\","
                                     "\n\"wheel roof\"]\n");
    npy_columns_end(&names);
}

TEST(a_cell_without_a_value_is_no_number_or_minus_one_or_the_empty_name)
{
    struct npy_names names = npy_columns_begin(check_arena());
    struct thing thing = {.size_m = 2, .whole = 1, .absent = 5, .name = "first"};
    check_cells(&names, &thing,
                (const char *const[]){two, not_a_number, CELL("\1"), minus_one, CELL("\0"),
                                      CELL("\1"), CELL("\0"), CELL("\2"), CELL("\0")});
    check_cells(&names, NULL,
                (const char *const[]){not_a_number, not_a_number, minus_one, minus_one, CELL("\0"),
                                      CELL("\0"), CELL("\0"), CELL("\0"), CELL("\0")});
    npy_columns_end(&names);
}
