#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Checks what nothing else reads: links between documents, names of equations that code and documents cite, SPDX lines, versions."""

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


# An equation's name is the \tag of its formula, in one chapter, and begins a line of the page of all equations, in the order of the chapters.
NAME = r"[a-z][a-z0-9]*(?:-[a-z0-9]+)*"
LONGEST_NAME = 28
register = root / "docs/theory/equations.md"
homes = {}  # the chapter of each name
sections = set()
for path in sorted((root / "docs/theory").glob("0*.md")):
    for line, text in numbered_lines(path):
        sections |= set(re.findall(r"^## (\d+\.\d+) ", text))
        for name in re.findall(r"\\tag\{([^}]*)\}", text):
            if not re.fullmatch(NAME, name) or len(name) > LONGEST_NAME:
                fault(path, line, f"{name} is no name of an equation: lower case, words joined by hyphens, {LONGEST_NAME} characters at most")
            if name in homes:
                fault(path, line, f"a second equation has the name {name}")
            homes.setdefault(name, path)
listed_names = {}
for line, text in numbered_lines(register):
    for name in re.findall(r"^- \*\*([^*]*)\*\* ", text):
        if name in listed_names:
            fault(register, line, f"the equation {name} is listed twice")
        if name not in homes:
            fault(register, line, f"the equation {name} is in no chapter")
        listed_names.setdefault(name, line)
for name, path in homes.items():
    if name not in listed_names:
        fault(path, 1, f"the equation {name} is missing in docs/theory/equations.md")
for name, expected in zip((one for one in listed_names if one in homes), (one for one in homes if one in listed_names)):
    if name != expected:
        fault(register, listed_names[name], f"the equation {name} is not in its chapter's order: expected {expected}")
        break


def check_citations(path):
    """[theory: reset-noise, crosstalk] in one line, or a link whose text is the name and whose place is the formula."""
    for line, text in numbered_lines(path):
        for cited in re.finditer(r"(?<!\\)\[theory:([^\]]*)(\])?", text):
            if not cited[2] or not re.fullmatch(rf" {NAME}(, {NAME})*", cited[1]):
                fault(path, line, f"no citation of equations: {cited[0]}\n  expected their names, by commas, in one line")
                continue
            for name in re.findall(NAME, cited[1]):
                if name not in homes:
                    fault(path, line, f"there is no equation {name} in docs/theory")
        for shown, target, name in re.findall(r"(?:\[([^\]]*)\])?\(([^()\s#]*)#equation-([^()\s]*)\)", text):
            home = (path.parent / target).resolve() if target else path
            if name not in homes:
                fault(path, line, f"there is no equation {name} in docs/theory")
            elif home != homes[name]:
                fault(path, line, f"the equation {name} is in {homes[name].relative_to(root)}")
            elif shown != name:
                fault(path, line, f"the link to the equation {name} shows {shown!r}")
        if re.search(r"\b(?:eqs?\.|equations?)\s\d+\.\d+", text, re.I):
            fault(path, line, "an equation is cited by a number: it has a name")
        for number in re.findall(r"\b[Tt]heory (\d+\.\d+)", text):
            if number not in sections:
                fault(path, line, f"there is no section {number} in docs/theory")


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
    if path.suffix in (".h", ".cpp", ".cu", ".md", ".py", ".ipynb", ".rst", ".txt", ".cmake", ".yaml", ".sh", ".mjs", ".js"):
        check_citations(path)
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

print("\n".join(faults) if faults else f"{len(homes)} equations, {len(files)} files: good")
sys.exit(1 if faults else 0)
