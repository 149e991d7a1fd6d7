# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What of a Markdown document a reader may type: fenced blocks by language, and code within lines.

    markdown.py DOCUMENT SCRIPT WORD     all blocks behind <!-- test: by SCRIPT WORD -->, which that script runs
"""

import dataclasses
import re
import sys


@dataclasses.dataclass
class Snippet:
    kind: str  # a block's language, or "inline"
    text: str
    line: int
    target: str = ""  # of a YAML block: the file that it changes, from <!-- test: into FILE --> before it
    prints: str = ""  # of a shell or Python block: what its output has to hold, from <!-- test: prints TEXT --> before it
    elsewhere: str = ""  # the script, and its word for it, that runs the block in place of this test, from <!-- test: by SCRIPT WORD --> before it


class Fault(Exception):
    """What is wrong with a document, and in which line."""

    def __init__(self, line, what):
        super().__init__(what)
        self.line = line


def snippets(text):
    """All snippets in the order in which they stand."""
    found, block, directives, before = [], None, {}, ""
    for number, line in enumerate(text.split("\n"), start=1):
        fence = re.match(r"```(.*)$", line)
        if block is not None and fence:
            found.append(block)
            block = None
        elif block is not None:
            block.text += line + "\n"
        elif fence:
            if not fence[1]:
                raise Fault(number, "a block without a language: say sh, yaml, python, cpp, or text for what nobody runs")
            block, directives = Snippet(fence[1], "", number, **directives), {}
        elif directive := re.fullmatch(r"<!-- test: (.*) -->", line):
            directives |= parsed(directive[1], number)
        elif line.startswith("    ") and not before.strip():
            raise Fault(number, "a block by indentation has no language: fence it")
        else:
            found += [Snippet("inline", code, number) for code in re.findall(r"`([^`]+)`", line)]
        before = line
    if block is not None:
        raise Fault(block.line, "a block without an end")
    return found


def parsed(directive, line):
    if into := re.fullmatch(r"into (\S+)", directive):
        return {"target": into[1]}
    if prints := re.fullmatch(r"prints (.+)", directive):
        return {"prints": prints[1]}
    if elsewhere := re.fullmatch(r"by (\S+ \S+)", directive):
        return {"elsewhere": elsewhere[1]}
    raise Fault(line, f"the test does not know what to do: {directive}")


def put_into(text, block):
    """YAML `text` with the keys of `block` in place of its own, or after them where it has none.

    A block is either keys of the file or, indented, entries of its list: an entry takes the place of the one with the same tag.
    """
    lines = text.rstrip("\n").split("\n")
    for name, part in parts(block):
        begin = next((i for i, line in enumerate(lines) if line.startswith(name)), None)
        if begin is not None:
            end = next((i for i in range(begin + 1, len(lines)) if starts_afresh(lines[i], name)), len(lines))
            lines[begin:end] = part
        elif name.startswith("  - "):
            last = max((i for i, line in enumerate(lines) if line.startswith("  - ")), default=None)
            if last is None:
                raise ValueError("there is no list to add to")
            lines[last + 1 : last + 1] = part
        else:
            lines += part
    return "\n".join(lines) + "\n"


def parts(block):
    """(how the first line begins, lines) of each key or entry."""
    found = []
    for line in block.rstrip("\n").split("\n"):
        if start := re.match(r"(  - )?\w+:", line):
            found.append((start[0], [line]))
        elif found:
            found[-1][1].append(line)
        else:
            raise ValueError(f"neither a key nor an entry of a list: {line}")
    return found


def starts_afresh(line, name):
    """Whether a line is no longer part of what began with `name`."""
    return line.startswith("  - ") or not line.startswith(" ") if name.startswith("  - ") else bool(line) and line[0] not in " #"


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as document:
        blocks = [one.text for one in snippets(document.read()) if one.elsewhere == " ".join(sys.argv[2:4])]
    if not blocks:
        sys.exit(f"{sys.argv[1]}: no block says <!-- test: by {' '.join(sys.argv[2:4])} -->")
    print("".join(blocks), end="")
