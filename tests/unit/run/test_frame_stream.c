#define SCRATCH_FILE "a"
#include "scratch.h"

#include "run/frame_stream.h"

#define FRAME(number)                                                                              \
    "{\"version\":1,\"scene\":\"s\",\"frame\":" number ",\"time_s\":" number                       \
    ",\"interval_s\":1,\"seed\":\"1\",\"ego\":\"e\"}"
#define LAST(number)                                                                               \
    "{\"version\":1,\"scene\":\"s\",\"frame\":" number ",\"time_s\":" number                       \
    ",\"interval_s\":1,\"last\":true,\"seed\":\"1\",\"ego\":\"e\"}"

struct bench {
    struct frame_stream stream;
    struct frame frame;
    struct diag diag;
};

/* A stream of the scratch file, times over. */
static void begin(struct bench *bench, struct scratch *scratch, const char *text, size_t times)
{
    static const char *paths[3];
    scratch_write(scratch->path, text);
    for (size_t i = 0; i < times; i++)
        paths[i] = scratch->path;
    *bench = (struct bench){.stream = {.paths = paths, .count = times}};
    bench->frame.arena = &scratch->arena;
}

static int next(struct bench *bench)
{
    return frame_stream_next(&bench->stream, &bench->frame, &bench->diag);
}

static void assert_refuses(struct scratch *scratch, struct bench *bench, const char *message)
{
    char expected[256];
    snprintf(expected, sizeof expected, "%s%s", scratch->path, message);
    assert_int_equal(next(bench), -1);
    frame_stream_name_line(&bench->stream, &bench->diag);
    assert_string_equal(bench->diag.text, expected);
    frame_stream_close(&bench->stream);
}

FIXTURE(make_scratch, remove_scratch);

TEST_OF(scratch, files_are_read_one_after_the_other)
{
    struct bench bench;
    begin(&bench, scratch, FRAME("0") "\n" LAST("1"), 2);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(next(&bench), 1);
        assert_int_equal(bench.frame.frame, i % 2);
    }
    assert_int_equal(next(&bench), 0);
    assert_int_equal(next(&bench), 0);
}

TEST_OF(scratch, an_empty_file_has_no_frames)
{
    struct bench bench;
    begin(&bench, scratch, "", 3);
    assert_int_equal(next(&bench), 0);
}

TEST_OF(scratch, a_message_names_file_and_line)
{
    struct bench bench;
    begin(&bench, scratch, FRAME("0") "\n" FRAME("1") "\nbroken", 2);
    assert_int_equal(next(&bench), 1);
    assert_int_equal(next(&bench), 1);
    assert_refuses(scratch, &bench, ":3: 'b' where a frame is expected");
}

TEST_OF(scratch, lines_are_counted_from_one_in_every_file)
{
    struct bench bench;
    begin(&bench, scratch, FRAME("0") "\n" FRAME("1"), 2);
    for (int i = 0; i < 3; i++)
        assert_int_equal(next(&bench), 1);
    bench.diag.code = DIAG_DATA;
    frame_stream_name_line(&bench.stream, &bench.diag);
    assert_non_null(strstr(bench.diag.text, "/a:1: "));
    frame_stream_close(&bench.stream);
}

TEST_OF(scratch, a_folder_has_no_lines)
{
    struct bench bench;
    begin(&bench, scratch, "", 1);
    bench.stream.paths = (const char *[]){scratch->directory};
    assert_int_equal(next(&bench), -1);
    frame_stream_name_line(&bench.stream, &bench.diag);
    assert_int_equal(bench.diag.code, DIAG_NO_INPUT);
    assert_null(strstr(bench.diag.text, ":0:"));
    assert_int_equal(strncmp(bench.diag.text, scratch->directory, strlen(scratch->directory)), 0);
    frame_stream_close(&bench.stream);
}

TEST_OF(scratch, a_file_that_is_not_there_is_named)
{
    struct bench bench;
    begin(&bench, scratch, "", 1);
    bench.stream.paths = (const char *[]){"/nonexistent/a"};
    assert_int_equal(next(&bench), -1);
    assert_string_equal(bench.diag.text, "/nonexistent/a: No such file or directory");
    assert_int_equal(bench.diag.code, DIAG_NO_INPUT);
}

/* A line may be well-formed, and each of its members too, and yet be no frame. */
TEST_OF(scratch, frames_are_checked)
{
    struct bench bench;
    begin(&bench, scratch,
          "{\"version\":1,\"scene\":\"s\",\"frame\":0,\"time_s\":0,\"interval_s\":1,\"seed\":\"1\","
          "\"ego\":\"e\",\"objects\":[]}",
          1);
    assert_refuses(scratch, &bench, ":1: ego: \"e\" is not among the objects");
}

/* A frame with these objects, which need not be read. */
static void begin_unread(struct bench *bench, struct scratch *scratch, const char *objects)
{
    char line[512];
    snprintf(line, sizeof line,
             "{\"version\":1,\"scene\":\"s\",\"frame\":0,\"time_s\":0,\"interval_s\":1,"
             "\"seed\":\"1\",\"ego\":\"e\",\"objects\":%s,\"extra\":7}",
             objects);
    begin(bench, scratch, line, 1);
    bench->stream.unread = PART_OBJECTS;
    assert_int_equal(next(bench), 1);
}

#define OBJECT(id)                                                                                 \
    "{\"id\":\"" id "\",\"class\":\"car\",\"x_m\":1,\"y_m\":2,\"yaw_rad\":0,\"vx_mps\":0,"         \
    "\"vy_mps\":0,\"yaw_rate_radps\":0,\"length_m\":4,\"width_m\":2,\"height_m\":1,\"travelled_"   \
    "m\":0}"

TEST_OF(scratch, objects_are_read_when_they_are_asked_for)
{
    struct bench bench;
    begin_unread(&bench, scratch, "[" OBJECT("f") "," OBJECT("e") "]");
    assert_int_equal(bench.frame.present, PART_OBJECTS);
    assert_int_equal(bench.frame.objects.count, 0);
    for (int i = 0; i < 2; i++) {
        assert_done(frame_stream_read_left, &bench.frame, PART_OBJECTS);
        assert_int_equal(bench.frame.objects.count, 2);
        assert_string_equal(frame_object(&bench.frame, "e")->id, "e");
    }
    frame_stream_close(&bench.stream);
}

TEST_OF(scratch, a_list_whose_end_is_not_sure_is_read_at_once)
{
    struct bench bench;
    begin_unread(&bench, scratch, "[" OBJECT("e") "," OBJECT("a],b") "]");
    assert_int_equal(bench.frame.objects.count, 2);
    frame_stream_close(&bench.stream);
}

TEST_OF(scratch, faults_of_objects_are_told_where_they_are_read)
{
    static const struct {
        const char *objects, *message;
    } cases[] = {
        {"[]", "ego: \"e\" is not among the objects"},
        {"[{}]", "objects[0].id: missing; expected a name"},
        {"[" OBJECT("e") "," OBJECT("e") "]", "objects: the id \"e\" stands twice"},
        {"[" OBJECT("e") "}]", "objects: '}' where ',' or ']' is expected"},
        {"[" OBJECT("e") ",]", "objects[1]: ']' where a value is expected"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct bench bench;
        begin_unread(&bench, scratch, cases[i].objects);
        assert_refused(DIAG_DATA, cases[i].message, frame_stream_read_left, &bench.frame,
                       PART_OBJECTS);
        frame_stream_close(&bench.stream);
    }
}
