"""The README's tables of data/machines: what each method costs on a machine that was measured with `dustbench measure-machine`."""

import pathlib
import statistics

import sample_readme

MACHINES = pathlib.Path(__file__).resolve().parents[2] / "data" / "machines"
SIZE = ("1920", "1080")
JUDGED = ("1280", "720")  # the size at which pictures are compared with the reference
LOADS = ("1000", "10000", "100000", "1000000")
SOFTWARE = ("llvmpipe", "softpipe", "swrast")


def draws_on_the_cpu(machine):
    return any(name in machine["gl_renderer"] for name in SOFTWARE)


def machines():
    """(name, machine, rows of the dust) of each folder; those with a GPU first."""
    found = []
    for folder in sorted(MACHINES.iterdir()):
        if folder.is_dir():
            machine = sample_readme.rows_of(folder / "machine.csv")[0]
            dust = [row for row in sample_readme.rows_of(folder / "summary.csv")
                    if row["scene"] == "plain" and row["p.particles"] not in ("", "0") and row["method"] != "null_method"]
            found.append((folder.name, machine, dust))
    return sorted(found, key=lambda each: draws_on_the_cpu(each[1]))


def measured(rows, method, size, load, column):
    return [row for row in rows if row["status"] == "done" and row[column] and row["method"] == method
            and (row["width"], row["height"]) == size and row["p.particles"] == load]


def median(rows, method, size, load, column):
    values = [float(row[column]) for row in measured(rows, method, size, load, column)]
    return statistics.median(values) if values else None


def milliseconds(rows, method, load):
    """Three significant digits, with a mark if the runs are invalid."""
    value = median(rows, method, SIZE, load, "method_ms_median")
    if value is None:
        return ""
    text = format(value, ",.0f") if value >= 100 else format(value, "#.3g")
    return text + (" \\*" if any(row["invalid"] for row in measured(rows, method, SIZE, load, "method_ms_median")) else "")


def table(rows):
    """A row for each method that was measured at SIZE: the smallest error first."""
    def error(method):
        return median(rows, method, JUDGED, LOADS[0], "flip_mask")

    lines = ["| Method | FLIP error | " + " | ".join(f"{int(load):,} particles [ms]" for load in LOADS) + " |", "|---|" + "--:|" * (1 + len(LOADS))]
    methods = {row["method"] for row in rows if (row["width"], row["height"]) == SIZE and row["status"] == "done"}
    for method in sorted(methods, key=lambda method: (error(method) is None, error(method), method)):
        wrong = error(method)
        cells = ["" if wrong is None else f"{wrong:.4f}"] + [milliseconds(rows, method, load) for load in LOADS]
        lines.append(f"| `{method}` | " + " | ".join(cells) + " |")
    invalid = [row for method in methods for load in LOADS for row in measured(rows, method, SIZE, load, "method_ms_median") if row["invalid"]]
    counts = {(int(row["p.particles"]), round(float(row["particles_median"]))) for row in invalid}
    if invalid:
        lines += ["", "\\* With " + ", and ".join(f"{drawn:,} instead of {load:,}" for load, drawn in sorted(counts)) + " particles."]
    return lines


def lines():
    """A title and a table for each machine."""
    result = []
    for name, machine, rows in machines():
        device = f"{machine['cores']} cores of an {machine['cpu'].replace('(R)', '')}"
        renderer = f"the software renderer {machine['gl_renderer']}" if draws_on_the_cpu(machine) else machine["gl_renderer"]
        result += [f"**{renderer[0].upper()}{renderer[1:]}** on {device} ([tables](data/machines/{name}), {machine['started_utc'][:10]}):", "",
                   *table(rows), ""]
    return result
