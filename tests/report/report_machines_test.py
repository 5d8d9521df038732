"""The page of several machines: made-up folders, the program's output, and the page in Chromium. report_page_test.py runs these tests."""

import json
import math
import os
import shutil
import subprocess
import tempfile
import unittest

import browser
import made_folder
import made_machines
import page_case

LAB = {"fog": 1.0, "ratio": 0.5}
ATTIC = {"fog": 40.0, "ratio": 2.0, "cpu": "Old CPU", "cores": 2, "gl_renderer": "llvmpipe (LLVM 15.0.6, 256 bits)", "git_commit": "fedcba9876543210fedc",
         "governor": "powersave"}
STUDENT_975_5 = 2.5705818366147395  # the 0.975-quantile of Student's t with 5 degrees of freedom
HALF = STUDENT_975_5 * made_machines.SCATTER / math.sqrt(5)


def report(*arguments):
    return subprocess.run([page_case.PROGRAM, "report", *arguments], capture_output=True, text=True)


class MachinesCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.mkdtemp(prefix="dustbench-machines-")
        cls.addClassCleanup(shutil.rmtree, cls.place)

    @classmethod
    def machine(cls, name, machine, **more):
        folder = os.path.join(cls.place, name)
        made_machines.write(folder, machine, **more)
        return folder


class ReportOfSeveralMachines(MachinesCase):
    """The program's output."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.lab = cls.machine("lab", LAB)
        cls.attic = cls.machine("attic", ATTIC)

    def page_of(self, *arguments):
        out = tempfile.mkdtemp(dir=self.place)
        called = report(*arguments, "--out", out)
        self.assertEqual(called.returncode, 0, called.stderr)
        self.assertEqual(called.stdout, os.path.join(out, "index.html") + "\n")
        with open(os.path.join(out, "index.html"), encoding="utf-8") as stream:
            return stream.read()

    @staticmethod
    def data_of(page):
        return json.loads(page.partition('id="report-data">')[2].partition("</script>")[0])

    def test_ratios_are_those_of_the_formula_in_any_order(self):
        for folders in ((self.lab, self.attic), (self.attic, self.lab)):
            data = self.data_of(self.page_of(*folders))
            self.assertEqual([machine["label"] for machine in data["machines"]], [os.path.basename(folder) for folder in folders])
            [experiment] = data["experiments"]
            self.assertEqual([variant["label"] for variant in experiment["variants"]], ["fog", "haze"])
            [ratio] = experiment["ratios"]
            self.assertEqual(ratio["common"], len(made_machines.LOADS))
            self.assertEqual(ratio["all"]["agreement"], "differ")
            for row in (ratio["all"], *ratio["worlds"]):
                for machine, side in zip(data["machines"], row["sides"]):
                    expected = 1 / (LAB if machine["label"] == "lab" else ATTIC)["ratio"]
                    for value, formula in zip(side[:3], (expected, expected * math.exp(-HALF), expected * math.exp(HALF))):
                        self.assertAlmostEqual(value / formula, 1, delta=1e-5)
                    self.assertEqual(side[3:], [6, "SLOWER" if expected > 1 else "FASTER", ""])

    def test_text_has_the_same_numbers(self):
        said = report(self.lab, self.attic, "--text").stdout
        self.assertRegex(said, r"frame_ms_median +haze +particles=100 +0\.500 \[0\.494, 0\.506\] FASTER +2\.000 \[1\.977, 2\.023\] SLOWER +differ")
        self.assertRegex(said, r"all 3 in common +0\.500 \[")
        for part in ("Old CPU", "Made-up GPU 4000", "software: llvmpipe", "commit: 0123456789ab on lab; fedcba987654 on attic", "powersave"):
            self.assertIn(part, said)

    def test_labels_name_the_machines(self):
        data = self.data_of(self.page_of(self.lab, self.attic, "--label", "new", "--label", "old one"))
        self.assertEqual([machine["label"] for machine in data["machines"]], ["new", "old one"])
        for labels, said in ((["--label", "x"], "got 1 for 2 folders"), (["--label", "x", "--label", "x"], "expected different labels")):
            called = report(self.lab, self.attic, *labels)
            self.assertEqual(called.returncode, 3)
            self.assertIn(said, called.stderr)

    def test_two_folders_of_one_machine_are_said_to_be(self):
        again = self.machine("again", LAB | {"started_utc": "2026-03-02T00:00:00Z"})
        called = report(self.lab, again, "--text")
        self.assertEqual(called.returncode, 0)
        self.assertIn("again and lab are the same machine, or two identical ones", called.stdout)
        called = report(self.lab, os.path.join(self.lab, "..", "lab"))
        self.assertEqual(called.returncode, 3)
        self.assertIn("given more than once", called.stderr)

    def test_a_missing_cell_is_named(self):
        less = self.machine("less", ATTIC, loads=(100, 200))
        made_machines.write_run(less, "haze", 400, 1, ATTIC, status="failed")
        page = self.page_of(self.lab, less)
        data = self.data_of(page)
        self.assertEqual(data["remarks"]["missing"], [{"cell": "fog particles=400", "on": [0], "lacking": [[1, "not measured"]]},
                                                      {"cell": "haze particles=400", "on": [0], "lacking": [[1, "failed: it broke"]]}])
        self.assertEqual(data["experiments"][0]["ratios"][0]["common"], 2)
        self.assertIn("fog particles=400: not measured on less", report(self.lab, less, "--text").stdout)

    def test_other_settings_are_refused_or_listed(self):
        large = self.machine("large", ATTIC, size="640x480")
        out = os.path.join(self.place, "never")
        called = report(self.lab, large, "--out", out)
        self.assertEqual(called.returncode, 6)
        self.assertIn("not comparable: size: 320x240 on lab; 640x480 on large\nnot comparable: no configuration was measured on two machines\n", called.stderr)
        self.assertFalse(os.path.exists(out))
        data = self.data_of(self.page_of(self.lab, large, self.attic))
        self.assertEqual(data["remarks"]["apart"], ["size: 320x240 on attic and lab; 640x480 on large"])
        self.assertEqual(data["remarks"]["missing"], [])

    def test_a_damaged_folder_is_named(self):
        hurt = self.machine("hurt", ATTIC)
        file = os.path.join(hurt, "runs", "fog-100-320x240-r1", "run.json")
        with open(file, "w", encoding="utf-8") as stream:
            stream.write("{")
        called = report(self.lab, hurt, "--out", os.path.join(self.place, "with-hurt"))
        self.assertEqual(called.returncode, 0)
        self.assertRegex(called.stderr, r"note: hurt: left out: .*fog-100-320x240-r1")
        os.makedirs(os.path.join(self.place, "empty", "runs"))
        for name in ("empty", "nowhere"):
            folder = os.path.join(self.place, name)
            called = report(self.lab, folder, "--out", os.path.join(self.place, "never"))
            self.assertEqual(called.returncode, 3, name)
            self.assertIn(f"'{folder}'", called.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.place, "never")))

    def test_options_belong_to_one_folder_or_to_several(self):
        for arguments, option in ((["--chart", "frames"], "--chart"), (["--pictures", "1"], "--pictures"), (["--text", "--out", "x"], "--text")):
            called = report(self.lab, self.attic, *arguments)
            self.assertEqual(called.returncode, 3, option)
            self.assertIn(option, called.stderr)
        called = report(self.lab, "--label", "x")
        self.assertEqual(called.returncode, 3)
        self.assertIn("--label: applies only to several folders", called.stderr)
        called = report(self.lab, self.attic, "--out", self.lab)
        self.assertEqual(called.returncode, 3)
        self.assertFalse(os.path.exists(os.path.join(self.lab, "index.html")))

    def test_claims_stand_side_by_side(self):
        """Real runs of a paper that takes seconds, and a copy as another machine, on which more particles give fewer billboards."""
        data = os.path.join(self.place, "data")
        shutil.copytree(os.path.join(page_case.ROOT, "data"), data)
        for name, text in made_folder.TINY_PAPER.items():
            file = os.path.join(data, "papers", "tiny", name)
            os.makedirs(os.path.dirname(file), exist_ok=True)
            with open(file, "w", encoding="utf-8") as stream:
                stream.write(text.replace('over = "none"', 'device = true\nover = "none"'))
        here, there = os.path.join(self.place, "here"), os.path.join(self.place, "there")
        environment = os.environ | {"DUSTBENCH_DATA": data}
        called = subprocess.run([page_case.PROGRAM, "reproduce", "--paper", "tiny", "--quick", "--out", here], capture_output=True, text=True, env=environment)
        self.assertEqual(called.returncode, 0, called.stderr)
        shutil.copytree(here, there)
        for name in os.listdir(os.path.join(there, "runs")):
            file = os.path.join(there, "runs", name, "run.json")
            with open(file, encoding="utf-8") as stream:
                run = json.load(stream)
            run["provenance"]["cpu"] = "Another CPU"
            run["summary"]["primitives_median"] = 1e5 / float(run["summary"]["primitives_median"])
            with open(file, "w", encoding="utf-8") as stream:
                json.dump(run, stream)
        out = os.path.join(self.place, "tiny.html")
        called = subprocess.run([page_case.PROGRAM, "report", here, there, "--out", out], capture_output=True, text=True, env=environment)
        self.assertEqual(called.returncode, 0, called.stderr)
        with open(out, encoding="utf-8") as stream:
            [claim] = self.data_of(stream.read())["claims"]
        self.assertEqual((claim["id"], claim["agreement"]), ("T1", "open"))
        # Refuted there, but its only control expects a refutation too, so the claim is untestable.
        self.assertEqual([own["verdict"] for own in claim["folders"]], ["confirmed", "untestable"])
        self.assertEqual([own["verdictText"] for own in claim["folders"]], ["confirmed on this device", "untestable"])
        said = subprocess.run([page_case.PROGRAM, "report", here, there, "--text"], capture_output=True, text=True, env=environment).stdout
        self.assertRegex(said, r"tiny +T1 +confirmed on this device +untestable +open")

    def test_one_folder_has_the_page_of_one_folder(self):
        """The page is exactly the template with these files and nothing else."""
        called = report(self.lab)
        self.addCleanup(os.remove, os.path.join(self.lab, "index.html"))
        self.assertEqual((called.returncode, called.stdout), (0, os.path.join(self.lab, "index.html") + "\n"))
        with open(os.path.join(self.lab, "index.html"), encoding="utf-8") as stream:
            page = stream.read()
        reports = os.path.join(page_case.ROOT, "reports")

        def text(*parts):
            with open(os.path.join(reports, *parts), encoding="utf-8") as stream:
                return stream.read()

        def escaped(content):
            return content.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")

        def between(start, end):
            return page.partition(start)[2].partition(end)[0]

        scripts = ("chart_style chart_data chart_parts published_marks cost_chart stage_chart quality_chart map_chart charts words".split(),
                   "elements markdown pictures claims overview page_state page_look chart_card head page".split())
        charts = ",".join(f'"{name}":' + text("page", "charts", f"{name}.json") for name in ("bars", "cost", "frames", "map", "quality", "stages"))
        data = between('id="report-data">', "</script>")
        columns = between('id="report-columns">', "</script>")
        named = json.loads(columns)
        self.assertEqual(named["psnr_db"], {"name": "PSNR", "unit": "dB", "better": "high", "metric": True, "flaw": False})
        self.assertLessEqual(json.loads(text("page", "columns.json")).items(), named.items())
        self.assertEqual(set(json.loads(data)), {"claims", "experiments", "facts", "files", "folder", "frames", "framesLeftOut", "heat", "linkedPictures", "machines",
                                                 "methods", "notDone", "papers", "pictures", "problems", "root", "runs", "tablesOnly", "version", "warnings", "written"})
        # Vega and its licence come from Debian.
        parts = {"title": "dustbench: lab", "style": text("page", "page.css"), "columns": columns, "charts": "{" + charts + "}",
                 "data": data, "schema": escaped(text("SCHEMA.md")), "metrics": escaped(text("METRICS.md")),
                 "chart-script": "".join(text("page", f"{name}.js") for name in scripts[0]), "page-script": "".join(text("page", f"{name}.js") for name in scripts[1]),
                 "vega": between("</template>\n<script>\n", "\n</script>\n<script>\n"), "licence": between("ISC licence).\n\n", "</pre></template>")}
        expected = text("page", "page.html")
        for name, content in parts.items():
            expected = expected.replace("{{" + name + "}}", content)
        self.assertEqual(len(page), len(expected))
        self.assertTrue(page == expected)


class PageOfSeveralMachines(MachinesCase):
    """The page as a reader sees it."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        path = browser.find()
        if not path:
            raise RuntimeError("no Chromium: install the Debian package chromium-headless-shell (.ci/install browser)")
        evil = "</script><b>x"
        folders = [cls.machine("lab", LAB | {"cpu": evil}), cls.machine("attic", ATTIC, warnings=["the machine is busy: load 3.2"]),
                   cls.machine("cellar", {"fog": 3.0, "ratio": 0.52}, loads=(100, 200))]
        cls.page = os.path.join(cls.place, "page.html")
        called = report(*folders, "--out", cls.page)
        if called.returncode:
            raise RuntimeError(called.stderr)
        cls.browser = cls.enterClassContext(browser.Browser(path))

    def setUp(self):
        self.browser.resize(1400, 1000)
        self.browser.prefer("light")
        self.browser.open(self.page)

    def tearDown(self):
        self.assertEqual(self.browser.errors, [])

    def texts(self, selector):
        return self.browser.evaluate(f"[...document.querySelectorAll({json.dumps(selector)})].map(item => item.textContent)")

    def test_each_machine_is_a_line_and_the_legend_names_it(self):
        for chart in ("chart-other-ratios", "chart-other-times"):
            self.assertEqual(set(self.texts(f"#{chart} .role-legend-label text")), {"lab", "attic", "cellar"}, chart)
        lines = "document.querySelectorAll('#%s .mark-line.role-mark path').length"
        self.assertEqual(self.browser.evaluate(lines % "chart-other-ratios"), 3)
        # A panel for each of the two methods.
        self.assertEqual(self.browser.evaluate(lines % "chart-other-times"), 6)

    def test_the_table_has_ratios_and_whether_machines_agree(self):
        rows = self.browser.evaluate("[...document.querySelectorAll('#ratios tbody tr')].map(row => [...row.cells].map(cell => cell.textContent))")
        self.assertEqual(rows[0], ["haze", "differ", "0.500× [0.494, 0.506]faster", "2× [1.98, 2.02]slower", "0.520× [0.514, 0.526]faster"])
        self.assertEqual(rows[3][:2] + rows[3][4:], ["haze at particles 400", "differ", "–"])
        self.assertIn("haze against fog, frame time: faster on lab and cellar; slower on attic.", self.texts(".answers li")[0])

    def test_another_reference_turns_the_ratios_round(self):
        self.browser.evaluate("(() => { const select = document.querySelector('#ratios select[data-key=against]'); select.value = '1'; "
                              "select.dispatchEvent(new Event('change', { bubbles: true })); })()")
        self.browser.wait_for("document.querySelector('#ratios tbody td').textContent === 'fog'", 5)
        self.assertEqual(self.texts("#ratios tbody tr:first-child td")[:4], ["fog", "differ", "2× [1.98, 2.02]slower", "0.500× [0.494, 0.506]faster"])

    def test_a_machine_switched_off_leaves_the_charts(self):
        self.browser.evaluate("document.querySelector('.chip[data-machine=attic]').click()")
        self.browser.wait_for("document.querySelectorAll('#chart-other-ratios .mark-line.role-mark path').length === 2", 5)

    def test_the_hardware_and_what_cannot_be_compared_is_said(self):
        rows = dict(self.browser.evaluate("[...document.querySelectorAll('.hardware tbody tr')].map(row => [row.cells[0].textContent, [...row.cells].slice(1).map(cell => cell.textContent)])"))
        self.assertEqual(rows["CPU"], ["</script><b>x", "Old CPU", "Made-up CPU at 3 GHz"])
        self.assertEqual(rows["OpenGL version and driver"], ["4.6 driver 550.1"] * 3)
        self.assertEqual(rows["measured"], ["2026-03-01 10:20 UTC"] * 3)
        self.assertEqual(rows["warnings"], ["none", "the machine is busy (36 runs)", "none"])
        self.assertEqual(rows["memory"], ["16.0 GiB"] * 3)
        said = self.texts(".problems")[0]
        for part in ("commit: 0123456789ab on cellar and lab; fedcba987654 on attic", "a software renderer on attic", "2 configurations are missing on some machines"):
            self.assertIn(part, said)
        self.assertEqual(self.texts("#missing tbody td:first-child"), ["fog particles=400", "haze particles=400"])

    def test_times_of_machines_stand_together_only_where_it_is_said(self):
        self.assertIn("These are times of different machines in one chart.", self.texts("#times .across")[0])
        self.assertIn("Times of different machines are not compared here.", self.texts("header .across")[0])

    def test_no_width_needs_sideways_scrolling(self):
        for width in (420, 1400, 2560):
            for scheme in ("light", "dark"):
                self.browser.resize(width, 1000, mobile=width < 700)
                self.browser.prefer(scheme)
                self.browser.open(self.page)
                self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), width)

    def test_a_long_name_needs_no_sideways_scrolling(self):
        page = os.path.join(self.place, "long.html")
        called = report(os.path.join(self.place, "lab"), os.path.join(self.place, "attic"), "--label", "x" * 60, "--label", "y" * 60, "--out", page)
        self.assertEqual(called.returncode, 0, called.stderr)
        self.browser.resize(420, 1000, mobile=True)
        self.browser.open(page)
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 420)

    def test_dark_and_light_can_be_read(self):
        for scheme in ("light", "dark"):
            self.browser.prefer(scheme)
            self.browser.wait_for(f"document.documentElement.dataset.theme === '{scheme}'")
            self.browser.wait_for("document.querySelector('#chart-other-times svg') !== null", 5)
            worst = self.browser.evaluate(page_case.CONTRAST)
            self.assertGreaterEqual(worst[0][0], 4.5, f"{scheme}: {worst}")
