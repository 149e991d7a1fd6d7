# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""benches/run.py with programs that are pretended: each prints what the real one prints, with figures that are known."""

from __future__ import annotations

import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from typing import Any

ROOT = pathlib.Path(__file__).resolve().parents[2]
BENCHES = ROOT / "benches"
sys.path.insert(0, str(BENCHES))

import goals  # noqa: E402
import topics  # noqa: E402

# Each call takes the next of the figures in ./figures, the last one again and again, and is told in the log that all builds share.
TOFRAY = """#!/usr/bin/python3
import json, os, pathlib, sys
here = pathlib.Path(__file__).parents[2]
words = sys.argv[1:]
if words[0] == "doctor":
    print(json.dumps({"tofray": "9.8.7", "compiler": "g++ 1", "cpu": "A processor", "isa": os.environ.get("TOFRAY_ISA") or "avx2", "cores_allowed": 2, "gpus": []}))
    sys.exit()
with open(here.parent / "log", "a") as log:
    log.write(here.name + " " + " ".join(words) + "\\n")
if (here / "broken").exists():
    sys.exit((here / "broken").read_text())
if "cuda" in words and not (here / "gpu").exists():
    print("error: no GPU can be used: no driver\\n  take the backend cpu", file=sys.stderr)
    sys.exit(5)
figures = json.loads((here / "figures").read_text())
(here / "figures").write_text(json.dumps(figures[1:] or figures))
one = {"isa": "avx2", "ms_median": figures[0], "ms_p10": figures[0], "sha256": here.name if (here / "other_bytes").exists() else "abc",
       "set_up_ms": {"from_nothing": 9.0, "another_lens": figures[0], "another_sensor_number": 0.5, "another_scene": 0.1}}
if (here / "no_set_up").exists():
    del one["set_up_ms"]
batches = [{"differing": name, "frames_per_s_device": 1e5, "frames_per_s_host": 9e3} for name in ("index", "seeds", "poses")]
if "--json" in words:
    print(json.dumps({"results": batches if "cuda" in words else [one]}))
else:
    print("scene", "code\\n" + words[1], "avx2", 1, "exact", 1.0, figures[0], figures[0], figures[0], 20.0, "abc")
"""

PRINTED = {
    "bench_anywhere": """101920 triangles, 32576 rays from anywhere, one thread, AVX2, medians of 21
each by itself: 2.43 M/s; packs of 8: 1.49, all the same bits
Embree's rtcIntersect1: 3.23 M/s; ratio 0.75
31000 meet something; 32576 of all meet the same
1610258 triangles, 32576 rays from anywhere, one thread, AVX2, medians of 21
each by itself: 1.04 M/s; packs of 8: 0.64, all the same bits
""",
    "bench_bounces": """scene                 bounces  ways        ms   off by [% of the direct light]  [mm]
corner, floor, box          0     -      1.76
corner, floor, box          7    16     40.00
room                        7    16    218.00                           19.00   44.30
bench-mesh                  3    16    200.00
""",
    "bench_meshes_avx2": """one thread, AVX2; millions of rays per second (medians of 41)
            hierarchy                  camera rays              shadow rays
 triangles  M/s build B each  full  squares  single  Embree  squares  single  Embree
    101920      2.50   57.0  0.81    26.00    2.20   13.00    30.00    2.20   12.00
   1510432      1.90   55.0  0.81     3.90    1.50    3.60     4.20    1.50    4.00
   7242880      1.70   55.0  0.81     1.10    1.10    -        1.10    1.10    -   
""",
    "bench_frames": "4.0 2.0 2.5\n",
}

RECORDED = """| arrays | MB a frame | computed | disk takes | recorded | of the slower | processor, ms a frame | of what it allows |
|---|---|---|---|---|---|---|---|
| all | 9.80 | 383 | 54 | 38 | 70 % | 47.7 | 90 % |
| raw,z_m,flags | 0.97 | 433 | 1014 | 248 | 57 % | 7.2 | 90 % |
"""

VIEWED = """bench-primitives 1.60 ms, its simulator anew for another lens 9.1 ms, load 0.1
| what | measured | of it |
| slider to picture, demo, `camera.lens.f_number` | 53 / 70 ms | sent to done |
| slider to picture, demo, `objects.2.sphere.radius` | 66 / 116 ms | sent to done |
| slider to picture, room, `camera.lens.f_number` | 54 / 76 ms | sent to done |
| first draft of a frame of 7 bounces, corner | 83 / 180 ms | the frame itself 623 / 709 ms |
| first draft of a frame of 7 bounces, room | 66 / 204 ms | the frame itself 994 / 1225 ms |
| frames drawn a second, 224 × 172, pico flexx, two panes | 24.1/s | computed 25.0/s |
| frames drawn a second, 640 × 480, imx556, two panes | 5.6/s | computed 6.0/s |
| idle: a page that stands still | server 0.0 % of a core | browser 0.8 % |
"""


def program(path: pathlib.Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)


def printer(text: str) -> str:
    return f"#!/usr/bin/python3\nprint({text!r}, end='')\n"


class Run(unittest.TestCase):
    def setUp(self) -> None:
        self.work = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.build("u", [2.0])
        self.build("v", [1.0])

    def build(self, name: str, figures: list[float], programs: bool = True) -> pathlib.Path:
        folder = self.work / name
        program(folder / "apps/tofray/tofray", TOFRAY)
        (folder / "figures").write_text(json.dumps(figures))
        for file, text in PRINTED.items() if programs else ():
            program(folder / "benches" / file, printer(text))
        return folder

    def run_benches(self, *words: object, path: str | None = None) -> subprocess.CompletedProcess[str]:
        env = {**os.environ, **({} if path is None else {"PATH": path})}
        env.pop("TOFRAY_ISA", None)
        return subprocess.run([sys.executable, "-B", str(BENCHES / "run.py"), *(str(word) for word in words), "-o", str(self.work / "out")], capture_output=True,
                              text=True, env=env)

    def numbers(self) -> Any:
        return json.loads((self.work / "out/numbers.json").read_text(encoding="utf-8"))

    def table(self) -> str:
        return (self.work / "out/numbers.md").read_text(encoding="utf-8")

    def rows(self, *words: object) -> dict[str, Any]:
        done = self.run_benches(*words)
        self.assertEqual((done.returncode, done.stdout), (0, f"{self.work}/out/numbers.md\n"), done.stderr)
        return {row["what"]: row for topic in self.numbers()["topics"] for row in topic["rows"]}

    def test_builds_take_turns_and_every_other_round_begins_with_new(self) -> None:
        self.rows(self.work / "u", self.work / "v", "--topics", "samples", "--rounds", "3")
        calls = [line.split()[0] for line in (self.work / "log").read_text().splitlines()]
        self.assertEqual(calls, 3 * ["u"] + 3 * ["v"] + 3 * ["v"] + 3 * ["u"] + 3 * ["u"] + 3 * ["v"])

    def test_median_least_and_both_ratios(self) -> None:
        # Three rounds of two scenes each.
        (self.work / "u/figures").write_text(json.dumps([4.0, 50, 10.0, 50, 5.0, 50]))
        (self.work / "v/figures").write_text(json.dumps([3.0, 50, 2.0, 50, 9.0, 60]))
        row = self.rows(self.work / "u", self.work / "v", "--topics", "set-up", "--rounds", "3")["bench-primitives, another lens"]
        self.assertEqual((row["old"]["rounds"], row["old"]["median"], row["old"]["best"]), ([4, 10, 5], 5, 4))
        self.assertEqual((row["new"]["rounds"], row["new"]["median"], row["new"]["best"]), ([3, 2, 9], 3, 2))
        self.assertEqual(row["ratio"], {"median": 0.6, "best": 0.5})
        self.assertEqual((row["goal"], row["met"]), ("≤ 1.02 of old", True))
        self.assertIn("| bench-primitives, another lens | ms | 5 (4) | 3 (2) | 0.600, 0.500 | ≤ 1.02 of old | met | 1 |", self.table())

    def test_of_rates_the_greatest_is_best(self) -> None:
        program(self.work / "v/benches/bench_anywhere", "#!/usr/bin/python3\nimport pathlib\nfile = pathlib.Path(__file__).parent / 'calls'\n"
                "n = len(file.read_text()) if file.exists() else 0\nfile.write_text('x' * (n + 1))\n"
                "print(f'101920 triangles, 8 rays\\neach by itself: {n + 1}.00 M/s; packs')\n")
        row = self.rows(self.work / "v", "--topics", "anywhere", "--rounds", "3")["101,920 triangles, each ray alone"]
        self.assertEqual((row["new"]["median"], row["new"]["best"]), (2, 3))

    def test_slower_than_old_by_more_than_two_percent_is_missed(self) -> None:
        (self.work / "v/figures").write_text("[2.05]")
        rows = self.rows(self.work / "u", self.work / "v", "--topics", "primitives", "--rounds", "1")
        self.assertIs(rows["flying-ball"]["met"], False)
        self.assertIn("| **missed** |", self.table())

    def test_goals_are_those_of_the_instruction_set(self) -> None:
        corner = "corner, floor, box, 7 bounces, 16 ways"
        for isa, goal, met in (("avx2", "≤ 45", True), ("avx512", "≤ 25", False), ("scalar", "", None)):
            row = self.rows(self.work / "v", "--topics", "bounces", "--rounds", "1", "--isa", isa)[corner]
            self.assertEqual((row["goal"], row["met"]), (goal, met))
            self.assertEqual(row["new"]["command"], f"TOFRAY_ISA={isa} BUILD/benches/bench_bounces 16 times")

    def test_a_missing_program_is_said_in_the_table_and_the_rest_is_measured(self) -> None:
        self.build("w", [1.0], programs=False)
        done = self.run_benches(self.work / "w", "--topics", "anywhere,samples", "--rounds", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Left out of new: benches/bench_anywhere is not built (cmake -DTOFRAY_BENCHES=ON, target bench_anywhere).", self.table())
        self.assertIn("| 101,920 triangles, to Embree |  | – |  | ≥ 1 | not measured |  |", self.table())
        self.assertIn("| 3 × 3 samples within pixels, to one | × | 1 (1) |  | ≤ 4 | met | 2 |", self.table())

    def test_what_the_old_build_lacks_the_new_one_still_has(self) -> None:
        self.build("w", [1.0], programs=False)
        row = self.rows(self.work / "w", self.work / "v", "--topics", "anywhere", "--rounds", "2")["101,920 triangles, to Embree"]
        self.assertEqual((row["new"]["rounds"], "old" in row, row["ratio"], row["met"]), ([0.75, 0.75], False, None, False))
        self.assertIn("Left out of old: benches/bench_anywhere", self.table())

    def test_no_gpu_and_no_node_are_said(self) -> None:
        (self.work / "v/viewer").mkdir()
        done = self.run_benches(self.work / "v", "--topics", "gpu,viewer", path=str(self.work))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Left out of new: no GPU can be used: no driver.", self.table())
        self.assertIn("Left out of new: node is missing.", self.table())

    def test_a_reason_of_both_is_said_once(self) -> None:
        self.rows(self.work / "u", self.work / "v", "--topics", "gpu")
        self.assertIn("Left out of old and new: no GPU can be used: no driver.", self.table())

    def test_a_skipped_test_gives_its_reason(self) -> None:
        (self.work / "v/viewer").mkdir()
        program(self.work / "bin/node", "#!/bin/sh\necho '# SKIPPED: there is no chromium here'\nexit 77\n")
        self.run_benches(self.work / "v", "--topics", "viewer", path=f"{self.work / 'bin'}:/usr/bin:/bin")
        self.assertIn("Left out of new: there is no chromium here.", self.table())

    def test_a_program_that_ends_badly_or_prints_something_else_is_a_fault(self) -> None:
        (self.work / "v/broken").write_text("error: out of memory")
        program(self.work / "v/benches/bench_bounces", printer("hello\n"))
        done = self.run_benches(self.work / "v", "--topics", "samples,bounces")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(self.table(), r"Left out of new: `BUILD/apps/tofray/tofray bench flying-ball --frames 30 --set .* --json` ended with 1: error: out of memory\.")
        self.assertIn("Left out of new: `BUILD/benches/bench_bounces 16 times` printed no figure that is known: hello.", self.table())

    def test_results_that_lack_something_leave_the_other_build_its_figures(self) -> None:
        (self.work / "u/no_set_up").touch()
        done = self.run_benches(self.work / "u", self.work / "v", "--topics", "set-up", "--rounds", "2")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("Left out of old: its results lack what is read of them (KeyError: 'set_up_ms').", self.table())
        self.assertIn("| bench-primitives, another lens | ms | – | 1 (1) |", self.table())

    def test_frames_of_other_bytes_are_named(self) -> None:
        words = (self.work / "u", self.work / "v", "--topics", "primitives", "--rounds", "1")
        self.rows(*words)
        self.assertNotIn("other bytes", self.table())
        (self.work / "v/other_bytes").touch()
        self.rows(*words)
        self.assertIn("**Frames have other bytes**: bench-primitives; bench-primitives, one thread; ", self.table())

    def test_conditions_stand_at_the_top(self) -> None:
        self.rows(self.work / "u", self.work / "v", "--topics", "samples", "--rounds", "1", "--old-commit", "abc1234")
        out = self.numbers()
        self.assertEqual((out["machine"]["cpu"], out["machine"]["isa"], out["machine"]["cores"]), ("A processor", "avx2", 2))
        self.assertEqual([one["commit"] for one in out["builds"].values()], ["abc1234", "unknown commit"])
        for what in ("load_at_begin", "load_at_end", "kernel"):
            self.assertIn(what, out["machine"])
        self.assertIn(f"- old: abc1234 (9.8.7, g++ 1), {self.work}/u", self.table())

    def test_wrong_words_are_refused(self) -> None:
        u = self.work / "u"
        wrong: list[tuple[list[object], str]] = [
            ([u, "--topics", "bouncs"], "there is no topic 'bouncs'; there are primitives, set-up,"),
            ([u, "--rounds", "0"], "'0' is no number of rounds"),
            ([self.work], f"{self.work} is no build of tofray: it has no program apps/tofray/tofray"),
            ([u, u, u], "3 builds are too many"),
            ([u, "--isa", "sse"], "invalid choice: 'sse'"),
            ([], "required: BUILD"),
        ]
        for words, said in wrong:
            done = self.run_benches(*words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)
        (self.work / "out").write_text("a file")
        done = self.run_benches(u)
        self.assertEqual((done.returncode, "out cannot be made: File exists" in done.stderr), (2, True), done.stderr)

    def test_every_goal_has_a_row_that_some_topic_measures(self) -> None:
        """What is called by a script of benches/ is called by the topic: here with the script's output."""
        (self.work / "v/gpu").touch()
        (self.work / "v/viewer").mkdir()
        scripts = {"benches/recording.py": RECORDED, "node": VIEWED}

        class Pretended(topics.Build):
            def run(self, *command: object, env: Any = {}) -> tuple[str, str]:
                return (scripts[str(command[0])], "a command") if str(command[0]) in scripts else super().run(*command, env=env)

        build = Pretended("new", self.work / "v", self.work)
        # Of this printout Embree's share of 7 million triangles and of 1.6 million from anywhere is missing on purpose.
        lacking = {"7,242,880 triangles, camera rays to Embree", "1,610,258 triangles, to Embree"}
        self.assertEqual(set(goals.GOALS), set(topics.TOPICS))
        for name, topic in topics.TOPICS.items():
            measured = {figure.row for figure in topic.measure(build)}
            self.assertEqual(set(goals.GOALS[name]) - measured, lacking & set(goals.GOALS[name]), name)

    @unittest.skipIf(importlib.util.find_spec("mypy") is None, "there is no mypy here")
    def test_types(self) -> None:
        done = subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", os.devnull, "--config-file", str(ROOT / "tests/python/mypy.ini"),
                               *(str(BENCHES / f"{name}.py") for name in ("run", "topics", "goals", "recording")), str(pathlib.Path(__file__))],
                              capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(BENCHES)})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
