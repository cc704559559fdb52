"""What is changed: every place in a source file, and the ways in which each may be changed."""
import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Change:
    file: str
    line: int
    kind: str
    before: str  # the line, without indentation
    after: str

    def key(self):
        return self.file, self.before, self.after

    def apply(self, text):
        lines = text.split("\n")
        whole = lines[self.line - 1]
        lines[self.line - 1] = whole[:len(whole) - len(whole.lstrip())] + self.after
        return "\n".join(lines)


SWAPS = [
    ("relation", {" < ": [" <= ", " >= "], " <= ": [" < ", " > "], " > ": [" >= ", " <= "], " >= ": [" > ", " < "],
                  " == ": [" != "], " != ": [" == "]}),
    ("arithmetic", {" + ": [" - "], " - ": [" + "], " * ": [" / "], " / ": [" * "], " % ": [" * "],
                    " << ": [" >> "], " >> ": [" << "], " & ": [" | "], " | ": [" & "], " ^ ": [" & "],
                    " += ": [" -= ", " = "], " -= ": [" += ", " = "], "++": ["--"], "--": ["++"]}),
    ("logic", {" && ": [" || "], " || ": [" && "], "true": ["false"], "false": ["true"]}),
    ("table", {"Reaction::off": ["Reaction::ramp"], "Reaction::ramp": ["Reaction::off"],
               "Permission::open": ["Permission::brake", "Permission::drive"],
               "Permission::brake": ["Permission::open", "Permission::drive"],
               "Permission::drive": ["Permission::open", "Permission::brake"],
               "rule_detail::kPowered": ["rule_detail::kAlways", "0"],
               "rule_detail::kAlways": ["rule_detail::kPowered", "0"]}),
]
STATES = ["boot", "disarmed", "armed", "driving", "stopping", "fault", "kNo"]
SIDES = re.compile(r"(?<![A-Za-z])(left|right)(?![a-z])|\bc_[LR]\b")
OTHER_SIDE = {"left": "right", "right": "left", "c_L": "c_R", "c_R": "c_L"}
INTEGER = re.compile(r"(?<![\w.'])(0x[0-9A-Fa-f']+|\d[\d']*)(?![\w.'])")
REAL = re.compile(r"(?<![\w.'])\d+\.\d+(?![\w.'])")
NEGATION = re.compile(r"(?<![\w)\]=])!(?=[\w(])")
MINUS = re.compile(r"(?:(?<=[({,])|(?<=[=?:,] )|(?<=return ))-(?=[A-Za-z(])")
STATEMENT = re.compile(r"(?:\+\+|--)?(?!return\b|using\b|break\b|continue\b|default\b|case\b|else\b)[A-Za-z_]\w*"
                       r"(?:(?:\.|->|::)\w+|\[[^\]]*\]|\([^;]*\))*\s*(?:[-+*/|&^%]?=(?!=)[^;]*|\+\+|--)?;")
GUARDED = re.compile(r"(?:else )?if \(.*\) [^{]*;")
LISTED = re.compile(r"(?:State|Param|protocol|CheckIn::Task)::\w+(?:::kId)?(?:, ?|(?=[)}]))")
NOT_CODE = ("#", "static_assert", "template", "using ", "namespace", "friend", "class ", "enum ", "requires", "case ",
            "public:", "private:", "protected:")


def without_comments_and_strings(text):
    """Same length and lines, so that places are the same."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'(?!\w)', blank, text, flags=re.S)


def other_integers(text):
    value = int(text.replace("'", ""), 0)
    tenth = value // 10
    others = [value + 1, value - 1] if value <= 64 else [value + tenth, value - tenth]
    return [str(v) for v in dict.fromkeys(others + [0, 2 * value]) if v >= 0 and v != value]


def closing(code, at):
    depth = 0
    for i in range(at, len(code)):
        depth += (code[i] == "(") - (code[i] == ")")
        if depth == 0:
            return i
    return -1


def sites_in_line(line, code):
    """(kind, the lines that it may become) for each place."""
    at = lambda begin, end, others: [line[:begin] + other + line[end:] for other in others]
    for kind, table in SWAPS:
        for text, others in table.items():
            word = rf"\b{text}\b" if text[0].isalpha() else re.escape(text)
            for match in re.finditer(word, code):
                yield kind, at(*match.span(), others)
    for match in INTEGER.finditer(code):
        yield "constant", at(*match.span(), other_integers(match.group()))
    for match in REAL.finditer(code):
        yield "constant", at(*match.span(), [f"2 * {match.group()}", "0.0"])
    for match in NEGATION.finditer(code):
        yield "condition", at(*match.span(), [""])
    for match in MINUS.finditer(code):
        yield "arithmetic", at(*match.span(), [""])
    for match in SIDES.finditer(code):
        yield "side", at(*match.span(), [OTHER_SIDE[match.group()]])
    for match in LISTED.finditer(code):
        if re.search(r"states\(|\{|^\s*(?:Param|protocol)::", code):
            yield "table", at(*match.span(), [""])
    if re.match(r"\s*/\* \w+ +\*/ \{", line):
        for match in re.finditer("|".join(rf"\b{state}\b" for state in STATES), code):
            yield "table", at(*match.span(), [state for state in STATES if state != match.group()])
    for match in re.finditer(r"\b(if|while) \(", code):
        end = closing(code, match.end() - 1)
        if end > 0:
            condition = line[match.end():end]
            yield "condition", [f"{line[:match.end()]}!({condition}){line[end:]}"]
    match = re.match(r"(.*\breturn )([^;{}][^;]*);$", code.rstrip())
    if match and match.group(2) not in ("true", "false"):
        yield "result", at(match.start(2), match.end(2), ["{}", f"!({line[match.start(2):match.end(2)]})"])
    if STATEMENT.fullmatch(code.strip()) or GUARDED.fullmatch(code.strip()):
        yield "deleted", [line[:len(line) - len(line.lstrip())] + ";"]


def changes_in(file, text):
    """A list of alternatives for each place."""
    sites = []
    code_lines = without_comments_and_strings(text).split("\n")
    in_assertion = False
    for number, (line, code) in enumerate(zip(text.split("\n"), code_lines), start=1):
        in_assertion = in_assertion or code.strip().startswith("static_assert")
        skipped = in_assertion or not code.strip() or code.strip().startswith(NOT_CODE)
        if in_assertion and code.rstrip().endswith(";") and not code.startswith("    "):
            in_assertion = False
        if skipped:
            continue
        for kind, lines in sites_in_line(line, code):
            alternatives = [Change(file, number, kind, line.strip(), other.strip()) for other in dict.fromkeys(lines)
                            if other.strip() != line.strip()]
            if alternatives:
                sites.append(alternatives)
    return sites
