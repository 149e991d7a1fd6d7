# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""All mutants of a source: small changes of its formulas that still compile, as edits that a switch can turn on (switch.h)."""
import hashlib
import re
from dataclasses import dataclass, field

from tokens import Source

operators = {"+": ("-", "Minus"), "-": ("+", "Plus"), "*": ("/", "Over"), "/": ("*", "Times"), "<": ("<=", "LessEqual"),
             "<=": ("<", "Less"), ">": (">=", "GreaterEqual"), ">=": (">", "Greater"), "==": ("!=", "Unequal"), "!=": ("==", "Equal"),
             "&": ("|", "BitOr"), "|": ("&", "BitAnd")}
swaps = {"min": "max", "max": "min", "any": "all", "all": "any", "fma": "fnma", "fnma": "fma", "sin": "cos", "cos": "sin",
         "floor": "ceil", "lowest": "highest", "highest": "lowest", "round_even": "floor"}
left_out = {"sqrt", "abs", "exp"}
keywords = {"return", "if", "else", "for", "while", "do", "switch", "case", "default", "break", "continue", "throw", "try", "catch", "const",
            "constexpr", "static", "auto", "using", "namespace", "template", "typename", "struct", "class", "enum", "new", "delete", "static_assert",
            "friend", "operator", "goto", "extern", "inline", "typedef", "public", "private", "co_return", "sizeof"}
declared_arrays = re.compile(r"(?:const\s+|static\s+)*\w[\w:]*(?:<[\w:]*>)?\s+\w+(?:\[[^\[\]]*\])*(?:,\s*\w+(?:\[[^\[\]]*\])*)*")
assignments = {"=", "+=", "-=", "*=", "/=", "|=", "&=", "^=", "<<=", ">>=", "%="}


@dataclass
class Mutant:
    file: str
    kind: str
    line: int
    column: int       # in the line without its indentation, from 1
    text: str         # that line
    before: str
    after: str
    replace: list = field(default_factory=list)   # (start, end, text with @n)
    wrap: list = field(default_factory=list)      # (start, end, in front, behind)
    which: int = 1    # of lines that read alike

    @property
    def place(self):
        """What stays the same when lines move."""
        which = f" (line {self.which} of this text)" if self.which > 1 else ""
        return f"{self.file} | {self.text} | @{self.column} {self.before} -> {self.after}{which}"

    def rank(self, seed):
        return hashlib.sha256(f"{seed} {self.place}".encode()).hexdigest()


class Finder:
    def __init__(self, file, source):
        self.file = file
        self.s = Source(source)
        self.found = []

    def all(self):
        for i, t in enumerate(self.s.tokens):
            if t.kind == "mark":
                self.operator(i)
                self.logical(i)
                self.ternary(i)
                self.minus(i)
                self.index(i)
                self.plus_is(i)
            elif t.kind == "number":
                self.number(i)
            elif t.kind == "name":
                self.function(i)
                self.condition(i)
                self.statement(i)
        return self.found

    def add(self, kind, i, before, after, replace=(), wrap=()):
        if kind != "constant" and self.in_constant(i) >= 0 or self.in_size(i):
            return   # computed by the compiler
        at = self.s.tokens[i].start
        text = self.s.line_text(at)
        indent = len(text) - len(text.lstrip())
        column = at - self.s.line_start(at) - indent + 1
        self.found.append(Mutant(self.file, kind, self.s.line(at), column, text.strip(), before, after, list(replace), list(wrap)))

    # Where expressions begin and end

    def left(self, i, stops):
        """The first token of the operand that ends in front of token i."""
        j = i - 1
        while j >= 0:
            text = self.s.text(j)
            if self.s.kind(j) == "mark":
                if text in (")", "]") or text == "}" and self.s.kind(self.s.partner.get(j, 0) - 1) == "name":
                    j = self.s.partner[j] - 1
                    continue
                if text in stops or text in "([{},;?:=" or text in assignments:
                    break
            if text in ("return", "case", "else", "throw"):
                break
            j -= 1
        return j + 1

    def right(self, i, stops):
        """The last token of the operand that begins behind token i."""
        j = i + 1
        while j < len(self.s.tokens):
            text = self.s.text(j)
            if self.s.kind(j) == "mark":
                if text in "([{":
                    j = self.s.partner[j] + 1
                    continue
                if text in stops or text in ")]},;?:" or text in assignments:
                    break
            j += 1
        return j - 1

    def primary(self, i):
        """The last token of the operand of a sign: a name with all that hangs on it, a number, a bracket."""
        j = i
        if self.s.text(j) == "(":
            j = self.s.partner[j]
        while True:
            following = self.s.text(j + 1)
            if following in (".", "->", "::"):
                j += 2
            elif following in ("(", "["):
                j = self.s.partner[j + 1]
            else:
                return j

    def span(self, first, last):
        return self.s.tokens[first].start, self.s.tokens[last].end

    # Kinds of mutants

    def operator(self, i):
        t = self.s.tokens[i]
        if t.text not in operators or not self.s.spaced(i) or self.s.text(i - 1) in ("operator", "return", "(", ",", "=", "?", ":"):
            return
        if self.s.kind(i - 1) == "text" or self.s.kind(i + 1) == "text":
            return   # strings
        after, other = operators[t.text]
        self.add("operator", i, t.text, after, [(t.start, t.end, f"{t.text} ::tofray_mutation::At<@n, ::tofray_mutation::{other}>{{}} {t.text}")])

    def logical(self, i):
        text = self.s.text(i)
        if text not in ("&&", "||") or not self.s.spaced(i):
            return
        first = self.left(i, {"||"} if text == "&&" else set())
        last = self.right(i, {"&&", "||"} if text == "&&" else {"||"})
        name, after = ("both", "||") if text == "&&" else ("either", "&&")
        start, end = self.span(first, last)
        t = self.s.tokens[i]
        self.add("logical", i, text, after, [(t.start, t.end, ", [&] { return static_cast<bool>(")],
                 [(start, end, f"::tofray_mutation::{name}<@n>(", "); })")])

    def ternary(self, i):
        if self.s.text(i) != "?":
            return
        first = self.left(i, set())
        start, end = self.span(first, i - 1)
        self.add("branches", i, "? a : b", "? b : a", wrap=[(start, end, "::tofray_mutation::condition<@n>(", ")")])

    def minus(self, i):
        if self.s.text(i) != "-" or self.s.spaced(i):
            return
        previous = self.s.text(i - 1)
        if self.s.kind(i - 1) in ("name", "number") and previous != "return" or previous in (")", "]", "operator"):
            return
        last = self.primary(i + 1)
        start, end = self.span(i + 1, last)
        t = self.s.tokens[i]
        self.add("sign", i, "-", "", [(t.start, t.end, "")], [(start, end, "::tofray_mutation::negative<@n>(", ")")])

    def index(self, i):
        if self.s.text(i) != "[" or self.s.text(i + 1) in ("[", "]", "&", "=") or self.s.text(i - 1) in ("[", "delete"):
            return
        if self.s.kind(i - 1) != "name" and self.s.text(i - 1) not in ("]", ")"):
            return
        if self.s.kind(i - 1) == "name" and (self.s.kind(i - 2) == "name" and self.s.text(i - 2) not in keywords or self.s.text(i - 2) in (">", "*", "&")
                                             and not self.s.spaced(i - 2)):
            return   # a declaration
        last = self.s.partner[i] - 1
        inner = range(i + 1, last + 1)
        if last == i + 1 and self.s.kind(i + 1) == "number" or any(self.s.kind(j) == "text" or self.s.text(j) == "," for j in inner):
            return
        start, end = self.span(i + 1, last)
        self.add("index", i, "[i]", "[i + 1]", wrap=[(start, end, "::tofray_mutation::index<@n>(", ")")])

    def plus_is(self, i):
        if self.s.text(i) not in ("+=", "-="):
            return
        last = self.right(i, set())
        if any(self.s.kind(j) == "text" for j in range(i, last + 1)):
            return
        start, end = self.span(i + 1, last)
        self.add("operator", i, self.s.text(i), "-=" if self.s.text(i) == "+=" else "+=", wrap=[(start, end, "::tofray_mutation::added<@n>(", ")")])

    def in_constant(self, i):
        """The token `constexpr` of the declaration that token i stands in, or −1."""
        j = i
        while j >= 0 and self.s.text(j) != ";":
            if self.s.text(j) == "constexpr":
                return j
            if self.s.text(j) == "{" and self.s.text(j - 1) in (")", "const", "noexcept"):
                return -1
            j = self.s.partner[j] - 1 if self.s.text(j) in (")", "]", "}") else j - 1
        return -1

    def in_size(self, i):
        """Token i is, or stands within, the size of an array that is declared: `float a[2 * n], b[n];`."""
        bracket = i if self.s.text(i) == "[" else self.s.inside[i]
        while bracket >= 0:
            first = bracket
            while first > 0 and self.s.text(first - 1) not in (";", "{", "}", ")"):
                first -= 1
            before = self.s.source[self.s.tokens[first].start:self.s.tokens[bracket].start]
            if self.s.text(bracket) == "[" and declared_arrays.fullmatch(before) and before.split()[0] not in keywords - {"const", "static"}:
                return True
            bracket = self.s.inside[bracket]
        return False

    def in_table(self, i):
        """One of more than 24 values in braces, alone or in pairs."""
        bracket = self.s.inside[i]
        for _ in range(2):
            if bracket < 0 or self.s.text(bracket) != "{":
                return False
            if self.arguments(bracket) > 24:
                return True
            bracket = self.s.inside[bracket]
        return False

    def number(self, i):
        t = self.s.tokens[i]
        before, after = self.s.source[t.start - 1], self.s.source[t.end:t.end + 1]
        previous = self.s.text(i - 1)
        if before == "<" or after == ">" or previous in ("case", "operator") or self.s.text(i + 1) in (":",) and previous not in ("?", "("):
            return
        hexadecimal = t.text[:2] in ("0x", "0X")
        floating = "." in t.text or (not hexadecimal and ("e" in t.text or "E" in t.text or t.text[-1] in "fF")) or (hexadecimal and "p" in t.text)
        bracket = self.s.inside[i]
        if previous == "[" and self.s.text(i + 1) == "]" and self.s.kind(i - 3) == "name" and self.s.text(i - 3) not in keywords:
            return   # the size of an array
        if bracket >= 0 and self.s.text(bracket) == "{" and previous == "=" and self.s.kind(i - 3) in ("", "mark") and self.s.text(i + 1) in (",", "}"):
            return   # an enumerator
        constant = self.in_constant(i)
        if constant >= 0 and not floating or self.in_table(i):
            return   # sizes and limits of the compiler; data
        value = float.fromhex(t.text.rstrip("fFlL")) if hexadecimal and floating else None
        if value is None and floating:
            value = float(t.text.rstrip("fFlL").replace("'", ""))
        if floating:
            other = f"2 * {t.text}" if value else t.text.replace("0", "1", 1)
        else:
            other = f"{t.text} + 1"
        name = "constant" if constant >= 0 else "number"
        edits = [(t.start, t.end, f"::tofray_mutation::{name}<@n>({t.text}, static_cast<decltype({t.text})>({other}))")]
        if constant >= 0:
            c = self.s.tokens[constant]
            edits.append((c.start, c.end, "const"))
        self.add("constant", i, t.text, other, edits)

    def function(self, i):
        name = self.s.text(i)
        if self.s.text(i + 1) != "(" or self.s.text(i - 1) in (".", "->") or self.s.kind(i - 1) == "name" and self.s.text(i - 1) != "return":
            return
        if name not in swaps and name not in left_out and name != "select":
            return
        first = i
        while self.s.text(first - 1) == "::":
            first -= 2
        if self.s.kind(first - 1) == "name" and self.s.text(first - 1) != "return" or self.s.text(first - 1) in (">", "*", "&") and not self.s.spaced(first - 1):
            return   # its declaration
        whole = self.s.source[self.s.tokens[first].start:self.s.tokens[i].end]
        prefix = whole[:-len(name)]
        arguments = self.arguments(i + 1)
        start, end = self.span(first, i)
        if name == "select" and arguments == 3:
            self.add("branches", i, "select(m, a, b)", "select(m, b, a)", [(start, end, f"TOFRAY_MUTATION_SELECT(@n, {whole})")])
        elif name in left_out and arguments == 1:
            self.add("function", i, f"{name}(a)", "a", [(start, end, f"TOFRAY_MUTATION_NONE(@n, {whole})")])
        elif name in swaps and not (prefix == "std::" and swaps[name] == "fnma"):
            self.add("function", i, name, swaps[name], [(start, end, f"TOFRAY_MUTATION_CALL(@n, {whole}, {prefix}{swaps[name]})")])

    def arguments(self, bracket):
        count, j, last = 1, bracket + 1, self.s.partner[bracket]
        while j < last:
            if self.s.text(j) in ("(", "[", "{"):
                j = self.s.partner[j]
            count += self.s.text(j) == ","
            j += 1
        return count

    def condition(self, i):
        if self.s.text(i) not in ("if", "while") or self.s.text(i + 1) != "(":
            return
        last = self.s.partner[i + 1] - 1
        inner = [self.s.text(j) for j in range(i + 2, last + 1)]
        if ";" in inner or "=" in inner or inner[0] in ("const", "auto"):
            return
        start, end = self.span(i + 2, last)
        self.add("branches", i, f"{self.s.text(i)} (c)", f"{self.s.text(i)} (!c)", wrap=[(start, end, "::tofray_mutation::condition<@n>(", ")")])

    def statement(self, i):
        previous = self.s.text(i - 1)
        after_condition = previous == ")" and self.s.text(self.s.partner[i - 1] - 1) in ("if", "for", "while")
        if previous not in (";", "{", "}", "else") and not after_condition or self.s.text(i) in keywords:
            return
        j, acts = i, False
        while self.s.text(j) != ";":
            if j >= len(self.s.tokens):
                return
            text, following = self.s.text(j), self.s.text(j + 1)
            if text in assignments:
                acts = True
                break
            if self.s.kind(j) == "name" and (self.s.kind(j + 1) == "name" or following == "<"):
                return   # a declaration
            if text in ("(", "["):
                acts = acts or text == "("
                j = self.s.partner[j] + 1
                continue
            if self.s.kind(j) != "name" and text not in ("::", ".", "->"):
                return
            j += 1
        while j < len(self.s.tokens) and self.s.text(j) != ";":
            j = self.s.partner[j] + 1 if self.s.text(j) in ("(", "[", "{") else j + 1
        if not acts or self.s.inside[i] < 0 or self.s.text(self.s.inside[i]) != "{" or self.s.text(j) != ";":
            return
        opened = self.s.inside[i]
        if self.s.kind(opened - 1) == "name" and self.s.text(opened - 1) not in ("else", "do", "const", "noexcept", "override"):
            return   # the body of a class or namespace
        start = self.s.tokens[i].start
        self.add("statement", i, self.s.source[start:self.s.tokens[j].end], "", wrap=[(start, start, "if (::tofray_mutation::on<@n>()) {} else ", "")])


def mutants_of(file, source):
    found = Finder(file, source).all()
    seen = {}
    for m in found:
        m.which = seen[m.place] = seen.get(m.place, 0) + 1
    return found


def woven(source, mutants):
    """The source with all `mutants` (number, mutant) in it, each behind its switch. Lines stay where they are."""
    replaced, opening, closing = {}, {}, {}
    for number, m in mutants:
        for start, end, text in m.replace:
            replaced[start] = (end, text.replace("@n", str(number)))
        for start, end, front, behind in m.wrap:
            # Of two with the same ends, the one that cuts its text in two is the inner one; a whole statement is outside of all.
            inner = 1 if m.kind == "logical" else 0
            opening.setdefault(start, []).append((-end if behind else -len(source) - 1, inner, number, front.replace("@n", str(number))))
            if behind:
                closing.setdefault(end, []).append((-start, -inner, -number, behind.replace("@n", str(number))))
    out, at = [], 0
    for position in sorted({*replaced, *opening, *closing}):
        if position < at:
            raise ValueError("edits overlap")
        out.append(source[at:position])
        at = position
        out += [text for *_, text in sorted(closing.get(position, []))]
        out += [text for *_, text in sorted(opening.get(position, []))]
        if position in replaced:
            end, text = replaced[position]
            out.append(text)
            at = end
    out.append(source[at:])
    return "".join(out)
