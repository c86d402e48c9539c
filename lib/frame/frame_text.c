#include "frame/frame_text.h"

#include "text/record_text.h"

int frame_text_read(const char *line, size_t length, struct frame *frame, struct diag *diag)
{
    frame_clear(frame);
    return record_text_read(line, length, &frame_record, frame, frame->arena, frame->list_cache,
                            diag);
}

int frame_text_write(const struct frame *frame, struct text *text, struct diag *diag)
{
    size_t begin = text->length;
    record_text_write(&frame_record, frame, frame->list_cache, text);
    size_t length = text->length - begin;
    if (length > FRAME_TEXT_SIZE) {
        text->length = begin;
        return diag_fail(diag, DIAG_DATA, "a line of %zu bytes; at most %d are allowed", length,
                         FRAME_TEXT_SIZE);
    }
    return 0;
}
