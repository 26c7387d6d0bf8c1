"""The report of a rig is of the rig that is written; options that would change nothing are refused."""

import json
import unittest

from program import MESHES, CommandLineTest

USAGE = 2
SPOT = MESHES / "free" / "spot-3k.obj"


class RigReport(CommandLineTest):
    def made(self, *options):
        """The file's joints, and the report."""
        self.run_ok("rig", SPOT, "-o", "x.json", "--report", "r.json", "-q", *options,
                    cwd=self.folder)
        return [json.loads((self.folder / name).read_text()) for name in ("x.json", "r.json")]

    def test_has_the_joints_of_the_file(self):
        for options in ((), ("--no-ends",), ("--ground-root",), ("--ground-root", "--no-ends")):
            written, report = self.made(*options)
            joints = report["joints"]
            with self.subTest(options=options):
                for key in ("name", "position"):
                    self.assertEqual([joint[key] for joint in joints],
                                     [joint[key] for joint in written["joints"]])
                self.assertEqual([-1 if joint["parent"] is None else joint["parent"]
                                  for joint in joints],
                                 [joint["parent"] for joint in written["joints"]])
                names = [joint["name"] for joint in joints]
                self.assertLessEqual(set(report["checks"]["joints_that_move_nothing"]), set(names))
                self.assertIn("head", report["roles"])
                for role in report["roles"].values():
                    self.assertEqual(names[role["number"]], role["joint"])
                    self.assertEqual(joints[role["number"]]["position"], role["position"])

    def test_has_standard_output_for_itself(self):
        result = self.run_ok("rig", SPOT, "-o", "x.glb", "--report", "-", cwd=self.folder)
        self.assertEqual(json.loads(result.out)["plan"], "quadruped")
        self.assertIn("wrote x.glb", result.err)


class Options(CommandLineTest):
    def test_ends_of_joints_that_are_given_move_nothing(self):
        self.run_ok("rig", SPOT, "-o", "x.glb", "-o", "x.json", "-q", cwd=self.folder)
        for arguments in ((SPOT, "--joints", "x.json"), ("x.glb", "--keep-rig")):
            self.run_ok("rig", *arguments, "-o", "again.glb", "--report", "r.json", "-q",
                        cwd=self.folder)
            report = json.loads((self.folder / "r.json").read_text())
            ends = {joint["name"] for joint in report["joints"] if "_end" in joint["name"]}
            self.assertGreater(len(ends), 4)
            self.assertEqual(ends - set(report["checks"]["joints_that_move_nothing"]), set())

    def test_up_turns_a_file_of_joints_that_are_given(self):
        """Of a format that does not state its axes; the plan says nothing here."""
        self.run_ok("rig", SPOT, "-o", "x.json", "-q", cwd=self.folder)
        rows = {}
        for up in ("y", "z"):
            self.run_ok("rig", SPOT, "--joints", "x.json", "--up", up, "-o", "x.glb", "-q",
                        cwd=self.folder)
            self.run_ok("rig", "x.glb", "--keep-rig", "-o", "again.json", "-q", cwd=self.folder)
            joints = json.loads((self.folder / "again.json").read_text())["joints"]
            rows[up] = {joint["name"]: joint["position"] for joint in joints}
        for name, (x, y, z) in rows["y"].items():
            for found, wanted in zip(rows["z"][name], (x, z, -y)):
                self.assertAlmostEqual(found, wanted, 4)

    def test_that_would_change_nothing_are_refused(self):
        self.run_ok("rig", SPOT, "-o", "x.glb", "-o", "x.json", "-q", cwd=self.folder)
        for arguments, says in (
                ((SPOT, "--joints", "x.json", "--front", "x"), ["--front"]),
                (("x.glb", "--keep-rig", "--up", "z"), ["--up"]),
                (("x.glb", "--bare", "--as-shown"), ["--bare", "--as-shown"]),
                ((SPOT, "--plan", "none", "--front", "x"), ["--front x", "--plan none"]),
                ((SPOT, "--root", "3", "--front", "x"), ["--front x", "--root"])):
            self.refused(USAGE, "rig", *arguments, "-o", "y.glb", says=says, cwd=self.folder)
        for option in (("--strict",), ("--wrap", "all"), ("--against", "x.json")):
            self.refused(USAGE, "evaluate", "x.glb", "--rig-truth", "x.glb", *option,
                         says=[option[0], "--rig-truth"], cwd=self.folder)
        self.refused(USAGE, "fair", SPOT, "--method", "host", "--precision", "single", "-o",
                     "y.ply", says=["single", "host", "double"], cwd=self.folder)


if __name__ == "__main__":
    unittest.main()
