"""Scores of the benchmark with known truth: curves whose distances are known."""

import os
import pathlib
import subprocess
import sys
import types
import unittest

import numpy

sys.path.insert(0, str(pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"]) / "bench" / "truth"))
import score

RADIUS = 0.05


def curve(places, radii=None):
    """A chain of nodes."""
    places = numpy.asarray(places, dtype=float)
    edges = numpy.array([(k, k + 1) for k in range(len(places) - 1)]).reshape(-1, 2)
    radii = numpy.full(len(places), RADIUS) if radii is None else numpy.asarray(radii, dtype=float)
    return types.SimpleNamespace(vertices=places, edges=edges, radii=radii)


def line(shares, up=0.0, radii=None):
    """Along x from 0 to 1."""
    return curve([(share, up, 0) for share in shares], radii)


# Vertices of a box around the line, with a diagonal of 1.2.
SIDE = numpy.sqrt((1.2 ** 2 - 1.1 ** 2) / 2)
SURFACE = numpy.array([(x, y, z) for x in (-0.05, 1.05) for y in (-SIDE / 2, SIDE / 2)
                       for z in (-SIDE / 2, SIDE / 2)])
EVEN = numpy.linspace(0, 1, 11)
# As many nodes in the first hundredth as in all the rest.
UNEVEN = numpy.concatenate([numpy.linspace(0, 0.01, 1000), numpy.linspace(0.011, 1, 1000)])


class Usage(unittest.TestCase):
    def test_says_what_it_needs(self):
        for words in ([], ["truth"], ["truth", "skeletons", "--csv"]):
            ran = subprocess.run([sys.executable, score.__file__, *words], capture_output=True,
                                 text=True)
            self.assertEqual(ran.returncode, 2)
            self.assertTrue(ran.stderr.startswith("usage: score.py "), ran.stderr)
            self.assertNotIn("Traceback", ran.stderr)


class Scores(unittest.TestCase):
    def test_truth_itself_has_no_distance_however_it_is_cut(self):
        bend = [(0, 0, 0), (0.31, 0.2, 0), (0.77, -0.1, 0.05), (1, 0, 0)]
        cut = [(1 - t) * numpy.array(a) + t * numpy.array(b)
               for a, b in zip(bend, bend[1:]) for t in (0, 0.123, 0.7)] + [bend[-1]]
        for ours, truth in ((line((0, 1)), line(EVEN)), (line(UNEVEN), line((0, 1))),
                            (curve(cut), curve(bend))):
            row = score.score(SURFACE, truth, ours)
            self.assertLess(row["hausdorff"], 1e-12)
            self.assertLess(row["mean_distance"], 1e-12)
            self.assertLess(row["radius_error"], 1e-12)

    def test_distances_are_over_the_diagonal(self):
        row = score.score(SURFACE, line(EVEN), line((0, 0.37, 1), up=0.03))
        self.assertAlmostEqual(row["hausdorff"], 0.03 / 1.2, 12)
        self.assertAlmostEqual(row["mean_distance"], 0.03 / 1.2, 12)

    def test_hausdorff_reaches_to_the_ends(self):
        row = score.score(SURFACE, line(EVEN), line((0, 0.9)))
        self.assertAlmostEqual(row["hausdorff"], 0.1 / 1.2, 12)
        # Of the truth's length a tenth lies .05 off in the mean, and none of ours.
        self.assertAlmostEqual(row["mean_distance"], 0.1 * 0.05 / 2 / 1.2, 5)

    def test_means_weigh_by_length_not_by_nodes(self):
        def wedge(shares):
            return curve([(share, 0.1 * share, 0) for share in shares])
        rows = [score.score(SURFACE, line((0, 1)), wedge(shares)) for shares in (EVEN, UNEVEN)]
        self.assertAlmostEqual(rows[0]["mean_distance"], 0.05 / 1.2, 3)
        self.assertAlmostEqual(rows[0]["mean_distance"], rows[1]["mean_distance"], 5)

    def test_radius_error_is_the_median_of_the_length(self):
        # From no error at x = 0 to 40 % at x = 1: 20 % in the middle of the length.
        for shares in (EVEN, UNEVEN):
            radii = RADIUS * (1 + 0.4 * numpy.asarray(shares))
            row = score.score(SURFACE, line((0, 1)), line(shares, radii=radii))
            self.assertAlmostEqual(row["radius_error"], 0.2, 3)

    def test_radius_of_the_truth_is_that_at_the_nearest_point(self):
        truth = line((0, 1), radii=(0.02, 0.06))
        row = score.score(SURFACE, truth, line(EVEN, radii=0.02 + 0.04 * EVEN))
        self.assertLess(row["radius_error"], 1e-12)

    def test_lone_node_counts_for_the_distance_alone(self):
        ours = line((0, 1))
        ours.vertices = numpy.vstack([ours.vertices, (0.5, 0.2, 0)])
        ours.radii = numpy.full(3, RADIUS)
        row = score.score(SURFACE, line(EVEN), ours)
        self.assertFalse(row["topology"])
        self.assertAlmostEqual(row["hausdorff"], 0.2 / 1.2, 12)
        self.assertLess(row["mean_distance"], 1e-12)


if __name__ == "__main__":
    unittest.main()
