/* The suite and the effects that a run simulates. They are chosen at glint-ideal, written into
 * every frame, and obeyed by the stages after it.
 *
 * A stage after ideal may be given a suite or effects as well, but only those that the frame was
 * seen with: others are refused with DIAG_CONFIG. All functions that return an int give 0, or -1
 * after a message. */
#pragma once

#include "documents/suite.h"
#include "run/stage.h"

/* The options --sensors and --effects. Stages after ideal have it as their state. */
struct suite_choice {
    const char *sensors; /* NULL: the suite that the frame names */
    const char *effects; /* NULL: those that the frame names; at ideal, those of the suite */
};
extern const struct record suite_choice_record;

/* For the tables of options of states that begin with a suite_choice: at ideal, where the suite is
 * required; and after it. */
#define SUITE_CHOICE_OF_IDEAL                                                                      \
    {FIELD_NAME_OF(struct suite_choice, sensors,                                                   \
                   "the sensor suite: a name in data/sensors/, or a path")},                       \
        SUITE_CHOICE_EFFECTS(                                                                      \
            "effects to simulate: auto, all, none, or names with commas, -NAME to "                \
            "leave one out: all,-ghosts; absent: those of the suite, or auto")
#define SUITE_CHOICE_AFTER_IDEAL                                                                   \
    {OPTIONAL_NAME(struct suite_choice, sensors,                                                   \
                   "path of the suite given to glint-ideal, if it is not found by its name")},     \
        SUITE_CHOICE_EFFECTS("the effects given to glint-ideal; others are refused")
#define SUITE_CHOICE_EFFECTS(help_)                                                                \
    {                                                                                              \
        OPTIONAL_NAME(struct suite_choice, effects, help_), .word = "LIST"                         \
    }

/* The suite that the command line gives by name or path (documents/suite_file.h), and the one that
 * a frame names. Each is loaded once. A frame's suite is one that a stage before this one in the
 * process has loaded, or else it lies among the documents, or else in the working folder; it has
 * the frame's digest. Frames, whoever wrote them, give plain names, and only regular files are read
 * for them. NULL after a message. */
const struct suite *suite_choice_load(struct runner *runner, const char *name);
const struct suite *suite_choice_of_frame(struct runner *runner, const struct frame *frame);

/* Adds a notice to the runner for each figure of the suite that is not usual for automotive radars.
 * For the programs that choose a suite. */
void suite_choice_doubt(struct runner *runner, const struct suite *suite);

/* Adds a notice if the frame has reflectors that are made for finer range cells than those of a
 * sensor; false if it has none. */
bool suite_choice_doubt_cells(struct runner *runner, const struct suite *suite,
                              const struct frame *frame);

/* Sets what ideal writes into every frame: name and digest of the suite, and the text of the
 * effects, which is the option's, or else the suite's, or else "auto". */
int suite_choice_request(const struct suite_choice *choice, const struct suite *suite,
                         struct sensors *request, struct diag *diag);

/* The suite that the frame was seen with. NULL after a message: another digest, or other sensors
 * than the frame has. */
const struct suite *suite_choice_suite(const struct suite_choice *choice, const struct frame *frame,
                                       struct runner *runner);

/* The effects that the frame asks for, to be noted in the runner's log. */
int suite_choice_effects(const struct suite_choice *choice, const struct frame *frame,
                         struct runner *runner, struct selection *selection);

/* Reads what the effects of the stage and the quality of its targets need of the frame, beside what
 * the stage itself names. */
int suite_choice_read(struct frame *frame, const struct suite *suite,
                      const struct selection *selection, struct runner *runner);

/* The step of a stage after ideal with a suite_choice as its state: calls the stage's visit for
 * every sensor of the suite. */
int suite_choice_step(void *state, struct frame *frame, struct runner *runner);

/* For locate_fault of ideal and the stages after it: a speed, an amplitude or the like that is out
 * of bounds comes from extreme values of an object or of the suite. */
int suite_choice_locate_fault(void *state, const struct frame *frame, struct runner *runner);
