/* What a stage is, and what it may ask for. Read this first.
 *
 *     traffic ─► extract ─► ideal ─► sensor ─► noise ─► target list
 *
 * A stage is one model of one step of this chain. It is data: one const struct stage in one file of
 * stages/, and the folder is the registry. The executable glint-NAME and the fused program glint
 * run the same struct. Sources make frames (next), filters change them in place (step), sinks write
 * something else (step and stop). A tool (run) is a program for which one frame at a time and one
 * output are not enough (tool.h).
 *
 * A stage names what it reads of a frame and what it alters; the rest passes as text. What no stage
 * of a process alters is written word for word as it was read. Objects, most of a line, are not
 * even parsed where neither a stage nor an effect (effects/effect.h) names them: a fault in them
 * passes, too, to the program that reads them, or to glint-check, which reads all.
 *
 * The runner owns the state and the frame; a stage keeps no pointer into a frame, prints nothing
 * and frees nothing it did not make. Formulas live in lib/ as pure functions; stages loop, pick
 * members and call.
 *
 * Every function returns 0, or -1 after a message in the runner's diag; but next returns 1 after
 * making a frame, and 0 after the last frame of the last scene. */
#pragma once

#include "frame/frame.h"

struct frame_place;
struct input;
struct reference_stream;
struct runner;
struct sensor;
struct suite;
struct text;
struct vehicle;

struct stage {
    const char *name;    /* "sensor-perfect": the executable is glint-sensor-perfect */
    const char *summary; /* one sentence */
    const char *details; /* more paragraphs for --help, or NULL */
    /* The state, of which members are the stage's options: --radius-m sets radius_m. Its gone
     * members are options of earlier versions. */
    const struct record *options;
    /* The first argument, as --help calls it; it sets the first option. NULL: there is none. */
    const char *operand;
    bool sink;
    bool into_folder; /* a tool's outputs are files in the folder that the operand names */
    bool draws; /* a tool that draws random numbers by the frames' seed, and so takes --seed */
    /* Sets of enum frame_part. A frame must have the parts that the stage reads. It must not yet
     * have those that the stage writes, except lost, counts and vehicles, which it adds to, and
     * parts that it reads as well, which it changes in place. The runner orders and checks only
     * the parts in writes after a step, so a stage must change no other (test_runner). It may set
     * members of the header; in place of roadside strips, interferers and letters of a name, which
     * the runner does not compare, it sets new ones. A tool with an empty set reads no frames. */
    unsigned reads, writes;
    int (*start)(void *state, struct runner *runner);
    int (*next)(void *state, struct frame *frame, struct runner *runner);
    int (*step)(void *state, struct frame *frame, struct runner *runner);
    /* The part of a step for one sensor, where step is suite_choice_step (suite_choice.h), which
     * calls it for every sensor of the suite. */
    void (*visit)(struct frame *frame, const struct sensor *sensor,
                  const struct selection *selection);
    /* Called on a stage whose frame is refused. Returns -1 after a message that names the faulty
     * place in the stage's input, or 0 if the input is not the cause. NULL: it never is. */
    int (*locate_fault)(void *state, const struct frame *frame, struct runner *runner);
    int (*stop)(void *state, struct runner *runner); /* after the last frame; NULL: nothing */
    int (*run)(void *state, struct runner *runner);  /* the whole work of a tool */
    /* Frees what a library made for the state, after a failure too; NULL: nothing. */
    void (*release)(void *state);
};

enum stage_kind { STAGE_SOURCE, STAGE_FILTER, STAGE_SINK, STAGE_TOOL };

static inline enum stage_kind stage_kind(const struct stage *stage)
{
    if (stage->run != NULL)
        return STAGE_TOOL;
    if (stage->next != NULL)
        return STAGE_SOURCE;
    return stage->sink ? STAGE_SINK : STAGE_FILTER;
}

/* True if the stage takes files of frames, or else standard input. */
static inline bool stage_takes_files(const struct stage *stage)
{
    return stage->next == NULL && (stage->run == NULL || stage->reads != 0);
}

/* Every stage and tool of the build, NULL at the end: the Makefile makes it from the listing of
 * stages/. */
extern const struct stage *const stages[];

/* The stage or tool of that name; NULL if this build has none. */
const struct stage *stage_by_name(const char *name);

/* "plan" for "/usr/bin/glint-plan"; NULL for a path that does not end in glint-NAME. */
const char *stage_name_in_path(const char *path);

/* The options of a stage: the members of its state that this table of fields lists. */
#define STAGE_OPTIONS(state, table)                                                                \
    (&(const struct record){.name = "options", .size = sizeof(state), .fields = (table)})

/* What the runner does for stages (runner.c). Those that return a pointer return NULL after a
 * message, unless they say otherwise. */

/* Memory that lasts as long as the stage, for what it loads. */
struct arena *runner_arena(struct runner *runner);

struct diag *runner_diag(struct runner *runner);

const struct stage *runner_stage(const struct runner *runner);

/* The log in which the stage notes the effects that it simulates and leaves out; NULL: none. */
struct effect_log *runner_log(struct runner *runner);

/* The vehicle document of a class (vehicle_set_load; folder and digest may be NULL), loaded once.
 * Stages ask for suites by suite_choice.h. */
const struct vehicle *runner_vehicle(struct runner *runner, const char *folder, const char *class,
                                     const char *digest);

/* What a sink writes: bytes; a text, whose memory is given back; such a text for people, which is
 * broken at the width of a terminal that shows it; or a record as a line of JSON. */
int runner_write(struct runner *runner, const char *bytes, size_t length);
int runner_write_text(struct runner *runner, struct text *text);
int runner_write_fitted(struct runner *runner, struct text *text);
int runner_write_record(struct runner *runner, const struct record *record, const void *base);

/* True if the name that --output gives ends in this, or in this and .gz or .zst, in letters
 * of any case. */
bool runner_output_ends(const struct runner *runner, const char *ending);

/* Refuses (64) a name that --output gives if it has another ending than this, with .gz or .zst
 * behind it or without. */
int runner_require_ending(struct runner *runner, const char *ending);

/* True if nothing is given by --output, and standard output is a terminal. */
bool runner_output_is_terminal(const struct runner *runner);

/* Opens a second stream, of frames or of tracks by their record, for sinks that compare it with the
 * first. "-" is standard input, and refused if the first stream is read from there. The runner
 * closes it. NULL after a message. */
struct reference_stream *runner_reference_stream(struct runner *runner, const char *path,
                                                 const struct record *record, bool partial);

/* Where the frame was read that the stage has now (frame/frame_sequence.h). */
struct frame_place runner_place(const struct runner *runner);

/* Opens what a source reads, which closes it in release. What the chain has made goes out before a
 * wait for more. The message does not name the file. */
struct input *runner_input(struct runner *runner, const char *path);

/* A line for people on stderr, once however often it is given: before the first frame if the stage
 * knows it at its start, or else at the end. The text lasts as long as the stage. */
void runner_notice(struct runner *runner, const char *text);

/* How many frames a source will make, for the time left. */
void runner_expect(struct runner *runner, int64_t frames);
