#include "commonroad_rows.h"

#include <stdio.h>

#include "base/elementary.h"
#include "base/intern.h"
#include "base/vec2.h"
#include "text/field.h"
#include "xml_rows.h"

#define UNSAID ((double)NAN)
#define BLANKS " \t\r\n"

enum { PATH_SIZE = 512, NAME_SIZE = FIELD_NAME_SIZE + 1, STEPS = 1000000 };

/* An exact value or an interval. */
struct interval {
    double low, high;
};

struct state {
    struct interval time, orientation, velocity, lateral, slip, yaw_rate;
};

/* A rectangle, a circle or a point; or the box around several, along the axes. */
struct area {
    double x_m, y_m, length_m, width_m, orientation_rad, radius_m;
    unsigned said; /* bit i: members[i] of a part was read */
    bool ended;    /* the shape or position was read */
};

struct document {
    struct xml_rows xml; /* first: xml_rows_close closes it */
    double step_s;
    size_t depth;         /* number of open elements */
    char path[PATH_SIZE]; /* of the open elements in an obstacle, "/shape/rectangle" */
    char text[NAME_SIZE]; /* of the element opened last, without white space before it */
    size_t path_length, text_length;
    bool in_obstacle, still;
    unsigned ended;                      /* bit i: single_elements[i] of the obstacle was read */
    char id[NAME_SIZE], type[NAME_SIZE]; /* of the obstacle; empty: not read yet */
    struct area shape, position, part;   /* part is added to shape or position at its end */
    struct state state;
    struct arena *arena;                 /* of the members below, kept until the end */
    struct intern ids;                   /* of the obstacles so far */
    LIST_OF(struct recorded_row) stills; /* obstacles that stand still */
    struct intern steps;                 /* times of all others */
    size_t still_given;                  /* number of stills given in every step */
    uint32_t step_given;                 /* number of steps in which the next still was given */
};

static const struct state no_state = {{UNSAID, UNSAID}, {UNSAID, UNSAID}, {UNSAID, UNSAID},
                                      {UNSAID, UNSAID}, {UNSAID, UNSAID}, {UNSAID, UNSAID}};
static const struct area no_part = {.x_m = UNSAID, .y_m = UNSAID};
static const struct area no_area = {.length_m = UNSAID};

static void fail(struct document *document, const char *what, const char *value,
                 const char *expectation)
{
    xml_rows_fail(&document->xml, what, value, expectation);
}

/* ---- values ---- */

/* Intervals by their paths in a state; numbers of a part by the names of their elements. */
static const struct member {
    const char *name;
    size_t offset;
    double low, high;
    bool whole;
} members[] = {
    {"/time", offsetof(struct document, state.time), 0, STEPS, true},
    {"/orientation", offsetof(struct document, state.orientation), -1e3, 1e3, false},
    {"/velocity", offsetof(struct document, state.velocity), -1e4, 1e4, false},
    {"/velocityY", offsetof(struct document, state.lateral), -1e4, 1e4, false},
    {"/slipAngle", offsetof(struct document, state.slip), -1e3, 1e3, false},
    {"/yawRate", offsetof(struct document, state.yaw_rate), -1e3, 1e3, false},
    {"x", offsetof(struct document, part.x_m), -1e9, 1e9, false},
    {"y", offsetof(struct document, part.y_m), -1e9, 1e9, false},
    {"length", offsetof(struct document, part.length_m), 0, 1e6, false},
    {"width", offsetof(struct document, part.width_m), 0, 1e6, false},
    {"orientation", offsetof(struct document, part.orientation_rad), -1e3, 1e3, false},
    {"radius", offsetof(struct document, part.radius_m), 0, 1e6, false},
};

enum { MEMBERS = sizeof members / sizeof *members };
_Static_assert(MEMBERS <= 32, "area.said has a bit for each");

/* The rest of a path below an element, or NULL if the path is not below it. */
static const char *below(const char *path, const char *element)
{
    size_t length = strlen(element);
    bool inside = strncmp(path, element, length) == 0;
    return inside && (path[length] == '/' || path[length] == '\0') ? path + length : NULL;
}

/* Reads an end of an interval, or checks the whole interval at its own end (end is ""). */
static void end_interval(struct document *document, const struct member *member, const char *end)
{
    struct interval *interval = (void *)((char *)document + member->offset);
    const char *name = member->name + 1;
    double value;
    if (*end == '\0' && !(interval->low <= interval->high))
        fail(document, name, NULL, "an exact value, or both ends of an interval, which ascend");
    if (*end == '\0' ||
        !xml_rows_number(&document->xml, name, document->text, member->low, member->high, &value))
        return;
    if (member->whole && value != floor(value))
        fail(document, name, document->text, "a whole number");
    bool low = strcmp(end, "/intervalEnd") != 0, high = strcmp(end, "/intervalStart") != 0;
    if ((low && !isnan(interval->low)) || (high && !isnan(interval->high)))
        fail(document, name, document->text, "a single value");
    interval->low = low ? value : interval->low;
    interval->high = high ? value : interval->high;
}

static void end_number(struct document *document, size_t number)
{
    const struct member *member = &members[number];
    double value;
    if ((document->part.said >> number & 1) != 0)
        fail(document, member->name, document->text, "a single value");
    document->part.said |= 1u << number;
    if (xml_rows_number(&document->xml, member->name, document->text, member->low, member->high,
                        &value))
        memcpy((char *)document + member->offset, &value, sizeof value);
}

static double middle(struct interval interval)
{
    return 0.5 * (interval.low + interval.high);
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

/* Widens the area to hold the part too. The first part becomes the area without any rounding. A
 * part of a shape that has no centre lies at the origin. */
static void end_part(struct document *document, struct area *area, bool is_point)
{
    struct area part = document->part;
    document->part = no_part;
    if (isnan(part.x_m) && isnan(part.y_m) && area == &document->shape && !is_point)
        part.x_m = part.y_m = 0;
    if (isnan(part.x_m) || isnan(part.y_m))
        fail(document, isnan(part.x_m) ? "x" : "y", NULL, "a number");
    double cosine = fabs(elementary_cos(part.orientation_rad));
    double sine = fabs(elementary_sin(part.orientation_rad));
    double length_m = part.length_m * cosine + part.width_m * sine + 2 * part.radius_m;
    double width_m = part.length_m * sine + part.width_m * cosine + 2 * part.radius_m;
    if (isnan(area->length_m)) {
        *area = (struct area){.x_m = part.x_m, .y_m = part.y_m, length_m, width_m};
        return;
    }
    join(&area->x_m, &area->length_m, part.x_m, length_m);
    join(&area->y_m, &area->width_m, part.y_m, width_m);
}

static void end_in_area(struct document *document, struct area *area, const char *name)
{
    bool is_point = strcmp(name, "point") == 0;
    if (is_point || strcmp(name, "rectangle") == 0 || strcmp(name, "circle") == 0)
        end_part(document, area, is_point);
    for (size_t i = 0; i < MEMBERS; i++)
        if (strcmp(members[i].name, name) == 0)
            end_number(document, i);
    if (area->ended)
        fail(document, "a second element", area == &document->shape ? "shape" : "position", "one");
    area->ended = strcmp(name, "shape") == 0 || strcmp(name, "position") == 0;
}

/* ---- states become rows ---- */

/* velocity is along the yaw and velocityY to its left; without velocityY the slip angle turns
 * velocity. Without a yaw the two are along x and y. */
static void set_velocity(const struct state *state, struct recorded_row *row)
{
    double ahead_mps = middle(state->velocity), left_mps = middle(state->lateral);
    double slip_rad = isnan(middle(state->slip)) ? 0 : middle(state->slip);
    struct vec2 heading = vec2_heading(isnan(row->yaw_rad) ? 0 : row->yaw_rad);
    if (isnan(left_mps)) {
        left_mps = isnan(row->yaw_rad) ? UNSAID : ahead_mps * elementary_sin(slip_rad);
        ahead_mps *= elementary_cos(slip_rad);
    }
    row->speed_mps = ahead_mps;
    row->vx_mps = ahead_mps * heading.x - left_mps * heading.y + 0.0; /* never -0 */
    row->vy_mps = ahead_mps * heading.y + left_mps * heading.x + 0.0;
}

/* Moves a row from the reference point of the states to the middle of the shape. If the two differ,
 * the velocity is not known. */
static void centre(const struct area *shape, struct recorded_row *row)
{
    if (shape->x_m == 0 && shape->y_m == 0)
        return;
    struct vec2 heading = vec2_heading(row->yaw_rad);
    row->x_m += shape->x_m * heading.x - shape->y_m * heading.y;
    row->y_m += shape->x_m * heading.y + shape->y_m * heading.x;
    row->vx_mps = row->vy_mps = UNSAID;
}

static bool is_there(struct document *document, const char *name, double value)
{
    if (isnan(value))
        fail(document, name, NULL, "one for every state; type and shape stand before the states");
    return !isnan(value);
}

static bool fill_row(struct document *document, struct recorded_row *row)
{
    const struct area *shape = &document->shape, *position = &document->position;
    double steps = middle(document->state.time);
    *row = recorded_row_unsaid;
    row->yaw_rad = middle(document->state.orientation);
    if (!is_there(document, "type", document->type[0] == '\0' ? UNSAID : 0) ||
        !is_there(document, "shape", shape->length_m) ||
        !is_there(document, "position", position->length_m) || !is_there(document, "time", steps) ||
        !is_there(document, "orientation", shape->x_m != 0 || shape->y_m != 0 ? row->yaw_rad : 0))
        return false;
    row->time_ns = recorded_row_time_ns(steps * document->step_s, 1);
    row->place = xml_rows_line(&document->xml);
    row->x_m = position->x_m;
    row->y_m = position->y_m;
    row->length_m = shape->length_m;
    row->width_m = shape->width_m;
    row->yaw_rate_radps = middle(document->state.yaw_rate);
    set_velocity(&document->state, row);
    centre(shape, row);
    return true;
}

static void end_state(struct document *document)
{
    struct arena *arena = document->still ? document->arena : &document->xml.arena;
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
        *list_add(&document->xml.events, arena) = (struct xml_event){RECORDED_ROW, row};
    }
    document->state = no_state;
    document->position = no_area;
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
    document->type[0] = '\0';
    document->ended = 0;
    document->shape = document->position = no_area;
    document->state = no_state;
    document->part = no_part;
    if (!document->in_obstacle)
        return;
    size_t known = document->ids.list.count;
    if (id == NULL || !recorded_row_name_fits(id))
        fail(document, "id", id, "1 to 1024 printable ASCII characters");
    else if (intern_word(&document->ids, id, document->arena) < known)
        fail(document, "id", id, "one that no obstacle above has");
    else
        memcpy(document->id, id, strlen(id) + 1);
}

static void on_begin(void *context, const char *name, const char **attributes)
{
    struct document *document = context;
    size_t room = PATH_SIZE - document->path_length;
    if (document->text_length > 0)
        fail(document, "an element", name, "no text before it in the element around it");
    document->text_length = 0;
    document->depth++;
    if (document->in_obstacle && strlen(name) + 2 <= room)
        document->path_length +=
            (size_t)snprintf(document->path + document->path_length, room, "/%s", name);
    else if (document->in_obstacle)
        fail(document, "an element", name, "512 bytes of names around it at most");
    else if (document->depth == 1)
        begin_root(document, name, attributes);
    else if (document->depth == 2)
        begin_obstacle(document, name, attributes);
}

static void end_in_state(struct document *document, const char *path, const char *name)
{
    if (strcmp(path, "/position/point") == 0 && !isnan(document->position.length_m))
        fail(document, "a second element", name, "one");
    if (*path == '\0')
        end_state(document);
    else if (below(path, "/position") != NULL)
        end_in_area(document, &document->position, name);
    for (size_t i = 0; i < MEMBERS; i++)
        if (below(path, members[i].name) != NULL)
            end_interval(document, &members[i], below(path, members[i].name));
}

/* Refuses a second element of a kind that an obstacle may have only once. */
static void end_single(struct document *document, const char *name)
{
    static const char *const single_elements[] = {"/type", "/role", "/initialState", "/trajectory"};
    for (unsigned i = 0; i < sizeof single_elements / sizeof single_elements[0]; i++) {
        if (strcmp(document->path, single_elements[i]) != 0)
            continue;
        if ((document->ended & 1U << i) != 0)
            fail(document, "a second element", name, "one");
        document->ended |= 1U << i;
    }
}

static void end_inside(struct document *document, const char *name)
{
    end_single(document, name);
    const char *path = document->path, *text = document->text;
    const char *initial = below(path, "/initialState"), *later = below(path, "/trajectory/state");
    if (initial != NULL || later != NULL)
        end_in_state(document, initial != NULL ? initial : later, name);
    else if (below(path, "/shape") != NULL)
        end_in_area(document, &document->shape, name);
    else if (strcmp(path, "/type") == 0 && recorded_row_name_fits(text))
        memcpy(document->type, text, strlen(text) + 1);
    else if (strcmp(path, "/role") == 0 && strcmp(text, "static") == 0)
        document->still = true;
    else if (strcmp(path, "/role") == 0 && strcmp(text, "dynamic") != 0)
        fail(document, "role", text, "static or dynamic");
}

static void on_end(void *context, const char *name)
{
    struct document *document = context;
    while (document->text_length > 0 &&
           strchr(BLANKS, document->text[document->text_length - 1]) != NULL)
        document->text_length--;
    document->text[document->text_length] = '\0';
    document->text_length = 0;
    document->in_obstacle = --document->depth > 1 && document->in_obstacle;
    if (!document->in_obstacle)
        return;
    end_inside(document, name);
    document->path_length -= strlen(name) + 1;
    document->path[document->path_length] = '\0';
}

static void on_text(void *context, const char *text, int length)
{
    struct document *document = context;
    for (int i = 0; i < length && document->in_obstacle; i++)
        if (document->text_length + 1 == NAME_SIZE)
            fail(document, "a text", document->id, "1024 bytes at most");
        else if (document->text_length > 0 || strchr(BLANKS, text[i]) == NULL)
            document->text[document->text_length++] = text[i];
}

static void fail_at_end(struct xml_rows *xml)
{
    diag_fail(&xml->fault, DIAG_DATA, "line %zu: the file ends before </commonRoad>",
              xml_rows_line(xml));
}

/* ---- the reader ---- */

/* Gives the rows of the file, and then every obstacle that stands still in each step of the others.
 */
static int next_event(void *state, struct recorded_row *row, struct diag *diag)
{
    struct document *document = state;
    int event = xml_rows_next(&document->xml, row, diag);
    if (event == RECORDED_END && document->steps.list.count == 0 && document->stills.count > 0)
        return diag_fail(diag, DIAG_DATA,
                         "nothing moves: all %zu obstacles are static, and no state of another "
                         "gives a time; expected a dynamic obstacle",
                         document->stills.count);
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

static const struct recorded_word words[] = {
#define COMMONROAD RECORDED_WORD
#include "commonroad_classes.def"
    {0},
};

static const struct recorded_format format = {
    .name = "a scenario of CommonRoad",
    .id_name = "id",
    .place = "line",
    .words = words,
    .next = next_event,
    .close = xml_rows_close,
};

struct recorded_reader commonroad_rows_open(struct input *input, struct arena *arena)
{
    struct document *document = arena_get(arena, sizeof *document);
    struct xml_rows *xml = &document->xml;
    xml_rows_begin(xml, "commonroad", input, document);
    xml->fail_at_end = fail_at_end;
    XML_SetElementHandler(xml->parser, on_begin, on_end);
    XML_SetCharacterDataHandler(xml->parser, on_text);
    document->arena = arena;
    return (struct recorded_reader){&format, document};
}
