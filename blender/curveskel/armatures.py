"""From the program's rig to an armature and vertex groups, and from an armature to joints."""

import bpy
from mathutils import Vector

END = "_end"
LEAST_BONE = 1e-4  # of the rig's size: Blender drops bones without length


def has_side(name):
    return name.endswith((".L", ".R"))


def is_end(joints, number):
    """A joint at a tip, which moves nothing and shows how long its bone is."""
    return END in joints[number]["name"] and not any(joint["parent"] == number for joint in joints)


def tails(joints):
    """Where each joint's bone ends, and the joint that is there, or None."""
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
        middle = [child for child in children[number] if not has_side(joints[child]["name"])]
        choice = children[number] if has_side(joint["name"]) or not middle else middle
        target = max(choice, key=lambda child: (weight[child], -child), default=None)
        tail = places[target] if target is not None else None
        if tail is None:  # straight on
            parent = joint["parent"]
            way = places[number] - places[parent] if parent >= 0 else Vector((0, 0, size / 4))
            tail = places[number] + 0.5 * way
        if (tail - places[number]).length < LEAST_BONE * size:
            tail = places[number] + Vector((0, 0, size / 50))
            target = None
        found.append((tail, target))
    return found


def build_armature(context, rig, name):
    """An armature object of the rig, in the world's coordinates; the names of its bones by joint,
    None for tips."""
    joints = rig["joints"]
    data = bpy.data.armatures.new(name)
    thing = bpy.data.objects.new(name, data)
    context.collection.objects.link(thing)
    context.view_layer.objects.active = thing
    bpy.ops.object.mode_set(mode="EDIT")
    bones = [None] * len(joints)
    ends = tails(joints)
    for number, joint in enumerate(joints):
        if is_end(joints, number):
            continue
        bone = bones[number] = data.edit_bones.new(joint["name"])
        bone.head = joint["position"]
        bone.tail = ends[number][0]
        parent = joint["parent"]
        if parent >= 0:
            bone.parent = bones[parent]
            bone.use_connect = ends[parent][1] == number
        along_front = abs(bone.vector.normalized().y) > 0.9
        bone.align_roll(Vector((0, 0, 1) if along_front else (0, -1, 0)))
    names = [bone.name if bone else None for bone in bones]
    bpy.ops.object.mode_set(mode="OBJECT")
    thing.show_in_front = True
    return thing, names


def fill_groups(thing, first, rig, names):
    """The object's vertex groups of these names; others stay. `first` is its first vertex's number
    in the rig, None in `names` = moves with the joint's parent."""
    groups = {}
    for name in {name for name in names if name}:
        old = thing.vertex_groups.get(name)
        if old:
            thing.vertex_groups.remove(old)
    for name in names:
        if name and name not in groups:
            groups[name] = thing.vertex_groups.new(name=name)
    parents = [joint["parent"] for joint in rig["joints"]]
    for vertex in range(len(thing.data.vertices)):
        row = first + vertex
        for joint, share in zip(rig["weights"]["joints"][row], rig["weights"]["values"][row]):
            while joint >= 0 and names[joint] is None:
                joint = parents[joint]
            if share > 0 and joint >= 0:
                groups[names[joint]].add([vertex], share, "ADD")


def bind(thing, armature):
    """Moves with the armature, from where it is; an armature modifier is added if there is none,
    before what makes more vertices of the skinned ones (but after mirrors)."""
    frame = thing.matrix_world.copy()
    thing.parent = armature
    thing.matrix_world = frame
    own = [modifier for modifier in thing.modifiers if modifier.type == "ARMATURE"]
    if any(modifier.object == armature for modifier in own):
        return
    modifier = thing.modifiers.new("Armature", "ARMATURE")
    modifier.object = armature
    place = len(thing.modifiers) - 1
    before = 0
    for number, other in enumerate(thing.modifiers):
        if other.type in ("MIRROR", "ARMATURE") and other != modifier:
            before = number + 1
    while place > before:  # Blender 3.4 has no other way without a context
        thing.modifiers.move(place, place - 1) if hasattr(thing.modifiers, "move") else \
            bpy.ops.object.modifier_move_up({"object": thing}, modifier=modifier.name)
        place -= 1


def joints_of(armature):
    """The bones that deform, as joints in the world; tips for those without such a child. And the
    bone of each joint."""
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
