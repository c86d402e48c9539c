/* The comparison that scripts/soundness rests on finds what is different and nothing else. */
#include "check.h"

#include <string.h>

#include "soundness/compare.h"

static const struct tolerance tolerance = {0.02, 0.002, 0.05, 0.5};

/* A frame of one cell with two members, its target, and a lost echo. */
struct sample {
    struct frame frame;
    struct cell cell;
    struct target target;
    struct contributor members[2];
    struct lost_group group;
    struct lost_echo lost;
};

static void make_sample(struct sample *sample)
{
    *sample = (struct sample){
        .frame = {.present = SECTION_CELLS | SECTION_TARGETS | SECTION_LOST},
        .cell = {.sensor = "front", .range_m = 20, .azimuth_rad = 0.1, .amplitude = 10},
        .target = {.sensor = "front", .range_m = 21, .amplitude_db = 20},
        .members = {{.id.object = "a", .id.reflector = "rear", .weight = 0.75},
                    {.id.object = "b", .id.reflector = "rear", .weight = 0.25}},
        .group = {.sensor = "front", .stage = "ideal", .reason = LOSS_BLOCKED},
        .lost = {.id.object = "c", .id.reflector = "rear", .by = "a"},
    };
    struct cell *cell = &sample->cell;
    cell->sum_re = 8, cell->delta_im = -1;
    cell->members.items = sample->target.contributors.items = sample->members;
    cell->members.count = sample->target.contributors.count = 2;
    sample->group.echoes.items = &sample->lost, sample->group.echoes.count = 1;
    sample->frame.cells.items = cell, sample->frame.cells.count = 1;
    sample->frame.targets.items = &sample->target, sample->frame.targets.count = 1;
    sample->frame.lost.items = &sample->group, sample->frame.lost.count = 1;
}

enum change {
    NOTHING,
    CELL_RANGE_WITHIN,
    CELL_RANGE,
    CELL_AZIMUTH,
    CELL_RATE,
    CELL_AMPLITUDE,
    SUPERPOSED,
    LEADER,
    WEIGHT,
    MEMBER,
    CELLS,
    NOISE,
    NEGATIVE_ZERO,
    LABEL,
    REASON,
    BLOCKER,
    LOST,
    ABSENT,
};

static void change(struct sample *sample, enum change change)
{
    struct cell *cell = &sample->cell;
    switch (change) {
    case NOTHING:
        break;
    case CELL_RANGE_WITHIN:
        cell->range_m += 0.019;
        break;
    case CELL_RANGE:
        cell->range_m += 0.021;
        break;
    case CELL_AZIMUTH:
        cell->azimuth_rad -= 0.0021;
        break;
    case CELL_RATE:
        cell->range_rate_mps = 0.051;
        break;
    case CELL_AMPLITUDE:
        cell->amplitude *= 1.06;
        break;
    case SUPERPOSED:
        cell->sum_re /= 1.06;
        break;
    case LEADER:
        sample->members[0].id.object = "z";
        break;
    case WEIGHT:
        sample->members[0].weight -= 0.06, sample->members[1].weight += 0.06;
        break;
    case MEMBER:
        cell->members.count = sample->target.contributors.count = 1;
        break;
    case CELLS:
        sample->frame.cells.count = 0;
        break;
    case NOISE:
        sample->target.range_m += 1e-9;
        break;
    case NEGATIVE_ZERO:
        sample->target.azimuth_rad = -0.0;
        break;
    case LABEL:
        sample->target.effects = EFFECT_BIT(EFFECT_MERGING);
        break;
    case REASON:
        sample->group.reason = LOSS_OUT_OF_VIEW;
        break;
    case BLOCKER:
        sample->lost.by = NULL;
        break;
    case LOST:
        sample->group.echoes.count = 0;
        break;
    case ABSENT:
        sample->frame.present &= ~(unsigned)SECTION_LOST;
        break;
    }
}

/* What each comparison answers, NULL where nothing is different to it. */
static const struct {
    enum change change;
    const char *bits, *within;
} cases[] = {
    {NOTHING, NULL, NULL},
    {CELL_RANGE_WITHIN, NULL, NULL},
    {CELL_RANGE, NULL, "cells[0].range_m"},
    {CELL_AZIMUTH, NULL, "cells[0].azimuth_rad"},
    {CELL_RATE, NULL, "cells[0].range_rate_mps"},
    {CELL_AMPLITUDE, NULL, "cells[0].amplitude"},
    {SUPERPOSED, NULL, "cells[0].superposed"},
    {LEADER, "targets[0].contributors[0].object", "cells[0].leader"},
    {WEIGHT, "targets[0].contributors[0].weight", "cells[0].a.rear.weight"},
    {MEMBER, "targets[0].contributors: 2 and 1", "cells[0].b.rear.weight"},
    {CELLS, NULL, "cells: 1 and 0"},
    {NOISE, "targets[0].range_m", "cells[0].noise on the same cell: range_m"},
    {NEGATIVE_ZERO, "targets[0].azimuth_rad", "cells[0].noise on the same cell: azimuth_rad"},
    {LABEL, "targets[0].effects", "cells[0].noise on the same cell: effects"},
    {REASON, "lost[0].reason", NULL},
    {BLOCKER, "lost[0].echoes[0].by", NULL},
    {LOST, "lost[0].echoes: 1 and 0", NULL},
    {ABSENT, "targets or lost: missing", NULL},
};

static void check_answer(int result, const struct diag *diag, const char *expected)
{
    assert_int_equal(result, expected == NULL ? 0 : -1);
    if (expected != NULL && strncmp(diag->text, expected, strlen(expected)) != 0)
        fail_msg("\"%s\", expected \"%s\"", diag->text, expected);
}

static void every_difference_is_found_and_named(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct sample all, chosen;
        struct diag bits = {0}, within = {0};
        make_sample(&all);
        make_sample(&chosen);
        change(&chosen, cases[i].change);
        check_answer(compare_bits(&all.frame, &chosen.frame, &bits), &bits, cases[i].bits);
        check_answer(compare_within(&all.frame, &chosen.frame, &tolerance, &within), &within,
                     cases[i].within);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_difference_is_found_and_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
