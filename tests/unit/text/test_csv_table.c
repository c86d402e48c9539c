#define SCRATCH_FILE "table.csv"
#include "scratch.h"

#include <zlib.h>

#include "text/csv_table.h"

static int read_bytes(struct scratch *scratch, const char *bytes, size_t length,
                      struct csv_table *table, struct diag *diag)
{
    struct text text = {.bytes = (char *)bytes, .length = length};
    *diag = (struct diag){0};
    return csv_table_parse(&text, table, &scratch->arena, diag);
}

static struct csv_table table_of(struct scratch *scratch, const char *text)
{
    struct csv_table table;
    assert_done(read_bytes, scratch, text, strlen(text), &table);
    return table;
}

FIXTURE(make_scratch, remove_scratch);

TEST_OF(scratch, every_spelling_of_a_table_is_the_same_table)
{
    static const char *const spellings[] = {
        "a,b\n1,2\n3,4\n",
        "a,b\n1,2\n3,4\r",
        "a,b\r\n1,2\r\n3,4\r\n",
        "a,b\r1,2\r3,4\r",
        ("\xef\xbb\xbf"
         "a,b\n1,2\n3,4\n"),
        "\xef\xbb\xbf\"a\",b\n1,2\n3,4\n",
        "\n\na,b\n\n1,2\r\n  \n\n3,4\n\n",
        "a , b\n 1,\t2\n3 ,4 \n",
        "\"a\",\"b\"\n\"1\",2\n3,\"4\"\n",
    };
    for (size_t i = 0; i < COUNT(spellings); i++) {
        struct csv_table table = table_of(scratch, spellings[i]);
        assert_int_equal(table.columns, 2);
        assert_int_equal(table.rows, 2);
        assert_string_equal(table.header[0], "a");
        assert_string_equal(table.header[1], "b");
        assert_string_equal(csv_table_cell(&table, 0, 0), "1");
        assert_string_equal(csv_table_cell(&table, 0, 1), "2");
        assert_string_equal(csv_table_cell(&table, 1, 0), "3");
        assert_string_equal(csv_table_cell(&table, 1, 1), "4");
    }
}

TEST_OF(scratch, quotes_keep_commas_line_breaks_blanks_and_quotes)
{
    struct csv_table table =
        table_of(scratch, "a,b,c,d,e\n\"1,2\",\"x\ny\",\" z \",\"say \"\"no\"\"\",\n");
    static const char *const cells[] = {"1,2", "x\ny", " z ", "say \"no\"", ""};
    assert_int_equal(table.rows, 1);
    for (size_t i = 0; i < 5; i++)
        assert_string_equal(csv_table_cell(&table, 0, i), cells[i]);
}

TEST_OF(scratch, a_header_alone_is_a_table_without_rows)
{
    struct csv_table table = table_of(scratch, "a,b\n");
    assert_int_equal(table.columns, 2);
    assert_int_equal(table.rows, 0);
}

/* The rows one after the other are those of the whole table, whatever the pieces of the file. */
TEST_OF(scratch, rows_come_one_after_the_other)
{
    gzFile file = gzopen(scratch->path, "wb");
    assert_non_null(file);
    assert_true(gzputs(file, "\xef\xbb\xbfx;\"a\nb\"\r\n") > 0);
    for (int i = 0; i < 50000; i++)
        assert_true(gzprintf(file, "%d;\"%d\n,\"\n\n", i, -i) > 0);
    assert_int_equal(gzclose(file), Z_OK);
    struct diag diag = {0};
    struct input *input = input_open(scratch->path, &diag);
    struct csv_table_rows *rows = csv_table_open(input, NULL, &diag);
    assert_non_null(rows);
    assert_string_equal(csv_table_names(rows)->header[1], "a\nb");
    for (size_t i = 0; i < 50000; i++) {
        const struct csv_table *row = csv_table_next(rows, &diag);
        char cell[32];
        snprintf(cell, sizeof cell, "%d\n,", -(int)i);
        assert_non_null(row);
        assert_int_equal(row->rows, 1);
        assert_string_equal(csv_table_cell(row, 0, 1), cell);
        assert_int_equal(row->numbers[0], 2 + 2 * i);
    }
    assert_null(csv_table_next(rows, &diag));
    assert_int_equal(diag.code, DIAG_OK);
    csv_table_close(rows);
    input_close(input);
}

/* A fault comes after the rows before it. */
TEST_OF(scratch, rows_before_a_fault_come_first)
{
    scratch_write(scratch->path, "a,b\r1,2\r3\r5,6\r");
    struct diag diag = {0};
    struct input *input = input_open(scratch->path, &diag);
    assert_null(csv_table_open(input, NULL, &diag));
    assert_string_equal(diag.text, "row 3: 1 cell; expected 2 as in the header");
    input_close(input);
    scratch_write(scratch->path, "a,b\n1,2\n3\n5,6\n");
    diag = (struct diag){0};
    input = input_open(scratch->path, &diag);
    struct csv_table_rows *rows = csv_table_open(input, NULL, &diag);
    assert_non_null(rows);
    assert_non_null(csv_table_next(rows, &diag));
    assert_int_equal(diag.code, DIAG_OK);
    assert_null(csv_table_next(rows, &diag));
    assert_string_equal(diag.text, "row 3: 1 cell; expected 2 as in the header");
    csv_table_close(rows);
    input_close(input);
}

/* ---- tables that begin otherwise ---- */

static const char *const two_names[] = {"id", "x", NULL};
static const struct csv_table_form other_form = {
    .names = two_names, .preamble = "tool ", .header = "id"};

/* All rows of a text as "cell|cell\n", with their numbers before them. */
static void rows_of(struct scratch *scratch, const char *text, const struct csv_table_form *form,
                    char *out, size_t room)
{
    scratch_write(scratch->path, text);
    struct diag diag = {0};
    struct input *input = input_open(scratch->path, &diag);
    struct csv_table_rows *rows = csv_table_open(input, form, &diag);
    const struct csv_table *row;
    size_t length = 0;
    out[0] = '\0';
    while (rows != NULL && (row = csv_table_next(rows, &diag)) != NULL)
        length += (size_t)snprintf(out + length, room - length, "%zu: %s=%s %s=%s\n",
                                   row->numbers[0], row->header[0], csv_table_cell(row, 0, 0),
                                   row->header[1], csv_table_cell(row, 0, 1));
    if (diag.code != DIAG_OK)
        snprintf(out + length, room - length, "%s", diag.text);
    csv_table_close(rows);
    input_close(input);
}

TEST_OF(scratch, a_table_of_numbers_has_the_names_that_it_lacks)
{
    static const struct {
        const char *text, *rows;
    } cases[] = {
        {"7,1.5\n8,2.5\n", "1: id=7 x=1.5\n2: id=8 x=2.5\n"},
        {"  7   1.5\t\r\n\n\t8\t 2.5\n", "1: id=7 x=1.5\n3: id=8 x=2.5\n"},
        {"7 wide\n", "1: id=7 x=wide\n"},
        {"x id\n1 2\n", "2: x=1 id=2\n"},
        {"7,1,2\n8,2,5\n", "2: 7=8 1=2\n"},
        {"7 1\n8\n", "1: id=7 x=1\nrow 2: 1 cell; expected 2 as in the header"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char rows[256];
        rows_of(scratch, cases[i].text, &other_form, rows, sizeof rows);
        assert_string_equal(rows, cases[i].rows);
    }
}

TEST_OF(scratch, lines_before_the_header_count_as_rows)
{
    char rows[256];
    rows_of(scratch, "tool 1, \"of\n\nmany, words\nid, x\n7, 1\n", &other_form, rows, sizeof rows);
    assert_string_equal(rows, "5: id=7 x=1\n");
    rows_of(scratch, "tool 1\nno header\n", &other_form, rows, sizeof rows);
    assert_string_equal(rows, "the table is empty; expected a header");
    rows_of(scratch, "tool 1,x\n7,1\n", NULL, rows, sizeof rows);
    assert_string_equal(rows, "2: tool 1=7 x=1\n");
}

TEST_OF(scratch, long_cells_are_read_whole)
{
    enum { LENGTH = 100000 };
    char *text = malloc(LENGTH + 8);
    assert_non_null(text);
    memcpy(text, "a,b\n", 4);
    memset(text + 4, 'x', LENGTH);
    strcpy(text + 4 + LENGTH, ",1\n");
    struct csv_table table = table_of(scratch, text);
    assert_int_equal(strlen(csv_table_cell(&table, 0, 0)), LENGTH);
    assert_string_equal(csv_table_cell(&table, 0, 1), "1");
    free(text);
}

TEST_OF(scratch, rows_have_the_numbers_that_a_spreadsheet_shows)
{
    static const struct {
        const char *text;
        size_t numbers[2];
    } cases[] = {
        {"a,b\n1,2\n3,4\n", {2, 3}},
        {"a,b\r\n1,2\r\n3,4\r\n", {2, 3}},
        {"a,b\r1,2\r3,4\r", {2, 3}},
        {"a,b\n\n\n1,2\n\n3,4\n", {4, 6}},
        {"a,b\r\n\r\n1,2\r\n\r\n\r\n3,4\r\n", {3, 6}},
        {"a,b\r\r1,2\r\r3,4\r", {3, 5}},
        {"\n\na,b\n \t\n1,2\n3,4\n", {5, 6}},
        {"a,b\n\"1\n\n\n\",2\n3,4\n", {2, 3}},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct csv_table table = table_of(scratch, cases[i].text);
        assert_int_equal(table.rows, 2);
        assert_int_equal(table.numbers[0], cases[i].numbers[0]);
        assert_int_equal(table.numbers[1], cases[i].numbers[1]);
    }
}

TEST_OF(scratch, damaged_tables_are_refused)
{
#define QUOTE_MESSAGE                                                                              \
    "a misplaced quote; expected quotes around the whole cell, and those inside it doubled"
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"", "the table is empty; expected a header"},
        {"\xef\xbb\xbf", "the table is empty; expected a header"},
        {"\n \r\n\n", "the table is empty; expected a header"},
        {"a,b\n1,2\n3\n", "row 3: 1 cell; expected 2 as in the header"},
        {"a,b\n1,2\n3,4,5\n", "row 3: 3 cells; expected 2 as in the header"},
        {"a,b\r\n\r\n1,2\r\n3,4,\r\n", "row 4: 3 cells; expected 2 as in the header"},
        {"a,b,a\n1,2,3\n", "columns 1 and 3 are both named \"a\""},
        {"a,,\n1,2,3\n", "columns 2 and 3 are both named \"\""},
        {"a,b\n1,2\n\"3,4\n5,6\n", "row 3: a quote opens a cell and nothing closes it"},
        {"a,b\n1,2\n3,4\"5\n", "row 3: " QUOTE_MESSAGE},
        {"a,b\n\n\"1\" 2,3\n", "row 3: " QUOTE_MESSAGE},
        {"a,b\n1\n\"1\" 2,3\n", "row 2: 1 cell; expected 2 as in the header"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct csv_table table;
        assert_refused(DIAG_DATA, cases[i].message, read_bytes, scratch, cases[i].text,
                       strlen(cases[i].text), &table);
    }
}

/* Wherever it is cut but behind a line end: 1.8 may be 1.85. The whole rows come first. */
TEST_OF(scratch, a_table_that_is_cut_is_refused)
{
    static const char *const texts[] = {
        "id,x\n1,1.85\n33,4\n",
        "id,x\r\n1,1.85\r\n33,\"4\"\r\n",
        "id;x\n1;1.85\n33;\n",
        "id x\n1  1.85\n33 4\n",
    };
    for (size_t i = 0; i < COUNT(texts); i++)
        for (size_t cut = 1; texts[i][cut - 1] != '\0'; cut++) {
            char part[64], rows[256];
            snprintf(part, sizeof part, "%.*s", (int)cut, texts[i]);
            bool whole = strchr("\r\n", part[cut - 1]) != NULL;
            const char *second = strstr(part, "1.85");
            rows_of(scratch, part, &other_form, rows, sizeof rows);
            assert_int_equal(strstr(rows, "row ") == NULL, whole);
            assert_int_equal(strstr(rows, "x=1.85\n") != NULL,
                             second != NULL && strpbrk(second, "\r\n") != NULL);
            struct csv_table table;
            struct diag diag;
            read_bytes(scratch, part, cut, &table, &diag);
            assert_true(i > 1 || (diag.code == DIAG_OK) == whole);
        }
    char rows[256];
    rows_of(scratch, "7 1.85\n33 4", &other_form, rows, sizeof rows);
    assert_string_equal(rows, "1: id=7 x=1.85\nrow 2: the file ends inside this row; expected a "
                              "line end after the last row");
}

TEST_OF(scratch, a_nul_byte_is_refused_wherever_it_is)
{
    static const char text[] = "ab,c\r\n1,2\r\n3,4\r\n";
    for (size_t i = 0; i < sizeof text - 1; i++) {
        char bytes[sizeof text];
        memcpy(bytes, text, sizeof text);
        if (bytes[i] == '\r' || bytes[i] == '\n' || bytes[i] == ',')
            continue;
        bytes[i] = '\0';
        struct csv_table table;
        struct diag diag;
        assert_int_equal(read_bytes(scratch, bytes, sizeof text - 1, &table, &diag), -1);
        char message[64];
        snprintf(message, sizeof message, "row %d: a NUL byte; expected text",
                 i < 6    ? 1
                 : i < 11 ? 2
                          : 3);
        assert_string_equal(diag.text, message);
    }
}

TEST_OF(scratch, columns_are_found_by_their_whole_name)
{
    struct csv_table table = table_of(scratch, "x,xx,vx,X\n1,2,3,4\n");
    size_t column;
    assert_done(csv_table_column, &table, "vx", &column);
    assert_int_equal(column, 2);
    assert_done(csv_table_column, &table, "x", &column);
    assert_int_equal(column, 0);
    assert_refused(DIAG_DATA, "column \"y\" is missing; the header is: x, xx, vx, X",
                   csv_table_column, &table, "y", &column);
}

TEST_OF(scratch, numbers_are_read_to_the_last_digit)
{
    struct csv_table table = table_of(
        scratch, "x\n0\n-0\n12.5\n-7.25e-3\n1E2\n0.1\n5335123.4567\n2.2250738585072011e-308\n");
    static const double values[] = {0,   -0.0, 12.5,         -7.25e-3,
                                    100, 0.1,  5335123.4567, 0x0.fffffffffffffp-1022};
    assert_int_equal(table.rows, COUNT(values));
    for (size_t i = 0; i < table.rows; i++) {
        double value;
        assert_done(csv_table_number, &table, i, 0, -1e9, 1e9, &value);
        assert_memory_equal(&value, &values[i], sizeof value);
    }
}

TEST_OF(scratch, cells_that_are_not_numbers_are_refused)
{
    static const char *const cells[] = {"abc",    "12abc",  "\"\"",     "nan",    "NaN",   "-nan",
                                        "inf",    "-inf",   "Infinity", "0x10",   "0x1p3", "1e",
                                        "1.",     ".5",     "+1",       "-",      "--1",   "1 2",
                                        "\" 1\"", "\"1 \"", "\"1,5\"",  "1e5000", "007",   "1_000"};
    for (size_t i = 0; i < COUNT(cells); i++) {
        char text[64], message[96], bare[32] = "";
        snprintf(text, sizeof text, "id,x\n7,%s\n", cells[i]);
        struct csv_table table = table_of(scratch, text);
        strcpy(bare, csv_table_cell(&table, 0, 1));
        snprintf(message, sizeof message, "row 2, column \"x\": \"%s\" is not a number", bare);
        double value;
        assert_refused(DIAG_DATA, message, csv_table_number, &table, 0, 1, -1e300, 1e300, &value);
    }
}

TEST_OF(scratch, numbers_outside_their_bounds_are_refused)
{
    struct csv_table table = table_of(scratch, "azimuth_rad,x\n\n-0.5,2\n");
    double value;
    assert_done(csv_table_number, &table, 0, 0, -0.5, 0, &value);
    assert_done(csv_table_number, &table, 0, 1, 0, 2, &value);
    assert_refused(DIAG_DATA, "row 3, column \"azimuth_rad\": -0.5 is outside [0, 3] rad",
                   csv_table_number, &table, 0, 0, 0, 3, &value);
    assert_refused(DIAG_DATA, "row 3, column \"x\": 2 is outside [-1, 1.5]", csv_table_number,
                   &table, 0, 1, -1, 1.5, &value);
}
