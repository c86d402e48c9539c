/* One scene, described in two ways: every coordinate one unit in the last place off, turned,
 * mirrored, in UTM coordinates, in the axes of the ego, with a strip more that lies out of sight,
 * or with parked cars that creep at 1e-12 m/s. Scenes have a roadside (MODEL 14.23), slow wheels
 * and limbs (14.11, 14.12), or parked cars with ghosts (14.1).
 *
 * A row says how many lists changed. That many may that have a margin (11.1) as small as what the
 * other description carries the decision; every changed list is one of these. The plain form of
 * the roadside numbers scatterers through all strips, whose cells are a ceil of a rounded length;
 * that of wheels and limbs adds echoes wherever a rounded speed is not 0; that of ghosts has the
 * azimuth of departure as a difference and divides by the antenna's gain of the arrival, so that
 * the levels of a path and of its reverse differ in the last digit. */
#include "lists.h"

#include "base/units.h"
#include "base/vec2.h"

enum { SCENES = 300 };

/* Suites that have micro_motion. The second turns echoes by the phases of their paths: where they
 * cancel, 1e-12 m carry an amplitude by 1e-7 dB. */
static const struct {
    const char *name;
    double threshold_carry;
} suites[] = {{"lrr77-full", 1}, {"radarscenes77-full", 1e3}};
enum { SUITES = sizeof suites / sizeof *suites };

/* What a description changes in a frame. */
enum change {
    CREEPING,
    FAR_STRIP,
    LAST_PLACE,
    QUARTER_TURN,
    TURNED,
    MIRRORED,
    UTM,
    EGO_AXES,
    CHANGES
};

/* What a scene has, and whose echoes are counted. */
enum subject { PARKED_CARS, ROADSIDE, SLOW_PARTS };

/* UTM coordinates are multiples of 9.3e-10 m; others are at most 1e3 m. */
static const struct {
    const char *name;
    double carry;
} changes[CHANGES] = {
    [CREEPING] = {"parked cars creep at 1e-12 m/s", 0},
    [FAR_STRIP] = {"a strip out of sight is one ulp longer", 0},
    [LAST_PLACE] = {"each coordinate one ulp off", 1},
    [QUARTER_TURN] = {"turned by 90 degrees", 4},
    [TURNED] = {"turned by any angle", 4},
    [MIRRORED] = {"mirrored", 4},
    [UTM] = {"in UTM coordinates", 4e3},
    [EGO_AXES] = {"in the axes of the ego", 4},
};

struct bench {
    struct runs runs;
    struct suite suite, moved; /* moved: with mirrored mounts where the scene is mirrored */
    enum change change;
    enum subject subject;
    struct carry carry;
    double lists, changed, near, plain;
    double seen; /* echoes of the subject */
    double
        farthest; /* of all changed lists, from the border of a decision, in units of its bound */
};

static int make_bench(void **state)
{
    return make_runs(sizeof(struct bench), state);
}

/* Other descriptions. */

/* The scene is mirrored at the x axis, turned, and shifted, in this order. */
struct description {
    bool mirrored;
    double angle_rad;
    struct vec2 heading, shift_m;
};

static struct vec2 turned(const struct description *as, double x, double y)
{
    return vec2_turn((struct vec2){x, as->mirrored ? -y : y}, as->heading);
}

static struct vec2 placed(const struct description *as, double x_m, double y_m)
{
    return vec2_add(turned(as, x_m, y_m), as->shift_m);
}

static void describe_object(const struct description *as, struct object *object)
{
    struct vec2 place_m = placed(as, object->x_m, object->y_m);
    struct vec2 velocity_mps = turned(as, object->vx_mps, object->vy_mps);
    double side = as->mirrored ? -1 : 1;
    object->x_m = place_m.x;
    object->y_m = place_m.y;
    object->vx_mps = velocity_mps.x;
    object->vy_mps = velocity_mps.y;
    object->yaw_rad = remainder(side * object->yaw_rad + as->angle_rad, 2 * PI);
    object->yaw_rate_radps *= side;
}

static void describe_strip(const struct description *as, struct roadside_strip *strip)
{
    struct vec2 from_m = placed(as, strip->from_x_m, strip->from_y_m);
    struct vec2 to_m = placed(as, strip->to_x_m, strip->to_y_m);
    strip->from_x_m = from_m.x;
    strip->from_y_m = from_m.y;
    strip->to_x_m = to_m.x;
    strip->to_y_m = to_m.y;
}

static struct description description_of(enum change change, const struct frame *frame,
                                         uint64_t *coin)
{
    const struct object *ego = frame_object(frame, frame->ego);
    struct description as = {.heading = {1, 0}};
    double any_rad = sample_between(coin, -PI, PI);
    as.mirrored = change == MIRRORED;
    if (change == QUARTER_TURN)
        as.angle_rad = PI / 2;
    if (change == TURNED)
        as.angle_rad = any_rad;
    if (change == EGO_AXES)
        as.angle_rad = -ego->yaw_rad;
    as.heading = change == QUARTER_TURN ? (struct vec2){0, 1} : vec2_heading(as.angle_rad);
    if (change == EGO_AXES)
        as.shift_m = vec2_scale(-1, turned(&as, ego->x_m, ego->y_m));
    if (change == UTM)
        as.shift_m = (struct vec2){467812.37, 5428051.91};
    return as;
}

/* Zero velocities are such by rounding: they become 1e-18 m/s, to either side. */
static double never_zero(double mps, uint64_t *coin)
{
    double side = sample_bits(coin) % 2 == 0 ? 1e-18 : -1e-18;
    return mps == 0 ? side : mps;
}

/* Reflectors of an object, seen in a mirror, with their names. */
static void mirror_reflectors(struct reflector_set *set, struct arena *arena)
{
    struct reflector_set seen = {.model = set->model, .blocks = set->blocks, .raised = set->raised};
    seen.objects.items = set->objects.items;
    seen.objects.count = seen.objects.room = set->objects.count;
    seen.clearance_m = set->clearance_m;
    for (size_t i = 0; i < set->points.count; i++) {
        struct point_reflector *point = list_add(&seen.points, arena);
        *point = set->points.items[i];
        point->y = -point->y;
        point->facing_rad = -point->facing_rad;
    }
    for (size_t i = 0; i < set->planes.count; i++) {
        const struct plane_reflector *side = &set->planes.items[i];
        struct plane_reflector *plane = list_add(&seen.planes, arena);
        *plane = *side;
        plane->from_x = side->to_x;
        plane->from_y = -side->to_y;
        plane->to_x = side->from_x;
        plane->to_y = -side->from_y;
    }
    for (size_t i = 0; i < set->rows.count; i++) {
        struct post_row *row = list_add(&seen.rows, arena);
        *row = set->rows.items[i];
        row->from_y = -row->from_y;
        row->to_y = -row->to_y;
        row->facing_rad = -row->facing_rad;
    }
    *set = seen;
}

static bool is_parked(const struct frame *frame, const struct object *object)
{
    return object->vx_mps == 0 && object->vy_mps == 0 && strcmp(object->id, frame->ego) != 0;
}

static void creep(struct frame *frame)
{
    for (size_t i = 0; i < frame->objects.count; i++) {
        struct object *object = &frame->objects.items[i];
        struct vec2 velocity_mps = vec2_scale(1e-12, vec2_heading(object->yaw_rad));
        if (!is_parked(frame, object))
            continue;
        object->vx_mps = velocity_mps.x;
        object->vy_mps = velocity_mps.y;
    }
}

static void redescribe(struct bench *bench, struct frame *frame, uint64_t *coin)
{
    struct description as = description_of(bench->change, frame, coin);
    const struct record *object = field_find(&frame_record, "objects", 7)->record;
    bool shaken = bench->change == LAST_PLACE;
    for (size_t i = 0; i < frame->objects.count; i++) {
        struct object *one = &frame->objects.items[i];
        if (bench->change != FAR_STRIP && bench->subject == SLOW_PARTS) {
            one->vx_mps = never_zero(one->vx_mps, coin);
            one->vy_mps = never_zero(one->vy_mps, coin);
        }
        if (shaken)
            move_all(object, one, coin);
        else if (bench->change != FAR_STRIP)
            describe_object(&as, one);
    }
    for (size_t i = 0; i < frame->roadside.count; i++)
        if (shaken)
            move_all(&roadside_strip_record, &frame->roadside.items[i], coin);
        else if (bench->change != FAR_STRIP)
            describe_strip(&as, &frame->roadside.items[i]);
    if (bench->change == FAR_STRIP) {
        struct roadside_strip *far = &frame->roadside.items[0];
        far->to_x_m = nextafter(far->to_x_m, (double)INFINITY);
    }
}

/* Scenes. */

/* A rail of 600 m, 300 m to the left of the ego, as the first strip. */
static void add_far_strip(struct frame *frame)
{
    const struct object *ego = frame_object(frame, frame->ego);
    *list_add(&frame->roadside, frame->arena) = (struct roadside_strip){
        .kind = ROADSIDE_RAIL,
        .from_x_m = ego->x_m - 300,
        .from_y_m = ego->y_m + 300,
        .to_x_m = ego->x_m + 300,
        .to_y_m = ego->y_m + 300,
        .level_db = 2,
    };
}

/* Strips with a width get one of exactly two cells of 4 m. */
static void widen(struct frame *frame)
{
    for (size_t i = 0; i < frame->roadside.count; i++)
        if (frame->roadside.items[i].width_m > 0)
            frame->roadside.items[i].width_m = 8;
}

/* What stands on a strip with a width is drawn from its right border on, and has no mirror image
 * under the same draws. */
static void drop_wide_strips(struct frame *frame)
{
    size_t kept = 0;
    for (size_t i = 0; i < frame->roadside.count; i++)
        if (frame->roadside.items[i].width_m <= 0)
            frame->roadside.items[kept++] = frame->roadside.items[i];
    frame->roadside.count = kept;
}

/* Speeds from none and next to none to those from which wheels and limbs have all of their
 * amplitude. */
static void slow_down(struct frame *frame, uint64_t *coin)
{
    static const double speeds_mps[] = {0, 1e-300, 1e-17, 1e-9, 0.04, 0.06, 0.2, 2};
    for (size_t i = 0; i < frame->objects.count; i++) {
        struct object *object = &frame->objects.items[i];
        double speed_mps = speeds_mps[sample_bits(coin) % 8];
        struct vec2 velocity_mps = vec2_scale(speed_mps, vec2_heading(object->yaw_rad));
        object->vx_mps = velocity_mps.x;
        object->vy_mps = velocity_mps.y;
        object->yaw_rate_radps = 0;
    }
}

/* Every second object stands; the ego drives on. */
static void park(struct frame *frame)
{
    for (size_t i = 0; i < frame->objects.count; i += 2) {
        struct object *object = &frame->objects.items[i];
        if (strcmp(object->id, frame->ego) != 0)
            object->vx_mps = object->vy_mps = object->yaw_rate_radps = 0;
    }
}

static void make_scene(struct bench *bench, int64_t number, struct frame *frame, uint64_t *coin)
{
    random_traffic_fill(&bench->runs.scene, number, frame);
    if (bench->runs.scene.density == &adversarial_traffic_density)
        adversarial_traffic_add(&bench->runs.scene, &bench->suite, number, frame);
    if (bench->change == FAR_STRIP)
        add_far_strip(frame);
    if (bench->subject == PARKED_CARS)
        park(frame);
    if (bench->subject == SLOW_PARTS)
        slow_down(frame, coin);
    if (bench->subject == ROADSIDE) {
        random_traffic_roadside(random_traffic_address(&bench->runs.scene, frame->seed, number),
                                frame);
        widen(frame);
        if (bench->change == MIRRORED)
            drop_wide_strips(frame);
    }
}

static void copy_scene(const struct frame *from, struct frame *to)
{
    to->ego = from->ego;
    for (size_t i = 0; i < from->objects.count; i++)
        *list_add(&to->objects, to->arena) = from->objects.items[i];
    for (size_t i = 0; i < from->roadside.count; i++)
        *list_add(&to->roadside, to->arena) = from->roadside.items[i];
}

/* Comparison. */

/* The number of cells of all strips by the plain ceil. */
static double plain_cells(const struct frame *frame)
{
    double cells = 0;
    for (size_t i = 0; i < frame->roadside.count; i++) {
        struct roadside_grid grid = roadside_grid_of(&frame->roadside.items[i]);
        cells += ceil(grid.length_m / grid.along_m);
    }
    return cells;
}

/* The number of wheels and limbs that a sensor sees move, by the plain test. */
static double plain_movers(const struct frame *frame, const char *sensor)
{
    struct echo_span echoes = frame_echoes_of(frame, sensor);
    double movers = 0;
    for (size_t i = 0; i < echoes.count; i++)
        movers +=
            echoes.items[i].moving_part != MOVING_NONE && echoes.items[i].ground_rate_mps != 0;
    return movers;
}

/* The amplitude of a ghost of an ERCS of 1 at the unit distance, by the difference of azimuths. */
static double plain_level(const struct antenna *antenna, const struct echo *ghost)
{
    double turn_rad = ghost->departure_azimuth_rad - ghost->azimuth_rad;
    double arrival = antenna_gain(antenna, ghost->azimuth_rad);
    double departure = antenna_gain(antenna, ghost->azimuth_rad + turn_rad);
    return sqrt(departure / arrival) * arrival;
}

/* Which ghosts of a sensor are stronger than those of the reverse path by the plain level, as a
 * hash. */
static uint64_t plain_order(const struct frame *frame, const struct sensor *sensor)
{
    struct echo_span echoes = frame_echoes_of(frame, sensor->name);
    uint64_t order = HASH_START;
    for (size_t i = 0; i < echoes.count; i++) {
        struct echo reverse = echoes.items[i];
        if (reverse.id.path != PATH_WALL_OBJECT)
            continue;
        reverse.id.path = PATH_OBJECT_WALL;
        const struct echo *other =
            bsearch(&reverse, echoes.items, echoes.count, sizeof *echoes.items, frame_order_echoes);
        if (other == NULL)
            continue;
        double rise =
            plain_level(&sensor->antenna, &echoes.items[i]) - plain_level(&sensor->antenna, other);
        int sign = (rise > 0) - (rise < 0);
        order = hash_bytes(order, &sign, sizeof sign);
    }
    return order;
}

/* True if the plain form sees another list after than before. */
static bool plain_differs(const struct bench *bench, const struct sensor *sensor)
{
    const struct frame *before = &bench->runs.before.frame, *after = &bench->runs.after.frame;
    switch (bench->subject) {
    case PARKED_CARS:
        return plain_order(before, sensor) != plain_order(after, sensor);
    case ROADSIDE:
        return plain_cells(before) != plain_cells(after);
    case SLOW_PARTS:
        return plain_movers(before, sensor->name) != plain_movers(after, sensor->name);
    }
    return false;
}

static void compare_plain(struct bench *bench)
{
    for (size_t i = 0; i < bench->suite.sensors.count; i++)
        bench->plain += plain_differs(bench, &bench->suite.sensors.items[i]);
}

static bool is_of(enum subject subject, enum path path)
{
    switch (subject) {
    case PARKED_CARS:
        return path == PATH_WALL_OBJECT || path == PATH_OBJECT_WALL;
    case ROADSIDE:
        return path == PATH_CLUTTER;
    case SLOW_PARTS:
        return path == PATH_WHEEL || path == PATH_LIMB;
    }
    return false;
}

/* Counts what the scenes are made for. */
static void count_seen(struct bench *bench)
{
    const struct frame *frame = &bench->runs.before.frame;
    for (size_t i = 0; i < frame->cells.count; i++)
        for (size_t j = 0; j < frame->cells.items[i].members.count; j++)
            bench->seen += is_of(bench->subject, frame->cells.items[i].members.items[j].id.path);
}

static double nearest(struct fate_pair pair, struct carry carry)
{
    double before = pair.before != NULL ? nearness(pair.before->margins, carry) : (double)INFINITY;
    double after = pair.after != NULL ? nearness(pair.after->margins, carry) : (double)INFINITY;
    return fmin(before, after);
}

/* Notes which lists changed, and which have an echo so near to a border. */
static void compare(struct bench *bench, const struct fates *before, const struct fates *after,
                    bool changed[], bool near[])
{
    double least[SENSORS];
    bool differ[SENSORS] = {false};
    size_t at[2] = {0, 0};
    struct fate_pair pair;
    for (size_t i = 0; i < SENSORS; i++)
        least[i] = (double)INFINITY;
    while (next_pair(before, after, at, &pair)) {
        size_t sensor = (pair.before != NULL ? pair.before : pair.after)->sensor;
        double border = nearest(pair, bench->carry);
        near[sensor] |= border <= 1;
        if (!differs(pair))
            continue;
        changed[sensor] = differ[sensor] = true;
        least[sensor] = fmin(least[sensor], border);
    }
    for (size_t i = 0; i < bench->suite.sensors.count; i++) {
        if (!differ[i])
            continue;
        bench->farthest = fmax(bench->farthest, least[i]);
        if (!(least[i] <= 1))
            fail_msg("%s, %s scene %d, %s: a list changed, %g from its nearest border",
                     bench->suite.sensors.items[i].name, bench->runs.scene.density->name,
                     (int)bench->runs.before.frame.frame, changes[bench->change].name, least[i]);
    }
}

/* The chain up to the list, with the margins of all decisions. */
static void run(struct bench *bench, struct chain *chain, bool other)
{
    const struct suite *suite = other ? &bench->moved : &bench->suite;
    chain->frame.sections |= CARRY_MARGINS;
    use_suite(&chain->sensor, suite);
    use_suite(&chain->noise, suite);
    step(&chain->extract, &chain->frame);
    for (size_t i = 0; other && bench->change == MIRRORED && i < chain->frame.reflectors.count; i++)
        mirror_reflectors(&chain->frame.reflectors.items[i], &chain->arena);
    see(&chain->frame, suite, bench->subject == PARKED_CARS);
    step(&chain->sensor, &chain->frame);
    step(&chain->noise, &chain->frame);
    collect(chain, suite);
}

static void run_scene(struct bench *bench, int64_t number)
{
    struct chain *before = &bench->runs.before, *after = &bench->runs.after;
    uint64_t coin = hash_bytes(hash_text(HASH_START, bench->suite.name), &number, sizeof number);
    bool changed[SENSORS] = {false}, near[SENSORS] = {false};
    begin(before, number);
    begin(after, number);
    make_scene(bench, number, &before->frame, &coin);
    copy_scene(&before->frame, &after->frame);
    if (bench->change == CREEPING)
        creep(&after->frame);
    else
        redescribe(bench, &after->frame, &coin);
    run(bench, before, false);
    run(bench, after, true);
    compare(bench, &before->cells, &after->cells, changed, near);
    compare(bench, &before->targets, &after->targets, changed, near);
    compare_plain(bench);
    count_seen(bench);
    for (size_t i = 0; i < bench->suite.sensors.count; i++) {
        bench->changed += changed[i];
        bench->near += near[i];
        bench->lists++;
    }
}

/* A mirrored level is another one, as its draws go by the aspect. */
static void choose_suite(struct bench *bench, int which)
{
    const struct suite *shipped = load_suite(suites[which].name, &bench->runs.documents);
    bool mirrored = bench->change == MIRRORED;
    struct sensor *sensors = arena_get(&bench->runs.documents, 2 * SENSORS * sizeof *sensors);
    bench->suite = bench->moved = *shipped;
    bench->suite.sensors.items = sensors;
    bench->moved.sensors.items = sensors + SENSORS;
    for (size_t i = 0; i < shipped->sensors.count; i++) {
        struct sensor *moved = &bench->moved.sensors.items[i];
        sensors[i] = shipped->sensors.items[i];
        if (mirrored)
            sensors[i].level_fast_db = 0;
        *moved = sensors[i];
        moved->mount_y_m *= mirrored ? -1 : 1;
        moved->mount_yaw_rad *= mirrored ? -1 : 1;
        suite_derive(&sensors[i]);
        suite_derive(moved);
    }
    bench->carry = (struct carry){changes[bench->change].carry, suites[which].threshold_carry};
}

/* Half of the scenes are adversarial, but none for creeping cars: they cross borders by creeping.
 */
static void run_change(struct bench *bench, const char *what)
{
    char unit[40];
    bench->lists = bench->changed = bench->near = bench->plain = 0;
    bench->seen = bench->farthest = 0;
    for (int suite = 0; suite < SUITES; suite++) {
        choose_suite(bench, suite);
        for (int64_t number = 0; number < hard_points(SCENES); number++) {
            bool dense = bench->change == CREEPING || number % 2 == 0;
            bench->runs.scene.density =
                dense ? &random_traffic_densities[TRAFFIC_DENSE] : &adversarial_traffic_density;
            run_scene(bench, number);
        }
    }
    print_message("%s, %s: %g echoes of it in cells; lists that changed were at most %.2g of a "
                  "bound from a border\n",
                  what, changes[bench->change].name, bench->seen, bench->farthest);
    assert_true(bench->seen > 0);
    snprintf(unit, sizeof unit, "of %g lists", bench->lists);
    hard_case(what, changes[bench->change].name, unit, bench->plain, bench->changed, bench->near);
}

FIXTURE(make_bench, remove_runs);

TEST_OF(bench, a_roadside_is_the_same_in_any_description)
{
    bench->subject = ROADSIDE;
    for (bench->change = FAR_STRIP; bench->change < CHANGES; bench->change++)
        run_change(bench, "roadside");
}

TEST_OF(bench, slow_wheels_and_limbs_are_the_same_in_any_description)
{
    bench->subject = SLOW_PARTS;
    for (bench->change = LAST_PLACE; bench->change < CHANGES; bench->change++)
        run_change(bench, "slow wheels");
}

TEST_OF(bench, parked_cars_that_creep_have_the_list_of_those_that_stand)
{
    bench->subject = PARKED_CARS;
    bench->change = CREEPING;
    run_change(bench, "ghosts");
}
