#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""cluster_test.py TOFRAY ENGINE: a set made by an engine has the SHA256SUMS of one process; 77 where the engine is not there.

ENGINE: slurm (three nodes of different instruction sets, a preemption, a node that dies), dask (three workers, one of which dies), parallel, mpirun.
"""

from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import slurm

SET = """
name: small
license: CC0-1.0
samples: 60
seed: 5
scene:
  camera: {profile: pico-flexx}
  transport: {bounces: 1, samples: BOUNCES}
  objects:
    - plane: {point: [0, 0, {uniform: [1 m, 2 m]}], reflectivity: {uniform: [20 %, 90 %]}}
    - sphere: {name: ball, center: [{uniform: [-20 cm, 20 cm]}, 0, 80 cm], radius: {uniform: [5 cm, 15 cm]}, reflectivity: 0.5}
set: {camera.sensor.width: 32, camera.sensor.height: 24, camera.lens.fx: 30 px, camera.lens.fy: 30 px, camera.lens.cx: 15.5 px, camera.lens.cy: 11.5 px}
"""


class Set:
    def __init__(self, tool: str, folder: pathlib.Path, environment: dict[str, str] | None = None) -> None:
        self.tool, self.out, self.environment = tool, folder / "out", environment
        folder.mkdir()
        (folder / "set.yaml").write_text(SET.replace("BOUNCES", "1024"))
        self.run("plan", str(folder / "set.yaml"), "-o", str(self.out), "--shard-samples", "3", "--pilot", "1")

    def run(self, *words: str, code: int = 0) -> str:
        done = subprocess.run([self.tool, "dataset", *words], env=self.environment, capture_output=True, text=True)
        assert done.returncode == code, f"{words}: {done.returncode}\n{done.stdout}\n{done.stderr}"
        return done.stdout

    def complete(self, cluster: slurm.Cluster) -> None:
        """Submits what is missing, and waits for its merge."""
        said = self.run("submit", str(self.out), "--tasks", "5")
        if "nothing to submit" in said:
            self.run("merge", str(self.out))
            return
        words = said.split()
        cluster.end_of(words[1].rstrip(":"))
        cluster.end_of(words[words.index("shards;") + 2])

    def sums(self) -> str:
        return (self.out / "SHA256SUMS").read_text()


def alone(tool: str, folder: pathlib.Path) -> str:
    one = Set(tool, folder)
    one.run("run", str(one.out), "--threads", "1")
    one.run("merge", str(one.out))
    return one.sums()


def by_slurm(tool: str, folder: pathlib.Path, expected: str) -> None:
    (folder / "cluster").mkdir()
    with slurm.Cluster(folder / "cluster") as cluster:
        said = cluster.ask("srun", "--nodes=3", "--ntasks=3", "sh", "-c", "echo $SLURMD_NODENAME $TOFRAY_ISA")
        assert sorted(line.strip() for line in said.splitlines()) == sorted(f"{node} {isa}".strip() for node, isa in slurm.NODES.items()), said
        # A whole set by ten jobs, and its merge behind them.
        one = Set(tool, folder / "one", cluster.environment)
        said = one.run("submit", str(one.out), "--tasks", "10", "--sbatch=--time=10")
        words = said.split()
        job, merge = words[1].rstrip(":"), words[words.index("shards;") + 2]
        assert "10 tasks for 20 missing shards" in said, said
        cluster.end_of(job)
        cluster.end_of(merge)
        assert one.sums() == expected, "the sums of one process"
        talk = [line for log in one.out.glob("log/slurm-*_*.out") for line in log.read_text().splitlines()]
        assert not talk, f"quiet jobs say nothing: {talk}"
        assert "nothing to submit" in one.run("submit", str(one.out))

        # An urgent job takes all nodes with shards under way.
        urgent = Set(tool, folder / "urgent", cluster.environment)
        words = urgent.run("submit", str(urgent.out), "--tasks", "3").split()
        cluster.wait(lambda: len(list(urgent.out.glob("shards/000/*.json"))) >= 1, "a shard")
        cluster.preempt(words[1].rstrip(":"))
        cluster.end_of(words[1].rstrip(":"))
        cluster.end_of(words[words.index("shards;") + 2])
        urgent.complete(cluster)
        assert urgent.sums() == expected, "the sums of one process after a preemption"

        # More tasks than the cluster takes; Slurm that refuses.
        two = Set(tool, folder / "two", cluster.environment)
        done = subprocess.run([tool, "dataset", "submit", str(two.out), "--tasks", "20"], env=cluster.environment, capture_output=True, text=True)
        assert done.returncode == 2 and "MaxArraySize" in done.stderr and "at most 11" in done.stderr, done.stderr
        done = subprocess.run([tool, "dataset", "submit", str(two.out), "--tasks", "2", "--sbatch=--partition=nowhere"], env=cluster.environment, capture_output=True, text=True)
        assert done.returncode == 3 and "sbatch failed" in done.stderr and "nowhere" in done.stderr, done.stderr

        # A node dies under way, a job is cancelled: what is missing is submitted by the same command.
        said = two.run("submit", str(two.out), "--tasks", "4")
        job, merge = said.split()[1].rstrip(":"), said.split()[said.split().index("shards;") + 2]
        cluster.wait(lambda: len(list(two.out.glob("shards/000/*.json"))) >= 2, "two shards")
        assert cluster.kill_node("n2") > 0, "a job was under way there"
        cluster.ask("scancel", f"{job}_3")
        cluster.wait(lambda: "down" in cluster.ask("sinfo", "-h", "-n", "n2", "-o", "%T"), "a node that is down", 120)
        cluster.ask("scancel", job)
        cluster.ask("scancel", merge)
        cluster.end_of(job)
        cluster.start_node("n2")
        cluster.wait(lambda: "idle" in cluster.ask("sinfo", "-h", "-n", "n2", "-o", "%T"), "a node that is back")
        left = two.run("status", str(two.out), code=1) if len(list(two.out.glob("shards/000/*.json"))) < 20 else ""
        two.complete(cluster)
        assert two.sums() == expected, "the sums of one process after a dead node"
        print(f"slurm: {len(expected.splitlines())} files; a node died with {left.splitlines()[0] if left else 'nothing missing'}")


def recipe(engine: str, tool: str, one: Set) -> str:
    """The line of docs/datasets.md, of this set and this program."""
    lines = (pathlib.Path(__file__).parents[2] / "docs/datasets.md").read_text().splitlines()
    line = next(line for line in lines if line.startswith(engine + " "))
    return line.replace("tofray dataset run corners", f"{tool} dataset run {one.out}")


def by_parallel(tool: str, folder: pathlib.Path, expected: str) -> None:
    one = Set(tool, folder / "one")
    subprocess.run(recipe("parallel", tool, one).replace("parallel ", "parallel --will-cite --jobs 2 ", 1), shell=True, check=True)
    one.run("merge", str(one.out))
    assert one.sums() == expected


def by_mpirun(tool: str, folder: pathlib.Path, expected: str) -> None:
    one = Set(tool, folder / "one")
    environment = {**os.environ, "OMPI_MCA_btl": "self,vader", "OMPI_MCA_rmaps_base_oversubscribe": "1",
                   "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    subprocess.run(recipe("mpirun", tool, one), shell=True, check=True, env=environment)
    one.run("merge", str(one.out))
    assert one.sums() == expected


def by_dask(tool: str, folder: pathlib.Path, expected: str) -> None:
    one = Set(tool, folder / "one")
    here = pathlib.Path(__file__).parent
    subprocess.run(["/usr/bin/python3", "-B", str(here / "dask_cluster.py"), str(one.out)], check=True, cwd=folder,
                   env={**os.environ, "TOFRAY_COMMAND": tool, "PYTHONPATH": str(here.parents[1] / "python")})
    assert one.sums() == expected, "the sums of one process"


def missing_dask() -> str:
    done = subprocess.run(["/usr/bin/python3", "-c", "import distributed"], capture_output=True, check=False)
    return "" if done.returncode == 0 else "distributed not installed (Debian: python3-distributed)"


def why_not(engine: str) -> str:
    """Why an engine cannot be tested here; empty where it can."""
    if engine == "slurm":
        return slurm.missing()
    if engine == "dask":
        return missing_dask()
    return "" if shutil.which(engine) else f"{engine} not installed (Debian: {'openmpi-bin' if engine == 'mpirun' else engine})"


def main() -> int:
    tool, engine = sys.argv[1:]
    why = why_not(engine)
    if why:
        print(f"SKIPPED: {why}")
        return 77
    with tempfile.TemporaryDirectory(prefix="tofray-cluster-") as name:
        folder = pathlib.Path(name)
        expected = alone(tool, folder / "alone")
        {"slurm": by_slurm, "dask": by_dask, "parallel": by_parallel, "mpirun": by_mpirun}[engine](tool, folder, expected)
    return 0


if __name__ == "__main__":
    sys.exit(main())
