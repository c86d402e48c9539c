"""Objects of other simulators for glint.Loop (scripts/glint): import it beside glint, or copy what you need.

    radar.step("7", [carla_object(actor) for actor in world.get_actors() if actor.type_id.startswith(("vehicle", "walker"))])
    radar.step("ego", [sumo_object(traci.vehicle, name) for name in traci.vehicle.getIDList()])

The first word is the id of the object that carries the radars. Frames of CARLA and SUMO are in their own world's metres.
"""
import math

from glint import turned


def carla_object(actor, kind=None):
    """An object from an actor of CARLA, whose y axis points right and whose yaw turns right, in degrees. The middle of its box is
    beside its place; extents are half of sizes."""
    at, box, v, kinds = actor.get_transform(), actor.bounding_box, actor.get_velocity(), actor.attributes
    yaw, rate = -math.radians(at.rotation.yaw), -math.radians(actor.get_angular_velocity().z)
    dx, dy = turned(box.location.x, -box.location.y, yaw)
    return {"id": str(actor.id), "class": kind or kinds.get("base_type") or ("pedestrian" if actor.type_id.startswith("walker") else "car"),
            "x_m": at.location.x + dx, "y_m": -at.location.y + dy, "yaw_rad": yaw, "vx_mps": v.x - rate * dy, "vy_mps": -v.y + rate * dx,
            "yaw_rate_radps": rate, "length_m": 2 * box.extent.x, "width_m": 2 * box.extent.y, "height_m": 2 * box.extent.z,
            "travelled_m": 0}


def sumo_object(vehicle, name, kind="car"):
    """An object from traci.vehicle of SUMO, whose angles turn right from north, in degrees, and whose places are those of front
    bumpers. The turn rate is that of the last step, which SUMO does not say: 0."""
    (x, y), yaw = vehicle.getPosition(name), math.radians(90 - vehicle.getAngle(name))
    along, left = turned(1, 0, yaw), vehicle.getLateralSpeed(name)
    length, speed = vehicle.getLength(name), vehicle.getSpeed(name)
    return {"id": name, "class": kind, "x_m": x - length / 2 * along[0], "y_m": y - length / 2 * along[1], "yaw_rad": yaw,
            "vx_mps": speed * along[0] - left * along[1], "vy_mps": speed * along[1] + left * along[0], "yaw_rate_radps": 0,
            "length_m": length, "width_m": vehicle.getWidth(name), "height_m": vehicle.getHeight(name), "travelled_m": 0}
