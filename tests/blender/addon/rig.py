"""Rig: bones and weights for the user's own objects."""

import bpy
from mathutils import Matrix, Vector
from scene import (armature, check_weights, folder, leftovers, mesh_object, off, select,
                   world_places, y_shape)

body = y_shape()
places = world_places(body)
button = mesh_object("button", *off(folder / "button.off"))
button.location = body.matrix_world @ Vector(min(body.data.vertices, key=lambda v: v.co.x).co)
button.modifiers.new("smooth", "SUBSURF")
button.vertex_groups.new(name="mine").add([0], 0.25, "REPLACE")
select(body, button)
assert bpy.ops.curveskel.rig() == {"FINISHED"}
made = armature()
bones = {bone.name for bone in made.data.bones}
assert len(bones) >= 4, bones
assert not any("_end" in name for name in bones), bones
assert len([bone for bone in made.data.bones if bone.parent is None]) == 1
for thing in (body, button):
    check_weights(thing, bones)
    assert thing.parent == made
    assert [m.type for m in thing.modifiers][0] == "ARMATURE", list(thing.modifiers)
assert button.vertex_groups["mine"].weight(0) == 0.25
assert [key.name for key in body.data.shape_keys.key_blocks] == ["Basis", "wide"]
assert body.data.materials[0].name == "skin" and body.data.uv_layers[0].name == "map"
assert [m.type for m in button.modifiers] == ["ARMATURE", "SUBSURF"]
moved = world_places(body)
assert max((a - b).length for a, b in zip(places, moved)) < 1e-4, "rests where it was"
# A limb that is turned takes its part along, and leaves the others.
tip = max((bone for bone in made.pose.bones if bone.parent), key=lambda bone: bone.bone.length)
tip.matrix_basis = Matrix.Rotation(0.8, 4, "X")
turned = world_places(body)
ways = sorted((a - b).length for a, b in zip(places, turned))
assert ways[-1] > 0.3 and ways[len(ways) // 3] < 1e-3, ways[::200]
assert not leftovers()
# Again: groups are made anew, not doubled.
tip.matrix_basis = Matrix.Identity(4)
body.parent = None
count = len(body.vertex_groups)
assert bpy.ops.curveskel.rig() == {"FINISHED"}
assert len(body.vertex_groups) == count
