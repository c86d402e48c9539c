#include "ideal/mirror_faces.h"

#include "geometry/predicates.h"
#include "ideal/line_of_sight.h"

/* Adds a mirror of a body that is turned to the sensor. */
static void add_face(const struct look *look, const struct look_body *body, size_t index,
                     bool in_view, struct mirror_faces *faces)
{
    struct vec2 sensor = look->pose.position_m, boresight = look->pose.boresight;
    const struct mirror_plane *plane = &body->set->reflectors->mirrors.items[index];
    struct side side =
        line_of_sight_side(body, plane->from_x, plane->from_y, plane->to_x, plane->to_y);
    bool behind = vec2_dot(boresight, vec2_sub(side.from, sensor)) < -REFLECTORS_SLACK_M &&
                  vec2_dot(boresight, vec2_sub(side.to, sensor)) < -REFLECTORS_SLACK_M;
    if (behind && !effects_forced(look->selection, EFFECT_GHOSTS))
        return;
    struct mirror mirror = mirror_of(side.from, side.to, body->box.motion, sensor);
    if (mirror.sensor_height_m == 0)
        return;
    *list_add(&faces->list, look->frame->arena) = (struct mirror_face){
        .body = body,
        .number = (int64_t)index + 1,
        .mirror = mirror,
        .along = side.along,
        .plane = plane,
        .permittivity = reflection_permittivity(plane->material, look->sensor->carrier_hz),
        .in_view = in_view,
        .joints = arena_get(look->frame->arena, sizeof(struct mirror_joints)),
    };
}

struct mirror_faces mirror_faces_of(const struct look *look)
{
    bool all = effects_forced(look->selection, EFFECT_GHOSTS);
    struct mirror_faces faces = {0};
    for (size_t i = 0; i < look->body_count; i++) {
        const struct look_body *body = &look->bodies[i];
        if (body->set == NULL)
            continue;
        struct look_extent extent = look_reflectors_extent(look, body, body->set);
        if (!all && look_out_of_range(look, &extent.silhouette))
            continue;
        bool in_view = all || !look_out_of_view(look, &extent.silhouette);
        for (size_t j = 0; j < body->set->reflectors->mirrors.count; j++)
            add_face(look, body, j, in_view, &faces);
    }
    return faces;
}

/* Notes the body if its mirror is in line with the face and meets an end of it. */
static void join(const struct mirror_face *face, const struct look_body *body,
                 const struct mirror_plane *plane)
{
    struct side side =
        line_of_sight_side(body, plane->from_x, plane->from_y, plane->to_x, plane->to_y);
    if (!vec2_same(face->along, side.along))
        return;
    if (vec2_length(vec2_sub(side.from, face->mirror.b)) <= LINE_OF_SIGHT_JOINT_M) {
        face->joints->after = body;
        face->joints->shares_end |= vec2_same(side.from, face->mirror.b);
    }
    if (vec2_length(vec2_sub(face->mirror.a, side.to)) <= LINE_OF_SIGHT_JOINT_M)
        face->joints->before = body;
}

const struct mirror_joints *mirror_faces_joints(const struct look *look,
                                                const struct mirror_face *face)
{
    if (face->joints->known)
        return face->joints;
    double half_m = 0.5 * vec2_length(vec2_sub(face->mirror.b, face->mirror.a));
    for (size_t i = 0; i < look->body_count; i++) {
        const struct look_body *body = &look->bodies[i];
        struct vec2 way = vec2_sub(face->mirror.middle, body->box.motion.position_m);
        if (body->set == NULL)
            continue;
        double reach_m =
            half_m + 10 * LINE_OF_SIGHT_JOINT_M + body->set->shape->share * body->radius_m;
        if (fabs(way.x) > reach_m || fabs(way.y) > reach_m)
            continue;
        for (size_t j = 0; j < body->set->reflectors->mirrors.count; j++)
            join(face, body, &body->set->reflectors->mirrors.items[j]);
    }
    face->joints->known = true;
    return face->joints;
}

bool mirror_faces_bounce(const struct look *look, const struct mirror_face *face, struct vec2 place,
                         struct vec2 *bounce)
{
    if (!mirror_bounce(&face->mirror, place, bounce))
        return false;
    if (!mirror_faces_joints(look, face)->shares_end)
        return true;
    struct vec2 image = mirror_image_place(&face->mirror, place);
    return predicates_orientation(look->pose.position_m, image, face->mirror.b) != 0;
}
