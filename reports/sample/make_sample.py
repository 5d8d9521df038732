"""Makes the sample reports, a folder for each paper. Writes the README's charts from them, and its table from data/machines.

    make_sample.py PROGRAM [PAPER …]            measures the quick runs (half an hour), writes this folder and README.md;
                                                `make sample` calls it
    make_sample.py --full PROGRAM PAPER …       measures the full runs of the papers (up to two hours each), writes
                                                PAPER/full; `make full PAPER=…` calls it
    make_sample.py --charts PROGRAM [PAPER …]   draws the charts of the full runs from their tables, PAPER/SUITE.svg
    make_sample.py --write                      updates README.md, and the README.md of each folder, from the tables
    make_sample.py PROGRAM GROUP                measures the quick runs of a group of papers that share runs, and draws their charts; keeps
                                                only tables and charts
    make_sample.py --check                      exits with 1 if README.md and this folder disagree, or if PAPER/full/README.md
                                                does not mention a claim whose verdict differs from that of the quick run
"""

import csv
import json
import pathlib
import shutil
import statistics
import subprocess
import sys
import textwrap
import time

import machine_tables
import sample_readme

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
README = ROOT / "README.md"
OUT = ROOT / "reports" / "out" / "sample"
# Papers that share runs: one folder for all, with further suites of our own.
GROUPS = {"transparency": {
    "title": "Eight papers on transparency",
    "papers": ["enderton2010", "aizenshtein2022", "munstermann2018", "mcguire2013", "salvi2011", "salvi2014", "yang2010", "cantlay2007"],
    "suites": ["transparency", "transparency-scenes", "transparency-load"]}}
GROUPED = {paper for group in GROUPS.values() for paper in group["papers"]}
PAPERS = sorted(folder.parent.name for folder in (ROOT / "data" / "papers").glob("*/paper.toml") if folder.parent.name not in GROUPED)
PAPER = "carr2006"  # shown in README.md
MAP = "carr2006-by-voxel_edge"  # the map of the paper's claims
BEGIN, END = "<!-- sample: `make sample` writes what follows -->\n", "<!-- end of sample -->\n"
GUIDE = ROOT / "reports" / "guide" / "which-transparency.md"  # with a table of the group `transparency`
MACHINE = ("cpu", "cores", "gl_renderer", "git_commit", "started_utc")
TABLES = ("summary.csv", "claims.csv", "experiments.csv")


def seconds_of(command):
    begin = time.monotonic()
    subprocess.run(command, check=True)
    return round(time.monotonic() - begin)


def provenance_of(out):
    """The provenance of the first run."""
    runs = (json.loads(run.read_text())["provenance"] for run in (out / "runs").glob("*/run.json"))
    return min(runs, key=lambda run: run["started_utc"])


def keep(out, kept, files, durations):
    """Copies those of the files that exist, and writes machine.csv with `durations` by column."""
    kept.mkdir(exist_ok=True)
    for name in files:
        if (out / name).exists():
            shutil.copy(out / name, kept)
    provenance = provenance_of(out)
    with open(kept / "machine.csv", "w", encoding="utf-8", newline="") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(MACHINE + tuple(durations))
        table.writerow([provenance[name] for name in MACHINE] + list(durations.values()))


def measure(program, paper):
    out, kept = OUT / paper, HERE / paper
    shutil.rmtree(out, ignore_errors=True)
    quick = [program, "reproduce", "--paper", paper, "--quick", "--out", out]
    # Both durations include the experiments, which run again.
    durations = {"quick_seconds": seconds_of(quick), "controls_seconds": seconds_of(quick + ["--controls"])}
    subprocess.run([program, "report", out, "--pictures", "1"], check=True)
    keep(out, kept, TABLES, durations)
    if paper == PAPER:
        draw_map(program, kept)


def draw_map(program, kept):
    """Draws the map of the claims of the quick run, from its tables alone."""
    subprocess.run([program, "report", kept, "--chart", MAP, "--out", kept / f"{MAP}-quick.svg"], check=True)


def measure_group(program, name):
    """Resumes an interrupted measurement, as measure_full does."""
    out, kept = OUT / name, HERE / name
    goes_on = any(out.glob("runs/*/run.json"))
    seconds = 0
    for paper in GROUPS[name]["papers"]:
        seconds += seconds_of([program, "reproduce", "--paper", paper, "--quick", "--controls", "--out", out])
    for suite in GROUPS[name]["suites"]:
        seconds += seconds_of([program, "suite", suite, "--quick", "--out", out])
    # The claims of all papers in the folder, as the last paper left them; the suites of our own have none.
    keep(out, kept, ("summary.csv", "claims.csv"), {"quick_seconds": "" if goes_on else seconds})
    draw_group(program, name)


def draw_group(program, name):
    """Draws the charts of the group's suites from its tables alone."""
    kept = HERE / name
    for old in kept.glob("*.svg"):
        old.unlink()
    for chart in ("all", "transparency-quick-quality", "aizenshtein2022-bits-quick-quality"):
        subprocess.run([program, "report", kept, "--chart", chart, "--out", kept], check=True)


def measure_full(program, paper):
    """Resumes an interrupted measurement. Only an uninterrupted one has a duration."""
    out = OUT / "full" / paper
    goes_on = any(out.glob("runs/*/run.json"))
    if goes_on:
        print(f"make_sample.py: resuming {out.relative_to(ROOT)}; remove it to start again and record the duration", flush=True)
    seconds = seconds_of([program, "reproduce", "--paper", paper, "--full", "--controls", "--out", out])
    keep(out, HERE / paper / "full", TABLES, {"full_seconds": "" if goes_on else seconds})
    draw_full(program, paper)
    for claim in differing(paper):
        print(f"{paper}: the verdict of {claim} differs from that of the quick run: explain it in reports/sample/{paper}/full/README.md")


def draw_full(program, paper):
    """Draws the chart of each suite's full run and the maps of claims, from the tables alone. A suite that has changed since keeps
    its last chart."""
    suites = {file.stem for file in (ROOT / "data" / "papers" / paper / "suites").glob("*.toml")}
    for old in (HERE / paper).glob("*.svg"):
        if old.stem not in suites and not old.stem.endswith("-quick"):
            old.unlink()
    subprocess.run([program, "report", HERE / paper / "full", "--chart", "all", "--out", HERE / paper], check=True)


def verdicts(folder):
    with open(folder / "claims.csv", encoding="utf-8", newline="") as stream:
        return {row["id"]: row["verdict"] for row in csv.DictReader(stream)}


def differing(paper):
    quick, full = verdicts(HERE / paper), verdicts(HERE / paper / "full")
    return [claim for claim, verdict in full.items() if quick.get(claim) != verdict]


def figures_text():
    text = ("Figures 5 and 7 of Carr & Geyer at 640×480 pixels, at all loads and speeds of their suites, measured with the models as printed in the paper "
            "(`mode=paper`), and with our corrected models (`mode=fixed`) at 20 m/s. The paper states no numbers for them, so compare the shapes of the curves.")
    return "\n".join(textwrap.wrap(text, 158))


def block():
    return "\n".join([
        BEGIN.rstrip("\n"),
        "The milliseconds that each method adds to a frame of 1920×1080 pixels, by number of particles, and its error: FLIP against the reference image, for 1,000",
        "particles at 1280×720. Missing values would have taken too long. `dustbench measure-machine` [measures your machine](reports/guide/measure-machine.md).", "",
        *machine_tables.lines(),
        figures_text(), "",
        f"![Frame rate of the billboard model against the number of particles, a curve for each speed](reports/sample/{PAPER}/{PAPER}-fig5.svg)", "",
        f"![Frame rate of both octree models against the number of particles, a panel for each speed](reports/sample/{PAPER}/{PAPER}-fig7.svg)",
        "", END.rstrip("\n"), ""])


def setting_of(row):
    """`moment_oit mode=paper moments=6 precision=quantised`: the parameters that the suite sets."""
    named = {"offscreen_particles": ["scale"], "weighted_oit": ["mode"], "moment_oit": ["mode", "moments", "precision"],
             "wavelet_oit": ["rank", "coefficients"], "stochastic_transparency": ["samples"], "multi_layer": ["layers"],
             "adaptive_transparency": ["nodes"]}
    return " ".join([row["method"]] + [f"{name}={row[f'p.{name}']}" for name in named.get(row["method"], [])])


def guide_block():
    """A row for each setting of the suite `transparency`: medians over the seeds, best first."""
    with open(HERE / "transparency" / "summary.csv", encoding="utf-8", newline="") as stream:
        runs = [row for row in csv.DictReader(stream) if row["scene"] == "smoke" and row["p.light"] == "none" and row["frames"] == "6"
                and row["status"] == "done" and row["method"] != "null_method"]
    loads = sorted({int(row["p.particles"]) for row in runs})

    def median(setting, column, load):
        values = [float(row[column]) for row in runs if setting_of(row) == setting and int(row["p.particles"]) == load and row[column]]
        return statistics.median(values) if values else None

    def text(value, form):
        return "" if value is None else format(value, form)
    settings = sorted({setting_of(row) for row in runs}, key=lambda setting: median(setting, "flip_mask", loads[-1]))
    lines = [BEGIN.rstrip("\n"),
             "| Method and setting | " + " | ".join(f"FLIP, {load} puffs" for load in loads)
             + f" | Worst pixel, {loads[-1]} puffs | Bits per pixel, {loads[-1]} puffs | Time, {loads[1]} puffs [ms] |", "|---|" + "--:|" * (len(loads) + 3)]
    for setting in settings:
        cells = [text(median(setting, "flip_mask", load), ".4f") for load in loads]
        cells += [text(median(setting, "error_max", loads[-1]), ".3f"), text(median(setting, "bits_per_pixel", loads[-1]), ",.0f"),
                  text(median(setting, "method_ms_median", loads[1]), ".1f")]
        lines.append(f"| `{setting}` | " + " | ".join(cells) + " |")
    return "\n".join(lines + [END])


def parts_of(document):
    text = document.read_text(encoding="utf-8")
    start, end = text.index(BEGIN), text.index(END) + len(END)
    return text[:start], text[start:end], text[end:]


def written():
    """The documents with a part that is written from this folder, and what the part must be."""
    return [(README, block()), (GUIDE, guide_block())]


def readmes():
    """The files that are wholly written from this folder, and what they must be."""
    papers = [(HERE / paper, sample_readme.title_of(paper), "make sample") for paper in PAPERS]
    groups = [(HERE / name, group["title"], f"make_sample.py PROGRAM {name}") for name, group in GROUPS.items()]
    return [(folder / "README.md", sample_readme.readme(folder, title, command)) for folder, title, command in papers + groups]


def write():
    for document, wanted in written():
        before, _, after = parts_of(document)
        document.write_text(before + wanted + after, encoding="utf-8")
    for file, text in readmes():
        file.write_text(text, encoding="utf-8")


def check():
    for document, text in written():
        found, wanted = parts_of(document)[1].splitlines(), text.splitlines()
        for number in range(max(len(found), len(wanted))):
            got, expected = (lines[number] if number < len(lines) else "nothing" for lines in (found, wanted))
            if got != expected:
                sys.exit(f"{document.name} has '{got}', expected '{expected}' from reports/sample; run `make sample` or make_sample.py --write")
    for file, text in readmes():
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            sys.exit(f"{file.relative_to(ROOT)} is not what its tables give; run make_sample.py --write")
    for folder in sorted(HERE.glob("*/full")):
        readme = folder / "README.md"
        explained = readme.read_text(encoding="utf-8") if readme.exists() else ""
        for claim in differing(folder.parent.name):
            if f"**{claim}**" not in explained:
                sys.exit(f"{readme.relative_to(ROOT)} does not explain **{claim}**, whose verdict differs from that of the quick run")


def main(arguments):
    if not arguments:
        sys.exit(__doc__)
    if arguments[0] == "--check":
        check()
        return
    if arguments[0] != "--write":
        full, charts = arguments[0] == "--full", arguments[0] == "--charts"
        if full and len(arguments) < 3:
            sys.exit(f"make_sample.py: --full needs a paper: {', '.join(PAPERS)}")
        program, *papers = arguments[1:] if full or charts else arguments
        allowed = PAPERS if full else [*PAPERS, *GROUPS]
        papers = papers or (PAPERS if charts else allowed)
        for paper in papers:
            if paper not in allowed:
                sys.exit(f"make_sample.py: no paper '{paper}'; papers: {', '.join(allowed)}")
        for paper in papers:
            if paper in GROUPS:
                (draw_group if charts else measure_group)(program, paper)
            else:
                (draw_full if charts else measure_full if full else measure)(program, paper)
                if charts and paper == PAPER:
                    draw_map(program, HERE / paper)
    write()


if __name__ == "__main__":
    main(sys.argv[1:])
