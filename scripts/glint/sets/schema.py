"""Plans of data sets by their schema (schemas/dataset.json), and the first fault of a value by the words of JSON Schema that it uses."""
import json
import os
import re

from glint.places import SCHEMAS

with open(os.path.join(SCHEMAS, "dataset.json"), encoding="utf-8") as file:
    PLAN = json.load(file)
SOURCE = PLAN["properties"]["sources"]["items"]
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
