# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The C++ pages' bodies: a directive of Breathe's for each thing of a header, in the header's order."""

import pathlib
import re
import xml.etree.ElementTree

MARK = re.compile(r"^\.\. all of (\w+)\.h\n", re.M)
DIRECTIVES = {"struct": "doxygenstruct", "class": "doxygenclass", "enum": "doxygenenum", "typedef": "doxygentypedef", "variable": "doxygenvariable",
              "function": "doxygenfunction"}


def things(xml_folder):
    """(header, line, directive) of each type, function and constant of the namespace."""
    for path in sorted(pathlib.Path(xml_folder).glob("*.xml")):
        for compound in xml.etree.ElementTree.parse(path).getroot().iter("compounddef"):
            kind, name = compound.get("kind"), compound.findtext("compoundname", "")
            if kind in ("struct", "class") and name.count("::") == 1 and compound.get("prot") == "public":
                place = compound.find("location")
                yield pathlib.Path(place.get("file")).stem, int(place.get("line")), f".. {DIRECTIVES[kind]}:: {name}\n   :members:\n   :undoc-members:\n"
            elif kind == "namespace":
                yield from members(name, compound)


def members(namespace, compound):
    for member in compound.iter("memberdef"):
        place, kind = member.find("location"), member.get("kind")
        name = f"{namespace}::{member.findtext('name', '')}"
        if kind == "function":
            name += "(" + ", ".join("".join(one.find("type").itertext()) for one in member.findall("param")) + ")"
        yield pathlib.Path(place.get("declfile") or place.get("file")).stem, int(place.get("declline") or place.get("line")), f".. {DIRECTIVES[kind]}:: {name}\n"


def fill_pages(stage, xml_folder):
    """In the place of a mark `.. all of frame.h`: all of it."""
    by_header = {}
    for header, line, directive in things(xml_folder):
        by_header.setdefault(header, []).append((line, directive))
    for path in sorted((stage / "cpp").glob("*.rst")):
        text = path.read_text(encoding="utf-8")
        path.write_text(MARK.sub(lambda found: "\n".join(one for _, one in sorted(by_header.get(found[1], []))), text), encoding="utf-8")
