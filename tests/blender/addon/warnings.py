"""All that the program warns of is told, in words of the add-on; the test reads them."""

import bpy
from mathutils import Matrix
from scene import armatures, figure, obj, rig, run_laws, select

settings = bpy.context.scene.curveskel


def plan_that_is_not_there():
    settings.plan = "quadruped"
    rig(figure())
    settings.plan = "auto"


def names_without_words():
    rig(obj("cow", "meshes/free/spot-3k.obj"), names="mixamo")


def two_at_once():
    settings.plan = "quadruped"
    rig(figure(), names="mixamo")
    settings.plan = "auto"


def weights(frame):
    body = figure()
    made = rig(body)
    body.modifiers.clear()
    body.parent = None
    made.matrix_world = frame @ made.matrix_world
    bpy.context.view_layer.update()
    select(body, made)
    assert bpy.ops.curveskel.weights() == {"FINISHED"}


def armature_beside_the_body():
    weights(Matrix.Translation((0, 0, 1)))


def armature_too_small():
    weights(Matrix.Scale(0.01, 4))


run_laws(plan_that_is_not_there, names_without_words, two_at_once, armature_beside_the_body,
         armature_too_small)
