# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What ./dev shows of a build: each step with the time that is left, and every line of the compiler as it was."""

import argparse
import json
import pathlib
import re
import subprocess
import tempfile
import unittest

arguments = argparse.ArgumentParser()
arguments.add_argument("--source", type=pathlib.Path, required=True)
arguments.add_argument("--compiler")
options, rest = arguments.parse_known_args()

COMPILER = ["/src/a.cpp:3:5: error: \\n in 'x'", "   3 |   int  x = 100%;", "      |   ^~~", "[notes] are no steps", ""]


class Progress(unittest.TestCase):
    def shown(self, lines, targets, built=()):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            objects = [f"src/CMakeFiles/{target}.dir/x.o" for target in targets]
            for target, path in zip(targets, objects):
                if target in built:
                    (folder / path).parent.mkdir(parents=True)
                    (folder / path).touch()
            (folder / "compile_commands.json").write_text(json.dumps(
                [{"directory": name, "command": f"c++ -O3 -o {path} -c x.cpp", "file": "x.cpp"} for path in objects], indent=1))
            done = subprocess.run([options.source / "tools/build_progress.sh", name, "2"], input="".join(line + "\n" for line in lines),
                                  capture_output=True, text=True, check=True)
        return done.stdout.split("\n")[:-1]

    def seconds_left(self, line):
        found = re.search(r"  \(0:0[0-9], about (\d+):(\d\d) left\)$", line)
        return None if found is None else 60 * int(found[1]) + int(found[2])

    def test_passes_on_what_the_compiler_says(self):
        self.assertEqual(self.shown(COMPILER, ["tofray_load"]), COMPILER)

    def test_a_step_of_ninja_is_done_when_it_is_said(self):
        line, = self.shown(["[1/3] Building CXX object src/CMakeFiles/tofray_model.dir/x.o"], ["tofray_kernel_avx2", "tofray_kernel_scalar", "tofray_model"])
        self.assertTrue(line.startswith("[1/3] Building CXX object src/CMakeFiles/tofray_model.dir/x.o"))
        self.assertEqual(self.seconds_left(line), (40 + 26) // 2)

    def test_a_step_of_make_begins_when_it_is_said(self):
        steps = [f"[ 33%] Building CXX object src/CMakeFiles/tofray_{name}.dir/x.o" for name in ("model", "kernel_scalar", "kernel_avx2")]
        left = [self.seconds_left(line) for line in self.shown(steps, ["tofray_kernel_avx2", "tofray_kernel_scalar", "tofray_model"])]
        self.assertEqual(left, [(10 + 26 + 40) // 2, (10 + 26 + 40) // 2, (26 + 40) // 2])   # two at work

    def test_what_is_there_already_takes_no_time(self):
        line, = self.shown(["[1/2] Building CXX object src/CMakeFiles/tofray_model.dir/x.o"], ["tofray_kernel_avx2", "tofray_kernel_avx512", "tofray_model"],
                           built=["tofray_kernel_avx2"])
        self.assertEqual(self.seconds_left(line), 42 // 2)

    def test_short_builds_have_no_estimate(self):
        line, = self.shown(["[1/1] Building CXX object src/CMakeFiles/tofray_model.dir/x.o"], ["tofray_model"])
        self.assertEqual(line, "[1/1] Building CXX object src/CMakeFiles/tofray_model.dir/x.o")


if __name__ == "__main__":
    unittest.main(argv=["progress", *rest])
