/* Floating car data of SUMO, played by glint-traffic-sumo with everybody as an ego: by the length
 * of the text live, resampled, or cut and with a radius. What begins as a file of routes gives the
 * types of a fixed recording. */
#include <string.h>

#include "fuzz/fuzz.h"

static const char recording[] =
    "<fcd-export><timestep time=\"0\"><vehicle id=\"a\" x=\"0\" y=\"0\" angle=\"9\" type=\"bus\"/>"
    "</timestep></fcd-export>";

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static const char root[] = "<routes>";
    struct fuzz_file file, fixed;
    fuzz_open(&file, bytes, size);
    fuzz_open(&fixed, recording, strlen(recording));
    const char *const typed[] = {fixed.path, "--ego", "all", "--types", file.path, NULL};
    const char *const ways[][10] = {
        {file.path, "--ego", "all", "--live", "--class-default", "car"},
        {file.path, "--ego", "all", "--rate-hz", "7", "--from-s", "0.6", "--class-default", "bus"},
        {file.path, "--ego", "ego,late", "--radius-m", "25", "--to-s", "1"},
    };
    bool routes = size > strlen(root) && memcmp(bytes, root, strlen(root)) == 0;
    fuzz_play("traffic-sumo", routes ? typed : ways[size % (sizeof ways / sizeof ways[0])]);
    fuzz_close(&fixed);
    fuzz_close(&file);
    return 0;
}
