"""The choice of gates: a change in each folder of the tree selects the gates that it concerns.

    selection_test.py TABLE        gates.txt of a build
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / ".ci"))
import selection  # noqa: E402

TABLE = None  # set below

SMALL = """module base methods/kit/base base_tests
module method methods/method method_tests base
module inner methods/method/inner inner_tests
module room bench/room room_tests base
module upper bench/room/upper - room
module pictures tests/pictures pictures_tests method inner
test whole.Room FOR bench/room FILES docs/room.txt
test whole.Method FOR method FILES tests/method/
place docs
place data/rooms room
place build.sh ALL
"""


def tracked():
    done = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True)
    return [name for name in done.stdout.splitlines() if (ROOT / name).exists()]


class ASmallTable(unittest.TestCase):
    def setUp(self):
        self.table = selection.read(SMALL)

    def chosen(self, *files, **more):
        plan = selection.select(self.table, files, **more)
        return plan.checked, plan.tests

    def test_a_change_reaches_whoever_links_its_module(self):
        self.assertEqual(self.chosen("methods/kit/base/a.cpp"),
                         (set(self.table.modules), set(self.table.tests)))
        self.assertEqual(self.chosen("bench/room/a.cpp"), ({"room", "upper"}, {"whole.Room"}))
        self.assertEqual(self.chosen("bench/room/upper/a.cpp"), ({"upper"}, {"whole.Room"}))

    def test_modules_of_a_method_count_as_one(self):
        for folder in ("", "inner/"):
            self.assertEqual(self.chosen(f"methods/method/{folder}a.cpp"), ({"method", "inner", "pictures"}, {"whole.Method"}))

    def test_the_innermost_folder_has_a_file(self):
        self.assertEqual(selection.select(self.table, ["bench/room/upper/a.frag"]).changed, {"upper"})
        self.assertEqual(selection.select(self.table, ["bench/room/parts/a.cpp"]).changed, {"room"})

    def test_a_folder_without_a_module_concerns_those_that_its_place_names(self):
        self.assertEqual(self.chosen("docs/other.txt"), (set(), set()))
        self.assertEqual(self.chosen("data/rooms/a.toml"), ({"room", "upper"}, {"whole.Room"}))

    def test_a_file_of_a_test_runs_it(self):
        self.assertEqual(self.chosen("docs/room.txt"), (set(), {"whole.Room"}))
        self.assertEqual(self.chosen("tests/method/a.py"), (set(), {"whole.Method"}))

    def test_files_of_the_build_concern_everything(self):
        for file in ("build.sh", "CMakeLists.txt", "bench/room/CMakeLists.txt", "bench/cli/package.cmake"):
            plan = selection.select(self.table, ["docs/other.txt", file])
            self.assertIn(file, plan.everything)
            self.assertEqual((plan.checked, plan.tests), (set(self.table.modules), set(self.table.tests)))

    def test_a_file_without_a_place_is_an_error_that_names_it(self):
        for file in ("bench/new/a.cpp", "methods/newer/a.cpp", "tests/new/a.py", "docs2/a.txt", "methods/basement/a.cpp"):
            with self.assertRaisesRegex(selection.BadTable, f"^{file}: "):
                self.chosen("docs/other.txt", file)

    def test_a_deleted_folder_concerns_everything(self):
        plan = selection.select(self.table, ["methods/old/a.cpp"], deleted={"methods/old/a.cpp"})
        self.assertIn("methods/old/a.cpp", plan.everything)
        # Deleting a file from a folder that still exists concerns the folder's module.
        self.assertEqual(self.chosen("bench/room/upper/a.cpp", deleted={"bench/room/upper/a.cpp"}), ({"upper"}, {"whole.Room"}))

    def test_names_stand_for_modules_and_folders(self):
        self.assertEqual(self.table.below("method"), ["inner", "method"])
        self.assertEqual(self.table.below("bench/room"), ["room", "upper"])
        self.assertEqual(self.table.below("bench"), ["room", "upper"])
        self.assertEqual(self.table.below("nothing"), [])
        self.assertEqual(selection.unknown_names(self.table), [])
        self.assertEqual(selection.unknown_names(selection.read("test a FOR gone FILES\nplace b gone ALL\n")),
                         ["place b: 'gone' is neither a module nor a folder of modules", "test a: 'gone' is neither a module nor a folder of modules"])
        with self.assertRaises(selection.BadTable):
            selection.read("modul base methods/base base_tests\n")


class TheTable(unittest.TestCase):
    def test_has_a_place_for_every_file_of_the_tree(self):
        selection.select(TABLE, tracked())

    def test_names_modules_that_there_are(self):
        self.assertEqual(selection.unknown_names(TABLE), [])

    def test_a_change_in_each_module_checks_it_and_whoever_includes_its_headers(self):
        """Compares the links in CMake with the includes in the sources."""
        holder = {}  # module of each source, by folder
        for file in tracked():
            holder[file], _ = selection.holder(TABLE, file)
        users = {name: {name} for name in TABLE.modules}
        for file, module in holder.items():
            if file.endswith((".h", ".cpp")):
                for included in re.findall(r'^#include "([^"]+)"', (ROOT / file).read_text(), re.MULTILINE):
                    if holder.get(included) and module:
                        users[holder[included]].add(module)
        for name, module in TABLE.modules.items():
            plan = selection.select(TABLE, [f"{module.folder}/planted.cpp"])
            with self.subTest(module=name):
                self.assertLessEqual(users[name], plan.checked)
                if module.folder.startswith(("methods/contract", "methods/kit", "tests/gates")):
                    self.assertEqual((plan.checked, plan.tests), (set(TABLE.modules), set(TABLE.tests)))
                else:
                    self.assertEqual(plan.everything, "")
                    self.assertLess(len(plan.checked), len(TABLE.modules) / 2)

    def test_a_change_of_a_method_leaves_the_harness_alone(self):
        plan = selection.select(TABLE, ["methods/weighted_oit/weighted_oit.cpp"])
        self.assertEqual({name for name in plan.checked if TABLE.modules[name].folder.startswith("bench/")}, set())
        self.assertLessEqual({"weighted_oit", "shaders", "wheel_dust"}, plan.checked)
        self.assertEqual(plan.tests, {"documents.CommandsOf.weighted-oit"})

    def test_a_change_of_the_results_reaches_the_page_and_the_command(self):
        plan = selection.select(TABLE, ["bench/results/a.cpp"])
        self.assertLessEqual({"bench_report", "bench_cli", "bench_view"}, plan.checked)
        self.assertLessEqual({"whole_program.ReportPage", "whole_program.Faults", "whole_program.RealWindow"}, plan.tests)

    def test_gates_and_build_concern_everything(self):
        for file in (".ci/run", ".ci/selection.py", "CMakeLists.txt", "methods/CMakeLists.txt", "Makefile", "CMakePresets.json",
                     "methods/contract/method.h", "methods/kit/gpu/layer.cpp", "tests/gates/table.cmake"):
            self.assertNotEqual(selection.select(TABLE, [file]).everything, "", file)
        self.assertEqual(selection.select(TABLE, [".ci/verified"]).everything, "")


class TheBase(unittest.TestCase):
    """The commit that changes are compared with, in a repository made for the test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="dustbench-gates-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.git("init", "--quiet", "--initial-branch=main")
        (self.root / ".ci").mkdir()
        self.first = self.commit("a.txt", "one")

    def git(self, *arguments):
        identity = ["-c", "user.name=test", "-c", "user.email=test@example.org", "-c", "commit.gpgsign=false"]
        return subprocess.run(["git", *identity, *arguments], cwd=self.root, check=True, capture_output=True, text=True).stdout.strip()

    def commit(self, name, text):
        (self.root / name).write_text(text)
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message=change")
        return self.git("rev-parse", "HEAD")

    def verify(self, text):
        (self.root / ".ci" / "verified").write_text(text)

    def test_is_the_verified_commit_and_what_differs_from_it_has_changed(self):
        self.verify(f"{self.first} 2026-11-26 41 minutes\n")
        self.commit("b.txt", "two")
        (self.root / "a.txt").unlink()
        (self.root / "c.txt").write_text("not known to git yet")
        self.assertEqual(selection.verified(self.root), (self.first, ""))
        self.assertEqual(selection.changed_files(self.root, self.first), [".ci/verified", "a.txt", "b.txt", "c.txt"])

    def test_is_missing_where_it_cannot_be_told(self):
        self.assertEqual(selection.verified(self.root), (None, ".ci/verified is missing or empty"))
        self.verify("")
        self.assertEqual(selection.verified(self.root), (None, ".ci/verified is missing or empty"))
        self.verify("0123456789abcdef0123456789abcdef01234567 2026-11-26\n")
        self.assertIn("does not know", selection.verified(self.root)[1])
        self.git("checkout", "--quiet", "-b", "side")
        other = self.commit("side.txt", "three")
        self.git("checkout", "--quiet", "main")
        (self.root / ".ci").mkdir(exist_ok=True)
        self.verify(f"{other} 2026-11-26\n")
        self.assertIn("not an ancestor", selection.verified(self.root)[1])


if __name__ == "__main__":
    TABLE = selection.read(pathlib.Path(sys.argv.pop(1)).read_text())
    unittest.main()
