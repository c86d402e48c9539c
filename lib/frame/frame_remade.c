#include "frame/frame_remade.h"

#include "frame/frame_order.h"

/* By so much, relative to its size, may a value differ from what is recomputed. */
static const double tolerance = 1e-9;

static int check_value(const char *member, double told, double truth, struct diag *diag)
{
    if (fabs(told - truth) <= tolerance * fabs(truth))
        return 0;
    return diag_fail(diag, DIAG_DATA, "%s: %.17g; recomputed, it is %.17g", member, told, truth);
}

/* All numbers of a struct must be those that are made again. */
static int check_numbers(const struct record *record, const void *told, const void *truth,
                         struct diag *diag)
{
    int result = 0;
    for (const struct field *field = record->fields; field->name != NULL && result == 0; field++)
        result =
            check_value(field->name, field_number(field, told), field_number(field, truth), diag);
    return result;
}

/* Sensors must be those of the suite. Streams of earlier versions tell neither the height of a
 * sensor nor its resolution. */
static int check_views(const struct frame *frame, const struct frame *again, struct diag *diag)
{
    for (size_t i = 0; i < frame->sensors.list.count && i < again->sensors.list.count; i++) {
        const struct sensor_view *told = &frame->sensors.list.items[i];
        struct sensor_view truth = again->sensors.list.items[i];
        if (told->resolution_range_m == 0)
            truth.mount_z_m = truth.resolution_range_m = truth.resolution_range_rate_mps = 0;
        if (check_numbers(&sensor_view_record, told, &truth, diag) != 0)
            return diag_prefix(diag, "sensors.list[%zu].", i);
    }
    return 0;
}

static int check_count(const struct count *told, const struct count *truth, struct diag *diag)
{
    for (enum path path = PATH_DIRECT; path < PATH_WHEEL; path++)
        if (check_value("echoes", (double)frame_counted_echoes(told, path),
                        (double)frame_counted_echoes(truth, path), diag) != 0)
            return diag_prefix(diag, "paths: %s ", frame_paths[path]);
    return check_value("pairs", (double)told->pairs, (double)truth->pairs, diag);
}

/* What ideal counts: direct echoes, ghosts and reflectors in view. frame_check_account knows what
 * later stages count. */
static int check_counts(const struct frame *frame, struct frame *again, struct diag *diag)
{
    for (size_t i = 0; i < frame->counts.count && i < again->counts.count; i++)
        if (check_count(&frame->counts.items[i], &again->counts.items[i], diag) != 0)
            return diag_prefix(diag, "counts[%zu].", i);
    again->targets = frame->targets;
    sightings_count_targets(again);
    for (size_t i = 0; i < frame->visibility.count && i < again->visibility.count; i++)
        if (check_numbers(&sighting_record, &frame->visibility.items[i],
                          &again->visibility.items[i], diag) != 0)
            return diag_prefix(diag, "visibility[%zu].", i);
    return 0;
}

static int check_contributor(const struct contributor *told, const char *sensor,
                             const struct frame *again, struct frame_remade *counts,
                             struct diag *diag)
{
    struct echo_span echoes = frame_echoes_of(again, sensor);
    for (size_t i = 0; i < echoes.count; i++)
        if (frame_order_echo_ids(&echoes.items[i].id, told) == 0) {
            struct contributor truth = frame_contributor(&echoes.items[i]);
            truth.weight = told->weight;
            counts->recomputed++;
            return check_numbers(&contributor_record, told, &truth, diag);
        }
    bool made_later = told->id.path >= PATH_WHEEL; /* than by ideal: of a body, or of none */
    if (made_later &&
        (frame_object_of(again, &told->id) != NULL) == frame_shows_object(told->id.path))
        return 0;
    return diag_fail(diag, DIAG_DATA, "reflector: the objects make no echo of \"%s\", \"%s\", %s",
                     told->id.object, told->id.reflector, frame_paths[told->id.path]);
}

static int check_target(const struct target *target, const struct frame *again,
                        struct frame_remade *counts, struct diag *diag)
{
    double weights = 0;
    counts->contributors += (int64_t)target->contributors.count;
    for (size_t i = 0; i < target->contributors.count; i++) {
        const struct contributor *told = &target->contributors.items[i];
        weights += told->weight;
        if (again != NULL && check_contributor(told, target->sensor, again, counts, diag) != 0)
            return diag_prefix(diag, "contributors[%zu].", i);
    }
    if (fabs(weights - 1) <= tolerance)
        return 0;
    return diag_fail(diag, DIAG_DATA, "contributors: weights sum to %.17g; expected 1", weights);
}

static int check_group(const struct lost_group *told, const struct lost_group *due,
                       struct diag *diag)
{
    bool same = due != NULL && frame_order_lost_groups(told, due) == 0 &&
                told->echoes.count == due->echoes.count;
    for (size_t i = 0; same && i < told->echoes.count; i++) {
        const struct lost_echo *one = &told->echoes.items[i], *truth = &due->echoes.items[i];
        same = frame_order_echo_ids(one, truth) == 0;
        if (same && check_numbers(&lost_echo_record, one, truth, diag) != 0)
            return diag_prefix(diag, "echoes[%zu].", i);
    }
    return same ? 0 : diag_fail(diag, DIAG_DATA, "echoes: of these objects, ideal loses others");
}

/* What never became an echo is known from the objects: `again` has the losses of ideal alone. */
static int check_losses(const struct frame *frame, const struct frame *again, struct diag *diag)
{
    size_t known = 0;
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *due = known < again->lost.count ? &again->lost.items[known] : NULL;
        bool of_ideal = strcmp(frame->lost.items[i].stage, "ideal") == 0;
        if (of_ideal && check_group(&frame->lost.items[i], due, diag) != 0)
            return diag_prefix(diag, "lost[%zu].", i);
        known += of_ideal;
    }
    return known == again->lost.count ? 0 : diag_fail(diag, DIAG_DATA, "lost: ideal loses more");
}

int frame_remade_check(const struct frame *frame, struct frame *again, struct frame_remade *counts,
                       struct diag *diag)
{
    if (again != NULL &&
        (check_views(frame, again, diag) != 0 || check_losses(frame, again, diag) != 0))
        return -1;
    for (size_t i = 0; i < frame->targets.count; i++)
        if (check_target(&frame->targets.items[i], again, counts, diag) != 0)
            return diag_prefix(diag, "targets[%zu].", i);
    return again != NULL ? check_counts(frame, again, diag) : 0;
}
