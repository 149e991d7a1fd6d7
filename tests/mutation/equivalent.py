# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Mutants that no test can kill, since they change nothing that a user could see: equivalent.txt says which, and why."""
from pathlib import Path

from mutants import mutants_of

root = Path(__file__).resolve().parents[2]


def known(path=Path(__file__).with_name("equivalent.txt")):
    """Place of a mutant → the reason. A line that begins with "src/" is a place; the indented lines below it are its reason."""
    out, places, ended = {}, [], True
    for line in path.read_text().splitlines():
        if line.startswith("src/"):
            if ended:
                places, ended = [], False
            places.append(line.strip())
            out[line.strip()] = ""
        elif line.startswith("    "):
            ended = True
            for place in places:
                out[place] = (out[place] + " " + line.strip()).strip()
    return out


def gone(places):
    """Those of them that the sources no longer have."""
    there = set()
    for file in {place.split(" | ")[0] for place in places}:
        if (root / file).is_file():
            there |= {m.place.strip() for m in mutants_of(file, (root / file).read_text())}
    return [place for place in places if place not in there]
