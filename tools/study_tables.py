# SPDX-License-Identifier: Apache-2.0
"""The block that tools/studies.py writes into the README.md of a study: tables of the values, errors and results that
expected.toml contains."""

BEGIN, END = "<!-- tools/studies.py: begin -->", "<!-- tools/studies.py: end -->"
MOST_ROWS = 24  # rows of a table in a README
LITTLE = 1e-5  # share of the measured value: smaller errors are rounding


def figure(value, digits=3):
    if value is None:
        return "–"
    return "0" if value == 0 else f"{value:.{digits}g}"


def percent(value):
    if value is None:
        return "–"
    return "below 0.001 %" if abs(value) < LITTLE else f"{100 * value:.3g} %"


def with_unit(value):
    return figure(value["value"], 4) + ("" if value["unit"] in ("", "1") else f" {value['unit']}")


def variables_of(entry):
    """Returns a table of the values; with more than MOST_ROWS values, one line that gives their number."""
    values = entry["values"]
    if len(values) > MOST_ROWS:
        two_sided = sum("lower" in value and "upper" in value for value in values.values())
        return [f"{len(values)} variables, {two_sided} of them with two ends of their 95 % interval: `expected.toml`."]
    lines = ["| variable | found | 95 % |", "| --- | --- | --- |"]
    for name, value in values.items():
        ends = "–"
        if "lower" in value or "upper" in value:
            ends = f"{figure(value.get('lower'), 4)} .. {figure(value.get('upper'), 4)}"
        lines.append(f"| {name} | {with_unit(value)} | {ends} |")
    return lines


def errors_of(entry):
    """Returns a table of the errors by experiment; with more than MOST_ROWS experiments, two lines."""
    lines = ["| experiment | | mean error | largest |", "| --- | --- | --- | --- |"]
    for fitted, how in ((True, "fitted"), (False, "predicted")):
        errors = {name: error for name, error in entry["errors"].items() if error["fitted"] == fitted}
        if len(entry["errors"]) > MOST_ROWS and errors:
            means = sorted(errors, key=lambda name: errors[name]["mean"] or 0.0)
            lines.append(f"| {len(errors)}, the median | {how} | {percent(errors[means[len(means) // 2]]['mean'])} | |")
            lines.append(f"| the worst, {means[-1]} | {how} | {percent(errors[means[-1]]['mean'])} | |")
        elif errors:
            lines += [f"| {name} | {how} | {percent(error['mean'])} | {percent(error['largest'])} |"
                      for name, error in errors.items()]
    return lines


def results_of(entry):
    """Returns tables of results. The last word of a result's name is its column; the words before are its row."""
    rows = {}
    for name, value in entry["results"].items():
        row, column = name.rsplit(".", 1) if "." in name else ("", name)
        rows.setdefault(row, {})[column] = value
    tables = {}
    for row, cells in rows.items():
        tables.setdefault(tuple(cells), []).append(f"| {row} | " + " | ".join(figure(cell, 4) for cell in cells.values()) + " |")
    lines = []
    for columns, table in tables.items():
        lines += ["| | " + " | ".join(columns) + " |", "| --- |" + " --- |" * len(columns), *table, ""]
    return lines[:-1]


def table_of(study, entry):
    if "results" in entry:
        return [f"`latsch {' '.join(entry['command'])}`, {entry['cpu_seconds']:.3g} s of processor time:", "", *results_of(entry)]
    cost = f", {entry['cpu_seconds']:.3g} s of processor time" if "cpu_seconds" in entry else ""
    how = f"in {entry['steps']} steps" if "steps" in entry else "of one trial at these values"
    return [f"`{study}`: target {figure(entry['target'])} {how}{cost}.", "", *variables_of(entry), "", *errors_of(entry)]


def block_of(content):
    lines = [BEGIN]
    for study, entry in content.items():
        if "no_run" in entry:
            lines += [f"`{study}`: no run has given its numbers yet. {entry['no_run']}", ""]
        if study != "data" and ("target" in entry or "results" in entry):
            lines += [*table_of(study, entry), ""]
    return "\n".join(lines[:-1] + [END]) if len(lines) > 1 else BEGIN + "\n" + END
