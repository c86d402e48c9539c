/* A suite, and then a frame of objects, with or without reflectors, that the whole chain sees with
 * it. The suite is the text's first line, the frame its second. */
#include <string.h>

#include "fuzz/fuzz.h"
#include "run/frame_stream.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    const uint8_t *end = memchr(bytes, '\n', size);
    if (end == NULL)
        return 0;
    struct fuzz_file suite;
    fuzz_open(&suite, bytes, (size_t)(end - bytes));
    size_t rest = size - (size_t)(end + 1 - bytes);
    if (rest > 0 && end[rest] == '\n')
        rest--;
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    struct diag diag = {0};
    if (frame_stream_parse((const char *)end + 1, rest, &frame, &diag) == 0)
        fuzz_chain(&frame, suite.path);
    fuzz_judge(&diag);
    arena_free(&arena);
    fuzz_close(&suite);
    return 0;
}
