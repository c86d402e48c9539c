/* Traces of OSI, played by glint-traffic-osi with the host or with everybody as an ego, by the
 * length of the trace live, resampled, or with velocities of rear axles. */
#include "fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct fuzz_file file;
    fuzz_open(&file, bytes, size);
    const char *const ways[][8] = {
        {file.path, "--class-default", "car"},
        {file.path, "--ego", "all", "--rear-axle-velocity"},
        {file.path, "--ego", "all", "--live", "--class-default", "bus"},
        {file.path, "--ego", "0,7", "--rate-hz", "30", "--radius-m", "20"},
    };
    fuzz_play("traffic-osi", ways[size % (sizeof ways / sizeof ways[0])]);
    fuzz_close(&file);
    return 0;
}
