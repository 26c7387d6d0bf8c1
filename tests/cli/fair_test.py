"""curveskel fair."""

import unittest

from ply import extent, ply
from program import TORUS, Y, CommandLineTest, run

USAGE = 2


class Fair(CommandLineTest):
    def test_keeps_the_vertices_and_faces_of_the_file_and_its_volume(self):
        vertices, faces = TORUS.read_text().split("\n", 2)[1].split()[:2]
        result = self.run_ok("fair", TORUS, "-o", "x.ply", "--iterations", "5", cwd=self.folder)
        self.assertIn("moved", result.out.decode())
        counts, positions = ply(self.folder / "x.ply")
        self.assertEqual(counts, {"vertex": int(vertices), "face": int(faces)})
        self.assertAlmostEqual(extent(positions), 8, delta=0.1)

    def test_no_iteration_changes_nothing(self):
        self.run_ok("fair", Y, "-o", "0.off", "--iterations", "0", cwd=self.folder)
        self.run_ok("fair", self.folder / "0.off", "-o", "1.off", "--iterations", "0",
                    cwd=self.folder)
        self.assertEqual((self.folder / "0.off").read_bytes().splitlines()[2:],
                         (self.folder / "1.off").read_bytes().splitlines()[2:])

    def test_methods_and_thread_counts_agree(self):
        for name, arguments in (("host", ["--threads", "1"]), ("again", ["--threads", "2"]),
                                ("cpu", ["--method", "cpu"])):
            self.run_ok("fair", TORUS, "-o", f"{name}.ply", *arguments, cwd=self.folder)
        self.assertEqual((self.folder / "host.ply").read_bytes(),
                         (self.folder / "again.ply").read_bytes())
        for p, q in zip(ply(self.folder / "host.ply")[1], ply(self.folder / "cpu.ply")[1]):
            for a, b in zip(p, q):
                self.assertAlmostEqual(a, b, delta=1e-9)

    def test_an_open_surface_keeps_its_boundary(self):
        square = "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .5 1\n" \
                 "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"
        (self.folder / "pyramid.off").write_text(square)
        result = self.run_ok("fair", "pyramid.off", "-o", "x.ply", cwd=self.folder)
        self.assertIn("not closed (4 edges with one face, 0 with three or more): faired as it is, "
                      "its boundaries held", result.err)
        self.assertNotIn("needed", result.err)
        positions = ply(self.folder / "x.ply")[1]
        self.assertEqual(positions[:4], [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
        self.assertLess(positions[4][2], 1)

    def test_the_closed_form_is_of_one_ring_on_host_and_device(self):
        for arguments in (("--rings", "2"), ("--method", "cpu")):
            self.refused(USAGE, "fair", Y, "-o", "x.ply", *arguments, "--local-solver", "closed",
                         says=["closed", "qr"], cwd=self.folder)

    def test_larger_patches_move_more_and_both_local_solvers_agree(self):
        moved = []
        for name, arguments in (("closed", ["--rings", "1"]), ("two", ["--rings", "2"]),
                                ("qr", ["--local-solver", "qr"])):
            self.run_ok("fair", TORUS, "-o", f"{name}.ply", "--volume", "keep", *arguments,
                        cwd=self.folder)
            moved.append(ply(self.folder / f"{name}.ply")[1])
        closed, two, qr = moved
        self.assertLess(extent(two), extent(closed))
        for p, q in zip(closed, qr):
            for a, b in zip(p, q):
                self.assertAlmostEqual(a, b, delta=1e-9)
        self.refused(2, "fair", TORUS, "-o", "x.ply", "--rings", "0", says=["--rings", "from 1"],
                     cwd=self.folder)

    def test_interop_is_refused_with_the_extension_and_the_method_that_works(self):
        result = run("devices")
        says = ["opencl-interop", "opencl"]
        if result.code == 0:
            says.append("cl_khr_gl_sharing")
        self.refused(4, "fair", TORUS, "-o", "x.ply", "--method", "opencl-interop", says=says,
                     cwd=self.folder)

    def test_stl_is_refused_where_single_precision_loses_the_shape(self):
        lines = Y.read_text().splitlines()
        counts = next(i for i, line in enumerate(lines) if line[:1].isdigit())
        vertices = int(lines[counts].split()[0])
        places = [i for i in range(counts + 1, len(lines)) if lines[i].strip()][:vertices]
        for i in places:
            lines[i] = " ".join(str(float(x) + 1e7) for x in lines[i].split())
        (self.folder / "far.off").write_text("\n".join(lines) + "\n")
        self.refused(6, "fair", "far.off", "-o", "x.stl", cwd=self.folder,
                     says=["single precision", "STL", "obj, off or ply", "to the origin"])
        self.run_ok("fair", "far.off", "-o", "x.ply", cwd=self.folder)
        self.run_ok("fair", Y, "-o", "x.stl", cwd=self.folder)

    def test_a_missing_device_is_named(self):
        result = run("fair", TORUS, "-o", "x.ply", "--method", "opencl", cwd=self.folder)
        if result.code != 0:
            self.assertEqual(result.code, 4)
            self.assertIn("host", result.err)


if __name__ == "__main__":
    unittest.main()
