"""Rig finds by itself where a body looks, as the program does."""

import bpy
from mathutils import Matrix
from scene import obj, refused, rig, run_laws, world_places


def has_its_head_at_the_horns(turn):
    body = obj("cow", "meshes/free/spot-3k.obj")
    body.matrix_world = Matrix.Rotation(turn, 4, "Z")
    bpy.context.view_layer.update()
    made = rig(body)
    horn = max(world_places(body), key=lambda place: place.z)
    head, hips = (made.matrix_world @ made.data.bones[name].head_local for name in ("head", "hips"))
    return (head - horn).length < 0.5 * (hips - horn).length


def looks_to_y():
    assert has_its_head_at_the_horns(0)


def looks_to_minus_y():
    assert has_its_head_at_the_horns(3.14159265)


def front_is_refused_without_a_plan():
    settings = bpy.context.scene.curveskel
    settings.plan, settings.front = "none", "x"
    refused("Front x needs a plan, and Plan none makes none", obj("cow", "meshes/free/spot-3k.obj"))
    settings.front = "auto"
    assert rig(obj("cow", "meshes/free/spot-3k.obj"))
    settings.plan = "auto"


run_laws(looks_to_y, looks_to_minus_y, front_is_refused_without_a_plan)
