# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""``python3 -m tofray dask …``: shards of a data set by the workers of a Dask cluster."""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import pathlib
import subprocess
import sys
from typing import Any

from .__main__ import command
from ._errors import BadInput, DeviceError, Error, IoError

_HELP = """example:
  dask scheduler --port 8786 &  dask worker localhost:8786 --nworkers 3 --nthreads 1 &
  python3 -m tofray dask corners --scheduler tcp://localhost:8786

Every worker has to see the folder at the same place, and to have this package. A worker that dies loses the shard that was
under way; another one makes it. The same command makes what is missing, whatever happened.
exit codes: 0, all shards are there; 1, too many holes, or values that miss their law; 2, bad input; 3, shards that nobody could make;
4, a package is missing."""


def _tool() -> str:
    found = command()
    if found is None:
        raise IoError("error: the command tofray is neither beside this package nor on the path\n  expected it there, or its place in the environment variable TOFRAY_COMMAND")
    return found


def _asked(words: list[str], good: tuple[int, ...]) -> str:
    done = subprocess.run([_tool(), "dataset", *words], capture_output=True, text=True, check=False)
    if done.returncode not in good:
        kind = BadInput if done.returncode == 2 else IoError
        raise kind(done.stderr.strip() or f"error: dataset {words[0]} ended with the code {done.returncode}")
    return done.stdout


def make_shard(folder: str, shard: int, threads: int) -> str:
    """Makes a shard, in a process of its own: what a fault ends is that process.

    Parameters
    ----------
    folder : str
        The set's.
    shard : int
        Its number.
    threads : int
        Samples at once.

    Returns
    -------
    str
        SHA-256 of the shard's record: the same whoever made it.

    Raises
    ------
    Error
        As the command ``dataset run`` says it.
    """
    _asked(["run", folder, "--shards", str(shard), "--threads", str(threads), "--quiet"], (0, 1))
    record = pathlib.Path(folder) / "shards" / f"{shard // 1000:03}" / f"{shard:06}.json"
    return hashlib.sha256(record.read_bytes()).hexdigest()


def missing_shards(folder: str) -> list[int]:
    """Numbers of the shards that are not complete.

    Parameters
    ----------
    folder : str
        The set's.

    Returns
    -------
    list of int

    Raises
    ------
    Error
        Where there is no plan.
    """
    out: list[int] = json.loads(_asked(["status", folder, "--json"], (0, 1)))["missing"]
    return out


def make_shards(client: Any, folder: str, retries: int = 3, threads: int = 1) -> int:
    """Makes the missing shards, each as a task of its own. Dask may run one twice: both write the same bytes.

    Parameters
    ----------
    client : distributed.Client
        Of the cluster.
    folder : str
        The set's.
    retries : int
        Of a shard that fails.
    threads : int
        Samples at once in a shard.

    Returns
    -------
    int
        How many there were to make.

    Raises
    ------
    Error
        Where some are still missing when all tasks have ended: which, and what the first of them said.
    """
    wanted = missing_shards(folder)
    # What is asked is whether shards are there, not what tasks have become: one whose worker died behind its last byte is no fault.
    futures = [client.submit(make_shard, folder, shard, threads, key=f"tofray-{os.getpid()}-{shard}", retries=retries, pure=False) for shard in wanted]
    client.gather(futures, errors="skip")
    left = missing_shards(folder)
    if left:
        said = next((str(one.exception()) for one in futures if one.status == "error"), "nothing")
        raise IoError(f"error: {len(left)} of {len(wanted)} shards are still missing, {left[0]} the first of them\n  a worker said: {said}\n  the same command goes on")
    return len(wanted)


def parser() -> argparse.ArgumentParser:
    """What the command line may say.

    Returns
    -------
    argparse.ArgumentParser
    """
    out = argparse.ArgumentParser(prog="python3 -m tofray dask", epilog=_HELP, formatter_class=argparse.RawDescriptionHelpFormatter,
                                  description="makes the shards of a data set that are missing on the workers of a Dask cluster, and merges them")
    out.add_argument("folder", help="of the plan, seen by all workers at this place")
    out.add_argument("--scheduler", required=True, metavar="ADDRESS", help="of the cluster: tcp://HOST:8786")
    out.add_argument("--retries", type=int, default=3, metavar="N", help="of a shard that fails (3)")
    out.add_argument("--threads", type=int, default=1, metavar="N", help="samples at once in a shard (1)")
    return out


def main(words: list[str]) -> int:
    """Runs the command.

    Parameters
    ----------
    words : list of str
        Behind ``dask``.

    Returns
    -------
    int
        The exit code.

    Raises
    ------
    SystemExit
        By the parser.
    """
    options = parser().parse_args(words)
    try:
        folder = str(pathlib.Path(options.folder).resolve())
        missing_shards(folder)
        count = _on_cluster(options, folder)
        done = subprocess.run([_tool(), "dataset", "merge", folder], check=False)
    except Error as error:
        print(error, file=sys.stderr)
        return {"bad_input": 2, "device": 4}.get(error.kind, 3)
    print(f"{count} shards made")
    return done.returncode


def _on_cluster(options: argparse.Namespace, folder: str) -> int:
    try:
        from distributed import Client
    except ImportError as error:
        raise DeviceError("error: there is no package distributed for this Python\n  Debian: apt install python3-distributed, for /usr/bin/python3") from error
    try:
        client = Client(options.scheduler, timeout="20s", set_as_default=False)
    except (OSError, ValueError) as error:
        raise IoError(f"error: no scheduler answers at {options.scheduler}\n  {error}; expected the address that `dask scheduler` says, such as tcp://localhost:8786") from error
    with client:
        return make_shards(client, folder, options.retries, options.threads)
