"""The report's page in a real browser, and its charts as files.

    report_page_test.py DUSTBENCH [TEST …]
"""

import glob
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import made_folder
import page_case
from report_charts_test import ReportCharts  # noqa: F401, found by unittest
from report_machines_test import PageOfSeveralMachines, ReportOfSeveralMachines  # noqa: F401
from report_names_test import ReportNames  # noqa: F401
from report_opening_test import ReportOpening  # noqa: F401
from report_published_test import ReportPublished  # noqa: F401
from report_words_test import ReportWords  # noqa: F401


class ReportPage(page_case.PageCase):
    def test_opens_quickly_without_a_word_in_the_console(self):
        # The best of three, so that a busy machine does not fail the test.
        self.assertLess(min(self.open() for _ in range(3)), 2)
        self.assertEqual(self.browser.errors, [])
        self.assertTrue(self.browser.evaluate("document.title").startswith("David N. Carr, Jim Geyer (2006): Variants of"))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('img:not(.picture-stage img), main script').length"), 0)

    def test_says_what_is_missing_and_what_failed(self):
        said = self.browser.evaluate("document.querySelector('.problems').textContent")
        for part in ("1 of ", "not done", "moon_phase"):
            self.assertIn(part, said)
        self.assertRegex(said, r"frame times of \d+ runs cannot be read")
        self.assertIn("it said " + made_folder.EVIL, self.browser.evaluate("document.getElementById('not-done').textContent"))
        self.assertIn(made_folder.EVIL, self.browser.evaluate("document.getElementById('warnings').textContent"))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#warnings tbody tr').length"), 1)

    def test_pictures_slide_and_take_turns(self):
        self.touch()
        state = "getComputedStyle(document.querySelector('.right-image')).clipPath"
        before = self.browser.evaluate(state)
        self.assertIn("50%", before)
        self.browser.evaluate("(() => { const wipe = document.querySelector('.wipe'); wipe.value = 200; wipe.dispatchEvent(new Event('input')); })()")
        self.assertIn("20%", self.browser.evaluate(state))
        self.assertTrue(self.browser.evaluate("[...document.querySelectorAll('.picture-stage img')].every(image => image.naturalWidth === 320)"))
        self.assertEqual(self.browser.evaluate("document.querySelector('.left-name').textContent"), "reference")
        self.browser.evaluate("(() => { const frame = document.querySelector('input.frame'); frame.value = 0; frame.dispatchEvent(new Event('input')); })()")
        self.assertEqual(self.browser.evaluate("document.querySelector('.frame-text').textContent"), "0")
        self.browser.evaluate("(() => { const mode = document.querySelector('select.mode'); mode.value = 'flicker'; mode.dispatchEvent(new Event('change')); })()")
        seen = "document.querySelector('.right-image').style.visibility"
        first = self.browser.evaluate(seen)
        self.browser.wait_for(f"{seen} !== {json.dumps(first)}", 5)

    def test_the_first_screen_says_how_far_to_trust_it_and_what_is_faster(self):
        self.assertTrue(self.browser.evaluate("document.getElementById('title').textContent").startswith("Variants of a New Volumetric Model"))
        trust = self.browser.evaluate("document.querySelector('.trust').innerText")
        count = len(self.rows)
        for part in ("quick run", "5 seeds, 6 repetitions", f"{count} of {count + 4} runs with warnings", "software renderer: llvmpipe",
                     f"1 of {count + 4} runs not completed"):
            self.assertIn(part, trust)
        answers = self.browser.evaluate("document.querySelector('.answers').textContent")
        self.assertIn("octree_recursive has a shorter build time than octree_search", answers)
        self.assertRegex(answers, r"0\.\d+× that of octree_search; 95\u00a0% interval 0\.\d+× to 0\.\d+×, 6 paired rounds")

    def test_a_claim_reads_like_a_review(self):
        said = self.browser.evaluate("document.querySelector('[data-claim=R2a]').innerText")
        for part in ("Build time, octree_recursive / octree_search (mode paper): 0.8", "×]; true if 0.98× or less", "octree_recursive / octree_search",
                     "95\u00a0% interval over 6 repetitions", "320×240 pixels", "Control", "would change it", "would refute it"):
            self.assertIn(part, said)
        ticks = self.browser.evaluate("[...document.querySelectorAll('[data-claim=R2a] .claim-range text')].map(text => text.textContent)")
        self.assertGreaterEqual(len(ticks), 2, ticks)
        # The list of its runs opens below it, over the full width.
        self.touch()
        self.browser.evaluate("[...document.querySelectorAll('[data-claim=R2a] details')].at(-1).open = true")
        runs, claim = self.browser.evaluate("""['[data-claim=R2a] .runs', '[data-claim=R2a]'].map(what => document.querySelector(what).clientWidth)""")
        self.assertGreater(runs, 0.95 * claim)

    def test_the_overview_is_sorted_and_filtered(self):
        self.touch()
        rows = "[...document.querySelectorAll('#overview tbody tr')].map(row => [row.cells[0].textContent, row.cells[1].textContent, row.cells[2].textContent])"
        self.browser.evaluate("document.querySelector('.more-rows').click()")
        all_rows = self.browser.evaluate(rows)
        self.assertNotIn("null_method", " ".join(row[0] for row in all_rows))
        for direction in (-1, 1):
            self.browser.evaluate("document.querySelector('#overview [data-key=fps_avg]').click()")
            rates = [float(row[2].replace(",", "")) for row in self.browser.evaluate(rows)]
            self.assertEqual(rates, sorted(rates, reverse=direction < 0))
        self.browser.evaluate("document.querySelector('#overview [data-key=world]').click()")
        particles = [int(row[1].split()[1].strip(",")) for row in self.browser.evaluate(rows) if row[1].startswith("particles")]
        self.assertEqual(particles, sorted(particles), "numbers in texts must sort as numbers")
        self.browser.evaluate("(() => { const filter = document.querySelector('.filter'); filter.value = 'BILLBOARD speed 40'; filter.dispatchEvent(new Event('input')); })()")
        kept = self.browser.evaluate(rows)
        self.assertTrue(0 < len(kept) < len(all_rows))
        self.assertTrue(all("billboard" in row[0] and "speed" in row[1] for row in kept))

    def test_a_link_shows_what_its_sender_saw(self):
        self.touch()
        self.choose("chart-carr2006-compare-quick", "column", "gpu_bytes")
        self.browser.evaluate("document.querySelector('.chip[data-method=billboard]').click()")
        self.browser.evaluate("document.querySelector('.links a[href=\"#quality\"]').click()")
        self.settled()
        before = self.browser.evaluate("document.querySelector('#chart-carr2006-compare-quick').textContent")
        hash = self.browser.evaluate("window.location.hash")
        self.assertTrue(hash.startswith("#quality?"), hash)
        self.browser.call("Page.navigate", url="about:blank")
        self.browser.open_at(self.page, hash)
        self.settled()
        self.assertIn("GPU memory", before)
        self.assertEqual(self.browser.evaluate("document.querySelector('#chart-carr2006-compare-quick').textContent"), before)
        self.assertEqual(self.browser.evaluate("document.querySelector('.chip[data-method=billboard]').getAttribute('aria-pressed')"), "false")

    def test_pictures_open_on_the_worst_with_its_numbers(self):
        said = self.browser.evaluate("document.querySelector('.right-name').textContent")
        self.assertIn("levels 2", said)
        self.assertIn("PSNR 33.5 dB, SSIM 0.982, FLIP 0.5", said)
        self.assertEqual(self.browser.evaluate("document.querySelector('.left-name').textContent"), "reference")
        self.assertEqual(self.browser.evaluate("document.querySelector('.frame-text').textContent"), "15")
        self.assertIn("seed 4", self.browser.evaluate("document.querySelector('select.world').selectedOptions[0].text"))
        self.touch()
        self.assertTrue(self.browser.evaluate("document.querySelector('.colour-bar').hidden"))
        self.browser.evaluate("""(() => { const right = document.querySelector('select.right');
            right.value = [...right.options].find(option => option.text.startsWith('difference')).value; right.dispatchEvent(new Event('change')); })()""")
        self.assertFalse(self.browser.evaluate("document.querySelector('.colour-bar').hidden"))
        self.browser.evaluate("(() => { const mode = document.querySelector('select.mode'); mode.value = 'native'; mode.dispatchEvent(new Event('change')); })()")
        self.assertEqual(self.browser.evaluate("document.querySelector('.right-image').getBoundingClientRect().width"), 320)

    def test_a_picture_is_held_against_its_own_finer_setting(self):
        shown = self.browser.evaluate("""(() => {
            const source = 'data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw==';
            const picture = (label, flip) => ({ label, method: 'A', difference: false, source, numbers: flip ? { psnr_db: 30, ssim: 0.9, flip } : {} });
            const pictures = [picture('reference of A 1'), picture('A 1', 0.1), picture('reference of A 2'), picture('A 2', 0.2)];
            const set = (experiment, more) => ({ experiment, world: '', frame: 0, width: 4, height: 4, pictures: [...pictures, ...more] });
            const data = { pictures: [set('x', []), set('other', [picture('A 3', 0.9)])], heat: ['#000', '#fff'] };
            const viewer = pictureViewer.build({ data }, id => id, id => id === 'x');
            return ['world', 'left', 'right'].map(name => viewer.querySelector(`select.${name}`).selectedOptions[0].text);
        })()""")
        self.assertEqual(shown, ["x", "reference of A 2", "A 2"])

    def test_metrics_and_columns_are_explained_on_the_page(self):
        self.touch()
        self.browser.evaluate("window.location.hash = '#metrics'")
        self.browser.wait_for("document.querySelector('#metrics details').open", 5)
        first = self.browser.evaluate("[...document.querySelectorAll('#metrics tbody tr td:first-child')].map(cell => cell.textContent)")
        for name in ("psnr_db", "gaps", "self_similarity"):
            self.assertIn(name, first)
        columns = self.browser.evaluate("[...document.querySelectorAll('#schema tbody tr td:first-child')].map(cell => cell.textContent)")
        self.assertIn("method_ms_median", columns)
        self.assertEqual(self.browser.evaluate("[...document.querySelectorAll('#schema a[href^=\"#\"]')].filter(a => !document.getElementById(a.getAttribute('href').slice(1))).map(a => a.href)"), [])
        self.assertIn("summary.csv", self.browser.evaluate("[...document.querySelectorAll('.lead a')].map(link => link.getAttribute('href'))"))

    def test_dark_and_light_can_be_read(self):
        self.touch()
        for scheme in ("light", "dark"):
            self.browser.prefer(scheme)
            self.browser.wait_for(f"document.documentElement.dataset.theme === '{scheme}'")
            self.settled()
            worst = self.browser.evaluate(page_case.CONTRAST)
            self.assertGreaterEqual(worst[0][0], 4.5, f"{scheme}: {worst}")
        self.browser.evaluate("document.getElementById('theme').click()")
        self.assertEqual(self.browser.evaluate("document.documentElement.dataset.theme"), "light")
        self.settled()

    def test_a_phone_needs_no_sideways_scrolling(self):
        self.touch()
        self.browser.resize(390, 844, mobile=True)
        self.browser.open(self.page)
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 390)

    def test_claims_turn_round_with_the_times(self):
        verdict = "document.querySelector('[data-claim=R2a] .verdict')?.textContent"
        self.assertEqual(self.browser.evaluate(verdict), "✓ confirmed")
        other = {"octree_recursive": "octree_search", "octree_search": "octree_recursive"}
        times = {}
        for row in self.rows:
            key = (row["method"], row.get("p.particles"), row.get("p.speed"), row.get("p.layout"), row.get("p.depth"), row["repetition"], row["width"], "flip" in row)
            times[key] = row["build_ms_median"]
        swapped = [row | {"build_ms_median": times.get((other.get(row["method"]), row.get("p.particles"), row.get("p.speed"), row.get("p.layout"),
                                                        row.get("p.depth"), row["repetition"], row["width"], "flip" in row), row["build_ms_median"])} for row in self.rows]
        made_folder.rewrite_runs(self.folder, swapped)
        try:
            said = self.report("--text")
            self.assertRegex(said, r"R2a +refuted")
            self.report()
            self.browser.open(self.page)
            self.assertEqual(self.browser.evaluate(verdict), "✗ refuted")
        finally:
            self.touch()
            made_folder.rewrite_runs(self.folder, self.rows)
            self.report()

    def test_reproduce_ends_with_a_page_of_what_it_measured(self):
        place = tempfile.mkdtemp(prefix="dustbench-tiny-")
        self.addCleanup(shutil.rmtree, place)
        data = os.path.join(place, "data")
        shutil.copytree(os.path.join(os.path.dirname(__file__), "..", "..", "data"), data)
        for name, text in made_folder.TINY_PAPER.items():
            file = os.path.join(data, "papers", "tiny", name)
            os.makedirs(os.path.dirname(file), exist_ok=True)
            with open(file, "w", encoding="utf-8") as stream:
                stream.write(text)
        out = os.path.join(place, "out")
        def reproduce(size):
            called = subprocess.run([page_case.PROGRAM, "reproduce", "--paper", "tiny", size, "--out", out], capture_output=True, text=True,
                                    env=os.environ | {"DUSTBENCH_DATA": data})
            self.assertEqual(called.returncode, 0, called.stderr)
            return called

        full = reproduce("--full").stderr
        self.assertRegex(full.partition("run 1 of 2")[0], r"estimate: \d+ s for 2 runs")
        self.assertRegex(full, r"run 1 of 2: .*; about \d+ s left")
        # The estimate covers the remaining runs, and now there are none.
        self.assertIn("estimate: 0 s for 0 runs", reproduce("--full").stderr)
        called = reproduce("--quick")
        self.assertNotIn("estimate", called.stderr)
        self.assertIn(os.path.join(out, "index.html"), called.stdout)
        self.touch()
        self.browser.open(os.path.join(out, "index.html"))
        marks = self.marks()
        self.assertEqual(set(marks), {"chart-tiny-loads", "chart-tiny-loads-stages", "chart-frames"})
        self.assertTrue(all(marks.values()), marks)
        self.assertIn("✓ confirmed", self.browser.evaluate("document.getElementById('claims').textContent"))
        self.assertRegex(self.browser.evaluate("document.getElementById('claims').textContent"), r"refuted, as expected \(1\.\d+×: for each particle there is one\)")
        self.assertTrue(self.browser.evaluate("[...document.querySelectorAll('.picture-stage img')].every(image => image.naturalWidth === 96)"))

    def test_reproducing_all_papers_ends_with_an_index_of_them(self):
        # A copy of the program with data of two papers that take seconds.
        place = tempfile.mkdtemp(prefix="dustbench-papers-")
        self.addCleanup(shutil.rmtree, place)
        program = os.path.join(place, "build", "release", "dustbench")
        os.makedirs(os.path.dirname(program))
        shutil.copy(page_case.PROGRAM, program)
        # Libraries that are loaded at run time are next to the program.
        for library in glob.glob(os.path.join(os.path.dirname(page_case.PROGRAM), "libdustbench_*.so")):
            shutil.copy(library, os.path.dirname(program))
        os.symlink(os.path.join(page_case.ROOT, "reports"), os.path.join(place, "reports"))
        data = os.path.join(place, "data")
        shutil.copytree(os.path.join(page_case.ROOT, "data"), data, ignore=shutil.ignore_patterns("papers"))
        for paper in ("tiny", "other"):
            for name, text in made_folder.TINY_PAPER.items():
                file = os.path.join(data, "papers", paper, name.replace("tiny", paper))
                os.makedirs(os.path.dirname(file), exist_ok=True)
                with open(file, "w", encoding="utf-8") as stream:
                    stream.write(text.replace("tiny", paper).replace("[100, 300]", "[100, 300]" if paper == "tiny" else "[150, 450]"))
        out = os.path.join(place, "out")

        def reproduce():
            libraries = os.path.dirname(page_case.PROGRAM) + ":" + os.environ.get("LD_LIBRARY_PATH", "")
            return subprocess.run([program, "reproduce", "--quick", "--out", out], capture_output=True, text=True,
                                  env=os.environ | {"LD_LIBRARY_PATH": libraries, "DUSTBENCH_DATA": ""})

        called = reproduce()
        self.assertEqual(called.returncode, 0, called.stderr)
        index = os.path.join(out, "index.html")
        self.assertIn(index, called.stdout)
        self.touch()
        self.browser.open(index)
        rows = self.browser.evaluate("[...document.querySelectorAll('tbody tr')].map(row => row.innerText)")
        self.assertEqual(len(rows), 2)
        for row in rows:
            self.assertIn("Nobody (2026): A very short paper", row)
            self.assertIn("1 confirmed", row)
            self.assertIn("2 of 2", row)
        for link in self.browser.evaluate("[...document.querySelectorAll('tbody a')].map(link => link.getAttribute('href'))"):
            self.assertTrue(os.path.exists(os.path.join(out, link)), link)
        # A page that dustbench did not write is detected before the first run.
        with open(index, "w", encoding="utf-8") as stream:
            stream.write("<html>my garden</html>")
        shutil.rmtree(os.path.join(out, "tiny"))
        called = reproduce()
        self.assertEqual(called.returncode, 3)
        self.assertIn("not written by dustbench", called.stderr)
        self.assertFalse(os.path.exists(os.path.join(out, "tiny", "runs")))


if __name__ == "__main__":
    page_case.PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
