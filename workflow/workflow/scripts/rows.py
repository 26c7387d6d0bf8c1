"""Rows of a shard: one for each surface, whatever became of it, and one for each branch.

usage: rows.py SHEET.tsv WORK SURFACES.csv BRANCHES.csv SECONDS.csv
The first two hold nothing that depends on the machine or the day: the same surfaces, the same bytes.
"""

import csv
import json
import pathlib
import signal
import sys

COLUMNS = ("id", "path", "options", "status", "message", "vertices", "faces", "components", "genus",
           "diagonal", "area", "volume", "cycle_rank", "tips", "junctions", "branches", "length", "inside_fraction",
           "centredness_median", "coverage", "reach", "tube_share", "curve_like",
           "topology_correct", "holds", "repairs")


def certificate_of(report):
    certificate = report["certificate"]
    names = {"components": "components_of_surface"}
    known = {column: certificate.get(names.get(column, column)) for column in COLUMNS}
    return {column: value for column, value in known.items() if value is not None}


def killed_by(number):
    names = {int(one): f" ({one.name})" for one in signal.Signals}
    return f"killed by signal {number}{names.get(number, '')}"


def row_of(surface, work):
    folder = work / surface["id"]
    row = dict.fromkeys(COLUMNS, "")
    row.update(surface)
    row["status"] = (folder / "status").read_text().splitlines()[0]
    lines = (folder / "messages").read_text(errors="replace").strip().splitlines()
    row["message"] = lines[0].removeprefix("curveskel: ") if lines else ""
    if int(row["status"]) > 128:  # and its files may end anywhere
        row["message"] = killed_by(int(row["status"]) - 128)
        return row, [], ""
    report = folder / "report.json"
    if not report.exists():
        return row, [], ""
    report = json.loads(report.read_text())
    row.update(certificate_of(report))
    row.update((name, report["surface"][name]) for name in ("diagonal", "area", "volume"))
    row["vertices"] = report["input"]["vertices"]
    row["faces"] = report["input"]["polygons"]
    row["repairs"] = sum(value for value in report["repairs"].values() if type(value) is int)
    tables = (folder / "branches.csv", folder / "branches.1.csv")  # the finest of several --levels
    table = next((table for table in tables if table.exists()), None)
    branches = list(csv.DictReader(table.read_text().splitlines())) if table else []
    row["branches"] = len(branches)
    return row, branches, report.get("seconds", "")


def main():
    sheet, work, *outputs = map(pathlib.Path, sys.argv[1:])
    with open(sheet, newline="") as file:
        surfaces = list(csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE))
    rows, all_branches, seconds = [], [], []
    for surface in surfaces:
        row, branches, taken = row_of(surface, work)
        rows.append(row)
        all_branches += [{"id": surface["id"], **branch} for branch in branches]
        seconds.append({"id": surface["id"], "seconds": taken})
    columns = list(all_branches[0]) if all_branches else ["id"]
    for path, header, content in zip(outputs, (COLUMNS, columns, ("id", "seconds")),
                                     (rows, all_branches, seconds)):
        with open(path, "w", newline="") as file:
            writer = csv.DictWriter(file, header, lineterminator="\n")
            writer.writeheader()
            writer.writerows(content)


if __name__ == "__main__":
    main()
