#include "run/side_program.h"

#include <errno.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "text/document.h"

enum { NOT_STARTED = -1 };

extern char **environ;

const char *side_program_find(const char *name, struct arena *arena)
{
    struct text text = {0};
    text_format(&text, "%s%s", document_own_folder(arena), name);
    const char *path = arena_text(arena, text.bytes, text.length);
    text_free(&text);
    return access(path, X_OK) == 0 ? path : NULL;
}

static int64_t ns_of(struct timeval time)
{
    return (int64_t)time.tv_sec * 1000000000 + (int64_t)time.tv_usec * 1000;
}

/* CPU time of all processes that this one started and that have ended. */
static int64_t children_ns(void)
{
    struct rusage usage;
    getrusage(RUSAGE_CHILDREN, &usage);
    return ns_of(usage.ru_utime) + ns_of(usage.ru_stime);
}

/* Starts it between two files and waits for its end. Returns what waitpid tells of it, or
 * NOT_STARTED. */
static int run_between(const char *path, char *const *words, FILE *in, FILE *out)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(in), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(out), STDOUT_FILENO);
    pid_t child;
    int status = NOT_STARTED;
    if (posix_spawn(&child, path, &actions, NULL, words, environ) == 0)
        while (waitpid(child, &status, 0) < 0 && errno == EINTR)
            continue;
    posix_spawn_file_actions_destroy(&actions);
    return status;
}

static int read_all(FILE *file, struct text *output)
{
    enum { PIECE = 64 * 1024 };
    rewind(file);
    size_t got;
    while ((got = fread(text_room(output, PIECE), 1, PIECE, file)) > 0)
        output->length += got;
    return ferror(file);
}

/* Only the programs of glint end with codes of diag.h. */
static int tell_end(const char *path, int status, struct diag *diag)
{
    if (status == NOT_STARTED)
        return diag_fail(diag, DIAG_INTERNAL, "%s: cannot be started", path);
    if (!WIFEXITED(status))
        return diag_fail(diag, DIAG_INTERNAL, "%s: ended by signal %d", path, WTERMSIG(status));
    int code = WEXITSTATUS(status);
    bool known = code >= DIAG_USAGE && code <= DIAG_CONFIG;
    return diag_fail(diag, known ? (enum diag_code)code : DIAG_INTERNAL,
                     "%s: failed with exit status %d", path, code);
}

/* Files instead of pipes: neither side ever waits for the other. */
int side_program_run(const char *path, char *const *words, const struct text *input,
                     struct text *output, int64_t *cpu_ns, struct diag *diag)
{
    FILE *in = tmpfile(), *out = tmpfile();
    int64_t before_ns = children_ns();
    int status = 0;
    bool whole = in != NULL && out != NULL &&
                 fwrite(input->bytes, 1, input->length, in) == input->length && fflush(in) == 0;
    if (whole) {
        rewind(in);
        status = run_between(path, words, in, out);
        whole = read_all(out, output) == 0;
    }
    *cpu_ns += children_ns() - before_ns;
    if (in != NULL)
        fclose(in);
    if (out != NULL)
        fclose(out);
    if (!whole)
        return diag_fail(diag, DIAG_IO, "cannot exchange files with %s", path);
    return status == 0 ? 0 : tell_end(path, status, diag);
}
