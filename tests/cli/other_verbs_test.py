"""curveskel contract, evaluate and devices."""

import json
import struct
import unittest

from program import LINKED_RINGS, TORUS, Y, CommandLineTest, run


def ply(path):
    """Counts from the header, then the vertices of a binary PLY in double precision."""
    data = path.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    counts = {line.split()[1]: int(line.split()[2])
              for line in header.decode().splitlines() if line.startswith("element")}
    positions = [struct.unpack_from("<3d", body, 24 * v) for v in range(counts["vertex"])]
    return counts, positions


def extent(positions):
    return max(max(axis) - min(axis) for axis in zip(*positions))


class Contract(CommandLineTest):
    def test_keeps_the_vertices_and_faces_of_the_file(self):
        vertices, faces = TORUS.read_text().split("\n", 2)[1].split()[:2]
        self.run_ok("contract", TORUS, "-o", "x.ply", cwd=self.folder)
        counts, positions = ply(self.folder / "x.ply")
        self.assertEqual(counts, {"vertex": int(vertices), "face": int(faces)})
        # The tube is gone, the ring is there: major radius 3, minor radius 1.
        self.assertLess(extent(positions), 7.2)
        self.assertGreater(extent(positions), 4.5)
        for x, y, z in positions:
            self.assertLess(abs(z), 0.3)

    def test_frames_begin_with_the_surface_and_shrink(self):
        self.run_ok("contract", LINKED_RINGS, "-o", "x.ply", "--frames", "frames/of/it",
                    "--iterations", "4", cwd=self.folder)
        frames = sorted((self.folder / "frames/of/it").iterdir())
        self.assertEqual([frame.name for frame in frames],
                         ["0000.ply", "0001.ply", "0002.ply", "0003.ply", "0004.ply"])
        counts = [ply(frame)[0]["vertex"] for frame in frames]
        self.assertEqual(counts, sorted(counts, reverse=True))

    def test_both_flows(self):
        for flow in ("medial", "paper"):
            self.run_ok("contract", Y, "-o", f"{flow}.ply", "--flow", flow, cwd=self.folder)


class Evaluate(CommandLineTest):
    def test_gives_the_certificate_that_extract_gave(self):
        self.run_ok("extract", LINKED_RINGS, "-o", "x.obj", "-o", "x.swc", "--report",
                    "report.json", cwd=self.folder)
        given = json.loads((self.folder / "report.json").read_text())["certificate"]
        # SWC numbers its nodes anew, so edges are sampled from their other ends.
        for skeleton, places in (("x.obj", 12), ("x.swc", 3)):
            result = self.run_ok("evaluate", LINKED_RINGS, skeleton, "--json", "x.json",
                                 cwd=self.folder)
            found = json.loads((self.folder / "x.json").read_text())["certificate"]
            self.assertEqual(found.keys(), given.keys())
            for key, value in given.items():
                self.assertAlmostEqual(found[key], value, places=places, msg=key)
            self.assertIn("length inside", result.out.decode())

    def test_finds_what_is_wrong(self):
        self.run_ok("extract", Y, "-o", "y.obj", cwd=self.folder)
        result = self.run_ok("evaluate", LINKED_RINGS, "y.obj", cwd=self.folder)
        self.assertIn("WRONG", result.out.decode())

    def test_json_on_standard_output(self):
        self.run_ok("extract", Y, "-o", "y.obj", cwd=self.folder)
        result = self.run_ok("evaluate", Y, "y.obj", "--json", "-", cwd=self.folder)
        self.assertTrue(json.loads(result.out)["certificate"]["topology_correct"])


class Devices(CommandLineTest):
    def test_lists_some_or_says_how_to_get_one(self):
        result = run("devices")
        if result.code == 0:
            self.assertIn("double precision", result.out.decode())
        else:
            self.assertEqual(result.code, 4)
            self.assertIn("install", result.err)


if __name__ == "__main__":
    unittest.main()
