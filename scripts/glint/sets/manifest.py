"""Finishes a data set: its README, its schema of frames, and last its manifest, datapackage.json."""
import json
import os

from glint.places import SCHEMAS
from glint.sets import pace, readme
from glint.sets.documents import DOCUMENTS, described
from glint.sets.durable import alone, digest_of, make_folder, remove_temporaries, sync_folder, write_whole
from glint.sets.layout import WORK
from glint.sets.plan import kind_of, read_json
from glint.sets.shard import MANIFEST, record_path

README, FRAME, OWN_SCHEMAS = "README.md", "frame", f"{DOCUMENTS}/schemas"
SUMS = "rows", "bytes", "content_bytes"
MEDIA = {"jsonl": "application/jsonl", "csv": "text/csv", "parquet": "application/vnd.apache.parquet"}


def frame_fields():
    """A Table Schema of the frame's members, from glint's own schema."""
    frame = read_json(os.path.join(SCHEMAS, "frame.json"))
    fields = [{"name": name, "type": member.get("type", "any"), "description": member.get("description", "")}
              for name, member in frame["properties"].items()]
    return {"fields": fields, "primaryKey": ["scene", "frame"]}


def schemas_of(layout):
    """The Table Schemas of what the set has, by the paths that they get.

    A foreign key names a resource. It is left out here, as every shard has resources of its own by the same schema.
    """
    of_tables = read_json(os.path.join(SCHEMAS, "tables.json")) if layout["plan"].get("tables") else {}
    for schema in of_tables.values():
        schema.pop("foreignKeys", None)
    of_lines = {} if layout["plan"].get("lines") == "none" else {FRAME: frame_fields()}
    return {f"{OWN_SCHEMAS}/{name}.json": schema for name, schema in {**of_lines, **of_tables}.items()}


def kind_of_file(path):
    """What Frictionless says of a file of lines, or of a table."""
    name, form, *compression = os.path.basename(path).split(".")
    kind = {"format": form, "mediatype": MEDIA[form]}
    kind |= {"encoding": "utf-8", "compression": compression[0]} if compression else {}
    return kind | {"schema": f"{OWN_SCHEMAS}/{FRAME if form == 'jsonl' else name}.json"}


def resource_of(file, shard):
    """A shard's file, in the words of Frictionless and our own."""
    name = file["path"].lower().split(".")[0]
    return {"name": name, "path": file["path"], "profile": "data-resource", **kind_of_file(file["path"]),
            "split": shard["split"], "suite": shard["suite"],
            **{member: file[member] for member in ("rows", "bytes", "hash", "content_bytes", "content_hash")},
            "commands": shard["commands"]}


def content_hash(resources):
    """One digest of all uncompressed bytes: of the lines that sha256sum would print of them."""
    lines = [f"{resource['content_hash'].removeprefix('sha256:')}  {resource['path']}\n" for resource in resources]
    return digest_of("".join(lines).encode())


def sums_of(resources):
    """What the manifest says of all resources together."""
    sums = {name: sum(resource[name] for resource in resources) for name in SUMS}
    return sums | {"content_hash": content_hash(resources)}


def origins_of(sources):
    """Licences and sources of recordings, if there are any, in the words of Frictionless."""
    recorded = [source for source in sources if kind_of(source) == "recording"]
    found = {"licenses": [{"name": name} for name in sorted({source["licence"] for source in recorded})],
             "sources": [{"title": title} for title in sorted({source["source"] for source in recorded})]}
    return found if recorded else {}


def resources_of(layout, records):
    return [resource_of(file, layout["shards"][record["part"]]) for record in records for file in record["files"]]


def package_of(layout, records, documents):
    plan, resources = layout["plan"], resources_of(layout, records)
    return {"profile": "data-package", "name": plan["name"], "description": plan["origin"],
            **origins_of(plan["sources"]),
            "program": layout["program"], "identity": layout["identity"], "plan": plan,
            "frames": sum(record["frames"] for record in records),
            **sums_of(resources),
            "inputs": layout["inputs"], "documents": documents, "resources": resources}


def finish(layout, folder):
    """Writes README and manifest of a set whose shards are all there."""
    work = os.path.join(folder, WORK)
    with alone(work):
        records = [read_json(record_path(folder, part)) for part in range(len(layout["shards"]))]
        for path, fields in schemas_of(layout).items():
            make_folder(os.path.dirname(os.path.join(folder, path)))
            write_whole(os.path.join(folder, path), work, json.dumps(fields, indent=1, ensure_ascii=False) + "\n")
        page = readme.readme_of(layout, records, folder, content_hash(resources_of(layout, records)))
        write_whole(os.path.join(folder, README), work, page)
        names = [*(document["path"] for document in layout["documents"]), *schemas_of(layout), README]
        package = package_of(layout, records, described({name: name for name in names}, folder))
        if os.path.exists(os.path.join(folder, pace.PATH)):
            os.remove(os.path.join(folder, pace.PATH))
        remove_temporaries(work, of_all=True)
        sync_folder(work)
        text = json.dumps(package, indent=1, ensure_ascii=False).removesuffix("\n}") + ",\n"
        # The last line holds the digest of all bytes before that line.
        write_whole(os.path.join(folder, MANIFEST), work, text + f' "digest": "{digest_of(text.encode())}"}}\n')
        return package
