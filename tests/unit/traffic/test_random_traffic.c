#include "check.h"

#include <dirent.h>

#include "documents/suite_file.h"
#include "effects/effect.h"
#include "traffic/random_traffic.h"
#include "traffic/scenario.h"
#include "traffic_bench.h"

#define SNAPSHOTS 400

static const struct frame *snapshot(struct bench *bench, int density, uint64_t seed, int64_t number)
{
    frame_clear(&bench->frame);
    bench->frame.seed = seed;
    bench->scene.density = &random_traffic_densities[density];
    random_traffic_fill(&bench->scene, number, &bench->frame);
    return &bench->frame;
}

static enum random_traffic_class class_of(const struct object *object)
{
    enum random_traffic_class class = 0;
    while (class < TRAFFIC_CLASSES && strcmp(object->class, random_traffic_class_name(class)) != 0)
        class ++;
    assert_true(class < TRAFFIC_CLASSES);
    return class;
}

FIXTURE(make_bench, remove_bench);

TEST_OF(bench, the_ego_stands_within_500_m_of_the_origin)
{
    double most_m = 0;
    for (int64_t number = 0; number < 20000; number++) {
        const struct object *ego = snapshot(bench, TRAFFIC_SPARSE, 1, number)->objects.items;
        assert_true(fabs(ego->x_m) <= 500 && fabs(ego->y_m) <= 500);
        most_m = fmax(most_m, fmax(fabs(ego->x_m), fabs(ego->y_m)));
    }
    assert_close(most_m, 500, 1);
}

TEST(every_vehicle_document_has_a_share)
{
    DIR *folder = opendir("data/vehicles");
    assert_non_null(folder);
    int documents = 0;
    for (const struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder))
        documents += strstr(entry->d_name, ".json") != NULL;
    closedir(folder);
    assert_int_equal(documents, TRAFFIC_CLASSES);
}

static const double SHARES[TRAFFIC_CLASSES] = {
    [TRAFFIC_CAR] = 0.50,       [TRAFFIC_VAN] = 0.10,
    [TRAFFIC_TRUCK] = 0.06,     [TRAFFIC_ARTICULATED_TRUCK] = 0.03,
    [TRAFFIC_BUS] = 0.03,       [TRAFFIC_MOTORCYCLE] = 0.04,
    [TRAFFIC_BICYCLE] = 0.05,   [TRAFFIC_PEDESTRIAN] = 0.09,
    [TRAFFIC_POST] = 0.04,      [TRAFFIC_WALL] = 0.02,
    [TRAFFIC_GUARDRAIL] = 0.04,
};

TEST_OF(bench, classes_come_in_their_shares)
{
    double hits[TRAFFIC_CLASSES] = {0}, objects = 0;
    for (int64_t number = 0; number < 2000; number++) {
        const struct frame *frame = snapshot(bench, TRAFFIC_DENSE, 1, number);
        for (size_t i = 1; i < frame->objects.count; i++) {
            hits[class_of(&frame->objects.items[i])]++;
            objects++;
        }
    }
    for (enum random_traffic_class class = 0; class < TRAFFIC_CLASSES; class ++) {
        double expected = objects * SHARES[class];
        assert_close(hits[class], expected, 5 * sqrt(expected));
    }
}

/* The documented counts and radii, all of them reached. */
TEST_OF(bench, densities_keep_to_their_numbers_and_radii)
{
    static const struct {
        int density;
        size_t least, most;
        double radius_m;
    } cases[] = {
        {TRAFFIC_SPARSE, 0, 3, 120},
        {TRAFFIC_MEDIUM, 0, 8, 60},
        {TRAFFIC_DENSE, 4, 15, 25},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t least = SIZE_MAX, most = 0;
        double farthest_m = 0;
        for (int64_t number = 0; number < SNAPSHOTS; number++) {
            const struct frame *frame = snapshot(bench, cases[i].density, 1, number);
            const struct object *object = frame->objects.items;
            size_t count = frame->objects.count - 1;
            least = count < least ? count : least;
            most = count > most ? count : most;
            for (size_t k = 1; k <= count; k++)
                farthest_m = fmax(farthest_m, hypot(object[k].x_m - object[0].x_m,
                                                    object[k].y_m - object[0].y_m));
        }
        assert_int_equal(least, cases[i].least);
        assert_int_equal(most, cases[i].most);
        assert_true(farthest_m <= cases[i].radius_m + 1e-9);
        assert_true(farthest_m > 0.95 * cases[i].radius_m);
    }
}

static void size_of(const struct bench *bench, const struct object *object, double *length_m,
                    double *width_m)
{
    const struct random_traffic_model *model = &bench->scene.models[class_of(object)];
    *length_m = object->length_m > 0 ? object->length_m : model->length_m;
    *width_m = object->width_m > 0 ? object->width_m : model->width_m;
}

/* True if a point of a grid 0.1 m wide over one box lies in the other. */
static bool covers(const struct bench *bench, const struct object *one, const struct object *other)
{
    double length_m, width_m, other_length_m, other_width_m;
    size_of(bench, one, &length_m, &width_m);
    size_of(bench, other, &other_length_m, &other_width_m);
    int columns = (int)ceil(length_m / 0.1), rows = (int)ceil(width_m / 0.1);
    for (int i = 0; i <= columns; i++)
        for (int k = 0; k <= rows; k++) {
            double x = length_m * ((double)i / columns - 0.5);
            double y = width_m * ((double)k / rows - 0.5);
            double dx = one->x_m + x * cos(one->yaw_rad) - y * sin(one->yaw_rad) - other->x_m;
            double dy = one->y_m + x * sin(one->yaw_rad) + y * cos(one->yaw_rad) - other->y_m;
            double along = dx * cos(other->yaw_rad) + dy * sin(other->yaw_rad);
            double aside = dy * cos(other->yaw_rad) - dx * sin(other->yaw_rad);
            if (fabs(along) < other_length_m / 2 && fabs(aside) < other_width_m / 2)
                return true;
        }
    return false;
}

TEST_OF(bench, no_object_overlaps_the_ego)
{
    for (int density = 0; density < TRAFFIC_DENSITIES; density++)
        for (int64_t number = 0; number < SNAPSHOTS; number++) {
            const struct frame *frame = snapshot(bench, density, 1, number);
            const struct object *object = frame->objects.items;
            for (size_t i = 1; i < frame->objects.count; i++)
                assert_false(covers(bench, &object[0], &object[i]));
        }
}

TEST_OF(bench, objects_overlap_each_other_but_rarely)
{
    double overlaps = 0, objects = 0;
    for (int64_t number = 0; number < 2 * SNAPSHOTS; number++) {
        const struct frame *frame = snapshot(bench, TRAFFIC_DENSE, 1, number);
        const struct object *object = frame->objects.items;
        for (size_t i = 1; i < frame->objects.count; i++) {
            size_t k = 1;
            while (k < i && !covers(bench, &object[k], &object[i]))
                k++;
            overlaps += k < i;
            objects++;
        }
    }
    assert_true(overlaps > 0 && overlaps < 0.05 * objects);
}

static void assert_same_objects(const struct frame *a, const struct frame *b)
{
    assert_int_equal(a->objects.count, b->objects.count);
    for (size_t i = 0; i < a->objects.count; i++) {
        struct object one = a->objects.items[i], other = b->objects.items[i];
        assert_string_equal(one.id, other.id);
        assert_string_equal(one.class, other.class);
        one.id = other.id;
        one.class = other.class;
        assert_memory_equal(&one, &other, sizeof one);
    }
}

TEST_OF(bench, a_snapshot_is_drawn_by_its_number_alone)
{
    void *other;
    make_bench(&other);
    const struct frame *alone = snapshot(other, TRAFFIC_DENSE, 5, 13);
    for (int64_t number = 0; number < 13; number++)
        snapshot(bench, TRAFFIC_DENSE, 5, number);
    assert_same_objects(snapshot(bench, TRAFFIC_DENSE, 5, 13), alone);
    remove_bench(&other);
}

TEST_OF(bench, seed_number_and_density_each_make_another_snapshot)
{
    const double x_m = snapshot(bench, TRAFFIC_DENSE, 5, 13)->objects.items[0].x_m;
    assert_true(fabs(snapshot(bench, TRAFFIC_DENSE, 6, 13)->objects.items[0].x_m - x_m) > 0);
    assert_true(fabs(snapshot(bench, TRAFFIC_DENSE, 5, 14)->objects.items[0].x_m - x_m) > 0);
    assert_true(fabs(snapshot(bench, TRAFFIC_MEDIUM, 5, 13)->objects.items[0].x_m - x_m) > 0);
}

static const struct frame *in_conditions(struct bench *bench, int density, int64_t number)
{
    snapshot(bench, density, 1, number);
    random_traffic_conditions(random_traffic_address(&bench->scene, 1, number), &bench->frame);
    return &bench->frame;
}

static void check_interferers(const struct frame *frame)
{
    const struct interferer *interferers = frame->conditions.interferers.items;
    size_t count = frame->conditions.interferers.count;
    assert_true(count <= 2 && count < frame->objects.count);
    for (size_t i = 0; i < count; i++) {
        assert_non_null(frame_object(frame, interferers[i].object));
        assert_string_not_equal(interferers[i].object, frame->ego);
        assert_true(interferers[i].eirp_dbm > 0 && interferers[i].eirp_dbm < 40);
        assert_true(fabs(interferers[i].slope_hzps) > 1e12);
        assert_true(fabs(interferers[i].slope_hzps) < 5e13);
        assert_true(interferers[i].hit_share > 0 && interferers[i].hit_share < 0.3);
    }
    if (count == 2)
        assert_string_not_equal(interferers[0].object, interferers[1].object);
}

TEST_OF(bench, roads_and_interferers_come_in_their_shares)
{
    enum { FRAMES = 20000, ASPHALT, CONCRETE, ONE, TWO, KINDS };
    static const double shares[KINDS] = {
        [ASPHALT] = 0.25, [CONCRETE] = 0.25, [ONE] = 0.2 / 2, [TWO] = 0.2 / 2};
    int hits[KINDS] = {0};
    for (int64_t number = 0; number < FRAMES; number++) {
        const struct frame *frame = in_conditions(bench, TRAFFIC_DENSE, number);
        const struct conditions *drawn = &frame->conditions;
        hits[ASPHALT] += drawn->road == ROAD_ASPHALT;
        hits[CONCRETE] += drawn->road == ROAD_CONCRETE;
        hits[ONE] += drawn->interferers.count == 1;
        hits[TWO] += drawn->interferers.count == 2;
        check_interferers(frame);
    }
    for (int kind = ASPHALT; kind < KINDS; kind++)
        assert_close((double)hits[kind] / FRAMES, shares[kind],
                     5 * sqrt(shares[kind] * (1 - shares[kind]) / FRAMES));
}

/* The share of scenes that have a condition, and its law: the middle of its range, evenly or in the
 * logarithm, is in the middle of what is drawn. */
TEST_OF(bench, every_number_is_drawn_as_its_effect_says)
{
    enum { FRAMES = 20000 };
    double share = 0;
    const struct effect_member *condition;
    for (int i = 1; (condition = effect_random_condition(i)) != NULL; i++) {
        const struct effect_random *draw = &condition->random;
        share = draw->share > 0 ? draw->share : share;
        if (condition->size != sizeof(double))
            continue;
        bool evenly = draw->law == EFFECT_EVENLY;
        double middle = evenly ? (draw->low + draw->high) / 2 : sqrt(draw->low * draw->high);
        int has = 0, above = 0;
        for (int64_t number = 0; number < FRAMES; number++) {
            const struct frame *frame = in_conditions(bench, TRAFFIC_SPARSE, number);
            double value;
            memcpy(&value, (const char *)&frame->conditions + condition->offset, sizeof value);
            assert_true(value == 0 || (value > draw->low && value < draw->high));
            has += value > 0;
            above += value > middle;
        }
        double slack = 5 * sqrt(share * (1 - share) / FRAMES);
        assert_close((double)has / FRAMES, share, slack);
        assert_close((double)above / FRAMES, share / 2, slack);
    }
}

TEST_OF(bench, conditions_of_few_objects_have_few_interferers)
{
    int64_t alone = 0, single = 0;
    for (int64_t number = 0; number < 3000; number++) {
        const struct frame *frame = in_conditions(bench, TRAFFIC_SPARSE, number);
        check_interferers(frame);
        alone += frame->objects.count == 1;
        single += frame->objects.count == 2 && frame->conditions.interferers.count == 1;
    }
    assert_true(alone > 0 && single > 0);
}

TEST_OF(bench, conditions_are_drawn_by_number_and_change_no_object)
{
    for (int64_t number = 0; number < 50; number++) {
        double x_m = snapshot(bench, TRAFFIC_DENSE, 1, number)->objects.items[1].x_m;
        double rain_mmph = in_conditions(bench, TRAFFIC_DENSE, number)->conditions.rain_mmph;
        in_conditions(bench, TRAFFIC_DENSE, number + 1);
        const struct frame *again = in_conditions(bench, TRAFFIC_DENSE, number);
        assert_close(again->objects.items[1].x_m, x_m, 0);
        assert_close(again->conditions.rain_mmph, rain_mmph, 0);
    }
}

/* Distances of a strip's ends ahead of the ego and to its left. */
static void check_strip(const struct roadside_strip *strip, const struct object *ego)
{
    struct vec2 ahead = vec2_heading(ego->yaw_rad), at = {ego->x_m, ego->y_m};
    struct vec2 from = vec2_sub((struct vec2){strip->from_x_m, strip->from_y_m}, at);
    struct vec2 to = vec2_sub((struct vec2){strip->to_x_m, strip->to_y_m}, at);
    assert_close(vec2_dot(from, ahead), -300, 1e-9);
    assert_close(vec2_dot(to, ahead), 300, 1e-9);
    double left_m = vec2_cross(ahead, from);
    assert_close(vec2_cross(ahead, to), left_m, 1e-9);
    assert_true(fabs(left_m) - strip->width_m / 2 >= 5);
    assert_true(strip->level_db == 2 && strip->spacing_m == 0);
    assert_int_equal(strip->kind == ROADSIDE_VEGETATION, strip->width_m > 0);
}

TEST_OF(bench, strips_run_along_the_road_on_both_sides_and_change_no_object)
{
    int kinds[ROADSIDE_VEGETATION + 1] = {0};
    for (int64_t number = 0; number < SNAPSHOTS; number++) {
        struct frame *frame = &bench->frame;
        size_t objects = snapshot(bench, TRAFFIC_MEDIUM, 1, number)->objects.count;
        random_traffic_roadside(random_traffic_address(&bench->scene, 1, number), frame);
        assert_int_equal(frame->objects.count, objects);
        for (size_t i = 0; i < frame->roadside.count; i++) {
            check_strip(&frame->roadside.items[i], &frame->objects.items[0]);
            kinds[frame->roadside.items[i].kind]++;
        }
    }
    assert_near(kinds[ROADSIDE_RAIL], 2 * SNAPSHOTS * 0.35, 0.1);
    assert_near(kinds[ROADSIDE_KERB], 2 * SNAPSHOTS * 0.15, 0.15);
    assert_near(kinds[ROADSIDE_POLES], 2 * SNAPSHOTS * 0.3, 0.1);
    assert_near(kinds[ROADSIDE_VEGETATION], 2 * SNAPSHOTS * 0.5, 0.1);
}
