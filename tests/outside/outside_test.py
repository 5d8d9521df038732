"""A method and a part in a separate project, built against an installed dustbench; libraries that are refused.

outside_test.py BUILD WORK: installs BUILD into WORK/prefix and uses nothing else of the build or its sources. Prints failures;
exits with 1 if there are any.
"""
import csv
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

build, work = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
source = pathlib.Path(__file__).resolve().parents[2]
prefix, place = work / "prefix", work / "place"
environment = {name: value for name, value in os.environ.items() if not name.startswith("DUSTBENCH_")}
if shutil.which("ccache"):
    environment["CMAKE_CXX_COMPILER_LAUNCHER"] = "ccache"
faults, installed = [], []


def expect(holds, what):
    if not holds:
        faults.append(what)


def call(*command, status=0, where=None):
    done = subprocess.run([str(word) for word in command], cwd=where or place, env=environment, text=True,
                          capture_output=True)
    if done.returncode != status:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}, expected {status}\n"
                 f"{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
    return done


def dustbench(*arguments, status=0):
    return call(prefix / "bin/dustbench", *arguments, status=status)


def build_project(folder, *targets, options=()):
    call("cmake", "-S", folder, "-B", folder / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}", *options)
    call("cmake", "--build", folder / "build", "--parallel", "2", *[word for name in targets for word in ("--target", name)])


def block_of_page(file):
    """The example of methods/README.md for this file."""
    page = (source / "methods/README.md").read_text()
    return re.search(rf"(?ms)^`{re.escape(file)}`[^\n]*\n```\w+\n(.*?)^```$", page)[1]


def install():
    shutil.rmtree(work, ignore_errors=True)
    place.mkdir(parents=True)
    manifest = build / "install_manifest.txt"
    before = manifest.read_text() if manifest.exists() else None
    call("cmake", "--install", build, "--prefix", prefix, where=work)
    installed.extend(manifest.read_text().splitlines())
    manifest.unlink() if before is None else manifest.write_text(before)  # owned by the user of the build
    for file in ["bin/dustbench", "lib/dustbench/kit/libdustbench_kit.so", "share/man/man1/dustbench.1",
                 "share/bash-completion/completions/dustbench", "share/dustbench/scenes/plain.toml",
                 "include/dustbench/methods/contract/method.h", "lib/cmake/dustbench/dustbenchConfig.cmake"]:
        expect((prefix / file).is_file(), f"installed: no {file}")
    for file in prefix.rglob("*"):
        # Paths below WORK are in the source tree in most builds, but must not occur in installed files either.
        expect(file.is_dir() or str(source).encode() not in file.read_bytes(), f"{file} names the source tree")


def write_and_build():
    said = dustbench("new-method", "haze").stdout
    expect(f"-DCMAKE_PREFIX_PATH={prefix} " in said or f"-DCMAKE_PREFIX_PATH='{prefix}' " in said, f"new-method: {said}")
    project = place / "haze"
    sources = sum(len(file.read_text().splitlines()) for file in project.iterdir() if file.suffix in (".cpp", ".txt")
                  and not file.name.endswith("_test.cpp"))
    expect(sources <= 70, f"the project has {sources} lines without its test, expected about 60")
    part = project / "parts/force/updraught.cpp"
    part.parent.mkdir(parents=True)
    part.write_text(block_of_page("methods/kit/particles/parts/force/updraught.cpp"))
    build_project(project)
    call("ctest", "--output-on-failure", where=project / "build")
    for file in (project / "build").rglob("*.d"):
        expect(str(source) + "/" not in file.read_text().replace(str(work), ""), f"{file} depends on the source tree")
    return project


def use(project):
    library = project / "build/haze.dustmethod.so"
    for kind, name in [("methods", "haze"), ("parts", "force/updraught")]:
        listed = json.loads(dustbench("list", kind, "--json", "--method-path", project / "build").stdout)
        entry = [item for item in listed if item["id"] == name]
        expect(entry and entry[0].get("origin") == str(library), f"list: got {entry}")
        expect(name not in dustbench("list", kind).stdout, f"{name} is listed without its path")
    run = ["--method-path", project / "build", "-P", "particles=200", "-P", "preroll=0.5", "--size", "96x72", "--frames", "3"]
    dustbench("run", "--method", "haze", "--metrics", *run, "--out", "out")
    expect_input(library, "out")
    with open(place / "out/summary.csv") as table:
        row = next(csv.DictReader(table))
    expect(row["status"] == "done" and float(row["psnr_db"]) > 0 and float(row["dust_height_max"]) > 0, f"summary: {row}")
    dustbench("report", "out")
    expect("haze" in (place / "out/index.html").read_text(), "the page does not name the method")
    (place / "pair.toml").write_text('title = "Two"\nmethods = ["haze", "null_method"]\nframes = 2\nwarmup = 0\n'
                                     'sizes = ["96x72"]\n[parameters]\nparticles = 200\npreroll = 0.5\n')
    suite = ["suite", "pair.toml", "--method-path", project / "build", "--out", "pair"]
    dustbench(*suite)
    again = dustbench(*suite).stderr
    expect("outdated" not in again, f"the same again: {again}")
    method = project / "haze.cpp"
    method.write_text(method.read_text().replace("in no order", "in any order"))
    build_project(project)
    changed = dustbench(*suite).stderr
    expect("outdated: 1 of" in changed and "haze.dustmethod.so" in changed, f"after a change: {changed}")
    dustbench("view", "--method", "haze", *run[:6], "--size", "96x72", "--picture", "view.png")
    expect((place / "view.png").is_file(), "view drew no picture")


def record_of(out):
    return json.loads((next((place / out / "runs").iterdir()) / "run.json").read_text())


def expect_input(library, out):
    inputs = {item["file"]: item["sha256"] for item in record_of(out)["provenance"]["inputs"]}
    expect(inputs.get(str(library)) == hashlib.sha256(library.read_bytes()).hexdigest(), f"inputs of {out}: {inputs}")


def use_part(project):
    """Updraught changes a particle system according to its speed."""
    system = (prefix / "share/dustbench/particles/fountain.toml").read_text()
    hashes = []
    for speed in (0, 2):
        (place / "lifted.toml").write_text(system + f'\n[[force]]\npart = "drag"\n\n[[force]]\npart = "updraught"\nspeed = {speed}\n')
        dustbench("run", "--method", "plugin_particles", "-P", "system=lifted.toml", "-P", "preroll=0.5", "--size", "64x48",
                  "--frames", "2", "--method-path", project / "build", "--out", f"lifted{speed}")
        hashes.append(record_of(f"lifted{speed}")["method_hash"])
        expect_input(project / "build/haze.dustmethod.so", f"lifted{speed}")
    expect(hashes[0] != hashes[1], f"the updraught changes nothing: {hashes}")


def refused(folder, identifier, reason):
    listed = dustbench("list", "methods", "--method-path", folder)
    lines = [line for line in listed.stdout.splitlines() if "is not loaded" in line and f"{identifier}.dustmethod.so" in line]
    expect(lines and reason in lines[0], f"{identifier}: expected '{reason}', got {lines}")
    used = dustbench("run", "--method", identifier, "--method-path", folder, "--out", "none", status=3).stderr
    expect(used.count("\n") == 1 and reason in used, f"run of {identifier}: {used}")


def option(flag):
    """Adds a flag after those of the package."""
    return f'target_compile_options(dustbench::kit INTERFACE "{flag}")\ntarget_link_options(dustbench::kit INTERFACE "{flag}")'


def refuse(project):
    # Only the part: the entry is the same, and this compiles faster.
    for file in ("haze.cpp", "haze_test.cpp"):
        (project / file).unlink()
    build_project(project, "haze.dustmethod.so", options=["-DCMAKE_BUILD_TYPE=Debug"])
    taken = dustbench("list", "parts", "--ids", "--method-path", project / "build").stdout
    expect("force/updraught" in taken.splitlines(), "a debug build has the same NDEBUG and must be accepted")
    plain = "-march=x86-64 " in (prefix / "lib/cmake/dustbench/dustbenchConfig.cmake").read_text()
    for name, line, fact in [
            ("fast", option("-ffast-math"), "__FAST_MATH__ is 1, expected undefined"),
            ("arch", option("-msse4.2" if plain else "-march=x86-64"), "__SSE4_2__ is"),
            ("debug", option("-UNDEBUG"), "NDEBUG is undefined, expected"),
            ("newer", "set_property(TARGET haze_objects PROPERTY CXX_STANDARD 23)", "__cplusplus is 202"),
            ("asan", option("-fsanitize=address"), "ASan")]:
        other = place / f"other_{name}"
        shutil.copytree(project, other, ignore=shutil.ignore_patterns("build"))
        with open(other / "CMakeLists.txt", "a") as file:
            file.write(line + "\n")
        build_project(other, "haze.dustmethod.so")
        refused(other / "build", "haze", fact)
    old = place / "old"
    old.mkdir()
    (old / "old.c").write_text("struct entry { unsigned api; const char *a, *b; void (*c)(void*); };\n"
                               "const struct entry* dustbenchMethodEntry(void) { static struct entry e; return &e; }\n")
    call("cc", "-shared", "-fPIC", "old.c", "-o", "old.dustmethod.so", where=old)
    refused(old, "old", "built for version 0 of the interface, expected 3")
    broken = place / "broken"
    broken.mkdir()
    (broken / "text.dustmethod.so").write_text("no library\n")
    refused(broken, "text", "text.dustmethod.so")
    (broken / "loud.c").write_text("__attribute__((constructor)) void start(void) { __builtin_trap(); }\n")
    call("cc", "-shared", "-fPIC", "loud.c", "-o", "loud.dustmethod.so", where=broken)
    refused(broken, "loud", "a process that tried it ended by signal")
    (broken / "gone.dustmethod.so").symlink_to("nowhere.so")
    refused(broken, "gone", "No such file")
    (broken / "empty.c").write_text("int nothing;\n")
    call("cc", "-shared", "-fPIC", "empty.c", "-o", "empty.dustmethod.so", where=broken)
    refused(broken, "empty", "it has no function dustbenchMethodEntry")
    shutil.copy(project / "build/haze.dustmethod.so", broken / "fog.dustmethod.so")
    refused(broken, "fog", "its id is 'haze', expected 'fog'")
    twice = place / "twice"
    twice.mkdir()
    shutil.copy(project / "build/haze.dustmethod.so", twice)
    both = dustbench("list", "methods", "--method-path", project / "build", "--method-path", twice).stdout
    why = [line for line in both.splitlines() if f"{twice}/haze.dustmethod.so is not loaded" in line]
    expect(why and f"already exists, from {project}/build/haze.dustmethod.so" in why[0], f"twice: {why}")
    missing = dustbench("list", "--method-path", "nowhere", status=3).stderr
    expect("nowhere" in missing, missing)
    expect("already exists" in dustbench("new-method", "null_method", status=3).stderr, "new-method null_method")
    expect("already exists" in dustbench("new-method", "haze", status=3).stderr, "new-method haze")
    expect("tests and benchmarks" in dustbench("new-method", "fog_test", status=3).stderr, "new-method fog_test")
    expect("lower-case" in dustbench("new-method", "Haze", status=3).stderr, "new-method Haze")


def uninstall():
    for file in installed:
        pathlib.Path(file).unlink()
    left = [str(file) for file in prefix.rglob("*") if not file.is_dir()]
    expect(not left, f"left behind: {left[:5]}")


install()
project = write_and_build()
use(project)
use_part(project)
refuse(project)
uninstall()
print("\n".join(faults))
sys.exit(1 if faults else 0)
