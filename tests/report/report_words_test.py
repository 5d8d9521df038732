"""Numbers on the page, in sentences, scales and tables. report_page_test.py runs these tests."""

import json

import made_folder
import page_case

REPORT = """({ data: JSON.parse(document.getElementById('report-data').textContent), columns: JSON.parse(document.getElementById('report-columns').textContent),
    specifications: JSON.parse(document.getElementById('report-charts').textContent) })"""
METHODS = {"null_method": 40, "billboard": 6, "octree_search": 30}  # number of frames of the method's run


class ReportWords(page_case.PageCase):
    @classmethod
    def make_rows(cls):
        rows = []
        for number, (method, frames) in enumerate(METHODS.items()):
            row = {"run_id": f"run-{number}", "status": "done", "reason": "", "method": method, "scene": "plain", "drive": "straight", "repetition": 1,
                   "frames": frames, "fps_avg": 100, "frame_ms_median": 10, "draw_ms_median": 10, "flip": 0.1, "psnr_db": 30, "gpu_bytes": 1e6}
            place = made_folder.write_run(cls.folder, row, {"puff": "texture", "soft": "off"})
            with open(f"{place}/frames.csv", "w", encoding="utf-8") as stream:
                stream.write("frame,time_s,frame_ms\n" + "".join(f"{i},{i / 60},{10 + i % 3}\n" for i in range(frames)))
            rows.append(row)
        # A run with pictures only, without numbers for the overview.
        made_folder.write_run(cls.folder, {"run_id": "bare", "status": "done", "reason": "", "method": "relief", "scene": "plain", "drive": "straight",
                                           "repetition": 1, "frames": 2, "gpu_bytes": 1e6}, {})
        return rows

    def said(self, script):
        return json.loads(self.browser.evaluate(f"JSON.stringify({script})"))

    def test_numbers_that_differ_are_told_apart(self):
        def claim(measured, low, high, least, most):
            return json.dumps({"measured": measured, "low": low, "high": high, "min": least, "max": most})

        cases = [  # measured, low, high, min, max, unit; its text, its range
            ((213.438, 213.438, 213.438, 213.5, 214.5), "", "213", "213.5 to 214.5"),
            ((213.438, 213.438, 213.438, 213.438, 213.438), "", "213.438", "213.438"),
            ((0.9999, 0.9999, 0.9999, None, 1), "", "0.9999", "1 or less"),
            ((0.99996, 0.99996, 0.99996, 0.99998, None), "", "0.99996", "0.99998 or more"),
            ((62967808, 62967808, 62967808, 62967808, 62967808), "", "62,967,808", "62,967,808"),
            ((27, 27, 27, 0.996, 1.004), "", "27", "0.996 to 1.004"),
            ((0.523678, 0.523188, 0.524167, 0.5226, 0.5246), "", "0.5237 [0.5232, 0.5242]", "0.5226 to 0.5246"),
            ((1.90957, 1.90779, 1.91136, None, 2), "×", "1.910× [1.908×, 1.911×]", "2× or less"),
            ((0.1234, 0.1111, 0.1357, 0.02, None), "share of the trail", "12.3 [11.1, 13.6]\u00a0% of the trail", "2\u00a0% of the trail or more"),
            ((36.96, 36.6, 37.14, None, 1e-5), "ms", "37.0 [36.6, 37.1]\u00a0ms", "0.01\u00a0µs or less"),
        ]
        for numbers, unit, text, limits in cases:
            shown = self.said(f"[words.measuredText({claim(*numbers)}, '{unit}'), words.rangeOf({claim(*numbers)}, '{unit}')]")
            self.assertEqual(shown, [text, limits])

    def test_a_scale_has_several_ticks_in_the_unit_of_the_sentence(self):
        for low, high in ((26, 92), (0.0047, 0.0061), (213.3, 214.6), (62967800, 62967900), (-0.3, 0.2), (1, 1.0001), (4, 6)):
            for log in ("true", "false") if low > 0 else ("false",):
                ticks = self.said(f"claimList.ticksOf({low}, {high}, {log})")
                self.assertGreaterEqual(len(set(ticks)), 2, (low, high, log))
                self.assertTrue(all(low <= tick <= high * (1 + 1e-6) for tick in ticks), ticks)
        drawn = self.said("""[...claimList.entry(%s, { paper: 'x', id: 'X', text: 'x', reason: '', verdict: 'confirmed', verdictText: 'confirmed', measured: 0.124, low: 0.1, high: 0.145, min: 0.02, max: null, cells: [],
            runs: [], controls: [], control: '', note: '', condition: '', over: 'seeds', rule: { quantity: 'value', column: 'gaps', of: 'billboard' } }, () => '').querySelectorAll('.claim-range text')]
            .map(text => text.textContent)""" % REPORT)
        self.assertTrue(len(drawn) > 1 and all(text.endswith("%") for text in drawn), drawn)

    def test_without_chance_an_interval_is_named(self):
        for low, text in ((1.9, "the interval comes from the fit"), (2, "no interval")):
            self.assertIn(text, self.said(f"words.testedOf({{ measured: 2, low: {low}, high: 2, over: '', cells: [], rule: {{}} }})"))

    def test_a_control_has_the_unit_and_the_digits_of_its_claim(self):
        rule = {"quantity": "finding", "of": "", "experiment": "x", "column": "a_b", "name": "kept", "unit": "share of all"}
        control = {"why": "known", "rule": rule | {"column": "c"}, "known": "refuted", "verdict": "refuted", "measured": 0.90744}
        claim = {"min": 0.9073, "max": None, "control": "turned", "controls": [control, control | {"verdict": "confirmed", "measured": 1e-7}, control | {"verdict": "not-tested", "measured": None}]}
        self.assertEqual(self.said(f"words.controlsOf({REPORT}, {json.dumps(claim)})"),
                         "refuted, as expected (90.74\u00a0% of all: known); confirmed, expected: refuted (1.0·10⁻⁵\u00a0% of all: known); not run: known")
        self.assertEqual(self.said(f"words.quantityOf({REPORT}, {{ rule: {json.dumps(rule)} }})"), ["kept (experiment x)", "share of all"])
        self.assertEqual(self.said(f"words.quantityOf({REPORT}, {{ rule: {json.dumps(rule | {'column': 'a|b'})} }})[0]"), "kept, mean of 2 values (experiment x)")

    def test_a_comparison_tells_of_the_side_that_is_faster(self):
        cell = {"pairs": 6, "ratio": 1.25, "low": 1.2, "high": 1.3, "verdict": "SLOWER"}
        column = {"column": "frame_ms_median", "overall": cell, "cells": [cell, cell | {"verdict": "UNRESOLVED"}, cell | {"verdict": "FASTER"}]}
        said = self.said(f"words.comparisonSentence({REPORT}, {{ of: 'thick', with: 'thin' }}, {json.dumps(column)})")
        self.assertEqual(said["head"], "thin has a shorter frame time than thick")
        self.assertEqual(said["text"], "0.800× that of thick; 95\u00a0% interval 0.769× to 0.833×, 6 paired rounds over 3 loads (faster at 1, unresolved at 1, slower at 1).")

    def test_cells_are_named_as_everywhere(self):
        cases = [("p.particles=1000 p.system=thesis_aa_sprites", "particles 1000, system thesis_aa_sprites"), ("grid=16x12 soft=off", "grid 16×12, soft off"),
                 ("true for finding silhouette_kept_bunny, false with silhouette_kept_car", "true for silhouette kept bunny, false with silhouette kept car")]
        self.assertEqual(self.said(f"{json.dumps([case[0] for case in cases])}.map(words.readable)"), [case[1] for case in cases])
        rule = {"rule": {"quantity": "finding", "column": "kept_at_50_car|kept_at_50_old_car|kept_at_50_hare"}}
        self.assertEqual(self.said(f"words.cellText({json.dumps(rule)}, 'true for finding kept_at_50_old_car, false with kept_at_50_car, kept_at_50_hare')"),
                         "true for old car, false with car, hare")
        rule["rule"]["column"] = "speed_5|speed_10"
        self.assertEqual(self.said(f"words.cellText({json.dumps(rule)}, 'true for finding speed_10, false with speed_5')"), "true for speed 10, false with speed 5")
        self.assertEqual(self.said("chartData.tied('octree, speed 0.01 m/s, resolution 50, grid 32×64×32')"), "octree, speed 0.01\u00a0m/s, resolution 50, grid 32×64×32")
        self.assertEqual(self.said("chartData.settingText({ name: 'grid', unit: '' }, '32x64x32')"), "grid 32×64×32")
        self.assertEqual(self.said("words.labelText('reference of billboard puff=texture soft=off')"), "reference of billboard, puff texture, soft off")

    def test_the_overview_has_rows_with_numbers_and_heads_that_paper_repeats(self):
        self.touch()
        heads = "[...document.querySelectorAll('.overview th')].map(head => [head.textContent, head.querySelectorAll('button').length])"
        on_screen = self.said(heads)
        self.assertTrue(all(buttons == 1 for _, buttons in on_screen))
        rows = self.said("[...document.querySelectorAll('.overview tbody tr')].map(row => row.cells[0].textContent)")
        self.assertTrue(rows and not any(row.startswith("relief") for row in rows), rows)
        self.assertIn(f"{len(rows)} of {len(rows)} rows shown", self.browser.evaluate("document.querySelector('.overview .note').textContent"))
        self.browser.evaluate("window.dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(self.said(heads), [[text, 0] for text, _ in on_screen])
        self.settled()
        widths = self.said("[...document.querySelectorAll('.chart svg')].map(svg => Number(svg.getAttribute('width')))")
        self.assertTrue(widths and max(widths) < 760, widths)
        self.browser.evaluate("window.dispatchEvent(new Event('afterprint'))")
        self.settled()
        self.assertEqual(self.said(heads), on_screen)

    def test_frame_times_open_on_a_long_run_of_a_method_and_say_which(self):
        built = """(run => { const report = %s; const { spec, notes, state } = chartKit.build(report, { id: 'frames', kind: 'frames', run });
            return [report.data.frames.find(item => item.run === state.run).label.split(/[ ,]/)[0], notes[0], spec.marks.length]; })""" % REPORT
        method, note, panels = self.said(f"{built}()")
        self.assertEqual((method, panels), ("octree_search", 2))
        self.assertTrue(note.startswith("octree_search"), note)
        short = self.said(f"{REPORT}.data.frames.find(item => item.frames === 6).run")
        self.assertEqual(self.said(f"{built}({short})")[2], 1, "six frames are too few for a distribution")

    def test_pictures_of_equal_cost_have_no_chart(self):
        self.assertEqual(self.said(f"chartKit.list({REPORT}).filter(chart => chart.kind === 'quality')"), [])
        self.assertIn("No chart", self.browser.evaluate("document.getElementById('quality').textContent"))

    def test_stages_have_no_methods_colour(self):
        for theme in ("light", "dark"):
            self.assertEqual(self.said(f"chartStyle.stageColours.{theme}.filter(colour => [...chartStyle.methodColours.{theme}, chartStyle.baselineColour.{theme}].includes(colour))"), [])
