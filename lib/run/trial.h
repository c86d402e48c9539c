/* Chains tried frame by frame, beside the whole chain.
 *
 * On every frame the whole chain runs first, and what each of its stages read is kept. A trial runs
 * from its first stage on, fed with what the whole chain's stage before it wrote. No stage asks for
 * an effect at home in a later one, so a trial without one effect begins at the effect's home.
 *
 * A list has the targets of one sensor in one frame. Lists are the same if their text in the
 * frame's line is, labels included. Times are CPU times of the stages that a trial runs, and of
 * writing the line; a trial saves the whole chain's time from its first stage on less its own. In
 * every round all trials take turns on each frame, so that load on the machine slows them alike. */
#pragma once

#include "run/frame_sample.h"
#include "run/stage.h"
#include "text/list_cache.h"

struct trial_options;

/* In the order of enum effect_home. */
enum trial_position { TRIAL_IDEAL, TRIAL_SENSOR, TRIAL_NOISE, TRIAL_POSITIONS };

enum { TRIAL_ROUNDS = 6 };

struct trial_count {
    int64_t lists, latest; /* how many lists have the cause, and the number of the latest */
};

/* The caller sets the first members, trial_prepare the stages, and the bench the rest. */
struct trial {
    const char *effects;       /* for glint-ideal */
    enum effect_id effect;     /* the only one that it leaves out; EFFECT_NONE: another chain */
    const char *programs[2];   /* after glint-ideal; the second may be NULL */
    enum trial_position first; /* before this stage it is the whole chain */
    void *own;                 /* the caller's */
    struct runner *stages[TRIAL_POSITIONS];

    int64_t changed;                    /* lists that differ from the whole chain's */
    struct intern causes;               /* of its effect, in the lists that changed */
    LIST_OF(struct trial_count) counts; /* by number of the cause */
    int64_t spent_ns[TRIAL_ROUNDS], latest_ns;
};

/* What a pass over frames does. */
enum {
    TRIAL_ALONE = 1 << 0,    /* the whole chain does not run first: trials begin at TRIAL_IDEAL */
    TRIAL_COMPARED = 1 << 1, /* lists are compared, and causes named */
    TRIAL_TIMED = 1 << 2,
    TRIAL_EFFECTS = 1 << 3, /* all trials without one effect run */
};

/* trial_begin sets the first members. The caller may set the next for each pass. */
struct trial_bench {
    struct runner *runner; /* of the tool; its diag has the messages */
    const struct suite *suite;
    bool doubts_cells;    /* true once a frame's reflectors were doubted */
    const char *vehicles; /* that objects are extracted with; NULL: the paper's */
    bool asks_vehicles;   /* by an option, which frames with reflectors refuse */
    bool extracts;        /* true once a frame without reflectors was extracted */
    const char *asked;    /* the effects of the whole chain, as they were asked for */
    uint64_t allowed;     /* their EFFECT_BITs */
    struct trial whole[TRIAL_POSITIONS]; /* the whole chain from each stage on */
    struct trial without[EFFECT_COUNT];  /* the whole chain less one effect that is allowed */

    int round; /* of the times */
    /* Takes the frame that a trial made, unless the trial leaves out an effect and all its lists
     * are the whole chain's; 0, or -1 after a message. NULL: nobody takes it. */
    int (*collect)(void *with, struct trial *trial, const struct frame *made);
    void *with;

    unsigned pass;
    LIST_OF(struct trial *) trials;
    struct effect_log log[TRIAL_POSITIONS]; /* of the whole chain's stages */
    int64_t lists, targets;                 /* that were compared, of the whole chain */
    int64_t frames[TRIAL_ROUNDS], head_ns[TRIAL_ROUNDS]; /* timed; reading and extraction */
    struct runner *extract, *logged[TRIAL_POSITIONS];
    struct frame frame, made;           /* of the whole chain, and of the latest trial */
    struct frame kept[TRIAL_POSITIONS]; /* what each stage of the whole chain read */
    struct arena arena, made_arena;
    struct list_cache cache;
    struct text line;
};

/* The --effects that decide as auto does among those that are allowed: "auto,-rows", or "none"; and
 * effects by their names: "rows,ghosts". */
const char *trial_request(uint64_t allowed, struct arena *arena);
const char *trial_names(uint64_t effects, struct arena *arena);

/* Sets up the whole chain for a suite and among the effects that are asked for, and its trials
 * without one effect. */
int trial_begin(struct trial_bench *bench, const struct trial_options *options,
                struct runner *runner);

/* Sets up the stages of a trial. */
void trial_prepare(struct trial_bench *bench, struct trial *trial);

/* Begins a pass of this kind, with the trials that it lists and those that are added. */
void trial_begin_pass(struct trial_bench *bench, unsigned pass);
void trial_add(struct trial_bench *bench, struct trial *trial);

/* Runs the trials on a frame under this seed. One of an effect that the whole chain has not
 * simulated yet has its lists and its time. -1 after a message that does not name the frame. */
int trial_run(struct trial_bench *bench, const struct sampled_frame *sampled, uint64_t seed);

/* Did the whole chain simulate the effect in any scan? Only then its trial ran. */
bool trial_simulated(const struct trial_bench *bench, enum effect_id effect);

/* What calls for the effect that the trial leaves out: what of the scene does in most lists that
 * changed, in the words of effect.h and by labels, and in how many; else (0) members of documents.
 */
const char *trial_cause(const struct trial *trial, int64_t *lists);

/* Microseconds a frame: the median over rounds, the least and the most. */
struct trial_time {
    double us, least_us, most_us;
};

/* The time of a trial that begins at TRIAL_IDEAL, with reading and extraction; and what one saves.
 */
struct trial_time trial_time_of(const struct trial_bench *bench, const struct trial *trial);
struct trial_time trial_saved(const struct trial_bench *bench, const struct trial *trial);

void trial_end(struct trial_bench *bench);
