/* OSI 3.8: a trace of messages SensorData, with the detections of all radars and the truth. */
#include "osi_trace.h"
#include "run/stage.h"

static int osi_start(void *state, struct runner *runner)
{
    struct trace *trace = state;
    trace->arena = runner_arena(runner);
    trace->end_s = OSI_TRACE_END_S;
    return !runner_output_is_terminal(runner)
               ? 0
               : diag_fail(runner_diag(runner), DIAG_USAGE,
                           "standard output is a terminal; write the trace to a file: -o FILE");
}

/* A message stands behind its length in four bytes. */
static int osi_step(void *state, struct frame *frame, struct runner *runner)
{
    struct text message = {0};
    char length[8];
    if (trace_take(state, frame, runner_diag(runner)) != 0)
        return -1;
    osi_trace_add(state, &message);
    text_put_word(length, message.length);
    return runner_write(runner, length, sizeof length / 2) == 0
               ? runner_write_text(runner, &message)
               : -1;
}

static const struct field osi_fields[] = {TRACE_OPTION, {0}};

const struct stage stage_osi = {
    .name = "osi",
    .summary = "Write a trace of OSI 3.8 with the detections of all radars and the truth.",
    .details = "Each frame is a message SensorData behind its length in four bytes. "
               "radial_velocity is positive "
               "towards the sensor, as OSI 3.8 says. data/exports/README.md lists the fields and "
               "what OSI has "
               "no place for. A trace holds one scene; frames need --sections quality.",
    .options = STAGE_OPTIONS(struct trace, osi_fields),
    .sink = true,
    .reads = PART_OBJECTS | PART_SENSORS | PART_TARGETS,
    .start = osi_start,
    .step = osi_step,
};
