#include "score/gospa.h"

#include <assert.h>
#include <stdbool.h>

#include "base/elementary.h"

/* The matrix, with no more rows than columns, and the pairs so far. Costs less the prices of their
 * row and column are never negative, and 0 where a row has its column. */
struct pairing {
    const double *cost;
    size_t columns;
    double *row_price, *column_price;
    size_t *column_of, *row_of;
    /* For the row that is being added: the least cost at which each column is reached, the row
     * before it on that path, and whether that is settled. */
    double *reach;
    size_t *from;
    bool *settled;
};

/* True if a column is reached at less cost than another, or at the same cost without moving a
 * row. */
static bool is_nearer(const struct pairing *pairing, size_t column, size_t than)
{
    double reach = pairing->reach[column], least = pairing->reach[than];
    bool is_free = pairing->row_of[column] == GOSPA_NONE && pairing->row_of[than] != GOSPA_NONE;
    return reach < least || (reach <= least && is_free);
}

/* Extends the paths from a row that is reached at the cost `spent`, and settles the nearest
 * column. */
static size_t settle_next(struct pairing *pairing, size_t row, double spent)
{
    size_t next = GOSPA_NONE;
    for (size_t column = 0; column < pairing->columns; column++) {
        if (pairing->settled[column])
            continue;
        double reach = spent + (pairing->cost[row * pairing->columns + column] -
                                pairing->row_price[row] - pairing->column_price[column]);
        if (reach < pairing->reach[column]) {
            pairing->reach[column] = reach;
            pairing->from[column] = row;
        }
        if (next == GOSPA_NONE || is_nearer(pairing, column, next))
            next = column;
    }
    pairing->settled[next] = true;
    return next;
}

static void change_prices(struct pairing *pairing, size_t row, double spent)
{
    pairing->row_price[row] += spent;
    for (size_t column = 0; column < pairing->columns; column++) {
        if (!pairing->settled[column])
            continue;
        double saved = spent - pairing->reach[column];
        pairing->column_price[column] -= saved;
        if (pairing->row_of[column] != GOSPA_NONE)
            pairing->row_price[pairing->row_of[column]] += saved;
    }
}

/* Gives a row a column at the least extra cost; rows along the path to a free column move on. */
static void add_row(struct pairing *pairing, size_t row)
{
    for (size_t column = 0; column < pairing->columns; column++) {
        pairing->reach[column] = HUGE_VAL;
        pairing->settled[column] = false;
    }
    size_t at = row, column;
    double spent = 0;
    for (;;) {
        column = settle_next(pairing, at, spent);
        spent = pairing->reach[column];
        if (pairing->row_of[column] == GOSPA_NONE)
            break;
        at = pairing->row_of[column];
    }
    change_prices(pairing, row, spent);
    do {
        at = pairing->from[column];
        pairing->row_of[column] = at;
        size_t before = pairing->column_of[at];
        pairing->column_of[at] = column;
        column = before;
    } while (at != row);
}

static void solve(const double *cost, size_t rows, size_t columns, size_t *column_of,
                  size_t *row_of, struct arena *arena)
{
    struct pairing pairing = {
        .cost = cost,
        .columns = columns,
        .row_price = arena_get(arena, rows * sizeof(double)),
        .column_price = arena_get(arena, columns * sizeof(double)),
        .column_of = column_of,
        .row_of = row_of,
        .reach = arena_get(arena, columns * sizeof(double)),
        .from = arena_get(arena, columns * sizeof(size_t)),
        .settled = arena_get(arena, columns * sizeof(bool)),
    };
    for (size_t row = 0; row < rows; row++)
        column_of[row] = GOSPA_NONE;
    for (size_t column = 0; column < columns; column++)
        row_of[column] = GOSPA_NONE;
    for (size_t row = 0; row < rows; row++)
        add_row(&pairing, row);
}

void gospa_assign(const double *cost, size_t rows, size_t columns, size_t *column_of,
                  struct arena *arena)
{
    size_t *row_of = arena_get(arena, columns * sizeof *row_of);
    if (rows <= columns) {
        solve(cost, rows, columns, column_of, row_of, arena);
        return;
    }
    double *turned = arena_get(arena, rows * columns * sizeof *turned);
    for (size_t row = 0; row < rows; row++)
        for (size_t column = 0; column < columns; column++)
            turned[column * rows + row] = cost[row * columns + column];
    solve(turned, columns, rows, row_of, column_of, arena);
}

/* Costs are at most c^2, so every item of the shorter list gets a partner. A partner at the cut-off
 * costs as much as two unpaired items, and does not count as one. */
size_t gospa_pair(const double *distance, size_t truths, size_t listed, double cutoff,
                  size_t *item_of, struct arena *arena)
{
    double *cost = arena_get(arena, truths * listed * sizeof *cost);
    for (size_t i = 0; i < truths * listed; i++) {
        double near = elementary_min(distance[i], cutoff);
        cost[i] = near * near;
    }
    gospa_assign(cost, truths, listed, item_of, arena);
    size_t pairs = 0;
    for (size_t i = 0; i < truths; i++) {
        if (item_of[i] != GOSPA_NONE && !(distance[i * listed + item_of[i]] < cutoff))
            item_of[i] = GOSPA_NONE;
        pairs += item_of[i] != GOSPA_NONE;
    }
    return pairs;
}

struct gospa gospa_of(double squares, size_t pairs, size_t truths, size_t listed, double cutoff)
{
    assert(pairs <= truths && pairs <= listed);
    double alone = cutoff * cutoff / 2;
    size_t longer = truths > listed ? truths : listed;
    struct gospa gospa = {
        .localisation = squares,
        .missed_part = alone * (double)(truths - pairs),
        .false_part = alone * (double)(listed - pairs),
    };
    gospa.value = sqrt(gospa.localisation + gospa.missed_part + gospa.false_part);
    if (longer > 0)
        gospa.ospa = sqrt((squares + cutoff * cutoff * (double)(longer - pairs)) / (double)longer);
    return gospa;
}
