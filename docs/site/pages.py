# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The site's pages out of the tree's documents, line by line the same but for their links, which lead to pages of the site.

A link to an equation, chapter.md#equation-ggx, becomes equation:ggx: extension.py knows which page has it.
"""

import os
import pathlib
import posixpath
import re
import shutil

LINK = re.compile(r"(\]\()([^)#\s]+)(#[^)\s]+)?(?=[)\s])")
EQUATION = re.compile(r"(\]\()[^)\s#]*#equation-([^)\s]+)(?=\))")
LANGUAGES = {".py": "python", ".h": "cpp", ".cpp": "cpp", ".yaml": "yaml", ".sh": "sh", ".cmake": "cmake", ".bib": "bibtex", ".obj": "text", ".mtl": "text"}
LARGEST_TEXT = 100_000

# What is below a page in the site's contents: README says nothing of that.
BELOW = {"index.md": "contents.txt", "decisions/index.md": ("0*",), "how-to.md": ("how-to/*",), "theory/index.md": ("0*", "equations")}

MOVED = {
    "README.md": "index.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "SECURITY.md": "security.md",
    "docs/index.md": None,  # the tree's own list of documents: the site has its contents beside each page
    "docs/decisions/README.md": "decisions/index.md",
}


class Pages:
    def __init__(self, root, stage):
        self.root, self.stage = pathlib.Path(root), pathlib.Path(stage)
        self.home = self.homes()
        self.shown = {}  # files and folders of the tree that are no documents, but that a document names
        self.faults = []

    def homes(self):
        """Where each document of the tree is on the site."""
        found = dict(MOVED)
        for path in sorted((self.root / "docs").rglob("*.md")):
            name = path.relative_to(self.root).as_posix()
            if not name.startswith("docs/site/") and name not in found:
                found[name] = name.removeprefix("docs/")
        for path in sorted((self.root / "include/tofray").glob("*.h")):
            if (self.root / f"docs/site/cpp/{path.stem}.rst").exists():
                found[path.relative_to(self.root).as_posix()] = f"cpp/{path.stem}.rst"
        for path in sorted((self.root / "examples/python/notebooks").glob("*.ipynb")):
            found[path.relative_to(self.root).as_posix()] = f"notebooks/{path.stem}.md"
        found["docs/decisions"] = found["docs/decisions/README.md"]
        found["docs/index.md"] = found["README.md"]
        return found

    def write(self, name, text):
        path = self.stage / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def make(self):
        for name, home in self.home.items():
            path = self.root / name
            if path.suffix == ".md" and name != "docs/index.md":
                self.write(home, self.with_links(name, home, path.read_text(encoding="utf-8")) + self.below(home))
        for folder in ("cpp", "python", "notebooks"):
            for path in (self.root / "docs/site" / folder).glob("*.rst"):
                text = path.read_text(encoding="utf-8")
                if folder == "cpp":
                    text = text.replace(".. intro of the header\n", self.intro(path.stem))
                self.write(f"{folder}/{path.name}", text)
        shutil.copytree(self.root / "docs/images", self.stage / "images")
        self.show_files()

    def below(self, home):
        pages = BELOW.get(home, ())
        if isinstance(pages, str):
            return (self.root / "docs/site" / pages).read_text(encoding="utf-8")
        return "\n```{toctree}\n:hidden:\n:glob:\n\n" + "\n".join(pages) + "\n```\n" if pages else ""

    def intro(self, header):
        """What a header says of itself, before its namespace begins: Doxygen would give it to the namespace, all headers' together."""
        path = self.root / f"include/tofray/{header}.h"
        said = re.search(r"((?:^///.*\n)+)namespace tofray", path.read_text(encoding="utf-8"), re.M) if path.exists() else None
        text = re.sub(r"^/// ?", "", said[1], flags=re.M) if said else ""
        return re.sub(r"`([^`]+)`", r"``\1``", text)

    def with_links(self, name, home, text):
        lines, code = text.split("\n"), False
        for at, line in enumerate(lines):
            if line.lstrip().startswith("```"):
                code = not code
            elif not code:
                line = LINK.sub(lambda found, number=at + 1: found[1] + self.target(name, number, home, found[2]) + (found[3] or ""), line)
                lines[at] = EQUATION.sub(r"\1equation:\2", line)
        return "\n".join(lines)

    def target(self, name, line, home, link):
        if "://" in link:
            return link
        wanted = posixpath.normpath(posixpath.join(posixpath.dirname(name), link))
        if not (self.root / wanted).exists():
            self.faults.append(f"{name}:{line}: error: the link leads nowhere: {link}")
            return link
        if wanted.startswith("docs/images/"):
            place = wanted.removeprefix("docs/")
        else:
            place = self.home.get(wanted) or self.show(wanted)
        return posixpath.relpath(place, posixpath.dirname(home) or ".")

    def show(self, wanted):
        """A page for a file or folder of the tree."""
        page = f"files/{wanted}.md" if (self.root / wanted).is_file() else f"files/{wanted}/index.md"
        if wanted not in self.shown:
            self.shown[wanted] = page
            if (self.root / wanted).is_dir():
                for path in sorted((self.root / wanted).iterdir()):
                    if path.is_file():
                        self.show(path.relative_to(self.root).as_posix())
        return page

    def show_files(self):
        for wanted, page in self.shown.items():
            path = self.root / wanted
            self.write(page, f"---\norphan: true\n---\n# {wanted}\n\n" + (self.folder(path) if path.is_dir() else self.file(path)))

    def folder(self, path):
        return "".join(f"- [{one.name}]({one.name}.md)\n" for one in sorted(path.iterdir()) if one.is_file())

    def file(self, path):
        if path.stat().st_size > LARGEST_TEXT or b"\0" in path.read_bytes():
            return f"{path.stat().st_size} bytes, in the repository.\n"
        text = path.read_text(encoding="utf-8")
        language = "cmake" if path.name == "CMakeLists.txt" else LANGUAGES.get(path.suffix, "text")
        return f"`````{language}\n{text.rstrip()}\n`````\n"


def fresh(folder):
    """An empty folder, which was one of this program's before or was not there."""
    mark = pathlib.Path(folder) / ".tofray-site"
    if os.path.exists(folder) and not mark.exists() and os.listdir(folder):
        raise SystemExit(f"{folder}: error: has files that this program did not write\n  expected an empty folder, or none")
    shutil.rmtree(folder, ignore_errors=True)
    mark.parent.mkdir(parents=True)
    mark.touch()
