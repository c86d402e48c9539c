#include "recorded/recorded_plausibility.h"

#include <stdio.h>

#include "base/units.h"

static const double BOUND_M = 2, BOUND_MPS2 = 1, BOUND_SHARE = 0.25, BOUND_SCATTERS = 3,
                    BIN_M = 0.1, EARLY_M = 0.7, STRETCH_M = 3, STRETCH_S = 3, NOISE_SHARE = 8,
                    MOST_NOISE_M = 12, ALIKE = 1.5, STANDS_MPS = 0.1, SLANT_RAD = PI / 6,
                    REST_M = 50, REST_SHARE = 5e-3;
enum { CLEAN_WAYS = 30, SURE_WAYS = 200, SURE_DENIED = 8, SURE_M = 10 };
enum { SURE_SLANTED = 3, SURE_EXPLAINED = 2, SURE_EXPLAINED_YAWS = 8, SURE_YAWS = 20 };

/* ---- ways ---- */

struct recorded_stretch recorded_plausibility_begin(const struct recorded_row *row)
{
    bool vector = !isnan(row->vx_mps) && !isnan(row->vy_mps);
    struct recorded_stretch track = {
        .at_m = {row->x_m, row->y_m},
        .velocity_mps = {row->vx_mps, row->vy_mps},
        .speed_mps = vector ? elementary_hypot(row->vx_mps, row->vy_mps) : fabs(row->speed_mps),
        .yaw_rad = row->yaw_rad,
        .place = row->place,
    };
    track.from_m = track.at_m;
    track.from_yaw_rad = track.yaw_rad;
    track.reversible = !vector && !isnan(row->yaw_rad) && !isnan(row->speed_mps);
    if (track.reversible)
        track.velocity_mps = vec2_scale(row->speed_mps, vec2_heading(row->yaw_rad));
    return track;
}

/* By how much the way leads beyond what the speeds allow; NAN without speeds. The mean of
 * velocities that turn from one into the other lies in the circle that has the two as ends of a
 * diameter, and a body that stops on the way has a share of it. */
static double deviation_m(const struct recorded_stretch *now, const struct recorded_stretch *before,
                          struct vec2 way_m, double length_s)
{
    if (isnan(now->speed_mps) || isnan(before->speed_mps))
        return (double)NAN;
    double fastest_mps = elementary_max(now->speed_mps, before->speed_mps);
    if (isnan(now->velocity_mps.x) || isnan(before->velocity_mps.x))
        return elementary_max(vec2_length(way_m) - fastest_mps * length_s, 0);
    struct vec2 sum_mps = vec2_add(now->velocity_mps, before->velocity_mps);
    struct vec2 change_mps = vec2_sub(now->velocity_mps, before->velocity_mps);
    struct vec2 said_m = vec2_scale(length_s / 2, sum_mps);
    double square = vec2_dot(said_m, said_m), share = 0;
    double least = now->reversible ? -1 : 0;
    if (square > 0)
        share = elementary_min(elementary_max(vec2_dot(way_m, said_m) / square, least), 1);
    double aside_m = vec2_length(vec2_sub(way_m, vec2_scale(share, said_m)));
    return elementary_max(aside_m - length_s / 2 * vec2_length(change_mps), 0);
}

/* The deviation that no more than so many ways exceed. */
static double exceeded_m(const struct recorded_plausibility *plausibility, uint64_t ways)
{
    size_t bin = plausibility->most;
    while (bin > 0 && plausibility->scatter[bin] <= ways)
        ways -= plausibility->scatter[bin--];
    return BIN_M * (double)bin;
}

/* The deviation that nine of ten ways do not exceed; some ways without any are added, so that the
 * first ways of a recording do not decide alone. */
static double scatter_m(const struct recorded_plausibility *plausibility)
{
    return exceeded_m(plausibility, (plausibility->ways + CLEAN_WAYS) / 10);
}

/* The scatter that a way may have. Where ways are judged while they are read, the first ones do not
 * know that of the recording. */
static double allowed_m(const struct recorded_plausibility *plausibility)
{
    bool early = !plausibility->whole && plausibility->ways < CLEAN_WAYS;
    return elementary_max(scatter_m(plausibility), early ? EARLY_M : 0);
}

static void count_deviation(struct recorded_plausibility *plausibility, double deviation_m)
{
    size_t bin = (size_t)elementary_min(floor(deviation_m / BIN_M), RECORDED_SCATTER_BINS - 1);
    plausibility->scatter[bin]++;
    plausibility->most = bin > plausibility->most ? bin : plausibility->most;
    plausibility->ways++;
}

static void note_place(struct recorded_plausibility *plausibility,
                       const struct recorded_stretch *now)
{
    if (plausibility->place == 0)
        plausibility->place = now->place;
}

/* ---- stretches ---- */

static double meant_rad(double yaw_rad, enum recorded_yaw meaning)
{
    switch (meaning) {
    case RECORDED_YAW_DEGREES:
        return yaw_rad * (PI / 180);
    case RECORDED_YAW_RADIANS:
        return yaw_rad * (180 / PI);
    case RECORDED_YAW_COMPASS:
        return PI / 2 - yaw_rad;
    case RECORDED_YAW_MIRRORED:
        return -yaw_rad;
    default:
        return yaw_rad;
    }
}

/* Adds the angles between the direction of the stretch and the mean of its first and last yaw. Yaws
 * count modulo pi if a body may reverse. */
static void count_yaw(struct recorded_slants *slants, const struct recorded_stretch *now,
                      bool forward)
{
    const double folds = forward ? 1 : 2;
    struct vec2 way_m = vec2_sub(now->at_m, now->from_m);
    double direction_rad = elementary_atan2(way_m.y, way_m.x);
    slants->stretches++;
    for (enum recorded_yaw i = 0; i < RECORDED_YAWS; i++) {
        double from_rad = meant_rad(now->from_yaw_rad, i), to_rad = meant_rad(now->yaw_rad, i);
        double mean_rad = from_rad + units_wrap_rad(to_rad - from_rad) / 2;
        double off_rad = fabs(units_wrap_rad(folds * (mean_rad - direction_rad))) / folds;
        slants->off_rad[i] += off_rad;
        if (i != RECORDED_YAW_STATED)
            continue;
        slants->contradicting += off_rad > SLANT_RAD;
        if (off_rad <= slants->most_rad)
            continue;
        slants->most_rad = off_rad;
        slants->yaw_rad = now->yaw_rad;
        slants->place = now->place;
    }
}

static void judge_yaw(struct recorded_plausibility *plausibility, struct recorded_stretch *now)
{
    if (isnan(now->yaw_rad) || isnan(now->from_yaw_rad))
        return;
    uint64_t contradicting = plausibility->all.contradicting;
    count_yaw(&plausibility->all, now, plausibility->forward);
    if (fabs(now->yaw_rad) > 2 * PI)
        count_yaw(&plausibility->far, now, plausibility->forward);
    if (plausibility->all.contradicting == contradicting)
        return;
    plausibility->slanted += !now->slanted;
    now->slanted = true;
}

static void judge_length(struct recorded_plausibility *plausibility,
                         const struct recorded_stretch *now, double moved_m, double led_m)
{
    struct recorded_contradiction *kind = NULL;
    if (led_m > ALIKE * moved_m)
        kind = &plausibility->rests;
    if (moved_m > ALIKE * now->said_m)
        kind = &plausibility->leaps;
    if (kind == NULL) {
        plausibility->agreeing += now->ways;
        return;
    }
    note_place(plausibility, now);
    kind->ways += now->ways;
    kind->moved_m += moved_m;
    kind->said_m += now->said_m;
    plausibility->stretches_m += elementary_max(moved_m, now->said_m);
}

static void begin_stretch(struct recorded_stretch *now)
{
    now->from_m = now->at_m;
    now->from_yaw_rad = now->yaw_rad;
    now->lasts_s = now->said_m = 0;
    now->led_m = (struct vec2){0, 0};
    now->ways = 0;
}

/* Noise spreads the deviations; what is the same in all ways is none. */
static double least_stretch_m(const struct recorded_plausibility *plausibility)
{
    double spread_m = scatter_m(plausibility) - exceeded_m(plausibility, plausibility->ways / 2);
    double noise_m = NOISE_SHARE * elementary_max(spread_m, 0);
    return STRETCH_M + elementary_min(noise_m, MOST_NOISE_M);
}

/* Judges the stretch if it is long enough, and begins another; or if it lasts too long. */
static void end_stretch(struct recorded_plausibility *plausibility, struct recorded_stretch *now)
{
    double moved_m = vec2_length(vec2_sub(now->at_m, now->from_m));
    double led_m = isnan(now->led_m.x) ? now->said_m : vec2_length(now->led_m);
    if (moved_m < STRETCH_M && !(led_m >= STRETCH_M) && now->lasts_s <= STRETCH_S)
        return;
    double least_m = least_stretch_m(plausibility);
    bool stated = !isnan(now->said_m);
    bool whole = moved_m >= least_m || (stated && led_m >= least_m);
    bool timely = now->ways == 1 || now->lasts_s <= STRETCH_S / STRETCH_M * least_m;
    if (!whole && timely)
        return;
    if (whole && timely && stated)
        judge_length(plausibility, now, moved_m, led_m);
    if (whole && timely && moved_m >= least_m / ALIKE)
        judge_yaw(plausibility, now);
    begin_stretch(now);
}

/* Counts a denied way. The directions of such ways are judged, too: where yaws are wrong and
 * velocities follow them, all ways may be denied. Ways that the speeds do not deny (said_m NAN) say
 * nothing of units. */
static void deny(struct recorded_plausibility *plausibility, struct recorded_stretch *now,
                 const struct recorded_stretch *before, double far_m, double fastest_mps,
                 double said_m)
{
    if (plausibility->counted)
        return;
    if (plausibility->standing + plausibility->driving + plausibility->fast == 0)
        plausibility->first = now->place;
    if (isnan(fastest_mps))
        plausibility->fast++;
    else if (fastest_mps < STANDS_MPS)
        plausibility->standing++;
    else
        plausibility->driving++;
    if (plausibility->learned || isnan(said_m))
        return;
    note_place(plausibility, now);
    plausibility->leaps.ways++;
    plausibility->leaps.moved_m += far_m;
    plausibility->leaps.said_m += said_m;
    now->from_m = before->at_m;
    now->from_yaw_rad = before->yaw_rad;
    if (far_m >= STRETCH_M)
        judge_yaw(plausibility, now);
    begin_stretch(now);
}

static void note_rest(struct recorded_plausibility *plausibility,
                      const struct recorded_stretch *now, const struct recorded_stretch *before,
                      double far_m, double length_s)
{
    double said_m = elementary_min(now->speed_mps, before->speed_mps) * length_s;
    if (plausibility->rest.ways > 0 || !(said_m >= REST_M) || far_m > REST_SHARE * said_m)
        return;
    plausibility->rest = (struct recorded_contradiction){1, far_m, said_m};
    plausibility->rest_s = length_s;
    plausibility->rest_place = now->place;
}

static void continue_stretch(struct recorded_stretch *now, const struct recorded_stretch *before,
                             double said_m, double length_s)
{
    struct vec2 sum_mps = vec2_add(now->velocity_mps, before->velocity_mps);
    now->from_m = before->from_m;
    now->from_yaw_rad = before->from_yaw_rad;
    now->lasts_s = before->lasts_s + length_s;
    now->said_m = before->said_m + said_m;
    now->led_m = vec2_add(before->led_m, vec2_scale(length_s / 2, sum_mps));
    now->ways = before->ways + 1;
}

bool recorded_plausibility_follow(struct recorded_plausibility *plausibility,
                                  struct recorded_stretch *now,
                                  const struct recorded_stretch *before, double length_s,
                                  enum recorded_way way)
{
    struct vec2 way_m = vec2_sub(now->at_m, before->at_m);
    double far_m = vec2_length(way_m), beyond_m = deviation_m(now, before, way_m, length_s);
    double fastest_mps =
        isnan(beyond_m) ? (double)NAN : elementary_max(now->speed_mps, before->speed_mps);
    double said_m = (now->speed_mps + before->speed_mps) / 2 * length_s;
    double bound_m = BOUND_M + length_s * (BOUND_MPS2 * length_s + BOUND_SHARE * fastest_mps);
    bool learns = !plausibility->learned, plain = way == RECORDED_WAY_PLAIN;
    if (learns && far_m > 0 && plain && !isnan(beyond_m))
        count_deviation(plausibility, beyond_m);
    bool denied = plain && beyond_m > bound_m &&
                  beyond_m > bound_m + BOUND_SCATTERS * allowed_m(plausibility);
    denied = denied || way == RECORDED_WAY_LEFT || far_m > RECORDED_FASTEST_MPS * length_s;
    now->slanted = before->slanted;
    if (denied) {
        deny(plausibility, now, before, far_m, fastest_mps, plain ? said_m : (double)NAN);
        return false;
    }
    continue_stretch(now, before, said_m, length_s);
    if (learns) {
        note_rest(plausibility, now, before, far_m, length_s);
        end_stretch(plausibility, now);
    }
    return true;
}

/* ---- the verdict ---- */

/* What explains the length by the speeds as a multiple of that by the places; NULL if nothing that
 * we know does. */
static const char *unit_of(double ratio)
{
    static const struct {
        double low, high;
        const char *unit;
    } units[] = {
        {0, 1e-7, "speeds that are left at 0"},
        {0.95e-6, 1.05e-6, "times in another unit than that of their column"},
        {0.95e-3, 1.05e-3, "places in mm, or times in another unit than that of their column"},
        {0.95e-2, 1.05e-2, "places in cm"},
        {0.29, 0.32, "places in feet"},
        {1.87, 2.02, "speeds in knots"},
        {2.15, 2.33, "speeds in miles/h"},
        {3.15, 3.43, "speeds in feet/s"},
        {3.44, 3.78, "speeds in km/h"},
        {0.95e2, 1.05e2, "speeds in cm/s"},
        {0.95e3, 1.05e3, "speeds in mm/s, or times in another unit than that of their column"},
        {0.95e6, 1.05e6, "times in another unit than that of their column"},
        {1.5e4, (double)INFINITY, "places in degrees"},
    };
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (ratio >= units[i].low && ratio <= units[i].high)
            return units[i].unit;
    return NULL;
}

static int refuse_units(const struct recorded_contradiction *ways, size_t place,
                        const struct recorded_format *format, struct diag *diag)
{
    double ratio = ways->said_m / ways->moved_m;
    const char *unit = unit_of(ratio), *advice = "";
    if (format->of_sumo && ratio > 100)
        advice = ": run sumo without --fcd-output.geo";
    return diag_fail(
        diag, DIAG_DATA,
        "%s %zu: from here on road users move by %.3g m where their speeds say %.3g m, "
        "%.3g times as far%s%s; expected places in m and speeds in m/s%s",
        format->place, place, ways->moved_m, ways->said_m, ratio, unit != NULL ? ", as with " : "",
        unit != NULL ? unit : "", advice);
}

static int refuse_rest(const struct recorded_plausibility *plausibility,
                       const struct recorded_format *format, struct diag *diag)
{
    return diag_fail(diag, DIAG_DATA,
                     "%s %zu: a road user moves by %.3g m in %.6g s where its speeds say %.0f m; "
                     "expected times in the unit of their column, and places in m",
                     format->place, plausibility->rest_place, plausibility->rest.moved_m,
                     plausibility->rest_s, plausibility->rest.said_m);
}

/* It is a matter of units if nine of ten ways contradict in the same sense and are not all 0. */
static int refuse_speeds(const struct recorded_plausibility *plausibility,
                         const struct recorded_format *format, struct diag *diag)
{
    const struct recorded_contradiction *rests = &plausibility->rests;
    const struct recorded_contradiction *leaps = &plausibility->leaps;
    const struct recorded_contradiction *most = rests->ways > leaps->ways ? rests : leaps;
    char longer[80] = "";
    if (most->moved_m > 0 && 10 * most->ways >= 9 * (rests->ways + leaps->ways))
        return refuse_units(most, plausibility->place, format, diag);
    if (leaps->ways > 0)
        snprintf(longer, sizeof longer, ", and by %.3g m where these say %.3g m", leaps->moved_m,
                 leaps->said_m);
    return diag_fail(diag, DIAG_DATA,
                     "%s %zu: from here on road users move by %.3g m where their speeds say %.3g "
                     "m%s; expected places in m that move as the speeds say%s",
                     format->place, plausibility->place, rests->moved_m, rests->said_m, longer,
                     format->of_sumo
                         ? "; SUMO's mesoscopic model gives the places of segments: run "
                           "sumo without --mesosim"
                         : "");
}

/* True if another meaning of the yaws explains the directions: its angles are on the mean less than
 * a third of those as stated, less 6 degrees. For 6.395 means nearly the same in both units. */
static bool explains(const struct recorded_slants *slants, enum recorded_yaw meaning)
{
    double spare_rad = (double)slants->stretches * (PI / 30);
    return 3 * slants->off_rad[meaning] + spare_rad < slants->off_rad[RECORDED_YAW_STATED];
}

static int refuse_yaws(const struct recorded_slants *slants, const struct recorded_format *format,
                       struct diag *diag)
{
    static const char *const meanings[RECORDED_YAWS] = {
        "", ", as with degrees that are taken for radians",
        ", as with radians that are taken for degrees", ", as with yaws clockwise from north",
        ", as with yaws clockwise from x"};
    enum recorded_yaw meaning = RECORDED_YAW_STATED;
    for (enum recorded_yaw i = RECORDED_YAW_STATED + 1; i < RECORDED_YAWS; i++)
        if (explains(slants, i) && slants->off_rad[i] < slants->off_rad[meaning])
            meaning = i;
    double off_rad = slants->off_rad[RECORDED_YAW_STATED] / (double)slants->stretches;
    const char *expected = "yaws in the unit of their column, counter-clockwise from x";
    if (format->of_sumo)
        expected = "angles in degrees, clockwise from north; the first versions of SUMO wrote 180 "
                   "minus these";
    return diag_fail(diag, DIAG_DATA,
                     "%s %zu: the yaw is %.6g rad, %.3g degrees off the direction of motion, as "
                     "all yaws are by %.3g degrees on the mean%s; expected %s",
                     format->place, slants->place, slants->yaw_rad, slants->most_rad * (180 / PI),
                     off_rad * (180 / PI), meanings[meaning], expected);
}

/* Yaws of many stretches are wrong if another direction of counting explains them, or if most of
 * those of several road users contradict. */
static bool is_slanted(const struct recorded_plausibility *plausibility, bool ended)
{
    const struct recorded_slants *all = &plausibility->all;
    size_t users = SURE_SLANTED, stretches = SURE_YAWS;
    bool explained = (!plausibility->forward && explains(all, RECORDED_YAW_DEGREES)) ||
                     explains(all, RECORDED_YAW_COMPASS) || explains(all, RECORDED_YAW_MIRRORED);
    if (explained) {
        users = plausibility->forward ? 1 : SURE_EXPLAINED;
        stretches = SURE_EXPLAINED_YAWS;
    }
    return all->stretches >= (ended ? stretches : SURE_WAYS) && plausibility->slanted >= users &&
           (explained || 3 * all->contradicting > 2 * all->stretches);
}

int recorded_plausibility_check(const struct recorded_plausibility *plausibility,
                                const struct recorded_format *format, bool ended, struct diag *diag)
{
    const struct recorded_slants *all = &plausibility->all, *far = &plausibility->far;
    uint64_t against = plausibility->rests.ways + plausibility->leaps.ways;
    size_t denied = plausibility->standing + plausibility->driving;
    bool enough = plausibility->stretches_m >= SURE_M || denied >= SURE_DENIED;
    if (plausibility->learned || (plausibility->whole && !ended))
        return 0;
    if (plausibility->rest.ways > 0)
        return refuse_rest(plausibility, format, diag);
    if (against > plausibility->agreeing && enough && (ended || against >= SURE_WAYS))
        return refuse_speeds(plausibility, format, diag);
    if (far->stretches >= SURE_SLANTED && explains(far, RECORDED_YAW_DEGREES))
        return refuse_yaws(far, format, diag);
    if (all->stretches >= (ended ? SURE_SLANTED : SURE_EXPLAINED_YAWS) &&
        explains(all, RECORDED_YAW_RADIANS))
        return refuse_yaws(all, format, diag);
    return is_slanted(plausibility, ended) ? refuse_yaws(all, format, diag) : 0;
}

int recorded_plausibility_learn(struct recorded_plausibility *plausibility,
                                const struct recorded_format *format, struct diag *diag)
{
    if (recorded_plausibility_check(plausibility, format, true, diag) != 0)
        return -1;
    plausibility->learned = true;
    plausibility->standing = plausibility->driving = plausibility->fast = 0;
    return 0;
}
