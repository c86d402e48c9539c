/* Ground clutter (MODEL 14.13). Points on the ground are echoes of the reflector "ground" of the
 * object "clutter", which is no object of the frame, with numbers from 1. */
#include "effects/effect.h"

#include "base/elementary.h"
#include "base/random.h"
#include "propagation/ground_return.h"

/* The ground is divided into rings, from the sensor's greatest range inwards. The inner radius of a
 * ring is this part of its outer one; the last ring reaches in to the sensor's least range. */
#define RING_PART 0.7071067811865476 /* power changes by 6 dB in a ring at 40 dB a decade */
#define RINGS 16

/* A ring ends where its remaining points together have less than this part of the threshold. */
#define FAINTEST 0.1

static bool described(const struct effect_scan *scan)
{
    const struct conditions *conditions = &scan->frame->conditions;
    const struct sensor_view *view = frame_view(scan->frame, scan->sensor->name);
    return conditions->clutter_per_m2 > 0 && conditions->clutter_ercs > 0 && view != NULL &&
           view->measured && frame_has_objects(scan->frame);
}

struct ring {
    double near_m, far_m;
    double mean;        /* mean number of points */
    double least_power; /* of a point with all weaker ones, over the mean power of a point */
};

static struct ring ring_between(const struct effect_scan *scan, double per_m2, double near_m,
                                double far_m)
{
    const struct sensor *sensor = scan->sensor;
    double amplitude = scan->frame->conditions.clutter_ercs *
                       radar_greatest_amplitude(&sensor->amplitude_law, near_m, far_m);
    double faintest = FAINTEST * sensor->threshold / amplitude;
    return (struct ring){near_m, far_m,
                         per_m2 * ground_return_area_m2(near_m, far_m, sensor->field_of_view_rad),
                         faintest * faintest};
}

/* Draws a place, uniform over the ring. */
static struct echo point_at(const struct effect_scan *scan, const struct ring *ring,
                            const struct sensor_pose *pose, const double uniform[2])
{
    double azimuth_rad = scan->sensor->field_of_view_rad * (uniform[1] - 0.5);
    return (struct echo){
        .sensor = scan->sensor->name,
        .id.object = "clutter",
        .id.reflector = "ground",
        .id.path = PATH_CLUTTER,
        .range_m = ground_return_range_m(ring->near_m, ring->far_m, uniform[0]),
        .azimuth_rad = azimuth_rad,
        .range_rate_mps =
            ground_return_range_rate_mps(pose->velocity_mps, pose->boresight, azimuth_rad),
        .time_s = scan->time_s,
        .effects = EFFECT_BIT(EFFECT_CLUTTER),
    };
}

/* Sets the elevation of a point on the ground, whose range is that in the plane. */
static void set_elevation(const struct sensor *sensor, struct echo *point)
{
    point->elevation_rad = elementary_atan2(-sensor->mount_z_m, point->range_m);
    point->present |= VALUE_ELEVATION;
}

/* Adds the points of a ring, the strongest first. share is the part of all points that are stronger
 * than the present one. Powers are exponential, so -ln(share) is its power over the mean, and all
 * weaker points have 1 - share + share ln(share) of the whole power. */
static void add_ring(const struct effect_scan *scan, const struct ring *ring, int64_t number,
                     const struct sensor_pose *pose, struct effect_echoes *echoes)
{
    struct random_address address = scan->address;
    address.item = (uint64_t)number;
    double waited = 0;
    for (uint32_t rank = 0;; rank++) {
        double uniform[4];
        random_uniform(&address, effect_clutter.purposes[0], rank, uniform);
        waited -= elementary_log(uniform[2]);
        double share = waited / ring->mean;
        if (!(share < 1))
            return;
        double power = -elementary_log(share);
        if (power + ring->mean * (1 - share - share * power) < ring->least_power)
            return;
        struct echo point = point_at(scan, ring, pose, uniform);
        point.id.number = number + RINGS * (int64_t)rank;
        point.ercs = scan->frame->conditions.clutter_ercs * sqrt(power);
        if (scan->sensor->elevation_view_rad > 0)
            set_elevation(scan->sensor, &point);
        effect_add(scan, echoes, &point);
    }
}

/* Mean number of points per m2 in this scan. With overdispersion it is a gamma variate, so that the
 * number of points is negative binomial; without, that number is Poisson. */
static double density_per_m2(const struct effect_scan *scan)
{
    const struct conditions *conditions = &scan->frame->conditions;
    double more = conditions->clutter_overdispersion - 1;
    if (!(more > 0))
        return conditions->clutter_per_m2;
    const struct sensor *sensor = scan->sensor;
    double area_m2 =
        ground_return_area_m2(sensor->range_min_m, sensor->range_max_m, sensor->field_of_view_rad);
    struct random_sequence sequence = random_sequence_at(scan->address, effect_clutter.purposes[0]);
    return random_gamma(&sequence, conditions->clutter_per_m2 * area_m2 / more) * more / area_m2;
}

static void add_echoes(const struct effect_scan *scan, struct effect_echoes *echoes)
{
    struct sensor_pose pose = effect_sensor_pose(scan);
    double per_m2 = density_per_m2(scan);
    double least_m = scan->sensor->range_min_m;
    double far_m = scan->sensor->range_max_m;
    for (int64_t number = 1; number <= RINGS && far_m > least_m; number++) {
        double near_m = number < RINGS ? elementary_max(least_m, RING_PART * far_m) : least_m;
        struct ring ring = ring_between(scan, per_m2, near_m, far_m);
        add_ring(scan, &ring, number, &pose, echoes);
        far_m = near_m;
    }
}

const struct effect effect_clutter = {
    .summary = "the ground and what stands on it make echoes",
    .cause = "clutter_per_m2 and clutter_ercs of the conditions",
    .left_out_when = "clutter_per_m2 or clutter_ercs is 0, or the frame has no objects",
    .cost = "a draw per point on the ground that is not too weak",
    .home = EFFECT_HOME_SENSOR,
    .reads = PART_OBJECTS,
    .members = {{EFFECT_CONDITION(clutter_per_m2), {5, 0.2, EFFECT_BY_LOGARITHM, 1e-5, 3e-3}},
                {EFFECT_CONDITION(clutter_ercs), {6, 0, EFFECT_BY_LOGARITHM, 0.01, 1}},
                {EFFECT_CONDITION(clutter_overdispersion), {7, 0, EFFECT_EVENLY, 0, 4}}},
    .purposes = {13}, /* per scan: number and places of the points */
    .described = described,
    .add_echoes = add_echoes,
};
