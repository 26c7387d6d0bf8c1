"""Objects under an armature: as its children or as those of what they had, with its modifier."""

import bpy
from mathutils import Matrix

from .armatures import SKINS, is_near, modifiers_of


def frame_above(thing):
    """That of its parent as it takes it over: its matrix in the world without its own."""
    if thing.parent is None:
        return Matrix.Identity(4)
    if thing.parent_type == "OBJECT":
        return thing.parent.matrix_world @ thing.matrix_parent_inverse
    return thing.matrix_world @ thing.matrix_basis.inverted_safe()


class Hanging:
    """An object's link to its parent, and its place in the world, to be kept when the parent
    changes."""

    def __init__(self, thing):
        self.thing = thing
        self.parent, self.type = thing.parent, thing.parent_type
        self.bone, self.vertices = thing.parent_bone, tuple(thing.parent_vertices)
        self.inverse = thing.matrix_parent_inverse.copy()
        self.above, self.frame = frame_above(thing), thing.matrix_world.copy()

    def move(self, context, parent):
        """Gives it that parent without a change of its own location, rotation and scale, so that
        animations stay right and shear stays. Returns False, with all as it was, if it would be
        elsewhere then."""
        thing = self.thing
        thing.parent_type = "OBJECT"
        thing.parent = parent
        thing.matrix_parent_inverse = parent.matrix_world.inverted_safe() @ self.above
        context.view_layer.update()
        return self.is_reached() or self.undo(context)

    def is_reached(self):
        return is_near(self.thing.matrix_world, self.frame)

    def undo(self, context):
        thing = self.thing
        thing.parent_type = "OBJECT"
        thing.parent = self.parent
        thing.parent_type = self.type
        thing.parent_bone = self.bone
        thing.parent_vertices = self.vertices
        thing.matrix_parent_inverse = self.inverse
        context.view_layer.update()
        return False

    def stay(self, context):
        """Puts it back to its place after its bone was replaced or removed."""
        thing = self.thing
        if self.type == "BONE" and self.bone not in self.parent.data.bones:
            return self.move(context, self.parent)
        inverse = thing.matrix_parent_inverse
        thing.matrix_parent_inverse = (
            inverse @ frame_above(thing).inverted_safe() @ self.above)
        context.view_layer.update()
        return self.is_reached() or self.undo(context)


def ancestors(thing):
    while thing.parent:
        thing = thing.parent
        yield thing


def link_to(thing, movers):
    """Going up from it, the parent type by which the first of these objects is met; None without
    one."""
    while thing.parent:
        if thing.parent in movers:
            return thing.parent_type
        thing = thing.parent
    return None


def take_parent(context, armature, things):
    """The parent that all these objects have in common becomes the armature's."""
    outer = [thing for thing in things if link_to(thing, things) is None]
    parents = {thing.parent for thing in outer}
    if len(parents) == 1 and None not in parents and all(
            thing.parent_type == "OBJECT" for thing in outer):
        Hanging(armature).move(context, parents.pop())


def hang(context, hanging, armature, old):
    """Objects that hang so under the armature, where they were, also from old armatures. What hangs
    from another of these objects, or from a parent that the armature has not, keeps it; the latter
    are returned."""
    kept = []
    above = set(ancestors(armature))
    leaving = set(old) - {armature}
    movers = {armature, *(before.thing for before in hanging)}
    for before in hanging:
        thing = before.thing
        link = link_to(thing, movers)
        if link == "OBJECT" or thing in above:
            continue
        may_move = link is not None or thing.parent is None or thing.parent in leaving or (
            thing.parent in above and thing.parent_type == "OBJECT")
        if not may_move or not before.move(context, armature):
            kept.append(thing)
    return kept


def switch_modifiers(thing, armature, old):
    """One armature modifier in place of those of old armatures. Returns whether there is one."""
    has_one = False
    for modifiers in modifiers_of(thing):
        skins = [modifier for modifier in modifiers if modifier.type in SKINS]
        has_one = has_one or any(modifier.object == armature for modifier in skins)
        for modifier in skins:
            if modifier.object in old and modifier.object != armature:
                if has_one:
                    modifiers.remove(modifier)
                else:
                    modifier.object = armature
                    has_one = True
    return has_one


def go_over(context, before, armature, old):
    """An object that is no mesh bends with this armature as it did with old ones."""
    switch_modifiers(before.thing, armature, old)
    if before.type == "ARMATURE" and before.parent in old and before.parent != armature and \
            before.move(context, armature):
        before.thing.parent_type = "ARMATURE"


def add_modifier(thing, armature, old):
    """An armature modifier in place of those of old armatures. A new one comes before what makes
    more vertices of the skinned ones, but after mirrors."""
    if switch_modifiers(thing, armature, old):
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
