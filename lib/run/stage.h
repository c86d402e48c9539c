/* A stage: one model of one step of the chain. Read this first.
 *
 *     traffic ─► extract ─► ideal ─► sensor ─► noise ─► target list
 *
 * A stage is data: one const struct stage in one file of stages/, and the folder is the registry.
 * The executable glint-NAME and the fused program glint run the same struct. Sources make frames
 * (next), filters change them in place (step), sinks write something else (step and stop). A
 * program that needs more than one frame at a time and one output is a tool (tool.h).
 *
 * The runner owns the state and the frame; a stage keeps no pointer into a frame, prints nothing
 * and frees nothing it did not make. Formulas live in lib/ as pure functions; stages loop, pick
 * members and call.
 *
 * Every function returns 0, or -1 after a message in the runner's diag. next also returns 1 after
 * making a frame; 0 is the end of the scenes. */
#ifndef STAGE_H
#define STAGE_H

#include "base/units.h"
#include "documents/catalogue.h"
#include "frame/frame.h"

struct reference_stream;
struct runner;
struct vehicle;

struct stage {
    const char *name;    /* "sensor-perfect": the executable is glint-sensor-perfect */
    const char *summary; /* one sentence */
    const char *details; /* more paragraphs for --help, or NULL */
    /* The state, of which members are the stage's options: --radius-m sets radius_m. */
    const struct record *options;
    /* A source's argument, as --help calls it; it sets the first option. NULL for all others. */
    const char *operand;
    bool sink;
    /* enum section. What a stage reads must be there; what it writes must not be there yet, unless
     * it reads it too: then it changes it in place. lost and counts are added to. Only what a stage
     * writes is ordered and checked after its step, so it changes nothing else (test_runner). */
    unsigned reads, writes;
    int (*start)(void *state, struct runner *runner);
    int (*next)(void *state, struct frame *frame, struct runner *runner);
    int (*step)(void *state, struct frame *frame, struct runner *runner);
    /* Of a source, for a frame that is refused: -1 after a message that names the place in what it
     * read, 0 if that is not to blame; NULL: it never is. */
    int (*locate_fault)(void *state, const struct frame *frame, struct runner *runner);
    int (*stop)(void *state, struct runner *runner); /* after the last frame; NULL: nothing */
    /* Frees what a library made for the state, after a failure too; NULL: nothing. */
    void (*release)(void *state);
};

/* For stages without options and without state. (These two records are in options.c.) */
extern const struct record no_options_record;

/* Which suite, and which effects of it. It is the state of stages after ideal, for which the frame
 * has the answers: other ones are refused. ideal's state begins with it. */
struct suite_choice {
    const char *sensors; /* NULL: the suite that the frame names */
    const char *effects; /* NULL: those that the frame names, or the suite does */
};
extern const struct record suite_choice_record;

/* The member after `sensors`, for tables of options. */
#define SUITE_CHOICE_EFFECTS                                                                       \
    {                                                                                              \
        FIELD_NAME_OF(struct suite_choice, effects, "auto, all, none, or effects by their names"), \
            FIELD_OPTIONAL, .word = "LIST"                                                         \
    }

/* What the runner does for stages (runner.c). */

/* Memory that lasts as long as the stage, for what it loads. */
struct arena *runner_arena(struct runner *runner);

struct diag *runner_diag(struct runner *runner);

/* The suite that the frame was seen with, or the one called name if it is not NULL. NULL after a
 * message; another digest than the frame's is refused (DIAG_CONFIG). Loaded once. */
const struct suite *runner_suite(struct runner *runner, const struct frame *frame,
                                 const char *name);

/* What ideal writes of its suite into every frame: name, digest, and which effects, by its
 * options or else by the suite itself. */
int runner_request(struct runner *runner, const struct suite_choice *choice,
                   const struct suite *suite, struct sensors *request);

/* The effects that the frame asks for. Refuses options that ask for others (DIAG_CONFIG). */
int runner_selection(struct runner *runner, const struct frame *frame,
                     const struct suite_choice *choice, struct selection *selection);

/* The whole step of a stage whose state is a suite_choice: visits every sensor of the suite that
 * the frame was seen with. */
int runner_visit_sensors(struct runner *runner, struct frame *frame,
                         void (*visit)(struct frame *frame, const struct sensor *sensor,
                                       const struct selection *selection));

/* The vehicle document of a class. NULL after a message. Loaded once. */
const struct vehicle *runner_vehicle(struct runner *runner, const char *class);

/* The whole step of a stage that extracts: completes the objects' sizes and has every object but
 * the ego listed in its class's set: the document's, of which describe, if it is not NULL, may put
 * others in place of any list, in memory of the arena. Sizes come from documents that were checked,
 * so objects are not among what the stage writes. */
int runner_extract(struct runner *runner, struct frame *frame,
                   void (*describe)(const void *state, const struct vehicle *vehicle,
                                    struct reflector_set *set, struct arena *arena));

/* A sink's way out. */
int runner_write(struct runner *runner, const char *bytes, size_t length);

/* The same for a line of JSON, as the record says. */
int runner_write_record(struct runner *runner, const struct record *record, const void *base);

/* Another stream beside the one that is read, for sinks that compare: opened once, closed at the
 * end.
 * "-" is standard input where the frames come from files. NULL after a message. */
struct reference_stream *runner_counterpart(struct runner *runner, const char *path, bool partial);

/* For the progress bar of a source: how many frames there will be. */
void runner_expect(struct runner *runner, int64_t frames);

#endif
