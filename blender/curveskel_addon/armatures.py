"""From the program's rig to an armature, and from an armature to joints."""

import contextlib

import bpy
from mathutils import Matrix, Vector

END = "_end"
LEAST_BONE = 1e-4  # of the rig's size: Blender drops bones without length
ON_AXIS = 1e-4  # sine of the angle
SAME_PLACE = 1e-5  # of the numbers in a matrix
SKINS = ("ARMATURE", "GP_ARMATURE", "GREASE_PENCIL_ARMATURE")  # types of modifiers
MADE = "curveskel"  # custom property of armatures and bones that the add-on made


def is_near(a, b):
    size = max(1.0, *(abs(number) for row in b for number in row))
    return all(abs(x - y) <= SAME_PLACE * size
               for row, other in zip(a, b) for x, y in zip(row, other))


def has_side(name):
    return name.endswith((".L", ".R"))


def is_end(joints, number):
    """A joint at a tip, which moves nothing and shows how long its bone is."""
    joint = joints[number]
    if "axis" in joint:
        return joint.get("end", False)
    return END in joint["name"] and not any(other["parent"] == number for other in joints)


def tail_by_axis(place, axis, below):
    """The child on the joint's axis, else the mean child's distance along it. `below`: places of
    children by number."""
    ways = {child: there - place for child, there in below.items()}
    target = max(ways, key=lambda child: ways[child].normalized().dot(axis))
    way = ways[target].normalized()
    if way.dot(axis) > 0 and way.cross(axis).length < ON_AXIS:
        return below[target], target
    return place + axis * (sum(way.length for way in ways.values()) / len(ways)), None


def tail_by_names(joints, name, below, weight):
    """The child with most joints below it: of one in the middle a middle one. For rigs of programs
    that write no axes."""
    middle = [child for child in below if not has_side(joints[child]["name"])]
    choice = list(below) if has_side(name) or not middle else middle
    target = max(choice, key=lambda child: (weight[child], -child))
    return below[target], target


def tails(joints):
    """For each joint the end of its bone, and the joint that is there, or None."""
    places = [Vector(joint["position"]) for joint in joints]
    children = [[] for _ in joints]
    weight = [1] * len(joints)
    for number in reversed(range(len(joints))):
        parent = joints[number]["parent"]
        if parent >= 0:
            children[parent].append(number)
            weight[parent] += weight[number]
    size = max(max(place[axis] for place in places) - min(place[axis] for place in places)
               for axis in range(3)) or 1.0
    found = []
    for number, joint in enumerate(joints):
        place, parent = places[number], joint["parent"]
        below = {child: places[child] for child in reversed(children[number])}
        before = place - places[parent] if parent >= 0 else Vector((0, 0, size / 4))
        axis = Vector(joint.get("axis", before)).normalized()
        if not below:  # straight on
            tail, target = place + 0.5 * before.length * axis, None
        elif "axis" in joint:
            tail, target = tail_by_axis(place, axis, below)
        else:
            tail, target = tail_by_names(joints, joint["name"], below, weight)
        if (tail - place).length < LEAST_BONE * size:
            tail, target = place + Vector((0, 0, size / 50)), None
        found.append((tail, target))
    return found


def modifiers_of(thing):
    """Lists of modifiers: grease pencils have two."""
    return [thing.modifiers, *filter(None, [getattr(thing, "grease_pencil_modifiers", None)])]


def bending(thing):
    """The armatures whose bones give the object its shape, by modifiers or as their child."""
    found = [modifier.object for modifiers in modifiers_of(thing) for modifier in modifiers
             if modifier.type in SKINS and modifier.object]
    if thing.parent and thing.parent.type == "ARMATURE" and thing.parent_type == "ARMATURE":
        found.append(thing.parent)
    return list(dict.fromkeys(found))


def moving(thing):
    """The same, and the armature that moves it as a whole."""
    parent = thing.parent
    if parent and parent.type == "ARMATURE" and (thing.parent_type == "BONE" or MADE in parent):
        return list(dict.fromkeys([*bending(thing), parent]))
    return bending(thing)


@contextlib.contextmanager
def at_rest(context, armatures):
    """With the armatures in their rest position, and what hangs from their bones where it is
    then."""
    posed = [armature for armature in armatures if armature.data.pose_position != "REST"]
    try:
        for armature in posed:
            armature.data.pose_position = "REST"
        context.view_layer.update()
        yield
    finally:
        for armature in posed:
            armature.data.pose_position = "POSE"
        context.view_layer.update()


def new_armature(context, name, beside):
    """An empty one in a collection of that object in which it can be seen, else the scene's."""
    armature = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    armature[MADE] = True
    armature.show_in_front = True
    for collection in beside.users_collection:
        if collection.library is None and collection.override_library is None:
            collection.objects.link(armature)
            if armature.visible_get(view_layer=context.view_layer):
                return armature
            collection.objects.unlink(armature)
    context.scene.collection.objects.link(armature)
    return armature


def remove(armature):
    data = armature.data
    bpy.data.objects.remove(armature)
    if data.users == 0:
        bpy.data.armatures.remove(data)


def made_bones(data):
    """Names of the bones that the add-on made and that still deform; others are the user's own."""
    return {bone.name for bone in data.bones if MADE in bone and bone.use_deform}


def users_own(armature):
    """In words, the first thing in it that the user added and that would go with it; None without
    any."""
    made = made_bones(armature.data)
    bones = [bone.name for bone in armature.data.bones if bone.name not in made]
    if bones:
        return f"bone {bones[0]}"
    for animation in (armature.animation_data, armature.data.animation_data):
        if animation and (animation.action or animation.nla_tracks or animation.drivers):
            return "animation"
    for part in (armature, *armature.pose.bones):
        if part.constraints:
            return f"constraints of {part.name}"
    for bone in armature.pose.bones:
        if bone.custom_shape:
            return f"shape of {bone.name}"
        if not is_near(bone.matrix_basis, Matrix.Identity(4)):
            return f"pose of {bone.name}"
    return None


def is_needed(armature):
    """By a child, a constraint, a driver of something else."""
    places = bpy.types.Collection, bpy.types.Scene, bpy.types.Screen
    users = bpy.data.user_map(subset=[armature])[armature]
    return any(user != armature and not isinstance(user, places) for user in users)


def set_bones(context, armature, rig):
    """The rig's bones, which are in the world's coordinates, in place of those that the add-on made
    before. Returns their names by joint, None for tips. If anything fails, the armature is as it
    was."""
    data, before = armature.data, armature.data.copy()
    context.view_layer.objects.active = armature
    try:
        bpy.ops.object.mode_set(mode="EDIT")
        names = edit_bones(armature, rig["joints"], made_bones(before))
        bpy.ops.object.mode_set(mode="OBJECT")
    except BaseException:
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        armature.data = before
        bpy.data.armatures.remove(data)
        raise
    bpy.data.armatures.remove(before)
    return names


def edit_bones(armature, joints, old):
    edit = armature.data.edit_bones
    own_parents = {bone.name: bone.parent.name for bone in edit if bone.name not in old
                   and bone.parent}
    for name in old:
        edit.remove(edit[name])
    to_armature = armature.matrix_world.inverted_safe()
    bones = [None] * len(joints)
    ends = tails(joints)
    for number, joint in enumerate(joints):
        if is_end(joints, number):
            continue
        bone = bones[number] = edit.new(joint["name"])
        bone[MADE] = True
        bone.head = to_armature @ Vector(joint["position"])
        bone.tail = to_armature @ ends[number][0]
        parent = joint["parent"]
        if parent >= 0:
            bone.parent = bones[parent]
            bone.use_connect = ends[parent][1] == number
        along_front = abs((ends[number][0] - Vector(joint["position"])).normalized().y) > 0.9
        bone.align_roll(to_armature.to_3x3() @ Vector((0, 0, 1) if along_front else (0, -1, 0)))
    for name, parent in own_parents.items():
        if edit[name].parent is None and parent in edit:
            edit[name].parent = edit[parent]
    return [bone.name if bone else None for bone in bones]


def joints_of(armature):
    """The bones that deform, as joints in the world; tips for those without such a child."""
    frame = armature.matrix_world
    bones = [bone for bone in armature.data.bones if bone.use_deform]
    number = {bone.name: index for index, bone in enumerate(bones)}
    joints = []
    for bone in bones:
        above = bone.parent
        while above and above.name not in number:
            above = above.parent
        joints.append({"name": bone.name, "parent": number[above.name] if above else -1,
                       "position": list(frame @ bone.head_local)})
    has_child = {joint["parent"] for joint in joints}
    for bone in bones:
        if number[bone.name] not in has_child:
            joints.append({"name": bone.name + END, "parent": number[bone.name],
                           "position": list(frame @ bone.tail_local)})
    return joints
