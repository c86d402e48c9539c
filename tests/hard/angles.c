/* Hard cases 1 to 12: the antenna's patterns, the angle read off them, and the angle of
 * visibility. */
#include "hard.h"

#include <complex.h>

#include "base/elementary.h"
#include "base/units.h"
#include "frame/frame_text.h"
#include "geometry/directivity.h"
#include "geometry/kinematics.h"
#include "radar/antenna.h"
#include "radar/monopulse.h"

enum { BITS = 400 };

static const struct antenna CENTRE = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = PHASE_CENTRE};
static const struct antenna ELEMENT = {.pattern = ANTENNA_DIPOLE_PAIR, .phase = PHASE_ELEMENT};

/* A random azimuth above 0: anywhere in the quadrant, near boresight on every scale, or near the
 * side, down to 1e-12 rad before it. */
static double azimuth_at(int i, int count, double least)
{
    double part = (double)(i / 3 + 1) / (count / 3 + 2);
    if (i % 3 == 0)
        return PI / 2 * part;
    return i % 3 == 1 ? pow(least, part) : PI / 2 - pow(1e-12, part);
}

/* Exact cos u, sin u and f of MODEL 7.1. */
struct pattern {
    mpfr_t cos_u, sin_u, element;
};

static void start_pattern(struct pattern *exact)
{
    mpfr_inits2(BITS, exact->cos_u, exact->sin_u, exact->element, (mpfr_ptr)0);
}

static void end_pattern(struct pattern *exact)
{
    mpfr_clears(exact->cos_u, exact->sin_u, exact->element, (mpfr_ptr)0);
}

static void set_pattern(struct pattern *exact, double azimuth_rad)
{
    MPFR_DECL_INIT(u, BITS);
    MPFR_DECL_INIT(cosine, BITS);
    mpfr_set_d(u, azimuth_rad, MPFR_RNDN);
    mpfr_sin_cos(u, cosine, u, MPFR_RNDN);
    mpfr_const_pi(exact->element, MPFR_RNDN);
    mpfr_mul(u, u, exact->element, MPFR_RNDN);
    mpfr_div_2ui(u, u, 1, MPFR_RNDN);
    mpfr_sin_cos(exact->sin_u, exact->cos_u, u, MPFR_RNDN);
    mpfr_div(exact->element, exact->sin_u, u, MPFR_RNDN);
    mpfr_mul(exact->element, exact->element, cosine, MPFR_RNDN);
}

/* The paper's x = pi sin(azimuth), the phase between the dipoles. */
static double dipole_phase(double azimuth_rad)
{
    return PI * sin(azimuth_rad);
}

static double naive_element(double azimuth_rad)
{
    double u = dipole_phase(azimuth_rad) / 2;
    return sin(u) / u * cos(azimuth_rad);
}

static double naive_delta(double azimuth_rad)
{
    return naive_element(azimuth_rad) * sqrt((1 - cos(dipole_phase(azimuth_rad))) / 2);
}

static double naive_delta_real(double azimuth_rad)
{
    return naive_element(azimuth_rad) * (1 - cos(dipole_phase(azimuth_rad))) / 2;
}

static double naive_delta_chord(double azimuth_rad)
{
    double _Complex turn = cexp(dipole_phase(azimuth_rad) * (double _Complex)I);
    return naive_element(azimuth_rad) * cabs(1 - turn) / 2;
}

static double naive_sum(double azimuth_rad)
{
    return naive_element(azimuth_rad) * cos(dipole_phase(azimuth_rad) / 2);
}

static double ours_delta(double azimuth_rad)
{
    return -cimag(antenna_pointers(&CENTRE, azimuth_rad).delta);
}

static double ours_delta_real(double azimuth_rad)
{
    return creal(antenna_pointers(&ELEMENT, azimuth_rad).delta);
}

static double ours_delta_chord(double azimuth_rad)
{
    double _Complex delta = antenna_pointers(&ELEMENT, azimuth_rad).delta;
    return elementary_hypot(creal(delta), cimag(delta));
}

static double ours_sum(double azimuth_rad)
{
    return antenna_gain(&CENTRE, azimuth_rad);
}

static double ours_sum_chord(double azimuth_rad)
{
    double _Complex sum = antenna_pointers(&ELEMENT, azimuth_rad).sum;
    return elementary_hypot(creal(sum), cimag(sum));
}

static void exact_delta(mpfr_t result, const struct pattern *exact)
{
    mpfr_mul(result, exact->element, exact->sin_u, MPFR_RNDN);
}

static void exact_delta_real(mpfr_t result, const struct pattern *exact)
{
    exact_delta(result, exact);
    mpfr_mul(result, result, exact->sin_u, MPFR_RNDN);
}

static void exact_sum(mpfr_t result, const struct pattern *exact)
{
    mpfr_mul(result, exact->element, exact->cos_u, MPFR_RNDN);
}

/* Hard cases 1 to 5, each with the element factor that both channels share. */
TEST(pointers_keep_their_digits_from_boresight_to_the_side)
{
    static const struct {
        const char *number, *title;
        double (*naive)(double), (*ours)(double);
        void (*exact)(mpfr_t, const struct pattern *);
        double least, bound;
    } cases[] = {
        {"1", "delta magnitude at boresight", naive_delta, ours_delta, exact_delta, 1e-300, 4},
        {"2", "real part of delta", naive_delta_real, ours_delta_real, exact_delta_real, 1e-150, 8},
        {"3", "delta magnitude from its parts", naive_delta_chord, ours_delta_chord, exact_delta,
         1e-300, 8},
        {"4", "sum magnitude at the side", naive_sum, ours_sum, exact_sum, 1e-300, 8},
        {"5", "sum magnitude from its parts", naive_sum, ours_sum_chord, exact_sum, 1e-300, 8},
    };
    struct pattern pattern;
    MPFR_DECL_INIT(exact, BITS);
    start_pattern(&pattern);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double naive = 0, ours = 0;
        int count = hard_points(30000);
        for (int i = 0; i < count; i++) {
            double azimuth_rad = azimuth_at(i, count, cases[k].least);
            set_pattern(&pattern, azimuth_rad);
            cases[k].exact(exact, &pattern);
            naive = hard_worse(naive, error_ulp(cases[k].naive(azimuth_rad), exact));
            ours = hard_worse(ours, error_ulp(cases[k].ours(azimuth_rad), exact));
        }
        hard_case(cases[k].number, cases[k].title, "ulp", naive, ours, cases[k].bound);
    }
    end_pattern(&pattern);
}

static double naive_azimuth(double delta, double sum)
{
    return asin(2 / PI * atan2(delta, sum));
}

/* Hard case 6: an echo from the side has its angle there or none, never one ahead. */
TEST(an_echo_from_the_side_is_not_invented_elsewhere)
{
    static const struct vec2 boresight = {1, 0};
    uint64_t sample = 6;
    int naive = 0, ours = 0, count = hard_points(1000000);
    for (int i = 0; i < count; i++) {
        double side = i % 2 == 0 ? 1 : -1;
        struct vec2 place = {0, side * exp(sample_between(&sample, -7, 7))};
        double element = place.x / vec2_length(place);
        double azimuth_rad = naive_azimuth(element * 1.0, element * 0.0);
        naive += !(fabs(azimuth_rad - PI / 2) < 1e-15);
        struct kinematics sight =
            kinematics_of((struct vec2){0, 0}, (struct vec2){0, 0}, boresight, place, place);
        const struct antenna *antenna = i / 2 % 2 == 0 ? &CENTRE : &ELEMENT;
        struct monopulse_angle angle =
            monopulse_angle(antenna, i / 4 % 2 == 0 ? MONOPULSE_MAGNITUDE : MONOPULSE_RATIO,
                            antenna_pointers(antenna, sight.azimuth_rad));
        ours += angle.valid && !(fabs(angle.azimuth_rad - side * PI / 2) < 1e-15);
    }
    hard_case("6", "an echo at exactly 90 degrees", "wrong", naive, ours, 0);
}

/* The exact azimuth of a pair: asin((2/pi) atan2(delta, sum)). */
static void set_azimuth(mpfr_t azimuth, double delta, double sum)
{
    MPFR_DECL_INIT(quarter, BITS);
    mpfr_set_d(azimuth, delta, MPFR_RNDN);
    mpfr_set_d(quarter, sum, MPFR_RNDN);
    mpfr_atan2(azimuth, azimuth, quarter, MPFR_RNDN);
    mpfr_const_pi(quarter, MPFR_RNDN);
    mpfr_div_2ui(quarter, quarter, 1, MPFR_RNDN);
    mpfr_div(azimuth, azimuth, quarter, MPFR_RNDN);
    mpfr_asin(azimuth, azimuth, MPFR_RNDN);
}

/* Delta and sum at an azimuth, each rounded to the nearest double. */
static void round_pair(struct pattern *exact, double azimuth_rad, double *delta, double *sum)
{
    set_pattern(exact, azimuth_rad);
    *delta = mpfr_get_d(exact->sin_u, MPFR_RNDN);
    *sum = mpfr_get_d(exact->cos_u, MPFR_RNDN);
}

/* Hard case 7. */
TEST(the_pair_is_inverted_up_to_the_side)
{
    struct pattern pattern;
    MPFR_DECL_INIT(exact, BITS);
    start_pattern(&pattern);
    double naive = 0, ours = 0;
    int count = hard_points(30000);
    for (int i = 0; i < count; i++) {
        double delta, sum;
        round_pair(&pattern, azimuth_at(i, count, 1e-300), &delta, &sum);
        set_azimuth(exact, delta, sum);
        naive = hard_worse(naive, error_ulp(naive_azimuth(delta, sum), exact));
        ours = hard_worse(ours, error_ulp(antenna_azimuth_rad(&CENTRE, delta, sum), exact));
    }
    hard_case("7", "the angle up to the side", "ulp", naive, ours, 4);
    end_pattern(&pattern);
}

enum { CELLS = 300 };

static void add_cell(struct frame *frame, struct antenna_pointers pointers)
{
    struct cell *cell = list_add(&frame->cells, frame->arena);
    *cell = (struct cell){
        .sensor = "s",
        .range_m = 1,
        .amplitude = 1,
        .sum_re = creal(pointers.sum),
        .sum_im = cimag(pointers.sum),
        .delta_re = creal(pointers.delta),
        .delta_im = cimag(pointers.delta),
    };
    *list_add(&cell->members, frame->arena) =
        (struct contributor){.id.object = "o", .id.reflector = "r", .range_m = 1, .weight = 1};
}

/* The cells after a trip through a pipe. */
static void send_cells(const struct frame *frame, struct frame *received, struct text *line)
{
    line->length = 0;
    assert_done(frame_text_write, frame, line);
    assert_done(frame_text_read, line->bytes, line->length - 1, received);
    assert_int_equal(received->cells.count, frame->cells.count);
}

static double cell_azimuth(const struct cell *cell)
{
    struct antenna_pointers pointers = {
        .sum = cell->sum_re + cell->sum_im * (double _Complex)I,
        .delta = cell->delta_re + cell->delta_im * (double _Complex)I,
    };
    return monopulse_angle(&ELEMENT, MONOPULSE_MAGNITUDE, pointers).azimuth_rad;
}

/* Hard case 8: frames carry the pointers, from which the next stage reads the angle; a sensing
 * ratio carries less of it, even with all of its digits. */
TEST(the_angle_survives_the_pipe)
{
    struct arena other = {0};
    struct text *line = check_text();
    struct frame frame = {.arena = check_arena()}, received = {.arena = &other};
    MPFR_DECL_INIT(exact, BITS);
    double naive = 0, ours = 0;
    int count = hard_points(30000) / CELLS * CELLS;
    for (int begin = 0; begin < count; begin += CELLS) {
        frame_clear(&frame);
        frame.scene = "pipe";
        frame.interval_s = 1;
        frame.ego = "ego";
        frame.present = PART_CELLS;
        for (int i = 0; i < CELLS; i++)
            add_cell(&frame, antenna_pointers(&ELEMENT, azimuth_at(begin + i, count, 1e-140)));
        send_cells(&frame, &received, line);
        for (int i = 0; i < CELLS; i++) {
            const struct cell *sent = &frame.cells.items[i];
            double sum = elementary_hypot(sent->sum_re, sent->sum_im);
            double delta = elementary_hypot(sent->delta_re, sent->delta_im);
            double asr = (delta - sum) / (delta + sum);
            set_azimuth(exact, delta, sum);
            naive = hard_worse(naive, error_ulp(asin(0.5 + 2 / PI * atan(asr)), exact));
            ours = hard_worse(ours, error_ulp(cell_azimuth(&received.cells.items[i]), exact));
        }
    }
    hard_case("8", "the angle after the pipe, naive by ASR", "ulp", naive, ours, 4);
    arena_free(&other);
}

enum { ROWS = 1024 };

/* A table of the sensing ratio over azimuth. */
struct asr_row {
    double azimuth_rad, asr;
};

/* The angle by the paper's suggestion: straight lines between rows of the table. */
static double tabled_azimuth(const struct asr_row *rows, double delta, double sum)
{
    double asr = (delta - sum) / (delta + sum);
    int low = 0, high = ROWS - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (rows[middle].asr <= asr)
            low = middle;
        else
            high = middle;
    }
    double part = (asr - rows[low].asr) / (rows[high].asr - rows[low].asr);
    return rows[low].azimuth_rad + part * (rows[high].azimuth_rad - rows[low].azimuth_rad);
}

/* Hard case 9. */
TEST(the_closed_form_beats_a_table)
{
    struct asr_row table[ROWS];
    for (int i = 0; i < ROWS; i++) {
        double azimuth_rad = PI / 2 * i / (ROWS - 1);
        table[i] = (struct asr_row){azimuth_rad, tan(PI / 2 * sin(azimuth_rad) - PI / 4)};
    }
    struct pattern pattern;
    MPFR_DECL_INIT(exact, BITS);
    start_pattern(&pattern);
    double naive = 0, ours = 0;
    int count = hard_points(30000);
    for (int i = 0; i < count; i++) {
        double delta, sum;
        round_pair(&pattern, azimuth_at(i, count, 1e-300), &delta, &sum);
        set_azimuth(exact, delta, sum);
        naive = hard_worse(naive, error_size(tabled_azimuth(table, delta, sum), exact));
        ours = hard_worse(ours, error_size(antenna_azimuth_rad(&CENTRE, delta, sum), exact));
    }
    hard_case("9", "the angle, naive by a table of 1,024", "rad", naive, ours, 4e-16);
    end_pattern(&pattern);
}

static void set_si(mpfr_t exact, double x)
{
    MPFR_DECL_INIT(divisor, BITS);
    mpfr_set_d(divisor, x, MPFR_RNDN);
    mpfr_sin(exact, divisor, MPFR_RNDN);
    if (x == 0)
        mpfr_set_ui(exact, 1, MPFR_RNDN);
    else
        mpfr_div(exact, exact, divisor, MPFR_RNDN);
}

/* Hard case 10. */
TEST(si_needs_no_series)
{
    MPFR_DECL_INIT(exact, BITS);
    uint64_t sample = 10;
    double naive = 0, ours = 0;
    int count = hard_points(100000);
    for (int i = 0; i < count; i++) {
        double logarithm = sample_between(&sample, -300, 0);
        double x = i % 2 == 0 ? 3.0 * i / count : 3 * pow(10, logarithm);
        set_si(exact, x);
        naive = hard_worse(naive, error_ulp(sin(x) / x, exact));
        ours = hard_worse(ours, error_ulp(units_si(x), exact));
    }
    hard_case("10", "sin(x)/x from 0 to 3", "ulp", naive, ours, 2);
}

/* Pointers of equal echoes to both sides, the left one stronger by extra. */
static struct antenna_pointers opposite(const struct antenna *antenna, double azimuth_rad,
                                        double extra)
{
    struct antenna_pointers left = antenna_pointers(antenna, azimuth_rad);
    struct antenna_pointers right = antenna_pointers(antenna, -azimuth_rad);
    return (struct antenna_pointers){(1 + extra) * left.sum + right.sum,
                                     (1 + extra) * left.delta + right.delta};
}

/* The angle by the paper's rule, with the sign that rounding gives it. */
static double naive_signed_azimuth(struct antenna_pointers pointers)
{
    double azimuth_rad = naive_azimuth(cabs(pointers.delta), cabs(pointers.sum));
    return copysign(azimuth_rad, -cimag(pointers.delta * conj(pointers.sum)));
}

/* Hard case 11, up to 75 degrees: beyond, under the phase of the element, the exact ratio itself
 * moves by more, by 2^-52 sin u / (2 cos^3 u) where cos u falls below 0.04. */
TEST(one_ulp_does_not_move_the_ratio)
{
    const struct antenna *antennas[] = {&CENTRE, &ELEMENT};
    uint64_t sample = 11;
    double naive = 0, ours = 0;
    int count = hard_points(100000);
    for (int i = 0; i < count; i++) {
        double azimuth_rad = sample_between(&sample, 0, 75 * PI / 180);
        struct antenna_pointers even = opposite(&ELEMENT, azimuth_rad, 0);
        for (int side = -1; side <= 1; side += 2) {
            struct antenna_pointers odd = opposite(&ELEMENT, azimuth_rad, side * 0x1p-52);
            naive = hard_worse(naive, fabs(naive_signed_azimuth(odd) - naive_signed_azimuth(even)));
            for (int k = 0; k < 2; k++) {
                odd = opposite(antennas[k], azimuth_rad, side * 0x1p-52);
                even = opposite(antennas[k], azimuth_rad, 0);
                double change = monopulse_angle(antennas[k], MONOPULSE_RATIO, odd).azimuth_rad -
                                monopulse_angle(antennas[k], MONOPULSE_RATIO, even).azimuth_rad;
                ours = hard_worse(ours, fabs(change));
            }
        }
    }
    hard_case("11", "one ulp moves a symmetric pair's angle by", "rad", naive, ours, 1e-12);
}

/* Hard case 12. */
TEST(parallel_directions_have_an_angle)
{
    uint64_t sample = 12;
    double naive = 0, ours = 0;
    int count = hard_points(1000000);
    MPFR_DECL_INIT(cross, 320);
    MPFR_DECL_INIT(dot, 320);
    MPFR_DECL_INIT(part, 320);
    for (int i = 0; i < count; i++) {
        struct vec2 a = {sample_between(&sample, -50, 50), sample_between(&sample, -50, 50)};
        struct vec2 b = vec2_scale(sample_between(&sample, 0.1, 10) * (i % 2 == 0 ? 1 : -1), a);
        mpfr_set_d(cross, a.x, MPFR_RNDN);
        mpfr_mul_d(cross, cross, b.y, MPFR_RNDN);
        mpfr_set_d(part, a.y, MPFR_RNDN);
        mpfr_mul_d(part, part, b.x, MPFR_RNDN);
        mpfr_sub(cross, cross, part, MPFR_RNDN);
        mpfr_abs(cross, cross, MPFR_RNDN);
        mpfr_set_d(dot, a.x, MPFR_RNDN);
        mpfr_mul_d(dot, dot, b.x, MPFR_RNDN);
        mpfr_set_d(part, a.y, MPFR_RNDN);
        mpfr_mul_d(part, part, b.y, MPFR_RNDN);
        mpfr_add(dot, dot, part, MPFR_RNDN);
        mpfr_atan2(cross, cross, dot, MPFR_RNDN);
        mpfr_sub_d(dot, cross, directivity_angle_rad(a, b), MPFR_RNDN);
        ours = hard_worse(ours, fabs(mpfr_get_d(dot, MPFR_RNDN)));
        mpfr_sub_d(dot, cross, acos(vec2_dot(a, b) / (vec2_length(a) * vec2_length(b))), MPFR_RNDN);
        naive = hard_worse(naive, fabs(mpfr_get_d(dot, MPFR_RNDN)));
    }
    hard_case("12", "the angle between parallel directions", "rad", naive, ours, 1e-15);
}
