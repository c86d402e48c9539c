#include "check.h"

#include "base/units.h"
#include "frame/frame.h"
#include "geometry/motion.h"
#include "text/record_read.h"
#include "traffic/road_traffic.h"

struct bench {
    struct arena arena, scratch;
    struct diag diag;
    struct roadway road;
    struct road_traffic traffic;
    struct frame frame;
};

static int make_bench(void **state)
{
    struct bench *bench = check_make(state, sizeof *bench);
    bench->frame.arena = &bench->scratch;
    return 0;
}

static int remove_bench(void **state)
{
    struct bench *bench = *state;
    arena_free(&bench->arena);
    arena_free(&bench->scratch);
    free(bench);
    return 0;
}

/* Reads a road and begins its traffic; the result of road_traffic_begin. */
static int begin(struct bench *bench, const char *text, double warmup_s, const char *ego,
                 int64_t scene)
{
    struct random_address address = {.seed = 3, .scene = (uint64_t)scene};
    arena_clear(&bench->arena);
    bench->diag = (struct diag){0};
    memset(&bench->road, 0, sizeof bench->road);
    if (record_read(text, strlen(text), &roadway_record, &bench->road, &bench->arena, NULL,
                    &bench->diag) != 0)
        fail_msg("%s", bench->diag.text);
    return road_traffic_begin(&bench->traffic, &bench->road, 1, warmup_s, ego, address,
                              &bench->arena, &bench->diag);
}

static const struct frame *frame_at(struct bench *bench, double time_s)
{
    road_traffic_advance(&bench->traffic, time_s);
    frame_clear(&bench->frame);
    road_traffic_fill(&bench->traffic, &bench->frame);
    return &bench->frame;
}

static void begin_well(struct bench *bench, const char *text, double warmup_s, const char *ego,
                       int64_t scene)
{
    if (begin(bench, text, warmup_s, ego, scene) != 0)
        fail_msg("%s", bench->diag.text);
}

/* Bends, oncoming lanes, a long vehicle, lights, and more arrivals than the lanes can take. */
static const char CROWDED[] =
    "{\"id\":\"r\",\"points\":[{\"x_m\":-400,\"y_m\":0},{\"x_m\":0,\"y_m\":0},{\"x_m\":200,\"y_m\":"
    "120},{\"x_m\":300,\"y_m\":-60},{\"x_m\":700,\"y_m\":0}],\"lanes\":["
    "{\"offset_m\":-4,\"limit_mps\":15,\"arrivals\":[{\"class\":\"car\",\"flow_per_h\":1500},"
    "{\"class\":\"articulated_truck\",\"flow_per_h\":300}],"
    "\"signals\":[{\"at_m\":800,\"green_s\":20,\"red_s\":25}]},"
    "{\"offset_m\":0,\"limit_mps\":25,\"arrivals\":[{\"class\":\"car\",\"flow_per_h\":2500,"
    "\"headway_s\":0.9,\"acceleration_mps2\":2,\"spread\":0.3},{\"class\":\"motorcycle\","
    "\"flow_per_h\":300},{\"class\":\"bicycle\",\"flow_per_h\":20,\"speed_mps\":5}],"
    "\"signals\":[{\"at_m\":500,\"green_s\":9,\"red_s\":11},{\"at_m\":900,\"green_s\":20,"
    "\"red_s\":15,\"offset_s\":7}]},"
    "{\"offset_m\":4,\"oncoming\":true,\"limit_mps\":20,\"arrivals\":[{\"class\":\"bus\","
    "\"flow_per_h\":400},{\"class\":\"car\",\"flow_per_h\":900}],"
    "\"signals\":[{\"at_m\":300,\"green_s\":5,\"red_s\":40}]}]}";

/* ---- lanes ---- */

static struct road_path path_of(struct bench *bench, const char *points, double radius_m,
                                double offset_m, bool oncoming)
{
    char text[512];
    struct road_path path;
    snprintf(text, sizeof text,
             "{\"id\":\"r\",\"radius_m\":%.17g,\"points\":[%s],\"lanes\":[{\"offset_m\":%.17g,"
             "\"oncoming\":%s,\"limit_mps\":9,\"arrivals\":[]}]}",
             radius_m, points, offset_m, oncoming ? "true" : "false");
    begin_well(bench, text, 0, NULL, 0);
    assert_int_equal(
        road_path_make(&path, &bench->road, bench->road.lanes.items, &bench->arena, &bench->diag),
        0);
    return path;
}

static const char CORNER[] =
    "{\"x_m\":0,\"y_m\":0},{\"x_m\":100,\"y_m\":0},{\"x_m\":100,\"y_m\":80}";

FIXTURE(make_bench, remove_bench);

/* A quarter circle around (80, 20) between straight pieces of 80 m and 60 m. */
TEST_OF(bench, a_right_angle_is_rounded_by_a_quarter_circle)
{
    static const double offsets_m[] = {0, 3.5, -3.5};
    for (size_t i = 0; i < COUNT(offsets_m); i++) {
        double offset_m = offsets_m[i], radius_m = 20 - offset_m;
        struct road_path path = path_of(bench, CORNER, 20, offset_m, false);
        double arc_m = radius_m * PI / 2;
        assert_close(path.length_m, 80 + arc_m + 60, 1e-12);
        assert_close(path.radius_m, radius_m, 1e-13);
        for (int k = 0; k <= 90; k++) {
            double angle_rad = units_wrap_rad(k * PI / 180);
            struct motion body = road_path_motion(&path, 80 + radius_m * angle_rad, 10);
            assert_close(body.position_m.x, 80 + radius_m * sin(angle_rad), 1e-12);
            assert_close(body.position_m.y, 20 - radius_m * cos(angle_rad), 1e-12);
            assert_close(body.yaw_rad, angle_rad, 1e-14);
            if (k > 0 && k < 90)
                assert_close(body.yaw_rate_radps, 10 / radius_m, 1e-13);
        }
        struct motion end = road_path_motion(&path, path.length_m, 10);
        assert_close(end.position_m.x, 100 - offset_m, 1e-12);
        assert_close(end.position_m.y, 80, 1e-12);
        assert_close(end.velocity_mps.x, 0, 1e-14);
        assert_close(end.velocity_mps.y, 10, 0);
    }
}

/* Half of the shorter leg is left to the arc: radius 40 m for a right angle. */
TEST_OF(bench, without_a_radius_an_arc_takes_half_the_shorter_leg)
{
    struct road_path path = path_of(bench, CORNER, 1e6, 0, false);
    assert_close(path.radius_m, 40, 1e-13);
}

static const char WINDING[] =
    "{\"x_m\":-50,\"y_m\":10},{\"x_m\":60,\"y_m\":0},{\"x_m\":120,\"y_m\":"
    "70},{\"x_m\":220,\"y_m\":20},{\"x_m\":150,\"y_m\":-90}";

TEST_OF(bench, velocity_and_yaw_rate_are_derivatives_of_the_pose)
{
    struct road_path path = path_of(bench, WINDING, 1e6, 1.5, false);
    double speed_mps = 12, step_s = 1e-4;
    for (double place_m = 0.01; place_m < path.length_m; place_m += 0.37) {
        struct motion before = road_path_motion(&path, place_m - speed_mps * step_s, speed_mps);
        struct motion body = road_path_motion(&path, place_m, speed_mps);
        struct motion after = road_path_motion(&path, place_m + speed_mps * step_s, speed_mps);
        if (before.yaw_rate_radps != after.yaw_rate_radps)
            continue; /* where an arc begins or ends */
        struct vec2 moved_m = vec2_sub(after.position_m, before.position_m);
        assert_close(moved_m.x / (2 * step_s), body.velocity_mps.x, 1e-5);
        assert_close(moved_m.y / (2 * step_s), body.velocity_mps.y, 1e-5);
        assert_close(units_wrap_rad(after.yaw_rad - before.yaw_rad) / (2 * step_s),
                     body.yaw_rate_radps, 1e-9);
        assert_close(vec2_length(body.velocity_mps), speed_mps, 1e-14);
    }
}

TEST_OF(bench, poses_are_continuous_along_the_lane)
{
    struct road_path path = path_of(bench, WINDING, 1e6, -2, false);
    for (size_t i = 1; i < path.pieces.count; i++) {
        double place_m = path.pieces.items[i].from_m;
        struct motion before = road_path_motion(&path, place_m - 1e-9, 1);
        struct motion after = road_path_motion(&path, place_m + 1e-9, 1);
        assert_close(vec2_length(vec2_sub(after.position_m, before.position_m)), 2e-9, 1e-12);
        assert_close(units_wrap_rad(after.yaw_rad - before.yaw_rad), 0, 1e-9);
    }
}

TEST_OF(bench, an_oncoming_lane_is_the_same_way_back)
{
    struct road_path there = path_of(bench, WINDING, 1e6, 1.5, false);
    struct arena kept = bench->arena;
    bench->arena = (struct arena){0};
    struct road_path back = path_of(bench, WINDING, 1e6, 1.5, true);
    assert_close(back.length_m, there.length_m, 1e-11);
    for (double place_m = 0; place_m < there.length_m; place_m += 1.7) {
        struct motion one = road_path_motion(&there, place_m, 1);
        struct motion other = road_path_motion(&back, there.length_m - place_m, 1);
        assert_close(vec2_length(vec2_sub(one.position_m, other.position_m)), 0, 1e-11);
        assert_close(fabs(units_wrap_rad(one.yaw_rad - other.yaw_rad)), PI, 1e-11);
    }
    arena_free(&kept);
}

/* ---- arrivals ---- */

/* On a road of 600 s at its speed nobody has left it after that time. The tolerances are five
 * standard errors. */
TEST_OF(bench, arrivals_are_a_poisson_process_of_the_classes_flows)
{
    static const char text[] =
        "{\"id\":\"r\",\"points\":[{\"x_m\":0,\"y_m\":0},{\"x_m\":90000,\"y_m\":0}],\"lanes\":["
        "{\"offset_m\":0,\"limit_mps\":30,\"arrivals\":[{\"class\":\"car\",\"flow_per_h\":27},"
        "{\"class\":\"truck\",\"flow_per_h\":9}]}]}";
    enum { SCENES = 2000 };
    double sum = 0, squares = 0, trucks = 0, mean = 36 / 6.0;
    for (int scene = 0; scene < SCENES; scene++) {
        begin_well(bench, text, 600, NULL, scene);
        const struct frame *frame = frame_at(bench, 0);
        double count = (double)frame->objects.count;
        sum += count;
        squares += (count - mean) * (count - mean);
        for (size_t i = 0; i < frame->objects.count; i++)
            trucks += strcmp(frame->objects.items[i].class, "truck") == 0;
    }
    /* A few still wait: who comes within two seconds of another. */
    assert_close(sum / SCENES, mean, 5 * sqrt(mean / SCENES) + 0.02);
    assert_close(squares / SCENES, mean, 5 * sqrt((mean + 2 * mean * mean) / SCENES) + 0.1);
    assert_close(trucks / sum, 0.25, 5 * sqrt(0.1875 / sum));
}

TEST_OF(bench, who_finds_no_gap_waits_outside)
{
    static const char text[] =
        "{\"id\":\"r\",\"points\":[{\"x_m\":0,\"y_m\":0},{\"x_m\":500,\"y_m\":0}],\"lanes\":["
        "{\"offset_m\":0,\"limit_mps\":15,\"arrivals\":[{\"class\":\"car\",\"flow_per_h\":3000,"
        "\"length_m\":5,\"spread\":0}],\"signals\":[{\"at_m\":100,\"green_s\":0,\"red_s\":1}]}]}";
    begin_well(bench, text, 600, NULL, 0);
    const struct frame *frame = frame_at(bench, 0);
    /* They stand gap_m apart, or little more; the first stands so far from the line. */
    assert_int_equal(frame->objects.count, 14);
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        assert_close(object->vx_mps, 0, 0.01);
        assert_close(object->x_m, 100 - 2 - 2.5 - 7 * (double)i, 0.1 * (double)(i + 1));
    }
    assert_true(frame->objects.items[13].x_m >= 2.5);
}

TEST_OF(bench, frames_do_not_depend_on_how_time_was_cut)
{
    begin_well(bench, CROWDED, 30, NULL, 5);
    const struct frame *frame = frame_at(bench, 47.3);
    size_t count = frame->objects.count;
    struct object *kept = arena_get(check_arena(), count * sizeof *kept);
    memcpy(kept, frame->objects.items, count * sizeof *kept);
    begin_well(bench, CROWDED, 30, NULL, 5);
    for (int i = 0; i < 473; i++)
        frame_at(bench, 0.1 * i);
    frame = frame_at(bench, 47.3);
    assert_int_equal(frame->objects.count, count);
    for (size_t i = 0; i < count; i++) {
        assert_close(frame->objects.items[i].x_m, kept[i].x_m, 0);
        assert_close(frame->objects.items[i].vy_mps, kept[i].vy_mps, 0);
    }
}

/* Behind a truck that nobody can overtake all end at its speed and the gap of that speed. */
TEST_OF(bench, a_platoon_keeps_the_published_gaps)
{
    static const char text[] =
        "{\"id\":\"r\",\"points\":[{\"x_m\":0,\"y_m\":0},{\"x_m\":30000,\"y_m\":0}],\"lanes\":["
        "{\"offset_m\":0,\"limit_mps\":33,\"arrivals\":[{\"class\":\"car\",\"flow_per_h\":800,"
        "\"spread\":0,\"acceleration_mps2\":3,\"length_m\":5},{\"class\":\"truck\",\"flow_per_h\":"
        "30,\"speed_mps\":15,\"spread\":0,\"length_m\":10}]}]}";
    begin_well(bench, text, 1500, NULL, 1);
    const struct frame *frame = frame_at(bench, 0);
    int64_t followers = 0;
    for (size_t i = 1; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i], *leader = object - 1;
        if (fabs(object->vx_mps - 15) > 1e-4 || fabs(leader->vx_mps - 15) > 1e-4 ||
            strcmp(object->class, "car") != 0)
            continue;
        double gap_m = leader->x_m - object->x_m - (leader->length_m + object->length_m) / 2;
        assert_near(gap_m, (2 + 15 * 1.6) / sqrt(1 - pow(15 / 33.0, 4)), 1e-3);
        followers++;
    }
    assert_true(followers > 15);
}

/* ---- nobody collides ---- */

static struct box box_of(const struct object *object)
{
    return (struct box){.motion = {.position_m = {object->x_m, object->y_m}},
                        .heading = vec2_heading(object->yaw_rad),
                        .length_m = object->length_m,
                        .width_m = object->width_m};
}

/* Is there a line along a side of the first box that parts the two? */
static bool parts(const struct box *box, const struct box *other)
{
    struct vec2 corner[4], sides[] = {box->heading, vec2_left(box->heading)};
    double half_m[] = {box->length_m / 2, box->width_m / 2};
    motion_box_outline(other, corner);
    for (int side = 0; side < 2; side++) {
        double least = 1e9, most = -1e9;
        for (int i = 0; i < 4; i++) {
            double along = vec2_dot(vec2_sub(corner[i], box->motion.position_m), sides[side]);
            least = fmin(least, along);
            most = fmax(most, along);
        }
        if (least > half_m[side] || most < -half_m[side])
            return true;
    }
    return false;
}

static void require_apart(const struct object *a, const struct object *b)
{
    if (fabs(a->x_m - b->x_m) > 25 || fabs(a->y_m - b->y_m) > 25)
        return;
    struct box box = box_of(a), other = box_of(b);
    if (!parts(&box, &other) && !parts(&other, &box))
        fail_msg("%s and %s collide at (%g, %g)", a->id, b->id, a->x_m, a->y_m);
}

static double speed_of(const struct object *object)
{
    return vec2_dot((struct vec2){object->vx_mps, object->vy_mps}, vec2_heading(object->yaw_rad));
}

/* Who has just come in need not brake harder than is comfortable. */
static void require_comfort(const struct road_traffic *traffic)
{
    for (size_t i = 0; i < traffic->queues.count; i++) {
        const struct road_queue *queue = &traffic->queues.items[i];
        for (size_t k = 0; k < queue->vehicles.count; k++) {
            const struct road_vehicle *vehicle = &queue->vehicles.items[k];
            if (vehicle->front_m == vehicle->length_m && vehicle->speed_mps > 0)
                assert_true(vehicle->acceleration_mps2 >= -vehicle->driver.deceleration_mps2);
        }
    }
}

/* All vehicles together drive so many seconds, or what CASES says. */
TEST_OF(bench, nobody_collides_or_drives_backwards)
{
    const double wanted_s = check_cases(1e5);
    double driven_s = 0;
    for (int64_t scene = 0; driven_s < wanted_s; scene++) {
        begin_well(bench, CROWDED, 0, NULL, scene);
        for (int step = 0; step < 16 * 300; step++) {
            const struct frame *frame = frame_at(bench, step * ROAD_TRAFFIC_STEP_S);
            const struct object *objects = frame->objects.items;
            require_comfort(&bench->traffic);
            for (size_t i = 0; i < frame->objects.count; i++) {
                assert_true(speed_of(&objects[i]) >= -1e-14);
                for (size_t k = 0; k < i; k++)
                    require_apart(&objects[i], &objects[k]);
            }
            driven_s += (double)frame->objects.count * ROAD_TRAFFIC_STEP_S;
        }
    }
    print_message("%.3g vehicle-seconds without a collision\n", driven_s);
}

/* ---- the ego, mirrors, refusals ---- */

TEST_OF(bench, the_ego_comes_by_its_place_at_time_zero)
{
    static const char text[] =
        "{\"id\":\"r\",\"points\":[{\"x_m\":0,\"y_m\":0},{\"x_m\":900,\"y_m\":0}],\"lanes\":["
        "{\"offset_m\":0,\"limit_mps\":30,\"arrivals\":[{\"class\":\"car\",\"flow_per_h\":200},"
        "{\"class\":\"van\",\"flow_per_h\":60,\"ego_m\":400}]}]}";
    for (int scene = 0; scene < 20; scene++) {
        begin_well(bench, text, 20, "me", scene);
        const struct frame *frame = frame_at(bench, 0);
        const struct object *ego = frame_object(frame, "me");
        assert_non_null(ego);
        assert_string_equal(ego->class, "van");
        assert_true(ego->x_m >= 400 && ego->x_m < 400 + 33 * ROAD_TRAFFIC_STEP_S);
        assert_true(road_traffic_has(&bench->traffic, "me"));
        frame_at(bench, 60);
        assert_false(road_traffic_has(&bench->traffic, "me"));
    }
}

/* Every y of the road with the other sign, and every offset. */
TEST_OF(bench, a_mirrored_road_has_mirrored_traffic)
{
    begin_well(bench, CROWDED, 60, NULL, 2);
    const struct frame *frame = frame_at(bench, 31.4);
    size_t count = frame->objects.count;
    struct object *kept = arena_get(check_arena(), count * sizeof *kept);
    memcpy(kept, frame->objects.items, count * sizeof *kept);
    arena_clear(&bench->arena);
    memset(&bench->road, 0, sizeof bench->road);
    assert_int_equal(record_read(CROWDED, strlen(CROWDED), &roadway_record, &bench->road,
                                 &bench->arena, NULL, &bench->diag),
                     0);
    for (size_t i = 0; i < bench->road.points.count; i++)
        bench->road.points.items[i].y_m *= -1;
    for (size_t i = 0; i < bench->road.lanes.count; i++)
        bench->road.lanes.items[i].offset_m *= -1;
    struct random_address address = {.seed = 3, .scene = 2};
    assert_int_equal(road_traffic_begin(&bench->traffic, &bench->road, 1, 60, NULL, address,
                                        &bench->arena, &bench->diag),
                     0);
    frame = frame_at(bench, 31.4);
    assert_int_equal(frame->objects.count, count);
    for (size_t i = 0; i < count; i++) {
        const struct object *object = &frame->objects.items[i];
        assert_close(object->travelled_m, kept[i].travelled_m, 0);
        assert_close(object->x_m, kept[i].x_m, 1e-12);
        assert_close(object->y_m, -kept[i].y_m, 1e-12);
        assert_close(units_wrap_rad(object->yaw_rad + kept[i].yaw_rad), 0, 1e-15);
        assert_close(object->vx_mps, kept[i].vx_mps, 1e-14);
        assert_close(object->vy_mps, -kept[i].vy_mps, 1e-14);
        assert_close(object->yaw_rate_radps, -kept[i].yaw_rate_radps, 1e-15);
    }
}

TEST_OF(bench, what_cannot_be_driven_is_refused)
{
    static const struct {
        const char *points, *lanes, *message;
    } cases[] = {
        {"{\"x_m\":0,\"y_m\":0},{\"x_m\":9,\"y_m\":0},{\"x_m\":0,\"y_m\":0.1}",
         "{\"offset_m\":0,\"limit_mps\":9,\"arrivals\":[]}",
         "roads[0].lanes[0].corner at (9, 0): the lane turns there with a radius of "},
        {"{\"x_m\":0,\"y_m\":0},{\"x_m\":9,\"y_m\":0}",
         "{\"offset_m\":0,\"limit_mps\":9,\"arrivals\":[{\"class\":\"tank\",\"flow_per_h\":1}]}",
         "roads[0].lanes[0].arrivals[0].class: "},
        {"{\"x_m\":0,\"y_m\":0},{\"x_m\":9,\"y_m\":0}",
         "{\"offset_m\":0,\"limit_mps\":9,\"arrivals\":[{\"class\":\"car\",\"flow_per_h\":1,"
         "\"width_m\":2,\"spread\":0}]},{\"offset_m\":-2.5,\"limit_mps\":9,\"arrivals\":[{"
         "\"class\":\"car\",\"flow_per_h\":1,\"width_m\":3,\"spread\":0}]}",
         "roads[0].lanes[1].offset_m: 2.5 m beside lanes[0]"},
        {"{\"x_m\":0,\"y_m\":0},{\"x_m\":9,\"y_m\":0}",
         "{\"offset_m\":0,\"limit_mps\":9,\"arrivals\":[{\"class\":\"car\",\"flow_per_h\":0,"
         "\"ego_m\":3}]}",
         "roads: no vehicle passes "},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        char text[1024];
        snprintf(text, sizeof text, "{\"id\":\"r\",\"points\":[%s],\"lanes\":[%s]}",
                 cases[i].points, cases[i].lanes);
        assert_int_equal(begin(bench, text, 1, "ego", 0), -1);
        assert_int_equal(bench->diag.code, DIAG_CONFIG);
        if (strncmp(bench->diag.text, cases[i].message, strlen(cases[i].message)) != 0)
            fail_msg("%s", bench->diag.text);
    }
}
