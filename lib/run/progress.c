#include "run/progress.h"

#include <stdio.h>
#include <unistd.h>

enum { BAR_WIDTH = 40 };

void progress_begin(struct progress *progress, int64_t expected)
{
    bool shown = expected > 0 && isatty(STDERR_FILENO) && !isatty(STDOUT_FILENO);
    *progress = (struct progress){.shown = shown, .expected = expected, .percent = -1};
}

void progress_step(struct progress *progress)
{
    if (!progress->shown)
        return;
    progress->done++;
    int percent = (int)(100 * progress->done / progress->expected);
    if (percent == progress->percent)
        return;
    progress->percent = percent;
    int filled = BAR_WIDTH * percent / 100;
    fprintf(stderr, "\r[%.*s%*s] %3d %%", filled, "########################################",
            BAR_WIDTH - filled, "", percent);
}

void progress_end(struct progress *progress)
{
    if (progress->shown)
        fprintf(stderr, "\r%*s\r", BAR_WIDTH + 8, "");
}
