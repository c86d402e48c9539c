/* Traffic of SUMO: floating car data as XML, also from a pipe while SUMO runs, or as a table. */
#include "run/recording_source.h"
#include "sumo_rows.h"
#include "sumo_types.h"

struct traffic_sumo {
    struct recording recording;  /* first, as its functions take it */
    LIST_OF(const char *) types; /* files */
};

static const struct field traffic_sumo_fields[] = {
    RECORDING_SOURCE(
        "the XML that sumo --fcd-output writes, plain or gzip; - is standard input; or "
        "the file of a table"),
    {.name = "types",
     .kind = FIELD_NAMES,
     .offset = offsetof(struct traffic_sumo, types),
     .help = "a file of SUMO with vTypes; may be given several times; absent: SUMO's default size "
             "of each class",
     .word = "FILE",
     FIELD_OPTIONAL},
    {OPTIONAL_FLAG(struct recording, live, "write each frame before the next step arrives")},
    {0},
};

/* A table of another program has no reader here. */
static struct recorded_reader open_table(struct input *input, const char *path,
                                         struct runner *runner)
{
    struct diag *diag = runner_diag(runner);
    struct recorded_reader reader = recorded_table_open(input, path, runner_arena(runner), diag);
    if (reader.format == NULL || reader.format->of_sumo)
        return reader;
    diag_fail(diag, DIAG_DATA, "%s; glint-traffic plays it", reader.format->name);
    reader.format->close(reader.state);
    return (struct recorded_reader){0};
}

static int traffic_sumo_start(void *state, struct runner *runner)
{
    struct traffic_sumo *own = state;
    struct recording *recording = &own->recording;
    struct arena *arena = runner_arena(runner);
    struct diag *diag = runner_diag(runner);
    for (size_t i = 0; i < own->types.count; i++)
        if (sumo_types_read(&recording->types, own->types.items[i], arena, diag) != 0)
            return -1;
    int xml = recording_source_begins(recording->source, '<', runner);
    struct input *input = xml >= 0 ? recording_source_input(state, runner) : NULL;
    if (input == NULL)
        return -1;
    struct recorded_reader reader =
        xml ? sumo_rows_open(input, arena) : open_table(input, recording->source, runner);
    return recording_open(recording, reader, arena, diag);
}

#define SUMO_FIRST(word, class, length_m, width_m, height_m) "\n    " class ": " word
#define SUMO(word, class, length_m, width_m, height_m) ", " word

const struct stage stage_traffic_sumo = {
    .name = "traffic-sumo",
    .summary = "Play the floating car data of SUMO, frame by frame.",
    .details =
        "Velocities and yaw rates come from the places, not from SUMO's speeds: while a vehicle\n"
        "changes lanes it does not move along its heading. They are centred differences, which\n"
        "wait for the next step. With --live they are differences from the step before, each "
        "frame\n"
        "goes out before the next step arrives, and no frame is marked as the last of its scene.\n"
        "Give sumo --precision 6: with its default of two decimals velocities are coarse. If it\n"
        "writes to a pipe, also give it --no-step-log, as its log would mix with the XML.\n"
        "\n"
        "Classes and sizes come from the types (--types). Without --types, each name of a\n"
        "type must be in --class-map or in this list of names by class:"
#include "recorded/recorded_classes.def"
    ,
    .options = STAGE_OPTIONS(struct traffic_sumo, traffic_sumo_fields),
    .operand = "SOURCE",
    .writes = PART_OBJECTS,
    .start = traffic_sumo_start,
    .next = recording_source_next,
    .locate_fault = recording_source_locate_fault,
    .release = recording_close,
};
