#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Asks the shells themselves what the tab key makes of a line, where they are installed. completion_test.py TOFRAY"""

import os
import pathlib
import pty
import shutil
import subprocess
import sys
import tempfile

# What is typed, and what the shell has to make of it or offer.
CASES = [
    ("tofray ren", "render"),
    ("tofray --vers", "--version"),
    ("tofray render bench-pr", "bench-primitives"),
    ("tofray render --fro", "--from"),
    ("tofray render --noise e", "exact"),
    ("tofray render ./a-sc", "./a-scene.yaml"),
    ("tofray render a-scene.yaml -o a-fol", "a-folder"),
    ("tofray list cam", "cameras"),
    ("tofray completion fi", "fish"),
    ("tofray inspect --pix", "--pixel"),
    ("tofray render --set camera.lens.f_", "camera.lens.f_number="),
    ("tofray render --theme=l", "--theme=light"),
    ("tofray render --arrays raw,z_", "raw,z_m"),
]

# Completes the line that stands in the file `typed` and writes what became of it.
ZSH = """
PS1=
{before}
autoload -Uz compinit && compinit -u
{after}
ask() {{
  BUFFER=$(<typed) CURSOR=$#BUFFER
  zle complete-word
  print -rn -- "$BUFFER" > became
  exit
}}
zle -N ask
bindkey '^X' ask
print ready > ready
"""


def of_bash(line, load):
    words = line.split(" ")
    quoted = " ".join(f"'{word}'" for word in words)
    script = f"{load}; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _tofray; echo \"${{COMPREPLY[*]}}\""
    return subprocess.run(["bash", "-c", script], check=True, capture_output=True, text=True).stdout


def of_fish(line, load):
    return subprocess.run(["fish", "-N", "-c", f"{load}; complete -C '{line}'"], check=True, capture_output=True, text=True).stdout


def of_zsh(line, load):
    before, after = ("", load) if load.startswith("source") else (load, "")
    for name, text in (("typed", line), (".zshrc", ZSH.format(before=before, after=after)), ("became", ""), ("ready", "")):
        pathlib.Path(name).write_text(text)
    child, terminal = pty.fork()
    if child == 0:
        os.execvpe("zsh", ["zsh", "-i"], os.environ | {"ZDOTDIR": os.getcwd(), "TERM": "dumb"})
    seen = b""
    try:
        sent = False
        while chunk := os.read(terminal, 4096):
            seen += chunk
            if not sent and pathlib.Path("ready").read_text():
                os.write(terminal, b"\x18")
                sent = True
    except OSError:  # how a terminal says that the other side has gone
        pass
    os.waitpid(child, 0)
    return pathlib.Path("became").read_text() or seen.decode(errors="replace")


SHELLS = {
    "bash": (of_bash, ["source <(tofray completion bash)"]),
    "zsh": (of_zsh, ["source <(tofray completion zsh)", "fpath=($PWD/functions $fpath)"]),
    "fish": (of_fish, ["tofray completion fish | source"]),
}


def has_terminals():
    """Whether the machine gives out pseudo-terminals: zsh completes on one."""
    try:
        for side in pty.openpty():
            os.close(side)
    except OSError:
        return False
    return True


def main():
    os.environ["PATH"] = f"{pathlib.Path(sys.argv[1]).resolve().parent}:{os.environ['PATH']}"
    faults = 0
    with tempfile.TemporaryDirectory(prefix="tofray-completion-") as folder:
        os.chdir(folder)
        os.environ["HOME"] = folder
        pathlib.Path("a-scene.yaml").write_text("objects: []\n")
        pathlib.Path("a-folder").mkdir()
        pathlib.Path("functions").mkdir()
        with open("functions/_tofray", "wb") as script:
            subprocess.run(["tofray", "completion", "zsh"], check=True, stdout=script)
        for shell, (ask, ways) in SHELLS.items():
            if shutil.which(shell) is None:
                print(f"{shell} is not installed: not asked")
                continue
            if shell == "zsh" and not has_terminals():
                print("zsh needs a pseudo-terminal, and this machine has none: not asked")
                continue
            for load in ways:
                for line, wanted in CASES:
                    offered = ask(line, load)
                    if wanted not in offered.split() and wanted not in offered.replace("/", " ").split():
                        print(f"{shell}, {load}: {line!r} became {offered.strip()!r}, expected {wanted!r}")
                        faults += 1
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
