/* Traffic of CommonRoad: the obstacles of a scenario in XML, 2018b or 2020a. */
/* needs: expat */
#include <math.h>

#include "base/elementary.h"
#include "traffic/recording.h"
#include "xml_rows.h"

enum { PATH_SIZE = 512, NAME_SIZE = FIELD_NAME_SIZE + 1, STEPS = 1000000 };

#define UNSAID ((double)NAN)

/* An exact value or an interval, each time with both ends, which may be UNSAID. */
struct interval {
    double low, high;
};

struct state {
    struct interval time, orientation, velocity, lateral, slip, yaw_rate;
};

/* A rectangle, a circle or a point. */
struct part {
    double x_m, y_m, length_m, width_m, orientation_rad, radius_m;
};

/* The box around parts. length_m UNSAID: there is none yet. */
struct region {
    double x_m, y_m, length_m, width_m;
};

struct document {
    struct xml_rows xml;
    double step_s;
    size_t depth;         /* elements that are open */
    char path[PATH_SIZE]; /* of those inside an obstacle, "/shape/rectangle" */
    char text[NAME_SIZE]; /* of the one that was opened last */
    size_t path_length, text_length;
    bool in_obstacle, still;
    char id[NAME_SIZE], type[NAME_SIZE]; /* of the obstacle; empty: not said yet */
    struct region shape, position;
    struct part part;
    struct state state;
    struct arena *arena;                 /* of what is kept until the end: */
    LIST_OF(struct recorded_row) stills; /* obstacles that stand still */
    struct intern steps;                 /* times of all others */
    size_t still_given;                  /* how many of those came in every step */
    uint32_t step_given;                 /* and in how many steps the next one came */
};

struct traffic_commonroad {
    const char *source;
    struct recording_options options;
    struct document document;
    struct recording recording;
};

static const struct state unsaid = {{UNSAID, UNSAID}, {UNSAID, UNSAID}, {UNSAID, UNSAID},
                                    {UNSAID, UNSAID}, {UNSAID, UNSAID}, {UNSAID, UNSAID}};
static const struct part no_part = {.x_m = UNSAID, .y_m = UNSAID};

static bool is_white(char letter)
{
    return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n';
}

static void fail(struct document *document, const char *what, const char *value,
                 const char *expectation)
{
    xml_rows_fail(&document->xml, what, value, expectation);
}

/* ---- values ---- */

static const struct member {
    const char *name;
    size_t offset;
    double low, high;
} of_states[] =
    {
        {"/time", offsetof(struct document, state.time), 0, STEPS},
        {"/orientation", offsetof(struct document, state.orientation), -1e3, 1e3},
        {"/velocity", offsetof(struct document, state.velocity), -1e4, 1e4},
        {"/velocityY", offsetof(struct document, state.lateral), -1e4, 1e4},
        {"/slipAngle", offsetof(struct document, state.slip), -1e3, 1e3},
        {"/yawRate", offsetof(struct document, state.yaw_rate), -1e3, 1e3},
},
  of_parts[] = {
      {"x", offsetof(struct document, part.x_m), -1e9, 1e9},
      {"y", offsetof(struct document, part.y_m), -1e9, 1e9},
      {"length", offsetof(struct document, part.length_m), 0, 1e6},
      {"width", offsetof(struct document, part.width_m), 0, 1e6},
      {"orientation", offsetof(struct document, part.orientation_rad), -1e3, 1e3},
      {"radius", offsetof(struct document, part.radius_m), 0, 1e6},
};

enum { OF_STATES = sizeof of_states / sizeof *of_states };
enum { OF_PARTS = sizeof of_parts / sizeof *of_parts };

/* What is left of a path below an element, or NULL if it is not below it. */
static const char *below(const char *path, const char *element)
{
    size_t length = strlen(element);
    bool inside = strncmp(path, element, length) == 0;
    return inside && (path[length] == '/' || path[length] == '\0') ? path + length : NULL;
}

static bool read_number(struct document *document, const struct member *member, double *value)
{
    const char *name = member->name + (member->name[0] == '/');
    return xml_rows_number(&document->xml, name, document->text, member->low, member->high, value);
}

static void read_interval(struct document *document, const struct member *member, const char *end)
{
    struct interval *interval = (void *)((char *)document + member->offset);
    double value;
    if (*end == '\0' || !read_number(document, member, &value))
        return;
    if (strcmp(end, "/intervalEnd") != 0)
        interval->low = value;
    if (strcmp(end, "/intervalStart") != 0)
        interval->high = value;
}

static void fail_interval(struct document *document, const char *name, struct interval interval,
                          const char *expectation)
{
    char text[80];
    snprintf(text, sizeof text, "[%.9g, %.9g]", interval.low, interval.high);
    fail(document, name, text, expectation);
}

/* The middle, or UNSAID; false after a message. */
static bool take(struct document *document, const char *name, struct interval interval,
                 double *value)
{
    *value = 0.5 * (interval.low + interval.high);
    if (interval.low <= interval.high || (isnan(interval.low) && isnan(interval.high)))
        return true;
    fail_interval(document, name, interval, "both ends of an interval, the lower one first");
    return false;
}

/* ---- shapes and positions ---- */

static void join(double *middle, double *size, double other, double other_size)
{
    double low = *middle - *size / 2, high = *middle + *size / 2;
    low = low < other - other_size / 2 ? low : other - other_size / 2;
    high = high > other + other_size / 2 ? high : other + other_size / 2;
    *middle = (low + high) / 2;
    *size = high - low;
}

/* The first part makes the region, so that its numbers stay as they are. */
static void add_part(struct document *document, struct region *region)
{
    const struct part part = document->part;
    double cosine = fabs(elementary_cos(part.orientation_rad));
    double sine = fabs(elementary_sin(part.orientation_rad));
    double length_m = part.length_m * cosine + part.width_m * sine + 2 * part.radius_m;
    double width_m = part.length_m * sine + part.width_m * cosine + 2 * part.radius_m;
    document->part = no_part;
    if (isnan(region->length_m)) {
        *region = (struct region){part.x_m, part.y_m, length_m, width_m};
        return;
    }
    join(&region->x_m, &region->length_m, part.x_m, length_m);
    join(&region->y_m, &region->width_m, part.y_m, width_m);
}

/* An element inside a region has ended. Without a centre, a part of a shape lies in its origin. */
static void end_in_region(struct document *document, struct region *region, const char *name)
{
    struct part *part = &document->part;
    bool is_point = strcmp(name, "point") == 0;
    if (is_point || strcmp(name, "rectangle") == 0 || strcmp(name, "circle") == 0) {
        if (isnan(part->x_m) && isnan(part->y_m) && region == &document->shape && !is_point)
            part->x_m = part->y_m = 0;
        if (isnan(part->x_m) || isnan(part->y_m))
            fail(document, isnan(part->x_m) ? "x" : "y", NULL, "a number");
        add_part(document, region);
        return;
    }
    for (size_t i = 0; i < OF_PARTS; i++) {
        double value;
        if (strcmp(of_parts[i].name, name) == 0 && read_number(document, &of_parts[i], &value))
            memcpy((char *)document + of_parts[i].offset, &value, sizeof value);
    }
}

/* ---- states become rows ---- */

/* velocity is along the yaw and velocityY to its left, unless a slip angle turns the velocity. The
 * two are along x and y where there is no yaw. */
static bool take_velocity(struct document *document, struct recorded_row *row)
{
    const struct state *state = &document->state;
    double ahead_mps, left_mps, slip_rad;
    if (!take(document, "velocity", state->velocity, &ahead_mps) ||
        !take(document, "velocityY", state->lateral, &left_mps) ||
        !take(document, "slipAngle", state->slip, &slip_rad))
        return false;
    struct vec2 heading = vec2_heading(isnan(row->yaw_rad) ? 0 : row->yaw_rad);
    if (isnan(left_mps)) {
        slip_rad = isnan(slip_rad) ? 0 : slip_rad;
        left_mps = isnan(row->yaw_rad) ? UNSAID : ahead_mps * elementary_sin(slip_rad);
        ahead_mps *= elementary_cos(slip_rad);
    }
    row->speed_mps = ahead_mps;
    row->vx_mps = ahead_mps * heading.x - left_mps * heading.y + 0.0; /* never -0 */
    row->vy_mps = ahead_mps * heading.y + left_mps * heading.x + 0.0;
    return true;
}

/* Moves a row from the point that states are of to the middle of a shape that lies off it. */
static void shift(const struct region *shape, struct recorded_row *row)
{
    struct vec2 heading = vec2_heading(row->yaw_rad);
    row->x_m += shape->x_m * heading.x - shape->y_m * heading.y;
    row->y_m += shape->x_m * heading.y + shape->y_m * heading.x;
    row->vx_mps = row->vy_mps = UNSAID;
}

/* Refuses an obstacle that lacks what a row needs. */
static bool is_whole(struct document *document, const struct recorded_row *row, double time)
{
    const struct region *shape = &document->shape;
    const struct {
        bool missing;
        const char *what, *expectation;
    } needs[] = {
        {document->type[0] == '\0', "type", "one before the states of an obstacle"},
        {isnan(shape->length_m), "shape", "one before the states of an obstacle"},
        {isnan(document->position.length_m), "position", "a point, or a region with a middle"},
        {isnan(time), "time", "a whole number of steps"},
        {isnan(row->yaw_rad) && (shape->x_m != 0 || shape->y_m != 0), "orientation",
         "one, as the middle of the shape is not its origin"},
    };
    for (size_t i = 0; i < sizeof needs / sizeof *needs; i++)
        if (needs[i].missing)
            fail(document, needs[i].what, NULL, needs[i].expectation);
    if (document->state.time.low < document->state.time.high || time > floor(time))
        fail_interval(document, "time", document->state.time, "a whole number of steps");
    return document->xml.fault.code == DIAG_OK;
}

static bool fill_row(struct document *document, struct recorded_row *row)
{
    const struct state *state = &document->state;
    const struct region *shape = &document->shape;
    double time = UNSAID;
    *row = recorded_row_unsaid;
    row->place = xml_rows_line(&document->xml);
    row->x_m = document->position.x_m;
    row->y_m = document->position.y_m;
    row->length_m = shape->length_m;
    row->width_m = shape->width_m;
    if (!take(document, "time", state->time, &time) ||
        !take(document, "orientation", state->orientation, &row->yaw_rad) ||
        !take(document, "yawRate", state->yaw_rate, &row->yaw_rate_radps) ||
        !take_velocity(document, row) || !is_whole(document, row, time))
        return false;
    row->time_ns = recorded_row_time_ns(time * document->step_s, 1);
    if (shape->x_m != 0 || shape->y_m != 0)
        shift(shape, row);
    return true;
}

static void end_state(struct document *document)
{
    struct xml_rows *xml = &document->xml;
    struct arena *arena = document->still ? document->arena : &xml->arena;
    struct recorded_row row;
    if (!fill_row(document, &row))
        return;
    row.id = arena_text(arena, document->id, strlen(document->id));
    row.class = arena_text(arena, document->type, strlen(document->type));
    if (document->still) {
        row.vx_mps = row.vy_mps = row.yaw_rate_radps = 0;
        *list_add(&document->stills, arena) = row;
    } else {
        intern_number(&document->steps, &row.time_ns, sizeof row.time_ns, document->arena);
        *list_add(&xml->events, arena) = (struct xml_event){RECORDED_ROW, row};
    }
    document->state = unsaid;
    document->position.length_m = UNSAID;
}

/* ---- elements ---- */

static void begin_root(struct document *document, const char *name, const char **attributes)
{
    const char *version = xml_rows_attribute(attributes, "commonRoadVersion");
    const char *step = xml_rows_attribute(attributes, "timeStepSize");
    struct xml_rows *xml = &document->xml;
    if (strcmp(name, "commonRoad") != 0)
        fail(document, "<commonRoad>", NULL, "a scenario of CommonRoad");
    else if (version == NULL || (strcmp(version, "2018b") != 0 && strcmp(version, "2020a") != 0))
        fail(document, "commonRoadVersion", version, "2018b or 2020a");
    else
        xml->in_root = xml_rows_number(xml, "timeStepSize", step, 1e-6, 1e3, &document->step_s);
}

static void begin_obstacle(struct document *document, const char *name, const char **attributes)
{
    const char *id = xml_rows_attribute(attributes, "id");
    document->still = strcmp(name, "staticObstacle") == 0;
    document->in_obstacle =
        document->still || strcmp(name, "obstacle") == 0 || strcmp(name, "dynamicObstacle") == 0;
    if (!document->in_obstacle)
        return;
    if (id != NULL && recorded_row_name_fits(id))
        memcpy(document->id, id, strlen(id) + 1);
    else
        fail(document, "id", id, "1 to 1024 printable ASCII characters");
    document->type[0] = '\0';
    document->shape.length_m = document->position.length_m = UNSAID;
    document->state = unsaid;
    document->part = no_part;
}

static void begin_inside(struct document *document, const char *name)
{
    size_t length = strlen(name);
    if (document->path_length + length + 2 > PATH_SIZE) {
        fail(document, "an element", name, "512 bytes of names around it at most");
        return;
    }
    document->path[document->path_length++] = '/';
    memcpy(document->path + document->path_length, name, length + 1);
    document->path_length += length;
}

static void on_begin(void *context, const char *name, const char **attributes)
{
    struct document *document = context;
    document->text_length = 0;
    if (document->in_obstacle)
        begin_inside(document, name);
    else if (document->depth == 0)
        begin_root(document, name, attributes);
    else if (document->depth == 1)
        begin_obstacle(document, name, attributes);
    document->depth++;
}

static void end_in_state(struct document *document, const char *path, const char *name)
{
    if (*path == '\0')
        end_state(document);
    else if (below(path, "/position") != NULL)
        end_in_region(document, &document->position, name);
    else
        for (size_t i = 0; i < OF_STATES; i++)
            if (below(path, of_states[i].name) != NULL)
                read_interval(document, &of_states[i], below(path, of_states[i].name));
}

static void read_role(struct document *document)
{
    document->still = strcmp(document->text, "static") == 0;
    if (!document->still && strcmp(document->text, "dynamic") != 0)
        fail(document, "role", document->text, "static or dynamic");
}

static void end_inside(struct document *document, const char *name)
{
    const char *path = document->path, *text = document->text;
    const char *initial = below(path, "/initialState"), *later = below(path, "/trajectory/state");
    if (initial != NULL || later != NULL)
        end_in_state(document, initial != NULL ? initial : later, name);
    else if (below(path, "/shape") != NULL)
        end_in_region(document, &document->shape, name);
    else if (strcmp(path, "/type") == 0 && recorded_row_name_fits(text))
        memcpy(document->type, text, strlen(text) + 1);
    else if (strcmp(path, "/role") == 0)
        read_role(document);
}

static void on_end(void *context, const char *name)
{
    struct document *document = context;
    while (document->text_length > 0 && is_white(document->text[document->text_length - 1]))
        document->text_length--;
    document->text[document->text_length] = '\0';
    document->text_length = 0;
    document->depth--;
    document->in_obstacle = document->in_obstacle && document->depth > 1;
    if (!document->in_obstacle)
        return;
    end_inside(document, name);
    document->path_length -= strlen(name) + 1;
    document->path[document->path_length] = '\0';
}

/* White space before a text is left out, so that there is none between elements. */
static void on_text(void *context, const char *text, int length)
{
    struct document *document = context;
    for (int i = 0; i < length && document->in_obstacle; i++) {
        if (document->text_length == 0 && is_white(text[i]))
            continue;
        if (document->text_length + 1 < NAME_SIZE)
            document->text[document->text_length++] = text[i];
        else
            fail(document, "a text", document->id, "1024 bytes at most");
    }
}

/* ---- the format ---- */

static void fail_at_end(struct xml_rows *xml)
{
    diag_fail(&xml->fault, DIAG_DATA, "line %zu: the file ends before </commonRoad>",
              xml_rows_line(xml));
}

/* Behind the file, what stands still comes in the steps of all others. */
static int next_event(void *state, struct recorded_row *row, struct diag *diag)
{
    struct document *document = state;
    int event = xml_rows_next(&document->xml, row, diag);
    if (event != RECORDED_END || document->steps.list.count == 0 ||
        document->still_given == document->stills.count)
        return event;
    *row = document->stills.items[document->still_given];
    memcpy(&row->time_ns, intern_text(&document->steps, document->step_given++),
           sizeof row->time_ns);
    if (document->step_given == document->steps.list.count) {
        document->step_given = 0;
        document->still_given++;
    }
    return RECORDED_ROW;
}

static void close_document(void *state)
{
    struct document *document = state;
    xml_rows_close(&document->xml);
}

static const struct recorded_word words[] = {
#define COMMONROAD(word, class) {word, class, 0, 0, 0},
#include "traffic/recorded_classes.def"
    {0},
};

static const struct recorded_format format = {
    .name = "a scenario of CommonRoad",
    .id_name = "id",
    .place = "line",
    .words = words,
    .next = next_event,
    .close = close_document,
};

/* ---- the stage ---- */

static int traffic_commonroad_start(void *state, struct runner *runner)
{
    struct traffic_commonroad *own = state;
    struct document *document = &own->document;
    struct diag *diag = runner_diag(runner);
    struct input *input = runner_input(runner, own->source);
    if (input == NULL)
        return diag_prefix(diag, "%s: ", own->source);
    xml_rows_begin(&document->xml, "commonroad", input, document);
    XML_SetElementHandler(document->xml.parser, on_begin, on_end);
    XML_SetCharacterDataHandler(document->xml.parser, on_text);
    document->xml.fail_at_end = fail_at_end;
    document->arena = runner_arena(runner);
    struct recorded_reader reader = {&format, document};
    return recording_open(&own->recording, reader, own->source, &own->options, false,
                          document->arena, diag);
}

static int traffic_commonroad_next(void *state, struct frame *frame, struct runner *runner)
{
    struct traffic_commonroad *own = state;
    return recording_next(&own->recording, frame, runner_diag(runner));
}

static int traffic_commonroad_locate_fault(void *state, const struct frame *frame,
                                           struct runner *runner)
{
    const struct traffic_commonroad *own = state;
    return recording_check(&own->recording, frame, runner_diag(runner));
}

static void traffic_commonroad_release(void *state)
{
    struct traffic_commonroad *own = state;
    recording_close(&own->recording);
}

static const struct field traffic_commonroad_fields[] = {
    {FIELD_NAME_OF(struct traffic_commonroad, source,
                   "a scenario of CommonRoad, plain or gzip; - is standard input")},
    {FIELD_RECORD_OF(struct traffic_commonroad, options, &recording_options_record, ""),
     FIELD_OPTIONAL},
    {0},
};

#define COMMONROAD(word, class) "\n    " word " = " class

const struct stage stage_traffic_commonroad = {
    .name = "traffic-commonroad",
    .summary = "Play the obstacles of a CommonRoad scenario, frame by frame.",
    .details =
        "The XML is of version 2018b or 2020a. An ego is an obstacle by its id; planning problems\n"
        "have no motion. A value is exact or an interval, a position a point or a region: their\n"
        "middles count. The body is the box around the parts of the shape. Its velocity is that\n"
        "of the file: velocity along the orientation, velocityY to its left or slipAngle; it is\n"
        "taken from the places where the box's middle is not the point that positions are of.\n"
        "Obstacles that stand still are there in every step. Obstacles of the environment,\n"
        "phantoms and occupancy sets are left out.\n"
        "\n"
        "What types of obstacles mean:"
#include "traffic/recorded_classes.def"
    ,
    .options = STAGE_OPTIONS(struct traffic_commonroad, traffic_commonroad_fields),
    .operand = "SOURCE",
    .writes = SECTION_OBJECTS,
    .start = traffic_commonroad_start,
    .next = traffic_commonroad_next,
    .locate_fault = traffic_commonroad_locate_fault,
    .release = traffic_commonroad_release,
};
