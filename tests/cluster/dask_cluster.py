#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""dask_cluster.py FOLDER: makes a set's shards by `python3 -m tofray dask` on three workers, of which one is killed with a shard under way."""

from __future__ import annotations

import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

from distributed import Client, LocalCluster


def kill_a_worker(cluster: LocalCluster, folder: pathlib.Path, until: float) -> None:
    """As soon as two shards are there and the worker computes a third one, by the kernel."""
    processes = {worker.worker_address: worker.pid for worker in cluster.workers.values()}
    with Client(cluster.scheduler_address, set_as_default=False) as client:
        while time.monotonic() < until:
            busy = [worker for worker, tasks in client.processing().items() if tasks]
            if busy and len(list(folder.glob("shards/000/*.json"))) >= 2:
                os.kill(processes[busy[0]], signal.SIGKILL)
                return
            time.sleep(0.02)


def main() -> int:
    folder = pathlib.Path(sys.argv[1])
    with LocalCluster(n_workers=3, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as cluster:
        before = {worker.pid for worker in cluster.workers.values()}
        killer = threading.Thread(target=kill_a_worker, args=(cluster, folder, time.monotonic() + 300))
        killer.start()
        done = subprocess.run([sys.executable, "-m", "tofray", "dask", str(folder), "--scheduler", cluster.scheduler_address], capture_output=True, text=True, check=False)
        killer.join()
        assert done.returncode == 0, f"{done.returncode}\n{done.stdout}\n{done.stderr}"
        assert "20 shards made" in done.stdout, done.stdout
        after = {worker.pid for worker in cluster.workers.values()}
        assert after != before, "a worker was killed, and another process is in its place"
        again = subprocess.run([sys.executable, "-m", "tofray", "dask", str(folder), "--scheduler", cluster.scheduler_address], capture_output=True, text=True, check=False)
        assert again.returncode == 0 and "0 shards made" in again.stdout, again.stdout + again.stderr
    nobody = subprocess.run([sys.executable, "-m", "tofray", "dask", str(folder / "none"), "--scheduler", "tcp://127.0.0.1:1"], capture_output=True, text=True, check=False)
    assert nobody.returncode == 3 and "there is no plan in this folder" in nobody.stderr, nobody.stderr
    return 0


if __name__ == "__main__":
    sys.exit(main())
