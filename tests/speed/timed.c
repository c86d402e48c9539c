/* glint with clocks: runs a pipeline as glint does, and then prints to stderr, as JSON lines, what
 * CPU time each part of the chain took. The linker puts the functions below in place of those that
 * the chain calls (Makefile, --wrap). */
#include <inttypes.h>
#include <stdio.h>
#include <time.h>

#include "frame/frame_text.h"
#include "run/frame_stream.h"
#include "run/pipeline_process.h"
#include "run/runner.h"
#include "text/output.h"

enum { MOST = 16 };

/* A part of the chain: reading, a stage or tool, writing. */
struct part {
    const struct stage *stage; /* NULL: reading or writing */
    int64_t spent_ns;
};

static struct part reading, writing, stages_of_chain[MOST];
static struct part outside; /* what is no part's: starting, the loop itself */
static struct part *now = &outside;
static int64_t since_ns, look_ns; /* when the part began; what one look at the clock takes */
static int64_t frames, bytes_read, bytes_written;

static int64_t cpu_ns(void)
{
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

/* A look at the clock is a system call, and a frame may take no longer than a few of those. */
static void time_clock(void)
{
    enum { CALLS = 1000 };
    int64_t begin_ns = cpu_ns();
    for (int i = 0; i < CALLS; i++)
        cpu_ns();
    look_ns = (cpu_ns() - begin_ns) / CALLS;
}

/* From here on the time is that of another part. Returns the one before. */
static struct part *enter(struct part *part)
{
    int64_t time_ns = cpu_ns();
    now->spent_ns += time_ns - since_ns - look_ns;
    struct part *before = now;
    now = part;
    since_ns = time_ns;
    return before;
}

static struct part *part_of(const struct runner *runner)
{
    struct part *part = stages_of_chain;
    while (part->stage != NULL && part->stage != runner->stage && part < stages_of_chain + MOST - 1)
        part++;
    part->stage = runner->stage;
    return part;
}

int __real_frame_stream_next(struct frame_stream *stream, struct frame *frame, struct diag *diag);
int __real_input_line(struct input *input, size_t most, const char **line, size_t *length,
                      struct diag *diag);
int __real_runner_next(struct runner *runner, struct frame *frame);
int __real_runner_step(struct runner *runner, struct frame *frame);
int __real_runner_run_tool(struct runner *runner);
int __real_frame_text_write(const struct frame *frame, struct text *text, struct diag *diag);
int __real_output_send(struct output *output, struct diag *diag);
int __wrap_frame_stream_next(struct frame_stream *stream, struct frame *frame, struct diag *diag);
int __wrap_input_line(struct input *input, size_t most, const char **line, size_t *length,
                      struct diag *diag);
int __wrap_runner_next(struct runner *runner, struct frame *frame);
int __wrap_runner_step(struct runner *runner, struct frame *frame);
int __wrap_runner_run_tool(struct runner *runner);
int __wrap_frame_text_write(const struct frame *frame, struct text *text, struct diag *diag);
int __wrap_output_send(struct output *output, struct diag *diag);

int __wrap_frame_stream_next(struct frame_stream *stream, struct frame *frame, struct diag *diag)
{
    struct part *before = enter(&reading);
    int more = __real_frame_stream_next(stream, frame, diag);
    enter(before);
    frames += more > 0;
    return more;
}

int __wrap_input_line(struct input *input, size_t most, const char **line, size_t *length,
                      struct diag *diag)
{
    int more = __real_input_line(input, most, line, length, diag);
    if (more > 0 && now == &reading)
        bytes_read += (int64_t)*length + 1;
    return more;
}

int __wrap_runner_next(struct runner *runner, struct frame *frame)
{
    struct part *before = enter(part_of(runner));
    int more = __real_runner_next(runner, frame);
    enter(before);
    frames += more > 0;
    return more;
}

int __wrap_runner_step(struct runner *runner, struct frame *frame)
{
    struct part *before = enter(part_of(runner));
    int result = __real_runner_step(runner, frame);
    enter(before);
    return result;
}

int __wrap_runner_run_tool(struct runner *runner)
{
    struct part *before = enter(part_of(runner));
    int result = __real_runner_run_tool(runner);
    enter(before);
    return result;
}

/* What a stage or tool writes itself is its own work. */
int __wrap_frame_text_write(const struct frame *frame, struct text *text, struct diag *diag)
{
    if (now != &outside)
        return __real_frame_text_write(frame, text, diag);
    size_t begin = text->length;
    enter(&writing);
    int result = __real_frame_text_write(frame, text, diag);
    enter(&outside);
    bytes_written += (int64_t)(text->length - begin);
    return result;
}

int __wrap_output_send(struct output *output, struct diag *diag)
{
    if (now != &outside)
        return __real_output_send(output, diag);
    enter(&writing);
    int result = __real_output_send(output, diag);
    enter(&outside);
    return result;
}

static void print_part(const char *name, const struct part *part)
{
    fprintf(stderr, "{\"part\":\"%s\",\"frames\":%" PRId64 ",\"ns_per_frame\":%.0f}\n", name,
            frames, frames > 0 ? (double)part->spent_ns / (double)frames : 0);
}

int main(int count, char **words)
{
    time_clock();
    since_ns = cpu_ns();
    int code = pipeline_process_main(count, words);
    if (bytes_read > 0)
        print_part("read", &reading);
    for (const struct part *part = stages_of_chain; part->stage != NULL; part++)
        print_part(part->stage->name, part);
    if (bytes_written > 0)
        print_part("write", &writing);
    fprintf(stderr, "{\"part\":\"bytes\",\"read\":%" PRId64 ",\"written\":%" PRId64 "}\n",
            bytes_read, bytes_written);
    return code;
}
