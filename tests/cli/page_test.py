"""The page of `extract --html`: whole in itself, and alive in a browser where there is one."""

import csv
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

PROGRAM = os.environ["CURVESKEL_PROGRAM"]
MESHES = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"]) / "meshes"
CHROMIUM = shutil.which("chromium")


def pixels_of(path):
    """Rows of RGB or RGBA bytes of a PNG file, eight bits a channel, not interlaced."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        content = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, _, colour = struct.unpack(">IIBB", content[:10])
        if kind == b"IDAT":
            packed += content
        at += 12 + length
    step = 4 if colour == 6 else 3
    raw, rows, before = zlib.decompress(packed), [], bytes(width * step)
    for row in range(height):
        filtering = raw[row * (width * step + 1)]
        line = bytearray(raw[row * (width * step + 1) + 1:(row + 1) * (width * step + 1)])
        for k in range(len(line)):
            left = line[k - step] if k >= step else 0
            up = before[k]
            corner = before[k - step] if k >= step else 0
            if filtering == 4:
                p = left + up - corner
                near = min((abs(p - left), 0, left), (abs(p - up), 1, up),
                           (abs(p - corner), 2, corner))[2]
            else:
                near = (0, left, up, (left + up) // 2)[filtering]
            line[k] = (line[k] + near) & 255
        rows.append(bytes(line))
        before = rows[-1]
    return rows, step


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def make(self, mesh):
        page = self.folder / "page.html"
        subprocess.run([PROGRAM, "extract", MESHES / mesh, "-o", self.folder / "s.csv", "--html",
                        page, "--quiet"], check=True)
        with open(self.folder / "s.csv", newline="") as file:
            return page, list(csv.DictReader(file))

    def test_holds_the_skeleton_and_nothing_from_elsewhere(self):
        page, rows = self.make("y.off")
        text = page.read_text()
        self.assertEqual(set(re.findall(r"https?://[^\s\"'<>)]*", text)),
                         {"http://www.w3.org/2000/svg"})  # a name, which is not fetched
        self.assertFalse(re.search(r"<(link|img|iframe)|\bsrc=|@import|url\(", text))
        data = json.loads(re.search(r'type="application/json">(.*?)</script>', text, re.S)[1])
        self.assertEqual(len(data["lines"]), len(rows))
        self.assertEqual(data["branches"], (self.folder / "s.csv").read_text())
        self.assertEqual(data["title"], "y.off")
        self.assertEqual(data["failures"], "")
        for line, row in zip(data["lines"], rows):
            self.assertEqual([line[0], line[-1]], [int(row["start"]), int(row["end"])])

    def test_is_the_same_each_time(self):
        first = self.make("torus.off")[0].read_bytes()
        self.assertEqual(self.make("torus.off")[0].read_bytes(), first)

    def in_browser(self, page, *options):
        return subprocess.run(
            [CHROMIUM, "--headless=new", "--no-sandbox", "--use-gl=angle",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1000,900",
             f"--user-data-dir={self.folder / 'profile'}", "--virtual-time-budget=5000", *options,
             page], capture_output=True, timeout=120, check=True).stdout.decode()

    @unittest.skipUnless(CHROMIUM, "there is no chromium")
    def test_shows_tables_plot_and_shape_in_a_browser(self):
        page, rows = self.make("y.off")
        address = f"file://{page}#branch=1"
        shown = self.in_browser(address, "--dump-dom")
        table = re.search(r'<table id="branches">.*?</table>', shown, re.S)[0]
        self.assertEqual(len(re.findall(r"<tr data-branch", table)), len(rows))
        self.assertEqual(re.findall(r'data-branch="(\d+)" class="chosen"', table), ["1"])
        self.assertTrue('<div id="named">branch 1: leaf' in shown, "or there is no WebGL")
        self.assertTrue(">Profile of branch 1<" in shown)
        self.assertGreaterEqual(len(re.findall(r"<path ", shown)), 3)
        self.assertTrue('<span id="verdict" class="holds">certificate holds</span>' in shown)
        self.in_browser(address, f"--screenshot={self.folder / 'page.png'}")
        lines, step = pixels_of(self.folder / "page.png")
        # The canvas has the surface's grey, and the chosen branch in its colour.
        colours = {}
        for line in lines[60:480:2]:
            for x in range(40, 560, 2):
                colour = line[x * step:x * step + 3]
                colours[colour] = colours.get(colour, 0) + 1
        greys = sum(count for (r, g, b), count in colours.items()
                    if max(r, g, b) - min(r, g, b) < 12 and 60 < r < 235)
        coloured = sum(count for (r, g, b), count in colours.items()
                       if max(r, g, b) - min(r, g, b) > 40)
        self.assertGreater(greys, 3000)
        self.assertGreater(coloured, 30)  # a thin tube behind glass


if __name__ == "__main__":
    unittest.main()
