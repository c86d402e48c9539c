/* Message and exit code of a failure.
 *
 * Functions that can fail return 0, or -1 after filling a struct diag; only the mains print and
 * exit. A message names the place, the value and what was expected; the runner puts program, file
 * and line in front of it. A text without a code is a note, and is printed too. Exit codes are
 * those of sysexits.h: a script can tell bad data (do not retry) from a full disk (retry). */
#pragma once

enum diag_code {
    DIAG_OK = 0,
    DIAG_USAGE = 64,
    DIAG_DATA = 65,
    DIAG_NO_INPUT = 66,
    DIAG_INTERNAL = 70,
    DIAG_MEMORY = 71, /* or file descriptors */
    DIAG_CANNOT_CREATE = 73,
    DIAG_IO = 74,
    DIAG_CONFIG = 78,
};

struct diag {
    enum diag_code code;
    char text[2048];
};

/* Records the failure and returns -1. A failure already recorded stays, because the first message
 * is nearest the cause. */
int diag_fail(struct diag *diag, enum diag_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Notes what is printed at the end of the run, which goes on. The first note stays. */
void diag_note(struct diag *diag, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* DIAG_MEMORY if errno says that memory or descriptors are used up, otherwise the code. */
enum diag_code diag_code_by_errno(enum diag_code otherwise);

/* Puts the formatted text in front of the recorded message, for the place that only the caller
 * knows; returns -1. */
int diag_prefix(struct diag *diag, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Prints "PROGRAM: MESSAGE" to stderr as one line, which no other process's output parts, with
 * control characters, also U+0080 to U+009F, as \xNN, because a message may quote input. */
void diag_print(const char *program, const struct diag *diag);
