#include "frame/frame_remade.h"

#include "check.h"

/* A frame with one target of one echo, and the frame that was computed again, with that echo. */
struct bench {
    struct frame frame, again;
    struct contributor *label;
};

static void begin(struct bench *bench)
{
    *bench = (struct bench){0};
    struct echo echo = {
        .sensor = "left", .id.object = "car", .id.reflector = "corner", .range_m = 10};
    *list_add(&bench->again.echoes, check_arena()) = echo;
    struct target *target = list_add(&bench->frame.targets, check_arena());
    *target = (struct target){.sensor = "left"};
    bench->label = list_add(&target->contributors, check_arena());
    *bench->label = frame_contributor(&echo);
    bench->label->weight = 1;
}

static void expect(struct bench *bench, struct frame *again, const char *message)
{
    struct diag diag = {0};
    struct frame_remade counts = {0};
    int result = frame_remade_check(&bench->frame, again, &counts, &diag);
    assert_string_equal(diag.text, message);
    assert_int_equal(result, message[0] == '\0' ? 0 : -1);
    assert_int_equal(counts.contributors, 1);
    assert_int_equal(counts.recomputed, again != NULL);
}

TEST(a_label_of_the_echo_as_it_is_passes)
{
    struct bench bench;
    begin(&bench);
    bench.label->range_m *= 1 + 1e-10;
    expect(&bench, &bench.again, "");
}

TEST(a_value_that_is_off_is_named)
{
    struct bench bench;
    begin(&bench);
    bench.label->range_m = 11;
    expect(&bench, &bench.again, "targets[0].contributors[0].range_m: 11; recomputed, it is 10");
}

TEST(without_echoes_only_weights_are_checked)
{
    struct bench bench;
    begin(&bench);
    bench.label->range_m = 11;
    expect(&bench, NULL, "");
    begin(&bench);
    bench.label->weight = 0.5;
    expect(&bench, NULL, "targets[0].contributors: weights sum to 0.5; expected 1");
}
