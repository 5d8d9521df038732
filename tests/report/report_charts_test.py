"""The charts of the report: their content, initial state and saved files. report_page_test.py runs these tests."""

import csv
import io
import json
import os
import statistics
import subprocess

import made_folder
import page_case

# The chart with an id, as the page builds it.
BUILT = """(() => { const read = id => JSON.parse(document.getElementById(id).textContent);
    const report = { data: read('report-data'), columns: read('report-columns'), specifications: read('report-charts') };
    return chartKit.build(report, chartKit.list(report).find(chart => chart.id === '%s')); })()"""


class ReportCharts(page_case.PageCase):
    def test_every_chart_has_marks(self):
        self.touch()
        self.browser.evaluate("document.getElementById('other-runs').open = true")
        marks = self.marks()
        expected = {f"chart-{suite}-quick{part}" for suite in page_case.SUITES for part in ("", "-stages")}
        self.assertEqual(set(marks), expected | {"chart-carr2006-flaws-quick-quality", "chart-frames", "chart-other", "chart-other-stages",
                                                "chart-carr2006-by-voxel_edge"})
        self.assertTrue(all(count > 3 for count in marks.values()), marks)

    def test_a_method_switched_off_leaves_every_chart(self):
        before = self.marks()
        self.browser.evaluate("document.querySelector('.chip[data-method=billboard]').click()")
        after = self.marks()
        self.assertLess(after["chart-carr2006-compare-quick"], before["chart-carr2006-compare-quick"])
        self.assertLess(after["chart-carr2006-compare-quick-stages"], before["chart-carr2006-compare-quick-stages"])
        self.assertEqual(after["chart-carr2006-fig5-quick"], 0)
        self.assertEqual(after["chart-carr2006-fig7-quick"], before["chart-carr2006-fig7-quick"])
        self.assertIn("current selection", self.browser.evaluate("document.querySelector('#chart-carr2006-fig5-quick').textContent"))
        self.browser.evaluate("document.querySelector('.chip[data-method=billboard]').click()")
        self.assertEqual(self.marks(), before)

    def test_scales_and_quantities_can_be_chosen(self):
        def labels(chart):
            self.settled()
            return self.browser.evaluate(f"[...document.querySelectorAll('#{chart} .role-axis text')].map(text => text.textContent)")

        self.touch()
        chart = "chart-carr2006-compare-quick"
        linear = labels(chart)
        self.assertIn("frame rate [frames/s]", linear)
        self.choose(chart, "yLog", "true")
        self.assertNotEqual(labels(chart), linear)
        self.choose(chart, "column", "gpu_bytes")
        self.assertTrue(any("GPU memory" in text and "[MB]" in text for text in labels(chart)))
        self.choose("chart-carr2006-flaws-quick-quality", "metric", "psnr_db")
        self.assertIn("PSNR [dB]", labels("chart-carr2006-flaws-quick-quality"))

    def test_axes_say_the_very_numbers(self):
        self.touch()
        self.browser.evaluate("document.getElementById('other-runs').open = true")
        self.settled()
        labels = self.browser.evaluate("[...document.querySelectorAll('#chart-other .role-axis-label text')].map(text => text.textContent)")
        for particles in ("25", "125", "333"):
            self.assertIn(particles, labels)

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
        for part in ("billboard", "particles", "frame rate", "frames/s", "interval of the median"):
            self.assertIn(part, said)

    def test_saves_a_chart_as_svg_and_png(self):
        for ending, start in (("svg", b"<svg"), ("png", b"\x89PNG")):
            saved = self.saved(f".controls:has(+ #chart-carr2006-fig7-quick) .save-{ending}", f"carr2006-fig7-quick.{ending}")
            self.assertTrue(saved.startswith(start), ending)

    def test_saves_the_numbers_of_a_chart_as_csv_and_json(self):
        def median(method, particles):
            return statistics.median(row["fps_avg"] for row in self.rows if row["method"] == method and row["frames"] == 30 and
                                     row["run_id"] in runs and row["p.particles"] == particles)

        runs = {run_id for run_id, *_ in made_folder.planned(page_case.PROGRAM, "carr2006-fig7", self.folder)}
        button = ".controls:has(+ #chart-carr2006-fig7-quick) .save-"
        table = list(csv.DictReader(io.StringIO(self.saved(button + "csv", "carr2006-fig7-quick.csv").decode())))
        self.assertEqual({row["method"] for row in table}, {"octree_recursive", "octree_search"})
        for row in table:
            particles = row["world"].removeprefix("particles ")
            self.assertAlmostEqual(float(row["fps_avg"]) / median(row["method"], particles), 1, delta=1e-4)
            self.assertLessEqual(float(row["fps_avg_low"]), float(row["fps_avg"]))
        saved = json.loads(self.saved(button + "json", "carr2006-fig7-quick.json"))
        names = [column["name"] for column in saved["columns"]]
        self.assertEqual(saved["columns"][names.index("fps_avg")]["unit"], "frames/s")
        self.assertEqual([str(row[names.index("fps_avg")]) for row in saved["rows"]], [row["fps_avg"] for row in table])

    def test_gives_the_suites_file(self):
        saved = self.saved("#experiment-carr2006-flaws-quick .save-toml", "carr2006-flaws.toml")
        with open(os.path.join(page_case.ROOT, "data/papers/carr2006/suites/carr2006-flaws.toml"), "rb") as stream:
            self.assertEqual(saved, stream.read())

    def test_a_suite_says_what_its_chart_opens_on_and_seeds_are_one(self):
        self.settled()
        labels = self.browser.evaluate("[...document.querySelectorAll('#chart-carr2006-flaws-quick .role-axis-title text')].map(text => text.textContent)")
        self.assertEqual(set(labels), {"gaps [% of the trail]", "speed [m/s]"})
        built = json.loads(self.browser.evaluate("JSON.stringify(" + BUILT % "carr2006-flaws-quick" + ".table)"))
        names = [name for name, _ in built["columns"]]
        for row in built["rows"]:
            of = dict(zip(names, row))
            speed = float(of["world"].split()[1])
            self.assertEqual(of["seeds"], 5)
            for name, seed in (("gaps", 3), ("gaps_low", 1), ("gaps_high", 5)):
                self.assertAlmostEqual(of[name], made_folder.gaps_of(speed, seed), delta=1e-6)

    def test_stages_show_the_methods_own_and_say_how_they_were_timed(self):
        self.touch()
        chart = "chart-carr2006-compare-quick-stages"

        def legend():
            self.settled()
            return self.browser.evaluate(f"[...document.querySelectorAll('#{chart} .role-legend-label text')].map(text => text.textContent)")

        self.assertEqual(legend(), ["simulate", "build", "sort", "upload", "draw"])
        self.assertIn("--sync frame", self.browser.evaluate(f"document.querySelector('#{chart} + .note').textContent"))
        self.choose(chart, "part", "frame")
        self.assertEqual(legend(), list(made_folder.STAGES))

    def test_labels_are_short_where_long_ones_would_be_left_out(self):
        self.assertEqual(self.browser.evaluate("""[[[100, 2000, 5000], [0, 60, 94]], [[100, 2000, 5000], [0, 90, 180]], [[0.25, 0.5], [0, 20]]]
            .map(([ticks, places]) => costChart.tickFormat(ticks, places))"""), [".6~s", ",.6~r", ",.6~r"])

    def test_a_map_shows_the_verdict_of_each_configuration(self):
        built = self.browser.evaluate("(() => { const { spec, table, caption } = " + BUILT % "carr2006-by-voxel_edge" + """;
            const of = name => spec.data.find(item => item.name === name).values;
            return { panels: of('panels'), tiles: of('tiles'), table, caption }; })()""")
        self.assertIn(["R2a: confirmed"], [panel["title"] for panel in built["panels"]])
        tiles = [tile for tile in built["tiles"] if tile["panel"] == "R2af"]
        self.assertEqual({(tile["x"], tile["y"]) for tile in tiles}, {(load, edge) for load in ("1000", "50000") for edge in ("2", "0.0625")})
        for tile in tiles:
            self.assertEqual(tile["row"], 0 if tile["y"] == "2" else 1, "the largest voxel on top")
            self.assertEqual(tile["column"], 0 if tile["x"] == "1000" else 1)
            self.assertEqual(tile["verdict"], "confirmed")
            self.assertRegex(tile["text"], r"^✓ 0\.8\d*×$")
        self.assertEqual(sum(row[0] == "R2af" for row in built["table"]["rows"]), len(tiles))
        self.assertIn("llvmpipe (made up)", built["caption"][-1])
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#chart-carr2006-by-voxel_edge .tile path').length"), len(built["tiles"]))

    def test_settings_beyond_two_divide_a_tile(self):
        tiles = self.browser.evaluate("""(() => {
            const cell = (edge, speed, levels, verdict) => ({ at: { voxel_edge: edge, speed, levels }, text: '', verdict, measured: 2, low: 1, high: 3, turns: 6 });
            const claim = { id: 'X', paper: 'x', text: 'x', verdict: 'depends', verdictText: 'depends', min: null, max: 1, measured: 2, low: 1, high: 3, controls: [],
                rule: { quantity: 'value', column: 'gaps', per: '', parts: [], of: '', with: '', along: 'voxel_edge' },
                cells: ['4', '8'].flatMap(edge => ['10', '5'].flatMap(speed => ['2', '1'].map(levels => cell(edge, speed, levels, levels === '1' ? 'confirmed' : 'refuted')))) };
            const read = id => JSON.parse(document.getElementById(id).textContent);
            const data = { ...read('report-data'), claims: [claim], papers: [{ id: 'x' }] };
            const report = { data, columns: read('report-columns'), specifications: read('report-charts') };
            const map = mapChart.listOf(report)[0];
            const built = chartKit.build(report, { ...map, kind: 'map' });
            return [map.id, built.spec.data.find(item => item.name === 'tiles').values.map(tile => [tile.x, tile.y, tile.strip, tile.strips, tile.text]), built.caption.join(' ')];
        })()""")
        self.assertEqual(tiles[0], "x-by-voxel_edge")
        self.assertEqual(sorted(tiles[1]), sorted([speed, edge, strip, 2, "✓✗"[strip]] for speed in ("5", "10") for edge in ("4", "8") for strip in (0, 1)))
        self.assertIn("from left to right: levels 1, 2.", tiles[2])

    def test_where_methods_lack_the_load_all_are_bars(self):
        built = self.browser.evaluate("""(() => {
            const cell = (method, settings, fps) => ({ method, settings, machine: 0, failed: 0, probability: 0, runs: [0], values: { fps_avg: fps, frame_ms_median: 1 } });
            const experiment = { id: 'x', suite: '', title: '', axes: [{ name: 'x', unit: '', world: false, numeric: true, values: ['2', '10'] }], fits: [], published: [],
                cells: [cell('C', { x: '10' }, 4), cell('A', {}, 1), cell('C', { x: '2' }, 3), cell('B', {}, 2)] };
            const data = { ...JSON.parse(document.getElementById('report-data').textContent), experiments: [experiment] };
            const report = { data, columns: JSON.parse(document.getElementById('report-columns').textContent), specifications: JSON.parse(document.getElementById('report-charts').textContent) };
            const { table, state } = chartKit.build(report, chartKit.list(report)[0]);
            return [state.x, table.rows.map(row => `${row[0]} ${row[1]}`.trim())];
        })()""")
        self.assertEqual(built, ["bars", ["A", "B", "C x 2", "C x 10"]])

    def test_a_load_that_the_suite_names_gives_level_lines_where_methods_lack_it(self):
        built = self.browser.evaluate("""(() => {
            const cell = (method, settings, fps) => ({ method, settings, machine: 0, failed: 0, probability: 0, runs: [0], values: { fps_avg: fps, frame_ms_median: 1 } });
            const experiment = { id: 'x', suite: '', title: '', chart: { column: 'fps_avg', against: 'x' }, fits: [], published: [],
                axes: [{ name: 'x', unit: '', world: false, numeric: true, values: ['2', '5', '10'] }],
                cells: [cell('C', { x: '10' }, 4), cell('A', {}, 1), cell('C', { x: '2' }, 3), cell('C', { x: '5' }, 6), cell('null_method', {}, 9)] };
            const data = { ...JSON.parse(document.getElementById('report-data').textContent), experiments: [experiment] };
            const report = { data, columns: JSON.parse(document.getElementById('report-columns').textContent), specifications: JSON.parse(document.getElementById('report-charts').textContent) };
            const { spec, state } = chartKit.build(report, chartKit.list(report)[0]);
            return [state.x, spec.data.find(({ name }) => name === 'points').values.map(({ series, x, y }) => `${series} ${x} ${y}`).sort()];
        })()""")
        self.assertEqual(built, ["x", ["A 10 1", "A 2 1", "C 10 4", "C 2 3", "C 5 6"]])

    def test_a_front_needs_intervals_that_separate(self):
        def front(points, high="false"):
            made = [dict(zip(("x", "xLow", "xHigh", "y", "yLow", "yHigh"), point)) for point in points]
            return self.browser.evaluate(f"(all => qualityChart.frontOf(all, {high}).map(point => all.indexOf(point)))({json.dumps(made)})")

        cheap, good = (1, 0.9, 1.1, 5, 4.9, 5.1), (3, 2.9, 3.1, 1, 0.9, 1.1)
        self.assertEqual(front([cheap, good]), [0, 1])
        self.assertEqual(front([cheap, good, (4, 3.5, 4.5, 6, 5.5, 6.5)]), [0, 1], "beaten in both")
        self.assertEqual(front([cheap, (1.05, 0.95, 1.15, 5, 4.9, 5.1)]), [], "which of the two leads is open")
        self.assertEqual(front([cheap, good], "true"), [0], "errs less and costs less")

    def test_colours_follow_names(self):
        colours = self.browser.evaluate("""(() => {
            const of = names => { const report = { data: { experiments: [{ cells: names.map(method => ({ method })) }] } };
                return names.map(name => chartKit.methodColour(report, name, 'light')); };
            const known = ['billboard', 'dense_grid', 'grid_fluid', 'octree_recursive', 'octree_search', 'plugin_particles', 'relief', 'voxel_shape', 'null_method'];
            return [of(known), of(['billboard', 'relief']), of([...known.slice(0, 8), 'aaa'])];
        })()""")
        self.assertEqual(len(set(colours[0])), 9)
        self.assertEqual(colours[1], [colours[0][0], colours[0][6]])
        self.assertEqual(len(set(colours[2])), 9)

    def test_numbers_have_few_digits_and_units(self):
        cases = [(2175000, "bytes", "2.17 MB"), (999, "bytes", "999 bytes"), (5.4e9, "bytes", "5.40 GB"), (0.1243, "share of the trail", "12.4 % of the trail"),
                 (1.2874, "×", "1.29×"), (113.4, "frames/s", "113 frames/s"), (0.00028, "ms", "0.280 µs"), (-0.5, "", "−0.500"), (57280, "particles", "57,300 particles"),
                 (2000, "particles", "2,000 particles"), (2.85e-7, "", "2.9·10⁻⁷"), (None, "ms", "–")]
        self.assertEqual(self.browser.evaluate(f"{json.dumps([case[:2] for case in cases])}.map(([value, unit]) => chartStyle.withUnit(value, unit))"),
                         [case[2].replace(" ", "\u00a0", 1) for case in cases])

    def test_long_names_break_in_a_narrow_legend(self):
        name = "octree_recursive, layout faithful, render billboards, policy accumulate"
        def lines(width):
            return self.browser.evaluate(f"chartParts.legendLines([{json.dumps(name)}, 'billboard'], {width})")

        self.assertEqual(lines(900), [name, "billboard"])
        self.assertEqual(lines(380), ["octree_recursive, layout faithful,\nrender billboards, policy accumulate", "billboard"])

    def test_charts_come_as_files_without_a_browser(self):
        for ending, start in (("svg", b"<svg"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
            with open(self.report("--chart", "fig7", "--format", ending).strip(), "rb") as stream:
                content = stream.read()
            self.assertTrue(content.startswith(start), ending)
            if ending == "svg":
                self.assertIn(b"octree_recursive", content)
        called = subprocess.run([page_case.PROGRAM, "report", self.folder, "--chart", "fig77"], capture_output=True, text=True)
        self.assertEqual(called.returncode, 3)
        self.assertIn("carr2006-fig7-quick", called.stderr)
