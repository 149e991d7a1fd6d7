#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The documentation as a site: docs/site/make.py [--build build/release] [--out build/site]. `./dev docs` calls it.

Pages are the tree's Markdown; C++ comes from the headers by Doxygen, Python from the module that is built, notebooks are run. Anything
that any of them warns of, a link or an equation's name that leads nowhere, a public name without a page: an error.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import time

import check
import headers
import notebooks
import pages

ROOT = pathlib.Path(__file__).resolve().parents[2]


def version():
    found = re.search(r"project\(tofray VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
    return found[1]


DOXYFILE = """
INPUT = {root}/include/tofray
OUTPUT_DIRECTORY = {out}
GENERATE_XML = YES
GENERATE_HTML = NO
GENERATE_LATEX = NO
EXTRACT_ALL = YES
STRIP_FROM_PATH = {root}/include
JAVADOC_AUTOBRIEF = YES
ENABLE_PREPROCESSING = YES
MACRO_EXPANSION = YES
INCLUDE_PATH = {root}/include
WARN_IF_INCOMPLETE_DOC = NO
QUIET = YES
EXCLUDE_SYMBOLS = *::Impl
"""


def run_doxygen(out):
    """Its XML. Comments are the words of the headers: what they call wrong is an error."""
    out.mkdir()
    (out / "Doxyfile").write_text(DOXYFILE.format(root=ROOT, out=out), encoding="utf-8")
    done = subprocess.run(["doxygen", "Doxyfile"], cwd=out, check=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    faults = [line for line in done.stdout.split("\n") if re.search(r": (warning|error):", line)]
    return [fault.replace(f"{ROOT}/", "") for fault in faults]


def run_sphinx(source, out, doxygen, build):
    environment = os.environ | {
        "TOFRAY_SITE_VERSION": version(), "TOFRAY_SITE_DOXYGEN": str(doxygen / "xml"),
        "PYTHONPATH": str(build / "python"), "PYTHONDONTWRITEBYTECODE": "1", "LC_ALL": "C.UTF-8",
    }
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", "-c", str(source), str(source), str(out)]
    return subprocess.run(command, check=False, env=environment).returncode == 0


def join_scripts(html):
    """Debian's Furo is a script that imports another, which pages do not load as a module, nor could from a folder: one script of both."""
    script = html / "_static/scripts/furo.js"
    text = re.sub(r'^import Gumshoe from ".*";\n', "", script.read_text(encoding="utf-8"))
    if re.search(r"^(import|export)\b", text, re.M):
        return [f"{script}: error: imports what no page loads: the switch for dark pages and the marks of the contents would do nothing"]
    script.write_text((script.parent / "gumshoe-patched.js").read_text(encoding="utf-8") + "\n" + text, encoding="utf-8")
    return []


def stage_settings(source):
    """Sphinx's settings beside the pages, with the files that pages load: the site asks no other host for any."""
    for name in ("conf.py", "extension.py", "katex.js"):
        (source / name).write_text((ROOT / "docs/site" / name).read_text(encoding="utf-8"), encoding="utf-8")
    static = source / "_static"
    static.mkdir()
    (static / "site.css").write_text((ROOT / "docs/site/static/site.css").read_text(encoding="utf-8"), encoding="utf-8")
    katex = pathlib.Path("/usr/share/javascript/katex")
    (static / "katex/fonts").mkdir(parents=True)
    (static / "katex/katex.min.css").write_bytes((katex / "katex.min.css").read_bytes())
    for font in (katex / "fonts").glob("*.woff2"):
        (static / "katex/fonts" / font.name).write_bytes(font.read_bytes())


def fail(faults):
    print("\n".join(faults), file=sys.stderr)
    sys.exit(1)


class Clock:
    def __init__(self):
        self.since, self.said = time.monotonic(), []

    def lap(self, what):
        now = time.monotonic()
        self.said.append(f"{what} {now - self.since:.0f} s")
        self.since = now


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path, help="where the Python module is built")
    parser.add_argument("--out", default=ROOT / "build/site", type=pathlib.Path)
    options = parser.parse_args()
    build, out = options.build.resolve(), options.out.resolve()
    pages.fresh(out)
    clock = Clock()
    source, doxygen, html = out / "source", out / "doxygen", out / "html"
    site = pages.Pages(ROOT, source)
    site.make()
    stage_settings(source)
    faults = site.faults + notebooks.make_pages(ROOT, source, build, out / "run")
    clock.lap("notebooks")
    faults += run_doxygen(doxygen)
    clock.lap("doxygen")
    if faults:
        fail(faults)
    headers.fill_pages(source, doxygen / "xml")
    good = run_sphinx(source, html, doxygen, build)
    clock.lap("sphinx")
    faults = join_scripts(html) + check.faults(ROOT, html, doxygen / "xml", build) if good else []
    clock.lap("check")
    if faults or not good:
        fail(faults or ["docs/site: error: Sphinx warned, see above"])
    print(f"{html}/index.html: {sum(1 for _ in html.rglob('*.html'))} pages ({', '.join(clock.said)})")


if __name__ == "__main__":
    main()
