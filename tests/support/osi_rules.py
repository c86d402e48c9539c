"""The rules that OSI states in the comments of its fields, for what glint-osi writes, and what breaks them.

A rule of 3.7 is not in 3.8: object_id of a detection refers to a message DetectedObject, which no version has any more, so
that every value breaks it.
"""
import os
import re

from osi_messages import value_of

RULES = """
Timestamp seconds >= 0
Timestamp nanos >= 0 <= 999999999
Identifier value >= 0
Dimension3d length >= 0
Dimension3d width >= 0
Dimension3d height >= 0
Spherical3d distance >= 0
ExternalReference type is_set
SensorData version is_set
SensorData timestamp is_set
SensorData sensor_id is_set
SensorData mounting_position is_set
SensorView version is_set
SensorView timestamp is_set
SensorView sensor_id is_set
SensorView mounting_position is_set
SensorView host_vehicle_id refers_to:MovingObject is_set
GroundTruth version is_set
GroundTruth timestamp is_set
GroundTruth host_vehicle_id refers_to:MovingObject is_set
MovingObject id is_globally_unique is_set
MovingObject vehicle_attributes if_type:2
MovingObject vehicle_classification if_type:2
MovingObject pedestrian_attributes if_type:3
StationaryObject id is_globally_unique is_set
SensorDetectionHeader cycle_counter >= 0
SensorDetectionHeader mounting_position is_set
SensorDetectionHeader number_of_valid_detections >= 0
SensorDetectionHeader sensor_id is_set
RadarDetection existence_probability >= 0 <= 1
RadarDetection radial_velocity_rmse >= 0
"""
OF_3_7 = "RadarDetection object_id refers_to:DetectedObject\n"

# The message of a field; of one name in several messages, with the message that has it.
KINDS = {
    "version": "InterfaceVersion", "timestamp": "Timestamp", "measurement_time": "Timestamp", "last_measurement_time": "Timestamp",
    "id": "Identifier", "sensor_id": "Identifier", "host_vehicle_id": "Identifier", "ambiguity_id": "Identifier",
    "object_id": "Identifier", "sensor_view": "SensorView", "global_ground_truth": "GroundTruth", "moving_object": "MovingObject",
    "stationary_object": "StationaryObject", "source_reference": "ExternalReference", "feature_data": "FeatureData", "base": "Base",
    "radar_sensor": "RadarDetectionData", "header": "SensorDetectionHeader", "detection": "RadarDetection",
    "dimension": "Dimension3d", "position_rmse": "Spherical3d", "RadarDetection.position": "Spherical3d",
}
TYPES = {"TYPE_OTHER": 1, "TYPE_VEHICLE": 2, "TYPE_PEDESTRIAN": 3}


def table(text):
    found = {}
    for line in text.split("\n"):
        words = line.replace(">= ", ">=").replace("<= ", "<=").split()
        if len(words) > 2:
            found[(words[0], words[1])] = words[2:]
    return found


def messages_of(message, kind="SensorData"):
    """A decoded message and all messages in it, with their kinds."""
    yield kind, message
    for name, values in message.items():
        inner = KINDS.get(f"{kind}.{name}") or KINDS.get(name, "")
        for value in values:
            if isinstance(value, dict):
                yield from messages_of(value, inner)


def broken(rule, name, message, ids):
    """True if a message breaks a rule of its field of that name; ids are those of the objects of each kind."""
    word, _, what = rule.partition(":")
    if word == "is_set":
        return name not in message
    if word == "if_type":
        kind = message.get("type", ["0"])[-1]
        return (TYPES.get(kind) or int(kind)) == int(what) and name not in message
    if name not in message:
        return False
    if word == "refers_to":
        return value_of(message, name, "value") not in ids.get(what, [])
    if word == "is_globally_unique":
        return sum(those.count(value_of(message, name, "value")) for those in ids.values()) != 1
    bound = float(rule[2:])
    return float(message[name][-1]) < bound if rule[:2] == ">=" else float(message[name][-1]) > bound


def faults(data, version):
    """The rules of 3.8 or 3.7 that a decoded SensorData breaks."""
    rules = table(RULES + (OF_3_7 if version == "3.7" else ""))
    all_messages = list(messages_of(data))
    ids = {}
    for kind, message in all_messages:
        if kind in ("MovingObject", "StationaryObject"):
            ids.setdefault(kind, []).append(value_of(message, "id", "value"))
    return [f"{kind}.{name}: {rule}" for kind, message in all_messages for (of, name), those in rules.items() if of == kind
            for rule in those if broken(rule, name, message, ids)]


def published(folder):
    """The rules of the interface itself, of fields that RULES has, in the words of RULES."""
    found, kind, comment = {}, [], []
    for name in sorted(os.listdir(folder)):
        if not name.endswith(".proto"):
            continue
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            for line in map(str.strip, file):
                if line.startswith("//"):
                    comment.append(line[2:].strip())
                    continue
                if opened := re.match(r"(message|enum|extend|oneof) ?(\S*)", line):
                    kind.append(opened[2])
                elif line == "}":
                    kind.pop()
                elif field := re.match(r"(?:optional|repeated) \S+ (\w+) = ", line):
                    rules = re.findall(r"\\rules\n(.*?)\\endrules", "\n".join(comment), re.DOTALL)
                    found[(".".join(kind), field[1])] = [in_short(rule) for rule in "\n".join(rules).split("\n") if rule]
                comment = [] if line else comment
    return found


def in_short(rule):
    for long, short in ((r"is_greater_than_or_equal_to: (\d+)", r">=\1"), (r"is_less_than_or_equal_to: (\d+)", r"<=\1"),
                        (r"refers_to: (\w+)", r"refers_to:\1"), (r"check_if this.type is_equal_to (\d) else do_check is_set", r"if_type:\1")):
        rule = re.sub(long, short, rule)
    return rule
