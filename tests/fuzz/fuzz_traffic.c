/* Scenarios and recorded tables, played by glint-traffic: the first frames go through the chain. A
 * text that begins with a brace is a scenario, any other a table and the files beside it at once,
 * of which everybody is an ego. */
#include <stdio.h>
#include <unistd.h>

#include "fuzz/fuzz.h"

/* The names of these files say what they are. */
static void play_table(const uint8_t *bytes, size_t size)
{
    static const char *const names[] = {"tracks", "tracksMeta", "recordingMeta"};
    enum { FILES = sizeof names / sizeof names[0] };
    char paths[FILES][64];
    for (size_t i = 0; i < FILES; i++) {
        snprintf(paths[i], sizeof paths[i], "build-fuzz/fuzz_%ld_%s.csv", (long)getpid(), names[i]);
        FILE *file = fopen(paths[i], "w");
        fuzz_must(file != NULL && fwrite(bytes, 1, size, file) == size, "no table in build-fuzz");
        fclose(file);
    }
    fuzz_play("traffic", (const char *const[]){paths[0], "--ego", "all", NULL});
    for (size_t i = 0; i < FILES; i++)
        unlink(paths[i]);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (size == 0 || bytes[0] != '{') {
        play_table(bytes, size);
        return 0;
    }
    struct fuzz_file file;
    fuzz_open(&file, bytes, size);
    fuzz_play("traffic", (const char *const[]){file.path, NULL});
    fuzz_close(&file);
    return 0;
}
