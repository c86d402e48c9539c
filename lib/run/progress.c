#include "run/progress.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "text/terminal.h"

enum { BAR_WIDTH = 24, LINE_WIDTH = 72 };

/* The last column of a terminal stays free: a cursor beside it may stand in the next line. */
static int line_width(void)
{
    size_t columns = terminal_columns(STDERR_FILENO);
    return columns > 0 && columns <= LINE_WIDTH ? (int)columns - 1 : LINE_WIDTH;
}

static const double QUIET_S = 1, PAUSE_S = 0.2;

static double clock_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void progress_begin(struct progress *progress, const char *unit)
{
    double now_s = clock_s();
    *progress = (struct progress){.unit = unit, .begin_s = now_s};
    progress->next_s = isatty(STDERR_FILENO) ? now_s + QUIET_S : (double)INFINITY;
}

bool progress_step(struct progress *progress)
{
    progress->count++;
    return progress->next_s < (double)INFINITY && clock_s() >= progress->next_s;
}

void progress_write(const struct progress *progress, double elapsed_s, double share, char *line,
                    size_t size)
{
    assert(share > 0);
    share = share < 1 ? share : 1;
    double rate = (double)progress->count / elapsed_s;
    long left_s = lrint(elapsed_s / share - elapsed_s);
    snprintf(line, size, "[%-*.*s] %3.0f %%, %.*f %s/s, %ld:%02ld:%02ld left", BAR_WIDTH,
             (int)(BAR_WIDTH * share), "########################", floor(100 * share),
             rate < 10 ? 1 : 0, rate, progress->unit, left_s / 3600, left_s / 60 % 60, left_s % 60);
}

void progress_show(struct progress *progress, double share)
{
    char line[LINE_WIDTH + 1];
    double now_s = clock_s();
    progress->next_s = now_s + PAUSE_S;
    if (!(share > 0))
        return;
    progress_write(progress, now_s - progress->begin_s, share, line, sizeof line);
    fprintf(stderr, "\r%-*.*s", line_width(), line_width(), line);
    progress->shown = true;
}

void progress_end(struct progress *progress)
{
    if (progress->shown)
        fprintf(stderr, "\r%*s\r", line_width(), "");
    progress->shown = false;
}
