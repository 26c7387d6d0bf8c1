"""For all laws inside Blender: the add-on installed in an empty scene, bodies, buttons."""

import pathlib
import sys
import tempfile
import traceback

import bpy
from mathutils import Matrix

folder = pathlib.Path(sys.argv[-2])
source = pathlib.Path(sys.argv[-1])
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_install(filepath=str(folder / "curveskel.zip"))
bpy.ops.preferences.addon_enable(module="curveskel_addon")


def mesh_object(name, places, faces):
    data = bpy.data.meshes.new(name)
    data.from_pydata(places, [], faces)
    thing = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(thing)
    return thing


def off(file):
    lines = file.read_text().split("\n")
    vertices, faces = map(int, lines[1].split()[:2])
    return ([tuple(map(float, line.split())) for line in lines[2:2 + vertices]],
            [tuple(map(int, line.split()[1:4]))
             for line in lines[2 + vertices:2 + vertices + faces]])


def obj(name, file):
    # y is up in the file, z here
    rows = [line.split() for line in (source / file).read_text().splitlines()]
    places = [tuple(map(float, row[1:4])) for row in rows if row and row[0] == "v"]
    return mesh_object(name, [(x, -z, y) for x, y, z in places],
                       [[int(corner.split("/")[0]) - 1 for corner in row[1:]]
                        for row in rows if row and row[0] == "f"])


def select(*things):
    bpy.ops.object.select_all(action="DESELECT")
    for thing in things:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = things[0]


def y_shape():
    thing = mesh_object("y", *off(source / "meshes" / "y.off"))
    thing.data.materials.append(bpy.data.materials.new("skin"))
    thing.data.uv_layers.new(name="map")
    thing.shape_key_add(name="Basis")
    key = thing.shape_key_add(name="wide")
    for point in key.data:
        point.co.x *= 1.5
    thing.location = (0, 0, 3)
    thing.rotation_euler = (0.3, 0, 1)
    bpy.context.view_layer.update()
    return thing


def armature():
    return next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")


def check_weights(thing, bones):
    names = {group.index: group.name for group in thing.vertex_groups}
    for vertex in thing.data.vertices:
        row = [group for group in vertex.groups if names[group.group] in bones]
        assert abs(sum(group.weight for group in row) - 1) < 1e-4, (thing.name, vertex.index)


def world_places(thing):
    bpy.context.view_layer.update()
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return [shown.matrix_world @ vertex.co for vertex in shown.data.vertices]


def leftovers():
    return [file for file in pathlib.Path(tempfile.gettempdir()).glob("curveskel-*")]


def armatures():
    return [thing for thing in bpy.data.objects if thing.type == "ARMATURE"]


def cube(name, place, size=0.1):
    c = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    thing = mesh_object(name, [[size / 2 * w for w in corner] for corner in c],
                        [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
                         (1, 5, 7, 3)])
    thing.location = place
    bpy.context.view_layer.update()
    return thing


def empty(name):
    thing = bpy.data.objects.new(name, None)
    bpy.context.collection.objects.link(thing)
    return thing


def figure(half=False, name="figure"):
    # a human of sticks; half of it with a mirror
    middle = [(0, 0, 1.0), (0, 0, 1.2), (0, 0, 1.42), (0, 0, 1.55), (0, 0, 1.75)]
    side = [(0.12, 0, 0.95), (0.13, 0, 0.5), (0.13, 0, 0.08), (0.13, -0.16, 0.04),
            (0.2, 0, 1.42), (0.48, 0, 1.42), (0.74, 0, 1.42)]
    edges = [(0, 1), (1, 2), (2, 3), (3, 4)]
    for first in (5, 12):
        edges += [(0, first), (first, first + 1), (first + 1, first + 2), (first + 2, first + 3),
                  (2, first + 4), (first + 4, first + 5), (first + 5, first + 6)]
    data = bpy.data.meshes.new(name)
    data.from_pydata(middle + side + [(-x, y, z) for x, y, z in side], edges, [])
    thing = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(thing)
    select(thing)
    thing.modifiers.new("skin", "SKIN")
    for number, vertex in enumerate(data.skin_vertices[0].data):
        vertex.radius = [(0.13, 0.13, 0.12, 0.05, 0.1)[number] if number < 5 else 0.05] * 2
    data.skin_vertices[0].data[0].use_root = True
    thing.modifiers.new("smooth", "SUBSURF").levels = 2
    for modifier in ("skin", "smooth"):
        bpy.ops.object.modifier_apply(modifier=modifier)
    if half:
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.bisect(plane_co=(0, 0, 0), plane_no=(1, 0, 0), clear_inner=True)
        bpy.ops.object.mode_set(mode="OBJECT")
        thing.modifiers.new("mirror", "MIRROR")
    return thing


def rig(*things, names="auto"):
    bpy.context.scene.curveskel.names = names
    select(*things)
    assert bpy.ops.curveskel.rig() == {"FINISHED"}
    return next(modifier.object for modifier in things[0].modifiers
                if modifier.type == "ARMATURE")


def refused(words, *things, names="auto", verb="rig"):
    bpy.context.scene.curveskel.names = names
    select(*things)
    before = len(armatures())
    try:
        getattr(bpy.ops.curveskel, verb)()
    except RuntimeError as error:
        assert words in str(error) and "Traceback" not in str(error), error
    else:
        assert False, "not refused: " + words
    assert len(armatures()) == before and not leftovers()


def shown_places(thing):
    # with what modifiers add, in the world
    bpy.context.view_layer.update()
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    places = [shown.matrix_world @ vertex.co for vertex in shown.to_mesh().vertices]
    shown.to_mesh_clear()
    return places


def turned_places(made, bone, thing):
    made.pose.bones[bone].matrix_basis = Matrix.Rotation(0.9, 4, "X")
    places = shown_places(thing)
    made.pose.bones[bone].matrix_basis = Matrix.Identity(4)
    bpy.context.view_layer.update()
    return places


def far(places, others):
    return max((a - b).length for a, b in zip(places, others))


def vertices_in(thing, name):
    group = thing.vertex_groups[name].index
    return [vertex.index for vertex in thing.data.vertices
            if any(entry.group == group for entry in vertex.groups)]


def hang_from_bone(thing, made, bone):
    frame = thing.matrix_world.copy()
    thing.parent, thing.parent_type, thing.parent_bone = made, "BONE", bone
    bpy.context.view_layer.update()
    thing.matrix_world = frame
    bpy.context.view_layer.update()


def run_laws(*laws):
    # each in an empty scene; all that fail are named
    failed = []
    for law in laws:
        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)
        bpy.ops.outliner.orphans_purge(do_recursive=True)
        bpy.context.scene.frame_set(1)
        try:
            law()
        except Exception:
            traceback.print_exc()
            failed.append(law.__name__)
    sys.stderr.flush()
    assert not failed, failed
