"""curveskel extract --preset, --surgery, --embed."""

import json
import unittest

from program import LINKED_RINGS, TORUS, Y, CommandLineTest, run

USAGE = 2
SOLVER = 5


class PresetTest(CommandLineTest):
    def extracted(self, surface, *arguments, code=0):
        """The report, the skeleton, what was printed."""
        result = run("extract", surface, "-o", "x.json", "--report", "r.json", *arguments,
                     cwd=self.folder)
        self.assertEqual(result.code, code, result.err)
        return (json.loads((self.folder / "r.json").read_text()),
                json.loads((self.folder / "x.json").read_text()), result.out.decode())


class Paper(PresetTest):
    def test_is_the_chain_of_the_paper(self):
        for surface, cycles in ((TORUS, 1), (Y, 0)):
            report, skeleton, printed = self.extracted(surface, "--preset", "paper")
            self.assertIn("preset: paper", printed)
            self.assertIn("certificate", printed)
            parameters = report["parameters"]
            self.assertEqual(parameters["preset"], "paper")
            self.assertEqual(parameters["fair"]["method"], "opencl")
            self.assertEqual(parameters["fair"]["volume"], "offset")
            self.assertEqual(parameters["contraction"]["flow"], "paper")
            self.assertEqual(parameters["contraction"]["max_iterations"], 3)
            self.assertEqual(parameters["surgery"]["method"], "cgal")
            self.assertEqual(parameters["embed"]["method"], "none")
            self.assertEqual(parameters["repair"]["wrap"], "never")
            self.assertFalse(parameters["fair_if_outside"])
            self.assertFalse(parameters["all_vertices_if_failed"])
            stages = [time["stage"] for time in report["times"]]
            self.assertNotIn("balls", stages)
            self.assertEqual([stages.count(name) for name in ("fair", "contract", "surgery")],
                             [1, 1, 1])
            (component,) = report["components"]
            self.assertLess(component["working_vertices"], 1100)
            self.assertLessEqual(len(component["contraction"]), 3)
            self.assertEqual({step["solver"] for step in component["contraction"]}, {"vcl-lsm"})
            self.assertEqual(report["certificate"]["cycle_rank"], cycles)
            self.assertEqual(report["certificate"]["components"], 1)
            self.assertEqual(set(skeleton["node_of_vertex"]), set(range(len(skeleton["nodes"]))))

    def test_prints_a_certificate_that_fails_and_tries_nothing_again(self):
        # Without balls the rings contract to curves that leave them.
        for strict, code in (((), 0), (("--strict",), SOLVER)):
            report, _, printed = self.extracted(LINKED_RINGS, "--preset", "paper", *strict,
                                                code=code)
            self.assertRegex(printed, "length inside.*WRONG")
            self.assertFalse(report["certificate"]["inside_enough"])
            self.assertEqual({one["name"] for one in report["history"]}, {"as asked"})
            stages = [time["stage"] for time in report["times"]]
            self.assertEqual([stages.count(name) for name in ("fair", "contract", "wrap")],
                             [1, 1, 0])

    def test_gives_the_same_bytes_whatever_the_threads(self):
        for threads in (1, 3):
            self.run_ok("extract", Y, "-o", f"{threads}.ply", "--preset", "paper", "--threads",
                        threads, cwd=self.folder)
        self.assertEqual((self.folder / "1.ply").read_bytes(),
                         (self.folder / "3.ply").read_bytes())

    def test_other_options_override_it_wherever_they_stand(self):
        others = ("--flow", "medial", "--solver", "cholesky", "--surgery", "own", "--embed", "own",
                  "--fair", 0, "--resolution", 700, "--wrap", "needed")
        for arguments in (("--preset", "paper", *others), (*others, "--preset", "paper")):
            report, _, _ = self.extracted(Y, *arguments)
            parameters = report["parameters"]
            self.assertEqual(parameters["preset"], "paper")
            self.assertIsNone(parameters["fair"])
            self.assertEqual(parameters["resolution"], 700)
            self.assertEqual(parameters["contraction"]["flow"], "medial")
            self.assertEqual(parameters["contraction"]["solver"], "cholesky")
            self.assertEqual(parameters["contraction"]["max_iterations"], 3)  # the preset's
            self.assertEqual(parameters["surgery"]["method"], "own")
            self.assertEqual(parameters["embed"]["method"], "own")
            self.assertEqual(parameters["repair"]["wrap"], "needed")

    def test_the_default_is_no_preset(self):
        report, skeleton, printed = self.extracted(Y)
        self.assertEqual(report["parameters"]["preset"], "default")
        self.assertNotIn("preset", printed)
        self.assertEqual(self.extracted(Y, "--preset", "default")[1]["nodes"], skeleton["nodes"])


class Surgery(PresetTest):
    def test_by_cgal_with_embedding_or_none(self):
        for surface, cycles in ((TORUS, 1), (Y, 0)):
            for embed in ("own", "none"):
                report, skeleton, _ = self.extracted(surface, "--surgery", "cgal", "--embed", embed)
                self.assertEqual(report["parameters"]["surgery"]["method"], "cgal")
                self.assertEqual(report["parameters"]["embed"]["method"], embed)
                self.assertEqual(report["certificate"]["cycle_rank"], cycles)
                self.assertTrue(all(radius >= 0 for radius in skeleton["radii"]))

    def test_unknown_names_are_usage_errors(self):
        for option, names in (("--preset", ["default", "paper"]), ("--surgery", ["own", "cgal"]),
                              ("--embed", ["own", "none"])):
            self.refused(USAGE, "extract", Y, "-o", "x.obj", option, "nonsense", says=names,
                         cwd=self.folder)


if __name__ == "__main__":
    unittest.main()
