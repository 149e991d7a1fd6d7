#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the benchmarks of one build, or of an old and a new one in turn, and writes a table for each topic: numbers.md and numbers.json.

    benches/run.py BUILD                      # a build folder: it has apps/tofray/tofray, and benches/ with -DTOFRAY_BENCHES=ON
    benches/run.py OLD NEW --topics bounces,meshes --rounds 5 -o out/numbers

Old and new take turns in each round, and every other round begins with new. A table has the median of the rounds and the best of them (of
times the least, of rates the greatest), both ratios of new to old, and each row's goal, which is held against the median. What cannot be
measured here is left out, and the table says why."""

from __future__ import annotations

import argparse
import dataclasses
import datetime
import json
import os
import pathlib
import platform
import statistics
import subprocess
import sys
from typing import Any, Mapping, Sequence

import goals
import topics
from topics import Build, Failed, Figure, LeftOut, Topic


@dataclasses.dataclass
class Measured:
    """Of a topic: figures of each row by build, a list for the rounds; why a build has none; which of these reasons are faults."""

    rows: dict[str, dict[str, list[Figure]]] = dataclasses.field(default_factory=dict)
    left_out: dict[str, str] = dataclasses.field(default_factory=dict)
    failed: bool = False

    def add(self, build: Build, figures: Sequence[Figure]) -> None:
        for figure in figures:
            self.rows.setdefault(figure.row, {}).setdefault(build.name, []).append(figure)


def turns(builds: Sequence[Build], rounds: int) -> list[tuple[int, Build]]:
    """The builds in turn; every other round begins with the last one."""
    return [(i, build) for i in range(rounds) for build in (builds if i % 2 == 0 else list(reversed(builds)))]


def measure(name: str, topic: Topic, builds: Sequence[Build], rounds: int) -> Measured:
    out = Measured()
    for i, build in turns(builds, rounds):
        if build.name in out.left_out:
            continue
        print(f"{name}: round {i + 1} of {rounds}, {build.name}", file=sys.stderr, flush=True)
        try:
            out.add(build, list(topic.measure(build)))
        except (LeftOut, Failed) as fault:
            out.left_out[build.name] = str(fault)
            out.failed = out.failed or isinstance(fault, Failed)
        except (LookupError, TypeError, ValueError) as fault:
            out.left_out[build.name] = f"its results lack what is read of them ({type(fault).__name__}: {fault})"
            out.failed = True
    return out


# --- What is written ---

def summary(figures: Sequence[Figure]) -> dict[str, Any]:
    values, first = [one.value for one in figures], figures[0]
    return {"median": statistics.median(values), "best": min(values) if first.less_is_better else max(values), "rounds": values,
            "command": first.command, "frame": first.frame}


def ratios(row: Mapping[str, Any]) -> dict[str, float] | None:
    """New over old, where both are there and no rate is nothing."""
    if "old" not in row or "new" not in row or not (row["old"]["median"] and row["old"]["best"]):
        return None
    return {key: row["new"][key] / row["old"][key] for key in ("median", "best")}


def judged(row: Mapping[str, Any], goal: goals.Goal | None, isa: str) -> tuple[str, bool | None]:
    """A goal in words, and whether it is met: None where nobody knows."""
    limit = None if goal is None else goal.on(isa)
    if goal is None or limit is None:
        return "", None
    if goal.of_old:
        ratio = row["ratio"]
        return f"≤ {limit:g} of old", None if ratio is None else ratio["median"] <= limit
    median = row["new"]["median"] if "new" in row else None
    met = None if median is None else (median >= limit if goal.at_least else median <= limit)
    return f"{'≥' if goal.at_least else '≤'} {limit:,g}", met


def table_row(what: str, by_build: Mapping[str, list[Figure]], goal: goals.Goal | None, isa: str) -> dict[str, Any]:
    row: dict[str, Any] = {"what": what, **{name: summary(figures) for name, figures in by_build.items()}}
    first = next(iter(by_build.values()))[0] if by_build else None
    row["unit"] = first.unit if first else ""
    row["ratio"] = ratios(row)
    row["goal"], row["met"] = judged(row, goal, isa)
    return row


def topic_json(name: str, topic: Topic, measured: Measured, isa: str) -> dict[str, Any]:
    wanted = goals.GOALS.get(name, {})
    rows = [*measured.rows, *(what for what in wanted if what not in measured.rows)]
    return {"name": name, "title": topic.title, "left_out": measured.left_out, "failed": measured.failed,
            "rows": [table_row(what, measured.rows.get(what, {}), wanted.get(what), isa) for what in rows]}


def number(value: float) -> str:
    return f"{value:,.0f}" if value >= 1000 else f"{value:.3g}"


def cell(row: Mapping[str, Any], name: str) -> str:
    return f"{number(row[name]['median'])} ({number(row[name]['best'])})" if name in row else "–"


def verdict(row: Mapping[str, Any]) -> str:
    if not row["goal"]:
        return ""
    return "not measured" if row["met"] is None else "met" if row["met"] else "**missed**"


def bytes_differ(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    return [row["what"] for row in rows if "old" in row and "new" in row and row["old"]["frame"] != row["new"]["frame"]]


def left_out_lines(left_out: Mapping[str, str]) -> list[str]:
    """Reasons, each once with the builds that it is of."""
    builds: dict[str, list[str]] = {}
    for name, reason in left_out.items():
        builds.setdefault(reason, []).append(name)
    return [line for reason, names in builds.items() for line in (f"Left out of {' and '.join(names)}: {reason}.", "")]


def topic_lines(topic: Mapping[str, Any], names: Sequence[str]) -> list[str]:
    commands = list(dict.fromkeys(row[name]["command"] for row in topic["rows"] for name in names if name in row))
    lines = [f"## {topic['title']}", "", *left_out_lines(topic["left_out"])]
    lines += ["| what | unit | " + " | ".join(f"{name}: median (best)" for name in names) + " | new/old: medians, bests | goal | | how |",
              "|---" * (len(names) + 6) + "|"]
    for row in topic["rows"]:
        ratio = f"{row['ratio']['median']:.3f}, {row['ratio']['best']:.3f}" if row["ratio"] else ""
        how = next((str(commands.index(row[name]["command"]) + 1) for name in names if name in row), "")
        lines.append(f"| {row['what']} | {row['unit']} | {' | '.join(cell(row, name) for name in names)} | {ratio} | {row['goal']} | {verdict(row)} | {how} |")
    differ = bytes_differ(topic["rows"])
    lines += ["", f"**Frames have other bytes**: {'; '.join(differ)}."] if differ else []
    return [*lines, "", *(f"{i}. `{command}`" for i, command in enumerate(commands, 1)), *[""] * bool(commands)]


def markdown(all_of: Mapping[str, Any]) -> str:
    machine, builds = all_of["machine"], all_of["builds"]
    lines = ["# Benchmarks", "",
             f"{all_of['date']}, {machine['cpu']}, {machine['cores']} cores, {machine['isa']}, Linux {machine['kernel']}; load {machine['load_at_begin']:.1f} at the "
             f"begin, {machine['load_at_end']:.1f} at the end. Medians of rounds, in brackets the best of them; goals are of the median.", ""]
    lines += [f"- {name}: {build['commit']} ({build['version']}, {build['compiler']}), {build['folder']}" for name, build in builds.items()]
    return "\n".join([*lines, "", *(line for topic in all_of["topics"] for line in topic_lines(topic, list(builds)))])


def write(folder: pathlib.Path, all_of: dict[str, Any]) -> None:
    all_of["machine"]["load_at_end"] = os.getloadavg()[0]
    (folder / "numbers.json").write_text(json.dumps(all_of, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    (folder / "numbers.md").write_text(markdown(all_of), encoding="utf-8")


# --- Builds and the machine ---

def commit_of(folder: pathlib.Path) -> str:
    """That of the tree which a build folder was made from, as it is now."""
    home = [line.split("=", 1)[1] for line in (folder / "CMakeCache.txt").read_text().splitlines() if line.startswith("CMAKE_HOME_DIRECTORY")] \
        if (folder / "CMakeCache.txt").exists() else []
    done = subprocess.run(["git", "-C", home[0], "describe", "--always", "--dirty", "--exclude=*"], capture_output=True, text=True) if home else None
    return done.stdout.strip() if done is not None and done.returncode == 0 else "unknown commit"


def doctor(build: Build) -> dict[str, Any]:
    """What a build says of itself and the machine."""
    text, command = build.run(build.tofray, "doctor", "--json")
    try:
        return dict(json.loads(text))
    except ValueError as fault:
        raise topics.unread(command, text) from fault


def begun(builds: Sequence[Build], commits: Sequence[str | None]) -> dict[str, Any]:
    said = [doctor(build) for build in builds]
    of_builds = {build.name: {"commit": commit or commit_of(build.folder), "version": one["tofray"], "compiler": one["compiler"], "folder": str(build.folder)}
                 for build, commit, one in zip(builds, commits, said)}
    machine = {"cpu": said[-1]["cpu"], "isa": said[-1]["isa"], "cores": said[-1]["cores_allowed"], "gpus": said[-1]["gpus"], "kernel": platform.release(),
               "load_at_begin": os.getloadavg()[0]}
    return {"date": datetime.datetime.now().strftime("%Y-%m-%d %H:%M"), "machine": machine, "builds": of_builds, "topics": []}


# --- The command ---

def positive(word: str) -> int:
    if not word.isdecimal() or int(word) < 1:
        raise argparse.ArgumentTypeError(f"{word!r} is no number of rounds: 1 or more")
    return int(word)


def topic_names(word: str) -> list[str]:
    names = word.split(",")
    unknown = [name for name in names if name not in topics.TOPICS]
    if unknown:
        raise argparse.ArgumentTypeError(f"there is no topic {unknown[0]!r}; there are {', '.join(topics.TOPICS)}")
    return names


def build_folder(word: str) -> pathlib.Path:
    folder = pathlib.Path(word).resolve()
    if not os.access(folder / "apps/tofray/tofray", os.X_OK):
        raise argparse.ArgumentTypeError(f"{word} is no build of tofray: it has no program apps/tofray/tofray")
    return folder


def arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("builds", nargs="+", type=build_folder, metavar="BUILD", help="a build folder, or an old and a new one")
    parser.add_argument("--topics", type=topic_names, default=list(topics.TOPICS), metavar="LIST", help=f"of {', '.join(topics.TOPICS)} (all)")
    parser.add_argument("--rounds", type=positive, metavar="N", help="rounds of each topic (" + ", ".join(f"{name} {one.rounds}" for name, one in topics.TOPICS.items()) + ")")
    parser.add_argument("--isa", choices=["scalar", "scalar_fma", "avx2", "avx512", "neon"], default="", help="instruction set, as TOFRAY_ISA (the best that there is)")
    parser.add_argument("--old-commit", metavar="NAME", help="what the old build was made from (the commit at which its source tree stands now)")
    parser.add_argument("--new-commit", metavar="NAME", help="the same of the new one")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("out/numbers"), metavar="DIR", help="folder to write to (out/numbers); recordings go to its disk, too")
    return parser


def run(given: argparse.Namespace) -> int:
    names = ["old", "new"][-len(given.builds):]
    builds = [Build(name, folder, given.output.resolve(), given.isa) for name, folder in zip(names, given.builds)]
    all_of = begun(builds, [given.old_commit, given.new_commit][-len(builds):])
    for name in given.topics:
        topic = topics.TOPICS[name]
        measured = measure(name, topic, builds, given.rounds or topic.rounds)
        all_of["topics"].append(topic_json(name, topic, measured, all_of["machine"]["isa"]))
        write(given.output, all_of)   # after each topic: what ends a run takes no more than one
    print(given.output / "numbers.md")
    return 1 if any(topic["failed"] for topic in all_of["topics"]) else 0


def main() -> int:
    parser = arguments()
    given = parser.parse_args()
    if len(given.builds) > 2:
        parser.error(f"{len(given.builds)} builds are too many: one, or an old and a new one")
    try:
        given.output.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        parser.error(f"{given.output} cannot be made: {fault.strerror}")
    try:
        return run(given)
    except (LeftOut, Failed) as fault:
        parser.error(str(fault))


if __name__ == "__main__":
    sys.exit(main())
