/* Scenarios and recorded tables, played by glint-traffic: the first frames go through the chain. A
 * text that begins with a brace is a scenario, any other a table, whose ego is the first track. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "fuzz/fuzz.h"

/* The name of a table says that it is one, so it needs a file with a name. */
static void play_table(const uint8_t *bytes, size_t size)
{
    char path[64], ego[64] = "1";
    const char *row = memchr(bytes, '\n', size), *end = (const char *)bytes + size;
    snprintf(path, sizeof path, "build-fuzz/fuzz_traffic.%ld.csv", (long)getpid());
    FILE *file = fopen(path, "w");
    fuzz_must(file != NULL && fwrite(bytes, 1, size, file) == size, "no table in build-fuzz");
    fclose(file);
    if (row != NULL && memchr(row, ',', (size_t)(end - row)) != NULL)
        snprintf(ego, sizeof ego, "%.*s",
                 (int)((const char *)memchr(row, ',', (size_t)(end - row)) - row - 1), row + 1);
    fuzz_play("traffic", path, ego);
    unlink(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (size == 0 || bytes[0] != '{') {
        play_table(bytes, size);
        return 0;
    }
    struct fuzz_file file;
    fuzz_open(&file, bytes, size);
    fuzz_play("traffic", file.path, NULL);
    fuzz_close(&file);
    return 0;
}
