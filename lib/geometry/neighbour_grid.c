#include "geometry/neighbour_grid.h"

#include <assert.h>

#include "base/hash.h"
#include "base/sort.h"

static const uint32_t NONE = UINT32_MAX;

struct cell {
    int64_t x, y;
};

static struct cell cell_of(const struct neighbour_grid *grid, struct vec2 place)
{
    return (struct cell){(int64_t)floor(place.x / grid->cell_m),
                         (int64_t)floor(place.y / grid->cell_m)};
}

static uint32_t *head_of(const struct neighbour_grid *grid, struct cell cell)
{
    uint64_t hash = hash_table_mix(hash_table_mix(0, (uint64_t)cell.x), (uint64_t)cell.y);
    return &grid->heads[hash & (grid->room - 1)];
}

struct neighbour_grid neighbour_grid_of(const struct vec2 *places, size_t count, double radius_m,
                                        struct arena *arena)
{
    assert(count <= INT32_MAX);
    struct neighbour_grid grid = {.places = places, .radius_m = radius_m, .room = 64};
    grid.cell_m = radius_m > 1 ? radius_m : 1;
    while (grid.room < 2 * count)
        grid.room *= 2;
    grid.heads = arena_room(arena, grid.room * sizeof *grid.heads);
    grid.next = arena_room(arena, count * sizeof *grid.next);
    for (size_t i = 0; i < grid.room; i++)
        grid.heads[i] = NONE;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t *head = head_of(&grid, cell_of(&grid, places[i]));
        grid.next[i] = *head;
        *head = i;
    }
    return grid;
}

static int compare_numbers(const void *a, const void *b)
{
    uint32_t one = *(const uint32_t *)a, other = *(const uint32_t *)b;
    return (one > other) - (one < other);
}

size_t neighbour_grid_find(const struct neighbour_grid *grid, struct vec2 place, uint32_t *found,
                           struct arena *arena)
{
    struct cell middle = cell_of(grid, place);
    size_t count = 0;
    for (int i = 0; i < 9; i++) {
        struct cell cell = {middle.x + i % 3 - 1, middle.y + i / 3 - 1};
        for (uint32_t at = *head_of(grid, cell); at != NONE; at = grid->next[at]) {
            struct cell own = cell_of(grid, grid->places[at]);
            struct vec2 way = vec2_sub(grid->places[at], place);
            if (own.x == cell.x && own.y == cell.y &&
                elementary_hypot(way.x, way.y) <= grid->radius_m)
                found[count++] = at;
        }
    }
    sort_items(found, count, sizeof *found, compare_numbers, arena);
    return count;
}
