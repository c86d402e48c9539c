/* What the harnesses of libFuzzer share. tests/tools/fuzz builds and runs them.
 *
 * A harness reads any bytes as one kind of input. It fails by a report of the sanitizers, by an
 * exit, or by fuzz_must. Input may be refused, but never with DIAG_INTERNAL, which says that a
 * stage is wrong. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/diag.h"
#include "run/runner.h"

/* libFuzzer calls this with every input. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

/* Ends the program with a message that libFuzzer keeps the input for. */
void fuzz_must(bool holds, const char *what);

/* Refuses DIAG_INTERNAL. */
void fuzz_judge(const struct diag *diag);

/* A file in memory with these bytes. The path lies in the struct. */
struct fuzz_file {
    int descriptor;
    char path[32];
};
void fuzz_open(struct fuzz_file *file, const void *bytes, size_t size);
void fuzz_close(struct fuzz_file *file);

/* A stage by its name, prepared with these words and started. Returns 0, or -1 if it refused. It
 * must be freed by runner_free in both cases. */
int fuzz_begin(struct runner *runner, const char *stage, size_t count, const char *const *words);

/* Frame number 0 or more of a scene "s", a second after the one before: an ego, and a thing of this
 * class 12 m ahead of it. */
void fuzz_scene(struct frame *frame, int number, const char *class);

/* Runs the frame through ideal, sensor and noise with this suite, as far as they take it, and
 * before that through one of the extracts, chosen by its number, unless it has reflectors. What
 * comes out must be a line that reads back to the same line. */
void fuzz_chain(struct frame *frame, const char *suite);

/* Plays a source with these words, the last of which is NULL: the first frames are written and read
 * back, the first three go through the chain. */
void fuzz_play(const char *stage, const char *const *words);

/* Writes the frame, reads it back and writes it again: both lines must be equal. */
void fuzz_round_trip(const struct frame *frame);
