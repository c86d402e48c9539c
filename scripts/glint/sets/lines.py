"""The lines of a shard: packed by gzip or zstd, with size and digest before and after, and counted for the line of progress."""
import hashlib
import os
import zlib

from glint import zstd
from glint.sets.durable import digest_of_file

ENDINGS = {"gzip": ".jsonl.gz", "zstd": ".jsonl.zst"}
# gzip: tables of this size (memLevel) stay in a core's cache, which is two per cent faster than zlib's default, and packs
# as well. Packed bytes depend on the content, the level, and the version of zlib or zstd.
GZIP, TABLES = 16 + zlib.MAX_WBITS, 7


def packer_of(plan):
    if plan.get("compression") == "zstd":
        return zstd.Packer(plan.get("level", 1))
    return zlib.compressobj(plan.get("level", 1), zlib.DEFLATED, GZIP, TABLES)


class Lines:
    """Packs the lines of a shard into a file, or into none (None)."""

    def __init__(self, plan, file, pace):
        self.file, self.pace, self.plain, self.plain_bytes = file, pace, hashlib.sha256(), 0
        self.packer = file and packer_of(plan)

    def write(self, lines):
        self.plain.update(lines)
        self.plain_bytes += len(lines)
        self.file.write(self.packer.compress(lines))
        self.pace.add(lines)

    def facts(self, rows):
        """Ends the file; its entry in the manifest."""
        self.file.write(self.packer.flush())
        self.file.flush()
        return {"rows": rows, "bytes": os.path.getsize(self.file.name), "hash": digest_of_file(self.file.name),
                "content_bytes": self.plain_bytes, "content_hash": "sha256:" + self.plain.hexdigest()}
