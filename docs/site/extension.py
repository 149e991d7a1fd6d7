# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What the site adds to Sphinx: equations are HTML when the page is made, citations lead to them, and x_1 in a chapter is x with an index."""

import html
import json
import os
import re
import subprocess

from docutils import nodes
from sphinx.errors import ExtensionError
from sphinx.util import logging

log = logging.getLogger(__name__)
HERE = os.path.dirname(os.path.abspath(__file__))
KATEX = os.environ.get("TOFRAY_SITE_KATEX", "/usr/share/javascript/katex")

TAG = re.compile(r"\s*\\tag\{([a-z0-9-]+)\}")
# [theory: reset-noise], [theory: ggx, ggx-masking] in any text; in documents links to equation:ggx, which pages.py writes
CITATION = re.compile(r"\[theory:\s([a-z0-9-]+(?:,\s[a-z0-9-]+)*)\]")
NAME = re.compile(r"[a-z0-9-]+")
SCHEME = "equation:"
# D_k, Z_jm, N_A,k, k_1r² (the index is 1), e^{i·m·φ_j}, (l·m)^(n+1). Of fill_factor it is none: a symbol is one letter.
BASE = r"(?:(?<=(?<![A-Za-z_])[A-Za-z])|(?<=[^\x00-\x7f])|(?<='))"
BRACES, PARENTHESES = r"\{([^{}]*(?:\{[^{}]*\}[^{}]*)*)\}", r"\(([^()]*(?:\([^()]*\)[^()]*)*)\)"
INDEX = re.compile(rf"{BASE}_(?:{BRACES}|(\d+|[A-Za-zα-ωΔ]+(?:,[A-Za-z0-9]+)*))|(?<=[\w)])\^(?:{BRACES}|{PARENTHESES})")

NOT_OURS = {"Any", "Callable", "Hz", "Iterable", "Iterator", "Literal", "Mapping", "None", "Sequence"}


def anchor(name):
    return f"equation-{name}"


class Katex:
    """One process of node for all equations; it is started with the first."""

    def __init__(self):
        self.process = None

    def html(self, tex, display):
        if self.process is None:
            self.process = subprocess.Popen(["node", f"{HERE}/katex.js", f"{KATEX}/katex.js"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.process.stdin.write(json.dumps({"tex": tex, "display": display}) + "\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise ExtensionError("KaTeX gave no answer: node, or libjs-katex, is missing")
        return json.loads(line)


katex = Katex()


def rendered(node, tex, display):
    answer = katex.html(tex, display)
    if "error" in answer:
        log.warning("KaTeX: %s", answer["error"], location=node)
        return f"<code>{html.escape(tex)}</code>"
    return answer["html"]


def visit_math(self, node):
    self.body.append(rendered(node, node.astext(), False))
    raise nodes.SkipNode


def visit_math_block(self, node):
    """The name stands in a line of its own below the formula, and is a link to it: KaTeX would draw a long one over a long formula."""
    tex = node.astext()
    names = TAG.findall(tex)
    place = f' id="{anchor(names[0])}"' if names else ""
    name = f'<div class="equation-name"><a href="#{anchor(names[0])}">{names[0]}</a></div>' if names else ""
    self.body.append(f'<div class="equation"{place}>{rendered(node, TAG.sub("", tex), True)}{name}</div>\n')
    raise nodes.SkipNode


def note_equations(app, document):
    """Which page has which equation."""
    homes = app.env.__dict__.setdefault("tofray_equations", {})
    for block in document.findall(nodes.math_block):
        for name in TAG.findall(block.astext()):
            homes[name] = app.env.docname


def plain_texts(tree):
    """Text that is prose: not code, not a heading's (which tables of contents repeat), not within a link."""
    left_out = (nodes.literal, nodes.literal_block, nodes.math, nodes.math_block, nodes.reference, nodes.title, nodes.raw, nodes.comment)
    for text in list(tree.findall(nodes.Text)):
        above = text.parent
        while above is not None and not isinstance(above, left_out):
            above = above.parent
        if above is None:
            yield text


def replaced(text, found):
    """The text's pieces: what lies between the places (start, end, node), and these nodes."""
    end, out, whole = 0, [], text.astext()
    for start, stop, node in found:
        if start > end:
            out.append(nodes.Text(whole[end:start]))
        out.append(node)
        end = stop
    if end < len(whole):
        out.append(nodes.Text(whole[end:]))
    if found:
        text.parent.replace(text, out)


def address_of(app, docname, homes, name, location):
    """Where an equation is, from a page; nothing, and a warning, of one that there is not."""
    if name in homes:
        return app.builder.get_relative_uri(docname, homes[name]) + "#" + anchor(name)
    log.warning("there is no equation %s", name, location=location)
    return None


def link_equations(app, tree, docname):
    homes = getattr(app.env, "tofray_equations", {})
    for text in plain_texts(tree):
        found = []
        for cited in CITATION.finditer(text.astext()):
            for name in NAME.finditer(cited[1]):
                address = address_of(app, docname, homes, name[0], docname)
                if address:
                    start = cited.start(1) + name.start()
                    found.append((start, start + len(name[0]), nodes.reference(name[0], name[0], internal=True, refuri=address)))
        replaced(text, found)
    for link in tree.findall(nodes.reference):
        if link.get("refuri", "").startswith(SCHEME):
            address = address_of(app, docname, homes, link["refuri"].removeprefix(SCHEME), link)
            if address:
                link["refuri"], link["internal"] = address, True
    if docname == "theory/equations":
        link_list(app, tree, docname, homes)


def link_list(app, tree, docname, homes):
    """The names at the beginning of the lines of the page of all equations."""
    for strong in list(tree.findall(nodes.strong)):
        address = address_of(app, docname, homes, strong.astext(), strong)
        if address:
            strong.replace_self(nodes.reference("", "", strong.deepcopy(), internal=True, refuri=address))


def indexed(text):
    """Nodes of a text with its indices low and its powers high."""
    out, end = [], 0
    for found in INDEX.finditer(text):
        out.append(nodes.Text(text[end : found.start()]))
        low, inner = found[1] or found[2], found[1] or found[2] or found[3] or found[4]
        kind = nodes.subscript if low else nodes.superscript
        out.append(kind("", "", *indexed(inner)))
        end = found.end()
    out.append(nodes.Text(text[end:]))
    return [one for one in out if not (isinstance(one, nodes.Text) and not one.astext())]


def set_indices(app, tree, docname):
    if docname.startswith(("theory/", "decisions/")) or docname in ("round-corner", "not-simulated"):
        for text in plain_texts(tree):
            if INDEX.search(text.astext()):
                text.parent.replace(text, indexed(text.astext()))


def mend_docstrings(app, what, name, obj, options, lines):
    """|x| is a magnitude, and for reStructuredText something else. What type a member has stands beside its name."""
    directive = None
    for at, line in enumerate(lines):
        if "|" in line and "``" not in line:
            lines[at] = line.replace("|", "\\|")
        if line.startswith(".. attribute:: "):
            directive = at
        elif line.startswith("   :type: ") and directive is not None:
            lines[at] = ""
            lines[directive] += "\n" + line
    lines[:] = "\n".join(lines).split("\n")


def take_prose(app, env, node, text):
    """Types of parameters are prose, such as "float32 array [phase, height, width]". A word that begins as our classes do has to be one."""
    if node.get("refdomain") != "py" or node.get("reftype") not in ("class", "obj"):
        return None
    target = node.get("reftarget", "")
    ours = target.startswith("tofray.") or (re.fullmatch(r"[A-Z][a-z]\w*", target) and target not in NOT_OURS)
    return None if ours else text


def setup(app):
    app.add_html_math_renderer("katex", (visit_math, None), (visit_math_block, None))
    app.connect("doctree-read", note_equations)
    app.connect("doctree-resolved", link_equations)
    app.connect("doctree-resolved", set_indices)
    app.connect("autodoc-process-docstring", mend_docstrings)
    app.connect("missing-reference", take_prose)
    return {"version": "1", "parallel_read_safe": False}
