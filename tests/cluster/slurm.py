# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A cluster of Slurm on this machine alone: munged, slurmctld and three slurmd with a folder, a key and ports of their own."""

from __future__ import annotations

import os
import pathlib
import shutil
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel", "srun")
NODES = {"n1": "scalar", "n2": "avx2", "n3": ""}  # instruction sets; empty: the best there is


def missing() -> str:
    """Why there can be no cluster here; empty where there can."""
    without = [name for name in PROGRAMS if shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin") is None]
    if without:
        return f"{', '.join(without)} not installed (Debian: slurmctld slurmd slurm-client munge)"
    return "" if os.geteuid() == 0 else "slurmd starts jobs of others: only as root"


def free_ports(count: int) -> list[int]:
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """For `with`: its daemons end with it."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder
        self.daemons: dict[str, subprocess.Popen[bytes]] = {}
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf"), "PATH": os.environ["PATH"] + ":/usr/sbin"}

    def start(self, name: str, *words: str) -> None:
        with open(self.folder / f"{name}.out", "ab") as out:
            self.daemons[name] = subprocess.Popen(words, env=self.environment, stdout=out, stderr=out, start_new_session=True)

    def start_node(self, node: str) -> None:
        self.start(node, "slurmd", "-D", "-N", node)

    def __enter__(self) -> Cluster:
        control, *nodes = free_ports(1 + len(NODES))
        host = socket.gethostname()
        for name in ("state", "spool", "munge"):
            (self.folder / name).mkdir()
        os.chmod(self.folder / "munge", 0o700)
        (self.folder / "munge/key").write_bytes(os.urandom(128))
        os.chmod(self.folder / "munge/key", 0o400)
        prolog = self.folder / "prolog"
        isas = "\n".join(f'  {node}) echo "export TOFRAY_ISA={isa}";;' for node, isa in NODES.items() if isa)
        prolog.write_text(f"#!/bin/sh\ncase $SLURMD_NODENAME in\n{isas}\nesac\n")
        prolog.chmod(0o755)
        at = self.folder
        lines = [f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=2 State=UNKNOWN" for node, port in zip(NODES, nodes)]
        (at / "slurm.conf").write_text(f"""ClusterName=tofray
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmctldPort={control}
AuthType=auth/munge
AuthInfo=socket={at}/munge/socket
CredType=cred/munge
StateSaveLocation={at}/state
SlurmdSpoolDir={at}/spool/%n
SlurmctldPidFile={at}/slurmctld.pid
SlurmdPidFile={at}/slurmd-%n.pid
SlurmctldLogFile={at}/slurmctld.log
SlurmdLogFile={at}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
TaskProlog={prolog}
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=0
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
SlurmdTimeout=10
KillWait=2
MaxArraySize=11
{chr(10).join(lines)}
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
PartitionName=all Nodes=n[1-3] Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO PriorityTier=1 GraceTime=5
PartitionName=urgent Nodes=n[1-3] MaxTime=INFINITE State=UP OverSubscribe=NO PriorityTier=10 PreemptMode=OFF
""")
        self.start("munged", "munged", "--foreground", "--force", f"--key-file={at}/munge/key", f"--socket={at}/munge/socket", f"--pid-file={at}/munge/pid",
                   f"--log-file={at}/munge/log", f"--seed-file={at}/munge/seed", "--num-threads=2")
        self.wait(lambda: (at / "munge/socket").exists(), "munged")
        self.start("slurmctld", "slurmctld", "-D")
        for node in NODES:
            self.start_node(node)
        self.wait(lambda: self.ask("sinfo", "-h", "-o", "%T %D").split() == ["idle", "3"], "three idle nodes")
        return self

    def ask(self, *words: str) -> str:
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, timeout=60).stdout

    def wait(self, ready: object, what: str, longest_s: float = 120) -> None:
        until = time.monotonic() + longest_s
        while not ready():  # type: ignore[operator]
            if time.monotonic() > until:
                logs = "\n".join(f"== {log.name}\n{log.read_text(errors='replace')[-2000:]}" for log in sorted(self.folder.glob("*.log")) + sorted(self.folder.glob("*.out")))
                raise TimeoutError(f"{what}\n{self.ask('sinfo')}\n{self.ask('squeue')}\n{logs}")
            time.sleep(0.1)

    def end_of(self, job: str) -> None:
        self.wait(lambda: not self.ask("squeue", "-h", "-j", job).strip(), f"the end of job {job}", 300)

    def preempt(self, job: str) -> None:
        """Takes all nodes for another job until those of this one have gone, and lets it begin again at once where it waits for that."""
        urgent = self.ask("sbatch", "--parsable", "--partition=urgent", "--nodes=3", "--exclusive", "--output=/dev/null", "--wrap=true").strip()
        self.end_of(urgent)
        self.ask("scontrol", "update", f"JobId={job}", "StartTime=now")

    def kill_node(self, node: str) -> int:
        """As if its power went: the daemon, and the steps of the jobs on it. How many processes that were."""
        os.killpg(self.daemons.pop(node).pid, 9)
        victims = [int(folder.name) for folder in pathlib.Path("/proc").iterdir() if folder.name.isdigit() and self.is_step(folder, node)]
        steps = {int(line.split()[1]) for line in self.ask("ps", "-eo", "pid=,ppid=").splitlines() if int(line.split()[0]) in victims}
        for pid in [*victims, *(one for one in steps if one not in (1, os.getpid()))]:
            try:
                os.kill(pid, 9)
            except ProcessLookupError:
                pass
        return len(victims)

    def is_step(self, folder: pathlib.Path, node: str) -> bool:
        """Whether a process is a job's on that node."""
        try:
            environment = (folder / "environ").read_bytes().split(b"\0")
        except OSError:
            return False
        return f"SLURMD_NODENAME={node}".encode() in environment and f"SLURM_CONF={self.folder}/slurm.conf".encode() in environment

    def __exit__(self, *_: object) -> None:
        self.ask("scancel", "--user=root")
        for daemon in reversed(list(self.daemons.values())):
            daemon.terminate()
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                os.killpg(daemon.pid, 9)
                daemon.wait()
