#include "noise/false_alarm_cells.h"

#include "base/elementary.h"
#include "base/random.h"
#include "effects/effect.h"

struct contributor false_alarm_cells_contributor(int64_t number)
{
    return (struct contributor){
        .id.object = "noise",
        .id.reflector = "cell",
        .id.path = PATH_FALSE_ALARM,
        .id.number = number,
        .weight = 1,
    };
}

static struct contributor draw_contributor(const struct sensor *sensor, int64_t number,
                                           const double uniform[3])
{
    struct contributor contributor = false_alarm_cells_contributor(number);
    contributor.azimuth_rad = sensor->field_of_view_rad * (uniform[1] - 0.5);
    double most_m = suite_range_max_m(sensor, contributor.azimuth_rad);
    contributor.range_m = sensor->range_min_m + (most_m - sensor->range_min_m) * uniform[0];
    contributor.range_rate_mps =
        sensor->unambiguous_middle_mps + sensor->false_alarm_range_rate_mps * (2 * uniform[2] - 1);
    return contributor;
}

void false_alarm_cells_draw_elevation(const struct frame *frame, const struct sensor *sensor,
                                      struct contributor *alarm)
{
    if (sensor->elevation_view_rad == 0)
        return;
    struct random_address address =
        frame_draw_address_of(frame, sensor->name, false_alarm_cells_contributor(0).id);
    double uniform[4];
    random_uniform(&address, RANDOM_ELEVATION, (uint32_t)alarm->id.number, uniform);
    alarm->elevation_rad = sensor->elevation_view_rad * (uniform[0] - 0.5);
    alarm->present |= VALUE_ELEVATION;
}

struct cell false_alarm_cells_cell(const struct sensor *sensor,
                                   const struct contributor *contributor, double amplitude,
                                   struct arena *arena)
{
    struct cell cell = {
        .sensor = sensor->name,
        .range_m = contributor->range_m,
        .azimuth_rad = contributor->azimuth_rad,
        .elevation_rad = contributor->elevation_rad,
        .range_rate_mps = contributor->range_rate_mps,
        .amplitude = amplitude,
        .sum_re = amplitude,
        .effects = EFFECT_BIT(EFFECT_FALSE_ALARMS),
        .present = contributor->present,
    };
    *list_add(&cell.members, arena) = *contributor;
    return cell;
}

double false_alarm_cells_amplitude(double threshold, double noise_sigma, double uniform)
{
    return elementary_hypot(threshold, noise_sigma * sqrt(-elementary_log(uniform)));
}

struct cell_span false_alarm_cells_of(struct frame *frame, const struct effect_scan *context)
{
    const struct sensor *sensor = context->sensor;
    const struct sensor_view *view = frame_view(frame, sensor->name);
    struct random_address address =
        frame_draw_address_in(context->address, false_alarm_cells_contributor(0).id);
    double uniform[4];
    if (!effect_simulates(context, EFFECT_FALSE_ALARMS) || view == NULL || !view->measured)
        return (struct cell_span){0};
    random_uniform(&address, RANDOM_FALSE_ALARMS, 0, uniform);
    size_t count = (size_t)random_poisson(sensor->false_alarms, uniform[0]);
    struct cell *cells = arena_get(frame->arena, (count + 1) * sizeof *cells);
    for (size_t i = 0; i < count; i++) {
        random_uniform(&address, RANDOM_FALSE_ALARMS, (uint32_t)i + 1, uniform);
        struct contributor contributor = draw_contributor(sensor, (int64_t)i + 1, uniform);
        contributor.time_s = context->time_s;
        false_alarm_cells_draw_elevation(frame, sensor, &contributor);
        double amplitude =
            false_alarm_cells_amplitude(sensor->threshold, sensor->search_sigma, uniform[3]);
        cells[i] = false_alarm_cells_cell(sensor, &contributor, amplitude, frame->arena);
    }
    if (count > 0)
        frame_count_echoes(frame, sensor->name, PATH_FALSE_ALARM, (int64_t)count);
    return (struct cell_span){cells, count};
}
