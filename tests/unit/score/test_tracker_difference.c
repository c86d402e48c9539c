#include "check.h"

#include "base/random.h"
#include "score/tracker_difference.h"

static const double NONE[TRACKER_FIGURES] = {0};

static void add(struct tracker_scenes *scenes, int number, double gospa, struct arena *arena)
{
    char name[16];
    snprintf(name, sizeof name, "s%d", number);
    double figures[TRACKER_FIGURES] = {[TRACKER_GOSPA] = gospa, [TRACKER_FALSE] = 2 * gospa};
    tracker_difference_add(scenes, name, figures, NONE, arena);
}

/* 1, 2, 3, 4, 5 have the mean 3, the standard error sqrt(1/2), and t = 2.776 with 4 degrees of
 * freedom. A scene counts once, however many frames it has. */
TEST(the_interval_is_students_over_scenes)
{
    struct tracker_scenes scenes = {0};
    struct tracker_difference difference;
    for (int scene = 1; scene <= 5; scene++)
        for (int frame = 0; frame < scene; frame++)
            add(&scenes, scene, scene, check_arena());
    assert_done(tracker_difference_of, &scenes, &difference);
    assert_int_equal(difference.scenes, 5);
    assert_close(difference.figures[TRACKER_GOSPA].mean, 3, 1e-12);
    assert_close(difference.figures[TRACKER_GOSPA].low, 3 - 2.776 * sqrt(0.5), 0.02);
    assert_close(difference.figures[TRACKER_FALSE].high, 6 + 2 * 2.776 * sqrt(0.5), 0.04);
    assert_close(difference.figures[TRACKER_MISSED].high, 0, 0);
}

TEST(fewer_than_five_scenes_are_refused)
{
    struct tracker_scenes scenes = {0};
    struct tracker_difference difference;
    for (int scene = 0; scene < 4; scene++)
        add(&scenes, scene, 1, check_arena());
    assert_refused(DIAG_DATA, "--against: number of scenes: 4; expected at least 5",
                   tracker_difference_of, &scenes, &difference);
}

/* Scenes differ by a Gaussian number, and by the square of one, which is skewed, less its mean. */
static double covered(int scenes_each, bool skewed)
{
    enum { TRIALS = 2000 };
    int inside = 0;
    struct random_address address = {.seed = 3};
    for (int trial = 0; trial < TRIALS; trial++) {
        struct tracker_scenes scenes = {0};
        struct tracker_difference difference;
        for (int scene = 0; scene < scenes_each; scene++) {
            double draw[4];
            address.frame++;
            random_gaussian(&address, RANDOM_POINTERS, 0, draw);
            add(&scenes, scene, skewed ? draw[0] * draw[0] - 1 : draw[0], check_arena());
        }
        assert_done(tracker_difference_of, &scenes, &difference);
        inside += difference.figures[TRACKER_GOSPA].low <= 0 &&
                  difference.figures[TRACKER_GOSPA].high >= 0;
        arena_clear(check_arena());
    }
    return (double)inside / TRIALS;
}

TEST(the_interval_covers_95_percent_of_gaussian_scenes)
{
    assert_close(covered(5, false), 0.95, 0.02);
    assert_close(covered(20, false), 0.95, 0.02);
}

TEST(the_interval_of_skewed_scenes_covers_nearly_as_much)
{
    assert_true(covered(20, true) > 0.88);
}
