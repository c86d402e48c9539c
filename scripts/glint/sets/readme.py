"""The README.md of a data set, from the texts of data/sets: what is in it, its conventions, and how to load it."""
import collections
import json
import os
import shlex

from glint.sets.documents import DOCUMENTS, suite_name
from glint.sets.plan import kind_of, read_json, scene_of, text_of
from glint.sets.traffic import shell_of

def split_table(layout, records):
    """Rows of the table of splits and suites."""
    sums = collections.defaultdict(lambda: [0, 0, 0, 0])
    for record in records:
        shard = layout["shards"][record["part"]]
        for i, count in enumerate((1, record["frames"], sum(record["targets"].values()),
                                   sum(file["bytes"] for file in record["files"]))):
            sums[shard["split"], shard["suite"]][i] += count
    rows = [f"| `{split}/{suite}` | {' | '.join(f'{count:,}' for count in row)} |" for (split, suite), row in sums.items()]
    return "\n".join(["| folder | shards | frames | targets | bytes |", "|---|---:|---:|---:|---:|", *rows])


def classes_by_split(layout, records):
    counts = collections.defaultdict(collections.Counter)
    for record in records:
        counts[layout["shards"][record["part"]]["split"]].update(record["targets"])
    return counts


def class_table(counts):
    """Rows of classes, the most frequent first, then by name."""
    whole = sum(counts.values(), collections.Counter())
    rows = [[name, *(f"{of_split[name]:,}" for of_split in counts.values())]
            for name, _ in sorted(whole.items(), key=lambda item: (-item[1], item[0]))]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def traffic_of(source):
    """Where the traffic of a source comes from."""
    kind = kind_of(source)
    if kind == "recording":
        return f"- `{scene_of(source)}`: a recording, by {source['source']}; licence: {source['licence']}"
    made = {"random": "snapshots that glint has drawn", "moving": "moving scenes that glint has drawn"}
    return f"- `{scene_of(source)}`: {made.get(kind, 'a scenario, played by glint')}"


def radar_of(suite, folder):
    """What the set's copy of a suite says of itself."""
    name = suite_name(suite)
    return f"- `{name}`: {read_json(os.path.join(folder, DOCUMENTS, 'sensors', name + '.json')).get('origin', 'a suite of your own')}"


def readme_of(layout, records, folder, content_hash):
    plan, counts = layout["plan"], classes_by_split(layout, records)
    splits, texts = plan.get("splits", {}), json.loads(text_of("readme.json"))
    first, parquet = layout["shards"][0], plan.get("tables") == "parquet"
    compression = plan.get("compression", "gzip")
    form = compression if first["lines"] else "tables"
    loading = texts["loading"].get(form) or text_of("loading.txt").rstrip()
    loading += "".join(texts["loading"].get(name, "") for name in plan.get("exports", ()))
    return text_of("readme.txt").format(
        name=plan["name"], origin=plan["origin"], program=layout["program"], shards=len(records),
        rows=sum(record["frames"] for record in records),
        targets=sum(sum(record["targets"].values()) for record in records),
        table=split_table(layout, records), splits=" | ".join(counts), rules="|".join("---:" for _ in counts),
        classes=class_table(counts), traffic="\n".join(map(traffic_of, plan["sources"])),
        radars="\n".join(radar_of(suite, folder) for suite in plan["suites"]), content_hash=content_hash,
        leak=texts["splits"][splits.get("by", "none")].format(gap_s=splits.get("gap_s")),
        lines=texts["lines"][form] + texts["bare"] * (plan.get("lines") == "without_objects"), shell=shlex.join(shell_of(plan)),
        tables=texts["tables"].format(form="Parquet" if parquet else f"CSV, {compression}") if plan.get("tables") else "",
        exports=texts["exports"].format(names=", ".join(plan["exports"])) if "exports" in plan else "",
        loading=loading.format(first=first["lines"] or first["tables"][0], split=first["split"], reader="parquet" if parquet else "csv"))
