#include "check.h"

#include <jansson.h>

#include "frame/frame_text.h"
#include "sample.h"
#include "text/record_write.h"

/* A frame with every member of every record, in the writer's own spelling. */
#define HEAD                                                                                       \
    "{\"version\":1,\"scene\":\"cut-in\",\"frame\":7,\"time_s\":0.28,\"interval_s\":0.04,"         \
    "\"last\":true,\"seed\":\"18446744073709551615\",\"ego\":\"e\",\"origin_x_m\":500000.25,"      \
    "\"origin_y_m\":-0.0,\"sections\":[\"objects\",\"account\",\"margins\"],"
#define OBJECTS                                                                                    \
    "\"objects\":[{\"id\":\"e\",\"class\":\"car\",\"x_m\":-0.0,\"y_m\":1e-07,\"yaw_rad\":0.1,"     \
    "\"vx_mps\":5e-324,\"vy_mps\":-2.5,\"yaw_rate_radps\":0,\"length_m\":4.5,\"width_m\":1.8,"     \
    "\"height_m\":1.5,\"travelled_m\":123456.789,\"extra\":{\"b\" : [1.0, 2e0 ],\"\\u0061\":0}}],"
#define REFLECTORS                                                                                 \
    "\"reflectors\":[{\"model\":\"car\",\"objects\":[\"a\\\"b\\\\\",\"\xc3\xa9\"],"                \
    "\"blocks\":true,\"raised\":true,\"points\":[{\"name\":\"p\",\"x\":0.5,\"y\":-0.5,"            \
    "\"inset_m\":0.1,\"facing_rad\":0,\"full_rad\":0.5,\"zero_rad\":1.5,\"shape\":\"linear\","     \
    "\"ercs\":0.7,\"under_vehicles\":0.5,\"lobe\":{\"width_rad\":0.7,\"depth_db\":14.9}}],"        \
    "\"planes\":[{\"name\":\"q\",\"from_x\":0.5,"                                                  \
    "\"from_y\":0.5,\"to_x\":-0.5,\"to_y\":0.5,\"margin_m\":0.2,\"ercs\":1}],\"rows\":[{"          \
    "\"name\":\"r\",\"from_x\":0,\"from_y\":0,\"to_x\":1,\"to_y\":0,\"spacing_m\":4,"              \
    "\"facing_rad\":0,\"full_rad\":1,\"zero_rad\":2,\"shape\":\"hard\",\"ercs\":0.2}]}],"
#define SENSORS                                                                                    \
    "\"sensors\":{\"suite\":\"s\",\"digest\":\"0123456789abcdef\",\"list\":[{\"name\":\"f\","      \
    "\"mount_x_m\":2,\"mount_y_m\":0,\"mount_yaw_rad\":0,\"field_of_view_rad\":3,"                 \
    "\"range_max_m\":30,\"cell_range_m\":0.3,\"cell_range_rate_mps\":0.5,\"cycle_s\":0.04,"        \
    "\"measured\":false}]},"
#define NAMES "\"object\":\"e\",\"reflector\":\"p\",\"path\":\"direct\""
#define IDEAL                                                                                      \
    ",\"range_m\":1e+06,\"azimuth_rad\":-3.141592653589793,\"range_rate_mps\":-0.1,"               \
    "\"ercs\":1e+308,\"time_s\":0.27"
#define MEMBER "[{" NAMES IDEAL ",\"weight\":1}]"
#define SIGHT ",\"margins\":{\"sight_m\":0}"
#define ECHOES "\"echoes\":[{\"sensor\":\"f\"," NAMES IDEAL SIGHT ",\"extra\":null}],"
#define CELLS                                                                                      \
    "\"cells\":[{\"sensor\":\"f\",\"range_m\":1,\"azimuth_rad\":0,\"elevation_rad\":0,\"range_"    \
    "rate_mps\":0,"                                                                                \
    "\"amplitude\":2,\"sum_re\":1,\"sum_im\":-1e+308,\"delta_re\":0,\"delta_im\":3,"               \
    "\"sign_undecided\":true,\"members\":" MEMBER ",\"margins\":{\"cell_edge\":2.5,\"sign\":1},"   \
    "\"extra\":\"x\"}],"
#define TARGETS                                                                                    \
    "\"targets\":[{\"sensor\":\"f\",\"range_m\":1,\"azimuth_rad\":0,\"elevation_rad\":-0.25,"      \
    "\"range_rate_mps\":0,"                                                                        \
    "\"amplitude_db\":-10.5,\"sign_undecided\":true,\"cell_range_m\":1,\"cell_azimuth_rad\":0,"    \
    "\"cell_elevation_rad\":0,"                                                                    \
    "\"cell_range_rate_mps\":0,\"cell_amplitude\":2,\"contributors\":" MEMBER ",\"margins\":{"     \
    "\"sight_m\":1e-09,\"threshold_db\":3,\"leader_db\":0,\"cell_edge\":0.5,\"sign\":1e-14,"       \
    "\"limit_db\":10000,\"limit_m\":2},\"extra\":[]}],"
#define LOST                                                                                       \
    "\"lost\":[{\"sensor\":\"f\",\"stage\":\"ideal\",\"reason\":\"blocked\",\"echoes\":["          \
    "{\"object\":\"e\",\"reflector\":\"p\",\"by\":\"e\",\"shortfall_db\":3" SIGHT "},"             \
    "{\"reflector\":\"q\",\"path\":\"object_wall\",\"mirror\":\"w\"},"                             \
    "{\"object\":\"f\",\"reflector\":\"p\"},{\"reflector\":\"q\"}]}],"
#define COUNTS                                                                                     \
    "\"counts\":[{\"sensor\":\"f\",\"pairs\":2,\"paths\":[{\"path\":\"direct\",\"echoes\":1}]}],"
#define VISIBILITY                                                                                 \
    "\"visibility\":[{\"sensor\":\"f\",\"object\":\"e\",\"reflectors\":9,\"in_range\":8,"          \
    "\"in_view\":4,\"blocked_share\":0.5,\"visibility\":\"v40-60\",\"detections\":3,\"merged\":2," \
    "\"ghosts\":1}],"

static const char rich[] =
    HEAD OBJECTS REFLECTORS SENSORS ECHOES CELLS TARGETS LOST COUNTS VISIBILITY
    "\"extra\":{ \"k\": -0.0 }}\n";

static int read_line(const char *line, struct frame *frame, struct diag *diag)
{
    *diag = (struct diag){0};
    return frame_text_read(line, strcspn(line, "\n"), frame, diag);
}

static void assert_reads_as_rich(const char *line)
{
    struct frame frame = {.arena = check_arena()};
    struct diag diag;
    struct text text = {0};
    if (read_line(line, &frame, &diag) != 0)
        fail_msg("%s\n%s", diag.text, line);
    assert_int_equal(frame_text_write(&frame, &text, &diag), 0);
    text_add(&text, "", 1);
    assert_string_equal(text.bytes, rich);
    text_free(&text);
}

TEST(a_rich_frame_comes_back_byte_for_byte)
{
    assert_reads_as_rich(rich);
}

/* The frame of the line, after parts of it were altered and others dropped. */
static void assert_written(const char *line, unsigned altered, unsigned dropped,
                           const char *expected)
{
    struct frame frame = {.arena = check_arena()};
    struct text *text = check_text();
    assert_done(frame_text_take, line, strlen(line), 0, &frame);
    frame_alter(&frame, altered);
    frame_drop(&frame, dropped);
    assert_done(frame_text_write, &frame, text);
    text_add(text, "", 1);
    assert_string_equal(text->bytes, expected);
}

TEST(members_that_nobody_alters_are_written_word_for_word)
{
    static const char line[] =
        "{\"scene\":\"\\u0061\",\"ego\":\"e\",\"objects\":[ ],\"lost\":[],\"seed\" : \"007\","
        "\"version\":1e0,\"origin_x_m\":0.0,\"interval_s\":\t1.0 ,\"time_s\":1E-1,\"frame\":1e0}";
    assert_written(line, 0, 0,
                   "{\"version\":1e0,\"scene\":\"\\u0061\",\"frame\":1e0,\"time_s\":1E-1,"
                   "\"interval_s\":1.0,\"seed\":\"007\",\"ego\":\"e\",\"origin_x_m\":0.0,"
                   "\"objects\":[ ],\"lost\":[]}\n");
    assert_written(line, PART_OBJECTS, PART_LOST,
                   "{\"version\":1e0,\"scene\":\"\\u0061\",\"frame\":1e0,\"time_s\":1E-1,"
                   "\"interval_s\":1.0,\"seed\":\"007\",\"ego\":\"e\",\"origin_x_m\":0.0,"
                   "\"objects\":[]}\n");
    assert_written(line, PART_HEADER, 0,
                   "{\"version\":1,\"scene\":\"a\",\"frame\":1,\"time_s\":0.1,"
                   "\"interval_s\":1,\"seed\":\"7\",\"ego\":\"e\",\"objects\":[ ],\"lost\":[]}\n");
}

/* The tree's text with its keys in another order, and white space where it may stand. */
static void print_shuffled(json_t *tree, const char *key, uint64_t *random, struct text *text)
{
    if (key != NULL && strcmp(key, "extra") == 0) {
        /* Byte for byte is for the other tests: this one carries a mark only. */
        text_add_word(text, "\"mark\"");
    } else if (json_is_object(tree)) {
        const char *keys[64];
        size_t count = 0;
        const char *name;
        json_t *value;
        json_object_foreach(tree, name, value) keys[count++] = name;
        text_add_word(text, "{ ");
        for (; count > 0; count--) {
            size_t pick = sample_bits(random) % count;
            text_format(text, "\t\"%s\" :\r ", keys[pick]);
            print_shuffled(json_object_get(tree, keys[pick]), keys[pick], random, text);
            text_add_word(text, count > 1 ? " ," : "");
            keys[pick] = keys[count - 1];
        }
        text_add_word(text, "}");
    } else if (json_is_array(tree)) {
        for (size_t i = 0; i < json_array_size(tree); i++) {
            text_add_word(text, i > 0 ? " , " : "[ ");
            print_shuffled(json_array_get(tree, i), NULL, random, text);
        }
        text_add_word(text, " ]");
    } else {
        char *scalar = json_dumps(tree, JSON_ENCODE_ANY | JSON_ENSURE_ASCII);
        text_add_word(text, scalar);
        free(scalar);
    }
}

TEST(keys_may_come_in_any_order_with_any_white_space)
{
    json_t *tree = json_loads(rich, JSON_DECODE_INT_AS_REAL, NULL);
    assert_non_null(tree);
    struct arena arena[2] = {0};
    struct frame frame = {.arena = &arena[0]}, again = {.arena = &arena[1]};
    uint64_t random = 3;
    struct text first = {0};
    for (int round = 0; round < 200; round++) {
        struct text line = {0}, text = {0};
        struct diag diag = {0};
        print_shuffled(tree, NULL, &random, &line);
        if (frame_text_read(line.bytes, line.length, &frame, &diag) != 0)
            fail_msg("%s\n%.*s", diag.text, (int)line.length, line.bytes);
        assert_int_equal(frame_text_write(&frame, &text, &diag), 0);
        if (round == 0)
            first = text;
        assert_int_equal(text.length, first.length);
        assert_memory_equal(text.bytes, first.bytes, first.length);
        text_free(&line);
        if (round > 0)
            text_free(&text);
    }
    struct diag diag;
    assert_int_equal(read_line(rich, &again, &diag), 0);
    assert_memory_equal(&frame.cells.items->sum_im, &again.cells.items->sum_im, sizeof(double));
    assert_close(frame.objects.items->vx_mps, 5e-324, 0);
    assert_true(signbit(frame.objects.items->x_m) && signbit(frame.origin_y_m));
    assert_string_equal(frame.reflectors.items->objects.items[0], "a\"b\\");
    assert_int_equal(frame.seed, UINT64_MAX);
    text_free(&first);
    json_decref(tree);
    arena_free(&arena[0]);
    arena_free(&arena[1]);
}

/* Every use of an id points to the same place, so that comparing them is cheap. */
TEST(equal_names_of_a_frame_are_one_pointer)
{
    struct frame frame = {.arena = check_arena()};
    struct diag diag;
    assert_int_equal(read_line(rich, &frame, &diag), 0);
    assert_true(frame.ego == frame.objects.items->id);
    assert_true(frame.ego == frame.cells.items->members.items->id.object);
    assert_true(frame.ego == frame.lost.items->echoes.items->by);
    assert_true(frame.sensors.list.items->name == frame.echoes.items->sensor);
}

/* rich with its first `from` replaced. In memory of its own. */
static char *with(const char *from, const char *to)
{
    const char *at = strstr(rich, from);
    if (at == NULL)
        fail_msg("%s is not in the line", from);
    char *line = malloc(sizeof rich + strlen(to));
    sprintf(line, "%.*s%s%s", (int)(at - rich), rich, to, at + strlen(from));
    return line;
}

TEST(a_number_may_be_spelled_in_any_way)
{
    static const char *const spellings[][2] = {
        {"\"time_s\":0.28", "\"time_s\":28e-2"},
        {"\"time_s\":0.28", "\"time_s\":0.280000000000000000000000000"},
        {"\"time_s\":0.28", "\"time_s\":0.28000000000000002665"},
        {"\"frame\":7", "\"frame\":7.0"},
        {"\"frame\":7", "\"frame\":70E-1"},
        {"\"pairs\":2", "\"pairs\":0.2e+01"},
        {"\"x_m\":-0.0,", "\"x_m\":-0e9,"},
        {"\"x_m\":-0.0,", "\"x_m\":-1e-400,"},
        {"\"version\":1", "\"version\":1.0"},
        {"\"version\":1", "\"version\":10e-1"},
        {"\"length_m\":4.5", "\"length_m\":0.00000045E7"},
        {"\"range_m\":1e+06", "\"range_m\":1000000"},
        {"\"seed\":\"18446744073709551615\"", "\"seed\":\"\\u00318446744073709551615\""},
        {"\"scene\":\"cut-in\"", "\"sc\\u0065ne\":\"c\\u0075t-in\""},
    };
    for (size_t i = 0; i < COUNT(spellings); i++) {
        char *line = with(spellings[i][0], spellings[i][1]);
        assert_reads_as_rich(line);
        free(line);
    }
}

TEST(a_lost_echo_may_name_an_object_that_the_echo_before_named_and_the_direct_path)
{
    char *line = with("{\"reflector\":\"q\",\"path\":\"object_wall\",\"mirror\":\"w\"}",
                      "{\"object\":\"e\",\"reflector\":\"q\",\"path\":\"object_wall\","
                      "\"mirror\":\"w\"}");
    assert_reads_as_rich(line);
    free(line);
    line =
        with("{\"reflector\":\"q\"}", "{\"object\":\"f\",\"reflector\":\"q\",\"path\":\"direct\"}");
    assert_reads_as_rich(line);
    free(line);
}

TEST(a_lost_echo_without_an_object_is_of_the_object_of_the_echo_before)
{
    struct frame frame = {.arena = check_arena()};
    struct diag diag;
    assert_int_equal(read_line(rich, &frame, &diag), 0);
    const struct lost_echo *echoes = frame.lost.items[0].echoes.items;
    assert_true(echoes[1].id.object == frame.ego && echoes[1].id.path == PATH_OBJECT_WALL);
    assert_string_equal(echoes[2].id.object, "f");
    assert_true(echoes[3].id.object == echoes[2].id.object && echoes[3].id.path == PATH_DIRECT);
}

TEST(what_is_absent_stays_absent)
{
    static const char head[] = "{\"version\":1,\"scene\":\"a\",\"frame\":0,\"time_s\":0,"
                               "\"interval_s\":1,\"seed\":\"0\",\"ego\":\"e\"";
    static const char *const tails[] = {"}\n", ",\"objects\":[]}\n",
                                        ",\"echoes\":[],\"cells\":[]}\n",
                                        ",\"lost\":[],\"extra\":null}\n"};
    for (size_t i = 0; i < COUNT(tails); i++) {
        struct frame frame = {.arena = check_arena()};
        struct diag diag;
        struct text line = {0}, text = {0};
        text_format(&line, "%s%s", head, tails[i]);
        text_add(&line, "", 1);
        assert_int_equal(read_line(rich, &frame, &diag), 0);
        assert_int_equal(read_line(line.bytes, &frame, &diag), 0);
        assert_int_equal(frame_text_write(&frame, &text, &diag), 0);
        text_add(&text, "", 1);
        assert_string_equal(text.bytes, line.bytes);
        text_free(&line);
        text_free(&text);
    }
}

TEST(faults_are_named_with_their_path_value_and_expectation)
{
#define OBJECT_KEYS                                                                                \
    "id, class, x_m, y_m, yaw_rad, vx_mps, vy_mps, yaw_rate_radps, length_m, width_m, height_m, "  \
    "travelled_m, extra"
    static const struct {
        const char *from, *to, *message;
    } cases[] = {
        {"\"range_m\":1e+06", "\"range_m\":-1", "echoes[0].range_m: -1 is outside [0, 1e6] m"},
        {"\"range_m\":1e+06", "\"range_m\":1000000.0000000001",
         "echoes[0].range_m: 1000000.0000000001 is outside [0, 1e6] m"},
        {"\"azimuth_rad\":-3.141592653589793", "\"azimuth_rad\":3.2",
         "echoes[0].azimuth_rad: 3.2 is outside [-3.14159, 3.14159] rad"},
        {"\"weight\":1", "\"weight\":1.5", "cells[0].members[0].weight: 1.5 is outside [0, 1]"},
        {"\"frame\":7", "\"frame\":7.5", "frame: 7.5 is not a whole number"},
        {"\"frame\":7", "\"frame\":\"7\"",
         "frame: a string; expected a whole number in [0, 9007199254740991]"},
        {"\"frame\":7", "\"frame\":null",
         "frame: null; expected a whole number in [0, 9007199254740991]"},
        {"\"version\":1", "\"version\":2", "version: 2 is outside [0, 1]; a newer glint reads it"},
        {"\"time_s\":0.28", "\"time_s\":1e999", "time_s: 1e999 is too large for a double"},
        {"\"time_s\":0.28", "\"time_s\":NaN", "time_s: 'N' where a value is expected"},
        {"\"last\":true", "\"last\":1", "last: a number; expected true or false"},
        {"\"last\":true", "\"last\":trve", "last: 't' where true or false is expected"},
        {"\"scene\":\"cut-in\"", "\"scene\":3", "scene: a number; expected a name"},
        {"\"echoes\":[{\"object\":\"e\",", "\"echoes\":[{",
         "lost[0].echoes[0].object: missing; expected a name"},
        {"\"scene\":\"cut-in\"", "\"scene\":\"\"", "scene: a name of 0 bytes; expected 1 to 1024"},
        {"\"scene\":\"cut-in\"", "\"scene\":\"a\\nb\"", "scene: control character 0x0a in a name"},
        {"\"scene\":\"cut-in\"", "\"scene\":\"\xff\"", "scene: byte 0xff in a string is not UTF-8"},
        {"\"seed\":\"1844", "\"seed\":\"9844",
         "seed: \"98446744073709551615\" is no seed; expected decimal digits up to "
         "18446744073709551615"},
        {"\"seed\":\"18446744073709551615\"", "\"seed\":1",
         "seed: a number; expected a string of digits"},
        {"\"path\":\"direct\"", "\"path\":\"bounce\"",
         "echoes[0].path: \"bounce\" is unknown; expected one of direct, "
         "wall_object, object_wall, wall_object_wall, "
         "wheel, limb, clutter, false_alarm"},
        {"\"shape\":\"linear\"", "\"shape\":\"flat\"",
         "reflectors[0].points[0].shape: \"flat\" is unknown; expected one of raised_cosine, "
         "hard, linear, cosine"},
        {"\"class\":\"car\",", "", "objects[0].class: missing; expected a name"},
        {"\"x_m\":-0.0,", "", "objects[0].x_m: missing; expected a number in [-1e7, 1e7] m"},
        {"\"ego\":\"e\",", "", "ego: missing; expected a name"},
        {"\"cell_elevation_rad\":0,", "",
         "targets[0].cell_elevation_rad: missing; expected a number in [-1.5708, 1.5708] rad"},
        {"\"list\":[{\"name\":\"f\",", "\"list\":[{",
         "sensors.list[0].name: missing; expected a name"},
        {"\"x_m\":-0.0,", "\"x_m\":-0.0,\"z_m\":1,",
         "objects[0].z_m: unknown key; expected one of " OBJECT_KEYS},
        {"\"digest\":", "\"digest\":\"1\",\"digest\":", "sensors.digest: the key stands twice"},
        {"\"pairs\":2", "\"pairs\":2,\"pairs\":2", "counts[0].pairs: the key stands twice"},
        {"\"objects\":[{", "\"objects\":[],\"objects\":[{", "objects: the key stands twice"},
        {"\"reason\":\"blocked\"", "\"reason\":[]", "lost[0].reason: an array; expected a name"},
        {"\"counts\":[{", "\"counts\":[7,{", "counts[0]: a number; expected an object"},
        {"\"sensors\":{", "\"sensors\":[{", "sensors: an array; expected an object"},
        {"\"objects\":[", "\"objects\":{", "objects: an object; expected an array of objects"},
        {"\"extra\":\"x\"", "\"extra\":{x}", "cells[0].extra: 'x' where a string is expected"},
        {"}\n", "} {}", "'{' where the end of the line is expected"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct frame frame = {.arena = check_arena()};
        struct diag diag;
        char *line = with(cases[i].from, cases[i].to);
        assert_int_equal(read_line(line, &frame, &diag), -1);
        assert_string_equal(diag.text, cases[i].message);
        assert_int_equal(diag.code, DIAG_DATA);
        free(line);
    }
}

TEST(no_beginning_of_a_frame_is_a_frame)
{
    struct frame frame = {.arena = check_arena()};
    for (size_t length = 0; length < sizeof rich - 2; length++) {
        struct diag diag = {0};
        char *cut = malloc(length + 1);
        memcpy(cut + 1, rich, length);
        assert_int_equal(frame_text_read(cut + 1, length, &frame, &diag), -1);
        assert_int_equal(diag.code, DIAG_DATA);
        free(cut);
    }
    struct diag diag;
    assert_int_equal(read_line("", &frame, &diag), -1);
    assert_string_equal(diag.text, "an empty line; expected a frame");
    assert_int_equal(read_line("[]", &frame, &diag), -1);
    assert_string_equal(diag.text, "'[' where a frame is expected");
}

/* Whatever one changed byte makes of the line: refused, or read and written the same way twice. */
TEST(a_changed_byte_is_refused_or_read_for_good)
{
    struct frame frame = {.arena = check_arena()};
    uint64_t random = 11;
    size_t taken = 0;
    for (int i = 0; i < 30000; i++) {
        char line[sizeof rich];
        struct text once = {0}, twice = {0};
        struct diag diag = {0};
        memcpy(line, rich, sizeof line);
        static const char bytes[] = "0159-.eE\"\\{}[]:, ax\x80\xc3";
        line[sample_bits(&random) % (sizeof rich - 2)] =
            bytes[sample_bits(&random) % (sizeof bytes - 1)];
        if (frame_text_read(line, sizeof rich - 2, &frame, &diag) == 0) {
            taken++;
            assert_int_equal(record_write_check(&frame_record, &frame, ~0U, &diag), 0);
            assert_int_equal(frame_text_write(&frame, &once, &diag), 0);
            assert_int_equal(frame_text_read(once.bytes, once.length - 1, &frame, &diag), 0);
            assert_int_equal(frame_text_write(&frame, &twice, &diag), 0);
            assert_memory_equal(once.bytes, twice.bytes, once.length);
        }
        text_free(&once);
        text_free(&twice);
    }
    assert_in_range(taken, 1000, 29000);
}

/* The text of what the line says, or nothing if it is refused. */
static void read_and_write(const char *line, size_t length, struct frame *frame, struct text *text)
{
    struct diag diag = {0};
    text->length = 0;
    if (frame_text_read(line, length, frame, &diag) == 0)
        assert_int_equal(frame_text_write(frame, text, &diag), 0);
}

#define FLAT                                                                                       \
    "{\"id\":\"e\",\"class\":\"car\",\"x_m\":1,\"y_m\":2,\"yaw_rad\":0.1,\"vx_mps\":5,"            \
    "\"vy_mps\":-2.5,\"yaw_rate_radps\":0,\"length_m\":4.5,\"width_m\":1.8,\"height_m\":1.5,"      \
    "\"travelled_m\":3}"

/* Objects that nobody reads pass to the next program, which takes or refuses the line as it would
 * have taken or refused the one before. */
TEST(what_passes_unread_is_refused_or_read_behind_as_before)
{
    static const char good[] =
        HEAD "\"objects\":[" FLAT "," FLAT "],\"vehicles\":[]," SENSORS COUNTS "\"extra\":0}\n";
    static const char bytes[] = "01.\"\"\\{}[[]]::,, ax\x80";
    struct frame frame = {.arena = check_arena()}, passed = {.arena = check_arena()};
    struct text before = {0}, behind = {0}, line = {0};
    uint64_t random = 12;
    size_t unread = 0, refused = 0;
    for (int i = 0; i < 60000; i++) {
        char text[sizeof good];
        struct diag diag = {0};
        memcpy(text, good, sizeof good);
        for (uint64_t k = sample_bits(&random) % 3; k > 0; k--)
            text[sample_bits(&random) % (sizeof good - 2)] =
                bytes[sample_bits(&random) % (sizeof bytes - 1)];
        read_and_write(text, sizeof good - 2, &frame, &before);
        line.length = 0;
        if (frame_text_take(text, sizeof good - 2, PART_OBJECTS, &passed, &diag) != 0) {
            assert_int_equal(before.length, 0);
            continue;
        }
        unread += (passed.line.unread & PART_OBJECTS) != 0;
        assert_int_equal(frame_text_write(&passed, &line, &diag), 0);
        read_and_write(line.bytes, line.length - 1, &frame, &behind);
        refused += behind.length == 0;
        assert_int_equal(behind.length, before.length);
        assert_memory_equal(behind.bytes, before.bytes, before.length);
    }
    assert_in_range(unread, 20000, 59000);
    assert_in_range(refused, 5000, 50000);
    text_free(&before);
    text_free(&behind);
    text_free(&line);
}

static struct frame frame_with_extra(struct arena *arena, size_t length)
{
    char *extra = arena_get(arena, length + 1);
    memset(extra, ' ', length);
    extra[0] = '[';
    extra[length - 1] = ']';
    return (struct frame){.scene = "a", .interval_s = 1, .ego = "e", .extra = extra};
}

TEST(extra_is_carried_up_to_its_limit)
{
    for (size_t length = FIELD_RAW_SIZE - 1; length <= FIELD_RAW_SIZE + 1; length++) {
        struct arena arena[2] = {0};
        struct frame written = frame_with_extra(&arena[0], length), read = {.arena = &arena[1]};
        struct text text = {0};
        struct diag diag = {0};
        assert_int_equal(frame_text_write(&written, &text, &diag), 0);
        int result = frame_text_read(text.bytes, text.length - 1, &read, &diag);
        if (length <= FIELD_RAW_SIZE) {
            assert_int_equal(result, 0);
            assert_string_equal(read.extra, written.extra);
        } else {
            assert_int_equal(result, -1);
            assert_string_equal(diag.text, "extra: 65537 bytes; expected at most 65536");
        }
        text_free(&text);
        arena_free(&arena[0]);
        arena_free(&arena[1]);
    }
}

TEST(a_line_is_written_up_to_its_limit)
{
    struct text text = {0};
    struct diag diag = {0};
    struct frame frame = frame_with_extra(check_arena(), 10);
    assert_int_equal(frame_text_write(&frame, &text, &diag), 0);
    size_t rest = text.length - 10;
    for (size_t length = FRAME_TEXT_SIZE - 1; length <= FRAME_TEXT_SIZE + 1; length++) {
        frame = frame_with_extra(check_arena(), length - rest);
        text.length = 3;
        int result = frame_text_write(&frame, &text, &diag);
        assert_int_equal(result, length <= FRAME_TEXT_SIZE ? 0 : -1);
        assert_int_equal(text.length, length <= FRAME_TEXT_SIZE ? 3 + length : 3);
    }
    assert_string_equal(diag.text, "a line of 16777217 bytes; at most 16777216 are allowed");
    text_free(&text);
}
