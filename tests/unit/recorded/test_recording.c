#define SCRATCH_FILE "tracks.csv"
#include "scratch.h"

#include "base/units.h"
#include "recorded/resampling.h"
#include "recorded_file.h"

#define HEADER "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width\n"
#define WALKERS "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy\n"
#define SUMO                                                                                       \
    "timestep_time;vehicle_id;vehicle_x;vehicle_y;vehicle_angle;vehicle_type;vehicle_speed\n"

enum { MOST_FRAMES = 4096 };

/* All frames of a recording. Their names and objects lie in the scratch arena. */
struct played {
    struct frame frames[MOST_FRAMES];
    size_t count;
    struct diag diag;
};

static void keep(struct played *played, const struct frame *frame, struct arena *arena)
{
    assert_true(played->count < MOST_FRAMES);
    struct frame *kept = &played->frames[played->count++];
    *kept = *frame;
    kept->scene = arena_text(arena, frame->scene, strlen(frame->scene));
    kept->ego = arena_text(arena, frame->ego, strlen(frame->ego));
    kept->objects.items = arena_get(arena, frame->objects.count * sizeof(struct object));
    for (size_t i = 0; i < frame->objects.count; i++) {
        struct object *object = &kept->objects.items[i];
        *object = frame->objects.items[i];
        object->id = arena_text(arena, object->id, strlen(object->id));
        object->class = arena_text(arena, object->class, strlen(object->class));
    }
}

static struct recording_options options_for(const char *ego)
{
    struct recording_options options;
    field_clear(&recording_options_record, &options);
    options.ego = ego;
    return options;
}

/* Plays a text; the message of a failure is in the answer's diag. */
static struct played *play(struct scratch *scratch, const char *text,
                           const struct recording_options *options)
{
    scratch_write(scratch->path, text);
    struct played *played = arena_get(&scratch->arena, sizeof *played);
    struct recording table = {.options = *options};
    struct frame frame = {.arena = check_arena()};
    int more = recorded_file_try(&table, scratch->path, &scratch->arena, &played->diag);
    for (more = more == 0 ? 1 : -1; more > 0;) {
        frame_clear(&frame);
        more = recording_next(&table, &frame, &played->diag);
        if (more > 0)
            keep(played, &frame, &scratch->arena);
    }
    recording_close(&table);
    return played;
}

static struct played *play_as(struct scratch *scratch, const char *ego, const char *text)
{
    struct recording_options options = options_for(ego);
    return play(scratch, text, &options);
}

static struct played *play_all(struct scratch *scratch, const char *text)
{
    struct played *played = play_as(scratch, "all", text);
    if (played->diag.code != DIAG_OK)
        fail_msg("%s", played->diag.text);
    return played;
}

/* An object at a time, whoever the ego. */
static const struct object *object_at(const struct played *played, double time_s, const char *id)
{
    for (size_t i = 0; i < played->count; i++)
        for (size_t j = 0; j < played->frames[i].objects.count; j++)
            if (played->frames[i].time_s == time_s &&
                strcmp(played->frames[i].objects.items[j].id, id) == 0)
                return &played->frames[i].objects.items[j];
    fail_msg("no %s at %g s", id, time_s);
    return NULL;
}

FIXTURE(make_scratch, remove_scratch);

TEST_OF(scratch, a_row_becomes_an_object)
{
    struct played *played = play_all(scratch, HEADER "7,1,100,truck,1.5,-2.5,3,4,0.75,8.5,2.25\n");
    const struct object *only = object_at(played, 0.1, "7");
    assert_string_equal(only->class, "truck");
    assert_close(only->x_m, 1.5, 0);
    assert_close(only->y_m, -2.5, 0);
    assert_close(only->vx_mps, 3, 0);
    assert_close(only->vy_mps, 4, 0);
    assert_close(only->yaw_rad, 0.75, 0);
    assert_close(only->yaw_rate_radps, 0, 0);
    assert_close(only->length_m, 8.5, 0);
    assert_close(only->width_m, 2.25, 0);
    assert_close(only->travelled_m, 0, 0);
    assert_int_equal(played->count, 1);
    assert_close(played->frames[0].interval_s, 1, 0);
    assert_true(played->frames[0].last);
    assert_string_equal(played->frames[0].scene, "tracks/7");
}

TEST_OF(scratch, frames_ascend_in_time_and_their_objects_in_id)
{
    struct played *played = play_as(scratch, "9",
                                    HEADER "9,3,350,car,0,0,0,0,0,4,2\n"
                                           "10,3,350,car,0,0,0,0,0,4,2\n"
                                           "9,1,100,car,0,0,0,0,0,4,2\n"
                                           "b,2,200,car,0,0,0,0,0,4,2\n"
                                           "2,3,350,car,0,0,0,0,0,4,2\n"
                                           "9,2,200,car,0,0,0,0,0,4,2\n");
    static const struct {
        double time_s, interval_s;
        const char *ids[4];
    } steps[] = {
        {0.1, 0.1, {"9", NULL}},
        {0.2, 0.1, {"9", "b", NULL}},
        {0.35, 0.15, {"10", "2", "9", NULL}},
    };
    assert_int_equal(played->count, 3);
    for (size_t i = 0; i < 3; i++) {
        const struct frame *frame = &played->frames[i];
        assert_close(frame->time_s, steps[i].time_s, 0);
        assert_close(frame->interval_s, steps[i].interval_s, 0);
        assert_int_equal(frame->frame, i);
        assert_int_equal(frame->last, i == 2);
        size_t count = 0;
        for (; steps[i].ids[count] != NULL; count++)
            assert_string_equal(frame->objects.items[count].id, steps[i].ids[count]);
        assert_int_equal(frame->objects.count, count);
    }
}

TEST_OF(scratch, stamps_are_in_the_unit_of_their_column)
{
    static const char *const texts[] = {
        "track_id,timestamp_us,agent_type,x,y,vx,vy\n1,1700000000050000,car,0,0,0,0\n",
        "track_id,timestamp_ms,agent_type,x,y,vx,vy\n1,1700000000050,car,0,0,0,0\n",
        "track_id,timestamp_s,agent_type,x,y,vx,vy\n1,1700000000.05,car,0,0,0,0\n",
    };
    for (size_t i = 0; i < 3; i++)
        assert_close(play_all(scratch, texts[i])->frames[0].time_s, 1700000000.05, 3e-7);
    assert_close(play_all(scratch, texts[1])->frames[0].time_s, 1700000000.05, 0);
}

TEST_OF(scratch, without_a_box_the_yaw_is_that_of_the_velocity_and_held_at_rest)
{
    struct played *played = play_as(scratch, "P1",
                                    HEADER "P1,1,100,pedestrian/bicycle,0,0,-1,1,,,\n"
                                           "P2,1,100,pedestrian/bicycle,0,0,0,0,,,\n"
                                           "P1,1,200,pedestrian/bicycle,0,0,-0.0,0,,,\n");
    assert_int_equal(played->count, 2);
    assert_close(object_at(played, 0.1, "P1")->yaw_rad, 3 * PI / 4, 1e-15);
    assert_close(object_at(played, 0.2, "P1")->yaw_rad, 3 * PI / 4, 1e-15);
    assert_close(object_at(played, 0.1, "P2")->yaw_rad, 0, 0);
    assert_close(object_at(played, 0.1, "P1")->length_m, 0, 0);
    assert_string_equal(object_at(played, 0.1, "P1")->class, "pedestrian");
}

/* The parabola through yaws 0, 0.02 and 0.14 at 0, 0.1 and 0.3 s has the slope 1/3 rad/s in the
 * middle: (0.2 * 0.2 + 0.6 * 0.1) / 0.3. */
TEST_OF(scratch, yaw_rates_are_slopes_of_parabolas_and_wrap)
{
    struct played *played = play_all(scratch, HEADER "a,1,0,car,0,0,0,0,3.13,4,2\n"
                                                     "a,2,100,car,0,0,0,0,3.15,4,2\n"
                                                     "a,4,300,car,0,0,0,0,-3.0131853071795863,4,2\n"
                                                     "b,2,300,car,0,0,0,0,1,4,2\n");
    assert_close(object_at(played, 0, "a")->yaw_rate_radps, 0.02 / 0.1, 1e-13);
    assert_close(object_at(played, 0.1, "a")->yaw_rate_radps, 1. / 3, 1e-13);
    assert_close(object_at(played, 0.3, "a")->yaw_rate_radps, 0.12 / 0.2, 1e-13);
    assert_close(object_at(played, 0.3, "b")->yaw_rate_radps, 0, 0);
}

/* SUMO gives the front: a car of 5 m that drives north at (0, 10) has its centre at (0, 7.5). With
 * constant acceleration the centred differences are exact, at unequal steps too. */
TEST_OF(scratch, places_become_centres_and_velocities)
{
    struct played *played = play_all(scratch, SUMO "0;v;0;10;0;passenger;9\n"
                                                   "1;v;0;20.5;0;passenger;9\n"
                                                   "3;v;0;44.5;0;passenger;9\n"
                                                   "3;once;100;0;270;bicycle;7\n");
    const struct object *middle = object_at(played, 1, "v");
    assert_close(object_at(played, 0, "v")->y_m, 7.5, 1e-12);
    assert_close(middle->y_m, 18, 1e-12);
    assert_close(middle->vy_mps, 11, 1e-12);
    assert_close(middle->vx_mps, 0, 1e-12);
    assert_close(middle->yaw_rad, PI / 2, 1e-15);
    assert_close(object_at(played, 0, "v")->vy_mps, 10.5, 1e-12);
    assert_close(object_at(played, 3, "v")->vy_mps, 12, 1e-12);
    assert_close(object_at(played, 3, "once")->vx_mps, -7, 1e-12);
    assert_close(object_at(played, 3, "once")->x_m, 100.8, 1e-12);
    assert_close(object_at(played, 3, "once")->width_m, 0.65, 0);
}

TEST_OF(scratch, the_distance_travelled_adds_up_from_place_to_place)
{
    struct played *played = play_as(scratch, "a",
                                    HEADER "a,3,300,car,503,5000000,0,-40,0,4,2\n"
                                           "a,2,200,car,503,5000004,30,0,0,4,2\n"
                                           "a,1,100,car,500,5000000,30,80,0,4,2\n");
    assert_close(object_at(played, 0.1, "a")->travelled_m, 0, 0);
    assert_close(object_at(played, 0.2, "a")->travelled_m, 5, 0);
    assert_close(object_at(played, 0.3, "a")->travelled_m, 9, 0);
    assert_close(object_at(played, 0.2, "a")->y_m, 4, 0);
    assert_close(played->frames[1].origin_y_m, 5000000, 0);
}

/* One long step, then many too short to change a plain sum. */
TEST_OF(scratch, many_short_steps_are_not_lost)
{
    enum { STEPS = 4000 };
    char *text = malloc(STEPS * 64);
    assert_non_null(text);
    size_t used =
        (size_t)sprintf(text, WALKERS "a,0,0,car,0,1e8,0,-222\na,0,900000000,car,0,0,0,0\n");
    for (int i = 1; i <= STEPS; i++)
        used += (size_t)sprintf(text + used, "a,0,%d,car,%de-9,0,0,0\n", 900000000 + i, i);
    struct played *played = play_as(scratch, "a", text);
    free(text);
    const struct object *last = &played->frames[played->count - 1].objects.items[0];
    assert_close(last->travelled_m - 1e8, STEPS * 1e-9, 2e-8);
}

/* Who is missing from a step, or jumps, comes again as another: another scene, no differences. */
TEST_OF(scratch, a_visit_ends_where_its_road_user_is_missing_or_jumps)
{
    struct played *played = play_as(scratch, "a,b",
                                    WALKERS "a,0,0,car,0,0,1,0\nb,0,0,car,0,0,0,0\n"
                                            "b,0,100,car,0,0,0,0\n"
                                            "a,0,200,car,5,0,1,0\nb,0,200,car,900,0,0,0\n"
                                            "a,0,300,car,5,1,1,0\nb,0,300,car,900,0,0,0\n");
    static const struct {
        const char *scene;
        int frame;
        bool last;
    } expected[] = {{"tracks/a", 0, true},    {"tracks/b", 0, false},   {"tracks/b", 1, true},
                    {"tracks/a/2", 0, false}, {"tracks/b/2", 0, false}, {"tracks/a/2", 1, true},
                    {"tracks/b/2", 1, true}};
    assert_int_equal(played->count, 7);
    for (size_t i = 0; i < 7; i++) {
        assert_string_equal(played->frames[i].scene, expected[i].scene);
        assert_int_equal(played->frames[i].frame, expected[i].frame);
        assert_int_equal(played->frames[i].last, expected[i].last);
    }
    assert_close(object_at(played, 0.2, "a")->travelled_m, 0, 0);
    assert_close(object_at(played, 0.3, "a")->travelled_m, 1, 0);
}

TEST_OF(scratch, a_recording_begins_and_ends_at_given_times)
{
    struct recording_options options = options_for("a");
    options.from_s = 0.15;
    options.to_s = 0.4;
    struct played *played = play(scratch,
                                 WALKERS "a,0,100,car,0,0,1,0\na,0,200,car,1,0,1,0\n"
                                         "a,0,300,car,2,0,1,0\na,0,400,car,3,0,1,0\n"
                                         "a,0,500,car,4,0,1,0\n",
                                 &options);
    assert_int_equal(played->count, 3);
    assert_close(played->frames[0].time_s, 0.2, 0);
    assert_int_equal(played->frames[0].frame, 0);
    assert_close(played->frames[2].time_s, 0.4, 0);
    assert_true(played->frames[2].last && !played->frames[1].last);
    assert_close(played->frames[0].objects.items[0].travelled_m, 1, 0);
}

/* Braking from 20 m/s at 1 m/s^2 and 2 s steps: at 1 s the place is at 19.5 m, and so is the
 * distance travelled, where the mean of the steps would be 19. */
TEST_OF(scratch, the_distance_travelled_is_resampled_like_the_place)
{
    struct recording_options options = options_for("a");
    options.rate_hz = 4;
    struct played *played = play(scratch,
                                 WALKERS "a,0,0,car,0,0,20,0\na,0,2000,car,38,0,18,0\n"
                                         "a,0,4000,car,72,0,16,0\n",
                                 &options);
    assert_int_equal(played->count, 17);
    for (size_t i = 0; i < 17; i++) {
        double time_s = played->frames[i].time_s;
        const struct object *only = &played->frames[i].objects.items[0];
        assert_close(only->travelled_m, 20 * time_s - time_s * time_s / 2, 1e-12);
        assert_close(only->travelled_m, only->x_m, 1e-12);
    }
}

/* A car stops within a second: at 12 m both at 2 s and 3 s, though the slope at 2 s is 1 m/s. A
 * plain cubic is at 12.15 m at 2.33 s and rolls back at 0.33 m/s. */
TEST_OF(scratch, resampling_rolls_nobody_back)
{
    struct recording_options options = options_for("v");
    options.rate_hz = 20;
    struct played *played = play(scratch,
                                 SUMO "0;v;0;0;90;passenger;10\n1;v;10;0;90;passenger;10\n"
                                      "2;v;12;0;90;passenger;2\n3;v;12;0;90;passenger;0\n"
                                      "4;v;12;0;90;passenger;0\n5;v;13;0;90;passenger;1\n",
                                 &options);
    assert_int_equal(played->count, 101);
    for (size_t i = 1; i < 101; i++) {
        const struct object *only = &played->frames[i].objects.items[0], *last = only;
        last = &played->frames[i - 1].objects.items[0];
        assert_true(only->vx_mps >= 0 && only->x_m >= last->x_m - 1e-12);
        assert_true(only->travelled_m >= last->travelled_m - 1e-12);
    }
    assert_close(object_at(played, 2, "v")->vx_mps, 1, 1e-12);
}

/* A car changes lanes in a queue: it goes ahead by 0.17 m in 1 s, from 1.6 m/s to 0.4 m/s, and
 * sideways by 0.83 m. With these slopes it would roll back at 0.34 m/s. From rest and at rest in
 * place, it stays. */
TEST(resampling_rolls_nobody_back_beside_a_lane_change)
{
    const struct object from = {.vx_mps = 1.6, .vy_mps = -1.2};
    struct object to = {.x_m = 0.17, .y_m = -0.83, .vx_mps = 0.4, .vy_mps = -0.4};
    for (int i = 0; i <= 20; i++) {
        struct object between = resampling_between(&from, &to, 1, i / 20.0);
        assert_true(between.vx_mps >= -1e-12 && between.vy_mps <= 0);
    }
    const struct object rest = {.vy_mps = -0.4};
    to.x_m = 0;
    for (int i = 0; i <= 20; i++)
        assert_close(resampling_between(&rest, &to, 1, i / 20.0).x_m, 0, 1e-12);
}

/* A body that reverses does so between the steps, too: from 1 m/s to -1 m/s within 1 s. */
TEST_OF(scratch, resampling_lets_who_reverses_reverse)
{
    struct recording_options options = options_for("a");
    options.rate_hz = 2;
    struct played *played =
        play(scratch, WALKERS "a,0,0,car,0,0,1,0\na,0,1000,car,0,0,-1,0\n", &options);
    assert_close(played->frames[1].objects.items[0].x_m, 0.25, 1e-12);
}

/* A parked van is set 6.4 m aside: no frame between the steps has it, and no velocity or distance
 * is that of the gap. */
TEST_OF(scratch, nothing_crosses_a_denied_way)
{
    struct recording_options options = options_for("all");
    options.rate_hz = 10;
    struct played *played = play(scratch,
                                 SUMO "0;e;0;0;90;passenger;9\n0;v;60;0;90;passenger;0\n"
                                      "1;e;9;0;90;passenger;9\n1;v;60;0;90;passenger;0\n"
                                      "2;e;18;0;90;passenger;9\n2;v;60;6.4;90;passenger;0\n"
                                      "3;e;27;0;90;passenger;9\n3;v;60;6.4;90;passenger;0\n",
                                 &options);
    size_t there = 0;
    for (size_t i = 0; i < played->count; i++) {
        const struct frame *frame = &played->frames[i];
        const struct object *van = frame_object(frame, "v");
        if (strcmp(frame->ego, "e") != 0 || van == NULL)
            continue;
        there++;
        assert_close(van->vy_mps, 0, 0);
        assert_close(van->travelled_m, 0, 0);
        assert_close(van->y_m, frame->time_s < 1.5 ? 0 : 6.4, 1e-12);
    }
    assert_int_equal(there, 11 + 11);
    const char *scenes[] = {"tracks/v", "tracks/v/2"};
    for (size_t i = 0, k = 0; i < played->count; i++)
        if (strcmp(played->frames[i].ego, "v") == 0 && played->frames[i].last)
            assert_string_equal(played->frames[i].scene, scenes[k++]);
    assert_non_null(strstr(played->diag.text, "though it stands by its speed (1 times)"));
}

/* The neighbours within a radius are those that a plain search finds, at all scales. */
TEST_OF(scratch, neighbours_are_those_within_the_radius)
{
    static const double radii_m[] = {0, 0.5, 3, 20, 1e3};
    enum { CARS = 60 };
    struct text *text = check_text();
    text_add_word(text, WALKERS);
    uint64_t random = 1;
    struct vec2 places[CARS];
    for (int i = 0; i < CARS; i++) {
        random = random * UINT64_C(6364136223846793005) + 1442695040888963407u;
        places[i] = (struct vec2){(double)(random >> 40 & 255) / 4 - 32,
                                  (double)(random >> 52 & 255) / 4 - 32};
        text_format(text, "%02d,0,0,car,%.17g,%.17g,0,0\n", i, places[i].x, places[i].y);
    }
    text_add(text, "", 1);
    for (size_t r = 0; r < COUNT(radii_m); r++) {
        struct recording_options options = options_for("all");
        options.radius_m = radii_m[r];
        struct played *played = play(scratch, text->bytes, &options);
        assert_int_equal(played->count, CARS);
        for (size_t ego = 0; ego < CARS; ego++) {
            size_t found = 0;
            for (size_t i = 0; i < CARS; i++)
                if (hypot(places[i].x - places[ego].x, places[i].y - places[ego].y) <= radii_m[r])
                    assert_int_equal(atoi(played->frames[ego].objects.items[found++].id), i);
            assert_int_equal(played->frames[ego].objects.count, found);
        }
    }
}

TEST_OF(scratch, damaged_recordings_are_refused)
{
    static const struct {
        const char *text, *message;
    } cases[] = {
        {HEADER "1,1,100,car,0,0,0,0,0,4,2\n\n2,1,100,car,0,0,0,0,0,4,2\n"
                "1,2,100,car,1,0,0,0,0,4,2\n",
         "row 5: track_id 1 at 0.1 s is in row 2 already"},
        {HEADER "1,1,100.5,car,0,0,0,0,0,4,2\n",
         "row 2, column \"timestamp_ms\": 100.5 is not a whole number"},
        {HEADER "1,1,1e16,car,0,0,0,0,0,4,2\n",
         "row 2, column \"timestamp_ms\": 1e16 is outside [-9e+12, 9e+12]"},
        {HEADER "1,1,,car,0,0,0,0,0,4,2\n", "row 2, column \"timestamp_ms\": \"\" is not a number"},
        {HEADER "1,1,100,car,0,2e9,0,0,0,4,2\n",
         "row 2, column \"y\": 2e9 is outside [-1e+09, 1e+09]"},
        {HEADER "1,1,100,car,nan,0,0,0,0,4,2\n", "row 2, column \"x\": \"nan\" is not a number"},
        {HEADER "1,1,100,car,0,0,0,0,0,-4,2\n",
         "row 2, column \"length\": -4 is outside [0, 1e+06]"},
        {HEADER "1,1,100,car,0,,0,0,0,4,2\n", "row 2, column \"y\": \"\" is not a number"},
        {HEADER "1,1,100,\"a\nb\",0,0,0,0,0,4,2\n",
         "row 2, column \"agent_type\": \"a\nb\"; expected 1 to 1024 printable ASCII characters"},
        {HEADER ",1,100,car,0,0,0,0,0,4,2\n",
         "row 2, column \"track_id\": \"\"; expected 1 to 1024 printable ASCII characters"},
        {"track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi,length,width\n",
         "column \"psi_rad\" is missing for a table of INTERACTION, the nearest layout; the header "
         "is: "
         "track_id, frame_id, timestamp_ms, agent_type, x, y, vx, vy, psi, length, width"},
        {"track_id,agent_type,x,y,vx,vy\n",
         "column \"timestamp_ms\" or \"timestamp_us\" or \"timestamp_s\" is missing for a table of "
         "INTERACTION, the nearest layout; the header is: track_id, agent_type, x, y, vx, vy"},
        {"id,x,y,width,height,class\n",
         "columns \"frame\", \"xVelocity\", \"yVelocity\" are missing for a table of highD, the "
         "nearest layout; the header is: id, x, y, width, height, class"},
        {"foo,bar\n", "no column is one that a layout needs; the header is: foo, bar"},
        {SUMO "1;v;0;0;0;passenger;0\n0.5;v;0;0;0;passenger;0\n",
         "row 3: 0.5 s after a step of 1 s; expected a later time, by at most 1e6 s"},
        {SUMO "1;v;0;0;north;passenger;0\n",
         "row 2, column \"vehicle_angle\": \"north\" is not a number"},
        {"timestep_time;vehicle_id;vehicle_x;vehicle_angle\n",
         "column \"vehicle_y\" is missing for a table of SUMO, the nearest layout; the header is: "
         "timestep_time, vehicle_id, vehicle_x, vehicle_angle"},
        {HEADER, "--ego: \"1\" is no track_id"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct played *played = play_as(scratch, "1", cases[i].text);
        const char *text = strstr(played->diag.text, "tracks.csv: ");
        assert_non_null(text);
        assert_string_equal(text + strlen("tracks.csv: "), cases[i].message);
        assert_int_equal(played->diag.code, DIAG_DATA);
    }
}

TEST_OF(scratch, a_recorded_motorway_is_read)
{
    const char *data = getenv("GLINT_TEST_DATA");
    if (data == NULL) {
        skip_because("GLINT_TEST_DATA is not set");
        return;
    }
    char path[4096];
    snprintf(path, sizeof path, "%s/csv/us101_interaction.csv", data);
    struct recording table;
    struct frame frame = {.arena = check_arena()};
    recorded_file_open(&table, path, "all", &scratch->arena);
    size_t states = 0;
    for (; recorded_file_next(&table, &frame); states++) {
        const struct object *ego = frame_object(&frame, frame.ego);
        struct vec2 heading = vec2_heading(ego->yaw_rad);
        assert_close(frame.interval_s, 0.1, 1e-15);
        assert_close(ego->vx_mps * heading.x + ego->vy_mps * heading.y,
                     hypot(ego->vx_mps, ego->vy_mps), 1e-8);
        assert_true(fabs(ego->yaw_rate_radps) < 1 && ego->length_m > 3);
    }
    assert_int_equal(states, 384);
    assert_int_equal(table.egos.count, 12);
    recording_close(&table);
}
