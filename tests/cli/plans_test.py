"""The plan of a body is the same however the file has it stand, with y up or z, ahead or back."""

import json
import os
import pathlib
import unittest

from program import CommandLineTest

MESHES = pathlib.Path(os.environ["CURVESKEL_COLLECTION"])
# The axes to which x, y and z of a body go: about its up, and to z up.
TURNS = (("x", "y", "z"), ("-x", "y", "-z"), ("z", "y", "-x"), ("x", "-z", "y"), ("-x", "z", "y"))


def turned(line, turn):
    """A vertex of OBJ or OFF."""
    words = line.split()
    first = 1 if words[:1] == ["v"] else 0
    place = dict(zip("xyz", map(float, words[first:first + 3])))
    return " ".join(words[:first] + [repr((-1 if axis[0] == "-" else 1) * place[axis[-1]])
                                     for axis in turn])


def is_vertex(name, number, line):
    if name.endswith(".obj"):
        return line.startswith("v ")
    return number > 0 and len(line.split()) == 3 and "." in line


class Plans(CommandLineTest):
    def plan_of(self, name, turn):
        lines = (MESHES / name).read_text().splitlines()
        changed = [turned(line, turn) if is_vertex(name, number, line) else line
                   for number, line in enumerate(lines)]
        self.assertNotEqual(sum(one != other for one, other in zip(lines, changed)), 0)
        (self.folder / name).write_text("\n".join(changed) + "\n")
        self.run_ok("rig", name, "-o", "x.glb", "--report", "x.json", "-q", cwd=self.folder)
        report = json.loads((self.folder / "x.json").read_text())
        # The input's axes, as a turn has them.
        back = [[0.0, 0.0, 0.0] for _ in range(2)]
        for k, key in enumerate(("up", "front")):
            for to, axis in enumerate(turn):
                sign = -1 if axis[0] == "-" else 1
                back[k]["xyz".index(axis[-1])] = sign * report[key][to] + 0.0
        return report["plan"], back[0], back[1]

    def test_do_not_hang_on_the_axes_of_the_file(self):
        for name, plan in (("spot-3k.obj", "quadruped"), ("cheburashka-7k.off", "humanoid")):
            usual = self.plan_of(name, TURNS[0])
            self.assertEqual(usual[0], plan)
            for turn in TURNS[1:]:
                with self.subTest(name=name, turn=turn):
                    self.assertEqual(self.plan_of(name, turn), usual)

    def test_boots_of_boxes_point_ahead(self):
        """With vertices at the toes alone, whatever is nearest to these was taken for the shin."""
        self.run_ok("rig", MESHES / "real" / "starter-ki-character.glb", "-o", "x.glb", "--report",
                    "x.json", "-q", cwd=self.folder)
        report = json.loads((self.folder / "x.json").read_text())
        self.assertEqual(report["plan"], "humanoid")
        self.assertEqual(report["front"], [0, 0, 1])


if __name__ == "__main__":
    unittest.main()
