"""The README.md of a folder of sample tables, made from the tables alone: where they were measured, the verdicts, the charts."""

import collections
import csv
import pathlib
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
VERDICTS = ("confirmed", "refuted", "depends", "unresolved", "untestable", "not-tested")


def rows_of(file):
    with open(file, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def cell(text):
    return text.replace("|", "\\|").replace("\n", " ")


def number(text):
    """Four significant digits, as the report prints them."""
    return format(float(text), ",.4g") if text else ""


def title_of(paper):
    return tomllib.loads((ROOT / "data" / "papers" / paper / "paper.toml").read_text(encoding="utf-8"))["title"]


def machine_lines(folder):
    machine = rows_of(folder / "machine.csv")[0]
    seconds = machine.get("quick_seconds")
    minutes = max(round(int(seconds) / 60), 1) if seconds else 0
    took = f" The runs took {minutes} minute{'s' if minutes > 1 else ''}." if minutes else ""
    return [f"Measured on {machine['started_utc'][:10]} at commit `{machine['git_commit'][:8]}` on {machine['cores']} cores of an "
            f"{machine['cpu'].replace('(R)', '')} with {machine['gl_renderer']}.{took}"]


def run_lines(folder):
    runs = rows_of(folder / "summary.csv")
    states = collections.Counter(run["status"] for run in runs)
    line = f"{len(runs)} runs: " + ", ".join(f"{count} {state}" for state, count in states.most_common()) + "."
    invalid = sum(1 for run in runs if run.get("invalid"))
    return [line + (f" No claim uses the {invalid} runs that are invalid (column `invalid`)." if invalid else "")]


def verdict_lines(claims):
    counts = collections.Counter(claim["verdict"] for claim in claims)
    controls = collections.Counter(claim["control"] for claim in claims if claim["control"])
    lines = [", ".join(f"{counts[verdict]} {verdict}" for verdict in VERDICTS if counts[verdict]) + ". Controls: "
             + (", ".join(f"{count} {state}" for state, count in controls.most_common()) or "none") + ".", "",
             "| Entry | Claim | Verdict | Measured, with its interval | Expected | Condition |", "|---|---|---|---|---|---|"]
    for claim in claims:
        measured = f"{number(claim['measured'])} {claim['interval']}".strip()
        verdict = claim["verdict_text"] + ("" if claim["control"] in ("", "turned") else f"; control {claim['control']}")
        entry = f"[{claim['id']}](../../../data/papers/{claim['paper']}/README.md)"
        lines.append("| " + " | ".join(cell(text) for text in (entry, claim["claim"], verdict, measured, claim["expected"],
                                                                claim["condition"] or claim["note"])) + " |")
    return lines


def suite_titles():
    """The title of each suite, by id."""
    files = [*(ROOT / "data" / "suites").glob("*.toml"), *(ROOT / "data" / "papers").glob("*/suites/*.toml")]
    return {file.stem: tomllib.loads(file.read_text(encoding="utf-8")).get("title", file.stem) for file in files}


def chart_lines(folder):
    titles, lines = suite_titles(), []
    for chart in sorted(folder.glob("*.svg")):
        suite = chart.stem.removesuffix("-quality").removesuffix("-quick")
        what = titles.get(suite, suite) + (": error against cost" if chart.stem.endswith("-quality") else "")
        if "-by-" in suite:
            what = f"Where each claim is true, by `{suite.partition('-by-')[2]}`"
        lines += [f"**{what}** (`{suite}`)", "", f"![{what}]({chart.name})", ""]
    return lines


def readme(folder, title, made_by):
    name = folder.relative_to(HERE)
    claims = rows_of(folder / "claims.csv")
    charts = chart_lines(folder)
    full = (folder / "full").exists()
    lines = [f"# {title}: sample", "",
             f"`{made_by}` writes this file from the tables next to it. " + machine_lines(folder)[0], "", run_lines(folder)[0], "",
             "The page with all charts and tables, from these tables:", "", "```sh",
             f"build/release/dustbench report reports/sample/{name} --out out/{name}", "```", "", "## Verdicts", "", *verdict_lines(claims), ""]
    if charts:
        lines += ["## Charts", ""] + (["Names that end in `-quick` belong to the quick run, the others to the [full run](full/README.md).", ""] if full else []) + charts
    return "\n".join(lines).rstrip("\n") + "\n"
