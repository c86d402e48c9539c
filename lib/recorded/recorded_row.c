#include "recorded/recorded_row.h"

#include <math.h>

#include "text/field.h"

const struct recorded_row recorded_row_unsaid = {.yaw_rad = (double)NAN,
                                                 .direction_rad = (double)NAN,
                                                 .vx_mps = (double)NAN,
                                                 .vy_mps = (double)NAN,
                                                 .yaw_rate_radps = (double)NAN,
                                                 .speed_mps = (double)NAN,
                                                 .z_m = (double)NAN,
                                                 .pitch_rad = (double)NAN};

int64_t recorded_row_time_ns(double time, double unit_s)
{
    const double per_unit = unit_s * 1e9;
    double whole = floor(time);
    return (int64_t)whole * (int64_t)per_unit + (int64_t)round((time - whole) * per_unit);
}

/* Divides whole milliseconds, microseconds or nanoseconds, so that the numerator is exact. */
double recorded_row_seconds(int64_t time_ns)
{
    int64_t unit = 1;
    if (time_ns % 1000000 == 0)
        unit = 1000000;
    else if (time_ns % 1000 == 0)
        unit = 1000;
    int64_t whole = time_ns / unit;
    return (double)whole / (1e9 / (double)unit);
}

bool recorded_row_name_fits(const char *name)
{
    size_t length = 0;
    for (; name[length] >= ' ' && name[length] <= '~'; length++)
        continue;
    return length > 0 && length <= FIELD_NAME_SIZE && name[length] == '\0';
}

int64_t recorded_row_instant_ns(int64_t begin_ns, int64_t number, double rate_hz)
{
    uint64_t since_begin = (uint64_t)round((double)number * 1e9 / rate_hz);
    return (int64_t)((uint64_t)begin_ns + since_begin);
}

int recorded_row_refuse_second(const struct recorded_format *format, const char *id,
                               int64_t time_ns, size_t place, size_t other, struct diag *diag)
{
    return diag_fail(diag, DIAG_DATA, "%s %zu: %s %s at %.12g s is in %s %zu already",
                     format->place, place > other ? place : other, format->id_name, id,
                     recorded_row_seconds(time_ns), format->place, place > other ? other : place);
}
