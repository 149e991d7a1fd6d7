# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Notebooks are run, and what they show becomes a page of the site."""

import json
import os
import pathlib
import subprocess
import sys

LONGEST_S = 120


def problems_of(name, notebook):
    """What a notebook in the tree has to be: no outputs, no counts, its licence within."""
    faults = []
    for number, cell in enumerate(notebook["cells"], start=1):
        if cell["cell_type"] == "code" and (cell["outputs"] or cell["execution_count"] is not None):
            faults.append(f"{name}: error: cell {number} is stored with its outputs; python3 docs/site/notebooks.py clears them")
    if "SPDX-License-Identifier: Apache-2.0" not in json.dumps(notebook["metadata"]):
        faults.append(f"{name}: error: its metadata lack the SPDX lines")
    return faults


def run(path, build, out, to):
    """Runs a notebook in an empty folder; what is wrong, as lines."""
    out.mkdir(parents=True, exist_ok=True)
    environment = os.environ | {"PYTHONPATH": str(build / "python"), "PYTHONDONTWRITEBYTECODE": "1", "LC_ALL": "C.UTF-8", "HOME": str(out)}
    environment |= {"MPLBACKEND": "module://matplotlib_inline.backend_inline", "PYTHONWARNINGS": "ignore"}
    (out / path.name).write_bytes(path.read_bytes())
    command = [sys.executable, "-m", "jupyter", "nbconvert", "--execute", f"--ExecutePreprocessor.timeout={LONGEST_S}", "--to", to, "--output-dir", str(out)]
    done = subprocess.run([*command, path.name], cwd=out, env=environment, check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return [] if done.returncode == 0 else [f"{path}: error: does not run to its end", done.stdout.rstrip()]


def make_pages(root, stage, build, scratch):
    faults = []
    for path in sorted((pathlib.Path(root) / "examples/python/notebooks").glob("*.ipynb")):
        name = path.relative_to(root).as_posix()
        faults += problems_of(name, json.loads(path.read_text(encoding="utf-8")))
        faults += run(path, build, scratch / path.stem, "markdown")
        page = stage / "notebooks"
        page.mkdir(exist_ok=True)
        for made in (scratch / path.stem).glob("*.md"):
            (page / made.name).write_text(made.read_text(encoding="utf-8"), encoding="utf-8")
        for made in (scratch / path.stem).glob("*_files/*"):
            (page / made.parent.name).mkdir(exist_ok=True)
            (page / made.parent.name / made.name).write_bytes(made.read_bytes())
    return faults


def clear(path):
    notebook = json.loads(path.read_text(encoding="utf-8"))
    for cell in notebook["cells"]:
        cell.pop("id", None)
        cell["metadata"] = {}
        if cell["cell_type"] == "code":
            cell["outputs"], cell["execution_count"] = [], None
    path.write_text(json.dumps(notebook, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    for one in sorted((pathlib.Path(__file__).resolve().parents[2] / "examples/python/notebooks").glob("*.ipynb")):
        clear(one)
