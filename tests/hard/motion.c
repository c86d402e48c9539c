/* Places, speeds and headings: hard cases 23, 24 and 35 to 38. */
#define SCRATCH_FILE "tracks.csv"
#include "support/recorded_file.h"
#include "support/scratch.h"

#include "hard.h"

#include "base/units.h"
#include "geometry/kinematics.h"
#include "geometry/motion.h"
#include "traffic/scenario.h"

static double worse(double one, double other)
{
    return isnan(other) ? one : fmax(one, other);
}

static struct vec2 draw_vector(uint64_t *random, double bound)
{
    double x = sample_between(random, -bound, bound);
    return (struct vec2){x, sample_between(random, -bound, bound)};
}

enum { TRACKS = 100 };

/* A coordinate in micrometres, around (5e5, 5.3e6) m, and as a table writes it. */
struct utm {
    int64_t x_um, y_um;
};

static struct utm draw_utm(uint64_t *random)
{
    struct utm utm = {INT64_C(500000000000), INT64_C(5300000000000)};
    utm.x_um += sample_integer(random, 200000000);
    utm.y_um += sample_integer(random, 200000000);
    return utm;
}

/* Ten seconds later, at 1 m/s along x, half a metre off at most. */
static struct utm draw_later(struct utm utm, uint64_t *random)
{
    utm.x_um += INT64_C(10000000) + sample_integer(random, 500000);
    utm.y_um += sample_integer(random, 500000);
    return utm;
}

static int write_tracks(const char *path, struct utm *places, int steps)
{
    uint64_t random = 23;
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs("track_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width\n", file);
    for (int i = 0; i < steps * TRACKS; i++) {
        places[i] = i < TRACKS ? draw_utm(&random) : draw_later(places[i - TRACKS], &random);
        fprintf(file, "%03d,%d,car,%lld.%06d,%lld.%06d,1,0,0,4,2\n", i % TRACKS, i / TRACKS * 10000,
                (long long)(places[i].x_um / 1000000), (int)(places[i].x_um % 1000000),
                (long long)(places[i].y_um / 1000000), (int)(places[i].y_um % 1000000));
    }
    return fclose(file);
}

/* The exact local coordinate: um / 1e6 - origin, the origin being the one that the frame names. */
static double local_error_m(double local_m, int64_t um, double origin_m, mpfr_t work)
{
    mpfr_set_sj(work, um, MPFR_RNDN);
    mpfr_div_ui(work, work, 1000000, MPFR_RNDN);
    mpfr_sub_d(work, work, origin_m, MPFR_RNDN);
    return error_size(local_m, work);
}

/* The exact coordinate in a frame with the heading (0.6, 0.8); the plain way turns before it
 * subtracts. */
static double turned_error_m(struct utm utm, struct vec2 origin_m, mpfr_t *work)
{
    struct vec2 heading = {0.6, 0.8}, place = {(double)utm.x_um / 1e6, (double)utm.y_um / 1e6};
    double ahead_m = vec2_turn_back(place, heading).x - vec2_turn_back(origin_m, heading).x;
    mpfr_set_sj(work[0], utm.x_um, MPFR_RNDN);
    mpfr_div_ui(work[0], work[0], 1000000, MPFR_RNDN);
    mpfr_sub_d(work[0], work[0], origin_m.x, MPFR_RNDN);
    mpfr_mul_d(work[0], work[0], heading.x, MPFR_RNDN);
    mpfr_set_sj(work[1], utm.y_um, MPFR_RNDN);
    mpfr_div_ui(work[1], work[1], 1000000, MPFR_RNDN);
    mpfr_sub_d(work[1], work[1], origin_m.y, MPFR_RNDN);
    mpfr_mul_d(work[1], work[1], heading.y, MPFR_RNDN);
    mpfr_add(work[0], work[0], work[1], MPFR_RNDN);
    return error_size(ahead_m, work[0]);
}

/* The exact distance of two places. */
static double range_error_m(double range_m, struct utm one, struct utm other, mpfr_t *work)
{
    mpfr_set_sj(work[0], one.x_um - other.x_um, MPFR_RNDN);
    mpfr_set_sj(work[1], one.y_um - other.y_um, MPFR_RNDN);
    mpfr_hypot(work[0], work[0], work[1], MPFR_RNDN);
    mpfr_div_ui(work[0], work[0], 1000000, MPFR_RNDN);
    return error_size(range_m, work[0]);
}

/* Hard case 23: a table of UTM places, read as glint-traffic reads it; local places and ranges from
 * the ego. */
SCRATCH_TEST(utm_places_keep_a_nanometre)
{
    int steps = hard_points(100000) / TRACKS;
    struct utm *places = arena_get(&scratch->arena, (size_t)(steps * TRACKS) * sizeof *places);
    assert_int_equal(write_tracks(scratch->path, places, steps), 0);
    struct recording scene;
    recorded_file_open(&scene, scratch->path, "000", &scratch->arena);
    double naive = 0, ours = 0;
    mpfr_t work[2];
    mpfr_inits2(320, work[0], work[1], (mpfr_ptr)NULL);
    struct frame frame = {.arena = check_arena()};
    for (int step = 0; step < steps; step++) {
        recorded_file_next(&scene, &frame);
        assert_int_equal(frame.objects.count, TRACKS);
        assert_true(frame.origin_x_m == round((double)places[0].x_um / 1e6) &&
                    frame.origin_y_m == round((double)places[0].y_um / 1e6));
        struct vec2 origin_m = {frame.origin_x_m, frame.origin_y_m};
        const struct utm *now = places + step * TRACKS;
        struct vec2 ego_m = {frame.objects.items[0].x_m, frame.objects.items[0].y_m};
        for (int i = 0; i < TRACKS; i++) {
            const struct object *object = &frame.objects.items[i];
            struct vec2 place_m = {object->x_m, object->y_m};
            struct kinematics sight = kinematics_of(ego_m, (struct vec2){0, 0}, (struct vec2){1, 0},
                                                    place_m, (struct vec2){0, 0});
            ours = fmax(ours, local_error_m(place_m.x, now[i].x_um, origin_m.x, work[0]));
            ours = fmax(ours, local_error_m(place_m.y, now[i].y_um, origin_m.y, work[0]));
            ours = fmax(ours, range_error_m(sight.range_m, now[0], now[i], work));
            naive = fmax(naive, turned_error_m(now[i], origin_m, work));
        }
    }
    mpfr_clears(work[0], work[1], (mpfr_ptr)NULL);
    recording_close(&scene);
    hard_case("23", "UTM places of a table, and ranges", "m", naive, ours, 1e-9);
}

/* Hard case 24: a million frames of a body that goes straight from a UTM place. */
TEST(a_million_frames_go_straight)
{
    const double rate_hz = 20, speed_mps = 33.3, yaw_rad = 0.7;
    const struct vec2 origin_m = {500000, 5300000};
    struct actor actor = {.id = "a",
                          .class = "car",
                          .x_m = 500000.25,
                          .y_m = 5300000.75,
                          .yaw_rad = yaw_rad,
                          .speed_mps = speed_mps};
    struct scenario scenario = {.rate_hz = rate_hz};
    struct actor actors[] = {actor};
    scenario.objects.items = actors;
    scenario.objects.count = 1;
    scenario_shift(&scenario, origin_m);
    actor_prepare(&actors[0], check_arena());
    double naive = 0, ours = 0, sum_m = actor.y_m;
    MPFR_DECL_INIT(start, 320);
    MPFR_DECL_INIT(speed, 320);
    MPFR_DECL_INIT(exact, 320);
    mpfr_set_d(speed, yaw_rad, MPFR_RNDN);
    mpfr_sin(speed, speed, MPFR_RNDN);
    mpfr_mul_d(speed, speed, speed_mps, MPFR_RNDN);
    mpfr_set_d(start, 0.75, MPFR_RNDN);
    for (int i = 0; i < hard_points(1000000); i++) {
        double travelled_m, time_s = i / rate_hz;
        struct motion body = actor_motion(&actors[0], time_s, &travelled_m);
        mpfr_mul_ui(exact, speed, (unsigned long)i, MPFR_RNDN);
        mpfr_div_d(exact, exact, rate_hz, MPFR_RNDN);
        mpfr_add(exact, exact, start, MPFR_RNDN);
        double exact_m = mpfr_get_d(exact, MPFR_RNDN);
        naive = fmax(naive, fabs(sum_m - origin_m.y - exact_m));
        ours = fmax(ours, error_size(body.position_m.y, exact));
        sum_m += speed_mps * elementary_sin(yaw_rad) / rate_hz;
    }
    hard_case("24", "1e6 frames straight on", "m", naive, ours, 1e-9);
}

/* The exact v . r / |r| of the given doubles. */
static void exact_rate(struct vec2 r, struct vec2 v, mpfr_t exact, mpfr_t work)
{
    mpfr_set_d(exact, r.x, MPFR_RNDN);
    mpfr_mul_d(exact, exact, v.x, MPFR_RNDN);
    mpfr_set_d(work, r.y, MPFR_RNDN);
    mpfr_mul_d(work, work, v.y, MPFR_RNDN);
    mpfr_add(exact, exact, work, MPFR_RNDN);
    MPFR_DECL_INIT(x, 320);
    MPFR_DECL_INIT(y, 320);
    mpfr_set_d(x, r.x, MPFR_RNDN);
    mpfr_set_d(y, r.y, MPFR_RNDN);
    mpfr_hypot(work, x, y, MPFR_RNDN);
    mpfr_div(exact, exact, work, MPFR_RNDN);
}

/* Hard case 35: motion that is tangential but for rounding; the sign is right if the error is a few
 * ulp. */
TEST(a_nearly_tangential_speed_keeps_its_sign)
{
    uint64_t random = 35;
    double naive = 0, ours = 0;
    const struct vec2 o = {0, 0}, ahead = {1, 0};
    MPFR_DECL_INIT(exact, 320);
    MPFR_DECL_INIT(work, 320);
    for (int i = 0; i < hard_points(300000); i++) {
        struct vec2 r = draw_vector(&random, 100);
        struct vec2 v = vec2_scale(sample_between(&random, -1, 1), vec2_left(r));
        double rate_mps = kinematics_of(o, o, ahead, r, v).range_rate_mps;
        exact_rate(r, v, exact, work);
        ours = fmax(ours, error_ulp(rate_mps, exact));
        naive = fmax(naive, error_ulp(vec2_dot(r, v) / vec2_length(r), exact));
    }
    hard_case("35", "range rate of tangential motion", "ulp", naive, ours, 4);
}

TEST(ranges_are_never_differenced)
{
    uint64_t random = 36;
    double naive = 0, ours = 0;
    const struct vec2 o = {0, 0}, ahead = {1, 0};
    MPFR_DECL_INIT(exact, 320);
    MPFR_DECL_INIT(work, 320);
    for (int i = 0; i < hard_points(100000); i++) {
        struct vec2 aside = vec2_heading(sample_between(&random, -PI, PI));
        struct vec2 r = vec2_scale(10, aside), v = vec2_scale(30, vec2_left(aside));
        double later_m = vec2_length(vec2_add(r, vec2_scale(1e-3, v)));
        double rate_mps = kinematics_of(o, o, ahead, r, v).range_rate_mps;
        exact_rate(r, v, exact, work);
        naive = fmax(naive, fabs((later_m - vec2_length(r)) / 1e-3 - mpfr_get_d(exact, MPFR_RNDN)));
        ours = fmax(ours, error_size(rate_mps, exact));
    }
    hard_case("36", "range rate without differences", "m/s", naive, ours, 30 * 4e-16);
}

enum { WORKS = 8 };

/* The exact way along one axis, for turn > 0 in closed form over plenty of bits: the real part of
 *
 * e^(i yaw) ((v + a t) e^(i w t) / (i w) - v / (i w) + a (e^(i w t) - 1) / w^2);
 *
 * its imaginary part is the way for yaw - pi/2. */
static void exact_way(double yaw_rad, bool across, double v, double a, double w, double t,
                      mpfr_t way, mpfr_t *m)
{
    mpfr_set_d(m[0], yaw_rad, MPFR_RNDN);
    if (across) {
        mpfr_const_pi(m[1], MPFR_RNDN);
        mpfr_div_2ui(m[1], m[1], 1, MPFR_RNDN);
        mpfr_sub(m[0], m[0], m[1], MPFR_RNDN);
    }
    mpfr_set_d(m[1], w, MPFR_RNDN);
    mpfr_mul_d(m[1], m[1], t, MPFR_RNDN);
    mpfr_add(m[1], m[1], m[0], MPFR_RNDN);
    mpfr_sin_cos(m[2], m[3], m[0], MPFR_RNDN);
    mpfr_sin_cos(m[4], m[5], m[1], MPFR_RNDN);
    mpfr_set_d(way, a, MPFR_RNDN);
    mpfr_mul_d(way, way, t, MPFR_RNDN);
    mpfr_add_d(way, way, v, MPFR_RNDN);
    mpfr_mul(way, way, m[4], MPFR_RNDN);
    mpfr_mul_d(m[2], m[2], v, MPFR_RNDN);
    mpfr_sub(way, way, m[2], MPFR_RNDN);
    mpfr_sub(m[5], m[5], m[3], MPFR_RNDN);
    mpfr_mul_d(m[5], m[5], a, MPFR_RNDN);
    mpfr_div_d(m[5], m[5], w, MPFR_RNDN);
    mpfr_add(way, way, m[5], MPFR_RNDN);
    mpfr_div_d(way, way, w, MPFR_RNDN);
}

/* Hard case 37: steps of up to a second, with turns from next to nothing to one radian. */
TEST(a_turning_step_needs_no_small_angle)
{
    uint64_t random = 37;
    double naive = 0, ours = 0;
    const struct vec2 o = {0, 0};
    mpfr_t way, m[WORKS];
    mpfr_init2(way, 1000);
    for (int i = 0; i < WORKS; i++)
        mpfr_init2(m[i], 1000);
    for (int i = 0; i < hard_points(100000); i++) {
        double yaw = sample_between(&random, -PI, PI), t = sample_between(&random, 0.01, 1);
        double v = sample_between(&random, 1, 50), a = i % 2 ? sample_between(&random, -9, 9) : 0;
        double w = i % 100 ? ldexp(sample_between(&random, 0.5, 1), -(i % 60)) : 1.3e-14;
        struct motion end = motion_drive(o, yaw, v, a, w, t);
        double length_m = motion_drive_length_m(v, a, t);
        exact_way(yaw, false, v, a, w, t, way, m);
        if (a == 0) {
            double plain_m = v / w * (elementary_sin(yaw + w * t) - elementary_sin(yaw));
            naive = worse(naive, fabs(plain_m - mpfr_get_d(way, MPFR_RNDN)) / length_m);
        }
        double x_m = error_size(end.position_m.x, way) / length_m;
        exact_way(yaw, true, v, a, w, t, way, m);
        ours = fmax(ours, hypot(x_m, error_size(end.position_m.y, way) / length_m));
    }
    mpfr_clear(way);
    for (int i = 0; i < WORKS; i++)
        mpfr_clear(m[i]);
    hard_case("37", "a turning, accelerating step", "m/m", naive, ours, 1e-15);
}

/* Hard case 38: angles on the circle, against 2 pi to 1400 bits: any double, and doubles next to
 * half turns. */
static double wrap_error_rad(double angle_rad, double wrapped_rad, mpfr_t turn, mpfr_t exact)
{
    mpfr_set_d(exact, angle_rad, MPFR_RNDN);
    mpfr_sub_d(exact, exact, wrapped_rad, MPFR_RNDN);
    mpfr_remainder(exact, exact, turn, MPFR_RNDN);
    return fabs(mpfr_get_d(exact, MPFR_RNDN));
}

static double draw_angle(uint64_t *random, int kind)
{
    static const double fixed[] = {1e17, -1e17, 1e300, -1e300, PI, -PI, 1.7976931348623157e308};
    double sign = kind % 2 ? 1 : -1;
    if (kind % 1000 < 7)
        return fixed[kind % 1000];
    if (kind % 3 == 0)
        return sign * sample_between(random, 0, 1e3);
    if (kind % 3 == 1)
        return sign * (PI * (double)(sample_integer(random, 1 << 20)));
    int exponent = (int)(sample_bits(random) % 2097) - 1074;
    return sign * ldexp(sample_between(random, 1, 2), exponent);
}

TEST(every_angle_wraps_exactly)
{
    uint64_t random = 38;
    double naive = 0, ours = 0;
    MPFR_DECL_INIT(turn, 2200);
    MPFR_DECL_INIT(exact, 2200);
    mpfr_const_pi(turn, MPFR_RNDN);
    mpfr_mul_2ui(turn, turn, 1, MPFR_RNDN);
    for (int i = 0; i < hard_points(1000000); i++) {
        double angle_rad = draw_angle(&random, i), wrapped_rad = units_wrap_rad(angle_rad);
        assert_true(wrapped_rad > -PI && wrapped_rad <= PI);
        ours = fmax(ours, wrap_error_rad(angle_rad, wrapped_rad, turn, exact));
        naive = fmax(naive, wrap_error_rad(angle_rad, remainder(angle_rad, 2 * PI), turn, exact));
    }
    hard_case("38", "wrapped angles of every size", "rad", naive, ours, 1e-15);
}

/* Headings up to 1e17 rad: the place where a body arrives that drives along them. */
TEST(a_heading_of_any_size_points_somewhere)
{
    uint64_t random = 138;
    double naive = 0, ours = 0;
    mpfr_t yaw, sine, cosine, work;
    mpfr_inits2(320, yaw, sine, cosine, work, (mpfr_ptr)NULL);
    for (int i = 0; i < hard_points(100000); i++) {
        double yaw_rad = i ? sample_between(&random, -1e17, 1e17) : 1e17;
        struct motion end = motion_drive((struct vec2){0, 0}, yaw_rad, 30, 0, 0, 1);
        struct vec2 plain = vec2_heading(remainder(yaw_rad, 2 * PI));
        mpfr_set_d(yaw, yaw_rad, MPFR_RNDN);
        mpfr_sin_cos(sine, cosine, yaw, MPFR_RNDN);
        mpfr_sub_d(work, sine, plain.y, MPFR_RNDN);
        naive = fmax(naive, fabs(mpfr_get_d(work, MPFR_RNDN)));
        mpfr_mul_ui(sine, sine, 30, MPFR_RNDN);
        mpfr_mul_ui(cosine, cosine, 30, MPFR_RNDN);
        double x_m = error_size(end.position_m.x, cosine), y_m = error_size(end.position_m.y, sine);
        ours = fmax(ours, hypot(x_m, y_m) / 30);
    }
    mpfr_clears(yaw, sine, cosine, work, (mpfr_ptr)NULL);
    hard_case("heading", "driving along up to 1e17 rad", "m/m", naive, ours, 1e-15);
}
