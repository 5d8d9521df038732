"""Lists every message of the program, and checks its wording: the phrases of words.toml and the rules below.

    messages_test.py [--list FILE] [PATH…]      writes the list to FILE ('-': prints it); only sources at or below these paths

Read the list aloud after a change: a message is good if a user who meets it once knows what to do.
"""

import pathlib
import re
import sys
import unittest

import messages
import words_test

ROOT = words_test.ROOT
SOURCES = (".cpp", ".h")

# (kinds, pattern that a message must not match, what to write instead, a message that breaks the rule, one that keeps it)
RULES = [
    ("error status", r"^(cannot|could not|failed|unable|invalid|please|error)\b", "begin with the thing: 'image 'x' cannot be read'",
     "cannot read image '{}': {}", "image '{}' cannot be read: {}"),
    ("error status", r"^[^\n.;]*[^.…\n]\.$", "no full stop at the end of a line that is not a sentence of several",
     "column '{}' is missing.", "column '{}' is missing"),
    ("error status window", r"`\{\}`|\"\{\}|“|‹", "quote values as '{}'; `…` is for commands", "got \"{}\", expected a number", "got '{}', expected a number"),
    ("error status window help text", r"\b(can't|won't|don't|doesn't|isn't|aren't|didn't|couldn't)\b", "write it out", "the file can't be read", "the file cannot be read"),
    ("error status window", r"[A-Za-z]!( |$)", "no exclamation mark", "the disk is full!", "the disk is full"),
    ("error status window help text", r"\b([a-z]+) \1\b", "a word appears twice", "the the file", "the file"),
    ("error status", r"^(?!.*(\ballowed\b|\bexpected\b|\bexceeds\b|, but |, which |, and |\btwice\b|\bwithout\b|;|\bmore than\b|\{\}$)).*: got .{12,}$",
     "after 'got', state what is allowed or expected", "--size: got '{}' instead of a size", "--size: got '{}', allowed: WIDTHxHEIGHT"),
    ("error status", r"^(?!World|Terrain|Composite|Mesh)[A-Z][a-z]+[ :](?!\d)", "begin in lower case, except names", "Column '{}' is missing", "column '{}' is missing"),
    ("error status window help text", r"[a-z]  +[a-z]", "one blank", "the  file", "the file"),
]
# Names that begin a message, and texts whose indent is a layout.
EXCEPTIONS = re.compile(r"^(Created the project|Dear ImGui)|\n {2,}|mapfile|  \{:")


def listed(below):
    """(source's name, message) of every message of the program and of its page."""
    for path in words_test.files(below):
        name = str(path.relative_to(ROOT))
        if path.suffix == ".js" and name.startswith("reports/page/"):
            yield from ((name, messages.Message(line, "page", text)) for line, text, _ in words_test.texts(path))
        if path.suffix not in SOURCES or not name.startswith(("methods/", "bench/")) or words_test.is_test(name):
            continue
        if re.search(r"(_fixture|test_\w+)\.h$", name):
            continue
        for message in messages.messages(path.read_text()):
            yield name, message


def broken(message):
    if EXCEPTIONS.search(message.text):
        return
    text = message.text.strip("\n").removeprefix("{}") if message.kind == "status" else message.text
    for kinds, pattern, better, _, _ in RULES:
        if message.kind in kinds.split() and re.search(pattern, text):
            yield better
    for pattern, rule in words_test.PATTERNS:
        if "only" not in rule and pattern.search(message.text):
            yield f"better {rule['better']}"


def kinds_of(source):
    return [(message.kind, message.text) for message in messages.messages(source)]


class Messages(unittest.TestCase):
    below, file = [], None

    def test_each_rule_finds_its_plant(self):
        for kinds, pattern, better, plant, good in RULES:
            with self.subTest(rule=better):
                self.assertRegex(plant, pattern)
                self.assertNotRegex(good, pattern)

    def test_messages_are_found_as_they_are_printed(self):
        self.assertEqual(kinds_of('throw InputError("--out: got \'" + options.out[0] + "\', allowed: a file");'),
                         [("error", "--out: got '{}', allowed: a file")])
        self.assertEqual(kinds_of('return fmt::format("a long "  // why\n   "text of {}", name(a, "b"));'), [("text", "a long text of {}")])
        self.assertEqual(kinds_of('if (a) std::cerr << "note: " << left.size() << " runs are left out\\n";'),
                         [("status", "note: {} runs are left out\n")])
        self.assertEqual(kinds_of('/* "not a text" */ fail(R"(raw text)");'), [("error", "raw text")])
        self.assertEqual(kinds_of('row(isOn ? "Save volume" : "Keep volume");'), [("window", "Save volume"), ("window", "Keep volume")])
        self.assertEqual(kinds_of("#include \"a b\"\nx = 'a' + '\"' + f(\"one two\");"), [("text", "one two")])

    def test_every_message_keeps_the_rules(self):
        everything = list(listed(self.below))
        if self.file:
            lines = [f"{name}:{message.line} [{message.kind}] {message.text!r}\n" for name, message in everything]
            (sys.stdout.write if self.file == "-" else pathlib.Path(self.file).write_text)("".join(lines))
        if not self.below:
            self.assertGreater(len(everything), 2000)
        found = [f"{name}:{message.line}: {message.text!r}: {better}" for name, message in everything for better in broken(message)]
        self.assertEqual(found, [], f"{len(found)} messages:\n" + "\n".join(found))


if __name__ == "__main__":
    given = sys.argv[1:]
    if given[:1] == ["--list"]:
        Messages.file, given = given[1], given[2:]
    Messages.below = [(pathlib.Path.cwd() / path).resolve() for path in given]
    unittest.main(argv=sys.argv[:1])
