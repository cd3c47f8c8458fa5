"""Mutants of a source file: one small change each, by the usual operators."""
import re
from dataclasses import dataclass

BINARY = {  # clang-format puts spaces around these where they are binary operators, and only there
    "<": ["<=", ">"], "<=": ["<", ">"], ">": [">=", "<"], ">=": [">", "<"],
    "==": ["!="], "!=": ["=="], "&&": ["||"], "||": ["&&"],
    "+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"],
    "+=": ["-="], "-=": ["+="], "*=": ["/="], "/=": ["*="],
}
SWAPPED_NAMES = {"min": "max", "max": "min", "floor": "ceil", "ceil": "floor",
                 "fmin": "fmax", "fmax": "fmin"}
COMMUTATIVE = {"min", "max", "fmin", "fmax", "hypot"}
# What stands there has no effect that a test could see, or is no code of the program.
NO_CODE = re.compile(r"^\s*(#|using\b|template\b|static_assert|namespace\b|friend\b|extern\b)")
# Any work-group gives the same bits.
ANY_VALUE = re.compile(r"\bWorkGroup\{[^}]*\}")
NUMBER = re.compile(r"(?<![\w.])(0x[0-9a-fA-F]+|\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+)(f|u|ul|ull|u?LL|UL)?(?![\w.])")


@dataclass(frozen=True)
class Mutant:
    path: str      # in the project
    begin: int     # the characters that change
    end: int
    text: str      # what stands there instead
    operator: str

    def apply(self, source):
        return source[:self.begin] + self.text + source[self.end:]

    def line(self, source):
        return source.count("\n", 0, self.begin) + 1

    def name(self, source):
        column = self.begin - source.rfind("\n", 0, self.begin)
        return f"{self.path}:{self.line(source)}:{column}:{self.operator}"


def masked(source):
    """The source with comments, texts and lines that are no code blanked, of the same length."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group(0))
    kinds = r'R"(?P<end>\w*)\(.*?\)(?P=end)"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\''
    source = re.sub(kinds, blank, source, flags=re.S)
    source = ANY_VALUE.sub(blank, source)
    lines = source.split("\n")
    goes_on = False  # a condition for the preprocessor
    for i, line in enumerate(lines):
        is_condition = goes_on or re.match(r"\s*#\s*(el)?if", line)
        goes_on = bool(is_condition) and line.endswith("\\")
        if is_condition or NO_CODE.match(line):
            lines[i] = " " * len(line)
    return "\n".join(lines)


def number_changes(match):
    digits, suffix = match.group(1), match.group(2) or ""
    if digits.startswith("0x"):
        value = int(digits, 16)
        return [("+1", hex(value + 1) + suffix)]
    if "." in digits or "e" in digits.lower():
        value = float(digits)
        made = [("x2", value * 2)] if value else [("+1", 1.0)]
        if value:
            made += [("+1", value + 1), ("-1", value - 1)]
        return [(name, ("%r" % v) + suffix) for name, v in made]
    value = int(digits)
    made = [("+1", value + 1)] + ([("-1", value - 1)] if value else []) + ([("x2", value * 2)] if value > 1 else [])
    return [(name, f"{v}{suffix}") for name, v in made]


def closing(code, opening):
    """The position after the bracket that closes the one at `opening`, or -1."""
    depth = 0
    for i in range(opening, len(code)):
        if code[i] in "([{":
            depth += 1
        elif code[i] in ")]}":
            depth -= 1
            if depth == 0:
                return i + 1
    return -1


def arguments(code, begin, end):
    """Places of a call's arguments between its brackets."""
    places, depth, start = [], 0, begin
    for i in range(begin, end):
        if code[i] in "([{":
            depth += 1
        elif code[i] in ")]}":
            depth -= 1
        elif code[i] == "," and depth == 0:
            places.append((start, i))
            start = i + 1
    return places + [(start, end)]


def mutants_of(path, source):
    """All mutants of a file, in the order of their places."""
    code = masked(source)
    found = []

    def add(begin, end, text, operator):
        found.append(Mutant(path, begin, end, text, operator))

    for match in re.finditer(r" (<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|<|>|\+|-|\*|/)(?=[ \n])", code):
        for other in BINARY[match.group(1)]:
            add(match.start(1), match.end(1), other, f"{match.group(1)}to{other}")
    for match in NUMBER.finditer(code):
        line = code[code.rfind("\n", 0, match.start()) + 1:match.start()]
        if re.search(r"(\bcase|#.*)\s*$", line):
            continue
        for name, text in number_changes(match):
            add(match.start(), match.end(), text, name)
    for match in re.finditer(r"\b(\w+)\(", code):
        if match.group(1) in SWAPPED_NAMES:
            add(match.start(1), match.end(1), SWAPPED_NAMES[match.group(1)], f"{match.group(1)}to{SWAPPED_NAMES[match.group(1)]}")
    for match in re.finditer(r"\b(?:if|while) \(", code):
        end = closing(code, match.end() - 1)
        if end > 0 and ";" not in code[match.end():end]:
            add(match.end(), end - 1, "!(" + source[match.end():end - 1] + ")", "negated")
    # An assignment or a call that stands alone.
    for match in re.finditer(r"(?m)^[ ]+((?:\*?[\w.\[\]>-]+ [-+*/|&^]?= |\+\+|--|[\w.:>-]+\()[^;{}]*);", code):
        text = match.group(1)
        before = code[:match.start(1)].rstrip()
        if text.startswith(("return", "break", "continue", "fail(", "throw")) or not before.endswith(("{", "}", ";", ")", "else")):
            continue
        add(match.start(1), match.end(), ";", "dropped")
    # Two neighbours of a call that look alike.
    for match in re.finditer(r"\b(?!if\b|for\b|while\b|switch\b|return\b|catch\b|sizeof\b)\w+\(", code):
        end = closing(code, match.end() - 1)
        if end < 0:
            continue
        if match.group(0)[:-1] in COMMUTATIVE:
            continue
        places = arguments(code, match.end(), end - 1)
        for (a, b), (c, d) in zip(places, places[1:]):
            first, second = source[a:b].strip(), source[c:d].strip()
            if first != second and re.fullmatch(r"[\w.]+", first) and re.fullmatch(r"[\w.]+", second):
                add(a, d, f"{second}, {first}", "swapped")
    return sorted(found, key=lambda m: (m.begin, m.end, m.operator, m.text))
