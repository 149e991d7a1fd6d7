# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Libraries that go along with a program, so that it needs none of the machine that it comes to (as auditwheel and its like do for wheels).

CMake finds them, patchelf has each refer to those beside it. Names get a hash of the content: a library of the machine that has the same
name is another one, in the same process, too.
"""

from __future__ import annotations

import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

FONT = pathlib.Path("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")
HERE = pathlib.Path(__file__).resolve().parent

# The oldest C library beside which distributions have a C++ library of that version (g++ 11, 12, 13, 13.2, 14).
GLIBC_OF_GLIBCXX = {29: 34, 30: 35, 31: 38, 32: 38, 33: 40}


def run(*words: object) -> str:
    done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise SystemExit(f"failed: {' '.join(str(word) for word in words)}\n{done.stdout}{done.stderr}")
    return done.stdout


def needed_libraries(files: list[pathlib.Path], own: pathlib.Path) -> list[pathlib.Path]:
    """Files of this machine that `files` need, directly or not. `own`: where libraries of ours are."""
    with tempfile.TemporaryDirectory() as folder:
        listing = pathlib.Path(folder) / "needed"
        run("cmake", "-D", "FILES=" + ";".join(map(str, files)), "-D", f"OWN={own}", "-D", f"OUTPUT={listing}", "-P", HERE / "dependencies.cmake")
        return sorted(path for line in listing.read_text().splitlines() if (path := pathlib.Path(line)).name)


def hashed(name: str, content: bytes) -> str:
    """libpng16.so.16 → libpng16-1a2b3c4d.so.16"""
    stem, dot, rest = name.partition(".so")
    return f"{stem}-{hashlib.sha256(content).hexdigest()[:8]}{dot}{rest}"


def carry(files: list[pathlib.Path], folder: pathlib.Path, own: pathlib.Path, rename_own: bool = False) -> list[pathlib.Path]:
    """Copies what `files` need into `folder`, and changes `files` so that they find it there. `own` holds libraries of ours, which
    stay where they are, or with `rename_own` are carried, too. Returns where the libraries of the machine came from."""
    found = needed_libraries(files, own)
    ours = [path for path in found if path.parent == own]
    foreign = [path for path in found if path.parent != own]
    folder.mkdir(parents=True, exist_ok=True)
    names, carried = {}, []
    for path in foreign + (ours if rename_own else []):
        new = folder / hashed(path.name, path.read_bytes())
        shutil.copy(path.resolve(), new)
        new.chmod(0o644)
        names[path.name] = new.name
        carried.append(new)
    for new in carried:
        run("patchelf", "--set-soname", new.name, new)
    if any(path.name.startswith("libfontconfig.") for path in foreign):
        shutil.copy(FONT, folder)   # src/pictures/carried_font.cpp looks there
        foreign.append(FONT)
    for file in [*files, *carried]:
        needed = run("patchelf", "--print-needed", file).split()
        replaced = [word for name in needed if name in names for word in ("--replace-needed", name, names[name])]
        if replaced:
            run("patchelf", *replaced, file)
        if replaced or any(name in {path.name for path in ours} for name in needed):
            places = [folder] if rename_own or file in carried else [folder, own]
            search = ":".join("$ORIGIN" + (f"/{to}" if (to := os.path.relpath(place, file.parent)) != "." else "") for place in places)
            run("patchelf", "--set-rpath", search, file)
    return foreign


def oldest_glibc(files: list[pathlib.Path]) -> int:
    """x of the oldest glibc 2.x that has all that these files ask for, and comes with a C++ library that has."""
    found = [2]
    for file in files:
        text = run("readelf", "--version-info", "--wide", file)
        found += [int(minor) for minor in re.findall(r"\bGLIBC_2\.(\d+)\b", text)]
        for minor in re.findall(r"\bGLIBCXX_3\.4\.(\d+)\b", text):
            if int(minor) > max(GLIBC_OF_GLIBCXX):
                raise SystemExit(f"{file} needs GLIBCXX_3.4.{minor}, which is newer than what packaging/carry.py knows")
            found.append(GLIBC_OF_GLIBCXX.get(int(minor), 2))
    return max(found)


def packages_of(files: list[pathlib.Path]) -> dict[str, str]:
    """The distribution's packages that these files are of, with their versions."""
    out = {}
    for file in files:
        for path in (file, file.resolve(), pathlib.Path(str(file.resolve()).removeprefix("/usr"))):
            found = subprocess.run(["dpkg-query", "-S", str(path)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            if found.returncode == 0:
                package = found.stdout.split(": ")[0].split(",")[0]
                out[package.split(":")[0]] = run("dpkg-query", "-W", "-f=${source:Package} ${source:Version}", package)
                break
        else:
            raise SystemExit(f"{file} is of no package: its licence is not known")
    return dict(sorted(out.items()))
