#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Checks what nothing else reads: links between documents, equation numbers that code and documents cite, SPDX lines, versions."""

import pathlib
import re
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
listed = subprocess.run(["git", "ls-files"], cwd=root, check=True, capture_output=True, text=True).stdout.split("\n")
files = [root / name for name in listed if name]
faults = []


def fault(path, line, what):
    faults.append(f"{path.relative_to(root)}:{line}: error: {what}")


def numbered_lines(path):
    return enumerate(path.read_text(encoding="utf-8").split("\n"), start=1)


equations = set(re.findall(r"^- \*\*(\d+\.\d+)\*\*", (root / "docs/theory/equations.md").read_text(encoding="utf-8"), re.M))

# Every equation number has a \tag in its chapter, and every \tag a line on the page of all equations.
tags = set()
for path in sorted((root / "docs/theory").glob("0*.md")):
    for line, text in numbered_lines(path):
        for tag in re.findall(r"\\tag\{([\d.]+)\}", text):
            if tag in tags:
                fault(path, line, f"equation {tag} is numbered twice")
            if tag not in equations:
                fault(path, line, f"equation {tag} is missing in docs/theory/equations.md")
            tags.add(tag)
for missing in sorted(equations - tags):
    faults.append(f"docs/theory/equations.md:1: error: equation {missing} is in no chapter")

for path in files:
    if path.suffix == ".md":
        code = False
        for line, text in numbered_lines(path):
            if text.lstrip().startswith("```"):
                code = not code
            if code:  # a lambda looks like a link
                continue
            for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
                if "://" not in target and not (path.parent / target).exists():
                    fault(path, line, f"the link leads nowhere: {target}")
    if path.suffix in (".h", ".cpp", ".md", ".cu"):
        for line, text in numbered_lines(path):
            # eq. 4.5, eq. 4.4–4.7, eqs. 2.5 and 2.6, equation 2.13
            for cited in re.findall(r"\b(?:eqs?\.|equations?) ((?:\d+\.\d+(?:[–-]| to | and |, )?)+)", text):
                for number in re.findall(r"\d+\.\d+", cited):
                    if number not in equations:
                        fault(path, line, f"there is no equation {number} in docs/theory/equations.md")
    if path.suffix in (".h", ".cpp", ".cu", ".md", ".cmake", ".yaml", ".py", ".sh") or path.name == "CMakeLists.txt":
        head = path.read_text(encoding="utf-8")[:300]
        if "SPDX-FileCopyrightText: 2026 The tofray authors" not in head or "SPDX-License-Identifier: Apache-2.0" not in head:
            fault(path, 1, "the two SPDX lines are missing")

# One version, wherever it stands.
def said(name, pattern):
    text = (root / name).read_text(encoding="utf-8")
    found = re.search(pattern, text, re.M)
    if not found:
        faults.append(f"{name}:1: error: no version is found: {pattern}")
    return found and (found[1], text[: found.start(1)].count("\n") + 1)


version, _ = said("CMakeLists.txt", r"^project\(tofray VERSION ([\d.]+)") or ("", 0)
for name, pattern in (("CITATION.cff", r"^version: ([\d.]+)$"), ("CHANGELOG.md", r"^## ([\d.]+) ")):
    other = said(name, pattern)
    if other and other[0] != version:
        fault(root / name, other[1], f"the version is {other[0]}, in CMakeLists.txt it is {version}")
if not (root / f"docs/release-notes/{version}.md").exists():
    faults.append(f"docs/release-notes/{version}.md:1: error: there is no such page, and the version is {version}")

print("\n".join(faults) if faults else f"{len(equations)} equations, {len(files)} files: good")
sys.exit(1 if faults else 0)
