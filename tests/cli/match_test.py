"""curveskel match."""

import unittest

from program import TORUS, Y, CommandLineTest


class Match(CommandLineTest):
    def test_says_of_how_many_branches_each_has_it_makes_pairs(self):
        result = self.run_ok("match", Y, TORUS, "-o", "m.json", cwd=self.folder)
        self.assertRegex(result.out.decode(),
                         r"^y\.off: 3 branches; torus\.off: 1 branch; \d pairs?, \d ambiguous\n")
        result = self.run_ok("match", Y, Y, "-o", "m.json", cwd=self.folder)
        self.assertIn("3 branches; y.off: 3 branches; 3 pairs, ", result.out.decode())
        self.assertIn("\n1 pair of junctions, ", result.out.decode())


if __name__ == "__main__":
    unittest.main()
