"""Every imperfect surface ends in a certified skeleton or in a clear refusal, as docs/robustness.md says.

With --write the table is made anew from what happens; CURVESKEL_COLLECTION names the folder of the
collection, of which meshes/free is a part.
"""

import collections
import json
import os
import pathlib
import sys
import tempfile
import time
import unittest

from program import CommandLineTest, run

SOURCE = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"])
# The surfaces that are free to pass on, or all of a collection.
COLLECTION = os.environ.get("CURVESKEL_COLLECTION")
FOLDER = pathlib.Path(COLLECTION) if COLLECTION else SOURCE / "meshes" / "free"
DOCUMENT = SOURCE / "docs" / "robustness.md"
# What the index calls open, non-manifold or one-sided outside defects/.
IMPERFECT = ["neuron-722817260-18k.ply", "rigs/quaternius-robot-multipart.ply"]

Outcome = collections.namedtuple("Outcome", "file code surface inside how seconds")

BEGIN = "<!-- made by tests/cli/robustness_test.py --write -->"


def files():
    defects = sorted(path.relative_to(FOLDER) for path in (FOLDER / "defects").iterdir())
    imperfect = [file + end for file in IMPERFECT for end in ("", ".gz") if (FOLDER / (file + end)).exists()]
    return [str(path) for path in defects] + imperfect


def outcome(file, folder):
    report_file = pathlib.Path(folder) / "report.json"
    report_file.unlink(missing_ok=True)
    begin = time.monotonic()
    result = run("extract", FOLDER / file, "-o", pathlib.Path(folder) / "skeleton.json",
                 "--report", report_file, "--strict", "--time-limit", "120")
    seconds = time.monotonic() - begin
    if not report_file.exists():
        message = result.err.strip().splitlines()[-1].split(": ", 2)[-1]
        message = message.replace(str(FOLDER) + "/", "")
        if ": found" in message:
            message = "found" + message.split(": found", 1)[1]
        return Outcome(file, result.code, "", "", message.replace("|", "\\|"), seconds)
    report = json.loads(report_file.read_text())
    surface = report["surface"]
    certificate = report["certificate"]
    lines = report["changes"]["lines"] + report["repairs"]["lines"]
    # A bent sheet may be right without being made of tubes, which --strict asks for, too.
    right = certificate["topology_correct"] and certificate["inside_enough"]
    code = 0 if right and result.code == 5 else result.code
    topology = "right" if certificate["topology_correct"] else "WRONG"
    return Outcome(file, code,
                   f"{surface['components']}, genus {surface['genus']}, {topology}",
                   f"{100 * certificate['inside_fraction']:.2f} %",
                   "; ".join(lines) or "nothing to repair", seconds)


def row(o):
    verdict = {0: "certified", 3: "refused", 5: "certificate failed"}.get(o.code, f"exit {o.code}")
    how = o.how if len(o.how) < 330 else o.how[:327] + "..."
    return f"| {o.file.removeprefix('defects/')} | {verdict} | {o.surface} | {o.inside} | {how} |"


def table_rows():
    """File name to verdict and surface, as documented."""
    rows = {}
    for line in DOCUMENT.read_text().split(BEGIN)[-1].splitlines():
        cells = [cell.strip() for cell in line.split(" | ")]
        if line.startswith("| ") and len(cells) >= 5 and cells[0] != "| file":
            rows[cells[0].removeprefix("| ")] = (cells[1], cells[2])
    return rows


class Robustness(CommandLineTest):
    def test_every_surface_ends_as_documented(self):
        print(f"surfaces: {FOLDER}", file=sys.stderr)
        documented = table_rows()
        for file in files():
            with self.subTest(file=file):
                found = outcome(file, self.folder)
                name = file.removeprefix("defects/")
                if not COLLECTION:
                    name = name.removesuffix(".gz")
                self.assertIn(name, documented)
                cells = [cell.strip() for cell in row(found).split(" | ")]
                self.assertEqual((cells[1], cells[2]), documented[name], found)
                self.assertIn(found.code, (0, 3), found)


def write():
    text = DOCUMENT.read_text().split(BEGIN)[0] if DOCUMENT.exists() else ""
    text += BEGIN + "\n| file | outcome | components, genus, topology | inside | what was done, or why not |\n"
    text += "|---|---|---|---|---|\n"
    with tempfile.TemporaryDirectory() as folder:
        for file in files():
            found = outcome(file, folder)
            print(f"{found.seconds:6.1f} s  {found.code}  {row(found)}", flush=True)
            text += row(found) + "\n"
    DOCUMENT.write_text(text)


if __name__ == "__main__":
    if "--write" in sys.argv:
        write()
    else:
        unittest.main()
