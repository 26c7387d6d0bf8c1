"""From the scene's meshes to a file for the program."""

import contextlib

SAME_PLACE = 1e-6  # of the coordinates


@contextlib.contextmanager
def only_mirrors(thing):
    """The object with none of its modifiers but mirrors: half a body is no body."""
    shown = [(modifier, modifier.show_viewport) for modifier in thing.modifiers]
    try:
        for modifier, _ in shown:
            if modifier.type != "MIRROR":
                modifier.show_viewport = False
        yield
    finally:
        for modifier, was_shown in shown:
            modifier.show_viewport = was_shown


def own_mesh(thing):
    """Vertices in the world and faces, without shape keys."""
    frame = thing.matrix_world
    return ([frame @ vertex.co for vertex in thing.data.vertices],
            [tuple(polygon.vertices) for polygon in thing.data.polygons])


def whole_mesh(context, thing):
    """The same with what mirrors add behind; the object's own where that moves its vertices."""
    own, faces = own_mesh(thing)
    if not any(modifier.type == "MIRROR" and modifier.show_viewport
               for modifier in thing.modifiers):
        return own, faces
    with only_mirrors(thing):
        shown = thing.evaluated_get(context.evaluated_depsgraph_get())
        mesh = shown.to_mesh()
        frame = thing.matrix_world
        places = [frame @ vertex.co for vertex in mesh.vertices]
        all_faces = [tuple(polygon.vertices) for polygon in mesh.polygons]
        shown.to_mesh_clear()
    near = SAME_PLACE * max([1.0, *(abs(c) for place in own for c in place)])
    is_own = len(places) >= len(own) and all((a - b).length <= near
                                             for a, b in zip(own, places))
    return (places, all_faces) if is_own else (own, faces)


def write_obj(context, things, file):
    """All objects as one OBJ file, in the world's coordinates. Returns, for each, the number of its
    first vertex in it."""
    firsts = []
    count = 0
    with open(file, "w", encoding="ascii") as out:
        for thing in things:
            places, faces = whole_mesh(context, thing)
            firsts.append(count)
            for place in places:
                out.write(f"v {place.x!r} {place.y!r} {place.z!r}\n")
            for face in faces:
                out.write("f " + " ".join(str(count + vertex + 1) for vertex in face) + "\n")
            count += len(places)
    return firsts
