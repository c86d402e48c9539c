#include "run/frame_stream.h"

#include "frame/frame_check.h"
#include "frame/frame_order.h"
#include "frame/frame_text.h"
#include "text/file_format.h"

static int open_next(struct frame_stream *stream, struct diag *diag)
{
    if (stream->path >= (stream->count > 0 ? stream->count : 1))
        return 0;
    const char *path = stream->count > 0 ? stream->paths[stream->path] : "-";
    stream->path++;
    stream->line = 0;
    stream->input = input_open(path, diag);
    if (stream->input == NULL)
        return diag_prefix(diag, "%s: ", path);
    input_before_waiting(stream->input, stream->pause);
    return 1;
}

/* Other programs may list the items of a part in any order; stages rely on the canonical one. */
static int order_and_check(struct frame *frame, unsigned parts, struct diag *diag)
{
    frame_order_parts(frame, (struct frame_parts){.parts = parts});
    return frame_check(frame, parts, diag);
}

int frame_stream_parse(const char *line, size_t length, struct frame *frame, struct diag *diag)
{
    return frame_text_read(line, length, frame, diag) == 0 ? order_and_check(frame, ~0U, diag) : -1;
}

int frame_stream_read_left(struct frame *frame, unsigned parts, struct diag *diag)
{
    parts &= frame->line.unread;
    if (parts == 0)
        return 0;
    return frame_text_read_left(frame, parts, diag) == 0 ? order_and_check(frame, parts, diag) : -1;
}

/* The input keeps the line until the next one is asked for. */
static int take(const struct frame_stream *stream, const char *line, size_t length,
                struct frame *frame, struct diag *diag)
{
    int result = frame_text_take(line, length, stream->unread, frame, diag);
    return result == 0 ? order_and_check(frame, ~0U, diag) : -1;
}

/* A file of another format is named instead of its first line. */
static void name_format(struct frame_stream *stream, struct diag *diag)
{
    size_t length;
    const char *head = input_head(stream->input, &length);
    if (stream->line == 1 && file_format_explain(frame_record.name, head, length, diag))
        stream->line = 0;
}

int frame_stream_next(struct frame_stream *stream, struct frame *frame, struct diag *diag)
{
    for (;;) {
        if (stream->input == NULL) {
            int opened = open_next(stream, diag);
            if (opened <= 0)
                return opened;
        }
        const char *line;
        size_t length;
        int more = input_line(stream->input, FRAME_TEXT_SIZE, &line, &length, diag);
        if (more >= 0 || diag->code != DIAG_NO_INPUT) /* a folder has no lines */
            stream->line++;
        if (more > 0 && take(stream, line, length, frame, diag) != 0)
            more = -1;
        if (more < 0)
            name_format(stream, diag);
        if (more != 0)
            return more;
        frame_stream_close(stream);
    }
}

struct frame_place frame_stream_place(const struct frame_stream *stream)
{
    return (struct frame_place){input_name(stream->input), stream->line};
}

double frame_stream_share(const struct frame_stream *stream)
{
    double share = stream->input != NULL ? input_share(stream->input) : 0;
    size_t count = stream->count > 0 ? stream->count : 1;
    return share > 0 ? ((double)(stream->path - 1) + share) / (double)count : 0;
}

void frame_stream_name_line(const struct frame_stream *stream, struct diag *diag)
{
    if (stream->input == NULL)
        return;
    if (stream->line == 0)
        diag_prefix(diag, "%s: ", input_name(stream->input));
    else
        diag_prefix(diag, "%s:%zu: ", input_name(stream->input), stream->line);
}

void frame_stream_close(struct frame_stream *stream)
{
    input_close(stream->input);
    stream->input = NULL;
}
