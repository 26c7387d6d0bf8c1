"""Rigs as Blender opens them; skipped where there is no Blender (Debian package blender)."""

import json
import os
import shutil
import subprocess
import unittest

from program import LINKED_RINGS, Y, CommandLineTest

# Debian's importer of glTF asks numpy for names that its numpy has no more.
LOOK = """
import json, sys
import bpy, numpy
numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=sys.argv[-2])
found = {"armatures": [], "meshes": []}
for thing in bpy.data.objects:
    if thing.type == "ARMATURE":
        found["armatures"].append({
            "bones": [bone.name for bone in thing.data.bones],
            "roots": [bone.name for bone in thing.data.bones if bone.parent is None],
            "turns": [(bone.tail_local - bone.head_local).angle(
                bone.children[0].head_local - bone.head_local)
                      for bone in thing.data.bones if len(bone.children) == 1],
            "shortest": min(bone.length for bone in thing.data.bones)})
    elif any(modifier.type == "ARMATURE" for modifier in thing.modifiers):
        mesh = thing.data
        found["meshes"].append({
            "vertices": [list(thing.matrix_world @ vertex.co) for vertex in mesh.vertices],
            "faces": len(mesh.polygons),
            "groups": [group.name for group in thing.vertex_groups],
            "weights": [[group.weight for group in vertex.groups] for vertex in mesh.vertices]})
json.dump(found, open(sys.argv[-1], "w"))
"""


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
class Blender(CommandLineTest):
    def opened(self, mesh, name):
        self.run_ok("rig", mesh, "-o", name, cwd=self.folder)
        script = self.folder / "look.py"
        script.write_text(LOOK)
        found = self.folder / "found.json"
        # Blender takes the first python3 in the path for its own.
        environment = {**os.environ, "PATH": "/usr/local/bin:/usr/bin:/bin"}
        subprocess.run([shutil.which("blender"), "--background", "--python-exit-code", "1",
                        "--python", script,
                        "--", self.folder / name, found],
                       check=True, capture_output=True, stdin=subprocess.DEVNULL,
                       env=environment)
        return json.loads(found.read_text())

    def test_opens_one_armature_that_moves_every_vertex(self):
        for mesh, name in ((Y, "rig.glb"), (LINKED_RINGS, "rig.gltf")):
            with self.subTest(mesh.name):
                self.check(mesh, self.opened(mesh, name))

    def check(self, mesh, found):
        self.assertEqual(len(found["armatures"]), 1)
        self.assertEqual(len(found["meshes"]), 1)
        bones, skin = found["armatures"][0], found["meshes"][0]
        self.assertEqual(bones["roots"], ["root"])
        self.assertGreater(bones["shortest"], 0)
        self.assertLess(max(bones["turns"]), 0.01)  # bones lie along their limbs
        self.assertEqual(sorted(bones["bones"]), sorted(skin["groups"]))
        lines = mesh.read_text().split("\n")
        counts = [int(number) for number in lines[1].split()[:2]]
        self.assertEqual([len(skin["vertices"]), skin["faces"]], counts)
        for line, place in zip(lines[2:], skin["vertices"]):
            x, y, z = map(float, line.split())
            for wanted, coordinate in zip((x, -z, y), place):  # Blender's z is up
                self.assertAlmostEqual(wanted, coordinate, delta=1e-4)
        for weights in skin["weights"]:
            moving = [weight for weight in weights if weight > 0]
            self.assertTrue(1 <= len(moving) <= 4)
            self.assertAlmostEqual(sum(moving), 1, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
