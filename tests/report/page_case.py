"""A test of the report's page in a real browser: a made-up results folder, its page, and what tests do with it.

Needs Chromium (Debian: chromium-headless-shell), node and rsvg-convert; fails with a word where one is missing.
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
        """Again, as it was first; gives the seconds that took."""
        self.browser.resize(1400, 1000)
        self.browser.prefer("light")
        type(self).touched = False
        return self.browser.open(self.page)

    def setUp(self):
        if self.touched:
            self.open()

    def touch(self):
        """Said by a test that leaves the page other than it was."""
        type(self).touched = True

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

    def choose(self, chart, key, value):
        self.browser.evaluate(f"""(() => {{ const select = document.querySelector('.controls:has(+ #{chart}) select[data-key={key}]');
            select.value = '{value}'; select.dispatchEvent(new Event('change')); }})()""")

    def saved(self, button, name):
        """What a button downloads."""
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
