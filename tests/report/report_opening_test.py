"""The report of a suite whose chart is one of error against cost. report_page_test.py runs these tests."""

import os
import shutil
import tempfile

import made_folder
import page_case

SUITE = """title = "Mud: error against time"
chart = "ssim against frame_ms_median"
methods = ["billboard", "octree_search"]
frames = 30
repetitions = 2
metrics = true
baseline = false
[parameters]
speed = 20
preroll = 1
particles = [100, 400]
"""


class ReportOpening(page_case.PageCase):
    @classmethod
    def setUpClass(cls):
        data = tempfile.mkdtemp(prefix="dustbench-opening-")
        cls.addClassCleanup(shutil.rmtree, data)
        os.makedirs(os.path.join(data, "suites"))
        with open(os.path.join(data, "suites", "mud-flaws.toml"), "w", encoding="utf-8") as stream:
            stream.write(SUITE)
        before = os.environ.get("DUSTBENCH_DATA")
        os.environ["DUSTBENCH_DATA"] = data
        cls.addClassCleanup(lambda: os.environ.pop("DUSTBENCH_DATA") if before is None else os.environ.update(DUSTBENCH_DATA=before))
        super().setUpClass()

    @classmethod
    def make_rows(cls):
        return made_folder.write(page_case.PROGRAM, cls.folder, ("mud-flaws",))

    def texts(self, selector):
        return self.browser.evaluate(f"[...document.querySelectorAll('{selector}')].map(element => element.textContent)")

    def test_the_first_screen_is_the_chart_of_error_against_cost(self):
        place = self.browser.evaluate("(() => { const box = document.querySelector('#opening .chart svg').getBoundingClientRect(); return [box.top, box.bottom, window.innerHeight]; })()")
        self.assertGreater(place[0], 0)
        self.assertLess(place[1], place[2], "it needs no scrolling")
        titles = self.texts("#opening .role-axis-title text")
        self.assertIn("SSIM", titles)
        self.assertIn("frame time [ms]", titles)
        self.assertEqual(len(self.texts("#opening .mark-symbol.role-mark path")) > 0, True)

    def test_it_stands_there_once(self):
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#chart-mud-flaws-quality').length"), 1)
        self.assertIn("at the top of the page", self.texts("#quality")[0])

    def test_the_chart_of_costs_opens_on_that_cost(self):
        titles = self.texts("#chart-mud-flaws .role-axis-title text")
        self.assertIn("frame time [ms]", titles)
        self.assertIn("particles", titles)
