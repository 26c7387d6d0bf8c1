"""The workflow over small sheets: a row for each surface, the same bytes twice, resumable."""

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

# The program, but some surfaces end it: `fault` by a crash, `greedy` always and `memory` once as the
# system does where memory is short, `stopped` once as a job's end does.
MORTAL = """#!/bin/sh
case " $* " in
  *fault.off*) kill -SEGV $$ ;;
  *memory.off*) [ -e "{folder}/once" ] || {{ touch "{folder}/once"; kill -KILL $$; }} ;;
  *greedy.off*) kill -KILL $$ ;;
  *stopped.off*) [ -e "{folder}/twice" ] || {{ touch "{folder}/twice"; kill -TERM $$; }} ;;
esac
exec "{program}" "$@"
"""


def expect(truth, message):
    if not truth:
        sys.exit(f"workflow_test: {message}")


def run(folder, sheet, *more, program=PROGRAM, results=".", shard_size=2, time_limit=60,
        option="worst=1"):
    return subprocess.run(
        ["snakemake", *more, "--snakefile", SOURCE / "workflow" / "workflow" / "Snakefile",
         "--profile", SOURCE / "workflow" / "profiles" / "local", "--cores", "2", "--directory",
         folder, "--config", f"sheet={sheet}", f"results={results}", f"program={program}",
         f"shard_size={shard_size}", f"time_limit={time_limit}", option],
        capture_output=True, text=True)


def done(*arguments, **options):
    ran = run(*arguments, **options)
    expect(ran.returncode == 0, (ran.stdout + ran.stderr)[-3000:])
    return ran


def write_sheet(path, rows, columns=("id", "path", "options")):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows((name, SOURCE / mesh, *more) for name, mesh, *more in rows)


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def times(results):
    """When each surface was done, by its id."""
    return {path.parent.name: path.stat().st_mtime_ns for path in results.glob("work/*/*/status")}


def rows_of_all_kinds(folder):
    sheet = folder / "sheet.csv"
    write_sheet(sheet, ROWS)
    results = folder / "results"
    results.mkdir()
    done(results, sheet)
    rows = {row["id"]: row for row in table(results / "surfaces.csv")}
    expect(list(rows) == [name for name, *_ in ROWS], f"rows of {list(rows)}")
    expect([row["status"] for row in rows.values()] == ["0", "0", "3", "3", "2"], rows)
    expect(rows["y"]["tips"] == "3" and rows["torus"]["cycle_rank"] == "1", rows)
    expect("cannot be opened" in rows["none"]["message"], rows["none"])
    expect("--detail" in rows["wrong"]["message"], rows["wrong"])
    branches = [row["id"] for row in table(results / "branches.csv")]
    expect(branches == ["y", "y", "y", "torus"], branches)
    report, worst = (results / "report.html").read_text().split("The worst certificates")
    expect("<svg" in worst, "no picture in the report")
    expect("no such file, or no surface" in report, "no word about a file that is not there")
    tips = next(chart for chart in report.split("<figure>") if "<figcaption>tips" in chart)
    expect("log scale, 1 of 0 beside it" in tips and "0.001" not in tips, f"a torus: {tips}")
    documented = (SOURCE / "workflow" / "README.md").read_text()
    for column in rows["y"]:
        expect(f"`{column}`" in documented, f"workflow/README.md has no word about {column}")

    again = done(results, sheet)
    expect("Nothing to be done" in again.stdout + again.stderr, "a complete batch runs again")

    # A killed job leaves some surfaces with a status, and no table. They are not done again.
    tables = [(results / name).read_bytes() for name in ("surfaces.csv", "branches.csv")]
    before = times(results)
    (results / "work" / "00000" / "torus" / "status").unlink()
    (results / "shards" / "00000.surfaces.csv").unlink()
    (results / "surfaces.csv").unlink()
    done(results, sheet)
    after = times(results)
    expect(after["y"] == before["y"], "a surface that was done is done again")
    expect("torus" in after, "a surface is left out")
    expect(tables == [(results / name).read_bytes() for name in ("surfaces.csv", "branches.csv")],
           "other bytes from the same surfaces")
    (results / "work" / "00000" / "torus" / "status").unlink()
    done(results, sheet, "--forcerun", "extract")
    expect("torus" in times(results), "a surface is not made again as the manual has it")

    # Tables that do not fit the sheet are refused, and their shard named.
    shard = results / "shards" / "00001.surfaces.csv"
    text = shard.read_text()
    for spoilt, word in ((text + text.splitlines()[-1] + "\n", "found 3 rows, needed the 2"),
                         (text.replace("none,", "nobody,"), "nobody")):
        shard.write_text(spoilt)
        refused = run(results, sheet)
        expect(refused.returncode != 0 and word in refused.stdout + refused.stderr,
               f"{word}: {refused.stderr[-2000:]}")


def changes_of_the_sheet(folder):
    mesh = folder / "mesh.off"
    shutil.copy(SOURCE / "meshes" / "y.off", mesh)
    sheet = folder / "changing.csv"
    results = folder / "changing"
    rows = [("a", mesh, ""), ("b", "meshes/torus.off", ""), ("c", "meshes/tube.off", "")]
    write_sheet(sheet, rows)
    results.mkdir()
    done(results, sheet, time_limit=0.001)
    found = table(results / "surfaces.csv")
    expect(all("time limit" in row["message"] for row in found), found)
    done(results, sheet)
    found = table(results / "surfaces.csv")
    expect([row["status"] for row in found] == ["0"] * 3, f"not tried with more time: {found}")
    before = times(results)
    done(results, sheet, time_limit=70)
    expect(times(results) == before, "more time is given to surfaces that were done")

    # Meshes change places, and one has other options: each row is of its own mesh.
    write_sheet(sheet, [("a", "meshes/torus.off", ""), ("b", mesh, ""), rows[2]])
    done(results, sheet, time_limit=70)
    found = {row["id"]: row for row in table(results / "surfaces.csv")}
    expect(found["a"]["cycle_rank"] == "1" and found["b"]["tips"] == "3", found)
    expect(times(results)["c"] == before["c"], "a surface that did not change is done again")
    write_sheet(sheet, [("a", "meshes/torus.off", "--detail 9"), ("b", mesh, ""), rows[2]])
    # Another file under the same path, no younger.
    stamp = mesh.stat()
    shutil.copy(SOURCE / "meshes" / "double-torus.off", mesh)
    os.utime(mesh, ns=(stamp.st_atime_ns, stamp.st_mtime_ns))
    done(results, sheet, time_limit=70)
    found = {row["id"]: row for row in table(results / "surfaces.csv")}
    expect(found["a"]["status"] == "2" and found["a"]["cycle_rank"] == "", found["a"])
    expect(found["b"]["cycle_rank"] == "2", f"the numbers of the mesh before: {found['b']}")

    done(results, sheet, shard_size=100)
    found = [row["id"] for row in table(results / "surfaces.csv")]
    expect(found == ["a", "b", "c"], f"one shard of what were two: {found}")
    branches = [(row["id"], row["branch"]) for row in table(results / "branches.csv")]
    expect(len(branches) == len(set(branches)) > 3, f"one shard of what were two: {branches}")


def surfaces_that_end_the_program(folder):
    here = folder / "a folder"
    here.mkdir()
    program = here / "mortal program"
    program.write_text(MORTAL.format(folder=here, program=PROGRAM))
    program.chmod(0o755)
    sheet = here / "a sheet.csv"
    names = ("fault", "memory", "greedy", "fine")
    for name in (*names, "stopped"):
        shutil.copy(SOURCE / "meshes" / "y.off", here / f"{name}.off")
    write_sheet(sheet, [*((name, here / f"{name}.off", "") for name in names),
                        ("fine.1", "meshes/torus.off", ""),
                        ("levels", here / "fine.off", "--levels 3")])
    options = {"program": program, "results": "out 6", "shard_size": 10}
    done(here, sheet, **options)
    found = {row["id"]: row for row in table(here / "out 6" / "surfaces.csv")}
    expect([row["status"] for row in found.values()] == ["139", "0", "137", "0", "0", "0"], found)
    expect(found["fault"]["message"] == "killed by signal 11 (SIGSEGV)", found["fault"])
    expect(found["greedy"]["message"] == "killed by signal 9 (SIGKILL)", found["greedy"])
    expect(found["fine.1"]["cycle_rank"] == "1", "files of two surfaces are mixed up")
    expect("killed by signal 11" in (here / "out 6" / "report.html").read_text(),
           "no word of the signal in the report")

    # The only surface of a page has levels: its picture is there, too.
    write_sheet(sheet, [("levels", here / "fine.off", "--levels 3")])
    done(here, sheet, **options)
    worst = (here / "out 6" / "report.html").read_text().split("The worst certificates")[1]
    expect("<svg" in worst, "no picture of a surface with levels")

    # A job that is ended gives no result, and goes on when it is started again.
    write_sheet(sheet, [("stopped", here / "stopped.off", "")])
    ended = run(here, sheet, **options)
    expect(ended.returncode != 0, "an ended job is taken for a result")
    done(here, sheet, **options)
    expect(table(here / "out 6" / "surfaces.csv")[0]["status"] == "0", "no result of a second start")


def refused(folder):
    sheet = folder / "refused.csv"
    ordinary = ("id", "path", "options")
    for rows, columns, word in (
            ([ROWS[0], ROWS[0]], ordinary, "twice"), ([("a b", "x.off", "")], ordinary, "does not match"),
            ([], ordinary, "no surface"), ([("a", "a\tb.off", "")], ordinary, "does not match"),
            ([ROWS[0]], ("id", "path", "Options"), "Options"),
            ([ROWS[0]], ("id", "file", "options"), "path")):
        write_sheet(sheet, rows, columns)
        ran = run(folder / "refused", sheet, "--dry-run")
        expect(ran.returncode != 0 and word in ran.stdout + ran.stderr,
               f"{word}: {ran.stderr[-500:]}")
    write_sheet(sheet, [(*ROWS[0], "a fly")], (*ordinary, "species"))
    ran = run(folder / "refused", sheet, "--dry-run")
    expect(ran.returncode == 0 and "species" in ran.stdout + ran.stderr, ran.stderr[-500:])
    for option, words in (("timelimit=3", ": there is no such option; those that there are: sheet, "
                           "results, program, shard_size, time_limit, worst\n"),
                          ("worst=few", ": needed is a whole number from 0 up\n")):
        ran = run(folder / "refused", sheet, "--dry-run", option=option)
        said = ran.stdout + ran.stderr
        expect(ran.returncode != 0 and words in said and "line " not in said, f"{option}: {said}")
    ran = run(folder / "refused", sheet, "--dry-run", program=folder / "no-program")
    expect(ran.returncode != 0 and "no-program" in ran.stdout + ran.stderr, ran.stderr[-500:])


def main():
    for tool in ("snakemake", "parallel"):
        if shutil.which(tool) is None:
            print(f"skipped: there is no {tool}")
            sys.exit(SKIPPED)
    for part in (rows_of_all_kinds, changes_of_the_sheet, surfaces_that_end_the_program, refused):
        if len(sys.argv) > 1 and part.__name__ not in sys.argv[1:]:
            continue
        with tempfile.TemporaryDirectory() as folder:
            part(pathlib.Path(folder))


main()
