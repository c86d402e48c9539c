#define SCRATCH_FILE "lines.jsonl"
#include "scratch.h"

#include "sample.h"
#include "score/reference_stream.h"

enum { SCENES = 4, FRAMES = 25 };

static void write_line(FILE *file, int scene, int frame)
{
    fprintf(
        file,
        "{\"scene\":\"scene %d\",\"frame\":%d,\"tracks\":[{\"id\":\"%d.%d\",\"x_m\":0,\"y_m\":0,"
        "\"vx_mps\":0,\"vy_mps\":0}]}\n",
        scene, frame, scene, frame);
}

static struct reference_stream *open_reference(const struct scratch *scratch, bool partial,
                                               struct diag *diag)
{
    return reference_stream_open(scratch->path, &track_list_record, partial,
                                 (struct input_pause){0}, diag);
}

/* Looks for a frame: 1 if its own line is found, else the result of the stream. */
static int ask(struct reference_stream *reference, int scene, int64_t number, struct diag *diag)
{
    char name[32], id[32];
    snprintf(name, sizeof name, "scene %d", scene);
    snprintf(id, sizeof id, "%d.%d", scene, (int)number);
    struct frame frame = {.scene = name, .frame = number, .arena = check_arena()};
    struct track_list tracks;
    int found = reference_stream_tracks(reference, &frame, &tracks, diag);
    if (found == 1) {
        assert_int_equal(tracks.tracks.count, 1);
        assert_string_equal(tracks.tracks.items[0].id, id);
    }
    return found;
}

/* Scene numbers in random order; the frames of each scene ascend. */
static void interleave(uint64_t *sample, int order[SCENES * FRAMES])
{
    int left[SCENES];
    for (int i = 0; i < SCENES; i++)
        left[i] = FRAMES;
    for (int i = 0; i < SCENES * FRAMES; i++) {
        int scene;
        do
            scene = (int)(sample_bits(sample) % SCENES);
        while (left[scene] == 0);
        left[scene]--;
        order[i] = scene;
    }
}

FIXTURE(make_scratch, remove_scratch);

TEST_OF(scratch, frames_meet_in_every_interleaving)
{
    uint64_t sample = 1;
    for (int round = 0; round < 50; round++) {
        int order[SCENES * FRAMES], next[SCENES] = {0};
        FILE *file = fopen(scratch->path, "w");
        interleave(&sample, order);
        for (int i = 0; i < SCENES * FRAMES; i++)
            write_line(file, order[i], next[order[i]]++);
        fclose(file);
        struct diag diag = {0};
        struct reference_stream *reference = open_reference(scratch, false, &diag);
        interleave(&sample, order);
        memset(next, 0, sizeof next);
        for (int i = 0; i < SCENES * FRAMES; i++)
            assert_int_equal(ask(reference, order[i], next[order[i]]++, &diag), 1);
        assert_done(reference_stream_finish, reference);
        reference_stream_close(reference);
    }
}

/* Each stream lacks some frames; all others meet. */
TEST_OF(scratch, frames_meet_where_either_stream_lacks_some)
{
    uint64_t sample = 2;
    for (int round = 0; round < 50; round++) {
        int order[SCENES * FRAMES], next[SCENES] = {0};
        bool there[SCENES][FRAMES], wanted[SCENES][FRAMES];
        for (int i = 0; i < SCENES * FRAMES; i++) {
            there[i % SCENES][i / SCENES] = sample_bits(&sample) % 4 != 0;
            wanted[i % SCENES][i / SCENES] = sample_bits(&sample) % 4 != 0;
        }
        FILE *file = fopen(scratch->path, "w");
        interleave(&sample, order);
        for (int i = 0; i < SCENES * FRAMES; i++, next[order[i - 1]]++)
            if (there[order[i]][next[order[i]]])
                write_line(file, order[i], next[order[i]]);
        fclose(file);
        struct diag diag = {0};
        struct reference_stream *reference = open_reference(scratch, true, &diag);
        interleave(&sample, order);
        memset(next, 0, sizeof next);
        for (int i = 0; i < SCENES * FRAMES; i++, next[order[i - 1]]++)
            if (wanted[order[i]][next[order[i]]])
                assert_int_equal(ask(reference, order[i], next[order[i]], &diag),
                                 there[order[i]][next[order[i]]]);
        assert_done(reference_stream_finish, reference);
        reference_stream_close(reference);
    }
}

TEST_OF(scratch, a_frame_without_a_line_is_refused)
{
    FILE *file = fopen(scratch->path, "w");
    write_line(file, 0, 0);
    write_line(file, 0, 2);
    fclose(file);
    struct diag diag = {0};
    struct reference_stream *reference = open_reference(scratch, false, &diag);
    assert_int_equal(ask(reference, 0, 0, &diag), 1);
    assert_int_equal(ask(reference, 0, 1, &diag), -1);
    assert_int_equal(diag.code, DIAG_DATA);
    assert_non_null(strstr(diag.text, "lines.jsonl has no frame 1 of scene \"scene 0\""));
    reference_stream_close(reference);
}

TEST_OF(scratch, a_line_without_a_frame_is_refused_with_its_place)
{
    FILE *file = fopen(scratch->path, "w");
    for (int scene = 0; scene < SCENES; scene++)
        write_line(file, scene, 3);
    fclose(file);
    struct diag diag = {0};
    struct reference_stream *reference = open_reference(scratch, false, &diag);
    assert_int_equal(ask(reference, 3, 3, &diag), 1);
    assert_int_equal(ask(reference, 0, 3, &diag), 1);
    assert_int_equal(reference_stream_finish(reference, &diag), -1);
    assert_non_null(strstr(diag.text, "lines.jsonl:2: frame 3 of scene \"scene 1\" is not in"));
    reference_stream_close(reference);
}

TEST_OF(scratch, a_file_that_is_not_there_is_refused)
{
    struct diag diag = {0};
    unlink(scratch->path);
    assert_null(open_reference(scratch, false, &diag));
    assert_int_equal(diag.code, DIAG_NO_INPUT);
    reference_stream_close(NULL);
}
