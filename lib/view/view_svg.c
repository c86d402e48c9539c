#include "view/view_svg.h"

#include "base/elementary.h"
#include "base/units.h"
#include "view/view_marks.h"

enum { WIDTH = 1200, HEIGHT = 800, MARGIN = 60, MARK = 7 };

/* A drawing, with the transformation from metres in the ego's axes, x right, to pixels. */
struct drawing {
    const struct frame *frame;
    struct view_models *models;
    struct text *text;
    struct vec2 origin, heading; /* place and heading of the ego */
    struct vec2 low, high;       /* corners of the area that must be in the picture, in the ego's
                                  * axes */
    double scale;                /* pixels per metre */
};

static void add_escaped(struct text *text, const char *word)
{
    for (; *word != '\0'; word++) {
        if (*word == '&')
            text_add_word(text, "&amp;");
        else if (*word == '<')
            text_add_word(text, "&lt;");
        else if (*word == '>')
            text_add_word(text, "&gt;");
        else if (*word == '"')
            text_add_word(text, "&quot;");
        else
            text_add(text, word, 1);
    }
}

static struct vec2 to_local(const struct drawing *drawing, struct vec2 place)
{
    return vec2_turn_back(vec2_sub(place, drawing->origin), drawing->heading);
}

static struct vec2 to_pixels(const struct drawing *drawing, struct vec2 place)
{
    struct vec2 local = to_local(drawing, place);
    struct vec2 middle = vec2_scale(0.5, vec2_add(drawing->low, drawing->high));
    return (struct vec2){WIDTH / 2.0 + drawing->scale * (local.x - middle.x),
                         HEIGHT / 2.0 - drawing->scale * (local.y - middle.y)};
}

static void include(struct drawing *drawing, struct vec2 place)
{
    struct vec2 local = to_local(drawing, place);
    drawing->low = (struct vec2){elementary_min(drawing->low.x, local.x),
                                 elementary_min(drawing->low.y, local.y)};
    drawing->high = (struct vec2){elementary_max(drawing->high.x, local.x),
                                  elementary_max(drawing->high.y, local.y)};
}

static struct box box_of(const struct drawing *drawing, const struct object *object)
{
    return view_frame_box(object, view_frame_vehicle(drawing->models, object->class));
}

/* Chooses the area of the picture: it includes the ego, all targets, and objects shorter than 20 m
 * with a target; all objects if there are no targets. */
static void frame_picture(struct drawing *drawing)
{
    const struct frame *frame = drawing->frame;
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        struct view_scan scan = view_frame_scan(frame, frame_view(frame, target->sensor));
        include(drawing, view_frame_place(&scan, target->range_m, target->azimuth_rad));
    }
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        struct box box = box_of(drawing, object);
        struct vec2 corner[4];
        motion_box_outline(&box, corner);
        bool ego = strcmp(object->id, frame->ego) == 0;
        bool part = frame_detects(frame, object->id) && box.length_m < 20;
        for (int j = 0; j < 4 && (ego || part || frame->targets.count == 0); j++)
            include(drawing, corner[j]);
    }
    struct vec2 size = vec2_sub(drawing->high, drawing->low);
    drawing->scale = elementary_min((WIDTH - 2 * MARGIN) / elementary_max(size.x, 5),
                                    (HEIGHT - 2 * MARGIN) / elementary_max(size.y, 5));
}

static void add_line(struct drawing *drawing, const char *class, struct vec2 from, struct vec2 to)
{
    struct vec2 a = to_pixels(drawing, from), b = to_pixels(drawing, to);
    text_format(drawing->text, "<path class=\"%s\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", class, a.x, a.y,
                b.x, b.y);
}

static void add_label(struct drawing *drawing, const char *class, struct vec2 at, const char *word)
{
    text_format(drawing->text, "<text class=\"%s\" x=\"%.1f\" y=\"%.1f\">", class, at.x, at.y);
    add_escaped(drawing->text, word);
    text_add_word(drawing->text, "</text>\n");
}

static bool in_picture(struct vec2 at, double margin)
{
    return at.x > -margin && at.y > -margin && at.x < WIDTH + margin && at.y < HEIGHT + margin;
}

static void draw_object(struct drawing *drawing, const struct object *object)
{
    struct box box = box_of(drawing, object);
    struct vec2 corner[4], middle = to_pixels(drawing, box.motion.position_m);
    if (!in_picture(middle, drawing->scale * elementary_hypot(box.length_m, box.width_m)))
        return;
    bool ego = strcmp(object->id, drawing->frame->ego) == 0;
    motion_box_outline(&box, corner);
    text_format(drawing->text, "<path class=\"%s\" d=\"", ego ? "ego" : "body");
    for (int i = 0; i < 4; i++) {
        struct vec2 at = to_pixels(drawing, corner[i]);
        text_format(drawing->text, "%s%.1f %.1f", i == 0 ? "M" : "L", at.x, at.y);
    }
    text_add_word(drawing->text, "Z\"/>\n");
}

/* Names lie over targets: in the box if there is room, else above it. One that would reach over the
 * edge of the picture is left out; letters are 8 pixels wide at most. */
static void draw_name(struct drawing *drawing, const struct object *object)
{
    struct box box = box_of(drawing, object);
    struct vec2 corner[4], at = to_pixels(drawing, box.motion.position_m);
    bool ego = strcmp(object->id, drawing->frame->ego) == 0;
    const char *name = ego ? "ego" : object->id;
    double half_height = 0;
    motion_box_outline(&box, corner);
    for (int i = 0; i < 4; i++)
        half_height = elementary_max(half_height, at.y - to_pixels(drawing, corner[i]).y);
    at.y += ego || half_height > 20 ? 4 : -8 - half_height;
    if (drawing->scale * box.length_m > 40 && in_picture(at, -4.0 * (double)strlen(name)))
        add_label(drawing, ego ? "inside" : "name", at, name);
}

static void add_dot(struct drawing *drawing, const char *class, struct vec2 place, double radius)
{
    struct vec2 at = to_pixels(drawing, place);
    if (in_picture(at, 0))
        text_format(drawing->text, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"/>\n",
                    class, at.x, at.y, radius);
}

/* The field of view as a sector. It is drawn as two arcs, since an arc that returns to its start is
 * empty. */
static void draw_beam(struct drawing *drawing, const struct sensor_view *sensor, size_t style)
{
    struct view_scan scan = view_frame_scan(drawing->frame, sensor);
    struct vec2 at = to_pixels(drawing, scan.pose.position_m);
    double radius = drawing->scale * sensor->range_max_m, half = sensor->field_of_view_rad / 2;
    text_format(drawing->text, "<path class=\"beam s%zu\" d=\"M%.1f %.1f", style % VIEW_COLOURS,
                at.x, at.y);
    for (int i = 0; i <= 2; i++) {
        struct vec2 to = to_pixels(
            drawing, view_frame_place(&scan, sensor->range_max_m, half * (1 - i) * 0.999999));
        if (i == 0)
            text_format(drawing->text, "L%.1f %.1f", to.x, to.y);
        else
            text_format(drawing->text, "A%.1f %.1f 0 0 1 %.1f %.1f", radius, radius, to.x, to.y);
    }
    text_add_word(drawing->text, "Z\"/>\n");
}

static void add_circle(struct text *text, const char *class, size_t style, struct vec2 at,
                       double radius)
{
    text_format(text, "<circle class=\"%s%zu\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"/>\n", class,
                style % VIEW_COLOURS, at.x, at.y, radius);
}

/* The shape of a sensor: a star, a polygon, or a ring for the circle. */
static void add_shape(struct text *text, size_t style, bool hollow, struct vec2 at)
{
    const struct view_shape *shape = &view_marks_shapes[style % VIEW_SHAPES];
    if (shape->corners == 0) {
        add_circle(text, hollow ? "hollow s" : "ring s", style, at, MARK * shape->size);
        return;
    }
    int64_t steps = shape->corners * (shape->inner > 0 ? 2 : 1);
    text_format(text, "<path class=\"%s%zu\" d=\"", hollow ? "hollow s" : "target f",
                style % VIEW_COLOURS);
    for (int64_t i = 0; i < steps; i++) {
        double reach = MARK * shape->size * (shape->inner > 0 && i % 2 == 1 ? shape->inner : 1);
        double angle = shape->turn_rad - PI / 2 + 2 * PI * (double)i / (double)steps;
        text_format(text, "%s%.1f %.1f", i == 0 ? "M" : "L", at.x + reach * elementary_cos(angle),
                    at.y + reach * elementary_sin(angle));
    }
    text_add_word(text, "Z\"/>\n");
}

static void add_symbol(struct text *text, size_t style, enum path path, struct vec2 at)
{
    static const struct vec2 gravel[] = {{0, -0.6}, {-0.65, 0.5}, {0.65, 0.5}};
    if (path == PATH_CLUTTER)
        for (int i = 0; i < 3; i++)
            add_circle(text, "target f", style, vec2_add(at, vec2_scale(MARK, gravel[i])),
                       0.42 * MARK);
    else if (path == PATH_FALSE_ALARM)
        text_format(text,
                    "<path class=\"alarm s%zu\" d=\"M%.1f %.1fl13.4 7.7m0 -7.7l-13.4 7.7m6.7 "
                    "-11.6v15.4\"/>\n",
                    style % VIEW_COLOURS, at.x - 6.7, at.y - 3.85);
    else
        add_shape(text, style, !frame_shows_object(path), at);
}

static void draw_target(struct drawing *drawing, const struct target *target)
{
    const struct sensor_view *sensor = frame_view(drawing->frame, target->sensor);
    size_t style = (size_t)(sensor - drawing->frame->sensors.list.items);
    struct view_scan scan = view_frame_scan(drawing->frame, sensor);
    struct vec2 at = view_frame_place(&scan, target->range_m, target->azimuth_rad);
    char class[16] = "speed s0";
    class[7] = (char)('0' + style % VIEW_COLOURS);
    for (size_t i = 0; i < target->contributors.count; i++) {
        const struct contributor *from = &target->contributors.items[i];
        struct vec2 place = view_frame_place(&scan, from->range_m, from->azimuth_rad);
        text_format(drawing->text, "<g class=\"part s%zu\" stroke-width=\"%.2f\">",
                    style % VIEW_COLOURS, 1 + 3 * from->weight);
        add_line(drawing, "tie", place, at);
        text_add_word(drawing->text, "</g>\n");
        add_dot(drawing, "lit", place, 3);
    }
    if (fabs(target->range_rate_mps) >= 0.02)
        add_line(drawing, class, at,
                 view_frame_place(&scan, target->range_m + target->range_rate_mps / 2,
                                  target->azimuth_rad));
    add_symbol(drawing->text, style, target->contributors.items[0].id.path, to_pixels(drawing, at));
}

/* Draws a dot where a reflector sent no echo, and a cross where an echo is in no target. A dot for
 * the first sensor serves all. */
static void draw_lost(struct drawing *drawing, const struct lost_group *group)
{
    struct view_scan scan =
        view_frame_scan(drawing->frame, frame_view(drawing->frame, group->sensor));
    bool first = strcmp(group->sensor, drawing->frame->sensors.list.items[0].name) == 0;
    for (size_t i = 0; i < group->echoes.count; i++) {
        const struct lost_echo *echo = &group->echoes.items[i];
        struct vec2 place = view_frame_place(&scan, echo->range_m, echo->azimuth_rad);
        struct vec2 at = to_pixels(drawing, place);
        if (echo->range_m == 0 || !in_picture(at, 0))
            continue;
        if (view_frame_loss_is_notable(frame_loss_of(group->reason)))
            text_format(drawing->text,
                        "<path class=\"lost\" d=\"M%.1f %.1fl10 10m0 -10l-10 10\"/>\n", at.x - 5,
                        at.y - 5);
        else if (first)
            add_dot(drawing, "centre", place, 2);
    }
}

static void draw_scale(struct drawing *drawing)
{
    double wanted = 80 / drawing->scale, step = elementary_pow(10, floor(elementary_log10(wanted)));
    step *= wanted <= step ? 1 : wanted <= 2 * step ? 2 : wanted <= 5 * step ? 5 : 10;
    text_format(drawing->text, "<path class=\"scale\" d=\"M20 %dv6h%.1fv-6\"/>\n", HEIGHT - 26,
                step * drawing->scale);
    text_format(drawing->text, "<text class=\"note\" x=\"24\" y=\"%d\">%g m</text>\n", HEIGHT - 30,
                step);
}

static void add_note(struct text *text, double x, double y, const char *words)
{
    text_format(text, "<text class=\"note\" x=\"%.0f\" y=\"%.0f\">%s</text>\n", x, y, words);
}

static void draw_legend(struct drawing *drawing)
{
    const struct frame *frame = drawing->frame;
    struct text *text = drawing->text;
    double y = 26;
    text_format(text, "<rect width=\"380\" height=\"%zu\" fill=\"#fff\" opacity=\"0.85\"/>\n",
                frame->sensors.list.count * 20 + 120);
    text_format(text, "<text class=\"title\" x=\"20\" y=\"%.0f\">", y);
    add_escaped(text, frame->scene);
    text_format(text, ", frame %lld, %g s</text>\n", (long long)frame->frame, frame->time_s);
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        y += 20;
        add_symbol(text, i, PATH_DIRECT, (struct vec2){29, y - 4});
        text_format(text, "<text class=\"note\" x=\"46\" y=\"%.0f\">target of ", y);
        add_escaped(text, frame->sensors.list.items[i].name);
        text_add_word(text, "; its line: radial speed, 0.5 s long</text>\n");
    }
    static const struct {
        enum path path;
        double x;
        const char *name;
    } kinds[] = {{PATH_WALL_OBJECT, 29, "ghost"},
                 {PATH_CLUTTER, 119, "clutter"},
                 {PATH_FALSE_ALARM, 219, "false alarm"}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        add_symbol(text, 0, kinds[i].path, (struct vec2){kinds[i].x, y + 16});
        add_note(text, kinds[i].x + 17, y + 20, kinds[i].name);
    }
    text_format(text, "<circle class=\"lit\" cx=\"29\" cy=\"%.0f\" r=\"3\"/>\n", y + 36);
    add_note(text, 46, y + 40, "echo in a target");
    if (!frame_carries(frame, CARRY_ACCOUNT))
        return;
    text_format(text, "<path class=\"lost\" d=\"M24 %.0fl10 10m0 -10l-10 10\"/>\n", y + 51);
    add_note(text, 46, y + 60, "echo in no target");
    text_format(text, "<circle class=\"centre\" cx=\"29\" cy=\"%.0f\" r=\"2\"/>\n", y + 76);
    add_note(text, 46, y + 80, "reflector without an echo");
}

static void begin_drawing(struct text *text)
{
    text_format(text,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" "
                "height=\"%d\" font-family=\"sans-serif\" font-size=\"13\">\n<style>\n",
                WIDTH, HEIGHT, WIDTH, HEIGHT);
    text_add_word(
        text,
        ".body{fill:#eceef1;stroke:#7b8490}.ego{fill:#3d4550}.centre{fill:#7b8490}\n"
        ".lit{fill:#16191d}.inside{fill:#fff;text-anchor:middle}\n"
        ".name{fill:#5b636e;text-anchor:middle;paint-order:stroke;stroke:#fff;stroke-width:3}\n"
        ".note{fill:#5b636e}\n"
        ".title{fill:#16191d;font-weight:bold}.scale{stroke:#16191d;stroke-width:1.5}\n"
        ".scale,.speed,.lost,.beam,.ring,.alarm{fill:none}.lost{stroke:#b3261e;stroke-width:2}\n"
        ".beam{stroke-dasharray:6 4;opacity:.5}.speed{stroke-width:1.6}\n"
        ".ring{stroke-width:2.6}.alarm{stroke-width:2.1}.target{stroke:#fff}.part{opacity:.6}\n"
        ".hollow{fill:#fff;stroke-width:1.6;stroke-dasharray:3 2}\n");
    for (int i = 0; i < VIEW_COLOURS; i++)
        text_format(text, ".s%d{stroke:%s}.f%d{fill:%s}\n", i, view_marks_light[i], i,
                    view_marks_light[i]);
    text_format(text, "</style>\n<rect width=\"%d\" height=\"%d\" fill=\"#fff\"/>\n", WIDTH,
                HEIGHT);
}

static void draw_frame(struct drawing *drawing)
{
    const struct frame *frame = drawing->frame;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        draw_beam(drawing, &frame->sensors.list.items[i], i);
    for (size_t i = 0; i < frame->objects.count; i++)
        draw_object(drawing, &frame->objects.items[i]);
    for (size_t i = 0; i < frame->lost.count; i++)
        draw_lost(drawing, &frame->lost.items[i]);
    for (size_t i = 0; i < frame->targets.count; i++)
        draw_target(drawing, &frame->targets.items[i]);
    for (size_t i = 0; i < frame->objects.count; i++)
        draw_name(drawing, &frame->objects.items[i]);
}

void view_svg_write(const struct frame *frame, struct view_models *models, struct text *text)
{
    struct motion ego = view_frame_ego(frame, 0);
    struct drawing drawing = {
        .frame = frame,
        .models = models,
        .text = text,
        .origin = ego.position_m,
        .heading = vec2_heading(ego.yaw_rad),
    };
    frame_picture(&drawing);
    begin_drawing(text);
    draw_frame(&drawing);
    draw_scale(&drawing);
    draw_legend(&drawing);
    text_add_word(text, "</svg>\n");
}

void view_svg_write_empty(struct text *text)
{
    begin_drawing(text);
    text_format(text,
                "<text class=\"note\" x=\"%d\" y=\"%d\" text-anchor=\"middle\">"
                "The stream is empty: it has no frames.</text>\n</svg>\n",
                WIDTH / 2, HEIGHT / 2);
}
