#define SCRATCH_FILE "tracks.csv"
#include "scratch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/units.h"
#include "text/field.h"
#include "traffic/trajectory.h"

#define HEADER "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width\n"
#define WALKERS "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy\n"

static int read_text(struct scratch *scratch, const char *text, struct trajectories *trajectories,
                     struct diag *diag)
{
    FILE *file = fopen(scratch->path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    *diag = (struct diag){0};
    return trajectory_read(scratch->path, &scratch->arena, trajectories, diag);
}

static struct trajectories trajectories_of(struct scratch *scratch, const char *text)
{
    struct trajectories trajectories;
    struct diag diag;
    if (read_text(scratch, text, &trajectories, &diag) != 0)
        fail_msg("%s", diag.text);
    return trajectories;
}

static const struct recorded_state *state_of(const struct trajectories *trajectories,
                                             int64_t time_ms, const char *id)
{
    for (size_t i = 0; i < trajectories->step_count; i++)
        for (size_t j = 0; j < trajectories->steps[i].count; j++) {
            const struct recorded_state *state = &trajectories->steps[i].states[j];
            if (state->time_ms == time_ms && strcmp(state->id, id) == 0)
                return state;
        }
    fail_msg("no state of %s at %lld ms", id, (long long)time_ms);
    return NULL;
}

static void a_row_becomes_a_state(void **state)
{
    struct trajectories read =
        trajectories_of(*state, HEADER "7,1,100,truck,1.5,-2.5,3,4,0.75,8.5,2.25\n");
    const struct recorded_state *only = state_of(&read, 100, "7");
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
    assert_int_equal(only->row, 2);
    assert_int_equal(read.step_count, 1);
    assert_int_equal(read.steps[0].interval_ms, 0);
}

static void columns_may_stand_in_any_order_among_others(void **state)
{
    struct trajectories read = trajectories_of(
        *state, "width,note,y,x,vy,vx,length,psi_rad,agent_type,timestamp_ms,track_id\n"
                "2,hello,-1,1,20,10,5,0.5,bus,0,a\n");
    const struct recorded_state *only = state_of(&read, 0, "a");
    assert_close(only->x_m, 1, 0);
    assert_close(only->y_m, -1, 0);
    assert_close(only->vx_mps, 10, 0);
    assert_close(only->vy_mps, 20, 0);
    assert_close(only->length_m, 5, 0);
    assert_close(only->width_m, 2, 0);
}

static void steps_ascend_in_time_and_their_states_in_id(void **state)
{
    struct trajectories read = trajectories_of(*state, HEADER "9,3,350,car,0,0,0,0,0,4,2\n"
                                                              "10,3,350,car,0,0,0,0,0,4,2\n"
                                                              "9,1,100,car,0,0,0,0,0,4,2\n"
                                                              "b,2,200,car,0,0,0,0,0,4,2\n"
                                                              "2,3,350,car,0,0,0,0,0,4,2\n"
                                                              "9,2,200,car,0,0,0,0,0,4,2\n");
    static const struct {
        int64_t time_ms, interval_ms;
        const char *ids[4];
    } steps[] = {
        {100, 100, {"9", NULL}},
        {200, 100, {"9", "b", NULL}},
        {350, 150, {"10", "2", "9", NULL}},
    };
    assert_int_equal(read.step_count, 3);
    for (size_t i = 0; i < 3; i++) {
        const struct recorded_step *step = &read.steps[i];
        assert_int_equal(step->time_ms, steps[i].time_ms);
        assert_int_equal(step->interval_ms, steps[i].interval_ms);
        size_t count = 0;
        for (; steps[i].ids[count] != NULL; count++)
            assert_string_equal(step->states[count].id, steps[i].ids[count]);
        assert_int_equal(step->count, count);
    }
}

static void tracks_are_known_by_their_ids(void **state)
{
    struct trajectories read = trajectories_of(*state, HEADER "9,1,100,car,0,0,0,0,0,4,2\n"
                                                              "10,1,100,car,0,0,0,0,0,4,2\n"
                                                              "P1,1,200,car,0,0,0,0,0,4,2\n"
                                                              "9,1,200,car,0,0,0,0,0,4,2\n");
    static const char *const ids[] = {"10", "9", "P1"};
    assert_int_equal(read.id_count, 3);
    for (size_t i = 0; i < 3; i++) {
        assert_string_equal(read.ids[i], ids[i]);
        assert_true(trajectory_has(&read, ids[i]));
    }
    static const char *const strangers[] = {"1", "", "P", "P11", "p1", "z"};
    for (size_t i = 0; i < sizeof strangers / sizeof strangers[0]; i++)
        assert_false(trajectory_has(&read, strangers[i]));
}

static void a_table_without_rows_has_no_steps(void **state)
{
    struct trajectories read = trajectories_of(*state, HEADER);
    assert_int_equal(read.step_count, 0);
    assert_int_equal(read.id_count, 0);
    assert_false(trajectory_has(&read, "1"));
}

static void classes_are_those_of_vehicle_documents(void **state)
{
    static const char *const classes[][2] = {
        {"car", "car"},
        {"truck", "truck"},
        {"bus", "bus"},
        {"motorcycle", "motorcycle"},
        {"bicycle", "bicycle"},
        {"pedestrian", "pedestrian"},
        {"pedestrian/bicycle", "pedestrian"},
        {"Tram 4000", "Tram 4000"},
    };
    for (size_t i = 0; i < sizeof classes / sizeof classes[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, WALKERS "1,1,100,%s,0,0,0,0\n", classes[i][0]);
        struct trajectories read = trajectories_of(*state, text);
        assert_string_equal(state_of(&read, 100, "1")->class, classes[i][1]);
    }
}

static void without_a_box_the_yaw_is_that_of_the_velocity(void **state)
{
    static const char *const texts[] = {
        WALKERS "P1,1,100,pedestrian/bicycle,0,0,-1,1\n"
                "P2,1,100,pedestrian/bicycle,0,0,0,0\n"
                "P3,1,100,pedestrian/bicycle,0,0,-0.0,-0.0\n",
        HEADER "P1,1,100,pedestrian/bicycle,0,0,-1,1,,,\n"
               "P2,1,100,pedestrian/bicycle,0,0,0,0,,,\n"
               "P3,1,100,pedestrian/bicycle,0,0,-0.0,-0.0,,,\n",
    };
    for (size_t i = 0; i < 2; i++) {
        struct trajectories read = trajectories_of(*state, texts[i]);
        assert_close(state_of(&read, 100, "P1")->yaw_rad, 3 * PI / 4, 1e-15);
        assert_close(state_of(&read, 100, "P2")->yaw_rad, 0, 0);
        assert_close(state_of(&read, 100, "P3")->yaw_rad, 0, 0);
        assert_close(state_of(&read, 100, "P1")->length_m, 0, 0);
        assert_close(state_of(&read, 100, "P1")->width_m, 0, 0);
    }
}

static void the_yaw_rate_looks_ahead_and_wraps(void **state)
{
    struct trajectories read = trajectories_of(*state, HEADER "a,1,100,car,0,0,0,0,3.1,4,2\n"
                                                              "a,2,200,car,0,0,0,0,-3.1,4,2\n"
                                                              "a,4,400,car,0,0,0,0,-3.0,4,2\n"
                                                              "a,5,500,car,0,0,0,0,-3.3,4,2\n"
                                                              "b,2,200,car,0,0,0,0,1,4,2\n");
    assert_close(state_of(&read, 100, "a")->yaw_rate_radps, (2 * PI - 6.2) / 0.1, 1e-13);
    assert_close(state_of(&read, 200, "a")->yaw_rate_radps, 0.1 / 0.2, 1e-14);
    assert_close(state_of(&read, 400, "a")->yaw_rate_radps, -0.3 / 0.1, 1e-13);
    assert_close(state_of(&read, 500, "a")->yaw_rate_radps, -0.3 / 0.1, 1e-13);
    assert_close(state_of(&read, 200, "b")->yaw_rate_radps, 0, 0);
    assert_close(state_of(&read, 500, "a")->yaw_rad, 2 * PI - 3.3, 1e-15);
}

static void the_distance_travelled_adds_up_from_place_to_place(void **state)
{
    struct trajectories read = trajectories_of(*state, HEADER "a,3,300,car,503,5000000,0,0,0,4,2\n"
                                                              "a,2,200,car,503,5000004,0,0,0,4,2\n"
                                                              "b,2,200,car,9,9,0,0,0,4,2\n"
                                                              "a,1,100,car,500,5000000,0,0,0,4,2\n"
                                                              "b,3,300,car,9,9,0,0,0,4,2\n");
    assert_close(state_of(&read, 100, "a")->travelled_m, 0, 0);
    assert_close(state_of(&read, 200, "a")->travelled_m, 5, 0);
    assert_close(state_of(&read, 300, "a")->travelled_m, 9, 0);
    assert_close(state_of(&read, 300, "b")->travelled_m, 0, 0);
}

/* One long step, then many too short to change a plain sum. */
static void many_short_steps_are_not_lost(void **state)
{
    enum { STEPS = 20000 };
    char *text = malloc(STEPS * 64);
    assert_non_null(text);
    size_t used = (size_t)sprintf(text, WALKERS "a,0,0,car,0,1e8,0,0\na,0,1,car,0,0,0,0\n");
    for (int i = 1; i <= STEPS; i++)
        used += (size_t)sprintf(text + used, "a,0,%d,car,%de-9,0,0,0\n", i + 1, i);
    struct trajectories read = trajectories_of(*state, text);
    free(text);
    assert_close(state_of(&read, STEPS + 1, "a")->travelled_m - 1e8, STEPS * 1e-9, 2e-8);
}

static void damaged_recordings_are_refused(void **state)
{
    static const struct {
        const char *text, *message;
    } cases[] = {
        {HEADER
         "1,1,100,car,0,0,0,0,0,4,2\n\n2,1,100,car,0,0,0,0,0,4,2\n1,2,100,car,1,0,0,0,0,4,2\n",
         "row 5: track 1 at 100 ms is in row 2 already"},
        {HEADER "1,1,100.5,car,0,0,0,0,0,4,2\n",
         "row 2, column \"timestamp_ms\": 100.5 is not a whole number"},
        {HEADER "1,1,1e16,car,0,0,0,0,0,4,2\n",
         "row 2, column \"timestamp_ms\": 1e16 is outside [-1e+13, 1e+13]"},
        {HEADER "1,1,,car,0,0,0,0,0,4,2\n", "row 2, column \"timestamp_ms\": \"\" is not a number"},
        {HEADER "1,1,100,car,0,2e9,0,0,0,4,2\n",
         "row 2, column \"y\": 2e9 is outside [-1e+09, 1e+09]"},
        {HEADER "1,1,100,car,nan,0,0,0,0,4,2\n", "row 2, column \"x\": \"nan\" is not a number"},
        {HEADER "1,1,100,car,0,0,0,0,0,-4,2\n",
         "row 2, column \"length\": -4 is outside [0, 1e+06]"},
        {HEADER "1,1,100,car,0,0,0,0,0,,2\n", "row 2, column \"length\": \"\" is not a number"},
        {"track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi,length,width\n",
         "column \"psi_rad\" is missing; the header is: track_id, frame_id, timestamp_ms, "
         "agent_type, x, y, vx, vy, psi, length, width"},
        {"track_id,timestamp_ms,agent_type,x,y,vx\n",
         "column \"vy\" is missing; the header is: track_id, timestamp_ms, agent_type, x, y, vx"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct trajectories read;
        struct diag diag;
        assert_int_equal(read_text(*state, cases[i].text, &read, &diag), -1);
        assert_string_equal(diag.text, cases[i].message);
        assert_int_equal(diag.code, DIAG_DATA);
    }
}

static void names_are_short_printable_ascii(void **state)
{
    static const char *const names[] = {"", "a\nb", "a\tb", "\x7f", "Z\xc3\xbcrich", "\xff"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char text[256], message[128];
        snprintf(text, sizeof text, WALKERS "1,1,100,\"%s\",0,0,0,0\n", names[i]);
        snprintf(
            message, sizeof message,
            "row 2, column \"agent_type\": \"%s\"; expected 1 to %d printable ASCII characters",
            names[i], FIELD_NAME_SIZE);
        struct trajectories read;
        struct diag diag;
        assert_int_equal(read_text(*state, text, &read, &diag), -1);
        assert_string_equal(diag.text, message);
    }
}

static void names_have_a_greatest_length(void **state)
{
    for (size_t excess = 0; excess < 2; excess++) {
        char id[FIELD_NAME_SIZE + 2] = "", text[FIELD_NAME_SIZE + 256];
        memset(id, 'x', FIELD_NAME_SIZE + excess);
        snprintf(text, sizeof text, WALKERS "%s,1,100,car,0,0,0,0\n", id);
        struct trajectories read;
        struct diag diag;
        assert_int_equal(read_text(*state, text, &read, &diag), excess == 0 ? 0 : -1);
    }
}

/* In this recording cars drive forwards along their yaw. */
static void check_step(const struct trajectories *read, size_t index)
{
    const struct recorded_step *step = &read->steps[index];
    for (size_t i = 0; i < step->count; i++) {
        const struct recorded_state *state = &step->states[i];
        assert_true(trajectory_has(read, state->id));
        assert_string_equal(state->class, "car");
        assert_true(state->length_m > 3 && state->width_m > 1.4);
        assert_true(fabs(state->yaw_rate_radps) < 1);
        double along_mps =
            state->vx_mps * cos(state->yaw_rad) + state->vy_mps * sin(state->yaw_rad);
        assert_close(along_mps, hypot(state->vx_mps, state->vy_mps), 1e-8);
    }
}

static void a_recorded_motorway_is_read(void **state)
{
    struct scratch *scratch = *state;
    const char *data = getenv("GLINT_TEST_DATA");
    if (data == NULL) {
        print_message("GLINT_TEST_DATA is not set: no recording to read\n");
        skip();
        return;
    }
    char path[4096];
    snprintf(path, sizeof path, "%s/csv/us101_interaction.csv", data);
    struct trajectories read;
    struct diag diag = {0};
    if (trajectory_read(path, &scratch->arena, &read, &diag) != 0)
        fail_msg("%s", diag.text);
    assert_int_equal(read.id_count, 12);
    size_t states = 0;
    for (size_t i = 0; i < read.step_count; i++) {
        assert_int_equal(read.steps[i].interval_ms, 100);
        check_step(&read, i);
        states += read.steps[i].count;
    }
    assert_int_equal(states, 384);
    const struct recorded_state *second = state_of(&read, 200, "1");
    assert_close(second->yaw_rate_radps, (-0.7467 + 0.7596) / 0.1, 1e-12);
    assert_close(second->travelled_m, hypot(21.1431 - 20.3796, -19.2659 + 18.5216), 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_row_becomes_a_state),
        cmocka_unit_test(columns_may_stand_in_any_order_among_others),
        cmocka_unit_test(steps_ascend_in_time_and_their_states_in_id),
        cmocka_unit_test(tracks_are_known_by_their_ids),
        cmocka_unit_test(a_table_without_rows_has_no_steps),
        cmocka_unit_test(classes_are_those_of_vehicle_documents),
        cmocka_unit_test(without_a_box_the_yaw_is_that_of_the_velocity),
        cmocka_unit_test(the_yaw_rate_looks_ahead_and_wraps),
        cmocka_unit_test(the_distance_travelled_adds_up_from_place_to_place),
        cmocka_unit_test(many_short_steps_are_not_lost),
        cmocka_unit_test(damaged_recordings_are_refused),
        cmocka_unit_test(names_are_short_printable_ascii),
        cmocka_unit_test(names_have_a_greatest_length),
        cmocka_unit_test(a_recorded_motorway_is_read),
    };
    return cmocka_run_group_tests(tests, make_scratch, remove_scratch);
}
