#include "check.h"

#include "base/units.h"
#include "score/track_score.h"

/* The ego at (100, 50) looks along y. Its radar sits 2 m ahead, turned 90 degrees to the left (to
 * -x), and sees 20 m far and 45 degrees to each side. */
static struct sensor_view view = {.name = "left",
                                  .mount_x_m = 2,
                                  .mount_yaw_rad = PI / 2,
                                  .field_of_view_rad = PI / 2,
                                  .range_max_m = 20};
static struct object objects[] = {
    {.id = "ego", .class = "car", .x_m = 100, .y_m = 50, .yaw_rad = PI / 2},
    {.id = "thing", .class = "truck", .vx_mps = 3},
};
static struct contributor echo = {.id.object = "thing"};
static struct target target = {.sensor = "left", .contributors = {&echo, 1, 1}};

static struct frame frame_with_thing_at(double x_m, double y_m)
{
    objects[1].x_m = x_m;
    objects[1].y_m = y_m;
    return (struct frame){.scene = "s",
                          .ego = "ego",
                          .objects = {objects, 2, 2},
                          .sensors.list = {&view, 1, 1},
                          .present = PART_OBJECTS | PART_SENSORS};
}

static bool in_view(double x_m, double y_m)
{
    struct frame frame = frame_with_thing_at(x_m, y_m);
    return track_score_counts(&frame, &objects[1], TRACK_TRUTH_IN_VIEW, NULL);
}

TEST(objects_in_range_and_view_count)
{
    assert_true(in_view(81, 52));
    assert_false(in_view(79, 52));
    assert_true(in_view(90, 61));
    assert_false(in_view(90, 63));
    assert_true(in_view(90, 43));
    assert_false(in_view(90, 41));
    assert_false(in_view(110, 52));
}

TEST(the_ego_never_counts)
{
    struct frame frame = frame_with_thing_at(90, 52);
    assert_false(track_score_counts(&frame, &objects[0], TRACK_TRUTH_ALL, NULL));
    assert_true(track_score_counts(&frame, &objects[1], TRACK_TRUTH_ALL, NULL));
}

TEST(objects_with_an_echo_in_a_target_are_detected)
{
    struct frame frame = frame_with_thing_at(500, 52);
    assert_false(track_score_counts(&frame, &objects[1], TRACK_TRUTH_DETECTED, NULL));
    frame.targets.items = &target;
    frame.targets.count = 1;
    assert_true(track_score_counts(&frame, &objects[1], TRACK_TRUTH_DETECTED, NULL));
}

TEST(classes_are_whole_words)
{
    struct frame frame = frame_with_thing_at(90, 52);
    static const struct {
        const char *classes;
        bool counts;
    } cases[] = {{"truck", true},   {"car,truck", true},  {"truck,car", true},
                 {"trucks", false}, {"tru", false},       {"car", false},
                 {",", false},      {"a,,truck,b", true}, {"car,trucks", false}};
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_int_equal(track_score_counts(&frame, &objects[1], TRACK_TRUTH_ALL, cases[i].classes),
                         cases[i].counts);
}

TEST(structures_count_where_they_are_asked_for)
{
    struct frame frame = frame_with_thing_at(90, 52);
    objects[1].class = "guardrail";
    assert_false(track_score_counts(&frame, &objects[1], TRACK_TRUTH_ALL, NULL));
    assert_true(track_score_counts(&frame, &objects[1], TRACK_TRUTH_ALL, "car,guardrail"));
    objects[1].class = "truck";
}

/* A wall of 300 m by 0.2 m, turned by atan(3/4), whose middle is 100 m from the track along it. */
TEST(a_track_on_an_object_that_is_not_expected_is_not_false)
{
    struct arena *arena = check_arena();
    struct object wall = {.id = "thing",
                          .class = "wall",
                          .x_m = 10,
                          .y_m = -8,
                          .yaw_rad = 0.64350110879328437,
                          .length_m = 300,
                          .width_m = 0.2};
    static const struct {
        double along_m, across_m;
        const char *classes;
        bool excused;
    } cases[] = {{100, 2.09, NULL, true},    {100, -2.09, NULL, true},  {100, 2.11, NULL, false},
                 {100, -2.11, NULL, false},  {151.99, 0, NULL, true},   {152.01, 0, NULL, false},
                 {151.2, 1.71, NULL, false}, {151.2, 1.69, NULL, true}, {100, 0, "wall", false}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct frame frame = frame_with_thing_at(0, 0);
        frame.objects.items = (struct object[]){objects[0], wall};
        frame.arena = arena;
        struct track track = {.id = "1",
                              .x_m = 10 + 0.8 * cases[i].along_m - 0.6 * cases[i].across_m,
                              .y_m = -8 + 0.6 * cases[i].along_m + 0.8 * cases[i].across_m};
        struct track_list list = {.tracks = {&track, 1, 1}};
        struct track_memory memory = {0};
        struct score_tally tally = {0};
        track_score_frame(&tally, &frame, &list, TRACK_TRUTH_ALL, cases[i].classes, &memory, arena);
        struct score score = score_of(&tally, 1, arena);
        assert_int_equal(score.false_count, !cases[i].excused);
        assert_int_equal(score.missed_count, cases[i].classes != NULL);
    }
}

TEST(a_track_on_the_ego_is_false)
{
    struct arena *arena = check_arena();
    struct frame frame = frame_with_thing_at(200, 200);
    frame.arena = arena;
    struct track track = {.id = "1", .x_m = 100, .y_m = 50};
    struct track_list list = {.tracks = {&track, 1, 1}};
    struct track_pairs pairs = track_score_pairs(&frame, &list, TRACK_TRUTH_IN_VIEW, NULL);
    assert_int_equal(pairs.list.count, 1);
    assert_false(pairs.list.items[0].excused);
}

TEST(a_frame_without_the_part_that_decides_is_refused)
{
    struct diag diag = {0};
    struct frame frame = {.present = PART_OBJECTS};
    assert_done(track_score_check, &frame, TRACK_TRUTH_ALL);
    assert_refused(DIAG_DATA, "sensors: missing; --objects=in_view needs it", track_score_check,
                   &frame, TRACK_TRUTH_IN_VIEW);
    frame.present |= PART_SENSORS;
    assert_done(track_score_check, &frame, TRACK_TRUTH_IN_VIEW);
    assert_int_equal(track_score_check(&frame, TRACK_TRUTH_DETECTED, &diag), -1);
    assert_int_equal(diag.code, DIAG_DATA);
}

TEST(a_switch_is_another_track_than_last_in_its_scene)
{
    struct arena *arena = check_arena();
    struct track_memory memory = {0};
    assert_null(track_score_replaced(&memory, "s", "a", "1", arena));
    assert_null(track_score_replaced(&memory, "s", "b", "2", arena));
    assert_null(track_score_replaced(&memory, "s", "a", "1", arena));
    assert_null(track_score_replaced(&memory, "t", "a", "2", arena));
    assert_non_null(track_score_replaced(&memory, "s", "a", "2", arena));
    assert_non_null(track_score_replaced(&memory, "s", "b", "1", arena));
    assert_non_null(track_score_replaced(&memory, "s", "a", "1", arena));
    track_score_forget(&memory, "s");
    assert_null(track_score_replaced(&memory, "s", "a", "3", arena));
    assert_non_null(track_score_replaced(&memory, "t", "a", "3", arena));
}

TEST(a_track_is_paired_with_an_object_nearer_than_five_metres)
{
    struct arena *arena = check_arena();
    struct frame frame = frame_with_thing_at(90, 52);
    frame.arena = arena;
    struct track track = {.id = "1", .x_m = 91.5, .y_m = 50, .vx_mps = 3, .vy_mps = 2};
    struct track_list list = {.tracks = {&track, 1, 1}};
    struct track_memory memory = {0};
    struct score_tally tally = {0};
    track_score_frame(&tally, &frame, &list, TRACK_TRUTH_IN_VIEW, NULL, &memory, arena);
    struct score score = score_of(&tally, 1, arena);
    assert_close(score.gospa, 2.5, 0);
    assert_close(score.differences[SCORE_POSITION].max, 2.5, 0);
    assert_close(score.differences[SCORE_VELOCITY].max, 2, 0);
    track.x_m = 93;
    track.y_m = 48;
    track_score_frame(&tally, &frame, &list, TRACK_TRUTH_IN_VIEW, NULL, &memory, arena);
    score = score_of(&tally, 1, arena);
    assert_int_equal(score.pair_count, 1);
    assert_int_equal(score.missed_count, 1);
    assert_int_equal(score.false_count, 1);
}

TEST(tracks_are_sorted_by_id)
{
    struct track tracks[] = {{.id = "b"}, {.id = "a"}, {.id = "c"}};
    struct track_list list = {.tracks = {tracks, 3, 3}};
    assert_done(track_score_order, &list, check_arena());
    assert_string_equal(tracks[0].id, "a");
    tracks[2].id = "b";
    assert_refused(DIAG_DATA, "tracks: the id \"b\" stands twice", track_score_order, &list,
                   check_arena());
}

/* A metre to each side with variances of 4 and 1 and a covariance of 1: (1 1) over [4 1; 1 1] is 1,
 * and without the covariance 1.25. */
TEST(a_squared_distance_is_over_the_covariance)
{
    struct arena *arena = check_arena();
    struct frame frame = frame_with_thing_at(90, 52);
    frame.arena = arena;
    struct track track = {.id = "1",
                          .x_m = 91,
                          .y_m = 53,
                          .variance_x_m2 = 4,
                          .covariance_xy_m2 = 1,
                          .variance_y_m2 = 1,
                          .present = TRACK_COVARIANCE};
    struct track_list list = {.tracks = {&track, 1, 1}};
    struct track_memory memory = {0};
    struct score_tally tally = {0};
    track_score_frame(&tally, &frame, &list, TRACK_TRUTH_ALL, NULL, &memory, arena);
    assert_close(score_of(&tally, 1, arena).differences[SCORE_NEES].max, 1, 1e-12);
    track.covariance_xy_m2 = 0;
    track_score_frame(&tally, &frame, &list, TRACK_TRUTH_ALL, NULL, &memory, arena);
    assert_close(score_of(&tally, 1, arena).differences[SCORE_NEES].mean, 1.125, 1e-12);
    track.present = 0;
    track_score_frame(&tally, &frame, &list, TRACK_TRUTH_ALL, NULL, &memory, arena);
    assert_close(score_of(&tally, 1, arena).differences[SCORE_NEES].mean, 1.125, 1e-12);
    assert_close(score_of(&tally, 1, arena).nees_low, 0, 0);
}

/* Quantiles of chi squared by table: 3.247 and 20.483 with 10, 74.222 and 129.561 with 100 degrees
 * of freedom. */
TEST(the_mean_of_the_nees_has_the_interval_of_chi_squared)
{
    struct arena *arena = check_arena();
    struct score_tally tally = {0};
    for (int i = 0; i < 50; i++) {
        *list_add(&tally.values[SCORE_ERROR][SCORE_NEES].list, arena) = 2;
        struct score score = score_of(&tally, 1, arena);
        assert_true((score.nees_low > 0) == (i >= 4));
        if (i == 4) {
            assert_near(score.nees_low, 3.247 / 5, 0.01);
            assert_near(score.nees_high, 20.483 / 5, 0.01);
        }
    }
    struct score score = score_of(&tally, 1, arena);
    assert_near(score.nees_low, 74.222 / 50, 0.001);
    assert_near(score.nees_high, 129.561 / 50, 0.001);
}

TEST(a_covariance_is_positive_definite)
{
    static const struct {
        double x, xy, y;
        int status;
    } cases[] = {{1, 0, 1, 0},  {4, 1.9, 1, 0}, {1e-9, 0, 1e9, 0}, {4, 2, 1, -1}, {4, -2, 1, -1},
                 {0, 0, 1, -1}, {1, 0, 0, -1},  {0, 0, 0, -1},     {4, 3, 1, -1}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct diag diag = {0};
        struct track track = {.id = "1",
                              .variance_x_m2 = cases[i].x,
                              .covariance_xy_m2 = cases[i].xy,
                              .variance_y_m2 = cases[i].y,
                              .present = TRACK_COVARIANCE};
        struct track_list list = {.tracks = {&track, 1, 1}};
        assert_int_equal(track_score_order(&list, check_arena(), &diag), cases[i].status);
    }
}
