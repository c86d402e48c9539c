"""Writes an export, in parts side by side if the caller has cores for them.

A part is some streams that follow each other, in a process of its own. A survey of all streams comes first, as numbers of scans,
times and titles follow those of earlier streams. If streams cannot be parted, they are one part without a survey. The bytes are the same.
"""
import importlib
from collections import Counter, namedtuple

from glint.exports.folder import TABLES, Folder, Part
from glint.exports.processes import answer_of, side_by_side
from glint.exports.streams import HEIGHT_M, Scenes, frames_of, is_read_again
from glint.progress import Progress
from glint.sets.durable import new_folder
from glint.sets.plan import Fault

PARTS_OF_A_JOB = 4  # so that all jobs end at about the same time
Written = namedtuple("Written", "scenes notes lacking counted assumed rest")  # what a part has to say, and what its layout needs at the end


def survey(streams):
    """The scenes of a part, up to its first fault. That is told when the part is written, as an earlier frame may have another one."""
    scenes = Scenes()

    def read(streams):
        for _ in frames_of(streams, scenes, heads=True):
            pass

    scenes.fault = answer_of(read, streams)[1]
    return scenes


def parts_of(streams, jobs):
    """The streams of each part, and its survey. All streams are one part if a scene has frames in several, or a stream is a pipe."""
    if jobs > 1 and len(streams) > 1 and all(map(is_read_again, streams)):
        count = min(len(streams), PARTS_OF_A_JOB * jobs)
        parts = [streams[len(streams) * i // count:len(streams) * (i + 1) // count] for i in range(count)]
        surveys = side_by_side(survey, parts, jobs)
        if not Scenes.are_shared(surveys):
            return parts, surveys
    return [Progress("streams").over(streams)], [Scenes()]


def write_part(task):
    writer, layout, path, number, streams, start = task
    scenes = Scenes()
    with Part(path, number) as part:
        written = writer(layout, part, start)
        for split, frame in frames_of(streams, scenes):
            written.add(split, frame)
        rest = written.close()
    return Written(scenes, part.notes, part.lacking, part.counted, part.assumed, rest)


def notes_of(written, layout):
    """What stands in the files for something that nobody has measured, and what else users must know."""
    notes, lacking, counted, assumed = {}, Counter(), Counter(), {}
    for part in written:
        notes |= part.notes
        lacking.update(part.lacking)
        counted.update(part.counted)
        assumed |= part.assumed
    notes |= {text.format(lacking[text], counted[text]): None for text in counted if lacking[text]}
    if assumed:
        notes[f"{HEIGHT_M} m is taken as the height of radars that have no mount_z_m: {', '.join(assumed)}"] = None
    return [*notes, *layout.get("constants", ())]


def write(layout, out, streams, jobs):
    """Writes the frames of streams into a folder that gets its name when all is there; what users must know of it."""
    writer = importlib.import_module("glint.exports." + layout["layout"]).Writer
    with new_folder(out, "--out") as path:
        parts, surveys = parts_of(streams, jobs)
        tasks = [(writer, layout, path, i, part, start) for i, (part, start) in enumerate(zip(parts, writer.starts(surveys)))]
        written = side_by_side(write_part, tasks, jobs)
        if wrong := [one.fault for one in surveys if one.fault]:  # of an input that has changed since
            raise Fault(*wrong[0])
        Scenes.tell_of_empty([part.scenes for part in written])
        folder = Folder(path)
        for name, heading in TABLES.items():
            folder.join(f"glint-{name}.csv", len(parts), ",".join(heading) + "\n")
        writer.finish(layout, folder, [part.rest for part in written])
    return notes_of(written, layout)
