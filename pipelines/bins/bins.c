/* A sensor of your own, in C: ../bins.py once more, in two channels of the same radar. */
#include "base/elementary.h"
#include "base/sort.h"
#include "base/units.h"
#include "run/stage.h"

static const double six_db = 1.9952623149688795;

struct bins {
    double threshold_db;
};

/* An echo in its bin of range and range rate, and what it gives the sum and the delta channel. */
struct heard {
    double range_bin, rate_bin;
    double sum, delta;
    const struct echo *echo;
};

/* Radar equation (MODEL 4.1: an ERCS of 0.8 has 6 dB at 30 m) and antenna (7.1). */
static struct heard hear(const struct echo *echo, const struct sensor_view *sensor)
{
    double u = PI / 2 * elementary_sin(echo->azimuth_rad);
    double ratio = 30 / elementary_max(echo->range_m, 0.5);
    double strength = six_db * ratio * ratio * echo->ercs / 0.8;
    double element =
        strength * (u != 0 ? elementary_sin(u) / u : 1) * elementary_cos(echo->azimuth_rad);
    return (struct heard){
        .range_bin = floor(echo->range_m / sensor->cell_range_m),
        .rate_bin = floor(echo->range_rate_mps / sensor->cell_range_rate_mps),
        .sum = element * elementary_cos(u),
        .delta = -element * elementary_sin(u),
        .echo = echo,
    };
}

/* By bin, and in a bin the strongest first. */
static int compare(const void *left, const void *right)
{
    const struct heard *a = left, *b = right;
    if (a->range_bin != b->range_bin)
        return a->range_bin < b->range_bin ? -1 : 1;
    if (a->rate_bin != b->rate_bin)
        return a->rate_bin < b->rate_bin ? -1 : 1;
    return (a->sum < b->sum) - (a->sum > b->sum);
}

/* Pointers add, places are means, and the echoes with their shares of the amplitude are the label.
 */
static struct cell cell_of(const struct heard *heard, size_t count, struct arena *arena)
{
    struct cell cell = {.sensor = heard->echo->sensor};
    for (size_t i = 0; i < count; i++) {
        cell.amplitude += heard[i].sum;
        cell.delta_im += heard[i].delta;
        cell.effects |= heard[i].echo->effects;
    }
    double whole = cell.amplitude > 0 ? cell.amplitude : 1;
    for (size_t i = 0; i < count; i++) {
        struct contributor *member = list_add(&cell.members, arena);
        *member = frame_contributor(heard[i].echo);
        member->weight = heard[i].sum / whole;
        cell.range_m += member->weight * member->range_m;
        cell.range_rate_mps += member->weight * member->range_rate_mps;
    }
    cell.sum_re = cell.amplitude;
    cell.azimuth_rad = elementary_asin(2 / PI * elementary_atan2(-cell.delta_im, cell.amplitude));
    return cell;
}

/* The cell goes into the frame, or its echoes are lost. */
static void report(struct frame *frame, const struct cell *cell, double threshold)
{
    if (cell->amplitude >= threshold) {
        *list_add(&frame->cells, frame->arena) = *cell;
        return;
    }
    for (size_t i = 0; i < cell->members.count; i++) {
        struct lost_echo lost = frame_lost_echo(&cell->members.items[i], &cell->margins);
        frame_lose_own(frame, "bins", cell->sensor, "weak", &lost);
    }
}

static bool same_bin(const struct heard *a, const struct heard *b)
{
    return a->range_bin == b->range_bin && a->rate_bin == b->rate_bin;
}

static void sense(struct frame *frame, const struct sensor_view *sensor, double threshold)
{
    struct echo_span echoes = frame_echoes_of(frame, sensor->name);
    struct heard *heard = arena_get(frame->arena, echoes.count * sizeof *heard);
    for (size_t i = 0; i < echoes.count; i++)
        heard[i] = hear(&echoes.items[i], sensor);
    sort_items(heard, echoes.count, sizeof *heard, compare, frame->arena);
    size_t first = 0;
    while (first < echoes.count) {
        size_t end = first + 1;
        while (end < echoes.count && same_bin(&heard[first], &heard[end]))
            end++;
        struct cell cell = cell_of(heard + first, end - first, frame->arena);
        report(frame, &cell, threshold);
        first = end;
    }
}

static int bins_step(void *state, struct frame *frame, struct runner *runner)
{
    (void)runner;
    const struct bins *own = state;
    double threshold = elementary_pow(10, own->threshold_db / 20);
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        sense(frame, &frame->sensors.list.items[i], threshold);
    return 0;
}

static const struct field bins_options[] = {
    {OPTIONAL_REAL(struct bins, threshold_db, 0, 200, "amplitude of the weakest cell; absent: 6"),
     .absent = 6},
    {0},
};

const struct stage stage_bins = {
    .name = "bins",
    .summary = "Add up the echoes in the bins of a fixed grid.",
    .options = STAGE_OPTIONS(struct bins, bins_options),
    .reads = PART_SENSORS | PART_ECHOES,
    .writes = PART_CELLS | PART_LOST,
    .step = bins_step,
};
