/* The comparison of scripts/soundness finds every difference and nothing else. */
#include "check.h"

#include <string.h>

#include "soundness/compare.h"

/* A frame of one target with two contributors, and a lost echo. */
struct sample {
    struct frame frame;
    struct target target;
    struct contributor members[2];
    struct lost_group group;
    struct lost_echo lost;
};

static void make_sample(struct sample *sample)
{
    *sample = (struct sample){
        .frame = {.present = PART_TARGETS | PART_LOST},
        .target = {.sensor = "front", .range_m = 21, .amplitude_db = 20},
        .members = {{.id.object = "a", .id.reflector = "rear", .weight = 0.75},
                    {.id.object = "b", .id.reflector = "rear", .weight = 0.25}},
        .group = {.sensor = "front", .stage = "ideal", .reason = "blocked"},
        .lost = {.id.object = "c", .id.reflector = "rear", .by = "a"},
    };
    sample->target.contributors.items = sample->members;
    sample->target.contributors.count = 2;
    sample->group.echoes.items = &sample->lost, sample->group.echoes.count = 1;
    sample->frame.targets.items = &sample->target, sample->frame.targets.count = 1;
    sample->frame.lost.items = &sample->group, sample->frame.lost.count = 1;
}

enum change {
    NOTHING,
    LEADER,
    WEIGHT,
    MEMBER,
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
    switch (change) {
    case NOTHING:
        break;
    case LEADER:
        sample->members[0].id.object = "z";
        break;
    case WEIGHT:
        sample->members[0].weight -= 0.06, sample->members[1].weight += 0.06;
        break;
    case MEMBER:
        sample->target.contributors.count = 1;
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
        sample->group.reason = "out_of_view";
        break;
    case BLOCKER:
        sample->lost.by = NULL;
        break;
    case LOST:
        sample->group.echoes.count = 0;
        break;
    case ABSENT:
        sample->frame.present &= ~(unsigned)PART_LOST;
        break;
    }
}

/* The comparison's message; NULL if there is no difference. */
static const struct {
    enum change change;
    const char *answer;
} cases[] = {
    {NOTHING, NULL},
    {LEADER, "targets[0].contributors[0].object"},
    {WEIGHT, "targets[0].contributors[0].weight"},
    {MEMBER, "targets[0].contributors: 2 and 1"},
    {NOISE, "targets[0].range_m"},
    {NEGATIVE_ZERO, "targets[0].azimuth_rad"},
    {LABEL, "targets[0].effects"},
    {REASON, "lost[0].reason"},
    {BLOCKER, "lost[0].echoes[0].by"},
    {LOST, "lost[0].echoes: 1 and 0"},
    {ABSENT, "targets or lost: missing"},
};

static void check_answer(int result, const struct diag *diag, const char *expected)
{
    assert_int_equal(result, expected == NULL ? 0 : -1);
    if (expected != NULL && strncmp(diag->text, expected, strlen(expected)) != 0)
        fail_msg("\"%s\", expected \"%s\"", diag->text, expected);
}

TEST(every_difference_is_found_and_named)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct sample all, chosen;
        struct diag diag = {0};
        make_sample(&all);
        make_sample(&chosen);
        change(&chosen, cases[i].change);
        check_answer(compare_bits(&all.frame, &chosen.frame, true, &diag), &diag, cases[i].answer);
    }
}
