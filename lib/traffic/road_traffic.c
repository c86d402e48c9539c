#include "traffic/road_traffic.h"

#include <inttypes.h>

#include "base/elementary.h"
#include "base/hash.h"
#include "base/random.h"
#include "documents/vehicle.h"

#define STEP_S ROAD_TRAFFIC_STEP_S
#define PATIENCE_S 21600.0

static double time_of(const struct road_traffic *traffic)
{
    return (double)traffic->step * STEP_S;
}

/* ---- arrivals ---- */

static const struct road_arrivals *draw_arrivals(const struct road_queue *queue,
                                                 struct random_sequence *sequence)
{
    const struct road_arrivals *arrivals = queue->lane->arrivals.items;
    const struct road_arrivals *last = arrivals + queue->lane->arrivals.count - 1;
    double left = random_sequence_next(sequence) * queue->flow_per_h;
    while (arrivals < last && left >= arrivals->flow_per_h)
        left -= arrivals++->flow_per_h;
    return arrivals;
}

/* Draws arrival number next_number of a lane. */
static void draw_next(const struct road_traffic *traffic, struct road_queue *queue)
{
    struct random_address address = traffic->address;
    address.sensor = hash_text(HASH_START, queue->road->id);
    address.frame = queue->number;
    address.item = (uint64_t)queue->next_number;
    struct random_sequence sequence = random_sequence_at(address, RANDOM_ARRIVALS);
    queue->next_s -= elementary_log(random_sequence_next(&sequence)) * 3600 / queue->flow_per_h;
    if (!(queue->flow_per_h > 0))
        return;
    const struct road_arrivals *arrivals = draw_arrivals(queue, &sequence);
    double limit_mps = queue->lane->limit_mps, share[5];
    for (int i = 0; i < 5; i++)
        share[i] = 1 + arrivals->spread * random_sequence_between(&sequence, -1, 1);
    queue->next = (struct road_vehicle){
        .id = arena_format(traffic->arena, "%s.%zu.%" PRId64, queue->road->id, queue->number,
                           queue->next_number),
        .arrivals = arrivals,
        .size = share[0],
        .length_m = share[0] * arrivals->length_m,
        .driver = {share[1] * elementary_min(arrivals->speed_mps, limit_mps),
                   share[2] * arrivals->headway_s, arrivals->gap_m,
                   share[3] * arrivals->acceleration_mps2, share[4] * arrivals->deceleration_mps2},
        .front_m = share[0] * arrivals->length_m,
    };
}

/* ---- driving ---- */

double road_traffic_acceleration_mps2(const struct road_driver *driver, double speed_mps,
                                      double gap_m, double leader_mps)
{
    double braking_mps2 = sqrt(driver->acceleration_mps2 * driver->deceleration_mps2);
    double wanted_m =
        speed_mps * driver->headway_s + speed_mps * (speed_mps - leader_mps) / (2 * braking_mps2);
    double closeness = (driver->gap_m + elementary_max(0, wanted_m)) / gap_m;
    double share = speed_mps / driver->speed_mps;
    return driver->acceleration_mps2 * (1 - share * share * share * share - closeness * closeness);
}

void road_traffic_move(double *place_m, double *speed_mps, double acceleration_mps2,
                       double duration_s)
{
    double end_mps = *speed_mps + acceleration_mps2 * duration_s;
    if (end_mps >= 0)
        *place_m += (*speed_mps + end_mps) / 2 * duration_s;
    else
        *place_m += *speed_mps * *speed_mps / (-2 * acceleration_mps2);
    *speed_mps = elementary_max(0, end_mps);
}

static bool is_red(const struct road_signal *signal, double time_s)
{
    double cycle_s = signal->green_s + signal->red_s, since_s = time_s + signal->offset_s;
    return cycle_s > 0 && since_s - floor(since_s / cycle_s) * cycle_s >= signal->green_s;
}

/* Acceleration of a vehicle behind a leader (or NULL) and before the lane's signals. */
static double acceleration_mps2(const struct road_traffic *traffic, const struct road_queue *queue,
                                const struct road_vehicle *vehicle,
                                const struct road_vehicle *leader)
{
    const struct road_driver *driver = &vehicle->driver;
    double speed_mps = vehicle->speed_mps;
    double gap_m =
        leader != NULL ? leader->front_m - leader->length_m - vehicle->front_m : (double)INFINITY;
    double least_mps2 = road_traffic_acceleration_mps2(
        driver, speed_mps, gap_m, leader != NULL ? leader->speed_mps : speed_mps);
    for (size_t i = 0; i < queue->lane->signals.count; i++) {
        const struct road_signal *signal = &queue->lane->signals.items[i];
        double stop_m = signal->at_m - vehicle->front_m;
        if (stop_m >= 0 && speed_mps * speed_mps <= 4 * driver->deceleration_mps2 * stop_m &&
            is_red(signal, time_of(traffic)))
            least_mps2 = elementary_min(
                least_mps2, road_traffic_acceleration_mps2(driver, speed_mps, stop_m, 0));
    }
    return least_mps2;
}

/* Lets the next arrival in if its time has come and it need not brake harder than is comfortable,
 * at its wanted speed or at that of the last vehicle. */
static void enter(const struct road_traffic *traffic, struct road_queue *queue)
{
    const struct road_vehicle *last =
        queue->vehicles.count > 0 ? &queue->vehicles.items[queue->vehicles.count - 1] : NULL;
    struct road_vehicle *next = &queue->next;
    const struct road_driver *driver = &next->driver;
    if (queue->next_s > time_of(traffic) ||
        (last != NULL && last->front_m - last->length_m - next->front_m < driver->gap_m))
        return;
    next->speed_mps = driver->speed_mps;
    next->acceleration_mps2 = acceleration_mps2(traffic, queue, next, last);
    if (next->acceleration_mps2 < -driver->deceleration_mps2 && last != NULL) {
        next->speed_mps = elementary_min(driver->speed_mps, last->speed_mps);
        next->acceleration_mps2 = acceleration_mps2(traffic, queue, next, last);
    }
    if (next->acceleration_mps2 < -driver->deceleration_mps2)
        return;
    *list_add(&queue->vehicles, traffic->arena) = *next;
    queue->next_number++;
    draw_next(traffic, queue);
}

static void drive(struct road_traffic *traffic, struct road_queue *queue)
{
    struct road_vehicle *vehicles = queue->vehicles.items;
    size_t left = 0;
    for (size_t i = 0; i < queue->vehicles.count; i++) {
        struct road_vehicle *vehicle = &vehicles[i];
        double from_m = vehicle->front_m, half_m = vehicle->length_m / 2;
        double ego_m = vehicle->arrivals->ego_m;
        road_traffic_move(&vehicle->front_m, &vehicle->speed_mps, vehicle->acceleration_mps2,
                          STEP_S);
        if (vehicle->front_m >= queue->path.length_m)
            left++;
        else if (traffic->awaited != NULL && ego_m >= 0 && from_m - half_m < ego_m &&
                 vehicle->front_m - half_m >= ego_m) {
            vehicle->id = traffic->awaited;
            traffic->awaited = NULL;
        }
    }
    queue->vehicles.count -= left;
    if (left > 0)
        memmove(vehicles, vehicles + left, queue->vehicles.count * sizeof *vehicles);
}

static void step(struct road_traffic *traffic)
{
    traffic->step++;
    for (size_t i = 0; i < traffic->queues.count; i++) {
        struct road_queue *queue = &traffic->queues.items[i];
        drive(traffic, queue);
        struct road_vehicle *vehicles = queue->vehicles.items;
        for (size_t k = 0; k < queue->vehicles.count; k++)
            vehicles[k].acceleration_mps2 =
                acceleration_mps2(traffic, queue, &vehicles[k], k > 0 ? &vehicles[k - 1] : NULL);
        enter(traffic, queue);
    }
}

/* ---- the beginning ---- */

/* Sets the sizes that arrivals leave to their class, and sums the flows. */
static int find_arrivals(struct road_queue *queue, struct arena *arena, struct diag *diag)
{
    for (size_t i = 0; i < queue->lane->arrivals.count; i++) {
        struct road_arrivals *arrivals = &queue->lane->arrivals.items[i];
        const struct vehicle *vehicle = vehicle_load(arrivals->class, NULL, arena, diag);
        if (vehicle == NULL)
            return diag_prefix(diag, "arrivals[%zu].class: ", i);
        const double own_m[] = {vehicle->length_m, vehicle->width_m, vehicle->height_m};
        double *sizes_m[] = {&arrivals->length_m, &arrivals->width_m, &arrivals->height_m};
        for (int k = 0; k < 3; k++)
            *sizes_m[k] = *sizes_m[k] > 0 ? *sizes_m[k] : own_m[k];
        queue->flow_per_h += arrivals->flow_per_h;
    }
    return 0;
}

/* Greatest distance of a vehicle's corner from the lane's middle: sqrt((r + w/2)^2 + (L/2)^2) - r
 * for a box of length L and width w on an arc of radius r. */
static double reach_m(const struct road_queue *queue)
{
    double reach_m = 0;
    for (size_t i = 0; i < queue->lane->arrivals.count; i++) {
        const struct road_arrivals *arrivals = &queue->lane->arrivals.items[i];
        double half_m = arrivals->length_m * (1 + arrivals->spread) / 2;
        double aside_m = arrivals->width_m * (1 + arrivals->spread) / 2;
        double side_m = queue->path.radius_m + aside_m;
        double swing_m = half_m * half_m / (side_m + sqrt(side_m * side_m + half_m * half_m));
        reach_m = elementary_max(reach_m, aside_m + swing_m);
    }
    return reach_m;
}

/* Refuses a lane whose vehicles could touch those of an earlier lane of its road. */
static int check_beside(const struct road_traffic *traffic, const struct road_queue *queue,
                        struct diag *diag)
{
    for (const struct road_queue *other = traffic->queues.items; other < queue; other++) {
        double apart_m = fabs(queue->lane->offset_m - other->lane->offset_m);
        double needed_m = reach_m(queue) + reach_m(other);
        if (other->road == queue->road && apart_m <= needed_m)
            return diag_fail(diag, DIAG_CONFIG,
                             "offset_m: %g m beside lanes[%zu], where vehicles need %.2f m",
                             apart_m, other->number, needed_m);
    }
    return 0;
}

static int add_lane(struct road_traffic *traffic, const struct roadway *road, size_t number,
                    struct diag *diag)
{
    struct road_lane *lane = &road->lanes.items[number];
    struct road_queue *queue = list_add(&traffic->queues, traffic->arena);
    *queue = (struct road_queue){.road = road, .lane = lane, .number = number};
    if (find_arrivals(queue, traffic->arena, diag) != 0 ||
        road_path_make(&queue->path, road, lane, traffic->arena, diag) != 0 ||
        check_beside(traffic, queue, diag) != 0)
        return diag_prefix(diag, "lanes[%zu].", number);
    draw_next(traffic, queue);
    return 0;
}

int road_traffic_begin(struct road_traffic *traffic, const struct roadway *roads, size_t count,
                       double warmup_s, const char *ego, struct random_address address,
                       struct arena *arena, struct diag *diag)
{
    *traffic = (struct road_traffic){.address = address, .arena = arena};
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < roads[i].lanes.count; k++)
            if (add_lane(traffic, &roads[i], k, diag) != 0)
                return diag_prefix(diag, "roads[%zu].", i);
    while (time_of(traffic) < warmup_s)
        step(traffic);
    traffic->awaited = ego;
    while (traffic->awaited != NULL && time_of(traffic) < warmup_s + PATIENCE_S)
        step(traffic);
    traffic->begin = traffic->step;
    return traffic->awaited == NULL
               ? 0
               : diag_fail(diag, DIAG_CONFIG,
                           "roads: no vehicle passes the ego_m of its arrivals within six hours");
}

/* ---- the present ---- */

void road_traffic_advance(struct road_traffic *traffic, double time_s)
{
    while ((double)(traffic->step + 1 - traffic->begin) * STEP_S <= time_s)
        step(traffic);
    traffic->within_s = time_s - (double)(traffic->step - traffic->begin) * STEP_S;
}

bool road_traffic_has(const struct road_traffic *traffic, const char *id)
{
    bool has = false;
    for (size_t i = 0; i < traffic->queues.count; i++)
        for (size_t k = 0; k < traffic->queues.items[i].vehicles.count && !has; k++)
            has = strcmp(traffic->queues.items[i].vehicles.items[k].id, id) == 0;
    return has;
}

static struct object object_of(const struct road_queue *queue, const struct road_vehicle *vehicle,
                               double within_s)
{
    double front_m = vehicle->front_m, speed_mps = vehicle->speed_mps;
    road_traffic_move(&front_m, &speed_mps, vehicle->acceleration_mps2, within_s);
    struct motion motion =
        road_path_motion(&queue->path, front_m - vehicle->length_m / 2, speed_mps);
    return frame_object_in((struct object){.id = vehicle->id,
                                           .class = vehicle->arrivals->class,
                                           .length_m = vehicle->length_m,
                                           .width_m = vehicle->size * vehicle->arrivals->width_m,
                                           .height_m = vehicle->size * vehicle->arrivals->height_m,
                                           .travelled_m = front_m - vehicle->length_m},
                           motion);
}

void road_traffic_fill(const struct road_traffic *traffic, struct frame *frame)
{
    for (size_t i = 0; i < traffic->queues.count; i++) {
        const struct road_queue *queue = &traffic->queues.items[i];
        for (size_t k = 0; k < queue->vehicles.count; k++)
            *list_add(&frame->objects, frame->arena) =
                object_of(queue, &queue->vehicles.items[k], traffic->within_s);
    }
}
