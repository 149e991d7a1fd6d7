# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""C++ source as a list of tokens: what is code, without comments, strings and preprocessor lines."""
import bisect
import re
from dataclasses import dataclass


@dataclass
class Token:
    kind: str   # name, number, text (string or character), mark (operator or bracket)
    text: str
    start: int  # in the source
    end: int


_pattern = re.compile(r"""
    (?P<space>\s+|\\\n)
  | (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<raw>(?:u8|[uUL])?R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)")
  | (?P<text>(?:u8|[uUL])?(?:"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)+'))
  | (?P<number>(?:0[xX][0-9a-fA-F']*(?:\.[0-9a-fA-F']*)?(?:[pP][+-]?\d+)?|(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[uUlLfF]*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<op><<=|>>=|\.\.\.|->\*|<=>|::|->|\+\+|--|<<|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[^\w\s])
""", re.VERBOSE | re.DOTALL)


def _code_only(source):
    """The source with preprocessor lines, and what only nvcc reads, as spaces of the same length."""
    out, cuda, depth, going_on = [], [], 0, False
    for line in source.splitlines(keepends=True):
        directive = line.lstrip()
        if going_on or directive.startswith("#"):
            if not going_on:
                word = directive[1:].split()[0] if directive[1:].split() else ""
                if word.startswith("if"):
                    depth += 1
                    if "__CUDA" in line:
                        cuda.append(depth)
                elif word in ("else", "elif") and cuda and cuda[-1] == depth:
                    cuda[-1] = -depth
                elif word == "endif":
                    if cuda and abs(cuda[-1]) == depth:
                        cuda.pop()
                    depth -= 1
            going_on = line.rstrip("\n").endswith("\\")
            out.append(re.sub(r"[^\n]", " ", line))
        else:
            out.append(re.sub(r"[^\n]", " ", line) if any(c > 0 for c in cuda) else line)
    return "".join(out)


class Source:
    """Tokens, which bracket belongs to which, and lines."""

    def __init__(self, source):
        self.source = source
        code = _code_only(source)
        self.tokens = []
        at = 0
        while at < len(code):
            m = _pattern.match(code, at)
            kind = "text" if m.lastgroup in ("raw", "mark") else m.lastgroup
            if m.group("raw"):
                kind = "text"
            if kind not in ("space", "comment"):
                self.tokens.append(Token("mark" if kind == "op" else kind, m.group(), m.start(), m.end()))
            at = m.end()
        self.partner = {}
        waiting = []
        self.inside = []        # the innermost bracket that each token stands in
        for i, t in enumerate(self.tokens):
            if t.kind == "mark" and t.text in ")]}" and waiting:
                opened = waiting.pop()
                self.partner[opened], self.partner[i] = i, opened
            self.inside.append(waiting[-1] if waiting else -1)
            if t.kind == "mark" and t.text in "([{":
                waiting.append(i)
        self._lines = [m.end() for m in re.finditer("\n", source)]

    def line(self, position):
        return bisect.bisect_right(self._lines, position) + 1

    def line_start(self, position):
        n = self.line(position)
        return 0 if n == 1 else self._lines[n - 2]

    def line_text(self, position):
        start = self.line_start(position)
        end = self.source.find("\n", start)
        return self.source[start:end if end >= 0 else len(self.source)]

    def text(self, i):
        return self.tokens[i].text if 0 <= i < len(self.tokens) else ""

    def kind(self, i):
        return self.tokens[i].kind if 0 <= i < len(self.tokens) else ""

    def spaced(self, i):
        """An operator between spaces: binary, by the style of this project."""
        t = self.tokens[i]
        return self.source[t.start - 1].isspace() and t.end < len(self.source) and self.source[t.end].isspace()
