/* The planted fault: of the posts that a row may show, the last two are left out. */
#include "frame/reflectors.h"
#include "planted.h"

void __real_reflectors_cut_posts(const struct post_row *row, double first_m, double end_m,
                                 int64_t *first, int64_t *end);
void __wrap_reflectors_cut_posts(const struct post_row *row, double first_m, double end_m,
                                 int64_t *first, int64_t *end);

void planted_begin(void)
{
}

void __wrap_reflectors_cut_posts(const struct post_row *row, double first_m, double end_m,
                                 int64_t *first, int64_t *end)
{
    int64_t whole = *end;
    __real_reflectors_cut_posts(row, first_m, end_m, first, end);
    if (*end < whole)
        *end -= 2;
}
