/* What a function prints, for tests of modules that write to standard output and stderr: the
 * function runs in a process of its own, and its result is the exit code. */
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include "check.h"

struct captured {
    int code;
    char out[1 << 16], err[4096]; /* with a NUL at the end */
};

static inline void captured_read(FILE *file, char *text, size_t size)
{
    rewind(file);
    text[fread(text, 1, size - 1, file)] = '\0';
    fclose(file);
}

/* Standard input is empty. */
static inline void capture(struct captured *captured, int (*function)(const void *),
                           const void *with)
{
    FILE *in = fopen("/dev/null", "r"), *out = tmpfile(), *err = tmpfile();
    int code = -1;
    pid_t child = fork();
    if (child == 0) {
        dup2(fileno(in), STDIN_FILENO);
        dup2(fileno(out), STDOUT_FILENO);
        dup2(fileno(err), STDERR_FILENO);
        _exit(function(with));
    }
    assert_int_equal(waitpid(child, &code, 0), child);
    assert_true(WIFEXITED(code));
    captured->code = WEXITSTATUS(code);
    captured_read(out, captured->out, sizeof captured->out);
    captured_read(err, captured->err, sizeof captured->err);
    fclose(in);
}
