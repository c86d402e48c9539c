#include "run/explain.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <time.h>
#include <unistd.h>

#include "base/text.h"
#include "effects/effect.h"
#include "run/options.h"
#include "text/output.h"

static int64_t clock_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

struct effect_log *explain_begin(struct arena *arena)
{
    struct effect_log *log = arena_get(arena, sizeof *log);
    *log = (struct effect_log){.clock_ns = clock_ns};
    return log;
}

static void write_line(const char *stage, int effect, const struct effect_log *log,
                       struct text *text)
{
    const char *left_out_when = effect_table[effect]->left_out_when;
    text_format(text,
                "{\"stage\":\"%s\",\"effect\":\"%s\",\"scans\":%" PRId64 ",\"simulated\":%" PRId64
                ",\"left_out\":%" PRId64 ",\"ns\":",
                stage, effects_names[effect], log->scans, log->scans_simulated[effect],
                log->scans_left_out[effect]);
    if (log->spent_ns[effect] > 0)
        text_format(text, "%" PRId64, log->spent_ns[effect]);
    else
        text_add_word(text, "null");
    text_add_word(text, ",\"left_out_when\":");
    if (left_out_when != NULL)
        text_add_json(text, left_out_when, strlen(left_out_when));
    else
        text_add_word(text, "null");
    text_add_word(text, "}\n");
}

static void write_row(int effect, const struct effect_log *log, struct text *text)
{
    const char *left_out_when = effect_table[effect]->left_out_when;
    text_format(text, "%-17s %10" PRId64 " %10" PRId64, effects_names[effect],
                log->scans_simulated[effect], log->scans_left_out[effect]);
    if (log->spent_ns[effect] > 0)
        text_format(text, " %10.2f", 1e-3 * (double)log->spent_ns[effect] / (double)log->scans);
    else
        text_format(text, " %10s", "-");
    text_format(text, "  %s\n", left_out_when != NULL ? left_out_when : "-");
}

static int append(const char *path, const struct text *text, struct diag *diag)
{
    int file = open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0)
        return diag_fail(diag, diag_code_by_errno(DIAG_CANNOT_CREATE), "%s: %s", path,
                         strerror(errno));
    if (output_write_all(file, text->bytes, text->length) != 0)
        diag_fail(diag, DIAG_IO, "%s: %s", path, strerror(errno));
    if (close(file) != 0)
        diag_fail(diag, DIAG_IO, "%s: %s", path, strerror(errno));
    return diag->code == DIAG_OK ? 0 : -1;
}

int explain_check(const char *path, struct diag *diag)
{
    return append(path, &(struct text){0}, diag);
}

int explain_append(const struct common_options *common, const char *stage,
                   const struct effect_log *log, struct diag *diag)
{
    struct text text = {0};
    if (common->text)
        text_format(&text, "%-17s %10s %10s %10s  left out when\n", stage, "simulated", "left out",
                    "us a scan");
    for (int i = 0; i < EFFECT_COUNT; i++) {
        const char *home = effect_homes[effect_table[i]->home];
        if (strncmp(stage, home, strlen(home)) != 0)
            continue;
        if (common->text)
            write_row(i, log, &text);
        else
            write_line(stage, i, log, &text);
    }
    int result = append(common->explain, &text, diag);
    text_free(&text);
    return result;
}
