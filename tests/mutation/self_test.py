# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""That mutants are what they say: found in code only, woven in without a change as long as they are off, and each changes what is computed."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here))
import equivalent  # noqa: E402
from mutants import mutants_of, woven  # noqa: E402
from tokens import Source  # noqa: E402

compiler = sys.argv.pop() if len(sys.argv) > 1 and not sys.argv[-1].startswith("-") else "c++"

program = r"""
#include <algorithm>
#include <cstdio>
constexpr int size = 2 + 1;                       // a + b: of the compiler
#if defined(__CUDACC__)
inline int gpu(int a) { return a - 1; }
#endif
/* a < b */ const char* text = "a + b";
template <class T>
T planted(T a, T b, const T* table, int i) {
  const T sum = a + b * table[i];
  T kept[2 * size], more[size];                   // sizes: of the compiler
  T out = *kept = *more = 2;
  out += sum;
  if (a < b && i > 0) out = out - (i >= 1 ? std::max(a, b) : a);
  return -out;
}
int main() {
  const double table[size + 1] = {1, 3, 5, 7};
  for (int i = 0; i < 3; ++i) std::printf("%g %g ", planted(2.0, 5.0, table, i), planted(5.0, 5.0, table, i));
}
"""


def outputs(source, numbers):
    """What the program prints with none and with each mutant switched on."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "woven.cpp").write_text(source)
        command = [compiler, "-std=c++20", f"-DTOFRAY_MUTANTS={len(numbers)}", "-I", here, "-include", here / "switch.h", "woven.cpp",
                   here / "switch.cpp", "-o", "program"]
        subprocess.run(command, check=True, cwd=folder)
        return [subprocess.run(["./program"], cwd=folder, capture_output=True, text=True, env={"TOFRAY_MUTANT": str(n)}).stdout for n in (0, *numbers)]


class Mutants(unittest.TestCase):
    def test_stand_in_code_and_nowhere_else(self):
        lines = {m.text for m in mutants_of("f.cpp", program)}
        self.assertIn("const T sum = a + b * table[i];", lines)
        for part in ("constexpr int size", "gpu", "text", "kept[2"):
            self.assertFalse([line for line in lines if part in line], part)

    def test_are_of_every_kind(self):
        changes = {(m.before, m.after) for m in mutants_of("f.cpp", program)}
        self.assertLessEqual({("+", "-"), ("*", "/"), ("<", "<="), (">=", ">"), ("&&", "||"), ("max", "min"), ("-", ""), ("[i]", "[i + 1]"),
                              ("+=", "-="), ("if (c)", "if (!c)"), ("? a : b", "? b : a"), ("2", "2 + 1"), ("out += sum;", "")}, changes)

    def test_change_what_is_computed_when_they_are_on_and_nothing_when_off(self):
        found = [m for m in mutants_of("f.cpp", program) if 11 <= m.line <= 16]
        numbered = list(enumerate(found, 1))
        plain, *changed = outputs(woven(program, numbered), [n for n, _ in numbered])
        self.assertEqual(outputs(program, [1])[0], plain)
        self.assertEqual([m.place for m, text in zip(found, changed) if text == plain], [])

    def test_keep_their_lines(self):
        numbered = list(enumerate(mutants_of("f.cpp", program), 1))
        self.assertEqual(woven(program, numbered).count("\n"), program.count("\n"))

    def test_are_the_same_ones_wherever_their_lines_have_moved(self):
        places = {m.place for m in mutants_of("f.cpp", program)}
        self.assertEqual({m.place for m in mutants_of("f.cpp", "\n\n" + program)}, places)
        self.assertEqual(len(places), len(mutants_of("f.cpp", program)), "each has a place of its own")


class Tokens(unittest.TestCase):
    def test_of_numbers_strings_and_operators(self):
        source = Source("x <<= 0x1p-21f + 1'000 + 2e-3f - R\"(a \" b)\" ->y; // no")
        self.assertEqual([t.text for t in source.tokens],
                         ["x", "<<=", "0x1p-21f", "+", "1'000", "+", "2e-3f", "-", "R\"(a \" b)\"", "->", "y", ";"])


class Equivalent(unittest.TestCase):
    def test_each_has_a_reason(self):
        self.assertEqual([place for place, reason in equivalent.known().items() if not reason], [])


if __name__ == "__main__":
    unittest.main()
