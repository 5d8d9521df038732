"""Finds the messages in the sources of the program: what it prints, and the texts of its window.

A message is an expression of C++ with at least one string literal: neighbouring literals and sums are joined, and every other
operand becomes `{}`. The code around it decides its kind.
"""

import dataclasses
import re

# Calls around a literal that make it an error, a text of the window or a help text.
ERROR = re.compile(r"(Error|_error|invalid_argument|refuse\w*|refused|cannot\w*|missing|unexpected|unknownName|fail)$")
WINDOW = re.compile(r"ImGui::|^(show(Text|Remark|List|Slider|Switch|Caption|Chart)|button|section|change|row)$")
HELP = re.compile(r"(add_(option|flag|subcommand)\w*|footer|description|option|flag|integer|real|choice|boolean|text|Parameter\w*|parameter)$")
STREAMS = {"std::cerr", "std::cout"}
ENDS_LINE = {"std::endl", "std::flush"}
SPEAKS = re.compile(r"[A-Za-z]{2,}[^\w\s]* +[^\s{]|[A-Za-z]{2,}[,:;]? \{")


@dataclasses.dataclass(frozen=True)
class Message:
    line: int
    kind: str  # error, status, window, help, text, or page (found elsewhere)
    text: str


def tokens(source):
    """(line, kind, text) with kind string, word or sign; comments, directives and white space are left out."""
    pattern = re.compile(
        r'(?P<skip>//[^\n]*|/\*.*?\*/|^[ \t]*#[^\n]*|\s+)|(?:R"(?P<mark>[^(]*)\((?P<raw>.*?)\)(?P=mark)")|"(?P<string>(?:[^"\\\n]|\\.)*)"'
        r"|(?P<char>'(?:[^'\\\n]|\\.)+')|(?P<word>[A-Za-z_][\w]*(?:::[A-Za-z_]\w*)*)|(?P<number>\d[\w.']*)|(?P<sign><<|->|&&|\|\||==|\S)", re.S | re.M)
    line = 1
    for found in pattern.finditer(source):
        kind = found.lastgroup
        if kind == "raw" or found["raw"] is not None:
            yield line, "string", found["raw"]
        elif kind == "string":
            yield line, "string", re.sub(r"\\(.)", lambda escape: {"n": "\n", "t": "\t"}.get(escape[1], escape[1]), found["string"])
        elif kind == "char":
            yield line, "string" if len(found["char"]) == 3 else "sign", found["char"][1:-1] if len(found["char"]) == 3 else found["char"]
        elif kind != "skip":
            yield line, "word" if kind == "word" else "sign", found[0]
        line += found[0].count("\n")


def ends(sign):
    return sign in {",", ")", "]", "}", ";", "?", ":", "==", "&&", "||", "{"}


def joined(parsed, first):
    """The text of a sum that begins at a literal, and the indices of its literals."""
    text, at, used = parsed[first][2], first + 1, {first}
    while at < len(parsed):
        _, kind, sign = parsed[at]
        if kind == "string":
            used.add(at)
            text, at = text + sign, at + 1
        elif sign in {"+", "<<"}:
            at += 1
            if at < len(parsed) and parsed[at][1] == "string":
                continue
            depth = 0
            while at < len(parsed):
                sign = parsed[at][2] if parsed[at][1] != "string" else ""
                if depth == 0 and (ends(sign) and sign != "{" or sign in {"+", "<<"}):
                    break
                depth += (sign in {"(", "[", "{"}) - (sign in {")", "]", "}"})
                at += 1
            text += "" if parsed[at - 1][2] in ENDS_LINE else "{}"
        else:
            break
    return text, used


def kind_of(around, statement):
    """`around`: the calls that contain the literal, outermost first; `statement`: the words before it in its statement."""
    if statement[:1] == ["throw"] or any(ERROR.search(call) for call in around):
        return "error"
    if STREAMS & set(statement):
        return "status"
    if any(WINDOW.search(call) for call in around):
        return "window"
    if any(HELP.search(call) for call in around):
        return "help"
    return "text"


def messages(source):
    parsed = list(tokens(source))
    around, statement, used = [], [], set()
    for at, (line, kind, text) in enumerate(parsed):
        if kind == "string":
            if at in used:
                continue
            message, literals = joined(parsed, at)
            used |= literals
            before = parsed[at - 1][2] if at else ""
            if before == "+" or (before == "<<" and parsed[at - 2][2] not in STREAMS):
                message = "{}" + message
            kind = kind_of([call for call in around if call], statement)
            if SPEAKS.search(message) or (kind == "window" and message[:1].isalpha()):
                yield Message(line, kind, message)
        elif text in {"(", "[", "{"}:
            around.append(parsed[at - 1][2] if at and parsed[at - 1][1] == "word" else "")
            if text == "{":
                statement = []
        elif text in {")", "]", "}"}:
            if around:
                around.pop()
            if text == "}":
                statement = []
        elif text == ";":
            statement = []
        elif kind == "word":
            statement.append(text)
