"""Weights Only leaves the bones as they are."""

import bpy
from scene import armature, check_weights, select, y_shape

body = y_shape()
select(body)
assert bpy.ops.curveskel.rig() == {"FINISHED"}
made = armature()
select(made)
bpy.ops.object.mode_set(mode="EDIT")
made.data.edit_bones.new("handle").tail = (0, 0, 40)
bpy.ops.object.mode_set(mode="OBJECT")
made.data.bones["handle"].use_deform = False
before = [(bone.name, tuple(bone.head_local), tuple(bone.tail_local)) for bone in made.data.bones]
bones = {bone.name for bone in made.data.bones if bone.use_deform}
body.vertex_groups.clear()
select(body, made)
assert bpy.ops.curveskel.weights() == {"FINISHED"}
assert [(bone.name, tuple(bone.head_local), tuple(bone.tail_local))
        for bone in made.data.bones] == before
assert {group.name for group in body.vertex_groups} == bones
check_weights(body, bones)
for thing in list(bpy.data.objects):
    if thing.type == "ARMATURE":
        bpy.data.objects.remove(thing)
select(body)
assert not bpy.ops.curveskel.weights.poll(), "no armature is selected"
