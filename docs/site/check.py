# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the site that was made: links and their anchors, equations, public names, and that it asks no other host for anything."""

import html.parser
import os
import pathlib
import posixpath
import subprocess
import sys
import urllib.parse
import xml.etree.ElementTree

LOADED = {"script": "src", "link": "href", "img": "src", "iframe": "src", "source": "src"}


class Page(html.parser.HTMLParser):
    """What of a page others can point to, and what it points to."""

    def __init__(self, path):
        super().__init__()
        self.places, self.links, self.loads, self.equations = set(), [], [], 0
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        said = dict(attributes)
        for key in ("id", "name"):
            if said.get(key):
                self.places.add(said[key])
        if tag == "a" and said.get("href"):
            self.links.append(said["href"])
        if tag in LOADED and said.get(LOADED[tag]):
            self.loads.append(said[LOADED[tag]])
        if said.get("class") == "equation":
            self.equations += 1


def broken_links(folder, pages):
    faults = []
    for name, page in pages.items():
        for link in page.links + page.loads:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.loads and parts.scheme != "data":
                    faults.append(f"{name}: error: loads {link}, of another host")
                continue
            path, place = urllib.parse.unquote(parts.path), urllib.parse.unquote(parts.fragment)
            target = posixpath.normpath(posixpath.join(posixpath.dirname(name), path)) if path else name
            if target not in pages and not (folder / target).is_file():
                faults.append(f"{name}: error: the link leads nowhere: {link}")
            elif place and target in pages and place not in pages[target].places:
                faults.append(f"{name}: error: {target} has no place {place!r}")
    return sorted(set(faults))


def equation_count(root, pages):
    """Every $$ … $$ of the chapters is an equation of its page."""
    faults = []
    for chapter in sorted((root / "docs/theory").glob("0*.md")):
        written = chapter.read_text(encoding="utf-8").count("$$") // 2
        shown = pages[f"theory/{chapter.stem}.html"].equations
        if written != shown:
            faults.append(f"docs/theory/{chapter.name}: error: {written} equations are written, {shown} are shown")
    return faults


def public_cpp_names(xml_folder):
    """Every name that Doxygen sees in the headers, qualified."""
    names = set()
    for path in pathlib.Path(xml_folder).glob("*.xml"):
        for compound in xml.etree.ElementTree.parse(path).getroot().iter("compounddef"):
            kind, own = compound.get("kind"), compound.findtext("compoundname", "")
            if kind in ("struct", "class"):
                names.add(own)
            if kind not in ("struct", "class", "namespace"):
                continue
            for member in compound.iter("memberdef"):
                if member.get("prot") == "public" and member.get("kind") != "friend":
                    name = member.findtext("name", "").replace("< ", "<").replace(" >", ">")  # as Sphinx writes it
                    names.add(f"{own}::{name}")
    return names


def public_python_names(build):
    done = subprocess.run([sys.executable, "-c", "import tofray; print('\\n'.join(tofray.__all__))"], check=True, text=True, stdout=subprocess.PIPE,
                          env=os.environ | {"PYTHONPATH": str(build / "python")})
    return {f"tofray.{name}" for name in done.stdout.split()}


def documented(folder):
    """The names that the search index's inventory has: (C++, Python)."""
    from sphinx.util.inventory import InventoryFile

    with (folder / "objects.inv").open("rb") as file:
        found = InventoryFile.load(file, "", posixpath.join)
    cpp = {name.split("(")[0] for kind, names in found.items() if kind.startswith("cpp:") for name in names}
    python = {name for kind, names in found.items() if kind.startswith("py:") for name in names}
    return cpp, python


def names_without_page(folder, xml_folder, build):
    cpp, python = documented(folder)
    faults = [f"include/tofray: error: {name} is on no page of the site" for name in sorted(public_cpp_names(xml_folder) - cpp)]
    return faults + [f"python/tofray: error: {name} is on no page of the site" for name in sorted(public_python_names(build) - python)]


def uncommented_things(xml_folder):
    """Structs, classes, enumerations and functions of the namespace without a comment."""
    faults = []
    for path in sorted(pathlib.Path(xml_folder).glob("*.xml")):
        for compound in xml.etree.ElementTree.parse(path).getroot().iter("compounddef"):
            if compound.get("kind") in ("struct", "class"):
                faults += uncommented(compound, compound.findtext("compoundname"))
            elif compound.get("kind") == "namespace":
                for member in compound.iter("memberdef"):
                    if member.get("kind") in ("enum", "function"):
                        faults += uncommented(member, member.findtext("name"))
    return faults


def uncommented(thing, name):
    if "".join(thing.find("briefdescription").itertext()).strip() or "".join(thing.find("detaileddescription").itertext()).strip():
        return []
    place = thing.find("location")
    return [f"include/{place.get('declfile') or place.get('file')}:{place.get('line')}: error: {name} has no comment that says what it is"]


def pictures_without_code(root):
    """Each picture of the documents is in the gallery, or in the chapter of the program that draws it."""
    gallery = (root / "docs/gallery.md").read_text(encoding="utf-8")
    return [f"docs/images/{path.name}: error: is not in docs/gallery.md" for path in sorted((root / "docs/images").glob("*.png"))
            if f"images/{path.name}" not in gallery]


def faults(root, folder, xml_folder, build):
    pages = {path.relative_to(folder).as_posix(): Page(path) for path in sorted(folder.rglob("*.html"))}
    if len(pages) < 20:
        return [f"{folder}: error: {len(pages)} pages are too few to be the site"]
    return (broken_links(folder, pages) + equation_count(root, pages) + names_without_page(folder, xml_folder, build) +
            uncommented_things(xml_folder) + pictures_without_code(root))
