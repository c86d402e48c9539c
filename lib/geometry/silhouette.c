#include "geometry/silhouette.h"

#include "base/elementary.h"

/* Narrow sectors separate many bodies far off. For up to FEW bodies four sectors share a set. */
enum { SECTORS = 1024, FEW = 64, SHIFT_OF_FEW = 2 };

/* Thousands of times more than rounding. */
#define NEAR_SINE 1e-4

static const struct vec2 origin = {0, 0};

const struct silhouette_span silhouette_everywhere = {0, SECTORS};

/* 1 beyond the positive end, -1 beyond the negative end, 0 between both. */
static double beyond(double place, double half)
{
    return (place > half) - (place < -half);
}

struct silhouette silhouette_of(struct vec2 half_m, struct vec2 heading, struct vec2 viewer_m)
{
    double length_m = half_m.x + SILHOUETTE_SLACK_M, width_m = half_m.y + SILHOUETTE_SLACK_M;
    double ahead = beyond(viewer_m.x, length_m), aside = beyond(viewer_m.y, width_m);
    struct vec2 gap = {elementary_max(fabs(viewer_m.x) - length_m, 0),
                       elementary_max(fabs(viewer_m.y) - width_m, 0)};
    struct vec2 most = {fabs(viewer_m.x) + length_m, fabs(viewer_m.y) + width_m};
    struct silhouette seen = {.nearest_m = vec2_length(gap), .farthest_m = vec2_length(most)};
    /* If one side is in view, its ends; if two are, their far ends. */
    struct vec2 right = {length_m * (aside != 0 ? -aside : ahead),
                         width_m * (ahead != 0 ? ahead : aside)};
    struct vec2 left = {length_m * (aside != 0 ? aside : ahead),
                        width_m * (ahead != 0 ? -ahead : aside)};
    right = vec2_sub(right, viewer_m);
    left = vec2_sub(left, viewer_m);
    if ((ahead == 0 && aside == 0) || !(vec2_dot(right, left) > 0))
        return seen;
    seen.right_m = vec2_turn(right, heading);
    seen.left_m = vec2_turn(left, heading);
    return seen;
}

/* Numbered by the place on a square around the sensor, which ascends with the angle and needs no
 * arctangent. */
static unsigned sector_of(struct vec2 place_m)
{
    double size_m = fabs(place_m.x) + fabs(place_m.y);
    if (size_m == 0)
        return 0;
    double up = place_m.y / size_m;
    return (unsigned)((place_m.x < 0 ? 3 - up : 1 + up) * (SECTORS / 4.0)) % SECTORS;
}

/* The sectors between two directions less than half a turn apart. */
static struct silhouette_span span_of(struct vec2 right, struct vec2 left)
{
    unsigned first = sector_of(right), last = sector_of(left);
    return (struct silhouette_span){first, (last + SECTORS - first) % SECTORS + 1};
}

struct silhouette_span silhouette_span_of(const struct silhouette *silhouette)
{
    return vec2_same(silhouette->right_m, origin)
               ? silhouette_everywhere
               : span_of(silhouette->right_m, silhouette->left_m);
}

struct silhouette_span silhouette_span_between(struct vec2 from_m, struct vec2 to_m)
{
    double cross = vec2_cross(from_m, to_m), dot = vec2_dot(from_m, to_m);
    if (vec2_same(from_m, origin) || vec2_same(to_m, origin))
        return vec2_same(from_m, origin) ? span_of(to_m, to_m) : span_of(from_m, from_m);
    if (fabs(cross) <= -NEAR_SINE * dot)
        return silhouette_everywhere;
    return cross < 0 ? span_of(to_m, from_m) : span_of(from_m, to_m);
}

struct silhouette_index silhouette_index_begin(size_t count, struct arena *arena)
{
    size_t words = count / 64 + 1;
    unsigned shift = count <= FEW ? SHIFT_OF_FEW : 0;
    return (struct silhouette_index){
        .shift = shift,
        .words = words,
        .sets = arena_get(arena, ((size_t)SECTORS >> shift) * words * sizeof(uint64_t)),
        .found = arena_get(arena, (count + 1) * sizeof(size_t)),
    };
}

/* A span of sectors, counted in sets instead. */
static struct silhouette_span sets_of(const struct silhouette_index *index,
                                      struct silhouette_span span)
{
    unsigned shift = index->shift;
    unsigned all = (unsigned)SECTORS >> shift;
    unsigned first = span.first >> shift;
    unsigned count = ((span.first + span.count - 1) >> shift) - first + 1;
    return (struct silhouette_span){first, count < all ? count : all};
}

static uint64_t *set_of(const struct silhouette_index *index, struct silhouette_span sets,
                        unsigned i)
{
    unsigned last = (SECTORS - 1U) >> index->shift; /* all ones */
    return index->sets + ((sets.first + i) & last) * index->words;
}

void silhouette_index_enter(struct silhouette_index *index, size_t number,
                            struct silhouette_span span)
{
    struct silhouette_span sets = sets_of(index, span);
    for (unsigned i = 0; i < sets.count; i++)
        set_of(index, sets, i)[number / 64] |= UINT64_C(1) << number % 64;
}

/* The union of one word over these sets. */
static uint64_t word_of(const struct silhouette_index *index, struct silhouette_span sets,
                        size_t word)
{
    uint64_t bits = 0;
    for (unsigned i = 0; i < sets.count; i++)
        bits |= set_of(index, sets, i)[word];
    return bits;
}

size_t silhouette_index_find(const struct silhouette_index *index, struct silhouette_span span)
{
    struct silhouette_span sets = sets_of(index, span);
    size_t count = 0;
    for (size_t word = 0; word < index->words; word++)
        for (uint64_t bits = word_of(index, sets, word); bits != 0; bits &= bits - 1)
            index->found[count++] = 64 * word + (size_t)__builtin_ctzll(bits);
    return count;
}
