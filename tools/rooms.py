#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The folders of src/ (and those of apps/ that tests have, too) by floors, in CONTRIBUTING.md: what each may include, as `USES` in its
CMakeLists.txt says. All have include/tofray, which USES calls api.

    python3 tools/rooms.py             writes the table anew
    python3 tools/rooms.py --check     says whether it is true; a test runs this

The table stands between <!-- table: rooms --> and <!-- end -->. A folder stands one floor above the highest one that it uses; what it
has through another that it uses is left out.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "CONTRIBUTING.md"
MEND = "python3 tools/rooms.py writes it"
WORDS = ("SOURCES", "USES", "LIBRARIES", "HEADERS", "COLD", "PART_OF")


def folders():
    """{folder: the folders that it uses}."""
    found = {}
    for path in sorted([*ROOT.glob("src/**/CMakeLists.txt"), *ROOT.glob("apps/tofray/*/CMakeLists.txt")]):
        text = re.sub(r"#.*", "", path.read_text(encoding="utf-8"))
        for call in re.findall(r"\btofray_folder\(([^)]*)\)", text):
            name, *rest = call.split()
            uses, inside = [], False
            for word in rest:
                inside = word == "USES" if word in WORDS else inside
                uses += [word] if inside and word not in (*WORDS, "api") else []
            if not name.startswith("$"):
                found[name] = uses
    return found


def reached(folder, uses, seen=None):
    """All that a folder may include, through whatever it uses."""
    seen = set() if seen is None else seen
    for other in uses[folder]:
        if other not in seen:
            seen.add(other)
            reached(other, uses, seen)
    return seen


def floor_of(folder, uses, path=()):
    if folder in path:
        raise SystemExit(f"rooms.py: {' uses '.join((*path, folder))}: a folder may not use itself")
    return 1 + max((floor_of(other, uses, (*path, folder)) for other in uses[folder]), default=-1)


def direct(folder, uses):
    """What a folder uses but for what it has through another one."""
    return sorted(other for other in uses[folder] if not any(other in reached(through, uses) for through in uses[folder]))


def table():
    uses = folders()
    unknown = sorted({other for all_of in uses.values() for other in all_of} - set(uses))
    if unknown:
        raise SystemExit(f"rooms.py: USES names {', '.join(unknown)}, of which there is no tofray_folder")
    floors = {}
    for folder in uses:
        floors.setdefault(floor_of(folder, uses), []).append(folder)
    lines = ["| floor | folder ← what it uses |", "|---|---|"]
    for floor in sorted(floors, reverse=True):
        rooms = [f"**{one}**" + (f" ← {', '.join(direct(one, uses))}" if uses[one] else "") for one in sorted(floors[floor])]
        lines.append(f"| {floor} | {'; '.join(rooms)} |")
    return "\n".join(lines) + "\n"


def main():
    text = PAGE.read_text(encoding="utf-8")
    begin, end = "<!-- table: rooms -->\n", "<!-- end -->"
    before, rest = text.split(begin, 1)
    after = rest.split(end, 1)[1]
    made = before + begin + table() + end + after
    if "--check" in sys.argv[1:]:
        if made != text:
            raise SystemExit(f"CONTRIBUTING.md: the table of folders is not what USES says: {MEND}")
        return
    PAGE.write_text(made, encoding="utf-8")


if __name__ == "__main__":
    main()
