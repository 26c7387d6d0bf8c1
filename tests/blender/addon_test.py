"""The add-on in Blender: what it makes of the user's own objects without a window, and how its
buttons behave in one. Skipped where there is no Blender (Debian package blender), the window where
there is no screen (Debian package xvfb)."""

import ast
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["CURVESKEL_PROGRAM"])
ZIP = pathlib.Path(os.environ["CURVESKEL_ADDON"])  # as the build makes it

BEGIN = """
import pathlib, sys, tempfile, traceback
import bpy
from mathutils import Matrix, Vector
folder = pathlib.Path(sys.argv[-2])
source = pathlib.Path(sys.argv[-1])
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_install(filepath=str(folder / "curveskel.zip"))
bpy.ops.preferences.addon_enable(module="curveskel")

def mesh_object(name, places, faces):
    data = bpy.data.meshes.new(name)
    data.from_pydata(places, [], faces)
    thing = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(thing)
    return thing

def off(file):
    lines = file.read_text().split("\\n")
    vertices, faces = map(int, lines[1].split()[:2])
    return ([tuple(map(float, line.split())) for line in lines[2:2 + vertices]],
            [tuple(map(int, line.split()[1:4]))
             for line in lines[2 + vertices:2 + vertices + faces]])

def select(*things):
    bpy.ops.object.select_all(action="DESELECT")
    for thing in things:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = things[0]

def y_shape():
    thing = mesh_object("y", *off(source / "meshes" / "y.off"))
    thing.data.materials.append(bpy.data.materials.new("skin"))
    thing.data.uv_layers.new(name="map")
    thing.shape_key_add(name="Basis")
    key = thing.shape_key_add(name="wide")
    for point in key.data:
        point.co.x *= 1.5
    thing.location = (0, 0, 3)
    thing.rotation_euler = (0.3, 0, 1)
    bpy.context.view_layer.update()
    return thing

def armature():
    return next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")

def check_weights(thing, bones):
    names = {group.index: group.name for group in thing.vertex_groups}
    for vertex in thing.data.vertices:
        row = [group for group in vertex.groups if names[group.group] in bones]
        assert abs(sum(group.weight for group in row) - 1) < 1e-4, (thing.name, vertex.index)

def world_places(thing):
    bpy.context.view_layer.update()
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return [shown.matrix_world @ vertex.co for vertex in shown.data.vertices]

def leftovers():
    return [file for file in pathlib.Path(tempfile.gettempdir()).glob("curveskel-*")]

def armatures():
    return [thing for thing in bpy.data.objects if thing.type == "ARMATURE"]

def cube(name, place, size=0.1):
    c = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    thing = mesh_object(name, [[size / 2 * w for w in corner] for corner in c],
                        [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
                         (1, 5, 7, 3)])
    thing.location = place
    bpy.context.view_layer.update()
    return thing

def empty(name):
    thing = bpy.data.objects.new(name, None)
    bpy.context.collection.objects.link(thing)
    return thing

def figure(half=False, name="figure"):
    # a human of sticks; half of it with a mirror
    middle = [(0, 0, 1.0), (0, 0, 1.2), (0, 0, 1.42), (0, 0, 1.55), (0, 0, 1.75)]
    side = [(0.12, 0, 0.95), (0.13, 0, 0.5), (0.13, 0, 0.08), (0.13, -0.16, 0.04),
            (0.2, 0, 1.42), (0.48, 0, 1.42), (0.74, 0, 1.42)]
    edges = [(0, 1), (1, 2), (2, 3), (3, 4)]
    for first in (5, 12):
        edges += [(0, first), (first, first + 1), (first + 1, first + 2), (first + 2, first + 3),
                  (2, first + 4), (first + 4, first + 5), (first + 5, first + 6)]
    data = bpy.data.meshes.new(name)
    data.from_pydata(middle + side + [(-x, y, z) for x, y, z in side], edges, [])
    thing = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(thing)
    select(thing)
    thing.modifiers.new("skin", "SKIN")
    for number, vertex in enumerate(data.skin_vertices[0].data):
        vertex.radius = [(0.13, 0.13, 0.12, 0.05, 0.1)[number] if number < 5 else 0.05] * 2
    data.skin_vertices[0].data[0].use_root = True
    thing.modifiers.new("smooth", "SUBSURF").levels = 2
    for modifier in ("skin", "smooth"):
        bpy.ops.object.modifier_apply(modifier=modifier)
    if half:
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.bisect(plane_co=(0, 0, 0), plane_no=(1, 0, 0), clear_inner=True)
        bpy.ops.object.mode_set(mode="OBJECT")
        thing.modifiers.new("mirror", "MIRROR")
    return thing

def rig(*things, names="auto"):
    bpy.context.scene.curveskel.names = names
    select(*things)
    assert bpy.ops.curveskel.rig() == {"FINISHED"}
    return next(modifier.object for modifier in things[0].modifiers
                if modifier.type == "ARMATURE")

def refused(words, *things, names="auto", verb="rig"):
    bpy.context.scene.curveskel.names = names
    select(*things)
    before = len(armatures())
    try:
        getattr(bpy.ops.curveskel, verb)()
    except RuntimeError as error:
        assert words in str(error) and "Traceback" not in str(error), error
    else:
        assert False, "not refused: " + words
    assert len(armatures()) == before and not leftovers()

def shown_places(thing):
    # with what modifiers add, in the world
    bpy.context.view_layer.update()
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    places = [shown.matrix_world @ vertex.co for vertex in shown.to_mesh().vertices]
    shown.to_mesh_clear()
    return places

def turned_places(made, bone, thing):
    made.pose.bones[bone].matrix_basis = Matrix.Rotation(0.9, 4, "X")
    places = shown_places(thing)
    made.pose.bones[bone].matrix_basis = Matrix.Identity(4)
    bpy.context.view_layer.update()
    return places

def far(places, others):
    return max((a - b).length for a, b in zip(places, others))

def vertices_in(thing, name):
    group = thing.vertex_groups[name].index
    return [vertex.index for vertex in thing.data.vertices
            if any(entry.group == group for entry in vertex.groups)]

def hang_from_bone(thing, made, bone):
    frame = thing.matrix_world.copy()
    thing.parent, thing.parent_type, thing.parent_bone = made, "BONE", bone
    bpy.context.view_layer.update()
    thing.matrix_world = frame
    bpy.context.view_layer.update()

def run_laws(*laws):
    # each in an empty scene; all that fail are named
    failed = []
    for law in laws:
        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)
        bpy.ops.outliner.orphans_purge(do_recursive=True)
        bpy.context.scene.frame_set(1)
        try:
            law()
        except Exception:
            traceback.print_exc()
            failed.append(law.__name__)
    sys.stderr.flush()
    assert not failed, failed
"""

RIG = """
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
"""

WEIGHTS = """
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
"""

MIRROR = """
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
"""

PARENTS = """
def from_tip(body, sword):
    tip = max(range(len(body.data.vertices)), key=lambda n: body.data.vertices[n].co.x)
    return (shown_places(sword)[0] - shown_places(body)[tip]).length

def what_hangs_from_a_bone_is_moved_once():
    body, sword = figure(), cube("sword", (0.72, -0.1, 1.42))
    rest = from_tip(body, sword)
    made = rig(body)
    hang_from_bone(sword, made, "hand.L")
    made.pose.bones["upper_arm.L"].matrix_basis = Matrix.Rotation(0.9, 4, "X")
    select(body, sword, made)
    assert bpy.ops.curveskel.weights() == {"FINISHED"}
    assert made.data.pose_position == "POSE"
    assert sword.parent == made and sword.parent_type == "OBJECT"
    assert abs(from_tip(body, sword) - rest) < 1e-4, from_tip(body, sword)
    made.pose.bones["upper_arm.L"].matrix_basis = Matrix.Identity(4)
    assert abs(from_tip(body, sword) - rest) < 1e-4, from_tip(body, sword)
    sword.modifiers.clear()
    hang_from_bone(sword, made, "hand.L")
    made.pose.bones["upper_arm.L"].matrix_basis = Matrix.Rotation(0.9, 4, "X")
    assert rig(body, sword) == made
    assert abs(from_tip(body, sword) - rest) < 1e-4, from_tip(body, sword)

def what_hangs_from_a_vertex_is_moved_once():
    body = figure()
    tip = max(body.data.vertices, key=lambda vertex: vertex.co.x)
    button = cube("button", (0, 0, 0), 0.02)
    button.parent, button.parent_type = body, "VERTEX"
    button.parent_vertices = [tip.index, 0, 0]
    bpy.context.view_layer.update()
    places = shown_places(button)
    made = rig(body, button)
    assert button.parent == made and button.parent_type == "OBJECT"
    assert far(places, shown_places(button)) < 1e-5
    turned = turned_places(made, "upper_arm.L", button)
    place = turned_places(made, "upper_arm.L", body)[tip.index]
    assert min((corner - place).length for corner in turned) < 0.05

def a_common_parent_goes_on_moving_all():
    control = empty("control")
    control.location, control.scale = (1, 0, 0), (1, 2, 1)
    body, hat = figure(), cube("hat", (0, 0, 1.9))
    body.parent = hat.parent = control
    bpy.context.view_layer.update()
    places = shown_places(body)
    made = rig(body, hat)
    assert made.parent == control and body.parent == hat.parent == made
    assert far(places, shown_places(body)) < 1e-5
    hips = (made.matrix_world @ made.data.bones[0].head_local).copy()
    control.location.y += 5
    assert far([place + Vector((0, 5, 0)) for place in places], shown_places(body)) < 1e-5
    assert ((made.matrix_world @ made.data.bones[0].head_local) - hips).y > 4.99

def other_parents_are_kept():
    control = empty("control")
    body, hat, feather = figure(), cube("hat", (0, 0, 1.9)), cube("feather", (0, 0, 2.05))
    hat.parent, feather.parent = control, hat
    bpy.context.view_layer.update()
    feather.matrix_world = Matrix.Translation((0, 0, 2.05))
    made = rig(body, hat, feather)
    assert body.parent == made and hat.parent == control and feather.parent == hat
    assert all(thing.modifiers[0].object == made for thing in (body, hat, feather))
    places = shown_places(hat)
    assert far(places, turned_places(made, made.data.bones[0].name, hat)) > 0.3
    control.location.y += 5
    assert far([place + Vector((0, 5, 0)) for place in places], shown_places(hat)) < 1e-5

def shear_stays():
    control = empty("control")
    control.rotation_euler, control.scale = (0, 0, 0.7), (1, 2, 1)
    body, hat = figure(), cube("hat", (0.1, 0, 1.9))
    hat.parent, hat.rotation_euler = control, (0, 0, 0.3)
    places = shown_places(hat)
    made = rig(hat)
    assert hat.parent == made
    assert far(places, shown_places(hat)) < 1e-5

def animation_stays():
    control = empty("control")
    body = figure()
    body.parent = control
    for frame in (1, 10):
        body.location = (0.1 * frame, 0, 0)
        body.keyframe_insert("location", frame=frame)
    control.location = (0, 2, 0)
    scene = bpy.context.scene
    scene.frame_set(10)
    late = shown_places(body)
    scene.frame_set(1)
    early = shown_places(body)
    rig(body)
    assert far(early, shown_places(body)) < 1e-5
    scene.frame_set(10)
    assert far(late, shown_places(body)) < 1e-5

def a_parent_that_moves_otherwise_is_kept():
    data = bpy.data.curves.new("path", "CURVE")
    data.dimensions, data.use_path, data.use_path_follow = "3D", True, True
    spline = data.splines.new("POLY")
    spline.points.add(2)
    for point, place in zip(spline.points, ((0, 0, 0), (1, 1, 0), (3, 1, 0))):
        point.co = (*place, 1)
    data.eval_time = 40
    path = bpy.data.objects.new("path", data)
    bpy.context.collection.objects.link(path)
    body = figure()
    body.parent = path
    places = shown_places(body)
    made = rig(body)
    assert body.parent == path
    assert far(places, shown_places(body)) < 1e-5
    for bone in made.data.bones:
        head = made.matrix_world @ bone.head_local
        assert min((place - head).length for place in places) < 0.2, bone.name

run_laws(what_hangs_from_a_bone_is_moved_once, what_hangs_from_a_vertex_is_moved_once,
         a_common_parent_goes_on_moving_all, other_parents_are_kept, shear_stays,
         animation_stays, a_parent_that_moves_otherwise_is_kept)
"""

DATA = """
def linked_duplicates_get_weights_of_their_own():
    body, left = figure(), cube("left", (0.73, 0, 1.42), 0.14)
    right, spare = (bpy.data.objects.new(name, left.data) for name in ("right", "spare"))
    for thing in (right, spare):
        bpy.context.collection.objects.link(thing)
    right.location = (-0.73, 0, 1.42)
    bpy.context.view_layer.update()
    rig(body, left, right)
    for thing, side in ((left, ".L"), (right, ".R")):
        names = [group.name for group in thing.vertex_groups if vertices_in(thing, group.name)]
        assert names and all(name.endswith(side) for name in names), (thing.name, names)
    assert not spare.vertex_groups

def link(path, **what):
    with bpy.data.libraries.load(str(path), link=True) as (_, wanted):
        for kind, names in what.items():
            setattr(wanted, kind, names)
    return wanted

def linked_objects_and_meshes_are_refused():
    hero = figure(name="hero")
    path = folder / "hero.blend"
    bpy.data.libraries.write(str(path), {hero})
    bpy.data.objects.remove(hero)
    local = mesh_object("hero", *off(source / "meshes" / "y.off"))
    linked = link(path, objects=["hero"]).objects[0]
    bpy.context.collection.objects.link(linked)
    bpy.context.view_layer.update()
    refused("is linked from", linked)
    assert not local.vertex_groups and local.parent is None and not local.modifiers
    twin = bpy.data.objects.new("twin", linked.data)
    bpy.context.collection.objects.link(twin)
    refused("is linked from", twin)
    select(linked)
    assert bpy.ops.curveskel.skeleton() == {"FINISHED"}  # changes nothing of it

def a_linked_armature_gives_weights():
    hero = figure(name="hero")
    made = rig(hero)
    hero.parent = None
    path = folder / "rig.blend"
    bpy.data.libraries.write(str(path), {made})
    name = made.name
    bpy.data.objects.remove(made)
    hero.modifiers.clear()
    hero.vertex_groups.clear()
    bpy.ops.outliner.orphans_purge(do_recursive=True)
    made = link(path, objects=[name]).objects[0]
    bpy.context.collection.objects.link(made)
    bpy.context.view_layer.update()
    select(hero, made)
    assert bpy.ops.curveskel.weights() == {"FINISHED"}
    check_weights(hero, {bone.name for bone in made.data.bones})
    refused("linked from", hero)  # by Rig, which would change its bones

run_laws(linked_duplicates_get_weights_of_their_own, linked_objects_and_meshes_are_refused,
         a_linked_armature_gives_weights)
"""

AGAIN = """
def skins(thing):
    return [modifier.object for modifier in thing.modifiers if modifier.type == "ARMATURE"]

def rig_again_replaces_bones_and_groups():
    body, light = figure(), empty("light")
    body.vertex_groups.new(name="mine").add([0, 1], 0.25, "REPLACE")
    made = rig(body)
    made.name = "hero"
    light.location = (0.7, 0, 1.5)
    bpy.context.view_layer.update()
    hang_from_bone(light, made, "hand.L")
    place = light.matrix_world.translation.copy()
    select(made)
    bpy.ops.object.mode_set(mode="EDIT")
    control = made.data.edit_bones.new("control")
    control.head, control.tail = (0, -0.5, 1), (0, -0.7, 1)
    control.parent, control.use_deform = made.data.edit_bones["hips"], False
    bpy.ops.object.mode_set(mode="OBJECT")
    made.data.bones["hand.R"].name = "renamed"
    assert rig(body) == made and armatures() == [made] and skins(body) == [made]
    bones = {bone.name for bone in made.data.bones}
    assert "hand.R" in bones and "renamed" not in bones and "hand.L.001" not in bones, bones
    assert made.data.bones["control"].parent.name == "hips"
    assert {group.name for group in body.vertex_groups} == bones - {"control"} | {"mine"}
    assert body.vertex_groups["mine"].weight(0) == 0.25
    assert light.parent_bone == "hand.L"
    assert (light.matrix_world.translation - place).length < 1e-5
    rig(body, names="mixamo")
    bones = {bone.name for bone in made.data.bones}
    assert "mixamorig:Hips" in bones and "hips" not in bones
    assert {group.name for group in body.vertex_groups} == bones - {"control"} | {"mine"}
    assert (light.matrix_world.translation - place).length < 1e-5
    check_weights(body, bones)

def posed_and_moved_bodies_are_rigged_where_they_are():
    body = figure()
    made = rig(body)
    made.location, made.scale = (1, 0, 2), (2, 2, 2)
    made.pose.bones["upper_arm.L"].matrix_basis = Matrix.Rotation(0.9, 4, "X")
    bpy.context.view_layer.update()
    heads = [made.matrix_world @ bone.head for bone in made.pose.bones]
    tails = [made.matrix_world @ bone.tail for bone in made.pose.bones]
    names = [bone.name for bone in made.data.bones]
    places = shown_places(body)
    assert rig(body) == made and armatures() == [made]
    assert [bone.name for bone in made.data.bones] == names
    assert far(heads, [made.matrix_world @ bone.head for bone in made.pose.bones]) < 0.02
    assert far(tails, [made.matrix_world @ bone.tail for bone in made.pose.bones]) < 0.02
    assert far(places, shown_places(body)) < 0.02

def locked_groups_stay():
    body = figure()
    made = rig(body)
    group = body.vertex_groups["head"]
    group.add(range(len(body.data.vertices)), 0.125, "REPLACE")
    group.lock_weight = True
    for verb in ("weights", "rig"):
        select(body, made)
        assert getattr(bpy.ops.curveskel, verb)() == {"FINISHED"}
        group = body.vertex_groups["head"]
        assert group.lock_weight and {group.weight(n) for n in range(50)} == {0.125}
        for vertex in body.data.vertices:  # those of the head have no other bone
            assert len(vertex.groups) == 1 or abs(
                sum(entry.weight for entry in vertex.groups) - 1) < 1e-4, vertex.index

def other_armatures_and_bodies_are_not_broken():
    body, hat = figure(), cube("hat", (0, 0, 1.9))
    made = rig(body, hat)
    refused("select it as well", hat)
    made.hide_set(True)
    refused("hidden", body, hat)
    made.hide_set(False)
    del made["curveskel"]
    refused("already", body)
    assert skins(body) == [made] and vertices_in(body, "hand.L")
    other = rig(cube("box", (3, 0, 0), 1))
    refused("already", body, other, verb="weights")
    assert skins(body) == [made]

def parts_that_were_rigged_apart_come_together():
    body, hat = figure(), cube("hat", (0, 0, 1.9))
    rig(hat)
    rig(body)
    made = rig(body, hat)
    assert armatures() == [made] and skins(body) == skins(hat) == [made]
    assert hat.parent == body.parent == made
    assert {group.name for group in hat.vertex_groups} == {bone.name for bone in made.data.bones}

def groups_of_the_users_own_are_not_taken():
    body = figure()
    body.vertex_groups.new(name="hips").add([0, 1, 2], 1, "REPLACE")
    body.modifiers.new("mask", "MASK").vertex_group = "hips"
    refused("hips", body)
    assert vertices_in(body, "hips") == [0, 1, 2] and len(body.vertex_groups) == 1
    body.vertex_groups.clear()
    made = rig(body)
    bones = {bone.name for bone in made.data.bones}
    bpy.data.objects.remove(made)  # its groups were made by the add-on, and may go
    made = rig(body)
    assert {group.name for group in body.vertex_groups} == bones
    check_weights(body, bones)

def a_linked_duplicate_of_a_character_is_left_alone():
    body = figure()
    made = rig(body)
    groups = [group.name for group in body.vertex_groups]
    select(body, made)
    bpy.ops.object.duplicate(linked=True)
    twin = next(thing for thing in bpy.context.selected_objects if thing.type == "MESH")
    assert twin.data == body.data
    other = rig(twin, names="mixamo")
    assert other not in (None, made) and "mixamorig:Hips" in other.data.bones
    assert "hips" in made.data.bones and "mixamorig:Hips" not in made.data.bones
    assert [group.name for group in body.vertex_groups] == groups
    assert made.data.pose_position == other.data.pose_position == "POSE"

run_laws(rig_again_replaces_bones_and_groups, posed_and_moved_bodies_are_rigged_where_they_are,
         locked_groups_stay, other_armatures_and_bodies_are_not_broken,
         parts_that_were_rigged_apart_come_together, groups_of_the_users_own_are_not_taken,
         a_linked_duplicate_of_a_character_is_left_alone)
"""

TAILS = """
from curveskel import armatures as module

def joint(name, parent, position, **more):
    return {"name": name, "parent": parent, "position": position, **more}

def tail_of(joints, number):
    place, target = module.tails(joints)[number]
    return [round(c, 4) for c in place], target

def bones_lie_on_their_axes():
    up, left = [0, 0, 1], [1, 0, 0]
    chest = [joint("joint_001", -1, [0, 0, 1], axis=up), joint("a", 0, [1, 0, 1], axis=left),
             joint("b", 1, [3, 0, 1], axis=left, end=True), joint("c", 0, [0, 0, 2], axis=up),
             joint("d", 0, [-1, 0, 1], axis=[-1, 0, 0])]
    assert tail_of(chest, 0) == ([0, 0, 2], 3)
    assert tail_of(chest, 1) == ([3, 0, 1], 2)
    assert tail_of(chest, 4) == ([-1.5, 0, 1], None)  # straight on
    assert [module.is_end(chest, n) for n in range(5)] == [False, False, True, False, False]
    chest[3]["position"] = [0.1, 0, 2]  # no longer on the axis: no child is met
    assert tail_of(chest, 0) == ([0, 0, 1 + round((2 + 1.01 ** 0.5) / 3, 4)], None)
    assert not module.is_end([joint("x_end", -1, [0, 0, 0], axis=up)], 0)

def rigs_without_axes_go_by_names():
    chest = [joint("chest", -1, [0, 0, 1]), joint("arm.L", 0, [1, 0, 1]),
             joint("arm_1.L", 1, [2, 0, 1]), joint("arm_end.L", 2, [3, 0, 1]),
             joint("head", 0, [0, 0, 2])]
    assert tail_of(chest, 0) == ([0, 0, 2], 4)
    assert tail_of(chest, 1) == ([2, 0, 1], 2)
    assert [module.is_end(chest, n) for n in range(5)] == [False, False, False, True, False]

def names_change_no_bone():
    places = {}
    for names in ("auto", "mixamo", "neutral"):
        body = figure()
        bones = rig(body, names=names).data.bones
        places[names] = [place for bone in bones for place in (bone.head_local, bone.tail_local)]
        assert not any("_end" in bone.name for bone in bones)
        if names == "mixamo":
            bone = next(bone for bone in bones if len(bone.children) == 3
                        and "Spine" in bone.name)
            assert [child.name for child in bone.children if child.use_connect] in (
                [], ["mixamorig:Neck"]), bone.name
            assert abs(bone.vector.normalized().x) < 0.05, bone.vector
    assert len(places["auto"]) == len(places["neutral"]) == len(places["mixamo"])
    assert far(places["auto"], places["mixamo"]) < 1e-5
    assert far(places["auto"], places["neutral"]) < 1e-5

run_laws(bones_lie_on_their_axes, rigs_without_axes_go_by_names, names_change_no_bone)
"""

SKELETON = """
body = y_shape()
select(body)
assert bpy.ops.curveskel.skeleton() == {"FINISHED"}
curve = next(thing for thing in bpy.data.objects if thing.type == "CURVE")
assert len(curve.data.splines) == 3, len(curve.data.splines)
places = world_places(body)
for spline in curve.data.splines:
    for point in spline.points:
        assert point.radius > 0
        nearest = min((place - point.co.to_3d()).length for place in places)
        assert 0.5 * point.radius < nearest < 3 * point.radius + 0.2, (nearest, point.radius)
"""

FAILURES = """
from curveskel import program
select(mesh_object("line", [(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)]))
try:
    bpy.ops.curveskel.rig()
except RuntimeError as error:
    assert "in.obj" in str(error) or "encloses nothing" in str(error), error
else:
    assert False, "a line has no rig"
assert not [thing for thing in bpy.data.objects if thing.type == "ARMATURE"]
preferences = bpy.context.preferences.addons["curveskel"].preferences
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
slow.write_text("#!/bin/sh\\necho 'contract ...' >&2\\nexec sleep 60\\n")
slow.chmod(0o755)
job = program.Job(str(slow))
job.start("rig")
while job.stage() == "starting":
    pass
assert job.stage() == "contract ..." and not job.is_done()
job.close()
assert not leftovers()
# An error in the add-on leaves no half of a rig.
from curveskel import armatures as module

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
from curveskel import groups
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
"""

# Clicks in a window: a run that Escape ends, then one that comes to its end, with the panel drawn.
WINDOW = """
import os, time, traceback
from curveskel.panel import CURVESKEL_PT_panel
bpy.context.preferences.view.show_splash = False
bpy.context.preferences.use_preferences_save = False
drawn = []
draw = CURVESKEL_PT_panel.draw
bpy.utils.unregister_class(CURVESKEL_PT_panel)
CURVESKEL_PT_panel.bl_category = "Item"  # the tab that is open
CURVESKEL_PT_panel.draw = lambda self, context: drawn.append(draw(self, context))
bpy.utils.register_class(CURVESKEL_PT_panel)

def press(window, key, x=400, y=400):
    window.event_simulate(type=key, value="PRESS", x=x, y=y)
    window.event_simulate(type=key, value="RELEASE", x=x, y=y)

def steps():
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    area.spaces[0].show_region_ui = True
    body = y_shape()
    select(body)
    slow = folder / "slow"
    slow.write_text("#!/bin/sh\\necho 'contract ...' >&2\\nexec sleep 60\\n")
    slow.chmod(0o755)
    preferences = bpy.context.preferences.addons["curveskel"].preferences
    preferences.program = str(slow)
    with bpy.context.temp_override(window=window, area=area, region=region):
        assert bpy.ops.curveskel.rig("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield 1
    assert leftovers(), "the run goes on"
    press(window, "ESC")
    yield 1
    assert not leftovers() and not armatures(), "Escape ends it and leaves nothing"
    preferences.program = ""
    with bpy.context.temp_override(window=window, area=area, region=region):
        assert bpy.ops.curveskel.rig("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    begin = time.monotonic()
    while not armatures() and time.monotonic() < begin + 30:
        yield 0.2
    yield 0.5
    assert len(armatures()) == 1 and not leftovers()
    assert drawn, "the panel was not drawn"
    # The user goes on while the program runs: a result for what has changed is not taken.
    slow.write_text(f"#!/bin/sh\\nwhile [ ! -e {folder}/go ]; do sleep 0.1; done\\n"
                    "exec curveskel \\"$@\\"\\n")
    preferences.program = str(slow)
    from curveskel import armatures as module
    tails = module.tails
    for change in ("edit mode", "moved", "deleted", "error"):
        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)
        body = y_shape()
        with bpy.context.temp_override(window=window, area=area, region=region):
            select(body)
            assert bpy.ops.curveskel.rig("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
            if change == "edit mode":
                bpy.ops.object.mode_set(mode="EDIT")
        yield 0.2
        if change == "moved":
            body.location.x += 5
        if change == "deleted":
            bpy.data.objects.remove(body)
        if change == "error":
            module.tails = lambda joints: 1 / 0
        assert leftovers(), "the run goes on"
        (folder / "go").touch()
        begin = time.monotonic()
        while leftovers() and time.monotonic() < begin + 10:
            yield 0.2
        assert not leftovers(), change
        (folder / "go").unlink()
        assert not armatures(), change
        if change == "edit mode":
            assert bpy.context.mode == "EDIT_MESH"
            with bpy.context.temp_override(window=window, area=area, region=region):
                bpy.ops.object.mode_set(mode="OBJECT")
        if change in ("edit mode", "moved"):
            assert not body.vertex_groups and not body.modifiers and body.parent is None
    module.tails = tails
    bpy.ops.screen.screenshot({"window": window, "area": area, "screen": window.screen},
                              filepath=str(folder / "window.png"))
    assert (folder / "window.png").stat().st_size > 1000

running = steps()

def tick():
    try:
        return next(running)
    except StopIteration:
        os._exit(0)
    except BaseException:
        traceback.print_exc()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(1)

bpy.app.timers.register(tick, first_interval=1)
"""


def capped_bar():
    """Half of a bar along x, from 0 to 4, open at 0: rings of eight and a cap."""
    import math
    rings = [(0.4 * k, 0.5) for k in range(10)] + [(3.8, 0.35)]
    lines, faces = [], []
    for x, radius in rings:
        lines += [f"{x} {radius * math.cos(k * math.pi / 4)} {radius * math.sin(k * math.pi / 4)}"
                  for k in range(8)]
    for ring in range(len(rings) - 1):
        for k in range(8):
            a, b = 8 * ring + k, 8 * ring + (k + 1) % 8
            faces += [(a, b, b + 8), (a, b + 8, a + 8)]
    last = 8 * (len(rings) - 1)
    lines.append("4 0 0")
    faces += [(last + k, last + (k + 1) % 8, len(lines) - 1) for k in range(8)]
    return off_text(lines, faces)


def off_text(lines, faces):
    return "\n".join(["OFF", f"{len(lines)} {len(faces)} 0", *lines,
                      *(f"3 {a} {b} {c}" for a, b, c in faces)]) + "\n"


OCTAHEDRON = off_text(
    ["0.1 0 0", "-0.1 0 0", "0 0.1 0", "0 -0.1 0", "0 0 0.1", "0 0 -0.1"],
    [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)])


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
class AddOn(unittest.TestCase):
    def run_in_blender(self, script, before=("--background",), with_screen=()):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            shutil.copy(ZIP, folder / "curveskel.zip")
            (folder / "half.off").write_text(capped_bar())
            (folder / "button.off").write_text(OCTAHEDRON)
            (folder / "script.py").write_text(BEGIN + script)
            (folder / "tmp").mkdir()
            (folder / "scripts").mkdir()
            # Blender takes the first python3 in the path for its own.
            environment = {**os.environ, "TMPDIR": str(folder / "tmp"),
                           "BLENDER_USER_SCRIPTS": str(folder / "scripts"),
                           "BLENDER_USER_CONFIG": str(folder / "config"),
                           "PATH": f"{PROGRAM.parent}:/usr/local/bin:/usr/bin:/bin"}
            done = subprocess.run(
                [*with_screen, shutil.which("blender"), *before, "--python-exit-code", "1",
                 "--python", folder / "script.py", "--", folder, SOURCE], capture_output=True,
                text=True, stdin=subprocess.DEVNULL, env=environment, check=False, timeout=300)
            self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-3000:])

    def test_rigs_the_users_own_objects(self):
        self.run_in_blender(RIG)

    def test_weights_leave_the_bones_alone(self):
        self.run_in_blender(WEIGHTS)

    def test_half_a_body_with_a_mirror_is_whole(self):
        self.run_in_blender(MIRROR)

    def test_objects_stay_where_and_whose_they_are(self):
        self.run_in_blender(PARENTS)

    def test_data_that_others_have_is_left_to_them(self):
        self.run_in_blender(DATA)

    def test_rig_again_replaces_what_rig_made(self):
        self.run_in_blender(AGAIN)

    def test_bones_lie_along_their_limbs(self):
        self.run_in_blender(TAILS)

    def test_skeleton_comes_as_curves_with_radii(self):
        self.run_in_blender(SKELETON)

    def test_failures_are_said_and_leave_nothing(self):
        self.run_in_blender(FAILURES)

    @unittest.skipUnless(shutil.which("xvfb-run"), "needs a screen: install the Debian package xvfb")
    def test_buttons_run_and_end_in_a_window(self):
        self.run_in_blender(WINDOW, ("--factory-startup", "--enable-event-simulate"),
                            ("xvfb-run", "-a", "-s", "-screen 0 1280x800x24"))


class Panel(unittest.TestCase):
    def choices(self, name):
        """The first words of the lists in panel.py."""
        tree = ast.parse((SOURCE / "blender" / "curveskel" / "panel.py").read_text())
        for statement in tree.body:
            if isinstance(statement, ast.Assign) and statement.targets[0].id == name:
                return [pair[0] for pair in ast.literal_eval(statement.value.generators[0].iter)]
        self.fail(name)

    def test_offers_what_the_program_knows(self):
        for name, option in (("PLANS", "--plan"), ("NAMES", "--names")):
            said = subprocess.run([PROGRAM, "rig", "in.obj", "-o", "out.json", option, "unheard-of"],
                                  capture_output=True, text=True, check=False).stderr
            known = said.split("is none of: ")[1].split("\n")[0].split(", ")
            self.assertEqual(sorted(self.choices(name)), sorted(known))


if __name__ == "__main__":
    unittest.main()
