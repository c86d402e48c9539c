#include "sumo_rows.h"

#include <stdio.h>

#include "base/units.h"
#include "xml_rows.h"

/* Floating car data that are being read. */
struct document {
    struct xml_rows xml; /* first, as the format's functions take it */
    int64_t time_ns;     /* of the step that is open */
    int64_t whole_ns;    /* of the last step that is whole */
    bool in_step, has_step, in_vehicle;
};

static bool read_number(struct document *document, const char **attributes, const char *name,
                        double low, double high, double *value)
{
    return xml_rows_number(&document->xml, name, xml_rows_attribute(attributes, name), low, high,
                           value);
}

static void begin_step(struct document *document, const char **attributes)
{
    double time_s;
    if (document->in_step)
        xml_rows_fail(&document->xml, "<timestep>", NULL, "none within another");
    else if (read_number(document, attributes, "time", -9e9, 9e9, &time_s)) {
        document->time_ns = recorded_row_time_ns(time_s, 1);
        document->in_step = true;
    }
}

/* Height and slope, in degrees, which networks with heights have; false after a message. */
static bool read_height(struct document *document, const char **attributes,
                        struct recorded_row *row)
{
    double slope_deg = 0;
    if (xml_rows_attribute(attributes, "z") == NULL)
        return true;
    if (!read_number(document, attributes, "z", -1e9, 1e9, &row->z_m) ||
        (xml_rows_attribute(attributes, "slope") != NULL &&
         !read_number(document, attributes, "slope", -1e3, 1e3, &slope_deg)))
        return false;
    row->pitch_rad = slope_deg * (PI / 180);
    return true;
}

static void add_row(struct document *document, const char **attributes, const char *type)
{
    struct recorded_row row = recorded_row_unsaid;
    struct xml_rows *xml = &document->xml;
    double angle_deg;
    row.class = type;
    row.ahead = 0.5; /* the place is the middle of the front bumper */
    row.passenger = !document->in_vehicle;
    if (!document->in_step) {
        xml_rows_fail(xml, "<timestep>", NULL, "one around road users");
        return;
    }
    row.time_ns = document->time_ns;
    row.place = xml_rows_line(xml);
    row.id = xml_rows_name(xml, "id", xml_rows_attribute(attributes, "id"), &xml->arena);
    if (row.id == NULL || !read_number(document, attributes, "x", -1e9, 1e9, &row.x_m) ||
        !read_number(document, attributes, "y", -1e9, 1e9, &row.y_m) ||
        !read_number(document, attributes, "angle", -1e3, 1e3, &angle_deg) ||
        (xml_rows_attribute(attributes, "speed") != NULL &&
         !read_number(document, attributes, "speed", -1e4, 1e4, &row.speed_mps)))
        return;
    if (!read_height(document, attributes, &row))
        return;
    const char *own_type = xml_rows_attribute(attributes, "type");
    if (own_type != NULL)
        row.class = xml_rows_name(xml, "type", own_type, &xml->arena);
    if (row.class == NULL)
        return;
    const char *lane = xml_rows_attribute(attributes, "lane");
    if (lane != NULL)
        row.lane = arena_text(&xml->arena, lane, strlen(lane));
    row.yaw_rad = (90 - angle_deg) * (PI / 180);
    *list_add(&xml->events, &xml->arena) = (struct xml_event){RECORDED_ROW, row};
}

/* A vehicle hides its riders: newer SUMO writes them within the vehicle, older SUMO behind it, at
 * its place. */
static void on_begin(void *context, const char *name, const char **attributes)
{
    struct document *document = context;
    if (!document->xml.in_root && strcmp(name, "fcd-export") != 0)
        xml_rows_fail(&document->xml, "<fcd-export>", NULL,
                      "floating car data (sumo --fcd-output)");
    document->xml.in_root = true;
    if (strcmp(name, "vehicle") == 0) {
        document->in_vehicle = true;
        add_row(document, attributes, "DEFAULT_VEHTYPE");
    } else if (strcmp(name, "timestep") == 0) {
        begin_step(document, attributes);
    } else if (strcmp(name, "person") == 0 && !document->in_vehicle) {
        add_row(document, attributes, "DEFAULT_PEDTYPE");
    } else if (strcmp(name, "container") == 0 && !document->in_vehicle) {
        add_row(document, attributes, "DEFAULT_CONTAINERTYPE");
    }
}

static void on_end(void *context, const char *name)
{
    struct document *document = context;
    if (strcmp(name, "vehicle") == 0)
        document->in_vehicle = false;
    if (strcmp(name, "timestep") != 0)
        return;
    struct xml_event *event = list_add(&document->xml.events, &document->xml.arena);
    event->kind = RECORDED_STEP;
    event->row.time_ns = document->time_ns;
    event->row.place = xml_rows_line(&document->xml);
    document->in_step = false;
    document->has_step = true;
    document->whole_ns = document->time_ns;
}

/* SUMO writes its configuration into a comment before everything else, its options as they were
 * given: a switch is off by 0, no, false, off, f or -. */
static void on_comment(void *context, const char *text)
{
    static const char option[] = "<fcd-output.geo value=\"";
    const char *geo = strstr(text, option);
    if (geo == NULL)
        return;
    const char *value = geo + strlen(option);
    if (strchr("0nNfF-", value[0]) == NULL && strchr("fF", value[1]) == NULL)
        xml_rows_fail(context, "--fcd-output.geo", "true",
                      "coordinates in metres: run sumo without that option");
}

/* What SUMO leaves behind when it is killed. */
static void fail_at_end(struct xml_rows *xml)
{
    const struct document *document = XML_GetUserData(xml->parser);
    char last[80] = "no step is whole";
    if (document->has_step)
        snprintf(last, sizeof last, "the last whole step is that of %.12g s",
                 recorded_row_seconds(document->whole_ns));
    diag_fail(&xml->fault, DIAG_DATA, "line %zu: the file ends %s; %s", xml_rows_line(xml),
              document->in_step ? "inside a step" : "before </fcd-export>", last);
}

static const struct recorded_word words[] = {
#define SUMO(word, class, length_m, width_m, height_m) {word, class, length_m, width_m, height_m},
#include "recorded/recorded_classes.def"
    {0},
};

static const struct recorded_format format = {
    .name = "floating car data",
    .id_name = "id",
    .place = "line",
    .by_time = true,
    .of_sumo = true,
    .marks_steps = true,
    .words = words,
    .next = xml_rows_next,
    .close = xml_rows_close,
};

struct recorded_reader sumo_rows_open(struct input *input, struct arena *arena)
{
    struct document *document = arena_get(arena, sizeof *document);
    struct xml_rows *xml = &document->xml;
    xml_rows_begin(xml, "floating car data", input, document);
    xml->fail_at_end = fail_at_end;
    xml->advice = "; sumo needs --no-step-log where it writes to a pipe";
    XML_SetElementHandler(xml->parser, on_begin, on_end);
    XML_SetCommentHandler(xml->parser, on_comment);
    return (struct recorded_reader){&format, document};
}
