"""scripts/bench --readers: what reading recorded traffic costs, beside its parser with empty handlers.

The reader reads all steps of a file, sorts them, and finds centres, velocities and yaw rates, but makes no frames: it is
asked for a time after the last step. Times are CPU time of whole processes, medians of runs that alternate; the ratio is
parser to reader, 1 where a reader costs nothing beside its parser.
"""
import json
import os
import statistics
import subprocess

import timing
from glint.progress import Progress

VEHICLES, STEPS, RUNS = 40, 10000, 5
PARSE_XML = os.path.join(timing.TOOLS, "parse_xml")
ROW = ('        <vehicle id="flow.{}" x="{:.2f}" y="{:.2f}" angle="{:.2f}" type="passenger" speed="{:.2f}" '
       'pos="{:.2f}" lane="ab_0" slope="0.00"/>\n')


def step(number, vehicles):
    """A step as SUMO writes it by default; vehicles drive in a row, and weave."""
    rows = []
    for i in range(vehicles):
        x = (number * 1.25 + 37 * i) % 1e5
        y = -1.6 + (number * (i + 7)) % 320 / 100
        rows.append(ROW.format(i, x, y, 90 - number * i % 11 / 10, 25 + i % 5, x))
    return f'    <timestep time="{number * 0.05:.2f}">\n{"".join(rows)}    </timestep>\n'


def write_floating_cars(path):
    with open(path, "w", encoding="utf-8") as file:
        file.write('<?xml version="1.0" encoding="UTF-8"?>\n<fcd-export>\n')
        for number in Progress("steps").over(range(STEPS)):
            file.write(step(number, VEHICLES))
        file.write("</fcd-export>\n")


def cpu_ns(words):
    """A reader ends with 65, because the ego that it is asked for is not there."""
    return timing.spent(["bash", "-c", '"$@" 2>/dev/null || [ $? = 65 ]', "-", *words])["spent"]["cpu_ns"]


def ratio_line(path, parser, reader):
    samples = [(cpu_ns([parser, path]), cpu_ns([*reader, path, "--ego", "nobody", "--from-s", "1e9"]))
               for _ in range(RUNS)]
    floor, own = (statistics.median(column) * 1e-9 for column in zip(*samples))
    size = os.path.getsize(path) / 1e6
    return {"reader": os.path.basename(reader[0]), "MB": round(size), "parser_MB/s": round(size / floor),
            "reader_MB/s": round(size / own), "parser_to_reader": round(floor / own, 2),
            "rows/s": round(STEPS * VEHICLES / own)}


def peak_line(reader, frames):
    """The peak of memory over so many frames, from a pipe."""
    words = [timing.SPENT, *reader, "-", "--ego", "flow.0"]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        process.stdin.write(b"<fcd-export>\n")
        for number in Progress("frames").over(range(frames)):
            process.stdin.write(step(number, 2).encode())
        process.stdin.write(b"</fcd-export>\n")
        process.stdin.close()
        told = json.loads(process.stderr.readlines()[-1])  # behind notices
    return {"reader": os.path.basename(reader[0]), "frames": frames, "peak_kB": told["peak_kB"]}


def lines(options, folder):
    reader = [os.path.join(os.path.dirname(options.glint), "glint-traffic-sumo")]
    path = os.path.join(folder, "fcd.xml")
    write_floating_cars(path)
    yield ratio_line(path, PARSE_XML, reader)
    for frames in (10**4, 10**5, 10**6):
        yield peak_line(reader, frames)
