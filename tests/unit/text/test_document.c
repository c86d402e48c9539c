#define SCRATCH_FILE "vehicles/mine.json"
#include "scratch.h"

#include <sys/stat.h>

#include "documents/suite_file.h"
#include "documents/vehicle.h"
#include "text/document.h"
#include "traffic/scenario.h"

static int read_document(const char *path, const struct record *record, void *base,
                         struct arena *arena, struct diag *diag)
{
    struct text *bytes = check_text();
    int result = document_bytes(path, bytes, diag);
    if (result == 0)
        result = document_parse(path, bytes, record, base, arena, diag);
    return result;
}

/* The scratch with a folder of vehicles. */
static int make_data(void **state)
{
    document_guard_memory();
    make_scratch(state);
    return mkdir(scratch_in(*state, "vehicles"), 0777);
}

static int remove_data(void **state)
{
    unsetenv("GLINT_DATA");
    return remove_scratch(state);
}

static const char vehicle_text[] =
    "{\"origin\": \"a test\", \"length_m\": 4, \"width_m\": 2, \"height_m\": 1.5,\n"
    " \"reflectors\": {\"blocks\": true, \"points\": [{\"name\": \"p\", \"x\": 0.5, \"y\": -0.5,\n"
    "  \"facing_rad\": 0, \"full_rad\": 1, \"zero_rad\": 2, \"ercs\": 1}]}}\n";

FIXTURE(make_data, remove_data);

TEST_OF(scratch, names_are_looked_up_in_the_data_folder_first)
{
    struct diag diag = {0};
    scratch_write(scratch->path, vehicle_text);
    assert_int_equal(setenv("GLINT_DATA", scratch->directory, 1), 0);
    assert_string_equal(document_find(NULL, "vehicles", "mine", ".json", &scratch->arena, &diag),
                        scratch->path);
    /* A name that is not there is found in the places after it. */
    assert_non_null(document_find(NULL, "vehicles", "car", ".json", &scratch->arena, &diag));
    /* A name that is in both is found in the first. */
    const char *car = scratch_in(scratch, "vehicles/car.json");
    assert_int_equal(link(scratch->path, car), 0);
    assert_string_equal(document_find(NULL, "vehicles", "car", ".json", &scratch->arena, &diag),
                        car);
    assert_int_equal(setenv("GLINT_DATA", "", 1), 0);
    assert_string_not_equal(document_find(NULL, "vehicles", "car", ".json", &scratch->arena, &diag),
                            car);
    assert_int_equal(unlink(car), 0);
}

TEST_OF(scratch, a_name_with_a_slash_or_a_dot_is_a_path)
{
    static const char *const paths[] = {"./mine", "mine.json", "/a/b", "..", "a/b", "-", "x.y"};
    struct diag diag = {0};
    for (size_t i = 0; i < COUNT(paths); i++)
        assert_string_equal(
            document_find(NULL, "vehicles", paths[i], ".json", &scratch->arena, &diag), paths[i]);
}

TEST_OF(scratch, for_an_unknown_name_the_message_lists_the_places)
{
    struct diag diag = {0};
    assert_int_equal(setenv("GLINT_DATA", scratch->directory, 1), 0);
    assert_null(document_find(NULL, "sensors", "nowhere", ".csv", &scratch->arena, &diag));
    char begin[160];
    int length =
        snprintf(begin, sizeof begin, "there is no sensors/nowhere.csv; looked in %s/sensors/, /",
                 scratch->directory);
    assert_memory_equal(diag.text, begin, (size_t)length);
    assert_non_null(strstr(diag.text, "../share/glint/data/sensors/, /"));
    assert_non_null(strstr(diag.text, "../../data/sensors/, data/sensors/"));
    assert_int_equal(diag.code, DIAG_CONFIG);
}

TEST_OF(scratch, names_are_listed_in_order_and_each_once)
{
    struct document_names list;
    assert_int_equal(setenv("GLINT_DATA", "data", 1), 0); /* the same place twice */
    assert_done(document_list, "vehicles", ".json", &list, &scratch->arena);
    assert_true(list.names.count > 5);
    for (size_t i = 1; i < list.names.count; i++)
        assert_true(strcmp(list.names.items[i - 1], list.names.items[i]) < 0);
    assert_done(document_list, "vehicles", ".none", &list, &scratch->arena);
    assert_int_equal(list.names.count, 0);
    assert_int_equal(setenv("GLINT_DATA", scratch->directory, 1), 0);
}

TEST_OF(scratch, folders_that_are_not_there_are_refused)
{
    struct document_names list;
    struct diag diag = {0};
    assert_int_equal(setenv("GLINT_DATA", scratch->path, 1), 0);
    assert_null(document_find(NULL, "vehicles", "car", ".json", &scratch->arena, &diag));
    assert_non_null(strstr(diag.text, "GLINT_DATA: \""));
    assert_int_equal(diag.code, DIAG_CONFIG);
    assert_int_equal(document_list("vehicles", ".json", &list, &scratch->arena, &diag), -1);
    assert_int_equal(setenv("GLINT_DATA", scratch->directory, 1), 0);
}

TEST_OF(scratch, a_name_that_is_nearly_right_is_guessed)
{
    struct diag diag = {0};
    assert_null(document_find(NULL, "vehicles", "pedestrain", ".json", &scratch->arena, &diag));
    static const char begin[] =
        "there is no vehicles/pedestrain.json (did you mean pedestrian?); looked in ";
    assert_memory_equal(diag.text, begin, sizeof begin - 1);
    assert_non_null(strstr(diag.text, "; all are listed by glint --list vehicles"));
}

TEST_OF(scratch, a_document_fills_its_struct)
{
    struct vehicle vehicle;
    scratch_write(scratch->path, vehicle_text);
    assert_done(read_document, scratch->path, &vehicle_record, &vehicle, &scratch->arena);
    assert_string_equal(vehicle.origin, "a test");
    assert_close(vehicle.length_m, 4, 0);
    assert_true(vehicle.reflectors.blocks && !vehicle.reflectors.raised);
    assert_int_equal(vehicle.reflectors.points.count, 1);
    assert_string_equal(vehicle.reflectors.points.items[0].name, "p");
    assert_close(vehicle.reflectors.points.items[0].inset_m, 0, 0);
    assert_int_equal(vehicle.reflectors.points.items[0].shape, VISIBILITY_RAISED_COSINE);
}

/* The document with one place changed. */
static void write_changed(const struct scratch *scratch, const char *from, const char *to)
{
    const char *at = strstr(vehicle_text, from);
    assert_non_null(at);
    char text[2048];
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - vehicle_text), vehicle_text, to,
             at + strlen(from));
    scratch_write(scratch->path, text);
}

TEST_OF(scratch, faults_are_named_with_path_member_and_expectation)
{
    static const struct {
        const char *from, *to, *message;
    } cases[] = {
        {"4,", "0,", "length_m: 0 is outside [0.01, 10000] m"},
        {"\"length_m\": 4, ", "", "length_m: missing; expected a number in [0.01, 10000] m"},
        {"4,", "\"4\",", "length_m: a string; expected a number in [0.01, 10000] m"},
        {"4,", "null,", "length_m: null; expected a number in [0.01, 10000] m"},
        {"\"a test\"", "[]", "origin: an array; expected a name"},
        {"\"x\": 0.5", "\"x\": 1.5", "reflectors.points[0].x: 1.5 is outside [-1, 1]"},
        {"\"x\"", "\"q\"",
         "reflectors.points[0].q: unknown key; expected one of name, x, y, z, extent, inset_m, "
         "facing_rad, full_rad, zero_rad, shape, ercs, moving_part, under_vehicles, lobe"},
        {"true", "1", "reflectors.blocks: a number; expected true or false"},
        {"\"blocks\": true", "\"objects\": []",
         "reflectors.objects: unknown key; expected one of blocks, raised, clearance_m, points, "
         "planes, "
         "rows, mirrors"},
        {"[{", "[3, {", "reflectors.points[0]: a number; expected an object"},
        {"\"ercs\": 1", "\"ercs\": 1, \"shape\": \"flat\"",
         "reflectors.points[0].shape: \"flat\" is unknown; expected one of raised_cosine, hard, "
         "linear, cosine"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct vehicle vehicle;
        char message[512];
        write_changed(scratch, cases[i].from, cases[i].to);
        snprintf(message, sizeof message, "%s: %s", scratch->path, cases[i].message);
        assert_refused(DIAG_CONFIG, message, read_document, scratch->path, &vehicle_record,
                       &vehicle, &scratch->arena);
    }
}

TEST_OF(scratch, text_that_is_not_a_document_is_refused_with_its_line)
{
    static const struct {
        const char *text, *message;
    } cases[] = {{"", ":1: "},
                 {"\n\n{\"origin\": }", ":3: "},
                 {"{\"origin\": \"a\",\n\"origin\": \"b\"}", ":2: duplicate object key"},
                 {"{} {}", ":1: end of file expected"},
                 {"\xef\xbb\xbf{}", ": JSON behind a byte order mark"},
                 {"{\"origin\": \"\\u0000\"}", ":1: "},
                 {"{\"origin\": \"\xff\"}", ":1: "},
                 {"{\"length_m\": 1e999}", ":1: "},
                 {"[]", ": '[' where a vehicle is expected"}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct vehicle vehicle;
        struct diag diag = {0};
        char begin[256];
        scratch_write(scratch->path, cases[i].text);
        int length = snprintf(begin, sizeof begin, "%s%s", scratch->path, cases[i].message);
        assert_int_equal(
            read_document(scratch->path, &vehicle_record, &vehicle, &scratch->arena, &diag), -1);
        if (strncmp(diag.text, begin, (size_t)length) != 0)
            fail_msg("\"%s\" does not begin with \"%s\"", diag.text, begin);
        assert_int_equal(diag.code, DIAG_CONFIG);
    }
}

TEST_OF(scratch, notes_are_strings)
{
    static const struct field fields[] = {
        {.name = "sources", .kind = FIELD_NOTES, .optional = true, .help = ""}, {0}};
    static const struct record record = {.name = "thing", .size = 1, .fields = fields};
    char nothing;
    struct diag diag = {0};
    scratch_write(scratch->path, "{\"sources\": {\"a\": \"b\", \"c\": \"d\"}}");
    assert_done(read_document, scratch->path, &record, &nothing, &scratch->arena);
    scratch_write(scratch->path, "{\"sources\": {\"a\": \"b\", \"c\": 1}}");
    assert_int_equal(read_document(scratch->path, &record, &nothing, &scratch->arena, &diag), -1);
    assert_non_null(strstr(diag.text, "mine.json: sources.c: a number; expected a string"));
}

TEST_OF(scratch, a_missing_document_is_named)
{
    struct vehicle vehicle;
    struct diag diag = {0};
    assert_refused(DIAG_NO_INPUT, "/nonexistent/a.json: No such file or directory", read_document,
                   "/nonexistent/a.json", &vehicle_record, &vehicle, &scratch->arena);
    assert_int_equal(
        read_document(scratch->directory, &vehicle_record, &vehicle, &scratch->arena, &diag), -1);
    assert_non_null(strstr(diag.text, ": Is a directory"));
}
