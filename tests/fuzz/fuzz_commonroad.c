/* Scenarios of CommonRoad, played by glint-traffic-commonroad with everybody as an ego, by the
 * length of the text resampled, with a class for all words, or cut and with a radius. */
#include "fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct fuzz_file file;
    fuzz_open(&file, bytes, size);
    const char *const ways[][8] = {
        {file.path, "--ego", "all", "--class-default", "car"},
        {file.path, "--ego", "all", "--rate-hz", "7", "--class-default", "post"},
        {file.path, "--ego", "30,7", "--radius-m", "25", "--to-s", "0.3"},
    };
    fuzz_play("traffic-commonroad", ways[size % (sizeof ways / sizeof ways[0])]);
    fuzz_close(&file);
    return 0;
}
