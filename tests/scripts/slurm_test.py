#!/usr/bin/env python3
"""Runs the documented Slurm and GNU parallel lines of `edgewise soak`, with fewer and shorter shards. The shards must
add up to what one run draws. Slurm runs as a private cluster of one node, which listens on 127.0.0.1 only.

usage: slurm_test.py EDGEWISE
Exit status 77, which ctest takes for "skipped", where Slurm, MUNGE or GNU parallel is missing."""
import ctypes
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPED = 77
SHARDS = 4
SHARD_S = 3
PATIENCE_S = 60
LIMIT_S = 270  # less than ctest's timeout, which leaves no time to stop the cluster
COUNTS = ("cases", "frames", "triangles", "pixels", "oracle_frames", "frontend_lists", "differences", "by")
os.environ["PATH"] += ":/usr/sbin:/sbin"  # where Debian has the daemons


def documented(start):
    """The one command in scripts/README.md that begins so, with its continuation lines."""
    text = (ROOT / "scripts/README.md").read_text()
    found = re.findall(rf"^ *({start} (?:.*\\\n)*.*)$", text, re.MULTILINE)
    if len(found) != 1:
        raise AssertionError(f"scripts/README.md has {len(found)} lines that begin with: {start}")
    return found[0]


def scaled_down(line, replacements):
    for theirs, ours in replacements.items():
        if line.count(theirs) != 1:
            raise AssertionError(f"expected '{theirs}' exactly once in: {line}")
        line = line.replace(theirs, ours)
    return line


def free_ports(count):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def adopt_orphans():
    """Descendants whose parent ends become children of this process. slurmd starts jobs as daemons."""
    PR_SET_CHILD_SUBREAPER = 36
    if ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl")


def processes():
    """The folder in /proc and the parent's id of each process."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            yield folder, int((folder / "stat").read_text().rpartition(")")[2].split()[1])
        except (FileNotFoundError, ProcessLookupError):  # it has ended
            pass


def kill_descendants():
    while True:
        for process, parent in processes():
            if parent == os.getpid():
                os.kill(int(process.name), signal.SIGKILL)
        try:
            while os.waitpid(-1, os.WNOHANG)[0] != 0:
                pass
        except ChildProcessError:  # none is left, and so no grandchild either
            return
        time.sleep(0.01)


class Soak(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(dir=FOLDER))
        self.folder.chmod(0o711)  # munged refuses a socket that others cannot reach
        (self.folder / "build").mkdir()
        (self.folder / "build/edgewise").symlink_to(EDGEWISE)
        # Settings of a user's own cluster would change what the lines do. GNU parallel writes to the home folder.
        self.environment = {key: value for key, value in os.environ.items()
                            if not key.startswith(("SLURM_", "SBATCH_", "SQUEUE_", "SINFO_", "SCONTROL_"))}
        self.environment["HOME"] = str(self.folder)

    def run_line(self, line):
        result = subprocess.run(["bash", "-c", line], cwd=self.folder, env=self.environment, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(result.returncode, 0, f"{line}\n{result.stdout}")
        return result.stdout

    def record(self, name):
        return json.loads((self.folder / f"{name}.json").read_text())

    def expect_totals_of_one_run(self):
        # Shards that drew for the same time have drawn different numbers of cases: even them out.
        cases = [self.record(f"soak-{shard}")["cases"] for shard in range(SHARDS)]
        self.assertGreater(min(cases), 0)
        for shard in range(SHARDS):
            if cases[shard] < max(cases):
                self.run_line(f"build/edgewise soak --resume soak-{shard}.json --cases {max(cases) - cases[shard]}")
        self.run_line(documented("build/edgewise soak --merge"))
        merged = self.record("soak")
        self.run_line(f"build/edgewise soak --seed {merged['seed']} --cases {SHARDS * max(cases)} --json one.json")
        one = self.record("one")
        self.assertEqual({count: merged[count] for count in COUNTS}, {count: one[count] for count in COUNTS})


class Parallel(Soak):
    def test_shards_add_up(self):
        line = documented("parallel")
        last = int(re.search(r"\{0\.\.(\d+)\}", line)[1])
        self.run_line(scaled_down(line, {f"{{0..{last}}}": f"{{0..{SHARDS - 1}}}", f"/{last + 1} ": f"/{SHARDS} ",
                                         "--for 1h": f"--for {SHARD_S}s"}))
        self.expect_totals_of_one_run()


class Slurm(Soak):
    def setUp(self):
        super().setUp()
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        key = self.folder / "key"
        key.touch(0o600)
        key.write_bytes(os.urandom(128))
        controller_port, node_port = free_ports(2)
        config = self.folder / "slurm.conf"
        # A requeued job waits for cred_expire, which is 120 s by default and cannot be less than 5 s.
        config.write_text(f"""
ClusterName=edgewise
SlurmctldHost=localhost(127.0.0.1)
SlurmUser={os.getuid()}
SlurmdUser={os.getuid()}
AuthType=auth/munge
AuthInfo=socket={self.folder}/munge.socket,cred_expire=5
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobRequeue=0
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
NodeName=localhost NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes=localhost Default=YES
""")
        self.environment["SLURM_CONF"] = str(config)
        self.start("munged", "--foreground", f"--socket={self.folder}/munge.socket", f"--key-file={key}",
                   f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log",
                   f"--seed-file={self.folder}/munged.seed")
        self.wait_for(lambda: (self.folder / "munge.socket").is_socket(), "munged's socket")
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D", "-N", "localhost")
        self.wait_for(lambda: self.ask("sinfo", "--noheader", "--format=%t") == "idle", "an idle node")

    def start(self, *words):
        with (self.folder / "daemons.log").open("a") as log:
            # No object is kept: kill_descendants ends it.
            os.posix_spawnp(words[0], words, self.environment, file_actions=[
                (os.POSIX_SPAWN_DUP2, log.fileno(), 1), (os.POSIX_SPAWN_DUP2, log.fileno(), 2)])

    def ask(self, *words):
        result = subprocess.run(words, env=self.environment, capture_output=True, text=True)
        return result.stdout.strip() if result.returncode == 0 else None

    def wait_for(self, condition, what):
        end = time.monotonic() + PATIENCE_S
        while not condition():
            if time.monotonic() > end:
                raise AssertionError(f"waited {PATIENCE_S} s for {what}\n{(self.folder / 'daemons.log').read_text()}")
            time.sleep(0.1)

    def parents_of_soaks(self):
        parents = set()
        for process, parent in processes():
            try:
                if (process / "exe").readlink() == EDGEWISE and (process / "cwd").readlink() == self.folder:
                    parents.add(Path(f"/proc/{parent}/comm").read_text().strip())
            except OSError:  # it has ended, or is another user's
                pass
        return parents

    def test_array_with_a_requeued_task_adds_up(self):
        line = documented("sbatch")
        last = int(re.search(r"--array=0-(\d+)", line)[1])
        answer = self.run_line(scaled_down(line, {f"--array=0-{last} ": f"--array=0-{SHARDS - 1} ",
                                                  f"/{last + 1} ": f"/{SHARDS} ", "--for 1h": f"--for {SHARD_S}s"}))
        job = answer.split()[-1]

        def states(of):
            return self.ask("squeue", "--noheader", f"--job={of}", "--format=%T")

        # A soak that has written its first record answers SIGTERM by saving.
        self.wait_for(lambda: (self.folder / "soak-0.json").exists(), "the first record")
        # Slurm waits for the process that it started, and kills the rest. So a shell must not stand between.
        self.assertEqual(self.parents_of_soaks(), {"slurmstepd"})
        time.sleep(1)
        self.run_line(f"scontrol requeue {job}_0")
        self.wait_for(lambda: states(f"{job}_0") == "PENDING", "the requeued task to stop")
        saved = self.record("soak-0")
        self.assertGreater(saved["cases"], 0)
        self.wait_for(lambda: states(job) == "", "the array to end")

        jobs = self.ask("scontrol", "show", "job", job)
        self.assertEqual(re.findall(r"JobState=(\w+)", jobs), SHARDS * ["COMPLETED"], jobs)
        self.assertEqual(sorted(re.findall(r"Restarts=(\d)", jobs)), [*(SHARDS - 1) * "0", "1"], jobs)
        resumed = self.record("soak-0")
        self.assertGreater(resumed["cases"], saved["cases"])
        self.assertGreater(resumed["seconds"], saved["seconds"] + SHARD_S - 0.5)
        self.expect_totals_of_one_run()


if __name__ == "__main__":
    EDGEWISE = Path(sys.argv.pop(1)).resolve()
    missing = [tool for tool in ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "sinfo", "squeue", "parallel")
               if shutil.which(tool) is None]
    if "parallel" not in missing and "GNU" not in subprocess.run(["parallel", "--version"], capture_output=True,
                                                                 text=True).stdout:
        missing.append("GNU parallel")
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (scripts/packages.txt: cluster; scripts/test --cluster)")
        sys.exit(SKIPPED)
    for number in (signal.SIGALRM, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    signal.alarm(LIMIT_S)
    adopt_orphans()
    with tempfile.TemporaryDirectory(prefix="edgewise-slurm-") as FOLDER:
        os.chmod(FOLDER, 0o711)
        try:
            unittest.main()
        finally:
            kill_descendants()
