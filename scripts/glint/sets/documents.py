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
FOLDERS = {"recording": "trajectories", "scenario": "scenarios", "suite": "sensors", "export": "exports"}


def program_version():
    done = subprocess.run([GLINT, "--version"], check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout.strip()


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


TABLES = "antenna_table", "range_curve", "azimuth_curve", "elevation_curve", "azimuth_floor_curve"


def copies_of_tables(suite):
    """The tables that a suite names. In the set they lie as they do here, seen from the suite."""
    for sensor in read_json(suite)["sensors"]:
        for table in filter(None, map(sensor.get, TABLES)):
            place, path = os.path.normpath(f"{DOCUMENTS}/sensors/{table}"), os.path.join(os.path.dirname(suite), table)
            refuse(os.path.isabs(table) or not place.startswith(DOCUMENTS + "/"), suite,
                   f"{table}: expected a table in or below the folder above this one, by its path from here")
            if not os.path.isfile(path):
                raise Fault(NO_INPUT, f"{suite}: {path}: no such file")
            yield place, path


def copies_of_suites(plan, plan_folder):
    names = [suite_name(word) for word in plan["suites"]]
    for name, word in zip(names, plan["suites"]):
        refuse(not re.fullmatch(r"\w[\w-]*", name), "/suites", f"{word}: expected a file name of letters, digits, _ and -")
        refuse([one.lower() for one in names].count(name.lower()) > 1, "/suites", f"{name} is there twice")
        path = path_of(word, "suite", plan_folder)
        yield f"{DOCUMENTS}/sensors/{name}.json", path
        try:
            yield from list(copies_of_tables(path))
        except (AttributeError, KeyError, TypeError) as error:
            raise Fault(BAD_DATA, f"{path}: expected a suite of sensors") from error


def copies_of_vehicles(plan, plan_folder):
    """All of them, as traffic may have any class. The user's own stand before the shipped ones."""
    folders = [os.path.join(folder, "vehicles") for folder in reversed(data_folders())]
    if "vehicles" in plan:
        folders.append(os.path.join(plan_folder, plan["vehicles"]))
        if not os.path.isdir(folders[-1]):
            raise Fault(NO_INPUT, f"/vehicles: {folders[-1]}: no such folder")
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
