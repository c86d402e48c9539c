#include "check.h"

#include "base/units.h"
#include "recorded/recorded_plausibility.h"

static const struct recorded_format format = {.name = "rows", .id_name = "id", .place = "row"};

/* A body in a step: its place, velocity and yaw. */
struct pose {
    double x_m, y_m, vx_mps, vy_mps, yaw_rad;
};

static struct recorded_stretch track_of(struct pose pose, size_t place)
{
    struct recorded_row row = recorded_row_unsaid;
    row.x_m = pose.x_m;
    row.y_m = pose.y_m;
    row.vx_mps = pose.vx_mps;
    row.vy_mps = pose.vy_mps;
    row.yaw_rad = pose.yaw_rad;
    row.place = place;
    return recorded_plausibility_begin(&row);
}

/* True if the way between two poses is denied, in a recording without scatter. */
static bool denies(struct pose from, struct pose to, double length_s)
{
    struct recorded_plausibility plausibility = {0};
    struct recorded_stretch before = track_of(from, 1), now = track_of(to, 2);
    return !recorded_plausibility_follow(&plausibility, &now, &before, length_s,
                                         RECORDED_WAY_PLAIN);
}

/* Follows one body through many poses. */
static void follow(struct recorded_plausibility *plausibility, const struct pose *poses,
                   size_t count, double length_s)
{
    struct recorded_stretch before = track_of(poses[0], 1);
    for (size_t i = 1; i < count; i++) {
        struct recorded_stretch now = track_of(poses[i], i + 1);
        recorded_plausibility_follow(plausibility, &now, &before, length_s, RECORDED_WAY_PLAIN);
        before = now;
    }
}

TEST(ways_that_the_speeds_deny_are_denied)
{
    assert_true(denies((struct pose){60, 0, 0, 0, 0}, (struct pose){60, 6.4, 0, 0, 0}, 0.1));
    assert_true(denies((struct pose){60, 0, 0, 0, 0}, (struct pose){60, 6.4, 0, 0, 0}, 1));
    assert_true(denies((struct pose){0, 0, 15, 0, 0}, (struct pose){15, 14.6, 15, 0, 0}, 1));
    assert_true(denies((struct pose){0, 0, 15, 0, 0}, (struct pose){29.6, 0, 15, 0, 0}, 1));
    assert_true(denies((struct pose){0, 0, 15, 0, 0}, (struct pose){-14.6, 0, 15, 0, 0}, 1));
}

TEST(ways_that_bodies_drive_stay)
{
    /* A quarter of a circle in a step, a stop within it, a start and a stop again between rests. */
    assert_false(denies((struct pose){0, 0, 12, 0, 0}, (struct pose){7.6, 7.6, 0, 12, PI / 2}, 1));
    assert_false(denies((struct pose){0, 0, 15, 0, 0}, (struct pose){2, 0, 0, 0, 0}, 1));
    assert_false(denies((struct pose){0, 0, 0, 0, 0}, (struct pose){9, 0, 0, 0, 0}, 3));
    /* Reversing, sliding sideways, a walker that turns round, noise of a body at rest. */
    assert_false(denies((struct pose){0, 0, -5, 0, 0}, (struct pose){-5, 0, -5, 0, 0}, 1));
    assert_false(denies((struct pose){0, 0, 0, 9, 0}, (struct pose){0, 9, 0, 9, 0}, 1));
    assert_false(denies((struct pose){0, 0, 1.5, 0, 0}, (struct pose){0, 0, -1.5, 0, PI}, 1));
    assert_false(denies((struct pose){0, 0, 0, 0, 0}, (struct pose){0.5, -0.6, 0, 0, 0}, 0.04));
}

TEST(a_speed_along_the_yaw_may_be_that_of_reversing)
{
    struct recorded_row row = recorded_row_unsaid;
    row.yaw_rad = 0;
    row.speed_mps = 8;
    struct recorded_plausibility plausibility = {0};
    struct recorded_stretch before = recorded_plausibility_begin(&row);
    row.x_m = -8;
    struct recorded_stretch now = recorded_plausibility_begin(&row);
    assert_true(recorded_plausibility_follow(&plausibility, &now, &before, 1, RECORDED_WAY_PLAIN));
    row.x_m = 0;
    row.y_m = 14.6;
    now = recorded_plausibility_begin(&row);
    assert_false(recorded_plausibility_follow(&plausibility, &now, &before, 1, RECORDED_WAY_PLAIN));
    assert_true(
        recorded_plausibility_follow(&plausibility, &now, &before, 1, RECORDED_WAY_EXPLAINED));
    assert_int_equal(plausibility.driving, 1);
}

/* Without speeds only 200 m/s deny a way. */
TEST(nothing_is_compared_without_speeds)
{
    const double unsaid = (double)NAN;
    struct pose from = {0, 0, unsaid, unsaid, unsaid}, to = {150, 0, unsaid, unsaid, unsaid};
    assert_false(denies(from, to, 1));
    assert_true(denies(from, to, 0.5));
    struct recorded_plausibility plausibility = {0};
    const struct pose poses[] = {from, to, from, to, from, to, from, to, from, to};
    follow(&plausibility, poses, 10, 1);
    assert_done(recorded_plausibility_check, &plausibility, &format, true);
}

/* Places that scatter by up to 2.8 m around a drive: after the first ways, none is denied. */
TEST(a_noisy_track_stays_whole)
{
    struct recorded_plausibility plausibility = {0};
    struct pose poses[400];
    uint64_t random = 1;
    for (size_t i = 0; i < 400; i++) {
        random = random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        double off_m = (double)(random >> 54) / 1023 * 2.8 - 1.4;
        poses[i] = (struct pose){0.6 * (double)i, off_m, 15, 0, 0};
    }
    follow(&plausibility, poses, 400, 0.04);
    size_t early = plausibility.driving;
    assert_true(early <= 2);
    follow(&plausibility, poses, 400, 0.04);
    assert_int_equal(plausibility.driving, early);
    assert_done(recorded_plausibility_check, &plausibility, &format, true);
}

/* A drive of 20 steps at 15 m/s, with factors on its places, speeds and times. */
static const char *drive(struct diag *diag, double places, double speeds, double times)
{
    struct recorded_plausibility plausibility = {0};
    struct pose poses[20];
    for (size_t i = 0; i < 20; i++)
        poses[i] = (struct pose){1.5 * (double)i * places, 0, 15 * speeds, 0, 0};
    follow(&plausibility, poses, 20, 0.1 * times);
    *diag = (struct diag){0};
    recorded_plausibility_check(&plausibility, &format, true, diag);
    return diag->text;
}

TEST(units_are_told_by_the_ratio)
{
    struct diag diag;
    static const struct {
        double places, speeds, times;
        const char *text;
    } cases[] = {
        {1, 3.6, 1, "speeds in km/h"},        {1, 2.237, 1, "speeds in miles/h"},
        {1, 3.281, 1, "speeds in feet/s"},    {1, 1.944, 1, "speeds in knots"},
        {3.281, 1, 1, "places in feet"},      {100, 1, 1, "places in cm"},
        {1 / 111320., 1, 1, "in degrees"},    {1, 0, 1, "speeds that are left at 0"},
        {1, 1, 1000, "times in the unit of"}, {1, 1, 1e-3, "times in another unit"},
    };
    assert_string_equal(drive(&diag, 1, 1, 1), "");
    assert_string_equal(drive(&diag, 1.2, 1, 1), "");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *text = drive(&diag, cases[i].places, cases[i].speeds, cases[i].times);
        assert_int_equal(diag.code, DIAG_DATA);
        if (strstr(text, cases[i].text) == NULL)
            fail_msg("%s, expected %s", text, cases[i].text);
    }
}

/* Bodies in all directions, in turn; meant gives the number that stands in the file. */
static const char *turn(struct diag *diag, double factor)
{
    struct recorded_plausibility plausibility = {0};
    for (int i = 0; i < 8; i++) {
        double yaw_rad = (0.15 + i) * PI / 4;
        struct pose poses[10];
        for (int k = 0; k < 10; k++)
            poses[k] = (struct pose){1.5 * k * cos(yaw_rad), 1.5 * k * sin(yaw_rad),
                                     15 * cos(yaw_rad), 15 * sin(yaw_rad), yaw_rad * factor};
        follow(&plausibility, poses, 10, 0.1);
    }
    *diag = (struct diag){0};
    recorded_plausibility_check(&plausibility, &format, true, diag);
    return diag->text;
}

TEST(yaws_in_another_unit_are_refused)
{
    struct diag diag;
    assert_string_equal(turn(&diag, 1), "");
    assert_non_null(strstr(turn(&diag, 180 / PI), "as with degrees that are taken for radians"));
    assert_non_null(strstr(turn(&diag, PI / 180), "as with radians that are taken for degrees"));
}

/* One body slides sideways and one reverses, all the time. */
TEST(yaws_of_sliding_and_reversing_bodies_are_no_contradiction)
{
    struct recorded_plausibility plausibility = {0};
    struct pose slides[100], reverses[100];
    for (int k = 0; k < 100; k++) {
        slides[k] = (struct pose){1.5 * k, 0, 15, 0, PI / 2};
        reverses[k] = (struct pose){-0.5 * k, 9, -5, 0, 0};
    }
    follow(&plausibility, slides, 100, 0.1);
    follow(&plausibility, reverses, 100, 0.1);
    assert_done(recorded_plausibility_check, &plausibility, &format, true);
}
