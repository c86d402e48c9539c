#include "sensor/scan.h"

#include "base/sort.h"

struct scan scan_receive(const struct effect_scan *context)
{
    struct echo_span added = effect_added_echoes(context);
    struct scan scan = {.context = *context, .added = added};
    const struct sensor *sensor = context->sensor;
    struct arena *arena = context->frame->arena;
    size_t all = context->echoes.count + added.count, count = all;
    struct received_echo *echoes = arena_get(arena, (all + 1) * sizeof *echoes);
    for (size_t i = 0; i < context->echoes.count; i++)
        echoes[i] = received_echo_of(context, &context->echoes.items[i]);
    for (size_t i = 0; i < added.count; i++)
        echoes[context->echoes.count + i] = received_echo_of(context, &added.items[i]);
    sort_items(echoes, count, sizeof *echoes, resolution_cell_compare, arena);
    while (count > 0 && !(echoes[count - 1].amplitude > 0))
        count--;
    scan.received.echoes = echoes;
    scan.received.count = count;
    scan.received.resolution = (struct resolution){
        sensor->half_range_m, sensor->half_range_rate_mps,
        sensor->waveform.samples > 0 && effect_simulates(context, EFFECT_COHERENCE)};
    scan.silent = echoes + count;
    scan.silent_count = all - count;
    return scan;
}

/* Reduces the echoes of a coherent cell to their parts at the leader's place. */
static void respond(struct received_echo *members, size_t count,
                    const struct resolution *resolution)
{
    struct resolution_echo leader = resolution_cell_place(&members[0]);
    for (size_t i = 1; i < count; i++) {
        struct resolution_echo place = resolution_cell_place(&members[i]);
        double part = resolution_response(&leader, &place, resolution);
        members[i].strength *= part;
        members[i].amplitude *= part;
    }
}

/* Sorts the received echoes into by_cell by counting: cell by cell, in their order. first[n + 2]
 * counts the echoes of cell n, then first[n + 1] is the next place in cell n, at last its end. */
static void group_by_cell(struct scan *scan)
{
    struct arena *arena = scan->context.frame->arena;
    const struct clustered_echoes *all = &scan->received;
    struct received_echo *by_cell = arena_get(arena, all->count * sizeof *by_cell);
    size_t *first = arena_get(arena, (scan->cells + 2) * sizeof *first);
    for (size_t i = 0; i < all->count; i++)
        first[all->cell[i] + 2]++;
    for (size_t number = 0; number < scan->cells; number++)
        first[number + 2] += first[number + 1];
    for (size_t i = 0; i < all->count; i++)
        by_cell[first[all->cell[i] + 1]++] = all->echoes[i];
    if (all->resolution.coherent)
        for (size_t n = 0; n < scan->cells; n++)
            respond(by_cell + first[n], first[n + 1] - first[n], &all->resolution);
    scan->by_cell = by_cell;
    scan->first = first;
}

/* Puts each echo into a cell of its own; the number of cells. */
static size_t one_cell_each(size_t *cell, size_t count)
{
    for (size_t i = 0; i < count; i++)
        cell[i] = i;
    return count;
}

static void resolve(struct scan *scan, const struct selection *selection)
{
    struct arena *arena = scan->context.frame->arena;
    const struct resolution *resolution = &scan->received.resolution;
    size_t count = scan->received.count;
    struct resolution_echo *places = arena_get(arena, (count + 1) * sizeof *places);
    size_t *cell = arena_get(arena, (count + 1) * sizeof *cell);
    for (size_t i = 0; i < count; i++)
        places[i] = resolution_cell_place(&scan->received.echoes[i]);
    bool merge = effects_forced(selection, EFFECT_MERGING) ||
                 (effects_enabled(selection, EFFECT_MERGING) &&
                  resolution_close(places, count, resolution, arena));
    scan->cells = merge ? resolution_cluster(places, count, resolution, cell, arena)
                        : one_cell_each(cell, count);
    scan->received.cell = cell;
    group_by_cell(scan);
    effects_note(selection, EFFECT_MERGING, merge);
}

struct scan scan_make(const struct effect_scan *context, const struct selection *selection)
{
    struct scan scan = scan_receive(context);
    resolve(&scan, selection);
    return scan;
}

const struct received_echo *scan_members(const struct scan *scan, size_t number, size_t *count)
{
    *count = scan->first[number + 1] - scan->first[number];
    return scan->by_cell + scan->first[number];
}

void scan_account(const struct scan *scan, struct frame *frame, const char *stage)
{
    const char *sensor = scan->context.sensor->name;
    for (size_t i = 0; i < scan->added.count; i++)
        frame_count_echoes(frame, sensor, scan->added.items[i].id.path, 1);
    for (size_t i = 0; i < scan->silent_count; i++) {
        const struct received_echo *silent = &scan->silent[i];
        struct lost_echo lost = frame_lost_echo(&silent->echo, silent->margins);
        frame_lose(frame, stage, sensor, LOSS_NO_AMPLITUDE, &lost);
    }
}
