#include "view/view_marks.h"

#include "base/units.h"

const struct view_shape view_marks_shapes[VIEW_SHAPES] = {
    {5, 0.42, 0, 1.3}, {0, 0, 0, 0.95},     {4, 0, 0, 1.2},
    {3, 0, 0, 1.2},    {4, 0, PI / 4, 1.2}, {4, 0.3, PI / 4, 1.3},
};

/* Any two differ by at least 10 in CIEDE2000, also for people who lack one kind of cones
 * (tests/browser). */
const char *const view_marks_light[VIEW_COLOURS] = {"#0072b2", "#c74e00", "#00675b", "#ac4481",
                                                    "#8e3900", "#3590d8", "#724a38", "#4c344e"};
const char *const view_marks_dark[VIEW_COLOURS] = {"#56b4e9", "#f0a030", "#2c9b9a", "#b75ec2",
                                                   "#de6e4e", "#a3daff", "#cfb37c", "#caccc8"};

const char *view_marks_kind(enum path path)
{
    if (path == PATH_CLUTTER)
        return "clutter";
    if (path == PATH_FALSE_ALARM)
        return "false_alarm";
    return frame_shows_object(path) ? "body" : "ghost";
}
