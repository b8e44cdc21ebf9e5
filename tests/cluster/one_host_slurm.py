"""A real Slurm of this one host, started by hand for a test: munged, slurmctld and slurmd, no systemd, no database.

Everything is in a folder of its own and listens on the loopback interface alone; what was started is ended by its id.
"""

import contextlib
import os
import pathlib
import secrets
import shutil
import socket
import subprocess
import time

PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol"]
CONFIGURATION = """ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={control_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_interval=1
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=60 State=UP
"""
# Names the version of control groups, which slurmd otherwise detects by what is mounted at /sys/fs/cgroup: containers and
# chroots often have nothing there. No plugin above uses them.
CGROUP_CONFIGURATION = "CgroupPlugin=cgroup/v1\n"


def find(program):
    """Its path; daemons lie where users' PATH need not lead."""
    return shutil.which(program) or shutil.which(program, path="/usr/sbin:/sbin")


def missing_programs():
    return [program for program in PROGRAMS if not find(program)]


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


class OneHostSlurm:
    """`with OneHostSlurm(folder, cpus) as slurm:`; `slurm.environment` makes sbatch and the like speak to it."""

    def __init__(self, folder, cpus):
        self.folder = pathlib.Path(folder)
        self.processes = []
        control_port, node_port = free_ports(2)
        self.configuration = CONFIGURATION.format(host=socket.gethostname().split(".")[0], folder=self.folder,
                                                  control_port=control_port, node_port=node_port, cpus=cpus,
                                                  user=subprocess.check_output(["id", "-un"], text=True).strip())
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}

    def __enter__(self):
        for name in ("state", "spool"):
            (self.folder / name).mkdir(parents=True)
        self.folder.chmod(0o755)
        (self.folder / "slurm.conf").write_text(self.configuration, encoding="utf-8")
        (self.folder / "cgroup.conf").write_text(CGROUP_CONFIGURATION, encoding="utf-8")
        key = self.folder / "munge.key"
        key.write_bytes(secrets.token_bytes(1024))
        key.chmod(0o400)
        try:
            paths = {"socket": "munge.socket", "key-file": "munge.key", "pid-file": "munge.pid", "log-file": "munge.log",
                     "seed-file": "munge.seed"}
            self.start("munged", "--foreground", "--force", *(f"--{k}={self.folder / v}" for k, v in paths.items()))
            self.wait("munged", (self.folder / "munge.socket").exists)
            self.start("slurmctld", "-D", "-f", self.folder / "slurm.conf")
            self.start("slurmd", "-D", "-f", self.folder / "slurm.conf")
            self.wait("slurmd", lambda: "State=IDLE" in self.query("scontrol", "show", "node"))
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
        for process in reversed(self.processes):
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def start(self, program, *arguments):
        log = (self.folder / f"{program}.output").open("wb")
        with log:
            self.processes.append(subprocess.Popen([find(program), *map(str, arguments)], stdout=log, stderr=log,
                                                   stdin=subprocess.DEVNULL, env=self.environment))

    def query(self, program, *arguments):
        done = subprocess.run([find(program), *arguments], capture_output=True, text=True, env=self.environment, check=False)
        return done.stdout

    def wait(self, what, is_so, seconds=60):
        end = time.monotonic() + seconds
        while not is_so():
            if time.monotonic() > end or any(process.poll() is not None for process in self.processes):
                logs = "\n".join(f"{log.name}: {log.read_text(errors='replace')[-1500:]}" for log in self.folder.glob("*.output"))
                raise RuntimeError(f"{what} does not come up:\n{logs}")
            time.sleep(0.1)
