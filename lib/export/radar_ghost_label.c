#include "export/radar_ghost_label.h"

/* The first digit; classes that are not listed have none. */
static const struct {
    const char *class;
    int64_t digit;
} class_digits[] = {
    {"pedestrian", 1}, {"bicycle", 2},           {"car", 3}, {"van", 3},
    {"truck", 4},      {"articulated_truck", 4}, {"bus", 4}, {"motorcycle", 5},
};

/* The last two digits, by path: 1 or 2 for a last bounce on the object or on the mirror, and a bit
 * for the order: 1, 2 or 4 for one, two or three bounces. */
static const int64_t bounce_digits[] = {
    [PATH_DIRECT] = 11,           [PATH_WALL_OBJECT] = 12, [PATH_OBJECT_WALL] = 22,
    [PATH_WALL_OBJECT_WALL] = 24, [PATH_WHEEL] = 11,       [PATH_LIMB] = 11,
};

enum { LABEL_BACKGROUND = 0, LABEL_NOISE = -2, LABEL_MAIN = 100 };

static int64_t class_digit(const char *class)
{
    for (size_t i = 0; class != NULL && i < sizeof class_digits / sizeof *class_digits; i++)
        if (strcmp(class, class_digits[i].class) == 0)
            return class_digits[i].digit;
    return 0;
}

int64_t radar_ghost_label_of(enum path path, const char *class)
{
    if (path == PATH_FALSE_ALARM)
        return LABEL_NOISE;
    int64_t digit = path == PATH_CLUTTER ? 0 : class_digit(class);
    return digit == 0 ? LABEL_BACKGROUND : 1000 * digit + LABEL_MAIN + bounce_digits[path];
}
