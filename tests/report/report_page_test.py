"""The report's page in a real browser, and its charts as files.

    report_page_test.py DUSTBENCH

Needs Chromium (Debian: chromium-headless-shell), node and rsvg-convert; fails with a word where one is missing.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import browser
import made_folder

PROGRAM = ""
SUITES = ("carr2006-fig5", "carr2006-fig7", "carr2006-depth", "carr2006-compare", "carr2006-flaws")
# Contrast of text against its background, by WCAG 2: each text element with its own colour and the nearest background.
CONTRAST = """(() => {
    const parts = text => (text.match(/[\\d.]+/g) || []).map(Number);
    const light = ([r, g, b]) => [r, g, b].map(v => v / 255).map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
        .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
    const background = element => {
        for (let at = element; at; at = at.parentElement) {
            const colour = parts(getComputedStyle(at).backgroundColor);
            if (colour.length === 3 || colour[3] > 0.5) return colour;
        }
        return [255, 255, 255];
    };
    const found = [];
    for (const element of document.querySelectorAll('h1, h2, h3, p, td, th, a, button, select, .verdict, .chart text, summary')) {
        if (!element.textContent.trim() || !element.getClientRects().length) continue;
        const style = getComputedStyle(element);
        const svg = element.tagName === 'text';
        const [a, b] = [light(parts(svg ? style.fill : style.color)), light(background(element))].sort((x, y) => y - x);
        found.push([(a + 0.05) / (b + 0.05), element.textContent.trim().slice(0, 40)]);
    }
    return found.sort((x, y) => x[0] - y[0]).slice(0, 3);
})()"""
MARKS = """Object.fromEntries([...document.querySelectorAll('.chart')].map(chart => [chart.id,
    chart.querySelectorAll('.mark-symbol path, .mark-rect path, .mark-line path, .mark-rule line').length]))"""


class ReportPage(unittest.TestCase):
    touched = True

    @classmethod
    def setUpClass(cls):
        path = browser.find()
        if not path:
            raise RuntimeError("no Chromium: install the Debian package chromium-headless-shell (.ci/install browser)")
        cls.folder = os.path.join(tempfile.mkdtemp(prefix="dustbench-report-"), "a&b <i>")
        cls.addClassCleanup(shutil.rmtree, os.path.dirname(cls.folder))
        os.makedirs(cls.folder)
        cls.rows = made_folder.write(PROGRAM, cls.folder, SUITES)
        cls.page = cls.report().strip()
        cls.browser = cls.enterClassContext(browser.Browser(path))

    @classmethod
    def report(cls, *more):
        called = subprocess.run([PROGRAM, "report", cls.folder, *more], capture_output=True, text=True)
        if called.returncode:
            raise RuntimeError(called.stderr)
        return called.stdout

    def open(self):
        """Again, as it was first; gives the seconds that took."""
        self.browser.resize(1400, 1000)
        self.browser.prefer("light")
        ReportPage.touched = False
        return self.browser.open(self.page)

    def setUp(self):
        if self.touched:
            self.open()

    def touch(self):
        """Said by a test that leaves the page other than it was."""
        ReportPage.touched = True

    def tearDown(self):
        self.assertEqual(self.browser.errors, [])

    def settled(self):
        """A redrawing is done once nothing in the page has changed for a while."""
        before = None
        for _ in range(100):
            now = self.browser.evaluate("[...document.querySelectorAll('.chart')].map(chart => chart.innerHTML.length).join()")
            if now == before:
                return
            before = now
            time.sleep(0.15)
        self.fail("the charts never come to rest")

    def marks(self):
        self.settled()
        return self.browser.evaluate(MARKS)

    def test_opens_quickly_without_a_word_in_the_console(self):
        # The best of three: a machine that is busy otherwise is not what is tested.
        self.assertLess(min(self.open() for _ in range(3)), 2)
        self.assertEqual(self.browser.errors, [])
        self.assertEqual(self.browser.evaluate("document.title"), "dustbench: a&b <i>")
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('img:not(.picture-stage img), main script').length"), 0)

    def test_every_chart_has_marks(self):
        marks = self.marks()
        expected = {f"chart-{suite}-quick{part}" for suite in SUITES for part in ("", "-stages")}
        self.assertEqual(set(marks), expected | {"chart-carr2006-flaws-quick-quality", "chart-frames", "chart-other", "chart-other-stages"})
        self.assertTrue(all(count > 3 for count in marks.values()), marks)

    def test_a_method_switched_off_leaves_every_chart(self):
        before = self.marks()
        self.browser.evaluate("document.querySelector('.chip[data-method=billboard]').click()")
        after = self.marks()
        self.assertLess(after["chart-carr2006-compare-quick"], before["chart-carr2006-compare-quick"])
        self.assertLess(after["chart-carr2006-compare-quick-stages"], before["chart-carr2006-compare-quick-stages"])
        self.assertEqual(after["chart-carr2006-fig5-quick"], 0)
        self.assertEqual(after["chart-carr2006-fig7-quick"], before["chart-carr2006-fig7-quick"])
        self.assertIn("switched on", self.browser.evaluate("document.querySelector('#chart-carr2006-fig5-quick').textContent"))
        self.browser.evaluate("document.querySelector('.chip[data-method=billboard]').click()")
        self.assertEqual(self.marks(), before)

    def test_scales_and_quantities_can_be_chosen(self):
        def labels(chart):
            self.settled()
            return self.browser.evaluate(f"[...document.querySelectorAll('#{chart} .role-axis text')].map(text => text.textContent)")

        def choose(chart, key, value):
            self.browser.evaluate(f"""(() => {{ const select = document.querySelector('#{chart}').parentElement
                .querySelector('.controls:has(+ #{chart}) select[data-key={key}]');
                select.value = '{value}'; select.dispatchEvent(new Event('change')); }})()""")

        self.touch()
        chart = "chart-carr2006-compare-quick"
        linear = labels(chart)
        self.assertIn("frames per second [1/s]", linear)
        choose(chart, "yLog", "true")
        self.assertNotEqual(labels(chart), linear)
        choose(chart, "column", "gpu_bytes")
        self.assertTrue(any("GPU memory" in text and "[MB]" in text for text in labels(chart)))
        choose("chart-carr2006-flaws-quick-quality", "metric", "psnr_db")
        self.assertIn("PSNR [dB]", labels("chart-carr2006-flaws-quick-quality"))

    def test_axes_say_the_very_numbers(self):
        self.settled()
        labels = self.browser.evaluate("[...document.querySelectorAll('#chart-other .role-axis-label text')].map(text => text.textContent)")
        for particles in ("25", "125", "333"):
            self.assertIn(particles, labels)

    def test_says_what_is_missing_and_what_failed(self):
        said = self.browser.evaluate("document.querySelector('.problems').textContent")
        for part in ("1 of ", "not done", "moon_phase"):
            self.assertIn(part, said)
        self.assertRegex(said, r"frame times of \d+ runs cannot be read")
        self.assertIn("it said " + made_folder.EVIL, self.browser.evaluate("document.getElementById('not-done').textContent"))
        self.assertIn(made_folder.EVIL, self.browser.evaluate("document.getElementById('warnings').textContent"))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#warnings tbody tr').length"), 1)

    def test_a_point_says_its_numbers(self):
        self.settled()
        box = json.loads(self.browser.evaluate("""JSON.stringify((() => {
            const point = document.querySelector('#chart-carr2006-compare-quick .mark-symbol.role-mark path');
            point.scrollIntoView({block: 'center'});
            const {x, y, width, height} = point.getBoundingClientRect();
            return [x + width / 2, y + height / 2];
        })())"""))
        self.browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=box[0], y=box[1])
        self.browser.wait_for("!document.getElementById('tooltip').hidden", 5)
        said = self.browser.evaluate("document.getElementById('tooltip').textContent")
        for part in ("billboard", "particles", "frames per second", "interval of the median"):
            self.assertIn(part, said)

    def test_pictures_slide_and_take_turns(self):
        self.touch()
        state = "getComputedStyle(document.querySelector('.right-image')).clipPath"
        before = self.browser.evaluate(state)
        self.assertIn("50%", before)
        self.browser.evaluate("(() => { const wipe = document.querySelector('.wipe'); wipe.value = 200; wipe.dispatchEvent(new Event('input')); })()")
        self.assertIn("20%", self.browser.evaluate(state))
        self.assertTrue(self.browser.evaluate("[...document.querySelectorAll('.picture-stage img')].every(image => image.naturalWidth === 320)"))
        self.assertEqual(self.browser.evaluate("document.querySelector('.left-name').textContent"), "exact")
        self.browser.evaluate("(() => { const frame = document.querySelector('input.frame'); frame.value = 1; frame.dispatchEvent(new Event('input')); })()")
        self.assertEqual(self.browser.evaluate("document.querySelector('.frame-text').textContent"), "15")
        self.browser.evaluate("(() => { const mode = document.querySelector('select.mode'); mode.value = 'flicker'; mode.dispatchEvent(new Event('change')); })()")
        seen = "document.querySelector('.right-image').style.visibility"
        first = self.browser.evaluate(seen)
        self.browser.wait_for(f"{seen} !== {json.dumps(first)}", 5)

    def test_saves_a_chart_as_svg_and_png(self):
        target = tempfile.mkdtemp(prefix="dustbench-saved-")
        self.addCleanup(shutil.rmtree, target)
        self.browser.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=target)
        for ending, start in (("svg", b"<svg"), ("png", b"\x89PNG")):
            self.browser.evaluate(f"document.querySelector('.controls:has(+ #chart-carr2006-fig7-quick) .save-{ending}').click()")
            file = os.path.join(target, f"carr2006-fig7-quick.{ending}")
            deadline = time.monotonic() + 10
            while not (os.path.exists(file) and os.path.getsize(file)) and time.monotonic() < deadline:
                time.sleep(0.05)
            with open(file, "rb") as stream:
                self.assertTrue(stream.read().startswith(start), ending)

    def test_dark_and_light_can_be_read(self):
        self.touch()
        for scheme in ("light", "dark"):
            self.browser.prefer(scheme)
            self.browser.wait_for(f"document.documentElement.dataset.theme === '{scheme}'")
            self.settled()
            worst = self.browser.evaluate(CONTRAST)
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
        verdict = "[...document.querySelectorAll('#claims tr')].find(row => row.textContent.startsWith('R2a'))?.querySelector('.verdict').textContent"
        self.assertEqual(self.browser.evaluate(verdict), "✓ confirmed")
        other = {"octree_recursive": "octree_search", "octree_search": "octree_recursive"}
        times = {}
        for row in self.rows:
            key = (row["method"], row.get("p.particles"), row.get("p.speed"), row.get("p.layout"), row.get("p.depth"), row["repetition"], row["width"], "flip" in row)
            times[key] = row["build_ms_median"]
        swapped = [row | {"build_ms_median": times.get((other.get(row["method"]), row.get("p.particles"), row.get("p.speed"), row.get("p.layout"),
                                                        row.get("p.depth"), row["repetition"], row["width"], "flip" in row), row["build_ms_median"])} for row in self.rows]
        made_folder.write_summary(self.folder, swapped)
        try:
            said = self.report("--text")
            self.assertRegex(said, r"R2a +refuted")
            self.report()
            self.browser.open(self.page)
            self.assertEqual(self.browser.evaluate(verdict), "✗ refuted")
        finally:
            self.touch()
            made_folder.write_summary(self.folder, self.rows)
            self.report()

    def test_a_folder_without_runs_gets_a_page_that_says_so(self):
        empty = tempfile.mkdtemp(prefix="dustbench-empty-")
        self.addCleanup(shutil.rmtree, empty)
        called = subprocess.run([PROGRAM, "report", empty], capture_output=True, text=True)
        self.assertEqual(called.returncode, 3)
        self.touch()
        self.browser.open(called.stdout.strip())
        self.assertIn("no folder 'runs'", self.browser.evaluate("document.querySelector('.problems').textContent"))

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
            called = subprocess.run([PROGRAM, "reproduce", "--paper", "tiny", size, "--out", out], capture_output=True, text=True,
                                    env=os.environ | {"DUSTBENCH_DATA": data})
            self.assertEqual(called.returncode, 0, called.stderr)
            return called

        full = reproduce("--full").stderr
        self.assertRegex(full.partition("[1/2]")[0], r"estimate: \d+ s for 2 runs")
        self.assertRegex(full, r"\[1/2\] .* ETA \d+ s")
        # What is left to do is estimated, which is nothing now.
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
        self.assertTrue(self.browser.evaluate("[...document.querySelectorAll('.picture-stage img')].every(image => image.naturalWidth === 96)"))

    def test_charts_come_as_files_without_a_browser(self):
        for ending, start in (("svg", b"<svg"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
            with open(self.report("--chart", "fig7", "--format", ending).strip(), "rb") as stream:
                content = stream.read()
            self.assertTrue(content.startswith(start), ending)
            if ending == "svg":
                self.assertIn(b"octree_recursive", content)
        called = subprocess.run([PROGRAM, "report", self.folder, "--chart", "fig77"], capture_output=True, text=True)
        self.assertEqual(called.returncode, 3)
        self.assertIn("carr2006-fig7-quick", called.stderr)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
