"""A result for what was edited while the program ran is not taken, and nothing is left of it."""

import contextlib

import bpy
from mathutils import Vector
from scene import armatures, figure, refused, rig, run_laws, select
from curveskel_addon import program


@contextlib.contextmanager
def meanwhile(change):
    wait = program.Job.wait

    def changed(job):
        wait(job)
        change()
        bpy.context.view_layer.update()

    program.Job.wait = changed
    try:
        yield
    finally:
        program.Job.wait = wait


def move_vertices(body):
    for vertex in body.data.vertices:
        vertex.co.x += 5


def move_basis(body):
    for point in body.data.shape_keys.reference_key.data:
        point.co.x += 5


def turn_face(body):
    body.data.polygons[0].flip()


def cut_mirror(body):
    body.modifiers["mirror"].use_axis = (False, True, False)


def edited_meshes_are_refused():
    for change in (move_vertices, turn_face, move_basis, cut_mirror):
        body = figure(half=change == cut_mirror)
        if change == move_basis:
            body.shape_key_add(name="Basis")
        with meanwhile(lambda: change(body)):
            refused("changed meanwhile", body)
        assert not body.vertex_groups and body.parent is None


def what_changes_no_place_is_taken():
    body = figure()
    body.shape_key_add(name="Basis")
    key = body.shape_key_add(name="broad")

    def change():
        key.value = 0.5
        body.data.materials.append(bpy.data.materials.new("skin"))
        body.modifiers.new("smooth", "SUBSURF")

    with meanwhile(change):
        rig(body)


def in_edit_bones(made, change):
    select(made)
    bpy.ops.object.mode_set(mode="EDIT")
    change(made.data.edit_bones)
    bpy.ops.object.mode_set(mode="OBJECT")


def edited_bones_are_refused():
    body = figure()
    made = rig(body)

    def move(edit):
        edit["hand.L"].tail += Vector((0.1, 0, 0))

    def take_off(edit):
        edit["head"].parent = None

    for change in (move, take_off):
        with meanwhile(lambda: in_edit_bones(made, change)):
            refused("changed meanwhile", body, made, verb="weights")


def a_refused_run_splits_nothing():
    body = figure()
    made = rig(body)
    twin = bpy.data.objects.new("twin", made.data)
    bpy.context.collection.objects.link(twin)

    def move():
        body.location.x += 1

    with meanwhile(move):
        refused("changed meanwhile", body)
    assert made.data == twin.data and len(bpy.data.armatures) == 1
    assert made.data.pose_position == "POSE"
    bones = [bone.name for bone in made.data.bones]
    body.location.x -= 1
    assert rig(body, names="neutral") == made
    assert made.data != twin.data and [bone.name for bone in twin.data.bones] == bones
    assert made.data.pose_position == twin.data.pose_position == "POSE"
    assert len(armatures()) == 2


run_laws(edited_meshes_are_refused, what_changes_no_place_is_taken, edited_bones_are_refused,
         a_refused_run_splits_nothing)
