"""What each harness of this folder starts from: the project's own data, and texts of its tests.

CORPORA has a function for each fuzz_*.c, which makes a list of inputs as bytes. It is called in the root of the
project, which is built.
"""
import glob
import gzip
import json
import os
import re
import subprocess
import sys

SCENES = ["cut-in", "intersection", "wet-road", "wheels-and-limbs", "walled-road", "corner-approach"]
SUITES = ["corner77", "lrr77-full", "srr24-pair", "radarscenes77-full", "lrr77-coherent"]


def printed(pipeline):
    return subprocess.run(["build/bin/glint", "-c", pipeline], check=True, stdout=subprocess.PIPE).stdout


def bytes_of(pattern):
    return [open(path, "rb").read() for path in sorted(glob.glob(pattern))]


def first_lines(pipeline, count=1):
    return b"".join(printed(pipeline).splitlines(keepends=True)[:count])


def frames():
    """Frames with every part: of objects, of reflectors, of echoes, of cells, of targets."""
    chain = ["traffic cut-in", "extract", "ideal --sensors lrr77-full --sections account,margins", "sensor", "noise"]
    made = [first_lines(" | ".join("glint-" + stage for stage in chain[:count + 1]), 2) for count in range(len(chain))]
    whole = "glint-traffic two-vehicles | glint-extract | glint-ideal --sensors corner77"\
            " --sections account,reflectors,echoes,cells"
    return made + [first_lines(whole + " | glint-sensor | glint-noise")]


def suite_and_frame():
    sys.path.insert(0, "tests/support")
    import suites as documents
    scenes = [first_lines("glint-traffic " + scene) for scene in SCENES]
    scenes += [first_lines(f"glint-traffic-random --density {density} --draw-conditions --frames 1 --seed {seed}")
               for density in ["sparse", "medium"] for seed in [1, 2]]
    scenes += [first_lines(f"glint-traffic {scene} | glint-extract") for scene in ["two-vehicles", "shadows"]]
    suites = []
    for name in SUITES:
        suite = documents.whole(name)
        for sensor in suite["sensors"]:
            for table in ["antenna_table", "range_curve", "azimuth_curve", "elevation_curve"]:
                if table in sensor:
                    sensor[table] = os.path.abspath(os.path.join("data/sensors", sensor[table]))
        suites.append(json.dumps(suite).encode())
    return [suite + b"\n" + scene for suite in suites for scene in scenes]


def traffic():
    """Scenarios and tables; those of highD and inD are the files beside them at once, so they have a single row."""
    names = "#{} Entity_Name [-],#{} bb_x [m],#{} bb_y [m],#{} bb_length [m],#{} bb_width [m],#{} bb_height [m],"\
            "#{} World_Position_X [m],#{} World_Position_Y [m],#{} Vel_X [m/s],#{} Vel_Y [m/s],"\
            "#{} World_Heading_Angle [rad],#{} Heading_Angle_Rate [rad/s],"
    log = "esmini GIT REV: N/A\nNumber of Vehicles: 2\nIndex [-],TimeStamp [s]," + "".join(
        names.replace("{}", str(number)) for number in (1, 2)) + "\n" + "".join(
            f"{i},{i / 20},Ego,1.4,0,5,2,1.5,{i},0,20,0,0.1,0,Other,1,0,2,0.6,1.5,{9 + i},3,20,0,0.1,0,\n" for i in range(3))
    tables = ["id,frame,x,y,width,height,xVelocity,yVelocity,class,drivingDirection,frameRate\n1,2,3,4,5,2,20,0,Car,2,25\n",
              "trackId,frame,xCenter,yCenter,heading,width,length,xVelocity,yVelocity,class,frameRate\n"
              "1,0,3,4,90,2,5,0,20,car,25\n",
              "".join(f"2  {i}  9  {1118846980200 + 100 * i}  16.4  {35 + 4 * i}.3  1  2  14.5  4.9  2  40  0  2  0  0  0  0\n"
                      for i in range(3)),
              "timestep_time;vehicle_id;vehicle_x;vehicle_y;vehicle_angle;vehicle_type;person_id;person_x\n"
              "0;a;1;2;90;passenger;;\n", log]
    with open("data/trajectories/highway.csv", "rb") as file:
        return bytes_of("data/scenarios/*.json") + [b"".join(file.readlines()[:12])] + [text.encode() for text in tables]


def floating_cars():
    """SUMO's data of its test, whole and cut; with types, as routes, and with heights."""
    text = re.search(r'^FCD = """(.*?)"""', open("tests/chain/recorded.py", encoding="utf-8").read(), re.S | re.M)[1]
    types = '<vTypeDistribution id="d"><vType id="bus" vClass="coach" length="13" width="2"/></vTypeDistribution>'
    steps = text.split("</timestep>")
    texts = ["</timestep>".join(steps[:count]) + "</timestep></fcd-export>" for count in range(1, len(steps))]
    texts += [text.replace("<fcd-export>", "<fcd-export>" + types), f"<routes>{types}</routes>",
              text.replace(" angle=", ' z="6.5" slope="3.4" angle=')]
    return [(text + " " * pad).encode() for text in texts for pad in range(4)]


def scenarios():
    """Scenarios of CommonRoad, of both versions: those of their test."""
    text = open("tests/chain/commonroad.py", encoding="utf-8").read()
    return [scenario.encode() for scenario in re.findall(r'= """(.*?</commonRoad>\n)"""', text, re.S)]


def traces():
    """Traces of OSI, whole and cut; with ids of 0 or without, said and not said, a view and data of a sensor, other fields."""
    sys.path.insert(0, "tests/support")
    from osi_messages import LANE, VERSION, message, moving, stamp, stationary, trace_of, whole
    made = []
    for zeros in (True, False):
        steps = [VERSION + stamp(i * 50_000_000, zeros) + message(3, whole(1, 0)) + (stationary(9, 4, 20, 5) if i == 0 else LANE)
                 + moving(0, 4, i, 0, 0.1, velocity=(20, 1), rate=0.3, rear=(-1.4, 0, -0.3), zeros=zeros)
                 + moving(7, 8, 9 + i, 3.0, size=(0, 0, 0), zeros=zeros) + moving(8, "pedestrian", 5, 5, 0.0) for i in range(4)]
        view = stamp(0) + message(7, steps[0]) + message(8, whole(1, 7))
        data = stamp(0) + message(8, view) + message(9, whole(1, 1)) + message(26, VERSION)
        made += [trace_of(*steps), trace_of(*steps)[:-9], trace_of(view, steps[1]), trace_of(*steps[:2]), trace_of(data, view)]
    return [trace + bytes(pad) for trace in made for pad in range(4)]


def tables():
    curves = [b"range_m,level_db\n1,40\n10,20\n100,0\n", b"azimuth_rad,level_db\n-1.5,-9\n0,0\n1.5,-8\n",
              b"elevation_rad,level_db\n-0.1,-3\n0.1,-4\n"]
    return bytes_of("data/antennas/*.csv") + curves + [b"azimuth_rad,sum,delta\n-1,0.2,-0.5\n0,1,0\n1,0.2,0.5\n"]


def numbers():
    return [b"0", b"-0.0", b"1e308", b"4.9e-324", b"123456.789012345678", b"9007199254740993", b"0.1e-6"]


def inputs():
    text = frames()[0]
    return [text, gzip.compress(text, mtime=0), gzip.compress(b"a\n", mtime=0) + gzip.compress(b"b", mtime=0)]


def tracks():
    track = '{"id":"a","x_m":1,"y_m":2,"vx_mps":3,"vy_mps":4}'
    return ["".join(f'{{"scene":"s","frame":{i},"time_s":{i},"tracks":[{track}]}}\n' for i in range(3)).encode()]


CORPORA = {
    "frame": frames, "chain": suite_and_frame, "suite": lambda: bytes_of("data/sensors/*.json"),
    "vehicle": lambda: bytes_of("data/vehicles/*.json"), "traffic": traffic, "table": tables, "number": numbers,
    "input": inputs, "tracks": tracks, "sumo": floating_cars, "commonroad": scenarios, "osi": traces,
    "pipeline": lambda: bytes_of("pipelines/*.sh") + [b"glint-extract <<'END' | glint-ideal --sensors lrr77\n{}\nEND\n# end\n"],
}
