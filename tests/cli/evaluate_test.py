"""curveskel evaluate."""

import json
import unittest

from program import LINKED_RINGS, Y, CommandLineTest, run

USAGE, INPUT = 2, 3


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
        result = run("evaluate", LINKED_RINGS, "y.obj", "--json", "e.json", cwd=self.folder)
        self.assertIn("WRONG", result.out.decode())
        self.assertEqual(result.code, 5)  # as of extract
        self.assertIn("the certificate failed", result.err)
        self.assertIn("e.json", self.files())

    def moved(self, name, place):
        """The skeleton y.obj with each node at place(x, y, z)."""
        lines = [line if not line.startswith("v ") else
                 " ".join(["v", *map(str, place(*map(float, line.split()[1:])))])
                 for line in (self.folder / "y.obj").read_text().splitlines()]
        (self.folder / name).write_text("\n".join(lines) + "\n")
        return name

    def test_a_skeleton_elsewhere_is_of_another_surface(self):
        self.run_ok("extract", Y, "-o", "y.obj", cwd=self.folder)
        shifted = self.moved("shifted.obj", lambda x, y, z: (x, y, z + 20))
        result = run("evaluate", Y, shifted, cwd=self.folder)
        self.assertEqual(result.code, 5, result.err)
        self.assertIn("no node of the skeleton is inside the surface", result.err)

    def test_a_skeleton_in_another_unit_is_warned_of(self):
        self.run_ok("extract", Y, "-o", "y.obj", cwd=self.folder)
        for factor in (0.001, 0.01, 100, 1000):
            scaled = self.moved("scaled.obj", lambda *place: [factor * x for x in place])
            result = run("evaluate", Y, scaled, cwd=self.folder)
            self.assertIn(f"times {1 / factor:g} they would", result.err)
            self.assertIn("export both in one unit", result.err)

    def test_strict_makes_a_failed_certificate_an_error(self):
        self.run_ok("extract", Y, "-o", "y.obj", cwd=self.folder)
        self.run_ok("evaluate", Y, "y.obj", "--strict", cwd=self.folder)
        result = run("evaluate", LINKED_RINGS, "y.obj", "--strict", cwd=self.folder)
        self.assertEqual(result.code, 5, result.err)
        self.assertIn("the certificate failed", result.err)

    def test_against_another_skeleton_gives_the_distance(self):
        self.run_ok("extract", Y, "-o", "y.obj", cwd=self.folder)
        self.moved("moved.obj", lambda x, y, z: (x + 0.1, y, z))
        distances = []
        for other in ("y.obj", "moved.obj"):
            self.run_ok("evaluate", Y, "y.obj", "--against", other, "--json", "e.json",
                        cwd=self.folder)
            found = json.loads((self.folder / "e.json").read_text())["against"]
            self.assertEqual(found["skeleton"], other)
            distances.append(found["hausdorff_distance"])
            self.assertLessEqual(found["mean_distance"], found["hausdorff_distance"] + 1e-12)
            for side in ("this", "other"):
                self.assertGreater(found["where_both_run"][side]["share_of_length"], 0.9)
                self.assertLess(found["where_both_run"][side]["centredness_median"], 1)
        self.assertAlmostEqual(distances[0], 0, places=9)
        self.assertGreater(distances[1], 0.001)

    def test_json_on_standard_output(self):
        self.run_ok("extract", Y, "-o", "y.obj", cwd=self.folder)
        result = self.run_ok("evaluate", Y, "y.obj", "--json", "-", cwd=self.folder)
        self.assertTrue(json.loads(result.out)["certificate"]["topology_correct"])

    def test_a_rig_beside_itself_and_beside_one_with_fewer_joints(self):
        for name, options in (("fine.glb", ("--bone-length", "3")), ("coarse.glb", ())):
            self.run_ok("rig", Y, "-o", name, *options, cwd=self.folder)
        found = {}
        for truth in ("fine.glb", "coarse.glb"):
            result = self.run_ok("evaluate", "fine.glb", "--rig-truth", truth, "--json", "x.json",
                                 cwd=self.folder)
            found[truth] = json.loads((self.folder / "x.json").read_text())
            self.assertEqual(found[truth]["truth"], truth)
            self.assertIn("joints to joints", result.out.decode())
        same = found["fine.glb"]
        self.assertEqual((same["joints_to_joints"], same["by_size"]["overlap"]), (0, 1))
        self.assertEqual((same["weights"]["l1"], same["poses"]["mean_distance"]), (0, 0))
        other = found["coarse.glb"]
        self.assertGreater(other["joints"], other["truth_joints"])
        self.assertGreater(other["joints_to_joints"], 0)
        self.assertIn("joints", other["weights"]["missing"])
        result = self.run_ok("evaluate", "fine.glb", "--rig-truth", "coarse.glb", "--json", "-",
                             cwd=self.folder)
        self.assertEqual(json.loads(result.out), other)

    def test_a_rig_is_compared_with_a_rig_and_a_surface_with_a_skeleton(self):
        self.run_ok("rig", Y, "-o", "y.glb", cwd=self.folder)
        self.refused(USAGE, "evaluate", Y, cwd=self.folder, says=["SKELETON", "--rig-truth"])
        self.refused(USAGE, "evaluate", "y.glb", "x.obj", "--rig-truth", "y.glb", cwd=self.folder,
                     says=["--rig-truth", "SKELETON"])
        for rig, truth in ((Y, "y.glb"), ("y.glb", Y)):
            self.refused(INPUT, "evaluate", rig, "--rig-truth", truth, cwd=self.folder,
                         says=[Y.name, "no rig", "curveskel rig"])

    def test_joints_of_any_file_that_has_them_are_compared(self):
        self.run_ok("rig", Y, "-o", "y.glb", "-o", "y.fbx", "-o", "y.json", "-o", "y.txt",
                    cwd=self.folder)
        for rig, truth in (("y.glb", "y.fbx"), ("y.fbx", "y.glb"), ("y.fbx", "y.fbx"),
                           ("y.glb", "y.json"), ("y.json", "y.glb"), ("y.glb", "y.txt"),
                           ("y.txt", "y.fbx")):
            result = self.run_ok("evaluate", rig, "--rig-truth", truth, "--json", "-",
                                 cwd=self.folder)
            found = json.loads(result.out)
            self.assertLess(found["joints_to_joints"], 1e-5, (rig, truth))
            self.assertEqual(found["by_size"]["overlap"], 1, (rig, truth))
            self.assertIn("no weights", found["weights"]["missing"])
            self.assertNotIn("within the box", result.err)
        self.refused(INPUT, "evaluate", "y.json", "--rig-truth", "y.txt", cwd=self.folder,
                     says=["joints alone", "a surface"])

    def test_joints_in_another_unit_are_warned_of(self):
        self.run_ok("rig", Y, "-o", "y.glb", "-o", "y.json", cwd=self.folder)
        rig = json.loads((self.folder / "y.json").read_text())
        for joint in rig["joints"]:
            joint["position"] = [100 * number for number in joint["position"]]
        (self.folder / "cm.json").write_text(json.dumps(rig))
        result = self.run_ok("evaluate", "y.glb", "--rig-truth", "cm.json", cwd=self.folder)
        self.assertIn("cm.json", result.err)
        self.assertIn("times 0.01", result.err)

    def test_rigs_that_are_not_read_are_refused_by_name(self):
        for name in ("y.npz", "y.usda", "y.usdz", "y.bvh"):
            self.run_ok("rig", Y, "-o", name, cwd=self.folder)
            self.refused(INPUT, "evaluate", name, "--rig-truth", name, cwd=self.folder,
                         says=[name[1:] + " file", "--rig-truth", ".glb"])


    def test_a_surface_for_a_skeleton_is_called_one(self):
        self.run_ok("rig", Y, "-o", "y.glb", cwd=self.folder)
        self.refused(INPUT, "evaluate", Y, "y.glb", cwd=self.folder,
                     says=["a surface file (glb)", "give the skeleton"])
        self.refused(INPUT, "evaluate", Y, Y, cwd=self.folder, says=["a surface file (off)"])

    def test_standard_input_gives_no_rig_and_no_skeleton(self):
        self.refused(2, "evaluate", "-", "--rig-truth", "r.glb", says=["no rig", "name a file"])
        self.refused(2, "evaluate", "r.glb", "--rig-truth", "-", says=["no rig", "name a file"])
        self.refused(2, "evaluate", Y, "-", says=["the surface alone", "name a file"])


if __name__ == "__main__":
    unittest.main()
