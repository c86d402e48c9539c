#include "check.h"

#include "run/progress.h"

struct moment {
    int64_t count;
    double elapsed_s, share;
    const char *line;
};

TEST(the_line_tells_share_rate_and_time_left)
{
    static const struct moment moments[] = {
        {500, 5, 0.25, "[######                  ]  25 %, 100 frames/s, 0:00:15 left"},
        {10, 2, 0.5, "[############            ]  50 %, 5.0 frames/s, 0:00:02 left"},
        {20, 2, 0.01, "[                        ]   1 %, 10 frames/s, 0:03:18 left"},
        {3600, 3600, 0.2, "[####                    ]  20 %, 1.0 frames/s, 4:00:00 left"},
    };
    for (size_t i = 0; i < COUNT(moments); i++) {
        struct progress progress = {.unit = "frames", .count = moments[i].count};
        char line[100];
        progress_write(&progress, moments[i].elapsed_s, moments[i].share, line, sizeof line);
        assert_string_equal(line, moments[i].line);
    }
}

TEST(a_file_that_grows_is_never_more_than_whole)
{
    struct progress progress = {.unit = "frames", .count = 9};
    char line[100];
    progress_write(&progress, 3, 1.5, line, sizeof line);
    assert_string_equal(line, "[########################] 100 %, 3.0 frames/s, 0:00:00 left");
}
