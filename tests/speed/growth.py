"""scripts/bench --growth: what large inputs cost, and how the cost grows.

A case is a pipeline and its input for any size. CPU time is that of a whole fused run, from its start to its end. Growth
is the instructions that doubling a size adds, to those that doubling half the size adds: 2 where time is
proportional to size, 4 where it is to the square. Growth is counted at smaller
sizes; more than MOST is a fault.
"""
import json
import os
import re
import subprocess
import sys

import counts
import scenes
from glint.progress import Progress, say

MOST = 2.3
SUITE = "srr24-pair-every-frame"
RUNS = 3


def first_frame(glint, *commands):
    text = " | ".join(["glint-traffic two-vehicles", *commands])
    done = subprocess.run([glint, "-c", text], check=True, stdout=subprocess.PIPE)
    return json.loads(done.stdout.splitlines()[0])


def write(folder, name, *lines):
    path = os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(line + "\n" for line in lines)
    return path


def objects(glint, folder, size):
    """Cars at one place."""
    frame = first_frame(glint)
    ego, car = (next(one for one in frame["objects"] if (one["id"] == frame["ego"]) == is_ego)
                for is_ego in (True, False))
    frame["objects"] = [ego] + [dict(car, id=f"car {i:06}") for i in range(size)]
    path = write(folder, f"objects-{size}.jsonl", json.dumps(frame))
    return f"glint-extract {path} | glint-ideal --sensors {SUITE} | glint-sensor | glint-noise"


def objects_in_full(glint, folder, size):
    """The same, with account and margins."""
    return objects(glint, folder, size).replace(SUITE, SUITE + " --sections account,margins")


def speeds(glint, folder, size):
    """Echoes at one range, each in a cell of its own, with margins."""
    return echoes(glint, folder, size, lambda i: {"range_m": 20, "range_rate_mps": i - size / 2})


def cells(glint, folder, size):
    """Cells with margins."""
    return echoes(glint, folder, size, lambda i: {"range_m": 1 + i * 0.35, "range_rate_mps": i * 7 % 50})


def echoes(glint, folder, size, values_of):
    frame = first_frame(glint, "glint-extract", f"glint-ideal --sensors {SUITE} --sections margins")
    frame["echoes"] = [dict(frame["echoes"][0], reflector=f"point {i:06}", **values_of(i)) for i in range(size)]
    frame.pop("counts", None)
    path = write(folder, f"echoes-{size}.jsonl", json.dumps(frame))
    return f"glint-sensor {path} | glint-noise"


def sensors(glint, folder, size):
    """Sensors."""
    with open(os.path.join("data", "sensors", SUITE + ".json"), encoding="utf-8") as file:
        one = json.load(file)["sensors"][0]
    one.pop("sources", None)
    suite = {"origin": "For the bench.", "sensors": [dict(one, name=f"sensor {i * 7919 % size:06}")
                                                     for i in range(size)]}
    path = write(folder, f"sensors-{size}.json", json.dumps(suite))
    frame = write(folder, "frame.jsonl", json.dumps(first_frame(glint)))
    return f"glint-extract {frame} | glint-ideal --sensors {path} | glint-sensor | glint-noise"


def ids(_, folder, size):
    """Objects of a scenario."""
    scene = {"origin": "For the bench.", "ego": "0", "rate_hz": 10, "duration_s": 0,
             "objects": [{"id": str(i), "class": "car", "x_m": i} for i in range(size)]}
    return "glint-traffic " + write(folder, f"ids-{size}.json", json.dumps(scene))


def classes(_, folder, size):
    """Classes, an object each, in ten frames."""
    vehicles = os.path.join(folder, f"classes-{size}")
    os.makedirs(vehicles, exist_ok=True)
    with open(os.path.join("data", "vehicles", "car.json"), encoding="utf-8") as file:
        car = file.read()
    for i in range(size):
        write(vehicles, f"class_{i}.json", car)
    objects = [{"id": str(i), "class": f"class_{i}", "x_m": 5 * i} for i in range(size)]
    scenario = {"origin": "For the bench.", "ego": "0", "rate_hz": 10, "duration_s": 0.9, "objects": objects}
    source = f"glint-traffic {write(folder, f'classes-{size}.json', json.dumps(scenario))}"
    return f"{source} | glint-extract --vehicles {vehicles} | glint-ideal --sensors {SUITE} | glint-sensor | glint-noise"


def scene(folder, name, size, **way):
    """An object with so many parts of its way, and a frame for each."""
    there = {"id": "a", "class": "car", **way}
    document = {"origin": "For the bench.", "ego": "a", "rate_hz": 1, "duration_s": size, "objects": [there]}
    return "glint-traffic " + write(folder, f"{name}-{size}.json", json.dumps(document))


def waypoints(_, folder, size):
    """Waypoints, a frame each."""
    return scene(folder, "waypoints", size, waypoints=[{"time_s": i, "x_m": 9 * i, "y_m": i % 2} for i in range(size)])


def stops(_, folder, size):
    """Waypoints of one that stands, a frame each."""
    return scene(folder, "stops", size, waypoints=[{"time_s": i, "x_m": 9, "y_m": 0} for i in range(size)])


def segments(_, folder, size):
    """Segments, a frame each."""
    return scene(folder, "segments", size, segments=[{"duration_s": 1, "yaw_rate_radps": i % 3 - 1} for i in range(size)])


def columns(_, folder, size):
    """Columns of a table."""
    more = [f"column {i}" for i in range(size)]
    header = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width".split(",")
    row = "1,1,0,car,0,0,10,0,0,4,2".split(",")
    path = write(folder, f"columns-{size}.csv", ",".join(header + more), ",".join(row + ["0"] * size))
    return f"glint-traffic {path} --ego 1"


def users(_, folder, size):
    """Road users in a row of esmini's log."""
    names = ("Entity_Name [-],bb_x [m],bb_y [m],bb_length [m],bb_width [m],bb_height [m],World_Position_X [m],"
             "World_Position_Y [m],Vel_X [m/s],Vel_Y [m/s],World_Heading_Angle [rad],Heading_Angle_Rate [rad/s]").split(",")
    header = ["TimeStamp [s]"] + [f"#{i + 1} {name}" for i in range(size) for name in names]
    row = ["0"] + [f"u{i},1.4,0,5,2,1.5,{10 * i},0,20,0,0.1,0" for i in range(size)]
    return f"glint-traffic {write(folder, f'users-{size}.csv', ','.join(header), ','.join(row))} --ego u0"


def tag(_, folder, size):
    """Bytes of one tag of XML."""
    path = write(folder, f"tag-{size}.xml", "<fcd-export>", '<timestep time="0">',
                 f'<vehicle id="a" x="0" y="0" angle="90" note="{"x" * size}"/></timestep></fcd-export>')
    return f"glint-traffic-sumo {path} --ego a"


def types(_, folder, size):
    """Types of SUMO's vehicles."""
    path = write(folder, "types.xml", '<fcd-export><timestep time="0"><vehicle id="a" x="0" y="0" angle="90" type="t0"/>'
                 "</timestep></fcd-export>")
    routes = write(folder, f"types-{size}.xml", "<routes>", *(f'<vType id="t{i}" length="9"/>' for i in range(size)),
                   "</routes>")
    return f"glint-traffic-sumo {path} --types {routes} --ego a"


def ghosts(glint, folder, size):
    """Objects at one density, with ghosts."""
    path = os.path.join(folder, f"ghosts-{size}.jsonl")
    source, *rest = scenes.commands("highway", size, 1, 1, "full")
    subprocess.run([glint, "-c", f"{source} -o {path}"], check=True)
    return " | ".join([f"glint-extract {path}", *rest[1:]])


def losses(glint, folder, size):
    """Objects on a page, with their lost echoes."""
    path = os.path.join(folder, f"losses-{size}.jsonl")
    text = " | ".join(scenes.commands("highway", size, 1, 1, "account"))
    subprocess.run([glint, "-c", f"{text} -o {path}"], check=True)
    return f"glint-view {path} -o {path}.html"


def targets(glint, folder, size):
    """Targets of a scan, scored."""
    frame = first_frame(glint, "glint-extract", f"glint-ideal --sensors {SUITE}", "glint-sensor", "glint-noise")
    frame.pop("counts", None)
    paths = []
    for name, apart_m in (("truth", 0), ("listed", 0.1)):
        frame["targets"] = [dict(frame["targets"][0], range_m=1 + i * 0.618 % 1 * 200 + apart_m, range_rate_mps=i / 100)
                            for i in range(size)]
        paths.append(write(folder, f"{name}-{size}.jsonl", json.dumps(frame)))
    return f"glint-score --truth {' '.join(paths)}"


# Each with the size that the bench times and the size from which the guard doubles twice.
CASES = [(objects, 16000, 1000), (objects_in_full, 4000, 500), (speeds, 8000, 1000), (cells, 8000, 1000),
         (sensors, 10000, 100), (ids, 3000, 1000), (classes, 2000, 500), (waypoints, 2000, 250), (stops, 2000, 250), (segments, 2000, 250),
         (columns, 3000, 3000), (users, 1000, 250), (tag, 4000000, 1000000), (types, 40000, 2000), (ghosts, 2000, 500), (losses, 3000, 500),
         (targets, 8000, 1000)]


def cpu_s(glint, text):
    times = []
    for _ in range(RUNS):
        process = subprocess.Popen([glint, "-c", text], stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit(f"bench: {text} fails")
        times.append(used.ru_utime + used.ru_stime)
    return min(times)


def instructions(glint, text):
    """Those of a whole run; readers hash by a random seed, which changes less than a thousandth."""
    done = subprocess.run(["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
                           glint, "-c", text],
                          env=dict(counts.ENVIRONMENT, GLINT_DATA=os.path.abspath("data")), check=True,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    return int(re.search(r"I +refs: +([\d,]+)", done.stderr).group(1).replace(",", ""))


def growth(glint, case, size, folder):
    few, some, many = (instructions(glint, case(glint, folder, n)) for n in (size, 2 * size, 4 * size))
    return (many - some) / (some - few)


def run(options, folder):
    """Prints a line for each case; returns the exit status, which growth alone decides."""
    say("    size   CPU time   growth   of")
    faster = 0
    for case, size, small in Progress("cases").over(CASES, cost=lambda _: 1):
        measured = growth(options.glint, case, small, folder) if counts.available() else 0
        say(f"{size:8,} {cpu_s(options.glint, case(options.glint, folder, size)):8.3f} s {measured:8.2f}   {case.__doc__}")
        faster += measured > MOST
    if faster > 0:
        say(f"bench: {faster} grow faster than {MOST}")
    return 1 if faster > 0 else 0
