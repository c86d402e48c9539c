"""The lines of a shard: packed by gzip or zstd(1), with size and digest before and after, and counted for the line of progress."""
import hashlib
import os
import subprocess
import zlib

from glint.sets.durable import digest_of_file
from glint.sets.plan import IO, Fault

ENDINGS = {"gzip": ".jsonl.gz", "zstd": ".jsonl.zst"}
# gzip: tables of this size (memLevel) stay in a core's cache, which is two per cent faster than zlib's default, and packs
# as well. Packed bytes depend on the content, the level, and the version of zlib or zstd.
GZIP, TABLES = 16 + zlib.MAX_WBITS, 7


class Gzip:
    def __init__(self, file, level):
        self.file, self.packer = file, zlib.compressobj(level, zlib.DEFLATED, GZIP, TABLES)

    def write(self, lines):
        self.file.write(self.packer.compress(lines))

    def close(self):
        self.file.write(self.packer.flush())


class Zstd:
    def __init__(self, file, level):
        self.process = subprocess.Popen(["zstd", "-q", f"-{level}"], stdin=subprocess.PIPE, stdout=file)

    def write(self, lines):
        try:
            self.process.stdin.write(lines)
        except BrokenPipeError:
            self.close()

    def close(self):
        self.process.communicate()
        if self.process.returncode != 0:
            raise Fault(IO, f"exit status {self.process.returncode}: zstd")


class Lines:
    """Packs the lines of a shard into a file, or into none (None)."""

    def __init__(self, plan, file, pace):
        packers = {"gzip": Gzip, "zstd": Zstd}
        self.file, self.pace, self.plain, self.plain_bytes = file, pace, hashlib.sha256(), 0
        self.packer = file and packers[plan.get("compression", "gzip")](file, plan.get("level", 1))

    def write(self, lines):
        self.plain.update(lines)
        self.plain_bytes += len(lines)
        self.packer.write(lines)
        self.pace.add(lines)

    def facts(self, rows):
        """Ends the file; its entry in the manifest."""
        self.packer.close()
        self.file.flush()
        return {"rows": rows, "bytes": os.path.getsize(self.file.name), "hash": digest_of_file(self.file.name),
                "content_bytes": self.plain_bytes, "content_hash": "sha256:" + self.plain.hexdigest()}
