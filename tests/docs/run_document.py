#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Runs what a document tells its reader to type, word for word and in its order, in one fresh folder. run_document.py --help

Blocks: sh and zsh and fish run in that shell (where it is installed) and have to succeed; python is run by the one
Python that ran the document's python before it; cpp and CMake's calls make one project, built and run at the end; yaml goes into the
file that its first line's comment names, or into the one that <!-- test: into FILE --> before it names, and tofray check has to like that
file once the next command runs; text is for people. <!-- test: prints TEXT --> before a shell or python block: what a sentence beside it says of its output.
<!-- test: by SCRIPT WORD --> before a block: that script of tools/ runs it, since it takes another machine. Code within
lines: what begins with a command's name is run; `key: value` has to be good YAML of a scene or a camera profile somewhere; options have
to exist; all other names have to occur in the source. exceptions.py lists what is not run so, and why.
"""

import argparse
import functools
import importlib.util
import pathlib
import re
import shutil
import sys

import exceptions
from markdown import Fault, put_into, snippets
from workplace import Workplace

COMMAND = re.compile(r"(tofray|\./dev|cmake|sudo|source|cp) ")

# Where a `key: value` of a line may belong.
SCENES = [
    "objects: []\n{}\n",
    "objects: []\nambient: {{{}}}\n",
    "objects: []\nambient: {{level: 5 %, {}}}\n",
    "objects: []\ncamera: {{pose: {{{}}}}}\n",
    "objects: []\ncamera: {{keyframes: {{file: poses.csv, {}}}}}\n",
    "objects: [mesh: {{file: a-chair.obj, reflectivity: 0.5, {}}}]\n",
    "objects: [box: {{min: [-1, -1, 2], max: [1, 1, 3], reflectivity: 0.5, {}}}]\n",
]
# Where a form, or a key of a data set, may belong.
FORM = re.compile(r"\{(uniform|log_uniform|normal|integer|even|choice|grid|chance|cap|files|table): ")
SETS = [
    "name: a\nsamples: 2\n{}\nscene: {{objects: []}}\n",
    "name: a\nsamples: 2\nscene: {{objects: [box: {{min: [-1, -1, 2], max: [1, 1, 3], reflectivity: 0.5, {}}}]}}\n",
    "name: a\nsamples: 2\nscene: {{objects: []}}\nset: {{{}}}\n",
]
FORMS = ["let: {{a: {}}}", "set: {{transport.smooth: {}}}", "set: {{objects.0.box.position: {}}}", "set: {{ambient.illuminance: 1 klx, ambient.direction: {}}}"]
PROFILE_KEYS = ["{}={}", "illumination.0.{}={}", "lens.{}={}"]


@functools.cache
def words_of(source):
    """Every name that the source knows."""
    found = set()
    for top in "include src apps python cmake packaging scenes profiles tools examples tests viewer CMakeLists.txt CMakePresets.json .ci dev".split():
        for path in [source / top] if (source / top).is_file() else (source / top).rglob("*"):
            if path.is_file() and path.parent != source / "tests/docs":
                found |= set(re.findall(r"[A-Za-z_]\w*", str(path.relative_to(source)) + path.read_text(errors="replace")))
    return found


@functools.cache
def options_of(place):
    """Every option of every command."""
    commands = re.findall(r"^  ([a-z]+) ", place.must(["tofray", "--help"]).split("Commands:\n")[1].split("\n\n")[0], re.M)
    texts = [place.must(["tofray", command, "--help"]) for command in commands]
    texts.append(place.run(["/usr/bin/python3", "-m", "tofray", "fit", "--help"])[1])  # of the Python package alone, where it is there
    return set(re.findall(r"(?<!\S)--?[a-z][a-z-]*", "".join(texts)))


class Document:
    def __init__(self, path, place):
        self.name, self.text, self.place = path.name, path.read_text(encoding="utf-8"), place
        self.cpp, self.cmake, self.changed = "", "", set()

    def faults(self):
        """(line, what) of everything that does not do what it says."""
        try:
            steps = [(one.line, lambda one=one: self.take(one)) for one in snippets(self.text)]
        except Fault as fault:
            return [(fault.line, str(fault))]
        found = []
        for line, step in [*steps, (1, self.check_files), (1, self.build_program)]:
            try:
                step()
            except (ValueError, OSError) as fault:
                found.append((line, str(fault)))
        return found

    def take(self, one):
        if one.elsewhere:
            self.runs_elsewhere(*one.elsewhere.split())
        elif one.kind == "inline":
            self.inline(one.text)
        elif one.kind in ("sh", "zsh", "fish"):
            self.check_files()
            self.holds(one.prints, self.shell(one.kind, one.text))
        elif one.kind == "python":
            self.holds(one.prints, self.place.python(one.text))
        elif one.kind == "yaml":
            self.yaml(one)
        elif one.kind == "cpp":
            self.cpp += one.text
        elif one.kind != "text":
            raise ValueError(f"the test does not know what to do with a block of {one.kind}")

    def runs_elsewhere(self, script, word):
        """Whether that script asks for this document's blocks of that word."""
        if f"blocks {self.name} {word}\n" not in (self.place.source / "tools" / script).read_text(encoding="utf-8"):
            raise ValueError(f"tools/{script} does not run the blocks {word} of {self.name}")

    @staticmethod
    def holds(wanted, out):
        if wanted not in out:
            raise ValueError(f"expected it to print {wanted!r}, got\n{out.rstrip()}")

    def shell(self, shell, text):
        """What it wrote."""
        if shutil.which("bash" if shell == "sh" else shell) is None:
            print(f"{self.name}: no {shell} here, not run: {text.strip()}")
            return ""
        if shell == "zsh":
            text = "autoload -Uz compinit && compinit -u\n" + text  # as a user's ~/.zshrc does
        start = {"sh": ["bash", "-euo", "pipefail"], "zsh": ["zsh", "-f", "-e"], "fish": ["fish", "-N"]}[shell]
        code, out = self.place.run([*start, "-c", self.runnable(text)])
        no_gpu = "--backend cuda" in text and code == 5 and "no GPU can be used" in out
        lacks = re.search(r"^error: .* needs the package (\w+) \(Debian: ", out, re.M)
        if code != 0 and lacks:
            print(f"{self.name}: no {lacks[1]} here, not run to its end: {text.strip()}")
        elif code != 0 and not no_gpu:
            raise ValueError(f"exit code {code}: {text.strip()}\n{out.rstrip()}")
        return out

    def runnable(self, text):
        for written, (instead, _) in exceptions.REPLACED.items():
            if written in text:
                text = text.replace(written, instead)
        lines = []
        for line in text.split("\n"):
            if line.startswith("tofray bench") and "--frames" not in line:
                line = line.replace("tofray bench", f"tofray bench {exceptions.FEW_FRAMES}", 1)
            if re.match(r"tofray (view|stream)( |$)", line):
                line = re.sub(r"\s+# .*", "", line)   # what comes around it would be a part of the comment
            if line == "tofray stream":   # a sentence names the command
                line += " --help"
            if re.match(r"tofray view( |$)", line):
                ends = "--export" in line
                line = exceptions.VIEW_EXPORT.format(line) if ends else exceptions.VIEW.format(line if "--port" in line else line + " --port 0")
            if re.match(r"tofray stream( |$)", line):
                ends = re.search(r"--(frames|duration|help)\b", line)
                line = (exceptions.STREAM_BOUNDED if ends else exceptions.STREAM).format(line)
            lines.append(line)
        return "\n".join(lines)

    def yaml(self, one):
        if one.target:
            path = self.place.path / one.target
            path.write_text(put_into(path.read_text(), one.text))
        elif named := re.match(r"# (\S+\.yaml)\b", one.text):
            path = self.place.path / named[1]
            path.write_text(one.text)
        else:
            raise ValueError("a yaml block that does not say which file it is, or changes")
        self.changed.add(path.name)

    def check_files(self):
        for name in sorted(self.changed):
            is_set = re.search("^samples:", (self.place.path / name).read_text(), re.M)
            self.place.must(["tofray", "dataset", "check", name] if is_set else ["tofray", "check", name])
        self.changed.clear()

    def inline(self, code):
        shell = next((name for name in ("zsh", "fish") if f"completion {name}" in code and "source" in code), "sh")
        if COMMAND.match(code) or code in exceptions.REPLACED:
            self.check_files()
            self.shell(shell, code)
        elif re.fullmatch(r"(find_package|target_link_libraries)\(.*\)", code):
            self.cmake += code + "\n"
        elif FORM.match(code):
            self.form(code)
        elif re.match(r"[a-z_]+(\.[a-z_]+)*: \S", code):
            self.yaml_of_a_line(code)
        else:
            self.names(code)

    def form(self, code):
        (self.place.path / "lamps.csv").write_text("power\n1 W\n2 W\n")
        (self.place.path / "parts").mkdir(exist_ok=True)
        shutil.copy(self.place.path / "examples/chair/chair.obj", self.place.path / "parts/chair.obj")
        box = "scene: {objects: [box: {min: [-1, -1, 2], max: [1, 1, 3], reflectivity: 0.5}]}\n"
        said = []
        for place in FORMS:
            (self.place.path / "a-set.yaml").write_text("name: a\nsamples: 2\n" + box + place.format(code) + "\n")
            status, out = self.place.run(["tofray", "dataset", "check", "a-set.yaml"])
            if status == 0:
                return
            said.append(out)
        raise ValueError(f"no set may say {code}\n" + "".join(said))

    def yaml_of_a_line(self, code):
        shutil.copy(self.place.path / "examples/chair/chair.obj", self.place.path / "a-chair.obj")
        key, value = code.split(": ", 1)
        known = []  # what is said against it in places that know the key
        for scene in SCENES:
            (self.place.path / "a-line.yaml").write_text(scene.format(code))
            if self.is_good(["tofray", "check", "a-line.yaml"], key, known):
                return
        for text in SETS:
            (self.place.path / "a-set.yaml").write_text(text.format(code))
            if self.is_good(["tofray", "dataset", "check", "a-set.yaml"], key, known):
                return
        for setting in PROFILE_KEYS:
            if self.is_good(["tofray", "check", "pico-flexx", "--set", setting.format(key, value)], key, known):
                return
        raise ValueError(f"no file may say {code}\n" + "".join(known).rstrip())

    def is_good(self, command, key, known):
        code, out = self.place.run(command)
        if code != 0 and f'unknown key "{key}"' not in out:
            known.append(out)
        return code == 0

    def names(self, code):
        if setting := re.fullmatch(r"--set (\S+=\S+)", code):
            self.place.must(["tofray", "check", "room", "--set", setting[1]])
        for option in re.findall(r"(?<!\S)--?[a-zA-Z][a-z-]*", code if code.startswith("--") else ""):
            if option not in options_of(self.place):
                raise ValueError(f"no command has the option {option}")
        for word in [] if code in exceptions.UNKNOWN_NAMES else re.findall(r"(?<![\w.])[A-Za-z_]\w+", code):
            if word not in words_of(self.place.source):
                raise ValueError(f"nothing in the source is called {word}")

    def build_program(self):
        """One project of the document's CMake calls and its C++."""
        if not self.cpp and not self.cmake:
            return
        outside, inside, why_not_run = exceptions.CPP.get(self.name, ("", "", ""))
        includes = "".join(re.findall(r"^#include .*\n", self.cpp, re.M)) or "#include <tofray/tofray.h>\n"
        body = re.sub(*exceptions.CUDA_LAUNCH, re.sub(r"^#include .*\n", "", self.cpp, flags=re.M))
        project = self.place.path / "program"
        project.mkdir()
        (project / "main.cpp").write_text(f"{includes}\n#include <cstdint>\n{outside}\nint main() {{\n{inside}{body}}}\n")
        find = "".join(re.findall(r"find_package.*\n", self.cmake)) or "find_package(tofray)\n"
        link = "".join(re.findall(r"target_link.*\n", self.cmake)) or "target_link_libraries(mine PRIVATE tofray::files)\n"
        begin = "cmake_minimum_required(VERSION 3.22)\nproject(mine LANGUAGES CXX)\n"
        (project / "CMakeLists.txt").write_text(f"{begin}{find}add_executable(mine main.cpp)\n{link}")
        self.place.must(["cmake", "-S", "program", "-B", "program/build"])
        self.place.must(["cmake", "--build", "program/build"])
        if not why_not_run:
            self.place.must(["program/build/mine"])


def arguments(what):
    parser = argparse.ArgumentParser(description=what, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, help_text in (("--source", "the checkout"), ("--build", "where it is built"), ("--compiler", "that it was built with")):
        parser.add_argument(name, required=True, help=help_text)
    return parser


def main():
    parser = arguments(__doc__)
    parser.add_argument("document", nargs="+", help="Markdown, within the checkout")
    options = parser.parse_args()
    if importlib.util.find_spec("numpy") is None:
        print("needs numpy (python3-numpy)")
        sys.exit(77)
    source, build = pathlib.Path(options.source).resolve(), pathlib.Path(options.build).resolve()
    found = 0
    for name in options.document:
        with Workplace(source, build, options.compiler) as place:
            for line, what in Document(source / name, place).faults():
                print(f"{name}:{line}: error: {what}")
                found += 1
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
