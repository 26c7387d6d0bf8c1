"""Blender opens a rig in the user's own glTF file: all is there, rests where it was, and
moves as our own skinning says. Characters are those of the collection, named by
CURVESKEL_COLLECTION, and of meshes/free. Skipped where there is no Blender (Debian package
blender)."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from in_blender import result_of

SOURCE = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"])
PROGRAM = os.environ["CURVESKEL_PROGRAM"]

# Debian's importer of glTF asks numpy for names that its numpy has no more.
LOOK = """
import json, pathlib, random, sys
import bpy, numpy
numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object

def load(file):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(file))
    for thing in bpy.data.objects:
        thing.animation_data_clear()
        for key in thing.data.shape_keys.key_blocks if (
                thing.type == "MESH" and thing.data.shape_keys) else []:
            key.value = 0
    bpy.context.view_layer.update()

def meshes():
    return sorted((thing for thing in bpy.data.objects
                   if thing.type == "MESH" and thing.users_scene
                   and "Icosphere" not in thing.name), key=lambda thing: thing.name)

def places(thing):
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    found = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
    mesh.vertices.foreach_get("co", found)
    shown.to_mesh_clear()
    frame = numpy.array(shown.matrix_world, dtype=float)
    return found.reshape(-1, 3) @ frame[:3, :3].T + frame[:3, 3]

def looks():
    found = []
    for thing in meshes():
        keys = thing.data.shape_keys
        found.append({
            "vertices": len(thing.data.vertices), "faces": len(thing.data.polygons),
            "materials": [slot.material.name if slot.material else None
                          for slot in thing.material_slots],
            "maps": [layer.name for layer in thing.data.uv_layers],
            "colours": len(thing.data.color_attributes),
            "keys": [block.name for block in keys.key_blocks] if keys else []})
    return sorted(found, key=str)

def bounds(positions):
    joined = numpy.concatenate(positions)
    return joined.min(axis=0), joined.max(axis=0)

def skinned(thing, armature):
    # Sum of weight * pose * inverse rest, of what the armature is given.
    pose = {bone.name: numpy.array(armature.matrix_world @ bone.matrix @
                                   bone.bone.matrix_local.inverted() @
                                   armature.matrix_world.inverted())
            for bone in armature.pose.bones}
    names = {group.index: group.name for group in thing.vertex_groups}
    frame = numpy.array(thing.matrix_world, dtype=float)
    found = []
    for vertex in thing.data.vertices:
        place = frame @ numpy.array([*vertex.co, 1.0])
        row = [(names[group.group], group.weight) for group in vertex.groups
               if group.weight > 0 and names[group.group] in pose]
        found.append(sum(weight * (pose[name] @ place) for name, weight in row)[:3]
                     / sum(weight for _, weight in row))
    return numpy.array(found)

folder = pathlib.Path(sys.argv[-1])
result = {}
for number in range(len(list(folder.glob("*.before.*")))):
    before, = folder.glob(f"{number}.before.*")
    load(before)
    kept = looks()
    shown = bounds([places(thing) for thing in meshes()])
    for thing in bpy.data.objects:  # a new rig rests as the old one was bound
        if thing.type == "ARMATURE":
            thing.data.pose_position = "REST"
    bpy.context.view_layer.update()
    low, high = bounds([places(thing) for thing in meshes()])
    load(folder / f"{number}.after.glb")
    size = numpy.linalg.norm(high - low)
    new_low, new_high = bounds([places(thing) for thing in meshes()])
    if numpy.abs(numpy.array(shown) - [low, high]).max() > 1e-4 * size:
        # It was posed: where in the scene it was bound no one knows, but for its extent.
        new_low, new_high, low, high = 0, new_high - new_low, 0, high - low
    armatures = [thing for thing in bpy.data.objects if thing.type == "ARMATURE"]
    basis = max(numpy.abs(numpy.array(bone.matrix_basis) - numpy.eye(4)).max()
                for bone in armatures[0].pose.bones)
    along = min((bone.tail_local - bone.head_local).normalized().dot(
                    (bone.children[0].head_local - bone.head_local).normalized())
                for bone in armatures[0].data.bones if len(bone.children) == 1)
    random.seed(1)
    for bone in armatures[0].pose.bones:
        bone.rotation_mode = "XYZ"
        bone.rotation_euler = [random.uniform(-0.4, 0.4) for _ in range(3)]
    bpy.context.view_layer.update()
    off, moved = 0, 0
    for thing in meshes():
        posed = places(thing)
        off = max(off, numpy.abs(posed - skinned(thing, armatures[0])).max() / size)
        frame = numpy.array(thing.matrix_world, dtype=float)
        still = numpy.array([frame[:3, :3] @ vertex.co + frame[:3, 3]
                             for vertex in thing.data.vertices])
        moved = max(moved, numpy.abs(posed - still).max() / size)
    result[before.name] = {
        "same looks": looks() == kept, "looks": kept, "armatures": len(armatures),
        "rest": max(numpy.abs(new_low - low).max(), numpy.abs(new_high - high).max()) / size,
        "poses": off, "moved": moved, "basis": basis, "along": along}
(folder / "result.json").write_text(json.dumps(result))
"""


def rigged_files():
    files = sorted((SOURCE / "meshes" / "free" / "rigs").glob("*.glb"))
    if os.environ.get("CURVESKEL_COLLECTION"):
        folder = pathlib.Path(os.environ["CURVESKEL_COLLECTION"]) / "characters"
        files += sorted(folder.glob("*.glb"))
        # Its old armature is scaled by 100, so that joints lay too near each other for Blender.
        files += sorted((folder.parent / "real").glob("quaternius-Swat.glb"))
    return files


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
class RigFiles(unittest.TestCase):
    def test_all_is_there_rests_where_it_was_and_moves_as_we_say(self):
        files = rigged_files()
        self.assertTrue(files)
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            for number, file in enumerate(files):
                shutil.copy(file, folder / f"{number}.before{file.suffix}")
                subprocess.run([PROGRAM, "rig", file, "-o", folder / f"{number}.after.glb", "-q"],
                               check=True, stderr=subprocess.DEVNULL)
            found = result_of(LOOK, folder)
        for number, file in enumerate(files):
            with self.subTest(file.name):
                result = found[f"{number}.before{file.suffix}"]
                self.assertTrue(result["same looks"], result["looks"])
                self.assertEqual(result["armatures"], 1)
                self.assertLess(result["rest"], 1e-4)
                self.assertLess(result["basis"], 1e-4, "its pose at first is no rest")
                self.assertGreater(result["along"], 0.99, "a bone points past its joint")
                self.assertLess(result["poses"], 1e-4)
                self.assertGreater(result["moved"], 0.02)
                print(f"{file.name}: rest {result['rest']:.1e} D, poses {result['poses']:.1e} D")


# The same rig as FBX and as glTF: looks, joints, places at rest and with all bones turned.
FBX = """
import json, pathlib, random, sys
import bpy, numpy
from mathutils import Matrix
numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object

def plain(name):  # the importer of glTF copies a material for meshes with other colours
    return name[:-4] if name[-4:-3] == "." and name[-3:].isdigit() else name

def load(file):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    load_one = (bpy.ops.import_scene.fbx if file.suffix == ".fbx" else
                bpy.ops.import_scene.gltf)
    load_one(filepath=str(file))
    for thing in bpy.data.objects:
        thing.animation_data_clear()
    return next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")

def meshes():
    return [thing for thing in bpy.data.objects if thing.type == "MESH" and thing.vertex_groups]

def looks():
    found = {}
    for thing in meshes():
        keys = thing.data.shape_keys
        names = {group.index: group.name for group in thing.vertex_groups}
        found[thing.data.name] = {
            "vertices": len(thing.data.vertices), "faces": len(thing.data.polygons),
            "materials": [plain(slot.material.name) if slot.material else None
                          for slot in thing.material_slots],
            "maps": len(thing.data.uv_layers), "colours": len(thing.data.color_attributes),
            "keys": [block.name for block in keys.key_blocks] if keys else [],
            "groups": sorted({names[group.group] for vertex in thing.data.vertices
                              for group in vertex.groups if group.weight > 0})}
    return found

def places():
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    found = {}
    for thing in meshes():
        shown = thing.evaluated_get(graph)
        mesh = shown.to_mesh()
        found[thing.data.name] = numpy.array([shown.matrix_world @ vertex.co
                                              for vertex in mesh.vertices])
        shown.to_mesh_clear()
    return found

def bend(armature):
    random.seed(2)
    turns = {name: [random.uniform(-0.4, 0.4) for _ in range(2)]
             for name in sorted(armature.pose.bones.keys())}
    frame = armature.matrix_world
    waiting = [bone for bone in armature.pose.bones if bone.parent is None]
    while waiting:
        bone = waiting.pop(0)
        waiting += list(bone.children)
        head = (frame @ bone.matrix).translation
        turn = (Matrix.Rotation(turns[bone.name][0], 4, "X")
                @ Matrix.Rotation(turns[bone.name][1], 4, "Y"))
        bone.matrix = (frame.inverted() @ Matrix.Translation(head) @ turn
                       @ Matrix.Translation(-head) @ frame @ bone.matrix)
        bpy.context.view_layer.update()

def state(file):
    armature = load(file)
    found = {"looks": looks(), "rest": places(),
             "pictures": {tuple(image.size) for image in bpy.data.images},
             "heads": {bone.name: numpy.array((armature.matrix_world @ bone.matrix).translation)
                       for bone in armature.pose.bones},
             "parents": {bone.name: bone.parent.name if bone.parent else None
                         for bone in armature.data.bones}}
    bend(armature)
    return {**found, "posed": places()}

def apart(a, b):
    return max(float(numpy.abs(a[name] - b[name]).max()) for name in a)

folder = pathlib.Path(sys.argv[-1])
result = {}
for file in sorted(folder.glob("*.glb")):
    gltf, fbx = state(file), state(file.with_suffix(".fbx"))
    size = max(numpy.ptp(places, axis=0).max() for places in gltf["rest"].values())
    same = [gltf[name] == fbx[name] for name in ("looks", "pictures", "parents")]
    result[file.stem] = {"same": same, "looks": str((gltf["looks"], fbx["looks"]))}
    if all(same):
        result[file.stem].update({name: apart(gltf[name], fbx[name]) / size
                                  for name in ("heads", "rest", "posed")})
(folder / "result.json").write_text(json.dumps(result))
"""


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
class Fbx(unittest.TestCase):
    def test_is_what_the_glTF_is(self):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            for source in rigged_files():
                name = folder / source.stem
                subprocess.run([PROGRAM, "rig", source, "-o", f"{name}.glb", "-o", f"{name}.fbx",
                                "-q"], check=True, stderr=subprocess.DEVNULL)
                self.read_by_assimp(f"{name}.fbx", f"{name}.glb")
            found = result_of(FBX, folder)
        self.assert_alike(found)

    def test_of_a_rig_that_is_kept_below_a_node_that_is_turned(self):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            for kept in ("upright", "turned"):
                given = folder / f"{kept}.gltf"
                subprocess.run([PROGRAM, "rig", SOURCE / "meshes" / "y.off", "-o", given, "-q"],
                               check=True, stderr=subprocess.DEVNULL)
                file = json.loads(given.read_text())
                scene = file["scenes"][0]
                file["materials"] = [{"name": "skin"}]
                file["meshes"][0]["primitives"][0]["material"] = 0
                if kept == "turned":
                    file["nodes"].append({"name": "z is up", "children": scene["nodes"],
                                          "rotation": [-0.5 ** 0.5, 0, 0, 0.5 ** 0.5],
                                          "translation": [1, 2, 3]})
                    scene["nodes"] = [len(file["nodes"]) - 1]
                given.write_text(json.dumps(file))
                subprocess.run([PROGRAM, "rig", given, "--keep-rig", "-q", "-o",
                                folder / f"{kept}.glb", "-o", folder / f"{kept}.fbx"],
                               check=True, stderr=subprocess.DEVNULL)
            found = result_of(FBX, folder)
        self.assertEqual(set(found), {"upright", "turned"})
        self.assert_alike(found)

    def assert_alike(self, found):
        self.assertTrue(found)
        for name, result in found.items():
            with self.subTest(name):
                self.assertEqual(result["same"], [True, True, True], result["looks"])
                for what in ("heads", "rest", "posed"):
                    self.assertLess(result[what], 1e-5, what)

    def read_by_assimp(self, fbx, glb):
        """The library of Debian's package assimp-utils, if it is there, finds all in both."""
        if not shutil.which("assimp"):
            return
        counts = []
        for file in (fbx, glb):
            said = subprocess.run(["assimp", "info", file], capture_output=True, text=True,
                                  check=True).stdout
            lines = dict(line.split(":", 1) for line in said.splitlines() if line.count(":") == 1)
            counts.append([int(lines[name]) for name in ("Faces", "Bones")])
        self.assertEqual(counts[0][0], counts[1][0])
        self.assertGreaterEqual(counts[0][1], counts[1][1])  # a mesh a material, with all joints


# Blender's own FBX or COLLADA of the characters, to be rigged.
EXPORT = """
import json, pathlib, sys
import bpy, numpy
numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object

folder = pathlib.Path(sys.argv[-1])
for file in sorted(folder.glob("*/before.glb")):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(file))
    for thing in [*bpy.data.objects]:
        thing.animation_data_clear()
        if thing.type == "ARMATURE":
            thing.data.pose_position = "REST"
        elif "Icosphere" in thing.name:  # what bones look like
            bpy.data.objects.remove(thing)
    written = file.with_name((folder / "name").read_text())
    if written.suffix == ".fbx":
        bpy.ops.export_scene.fbx(filepath=str(written), path_mode="COPY", embed_textures=True,
                                 bake_anim=False, add_leaf_bones=False)
    else:
        # Of skins it writes the mesh as if its armature were not turned or scaled.
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.make_single_user(object=True, obdata=True)
        bpy.ops.object.transform_apply(location=False, rotation=True, scale=True)
        bpy.ops.wm.collada_export(filepath=str(written), use_texture_copies=True,
                                  include_animations=False)
(folder / "result.json").write_text(json.dumps({}))
"""

COMPARE = """
import json, pathlib, sys
import bpy, numpy
numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object

def look(file):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    {".fbx": bpy.ops.import_scene.fbx, ".dae": bpy.ops.wm.collada_import,
     ".glb": bpy.ops.import_scene.gltf}[file.suffix](filepath=str(file))
    for thing in bpy.data.objects:
        thing.animation_data_clear()
    for thing in bpy.data.objects:
        if thing.type == "ARMATURE":
            thing.data.pose_position = "REST"
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    found = {"keys": set(), "pictures": {tuple(image.size) for image in bpy.data.images
                                         if image.size[0] > 0}}
    corners = []
    for thing in bpy.data.objects:
        if thing.type != "MESH" or "Icosphere" in thing.name:
            continue
        names = [slot.material.name for slot in thing.material_slots]
        if thing.data.shape_keys:
            found["keys"] |= {block.name for block in thing.data.shape_keys.key_blocks[1:]}
        shown = thing.evaluated_get(graph)
        mesh = shown.to_mesh()
        places = [thing.matrix_world @ vertex.co for vertex in mesh.vertices]
        maps = mesh.uv_layers[0].data if mesh.uv_layers else None
        for face in mesh.polygons:
            material = names[face.material_index] if names else ""
            for loop in face.loop_indices:
                uv = maps[loop].uv if maps else (0, 0)
                corners.append((material, *places[mesh.loops[loop].vertex_index], *uv))
        shown.to_mesh_clear()
    size = max(numpy.ptp([corner[1 + k] for corner in corners]) for k in range(3))
    rounded = [(corner[0], *(round(2000 * x / size) for x in corner[1:4]),
                *(round(500 * x) for x in corner[4:])) for corner in corners]
    return found, size, sorted(rounded)

folder = pathlib.Path(sys.argv[-1])
result = {}
for file in sorted(folder.glob("*/" + (folder / "name").read_text())):
    wanted, size, corners = look(file)
    found, new_size, new_corners = look(file.with_name("rigged.glb"))
    near = sum(numpy.abs(numpy.array(a[1:]) - b[1:]).max() <= 1 and a[0] == b[0]
               for a, b in zip(corners, new_corners))
    result[file.parent.name] = {
        "same": [found[name] == wanted[name] for name in ("keys", "pictures")],
        "said": str((wanted, found)), "size": new_size / size,
        "corners": [len(corners), len(new_corners)], "alike": near / max(len(corners), 1)}
(folder / "result.json").write_text(json.dumps(result))
"""


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
class FilesOfBlender(unittest.TestCase):
    def test_keep_their_look_and_their_size(self):
        for name in ("before.fbx", "before.dae"):
            with tempfile.TemporaryDirectory() as place:
                folder = pathlib.Path(place)
                (folder / "name").write_text(name)
                for source in rigged_files():
                    (folder / source.stem).mkdir()
                    shutil.copy(source, folder / source.stem / "before.glb")
                result_of(EXPORT, folder)
                for file in folder.glob("*/" + name):
                    subprocess.run([PROGRAM, "rig", file, "-o", file.with_name("rigged.glb"), "-q"],
                                   check=True, stderr=subprocess.DEVNULL)
                found = result_of(COMPARE, folder)
            self.assertTrue(found)
            for character, result in found.items():
                with self.subTest(f"{character}, {name}"):
                    self.assertEqual(result["same"], [True, True], result["said"])
                    self.assertAlmostEqual(result["size"], 1, places=4)
                    self.assertEqual(*result["corners"])
                    # Some of rounded numbers go the other way, and the order with them.
                    self.assertGreater(result["alike"], 0.95)


if __name__ == "__main__":
    unittest.main()
