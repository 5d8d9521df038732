"""Documents, help texts and messages use plain, current English: no phrase of words.toml.

    words_test.py [PATH…]      only files at or below these paths (default: everything)

It reads the prose of documents, the comments and texts of TOML files, the texts in the sources of the program and of the page.
"""

import fnmatch
import pathlib
import re
import subprocess
import sys
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RULES = tomllib.loads((ROOT / "tests" / "documents" / "words.toml").read_text())
PATTERNS = [(re.compile(rule["find"], re.IGNORECASE), rule) for rule in RULES["phrase"]]
KINDS = ("*.md", "*.toml", "*.h", "*.cpp", "*.js", "*.html", "Makefile", "*.csv.in")


def files(below):
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *KINDS], cwd=ROOT, capture_output=True, text=True, check=True)
    for name in listed.stdout.splitlines():
        path = ROOT / name
        if path.exists() and (not below or any(path.is_relative_to(parent) for parent in below)):
            yield path


def is_test(name):
    return name.startswith("tests/") or name.endswith(("_test.cpp", "_bench.cpp")) or "/testing/" in name or "/test/" in name


def paragraphs(lines):
    """(first line's number, text) of neighbouring lines that are not empty."""
    block, first = [], 0
    for number, line in enumerate([*lines, ""], 1):
        if line.strip():
            first = first or number
            block.append(line.strip())
        elif block:
            yield first, " ".join(block)
            block, first = [], 0


def of_markdown(text):
    """Prose without code; rows of tables and items of lists count as paragraphs of their own."""
    text = re.sub(r"(?ms)^```.*?^```", lambda code: "\n" * code[0].count("\n"), text)
    text = re.sub(r"(?s)<!--.*?-->", lambda comment: "\n" * comment[0].count("\n"), text)
    text = re.sub(r"(?s)`[^`]*`", lambda code: "`…`" + "\n" * code[0].count("\n"), text)
    lines = [re.sub(r"\]\([^)]*\)", "]", line) for line in text.splitlines()]
    separate = re.compile(r"\s*(\||[-*] |\d+\. |#|>)")
    spread = []
    for number, line in enumerate(lines, 1):
        if separate.match(line) and spread and spread[-1][1].strip():
            spread.append((number, ""))
        spread.append((number, line))
    numbers = [number for number, _ in spread]
    for first, paragraph in paragraphs([line for _, line in spread]):
        yield numbers[first - 1], paragraph, "table" if paragraph.startswith("|") else "prose"


def of_strings(text, quotes):
    """The texts of a source that read like words: two of them at least. Neighbouring literals of C++ are one text."""
    joined = re.sub(r'"\s*\n\s*"', lambda gap: "\0" * gap[0].count("\n"), text) if quotes == '"' else text
    number = 1
    for line in joined.split("\n"):
        code = re.sub(r"(?<!:)//.*$", "", line) if '"' not in line else line
        for quote in quotes:
            for literal in re.findall(rf"{quote}((?:[^{quote}\\]|\\.)*){quote}", code):
                if re.search(r"[a-z]+ [a-z]+", literal):
                    yield number, literal.replace("\0", ""), "text"
        number += 1 + line.count("\0")


def of_toml(text):
    lines = text.splitlines()
    yield from ((number, paragraph, "comment") for number, paragraph in paragraphs([line.strip()[1:] if line.strip().startswith("#") else "" for line in lines]))
    yield from of_strings(text, '"')


def of_html(text):
    bare = re.sub(r"(?s)<(script|style).*?</\1>|<[^>]*>", lambda tag: "\n" * tag[0].count("\n") or " ", text)
    yield from ((number, paragraph, "text") for number, paragraph in paragraphs(bare.splitlines()))


def texts(path):
    text, name = path.read_text(), str(path.relative_to(ROOT))
    if path.suffix == ".md":
        return of_markdown(text)
    if is_test(name) or (path.suffix == ".html" and "sample" in path.parts):
        return ()
    if path.suffix == ".toml":
        return of_toml(text)
    if path.suffix == ".html":
        return of_html(text)
    if path.name == "Makefile":
        return ((number, line.split("## ")[1], "text") for number, line in enumerate(text.splitlines(), 1) if "## " in line)
    return of_strings(text, "'`\"" if path.suffix == ".js" else '"')


def is_exception(name, text):
    return any(fnmatch.fnmatch(name, rule["in"]) and rule["text"] in text for rule in RULES["exception"])


def found_in(path):
    name = str(path.relative_to(ROOT))
    for number, text, kind in texts(path):
        for pattern, rule in PATTERNS:
            if rule.get("only", kind) != kind:
                continue
            match = pattern.search(text)
            if match and not is_exception(name, text):
                yield f"{name}:{number}: '{match[0][:60]}': better {rule['better']}"


class Words(unittest.TestCase):
    below = []

    def test_each_pattern_finds_its_plant(self):
        for pattern, rule in PATTERNS:
            with self.subTest(find=rule["find"]):
                self.assertRegex(rule["plant"], pattern)
                if "but" in rule:
                    self.assertNotRegex(rule["but"], pattern)

    def test_exceptions_have_reasons_and_uses(self):
        for rule in RULES["exception"]:
            with self.subTest(exception=rule["text"]):
                self.assertTrue(rule["reason"])
                used = [path for path in files([]) if fnmatch.fnmatch(str(path.relative_to(ROOT)), rule["in"])]
                self.assertTrue(any(rule["text"] in path.read_text() for path in used), "no longer needed")

    def test_no_text_has_a_phrase(self):
        found = [line for path in files(self.below) for line in found_in(path)]
        self.assertEqual(found, [], f"{len(found)} phrases:\n" + "\n".join(found))


if __name__ == "__main__":
    Words.below = [(pathlib.Path.cwd() / given).resolve() for given in sys.argv[1:]]
    unittest.main(argv=sys.argv[:1])
