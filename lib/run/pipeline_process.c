#include "run/pipeline_process.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/suggestion.h"
#include "documents/suite_file.h"
#include "documents/vehicle_set.h"
#include "effects/effect.h"
#include "run/chain.h"
#include "run/datasheet.h"
#include "run/pipeline.h"
#include "text/data_folder.h"
#include "text/document.h"
#include "text/file_format.h"
#include "text/input.h"
#include "text/output.h"
#include "text/path.h"
#include "text/terminal.h"

/* The text of `glint` without arguments. */
static const char first_hour[] =
    "glint simulates the target lists that automotive radars report, with labels.\n"
    "\n"
    "    glint-traffic | glint-extract | glint-ideal | glint-sensor | glint-noise\n"
    "    scenes,         reflection      exact         resolution     noise:\n"
    "    objects         centres         echoes        cells          targets\n"
    "\n"
    "    glint two-vehicles > list.jsonl     simulate two cars, as two radars see them\n"
    "    glint-view list.jsonl -o list.html  see it: a page for any browser\n"
    "    glint-summary list.jsonl            count targets by sensor and by class\n"
    "    glint --list pipelines              other scenes and effects, ready to run\n"
    "    glint --list programs               all programs; each has a --help\n"
    "\n"
    "glint --help says how to run a pipeline of your own.\n";

static const char usage[] =
    "Usage: glint FILE\n"
    "  or:  glint -c TEXT\n"
    "  or:  glint --list WHAT\n"
    "  or:  glint --datasheet SUITE\n"
    "Run a pipeline of glint stages, and a tool at its end, in one process.\n"
    "\n"
    "FILE is a script that bash would run too, with the same output and exit code. It\n"
    "holds one pipeline: words, quotes, comments, continued lines, |, and the line\n"
    "`set -o pipefail`; frames for the first program may stand below, between <<'END'\n"
    "and END. Anything else is refused, with its line. If any program fails, the file\n"
    "of -o stays as it was. A name without dot and slash is that of a file or else of\n"
    "an installed pipeline: glint two-vehicles.\n"
    "\n"
    "Options:\n"
    "  -c TEXT              run TEXT instead of a file\n"
    "      --list WHAT      list what there is, with a sentence on each: programs,\n"
    "                       effects, sections, sensors, scenarios, vehicles or\n"
    "                       pipelines; of an effect, by its name: its cause, when\n"
    "                       auto leaves it out, and its cost\n"
    "      --datasheet SUITE\n"
    "                       print the radars of a suite (a name in data/sensors/, or\n"
    "                       a path) as their maker would: resolution, accuracy,\n"
    "                       ranges of detection, false alarms, and whether its\n"
    "                       figures agree\n"
    "  -h, --help           print this help\n"
    "      --version        print the version\n"
    "\n"
    "Exit status: that of the rightmost program that fails, as with bash's pipefail;\n"
    "64 if the pipeline is refused, 78 if a suite is.\n";

static int complain(const struct diag *diag)
{
    diag_print("glint", diag);
    return (int)diag->code;
}

/* A path may lead to another program of that name; where the system does not tell ours, it does. */
static bool is_own(const char *program, struct arena *arena)
{
    const char *slash = strrchr(program, '/'), *folder = data_folder_of_program(arena);
    if (slash == NULL)
        return true;
    if (*folder == '\0')
        return false;
    const char *own = arena_format(arena, "%s%s", folder, slash + 1);
    return access(own, X_OK) == 0 && path_same_file(program, own);
}

/* False if this build has no such stage or tool. A runner whose command line is refused is prepared
 * all the same: it fails when the chain starts, as it would in a pipe. */
static bool prepare(struct runner *runner, const struct command *command, struct arena *arena)
{
    const char *program = command->words.items[0], *name = stage_name_in_path(program);
    if (name == NULL || !is_own(program, arena))
        return false;
    const struct stage *stage = stage_by_name(name);
    if (stage != NULL)
        runner_prepare(runner, stage, command->words.count - 1, command->words.items + 1);
    return stage != NULL;
}

/* Refuses a program at a place where it would behave differently in a pipe of processes. */
static int check_place(const struct runner *runner, const struct command *command, size_t index,
                       size_t count, struct diag *diag)
{
    const struct stage *stage = runner->stage;
    const char *fault = NULL;
    if (index > 0 && stage->next != NULL)
        fault = "is a source and can only stand first";
    else if (index > 0 && !stage_takes_files(stage))
        fault = "reads no frames, so it can only stand first";
    else if (index > 0 && runner->common.files.count > 0)
        fault = "reads files, so it can only stand first";
    else if (index + 1 < count && (stage->sink || stage->run != NULL))
        fault = "writes no frames, so it can only stand last";
    else if (index + 1 < count && runner->common.output != NULL)
        fault = "writes to a file, so it can only stand last";
    else if (runner->common.help || runner->common.version)
        fault = "was asked for --help or --version";
    if (fault == NULL)
        return 0;
    return diag_fail(diag, DIAG_USAGE, "%zu: glint-%s %s; run it with bash", command->line,
                     stage->name, fault);
}

static int unknown_program(const struct command *command, struct diag *diag)
{
    const char *program = command->words.items[0], *name = stage_name_in_path(program);
    struct suggestion meant =
        suggestion_begin(name != NULL ? name : program, strlen(name != NULL ? name : program));
    for (size_t i = 0; stages[i] != NULL; i++)
        suggestion_offer(&meant, stages[i]->name);
    return diag_fail(diag, DIAG_USAGE,
                     "%zu: %s is no stage or tool of this build%s; run it with bash", command->line,
                     program, suggestion_question(&meant, "glint-"));
}

static int run_commands(const struct pipeline *pipeline, struct runner *runners,
                        struct arena *arena, struct diag *diag)
{
    size_t count = pipeline->commands.count;
    for (size_t i = 0; i < count; i++) {
        const struct command *command = &pipeline->commands.items[i];
        if (!prepare(&runners[i], command, arena))
            return unknown_program(command, diag);
        if (check_place(&runners[i], command, i, count, diag) != 0)
            return -1;
    }
    return chain_run(runners, count);
}

/* Lets standard input have the bytes of the here-document, from a file without a name. */
static int give_input(const struct pipeline *pipeline, struct diag *diag)
{
    if (pipeline->input == NULL)
        return 0;
    FILE *file = tmpfile();
    bool given = file != NULL &&
                 output_write_all(fileno(file), pipeline->input, pipeline->input_length) == 0 &&
                 lseek(fileno(file), 0, SEEK_SET) == 0 && dup2(fileno(file), STDIN_FILENO) >= 0;
    if (!given)
        diag_fail(diag, diag_code_by_errno(DIAG_IO), " a file for its here-document: %s",
                  strerror(errno));
    if (file != NULL)
        fclose(file);
    return given ? 0 : -1;
}

static int run_text(const char *name, const char *text, size_t length, struct arena *arena)
{
    struct diag diag = {0};
    struct pipeline pipeline;
    if (pipeline_parse(text, length, &pipeline, arena, &diag) != 0) {
        bool named = file_format_explain("pipeline", text, length, &diag);
        diag_prefix(&diag, named ? "%s: " : "%s:", name);
        return complain(&diag);
    }
    size_t count = pipeline.commands.count;
    struct runner *runners = arena_get(arena, count * sizeof *runners);
    int code = give_input(&pipeline, &diag);
    if (code == 0)
        code = run_commands(&pipeline, runners, arena, &diag);
    for (size_t i = 0; i < count; i++)
        runner_free(&runners[i]);
    if (diag.code == DIAG_OK)
        return code;
    diag_prefix(&diag, "%s:", name);
    return complain(&diag);
}

/* The file of that name, or else the installed pipeline. */
static const char *find_script(const char *name, struct arena *arena, struct diag *diag)
{
    return access(name, F_OK) == 0 ? name
                                   : document_find(NULL, "pipelines", name, ".sh", arena, diag);
}

static int read_script(const char *path, struct text *text, struct diag *diag)
{
    enum { MOST = 1 << 30 }; /* a here-document may be long */
    struct input *input = input_open(path, diag);
    int result = input != NULL ? input_all(input, MOST, text, diag) : -1;
    input_close(input);
    return result == 0 ? 0 : diag_prefix(diag, "%s: ", path);
}

static int run_file(const char *name, struct arena *arena)
{
    struct diag diag = {0};
    struct text text = {0};
    int code;
    const char *path = find_script(name, arena, &diag);
    if (path == NULL || read_script(path, &text, &diag) != 0)
        code = complain(&diag);
    else
        code = run_text(path, text.bytes, text.length, arena);
    text_free(&text);
    return code;
}

/* A stage stands at a place of the chain, a tool at its end or alone. */
static void add_programs(struct text *text)
{
    for (int tool = 0; tool < 2; tool++)
        for (size_t i = 0; stages[i] != NULL; i++)
            if ((stages[i]->run != NULL) == tool)
                text_format(text, "glint-%-17s  %s  %s\n", stages[i]->name,
                            tool ? "tool " : "stage", stages[i]->summary);
}

static void add_effects(struct text *text)
{
    for (int i = 0; i < EFFECT_COUNT; i++)
        text_format(text, "%-16s  %-7s %s\n", effects_names[i], effect_homes[effect_table[i]->home],
                    effect_table[i]->summary);
}

static void add_sections(struct text *text)
{
    for (int i = 0; sections_names[i] != NULL; i++)
        text_format(text, "%-10s  %s\n", sections_names[i], sections_meanings[i]);
}

static void add_effect(const struct effect *effect, struct text *text)
{
    bool leaves = effect->left_out_when != NULL;
    text_format(text, "%s\nsimulated by glint-%s\ndescribed by %s\nauto %s%s\ncosts %s\n",
                effect->summary, effect_homes[effect->home], effect->cause,
                leaves ? "leaves it out when " : "never leaves it out",
                leaves ? effect->left_out_when : "", effect->cost);
}

/* The origin of a suite or a scenario, without "Made for glint ...: " at its beginning; of a link,
 * what it leads to. */
static void add_origin(const char *name, const char *path, struct text *text, struct arena *arena)
{
    (void)name;
    static const char ours[] = "Made for glint";
    char *target = path_target(path);
    const char *there = path_name(target);
    bool is_link = strcmp(there, path_name(path)) != 0;
    if (is_link)
        text_format(text, "another name of %.*s", (int)strcspn(there, "."), there);
    free(target);
    if (is_link)
        return;
    const char *origin = document_origin(path, arena);
    if (origin == NULL)
        origin = "a document without an origin";
    const char *colon = strstr(origin, ": ");
    if (strncmp(origin, ours, sizeof ours - 1) == 0 && colon != NULL)
        origin = colon + 2;
    text_add_word(text, origin);
}

/* The sets of vehicles that have a document of the class beside the paper's. */
static void add_sets(const char *class, struct text *text, struct arena *arena)
{
    struct diag diag = {0};
    struct document_names sets;
    if (vehicle_set_list(class, &sets, arena, &diag) != 0)
        return;
    for (size_t i = 0; i < sets.names.count; i++)
        text_format(text, "%s%s", i == 0 ? "; also --vehicles " : ", ", sets.names.items[i]);
}

static void add_size(const char *name, const char *path, struct text *text, struct arena *arena)
{
    (void)path;
    struct diag diag = {0};
    const struct vehicle *vehicle = vehicle_load(name, NULL, arena, &diag);
    if (vehicle == NULL) {
        text_add_word(text, diag.text);
        return;
    }
    text_format(text, "%g m long, %g m wide, %g m high", vehicle->length_m, vehicle->width_m,
                vehicle->height_m);
    add_sets(name, text, arena);
}

/* The words of the comment at the head of a script, behind its first line, #!. */
static void read_comment(const char *path, struct text *comment)
{
    struct diag diag = {0};
    struct text script = {0};
    document_bytes(path, &script, &diag);
    text_add(&script, "", 1);
    const char *line = strchr(script.bytes, '\n');
    while (line != NULL && line[1] == '#') {
        size_t length = strcspn(line + 2, "\n");
        text_add(comment, line + 2, length);
        line = strchr(line + 2, '\n');
    }
    text_add(comment, "", 1);
    text_free(&script);
}

/* The comment's first sentence, or its first two if the first is a mere title. */
static void add_comment(const char *name, const char *path, struct text *text, struct arena *arena)
{
    enum { TITLE = 24 };
    (void)name;
    (void)arena;
    struct text comment = {0};
    read_comment(path, &comment);
    const char *words = comment.bytes + (comment.bytes[0] == ' ');
    const char *stop = strstr(words, ". ");
    if (stop != NULL && stop < words + TITLE)
        stop = strstr(stop + 1, ". ");
    text_add(text, words, stop != NULL ? (size_t)(stop + 1 - words) : strlen(words));
    text_free(&comment);
}

/* The kinds that --list knows beside the names of effects: either all is built in, or each thing is
 * a file with this ending, described in a line. */
static const struct listed_kind {
    const char *name;
    void (*add_built_in)(struct text *text);
    const char *ending;
    void (*describe)(const char *name, const char *path, struct text *text, struct arena *arena);
} kinds[] = {
    {.name = "programs", .add_built_in = add_programs},
    {.name = "effects", .add_built_in = add_effects},
    {.name = "sections", .add_built_in = add_sections},
    {.name = "sensors", .ending = ".json", .describe = add_origin},
    {.name = "scenarios", .ending = ".json", .describe = add_origin},
    {.name = "vehicles", .ending = ".json", .describe = add_size},
    {.name = "pipelines", .ending = ".sh", .describe = add_comment},
};

static int add_files(const struct listed_kind *kind, struct text *text, struct arena *arena,
                     struct diag *diag)
{
    struct document_names list;
    if (document_list(kind->name, kind->ending, &list, arena, diag) != 0)
        return -1;
    for (size_t i = 0; i < list.names.count; i++) {
        const char *name = list.names.items[i];
        const char *path = document_find(NULL, kind->name, name, kind->ending, arena, diag);
        text_format(text, "%-21s  ", name);
        if (path != NULL)
            kind->describe(name, path, text, arena);
        text_add_word(text, "\n");
    }
    return 0;
}

/* Adds a line for each thing of that kind: its name, and what it is in a sentence, before which an
 * effect has the stage that simulates it. A document that cannot be read has its message instead.
 * If kind is the name of an effect: its sentence, stage, cause, when auto leaves it out, and cost,
 * a line each. DIAG_USAGE for another kind. */
static int add_listing(const char *kind, struct text *text, struct arena *arena, struct diag *diag)
{
    struct suggestion meant = suggestion_begin(kind, strlen(kind));
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        suggestion_offer(&meant, kinds[i].name);
        if (strcmp(kind, kinds[i].name) != 0)
            continue;
        if (kinds[i].add_built_in == NULL)
            return add_files(&kinds[i], text, arena, diag);
        kinds[i].add_built_in(text);
        return 0;
    }
    for (int i = 0; i < EFFECT_COUNT; i++) {
        suggestion_offer(&meant, effects_names[i]);
        if (strcmp(kind, effects_names[i]) == 0) {
            add_effect(effect_table[i], text);
            return 0;
        }
    }
    return diag_fail(diag, DIAG_USAGE,
                     "--list %s is unknown%s; expected programs, effects, sections, sensors, "
                     "scenarios, vehicles, pipelines or the name of an effect",
                     kind, suggestion_question(&meant, ""));
}

static int print(const char *bytes, size_t length)
{
    struct diag diag = {0};
    return output_print(bytes, length, &diag) == 0 ? 0 : complain(&diag);
}

static int add_datasheet(const char *name, struct text *text, struct arena *arena,
                         struct diag *diag)
{
    const struct suite *suite = suite_file_load(name, arena, diag);
    if (suite == NULL)
        return -1;
    datasheet_add(suite, text);
    return 0;
}

/* Prints what an option asks for: the text that this function adds for its value, which fits a
 * terminal. */
static int answer(int (*add)(const char *, struct text *, struct arena *, struct diag *),
                  const char *value, struct arena *arena)
{
    struct diag diag = {0};
    struct text text = {0};
    int result = add(value, &text, arena, &diag);
    terminal_fit(&text, terminal_columns(STDOUT_FILENO));
    int code = result == 0 ? print(text.bytes, text.length) : complain(&diag);
    text_free(&text);
    return code;
}

static int refuse_options(const char *first)
{
    static const char *const options[] = {"c", "list", "datasheet", "help", "version"};
    const char *name = first + strspn(first, "-");
    struct suggestion meant = suggestion_begin(name, strlen(name));
    bool known = first[0] != '-';
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        suggestion_offer(&meant, options[i]);
        known = known || strcmp(name, options[i]) == 0;
    }
    struct diag diag = {0};
    if (known)
        diag_fail(&diag, DIAG_USAGE, "expected a FILE, -c TEXT or an option; see --help");
    else
        diag_fail(&diag, DIAG_USAGE, "unknown option %s%s; see --help", first,
                  suggestion_question(&meant, "--"));
    return complain(&diag);
}

static int run(int count, char **words, struct arena *arena)
{
    const char *first = count > 1 ? words[1] : "", *second = count > 2 ? words[2] : NULL;
    if (count < 2) {
        fputs(first_hour, stderr);
        return DIAG_USAGE;
    }
    if (strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
        return print(usage, sizeof usage - 1);
    if (strcmp(first, "--version") == 0)
        return print("glint (glint) " GLINT_VERSION "\n", sizeof "glint (glint) " GLINT_VERSION);
    if (count == 3 && strcmp(first, "-c") == 0)
        return run_text("-c", second, strlen(second), arena);
    if (count == 3 && strcmp(first, "--list") == 0)
        return answer(add_listing, second, arena);
    if (count == 3 && strcmp(first, "--datasheet") == 0)
        return answer(add_datasheet, second, arena);
    if (count == 2 && (first[0] != '-' || first[1] == '\0'))
        return run_file(first, arena);
    return refuse_options(first);
}

int pipeline_process_main(int count, char **words)
{
    document_guard_memory();
    input_guard_descriptors();
    struct arena arena = {0};
    int code = run(count, words, &arena);
    arena_free(&arena);
    return code;
}
