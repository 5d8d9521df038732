"""Published numbers on the charts, captions, and the report from only tables. report_page_test.py runs these tests."""

import json
import math
import os
import re
import shutil
import subprocess
import tempfile

import made_folder
import page_case

# A made-up paper: two series of two methods against a load, with times in ms for the paper's frames per second; and bars with a band.
PAPER = {
    "paper.toml": """id = "mud"
title = "Mud"
authors = "Nobody"
year = 2006
venue = ""
key = "Carr2006"
summary = ""
suites = ["mud-loads", "mud-bars"]
""",
    "claims.toml": """[[claim]]
id = "M1"
text = "of a frame, drawing takes more than half"
device = true
suite = "mud-loads"
quantity = "share"
column = "frame_ms_median"
parts = ["draw_ms_median"]
of = "billboard"
min = 0.5
reason = "half"
[[claim.control]]
why = "of what is drawn all is drawn"
gives = "confirmed"
column = "draw_ms_median"
[[claim.control]]
why = "sorting is not drawing"
gives = "refuted"
parts = ["sort_ms_median"]
""",
    "suites/mud-loads.toml": """title = "Figure 3: loads"
summary = ""
chart = "frame_ms_median against particles"
methods = ["billboard", "octree_search"]
frames = 30
repetitions = 6
[parameters]
preroll = 1
particles = [100, 400, 1600]
[method.billboard]
sort = ["none", "radix"]
[method.octree_search]
sort = ["none", "radix"]
""",
    "suites/mud-bars.toml": """title = "Bars"
summary = ""
methods = ["billboard", "octree_search"]
frames = 30
repetitions = 6
[parameters]
preroll = 1
particles = 150
""",
    "published.csv": """suite,of,axis,x,column,unit,min,max,hardware,what
mud-loads,billboard sort=none,particles,100,fps_avg,frames/s,10,10,A PC of 1999,plain
mud-loads,billboard sort=none,particles,800,fps_avg,frames/s,2,2.5,A PC of 1999,plain
mud-loads,billboard sort=radix,particles,100,fps_avg,frames/s,5,5,A PC of 1999,sorted
mud-bars,billboard,,,fps_avg,frames/s,10,15,A laptop of 2002,no load
""",
}
OF_THE_PAPER = {"billboard, sort none": 100, "billboard, sort radix": 200}  # ms of a frame with 100 particles


def frame_ms(particles):
    return sum(made_folder.stages_of("billboard", {"particles": particles}, 1).values())


class ReportPublished(page_case.PageCase):
    @classmethod
    def setUpClass(cls):
        data = tempfile.mkdtemp(prefix="dustbench-paper-")
        cls.addClassCleanup(shutil.rmtree, data)
        for name, text in PAPER.items():
            file = os.path.join(data, "papers", "mud", name)
            os.makedirs(os.path.dirname(file), exist_ok=True)
            with open(file, "w", encoding="utf-8") as stream:
                stream.write(text)
        cls.published = os.path.join(data, "papers", "mud", "published.csv")
        before = os.environ.get("DUSTBENCH_DATA")
        os.environ["DUSTBENCH_DATA"] = data
        cls.addClassCleanup(lambda: os.environ.pop("DUSTBENCH_DATA") if before is None else os.environ.update(DUSTBENCH_DATA=before))
        super().setUpClass()

    @classmethod
    def make_rows(cls):
        return made_folder.write(page_case.PROGRAM, cls.folder, ("mud-loads", "mud-bars"))

    def built(self, chart, more="{}"):
        """Data of the chart's specification, its scales and its caption."""
        return self.browser.evaluate("""(() => { const read = id => JSON.parse(document.getElementById(id).textContent);
            const report = { data: read('report-data'), columns: read('report-columns'), specifications: read('report-charts') };
            const { spec, caption } = chartKit.build(report, { ...chartKit.list(report).find(chart => chart.id === '%s'), ...%s });
            const of = list => Object.fromEntries((list || []).map(item => [item.name, item]));
            return { data: of(spec.data), scales: of(spec.scales), title: (spec.title || {}).text, caption }; })()""" % (chart, more))

    def test_points_stand_in_their_series_and_ms_and_frames_per_second_are_converted(self):
        marks = self.built("mud-loads")["data"]["published"]["values"]
        self.assertEqual([(mark["series"], mark["x"]) for mark in marks],
                         [("billboard, sort none", 100), ("billboard, sort none", 800), ("billboard, sort radix", 100)])
        self.assertEqual(marks[0]["y"], 100)
        self.assertEqual((marks[1]["low"], marks[1]["high"]), (400, 500))
        as_printed = self.built("mud-loads", "{column: 'fps_avg'}")["data"]["published"]["values"]
        self.assertEqual((as_printed[1]["low"], as_printed[1]["high"]), (2, 2.5))
        self.assertEqual(self.built("mud-loads", "{column: 'gpu_bytes'}")["data"]["published"]["values"], [])

    def test_the_measured_curve_is_scaled_to_the_first_point(self):
        built = self.built("mud-loads")["data"]
        [factor] = built["factors"]["values"]
        self.assertEqual(factor["series"], "billboard, sort none", "one point alone gives no curve")
        expected = 100 / frame_ms(100)
        self.assertAlmostEqual(float(factor["text"].rstrip("×")) / expected, 1, delta=0.02)
        curve = [(row["x"], row["y"]) for row in built["scaled"]["values"]]
        self.assertEqual([x for x, _ in curve], [100, 400, 800])
        self.assertEqual(curve[0][1], 100)
        self.assertAlmostEqual(curve[1][1] / (expected * frame_ms(400)), 1, delta=0.02)
        between = math.sqrt(frame_ms(400) * frame_ms(1600))
        self.assertAlmostEqual(curve[2][1] / (expected * between), 1, delta=0.02)

    def test_marks_are_hollow_and_have_the_colour_and_the_form_of_their_series(self):
        self.settled()
        looks = self.browser.evaluate("""['none', 'radix'].map(sort => ['point', 'publishedPoint'].map(name => {
            const groups = [...document.querySelectorAll('#chart-mud-loads .mark-symbol.role-mark')].filter(group => group.classList.contains(name));
            const all = [...groups[0].querySelectorAll('path')];
            const index = sort === 'none' ? 0 : name === 'point' ? 1 : all.length - 1;  // loads first; the paper's points as in its file
            const path = all[index];
            return [path.getAttribute('stroke'), path.getAttribute('fill'), path.getAttribute('d').replace(/[\\d.,-]+/g, '')];
        }))""")
        for measured, published in looks:
            self.assertEqual(published[0], measured[0])
            self.assertEqual(published[2], measured[2])
            self.assertEqual(measured[1], measured[0])
            self.assertEqual(published[1], "#ffffff")
        self.assertNotEqual(looks[0][0][0], looks[1][0][0])

    def test_a_span_of_ten_and_more_is_logarithmic(self):
        self.assertEqual(self.built("mud-loads")["scales"]["y"]["type"], "log")
        self.assertEqual(self.built("mud-loads", "{yLog: false}")["scales"]["y"]["type"], "linear")

    def test_a_number_without_a_load_is_a_band(self):
        [band] = self.built("mud-bars")["data"]["bands"]["values"]
        self.assertEqual((band["min"], band["max"]), (10, 15))
        self.assertEqual(band["text"].replace("\u00a0", " "), "published: 10 to 15 frames/s")
        [band] = self.built("mud-bars", "{column: 'frame_ms_median'}")["data"]["bands"]["values"]
        self.assertEqual(band["text"].replace("\u00a0", " "), "published: 66.7 to 100 ms (10 to 15 frames/s)")

    def test_the_picture_itself_says_hardware_year_and_device(self):
        self.assertIn("Hollow marks: published, A PC of 1999.", self.built("mud-loads")["caption"])
        self.assertIn("Band: published without a load, A laptop of 2002.", self.built("mud-bars")["caption"])
        self.settled()
        self.assertIn("A PC of 1999", self.browser.evaluate("document.getElementById('chart-mud-loads').textContent"))
        with open(self.report("--chart", "mud-loads").strip(), encoding="utf-8") as stream:
            svg = stream.read()
        for part in ("A PC of 1999", "2 cores, llvmpipe (made up)", "Dashed", "publishedPoint", "factor"):
            self.assertIn(part, svg)
        with open(self.report("--chart", "mud-loads-stages").strip(), encoding="utf-8") as stream:
            self.assertIn("2 cores, llvmpipe (made up)", stream.read())
        self.assertLess(float(re.search(r'<svg [^>]*width="([0-9.]+)"', svg).group(1)), 960, "a caption must not widen the chart")

    def test_paper_has_marks_and_caption_too(self):
        self.touch()
        self.browser.evaluate("window.dispatchEvent(new Event('beforeprint'))")
        self.settled()
        self.assertIn("A PC of 1999", self.browser.evaluate("document.getElementById('chart-mud-loads').textContent"))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#chart-mud-loads .publishedPoint path').length"), 3)
        self.browser.evaluate("window.dispatchEvent(new Event('afterprint'))")

    def test_a_narrow_chart_wraps_its_caption(self):
        lines = self.built("mud-loads", "{width: 320}")["title"]
        self.assertGreater(len(lines), 4)
        self.assertTrue(all(len(line) <= 320 / 8.8 or " " not in line for line in lines), lines)

    def test_a_claim_about_the_device_says_so(self):
        said = self.browser.evaluate("document.querySelector('.claim[data-claim=M1] .claim-mark').innerText")
        self.assertIn("on this device", said)
        self.assertIn("on this device", self.report("--text"))

    def test_a_row_without_a_place_stops_reproduce_before_anything_is_measured(self):
        with open(self.published, encoding="utf-8") as stream:
            whole = stream.read()
        out = os.path.join(self.folder, "new")
        for planted, said in ((",particles,800", "axis: got 'load'"), ("frames/s,2,", "unit: got 'ms'"), ("sort=radix", "of: got 'billboard sort=bubble'"), ("mud-bars", "suite: got 'mud-bar'")):
            new = {",particles,800": ",load,800", "frames/s,2,": "ms,2,", "sort=radix": "sort=bubble", "mud-bars": "mud-bar"}[planted]
            with open(self.published, "w", encoding="utf-8") as stream:
                stream.write(whole.replace(planted, new))
            for more in ([], ["--dry-run"]):
                called = subprocess.run([page_case.PROGRAM, "reproduce", "--paper", "mud", "--quick", "--out", out, *more], capture_output=True, text=True)
                self.assertEqual((called.returncode, called.stdout), (3, ""), planted)
                self.assertIn(said, called.stderr)
                self.assertIn("published.csv:", called.stderr)
                self.assertEqual(called.stderr.count("\n"), 1)
            self.assertFalse(os.path.exists(out))
        with open(self.published, "w", encoding="utf-8") as stream:
            stream.write(whole)
        called = subprocess.run([page_case.PROGRAM, "reproduce", "--paper", "mud", "--dry-run", "--out", out], capture_output=True, text=True)
        self.assertEqual(called.returncode, 0, called.stderr)
        self.assertIn("mud: 2 suites, 0 experiments, 4 published numbers on its charts", called.stdout)
        self.assertRegex(called.stdout, r"mud-loads: \d+ runs")
        self.assertFalse(os.path.exists(out))

    def test_tables_alone_give_the_same_charts(self):
        tables, elsewhere = (tempfile.mkdtemp(prefix="dustbench-tables-") for _ in range(2))
        self.addCleanup(shutil.rmtree, tables)
        self.addCleanup(shutil.rmtree, elsewhere)
        shutil.copy(os.path.join(self.folder, "summary.csv"), tables)
        with open(os.path.join(tables, "machine.csv"), "w", encoding="utf-8") as stream:
            stream.write('cpu,cores,gl_renderer\n"%s",2,llvmpipe (made up)\n' % ("made up " + made_folder.EVIL).replace('"', '""'))
        with open(os.path.join(tables, "claims.csv"), "w", encoding="utf-8") as stream:
            stream.write("kept")

        def svg(folder, *more):
            called = subprocess.run([page_case.PROGRAM, "report", folder, "--chart", "mud-loads", *more], capture_output=True, text=True)
            self.assertEqual(called.returncode, 0, called.stderr)
            with open(called.stdout.strip(), encoding="utf-8") as stream:
                return stream.read()

        file = os.path.join(elsewhere, "new", "a.svg")
        self.assertEqual(svg(tables, "--out", file), svg(self.folder))
        called = subprocess.run([page_case.PROGRAM, "report", tables, "--chart", "all", "--out", elsewhere], capture_output=True, text=True)
        self.assertEqual(sorted(os.path.basename(line) for line in called.stdout.splitlines()), ["mud-bars.svg", "mud-loads.svg"], called.stderr)
        self.assertEqual(sorted(os.listdir(tables)), ["claims.csv", "machine.csv", "summary.csv"])

        called = subprocess.run([page_case.PROGRAM, "report", tables, "--out", os.path.join(elsewhere, "page")], capture_output=True, text=True)
        self.assertEqual(called.returncode, 0, called.stderr)
        self.assertEqual(sorted(os.listdir(tables)), ["claims.csv", "machine.csv", "summary.csv"])
        self.touch()
        self.browser.open(called.stdout.strip())
        self.settled()
        self.assertGreater(self.browser.evaluate("document.querySelectorAll('#chart-mud-loads .publishedPoint path').length"), 2)
        link = self.browser.evaluate("[...document.querySelectorAll('a')].map(link => link.getAttribute('href')).find(link => link.endsWith('summary.csv'))")
        self.assertTrue(os.path.samefile(os.path.join(elsewhere, "page", link), os.path.join(tables, "summary.csv")))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('a[href*=\"runs/\"]').length"), 0)
        called = subprocess.run([page_case.PROGRAM, "report", tables], capture_output=True, text=True)
        self.assertEqual(called.returncode, 0, called.stderr)
        with open(os.path.join(tables, "claims.csv"), encoding="utf-8") as stream:
            self.assertEqual(stream.read(), "kept")
