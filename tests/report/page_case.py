"""Base class for tests of the report page in a real browser: a made-up results folder, its page, and shared steps.

Needs Chromium (Debian: chromium-headless-shell), node and rsvg-convert, and fails with a message if one is missing.
"""

import json
import os
import shutil
import subprocess
import tempfile
import time
import unittest

import browser
import made_folder

PROGRAM = ""  # set by report_page_test.py
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SUITES = ("carr2006-fig5", "carr2006-fig7", "carr2006-depth", "carr2006-compare", "carr2006-flaws")
MARKS = """Object.fromEntries([...document.querySelectorAll('.chart')].map(chart => [chart.id,
    chart.querySelectorAll('.mark-symbol path, .mark-rect path, .mark-line path, .mark-rule line').length]))"""

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
    for (const element of document.querySelectorAll('h1, h2, h3, p, td, th, dt, dd, li, a, button, select, .verdict, .claim-range text, .chart text, summary')) {
        if (!element.textContent.trim() || !element.getClientRects().length) continue;
        const style = getComputedStyle(element);
        const svg = element.tagName === 'text';
        const [a, b] = [light(parts(svg ? style.fill : style.color)), light(background(element))].sort((x, y) => y - x);
        found.push([(a + 0.05) / (b + 0.05), element.textContent.trim().slice(0, 40)]);
    }
    return found.sort((x, y) => x[0] - y[0]).slice(0, 3);
})()"""


class PageCase(unittest.TestCase):
    touched = True

    @classmethod
    def setUpClass(cls):
        path = browser.find()
        if not path:
            raise RuntimeError("no Chromium: install the Debian package chromium-headless-shell (.ci/install browser)")
        cls.folder = os.path.join(tempfile.mkdtemp(prefix="dustbench-report-"), "a&b <i>")
        cls.addClassCleanup(shutil.rmtree, os.path.dirname(cls.folder))
        os.makedirs(cls.folder)
        cls.rows = cls.make_rows()
        cls.page = cls.report().strip()
        cls.browser = cls.enterClassContext(browser.Browser(path))

    @classmethod
    def make_rows(cls):
        return made_folder.write(PROGRAM, cls.folder, SUITES)

    @classmethod
    def report(cls, *more):
        called = subprocess.run([PROGRAM, "report", cls.folder, *more], capture_output=True, text=True)
        if called.returncode:
            raise RuntimeError(called.stderr)
        return called.stdout

    def open(self):
        """Opens the page again in its initial state and returns the seconds that this took."""
        self.browser.resize(1400, 1000)
        self.browser.prefer("light")
        type(self).touched = False
        return self.browser.open(self.page)

    def setUp(self):
        if self.touched:
            self.open()

    def touch(self):
        """Marks the page as modified."""
        type(self).touched = True

    def tearDown(self):
        self.assertEqual(self.browser.errors, [])

    def settled(self):
        """Waits until the charts have stopped changing."""
        before = None
        for _ in range(100):
            now = self.browser.evaluate("[...document.querySelectorAll('.chart')].map(chart => chart.innerHTML.length).join()")
            if now == before:
                return
            before = now
            time.sleep(0.15)
        self.fail("the charts do not stop changing")

    def choose(self, chart, key, value):
        self.browser.evaluate(f"""(() => {{ const select = document.querySelector('.controls:has(+ #{chart}) select[data-key={key}]');
            select.value = '{value}'; select.dispatchEvent(new Event('change')); }})()""")

    def saved(self, button, name):
        """Returns the file that a button downloads."""
        target = tempfile.mkdtemp(prefix="dustbench-saved-")
        self.addCleanup(shutil.rmtree, target)
        self.browser.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=target)
        self.browser.evaluate(f"document.querySelector({json.dumps(button)}).click()")
        file = os.path.join(target, name)
        deadline = time.monotonic() + 10
        while not (os.path.exists(file) and os.path.getsize(file)) and time.monotonic() < deadline:
            time.sleep(0.05)
        with open(file, "rb") as stream:
            return stream.read()

    def marks(self):
        self.settled()
        return self.browser.evaluate(MARKS)
