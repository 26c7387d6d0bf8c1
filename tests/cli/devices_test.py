"""curveskel devices."""

import unittest

from program import CommandLineTest, run


class Devices(CommandLineTest):
    def test_lists_some_or_says_how_to_get_one(self):
        result = run("devices")
        if result.code == 0:
            self.assertIn("double precision", result.out.decode())
            self.assertRegex(result.out.decode(), "fair, single +opencl, opencl-transfer")
            self.assertRegex(result.out.decode(), "solvers +(vcl-qr, vcl-lsm, cg|none)")
        else:
            self.assertEqual(result.code, 4)
            self.assertIn("install", result.err)


if __name__ == "__main__":
    unittest.main()
