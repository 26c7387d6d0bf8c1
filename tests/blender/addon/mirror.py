"""Half a body with a mirror modifier is rigged as a whole one."""

import bpy
from mathutils import Vector
from scene import (check_weights, far, figure, folder, mesh_object, off, refused, rig, run_laws,
                   shown_places, turned_places)


def check_both_sides(body, made):
    bones = {bone.name for bone in made.data.bones}
    assert {"hand.L", "hand.R", "toes.L", "toes.R"} <= bones, bones
    left, right = (made.data.bones[name].head_local for name in ("hand.L", "hand.R"))
    assert (left - Vector((-right.x, right.y, right.z))).length < 0.01, (left, right)
    check_weights(body, bones)


def half_a_body_is_whole():
    half = figure(half=True)
    half.modifiers["mirror"].use_clip = True
    check_both_sides(half, rig(half))
    assert [m.type for m in half.modifiers] == ["MIRROR", "ARMATURE"]
    assert half.modifiers["mirror"].show_viewport


def a_seam_within_the_merge_distance_is_one():
    half = figure(half=True)
    half.modifiers["mirror"].merge_threshold = 2e-3
    seam = [vertex for vertex in half.data.vertices if abs(vertex.co.x) < 1e-6]
    assert seam
    for vertex in seam:
        vertex.co.x = 9e-4
    half.location = (0, 0, 3)
    bpy.context.view_layer.update()
    check_both_sides(half, rig(half))


def shape_keys_that_are_on_change_nothing():
    plain, half = figure(half=True), figure(half=True)
    half.shape_key_add(name="Basis")
    key = half.shape_key_add(name="broad")
    for point in key.data:
        point.co.y *= 1.3
    key.value, half.active_shape_key_index = 0.3, 1
    made = rig(half)
    check_both_sides(half, made)
    assert far([bone.head_local for bone in rig(plain).data.bones],
               [bone.head_local for bone in made.data.bones]) < 1e-6
    assert abs(key.value - 0.3) < 1e-6 and half.active_shape_key_index == 1
    assert not half.show_only_shape_key


def a_mirror_that_cuts_is_refused():
    body = figure()
    body.modifiers.new("mirror", "MIRROR").use_bisect_axis[0] = True
    refused("Bisect", body)
    assert not body.vertex_groups


def each_side_moves_with_its_own_bones():
    for names, arm in (("auto", "upper_arm.R"), ("unity", "RightUpperArm"),
                       ("unreal", "upperarm_r"), ("vrm", "rightUpperArm"),
                       ("rigify", "upper_arm.R")):
        half = figure(half=True)
        made = rig(half, names=names)
        places = shown_places(half)
        moved = [place.x for place, turned in zip(places, turned_places(made, arm, half))
                 if (place - turned).length > 1e-3]
        assert len(moved) > 100 and max(moved) < 0.05, (names, len(moved))


def names_that_a_mirror_does_not_flip_are_refused():
    half = figure(half=True)
    for names in ("mixamo", "neutral"):
        refused("choose Names", half, names=names)
    half.modifiers["mirror"].use_mirror_vertex_groups = False
    refused("Vertex Groups", half)
    refused("mirror modifier", half, names="mixamo")
    body = figure()
    made = rig(body, names="mixamo")
    refused("mirror modifier", half, made, verb="weights")
    assert not half.vertex_groups and len(half.modifiers) == 1
    bar = mesh_object("bar", *off(folder / "half.off"))
    bar.modifiers.new("mirror", "MIRROR")
    refused("mirror modifier", bar)  # its joints go on from one end to the other


run_laws(half_a_body_is_whole, a_seam_within_the_merge_distance_is_one,
         shape_keys_that_are_on_change_nothing, a_mirror_that_cuts_is_refused,
         each_side_moves_with_its_own_bones, names_that_a_mirror_does_not_flip_are_refused)
