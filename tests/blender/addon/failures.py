"""Errors are told, and leave nothing behind."""

import bpy
from scene import armatures, far, folder, leftovers, mesh_object, rig, select, world_places, y_shape
from curveskel_addon import program

for places, faces, words in (([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)], "encloses nothing"),
                             ([], [], "no faces"), ([(0, 0, 0), (1, 0, 0)], [], "no faces")):
    select(mesh_object("line", places, faces))
    for verb in (bpy.ops.curveskel.rig, bpy.ops.curveskel.skeleton):
        try:
            verb()
        except RuntimeError as error:
            assert words in str(error) and "in.obj" not in str(error), error
        else:
            assert False, "a line has no rig"
assert not [thing for thing in bpy.data.objects if thing.type == "ARMATURE"]
preferences = bpy.context.preferences.addons["curveskel_addon"].preferences
for path, words in (("/nowhere/curveskel", "not found"), ("/bin/true", "no curveskel")):
    preferences.program = path
    try:
        bpy.ops.curveskel.test_program()
    except RuntimeError as error:
        assert words in str(error), error
    else:
        assert False, path
preferences.program = ""
assert bpy.ops.curveskel.test_program() == {"FINISHED"}
# A run that is cancelled ends at once, and leaves nothing.
slow = folder / "slow"
slow.write_text("#!/bin/sh\necho 'contract ...' >&2\nexec sleep 60\n")
slow.chmod(0o755)
job = program.Job(str(slow))
job.start("rig")
while job.stage() == "starting":
    pass
assert job.stage() == "contract ..." and not job.is_done()
job.close()
assert not leftovers()
# An error in the add-on leaves no half of a rig.
from curveskel_addon import armatures as module


def breaks(*things):
    select(*things)
    try:
        bpy.ops.curveskel.rig()
    except RuntimeError as error:
        assert "ZeroDivisionError" in str(error), error
    else:
        assert False, "an error is told"
    assert bpy.context.mode == "OBJECT" and not leftovers()


tails = module.tails
body = y_shape()
places = world_places(body)
module.tails = lambda joints: 1 / 0
breaks(body)
assert not armatures() and not bpy.data.armatures
module.tails = tails
from curveskel_addon import groups
fill, groups.fill = groups.fill, lambda *_: 1 / 0
breaks(body)
assert not armatures() and not bpy.data.armatures
groups.fill = fill
made = rig(body)
heads = [bone.head_local.copy() for bone in made.data.bones]
module.tails = lambda joints: 1 / 0
breaks(body)
assert len(bpy.data.armatures) == 1
assert [bone.head_local for bone in made.data.bones] == heads
module.tails = tails
assert far(places, world_places(body)) < 1e-5
