#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The table of what an addition touches (CONTRIBUTING.md): each example stands in exactly the files that its row names."""

import argparse
import pathlib
import re
import sys

ROOMS = ("include", "src", "apps", "python/native", "python/tofray")
WRITTEN_BY_TOOLS = {"python/tofray/_model.py", "python/tofray/_model_names.py", "python/tofray/_arrays.py"}
ENDS = {".h", ".cpp", ".cu", ".py"}


def rows(text):
    """(addition, regular expression of the example, files) of each row of the table."""
    table = text.split("| addition | example | source files that name it |\n", 1)[1].split("\n\n", 1)[0]
    for line in table.splitlines()[1:]:
        addition, example, files = (cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|")))
        yield addition, example.strip("`").replace("\\|", "|"), re.findall(r"`([^`]+)`", files)


def files_that_name(source, example):
    """Files written by hand in which the example is a word."""
    word = re.compile(rf"(?<![\w])({example})(?![\w])")
    for room in ROOMS:
        for path in sorted((source / room).rglob("*")):
            name = path.relative_to(source).as_posix()
            if path.suffix in ENDS and name not in WRITTEN_BY_TOOLS and word.search(path.read_text(encoding="utf-8")):
                yield name


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--source", type=pathlib.Path, required=True)
    source = parser.parse_args().source
    wrong, seen = [], 0
    for addition, example, said in rows((source / "CONTRIBUTING.md").read_text(encoding="utf-8")):
        seen += 1
        found = list(files_that_name(source, example))
        print(f"{addition}: {len(found)} files")
        wrong += [f"CONTRIBUTING.md, {addition}: {name} names {example}, and the row does not say so" for name in found if name not in said]
        wrong += [f"CONTRIBUTING.md, {addition}: {name} does not name {example}" for name in said if name not in found]
    if seen < 8:
        wrong.append(f"the table has {seen} rows: it lost some")
    print(*wrong, sep="\n", file=sys.stderr)
    return 1 if wrong else 0


sys.exit(main())
