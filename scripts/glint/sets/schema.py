"""The members of a plan: plans are checked by this table, and schemas/dataset.json is printed from it (make schemas)."""
import json
import re

TEXT = {"type": "string", "minLength": 1}
SECONDS = {"type": "number", "minimum": -9 * 10 ** 9, "maximum": 9 * 10 ** 9}
LENGTH_S = {"type": "number", "minimum": 1e-6, "maximum": 10 ** 6}


def text_like(pattern):
    return {"type": "string", "pattern": pattern}


def whole(least, most):
    return {"type": "integer", "minimum": least, "maximum": most}


def several(items, **bounds):
    return {"type": "array", "minItems": 1, **bounds, "items": items}


def record(title, purpose, required, members):
    """An object of these members and no others; each has its help and the words of JSON Schema that describe its value."""
    properties = {name: {"$comment" if "properties" in value else "description": text, **value}
                  for name, (text, value) in members.items()}
    return {"title": title, "description": purpose, "type": "object", "additionalProperties": False,
            "required": required, "properties": properties}


SOURCE = record("source", "Traffic of one kind.", [], {
    "random": ("density of random traffic", {"enum": ["sparse", "medium", "dense"]}),
    "seconds": ("of random traffic: moving scenes of this length in place of snapshots",
                {"type": "number", "exclusiveMinimum": 0, "maximum": 100000}),
    "frames": ("how many random snapshots", whole(1, 10 ** 9)),
    "scenario": ("a scenario: a name in data/scenarios/, or a path from the plan's folder", TEXT),
    "scenes": ("of moving random traffic and of a scenario with distributions: the first scene, and the one behind the last",
               several(whole(0, 10 ** 9), minItems=2, maxItems=2)),
    "recording": ("recorded traffic: a name in data/trajectories/, or a path from the plan's folder", TEXT),
    "licence": ("of a recording: under which licence it may be used, as CC-BY-4.0", TEXT),
    "source": ("of a recording: who recorded it, and where it is to be had", TEXT),
    "program": ("the source's program; absent: glint-traffic, or glint-traffic-random", text_like("^glint-traffic[a-z0-9-]*$")),
    "egos": ("of a recording: the objects that carry the sensors, or all", several(TEXT, uniqueItems=True)),
    "scene": ("of a recording: the beginning of its scenes' names; absent: the name of its file", TEXT),
    "from_s": ("of a recording: the first time that is played", SECONDS),
    "to_s": ("of a recording: the time from which on nothing is played", SECONDS),
    "block_s": ("of a recording: the longest scene; absent: as long as its split", LENGTH_S),
    "rate_hz": ("of a recording or of moving random traffic: frames in a second; absent: the recording's own, whose blocks "
                "are shards, or 20", {"type": "number", "minimum": 0.001, "maximum": 10 ** 6}),
    "options": ("more options of the source's program", {"type": "string"}),
    "split": ("the split that has all of the source; for splits by recording or kind", text_like("^[a-z0-9][a-z0-9_-]*$"))})
SPLITS = record("splits", "Parts for training, validation and test that share no traffic.", ["by"], {
    "by": ("scene: numbers of random scenes; time: blocks of recordings with a gap between; recording: the split of each source; "
           "kind: the split of a source, or else recordings by time and others by scene", {"enum": ["scene", "time", "recording", "kind"]}),
    "shares": ("the share of each split, in their order; 1 in sum; none if by is recording", {
        "type": "object", "minProperties": 1, "additionalProperties": {"type": "number", "exclusiveMinimum": 0, "maximum": 1}}),
    "gap_s": ("of recordings by time: the gap that is left out between two splits; longer than vehicles stay in view", LENGTH_S)})
PLAN = record(
    "dataset", "The plan of a data set: from which traffic, by which chain and with which radars scripts/dataset makes it.",
    ["name", "origin", "sources", "chain", "suites", "frames_per_shard"], {
        "name": ("of the set", text_like("^[a-z0-9][a-z0-9._-]*$")),
        "origin": ("who made this, and from what", TEXT),
        "sources": ("where the traffic comes from; each is random, a scenario or a recording", several(SOURCE)),
        "chain": ("stages from objects to targets, with {suite} where the name of a suite belongs", TEXT),
        "suites": ("radars: names in data/sensors/, or paths from the plan's folder; each makes lists of all traffic",
                   several(TEXT, uniqueItems=True)),
        "vehicles": ("a set of vehicle documents, as detailed or paper, or the path of a folder from the plan's folder; absent: that of the suites, or paper", TEXT),
        "seeds": ("of the random numbers; each makes lists of all traffic; absent: 1",
                  several(whole(0, 2 ** 53 - 1), uniqueItems=True)),
        "tables": ("tables of glint-tables beside the lines of each shard: true for CSV, parquet for Parquet by DuckDB; absent: none",
                   {"enum": [False, True, "parquet"]}),
        "lines": ("JSON lines of each shard: whole, or with tables also without_objects or none; absent: whole",
                  {"enum": ["whole", "without_objects", "none"]}),
        "exports": ("layouts of public data sets that the set also gets, in exports/LAYOUT (data/exports/README.md); absent: none",
                    several({"enum": ["nuscenes", "truckscenes", "openpcdet", "kitti", "vod"]}, uniqueItems=True)),
        "compression": ("of lines, and of tables of CSV; absent: gzip", {"enum": ["gzip", "zstd"]}),
        "level": ("of the compression of lines: up to 9 for gzip, 19 for zstd; absent: 1", whole(1, 19)),
        "frames_per_shard": ("the most frames of a shard, unless a scene or a block has more", whole(1, 10 ** 9)),
        "splits": ("absent: one, called all", SPLITS)})


def printed(schema, line="\n  "):
    """JSON, with a line for each member of a record and for what describes the record itself."""
    if not isinstance(schema, dict):
        return json.dumps(schema)
    is_record, text = "properties" in schema, ""
    for word, value in schema.items():
        begin = line if is_record and word in ("$schema", "title", "description", "required", "properties") else " "
        text += f'{"," if text else ""}{begin}"{word}": '
        if word == "properties":
            text += "{" + ",".join(f'{line}  "{name}": {printed(of, line + "    ")}' for name, of in value.items()) + line + "}"
        else:
            text += printed(value, line + "  ")
    return "{" + text.lstrip(" ") + (line[:-2] if is_record and "$comment" not in schema else "") + "}"


TYPES = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "boolean": bool}
BOUNDS = {"minimum": ("at least", lambda value, bound: value >= bound),
          "maximum": ("at most", lambda value, bound: value <= bound),
          "exclusiveMinimum": ("more than", lambda value, bound: value > bound),
          "minLength": ("a text of at least this many letters:", lambda value, bound: len(value) >= bound),
          "minItems": ("at least this many items:", lambda value, bound: len(value) >= bound),
          "maxItems": ("at most this many items:", lambda value, bound: len(value) <= bound),
          "minProperties": ("at least this many members:", lambda value, bound: len(value) >= bound),
          "pattern": ("a text like", lambda value, bound: re.fullmatch(bound, value)),
          "enum": ("one of", lambda value, bound: any(value == one and type(value) is type(one) for one in bound)),
          "uniqueItems": ("no item twice:", lambda value, _: len(set(map(str, value))) == len(value))}


def has_type(value, name):
    wanted = TYPES[name]
    return isinstance(value, wanted) and (wanted is bool or not isinstance(value, bool))


def fault_of_object(value, schema, path):
    for name in schema.get("required", []):
        if name not in value:
            return f"{path or '/'}: {name} is missing: {schema['properties'][name]['description']}"
    known, others = schema.get("properties", {}), schema.get("additionalProperties", True)
    for name, member in value.items():
        if name not in known and others is False:
            return f"{path}/{name}: unknown member; expected one of {', '.join(known)}"
        below = known.get(name, others if isinstance(others, dict) else {})
        if fault := fault_of(member, below, f"{path}/{name}"):
            return fault
    return None


def fault_of(value, schema, path=""):
    """The first fault of a value, as path, value and expectation; None if there is none."""
    if "type" in schema and not has_type(value, schema["type"]):
        return f"{path or '/'}: {value!r}; expected {schema['type']}"
    if isinstance(value, str) and re.search("[\0-\x1f\x7f\ud800-\udfff]", value):
        return f"{path}: {value!r}; expected one line, without control characters and halves of characters"
    for word, (text, holds) in BOUNDS.items():
        if word in schema and not holds(value, schema[word]):
            return f"{path or '/'}: {value!r}; expected {text} {schema[word]}"
    if isinstance(value, dict):
        return fault_of_object(value, schema, path)
    if isinstance(value, list):
        for i, item in enumerate(value):
            if fault := fault_of(item, schema.get("items", {}), f"{path}/{i}"):
                return fault
    return None


if __name__ == "__main__":
    print(printed({"$schema": "https://json-schema.org/draft/2020-12/schema"} | PLAN))
