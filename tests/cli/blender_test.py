"""Rigs as Blender opens them, glTF as it imports it; skipped where there is no Blender (Debian
package blender)."""

import array
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import unittest

from program import LINKED_RINGS, MESHES, Y, CommandLineTest

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

# The corners of all triangles that each scene shows, object by object.
IMPORT = """
import json, pathlib, sys
import bpy, numpy
numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object
for source in pathlib.Path(sys.argv[-1]).glob("*.gl*"):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(source))
    graph = bpy.context.evaluated_depsgraph_get()
    found = []
    for thing in bpy.data.objects:
        if thing.type != "MESH" or not thing.users_scene:
            continue
        shown = thing.evaluated_get(graph)
        mesh = shown.to_mesh()
        places = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
        mesh.vertices.foreach_get("co", places)
        frame = numpy.array(shown.matrix_world, dtype=float)
        places = places.reshape(-1, 3).astype(float) @ frame[:3, :3].T + frame[:3, 3]
        corners = numpy.empty(len(mesh.loops), dtype=numpy.int32)
        mesh.loops.foreach_get("vertex_index", corners)
        places = places[corners][:, [0, 2, 1]] * [1, 1, -1]  # Blender's z is up
        found.append(places.reshape(-1, 9).tolist())
    source.with_suffix(".json").write_text(json.dumps(found))
"""


def blender(script, folder, *arguments):
    (folder / "script.py").write_text(script)
    # Blender takes the first python3 in the path for its own.
    environment = {**os.environ, "PATH": "/usr/local/bin:/usr/bin:/bin"}
    subprocess.run([shutil.which("blender"), "--background", "--python-exit-code", "1",
                    "--python", folder / "script.py", "--", *arguments],
                   check=True, capture_output=True, stdin=subprocess.DEVNULL, env=environment)


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
class Blender(CommandLineTest):
    def opened(self, mesh, name):
        self.run_ok("rig", mesh, "-o", name, cwd=self.folder)
        found = self.folder / "found.json"
        blender(LOOK, self.folder, self.folder / name, found)
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


def gltf_files():
    """All of meshes/free and, where CURVESKEL_COLLECTION names one, of the collection; none that
    Debian's Blender lacks a library for."""
    folders = [MESHES / "free"]
    if os.environ.get("CURVESKEL_COLLECTION"):
        folders.append(pathlib.Path(os.environ["CURVESKEL_COLLECTION"]))
    return [file for folder in folders for file in sorted(folder.rglob("*.gl*"))
            if file.suffix in (".glb", ".gltf") and file.parent.name != "defects"
            and "KHR_draco_mesh_compression" not in at_rest(file)[0].get("extensionsUsed", [])]


def at_rest(file):
    """The JSON without its animations, of which Blender shows the first moment, and without its
    pictures; and the rest of the file."""
    data = file.read_bytes()
    text, rest = data, b""
    if data[:4] == b"glTF":
        (length,) = struct.unpack_from("<I", data, 12)
        text, rest = data[20:20 + length], data[20 + length:]
    scene = json.loads(text)
    for name in ("animations", "images", "textures", "materials"):
        scene.pop(name, None)
    for mesh in scene.get("meshes", []):
        for primitive in mesh["primitives"]:
            primitive.pop("material", None)
    return scene, rest


def triangle_counts(scene):
    """Of the shown nodes with meshes, in the order of the scene."""
    def of_primitive(primitive):
        accessor = primitive.get("indices", primitive["attributes"]["POSITION"])
        count = scene["accessors"][accessor]["count"]
        return count // 3 if primitive.get("mode", 4) == 4 else count - 2

    counts = []
    open_nodes = list(reversed(scene["scenes"][scene.get("scene", 0)]["nodes"]))
    while open_nodes:
        node = scene["nodes"][open_nodes.pop()]
        if "mesh" in node:
            counts.append(sum(of_primitive(primitive) for primitive
                              in scene["meshes"][node["mesh"]]["primitives"]
                              if primitive.get("mode", 4) >= 4))
        open_nodes += reversed(node.get("children", []))
    return counts


def largest_distance(ours, theirs, tolerance):
    """Over the corners of their triangles, which are ours in our order; Blender leaves out those
    without area and copies. None: they are not ours."""
    largest, k = 0, 0
    for triangle in theirs:
        while k < len(ours):
            distance = max(math.dist(ours[k][i:i + 3], triangle[i:i + 3]) for i in (0, 3, 6))
            k += 1
            if distance <= tolerance:
                largest = max(largest, distance)
                break
        else:
            return None
    return largest


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
class Import(CommandLineTest):
    def ours(self, file):
        """Our triangles as nine coordinates each, in the file's order."""
        self.run_ok("fair", file, "-o", "ours.off", "--iterations", "0", "-q", cwd=self.folder)
        words = (self.folder / "ours.off").read_text().split("\n")
        lines = [line for line in words[1:] if line and not line.startswith("#")]
        vertices, faces = map(int, lines[0].split()[:2])
        places = [array.array("d", map(float, line.split()))
                  for line in lines[1:1 + vertices]]
        return [sum((places[int(v)] for v in line.split()[1:4]), array.array("d"))
                for line in lines[1 + vertices:1 + vertices + faces]]

    def test_shows_every_vertex_where_we_read_it(self):
        files = gltf_files()
        self.assertTrue(files)
        stage = self.folder / "stage"
        stage.mkdir()
        for number, file in enumerate(files):
            scene, rest = at_rest(file)
            for buffer in scene.get("buffers", []):
                if not buffer.get("uri", "data:").startswith("data:"):
                    shutil.copy(file.parent / buffer["uri"], stage)
            text = json.dumps(scene).encode()
            text += b" " * (-len(text) % 4)
            if rest:
                text = (b"glTF" + struct.pack("<III", 2, 20 + len(text) + len(rest), len(text))
                        + b"JSON" + text + rest)
            (stage / f"{number}{file.suffix}").write_bytes(text)
        blender(IMPORT, self.folder, stage)
        for number, file in enumerate(files):
            with self.subTest(file.name):
                self.compare(file, json.loads((stage / f"{number}.json").read_text()))

    def compare(self, file, objects):
        ours = self.ours(file)
        axes = [[triangle[i] for triangle in ours for i in range(axis, 9, 3)] for axis in range(3)]
        diagonal = math.dist([min(axis) for axis in axes], [max(axis) for axis in axes])
        scene = at_rest(file)[0]
        begin, seen, largest = 0, 0, 0
        for count in triangle_counts(scene):
            block = ours[begin:begin + count]
            begin += count
            found = [(distance, k) for k, theirs in enumerate(objects)
                     if 0.8 * count <= len(theirs) <= count and
                     (distance := largest_distance(block, theirs, 1e-4 * diagonal)) is not None]
            self.assertTrue(found, f"{count} triangles that Blender has elsewhere")
            objects.pop(min(found)[1])
            largest = max(largest, min(found)[0])
            seen += 1
        self.assertEqual(begin, len(ours))
        self.assertGreater(seen, 0)
        print(f"{file.name}: {seen} meshes, at most {largest / diagonal:.1e} D away")


if __name__ == "__main__":
    unittest.main()
