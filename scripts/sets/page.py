"""The README.md of a data set: what is in it, its conventions, and how to load it."""
import collections
import shlex

from plan import kind_of, scene_of
from traffic import shell_of

PAGE = """\
# {name}

{origin}

{rows:,} frames in {shards} shards, with {targets:,} targets of all kinds, by {program}. `datapackage.json` describes every file
(Frictionless): rows, bytes, SHA-256 of the file (`hash`) and of its uncompressed bytes (`content_hash`), and the command
lines that made it. Its last line is the SHA-256 of all bytes before that line.

{table}

| targets, by what made most of each | {splits} |
|---|{rules}|
{classes}

Targets are made by glint from models: no radar has measured them. The traffic:

{traffic}

## Conventions

- {lines} `documents/schemas/` lists members and columns.{tables}
- SI units and radians; the unit is in the name of a member. Axes follow ISO 8855: x forward, y left, angles
  counter-clockwise. Azimuth counts from boresight, left positive; range rate is positive when receding.
- A frame is known by `scene` and `frame`: a scene's name is unique in the set. `objects` is the truth. A target's
  `contributors` are its label: `object`, `reflector`, `path` and `weight`, 1 in sum; the first is not always the
  strongest. `cell_...` are values without noise.
- A scan without targets is a frame all the same. `seed` is text, as it may have 64 bits.
- `documents/` has the radars and vehicles. `GLINT_DATA=documents {shell} '...'` repeats a command line; paths of
  recordings and of stages are from the folder of the plan.
- {leak}

## Loading

Run in the folder of the set.

{loading}"""
OF_GZIP = """\
pandas (tested):

```python
import pandas

frames = pandas.read_json("{first}", lines=True, dtype=False, convert_dates=False)
targets = pandas.json_normalize(frames.to_dict("records"), "targets", ["scene", "frame", "time_s"])
strongest = targets["contributors"].map(lambda parts: max(parts, key=lambda part: part["weight"])["object"])
print(len(frames), len(targets), strongest.nunique())
```

DuckDB (tested):

```sql
select scene, frame, target.sensor, target.range_m, target.azimuth_rad, target.range_rate_mps
from (select scene, frame, unnest(targets) as target from read_json('{split}/*/*.jsonl.gz', format = 'newline_delimited'))
order by scene, frame;
```

PyTorch (tested):

```python
import glob
import gzip
import json

import torch


class Frames(torch.utils.data.IterableDataset):
    \"\"\"Targets of a frame as rows of range, azimuth, range rate and amplitude, and its objects.

    Each worker reads shards of its own.
    \"\"\"

    def __init__(self, pattern):
        self.paths = sorted(glob.glob(pattern))

    def __iter__(self):
        worker = torch.utils.data.get_worker_info()
        for path in self.paths[worker.id::worker.num_workers] if worker else self.paths:
            with gzip.open(path, "rt", encoding="utf-8") as lines:
                for frame in map(json.loads, lines):
                    rows = [[target["range_m"], target["azimuth_rad"], target["range_rate_mps"], target["amplitude_db"]]
                            for target in frame["targets"]]
                    yield torch.tensor(rows).reshape(-1, 4), frame.get("objects")


loader = torch.utils.data.DataLoader(Frames("{split}/*/*.jsonl.gz"), batch_size=None, num_workers=2)
print(sum(len(targets) for targets, objects in loader))
```

MATLAB (tested with GNU Octave):

```matlab
folder = tempname();
names = gunzip("{first}", folder);
lines = strsplit(strtrim(fileread(names{{1}})), "\\n");
count = 0;
for i = 1:numel(lines)
    frame = jsondecode(lines{{i}});
    count = count + numel(frame.targets);
end
printed = sprintf("%d %d", numel(lines), count)
```
"""
OF_ZSTD = "`zstd -dc {split}/*/*.jsonl.zst` prints the lines; DuckDB's `read_json` reads them as they are.\n"
OF_TABLES = "`pandas.read_{reader}(\"{first}\")`; DuckDB reads CSV by glint's `schemas/tables.sql`, and Parquet as it is.\n"
LINES = {"gzip": "A shard is `SPLIT/SUITE/NUMBER.jsonl.gz`: gzip, one frame a line.",
         "zstd": "A shard is `SPLIT/SUITE/NUMBER.jsonl.zst`: zstd, one frame a line.", None: "A shard is its tables."}
BARE = " Lines have no `objects`; tables have them."
TABLES = """
- The tables of a shard ({form}) are in `SPLIT/SUITE/NUMBER/`. Whole numbers that are unique in the set join
  them: `frame_key` is a row of `frames`, `scan_key` of `scans`, `object_key` of `objects`, `detection_key` of
  `detections`."""
LEAKS = {None: "The set is one split.",
         "scene": "Splits share no scene: scenes were drawn one by one.",
         "time": "Splits are blocks of time; {gap_s} s between two of them are left out.",
         "recording": "Splits share no recording.",
         "kind": "Splits share no scene and no recorded time."}


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


def page_of(layout, records):
    plan, counts = layout["plan"], classes_by_split(layout, records)
    splits = plan.get("splits", {})
    first, parquet = layout["shards"][0], plan.get("tables") == "parquet"
    compression = plan.get("compression", "gzip") if first["lines"] else None
    loading = {"gzip": OF_GZIP, "zstd": OF_ZSTD, None: OF_TABLES}[compression]
    return PAGE.format(
        name=plan["name"], origin=plan["origin"], program=layout["program"], shards=len(records),
        rows=sum(record["frames"] for record in records),
        targets=sum(sum(record["targets"].values()) for record in records),
        table=split_table(layout, records), splits=" | ".join(counts), rules="|".join("---:" for _ in counts),
        classes=class_table(counts), traffic="\n".join(map(traffic_of, plan["sources"])),
        leak=LEAKS[splits.get("by")].format(gap_s=splits.get("gap_s")),
        lines=LINES[compression] + BARE * (plan.get("lines") == "without_objects"), shell=shlex.join(shell_of(plan)),
        tables=TABLES.format(form="Parquet" if parquet else "CSV, gzip") if plan.get("tables") else "",
        loading=loading.format(first=first["lines"] or first["tables"][0], split=first["split"], reader="parquet" if parquet else "csv"))
