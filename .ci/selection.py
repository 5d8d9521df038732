"""Which gates a change needs, from the files that changed and from the table that CMake writes (tests/gates/table.cmake).

A module that changed, and every module that links it, runs its tests and again under the sanitizers. A test of the whole
program runs if one of the modules or files that it is for changed. All other tests of modules run in the release build.
"""
import dataclasses
import pathlib
import subprocess

EVERYTHING = "ALL"


class BadTable(Exception):
    """A line of the table cannot be read, or a file has no place in it."""


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
        """The modules that a name stands for: one module, a folder of modules, or the last part of such a folder."""
        if name in self.modules:
            found = [name]
        else:
            found = [other for other, module in self.modules.items() if is_below(module.folder, name)]
        found = found or [other for other, module in self.modules.items() if f"/{name}/" in f"/{module.folder}/"]
        # A folder stands for the modules in it as well.
        return sorted({other for each in found for other, module in self.modules.items()
                       if is_below(module.folder, self.modules[each].folder)})

    def dependents(self, names):
        """These modules and all that link them. The modules of one method use each other's headers: they count as one."""
        reached = set(names)

        def is_next(name, module):
            return reached & set(module.links) or any(method_of(module) and method_of(module) == method_of(self.modules[other]) for other in reached)

        while more := {name for name, module in self.modules.items() if name not in reached and is_next(name, module)}:
            reached |= more
        return reached


@dataclasses.dataclass
class Plan:
    everything: str = ""  # the reason, or empty
    changed: set = dataclasses.field(default_factory=set)  # modules, as are the next
    checked: set = dataclasses.field(default_factory=set)
    tests: set = dataclasses.field(default_factory=set)  # of the whole program


def method_of(module):
    """The folder of the method that it is a part of, or None."""
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
    """Names of the table that are no module and no folder of modules: misspelt, or left by a module that was deleted."""
    given = {(f"test {name}", module) for name, test in table.tests.items() for module in test.modules}
    given |= {(f"place {path}", module) for path, names in table.places.items() for module in names if module != EVERYTHING}
    return sorted(f"{line}: '{name}' is no module and no folder of modules" for line, name in given if not table.below(name))


def holder(table, file):
    """Who has a file: (module, None), or (None, place), or (None, None). The longest path wins."""
    folders = {module.folder: name for name, module in table.modules.items() if is_below(file, module.folder)}
    folder = max(folders, key=len, default="")
    place = max((path for path in table.places if is_below(file, path)), key=len, default="")
    return (folders[folder], None) if len(folder) > len(place) else (None, place or None)


def is_of_the_build(file):
    return pathlib.PurePath(file).name == "CMakeLists.txt" or file.endswith((".cmake", ".cmake.in"))


def select(table, files, deleted=()):
    """The gates for these changed files, paths from the root; some of them may be deleted."""
    plan = Plan()
    inputs = set()  # modules whose data changed, not their sources
    for file in files:
        tests = {name for name, test in table.tests.items() if any(is_below(file, path) for path in test.files)}
        plan.tests |= tests
        module, place = holder(table, file)
        if is_of_the_build(file):
            plan.everything = plan.everything or f"{file} is a file of the build"
        elif module and is_below(table.modules[module].folder, "methods") and not method_of(table.modules[module]):
            plan.everything = plan.everything or f"{file} is of the contract or the kit"
        elif module:
            plan.changed.add(module)
        elif place and EVERYTHING in table.places[place]:
            plan.everything = plan.everything or f"{file} concerns everything"
        elif place:
            inputs.update(name for given in table.places[place] for name in table.below(given))
        elif file in deleted:
            plan.everything = plan.everything or f"{file} is deleted, and its module with it"
        elif not tests:
            raise BadTable(f"{file}: no module, test or place of the table has it; add one in tests/gates/table.cmake")
    if plan.everything:
        plan.checked, plan.tests = set(table.modules), set(table.tests)
        return plan
    plan.checked = table.dependents(plan.changed) | inputs
    plan.tests |= {name for name, test in table.tests.items()
                   if plan.checked & {module for given in test.modules for module in table.below(given)}}
    return plan


def git(root, *arguments):
    """Its lines, or None where it fails."""
    done = subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True)
    return done.stdout.splitlines() if done.returncode == 0 else None


def changed_files(root, base):
    """What differs from a commit, deleted files and those that git does not know yet included."""
    return sorted({*git(root, "diff", "--name-only", "--no-renames", base), *git(root, "ls-files", "--others", "--exclude-standard")})


def merge_base(root, revision):
    found = git(root, "merge-base", revision, "HEAD")
    return found[0] if found else None


def verified(root):
    """The commit of .ci/verified, and why there is none."""
    try:
        commit = (root / ".ci" / "verified").read_text().split()[0]
    except (OSError, IndexError):
        return None, ".ci/verified is missing or empty"
    if git(root, "cat-file", "-e", f"{commit}^{{commit}}") is None:
        return None, f"git does not know {commit} of .ci/verified"
    if git(root, "merge-base", "--is-ancestor", commit, "HEAD") is None:
        return None, f"{commit} of .ci/verified is not an ancestor of HEAD"
    return commit, ""
