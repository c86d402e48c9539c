#include "recorded/recorded_store.h"

#include "check.h"

/* A reader of rows that the test states. */
struct given {
    const struct recorded_row *rows;
    size_t count, at;
};

static int next_given(void *state, struct recorded_row *row, struct diag *diag)
{
    (void)diag;
    struct given *given = state;
    if (given->at == given->count)
        return RECORDED_END;
    *row = given->rows[given->at++];
    return RECORDED_ROW;
}

static const struct recorded_format format = {
    .name = "rows", .id_name = "id", .place = "row", .next = next_given};

/* A car on a circle of 50 m, 12 m/s, at a time in ms. */
static struct recorded_row circling(const char *id, double time_ms, size_t place)
{
    const double rate_radps = 12. / 50, yaw_rad = rate_radps * time_ms * 1e-3;
    struct recorded_row row = recorded_row_unsaid;
    row.id = id;
    row.class = "car";
    row.time_ns = llround(time_ms * 1e6);
    row.x_m = 50 * sin(yaw_rad);
    row.y_m = -50 * cos(yaw_rad);
    row.yaw_rad = yaw_rad;
    row.vx_mps = 12 * cos(yaw_rad);
    row.vy_mps = 12 * sin(yaw_rad);
    row.yaw_rate_radps = rate_radps;
    row.place = place;
    return row;
}

/* Opens a store of these rows; its format is NULL after a message. */
static struct recorded_reader try_store(const struct recorded_row *rows, size_t count,
                                        double rate_hz, struct diag *diag)
{
    struct recorded_plausibility plausibility = {0};
    struct given *given = arena_get(check_arena(), sizeof *given);
    *given = (struct given){rows, count, 0};
    *diag = (struct diag){0};
    return recorded_store_open((struct recorded_reader){&format, given}, rate_hz, &plausibility,
                               check_arena(), diag);
}

static struct recorded_reader stored(const struct recorded_row *rows, size_t count, double rate_hz)
{
    struct diag diag;
    struct recorded_reader reader = try_store(rows, count, rate_hz, &diag);
    if (reader.format == NULL)
        fail_msg("%s", diag.text);
    return reader;
}

/* What comes next; false at the end. */
static bool next_event(struct recorded_reader reader, int *event, struct recorded_row *row)
{
    struct diag diag = {0};
    *event = reader.format->next(reader.state, row, &diag);
    assert_true(*event >= RECORDED_END);
    return *event != RECORDED_END;
}

static int compare_letters(const void *one, const void *other)
{
    return *(const char *)one - *(const char *)other;
}

/* Checks the steps: "TIME_MS a b;TIME_MS b;", with ids of one letter. */
static void assert_steps(struct recorded_reader reader, const char *expected)
{
    char steps[1024] = "", ids[64] = "";
    struct recorded_row row;
    int event;
    while (next_event(reader, &event, &row)) {
        size_t used = strlen(event == RECORDED_ROW ? ids : steps);
        if (event == RECORDED_ROW) {
            snprintf(ids + used, sizeof ids - used, "%s", row.id);
            continue;
        }
        qsort(ids, strlen(ids), 1, compare_letters);
        snprintf(steps + used, sizeof steps - used, "%g", (double)row.time_ns * 1e-6);
        for (size_t i = 0; ids[i] != '\0'; i++)
            snprintf(steps + strlen(steps), sizeof steps - strlen(steps), " %c", ids[i]);
        snprintf(steps + strlen(steps), sizeof steps - strlen(steps), ";");
        ids[0] = '\0';
    }
    assert_string_equal(steps, expected);
}

static void assert_circling(const struct recorded_row *row, double tolerance)
{
    struct recorded_row exact = circling(row->id, (double)row->time_ns * 1e-6, 0);
    assert_close(row->x_m, exact.x_m, tolerance);
    assert_close(row->y_m, exact.y_m, tolerance);
    assert_close(row->yaw_rad, exact.yaw_rad, tolerance);
    assert_close(row->vx_mps, exact.vx_mps, 100 * tolerance);
    assert_close(row->vy_mps, exact.vy_mps, 100 * tolerance);
    assert_close(row->yaw_rate_radps, exact.yaw_rate_radps, tolerance);
}

TEST(stamps_within_a_tenth_of_the_usual_step_are_one_step)
{
    const struct recorded_row rows[] = {
        circling("a", 0, 1),   circling("a", 100, 2), circling("a", 200, 3), circling("a", 300, 4),
        circling("b", 9, 5),   circling("b", 91, 6),  circling("b", 200, 7), circling("b", 310, 8),
        circling("c", 100, 9), circling("c", 300, 10)};
    assert_steps(stored(rows, 10, 0), "0 a b;100 a b c;200 a b;300 a b c;");
}

/* b's stamp is 10 ms after a's: it turns with the yaw rate of its own stamps. */
TEST(a_row_is_moved_to_the_time_of_its_step)
{
    struct recorded_row rows[9], row;
    for (size_t i = 0; i < 3; i++) {
        rows[3 * i] = circling("a", 100 * (double)i, i);
        rows[3 * i + 1] = circling("b", 100 * (double)i + 10, i);
        rows[3 * i + 2] = circling("c", 100 * (double)i, i);
        rows[3 * i + 1].yaw_rate_radps = (double)NAN;
    }
    struct recorded_reader reader = stored(rows, 9, 0);
    size_t moved = 0;
    for (int event; next_event(reader, &event, &row);) {
        if (event == RECORDED_ROW)
            assert_circling(&row, 1e-5);
        moved += event == RECORDED_ROW && *row.id == 'b';
    }
    assert_int_equal(moved, 3);
}

/* Without velocities those of the rows' own stamps move a row. */
TEST(velocities_that_lack_are_those_of_the_own_stamps)
{
    struct recorded_row rows[8], row;
    static const double late_ms[] = {0, 8, 2, 9};
    for (size_t i = 0; i < 4; i++) {
        rows[2 * i] = circling("a", 100 * (double)i, i);
        rows[2 * i + 1] = circling("b", 100 * (double)i + late_ms[i], i);
        rows[2 * i + 1].vx_mps = rows[2 * i + 1].vy_mps = (double)NAN;
    }
    struct recorded_reader reader = stored(rows, 8, 0);
    for (int event; next_event(reader, &event, &row);) {
        struct recorded_row exact = circling("b", (double)row.time_ns * 1e-6, 0);
        if (event == RECORDED_ROW && *row.id == 'b')
            assert_close(hypot(row.x_m - exact.x_m, row.y_m - exact.y_m), 0, 2e-3);
    }
}

/* At 100 ms the stamps are 8 and 4 ms after each other: after 10 ms the next step begins. */
TEST(a_chain_of_stamps_is_cut_at_a_tenth)
{
    struct recorded_row rows[36];
    for (size_t i = 0; i < 12; i++) {
        double time_ms = 100 * (double)i;
        rows[3 * i] = circling("a", time_ms, i);
        rows[3 * i + 1] = circling("b", time_ms + (i == 1 ? 8 : 0), i);
        rows[3 * i + 2] = circling("c", time_ms + (i == 1 ? 12 : 0), i);
    }
    assert_steps(
        stored(rows, 36, 0),
        "0 a b c;100 a b;112 c;200 a b c;300 a b c;400 a b c;500 a b c;600 a b c;700 a b c;"
        "800 a b c;900 a b c;1000 a b c;1100 a b c;");
}

TEST(a_step_has_no_two_stamps_of_one_road_user)
{
    const struct recorded_row rows[] = {circling("a", 0, 1),   circling("a", 100, 2),
                                        circling("a", 101, 3), circling("a", 200, 4),
                                        circling("a", 300, 5), circling("b", 101, 6)};
    assert_steps(stored(rows, 6, 0), "0 a;100 a;101 a b;200 a;300 a;");
}

/* Whoever is absent for steps has left; that makes no times of its own. */
TEST(absences_are_no_times_of_their_own)
{
    const struct recorded_row rows[] = {
        circling("a", 0, 1),   circling("a", 100, 2), circling("a", 300, 3), circling("a", 500, 4),
        circling("b", 0, 5),   circling("b", 100, 6), circling("b", 200, 7), circling("b", 300, 8),
        circling("b", 400, 9), circling("b", 500, 10)};
    struct recorded_reader reader = stored(rows, 10, 0);
    assert_steps(reader, "0 a b;100 a b;200 b;300 a b;400 b;500 a b;");
    recorded_store_rewind(reader);
    assert_steps(reader, "0 a b;100 a b;200 b;300 a b;400 b;500 a b;");
}

/* a at 10 Hz, b 37 ms later, c at 8 Hz with a gap of a second. */
static size_t rows_apart(struct recorded_row *rows)
{
    size_t count = 0;
    for (size_t i = 0; i < 30; i++) {
        rows[count] = circling("a", 100 * (double)i, count);
        rows[count + 1] = circling("b", 100 * (double)i + 37, count);
        count += 2;
        if (i >= 10 && i <= 17)
            continue;
        rows[count] = circling("c", 125 * (double)i + 50, count);
        count++;
    }
    return count;
}

TEST(times_of_their_own_need_a_rate)
{
    struct diag diag;
    struct recorded_row rows[90];
    assert_null(try_store(rows, rows_apart(rows), 0, &diag).format);
    assert_int_equal(diag.code, DIAG_DATA);
    assert_non_null(strstr(diag.text, "the road users have times of their own"));
    assert_non_null(strstr(diag.text, "--rate-hz 10 interpolates each between its own rows"));
}

TEST(each_is_interpolated_between_its_own_rows)
{
    struct recorded_row rows[90], row;
    struct recorded_reader reader = stored(rows, rows_apart(rows), 20);
    size_t counts[3] = {0}, steps = 0;
    for (int event; next_event(reader, &event, &row);) {
        steps += event == RECORDED_STEP;
        if (event != RECORDED_ROW)
            continue;
        assert_int_equal(row.time_ns % 50000000, 0);
        assert_circling(&row, 1e-6);
        counts[*row.id - 'a']++;
        if (*row.id == 'c')
            assert_true(row.time_ns <= 1175000000 || row.time_ns >= 2300000000);
    }
    assert_int_equal(steps, 74);
    assert_int_equal(counts[0], 59);
    assert_int_equal(counts[1], 58);
    assert_int_equal(counts[2], 23 + 28);
}

TEST(rows_of_one_time_that_differ_are_refused_at_a_rate_too)
{
    struct diag diag;
    struct recorded_row rows[92];
    size_t count = rows_apart(rows);
    rows[count] = rows[count - 1];
    stored(rows, count + 1, 20);
    rows[count].x_m += 1;
    rows[count].place = count;
    assert_null(try_store(rows, count + 1, 20, &diag).format);
    assert_non_null(strstr(diag.text, " is in row "));
}
