/* Numbers and records as text: hard cases 54 to 64. */
#define SCRATCH_FILE "locale"
#include "hard.h"
#include "support/scratch.h"

#include <locale.h>

#include <csv.h>
#include <jansson.h>

#include "base/number.h"
#include "frame/frame_text.h"
#include "text/csv_table.h"
#include "text/document.h"
#include "text/record_write.h"
#include "traffic/scenario.h"

enum { PRECISION = 200 };

static double any_finite(uint64_t *random)
{
    double value = (double)NAN;
    while (!isfinite(value))
        value = sample_from_bits(sample_word(random));
    return value;
}

static double through_text(double value)
{
    char text[NUMBER_SIZE];
    double back;
    assert_true(number_read(text, text + number_write(value, text), &back));
    return back;
}

TEST(every_double_comes_back)
{
    uint64_t random = 54;
    int points = hard_points(300000);
    double naive = 0, ours = 0, naive_ulp = 0, ours_ulp = 0;
    MPFR_DECL_INIT(exact, PRECISION);
    for (int i = 0; i < points; i++) {
        double value = any_finite(&random), back = through_text(value);
        char text[64];
        snprintf(text, sizeof text, "%.15g", value);
        double plain = strtod(text, NULL);
        naive += memcmp(&plain, &value, sizeof value) != 0;
        ours += memcmp(&back, &value, sizeof value) != 0;
        mpfr_set_d(exact, value, MPFR_RNDN);
        naive_ulp = fmax(naive_ulp, isfinite(plain) ? error_ulp(plain, exact) : 0);
        ours_ulp = fmax(ours_ulp, error_ulp(back, exact));
    }
    hard_case("54", "doubles changed by text (naive: %.15g)", "wrong", naive, ours, 0);
    hard_case("54", "error of doubles as text (naive: %.15g)", "ulp", naive_ulp, ours_ulp, 0);
}

static double relative_error(const char *text, double value)
{
    return fabs(strtod(text, NULL) - value) / value;
}

TEST(small_and_large_numbers_keep_their_digits)
{
    static const double values[] = {5335123.4567, 1e-9, 691000.125, 1.7e9 + 0.04};
    double naive = 0, ours = 0;
    for (size_t i = 0; i < COUNT(values); i++) {
        char text[64], written[NUMBER_SIZE + 1];
        snprintf(text, sizeof text, "%g", values[i]);
        naive = fmax(naive, relative_error(text, values[i]));
        snprintf(text, sizeof text, "%f", values[i]);
        naive = fmax(naive, relative_error(text, values[i]));
        written[number_write(values[i], written)] = '\0';
        ours = fmax(ours, relative_error(written, values[i]));
    }
    hard_case("55", "UTM and 1e-9 as text (naive: %g, %f)", "relative", naive, ours, 0);
}

/* A line of a frame with one object; its words SEED, X and MORE are replaced. */
static int read_frame(const char *seed, const char *x, const char *more, struct frame *frame,
                      struct diag *diag)
{
    char line[4096];
    arena_clear(check_arena());
    *frame = (struct frame){.arena = check_arena()};
    *diag = (struct diag){0};
    int length = snprintf(line, sizeof line,
                          "{\"version\":1,\"scene\":\"s\",\"frame\":0,\"time_s\":0,"
                          "\"interval_s\":1,\"last\":true,\"seed\":%s,\"ego\":\"e\","
                          "\"origin_x_m\":0,\"origin_y_m\":0,\"objects\":[{\"id\":\"e\","
                          "\"class\":\"car\",\"x_m\":%s,\"y_m\":0,\"yaw_rad\":0,\"vx_mps\":0,"
                          "\"vy_mps\":0,\"yaw_rate_radps\":0,\"length_m\":4,\"width_m\":2,"
                          "\"height_m\":1,\"travelled_m\":0}]}%s",
                          seed, x, more);
    assert_in_range(length, 1, sizeof line - 1);
    return frame_text_read(line, (size_t)length, frame, diag);
}

static bool reads_x(const char *x, double *value)
{
    struct frame frame;
    struct diag diag;
    if (read_frame("\"1\"", x, "", &frame, &diag) != 0)
        return false;
    *value = frame.objects.items[0].x_m;
    return true;
}

/* The number in a document, which jansson reads. */
static bool document_reads_x(const char *x, double *value)
{
    struct text *text = check_text();
    struct scenario scenario;
    struct diag diag = {0};
    text_format(text,
                "{\"origin\":\"t\",\"ego\":\"e\",\"rate_hz\":1,\"duration_s\":1,\"objects\":"
                "[{\"id\":\"e\",\"class\":\"car\",\"x_m\":%s}]}",
                x);
    int done = document_parse("test", text, &scenario_record, &scenario, check_arena(), &diag);
    if (done == 0)
        *value = scenario.objects.items[0].x_m;
    return done == 0;
}

static bool parse_table(const char *bytes, size_t length, struct csv_table *table,
                        struct diag *diag)
{
    struct text *text = check_text();
    *diag = (struct diag){0};
    text_add(text, bytes, length);
    return csv_table_parse(text, table, check_arena(), diag) == 0;
}

static bool table_reads_x(const char *x, double *value)
{
    char text[128];
    struct csv_table table;
    struct diag diag;
    int length = snprintf(text, sizeof text, "id,x\n1,%s\n", x);
    return parse_table(text, (size_t)length, &table, &diag) &&
           csv_table_number(&table, 0, 1, -1e300, 1e300, value, &diag) == 0;
}

static bool option_reads_x(const char *x, double *value)
{
    return field_read_number(x, strlen(x), value) == 0;
}

static bool (*const readers[])(const char *, double *) = {reads_x, document_reads_x, table_reads_x,
                                                          option_reads_x};

/* How many readers do not read the text as this double, bit for bit. */
static double count_misread(const char *text, double expected)
{
    double wrong = 0;
    for (size_t i = 0; i < COUNT(readers); i++) {
        double value;
        if (!readers[i](text, &value) || memcmp(&value, &expected, sizeof value) != 0)
            wrong++;
    }
    return wrong;
}

/* How many readers take the text for a number. */
static double count_taken(const char *text)
{
    double wrong = 0;
    for (size_t i = 0; i < COUNT(readers); i++) {
        double value;
        wrong += readers[i](text, &value);
    }
    return wrong;
}

/* The value of a number under json_real_value, or under json_number_value. */
static double by_jansson(const char *text, double (*value_of)(const json_t *))
{
    json_t *tree = json_loads(text, JSON_DECODE_ANY, NULL);
    double value = value_of(tree);
    json_decref(tree);
    return value;
}

TEST(minus_zero_keeps_its_sign)
{
    char text[NUMBER_SIZE + 1];
    text[number_write(-0.0, text)] = '\0';
    double naive = !signbit(by_jansson("-0", json_number_value)), value;
    double ours = strcmp(text, "-0.0") != 0;
    ours += !signbit(by_jansson(text, json_number_value));
    ours += count_misread("-0.0", -0.0) + count_misread("-0e0", -0.0);
    ours += !reads_x("-0", &value) || !signbit(value);
    ours += !table_reads_x("-0", &value) || !signbit(value);
    ours += !option_reads_x("-0", &value) || !signbit(value);
    hard_case("56", "-0.0 through every reader (naive: jansson)", "wrong", naive, ours, 0);
}

static bool refuses(const struct field *field, double value)
{
    struct field alone[] = {*field, {0}};
    alone->group = 0; /* A record of one member has no mask of the members that are present. */
    const struct record record = {.size = field->offset + sizeof value, .fields = alone};
    size_t length = strlen(field->name);
    struct diag diag = {0};
    char *base = calloc(1, field->offset + sizeof value);
    assert_non_null(base);
    memcpy(base + field->offset, &value, sizeof value);
    record_write_check(&record, base, ~0U, &diag);
    free(base);
    return diag.code == DIAG_DATA && strncmp(diag.text, field->name, length) == 0 &&
           diag.text[length] == ':';
}

/* Over all real members that a line can have: how many let a value through that is no number. */
static double count_careless(const struct record *record, size_t *members)
{
    static const double values[] = {(double)NAN, (double)INFINITY, (double)-INFINITY};
    double wrong = 0;
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        if (field->kind == FIELD_RECORD || field->kind == FIELD_LIST)
            wrong += count_careless(field->record, members);
        if (field->kind != FIELD_REAL)
            continue;
        ++*members;
        for (size_t i = 0; i < COUNT(values); i++)
            wrong += !refuses(field, values[i]);
    }
    return wrong;
}

TEST(what_is_no_number_never_leaves)
{
    static const double values[] = {(double)NAN, (double)INFINITY, (double)-INFINITY};
    json_t *object = json_object();
    for (size_t i = 0; i < COUNT(values); i++)
        json_object_set_new(object, "a", json_real(values[i]));
    double naive = json_object_size(object) == 0 ? COUNT(values) : 0;
    json_decref(object);
    size_t members = 0;
    double ours = count_careless(&frame_record, &members);
    assert_true(members > 50);
    hard_case("57", "NaN and inf in any member (naive: jansson)", "wrong", naive, ours, 0);
}

TEST(whole_numbers_are_numbers)
{
    static const char *const texts[] = {"1", "-3", "1e3", "1234567", "4E+2", "0"};
    double naive = 0, ours = 0;
    for (size_t i = 0; i < COUNT(texts); i++) {
        double value = strtod(texts[i], NULL);
        naive += by_jansson(texts[i], json_real_value) != value;
        ours += count_misread(texts[i], value);
    }
    hard_case("58", "whole numbers read (naive: json_real_value)", "wrong", naive, ours, 0);
}

TEST(the_ends_of_the_doubles_are_exact_or_refused)
{
    static const char *const too_large[] = {"1e309", "-1e309", "1.7976931348623159e308", "1e99999",
                                            "1.5e999999999999999999999"};
    static const struct {
        const char *text;
        double value;
    } small[] = {{"1e-400", 0},
                 {"-1.5e-400", -0.0},
                 {"1e-999999999999999999999", 0},
                 {"2.4703282292062327e-324", 0},
                 {"5e-324", 0x1p-1074},
                 {"2.2250738585072011e-308", 0x0.fffffffffffffp-1022},
                 {"2.2250738585072014e-308", 0x1p-1022}};
    double naive = 0, ours = 0;
    for (size_t i = 0; i < COUNT(too_large); i++) {
        naive += isinf(strtod(too_large[i], NULL)) != 0;
        ours += count_taken(too_large[i]);
    }
    for (size_t i = 0; i < COUNT(small); i++)
        ours += count_misread(small[i].text, small[i].value);
    uint64_t random = 59;
    for (int i = 0; i < hard_points(100000); i++) {
        double value = sample_from_bits(sample_word(&random) & UINT64_C(0x800fffffffffffff));
        double back = through_text(value);
        ours += memcmp(&back, &value, sizeof value) != 0;
    }
    hard_case("59", "1e309, 1e-400, subnormals (naive: strtod)", "wrong", naive, ours, 0);
}

static bool seed_comes_back(uint64_t seed, struct text *line)
{
    struct frame frame;
    struct diag diag;
    char text[32];
    line->length = 0;
    snprintf(text, sizeof text, "\"%llu\"", (unsigned long long)seed);
    return read_frame(text, "0", "", &frame, &diag) == 0 && frame.seed == seed &&
           frame_text_write(&frame, line, &diag) == 0 &&
           frame_text_read(line->bytes, line->length - 1, &frame, &diag) == 0 && frame.seed == seed;
}

static bool takes_seed(const char *text)
{
    struct frame frame;
    struct diag diag;
    return read_frame(text, "0", "", &frame, &diag) == 0;
}

TEST(seeds_keep_all_their_bits)
{
    static const char *const bad[] = {"1",       "\"18446744073709551616\"",
                                      "\"-1\"",  "\"+1\"",
                                      "\"0x1\"", "\"99999999999999999999\"",
                                      "\"1.0\"", "\"\"",
                                      "\"1e3\"", "\" 1\"",
                                      "null",    "1.5",
                                      "\"1 \""};
    struct text *line = check_text();
    uint64_t random = 60;
    double naive = 0, ours = 0;
    for (size_t i = 0; i < COUNT(bad); i++)
        ours += takes_seed(bad[i]);
    int points = hard_points(100000);
    for (int i = 0; i < points; i++) {
        uint64_t seed = i == 0   ? UINT64_C(9007199254740993)
                        : i == 1 ? UINT64_MAX
                                 : sample_word(&random);
        MPFR_DECL_INIT(number, 53);
        naive += mpfr_set_uj(number, seed, MPFR_RNDN) != 0;
        ours += !seed_comes_back(seed, line);
    }
    hard_case("60", "64-bit seeds (naive: as JSON numbers)", "wrong", naive, ours, 0);
}

static bool takes_frame(const char *x, const char *more)
{
    struct frame frame;
    struct diag diag;
    return read_frame("\"1\"", x, more, &frame, &diag) == 0;
}

/* An object's extra member, nested so deep. */
static bool takes_depth(size_t depth)
{
    char x[3000] = "0,\"extra\":";
    assert_true(2 * depth + 20 < sizeof x);
    size_t length = strlen(x);
    memset(x + length, '[', depth);
    memset(x + length + depth, ']', depth);
    x[length + 2 * depth] = '\0';
    return takes_frame(x, "");
}

static bool takes_document(const char *bytes, size_t length)
{
    struct text *text = check_text();
    struct scenario scenario;
    struct diag diag = {0};
    text_add(text, bytes, length);
    bool taken =
        document_parse("test", text, &scenario_record, &scenario, check_arena(), &diag) == 0;
    return taken;
}

TEST(ambiguous_json_is_refused)
{
    static const char *const inside[] = {"0,\"x_m\":1",
                                         "0,\"id\":\"f\"",
                                         "0,\"extra\":\"\\u0000\"",
                                         "0,\"extra\":\"\\ud800\"",
                                         "0,\"extra\":\"\x80\"",
                                         "0,",
                                         "0}],\"objects\":[{"};
    static const char *const after[] = {"x", "{}", ",", "]", "\n{}", "\xef\xbb\xbf"};
    double ours = !takes_frame("0", "") + !takes_frame("0", " \t");
    for (size_t i = 0; i < COUNT(inside); i++)
        ours += takes_frame(inside[i], "");
    for (size_t i = 0; i < COUNT(after); i++)
        ours += takes_frame("0", after[i]);
    ours += !takes_depth(1000) + takes_depth(1001);
    struct frame frame = {.arena = check_arena()};
    struct diag diag = {0};
    ours += frame_text_read("\xef\xbb\xbf{}", 5, &frame, &diag) == 0 ||
            strstr(diag.text, "0xef") == NULL;
#define GOOD                                                                                       \
    "{\"origin\":\"t\",\"ego\":\"e\",\"rate_hz\":1,\"duration_s\":1,\"objects\":[{\"id\":\"e\","   \
    "\"class\":\"c\"}]"
    static const char good[] = GOOD "}", twice[] = GOOD ",\"rate_hz\":2}",
                      mark[] = "\xef\xbb\xbf" GOOD "}", trailing[] = GOOD "}x", nul[] = GOOD "}\0";
    ours += !takes_document(good, sizeof good - 1) + takes_document(twice, sizeof twice - 1) +
            takes_document(mark, sizeof mark - 1) + takes_document(trailing, sizeof trailing - 1) +
            takes_document(nul, sizeof nul - 1);
    json_t *tree = json_loads(twice, 0, NULL);
    double naive = tree != NULL;
    json_decref(tree);
    hard_case("61", "twins, NUL, BOM, trailing text, depth", "wrong", naive, ours, 0);
}

/* Makes a locale with a decimal comma in a folder, and sets it. The sources are written here, as a
 * bare system has none; localedef is part of the C library, and warns of all that they do not say.
 */
static bool set_german(const char *folder)
{
    static const char charmap[] = "<escape_char> /\nCHARMAP\n<U0000>..<U007F> /x00\nEND CHARMAP",
                      numbers[] = "escape_char /\nLC_NUMERIC\ndecimal_point \"<U002C>\"\n"
                                  "thousands_sep \"<U002E>\"\ngrouping 3;3\nEND LC_NUMERIC";
    char command[1024];
    snprintf(command, sizeof command,
             "mkdir '%s' && cd '%s' && echo '%s' >charmap && echo '%s' >numbers && "
             "localedef -c -f ./charmap -i ./numbers ./de_DE 2>warnings",
             folder, folder, charmap, numbers);
    return system(command) >= 0 && setenv("LOCPATH", folder, 1) == 0 &&
           setlocale(LC_NUMERIC, "de_DE") != NULL;
}

SCRATCH_TEST(the_locale_is_not_consulted)
{
    char command[256];
    uint64_t random = 62;
    double naive = 0, ours = 0;
    bool german = set_german(scratch->path);
    for (int i = 0; i < hard_points(100000) && german; i++) {
        double value = any_finite(&random), back = through_text(value);
        char text[64];
        snprintf(text, sizeof text, "%.17g", value);
        naive += strpbrk(text, ",") != NULL;
        ours += memcmp(&back, &value, sizeof value) != 0;
    }
    if (german) {
        ours += count_misread("12.55", 12.55) + count_misread("1.5e-400", 0) +
                count_misread("-0.25e-2", -0.0025) + count_taken("1.5e309") + count_taken("12,55");
        naive += strtod("12.55", NULL) == 12;
    }
    setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
    snprintf(command, sizeof command, "rm -rf '%s'", scratch->path);
    assert_int_equal(system(command), 0);
    if (german)
        hard_case("62", "numbers under de_DE (naive: printf, strtod)", "wrong", naive, ours, 0);
    else
        skip_because("localedef made no locale with a decimal comma");
}

TEST(only_whole_numbers_of_json_are_taken)
{
    static const char *const texts[] = {"nan",   "NaN", "inf",   "-inf",  "Infinity", "0x1p3",
                                        "0x10",  "",    "12abc", "1e",    "--1",      "1_000",
                                        "1.2.3", "-",   "+1",    "1,5",   "e5",       "nan(1)",
                                        "1e+",   "1d3", "1..2",  "infin", "- 1",      "1 2"};
    double ours = 0;
    for (size_t i = 0; i < COUNT(texts); i++)
        ours += count_taken(texts[i]);
    hard_case("63", "words and remains as numbers (naive: atof)", "wrong", COUNT(texts), ours, 0);
}

struct plain_csv {
    double numbers[3];
    size_t count;
};

/* Reads a table as libcsv gives its fields by default: without an end. */
static void take_plain_cell(void *text, size_t length, void *context)
{
    (void)length;
    struct plain_csv *plain = context;
    if (plain->count < 3)
        plain->numbers[plain->count++] = strtod(text, NULL);
}

static double count_plain_csv_wrong(void)
{
    static const char row[] = "12.5,3,7\n", open[] = "\"1,2\n3,4\n";
    struct plain_csv plain = {.count = 0};
    struct csv_parser parser;
    assert_int_equal(csv_init(&parser, 0), 0);
    csv_parse(&parser, row, sizeof row - 1, take_plain_cell, NULL, &plain);
    csv_fini(&parser, take_plain_cell, NULL, &plain);
    csv_free(&parser);
    double wrong = (plain.numbers[0] != 12.5) + (plain.numbers[1] != 3) + (plain.numbers[2] != 7);
    assert_int_equal(csv_init(&parser, 0), 0);
    csv_parse(&parser, open, sizeof open - 1, NULL, NULL, NULL);
    wrong += csv_fini(&parser, NULL, NULL, NULL) == 0;
    csv_free(&parser);
    return wrong;
}

/* The message that a table is refused with, or the number in its last cell and the row of that
 * cell. */
static bool table_says(const char *bytes, const char *expected)
{
    struct csv_table table;
    struct diag diag;
    char said[2100];
    double value;
    if (parse_table(bytes, strlen(bytes), &table, &diag) &&
        csv_table_number(&table, table.rows - 1, table.columns - 1, -1e9, 1e9, &value, &diag) == 0)
        snprintf(said, sizeof said, "%g in row %zu", value, table.numbers[table.rows - 1]);
    else
        snprintf(said, sizeof said, "%s", diag.text);
    if (strcmp(said, expected) == 0)
        return true;
    print_error("%s\n", said);
    return false;
}

TEST(tables_are_read_as_they_stand_or_refused)
{
    static const struct {
        const char *bytes, *expected;
    } cases[] = {
        {"a,b,c\n12.5,3,7\n", "7 in row 2"},
        {"a,b,c\n12.5,12.5,3\n", "3 in row 2"},
        {"a,b\n1,\"2\n3,4\n", "row 2: a quote opens a cell and nothing closes it"},
        {"a,b\n\n\n1,2\n", "2 in row 4"},
        {"a,b\r\n\r\n1,2\r\n", "2 in row 3"},
        {"\xef\xbb\xbf"
         "a,b\n1,2\n",
         "2 in row 2"},
        {"\xef\xbb\xbf\"a\",b\n1,2\n", "2 in row 2"},
        {"a,b\n1,2,3\n", "row 2: 3 cells; expected 2 as in the header"},
        {"a,b\n1\n", "row 2: 1 cell; expected 2 as in the header"},
        {"a,b\n1,2x\n", "row 2, column \"b\": \"2x\" is not a number"},
        {"", "the table is empty; expected a header"},
    };
    double ours = 0;
    for (size_t i = 0; i < COUNT(cases); i++)
        ours += !table_says(cases[i].bytes, cases[i].expected);
    hard_case("64", "CSV tables (naive: libcsv's defaults)", "wrong", count_plain_csv_wrong(), ours,
              0);
}
