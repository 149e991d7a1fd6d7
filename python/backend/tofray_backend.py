# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Builds wheels (PEP 517 and 660) by CMake: the module with both libraries in it, and the command.

Needs what `./dev packages` installs, and Python's headers and pybind11; nothing of a registry. What is built stays in build/wheel, or where
the environment variable TOFRAY_WHEEL_BUILD says, and is used again; TOFRAY_CUDA (ON, OFF or AUTO) and CUDAARCHS say for which GPUs, as in ./dev;
TOFRAY_CMAKE_ARGS are further words for CMake. `pip install -v .` shows what was chosen, `python -m tofray doctor` says it afterwards.
"""

from __future__ import annotations

import base64
import csv
import hashlib
import io
import os
import pathlib
import re
import shlex
import subprocess
import sys
import sysconfig
import zipfile
from typing import Any

ROOT = pathlib.Path(__file__).resolve().parents[2]


def _version() -> str:
    found = re.search(r"project\(tofray VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
    assert found is not None
    return found[1]


def _metadata() -> str:
    return (f"Metadata-Version: 2.1\nName: tofray\nVersion: {_version()}\nSummary: Simulator of indirect time-of-flight (PMD) 3D cameras\n"
            "License: Apache-2.0\nRequires-Python: >=3.9\nRequires-Dist: numpy\n")


def _tag() -> str:
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    return f"{python}-{python}-" + re.sub(r"[-.]", "_", sysconfig.get_platform())


def _build() -> pathlib.Path:
    """Archives in place of shared libraries, so that the module stands alone wherever it is copied to."""
    folder = pathlib.Path(os.environ.get("TOFRAY_WHEEL_BUILD") or ROOT / "build/wheel").resolve()
    jobs = os.environ.get("TOFRAY_JOBS") or str(os.cpu_count() or 1)
    subprocess.run(["cmake", "-S", str(ROOT), "-B", str(folder), "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
                    "-DBUILD_SHARED_LIBS=OFF", "-DTOFRAY_TESTS=OFF", "-DTOFRAY_PYTHON=ON", f"-DTOFRAY_PYTHON_EXECUTABLE={sys.executable}",
                    *(f"-D{option}={os.environ[name]}" for option, name in
                      (("TOFRAY_CUDA", "TOFRAY_CUDA"), ("TOFRAY_CUDA_ARCHITECTURES", "CUDAARCHS")) if os.environ.get(name)),
                    *shlex.split(os.environ.get("TOFRAY_CMAKE_ARGS", ""))], check=True)
    for line in (folder / "choices.txt").read_text(encoding="utf-8").splitlines():
        print(f"Building {line}", flush=True)
    subprocess.run(["cmake", "--build", str(folder), "--parallel", jobs, "--target", "tofray_python", "tofray"], check=True)
    return folder


def _write(directory: str, files: dict[str, tuple[bytes, int]], name: str = "tofray", tag: str = "", metadata: str = "") -> str:
    """(packaging/make.py has wheels of other names, tags and metadata.)"""
    info, tag = f"{name}-{_version()}.dist-info", tag or _tag()
    name = f"{name}-{_version()}-{tag}.whl"
    files = {**files, f"{info}/METADATA": ((metadata or _metadata()).encode(), 0o644),
             f"{info}/WHEEL": (f"Wheel-Version: 1.0\nGenerator: tofray\nRoot-Is-Purelib: false\nTag: {tag}\n".encode(), 0o644)}
    record = io.StringIO()
    lines = csv.writer(record, lineterminator="\n")
    with zipfile.ZipFile(os.path.join(directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        def add(path: str, data: bytes, mode: int) -> None:
            entry = zipfile.ZipInfo(path, (1980, 1, 1, 0, 0, 0))
            entry.external_attr, entry.compress_type = (0o100000 | mode) << 16, zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)

        for path, (data, mode) in files.items():
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            lines.writerow([path, f"sha256={digest}", len(data)])
            add(path, data, mode)
        lines.writerow([f"{info}/RECORD", "", ""])
        add(f"{info}/RECORD", record.getvalue().encode(), 0o644)
    return name


def _module(folder: pathlib.Path) -> pathlib.Path:
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    return folder / "python/tofray" / f"_native{suffix}"


def prepare_metadata_for_build_wheel(metadata_directory: str, config_settings: Any = None) -> str:
    """Nothing has to be built to know it."""
    info = pathlib.Path(metadata_directory) / f"tofray-{_version()}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(_metadata(), encoding="utf-8")
    (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: tofray\nRoot-Is-Purelib: false\nTag: {_tag()}\n", encoding="utf-8")
    return info.name


prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


def build_wheel(wheel_directory: str, config_settings: Any = None, metadata_directory: Any = None) -> str:
    folder = _build()
    package = ROOT / "python/tofray"
    files = {f"tofray/{path.name}": (path.read_bytes(), 0o644) for path in sorted(package.iterdir())
             if path.suffix in (".py", ".pyi") or path.name == "py.typed"}
    module = _module(folder)
    files[f"tofray/{module.name}"] = (module.read_bytes(), 0o755)
    files["tofray/bin/tofray"] = ((folder / "apps/tofray/tofray").read_bytes(), 0o755)
    return _write(wheel_directory, files)


def build_editable(wheel_directory: str, config_settings: Any = None, metadata_directory: Any = None) -> str:
    """A line that names the build folder, whose Python files are links to the tree's."""
    folder = _build()
    return _write(wheel_directory, {"tofray.pth": (f"{folder / 'python'}\n".encode(), 0o644)})


def build_sdist(sdist_directory: str, config_settings: Any = None) -> str:
    raise RuntimeError("tofray is installed from its repository: pip install <folder of the repository>")
