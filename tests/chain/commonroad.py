"""Traffic of CommonRoad against an independent reading by Python's own XML parser.

Usage: python3 tests/chain/commonroad.py BIN_DIR
"""
import gzip
import math
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import recorded  # noqa: E402
from recorded import (  # noqa: E402
    BIN, DATA, add_slopes, check, check_mirrored, compare, egos_as_if_alone, refuses, run, save)

PROGRAM = "glint-traffic-commonroad"
CLASSES = {"car": "car", "truck": "truck", "bus": "bus", "motorcycle": "motorcycle", "bicycle": "bicycle",
           "pedestrian": "pedestrian", "parkedVehicle": "car", "roadBoundary": "guardrail"}

NEW = """<?xml version="1.0" encoding="UTF-8"?>
<commonRoad timeStepSize="0.1" commonRoadVersion="2020a" benchmarkID="OWN_1">
  <!-- <dynamicObstacle id="none"> -->
  <lanelet id="5"><leftBound><point><x>1</x><y>2</y></point></leftBound></lanelet>
  <staticObstacle id="9">
    <type>parkedVehicle</type>
    <shape><rectangle><length>4.4</length><width>1.7</width></rectangle></shape>
    <initialState>
      <position><point><x>40</x><y>-4</y></point></position>
      <orientation><exact>1.5</exact></orientation><time><exact>0</exact></time>
    </initialState>
  </staticObstacle>
  <dynamicObstacle id="30">
    <type>car</type>
    <shape><rectangle><length>4.5</length><width>1.8</width></rectangle></shape>
    <initialState>
      <position><point><x>10</x><y>0</y></point></position>
      <orientation><exact>0.1</exact></orientation><time><exact>2</exact></time>
      <velocity><exact>12</exact></velocity><slipAngle><exact>0.02</exact></slipAngle><yawRate><exact>0.3</exact></yawRate>
    </initialState>
    <initialSignalState><horn>false</horn></initialSignalState>
    <trajectory>
      <state>
        <position><point><x>11.2</x><y>0.1</y></point></position>
        <orientation><exact>0.13</exact></orientation><time><exact>3</exact></time>
        <velocity><exact>12.1</exact></velocity><velocityY><exact>0.4</exact></velocityY>
      </state>
      <state>
        <position><point><x>12.4</x><y>0.25</y></point></position>
        <orientation><exact> 0.16
        </exact></orientation><time><exact>4</exact></time>
        <velocity><exact>-12.2</exact></velocity>
      </state>
    </trajectory>
    <signalSeries><signalState><horn>true</horn><time><exact>77</exact></time></signalState></signalSeries>
  </dynamicObstacle>
  <dynamicObstacle id="31">
    <type>truck</type>
    <shape><polygon><point><x>-1</x><y>-1</y></point><point><x>-1</x><y>1.5</y></point><point><x>6</x><y>1</y></point></polygon>
      <rectangle><length>2</length><width>2</width><orientation>0.5</orientation><center><x>-2</x><y>0</y></center></rectangle></shape>
    <initialState>
      <position><point><x>60</x><y>3</y></point></position>
      <orientation><exact>3.1</exact></orientation><time><exact>3</exact></time><velocity><exact>9</exact></velocity>
    </initialState>
    <trajectory>
      <state>
        <position><point><x>59</x><y>3.1</y></point></position>
        <orientation><exact>-3.1</exact></orientation><time><exact>4</exact></time><velocity><exact>9</exact></velocity>
      </state>
    </trajectory>
  </dynamicObstacle>
  <dynamicObstacle id="32">
    <type>pedestrian</type>
    <shape><circle><radius>0.3</radius></circle></shape>
    <initialState>
      <position><point><x>20</x><y>8</y></point></position>
      <time><exact>2</exact></time><velocity><exact>0.6</exact></velocity><velocityY><exact>-0.8</exact></velocityY>
    </initialState>
    <occupancySet><occupancy><shape><rectangle><length>9</length><width>9</width></rectangle></shape>
      <time><exact>3</exact></time></occupancy></occupancySet>
  </dynamicObstacle>
  <environmentObstacle id="40"><type>building</type><shape><polygon><point><x>0</x><y>0</y></point></polygon></shape>
  </environmentObstacle>
  <planningProblem id="1"><initialState><position><point><x>0</x><y>0</y></point></position>
    <time><exact>0</exact></time></initialState></planningProblem>
</commonRoad>
"""

OLD = """<commonRoad timeStepSize="0.2" commonRoadVersion="2018b">
  <obstacle id="7">
    <role>dynamic</role>
    <type>bus</type>
    <shape><rectangle><length>12</length><width>2.5</width></rectangle></shape>
    <initialState>
      <position><rectangle><length>0.5</length><width>0.3</width><orientation>-1.9</orientation>
        <center><x>700351.66</x><y>-5866.33</y></center></rectangle></position>
      <orientation><intervalStart>0.01</intervalStart><intervalEnd>0.03</intervalEnd></orientation>
      <time><exact>0</exact></time>
      <velocity><intervalStart>27</intervalStart><intervalEnd>27.5</intervalEnd></velocity>
    </initialState>
    <trajectory><state>
      <position><circle><radius>1</radius><center><x>700357</x><y>-5866.2</y></center></circle></position>
      <orientation><intervalStart>0.02</intervalStart><intervalEnd>0.04</intervalEnd></orientation>
      <time><exact>1</exact></time>
      <velocity><intervalStart>26</intervalStart><intervalEnd>28</intervalEnd></velocity>
    </state></trajectory>
  </obstacle>
  <obstacle id="8">
    <role>static</role>
    <type>roadBoundary</type>
    <shape><rectangle><length>30</length><width>0.4</width></rectangle></shape>
    <initialState>
      <position><polygon><point><x>700360</x><y>-5870</y></point><point><x>700364</x><y>-5870</y></point>
        <point><x>700362</x><y>-5868</y></point></polygon></position>
      <orientation><exact>0.2</exact></orientation><time><exact>0</exact></time>
    </initialState>
  </obstacle>
</commonRoad>
"""


def number(element, name, absent=None):
    part = element.find(name) if element is not None else None
    return absent if part is None else float(part.text)


def middle(state, name):
    part = state.find(name)
    if part is None:
        return None
    exact = part.find("exact")
    ends = [exact, exact] if exact is not None else [part.find("intervalStart"), part.find("intervalEnd")]
    return (float(ends[0].text) + float(ends[1].text)) / 2


def corners(region, absent):
    """Points whose bounding box is that of the parts of a region."""
    for part in region:
        if part.tag == "point":
            yield float(part.find("x").text), float(part.find("y").text)
        elif part.tag == "polygon":
            yield from corners(part, absent)
        else:
            at = part.find("center")
            x, y = number(at, "x", absent), number(at, "y", absent)
            if part.tag == "circle":
                reach = float(part.find("radius").text)
                yield from ((x - reach, y - reach), (x + reach, y + reach))
                continue
            length, width = float(part.find("length").text), float(part.find("width").text)
            turn = number(part, "orientation", 0)
            for ahead, left in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
                dx, dy = ahead * length / 2, left * width / 2
                yield x + dx * math.cos(turn) - dy * math.sin(turn), y + dx * math.sin(turn) + dy * math.cos(turn)


def box(region, absent=None):
    points = list(corners(region, absent))
    low = [min(point[i] for point in points) for i in (0, 1)]
    high = [max(point[i] for point in points) for i in (0, 1)]
    return (low[0] + high[0]) / 2, (low[1] + high[1]) / 2, high[0] - low[0], high[1] - low[1]


def track_of(obstacle, step_s):
    """[(time, state)] with what the file says, the body's middle as place."""
    ahead, left, length, width = box(obstacle.find("shape"), 0)
    track = []
    for state in [obstacle.find("initialState"), *obstacle.findall("trajectory/state")]:
        x, y, _, _ = box(state.find("position"))
        yaw, speed = middle(state, "orientation"), middle(state, "velocity")
        side, slip = middle(state, "velocityY"), middle(state, "slipAngle")
        one = {"class": CLASSES[obstacle.find("type").text], "length_m": length, "width_m": width, "x_m": x, "y_m": y,
               "yaw_rate_radps": middle(state, "yawRate"), "vx_mps": None, "vy_mps": None, "yaw_rad": yaw}
        if yaw is None:
            one |= {"vx_mps": speed, "vy_mps": side, "yaw_rad": math.atan2(side, speed)}
        elif speed is not None:
            vector = complex(speed, side) if side is not None else speed * complex(math.cos(slip or 0), math.sin(slip or 0))
            vector *= complex(math.cos(yaw), math.sin(yaw))
            one |= {"vx_mps": vector.real, "vy_mps": vector.imag}
        if ahead or left:
            one["x_m"] += ahead * math.cos(yaw) - left * math.sin(yaw)
            one["y_m"] += ahead * math.sin(yaw) + left * math.cos(yaw)
            one["vx_mps"] = one["vy_mps"] = None
        track.append((round(middle(state, "time") * step_s, 9), one))
    return track


def expected_of(text):
    """{time: {id: state}} of a scenario."""
    root, steps, stills = ElementTree.fromstring(text), {}, {}
    for obstacle in root:
        if obstacle.tag not in ("obstacle", "dynamicObstacle", "staticObstacle"):
            continue
        track = track_of(obstacle, float(root.get("timeStepSize")))
        role = obstacle.find("role")
        if obstacle.tag == "staticObstacle" or (role is not None and role.text == "static"):
            stills[obstacle.get("id")] = track[0][1] | {"vx_mps": 0, "vy_mps": 0, "yaw_rate_radps": 0}
            continue
        add_slopes(track)
        for time, one in track:
            steps.setdefault(time, {})[obstacle.get("id")] = one
    return {time: users | stills for time, users in steps.items()}


def exactness(folder):
    new, old = save(folder, "new.xml", NEW), save(folder, "old.xml", OLD)
    for ego in ("30", "31", "32", "9"):
        compare(run(PROGRAM, new, "--ego", ego), expected_of(NEW), ego)
    compare(run(PROGRAM, old, "--ego", "7"), expected_of(OLD), "7")
    compare(run(PROGRAM, "-", "--ego", "7", data=OLD.encode()), expected_of(OLD), "7")
    with gzip.open(new + ".gz", "wb") as file:
        file.write(NEW.encode())
    compare(run(PROGRAM, new + ".gz", "--ego", "30"), expected_of(NEW), "30")
    if DATA is None:
        print("skipped  scenarios of CommonRoad: GLINT_TEST_DATA is not set")
        return
    for name in ("DEU_A9-3_1_T-1.xml", "FRA_Anglet-1_1_T-1.xml"):
        with open(f"{DATA}/commonroad/{name}", encoding="utf-8") as file:
            expected = expected_of(file.read())
        for ego in {ego for users in expected.values() for ego in users}:
            compare(run(PROGRAM, f"{DATA}/commonroad/{name}", "--ego", ego), expected, ego)


def shared_options(folder):
    path = os.path.join(folder, "new.xml")
    for words in ((), ("--radius-m", "20"), ("--rate-hz", "25"), ("--from-s", "0.25", "--to-s", "0.3")):
        together = egos_as_if_alone(PROGRAM, path, *words)
        check("30" in together and "32" not in together, f"egos are all but pedestrians: {list(together)}")
    near = run(PROGRAM, path, "--ego", "30", "--radius-m", "20")
    check([part["id"] for part in near[0]["objects"]] == ["30", "32"], "--radius-m")
    mapped = run(PROGRAM, path, "--ego", "30", "--class-map", "truck=bus,parkedVehicle=van")
    check([part["class"] for part in mapped[1]["objects"]] == ["car", "bus", "van"], "--class-map")
    save(folder, "strange.xml", NEW.replace("<type>truck</type>", "<type>unknown</type>"))
    mapped = run(PROGRAM, os.path.join(folder, "strange.xml"), "--ego", "30", "--class-default", "post")
    check(mapped[1]["objects"][1]["class"] == "post", "--class-default")
    lines = re.findall(r"\n    ([a-z]+): (.*)", os.popen(f"{BIN}/{PROGRAM} --help").read())
    listed = {word: class_ for class_, words in lines for word in words.split(", ")}
    check(listed.items() >= CLASSES.items(), "--help has the classes")


def flip(match):
    return f"{match[1]}{-float(match[2])}{match[3]}"


def a_mirrored_world_is_mirrored(folder):
    """Every y and every angle changes its sign; an interval also the order of its ends."""
    for name, text, ego in (("new.xml", NEW, "30"), ("old.xml", OLD, "7")):
        text = re.sub(r"(<y>)([^<]*)(</y>)", flip, text)
        text = re.sub(r"(<(?:orientation|yawRate|slipAngle|velocityY)><exact>)([^<]*)(</exact>)", flip, text)
        text = re.sub(r"(<rectangle>[^\n]*<orientation>)([^<]*)(</orientation>)", flip, text)
        text = re.sub(r"<orientation><intervalStart>([^<]*)</intervalStart><intervalEnd>([^<]*)</intervalEnd>",
                      r"<orientation><intervalStart>-\2</intervalStart><intervalEnd>-\1</intervalEnd>", text)
        mirrored = run(PROGRAM, save(folder, "mirrored.xml", text), "--ego", ego)
        check_mirrored(run(PROGRAM, os.path.join(folder, name), "--ego", ego), mirrored)


def big(folder, count, steps=1000):
    """So many obstacles, each with a state in every step."""
    with open(os.path.join(folder, "big.xml"), "w", encoding="ascii") as file:
        file.write('<commonRoad timeStepSize="0.1" commonRoadVersion="2020a">')
        for i in range(count):
            file.write(f'<dynamicObstacle id="{i}"><type>car</type><shape><rectangle><length>4</length><width>2</width>'
                       "</rectangle></shape>")
            for k in range(steps):
                head, tag = ("<trajectory>" if k == 1 else ""), ("state" if k else "initialState")
                file.write(f"{head}<{tag}><position><point><x>{10 * i + k}</x><y>{i}</y></point></position><orientation><exact>0"
                           f"</exact></orientation><time><exact>{k}</exact></time><velocity><exact>10</exact></velocity></{tag}>")
            file.write("</trajectory></dynamicObstacle>")
        file.write("</commonRoad>")
    return count * steps


def memory_is_64_bytes_a_row(folder):
    """The most that was resident once the first frame is there, when all rows have been read."""
    most = {}
    for count in (40, 120):
        rows = big(folder, count)
        with subprocess.Popen([os.path.join(BIN, PROGRAM), os.path.join(folder, "big.xml"), "--ego", "0", "--radius-m", "0"],
                              stdout=subprocess.PIPE) as process:
            process.stdout.readline()
            with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
                most[rows] = int(re.search(r"VmHWM:\s+(\d+) kB", file.read())[1]) * 1024
            frames = process.stdout.read().count(b"\n")
        check(process.returncode == 0 and frames == 999, f"{rows} rows: {frames} frames more")
    (few, less), (many, more) = most.items()
    print(f"commonroad: {(more - less) / (many - few):.1f} bytes of memory a row")
    check(more - less <= 70 * (many - few), f"memory: {most}")


ONCE = ("shape", "position", "type", "role", "initialState", "trajectory")


def what_stands_twice_is_refused(folder):
    """Every element of which an obstacle has one, each number with a blank inside, and texts around an element."""
    tried = set()
    for text, ego in ((NEW, "30"), (OLD, "7")):
        ignored = r"<!--.*?-->|<(lanelet|signalSeries|planningProblem|occupancySet|environmentObstacle)\b.*?</\1>"
        left_out = [match.span() for match in re.finditer(ignored, text, re.S)]
        leaves = "x|y|length|width|radius|orientation|exact|intervalStart|intervalEnd|type|role"
        others = "initialState|trajectory|shape|position|time|velocity|yawRate|slipAngle|velocityY|orientation|center"
        for match in re.finditer(rf"(?=(<({leaves})>([^<]*)</\2>|<({others})>.*?</\4>))", text, re.S):
            if any(first <= match.start() < end for first, end in left_out):
                continue
            whole, name, value = match[1], match[2] or match[4], match[3]
            broken = [(whole * 2, f'a second element is "{name}"; expected one' if name in ONCE
                       else "; expected a single value")]
            if value and re.fullmatch(r"[-0-9.e]+", value):
                broken += [(f"<{name}>1 {value}</{name}>", f'is "1 {value}"; expected a number in '),
                           (f"<{name}>1\n  {value}</{name}>", "; expected a number in "),
                           (f"<{name}>1<note/>{value}</{name}>", 'an element is "note"; expected no text before it'),
                           (f"<{name}>{value} m</{name}>", f'is "{value} m"; expected a number in ')]
            for new, message in broken:
                path = save(folder, "twice.xml", text[:match.start()] + new + text[match.start() + len(whole):])
                done = subprocess.run([os.path.join(BIN, PROGRAM), path, "--ego", ego], capture_output=True, check=False)
                said = done.stderr.decode()
                check(done.returncode == 65 and message in said and ": line " in said, f"{whole} -> {new}: {said}")
            tried.add(name)
    check(len(tried) >= 18, f"elements: {sorted(tried)}")
    plain = run(PROGRAM, save(folder, "same.xml", NEW), "--ego", "30")
    for new in ("<x> 10 </x>", "<x>\n\t10\n</x>", "<x>1<!-- m -->0</x>", "<x><![CDATA[10]]></x>", "<x>&#49;0</x>"):
        check(run(PROGRAM, save(folder, "same.xml", NEW.replace("<x>10</x>", new, 1)), "--ego", "30") == plain,
              f"{new} is 10, as every reader of XML has it")


def bad_input(folder):
    number_of = "expected a number in "
    cases = [
        ("<commonRoad", "<commonRode", "line 2: <commonRoad> is missing; expected a scenario of CommonRoad"),
        ('"2020a"', '"2017a"', 'line 2: commonRoadVersion is "2017a"; expected 2018b or 2020a'),
        (' commonRoadVersion="2020a"', "", "line 2: commonRoadVersion is missing; expected 2018b or 2020a"),
        ('timeStepSize="0.1" ', "", "line 2: timeStepSize is missing; " + number_of),
        ('timeStepSize="0.1"', 'timeStepSize="0"', 'line 2: timeStepSize is "0"; expected a number in [1e-06, 1000]'),
        ('<dynamicObstacle id="30">', "<dynamicObstacle>", "line 13: id is missing; expected 1 to 1024 printable ASCII"),
        ('<dynamicObstacle id="30">', '<dynamicObstacle id="">', 'line 13: id is ""; expected 1 to 1024 printable ASCII'),
        ("<type>car</type>", "", "line 20: type is missing; expected one for every state; type and shape stand before"),
        ("<type>car</type>", "<type>hovercraft</type>", 'line 20: unknown class "hovercraft"; expected a word that --help lists'),
        ("<shape><rectangle><length>4.5</length><width>1.8</width></rectangle></shape>", "",
         "line 20: shape is missing; expected one for every state; type and shape stand before"),
        ("<length>4.5", "<length>long", 'line 15: length is "long"; expected a number in [0, 1e+06]'),
        ("<length>4.5", "<length>-4.5", 'line 15: length is "-4.5"; expected a number in [0, 1e+06]'),
        ("<length>4.5</length>", "<length/>", 'line 15: length is ""; ' + number_of),
        ("<radius>0.3", "<radius>nan", 'line 54: radius is "nan"; ' + number_of),
        ("<x>10</x>", "", "line 17: x is missing; expected a number"),
        ("<x>10</x>", "<x>1e10</x>", 'line 17: x is "1e10"; expected a number in [-1e+09, 1e+09]'),
        ("<position><point><x>10</x><y>0</y></point></position>", "",
         "line 20: position is missing; expected one for every state"),
        ("<x>-2</x>", "", "line 40: x is missing; expected a number"),
        ("<time><exact>2</exact></time>\n      <velocity>", "\n      <velocity>",
         "line 20: time is missing; expected one for every state"),
        ("<exact>2</exact>", "<exact>2.5</exact>", 'line 18: time is "2.5"; expected a whole number'),
        ("<exact>2</exact>", "<intervalStart>2</intervalStart><intervalEnd>4.5</intervalEnd>",
         'line 18: time is "4.5"; expected a whole number'),
        ("<exact>2</exact>", "<exact>-1</exact>", 'line 18: time is "-1"; expected a number in [0, 1e+06]'),
        ("<exact>3</exact>", "<exact>2</exact>", "id 30 at 0.2 s is in line 20 already"),
        ("<point><x>10</x><y>0</y></point>", 2 * "<point><x>10</x><y>0</y></point>",
         'line 17: a second element is "point"; expected one'),
        ("</trajectory>\n  </dynamicObstacle>", "</trajectory>\n  </dynamicObstacle>\n"
         '<dynamicObstacle id="30"></dynamicObstacle>', 'id is "30"; expected one that no obstacle above has'),
        ("<exact>12</exact>", "<exact>fast</exact>", 'line 19: velocity is "fast"; ' + number_of),
        ("<exact>0.1</exact>", "<intervalStart>0.1</intervalStart><intervalEnd>0.05</intervalEnd>",
         'line 18: orientation is missing; expected an exact value, or both ends of an interval, which ascend'),
        ("<exact>0.3</exact>", "<intervalStart>0.3</intervalStart>",
         'line 19: yawRate is missing; expected an exact value, or both ends of an interval'),
        ("<orientation><exact>3.1</exact></orientation>", "",
         "line 44: orientation is missing; expected one for every state"),
        ("</trajectory>", "</track>", "line 34: mismatched tag"),
        ("<type>car", "<type>" + "c" * 2000, 'line 14: a text is "30"; expected 1024 bytes at most'),
        ("<shape>", "<" + "s" * 600 + "/><shape>", 'expected 512 bytes of names around it at most'),
        ("</commonRoad>", "", ": the file ends before </commonRoad>"),
        (NEW[900:], "", ": the file ends before </commonRoad>"),
    ]
    refuses(PROGRAM, folder, "bad.xml", NEW, cases, "30")
    refuses(PROGRAM, folder, "bad.xml", OLD, [
        ("<role>dynamic</role>", "<role>moving</role>", 'line 3: role is "moving"; expected static or dynamic'),
        ("<center><x>700351.66</x><y>-5866.33</y></center>", "", "line 8: x is missing; expected a number"),
    ], "7")
    new = os.path.join(folder, "new.xml")
    for words, code, message in (
            ((new, "--ego", "nobody"), 65, '--ego: "nobody" is no id'),
            ((new,), 64, "a recording has no ego of its own"),
            ((new, "--ego", "30", "--live"), 64, "--live"),
            ((os.path.join(folder, "none.xml"), "--ego", "30"), 66, "none.xml: No such file or directory")):
        said, _ = run(PROGRAM, *words, fails=code)
        check(message in said, f"{words}: {said}")
    said, _ = run("glint-traffic", new, "--ego", "30", fails=65)
    check("a scenario of CommonRoad" in said and PROGRAM in said, said)


with tempfile.TemporaryDirectory() as place:
    if os.path.exists(os.path.join(BIN, PROGRAM)):
        exactness(place)
        shared_options(place)
        a_mirrored_world_is_mirrored(place)
        memory_is_64_bytes_a_row(place)
        what_stands_twice_is_refused(place)
        bad_input(place)
    else:
        print(f"skipped  {PROGRAM}: it is not there, as it needs expat")
print(f"commonroad: {recorded.checks} checks hold")
