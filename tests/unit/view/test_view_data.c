#include "check.h"

#include <jansson.h>

#include "frame/frame_text.h"
#include "view/view_data.h"
#include "view/view_page.h"

/* The ego at (10, 20) heads north at 5 m/s and turns; its sensor sits 2 m ahead and 1 m left. */
#define EGO                                                                                        \
    "{\"id\":\"e\",\"class\":\"thing\",\"x_m\":10,\"y_m\":20,\"yaw_rad\":1.5707963267948966,"      \
    "\"vx_mps\":0,\"vy_mps\":5,\"yaw_rate_radps\":0.1,\"length_m\":4,\"width_m\":2,"               \
    "\"height_m\":1,\"travelled_m\":0}"
#define OTHER                                                                                      \
    "{\"id\":\"</script>\",\"class\":\"thing\",\"x_m\":10,\"y_m\":30,\"yaw_rad\":0,"               \
    "\"vx_mps\":1,\"vy_mps\":0,\"yaw_rate_radps\":0,\"length_m\":3,\"width_m\":1,"                 \
    "\"height_m\":1,\"travelled_m\":0}"
#define SENSORS(age)                                                                               \
    "\"sensors\":{\"suite\":\"s\",\"digest\":\"0123456789abcdef\",\"list\":[{\"name\":\"f\","      \
    "\"mount_x_m\":2,\"mount_y_m\":1,\"mount_yaw_rad\":0.25,\"field_of_view_rad\":3,"              \
    "\"range_max_m\":30,\"cell_range_m\":0.3,\"cell_range_rate_mps\":0.5,\"measured\":true,\"age_" \
    "s\":" age "}]},"
#define PART(name, range, weight, time)                                                            \
    "{\"object\":\"</script>\",\"reflector\":\"" name "\",\"path\":\"direct\",\"range_m\":" range  \
    ",\"azimuth_rad\":0.5,\"range_rate_mps\":-2,\"ercs\":0.5,\"time_s\":" time                     \
    ",\"weight\":" weight "}"
#define TARGET(range, parts)                                                                       \
    "{\"sensor\":\"f\",\"range_m\":" range ",\"azimuth_rad\":0.125,\"range_rate_mps\":-1.5,"       \
    "\"amplitude_db\":12.5,\"cell_range_m\":8.25,\"cell_azimuth_rad\":0.25,"                       \
    "\"cell_range_rate_mps\":-1.25,\"cell_amplitude\":4,\"cell_sum\":3,\"contributors\":[" parts   \
    "]}"
#define LOST                                                                                       \
    "\"lost\":[{\"sensor\":\"f\",\"stage\":\"ideal\",\"reason\":\"facing_away\",\"echoes\":["      \
    "{\"object\":\"</script>\",\"reflector\":\"c\",\"path\":\"direct\"}]},"                        \
    "{\"sensor\":\"f\",\"stage\":\"sensor\",\"reason\":\"below_threshold\",\"echoes\":["           \
    "{\"object\":\"</script>\",\"reflector\":\"d\",\"path\":\"direct\",\"shortfall_db\":2.5}]}]"
#define FRAME(scene, number, time, last, rest) AGED("0", scene, number, time, last, rest)
#define AGED(age, scene, number, time, last, rest)                                                 \
    "{\"version\":1,\"scene\":\"" scene "\",\"frame\":" number ",\"time_s\":" time                 \
    ",\"interval_s\":0.04,\"last\":" last                                                          \
    ",\"seed\":\"1\",\"ego\":\"e\",\"sections\":[\"account\"],"                                    \
    "\"objects\":[" EGO "," OTHER "]," SENSORS(age) rest "}"
#define RICH                                                                                       \
    "\"targets\":[" TARGET(                                                                        \
        "8", PART("a", "8.5", "0.75", "4") "," PART(                                               \
                 "b", "8.75", "0.25", "4")) "," TARGET("9", PART("e", "9.5", "1", "4")) "]," LOST

/* Frames read from lines and packed, and the text of the page's data. */
struct packed {
    struct arena arena, frame_arena;
    struct view_data data;
    struct text head, columns;
    json_t *json;
};

static void add_line(struct packed *packed, const char *line)
{
    struct frame frame = {.arena = &packed->frame_arena};
    assert_done(frame_text_read, line, strlen(line), &frame);
    assert_done(view_data_add, &packed->data, &frame);
}

static void finish(struct packed *packed)
{
    json_error_t error;
    view_page_write_head(&packed->data, -1, &packed->head);
    view_columns_write(&packed->data.columns, &packed->columns);
    packed->json = json_loadb(packed->head.bytes, packed->head.length, 0, &error);
    if (packed->json == NULL)
        fail_msg("the head is not JSON: %s", error.text);
}

static unsigned digit(char letter)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = strchr(digits, letter);
    assert_non_null(at);
    return (unsigned)(at - digits);
}

static unsigned byte_at(const struct packed *packed, size_t begin, size_t index)
{
    const char *group = packed->columns.bytes + begin + index / 3 * 4;
    unsigned bits =
        digit(group[0]) << 18 | digit(group[1]) << 12 | digit(group[2]) << 6 | digit(group[3]);
    return bits >> (16 - 8 * (index % 3)) & 0xff;
}

static json_t *place_of(const struct packed *packed, const char *name)
{
    size_t index;
    json_t *place;
    json_array_foreach(json_object_get(packed->json, "columns"), index, place)
    {
        if (strcmp(json_string_value(json_object_get(place, "name")), name) == 0)
            return place;
    }
    fail_msg("there is no column %s", name);
    return NULL;
}

static size_t count_of(const struct packed *packed, const char *name)
{
    json_t *place = place_of(packed, name);
    return (size_t)json_integer_value(json_object_get(place, "count"));
}

/* A number of a column, decoded independently of the code under test. */
static double value_of(const struct packed *packed, const char *name, size_t index)
{
    json_t *place = place_of(packed, name);
    assert_true(index < count_of(packed, name));
    const char *type = json_string_value(json_object_get(place, "type"));
    size_t begin = (size_t)json_integer_value(json_object_get(place, "begin"));
    size_t width = (size_t)(type[1] - '0');
    assert_int_equal(begin % 16, 0);
    uint32_t bits = 0;
    for (size_t i = 0; i < width; i++)
        bits |= (uint32_t)byte_at(packed, begin, index * width + i) << 8 * i;
    if (type[0] == 'u')
        return bits;
    float real;
    memcpy(&real, &bits, sizeof real);
    return (double)real;
}

static const char *name_at(const struct packed *packed, double index)
{
    return json_string_value(json_array_get(json_object_get(packed->json, "names"), (size_t)index));
}

static int begin(void **state)
{
    struct packed *packed = check_make(state, sizeof *packed);
    view_data_begin(&packed->data, &packed->arena);
    return 0;
}

static int end(void **state)
{
    struct packed *packed = *state;
    json_decref(packed->json);
    text_free(&packed->head);
    text_free(&packed->columns);
    arena_free(&packed->arena);
    arena_free(&packed->frame_arena);
    free(packed);
    return 0;
}

#define VIEW_TEST(name) TEST_WITH(begin, end, struct packed *packed, name)

VIEW_TEST(the_columns_hold_what_the_frames_held)
{
    add_line(packed, FRAME("x", "100", "4", "false", RICH));
    finish(packed);
    static const struct {
        const char *column;
        size_t index;
        double value;
    } cases[] = {
        {"frame_objects", 0, 2},
        {"frame_scans", 0, 1},
        {"scan_targets", 0, 2},
        {"target_range_m", 0, 8},
        {"target_range_m", 1, 9},
        {"target_azimuth_rad", 0, 0.125},
        {"target_range_rate_mps", 1, -1.5},
        {"target_amplitude_db", 0, 12.5},
        {"target_cell_range_m", 0, 8.25},
        {"target_cell_sum", 0, 3},
        {"target_effects", 0, 0},
        {"target_effects", 1, 0},
        {"target_contributors", 0, 2},
        {"target_contributors", 1, 1},
        {"contributor_weight", 0, 0.75},
        {"contributor_weight", 1, 0.25},
        {"contributor_range_m", 2, 9.5},
        {"object_length_m", 1, 3},
        {"object_vx_mps", 1, 1},
        {"scan_fates", 0, 1},
        {"scan_details", 0, 1},
        {"pattern_items", 0, 2},
        {"detail_shortfall_db", 0, 2.5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        if (value_of(packed, cases[i].column, cases[i].index) != cases[i].value)
            fail_msg("%s[%zu] is %g", cases[i].column, cases[i].index,
                     value_of(packed, cases[i].column, cases[i].index));
    assert_string_equal(name_at(packed, value_of(packed, "contributor_reflector", 2)), "e");
    assert_string_equal(name_at(packed, value_of(packed, "detail_reflector", 0)), "d");
    assert_string_equal(name_at(packed, value_of(packed, "item_stage", 0)), "ideal");
}

VIEW_TEST(a_sensor_that_stays_the_same_is_listed_once)
{
    add_line(packed, FRAME("x", "100", "4", "false", RICH));
    add_line(packed, FRAME("x", "101", "4.04", "true", RICH));
    finish(packed);
    assert_int_equal(packed->data.sensors.count, 1);
}

VIEW_TEST(a_sensor_stands_and_moves_with_its_mount)
{
    add_line(packed, FRAME("x", "0", "4", "false", RICH));
    finish(packed);
    /* Coordinates are relative to the ego's start; omega x r of r = (-1, 2) is (-0.2, -0.1). */
    assert_close(value_of(packed, "scan_x_m", 0), -1, 1e-6);
    assert_close(value_of(packed, "scan_y_m", 0), 2, 1e-6);
    assert_close(value_of(packed, "scan_yaw_rad", 0), acos(0) + 0.25, 1e-6);
    assert_close(value_of(packed, "scan_vx_mps", 0), -0.2, 1e-6);
    assert_close(value_of(packed, "scan_vy_mps", 0), 4.9, 1e-6);
    assert_close(value_of(packed, "object_y_m", 1), 10, 1e-6);
}

VIEW_TEST(a_sensor_stands_where_it_was_when_it_measured)
{
    add_line(packed, AGED("0.02", "x", "0", "4.02", "false",
                          "\"targets\":[" TARGET("8", PART("a", "8.5", "1", "4")) "]"));
    finish(packed);
    /* 0.02 s earlier at 5 m/s, and turned 0.002 rad less. */
    assert_close(value_of(packed, "scan_age_s", 0), 0.02, 1e-6);
    assert_close(value_of(packed, "scan_yaw_rad", 0), acos(0) + 0.25 - 0.002, 1e-6);
    assert_close(value_of(packed, "scan_y_m", 0), 2 - 0.1 + 0.002 * 1, 1e-4);
}

VIEW_TEST(no_name_can_end_the_script_element)
{
    add_line(packed, FRAME("<!--<script>", "0", "4", "false", RICH));
    finish(packed);
    assert_null(memchr(packed->head.bytes, '<', packed->head.length));
    assert_string_equal(name_at(packed, 0), "<!--<script>");
    assert_string_equal(name_at(packed, value_of(packed, "object_id", 1)), "</script>");
}

VIEW_TEST(scenes_may_interleave_and_those_cut_short_are_marked)
{
    add_line(packed, FRAME("x", "7", "4", "false", RICH));
    add_line(packed, FRAME("y", "0", "4", "false", RICH));
    add_line(packed, FRAME("x", "8", "5", "false", RICH));
    add_line(packed, FRAME("y", "1", "5", "true", RICH));
    finish(packed);
    json_t *scenes = json_object_get(packed->json, "scenes");
    assert_int_equal(json_array_size(scenes), 2);
    assert_false(json_is_true(json_object_get(json_array_get(scenes, 0), "ended")));
    assert_true(json_is_true(json_object_get(json_array_get(scenes, 1), "ended")));
    static const double owner[] = {0, 1, 0, 1}, number[] = {0, 0, 1, 1}, time_s[] = {0, 0, 1, 1};
    for (size_t i = 0; i < 4; i++) {
        assert_true(value_of(packed, "frame_scene", i) == owner[i]);
        assert_true(value_of(packed, "frame_number", i) == number[i]);
        assert_true(value_of(packed, "frame_time_s", i) == time_s[i]);
    }
}

/* Two ghosts of one reflector, one in a target, one lost, and its direct echo, lost too. */
VIEW_TEST(echoes_keep_their_mirror_and_number)
{
    add_line(packed,
             FRAME("x", "0", "4", "false",
                   "\"targets\":[{\"sensor\":\"f\",\"range_m\":8,\"azimuth_rad\":0,"
                   "\"range_rate_mps\":0,\"amplitude_db\":1,\"cell_range_m\":8,"
                   "\"cell_azimuth_rad\":0,\"cell_range_rate_mps\":0,\"cell_amplitude\":4,"
                   "\"effects\":[\"merging\",\"list_limit\"],\"contributors\":["
                   "{\"object\":\"o\",\"reflector\":\"r\",\"path\":\"wall_object\","
                   "\"mirror\":\"w\",\"number\":3,\"range_m\":8,\"azimuth_rad\":0,"
                   "\"range_rate_mps\":0,\"ercs\":1,\"time_s\":4,\"weight\":1}]}],"
                   "\"lost\":[{\"sensor\":\"f\",\"stage\":\"sensor\",\"reason\":"
                   "\"below_threshold\",\"effect\":\"threshold\",\"echoes\":["
                   "{\"object\":\"o\",\"reflector\":\"r\",\"path\":\"direct\",\"shortfall_db\":1},"
                   "{\"object\":\"o\",\"reflector\":\"r\",\"path\":\"object_wall\","
                   "\"mirror\":\"v\",\"number\":2,\"shortfall_db\":2}]}]"));
    finish(packed);
    assert_string_equal(name_at(packed, value_of(packed, "contributor_mirror", 0) - 1), "w");
    assert_true(value_of(packed, "contributor_number", 0) == 3);
    assert_true(value_of(packed, "contributor_path", 0) == PATH_WALL_OBJECT);
    assert_true(value_of(packed, "item_mirror", 0) == 0 && value_of(packed, "item_number", 0) == 0);
    assert_string_equal(name_at(packed, value_of(packed, "item_mirror", 1) - 1), "v");
    assert_true(value_of(packed, "item_number", 1) == 2);
    assert_true(value_of(packed, "item_effect", 1) == EFFECT_THRESHOLD);
    assert_true(value_of(packed, "detail_number", 1) == 2);
    assert_true(value_of(packed, "detail_mirror", 0) == 0);
    json_t *sets = json_object_get(packed->json, "effect_sets");
    json_t *set = json_object_get(
        json_array_get(sets, (size_t)value_of(packed, "target_effects", 0)), "effects");
    assert_int_equal(json_array_size(set), 2);
    assert_string_equal(json_string_value(json_array_get(set, 1)), "list_limit");
}

VIEW_TEST(a_stages_own_reason_is_shown_with_the_stage)
{
    add_line(packed,
             FRAME("x", "0", "4", "false",
                   "\"targets\":[],\"lost\":["
                   "{\"sensor\":\"f\",\"stage\":\"mud\",\"reason\":\"covered\",\"echoes\":["
                   "{\"object\":\"</script>\",\"reflector\":\"r\",\"path\":\"direct\"}]}]"));
    finish(packed);
    json_t *own = json_array_get(json_object_get(packed->json, "reasons"), LOSS_OWN);
    assert_string_equal(json_string_value(json_object_get(own, "name")), "mud: covered");
    assert_true(json_is_true(json_object_get(own, "notable")));
    assert_close(value_of(packed, "item_reason", 0), LOSS_OWN, 0);
}

VIEW_TEST(every_reason_and_path_has_its_name)
{
    finish(packed);
    json_t *reasons = json_object_get(packed->json, "reasons");
    json_t *switched_off = json_array_get(reasons, LOSS_SWITCHED_OFF);
    assert_string_equal(json_string_value(json_object_get(switched_off, "name")), "switched_off");
    json_t *paths = json_object_get(packed->json, "paths");
    assert_string_equal(json_string_value(json_array_get(paths, PATH_FALSE_ALARM)), "false_alarm");
}

VIEW_TEST(the_same_losses_share_a_pattern)
{
    for (int i = 0; i < 1000; i++)
        add_line(packed, FRAME("x", "0", "4", "false", RICH));
    finish(packed);
    assert_int_equal(count_of(packed, "pattern_items"), 1);
    assert_int_equal(count_of(packed, "fate_pattern"), 1000);
    assert_int_equal(count_of(packed, "detail_shortfall_db"), 1000);
}

/* The sensor at (9, 22) looks north and 0.25 rad to the left of it: the other car's centre, at (10,
 * 30), is hypot(1, 8) m away, at -atan(1/8) - 0.25 rad. Then the car is seen 0.02 s before the
 * frame's time, 0.02 m less far ahead; then another place of it is. */
VIEW_TEST(a_loss_is_at_its_spot_or_has_its_place)
{
#define LOST_AT(range, azimuth)                                                                    \
    "\"lost\":[{\"sensor\":\"f\",\"stage\":\"ideal\",\"reason\":\"facing_away\",\"echoes\":["      \
    "{\"object\":\"</script>\",\"reflector\":\"c\",\"path\":\"direct\",\"range_m\":" range         \
    ",\"azimuth_rad\":" azimuth "}]}]"
    add_line(packed, FRAME("x", "0", "4", "false", LOST_AT("8.062", "-0.37435")));
    add_line(packed, AGED("0.02", "x", "1", "4.02", "false", LOST_AT("8.157", "-0.36796")));
    add_line(packed, FRAME("x", "2", "4.04", "false", LOST_AT("8.5", "-0.37435")));
    finish(packed);
    assert_int_equal(count_of(packed, "spot_x_m"), 1);
    assert_close(value_of(packed, "spot_x_m", 0), 0, 1e-3);
    assert_close(value_of(packed, "spot_y_m", 0), 0, 1e-3);
    assert_string_equal(name_at(packed, value_of(packed, "spot_reflector", 0)), "c");
    assert_int_equal(count_of(packed, "detail_range_m"), 1);
    assert_close(value_of(packed, "detail_range_m", 0), 8.5, 1e-6);
    assert_close(value_of(packed, "detail_azimuth_rad", 0), -0.37435, 1e-6);
}

VIEW_TEST(a_ghost_is_not_at_the_spot_of_its_reflector)
{
#define LOST_BY(path, range)                                                                       \
    "\"lost\":[{\"sensor\":\"f\",\"stage\":\"ideal\",\"reason\":\"out_of_view\",\"echoes\":["      \
    "{\"object\":\"</script>\",\"reflector\":\"c\",\"path\":\"" path "\",\"range_m\":" range       \
    ",\"azimuth_rad\":-0.37435}]}]"
    add_line(packed, FRAME("x", "0", "4", "false", LOST_BY("wall_object", "12")));
    add_line(packed, FRAME("x", "1", "4.04", "false", LOST_BY("direct", "8.062")));
    add_line(packed, FRAME("x", "2", "4.08", "false", LOST_BY("wall_object", "8.062")));
    finish(packed);
    assert_int_equal(count_of(packed, "spot_x_m"), 1);
    assert_close(value_of(packed, "spot_x_m", 0), 0, 1e-3);
    assert_int_equal(count_of(packed, "detail_range_m"), 2);
    assert_close(value_of(packed, "detail_range_m", 0), 12, 1e-6);
}

/* The sensor that the page has for this part of its record in the frame. */
static struct sensor_view sensor_told(struct packed *packed, const char *part)
{
    char line[2048];
    snprintf(line, sizeof line,
             "{\"version\":1,\"scene\":\"x\",\"frame\":0,\"time_s\":4,\"interval_s\":0.04,"
             "\"seed\":\"1\",\"ego\":\"e\",\"sections\":[],\"sensors\":{\"suite\":\"nowhere\","
             "\"digest\":\"0123456789abcdef\",\"list\":[{\"name\":\"front\",\"mount_x_m\":2,"
             "\"mount_y_m\":1,\"mount_yaw_rad\":0.25,\"field_of_view_rad\":3,\"range_max_m\":30,"
             "\"cell_range_m\":0.3,\"cell_range_rate_mps\":0.5,%s\"measured\":true}]}}",
             part);
    add_line(packed, line);
    return packed->data.sensors.items[packed->data.sensors.count - 1];
}

VIEW_TEST(the_resolution_is_the_frames_and_no_suites)
{
    struct sensor_view sensor =
        sensor_told(packed, "\"resolution_range_m\":3.175,\"resolution_range_rate_mps\":0.25,");
    assert_close(sensor.resolution_range_m, 3.175, 0);
    assert_close(sensor.resolution_range_rate_mps, 0.25, 0);
    assert_close(sensor_told(packed, "").resolution_range_m, 0, 0);
}

VIEW_TEST(a_column_is_as_wide_as_its_largest_number)
{
    add_line(packed, FRAME("x", "10", "4", "false", RICH));
    add_line(packed, FRAME("x", "265", "5", "false", RICH));
    add_line(packed, FRAME("x", "70010", "6", "false", RICH));
    finish(packed);
    assert_true(value_of(packed, "frame_number", 1) == 255);
    assert_true(value_of(packed, "frame_number", 2) == 70000);
}

VIEW_TEST(an_empty_stream_has_a_head)
{
    finish(packed);
    assert_int_equal(json_array_size(json_object_get(packed->json, "scenes")), 0);
    assert_int_equal(packed->columns.length, 0);
}

TEST(columns_of_the_quality_are_those_of_its_table)
{
    const struct view_columns columns = {0};
    struct view_column_place places[COLUMN_COUNT];
    view_columns_places(&columns, places);
    const char *prefix = "quality_";
    enum view_column column = COLUMN_QUALITY_SNR_DB;
    for (const struct field *field = quality_record.fields; field->name != NULL;
         field++, column++) {
        assert_int_equal(strncmp(places[column].name, prefix, strlen(prefix)), 0);
        assert_string_equal(places[column].name + strlen(prefix), field->name);
    }
    assert_int_equal(column, COLUMN_COUNT);
}

VIEW_TEST(lines_on_the_ground_are_relative_to_the_ego_and_have_the_word_of_their_kind)
{
    add_line(packed, FRAME("s", "0", "4", "true",
                           "\"roadside\":[{\"kind\":\"poles\",\"from_x_m\":12,\"from_y_m\":21,"
                           "\"to_x_m\":15,\"to_y_m\":26,\"width_m\":3}]"));
    finish(packed);
    json_t *scene = json_array_get(json_object_get(packed->json, "scenes"), 0);
    json_t *line = json_array_get(json_object_get(scene, "ground"), 0);
    assert_string_equal(json_string_value(json_object_get(line, "kind")), "poles");
    static const char *const members[] = {"from_x_m", "from_y_m", "to_x_m", "to_y_m", "width_m"};
    static const double expected[] = {2, 1, 5, 6, 3};
    for (size_t i = 0; i < 5; i++)
        assert_close(json_number_value(json_object_get(line, members[i])), expected[i], 1e-12);
}
