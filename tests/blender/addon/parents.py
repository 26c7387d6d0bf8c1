"""Objects stay where they are, and with the parents that they have."""

import bpy
from mathutils import Matrix, Vector
from scene import (cube, empty, far, figure, hang_from_bone, rig, run_laws, select, shown_places,
                   turned_places)


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
