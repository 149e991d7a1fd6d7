#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""How long `dataset status` and `dataset merge` take of a set of ten million samples in 60,000 shards, and their peak memory.

    benches/many_records.py BUILD/apps/tofray/tofray [--shards 60000] [--samples 167] [--folder FOLDER]

One shard is made; the others have its tar (as links) and its record with their own numbers. FOLDER takes some 3 GB and is removed.
"""

from __future__ import annotations

import argparse
import json
import os
import pathlib
import re
import shutil
import tempfile
import time

SET = """name: many
license: CC0-1.0
samples: {samples}
seed: 1
arrays: [z_m, gt_z_m]
scene:
  camera: {{profile: pico-flexx}}
  objects:
    - plane: {{point: [0, 0, {{uniform: [1 m, 2 m]}}], reflectivity: {{uniform: [20 %, 90 %]}}}}
set: {{camera.sensor.width: 32, camera.sensor.height: 24}}
"""


def run(*words: object, good: tuple[int, ...] = (0,)) -> tuple[float, float]:
    """Seconds, and MB of memory at its peak."""
    start = time.perf_counter()
    child = os.posix_spawn(str(words[0]), [str(word) for word in words], os.environ)
    _, status, usage = os.wait4(child, 0)
    if os.waitstatus_to_exitcode(status) not in good:
        raise SystemExit(f"{' '.join(map(str, words))}: exit status {os.waitstatus_to_exitcode(status)}")
    return time.perf_counter() - start, usage.ru_maxrss / 1024


def records(folder: pathlib.Path, shards: int, samples: int) -> None:
    """The record and the tar of each shard, like those of the first."""
    first = folder / "shards/000/000000"
    record = json.loads(first.with_suffix(".json").read_text())
    if json.dumps(record, separators=(",", ":")) + "\n" != first.with_suffix(".json").read_text():
        raise SystemExit("a record is not written as Python writes it: this script has to follow")
    # Where a sample's number stands, so that 60,000 records are text alone.
    parts = re.split(r'(?<="sample":)(\d+)', json.dumps(record["samples"], separators=(",", ":")))
    head = json.dumps({**record, "shard": -1, "first": -2, "samples": []}, separators=(",", ":"))
    for shard in range(1, shards):
        path = folder / f"shards/{shard // 1000:03}/{shard:06}"
        path.parent.mkdir(parents=True, exist_ok=True)
        start = shard * samples
        listed = "".join(str(int(part) + start) if i % 2 else part for i, part in enumerate(parts))
        text = head.replace('"shard":-1,"first":-2', f'"shard":{shard},"first":{start}', 1).removesuffix("[]}") + listed + "}\n"
        path.with_suffix(".json").write_text(text)
        os.link(first.with_suffix(".tar"), path.with_suffix(".tar"))


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("tofray", type=pathlib.Path)
    words.add_argument("--shards", type=int, default=60000)
    words.add_argument("--samples", type=int, default=167, help="in a shard")
    words.add_argument("--folder", type=pathlib.Path)
    asked = words.parse_args()
    program = asked.tofray.resolve()
    place = pathlib.Path(tempfile.mkdtemp(prefix="many-records-", dir=asked.folder))
    try:
        (place / "set.yaml").write_text(SET.format(samples=asked.shards * asked.samples))
        out = place / "out"
        run(program, "dataset", "plan", place / "set.yaml", "-o", out, "--shard-samples", asked.samples, "--pilot", 1, "--quiet")
        run(program, "dataset", "run", out, "--part", f"0/{asked.shards}", "--quiet")
        records(out, asked.shards, asked.samples)
        print(f"{asked.shards} records of {asked.shards * asked.samples} samples, {sum(p.stat().st_size for p in out.glob('shards/*/*.json')) / 1e9:.2f} GB")
        for command, good in (("status", (0,)), ("merge", (0, 1))):   # 1: draws that are copies miss their law
            seconds, peak = run(program, "dataset", command, out, "--quiet", good=good)
            print(f"dataset {command}: {seconds:.1f} s, {peak:.0f} MB")
    finally:
        shutil.rmtree(place)


if __name__ == "__main__":
    main()
