"""curveskel contract."""

import os
import unittest

from ply import extent, ply
from program import LINKED_RINGS, TORUS, Y, CommandLineTest, run


class Contract(CommandLineTest):
    def test_keeps_the_vertices_and_faces_of_the_file(self):
        vertices, faces = TORUS.read_text().split("\n", 2)[1].split()[:2]
        result = self.run_ok("contract", TORUS, "-o", "x.ply", cwd=self.folder)
        self.assertRegex(result.out.decode(), "; the (area|volume) is below the limit\n")
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


    def test_jacobi_says_that_it_diverges(self):
        self.refused(5, "contract", Y, "-o", "x.ply", "--flow", "paper", "--solver", "jacobi",
                     says=["diverges", "spectral radius", "cholesky"], cwd=self.folder)

    def test_solvers_on_a_device_work_or_say_what_is_missing(self):
        for solver in ("vcl-lsm", "cg", "gauss-seidel"):
            result = run("contract", Y, "-o", "x.ply", "--solver", solver, "--iterations", "1",
                         cwd=self.folder)
            if result.code != 0:
                self.assertEqual(result.code, 4)
                self.assertIn("use the solver cholesky", result.err)

    def test_without_a_driver_what_needs_one_is_refused(self):
        environment = dict(os.environ, OCL_ICD_VENDORS="/nonexistent")
        for arguments in (("contract", Y, "-o", "x.ply", "--solver", "gauss-seidel"),
                          ("contract", Y, "-o", "x.ply", "--solver", "vcl-qr"),
                          ("fair", Y, "-o", "x.ply", "--method", "opencl")):
            self.refused(4, *arguments, says=["no", "device", "found", "pocl-opencl-icd"],
                         cwd=self.folder, env=environment)


if __name__ == "__main__":
    unittest.main()
