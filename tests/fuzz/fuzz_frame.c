/* Frames, line after line, plain or gzip, as every stage reads them. */
#include "fuzz/fuzz.h"
#include "run/frame_stream.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct fuzz_file file;
    fuzz_open(&file, bytes, size);
    const char *path = file.path;
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    struct frame_stream stream = {.paths = &path, .count = 1};
    struct diag diag = {0};
    while (frame_stream_next(&stream, &frame, &diag) == 1)
        fuzz_round_trip(&frame);
    fuzz_judge(&diag);
    frame_stream_close(&stream);
    arena_free(&arena);
    fuzz_close(&file);
    return 0;
}
