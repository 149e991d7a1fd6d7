# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What benches/run.py measures: for each topic the programs that it calls, and what it reads of their output."""

from __future__ import annotations

import dataclasses
import json
import os
import pathlib
import re
import shlex
import subprocess
from typing import Any, Callable, Iterator, Mapping

ROOT = pathlib.Path(__file__).resolve().parents[1]
SKIPPED = 77                     # exit code of a test or benchmark that was left out
NOT_ON_THIS_MACHINE = 5          # that of tofray, for a GPU or an instruction set that is not there


class LeftOut(Exception):
    """A topic that cannot be measured here, with its reason."""


class Failed(Exception):
    """A program that ended badly, or said what nobody can read."""


@dataclasses.dataclass(frozen=True)
class Figure:
    row: str
    value: float
    unit: str
    command: str
    less_is_better: bool = True
    frame: str = ""              # SHA-256 of its first frame


@dataclasses.dataclass(frozen=True)
class Build:
    """A build folder of tofray, and the place where its programs run."""

    name: str
    folder: pathlib.Path
    scratch: pathlib.Path        # on the disk that recordings are measured on
    isa: str = ""                # forced by TOFRAY_ISA; else the program's choice

    @property
    def tofray(self) -> pathlib.Path:
        return self.folder / "apps/tofray/tofray"

    def bench(self, name: str) -> pathlib.Path:
        path = self.folder / "benches" / name
        if not path.exists():
            raise LeftOut(f"benches/{name} is not built (cmake -DTOFRAY_BENCHES=ON, target {name})")
        return path

    def shown(self, words: list[str], env: Mapping[str, str]) -> str:
        """A command as a reader types it, with BUILD in place of the build's folder."""
        return " ".join([*(f"{key}={value}" for key, value in env.items()), shlex.join(words)]).replace(str(self.folder), "BUILD")

    def run(self, *command: object, env: Mapping[str, str] = {}) -> tuple[str, str]:
        """What a program prints, and the command as it is shown."""
        words, more = [str(word) for word in command], {**({"TOFRAY_ISA": self.isa} if self.isa else {}), **env}
        shown = self.shown(words, more)
        try:
            done = subprocess.run(words, cwd=ROOT, env={**os.environ, **more}, capture_output=True, text=True)
        except FileNotFoundError as fault:
            raise LeftOut(f"{pathlib.Path(words[0]).name} is missing") from fault
        judge(shown, done)
        return done.stdout, shown

    def frames(self, *words: str) -> tuple[list[dict[str, Any]], str]:
        """The results of `tofray bench`."""
        text, command = self.run(self.tofray, "bench", *words, "--json")
        try:
            return list(json.loads(text)["results"]), command
        except (ValueError, KeyError) as fault:
            raise unread(command, text) from fault


def judge(shown: str, done: subprocess.CompletedProcess[str]) -> None:
    if done.returncode == 0:
        return
    said = (done.stderr.strip() or done.stdout.strip()).splitlines() or ["it says nothing"]
    if done.returncode == SKIPPED:
        reasons = [line for line in done.stdout.splitlines() if "SKIPPED:" in line]
        raise LeftOut(reasons[0].split("SKIPPED:")[1].strip() if reasons else said[0])
    if done.returncode == NOT_ON_THIS_MACHINE:
        raise LeftOut(said[0].removeprefix("error: "))
    raise Failed(f"`{shown}` ended with {done.returncode}: {said[-1]}")


def unread(command: str, text: str) -> Failed:
    return Failed(f"`{command}` printed no figure that is known: {(text.strip().splitlines() or ['nothing'])[0]}")


def matches(pattern: str, text: str, command: str) -> list[re.Match[str]]:
    found = list(re.finditer(pattern, text, re.M))
    if not found:
        raise unread(command, text)
    return found


def to(figure: Figure, other: Figure, row: str) -> Figure:
    """The ratio of two times."""
    return dataclasses.replace(figure, row=row, value=figure.value / other.value, unit="×")


# --- Frames ---

def frame(at: Build, row: str, *words: str) -> Figure:
    results, command = at.frames(*words)
    return Figure(row, float(results[0]["ms_median"]), "ms", command, frame=results[0]["sha256"])


def primitives(at: Build) -> Iterator[Figure]:
    for row, words in (("bench-primitives", ["bench-primitives"]), ("bench-primitives, one thread", ["bench-primitives", "--threads", "1"]),
                       ("bench-primitives, noise off", ["bench-primitives", "--noise", "off"]), ("flying-ball", ["flying-ball"]),
                       ("bench-mesh", ["bench-mesh"])):
        yield frame(at, row, *words, "--frames", "100")


def set_up(at: Build) -> Iterator[Figure]:
    for scene in ("bench-primitives", "bench-mesh"):
        results, command = at.frames(scene, "--frames", "10")
        for what, ms in results[0]["set_up_ms"].items():
            yield Figure(f"{scene}, {what.replace('_', ' ').replace('sensor number', 'number of the sensor')}", float(ms), "ms", command)


def samples(at: Build) -> Iterator[Figure]:
    slow = ("flying-ball", "--frames", "30", "--set", "objects.1.sphere.velocity=[0, 0, -5 cm/s]")  # its own ball is at the camera by frame 20
    one = frame(at, "one ray", *slow)
    yield one
    for row, words in (("3 × 3 samples within pixels", ["--subpixel", "3"]), ("9 times within each exposure", ["--exposure-samples", "9"])):
        many = frame(at, row, *slow, *words)
        yield many
        yield to(many, one, f"{row}, to one")


def gpu(at: Build) -> Iterator[Figure]:
    for scene, batch in (("bench-primitives", "4096"), ("bench-mesh", "512")):
        results, command = at.frames(scene, "--backend", "cuda", "--batch", batch)
        for one in results:
            differing = "" if one["differing"] == "index" else f", of other {one['differing']}"
            for where, key in (("left there", "frames_per_s_device"), ("taken to the host", "frames_per_s_host")):
                yield Figure(f"{scene}{differing}, {where}", float(one[key]), "frames/s", command, less_is_better=False)


# --- Rays ---

def anywhere(at: Build) -> Iterator[Figure]:
    text, command = at.run(at.bench("bench_anywhere"))
    for part in re.split(r"(?m)^(?=\d+ triangles, )", text):
        for found in re.finditer(r"(\d+) triangles, .*\neach by itself: ([\d.]+) M/s(?:.*\n.*Embree.*ratio ([\d.]+))?", part):
            row = f"{int(found[1]):,} triangles"
            yield Figure(f"{row}, each ray alone", float(found[2]), "M rays/s", command, less_is_better=False)
            if found[3]:
                yield Figure(f"{row}, to Embree", float(found[3]), "×", command, less_is_better=False)
    matches(r"^each by itself:", text, command)


def bounces(at: Build) -> Iterator[Figure]:
    text, command = at.run(at.bench("bench_bounces"), "16", "times")
    for found in matches(r"^(\S.*?) +(\d+) +(-|\d+) +([\d.]+)", text, command):
        light = "no bounces" if found[3] == "-" else f"{found[2]} bounces, {found[3]} ways"
        yield Figure(f"{found[1]}, {light}", float(found[4]), "ms", command)


def mesh_row(words: list[str], command: str) -> Iterator[Figure]:
    """Of: triangles, M/s built, bytes each, full, and for camera and shadow rays squares, single, Embree."""
    row = f"{int(words[0]):,} triangles"
    yield Figure(f"{row}, built", float(words[1]), "M triangles/s", command, less_is_better=False)
    yield Figure(f"{row}, memory of each", float(words[2]), "bytes", command)
    for kind, own, embree in (("camera", words[4], words[6]), ("shadow", words[7], words[9])):
        yield Figure(f"{row}, {kind} rays", float(own), "M rays/s", command, less_is_better=False)
        if embree != "-":
            yield Figure(f"{row}, {kind} rays to Embree", float(own) / float(embree), "×", command, less_is_better=False)


def meshes(at: Build) -> Iterator[Figure]:
    isa = at.isa or isa_of(at)
    text, command = at.run(at.bench("bench_meshes_avx512" if isa == "avx512" else "bench_meshes_avx2"), "1e5", "1e6", "1e7")
    for found in matches(r"^ *\d+(?: +(?:[\d.]+|-)){9} *$", text, command):
        yield from mesh_row(found[0].split(), command)


def isa_of(at: Build) -> str:
    """The instruction set whose code runs."""
    text, _ = at.run(at.tofray, "doctor", "--json")
    return str(json.loads(text)["isa"])


KINDS = {"spread-sphere": "spheres", "sun-sphere": "spheres in the sun", "spread-mesh": "mesh instances"}


def objects(at: Build) -> Iterator[Figure]:
    text, command = at.run("benches/many_objects.py", at.tofray, "--threads", "1", "--rounds", "1", "--frames", "12", "--kinds", ",".join(KINDS))
    for found in matches(r"^(\S+) +1 threads +(\d+) objects +([\d.]+) ms +([\d.]+) x", text, command):
        count, kind = int(found[2]), KINDS[found[1]]
        row = f"{count:,} {kind}" if count > 1 else f"1 {kind}".replace("spheres", "sphere").replace("instances", "instance")
        yield Figure(row, float(found[3]), "ms", command)
        if count > 1:
            yield Figure(f"{row}, to one", float(found[4]), "×", command)


# --- The disk, the pixel, the viewer ---

def recording(at: Build) -> Iterator[Figure]:
    text, command = at.run("benches/recording.py", at.tofray, at.bench("bench_frames"), at.scratch, "--frames", "100", "--rounds", "1")
    for found in matches(r"^\| (all|raw\S+) \|(?: [\d.]+ \|){3} ([\d.]+) \| ([\d.]+) % \|", text, command):
        row = "all arrays" if found[1] == "all" else found[1]
        yield Figure(f"{row}, recorded", float(found[2]), "frames/s", command, less_is_better=False)
        yield Figure(f"{row}, of the slower", float(found[3]), "%", command, less_is_better=False)


def pixel(at: Build) -> Iterator[Figure]:
    text, command = at.run("benches/whole_pixel.py", at.tofray, "1", "all")
    for found in matches(r"^\| (none|all) \| ([\d.]+)(?: ms)? \| ([\d.]+)(?: ms)? \|", text, command):
        for threads, value in (("one thread", found[2]), ("two threads", found[3])):
            if found[1] == "none":
                yield Figure(f"no effects, {threads}", float(value), "ms", command)
            else:
                yield Figure(f"all effects, {threads}, to none", float(value), "×", command)


def viewer(at: Build) -> Iterator[Figure]:
    page = at.folder / "viewer"
    if not page.exists():
        raise LeftOut("the viewer's page is not built (cmake -DTOFRAY_VIEW=ON)")
    text, command = at.run("node", "benches/viewer.mjs", "20", "5", env={"TOFRAY": str(at.tofray), "TOFRAY_PAGE_PACKAGES": str(page)})
    for found in matches(r"^\| (\S.*?) \| (?:([\d.]+) / ([\d.]+) ms|([\d.]+)/s) \|", text, command):
        row = found[1].replace("`", "")
        if found[4]:
            yield Figure(row, float(found[4]), "frames/s", command, less_is_better=False)
        else:
            yield Figure(f"{row}, median", float(found[2]), "ms", command)
            yield Figure(f"{row}, 95th percentile", float(found[3]), "ms", command)


@dataclasses.dataclass(frozen=True)
class Topic:
    title: str
    rounds: int                  # unless --rounds says otherwise: programs that take medians themselves need few
    measure: Callable[[Build], Iterator[Figure]]


TOPICS: Mapping[str, Topic] = {
    "primitives": Topic("Frames", 7, primitives),
    "set-up": Topic("Set-up of a simulator", 7, set_up),
    "anywhere": Topic("Rays from anywhere", 3, anywhere),
    "bounces": Topic("Light that bounces", 3, bounces),
    "meshes": Topic("Meshes", 2, meshes),
    "objects": Topic("Many objects", 2, objects),
    "samples": Topic("Samples in motion", 3, samples),
    "recording": Topic("Recording to the disk", 2, recording),
    "pixel": Topic("The whole pixel", 3, pixel),
    "gpu": Topic("On a GPU", 3, gpu),
    "viewer": Topic("The viewer", 1, viewer),
}
