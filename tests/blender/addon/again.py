"""Rig again: its own bones and groups are replaced, all else stays."""

import bpy
from mathutils import Matrix
from scene import (armatures, check_weights, cube, empty, far, figure, hang_from_bone, refused,
                   rig, run_laws, select, shown_places, vertices_in)


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


def apart():
    # a body and a hat with an armature each
    body, hat = figure(), cube("hat", (0, 0, 1.9))
    return body, rig(body), hat, rig(hat)


def add_control(made):
    select(made)
    bpy.ops.object.mode_set(mode="EDIT")
    control = made.data.edit_bones.new("my_control")
    control.head, control.tail, control.use_deform = (0, -0.5, 1), (0, -0.7, 1), False
    bpy.ops.object.mode_set(mode="OBJECT")
    made.pose.bones["my_control"].constraints.new("LIMIT_ROTATION")


def add_action(made):
    made.pose.bones[0].keyframe_insert("location", frame=1)


def add_constraint(made):
    made.pose.bones[0].constraints.new("LIMIT_ROTATION")


def add_pose(made):
    made.pose.bones[0].rotation_quaternion = (0.9, 0.1, 0, 0)


def what_the_user_added_stays_where_parts_come_together():
    for add in (add_control, add_action, add_constraint, add_pose):
        body, first, hat, second = apart()
        add(second)
        assert rig(body, hat) == second and skins(body) == skins(hat) == [second], add
        assert armatures() == [second], add
        check_weights(body, {bone.name for bone in second.data.bones})
        if add == add_control:
            assert len(second.pose.bones["my_control"].constraints) == 1
        if add == add_action:
            assert second.animation_data.action
        for thing in (body, hat, second):
            bpy.data.objects.remove(thing)


def two_armatures_that_the_user_changed_are_refused():
    body, first, hat, second = apart()
    add_control(second)
    add_action(first)
    before = [len(made.data.bones) for made in (first, second)]
    refused("my_control", body, hat)
    assert [len(made.data.bones) for made in (first, second)] == before
    assert skins(body) == [first] and skins(hat) == [second]


def an_armature_that_others_need_stays():
    body, first, hat, second = apart()
    light = empty("light")
    light.constraints.new("CHILD_OF").target = second
    assert rig(body, hat) == first
    assert light.constraints[0].target == second and second in armatures()


def meshes_that_deform_as_children_are_not_broken():
    body, hat = figure(), cube("hat", (0, 0, 1.9))
    made = rig(body)
    bones = [bone.name for bone in made.data.bones]
    hat.parent, hat.parent_type = made, "ARMATURE"
    hat.vertex_groups.new(name="head").add(range(8), 1, "REPLACE")
    refused("hat moves with", body, names="neutral")
    assert [bone.name for bone in made.data.bones] == bones
    rig(body, hat, names="neutral")
    assert hat.parent_type == "OBJECT" and skins(hat) == [made]


def bent_by(made, data, name, as_child=False):
    thing = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(thing)
    if as_child:
        thing.parent, thing.parent_type = made, "ARMATURE"
    else:
        thing.modifiers.new("bend", "ARMATURE").object = made
    return thing


def curves_texts_and_lattices_go_on():
    body, made, hat, other = apart()
    curve = bent_by(other, bpy.data.curves.new("curve", "CURVE"), "curve")
    text = bent_by(other, bpy.data.curves.new("text", "FONT"), "text", as_child=True)
    cage = bent_by(made, bpy.data.lattices.new("cage"), "cage")
    cage.vertex_groups.new(name="hips").add(range(8), 1, "REPLACE")
    text.location = (0, 0, 2)
    bpy.context.view_layer.update()
    frame = text.matrix_world.copy()
    assert rig(body, hat) == made and armatures() == [made]
    assert skins(curve) == skins(cage) == [made]
    assert text.parent == made and text.parent_type == "ARMATURE"
    assert far(frame, text.matrix_world) < 1e-5
    # Not with bones of other names: the lattice's groups would have none.
    refused("cage", body, hat, names="mixamo")
    assert "hips" in made.data.bones
    cage.vertex_groups.clear()
    assert rig(body, hat, names="mixamo") == made


run_laws(rig_again_replaces_bones_and_groups, posed_and_moved_bodies_are_rigged_where_they_are,
         locked_groups_stay, other_armatures_and_bodies_are_not_broken,
         parts_that_were_rigged_apart_come_together, groups_of_the_users_own_are_not_taken,
         a_linked_duplicate_of_a_character_is_left_alone,
         what_the_user_added_stays_where_parts_come_together,
         two_armatures_that_the_user_changed_are_refused, an_armature_that_others_need_stays,
         meshes_that_deform_as_children_are_not_broken, curves_texts_and_lattices_go_on)
