"""Checks the documents: links and paths exist, the README is short, each guide says what it is for and shows one command and its
duration on its first screen, and the README's table is that of the sample report.

    documents_test.py
"""

import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
GUIDES = sorted((ROOT / "reports" / "guide").glob("*.md"))
FIRST_SCREEN = 30  # lines


def tracked(*patterns):
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *patterns], cwd=ROOT, capture_output=True, text=True)
    if listed.returncode == 0 and listed.stdout:
        return [ROOT / name for name in listed.stdout.splitlines() if (ROOT / name).exists()]
    found = (path for pattern in patterns for path in ROOT.rglob(pattern))
    return [path for path in found if not {"build", "out"} & set(path.relative_to(ROOT).parts)]


def documents():
    return tracked("*.md")


def prose(text):
    """Without fenced and indented blocks."""
    return re.sub(r"(?m)^(    |\t).*$", "", re.sub(r"(?ms)^```.*?^```", "", text))


def anchors(path):
    found = set()
    for heading in re.findall(r"(?m)^#+ +(.*)$", re.sub(r"(?ms)^```.*?^```", "", path.read_text())):
        plain = re.sub(r"[`*]|\[|\]\([^)]*\)", "", heading).strip().lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).replace(" ", "-"))
    return found


class Documents(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for document in documents():
            text = prose(document.read_text())
            links = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'src="([^"]+)"', text)
            for link in links:
                if re.match(r"[a-z]+:", link):
                    continue
                path, _, anchor = link.partition("#")
                target = (document.parent / path).resolve() if path else document
                with self.subTest(document=str(document.relative_to(ROOT)), link=link):
                    self.assertTrue(target.exists(), "the target does not exist")
                    if anchor and target.suffix == ".md":
                        self.assertIn(anchor, anchors(target))

    def test_paths_in_text_exist(self):
        for document in documents():
            if document.name == "CHANGELOG.md" or document.parent.name == "decisions":
                continue  # they describe earlier states
            for path in re.findall(r"`((?:methods|bench|data|reports|tests|\.ci)/[\w./-]+)`", prose(document.read_text())):
                if path.startswith(("reports/out", "methods/dots", "data/suites/dots", "methods/kit/particles/parts/force/updraught",
                                    "bench/measure/image/coverage_metric", "bench/export/csv_format")):  # examples
                    continue
                with self.subTest(document=str(document.relative_to(ROOT))):
                    self.assertTrue((ROOT / path).exists(), f"{path} does not exist")

    def test_documents_that_sources_name_exist(self):
        names = {path.name for path in documents()}
        for source in tracked("*.md", "*.toml", "*.h", "*.cpp", "*.cmake", "*CMakeLists.txt", "*.py", "*.sh", "*.js", "*.html"):
            if "sample" in source.parts and source.suffix == ".html":
                continue
            text = re.sub(r"https?://\S+", "", source.read_text())
            for name in re.findall(r"(?<![\w*-])([\w-]+\.md)\b", text):
                with self.subTest(source=str(source.relative_to(ROOT))):
                    self.assertIn(name, names)

    def test_the_tables_of_papers_name_entries_and_tests_that_exist_and_every_entry(self):
        tests = {f"{suite}.{name}" for source in tracked("*_test.cpp")
                 for suite, name in re.findall(r"(?m)^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)", source.read_text())}
        claims = {folder.name: set(re.findall(r'(?m)^id = "(\w+)"', (folder / "claims.toml").read_text()))
                  for folder in (ROOT / "data" / "papers").iterdir() if (folder / "claims.toml").exists()}
        for paper, ids in claims.items():
            table = ROOT / "data" / "papers" / paper / "README.md"
            if not table.exists():
                continue
            text = table.read_text()
            with self.subTest(paper=paper):
                named = set(re.findall(r"`([A-Z]\w+\.[A-Z]\w+)`", text))
                self.assertEqual(named - tests, set(), "no such test")
                ours = {id for id in ids if id[-1] == "f" and id[:-1] in ids}  # an entry in our mode shares the sentence of the printed one
                self.assertEqual(ids - ours - set(re.findall(r"\b[A-Z]\d+[a-z]?\b", text)), set(), "entries without a sentence")
                mentioned = set(re.findall(r"\b[RP]\d+[a-z]\b", text))
                self.assertEqual(mentioned - set().union(*claims.values()), set(), "no such entry")

    def test_the_readme_is_short(self):
        self.assertLessEqual(len((ROOT / "README.md").read_text().splitlines()), 110)

    def test_each_guide_shows_one_command_and_its_duration_at_once(self):
        for guide in GUIDES:
            if guide.name == "README.md":
                continue
            screen = "\n".join(guide.read_text().splitlines()[:FIRST_SCREEN])
            with self.subTest(guide=guide.name):
                self.assertRegex(screen, r"(?m)^```sh$")
                self.assertRegex(screen, r"\d (s|minutes?)\b")

    def test_each_guide_begins_with_its_purpose(self):
        for guide in GUIDES:
            with self.subTest(guide=guide.name):
                first = guide.read_text().split("\n\n")[1]
                self.assertFalse(first.startswith(("```", "<!--", "|", "![", "- ")), "a sentence must say what the guide is for before the first command")

    def test_each_guide_is_in_the_list_of_guides(self):
        listed = (ROOT / "reports" / "guide" / "README.md").read_text()
        for guide in GUIDES:
            if guide.name != "README.md":
                self.assertIn(f"]({guide.name})", listed)

    def test_the_readme_has_the_table_of_the_sample_report(self):
        called = subprocess.run([sys.executable, "-B", ROOT / "reports" / "sample" / "make_sample.py", "--check"], capture_output=True, text=True)
        self.assertEqual(called.returncode, 0, called.stderr)


if __name__ == "__main__":
    unittest.main()
