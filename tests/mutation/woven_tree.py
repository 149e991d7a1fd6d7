# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A copy of the project with mutants woven in, and its programs."""
import re
import shutil
import subprocess
from pathlib import Path

from mutants import mutants_of, woven

root = Path(__file__).resolve().parents[2]
here = Path(__file__).resolve().parent
# Boxes and beams are for wide packs alone: what this machine is fastest with.
fastest = "avx512" if re.search(r"^flags.*\bavx512dq\b", Path("/proc/cpuinfo").read_text(), re.MULTILINE) else "avx2"
# Data and limits of input, and packs of instruction sets that not every build has a kernel of.
no_formulas = {"src/base/ranges.h", "src/base/limits.h", "src/base/sun_am15.cpp", "src/num/avx512.h", "src/num/twin.h", "src/num/neon.h"}
# Beyond an array's end: CI sees it by its sanitizers, which are slower than this.
flags = "-O1 -w -Wno-narrowing -D_GLIBCXX_ASSERTIONS -fsanitize=bounds -fsanitize-undefined-trap-on-error"


def git(*arguments):
    return subprocess.run(["git", "-C", str(root), *arguments], check=True, capture_output=True, text=True).stdout


def files_of_project():
    return [f for f in git("ls-files", "-co", "--exclude-standard").splitlines() if (root / f).is_file()]


def sample(folders, count, seed):
    """`count` mutants of each folder, by rank: changes elsewhere leave the choice as it is."""
    out = []
    for folder in folders:
        found = []
        for path in sorted((root / "src" / folder).glob("*.*")):
            file = path.relative_to(root).as_posix()
            if path.suffix in (".h", ".cpp") and file not in no_formulas:
                found += mutants_of(file, path.read_text())
        out += sorted(found, key=lambda m: m.rank(seed))[:count]
    return out


def write(path, text):
    """Only what differs is written: the build takes no more than is new."""
    data = text if isinstance(text, bytes) else text.encode()
    if path.is_file() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


class WovenTree:
    def __init__(self, folder, chosen, programs, jobs):
        self.folder, self.programs, self.jobs = Path(folder).resolve(), programs, jobs
        self.tree, self.build = self.folder / "tree", self.folder / "build"
        self.numbered = dict(enumerate(chosen, 1))
        self.refused = []          # what the compiler did not take

    def prepare(self):
        self.copy()
        self.configure()
        for _ in range(20):
            self.weave()
            output = self.compile()
            if output is None:
                return
            self.refuse(output)
        raise SystemExit("the woven tree does not build: see " + str(self.folder / "build.log"))

    def copy(self):
        files = set(files_of_project())
        for file in files:
            if not file.startswith("src/"):
                write(self.tree / file, (root / file).read_bytes())
                shutil.copymode(root / file, self.tree / file)
        for path in self.tree.rglob("*"):
            if path.is_file() and path.relative_to(self.tree).as_posix() not in files:
                path.unlink()

    def weave(self):
        by_file = {}
        for number, m in self.numbered.items():
            by_file.setdefault(m.file, []).append((number, m))
        for file in files_of_project():
            if not file.startswith("src/"):
                continue
            source = (root / file).read_bytes()
            write(self.tree / file, woven(source.decode(), by_file[file]) if file in by_file else source)

    def configure(self):
        self.build.mkdir(parents=True, exist_ok=True)
        write(self.build / "switch.h", (here / "switch.h").read_bytes())
        switch, before = self.build / "switch.o", None
        if switch.exists():
            before = switch.read_bytes()
        subprocess.run(["g++", "-std=c++20", "-O1", f"-DTOFRAY_MUTANTS={len(self.numbered)}", "-I", here, "-c", here / "switch.cpp", "-o", switch], check=True)
        settings = {"CMAKE_BUILD_TYPE": "Debug", "CMAKE_CXX_FLAGS_DEBUG": flags, "CMAKE_CXX_FLAGS": f"-std=c++20 -include {self.build / 'switch.h'}",
                    "CMAKE_EXE_LINKER_FLAGS": switch, "CMAKE_SHARED_LINKER_FLAGS": switch, "TOFRAY_CUDA": "OFF",
                    "TOFRAY_KERNELS": ";".join(dict.fromkeys(["scalar", "avx2", fastest])), "TOFRAY_KERNEL_OPTIMIZATION": "-O1"}
        if shutil.which("ccache"):
            settings["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
        command = ["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja"] + [f"-D{key}={value}" for key, value in settings.items()]
        # sources must be there for CMake: those without mutants, until weave() puts them in
        for file in files_of_project():
            if file.startswith("src/") and not (self.tree / file).exists():
                write(self.tree / file, (root / file).read_bytes())
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        if switch.read_bytes() != before:
            for program in (self.build / "tests").glob("test_*"):
                if program.is_file() and program.suffix == "":
                    program.unlink()   # linked anew with this switch

    def compile(self):
        """None, or what the compiler says."""
        command = ["ninja", "-C", str(self.build), f"-j{self.jobs}", "-k", "0"] + [f"test_{p}" for p in self.programs]
        done = subprocess.run(command, capture_output=True, text=True)
        (self.folder / "build.log").write_text(done.stdout + done.stderr)
        return None if done.returncode == 0 else done.stdout + done.stderr

    def refuse(self, output):
        """Takes out the mutants on the lines that errors name; where an error is elsewhere, those on all lines that its notes name."""
        place = re.compile(r"(?:tree/src|roots/\w+)/([^:\s]+):(\d+)")
        at = {}
        for number, m in self.numbered.items():
            at.setdefault((m.file, m.line), []).append(number)

        def places(text):
            found = [("src/" + file, int(line)) for file, line in place.findall(text)]
            return [at[p] for p in found if p in at]

        wrong, block, errors = set(), [], []
        for line in output.splitlines():
            if ": error:" in line or "In function" in line or re.match(r"\[\d+/\d+\]", line):
                errors.append(block)
                block = []
            block.append(line)
        errors.append(block)
        for block in errors:
            if not block or ": error:" not in block[0]:
                continue
            named = places(block[0]) or places("\n".join(block))
            for numbers in named:
                wrong.update(numbers)
        if not wrong:
            raise SystemExit("the woven tree does not build: see " + str(self.folder / "build.log"))
        self.refused += [self.numbered.pop(n) for n in sorted(wrong)]
