"""The same bytes whatever addresses the memory has: sets and unions of CGAL's hang on their order
where one is not careful, and two threads change it."""

import math
import os
import random
import unittest

from program import MESHES, CommandLineTest, write_torus

SHUFFLED = os.environ["CURVESKEL_SHUFFLED_ADDRESSES"]
BOX = ("013", "032", "467", "475", "045", "051", "237", "276", "026", "064", "157", "173")


def write_parts(path, parts):
    """Closed parts of points and triangles, each vertex its part's own."""
    lines, before = [], 1
    for points, faces in parts:
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in points]
        lines += ["f " + " ".join(str(before + corner) for corner in face) for face in faces]
        before += len(points)
    path.write_text("\n".join(lines) + "\n")
    return path


def fir():
    """Tilted cones, each in the next."""
    chance, sides = random.Random(1), 9
    for k in range(6):
        radius, tilt, turn = 1 - .12 * k, chance.uniform(-.2, .2), chance.uniform(0, 6)
        rim = [(radius * math.cos(turn + 2 * math.pi * i / sides), 0,
                radius * math.sin(turn + 2 * math.pi * i / sides)) for i in range(sides)]
        c, s = math.cos(tilt), math.sin(tilt)
        yield ([(c * x - s * y, s * x + c * y + .6 * k, z)
                for x, y, z in [*rim, (0, 1.2, 0), (0, -.1, 0)]],
               [face for i in range(sides) for j in [(i + 1) % sides]
                for face in ((j, i, sides), (i, j, sides + 1))])


def house():
    """Boxes with sides in the same planes."""
    chance = random.Random(1)
    for _ in range(12):
        low = [chance.randrange(0, 12) / 4 for _ in range(3)]
        width = [chance.randrange(3, 12) / 4 for _ in range(3)]
        yield ([(low[0] + width[0] * x, low[1] + width[1] * y, low[2] + width[2] * z)
                for x in (0, 1) for y in (0, 1) for z in (0, 1)],
               [tuple(map(int, face)) for face in BOX])


class AnyAddresses(CommandLineTest):
    def expect_same_bytes(self, verb, mesh, output, *options):
        written = set()
        for seed in range(1, 5):
            self.run_ok(verb, mesh, "-o", output, "--threads", 1 + seed % 2, *options,
                        cwd=self.folder,
                        env={**os.environ, "LD_PRELOAD": SHUFFLED, "CURVESKEL_SHUFFLE": str(seed)})
            written.add((self.folder / output).read_bytes())
        self.assertEqual(len(written), 1, output)

    def test_of_bodies_made_of_parts_that_overlap(self):
        for name, parts in (("fir", fir()), ("house", house())):
            mesh = write_parts(self.folder / f"{name}.obj", parts)
            self.expect_same_bytes("extract", mesh, f"{name}.json", "--merge-overlapping")

    def test_of_a_skeleton(self):
        self.expect_same_bytes("extract", write_torus(self.folder / "torus.ply", 60, 30),
                               "torus.json")

    def test_of_a_surface_that_is_wrapped(self):
        house_of_sheets = write_parts(self.folder / "open.obj",
                                      [(points, faces[2:]) for points, faces in house()])
        self.expect_same_bytes("extract", house_of_sheets, "open.json")

    def test_of_a_rig(self):
        self.expect_same_bytes("rig", MESHES / "free" / "spot-3k.obj", "spot.glb")


if __name__ == "__main__":
    unittest.main()
