# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A fresh folder that looks like a checkout to its user, with tofray installed for him alone."""

import os
import pathlib
import subprocess
import sys
import tempfile
import threading

import exceptions

CHECKOUT = (
    ".ci CHANGELOG.md CMakeLists.txt CMakePresets.json CONTRIBUTING.md LICENSE README.md apps benches cmake data docs examples include profiles "
    "pyproject.toml python scenes src tests viewer"
).split()
LONGEST_S = 300

# Reads pieces of a program, each after its length, and runs them one after the other, like cells of a notebook.
SESSION = """
import sys, traceback
names = {"__name__": "__main__"}
for size in iter(sys.stdin.readline, ""):
    text, fault = sys.stdin.read(int(size)), 0
    try:
        exec(compile(text, "the document", "exec"), names)
    except BaseException:
        traceback.print_exc()
        fault = 1
    sys.stderr.flush()
    print(f"\\n--- done: {fault}", flush=True)
"""


class Workplace:
    def __init__(self, source, build, compiler, installed=None):
        """`installed`: where tofray has been installed already; otherwise it is, here."""
        self.source, self.build, self.compiler, self.installed = source, build, compiler, installed
        self.folder, self.session = None, None

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="tofray-docs-")
        self.path = pathlib.Path(self.folder.name)
        for name in CHECKOUT:
            if (self.source / name).exists():
                (self.path / name).symlink_to(self.source / name)
        (self.path / "build").mkdir()
        (self.path / "build/release").symlink_to(self.build)
        dev = self.path / "dev"
        dev.write_text(exceptions.DEV.format(source=self.source))
        dev.chmod(0o755)
        prefix = self.path / "home/.local"
        keep = {name: value for name, value in os.environ.items() if not name.startswith(("TOFRAY_", "CMAKE_", "XDG_", "ZDOTDIR"))}
        self.environment = keep | {"HOME": str(prefix.parent), "PATH": f"{prefix}/bin:{keep['PATH']}", "CXX": self.compiler}
        self.environment |= {"LC_ALL": "C.UTF-8", "CMAKE_PREFIX_PATH": str(prefix)}
        if self.installed:
            prefix.parent.mkdir()
            prefix.symlink_to(self.installed)
        else:
            self.must(["cmake", "--install", str(self.build), "--prefix", str(prefix)])
        return self

    def __exit__(self, *_):
        if self.session:
            self.session.kill()
            self.session.communicate()
        self.folder.cleanup()

    def python(self, text):
        """What this piece wrote, run by the Python that ran all pieces before it."""
        if not self.session:
            self.session = subprocess.Popen(
                [sys.executable, "-W", "error", "-u", "-c", SESSION], cwd=self.path, env=self.environment, text=True, encoding="utf-8",
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace",
            )
        too_long = threading.Timer(LONGEST_S, self.session.kill)
        too_long.start()
        out = []
        try:
            self.session.stdin.write(f"{len(text)}\n{text}")
            self.session.stdin.flush()
            for line in self.session.stdout:
                if line == "--- done: 0\n":
                    return "".join(out)
                if line.startswith("--- done: "):
                    raise ValueError("".join(out).rstrip())
                out.append(line)
        finally:
            too_long.cancel()
        raise ValueError("".join(out) + f"Python has ended, or was not done after {LONGEST_S} s")

    def run(self, command, text=""):
        """(exit code, what it wrote)."""
        try:
            done = subprocess.run(
                command, cwd=self.path, env=self.environment, input=text, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                timeout=LONGEST_S, check=False, errors="replace",
            )
        except subprocess.TimeoutExpired:
            return 124, f"not done after {LONGEST_S} s"
        return done.returncode, done.stdout

    def must(self, command, text=""):
        code, out = self.run(command, text)
        if code != 0:
            raise ValueError(f"exit code {code}\n{out.rstrip()}")
        return out
