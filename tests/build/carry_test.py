# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Libraries that go along with a program (packaging/carry.py): it runs where the machine's are gone or are others, from wherever it lies."""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

arguments = argparse.ArgumentParser()
arguments.add_argument("--source", type=pathlib.Path, required=True)
arguments.add_argument("--compiler", required=True)
options, rest = arguments.parse_known_args()
sys.path.insert(0, str(options.source / "packaging"))
import carry  # noqa: E402

INNER = "extern \"C\" int inner(); int inner() { return 40; }"
OUTER = "extern \"C\" int inner(); extern \"C\" int outer(); int outer() { return inner() + 2; }"
PROGRAM = "extern \"C\" int outer(); int main() { return outer(); }"


@unittest.skipIf(shutil.which("patchelf") is None or shutil.which("objdump") is None, "needs patchelf and objdump")
class Carry(unittest.TestCase):
    """A program that needs a library of ours, which needs one of the machine's."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()
        for name in ("machine", "top/bin", "top/lib"):
            (self.folder / name).mkdir(parents=True)
        self.machine, self.lib = self.folder / "machine", self.folder / "top/lib"
        self.compile("machine/libinner.so.1", INNER, "-shared", "-Wl,-soname,libinner.so.1")
        self.compile("top/lib/libouter.so.0", OUTER, "-shared", "-Wl,-soname,libouter.so.0", "-l:libinner.so.1", f"-Wl,-rpath,{self.machine}")
        self.compile("top/bin/program", PROGRAM, "-l:libouter.so.0", f"-Wl,-rpath,{self.lib}", f"-Wl,-rpath-link,{self.machine}")
        self.program, self.outer = self.folder / "top/bin/program", self.lib / "libouter.so.0"

    def compile(self, name, text, *words):
        source = self.folder / "source.cpp"
        source.write_text(text)
        subprocess.run([options.compiler, "-fPIC", source, "-o", self.folder / name, f"-L{self.machine}", f"-L{self.folder / 'top/lib'}", *words], check=True)

    def result_elsewhere(self, program="top/bin/program"):
        """Of the program, where the folder has been moved and the machine's library is gone."""
        shutil.rmtree(self.machine)
        (self.folder / "top").rename(self.folder / "elsewhere")
        return subprocess.run([self.folder / program.replace("top", "elsewhere")], check=False, stderr=subprocess.DEVNULL).returncode

    def test_without_them_the_program_does_not_run(self):
        self.assertEqual(self.result_elsewhere(), 127)

    def test_what_it_needs_lies_in_a_folder_of_its_own_and_it_runs_anywhere(self):
        foreign = carry.carry([self.program, self.outer], self.lib / "private", self.lib)
        self.assertEqual([path.name for path in foreign], ["libinner.so.1"])
        self.assertRegex(" ".join(path.name for path in (self.lib / "private").iterdir()), r"^libinner-[0-9a-f]{8}\.so\.1$")
        self.assertEqual(self.result_elsewhere(), 42)

    def test_with_our_own_library_carried_too_one_folder_has_all(self):
        carry.carry([self.program], self.folder / "top/all", self.lib, rename_own=True)
        self.assertEqual(len(list((self.folder / "top/all").iterdir())), 2)
        shutil.rmtree(self.lib)
        self.assertEqual(self.result_elsewhere(), 42)

    def test_another_library_of_that_name_is_not_taken(self):
        carry.carry([self.program, self.outer], self.lib / "private", self.lib)
        other = self.folder / "other"
        other.mkdir()
        self.compile("other/libinner.so.1", INNER.replace("40", "1"), "-shared", "-Wl,-soname,libinner.so.1")
        done = subprocess.run([self.program], check=False, env={"LD_LIBRARY_PATH": str(other)})
        self.assertEqual(done.returncode, 42)

    def test_what_is_not_here_is_an_error_and_named(self):
        (self.machine / "libinner.so.1").unlink()
        with self.assertRaisesRegex(SystemExit, "libinner.so.1"):
            carry.carry([self.program, self.outer], self.lib / "private", self.lib)

    def test_the_c_and_the_cpp_library_stay_the_machines(self):
        self.compile("top/bin/words", "#include <iostream>\n#include <cmath>\nint main(int n, char**) { std::cout << std::sin(n); }")
        self.assertEqual(carry.needed_libraries([self.folder / "top/bin/words"], self.lib), [])

    def test_the_oldest_glibc_is_that_of_the_newest_symbol(self):
        # pthread_clockjoin_np is of glibc 2.31; every program needs 2.34's __libc_start_main where it is linked by a newer one
        self.compile("machine/libnew.so", '#include <pthread.h>\nextern "C" int f(pthread_t t) { return pthread_clockjoin_np(t, nullptr, 0, nullptr); }', "-shared")
        self.compile("machine/libold.so", '#include <cstdlib>\nextern "C" int f(const char* t) { return abs(*t); }', "-shared")
        self.assertGreaterEqual(carry.oldest_glibc([self.machine / "libnew.so"]), 31)
        self.assertLess(carry.oldest_glibc([self.machine / "libold.so"]), 31)

    def test_a_cpp_library_is_no_older_than_the_one_its_symbols_are_of(self):
        real = carry.run
        self.addCleanup(setattr, carry, "run", real)
        carry.run = lambda *words: "Name: GLIBC_2.14  Name: GLIBCXX_3.4.30"
        self.assertEqual(carry.oldest_glibc([self.program]), 35)
        carry.run = lambda *words: "Name: GLIBC_2.38  Name: GLIBCXX_3.4.29"
        self.assertEqual(carry.oldest_glibc([self.program]), 38)
        carry.run = lambda *words: "Name: GLIBCXX_3.4.99"
        with self.assertRaisesRegex(SystemExit, "GLIBCXX_3.4.99"):
            carry.oldest_glibc([self.program])


if __name__ == "__main__":
    unittest.main(argv=["carry", *rest])
