/* The machine's floors, with which scripts/bench compares glint's times: ROUNDS lines per floor of
 * NAME, UNIT and VALUE between tabs, all floors in turn each round. FRAMES is the file that zlib
 * compresses. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <zlib.h>

#include "clock.h"
#include "digits.h"
#include "plain.h"
#include "support/sample.h"

enum { NUMBERS = 240, VEHICLES = 20, PIPE_BYTES = 30000, TEXT_SIZE = 1 << 16, SWEEPS = 500 };

struct bench {
    struct plain_vehicle vehicles[VEHICLES];
    double numbers[NUMBERS];
    char text[TEXT_SIZE]; /* the numbers, a newline after each */
    char scene[TEXT_SIZE], line[TEXT_SIZE];
    int pipe[2];
    unsigned char *frames, *packed;
    size_t frames_length, packed_size;
};

static char *put(char *at, double number, char after)
{
    at = digits_write(number, at);
    *at++ = after;
    return at;
}

static char *put_text(char *at, const char *text)
{
    size_t length = strlen(text);
    memcpy(at, text, length);
    return at + length;
}

/* Reads the next of numbers that are ended by one byte each; returns the place after it. */
static const char *get(const char *at, double *number)
{
    return digits_read(at, at + 32, number) + 1;
}

static void write_numbers(struct bench *bench)
{
    char *at = bench->text;
    for (int i = 0; i < NUMBERS; i++)
        at = put(at, bench->numbers[i], '\n');
    *at = '\0';
}

static void read_numbers(struct bench *bench)
{
    const char *at = bench->text;
    for (int i = 0; i < NUMBERS; i++)
        at = get(at, &bench->numbers[i]);
}

static void compute(struct bench *bench)
{
    struct plain_target targets[PLAIN_CENTRES];
    bench->vehicles[0].x_m += 1e-6 * (double)plain_targets(bench->vehicles, VEHICLES, targets);
}

static void move_through_pipe(struct bench *bench)
{
    if (write(bench->pipe[1], bench->line, PIPE_BYTES) != PIPE_BYTES)
        abort();
    for (long left = PIPE_BYTES; left > 0;)
        left -= read(bench->pipe[0], bench->line, (size_t)left);
}

static void compress_frames(struct bench *bench)
{
    uLongf length = bench->packed_size;
    if (compress2(bench->packed, &length, bench->frames, bench->frames_length, 1) != Z_OK)
        abort();
}

static void write_scene(struct bench *bench)
{
    char *at = bench->scene;
    for (int i = 0; i < VEHICLES; i++) {
        const struct plain_vehicle *of = &bench->vehicles[i];
        const double members[] = {of->x_m,       of->y_m,      of->yaw_rad,
                                  of->speed_mps, of->length_m, of->width_m};
        for (int k = 0; k < 6; k++)
            at = put(at, members[k], ',');
    }
    *at = '\0';
}

/* A chain with no care: numbers in, the computation of plain.h, JSON out; no labels, no checks. */
static void run_plain_chain(struct bench *bench)
{
    struct plain_vehicle vehicles[VEHICLES];
    struct plain_target targets[PLAIN_CENTRES];
    const char *from = bench->scene;
    for (int i = 0; i < VEHICLES; i++) {
        double *members[] = {&vehicles[i].x_m,       &vehicles[i].y_m,      &vehicles[i].yaw_rad,
                             &vehicles[i].speed_mps, &vehicles[i].length_m, &vehicles[i].width_m};
        for (int k = 0; k < 6; k++)
            from = get(from, members[k]);
    }
    char *at = put_text(bench->line, "{\"targets\":[");
    size_t count = plain_targets(vehicles, VEHICLES, targets);
    for (size_t i = 0; i < count; i++) {
        at = put(put_text(at, "{\"range_m\":"), targets[i].range_m, ',');
        at = put(put_text(at, "\"azimuth_rad\":"), targets[i].azimuth_rad, ',');
        at = put(put_text(at, "\"range_rate_mps\":"), targets[i].range_rate_mps, ',');
        at = put(put_text(at, "\"amplitude\":"), targets[i].amplitude, '}');
        *at++ = ',';
    }
    put_text(at - 1, "]}\n");
}

static double time_ns(void (*floor)(struct bench *bench), struct bench *bench, int sweeps)
{
    double begin_ns = cpu_ns();
    for (int i = 0; i < sweeps; i++)
        floor(bench);
    return (cpu_ns() - begin_ns) / sweeps;
}

/* Vehicles on three lanes ahead of the radar and beside it. */
static void prepare(struct bench *bench, const char *path)
{
    uint64_t random = 1;
    for (int i = 0; i < VEHICLES; i++)
        bench->vehicles[i] = (struct plain_vehicle){12.5 * i - 20,
                                                    3.75 * (i % 3 - 1),
                                                    sample_between(&random, -0.01, 0.01),
                                                    sample_between(&random, 24, 36),
                                                    sample_between(&random, 4, 16),
                                                    2};
    for (int i = 0; i < NUMBERS; i++)
        bench->numbers[i] = sample_between(&random, -200, 200);
    write_scene(bench);
    FILE *file = fopen(path, "rb");
    if (file == NULL || pipe(bench->pipe) != 0)
        abort();
    bench->frames = malloc(1 << 20);
    bench->frames_length = fread(bench->frames, 1, 1 << 20, file);
    bench->packed_size = compressBound(bench->frames_length);
    bench->packed = malloc(bench->packed_size);
    fclose(file);
}

int main(int count, char **words)
{
    static struct bench bench;
    if (count != 3) {
        fprintf(stderr, "usage: floors ROUNDS FRAMES\n");
        return 64;
    }
    prepare(&bench, words[2]);
    for (int round = 0; round < atoi(words[1]); round++) {
        printf("write 240 numbers\tns\t%.1f\n", time_ns(write_numbers, &bench, SWEEPS));
        printf("read 240 numbers\tns\t%.1f\n", time_ns(read_numbers, &bench, SWEEPS));
        printf("compute 66 centres\tns\t%.1f\n", time_ns(compute, &bench, SWEEPS));
        printf("pipe 30 kB\tns\t%.1f\n", time_ns(move_through_pipe, &bench, SWEEPS));
        printf("plain chain\tns\t%.1f\n", time_ns(run_plain_chain, &bench, SWEEPS));
        printf("zlib level 1\tMB/s\t%.1f\n",
               1e3 * (double)bench.frames_length / time_ns(compress_frames, &bench, 1));
    }
    return 0;
}
