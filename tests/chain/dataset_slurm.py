"""A data set by Slurm on two nodes of this host has the bytes of one by make; shards that fail are named with their array.

Usage: python3 tests/chain/dataset_slurm.py BIN_DIR

Brings up munged, slurmctld and two slurmd on ports of their own in a folder of its own, bound to 127.0.0.1, and stops
them by their process numbers. Needs root and Debian's slurm-wlm; otherwise it says what is missing and ends with 1.
"""
import contextlib
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dataset as sets  # noqa: E402
import signals  # noqa: E402

PATIENCE_S = 600
MOST_TASKS = 8
CONFIGURATION = """\
ClusterName=glint
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={place}/munge.socket
CredType=cred/munge
SlurmctldPort={ports[0]}
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
StateSaveLocation={place}/state
SlurmdSpoolDir={place}/spool-%n
SlurmctldPidFile={place}/slurmctld.pid
SlurmdPidFile={place}/slurmd-%n.pid
SlurmctldLogFile={place}/slurmctld.log
SlurmdLogFile={place}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc={place}/completed.txt
MpiDefault=none
ReturnToService=2
MaxArraySize={most}
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmctldTimeout=30
SlurmdTimeout=30
SchedulerParameters=batch_sched_delay=0,sched_min_interval=1000000
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1 RealMemory=1000 State=UNKNOWN
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1 RealMemory=1000 State=UNKNOWN
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]


def wait_until(holds, what):
    end = time.monotonic() + PATIENCE_S
    while not holds():
        assert time.monotonic() < end, f"waited {PATIENCE_S} s until {what}"
        time.sleep(0.1)


def as_munge(place):
    """munged in the foreground, as its own user, with a key of its own."""
    key = os.path.join(place, "munge.key")
    with open(key, "wb") as file:
        file.write(os.urandom(128))
    os.chmod(key, 0o400)
    shutil.chown(key, "munge", "munge")
    files = {"socket": "munge.socket", "pid-file": "munge.pid", "log-file": "munge.log", "seed-file": "munge.seed"}
    return ["runuser", "-u", "munge", "--", "munged", "--foreground", f"--key-file={key}",
            *(f"--{option}={place}/{name}" for option, name in files.items())]


@contextlib.contextmanager
def daemons(place):
    """Slurm on this host, in the foreground of processes that are stopped at the end."""
    shutil.chown(place, "munge", "munge")
    os.chmod(place, 0o755)
    os.mkdir(os.path.join(place, "state"))
    path = os.path.join(place, "slurm.conf")
    with open(path, "w", encoding="ascii") as file:
        file.write(CONFIGURATION.format(host=socket.gethostname(), place=place, ports=free_ports(3), most=MOST_TASKS))
    os.environ["SLURM_CONF"] = path
    started = []
    try:
        for words in (as_munge(place), ["slurmctld", "-D", "-c", "-i", "-f", path],
                      *(["slurmd", "-D", "-N", node, "-f", path] for node in ("n1", "n2"))):
            log = open(os.path.join(place, f"{len(started)}.log"), "wb")
            started.append(subprocess.Popen(words, stdout=log, stderr=log, start_new_session=True))
            wait_until(lambda: os.path.exists(f"{place}/munge.socket"), "munged listens")
        wait_until(lambda: nodes().count("idle") == 2, "both nodes are idle")
        yield started
    finally:
        for process in reversed(started):
            os.killpg(process.pid, signal.SIGTERM)
        for process in reversed(started):
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(10)
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)


def nodes():
    return sets.run(["sinfo", "-h", "-N", "-o", "%T"]).stdout.split()


def end_of(jobs):
    """Waits for jobs; sbatch --wait would wait much longer."""
    def gone():
        done = sets.run(["squeue", "-h", "-j", ",".join(jobs)])
        return done.returncode != 0 or not done.stdout.strip()
    wait_until(gone, f"jobs {jobs} are done")


def submitted(words):
    """What scripts/dataset says after it has submitted, and all ids of jobs in it."""
    done = sets.run(words)
    assert done.returncode == 0, done.stdout
    arrays, check = re.search(r"in arrays ([\d ]+); job (\d+)", done.stdout).groups()
    end_of([*arrays.split(), check])
    return arrays.split()


def without_slurm(place):
    return {name: content for name, content in sets.files(place).items() if not name.startswith("work/slurm/")}


def checked(place):
    with open(os.path.join(place, "work/slurm/check.out"), encoding="utf-8") as file:
        return file.read()


def two_nodes_make_the_bytes_of_one_machine(folder, cluster):
    plan = sets.snapshots(200, splits={"by": "scene", "shares": sets.SHARES})
    right = sets.files(sets.made(folder, plan, "right"))
    place = os.path.join(folder, "set")
    sets.begin(folder, plan)
    arrays = submitted([sets.DATASET, os.path.join(folder, "set.json"), "--out", place, "--slurm"])
    assert len(arrays) == 3, f"20 tasks below MaxArraySize {MOST_TASKS} are {len(arrays)} arrays"
    assert without_slurm(place) == right, checked(place)
    with open(os.path.join(cluster, "completed.txt"), encoding="utf-8") as file:
        used = set(re.findall(r"NodeList=(n\d)", file.read()))
    assert used == {"n1", "n2"}, f"the tasks ran on {used}"


def hide(folder, names, back=False):
    """Takes some recordings away, or brings them back."""
    for name in names:
        here, hidden = os.path.join(folder, name), os.path.join(folder, name + ".hidden")
        os.rename(*((hidden, here) if back else (here, hidden)))


def a_shard_that_fails_is_named_with_its_array(folder, _):
    names = [sets.recording(folder, f"{i}.csv", slice(1 + 25 * i, 26 + 25 * i)) for i in range(12)]
    plan = sets.plan_of([{"recording": name, "egos": ["all"]} for name in names])
    right = sets.files(sets.made(folder, plan, "right"))
    place, _ = sets.begin(folder, plan)
    failing = [names[i] for i in (3, 9, 10)]
    hide(folder, failing)
    submitted(["make", "-s", "-C", place, "slurm"])
    said = checked(place)
    assert "3 of 12 shards are missing: part-3 part-9 part-10" in said, said
    assert "datapackage.json" not in sets.files(place)
    again = re.findall(r"sbatch --parsable .*", said)
    assert [re.search(r"--array=(\S+)", line)[1] for line in again] == ["3", "1-2"], said
    hide(folder, failing, back=True)
    jobs = [sets.run(["bash", "-c", line]).stdout.strip() for line in again]
    end_of(jobs)
    assert sets.make(place).returncode == 0 and without_slurm(place) == right


def main():
    missing = [name for name in ("munged", "slurmctld", "slurmd", "sbatch") if not shutil.which(name)]
    if missing or os.getuid() != 0:
        sys.exit(f"dataset_slurm: needs root and {' '.join(missing) or 'nothing else'}")
    signals.as_on_a_terminal()
    sets.use(sys.argv[1])
    with tempfile.TemporaryDirectory() as cluster, daemons(cluster):
        for check in (two_nodes_make_the_bytes_of_one_machine, a_shard_that_fails_is_named_with_its_array):
            with tempfile.TemporaryDirectory() as folder:
                check(folder, cluster)
            print(check.__name__.replace("_", " "), flush=True)


if __name__ == "__main__":
    main()
