"""Blender's own meshes of quads come out of rig as FBX with their objects, vertices, faces, materials,
texture coordinates and shape keys, in their order; objects of OBJ stay apart in glTF, too. Skipped
where there is no Blender (Debian package blender)."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from in_blender import result_of

PROGRAM = os.environ["CURVESKEL_PROGRAM"]

START = """
import json, pathlib, sys
import bpy, numpy
numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object
folder = pathlib.Path(sys.argv[-1])
"""

MAKE = START + """
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_monkey_add(location=(0, 0, 1))
head = bpy.context.object
head.shape_key_add(name="Basis")
wide = head.shape_key_add(name="wide ears")
for number, vertex in enumerate(head.data.vertices):
    if abs(vertex.co.x) > 0.9:
        wide.data[number].co.x *= 1.2
for name in ("fur", "skin"):
    head.data.materials.append(bpy.data.materials.new(name))
for face in head.data.polygons:
    face.material_index = face.index % 3 % 2
bpy.ops.mesh.primitive_cube_add(location=(0, 0, -1))
bpy.ops.export_scene.fbx(filepath=str(folder / "given.fbx"))
bpy.ops.wm.obj_export(filepath=str(folder / "given.obj"))
bpy.ops.wm.collada_export(filepath=str(folder / "given.dae"))
(folder / "result.json").write_text("{}")
"""

READ = START + """
def load(file):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    {".fbx": bpy.ops.import_scene.fbx, ".dae": bpy.ops.wm.collada_import,
     ".obj": bpy.ops.wm.obj_import, ".glb": bpy.ops.import_scene.gltf}[file.suffix](
        filepath=str(file))

def state(thing):
    mesh = thing.data
    frame = numpy.array(thing.matrix_world)
    placed = lambda points: [list(frame[:3, :3] @ numpy.array(point.co) + frame[:3, 3])
                             for point in points]
    keys = mesh.shape_keys.key_blocks if mesh.shape_keys else []
    return {"faces": [list(face.vertices) for face in mesh.polygons],
            "materials": [mesh.materials[face.material_index].name
                          if mesh.materials and mesh.materials[0] else None
                          for face in mesh.polygons],
            "keys": [key.name for key in keys],
            "numbers": [placed(mesh.vertices), *(placed(key.data) for key in keys)],
            "maps": [[list(corner.uv) for corner in layer.data] for layer in mesh.uv_layers]}

found = {}
for file in folder.iterdir():
    if file.suffix in (".fbx", ".dae", ".obj", ".glb"):
        load(file)
        found[file.name] = {thing.name: state(thing) for thing in bpy.data.objects
                            if thing.type == "MESH" and "Icosphere" not in thing.name}
(folder / "result.json").write_text(json.dumps(found))
"""


def farthest(a, b):
    """Of lists of numbers in lists; infinity where they have other shapes."""
    if isinstance(a, list):
        return (max((farthest(*pair) for pair in zip(a, b)), default=0) if len(a) == len(b)
                else float("inf"))
    return abs(a - b)


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
class Polygons(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            result_of(MAKE, folder)
            for name in ("fbx", "obj", "dae"):
                subprocess.run([PROGRAM, "rig", folder / f"given.{name}", "-q",
                                "-o", folder / f"{name}.fbx", "-o", folder / f"{name}.glb"],
                               check=True, stderr=subprocess.DEVNULL)
            cls.found = result_of(READ, folder)

    def test_of_fbx_are_those_of_the_file(self):
        for name in ("fbx", "obj", "dae"):
            given, written = self.found[f"given.{name}"], self.found[f"{name}.fbx"]
            self.assertEqual(set(written), {"Cube", "Suzanne"})
            for thing, state in given.items():
                with self.subTest(f"{thing} of {name}"):
                    for what in ("faces", "materials", "keys"):
                        self.assertEqual(written[thing][what], state[what], what)
                    for what in ("numbers", "maps"):
                        self.assertLess(farthest(written[thing][what], state[what]), 1e-5, what)
        self.assertTrue(any(len(face) == 4 for face in self.found["fbx.fbx"]["Suzanne"]["faces"]))

    def test_objects_stay_apart_in_gltf(self):
        for name in ("fbx", "obj", "dae"):
            self.assertEqual(set(self.found[f"{name}.glb"]), {"Cube", "Suzanne"})


if __name__ == "__main__":
    unittest.main()
