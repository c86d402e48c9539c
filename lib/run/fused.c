#include "run/fused.h"

#include <inttypes.h>
#include <stdio.h>
#include <unistd.h>

#include "base/suggestion.h"
#include "documents/datasheet_text.h"
#include "documents/suite_file.h"
#include "run/chain.h"
#include "run/listing.h"
#include "run/pipeline.h"
#include "text/document.h"
#include "text/file_format.h"
#include "text/input.h"
#include "text/output.h"
#include "text/path.h"

static const char usage[] =
    "Usage: glint FILE\n"
    "  or:  glint -c TEXT\n"
    "  or:  glint --times FILE\n"
    "  or:  glint --list sensors | scenarios | vehicles | pipelines | stages | tools | effects\n"
    "  or:  glint --list EFFECT\n"
    "  or:  glint --datasheet SUITE\n"
    "Run a pipeline of glint stages, and a tool at its end, in one process.\n"
    "\n"
    "FILE is a script that bash would run too, with the same output and exit code. It holds\n"
    "one pipeline: words, quotes, comments, continued lines, |, and the line\n"
    "`set -o pipefail`. Anything else is refused, with its line. If any program fails, the\n"
    "file of -o is left as it was. A name without dot and slash that no file has is that of an\n"
    "installed pipeline: glint two-vehicles.\n"
    "\n"
    "Options:\n"
    "  -c TEXT              run TEXT instead of a file\n"
    "      --times FILE     run FILE, then print where the time went to stderr (JSON lines)\n"
    "      --list WHAT      list what is installed, with a sentence on each; of an effect,\n"
    "                       by its name, what causes it, when auto leaves it out, its cost\n"
    "      --datasheet SUITE\n"
    "                       print the radars of a suite (a name in data/sensors/, or a path) as\n"
    "                       their maker would: resolution, accuracy, ranges of detection, false\n"
    "                       alarms, and how well the figures agree with each other\n"
    "  -h, --help           print this help\n"
    "      --version        print the version\n"
    "\n"
    "Exit status: that of the rightmost program that fails, as with bash's pipefail; 64 if the\n"
    "pipeline is refused, 78 if a suite is.\n";

static int complain(const struct diag *diag)
{
    diag_print("glint", diag);
    return (int)diag->code;
}

const char *fused_name(const char *path)
{
    const char *name = path_name(path);
    return strncmp(name, "glint-", 6) == 0 ? name + 6 : NULL;
}

const struct stage *fused_stage(const char *name)
{
    for (size_t i = 0; stages[i] != NULL; i++)
        if (strcmp(stages[i]->name, name) == 0)
            return stages[i];
    return NULL;
}

const struct tool *fused_tool(const char *name)
{
    for (size_t i = 0; tools[i] != NULL; i++)
        if (strcmp(tools[i]->name, name) == 0)
            return tools[i];
    return NULL;
}

/* A program that is named by a path may be another one of the same name. */
static bool is_own(const char *program, struct arena *arena)
{
    const char *slash = strrchr(program, '/');
    if (slash == NULL)
        return true;
    const char *own = arena_format(arena, "%s%s", document_own_folder(arena), slash + 1);
    return access(own, X_OK) == 0 && path_same_file(program, own);
}

/* False if this build has no such stage or tool. A runner whose command line is refused is prepared
 * all the same: it fails when the chain starts, as it would in a pipe. */
static bool prepare(struct runner *runner, const struct command *command, struct arena *arena)
{
    const char *program = command->words.items[0], *name = fused_name(program);
    if (name == NULL || !is_own(program, arena))
        return false;
    const struct stage *stage = fused_stage(name);
    const struct tool *tool = fused_tool(name);
    size_t count = command->words.count - 1;
    const char *const *words = command->words.items + 1;
    if (stage != NULL)
        runner_prepare(runner, stage, count, words);
    else if (tool != NULL)
        runner_prepare_tool(runner, tool, count, words);
    return stage != NULL || tool != NULL;
}

/* Refuses what a pipe of processes would do in another way than one process. */
static int check_place(const struct runner *runner, const struct command *command, size_t index,
                       size_t count, struct diag *diag)
{
    const struct program *program = &runner->program;
    const char *fault = NULL;
    if (index > 0 && program->kind == PROGRAM_SOURCE)
        fault = "is a source and can only stand first";
    else if (index > 0 && !program->takes_files)
        fault = "reads no frames, so it can only stand first";
    else if (index > 0 && runner->common.files.count > 0)
        fault = "reads files, so it can only stand first";
    else if (index + 1 < count && (program->kind == PROGRAM_SINK || program->kind == PROGRAM_TOOL))
        fault = "writes no frames, so it can only stand last";
    else if (index + 1 < count && runner->common.output != NULL)
        fault = "writes to a file, so it can only stand last";
    else if (runner->common.help || runner->common.version)
        fault = "was asked for --help or --version";
    if (fault == NULL)
        return 0;
    return diag_fail(diag, DIAG_USAGE, "%zu: glint-%s %s; run it with bash", command->line,
                     program->name, fault);
}

static int unknown_program(const struct command *command, struct diag *diag)
{
    const char *program = command->words.items[0], *name = fused_name(program);
    struct suggestion meant =
        suggestion_begin(name != NULL ? name : program, strlen(name != NULL ? name : program));
    for (size_t i = 0; stages[i] != NULL; i++)
        suggestion_offer(&meant, stages[i]->name);
    for (size_t i = 0; tools[i] != NULL; i++)
        suggestion_offer(&meant, tools[i]->name);
    return diag_fail(diag, DIAG_USAGE,
                     "%zu: %s is no stage or tool of this build%s; run it with bash", command->line,
                     program, suggestion_question(&meant, "glint-"));
}

static int run_commands(const struct pipeline *pipeline, struct runner *runners,
                        struct chain_times *times, struct arena *arena, struct diag *diag)
{
    size_t count = pipeline->commands.count;
    for (size_t i = 0; i < count; i++) {
        const struct command *command = &pipeline->commands.items[i];
        if (!prepare(&runners[i], command, arena))
            return unknown_program(command, diag);
        if (check_place(&runners[i], command, i, count, diag) != 0)
            return -1;
    }
    return chain_run(runners, count, times);
}

static void print_time(const char *part, int64_t total_ns, int64_t frames)
{
    fprintf(stderr, "{\"part\":\"%s\",\"frames\":%" PRId64 ",\"ns_per_frame\":%.0f}\n", part,
            frames, frames > 0 ? (double)total_ns / (double)frames : 0);
}

static void print_times(const struct chain_times *times, const struct runner *runners, size_t count)
{
    if (times->bytes_read > 0)
        print_time("read", times->read_ns, times->frames);
    for (size_t i = 0; i < count; i++)
        print_time(runners[i].program.name, times->step_ns[i], times->frames);
    if (times->bytes_written > 0)
        print_time("write", times->write_ns, times->frames);
    fprintf(stderr, "{\"part\":\"bytes\",\"read\":%" PRId64 ",\"written\":%" PRId64 "}\n",
            times->bytes_read, times->bytes_written);
}

static int run_text(const char *name, const char *text, size_t length, bool timed,
                    struct arena *arena)
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
    struct chain_times times = {.step_ns = arena_get(arena, count * sizeof(int64_t))};
    int code = run_commands(&pipeline, runners, timed ? &times : NULL, arena, &diag);
    if (timed && diag.code == DIAG_OK)
        print_times(&times, runners, count);
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
    return access(name, F_OK) == 0 ? name : document_find("pipelines", name, ".sh", arena, diag);
}

static int run_file(const char *name, bool timed, struct arena *arena)
{
    struct diag diag = {0};
    struct text text = {0};
    int code;
    const char *path = find_script(name, arena, &diag);
    if (path == NULL || document_bytes(path, &text, &diag) != 0)
        code = complain(&diag);
    else
        code = run_text(path, text.bytes, text.length, timed, arena);
    text_free(&text);
    return code;
}

static int print(const char *bytes, size_t length)
{
    struct diag diag = {0};
    return output_print(bytes, length, &diag) == 0 ? 0 : complain(&diag);
}

static int list(const char *kind, struct arena *arena)
{
    struct diag diag = {0};
    struct text text = {0};
    int code = listing_add(kind, &text, arena, &diag) == 0 ? print(text.bytes, text.length)
                                                           : complain(&diag);
    text_free(&text);
    return code;
}

static int print_datasheet(const char *name, struct arena *arena)
{
    struct diag diag = {0};
    const struct suite *suite = suite_file_load(name, arena, &diag);
    if (suite == NULL)
        return complain(&diag);
    struct text text = {0};
    datasheet_text_add(suite, &text);
    int code = print(text.bytes, text.length);
    text_free(&text);
    return code;
}

static int refuse_options(const char *first)
{
    static const char *const options[] = {"c", "times", "list", "datasheet", "help", "version"};
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
    if (strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
        return print(usage, sizeof usage - 1);
    if (strcmp(first, "--version") == 0)
        return print("glint (glint) " GLINT_VERSION "\n", sizeof "glint (glint) " GLINT_VERSION);
    if (count == 3 && strcmp(first, "-c") == 0)
        return run_text("-c", second, strlen(second), false, arena);
    if (count == 3 && strcmp(first, "--times") == 0)
        return run_file(second, true, arena);
    if (count == 3 && strcmp(first, "--list") == 0)
        return list(second, arena);
    if (count == 3 && strcmp(first, "--datasheet") == 0)
        return print_datasheet(second, arena);
    if (count == 2 && (first[0] != '-' || first[1] == '\0'))
        return run_file(first, false, arena);
    return refuse_options(first);
}

int fused_main(int count, char **words)
{
    document_guard_memory();
    input_guard_descriptors();
    struct arena arena = {0};
    int code = run(count, words, &arena);
    arena_free(&arena);
    return code;
}
