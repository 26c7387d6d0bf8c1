"""Laws of VRM files of people: they keep to the specification's schema, and to its tree of bones."""

import copy
import json
import os
import pathlib
import struct
import tempfile
import unittest
import warnings

import jsonschema

from program import run

COLLECTION = pathlib.Path(os.environ["CURVESKEL_COLLECTION"])
SCHEMA = json.loads((pathlib.Path(__file__).parent / "vrm-1.0.schema.json").read_text())
PEOPLE = ("male", "zombie", "bunny")
META = ("--vrm-name", "A person", "--vrm-author", "Somebody", "--vrm-licence",
        "https://vrm.dev/licenses/1.0/")


def json_of(glb):
    (length,) = struct.unpack("<I", glb[12:16])
    return json.loads(glb[20:20 + length])


def faults_of(figure):
    return [fault.message for fault in jsonschema.Draft7Validator(SCHEMA).iter_errors(figure)]


class Vrm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.figures = {}
        with tempfile.TemporaryDirectory() as folder:
            for person in PEOPLE:
                mesh = COLLECTION / "characters" / f"human-{person}.glb"
                if not mesh.exists():
                    warnings.warn(f"{mesh} is not there, so it is not tested")
                    continue
                file = pathlib.Path(folder) / f"{person}.vrm"
                result = run("rig", mesh, "-o", file, "--pose", "t", *META)
                assert result.code == 0, result.err
                cls.figures[person] = json_of(file.read_bytes())

    def each(self):
        for person, figure in self.figures.items():
            with self.subTest(person):
                yield figure

    def test_keeps_to_the_schema(self):
        for figure in self.each():
            self.assertEqual(faults_of(figure), [])

    def test_the_schema_sees_what_is_wrong(self):
        for figure in self.each():
            for spoil in (lambda vrm: vrm["humanoid"]["humanBones"].pop("hips"),
                          lambda vrm: vrm["meta"].pop("licenseUrl"),
                          lambda vrm: vrm["meta"]["authors"].clear(),
                          lambda vrm: vrm["humanoid"]["humanBones"]["head"].update(node="head"),
                          lambda vrm: vrm.pop("specVersion")):
                spoilt = copy.deepcopy(figure)
                spoil(spoilt["extensions"]["VRMC_vrm"])
                self.assertEqual(len(faults_of(spoilt)), 1)

    def test_bones_hang_as_a_persons_do(self):
        for figure in self.each():
            nodes = figure["nodes"]
            parents = {child: k for k, node in enumerate(nodes) for child in node.get("children", [])}
            bones = {name: bone["node"] for name, bone in
                     figure["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"].items()}
            self.assertEqual(len(set(bones.values())), len(bones))

            def is_below(name, above):
                node = bones[name]
                while node in parents:
                    node = parents[node]
                    if node == bones[above]:
                        return True
                return False

            self.assertTrue(is_below("spine", "hips") and is_below("head", "spine"))
            for side in ("left", "right"):
                for chain in (("hips", "UpperLeg", "LowerLeg", "Foot"),
                              ("spine", "UpperArm", "LowerArm", "Hand")):
                    for above, below in zip(chain, chain[1:]):
                        above = above if above in bones else side + above
                        self.assertTrue(is_below(side + below, above), (side + below, above))


if __name__ == "__main__":
    unittest.main()
