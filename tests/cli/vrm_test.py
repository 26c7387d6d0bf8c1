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


class KeptRig(unittest.TestCase):
    """Joints of somebody else's make a VRM, and a VRM stays itself."""

    def setUp(self):
        self.mesh = COLLECTION / "characters" / "human-male.glb"
        if not self.mesh.exists():
            self.skipTest(f"{self.mesh} is not there")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def kept(self, mesh, output, *options):
        result = run("rig", mesh, "--keep-rig", "-o", self.folder / output, *options)
        self.assertEqual(result.code, 0, result.err)
        return json_of((self.folder / output).read_bytes())

    def test_names_of_joints_say_their_roles(self):
        figure = self.kept(self.mesh, "a.vrm", *META, "--report", self.folder / "a.json")
        self.assertEqual(faults_of(figure), [])
        bones = figure["extensions"]["VRMC_vrm"]["humanoid"]["humanBones"]
        names = {role: figure["nodes"][bone["node"]]["name"] for role, bone in bones.items()}
        self.assertEqual((names["hips"], names["leftLowerArm"], names["rightToes"]),
                         ("pelvis", "lowerarm_l", "ball_r"))
        roles = json.loads((self.folder / "a.json").read_text())["roles"]
        self.assertEqual({role: entry["joint"] for role, entry in roles.items()}, names)

    def test_what_a_vrm_says_need_not_be_said_again(self):
        before = self.kept(self.mesh, "a.vrm", *META)["extensions"]
        self.assertEqual(self.kept(self.folder / "a.vrm", "b.vrm")["extensions"], before)
        before["VRMC_vrm"]["meta"]["name"] = "B"
        named = self.kept(self.folder / "a.vrm", "c.vrm", "--vrm-name", "B")
        self.assertEqual(named["extensions"], before)

    def test_a_vrm_0_file_keeps_its_own_texts(self):
        result = run("rig", self.mesh, "--keep-rig", "-o", self.folder / "a.gltf")
        self.assertEqual(result.code, 0, result.err)
        figure = json.loads((self.folder / "a.gltf").read_text())
        number = {node.get("name"): k for k, node in enumerate(figure["nodes"])}
        old = {"VRM": {"humanoid": {"humanBones": [{"bone": "hips", "node": number["pelvis"]}]},
                       "meta": {"title": "A"}}}
        (self.folder / "old.vrm").write_text(json.dumps({**figure, "extensions": old}))
        self.assertEqual(self.kept(self.folder / "old.vrm", "new.vrm")["extensions"], old)
        result = run("rig", self.folder / "old.vrm", "--keep-rig", "-o", self.folder / "x.vrm",
                     "--vrm-name", "B")
        self.assertEqual(result.code, 2)
        self.assertIn("VRM 0.x", result.err)


if __name__ == "__main__":
    unittest.main()
