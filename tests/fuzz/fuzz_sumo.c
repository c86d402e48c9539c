/* Floating car data of SUMO, played by glint-traffic-sumo with everybody as an ego. By the length
 * of the text it is played live, resampled, cut or with a radius too, and is its own file of types.
 * The first frame goes through the chain, and all of them are written and read back. */
#include "fuzz/fuzz.h"

enum { FRAMES = 50, WORDS = 8 };

static void play(size_t count, const char *const *words)
{
    struct runner runner;
    struct arena arena = {0};
    bool good = fuzz_begin(&runner, "traffic-sumo", count, words) == 0;
    for (int i = 0; good && i < FRAMES; i++) {
        struct frame frame = {.arena = &arena};
        arena_clear(&arena);
        good = runner_next(&runner, &frame) == 1;
        if (good)
            fuzz_round_trip(&frame);
        if (good && i == 0)
            fuzz_chain(&frame, "corner77-every-frame");
    }
    fuzz_judge(&runner.diag);
    runner_free(&runner);
    arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct fuzz_file file, types;
    fuzz_open(&file, bytes, size);
    fuzz_open(&types, bytes, size);
    const char *const ways[][WORDS] = {
        {file.path, "--ego", "all", "--class-default", "car", "--types", types.path},
        {file.path, "--ego", "all", "--live"},
        {file.path, "--ego", "all", "--rate-hz", "7", "--from-s", "0.6", "--class-default", "bus"},
        {file.path, "--ego", "ego,late", "--radius-m", "25", "--to-s", "1"},
    };
    const char *const *way = ways[size % (sizeof ways / sizeof ways[0])];
    size_t count = 0;
    while (count < WORDS && way[count] != NULL)
        count++;
    play(count, way);
    fuzz_close(&types);
    fuzz_close(&file);
    return 0;
}
