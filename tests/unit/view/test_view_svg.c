#include "check.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frame/frame_text.h"
#include "view/view_svg.h"

#define OBJECT(id, x) OBJECT_OF("thing", id, x)
#define OBJECT_OF(class, id, x) "{\"id\":\"" id "\",\"class\":\"" class "\",\"x_m\":" x AT_REST
#define AT_REST                                                                                    \
    ",\"y_m\":0,\"yaw_rad\":0,\"vx_mps\":0,\"vy_mps\":0,\"yaw_rate_radps\":0,\"length_m\":4,"      \
    "\"width_m\":2,\"height_m\":1,\"travelled_m\":0}"
#define CONTRIBUTOR(reflector, range, weight) CONTRIBUTOR_BY("direct", reflector, range, weight)
#define CONTRIBUTOR_BY(path, reflector, range, weight)                                             \
    "{\"object\":\"o\",\"reflector\":\"" reflector "\",\"path\":\"" path "\",\"range_m\":" range   \
    ",\"azimuth_rad\":0,\"range_rate_mps\":0,\"ercs\":1,\"time_s\":4,\"weight\":" weight "}"
#define ECHOES                                                                                     \
    CONTRIBUTOR("a", "7", "0.5")                                                                   \
    "," CONTRIBUTOR("b", "8", "0.25") "," CONTRIBUTOR("c", "9", "0.25")
#define TARGET(range) TARGET_OF(range, CONTRIBUTOR("a", "8", "1"))
#define TARGET_OF(range, contributors)                                                             \
    "{\"sensor\":\"f\",\"range_m\":" range ",\"azimuth_rad\":0,\"range_rate_mps\":0,"              \
    "\"amplitude_db\":12,\"cell_range_m\":8,\"cell_azimuth_rad\":0,\"cell_range_rate_mps\":0,"     \
    "\"cell_amplitude\":4,\"contributors\":[" contributors "]}"
#define TARGET_BY(path, range) TARGET_OF(range, CONTRIBUTOR_BY(path, "a", "8", "1"))
#define FRAME(scene, objects, rest)                                                                \
    "{\"version\":0,\"scene\":\"" scene "\",\"frame\":0,\"time_s\":4,\"interval_s\":0.04,"         \
    "\"seed\":\"1\",\"ego\":\"e\",\"objects\":[" OBJECT("e", "0") objects "]" rest "}"
#define SENSORS(name)                                                                              \
    ",\"sensors\":{\"suite\":\"s\",\"digest\":\"0123456789abcdef\",\"list\":[{\"name\":\"" name    \
    "\",\"mount_x_m\":2,\"mount_y_m\":0,\"mount_yaw_rad\":0,\"field_of_view_rad\":3,"              \
    "\"range_max_m\":30,\"cell_range_m\":0.3,\"cell_range_rate_mps\":0.5,\"measured\":true}]}"

#define ENTRY(reflector, place)                                                                    \
    "{\"object\":\"o\",\"reflector\":\"" reflector "\",\"path\":\"direct\"" place "}"
#define LOST(reason, entries)                                                                      \
    "{\"stage\":\"ideal\",\"sensor\":\"f\",\"reason\":\"" reason "\",\"echoes\":[" entries "]}"

#define AT(range) ",\"range_m\":" range
#define BLOCKED                                                                                    \
    LOST("blocked", ENTRY("corner_fl", AT("8")) "," ENTRY("wheel_rr", AT("10")) "," ENTRY("x", ""))
#define FACING_AWAY LOST("facing_away", ENTRY("corner_rl", AT("9")))

/* The drawing of a frame's line, NUL-terminated; the caller frees it. */
static char *draw(const char *line)
{
    struct arena arena = {0}, documents = {0};
    struct frame frame = {.arena = &arena};
    struct view_models models = {.arena = &documents};
    struct text text = {0};
    struct diag diag = {0};
    if (frame_text_read(line, strlen(line), &frame, &diag) != 0)
        fail_msg("%s", diag.text);
    view_svg_write(&frame, &models, &text);
    text_add(&text, "", 1);
    arena_free(&arena);
    arena_free(&documents);
    return text.bytes;
}

static const char *skip_entity(const char *at)
{
    static const char *const known[] = {"&amp;", "&lt;", "&gt;", "&quot;"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strncmp(at, known[i], strlen(known[i])) == 0)
            return at + strlen(known[i]) - 1;
    fail_msg("a bare ampersand at %.20s", at);
    return at;
}

/* True if every end tag closes the element that is open, attributes are quoted, and ampersands
 * begin an entity. */
static void assert_well_formed(const char *xml)
{
    const char *open[32];
    size_t depth = 0, elements = 0;
    for (const char *at = xml; *at != '\0'; at++) {
        assert_true((unsigned char)*at >= 0x20 || *at == '\n');
        if (*at == '&')
            at = skip_entity(at);
        if (*at != '<')
            continue;
        bool closing = at[1] == '/';
        const char *name = at + (closing ? 2 : 1), *end = name;
        assert_true(isalpha((unsigned char)*name));
        size_t length = strcspn(name, " />");
        for (bool quoted = false; *end != '>' || quoted; end++) {
            assert_true(*end != '\0' && *end != '<');
            quoted ^= *end == '"';
        }
        if (closing) {
            assert_true(depth > 0 && strncmp(open[depth - 1], name, length) == 0);
            depth--;
        } else if (end[-1] != '/') {
            assert_true(depth < 32);
            open[depth++] = name;
        }
        elements++;
        at = end;
    }
    assert_int_equal(depth, 0);
    assert_true(elements > 3);
}

TEST(drawings_are_well_formed_xml)
{
    static const char *const lines[] = {
        FRAME("x", "", ""),
        FRAME("x", "," OBJECT("o", "12"), ""),
        FRAME("x", "," OBJECT("o", "12"), SENSORS("f") ",\"targets\":[" TARGET("8") "]"),
        FRAME("<svg>&amp;\\\"]]>", "," OBJECT("</text><script>", "12"), SENSORS("<&>")),
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char *xml = draw(lines[i]);
        assert_well_formed(xml);
        assert_null(strstr(xml, "nan"));
        assert_null(strstr(xml, "inf"));
        free(xml);
    }
    struct text empty = {0};
    view_svg_write_empty(&empty);
    text_add(&empty, "", 1);
    assert_well_formed(empty.bytes);
    text_free(&empty);
}

TEST(names_are_escaped)
{
    char *xml = draw(FRAME("<b>&\\\"", "," OBJECT("</text><script>", "12"), SENSORS("f")));
    assert_non_null(strstr(xml, "&lt;b&gt;&amp;&quot;"));
    assert_non_null(strstr(xml, "&lt;/text&gt;&lt;script&gt;"));
    assert_null(strstr(xml, "<script"));
    free(xml);
}

/* The first corner of the nth path of a class. */
static void corner_of(const char *xml, const char *class, int nth, double *x, double *y)
{
    char wanted[64];
    snprintf(wanted, sizeof wanted, "class=\"%s\" d=\"M", class);
    for (const char *at = strstr(xml, wanted); at != NULL; at = strstr(at + 1, wanted))
        if (nth-- == 0) {
            char *end;
            *x = strtod(at + strlen(wanted), &end);
            *y = strtod(end, &end);
            return;
        }
    fail_msg("no %s", wanted);
}

TEST(drawings_have_the_scale_of_their_bar)
{
    char *xml = draw(FRAME("x", "," OBJECT("o", "12"),
                           SENSORS("f") ",\"targets\":[" TARGET("8") "," TARGET("13") "]"));
    double near_x, far_x, y, bar, metres;
    corner_of(xml, "target f0", 0, &near_x, &y);
    corner_of(xml, "target f0", 1, &far_x, &y);
    assert_int_equal(sscanf(strstr(xml, "d=\"M20 774v6h"), "d=\"M20 774v6h%lfv", &bar), 1);
    assert_int_equal(sscanf(strstr(xml, "y=\"770\">"), "y=\"770\">%lf m<", &metres), 1);
    assert_close((far_x - near_x) / bar, 5 / metres, 0.01);
    free(xml);
}

static int count_of(const char *xml, const char *word)
{
    int count = 0;
    for (const char *at = strstr(xml, word); at != NULL; at = strstr(at + 1, word))
        count++;
    return count;
}

/* From 80 to 200 pixels, whatever the size of the scene. */
TEST(the_bar_is_a_round_length)
{
    static const char *const lines[] = {
        FRAME("x", "", ""),
        FRAME("x", "," OBJECT("o", "30"), ""),
        FRAME("x", "," OBJECT("o", "70"), ""),
        FRAME("x", "," OBJECT("o", "200"), ""),
        FRAME("x", "," OBJECT("o", "500"), ""),
        FRAME("x", "," OBJECT("o", "900"), ""),
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        double bar, metres;
        char *xml = draw(lines[i]);
        assert_int_equal(sscanf(strstr(xml, "d=\"M20 774v6h"), "d=\"M20 774v6h%lfv", &bar), 1);
        assert_int_equal(sscanf(strstr(xml, "y=\"770\">"), "y=\"770\">%lf m<", &metres), 1);
        assert_in_range(bar, 80, 200);
        double digit = metres / pow(10, floor(log10(metres)));
        assert_true(digit == 1 || digit == 2 || digit == 5);
        free(xml);
    }
}

TEST(every_kind_of_target_has_its_mark)
{
    static const char *const lines[] = {
        FRAME("x", "", SENSORS("f") ",\"targets\":[" TARGET_BY("wheel", "8") "]"),
        FRAME("x", "", SENSORS("f") ",\"targets\":[" TARGET_BY("wall_object", "8") "]"),
        FRAME("x", "", SENSORS("f") ",\"targets\":[" TARGET_BY("clutter", "8") "]"),
        FRAME("x", "", SENSORS("f") ",\"targets\":[" TARGET_BY("false_alarm", "8") "]"),
    };
    static const char *const marks[] = {"<path class=\"target f0\"", "<path class=\"hollow s0\"",
                                        "<circle class=\"target f0\"", "<path class=\"alarm s0\""};
    for (size_t i = 0; i < 4; i++) {
        char *xml = draw(lines[i]);
        const char *legend = strstr(xml, "<rect width=\"380\"");
        for (size_t mark = 0; mark < 4; mark++)
            assert_int_equal(strstr(xml, marks[mark]) < legend, mark == i);
        free(xml);
    }
}

TEST(every_echo_of_a_target_is_lit_and_tied_to_it)
{
    char *xml = draw(FRAME("x", "," OBJECT("o", "12"),
                           SENSORS("f") ",\"targets\":[" TARGET_OF("8", ECHOES) "]"));
    /* One more stands in the legend. */
    assert_int_equal(count_of(xml, "<circle class=\"lit\""), 3 + 1);
    assert_int_equal(count_of(xml, "<path class=\"tie\""), 3);
    free(xml);
}

TEST(targets_of_the_first_sensor_are_stars_of_five_points)
{
    char *xml = draw(FRAME("x", "", SENSORS("f")));
    const char *star = strstr(xml, "<path class=\"target f0\"");
    assert_non_null(star);
    *strchr(star, '>') = '\0';
    assert_int_equal(count_of(star, "L"), 9);
    free(xml);
}

/* Two echoes are hidden, and one whose place is not known; a reflector faces away. */
TEST(losses_are_marked_where_they_were)
{
    char *xml = draw(
        FRAME("x", "," OBJECT("o", "12"), SENSORS("f") ",\"lost\":[" BLOCKED "," FACING_AWAY "]"));
    assert_int_equal(count_of(xml, "<circle class=\"centre\""), 1);
    assert_int_equal(count_of(xml, "<path class=\"lost\""), 2);
    double near_x, far_x, y, bar, metres;
    corner_of(xml, "lost", 0, &near_x, &y);
    corner_of(xml, "lost", 1, &far_x, &y);
    assert_int_equal(sscanf(strstr(xml, "d=\"M20 774v6h"), "d=\"M20 774v6h%lfv", &bar), 1);
    assert_int_equal(sscanf(strstr(xml, "y=\"770\">"), "y=\"770\">%lf m<", &metres), 1);
    assert_close((far_x - near_x) / bar, 2 / metres, 0.01);
    free(xml);
}

TEST(a_name_lies_over_targets_and_not_over_the_edge)
{
    char *xml = draw(FRAME("x", "," OBJECT("near", "12") "," OBJECT("far", "40"),
                           SENSORS("f") ",\"targets\":[" TARGET("8") "," TARGET("13") "]"));
    const char *name = strstr(xml, ">near<");
    assert_non_null(name);
    assert_true(name > strstr(xml, "class=\"target f0\""));
    assert_null(strstr(xml, ">far<"));
    free(xml);
}
