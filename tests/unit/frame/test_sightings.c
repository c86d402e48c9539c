#include "frame/sightings.h"

#include "check.h"
#include "frame/frame.h"

TEST(levels_begin_at_their_lower_border)
{
    static const struct {
        int64_t in_view, blocked;
        int visibility;
        double share;
    } cases[] = {{5, 4, 0, 0.8},     {1000, 601, 0, 0.601}, {5, 3, 1, 0.6}, {1000, 401, 1, 0.401},
                 {5, 2, 2, 0.4},     {1000, 201, 2, 0.201}, {5, 1, 3, 0.2}, {5, 0, 3, 0},
                 {1000, 1000, 0, 1}, {4, 2, 1, 0.5},        {0, 0, 4, 0}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct sighting sighting = {.in_view = cases[i].in_view, .blocked = cases[i].blocked};
        sightings_judge(&sighting);
        assert_int_equal(sighting.visibility, cases[i].visibility);
        assert_close(sighting.blocked_share, cases[i].share, 0);
    }
}

static struct contributor from(const char *object, enum path path, const char *mirror)
{
    return (struct contributor){.id = {.object = object, .path = path, .mirror = mirror}};
}

/* A target of car and van together, one of the car alone with a wheel, one of the car's ghost with
 * clutter beside it, and a false alarm. */
TEST(targets_count_once_for_an_object_and_kind)
{
    struct contributor both[] = {from("car", PATH_DIRECT, NULL), from("car", PATH_DIRECT, NULL),
                                 from("van", PATH_DIRECT, NULL)};
    struct contributor alone[] = {from("car", PATH_DIRECT, NULL), from("car", PATH_WHEEL, NULL)};
    struct contributor ghost[] = {from("car", PATH_OBJECT_WALL, "rail"),
                                  from("car", PATH_WALL_OBJECT, "rail"),
                                  from("ground", PATH_CLUTTER, NULL)};
    struct contributor alarm[] = {from("noise", PATH_FALSE_ALARM, NULL)};
    struct target targets[] = {{.sensor = "left", .contributors = {both, 3, 3}},
                               {.sensor = "left", .contributors = {alone, 2, 2}},
                               {.sensor = "left", .contributors = {ghost, 3, 3}},
                               {.sensor = "right", .contributors = {alarm, 1, 1}}};
    struct sighting sightings[] = {{.sensor = "left", .object = "car", .detections = 7},
                                   {.sensor = "left", .object = "rail"},
                                   {.sensor = "left", .object = "van"},
                                   {.sensor = "right", .object = "car", .ghosts = 7}};
    struct frame frame = {.targets = {targets, 4, 4}, .visibility = {sightings, 4, 4}};
    static const int64_t due[][3] = {{2, 1, 1}, {0, 0, 0}, {1, 1, 0}, {0, 0, 0}};
    sightings_count_targets(&frame);
    for (size_t i = 0; i < COUNT(due); i++) {
        assert_int_equal(sightings[i].detections, due[i][0]);
        assert_int_equal(sightings[i].merged, due[i][1]);
        assert_int_equal(sightings[i].ghosts, due[i][2]);
    }
}
