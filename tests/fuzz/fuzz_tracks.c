/* A tracker's lines beside a stream of frames, as glint-score-tracks reads them. */
#include "fuzz/fuzz.h"
#include "score/reference_stream.h"

static void match(struct reference_stream *tracks, int number, struct diag *diag)
{
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    struct track_list list;
    fuzz_scene(&frame, number, "car");
    reference_stream_tracks(tracks, &frame, &list, diag);
    arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct fuzz_file file;
    fuzz_open(&file, bytes, size);
    struct diag diag = {0};
    struct reference_stream *tracks =
        reference_stream_open(file.path, &track_list_record, true, (struct input_pause){0}, &diag);
    for (int number = 0; diag.code == DIAG_OK && number < 3; number++)
        match(tracks, number, &diag);
    if (diag.code == DIAG_OK)
        reference_stream_finish(tracks, &diag);
    fuzz_judge(&diag);
    reference_stream_close(tracks);
    fuzz_close(&file);
    return 0;
}
