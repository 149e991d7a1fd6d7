#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Which small mistakes in the formulas does no test see?  tests/mutation/run.py [--folders trace,power] [--count 40] [--seed 1]

Mutants are chosen at random, but the same ones for each seed, and woven into a copy of the tree in build/mutation, each behind a number, so
that all are built at once. Each test is run once to see which mutants it reaches; then each mutant is switched on, and the tests that reach it
run, the fastest first, until one is red. Golden hashes do not count: they say that something changed, not what is right. Results are kept in
build/mutation/results.json: a run that was interrupted goes on, and --again tries what survived once more."""
import argparse
import concurrent.futures
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import equivalent
from woven_tree import WovenTree, root, sample

folders = "trace power raw depth camera scene pipeline num base simulator".split()
programs = "base num camera scene trace power raw depth backend simulator io".split()
golden = re.compile(r"(^|/)KnownBytes\.")
no_claim = re.compile(r"(^|/)(KnownBytes|SameBytes)\.")
batches = (0.1, 1.0, 1e9)        # seconds of a test alone: fast ones first


def run(program, arguments, seconds, **environment):
    """Ends after so many seconds of the processor's time (a busy machine shall not look like an endless loop), or 20 times that of the clock's."""
    command = ["sh", "-c", f'ulimit -t {int(seconds) + 1}; ulimit -c 0; exec "$@"', "sh", program, *arguments]
    try:
        return subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=20 * seconds, env={**os.environ, **environment},
                              cwd=tempfile.gettempdir())
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(command, -signal.SIGXCPU, "", "")


def first_red(program, tests, number, seconds):
    """The name of the first test that is red with mutant `number`; none: empty."""
    done = run(program, [f"--gtest_filter={':'.join(tests)}", "--gtest_fail_fast"], seconds, TOFRAY_MUTANT=str(number))
    if done.returncode == 0:
        return ""
    failed = re.findall(r"\[  FAILED  \] (\S+?)[, ]", done.stdout + " ")
    begun = re.findall(r"\[ RUN      \] (\S+)", done.stdout)
    if failed:
        return failed[0]
    how = "takes too long" if -done.returncode in (signal.SIGXCPU, signal.SIGKILL) else f"ends with {done.returncode}"
    return f"{begun[-1] if begun else Path(program).name} ({how})"


class Round:
    def __init__(self, tree, folder, jobs, longest):
        self.tree, self.folder, self.jobs, self.longest = tree, Path(folder), jobs, longest
        self.results_file = self.folder / "results.json"
        self.results = json.loads(self.results_file.read_text()) if self.results_file.exists() else {}
        self.lock = threading.Lock()
        self.reached = {}     # number → [(seconds, program, test)]

    def program(self, name):
        return str(self.tree.build / "tests" / f"test_{name}")

    def look(self):
        """Runs each test once, alone: how long it takes, and which mutants it reaches."""
        for name in self.tree.programs:
            tests = self.tests_of(name)
            with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
                for test, (good, seconds, seen) in zip(tests, pool.map(lambda t: self.look_at(name, t), tests)):
                    if not good:
                        print(f"left out, red or longer than {self.longest:g} s without a mutant: {name} {test}")
                        continue
                    for number in seen:
                        self.reached.setdefault(number, []).append((seconds, name, test))

    def tests_of(self, name):
        listed = subprocess.run([self.program(name), "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
        out, suite = [], ""
        for line in listed.splitlines():
            if line.startswith("  "):
                out.append(suite + line.split("#")[0].strip())
            elif line.endswith(".") or "# TypeParam" in line:
                suite = line.split("#")[0].strip()
        return [t for t in out if "SameBytes." not in t and "DISABLED_" not in t]

    def look_at(self, name, test):
        with tempfile.NamedTemporaryFile() as seen:
            begin = time.monotonic()
            done = run(self.program(name), [f"--gtest_filter={test}"], self.longest, TOFRAY_MUTANTS_SEEN=seen.name)
            return done.returncode == 0, time.monotonic() - begin, sorted({int(n) for n in Path(seen.name).read_text().split()})

    def judge(self, number):
        """killed, golden, survived or unreached, and by what."""
        tests = sorted(self.reached.get(number, []))
        if not tests:
            return "unreached", ""
        claims = [t for t in tests if not no_claim.search(t[2])]
        least = 0.0
        for most in batches:
            batch = [t for t in claims if least <= t[0] < most]
            least = most
            by = self.run_tests(number, batch)
            if by:
                return "killed", by
        by = self.run_tests(number, [t for t in tests if golden.search(t[2])])
        return ("golden", by) if by else ("survived", "")

    def run_tests(self, number, tests):
        for name in self.tree.programs:
            mine = [t for t in tests if t[1] == name]
            by = mine and first_red(self.program(name), [t[2] for t in mine], number, 5 + 5 * sum(t[0] for t in mine))
            if by:
                return by
        return ""

    def judge_all(self, again):
        todo = [n for n, m in self.tree.numbered.items()
                if m.place not in self.results or again and self.results[m.place]["fate"] not in ("killed", "refused")]
        print(f"{len(todo)} of {len(self.tree.numbered)} mutants to try", flush=True)
        for m in self.tree.refused:
            self.results[m.place] = {"fate": "refused", "by": "", "line": m.line}
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            for _ in pool.map(self.one, todo):
                pass
        self.save()

    def one(self, number):
        fate, by = self.judge(number)
        m = self.tree.numbered[number]
        with self.lock:
            self.results[m.place] = {"fate": fate, "by": by, "line": m.line}
            self.save()
        print(f"{fate:9} {m.file}:{m.line}  {m.before} -> {m.after}  {by}", flush=True)

    def save(self):
        self.results_file.write_text(json.dumps(self.results, indent=1, ensure_ascii=False))


def table(chosen, results, known):
    """One line per mutant that was not killed, and the counts of each folder."""
    kinds = ("killed", "golden", "survived", "unreached", "equivalent", "refused")
    counts, lines = {}, []
    for m in chosen:
        r = results.get(m.place)
        if r is None:
            continue
        fate = "equivalent" if m.place in known and r["fate"] != "killed" else r["fate"]
        folder = m.file.split("/")[1]
        counts.setdefault(folder, dict.fromkeys(kinds, 0))[fate] += 1
        if fate in ("golden", "survived", "unreached"):
            lines.append(f"{fate:9} {m.file}:{m.line}\n          {m.place.split(' | ', 1)[1]}")
    lines.append("| folder | mutants | killed by a claim | golden hash only | survived | equivalent | killed of what is not equivalent |")
    lines.append("|---|---|---|---|---|---|---|")
    total = dict.fromkeys(kinds, 0)
    for folder, c in [*counts.items(), ("all", total)]:
        if folder != "all":
            for kind in kinds:
                total[kind] += c[kind]
        missed = c["survived"] + c["unreached"]
        share = 100 * c["killed"] / max(1, c["killed"] + c["golden"] + missed)
        lines.append(f"| {folder} | {sum(c.values()) - c['refused']} | {c['killed']} | {c['golden']} | {missed} | {c['equivalent']} | {share:.0f} % |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--folders", default=",".join(folders), help="of src/, with commas")
    parser.add_argument("--count", type=int, default=40, help="mutants of each folder")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--programs", default=",".join(programs), help="of tests/, with commas")
    parser.add_argument("--build", default=str(root / "build" / "mutation"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--nice", type=int, default=19)
    parser.add_argument("--longest", type=float, default=10, help="seconds of a test; longer ones are left out")
    parser.add_argument("--again", action="store_true", help="try once more what was not killed")
    parser.add_argument("--list", action="store_true", help="print the mutants and end")
    parser.add_argument("--table", action="store_true", help="print the results so far and end")
    options = parser.parse_args()
    chosen = sample(options.folders.split(","), options.count, options.seed)
    known = equivalent.known()
    if options.list:
        print("\n".join(f"{m.line}: {m.place}" for m in chosen))
        return
    results_file = Path(options.build) / "results.json"
    if not options.table:
        os.nice(options.nice)
        tree = WovenTree(options.build, chosen, options.programs.split(","), options.jobs)
        tree.prepare()
        this = Round(tree, options.build, options.jobs, options.longest)
        this.look()
        this.judge_all(options.again)
    for place in equivalent.gone(known):
        print(f"no longer in the sources, to be taken out of equivalent.txt: {place}")
    print(table(chosen, json.loads(results_file.read_text()), known))


if __name__ == "__main__":
    sys.exit(main())
