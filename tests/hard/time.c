/* Time, binning and order: hard cases 40 to 47, and 24, straight motion over a million frames. */
#define SCRATCH_FILE "hard"
#include "chain.h"
#include "support/recorded_file.h"
#include "support/scratch.h"

#include "base/number.h"
#include "base/sort.h"
#include "base/units.h"
#include "radar/resolution.h"
#include "radar/scan_timing.h"
#include "sensor/resolution_cell.h"
#include "traffic/scenario.h"

enum { FRAMES = 1000000, PRECISION = 320 };

static const double rates_hz[] = {20, 10, 25, 30, 17};

#define START_X_M 512345.678
#define START_Y_M 5335123.4567
#define SPEED_MPS 50.0
#define YAW_RAD 0.6

/* A scenario of a car at 50 m/s in UTM coordinates for a million frames. */
static struct scenario *open_scene(struct scratch *scratch, double rate_hz)
{
    char text[512];
    snprintf(text, sizeof text,
             "{\"origin\": \"test\", \"ego\": \"e\", \"rate_hz\": %.17g, \"duration_s\": %.17g, "
             "\"objects\": [{\"id\": \"e\", \"class\": \"car\", \"x_m\": %.17g, \"y_m\": %.17g, "
             "\"speed_mps\": %.17g, \"yaw_rad\": %.17g}]}",
             rate_hz, (FRAMES - 1) / rate_hz, START_X_M, START_Y_M, SPEED_MPS, YAW_RAD);
    scratch_write(scratch->path, text);
    struct diag diag = {0};
    struct scenario_document document;
    struct scenario *scene = NULL;
    if (scenario_read(scratch->path, &document, &scratch->arena, &diag) == 0)
        scene = scenario_draw(&document, (struct random_address){.seed = 1}, NULL, &scratch->arena,
                              &diag);
    if (scene == NULL)
        fail_msg("%s", diag.text);
    assert_int_equal(scenario_frames(scene), FRAMES);
    return scene;
}

/* The step between frames that are checked: every frame, or every tenth one where HARD_TENTH is
 * set. */
static int64_t frame_step(void)
{
    return FRAMES / hard_points(FRAMES);
}

static void frame_of(const struct scenario *scene, int64_t number, struct frame *frame)
{
    frame_clear(frame);
    scenario_fill(scene, number, frame);
}

SCRATCH_TEST(a_million_frames_stand_at_their_times)
{
    struct frame frame = {.arena = check_arena()};
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(exact, PRECISION);
    for (size_t r = 0; r < COUNT(rates_hz); r++) {
        const struct scenario *scene = open_scene(scratch, rates_hz[r]);
        double clock_s = 0;
        for (int64_t i = 0; i < FRAMES; i++, clock_s += 1 / rates_hz[r]) {
            if (i % frame_step() != 0)
                continue;
            frame_of(scene, i, &frame);
            mpfr_set_sj(exact, i, MPFR_RNDN);
            mpfr_div_d(exact, exact, rates_hz[r], MPFR_RNDN);
            ours = fmax(ours, error_ulp(frame.time_s, exact));
            naive = fmax(naive, error_ulp(clock_s, exact));
        }
    }
    hard_case("40", "time of 1e6 frames at 10 to 30 Hz", "ulp", naive, ours, 0.5);
}

SCRATCH_TEST(a_frame_is_found_again_from_its_time)
{
    struct frame frame = {.arena = check_arena()};
    double naive = 0, ours = 0;
    for (size_t r = 0; r < COUNT(rates_hz); r++) {
        const struct scenario *scene = open_scene(scratch, rates_hz[r]);
        for (int64_t i = 0; i < FRAMES; i += frame_step()) {
            frame_of(scene, i, &frame);
            double interval_s = 1 / rates_hz[r];
            naive += (int64_t)((double)i * interval_s / interval_s) != i;
            ours += llround(frame.time_s * rates_hz[r]) != i;
        }
    }
    hard_case("41", "frame number back from its time", "wrong", naive, ours, 0);
}

/* Hard case 41 for scans: a sensor with a scan in every second frame, its cycle written as a
 * decimal. */
SCRATCH_TEST(scans_fall_on_their_frames)
{
    struct frame frame = {.arena = check_arena()};
    double naive = 0, ours = 0;
    for (size_t r = 0; r < COUNT(rates_hz); r++) {
        const struct scenario *scene = open_scene(scratch, rates_hz[r]);
        double cycle_s = 2 / rates_hz[r];
        for (int64_t i = 0; i < FRAMES; i += frame_step()) {
            double instant_s = -1;
            frame_of(scene, i, &frame);
            bool scan =
                floor(frame.time_s / cycle_s) != floor((frame.time_s - frame.interval_s) / cycle_s);
            naive += scan != (i % 2 == 0);
            enum scan_timing_answer answer =
                scan_timing_instant_s(cycle_s, frame.time_s, frame.interval_s, &instant_s);
            ours += i % 2 == 0 ? answer != SCAN_TIMING_ONE || instant_s != frame.time_s
                               : answer != SCAN_TIMING_NONE;
        }
    }
    hard_case("41", "scan of every second frame (naive: floor)", "wrong", naive, ours, 0);
}

SCRATCH_TEST(unix_times_keep_their_intervals)
{
    const int64_t epoch_ms = INT64_C(1700000000000);
    int steps = hard_points(10000);
    FILE *file = fopen(scratch->path, "w");
    assert_non_null(file);
    fputs("track_id,timestamp_ms,agent_type,x,y,vx,vy\n", file);
    for (int i = 0; i < steps; i++)
        fprintf(file, "1,%lld,car,%d,0,50,0\n", (long long)(epoch_ms + 40 * (int64_t)i), 2 * i);
    assert_int_equal(fclose(file), 0);
    struct recording scene;
    recorded_file_open(&scene, scratch->path, "1", &scratch->arena);
    struct frame frame = {.arena = check_arena()};
    double naive = 0, ours = 0, before_s = 0;
    for (int i = 0; i < steps; i++, before_s = frame.time_s) {
        recorded_file_next(&scene, &frame);
        ours = fmax(ours, fabs(frame.interval_s - 0.04));
        if (i > 0)
            naive = fmax(naive, fabs((frame.time_s - before_s) - 0.04));
        ours += frame.time_s != (double)(epoch_ms + 40 * i) / 1000;
    }
    recording_close(&scene);
    hard_case("42", "interval of frames in UNIX time", "s", naive, ours, 0);
}

static double position_error_m(const struct frame *frame, mpfr_t time_s, mpfr_t cosine, mpfr_t sine)
{
    const struct object *car = &frame->objects.items[0];
    double worst_m = 0;
    MPFR_DECL_INIT(place, PRECISION);
    for (int axis = 0; axis < 2; axis++) {
        mpfr_mul(place, time_s, axis == 0 ? cosine : sine, MPFR_RNDN);
        mpfr_mul_d(place, place, SPEED_MPS, MPFR_RNDN);
        mpfr_add_d(place, place, axis == 0 ? START_X_M : START_Y_M, MPFR_RNDN);
        mpfr_sub_d(place, place, axis == 0 ? frame->origin_x_m : frame->origin_y_m, MPFR_RNDN);
        mpfr_sub_d(place, place, axis == 0 ? car->x_m : car->y_m, MPFR_RNDN);
        worst_m = fmax(worst_m, fabs(mpfr_get_d(place, MPFR_RNDN)));
    }
    return worst_m;
}

SCRATCH_TEST(straight_motion_does_not_drift)
{
    static const double rates[] = {17, 25};
    struct frame frame = {.arena = check_arena()}, drifting = {.arena = check_arena()};
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(time_s, PRECISION);
    MPFR_DECL_INIT(cosine, PRECISION);
    MPFR_DECL_INIT(sine, PRECISION);
    mpfr_set_d(sine, YAW_RAD, MPFR_RNDN);
    mpfr_cos(cosine, sine, MPFR_RNDN);
    mpfr_sin(sine, sine, MPFR_RNDN);
    for (size_t r = 0; r < COUNT(rates); r++) {
        const struct scenario *scene = open_scene(scratch, rates[r]);
        struct object car = {.x_m = START_X_M, .y_m = START_Y_M};
        drifting.objects.items = &car;
        for (int64_t i = 0; i < FRAMES; i++) {
            if (i % frame_step() == 0) {
                frame_of(scene, i, &frame);
                mpfr_set_sj(time_s, i, MPFR_RNDN);
                mpfr_div_d(time_s, time_s, rates[r], MPFR_RNDN);
                ours = fmax(ours, position_error_m(&frame, time_s, cosine, sine));
                naive = fmax(naive, position_error_m(&drifting, time_s, cosine, sine));
            }
            car.x_m += SPEED_MPS * cos(YAW_RAD) / rates[r];
            car.y_m += SPEED_MPS * sin(YAW_RAD) / rates[r];
        }
    }
    hard_case("24", "place after 1e6 frames at 50 m/s from UTM", "m", naive, ours, 1e-9);
}

/* Hard case 43: every multiple of a step is reported as that multiple, and rounding it twice
 * changes nothing. */
TEST(multiples_of_a_step_stay_in_their_bin)
{
    static const double steps[] = {0.3, 0.1, 0.05, 0.01, 0.0017453292519943295};
    double naive = 0, ours = 0;
    for (size_t s = 0; s < COUNT(steps); s++)
        for (int k = 0; k < hard_points(10000); k++) {
            char decimal[32];
            snprintf(decimal, sizeof decimal, "%.10g", k * steps[s]);
            double value = strtod(decimal, NULL), reported = units_rounded(value, steps[s]);
            naive += floor(value / steps[s]) != k;
            ours += reported != k * steps[s] || units_rounded(reported, steps[s]) != reported;
        }
    hard_case("43", "1e4 multiples of five steps", "wrong", naive, ours, 0);
}

/* Hard case 44: the border of a cell is where the doubles put it: |a - b| rounded once, then <=.
 * The naive count is of decimals, a multiple of 0.01 m apart, that the doubles put on the other
 * side. */
static size_t cluster(const struct resolution_echo *echoes, size_t count, double half_range_m,
                      double half_range_rate_mps, size_t *cell)
{
    struct arena arena = {0};
    const struct resolution resolution = {half_range_m, half_range_rate_mps, false};
    size_t cells = resolution_cluster(echoes, count, &resolution, cell, &arena);
    arena_free(&arena);
    return cells;
}

TEST(the_border_of_a_cell_is_decided_in_doubles)
{
    static const double pairs[][2] = {
        {12.55, 12.40}, {12.70, 12.55}, {0.45, 0.30}, {0.30, 0.15}, {0, 0.15}};
    static const bool shared[] = {false, true, false, true, true};
    uint64_t random = 44;
    int points = hard_points(1000000);
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(difference, 53);
    for (int i = 0; i < points; i++) {
        int64_t a = 20000 + sample_integer(&random, 19000), b = a + sample_integer(&random, 20);
        struct resolution_echo echoes[] = {{(double)a / 100, 0, 2, 0, 0},
                                           {(double)b / 100, 0, 1, 0, 0}};
        if (i < 5)
            for (int k = 0; k < 2; k++)
                echoes[k].range_m = pairs[i][k];
        size_t cell[2];
        bool one = cluster(echoes, 2, 0.15, 0.25, cell) == 1;
        mpfr_set_d(difference, echoes[0].range_m, MPFR_RNDN);
        mpfr_sub_d(difference, difference, echoes[1].range_m, MPFR_RNDN);
        mpfr_abs(difference, difference, MPFR_RNDN);
        ours += one != (mpfr_cmp_d(difference, 0.15) <= 0) || (i < 5 && one != shared[i]);
        naive += i >= 5 && one != (llabs(a - b) <= 15);
    }
    hard_case("44", "cell border (naive: as decimals)", "wrong", naive, ours, 0);
}

enum { TIED = 6 };

static void shuffle(uint64_t *random, void *items, size_t count, size_t size)
{
    char spare[1024], *bytes = items;
    assert_true(size <= sizeof spare);
    for (size_t i = count; i > 1; i--) {
        char *one = bytes + (i - 1) * size;
        char *other = bytes + (size_t)(sample_bits(random) % i) * size;
        memcpy(spare, one, size);
        memmove(one, other, size);
        memcpy(other, spare, size);
    }
}

/* Draws echoes 0 to 0.28 m apart, with amplitudes that are the same or apart_ulp steps apart. */
static void draw_rays(uint64_t *random, int64_t apart_ulp,
                      struct received_echo received_echoes[TIED])
{
    static const char *const names[] = {"a", "b", "c", "d", "e", "f"};
    for (size_t i = 0; i < TIED; i++) {
        double amplitude = 2 * (1 + (double)sample_integer(random, apart_ulp) * 0x1p-52);
        double range_m = 10 + 0.07 * (double)(sample_bits(random) % 5);
        received_echoes[i] = (struct received_echo){
            .echo = {.id.object = "o", .id.reflector = names[i], .range_m = range_m},
            .range_m = range_m,
            .strength = amplitude,
            .amplitude = amplitude};
    }
}

/* The mean ranges of the cells, in their order. */
static size_t find_cells(const struct received_echo received_echoes[TIED], double range_m[TIED])
{
    struct resolution_echo echoes[TIED];
    size_t cell[TIED];
    for (size_t i = 0; i < TIED; i++)
        echoes[i] = (struct resolution_echo){received_echoes[i].echo.range_m, 0,
                                             received_echoes[i].amplitude, 0, 0};
    size_t cells = cluster(echoes, TIED, 0.15, 0.25, cell);
    for (size_t number = 0; number < cells; number++) {
        double ranges[TIED], weights[TIED];
        size_t count = 0;
        for (size_t i = 0; i < TIED; i++)
            if (cell[i] == number) {
                ranges[count] = echoes[i].range_m;
                weights[count++] = echoes[i].amplitude;
            }
        range_m[number] = resolution_mean(ranges, weights, count);
    }
    return cells;
}

static int compare_amplitudes(const void *left, const void *right)
{
    const struct received_echo *a = left, *b = right;
    return (a->amplitude < b->amplitude) - (a->amplitude > b->amplitude);
}

/* True if two orders of the received echoes make different lists under an order of strength. */
static bool differ(const struct received_echo one[TIED], const struct received_echo other[TIED],
                   int (*compare)(const void *, const void *), struct arena *arena)
{
    struct received_echo sorted[2][TIED];
    double range_m[2][TIED];
    size_t cells[2];
    for (int i = 0; i < 2; i++) {
        memcpy(sorted[i], i == 0 ? one : other, sizeof sorted[i]);
        sort_items(sorted[i], TIED, sizeof sorted[i][0], compare, arena);
        cells[i] = find_cells(sorted[i], range_m[i]);
    }
    arena_clear(arena);
    return cells[0] != cells[1] || memcmp(range_m[0], range_m[1], cells[0] * sizeof(double)) != 0;
}

TEST(ties_fall_the_same_way_in_every_order)
{
    uint64_t random = 45;
    int points = hard_points(200000);
    double naive = 0, ours = 0;
    for (int i = 0; i < points; i++) {
        struct received_echo received_echoes[TIED], shuffled[TIED];
        draw_rays(&random, 0, received_echoes);
        memcpy(shuffled, received_echoes, sizeof shuffled);
        shuffle(&random, shuffled, TIED, sizeof shuffled[0]);
        naive += differ(received_echoes, shuffled, compare_amplitudes, check_arena());
        ours += differ(received_echoes, shuffled, resolution_cell_compare, check_arena());
    }
    hard_case("45", "cells of tied echoes, input shuffled", "wrong", naive, ours, 0);
}

static double through_text(double value, int digits)
{
    char text[64];
    double back;
    size_t length = digits > 0 ? (size_t)snprintf(text, sizeof text, "%.*g", digits, value)
                               : number_write(value, text);
    assert_true(number_read(text, text + length, &back));
    return back;
}

/* Hard case 46: one ulp decides, so a pipe between two stages must not move it. */
TEST(near_ties_survive_the_pipe)
{
    uint64_t random = 46;
    int points = hard_points(200000);
    double naive = 0, ours = 0;
    for (int i = 0; i < points; i++) {
        struct received_echo received_echoes[TIED], rounded[TIED], carried[TIED];
        draw_rays(&random, 1, received_echoes);
        memcpy(rounded, received_echoes, sizeof rounded);
        memcpy(carried, received_echoes, sizeof carried);
        for (size_t k = 0; k < TIED; k++) {
            rounded[k].amplitude = through_text(received_echoes[k].amplitude, 15);
            carried[k].amplitude = through_text(received_echoes[k].amplitude, 0);
        }
        shuffle(&random, carried, TIED, sizeof carried[0]);
        naive += differ(received_echoes, rounded, resolution_cell_compare, check_arena());
        ours += differ(received_echoes, carried, resolution_cell_compare, check_arena());
    }
    hard_case("46", "ties of 1 ulp through text (naive: 15 digits)", "wrong", naive, ours, 0);
}

struct keyed {
    int key, place;
};

static int compare_keys(const void *left, const void *right)
{
    return ((const struct keyed *)left)->key - ((const struct keyed *)right)->key;
}

/* Sorts by selection and exchange, which changes the order of ties, as some qsort may. */
static void sort_unstably(struct keyed *items, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 1; k < count; k++)
            if (items[k].key < items[i].key) {
                struct keyed item = items[i];
                items[i] = items[k];
                items[k] = item;
            }
}

static double count_swapped(const struct keyed *items, size_t count)
{
    double swapped = 0;
    for (size_t i = 1; i < count; i++)
        swapped += items[i].key < items[i - 1].key ||
                   (items[i].key == items[i - 1].key && items[i].place < items[i - 1].place);
    return swapped;
}

TEST(sorting_keeps_the_order_of_ties)
{
    enum { ITEMS = 64 };
    uint64_t random = 47;
    int points = hard_points(10000);
    double naive = 0, ours = 0;
    for (int i = 0; i < points; i++) {
        struct keyed items[ITEMS], others[ITEMS];
        for (int k = 0; k < ITEMS; k++)
            items[k] = others[k] = (struct keyed){(int)(sample_bits(&random) % 4), k};
        sort_items(items, ITEMS, sizeof items[0], compare_keys, check_arena());
        sort_unstably(others, ITEMS);
        ours += count_swapped(items, ITEMS) > 0;
        naive += count_swapped(others, ITEMS) > 0;
        arena_clear(check_arena());
    }
    hard_case("47", "64 tied keys sorted (naive: by exchange)", "wrong", naive, ours, 0);
}

/* Reorders the echoes of each sensor, which stand together. */
static void shuffle_echoes(uint64_t *random, struct frame *frame)
{
    struct echo *echoes = frame->echoes.items;
    for (size_t begin = 0, end; begin < frame->echoes.count; begin = end) {
        for (end = begin;
             end < frame->echoes.count && strcmp(echoes[end].sensor, echoes[begin].sensor) == 0;)
            end++;
        shuffle(random, echoes + begin, end - begin, sizeof *echoes);
    }
}

/* What the stages from the given one to the last make of the chain's frame: cells, targets, and
 * echoes if not given. */
static void find_targets(struct hard_chain *chain, size_t from, struct text *text)
{
    hard_chain_step(chain, from, CHAIN_STAGES - 1);
    frame_drop(&chain->frame, PART_OBJECTS | PART_REFLECTORS | (from > 2 ? PART_ECHOES : 0));
    text->length = 0;
    hard_chain_write(chain, text);
}

enum { ORDERS = 1000, SCENES = 20 };

/* Runs one scene in 50 orders of its objects, or of its echoes, and counts how often a byte
 * changed. */
static double count_changes(struct hard_chain *chain, uint64_t *random, bool objects)
{
    struct text *line = check_text(), *first = check_text(), *text = check_text();
    struct frame *frame = &chain->frame;
    size_t from = objects ? 1 : 3;
    double changes = 0;
    hard_chain_next(chain);
    hard_chain_step(chain, 1, from - 1);
    hard_chain_write(chain, line);
    find_targets(chain, from, first);
    for (int i = 0; i < hard_points(ORDERS) / SCENES; i++) {
        assert_done(frame_text_read, line->bytes, line->length - 1, frame);
        if (objects)
            shuffle(random, frame->objects.items, frame->objects.count, sizeof(struct object));
        else
            shuffle_echoes(random, frame);
        find_targets(chain, from, text);
        changes +=
            text->length != first->length || memcmp(text->bytes, first->bytes, text->length) != 0;
    }
    return changes;
}

static void orders_of_input_change_no_byte(bool objects, const char *title)
{
    uint64_t random = 451;
    struct hard_chain chain;
    double ours = 0;
    hard_chain_start(&chain, 999990, SCENES);
    for (int i = 0; i < SCENES; i++)
        ours += count_changes(&chain, &random, objects);
    hard_chain_stop(&chain);
    hard_case("45", title, "wrong", (double)NAN, ours, 0);
}

TEST(the_order_of_objects_changes_no_byte)
{
    orders_of_input_change_no_byte(true, "cells and targets, 1,000 orders of objects");
}

TEST(the_order_of_echoes_changes_no_byte)
{
    orders_of_input_change_no_byte(false, "cells and targets, 1,000 orders of echoes");
}
