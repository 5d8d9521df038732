#!/usr/bin/env -S python3 -B
"""Plants a finding of each kind that clang-tidy looks for, and expects .ci/lint to find them all: in a file read alone, and in files read together.

Exit code: 77 if clang-tidy is not installed (`make lint` installs it).
"""
import importlib.machinery
import importlib.util
import json
import pathlib
import re
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / ".ci"))
loader = importlib.machinery.SourceFileLoader("lint", str(ROOT / ".ci" / "lint"))
lint = importlib.util.module_from_spec(importlib.util.spec_from_loader("lint", loader))
loader.exec_module(lint)

HEADERS = "cstdio cstring memory string utility vector".split()
PLANTED = {
    "bugprone-assignment-in-if-condition": "bool two(int a) { if (a = 2) return true; return false; }",
    "bugprone-branch-clone": "int one(int a) { if (a > 1) return 1; else return 1; }",
    "bugprone-integer-division": "float half(int a, int b) { return a / b * 0.5f; }",
    "bugprone-standalone-empty": "void forget(std::vector<int>& v) { v.empty(); }",
    "bugprone-string-constructor": "std::string letters() { return std::string('x', 50); }",
    "bugprone-suspicious-include": '#include "clean_2.cpp"',
    "bugprone-suspicious-semicolon": "void stray(int a) { if (a); std::puts(\"\"); }",
    "bugprone-use-after-move": "std::string twice(std::string s) { std::string t = std::move(s); return s + t; }",
    "concurrency-thread-canceltype-asynchronous": "#include <pthread.h>\n"
                                                  "void cancel() { int before; pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, &before); }",
    "cppcoreguidelines-slicing": "struct Whole { int a = 0; }; struct More : Whole { int b = 0; };\nvoid slice() { More more; Whole whole = more; (void)whole; }",
    "cppcoreguidelines-virtual-class-destructor": "struct Abstract { virtual void f() = 0; ~Abstract() {} };",
    "misc-redundant-expression": "int same(int a) { return a == a ? 1 : 2; }",
    "misc-unconventional-assign-operator": "struct Assigned { int operator=(const Assigned&) { return 1; } };",
    "misc-unused-parameters": "int first(int a, int b) { return a; }",
    "modernize-make-unique": "std::unique_ptr<int> three() { return std::unique_ptr<int>(new int(3)); }",
    "modernize-redundant-void-arg": "int none(void) { return 0; }",
    "modernize-use-equals-default": "struct Made { Made() {} int a = 0; };",
    "modernize-use-nullptr": "int* nowhere = 0;",
    "modernize-use-override": "struct Over { virtual ~Over() = default; virtual int f() { return 1; } };\nstruct Under : Over { virtual int f() { return 2; } };",
    "performance-for-range-copy": "void copies(const std::vector<std::string>& v) { for (const auto s : v) std::puts(s.c_str()); }",
    "performance-move-constructor-init": "struct Moved { Moved(Moved&& o) : s(o.s) {} std::string s; };",
    "performance-unnecessary-value-param": "void puts(std::string text) { std::puts(text.c_str()); }",
    "readability-container-size-empty": "bool isEmpty(const std::string& t) { return t.size() == 0; }",
    "readability-identifier-naming": "class lowerCase {};",
    "readability-redundant-string-cstr": "std::string again(const std::string& s) { return std::string(s.c_str()); }",
}


def checks(findings):
    return {name for line, _ in findings for name in re.findall(r"\[([a-z-]+)", line)}


def main():
    if not shutil.which(lint.TOOL) or not shutil.which(lint.COMPILER):
        print(f"{lint.TOOL} or {lint.COMPILER} is not installed")
        sys.exit(77)
    (ROOT / "build").mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(dir=ROOT / "build") as folder: # within the tree, for .clang-tidy
        sources = pathlib.Path(folder) / "methods"
        sources.mkdir()
        lint.JOINED = pathlib.Path(folder) / "joined"
        clean = [sources / f"clean_{number}.cpp" for number in (1, 2)]
        for file in clean:
            file.write_text(f"int {file.stem}() {{ return 1; }}\n")
        planted = sources / "planted.cpp"
        planted.write_text("".join(f"#include <{name}>\n" for name in HEADERS) + "namespace {\n" +
                           "\n".join(code for code in PLANTED.values() if "#include" not in code) + "\n}  // namespace\n" +
                           "\n".join(code for code in PLANTED.values() if "#include" in code) + "\n")
        options = ["-std=c++20"]
        alone = lint.tidy(planted, "--", *options)
        together = lint.tidy_joined([str(clean[0]), str(planted)], options)
        faults = [f"{how}: {check} was not found" for how, findings in (("alone", alone), ("together", together)) for check in PLANTED
                  if check not in checks(findings)]
        faults += [f"only alone: {line}" for line in {line for line, _ in alone} - {line for line, _ in together}]
        borrower = sources / "borrower.cpp"
        borrower.write_text("std::vector<int> borrowed;\n")  # compiles after a file that includes <vector>
        owner = sources / "a_owner.cpp"
        owner.write_text("#include <vector>\n")
        commands = {str(file): ["clang++", *options, "-o", "out.o", "-c", str(file)] for file in (owner, borrower)}
        lint.COMMANDS = pathlib.Path(folder) / "compile_commands.json"
        lint.COMMANDS.write_text(json.dumps([{"directory": folder, "file": file, "arguments": words} for file, words in commands.items()]))
        read = dict(lint.read(list(commands), commands))
        if read[str(owner)] or not read[str(borrower)]:
            faults.append(f"a file without an include: expected a finding there alone, got {read}")
        if lint.tidy_joined([str(file) for file in clean], options):
            faults.append("clean files read together: got a finding")
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


main()
