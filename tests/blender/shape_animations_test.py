"""Shape keys that move in an FBX file, as Blender writes it, move so in what `rig` makes of it, with
the file's own joints and with new ones. Skipped without Blender (Debian package blender)."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from in_blender import result_of

PROGRAM = os.environ["CURVESKEL_PROGRAM"]

FACE = """
def keyed(owner, path, keys):
    for frame, value in keys:
        setattr(owner, path, value)
        owner.keyframe_insert(path, frame=frame)

folder = pathlib.Path(sys.argv[-1])
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=16, location=(0, 0, 1.5))
face = bpy.context.object
face.scale = (1, 1, 1.5)
bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
face.shape_key_add(name="Basis")
jaw, wide, still = (face.shape_key_add(name=name) for name in ("jaw", "wide", "still"))
for number, vertex in enumerate(face.data.vertices):
    x, y, z = vertex.co
    if y < 0 and z < 1.5:
        jaw.data[number].co = (x, y - 0.5, z - 0.3)
    if abs(x) > 0.5:
        wide.data[number].co = (1.5 * x, y, z)
    if z > 2.5:
        still.data[number].co = (x, y, z + 0.5)
still.value = 0.4
keyed(jaw, "value", ((1, 0), (11, 1), (21, 0.3), (31, 0.8)))
keyed(wide, "value", ((5, 0.2), (25, 0.9)))
bpy.ops.object.armature_add()
armature = bpy.context.object
bpy.ops.object.mode_set(mode="EDIT")
neck = armature.data.edit_bones[0]
neck.tail = (0, 0, 1.5)
head = armature.data.edit_bones.new("head")
head.head, head.tail, head.parent = (0, 0, 1.5), (0, 0, 3), neck
bpy.ops.object.mode_set(mode="OBJECT")
face.select_set(True)
bpy.ops.object.parent_set(type="ARMATURE_AUTO")
head = armature.pose.bones["head"]
head.rotation_mode = "XYZ"
keyed(head, "rotation_euler", ((1, (0, 0, 0)), (16, (0.5, 0, 0)), (31, (0, 0, 0))))
bpy.context.scene.frame_end = 31
bpy.ops.export_scene.fbx(filepath=str(folder / "face.fbx"), add_leaf_bones=False,
                         bake_anim_simplify_factor=0)
(folder / "result.json").write_text(json.dumps({}))
"""

VALUES = """
def load(file):
    open_scene(file)
    return next(thing for thing in bpy.data.objects
                if thing.type == "MESH" and thing.data.shape_keys).data.shape_keys

def only(owner, clip):
    # The clip's action alone; glTF has a track for each clip, of which one is also the action.
    for track in [*owner.animation_data.nla_tracks]:
        owner.animation_data.nla_tracks.remove(track)
    owner.animation_data.action = clip

def clips(keys):
    return {clip.name: clip for clip in bpy.data.actions
            if any("key_blocks" in curve.data_path for curve in clip.fcurves)}

def values(keys, seconds):
    scene = bpy.context.scene
    rows = []
    for moment in seconds:
        frame = moment * scene.render.fps / scene.render.fps_base
        scene.frame_set(int(frame), subframe=frame - int(frame))
        rows.append([block.value for block in keys.key_blocks[1:]])
    return rows

folder = pathlib.Path(sys.argv[-1])
seconds = [frame / 48 for frame in range(2, 63)]  # at the file's keys, and halfway between them
result = {}
for file in sorted([*folder.glob("*.fbx"), *folder.glob("*.glb")]):
    keys = load(file)
    found = clips(keys)
    for clip in found.values():
        only(keys, clip)
    result[file.name] = {
        "names": [block.name for block in keys.key_blocks[1:]], "clips": len(found),
        "rows": values(keys, seconds)}
(folder / "result.json").write_text(json.dumps(result))
"""


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
class ShapeAnimations(unittest.TestCase):
    def test_shape_keys_move_as_in_the_file(self):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            result_of(FACE, folder)
            for name, options in (("kept", ["--keep-rig"]), ("new", [])):
                made = folder / name
                subprocess.run([PROGRAM, "rig", folder / "face.fbx", *options, "-q", "-o",
                                f"{made}.glb", "-o", f"{made}.fbx"], check=True,
                               stderr=subprocess.DEVNULL)
            found = result_of(VALUES, folder)
        given = found.pop("face.fbx")
        self.assertEqual(given["names"], ["jaw", "wide", "still"])
        jaw = [row[0] for row in given["rows"]]
        self.assertGreater(max(jaw) - min(jaw), 0.9)
        self.assertEqual(len(found), 4)
        for name, result in found.items():
            with self.subTest(name):
                self.assertEqual(result["names"], given["names"])
                self.assertEqual(result["clips"], given["clips"])
                apart = max(abs(a - b) for row, other in zip(result["rows"], given["rows"])
                            for a, b in zip(row, other))
                print(f"{name}: {apart:.2e}")
                self.assertLess(apart, 1e-4)


if __name__ == "__main__":
    unittest.main()
