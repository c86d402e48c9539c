#include "score/tracker_difference.h"

#include <inttypes.h>

#include "base/elementary.h"
#include "score/relative_error.h"
#include "text/text_table.h"

enum { FEWEST = 5 };

#define BOUND(member, help) FIELD_REAL_IN(struct tracker_interval, member, -1e300, 1e300, help)

static const struct field interval_fields[] = {
    {BOUND(mean, "mean over the scenes")},
    {BOUND(low, "lower end of the 95 % interval")},
    {BOUND(high, "upper end of the 95 % interval")},
    {0},
};

static const struct record interval_record = {
    FIELD_TABLE(struct tracker_interval, interval_fields, "difference",
                "Difference of two trackers per frame, with its 95 % interval over scenes.")};

#define FIGURE(name_, which, help_)                                                                \
    FIELD_NAMED(name_), .kind = FIELD_RECORD, .record = &interval_record,                          \
                        .offset = offsetof(struct tracker_difference, figures) +                   \
                                  (which) * sizeof(struct tracker_interval),                       \
                        .help = (help_)

static const struct field difference_fields[] = {
    {FIELD_INTEGER_IN(struct tracker_difference, scenes, FEWEST, 0x1p53, "number of scenes")},
    {FIGURE(gospa, TRACKER_GOSPA, "GOSPA of a frame")},
    {FIGURE(missed_count, TRACKER_MISSED, "missed objects in a frame")},
    {FIGURE(false_count, TRACKER_FALSE, "false tracks in a frame")},
    {FIGURE(id_switches, TRACKER_SWITCHES, "identity switches in a frame")},
    {0},
};

const struct record tracker_difference_record = {
    FIELD_TABLE(struct tracker_difference, difference_fields, "tracker_difference",
                "Scores of the tracks less those of --against, paired by scene.")};

void tracker_difference_add(struct tracker_scenes *scenes, const char *scene,
                            const double one[TRACKER_FIGURES], const double other[TRACKER_FIGURES],
                            struct arena *arena)
{
    size_t number = intern_word(&scenes->names, scene, arena);
    struct tracker_scene *sums =
        number < scenes->list.count ? &scenes->list.items[number] : list_add(&scenes->list, arena);
    sums->frames++;
    for (int i = 0; i < TRACKER_FIGURES; i++)
        sums->sums[i] += one[i] - other[i];
}

static struct tracker_interval interval_of(const struct tracker_scenes *scenes, int figure)
{
    double count = (double)scenes->list.count;
    double sum = 0, squares = 0;
    for (size_t i = 0; i < scenes->list.count; i++)
        sum += scenes->list.items[i].sums[figure] / (double)scenes->list.items[i].frames;
    double mean = sum / count;
    for (size_t i = 0; i < scenes->list.count; i++) {
        const struct tracker_scene *scene = &scenes->list.items[i];
        double off = scene->sums[figure] / (double)scene->frames - mean;
        squares += off * off;
    }
    double half = relative_error_student(count - 1) * sqrt(squares / (count - 1) / count);
    return (struct tracker_interval){mean, mean - half, mean + half};
}

int tracker_difference_of(const struct tracker_scenes *scenes,
                          struct tracker_difference *difference, struct diag *diag)
{
    difference->scenes = (int64_t)scenes->list.count;
    if (difference->scenes < FEWEST)
        return diag_fail(diag, DIAG_DATA,
                         "--against: number of scenes: %" PRId64 "; expected at least %d",
                         difference->scenes, FEWEST);
    for (int i = 0; i < TRACKER_FIGURES; i++)
        difference->figures[i] = interval_of(scenes, i);
    return 0;
}

void tracker_difference_table(const struct tracker_difference *difference, struct text *text)
{
    text_format(text,
                "\nscores less those of --against, per frame: mean over %" PRId64 " scenes, 95 %% "
                "interval\n",
                difference->scenes);
    struct text rows = {0};
    for (int i = 0; i < TRACKER_FIGURES; i++) {
        const char *name = difference_fields[i + 1].name;
        const struct tracker_interval *figure = &difference->figures[i];
        text_format(&rows, "%s\t%s\t%.4f\t%.4f to %.4f\n", name, i == TRACKER_GOSPA ? "m" : "",
                    figure->mean, figure->low, figure->high);
    }
    text_table_write(&rows, (int[]){-22, -12, 10, 20, 0}, "", text);
}
