/* Floating car data of SUMO, played by glint-traffic-sumo with everybody as an ego: by the length
 * of the text live, resampled, or cut and with a radius. What begins as a file of routes gives the
 * types of a fixed recording. Frames are written and read back; the first resampled one goes
 * through the chain. */
#include <string.h>

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
        if (good && i == 0 && count == WORDS)
            fuzz_chain(&frame, "corner77-every-frame");
    }
    fuzz_judge(&runner.diag);
    runner_free(&runner);
    arena_free(&arena);
}

static const char recording[] =
    "<fcd-export><timestep time=\"0\"><vehicle id=\"a\" x=\"0\" y=\"0\" angle=\"9\" type=\"bus\"/>"
    "</timestep></fcd-export>";

static void play_file(const char *path, size_t way)
{
    const char *const ways[][WORDS] = {
        {path, "--ego", "all", "--live", "--class-default", "car"},
        {path, "--ego", "all", "--rate-hz", "7", "--from-s", "0.6", "--class-default", "bus"},
        {path, "--ego", "ego,late", "--radius-m", "25", "--to-s", "1"},
    };
    const char *const *words = ways[way % (sizeof ways / sizeof ways[0])];
    size_t count = 0;
    while (count < WORDS && words[count] != NULL)
        count++;
    play(count, words);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static const char root[] = "<routes>";
    struct fuzz_file file, fixed;
    fuzz_open(&file, bytes, size);
    fuzz_open(&fixed, recording, strlen(recording));
    const char *const typed[] = {fixed.path, "--ego", "all", "--types", file.path};
    if (size > strlen(root) && memcmp(bytes, root, strlen(root)) == 0)
        play(sizeof typed / sizeof typed[0], typed);
    else
        play_file(file.path, size);
    fuzz_close(&fixed);
    fuzz_close(&file);
    return 0;
}
