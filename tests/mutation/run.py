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

folders = sorted(path.name for path in (root / "src").iterdir() if path.is_dir())
programs = ("base num camera scene depth power trace raw model yaml mesh image pictures gltf files results load energy "
            "backend bytes simulator extremes threads app runs").split()       # those that take long are last
golden = re.compile(r"(^|/)KnownBytes\.")
# SameBytes does as KnownBytes does, and takes long: neither is a claim. Without an environment there is no mutant.
never = re.compile(r"SameBytes\.|DISABLED_|/no_environment$")
batches = (0.1, 1.0, 1e9)        # seconds of a test alone: fast ones first


def limited(program, arguments, seconds):
    """Of the processor's time: a busy machine shall not look like an endless loop."""
    return ["sh", "-c", f'ulimit -t {int(seconds) + 1}; ulimit -c 0; exec "$@"', "sh", program, *arguments]


def run(program, arguments, seconds, **environment):
    command = limited(program, arguments, seconds)
    try:
        return subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=60 * seconds, env={**os.environ, **environment},
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
    def __init__(self, folder, jobs, longest):
        self.folder, self.jobs, self.longest = Path(folder), jobs, longest
        self.results_file = self.folder / "results.json"
        self.results = json.loads(self.results_file.read_text()) if self.results_file.exists() else {}
        self.lock = threading.Lock()

    def program(self, name):
        return str(self.tree.build / "tests" / f"test_{name}")

    def look(self, name):
        """Runs each test of a program once, alone: how much of the processor's time it takes, and which mutants it reaches. Kept until it changes.
        @return number of a mutant → [(seconds, test)]"""
        file = self.folder / "look.json"
        kept = json.loads(file.read_text()) if file.exists() else {}
        state = [Path(self.program(name)).stat().st_mtime, self.longest]
        if name not in kept or kept[name]["state"] != state:
            tests = self.tests_of(name)
            with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
                kept[name] = {"state": state, "tests": dict(zip(tests, pool.map(lambda test: self.look_at(name, test), tests)))}
            file.write_text(json.dumps(kept))
        reached = {}
        for test, (good, seconds, seen) in kept[name]["tests"].items():
            if not good:
                print(f"left out, red or longer than {self.longest:g} s without a mutant: {name} {test}", flush=True)
            for number in seen if good else ():
                if number > 0:
                    reached.setdefault(number, []).append((seconds, test))
                else:
                    self.results[self.tree.numbered[-number].place]["void"] = True
        return reached

    def tests_of(self, name):
        listed = subprocess.run([self.program(name), "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
        out, suite = [], ""
        for line in listed.splitlines():
            if line.startswith("  "):
                out.append(suite + line.split("#")[0].strip())
            elif line.endswith(".") or "# TypeParam" in line:
                suite = line.split("#")[0].strip()
        return [t for t in out if not never.search(t)]

    def look_at(self, name, test):
        with tempfile.NamedTemporaryFile() as seen:
            program = subprocess.Popen(limited(self.program(name), [f"--gtest_filter={test}"], self.longest), cwd=tempfile.gettempdir(),
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, "TOFRAY_MUTANTS_SEEN": seen.name})
            _, status, used = os.wait4(program.pid, 0)
            program.returncode = os.waitstatus_to_exitcode(status)
            return program.returncode == 0, used.ru_utime + used.ru_stime, sorted({int(n) for n in Path(seen.name).read_text().split()})

    def judge_all(self, tree, again):
        """Program by program, so that the fast ones kill most. A fate is open until all programs were tried."""
        self.tree = tree
        tree.prepare()
        for m in self.tree.refused:
            self.results[m.place] = {"fate": "refused", "by": "", "tried": []}
        for number, m in self.tree.numbered.items():
            r = self.results.setdefault(m.place, {"fate": "open", "by": "", "tried": []})
            if r["fate"] != "killed":
                r.update(fate="open", tried=[] if again else r["tried"])     # programs that were not asked yet are
        for name in self.tree.programs:
            reached = self.look(name)
            waiting = [n for n, m in self.tree.numbered.items() if self.results[m.place]["fate"] == "open" and name not in self.results[m.place]["tried"]]
            print(f"{name}: {len(waiting)} of {len(self.tree.numbered)} mutants to try", flush=True)
            with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
                list(pool.map(lambda number: self.judge(number, name, sorted(reached.get(number, []))), waiting))
        for number, m in self.tree.numbered.items():
            r = self.results[m.place]
            if r["fate"] == "open":
                r["fate"] = "golden" if r.get("hash") else "survived" if r.get("reached") else "refused" if r.get("void") else "unreached"
        self.save()

    def judge(self, number, name, tests):
        claims, hashes = [t for t in tests if not golden.search(t[1])], [t for t in tests if golden.search(t[1])]
        by, least = "", 0.0
        for most in batches:
            by = by or self.first_red(number, name, [t for t in claims if least <= t[0] < most])
            least = most
        red_hash = not by and self.first_red(number, name, hashes)
        m = self.tree.numbered[number]
        with self.lock:
            r = self.results[m.place]
            r["tried"].append(name)
            if by:
                r.update(fate="killed", by=by)
                print(f"killed {m.file}:{m.line}  {m.before} -> {m.after}  {by}", flush=True)
            if tests:
                r["reached"] = True
            if red_hash:
                r["hash"] = red_hash
            self.save()

    def first_red(self, number, name, tests):
        return first_red(self.program(name), [t for _, t in tests], number, 5 + 5 * sum(s for s, _ in tests)) if tests else ""

    def save(self):
        self.results_file.write_text(json.dumps(self.results, indent=1, ensure_ascii=False))


def table(chosen, results, known):
    """One line per mutant that was not killed, and the counts of each folder."""
    kinds = ("killed", "golden", "survived", "unreached", "equivalent", "refused")
    counts, lines = {}, []
    for m in chosen:
        r = results.get(m.place)
        if r is None or r["fate"] == "open":
            continue
        fate = "equivalent" if m.place.strip() in known and r["fate"] != "killed" else r["fate"]
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
    parser.add_argument("--seed", default="1", help="one, or several with commas: all of their mutants")
    parser.add_argument("--programs", default=",".join(programs), help="of tests/, with commas")
    parser.add_argument("--build", default=str(root / "build" / "mutation"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--nice", type=int, default=19)
    parser.add_argument("--longest", type=float, default=5, help="seconds of a test; longer ones are left out")
    parser.add_argument("--again", action="store_true", help="try once more what was not killed")
    parser.add_argument("--list", action="store_true", help="print the mutants and end")
    parser.add_argument("--table", action="store_true", help="print the results so far and end")
    options = parser.parse_args()
    chosen = list({m.place: m for seed in options.seed.split(",") for m in sample(options.folders.split(","), options.count, seed)}.values())
    known = equivalent.known()
    if options.list:
        print("\n".join(f"{m.line}: {m.place}" for m in chosen))
        return
    results_file = Path(options.build) / "results.json"
    if not options.table:
        os.nice(options.nice)
        this = Round(options.build, options.jobs, options.longest)
        waiting = [m for m in chosen if m.place.strip() not in known and this.results.get(m.place, {}).get("fate") not in ("killed", "refused")]
        this.judge_all(WovenTree(options.build, waiting, options.programs.split(","), options.jobs), options.again)
    for place in equivalent.gone(known):
        print(f"no longer in the sources, to be taken out of equivalent.txt: {place}")
    print(table(chosen, json.loads(results_file.read_text()), known))


if __name__ == "__main__":
    sys.exit(main())
