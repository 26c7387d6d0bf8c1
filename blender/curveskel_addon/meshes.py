"""From the scene's meshes to a file for the program."""

import array
import contextlib
import hashlib

from .program import ProgramError

SAME_PLACE = 1e-6  # of the coordinates


def shown_mirrors(thing):
    return [modifier for modifier in thing.modifiers
            if modifier.type == "MIRROR" and modifier.show_viewport]


@contextlib.contextmanager
def only_mirrors(thing):
    """The object at its shape keys' basis, with none of its modifiers but mirrors."""
    shown = [(modifier, modifier.show_viewport) for modifier in thing.modifiers]
    pinned, key = thing.show_only_shape_key, thing.active_shape_key_index
    try:
        for modifier, _ in shown:
            if modifier.type != "MIRROR":
                modifier.show_viewport = False
        if thing.data.shape_keys:
            thing.active_shape_key_index = 0
            thing.show_only_shape_key = True
        yield
    finally:
        for modifier, was_shown in shown:
            modifier.show_viewport = was_shown
        if thing.data.shape_keys:
            thing.active_shape_key_index = key
            thing.show_only_shape_key = pinned


def basis(thing):
    keys = thing.data.shape_keys
    return keys.reference_key.data if keys else thing.data.vertices


def own_mesh(thing):
    """Vertices and faces as the object has them, without shape keys."""
    return ([point.co.copy() for point in basis(thing)],
            [tuple(polygon.vertices) for polygon in thing.data.polygons])


def mirror_settings(thing):
    return [(*modifier.use_axis, *modifier.use_bisect_axis, *modifier.use_bisect_flip_axis,
             modifier.use_mirror_merge and modifier.merge_threshold, modifier.mirror_object
             and [tuple(row) for row in modifier.mirror_object.matrix_world])
            for modifier in shown_mirrors(thing)]


def digest(thing):
    """Of all that the program gets of it, but for its place."""
    mesh = thing.data
    found = hashlib.sha256(repr(mirror_settings(thing)).encode())
    for items, name, kind, size in ((basis(thing), "co", "f", 3),
                                    (mesh.loops, "vertex_index", "i", 1),
                                    (mesh.polygons, "loop_total", "i", 1)):
        numbers = array.array(kind, bytes(4 * size * len(items)))
        items.foreach_get(name, numbers)
        found.update(numbers)
    return found.digest()


def merge_reach(thing):
    """Distance by which mirrors may move vertices at a seam: to the middle of the two that they
    join."""
    return sum(0.5 * modifier.merge_threshold * sum(modifier.use_axis)
               for modifier in shown_mirrors(thing) if modifier.use_mirror_merge)


def whole_mesh(context, thing):
    """The same with what mirrors add, as half a body is no body; and whether the object's own
    vertices come first in it."""
    own, faces = own_mesh(thing)
    if not shown_mirrors(thing):
        return own, faces, True
    with only_mirrors(thing):
        shown = thing.evaluated_get(context.evaluated_depsgraph_get())
        mesh = shown.to_mesh()
        places = [vertex.co.copy() for vertex in mesh.vertices]
        all_faces = [tuple(polygon.vertices) for polygon in mesh.polygons]
        shown.to_mesh_clear()
    near = merge_reach(thing) + SAME_PLACE * max([1.0, *(abs(c) for place in own for c in place)])
    comes_first = len(places) >= len(own) and all((a - b).length <= near
                                                  for a, b in zip(own, places))
    return places, all_faces, comes_first


def write_obj(context, things, file, for_weights):
    """All objects as one OBJ file, in the world's coordinates. Returns, for each, the numbers of
    its vertices in it; weights need the object's own first, those that mirrors make last."""
    rows = []
    count = 0
    with open(file, "w", encoding="ascii") as out:
        for thing in things:
            places, faces, own_first = whole_mesh(context, thing)
            if for_weights and not own_first:
                raise ProgramError(
                    f"{thing.name}: its mirror modifier {shown_mirrors(thing)[0].name} cuts the "
                    "mesh, so that weights would have no vertices to go to; turn its Bisect off, "
                    "or apply it")
            for place in places:
                x, y, z = thing.matrix_world @ place
                out.write(f"v {x!r} {y!r} {z!r}\n")
            for face in faces:
                out.write("f " + " ".join(str(count + vertex + 1) for vertex in face) + "\n")
            rows.append(range(count, count + len(places)))
            count += len(places)
    return rows
