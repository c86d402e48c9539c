#include "plain.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

struct box {
    double x, y, cosine, sine, half_length, half_width, radius, range;
};

struct echo {
    double x, y, range, azimuth, rate, amplitude;
    size_t vehicle;
    bool merged;
};

static const double wavelength_m = 0.0039, ego_mps = 30, threshold = 2;
static const double cell_range_m = 1.79, cell_rate_mps = 0.103;

/* Corners and sides of a vehicle as fractions of half its length and width; each faces away from
 * the centre. */
static const double centres[8][2] = {{1, 1}, {1, -1}, {-1, 1}, {-1, -1},
                                     {1, 0}, {-1, 0}, {0, 1},  {0, -1}};

static struct box box_of(const struct plain_vehicle *vehicle)
{
    struct box box = {.x = vehicle->x_m,
                      .y = vehicle->y_m,
                      .cosine = cos(vehicle->yaw_rad),
                      .sine = sin(vehicle->yaw_rad),
                      .half_length = vehicle->length_m / 2,
                      .half_width = vehicle->width_m / 2};
    box.radius = hypot(box.half_length, box.half_width);
    box.range = hypot(box.x, box.y);
    return box;
}

static bool faces(const struct box *box, const double *place, double x, double y)
{
    double u = box->cosine * place[0] - box->sine * place[1];
    double v = box->sine * place[0] + box->cosine * place[1];
    return u * x + v * y < 0;
}

/* True if the line from the radar to (x, y) crosses the box; by slabs, in the box's own frame. */
static bool crosses(const struct box *box, double x, double y)
{
    double from[2] = {-box->cosine * box->x - box->sine * box->y,
                      box->sine * box->x - box->cosine * box->y};
    double way[2] = {box->cosine * x + box->sine * y, -box->sine * x + box->cosine * y};
    double half[2] = {box->half_length, box->half_width}, enter = 0, leave = 1;
    for (int axis = 0; axis < 2; axis++) {
        double a = (-half[axis] - from[axis]) / way[axis];
        double b = (half[axis] - from[axis]) / way[axis];
        enter = fmax(enter, fmin(a, b));
        leave = fmin(leave, fmax(a, b));
    }
    return enter < leave;
}

static bool hidden(const struct box *boxes, size_t count, const struct echo *echo)
{
    for (size_t i = 0; i < count; i++)
        if (i != echo->vehicle && boxes[i].range - boxes[i].radius < echo->range &&
            crosses(&boxes[i], echo->x, echo->y))
            return true;
    return false;
}

/* Sum pattern of two apertures side by side. */
static double gain(double azimuth)
{
    double phase = 6.9 * sin(azimuth);
    return phase == 0 ? 1 : fabs(sin(phase) / phase);
}

static struct echo echo_of(const struct plain_vehicle *vehicle, const struct box *box,
                           const double *place, size_t index)
{
    double along = place[0] * box->half_length, across = place[1] * box->half_width;
    struct echo echo = {.x = box->x + box->cosine * along - box->sine * across,
                        .y = box->y + box->sine * along + box->cosine * across,
                        .vehicle = index};
    echo.range = hypot(echo.x, echo.y);
    echo.azimuth = atan2(echo.y, echo.x);
    double u = vehicle->speed_mps * box->cosine - ego_mps, v = vehicle->speed_mps * box->sine;
    echo.rate = (u * echo.x + v * echo.y) / echo.range;
    echo.amplitude = 2e5 * gain(echo.azimuth) / (echo.range * echo.range);
    return echo;
}

static int stronger(const void *a, const void *b)
{
    double left = ((const struct echo *)a)->amplitude, right = ((const struct echo *)b)->amplitude;
    return (left < right) - (left > right);
}

/* The target of a cell: pointers of both channels added up, and the angle by their ratio. */
static struct plain_target cell_of(struct echo *echoes, size_t count, size_t leader)
{
    double sum_re = 0, sum_im = 0, delta_re = 0, delta_im = 0;
    for (size_t i = leader; i < count; i++) {
        struct echo *echo = &echoes[i];
        if (echo->merged || fabs(echo->range - echoes[leader].range) > cell_range_m / 2 ||
            fabs(echo->rate - echoes[leader].rate) > cell_rate_mps / 2)
            continue;
        echo->merged = true;
        double phase = fmod(4 * 3.141592653589793 * echo->range / wavelength_m, 6.283185307179586);
        double re = echo->amplitude * cos(phase), im = echo->amplitude * sin(phase);
        double slope = tan(6.9 * sin(echo->azimuth));
        sum_re += re;
        sum_im += im;
        delta_re += slope * re;
        delta_im += slope * im;
    }
    double power = sum_re * sum_re + sum_im * sum_im;
    double ratio = (delta_re * sum_re + delta_im * sum_im) / power;
    return (struct plain_target){echoes[leader].range, asin(atan(ratio) / 6.9), echoes[leader].rate,
                                 sqrt(power)};
}

size_t plain_targets(const struct plain_vehicle *vehicles, size_t count,
                     struct plain_target *targets)
{
    struct box boxes[64];
    struct echo echoes[PLAIN_CENTRES];
    size_t facing = 0, seen = 0, made = 0;
    for (size_t i = 0; i < count; i++)
        boxes[i] = box_of(&vehicles[i]);
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 8 && facing < PLAIN_CENTRES; c++) {
            if (!faces(&boxes[i], centres[c], boxes[i].x, boxes[i].y))
                continue;
            facing++;
            struct echo echo = echo_of(&vehicles[i], &boxes[i], centres[c], i);
            if (!hidden(boxes, count, &echo))
                echoes[seen++] = echo;
        }
    qsort(echoes, seen, sizeof echoes[0], stronger);
    for (size_t i = 0; i < seen; i++)
        if (!echoes[i].merged && echoes[i].amplitude >= threshold)
            targets[made++] = cell_of(echoes, seen, i);
    return made;
}
