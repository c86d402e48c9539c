/* Scenarios of CommonRoad, played by glint-traffic-commonroad with all egos. */
#include "fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct fuzz_file file;
    fuzz_open(&file, bytes, size);
    fuzz_play("traffic-commonroad", file.path, "all");
    fuzz_close(&file);
    return 0;
}
