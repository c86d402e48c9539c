#include "check.h"

#include "documents/waveform.h"

static struct waveform usual(enum waveform_kind kind)
{
    struct waveform waveform;
    field_clear(&waveform_record, &waveform);
    waveform.kind = kind;
    waveform.samples = 128;
    waveform.repetitions = 64;
    return waveform;
}

static void assert_fault(const struct waveform *waveform, const char *member)
{
    struct diag diag = {0};
    assert_int_equal(waveform_check(waveform, 1.79, 229, &diag), -1);
    assert_int_equal(diag.code, DIAG_CONFIG);
    assert_int_equal(strncmp(diag.text, member, strlen(member)), 0);
}

static void assert_fine(const struct waveform *waveform, double cell_range_m, double range_max_m)
{
    assert_done(waveform_check, waveform, cell_range_m, range_max_m);
}

TEST(absent_members_mean_hanns_window_and_the_twelfth_of_sixteen)
{
    struct waveform waveform = usual(WAVEFORM_CHIRP);
    struct cfar cfar = waveform_cfar(&waveform, 2, 1);
    assert_int_equal(waveform.window, POINT_RESPONSE_HANN);
    assert_int_equal(cfar.kind, CFAR_ORDERED);
    assert_int_equal(cfar.cells, 16);
    assert_int_equal(cfar.nearest, 6);
    assert_int_equal(cfar.spacing, 6);
    assert_int_equal(waveform.stagger, 0);
    assert_int_equal(cfar.rank, 12);
    assert_near(cfar.factor, 11.080194, 1e-7);
    assert_fine(&waveform, 1.79, 229);
}

TEST(a_suite_without_a_waveform_is_accepted)
{
    struct waveform waveform;
    field_clear(&waveform_record, &waveform);
    assert_fine(&waveform, 1.79, 1e6);
}

TEST(pulses_have_four_samples_to_a_cell)
{
    struct waveform chirp = usual(WAVEFORM_CHIRP), pulse = usual(WAVEFORM_PULSE);
    assert_close(waveform_range_step_m(&chirp, 1.79), 1.79, 0);
    assert_close(waveform_range_step_m(&pulse, 0.3), 0.075, 0);
    assert_fine(&pulse, 0.3, 9.6);
    struct diag diag = {0};
    assert_int_equal(waveform_check(&pulse, 0.3, 9.7, &diag), -1);
}

TEST(contradictory_members_are_refused_by_name)
{
    struct waveform waveform = usual(WAVEFORM_CHIRP);
    waveform.samples = 127;
    assert_fault(&waveform, "samples: ");
    waveform = usual(WAVEFORM_CHIRP);
    waveform.cfar_cells = 15;
    assert_fault(&waveform, "cfar_cells: ");
    waveform.cfar_cells = 8;
    assert_fault(&waveform, "cfar_rank: ");
    waveform.cfar = CFAR_MEAN;
    assert_fine(&waveform, 1.79, 229);
    waveform = usual(WAVEFORM_CHIRP);
    waveform.repetitions = 50;
    assert_fault(&waveform, "cfar_cells: ");
    waveform.window = POINT_RESPONSE_RECTANGULAR;
    assert_fine(&waveform, 1.79, 229);
    waveform.repetitions = 20;
    assert_fault(&waveform, "cfar_cells: ");
    waveform = usual(WAVEFORM_CHIRP);
    waveform.cfar_guard = 1;
    assert_fault(&waveform, "cfar_guard: ");
    waveform = usual(WAVEFORM_CHIRP);
    waveform.stagger = 21;
    assert_fine(&waveform, 1.79, 229);
    waveform.stagger = 22;
    assert_fault(&waveform, "stagger: ");
}
