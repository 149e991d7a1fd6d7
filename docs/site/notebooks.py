#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Notebooks are run, and what they show becomes a page of the site.

notebooks.py           takes the outputs out of those in the tree, where an editor left them
notebooks.py FILE OUT  runs one, and writes it into the folder OUT as Markdown, with its pictures beside it
"""

import json
import os
import pathlib
import subprocess
import sys

LONGEST_S = 120


def notebooks_of(root):
    return sorted((pathlib.Path(root) / "examples/python/notebooks").glob("*.ipynb"))


def faults_of_stored(path):
    """What a notebook in the tree has to be: no outputs, no counts, its licence within."""
    notebook, faults = json.loads(path.read_text(encoding="utf-8")), []
    for number, cell in enumerate(notebook["cells"], start=1):
        if cell["cell_type"] == "code" and (cell["outputs"] or cell["execution_count"] is not None):
            faults.append(f"{path}: error: cell {number} is stored with its outputs; python3 docs/site/notebooks.py takes them out")
    if notebook["metadata"].get("SPDX-License-Identifier") != "Apache-2.0":
        faults.append(f"{path}: error: its metadata lack the SPDX lines")
    return faults


def run(path, packages, out):
    """Runs a notebook, with the module that stands in `packages`, in the empty folder `out`; what is wrong, as lines."""
    out.mkdir(parents=True)
    environment = os.environ | {"PYTHONPATH": str(pathlib.Path(packages).resolve()), "PYTHONDONTWRITEBYTECODE": "1", "LC_ALL": "C.UTF-8", "HOME": str(out)}
    environment |= {"PYDEVD_DISABLE_FILE_VALIDATION": "1", "JUPYTER_PLATFORM_DIRS": "1"}
    done = subprocess.run([sys.executable, __file__, str(path), str(out)], cwd=out, env=environment, check=False, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return [] if done.returncode == 0 else [f"{path}: error: does not run to its end", done.stdout.rstrip()]


def run_here(path, out):
    import nbformat
    from nbconvert import MarkdownExporter
    from nbconvert.preprocessors import ExecutePreprocessor
    from nbconvert.writers import FilesWriter

    notebook = nbformat.read(path, as_version=4)
    ExecutePreprocessor(timeout=LONGEST_S).preprocess(notebook, {"metadata": {"path": str(out)}})
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            if output.get("name") == "stderr":
                raise SystemExit(f"it warns:\n{output.text}")
    body, resources = MarkdownExporter().from_notebook_node(notebook, {"unique_key": path.stem, "output_files_dir": f"{path.stem}_files"})
    FilesWriter(build_directory=str(out)).write(body, resources, notebook_name=path.stem)


def make_pages(root, stage, build, scratch):
    faults = []
    for path in notebooks_of(root):
        faults += faults_of_stored(path) + run(path, build / "python", scratch / path.stem)
        for made in [*(scratch / path.stem).glob("*.md"), *(scratch / path.stem).glob("*_files/*")]:
            place = stage / "notebooks" / made.relative_to(scratch / path.stem)
            place.parent.mkdir(exist_ok=True)
            place.write_bytes(made.read_bytes())
    return faults


def clear(path):
    notebook = json.loads(path.read_text(encoding="utf-8"))
    for cell in notebook["cells"]:
        cell.pop("id", None)
        cell["metadata"] = {}
        if cell["cell_type"] == "code":
            cell["outputs"], cell["execution_count"] = [], None
    notebook["nbformat_minor"] = 4
    path.write_text(json.dumps(notebook, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) == 3:
        run_here(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
    else:
        for one in notebooks_of(pathlib.Path(__file__).resolve().parents[2]):
            clear(one)
