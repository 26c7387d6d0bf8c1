"""From the program's weights to vertex groups."""

import bpy

from .armatures import MADE
from .program import ProgramError

MIRRORED_WRONG = 0.02  # share of a mirror's vertices; rigs of both sides are not quite alike


def made_groups(thing, old_bones):
    """Names of the groups that the add-on made: those that it noted, and those of its bones, which
    may have been renamed since."""
    return set(thing.get(MADE, ())) | old_bones


def is_locked(thing, name):
    group = thing.vertex_groups.get(name)
    return group is not None and group.lock_weight


def check_own(thing, names, old_bones):
    """Groups of the user's that a bone would take."""
    made = made_groups(thing, old_bones)
    own = [name for name in dict.fromkeys(names)
           if name in thing.vertex_groups and name not in made and not is_locked(thing, name)]
    if own:
        raise ProgramError(
            f"{thing.name} has vertex groups of its own with names of bones: "
            f"{', '.join(own[:5])}{' ...' if len(own) > 5 else ''}; rename or remove them, choose "
            "other Names, or lock them to keep their weights for these bones")


def bones_by_joint(rig, names):
    """Each joint's bone: where it has none, that of the next joint above; None without any."""
    found = []
    for joint, name in zip(rig["joints"], names):
        parent = joint["parent"]
        found.append(name or (found[parent] if parent >= 0 else None))
    return found


def check_mirrored(thing, rows, rig, names):
    """A mirror gives its vertices the groups of their originals, by names of the other side: so a
    side's bones must be those of the other, renamed."""
    own = len(thing.data.vertices)
    if len(rows) <= own:
        return
    bones = bones_by_joint(rig, names)
    weights = rig["weights"]

    def strongest(row):
        values = weights["values"][row]
        return bones[weights["joints"][row][values.index(max(values))]]

    reached = {strongest(row) for row in rows[:own]}
    if all(modifier.use_mirror_vertex_groups for modifier in thing.modifiers
           if modifier.type == "MIRROR" and modifier.show_viewport):
        reached |= {bpy.utils.flip_name(name) for name in reached if name}
    wrong = [name for name in map(strongest, rows[own:]) if name not in reached]
    if len(wrong) > MIRRORED_WRONG * (len(rows) - own):
        raise ProgramError(
            f"{thing.name}: its mirror modifier would move the half that it makes with the other "
            f"half's bones, as it gives nothing to {max(set(wrong), key=wrong.count)}; apply it, "
            "or turn its Vertex Groups on and choose Names that Blender mirrors: auto, rigify, "
            "vrm, unreal, unity or godot")


def fill(thing, rows, rig, names, old_bones):
    """Groups of these names in place of those that the add-on made before. Others stay, and so do
    locked ones: what they leave of a vertex is shared out. None in `names` = moves with the joint's
    parent."""
    wanted = dict.fromkeys(name for name in names if name)
    for name in made_groups(thing, old_bones) | set(wanted):
        if name in thing.vertex_groups and not is_locked(thing, name):
            thing.vertex_groups.remove(thing.vertex_groups[name])
    groups = {name: thing.vertex_groups.get(name) or thing.vertex_groups.new(name=name)
              for name in wanted}
    locked = {group.index for group in groups.values() if group.lock_weight}
    bones = bones_by_joint(rig, names)
    for vertex in thing.data.vertices:
        row = rows[vertex.index]
        shares = {}
        for joint, share in zip(rig["weights"]["joints"][row], rig["weights"]["values"][row]):
            name = bones[joint]
            if share > 0 and name and not groups[name].lock_weight:
                shares[name] = shares.get(name, 0) + share
        kept = sum(entry.weight for entry in vertex.groups if entry.group in locked)
        part = max(0, 1 - kept) / sum(shares.values()) if locked and shares else 1
        for name, share in shares.items():
            if part > 0:
                groups[name].add([vertex.index], share * part, "REPLACE")
    thing[MADE] = [name for name in wanted if not groups[name].lock_weight]
