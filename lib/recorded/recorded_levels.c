#include "recorded/recorded_levels.h"

#include "base/sort.h"

static const double LINK_M = 1.5, BEND_M = 600, STEEP = 0.12, KEPT_M = 5, LEAST_RUN_M = 0.5,
                    STEEPEST_RAD = 1.5;

/* A body, by its distance from the ego. */
struct other {
    double distance_m;
    size_t number;
};

/* ---- two bodies ---- */

/* The rise on the way that the slope at the body's place makes, and the weight of this. */
struct rise {
    double rise_m, weight;
};

static struct rise rise_of(const struct recorded_level *body, struct vec2 way_m)
{
    double along_m = vec2_dot(body->heading, way_m), way2_m2 = vec2_dot(way_m, way_m);
    if (isnan(body->slope) || way2_m2 == 0)
        return (struct rise){0, 0};
    return (struct rise){body->slope * along_m, along_m * along_m / way2_m2};
}

/* How far a body is above or below the road on which another body is; and how far it could be for
 * want of known slopes, on a road as steep as there are. */
struct apart {
    double apart_m, unknown_m;
};

static struct apart apart_of(const struct recorded_level *one, const struct recorded_level *other)
{
    struct vec2 way_m = vec2_sub(other->place_m, one->place_m);
    struct rise from = rise_of(one, way_m), to = rise_of(other, way_m);
    double weight = from.weight + to.weight;
    double mean_m = 0, half_m = 0;
    if (weight > 0) {
        mean_m = (from.weight * from.rise_m + to.weight * to.rise_m) / weight;
        half_m = elementary_min(from.weight, to.weight) / weight * fabs(from.rise_m - to.rise_m);
    }
    double above_m = other->z_m - (one->z_m + one->tall_m) - (mean_m + half_m);
    double below_m = one->z_m - (other->z_m + other->tall_m) + (mean_m - half_m);
    double unknown_m = STEEP * vec2_length(way_m) * elementary_max(1 - weight, 0);
    return (struct apart){elementary_max(above_m, below_m), unknown_m};
}

/* ---- all bodies ---- */

static int compare_distances(const void *a, const void *b)
{
    const struct other *one = a, *other = b;
    return (one->distance_m > other->distance_m) - (one->distance_m < other->distance_m);
}

/* Whether the bodies on the ego's road, whose numbers these are, lead to this one. */
static bool is_led_to(const struct recorded_level *bodies, const size_t *members, size_t count,
                      const struct recorded_level *body)
{
    double nearest_m2 = (double)INFINITY;
    struct apart nearest = {0};
    for (size_t i = 0; i < count; i++) {
        const struct recorded_level *member = &bodies[members[i]];
        struct vec2 way_m = vec2_sub(body->place_m, member->place_m);
        double way_m2 = vec2_dot(way_m, way_m), bend_m = way_m2 / (4 * BEND_M);
        struct apart apart = apart_of(member, body);
        if (apart.apart_m > RECORDED_LEVELS_MOST_M + bend_m + apart.unknown_m)
            return false;
        if (way_m2 >= nearest_m2)
            continue;
        nearest_m2 = way_m2;
        nearest = apart;
    }
    return nearest.apart_m <= LINK_M + elementary_min(nearest.unknown_m, LINK_M);
}

void recorded_levels_mark(const struct recorded_level *bodies, size_t count, size_t ego, bool *on,
                          struct arena *arena)
{
    LIST_OF(struct other) others = {0};
    size_t *members = arena_room(arena, count * sizeof *members), member_count = 0;
    members[member_count++] = ego;
    for (size_t i = 0; i < count; i++) {
        on[i] = i == ego || isnan(bodies[i].z_m) || isnan(bodies[ego].z_m);
        if (on[i])
            continue;
        struct vec2 way_m = vec2_sub(bodies[i].place_m, bodies[ego].place_m);
        *list_add(&others, arena) = (struct other){vec2_length(way_m), i};
    }
    sort_list(&others, compare_distances, arena);
    for (size_t i = 0; i < others.count; i++) {
        size_t number = others.items[i].number;
        const struct recorded_level *body = &bodies[number];
        on[number] = apart_of(&bodies[ego], body).apart_m <= RECORDED_LEVELS_MOST_M ||
                     is_led_to(bodies, members, member_count, body);
        if (on[number] && body->tall_m == 0)
            members[member_count++] = number;
    }
}

/* ---- slopes ---- */

struct recorded_climb recorded_levels_climb(struct recorded_climb climb, double run_m,
                                            double rise_m)
{
    double way_m = fabs(run_m), kept = elementary_exp(-way_m / KEPT_M);
    if (run_m < 0)
        rise_m = -rise_m;
    return (struct recorded_climb){kept * climb.rise_m + rise_m, kept * climb.run_m + way_m};
}

double recorded_levels_slope(struct recorded_climb climb)
{
    return climb.run_m < LEAST_RUN_M ? (double)NAN : climb.rise_m / climb.run_m;
}

double recorded_levels_pitched(double pitch_rad)
{
    bool known = pitch_rad != 0 && fabs(pitch_rad) < STEEPEST_RAD;
    return known ? elementary_sin(pitch_rad) / elementary_cos(pitch_rad) : (double)NAN;
}
