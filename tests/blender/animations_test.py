"""Animated characters whose rig is kept move in Blender as before: glTF that becomes FBX, and FBX
and COLLADA, as Blender writes them, that become glTF. Characters are the collection's, named by
CURVESKEL_COLLECTION. Skipped without it or Blender (Debian package blender)."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from in_blender import result_of

PROGRAM = os.environ["CURVESKEL_PROGRAM"]
COLLECTION = os.environ.get("CURVESKEL_COLLECTION")

LOAD = """
def load(file):
    open_scene(file)
    armature = next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")
    # glTF has a track for each clip, of which one is also the action.
    for track in [*armature.animation_data.nla_tracks]:
        armature.animation_data.nla_tracks.remove(track)
    return armature
"""

MOVES = LOAD + """
def places(seconds):
    scene = bpy.context.scene
    frame = seconds * scene.render.fps / scene.render.fps_base
    scene.frame_set(int(frame), subframe=frame - int(frame))
    graph = bpy.context.evaluated_depsgraph_get()
    rows = []
    for thing in sorted(bpy.data.objects, key=lambda thing: thing.name):
        if thing.type != "MESH" or not thing.vertex_groups:
            continue
        shown = thing.evaluated_get(graph)
        mesh = shown.to_mesh()
        rows += [shown.matrix_world @ vertex.co for vertex in mesh.vertices]
        shown.to_mesh_clear()
    return numpy.array(rows)

folder = pathlib.Path(sys.argv[-1])
result = {}
for file in sorted(folder.glob("*.glb")):
    seconds = [k / 48 for k in range(4, 29)]  # keys of the files, and halfway between them
    found = {}
    for one in (file, file.with_suffix(".fbx")):
        clip = load(one).animation_data.action.name
        found[one.suffix] = (clip, len(bpy.data.actions), [places(moment) for moment in seconds])
    (clip, clips, gltf), (other, others, fbx) = found[".glb"], found[".fbx"]
    size = numpy.ptp(gltf[0], axis=0).max()
    apart = [float(numpy.abs(a - b).max()) / size for a, b in zip(gltf, fbx)]
    result[file.stem] = {
        "clips": [clips, others], "names": [clip, other],
        "at keys": max(apart[::2]), "between": max(apart[1::2]),
        "moved": max(float(numpy.abs(a - gltf[0]).max()) for a in gltf) / size}
(folder / "result.json").write_text(json.dumps(result))
"""

EXPORTS = """
folder = pathlib.Path(sys.argv[-1])
for file in sorted(folder.glob("*.glb")):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(file))
    name = str(file.with_suffix(""))
    bpy.ops.export_scene.fbx(filepath=name + ".fbx", add_leaf_bones=False,
                             bake_anim_simplify_factor=0)
    bpy.ops.wm.collada_export(filepath=name + ".dae")
(folder / "result.json").write_text(json.dumps({}))
"""

JOINTS = LOAD + """
def frames(armature, clip, keys):
    # Blender leaves bones that a clip does not move where the clip before has left them.
    armature.animation_data.action = None
    for bone in armature.pose.bones:
        bone.matrix_basis.identity()
    armature.animation_data.action = clip
    rows = []
    for key in keys:
        bpy.context.scene.frame_set(key)
        shown = armature.evaluated_get(bpy.context.evaluated_depsgraph_get())
        rows.append({bone.name: numpy.array(shown.matrix_world @ bone.matrix)
                     for bone in shown.pose.bones})
    return rows

def moves(rows):
    names = sorted(rows[0])
    return numpy.array([[row[name] @ numpy.linalg.inv(rows[0][name]) for name in names]
                        for row in rows])

folder = pathlib.Path(sys.argv[-1])
result = {}
for file in sorted([*folder.glob("*.fbx"), *folder.glob("*.dae")]):
    keys = range(1, 20, 3)
    armature = load(file)
    clips = {clip.name.split("|")[-1]: frames(armature, clip, keys) for clip in bpy.data.actions}
    armature = load(file.with_suffix(file.suffix + ".glb"))
    for clip, given in clips.items():
        alike = [one for one in bpy.data.actions if clip in one.name or file.suffix == ".dae"]
        found = frames(armature, min(alike, key=lambda one: len(one.name)), keys)
        places = [numpy.array([row[name][:3, 3] for name in sorted(row)]) for row in given]
        size = numpy.ptp(places[0], axis=0).max()
        before, now = moves(given), moves(found)
        before[..., :3, 3] /= size
        now[..., :3, 3] /= size
        result[f"{file.name} {clip}"] = {
            "apart": float(numpy.abs(before - now).max()),
            "moved": float(max(numpy.abs(row - places[0]).max() for row in places)) / size}
(folder / "result.json").write_text(json.dumps(result))
"""


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
@unittest.skipUnless(COLLECTION, "needs the animated characters of the collection")
class Animations(unittest.TestCase):
    def test_move_as_those_of_gltf(self):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            for source in sorted((pathlib.Path(COLLECTION) / "clips").glob("*.glb")):
                name = folder / source.stem
                subprocess.run([PROGRAM, "rig", source, "--keep-rig", "-q", "-o", f"{name}.glb",
                                "-o", f"{name}.fbx"], check=True, stderr=subprocess.DEVNULL)
            found = result_of(MOVES, folder)
        self.assertTrue(found)
        for name, result in found.items():
            with self.subTest(name):
                print(f"{name}: {result}")
                self.assertEqual(*result["clips"])
                self.assertGreater(result["moved"], 0.005)
                self.assertLess(result["at keys"], 1e-4)
                # There Blender blends the numbers of glTF's turns, and the angles of FBX's.
                self.assertLess(result["between"], 1e-3)

    def test_of_fbx_and_collada_go_into_gltf(self):
        clips = pathlib.Path(COLLECTION) / "clips"
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            for name in ("fox-animations.glb", "human-sample.glb"):
                shutil.copy(clips / name, folder)
            result_of(EXPORTS, folder)
            for source in [*folder.glob("*.fbx"), *folder.glob("*.dae")]:
                subprocess.run([PROGRAM, "rig", source, "--keep-rig", "-q", "-o", f"{source}.glb"],
                               check=True, stderr=subprocess.DEVNULL)
            found = result_of(JOINTS, folder)
        self.assertEqual(len(found), 14 + 1 + 2)  # Blender's COLLADA has one clip of each file
        self.assertGreater(max(result["moved"] for result in found.values()), 0.5)
        for name, result in found.items():
            with self.subTest(name):
                print(f"{name}: {result}")
                self.assertLess(result["apart"], 1e-4)


if __name__ == "__main__":
    unittest.main()
