"""From the program's rig to an armature and vertex groups, and from an armature to joints."""

import bpy
from mathutils import Vector

END = "_end"
LEAST_BONE = 1e-4  # of the rig's size: Blender drops bones without length
ON_AXIS = 1e-4  # sine of the angle


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
