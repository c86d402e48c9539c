/* Documents of vehicles and other things. One that is taken stands before a radar in three frames,
 * each with another extract. */
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "documents/vehicle.h"
#include "fuzz/fuzz.h"

/* A frame names a class by a plain name, so the document stands in a folder of data of its own. */
static void write_document(const uint8_t *bytes, size_t size)
{
    char path[64];
    int length = snprintf(path, sizeof path, "build-fuzz/vehicle.%ld", (long)getpid());
    setenv("GLINT_DATA", path, 1);
    mkdir(path, 0777);
    length += snprintf(path + length, sizeof path - (size_t)length, "/vehicles");
    mkdir(path, 0777);
    snprintf(path + length, sizeof path - (size_t)length, "/fuzzed.json");
    FILE *file = fopen(path, "w");
    fuzz_must(file != NULL && fwrite(bytes, 1, size, file) == size, "no document in build-fuzz");
    fclose(file);
}

static void look(int number)
{
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    fuzz_scene(&frame, number, "fuzzed");
    fuzz_chain(&frame, "corner77-every-frame");
    arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct arena arena = {0};
    struct diag diag = {0};
    write_document(bytes, size);
    bool taken = vehicle_load("fuzzed", NULL, &arena, &diag) != NULL;
    fuzz_judge(&diag);
    for (int number = 0; taken && number < 3; number++)
        look(number);
    arena_free(&arena);
    return 0;
}
