"""Chooses the gates for a change, from the changed files and the table that CMake writes (tests/gates/table.cmake).

The tests of a changed module, and of every module that links it, also run under the sanitizers. A test of the whole program
runs if one of its modules or files has changed. The tests of all modules run in the release build.
"""
import dataclasses
import pathlib
import subprocess

EVERYTHING = "ALL"


class BadTable(Exception):
    """A line of the table cannot be read, or the table does not cover a file."""


@dataclasses.dataclass
class Module:
    folder: str
    program: str | None
    links: list[str]


@dataclasses.dataclass
class ProgramTest:
    modules: list[str]
    files: list[str]


@dataclasses.dataclass
class Table:
    modules: dict[str, Module]
    tests: dict[str, ProgramTest]
    places: dict[str, list[str]]

    def below(self, name):
        """The modules that a name means: one module, a folder of modules, or the last part of such a folder."""
        if name in self.modules:
            found = [name]
        else:
            found = [other for other, module in self.modules.items() if is_below(module.folder, name)]
        found = found or [other for other, module in self.modules.items() if f"/{name}/" in f"/{module.folder}/"]
        # A folder also means the modules in its subfolders.
        return sorted({other for each in found for other, module in self.modules.items()
                       if is_below(module.folder, self.modules[each].folder)})

    def dependents(self, names):
        """These modules and all that link them. The modules of one method use each other's headers, so they count as one."""
        reached = set(names)

        def is_next(name, module):
            return reached & set(module.links) or any(method_of(module) and method_of(module) == method_of(self.modules[other]) for other in reached)

        while more := {name for name, module in self.modules.items() if name not in reached and is_next(name, module)}:
            reached |= more
        return reached


@dataclasses.dataclass
class Plan:
    everything: str = ""  # the reason, or empty
    changed: set = dataclasses.field(default_factory=set)  # names of modules, as in `checked`
    checked: set = dataclasses.field(default_factory=set)
    tests: set = dataclasses.field(default_factory=set)  # names of tests of the whole program


def method_of(module):
    """The name of the method that the module belongs to, or None."""
    parts = pathlib.PurePath(module.folder).parts
    return parts[1] if parts[0] == "methods" and parts[1] not in ("contract", "kit") else None


def is_below(path, folder):
    return path == folder or path.startswith(folder.rstrip("/") + "/")


def read(text):
    table = Table({}, {}, {})
    for line in text.splitlines():
        kind, name, *rest = line.split()
        if kind == "module":
            folder, program, *links = rest
            table.modules[name] = Module(folder, None if program == "-" else program, links)
        elif kind == "test":
            at = rest.index("FILES")
            table.tests[name] = ProgramTest(rest[1:at], rest[at + 1:])
        elif kind == "place":
            table.places[name] = rest
        else:
            raise BadTable(f"got the line '{line}', expected module, test or place")
    return table


def unknown_names(table):
    """Names in the table that are neither a module nor a folder of modules: misspelt, or left over from a deleted module."""
    given = {(f"test {name}", module) for name, test in table.tests.items() for module in test.modules}
    given |= {(f"place {path}", module) for path, names in table.places.items() for module in names if module != EVERYTHING}
    return sorted(f"{line}: '{name}' is neither a module nor a folder of modules" for line, name in given if not table.below(name))


def holder(table, file):
    """The owner of a file: (module, None), (None, place) or (None, None). The longest path wins."""
    folders = {module.folder: name for name, module in table.modules.items() if is_below(file, module.folder)}
    folder = max(folders, key=len, default="")
    place = max((path for path in table.places if is_below(file, path)), key=len, default="")
    return (folders[folder], None) if len(folder) > len(place) else (None, place or None)


def is_of_the_build(file):
    return pathlib.PurePath(file).name == "CMakeLists.txt" or file.endswith((".cmake", ".cmake.in"))


def select(table, files, deleted=()):
    """The gates for these changed files, paths from the root; some of them may be deleted."""
    plan = Plan()
    inputs = set()  # modules whose data changed, but not their sources
    for file in files:
        tests = {name for name, test in table.tests.items() if any(is_below(file, path) for path in test.files)}
        plan.tests |= tests
        module, place = holder(table, file)
        if is_of_the_build(file):
            plan.everything = plan.everything or f"{file} is a build file"
        elif module and is_below(table.modules[module].folder, "methods") and not method_of(table.modules[module]):
            plan.everything = plan.everything or f"{file} belongs to the contract or the kit"
        elif module:
            plan.changed.add(module)
        elif place and EVERYTHING in table.places[place]:
            plan.everything = plan.everything or f"{file} affects everything"
        elif place:
            inputs.update(name for given in table.places[place] for name in table.below(given))
        elif file in deleted:
            plan.everything = plan.everything or f"{file} is deleted, together with its module"
        elif not tests:
            raise BadTable(f"{file}: not covered by a module, test or place of the table; add one in tests/gates/table.cmake")
    if plan.everything:
        plan.checked, plan.tests = set(table.modules), set(table.tests)
        return plan
    plan.checked = table.dependents(plan.changed) | inputs
    plan.tests |= {name for name, test in table.tests.items()
                   if plan.checked & {module for given in test.modules for module in table.below(given)}}
    return plan


def git(root, *arguments):
    """The lines that git prints, or None if it fails."""
    done = subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True)
    return done.stdout.splitlines() if done.returncode == 0 else None


def changed_files(root, base):
    """The files that differ from a commit, including deleted and untracked ones."""
    return sorted({*git(root, "diff", "--name-only", "--no-renames", base), *git(root, "ls-files", "--others", "--exclude-standard")})


def merge_base(root, revision):
    found = git(root, "merge-base", revision, "HEAD")
    return found[0] if found else None


def verified(root):
    """The commit in .ci/verified, or None and the reason."""
    try:
        commit = (root / ".ci" / "verified").read_text().split()[0]
    except (OSError, IndexError):
        return None, ".ci/verified is missing or empty"
    if git(root, "cat-file", "-e", f"{commit}^{{commit}}") is None:
        return None, f"{commit} in .ci/verified is not a commit of this repository"
    if git(root, "merge-base", "--is-ancestor", commit, "HEAD") is None:
        return None, f"{commit} in .ci/verified is not an ancestor of HEAD"
    return commit, ""
