#include "recorded/recorded_layouts.h"

#include <assert.h>
#include <ctype.h>
#include <stdio.h>

#include "base/intern.h"
#include "base/units.h"
#include "base/vec2.h"
#include "text/csv_table.h"

#define COLUMN(name, kind, need, member, low, high, scale, shift)                                  \
    {                                                                                              \
        name, kind, need, offsetof(struct recorded_cells, member), low, high, scale, shift         \
    }
#define ID(name) COLUMN(name, RECORDED_NAME, RECORDED_NEEDED, row.id, 0, 0, 0, 0)
#define CLASS(name, need) COLUMN(name, RECORDED_NAME, need, row.class, 0, 0, 0, 0)
#define RECORDING(name) COLUMN(name, RECORDED_ALIKE, RECORDED_OPTIONAL, row.id, 0, 0, 0, 0)
#define TIME(name, unit_s)                                                                         \
    COLUMN(name, RECORDED_TIME, RECORDED_NEEDED, row.time_ns, 0, 0, unit_s, 0)
#define FRAME(name) COLUMN(name, RECORDED_FRAMES, RECORDED_NEEDED, row.time_ns, 0, 1e9, 1, 0)
#define VALUE(name, member, need, low, high, scale, shift)                                         \
    COLUMN(name, RECORDED_NUMBER, need, row.member, low, high, scale, shift)
#define PLACE(name, member, sign) VALUE(name, member, RECORDED_NEEDED, -1e9, 1e9, sign, 0)
#define SPEED(name, member, sign) VALUE(name, member, RECORDED_NEEDED, -1e4, 1e4, sign, 0)
#define SIZE(name, member, need) VALUE(name, member, need, 0, 1e6, 1, 0)
#define ASIDE(name, index)                                                                         \
    COLUMN(name, RECORDED_NUMBER, RECORDED_NEEDED, aside[index], -1e6, 1e6, 1, 0)

/* ---- SUMO: floating car data ---- */

/* In both spellings of its columns. The place is the middle of the front bumper, the angle in
 * degrees clockwise from north. The speed serves where there is only one step: velocities are those
 * of the places. Rows ascend in time. Steps without anyone are not in a table. */
#define SUMO_COLUMNS(table, prefix, time)                                                          \
    static const struct recorded_column table[] = {                                                \
        ID(prefix "id"),                                                                           \
        TIME(time, 1),                                                                             \
        CLASS(prefix "type", RECORDED_OPTIONAL),                                                   \
        PLACE(prefix "x", x_m, 1),                                                                 \
        PLACE(prefix "y", y_m, 1),                                                                 \
        VALUE(prefix "angle", yaw_rad, RECORDED_NEEDED, -1e3, 1e3, -PI / 180, -90),                \
        VALUE(prefix "speed", speed_mps, RECORDED_OPTIONAL, -1e4, 1e4, 1, 0),                      \
        VALUE(prefix "z", z_m, RECORDED_OPTIONAL, -1e9, 1e9, 1, 0),                                \
        COLUMN(prefix "lane", RECORDED_WORDS, RECORDED_OPTIONAL, row.lane, 0, 0, 0, 0),            \
        {.name = NULL}}
SUMO_COLUMNS(sumo_vehicles, "vehicle_", "timestep_time");
SUMO_COLUMNS(sumo_persons, "person_", "timestep_time");
SUMO_COLUMNS(sumo_containers, "container_", "timestep_time");
SUMO_COLUMNS(sumo_plain, "", "time");

static const struct recorded_word sumo_words[] = {
#define SUMO(word, class, length_m, width_m, height_m) {word, class, length_m, width_m, height_m},
#include "recorded/recorded_classes.def"
    {0},
};

#define SUMO_FORMAT                                                                                \
    {                                                                                              \
        .name = "a table of SUMO", .id_name = "id", .by_time = true, .words = sumo_words,          \
        .of_sumo = true                                                                            \
    }

/* ---- inD, rounD, exiD and uniD ---- */

/* Headings are in degrees, sizes of pedestrians and bicycles are 0, and a trailer is a track beside
 * that of its vehicle. Rows stand by track. */
static const struct recorded_column ind_columns[] = {
    ID("trackId"),
    RECORDING("recordingId"),
    FRAME("frame"),
    PLACE("xCenter", x_m, 1),
    PLACE("yCenter", y_m, 1),
    VALUE("heading", yaw_rad, RECORDED_NEEDED, -1e3, 1e3, PI / 180, 0),
    SIZE("width", width_m, RECORDED_NEEDED),
    SIZE("length", length_m, RECORDED_NEEDED),
    SPEED("xVelocity", vx_mps, 1),
    SPEED("yVelocity", vy_mps, 1),
    {0},
};

static const struct recorded_word ind_words[] = {
#define IND RECORDED_WORD
#include "recorded/recorded_classes.def"
    {0},
};

/* ---- highD ---- */

/* Axes of an image, x to the right and y down, and of a box its upper left corner. Its width is the
 * length of the vehicle. Rows stand by track. */
static const struct recorded_column highd_columns[] = {
    ID("id"),
    FRAME("frame"),
    PLACE("x", x_m, 1),
    PLACE("y", y_m, -1),
    SIZE("width", length_m, RECORDED_NEEDED),
    SIZE("height", width_m, RECORDED_NEEDED),
    SPEED("xVelocity", vx_mps, 1),
    SPEED("yVelocity", vy_mps, -1),
    {0},
};

static const struct recorded_word highd_words[] = {
#define HIGHD RECORDED_WORD
#include "recorded/recorded_classes.def"
    {0},
};

static void complete_highd(struct recorded_cells *cells)
{
    struct recorded_row *row = &cells->row;
    row->x_m += row->length_m / 2;
    row->y_m -= row->width_m / 2;
}

/* ---- NGSIM ---- */

/* In feet, of the middle of the front bumper. Local_Y points along the road and Local_X to its
 * right. There are no headings; ids come again for other vehicles. Frames of two files begin with
 * the same number, so that the stamp is read where there is one. */
#define FOOT_M 0.3048
#define FEET(name, member, low, scale)                                                             \
    VALUE(name, member, RECORDED_NEEDED, low, 1e9, (scale)*FOOT_M, 0)

static const struct recorded_column ngsim_columns[] = {
    ID("Vehicle_ID"),
    RECORDING("Location"),
    TIME("Global_Time", 1e-3),
    TIME("Frame_ID", 0.1),
    CLASS("v_Class", RECORDED_NEEDED),
    FEET("Local_Y", x_m, -1e9, 1),
    FEET("Local_X", y_m, -1e9, -1),
    FEET("v_Length", length_m, 0, 1),
    FEET("v_Width", width_m, 0, 1),
    {0},
};

const char *const recorded_layouts_ngsim_names[] = {
    "Vehicle_ID", "Frame_ID",  "Total_Frames",  "Global_Time",  "Local_X", "Local_Y", "Global_X",
    "Global_Y",   "v_Length",  "v_Width",       "v_Class",      "v_Vel",   "v_Acc",   "Lane_ID",
    "Preceding",  "Following", "Space_Headway", "Time_Headway", NULL};

static const struct recorded_word ngsim_words[] = {
#define NGSIM RECORDED_WORD
#include "recorded/recorded_classes.def"
    {0},
};

/* ---- esmini: the log of --csv_logger ---- */

/* A row for each step, with columns for everybody. The place is that of the reference point,
 * usually below the rear axle, and the box lies around another. The log says no classes, so they
 * are those of the names, or else follow from the box. Before version 2.37.5 esmini wrote
 * "Entitity"; its first logs have other units, places without one. */
enum { BOX_X, BOX_Y };

static const struct recorded_column esmini_columns[] = {
    ID("Entity_Name [-]"),
    ID("Entitity_Name [-]"),
    CLASS("Entity_Name [-]", RECORDED_NEEDED),
    CLASS("Entitity_Name [-]", RECORDED_NEEDED),
    TIME("TimeStamp [s]", 1),
    TIME("TimeStamp [sec]", 1),
    PLACE("World_Position_X [m]", x_m, 1),
    PLACE("World_Position_X [-]", x_m, 1),
    PLACE("World_Position_Y [m]", y_m, 1),
    PLACE("World_Position_Y [-]", y_m, 1),
    VALUE("World_Position_Z [m]", z_m, RECORDED_OPTIONAL, -1e9, 1e9, 1, 0),
    VALUE("World_Position_Z [-]", z_m, RECORDED_OPTIONAL, -1e9, 1e9, 1, 0),
    SPEED("Vel_X [m/s]", vx_mps, 1),
    SPEED("Vel_Y [m/s]", vy_mps, 1),
    VALUE("World_Heading_Angle [rad]", yaw_rad, RECORDED_NEEDED, -1e3, 1e3, 1, 0),
    VALUE("World_Heading_Angle [deg]", yaw_rad, RECORDED_NEEDED, -1e3, 1e3, PI / 180, 0),
    VALUE("Heading_Angle_Rate [rad/s]", yaw_rate_radps, RECORDED_NEEDED, -1e3, 1e3, 1, 0),
    VALUE("Heading_Angle_Rate [deg/s]", yaw_rate_radps, RECORDED_NEEDED, -6e4, 6e4, PI / 180, 0),
    ASIDE("bb_x [m]", BOX_X),
    ASIDE("bb_y [m]", BOX_Y),
    SIZE("bb_length [m]", length_m, RECORDED_NEEDED),
    SIZE("bb_width [m]", width_m, RECORDED_NEEDED),
    SIZE("bb_height [m]", height_m, RECORDED_NEEDED),
    {0},
};

static const struct recorded_word esmini_words[] = {
#define ESMINI RECORDED_WORD
#include "recorded/recorded_classes.def"
    {0},
};

static const char *word_of_box(const struct recorded_row *row)
{
    if (row->length_m <= 1.2)
        return esmini_words[0].word;
    if (row->width_m <= 1.2)
        return esmini_words[1].word;
    if (row->length_m <= 5.6)
        return esmini_words[2].word;
    if (row->length_m <= 7)
        return esmini_words[3].word;
    return esmini_words[4].word;
}

/* The velocity of a point of a body that turns differs from that of another. */
static void complete_esmini(struct recorded_cells *cells)
{
    struct recorded_row *row = &cells->row;
    struct vec2 heading = vec2_heading(row->yaw_rad);
    double x_m = cells->aside[BOX_X] * heading.x - cells->aside[BOX_Y] * heading.y;
    double y_m = cells->aside[BOX_X] * heading.y + cells->aside[BOX_Y] * heading.x;
    row->x_m += x_m;
    row->y_m += y_m;
    row->vx_mps -= row->yaw_rate_radps * y_m;
    row->vy_mps += row->yaw_rate_radps * x_m;
    row->likely = word_of_box(row);
}

/* ---- INTERACTION ---- */

/* Files of pedestrians lack heading and sizes, and a row may leave these cells empty; then the yaw
 * is that of the velocity. Rows stand in any order. */
static const struct recorded_column interaction_columns[] = {
    ID("track_id"),
    RECORDING("case_id"),
    TIME("timestamp_ms", 1e-3),
    TIME("timestamp_us", 1e-6),
    TIME("timestamp_s", 1),
    CLASS("agent_type", RECORDED_NEEDED),
    PLACE("x", x_m, 1),
    PLACE("y", y_m, 1),
    SPEED("vx", vx_mps, 1),
    SPEED("vy", vy_mps, 1),
    VALUE("psi_rad", yaw_rad, RECORDED_TOGETHER, -1e3, 1e3, 1, 0),
    SIZE("length", length_m, RECORDED_TOGETHER),
    SIZE("width", width_m, RECORDED_TOGETHER),
    SIZE("height", height_m, RECORDED_OPTIONAL),
    {0},
};

static const struct recorded_word interaction_words[] = {
#define INTERACTION RECORDED_WORD
#include "recorded/recorded_classes.def"
    {0},
};

/* ---- all of them ---- */

/* Slower than 1 m/s a vehicle in a jam may move anywhere within the noise of its place, which is
 * that of an image (slow_mps of highD and NGSIM). */
static const struct recorded_layout layouts[] = {
    {.format = SUMO_FORMAT,
     .kinds = {{sumo_vehicles, "DEFAULT_VEHTYPE", 0.5},
               {sumo_persons, "DEFAULT_PEDTYPE", 0.5},
               {sumo_containers, "DEFAULT_CONTAINERTYPE", 0.5}}},
    {.format = SUMO_FORMAT, .kinds = {{sumo_plain, "DEFAULT_VEHTYPE", 0.5}}},
    {.format = {.name = "a table of inD", .id_name = "trackId", .words = ind_words},
     .kinds = {{ind_columns, NULL, 0}},
     .beside = {"trackId", NULL}},
    {.format = {.name = "a table of highD", .id_name = "id", .words = highd_words, .slow_mps = 1},
     .kinds = {{highd_columns, NULL, 0}},
     .beside = {"id", "drivingDirection"},
     .complete = complete_highd},
    {.format =
         {.name = "a table of NGSIM", .id_name = "Vehicle_ID", .words = ngsim_words, .slow_mps = 1},
     .kinds = {{ngsim_columns, NULL, 0.5}}},
    {.format = {.name = "a log of esmini",
                .id_name = "Entity_Name",
                .by_time = true,
                .words = esmini_words},
     .kinds = {{esmini_columns, NULL, 0}},
     .wide = true,
     .complete = complete_esmini},
    {.format = {.name = "a table of INTERACTION",
                .id_name = "track_id",
                .words = interaction_words},
     .kinds = {{interaction_columns, NULL, 0}}},
};

/* ---- the layout of a table ---- */

enum { NAME_ROOM = 80 };

/* The names of a table's columns. */
struct header {
    const struct csv_table *names;
    struct intern places;       /* of the columns, by their names */
    struct intern folded;       /* names in lower case */
    LIST_OF(int) folded_places; /* the first column of each, by the number of the name */
    struct arena *arena;
};

static void fold(const char *name, char *room)
{
    size_t length = 0;
    for (; name[length] != '\0' && length + 1 < NAME_ROOM; length++)
        room[length] = (char)tolower((unsigned char)name[length]);
    room[length] = '\0';
}

/* Keeps the place of each column by its name, and by its name in lower case. */
static void keep_places(struct header *header)
{
    char room[NAME_ROOM];
    for (size_t i = 0; i < header->names->columns; i++) {
        const char *name = header->names->header[i];
        intern_word(&header->places, name, header->arena);
        fold(name, room);
        if (intern_word(&header->folded, room, header->arena) == header->folded_places.count)
            *list_add(&header->folded_places, header->arena) = (int)i;
    }
}

/* The place of the column of this name, else of the first one whose letters differ in case. */
static int place_of(const struct header *header, const char *name)
{
    char room[NAME_ROOM];
    uint32_t place;
    if (intern_find(&header->places, name, strlen(name), &place))
        return (int)place;
    fold(name, room);
    if (!intern_find(&header->folded, room, strlen(room), &place))
        return RECORDED_ABSENT;
    assert(place < header->folded_places.count);
    return header->folded_places.items[place];
}

/* The name of a column; in a wide table that of a road user. */
static const char *name_of(const struct recorded_column *column, const char *user, char *room)
{
    if (user == NULL || column->kind == RECORDED_TIME)
        return column->name;
    snprintf(room, NAME_ROOM, "%s %s", user, column->name);
    return room;
}

static bool same_value(const struct recorded_column *a, const struct recorded_column *b)
{
    return a->kind == b->kind && a->offset == b->offset;
}

/* Finds the columns of a kind, of each value the first spelling. */
static struct recorded_part part_of(const struct header *header, const struct recorded_kind *kind,
                                    const char *user)
{
    const struct recorded_column *columns = kind->columns;
    assert(columns != NULL);
    struct recorded_part part = {.kind = kind, .user = user, .id = RECORDED_ABSENT};
    char room[NAME_ROOM];
    bool found = false;
    for (size_t i = 0; columns[i].name != NULL; i++) {
        found = found && same_value(&columns[i - 1], &columns[i]);
        part.at[i] = found ? RECORDED_ABSENT : place_of(header, name_of(&columns[i], user, room));
        found = found || part.at[i] != RECORDED_ABSENT;
        if (part.id == RECORDED_ABSENT && same_value(columns, &columns[i]))
            part.id = part.at[i];
    }
    return part;
}

/* Values that stand together are needed once one of them is there. */
static bool is_needed(const struct recorded_part *part, const struct recorded_column *column)
{
    const struct recorded_column *columns = part->kind->columns;
    bool together = false;
    for (size_t i = 0; columns[i].name != NULL; i++)
        together =
            together || (columns[i].need == RECORDED_TOGETHER && part->at[i] != RECORDED_ABSENT);
    return column->need == RECORDED_NEEDED || (column->need == RECORDED_TOGETHER && together);
}

/* Adds the names of columns of which any one would do. */
static void add_names(const struct recorded_part *part, size_t from, size_t end, struct text *names)
{
    char room[NAME_ROOM];
    for (size_t i = from; i < end; i++) {
        const char *between = names->length > 0 ? ", " : "";
        text_format(names, "%s\"%s\"", i > from ? " or " : between,
                    name_of(&part->kind->columns[i], part->user, room));
    }
}

/* Counts the needed values, and adds the names of lacking columns to the text, if there is one. */
static void count_values(struct recorded_fit *fit, const struct recorded_part *part,
                         struct text *names)
{
    const struct recorded_column *columns = part->kind->columns;
    for (size_t i = 0, end; columns[i].name != NULL; i = end) {
        bool found = false;
        for (end = i; columns[end].name != NULL && same_value(&columns[i], &columns[end]); end++)
            found = found || part->at[end] != RECORDED_ABSENT;
        if (!is_needed(part, &columns[i]))
            continue;
        fit->found += found;
        fit->lacking += !found;
        if (names != NULL && !found)
            add_names(part, i, end, names);
    }
}

/* Adds every road user that a column names, whatever its number is; without any, "#1". */
static void add_users(struct header *header, struct recorded_fit *fit)
{
    struct intern users = {0};
    for (size_t i = 0; i < header->names->columns; i++) {
        const char *name = header->names->header[i];
        size_t length = strcspn(name, " ");
        if (*name == '#' && length > 1 && strspn(name + 1, "0123456789") == length - 1)
            intern_number(&users, name, length, header->arena);
    }
    if (users.list.count == 0)
        intern_word(&users, "#1", header->arena);
    for (uint32_t i = 0; i < users.list.count; i++)
        *list_add(&fit->parts, header->arena) =
            part_of(header, fit->layout->kinds, intern_text(&users, i));
}

/* Adds the kinds that have a column of ids; without any, the first. */
static void add_kinds(struct header *header, struct recorded_fit *fit)
{
    const struct recorded_kind *kinds = fit->layout->kinds;
    for (size_t i = 0; i < RECORDED_KINDS && kinds[i].columns != NULL; i++) {
        struct recorded_part part = part_of(header, &kinds[i], NULL);
        if (part.id != RECORDED_ABSENT)
            *list_add(&fit->parts, header->arena) = part;
    }
    if (fit->parts.count == 0)
        *list_add(&fit->parts, header->arena) = part_of(header, kinds, NULL);
}

static struct recorded_fit fit_of(struct header *header, const struct recorded_layout *layout)
{
    struct recorded_fit fit = {.layout = layout};
    if (layout->wide)
        add_users(header, &fit);
    else
        add_kinds(header, &fit);
    for (size_t i = 0; i < fit.parts.count; i++)
        count_values(&fit, &fit.parts.items[i], NULL);
    return fit;
}

/* Names the nearest layout with what it lacks, and the header. */
static int refuse_header(const struct csv_table *table, const struct recorded_fit *fit,
                         struct diag *diag)
{
    enum { MOST = 600 };
    struct recorded_fit counted = {0};
    struct text lacking = {0}, header = {0};
    for (size_t i = 0; i < fit->parts.count; i++)
        count_values(&counted, &fit->parts.items[i], &lacking);
    for (size_t i = 0; i < table->columns; i++)
        text_format(&header, "%s%s", i > 0 ? ", " : "", table->header[i]);
    int names = (int)(lacking.length < MOST ? lacking.length : MOST);
    int length = (int)(header.length < MOST ? header.length : MOST);
    if (counted.found == 0)
        diag_fail(diag, DIAG_DATA, "no column is one that a layout needs; the header is: %.*s",
                  length, header.bytes);
    else
        diag_fail(diag, DIAG_DATA,
                  "column%s %.*s %s missing for %s, the nearest layout; the header is: %.*s",
                  counted.lacking > 1 ? "s" : "", names, lacking.bytes,
                  counted.lacking > 1 ? "are" : "is", fit->layout->format.name, length,
                  header.bytes);
    text_free(&lacking);
    text_free(&header);
    return -1;
}

int recorded_layouts_find(const struct csv_table *names, struct recorded_fit *fit,
                          struct arena *arena, struct diag *diag)
{
    struct header header = {.names = names, .arena = arena};
    keep_places(&header);
    *fit = fit_of(&header, layouts);
    for (size_t i = 1; i < sizeof layouts / sizeof *layouts; i++) {
        struct recorded_fit other = fit_of(&header, &layouts[i]);
        size_t share = other.found * (fit->found + fit->lacking);
        size_t best_share = fit->found * (other.found + other.lacking);
        if (share > best_share || (share == best_share && other.found > fit->found))
            *fit = other;
    }
    return fit->lacking == 0 ? 0 : refuse_header(names, fit, diag);
}
