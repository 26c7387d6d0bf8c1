"""The workflow over a small sheet: a row for each surface, the same bytes twice, resumable."""

import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

PROGRAM = os.environ["CURVESKEL_PROGRAM"]
SOURCE = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"])
SKIPPED = 77

ROWS = [("y", "meshes/y.off", ""), ("torus", "meshes/torus.off", "--detail 0.2"),
        ("no-surface", "meshes/README.md", ""), ("none", "meshes/none.off", ""),
        ("wrong", "meshes/y.off", "--detail 7")]


def expect(truth, message):
    if not truth:
        sys.exit(f"workflow_test: {message}")


def run(folder, sheet, *more):
    return subprocess.run(
        ["snakemake", *more, "--snakefile", SOURCE / "workflow" / "workflow" / "Snakefile",
         "--profile", SOURCE / "workflow" / "profiles" / "local", "--directory", folder, "--config",
         f"sheet={sheet}", "results=.", f"program={PROGRAM}", "shard_size=2", "worst=1"],
        capture_output=True, text=True)


def write_sheet(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("id", "path", "options"))
        writer.writerows((name, SOURCE / mesh, options) for name, mesh, options in rows)


def check(folder):
    sheet = folder / "sheet.csv"
    write_sheet(sheet, ROWS)
    results = folder / "results"
    results.mkdir()
    first = run(results, sheet)
    expect(first.returncode == 0, first.stderr[-2000:])
    with open(results / "surfaces.csv", newline="") as file:
        rows = {row["id"]: row for row in csv.DictReader(file)}
    expect(list(rows) == [name for name, *_ in ROWS], f"rows of {list(rows)}")
    expect([row["status"] for row in rows.values()] == ["0", "0", "3", "3", "2"], rows)
    expect(rows["y"]["tips"] == "3" and rows["torus"]["cycle_rank"] == "1", rows)
    expect("cannot be opened" in rows["none"]["message"], rows["none"])
    expect("--detail" in rows["wrong"]["message"], rows["wrong"])
    with open(results / "branches.csv", newline="") as file:
        branches = [row["id"] for row in csv.DictReader(file)]
    expect(branches == ["y", "y", "y", "torus"], branches)
    expect("<svg" in (results / "report.html").read_text(), "no picture in the report")

    # What a killed job leaves: some surfaces with a status, no table. They are not done again.
    tables = [(results / name).read_bytes() for name in ("surfaces.csv", "branches.csv")]
    done = results / "work" / "00000" / "y.status"
    before = done.stat().st_mtime_ns
    (results / "work" / "00000" / "torus.status").unlink()
    (results / "shards" / "00000.surfaces.csv").unlink()
    again = run(results, sheet)
    expect(again.returncode == 0, again.stderr[-2000:])
    expect(done.stat().st_mtime_ns == before, "a surface that was done is done again")
    expect((results / "work" / "00000" / "torus.status").exists(), "a surface is left out")
    expect(tables == [(results / name).read_bytes() for name in ("surfaces.csv", "branches.csv")],
           "other bytes from the same surfaces")

    for rows, word in (([ROWS[0], ROWS[0]], "twice"), ([("a b", "x.off", "")], "does not match"),
                       ([], "no surface")):
        write_sheet(sheet, rows)
        refused = run(folder / "refused", sheet, "--dry-run")
        expect(refused.returncode != 0 and word in refused.stdout + refused.stderr,
               f"{word}: {refused.stderr[-500:]}")


def main():
    for tool in ("snakemake", "parallel"):
        if shutil.which(tool) is None:
            print(f"skipped: there is no {tool}")
            sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as folder:
        check(pathlib.Path(folder))


main()
