# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""One pixel on a camera's optical axis before a wall: what `tofray` says about its noise. Needs nothing but Python's own library."""

import array
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TYPES = {"'<f4'": "f", "'<u4'": "I", "'<u2'": "H", "'|u1'": "B", "'<f8'": "d"}


def program():
    """The tool: what the environment variable TOFRAY names, that of the release build, or that on the path."""
    for candidate in (os.environ.get("TOFRAY"), ROOT / "build/release/apps/tofray/tofray", shutil.which("tofray")):
        if candidate and pathlib.Path(candidate).exists():
            return str(candidate)
    raise SystemExit("error: no tofray found; build it, or say where it is: TOFRAY=… python3 tools/…")


def modes_of(camera):
    """All that `tofray list cameras` says of a camera."""
    listed = json.loads(subprocess.run([program(), "list", "cameras", "--json"], check=True, capture_output=True, text=True).stdout)
    return next(one for one in (listed["cameras"] if isinstance(listed, dict) else listed) if one["name"] == camera)


def binning_of(camera):
    """How many pixels of the sensor lie along a side of one of the image."""
    profile = (ROOT / f"profiles/{camera}.yaml").read_text(encoding="utf-8")
    found = re.search(r"^  binning: *\{?(?:value: *)?(\d+)", profile, flags=re.M)
    return int(found.group(1)) if found else 1


def read(archive, name):
    """An array of an npz file, flat."""
    data = archive.read(name + ".npy")
    length = int.from_bytes(data[8:10], "little")
    header = data[10 : 10 + length].decode("latin1")
    kind = next(code for text, code in TYPES.items() if text in header)
    return array.array(kind, data[10 + length :])


def wall(camera, mode, distance, reflectivity, side, names, words, sets=()):
    """Arrays by name of a frame of a wall before the middle side x side pixels of a camera. `words`: of the command line."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program(), "render", "card", "--quiet", *words, "--emit", "npz", "--arrays", ",".join(names), "-o", folder + "/out"]
        changes = {
            "camera.profile": camera,
            "camera.mode": mode,
            "objects.0.plane.point": f"[0, 0, {distance:.9g}]",
            "objects.0.plane.reflectivity": f"{reflectivity:.9g}",
            "camera.sensor.width": side,
            "camera.sensor.height": side,
            "camera.lens.cx": f"{0.5 * (side - 1)} px",
            "camera.lens.cy": f"{0.5 * (side - 1)} px",
            **dict(sets),
        }
        for key, value in changes.items():
            command += ["--set", f"{key}={value}"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(command)}\n{done.stderr}")
        with zipfile.ZipFile(folder + "/out/frame.npz") as archive:
            return {name: read(archive, name) for name in names}


class Pixel:
    """What one pixel on the axis says: sigma of its range [mm], its error without noise [mm], flags, amplitude [e]."""

    def __init__(self, camera, mode, distance, reflectivity, sets=()):
        names = ("noise_m", "range_m", "gt_range_m", "flags", "amplitude_e")
        arrays = wall(camera, mode, distance, reflectivity, binning_of(camera), names, ["--noise", "off"], sets)
        value = {name: array[0] for name, array in arrays.items()}
        self.sigma_mm = 1e3 * value["noise_m"]
        self.error_mm = 1e3 * (value["range_m"] - value["gt_range_m"])
        self.flags = value["flags"]
        self.amplitude_e = value["amplitude_e"]
