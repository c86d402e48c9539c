"""The programs and documents that a data set is made with: where they lie, and which of them it gets copies of."""
import os
import re
import shlex
import shutil
import subprocess

from glint.places import BIN, DATA, GLINT
from glint.sets.durable import digest_of_file, make_folder, whole_file
from glint.sets.plan import BAD_DATA, FROM_FILES, NO_INPUT, Fault, is_own, kind_of, read_json, refuse, stages_of

DOCUMENTS = "documents"
TABLES = "antenna_table", "range_curve", "azimuth_curve", "elevation_curve", "azimuth_floor_curve"  # members of sensors
FOLDERS = {"recording": "trajectories", "scenario": "scenarios", "suite": "sensors", "export": "exports"}


def program_version(program=GLINT):
    return subprocess.check_output([program, "--version"], text=True).strip()


def environment(folder):
    return os.environ | {"PATH": BIN + os.pathsep + os.environ["PATH"],
                         "GLINT_DATA": os.path.abspath(os.path.join(folder, DOCUMENTS))}


def data_folders():
    """Where names of documents are looked up, as glint does."""
    return [folder for folder in (os.environ.get("GLINT_DATA"), DATA) if folder]


def path_of(word, kind, plan_folder):
    """The file of a name or path."""
    found = [os.path.join(folder, FOLDERS[kind], word + ending) for folder in data_folders()
             for ending in (".json", ".csv", ".csv.gz")] if is_name(word) else [os.path.join(plan_folder, word)]
    for path in found:
        if os.path.isfile(path):
            return path
    raise Fault(NO_INPUT, f"{kind} {word}: {' and '.join(found)}: no such file")


def is_name(word):
    return "/" not in word and "." not in word


def suite_name(word):
    return os.path.splitext(os.path.basename(word))[0]


def base_of(suite, path, extending):
    """The file of the suite that this one extends; None if it extends none. extending are those that extend this one."""
    refuse(not isinstance(suite, dict), path, "expected a suite of sensors")
    if "extends" not in suite:
        return None
    refuse(not isinstance(suite["extends"], str), path, "extends: expected the name or the path of a suite")
    base = path_of(suite["extends"], "suite", os.path.dirname(path))
    refuse(os.path.realpath(base) in map(os.path.realpath, (*extending, path)), path,
           f"extends: {suite['extends']}: expected a suite that does not extend this one")
    return base


def extended(base, own):
    """The members of the base, but for those that the other one has: objects member by member, lists of what has names
    item by item. None takes a member away."""
    if isinstance(base, dict) and isinstance(own, dict):
        made = base | {name: extended(base.get(name), value) for name, value in own.items()}
        return {name: value for name, value in made.items() if value is not None}
    if have_names(base) and have_names(own):
        changes = {one["name"]: one for one in own}
        return [extended(one, changes.pop(one["name"], {})) for one in base] + list(changes.values())
    return own


def have_names(items):
    return isinstance(items, list) and all(isinstance(one, dict) and "name" in one for one in items) and bool(items)


def whole_suite(path, extending=()):
    """A suite with what it has from those that it extends; its tables by their paths from its folder."""
    own = read_json(path)
    there = base_of(own, path, extending)
    if there is None:
        return own
    base = whole_suite(there, (*extending, path))
    refuse(not have_names(base.get("sensors")), there, "expected a suite of sensors")
    for sensor in base["sensors"]:
        for member in sensor.keys() & set(TABLES):
            table = os.path.join(os.path.dirname(there), sensor[member])
            sensor[member] = os.path.relpath(table, os.path.dirname(path) or ".")
    return extended(base, {name: value for name, value in own.items() if name != "extends"})


def copies_of_suite(path, place, extending=()):
    """A suite, its tables, and the suites that it extends. In the set they lie as they do here, seen from the suite."""
    def beside(word, what):
        there = os.path.normpath(os.path.join(os.path.dirname(place), word))
        refuse(os.path.isabs(word) or not there.startswith(DOCUMENTS + "/"), path,
               f"{word}: expected a {what} in or below the folder above this one, by its path from here")
        return there

    yield place, path
    suite = read_json(path)
    for sensor in suite.get("sensors", []) if "extends" in suite else suite["sensors"]:
        for table in filter(None, map(sensor.get, TABLES)):
            there, found = beside(table, "table"), os.path.join(os.path.dirname(path), table)
            if not os.path.isfile(found):
                raise Fault(NO_INPUT, f"{path}: {found}: no such file")
            yield there, found
    if base := base_of(suite, path, extending):
        word = suite["extends"]
        there = f"{DOCUMENTS}/sensors/{word}.json" if is_name(word) else beside(word, "suite")
        yield from copies_of_suite(base, there, (*extending, path))


def copies_of_suites(plan, plan_folder):
    names = [suite_name(word) for word in plan["suites"]]
    for name, word in zip(names, plan["suites"]):
        refuse(not re.fullmatch(r"\w[\w-]*", name), "/suites", f"{word}: expected a file name of letters, digits, _ and -")
        refuse([one.lower() for one in names].count(name.lower()) > 1, "/suites", f"{name} is there twice")
        path = path_of(word, "suite", plan_folder)
        try:
            yield from list(copies_of_suite(path, f"{DOCUMENTS}/sensors/{name}.json"))
        except (AttributeError, KeyError, TypeError) as error:
            raise Fault(BAD_DATA, f"{path}: expected a suite of sensors") from error


def set_of_vehicles(plan, plan_folder):
    """The word or path of the plan's vehicles, or else that of all its suites; without a word they are the paper's."""
    suites = [whole_suite(path_of(word, "suite", plan_folder)) for word in plan["suites"]]
    words = {plan["vehicles"]} if "vehicles" in plan else {suite.get("vehicles", "paper") for suite in suites}
    refuse(len(words) > 1, "/vehicles", f"missing; the suites name {' and '.join(sorted(words))}")
    return words.pop()


def folder_of_vehicles(word, plan_folder):
    """The folder that a word or path means."""
    if not is_name(word):
        folder = os.path.join(plan_folder, word)
        if not os.path.isdir(folder):
            raise Fault(NO_INPUT, f"/vehicles: {folder}: no such folder")
        return folder
    named = [os.path.join(folder, word if word != "paper" else "", "vehicles") for folder in data_folders()]
    refuse(not any(map(os.path.isdir, named)), "/vehicles",
           f'"{word}" is no set of vehicles; expected a word as detailed or paper, or the path of a folder: ./{word}')
    return next(filter(os.path.isdir, named))


def copies_of_vehicles(plan, plan_folder):
    """All of them, as traffic may have any class. The user's own stand before the shipped ones."""
    folders = [os.path.join(folder, "vehicles") for folder in reversed(data_folders())]
    folders.append(folder_of_vehicles(set_of_vehicles(plan, plan_folder), plan_folder))
    found = {name: os.path.join(folder, name) for folder in folders if os.path.isdir(folder)
             for name in os.listdir(folder) if name.endswith(".json")}
    for name, path in found.items():
        yield f"{DOCUMENTS}/vehicles/{name}", path


def copies_of_traffic(plan, plan_folder):
    """What has a name; what has a path is read where it lies. Moving random scenes are those of a scenario."""
    for source in plan["sources"]:
        kind, word = kind_of(source), source.get(kind_of(source))
        if kind == "moving":
            kind, word = "scenario", "random-roads"
        if kind in FROM_FILES and is_name(word):
            path = path_of(word, kind, plan_folder)
            yield f"{DOCUMENTS}/{FOLDERS[kind]}/{os.path.basename(path)}", path


def copies(plan, plan_folder):
    """What the set gets copies of: file by the path that it gets in the set."""
    found = {}
    for copies_of in (copies_of_suites, copies_of_vehicles, copies_of_traffic):
        for name, path in copies_of(plan, plan_folder):
            if digest_of_file(found.setdefault(name, path)) != digest_of_file(path):
                raise Fault(BAD_DATA, f"{path} and {found[name]} would get one name in the set: {name}")
    return dict(sorted(found.items()))


def copy_documents(copied, folder, work):
    for name, path in copied.items():
        make_folder(os.path.dirname(os.path.join(folder, name)))
        with open(path, "rb") as source, whole_file(os.path.join(folder, name), work) as file:
            shutil.copyfileobj(source, file)


def files_of(source, plan_folder):
    """The files that a source reads in the plan's folder: traffic, its meta files, and those that options name."""
    kind = kind_of(source)
    words = shlex.split(source.get("options", "").replace("=", " "))
    names = [word for word in words if not is_name(word) and os.path.isfile(os.path.join(plan_folder, word))]
    if kind in FROM_FILES and path_of(source[kind], kind, plan_folder) and not is_name(source[kind]):
        names.append(source[kind])
        folder, name = os.path.split(source[kind])
        recorded = re.fullmatch(r"(.*)_tracks\.csv(\.gz)?", name)
        beside = os.listdir(os.path.join(plan_folder, folder)) if recorded else []
        names += [os.path.join(folder, other) for other in beside
                  if re.fullmatch(re.escape(recorded[1]) + r"_(tracks|recording)Meta\.csv", other)]
    return sorted(set(names))


def files_of_chain(plan, plan_folder):
    """The files of the user's own stages, with paths from the plan's folder."""
    found = []
    for stage in filter(is_own, stages_of(plan["chain"])):
        names = [word for word in stage if "/" in word and os.path.isfile(os.path.join(plan_folder, word))]
        if not names:
            raise Fault(NO_INPUT, f"/chain: {shlex.join(stage)}: no such file in {plan_folder}")
        found += names
    return found


def described(files, folder=""):
    """Size and digest of files, by the names that they have in the set or from the plan's folder."""
    return [{"path": name, "bytes": os.path.getsize(os.path.join(folder, path)),
             "hash": digest_of_file(os.path.join(folder, path))} for name, path in files.items()]
