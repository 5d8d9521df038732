"""The page of runs with names of properties that every JavaScript object has. report_page_test.py runs these tests."""

import made_folder
import page_case

NAMES = ("__proto__", "constructor", "toString", "hasOwnProperty")


class ReportNames(page_case.PageCase):
    @classmethod
    def make_rows(cls):
        rows = []
        for method in NAMES:
            for particles in (100, 200, 400):
                for repetition in (1, 2):
                    ms = 5 + particles / 100 + repetition / 10
                    row = {"run_id": f"{method}-{particles}-{repetition}", "status": "done", "reason": "", "method": method,
                           "scene": "__proto__", "drive": "valueOf", "repetition": repetition, "frames": 3, "fps_avg": 1000 / ms,
                           "frame_ms_median": ms, "draw_ms_median": ms, "flip": 0.1, "psnr_db": 30}
                    made_folder.write_run(cls.folder, row, {"particles": particles, "__proto__": "off", "isPrototypeOf": "on"}, ["__proto__"])
                    rows.append(row)
        return rows

    def test_names_of_properties_are_names(self):
        self.touch()
        self.browser.evaluate("document.querySelectorAll('details.fold').forEach(fold => { fold.open = true; })")
        said = self.browser.evaluate("document.querySelector('main').textContent")
        for name in NAMES:
            self.assertIn(name, said)
        marks = self.marks()
        self.assertIn("chart-other", marks)
        self.assertTrue(all(count > 3 for count in marks.values()), marks)
        rows = self.browser.evaluate("[...document.querySelectorAll('#overview tbody tr')].map(row => row.cells[0].textContent)")
        self.assertEqual({name for name in NAMES if any(row.startswith(name) for row in rows)}, set(NAMES), rows)

    def test_a_method_of_such_a_name_is_switched_off_and_on(self):
        self.touch()
        self.browser.evaluate("document.querySelectorAll('details.fold').forEach(fold => { fold.open = true; })")
        before = self.marks()["chart-other"]
        for name in NAMES:
            self.browser.evaluate(f"document.querySelector('.chip[data-method={name}]').click()")
            self.assertLess(self.marks()["chart-other"], before, name)
            self.browser.evaluate(f"document.querySelector('.chip[data-method={name}]').click()")
            self.assertEqual(self.marks()["chart-other"], before, name)
