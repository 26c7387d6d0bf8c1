"""Meshes and armatures that other objects or files have, too."""

import bpy
from scene import (check_weights, cube, figure, folder, mesh_object, off, refused, rig, run_laws,
                   select, source, vertices_in)


def linked_duplicates_get_weights_of_their_own():
    body, left = figure(), cube("left", (0.73, 0, 1.42), 0.14)
    right, spare = (bpy.data.objects.new(name, left.data) for name in ("right", "spare"))
    for thing in (right, spare):
        bpy.context.collection.objects.link(thing)
    right.location = (-0.73, 0, 1.42)
    bpy.context.view_layer.update()
    rig(body, left, right)
    for thing, side in ((left, ".L"), (right, ".R")):
        names = [group.name for group in thing.vertex_groups if vertices_in(thing, group.name)]
        assert names and all(name.endswith(side) for name in names), (thing.name, names)
    assert not spare.vertex_groups


def link(path, **what):
    with bpy.data.libraries.load(str(path), link=True) as (_, wanted):
        for kind, names in what.items():
            setattr(wanted, kind, names)
    return wanted


def linked_objects_and_meshes_are_refused():
    hero = figure(name="hero")
    path = folder / "hero.blend"
    bpy.data.libraries.write(str(path), {hero})
    bpy.data.objects.remove(hero)
    local = mesh_object("hero", *off(source / "meshes" / "y.off"))
    linked = link(path, objects=["hero"]).objects[0]
    bpy.context.collection.objects.link(linked)
    bpy.context.view_layer.update()
    refused("is linked from", linked)
    assert not local.vertex_groups and local.parent is None and not local.modifiers
    twin = bpy.data.objects.new("twin", linked.data)
    bpy.context.collection.objects.link(twin)
    refused("is linked from", twin)
    select(linked)
    assert bpy.ops.curveskel.skeleton() == {"FINISHED"}  # changes nothing of it


def a_linked_armature_gives_weights():
    hero = figure(name="hero")
    made = rig(hero)
    hero.parent = None
    path = folder / "rig.blend"
    bpy.data.libraries.write(str(path), {made})
    name = made.name
    bpy.data.objects.remove(made)
    hero.modifiers.clear()
    hero.vertex_groups.clear()
    bpy.ops.outliner.orphans_purge(do_recursive=True)
    made = link(path, objects=[name]).objects[0]
    bpy.context.collection.objects.link(made)
    bpy.context.view_layer.update()
    select(hero, made)
    assert bpy.ops.curveskel.weights() == {"FINISHED"}
    check_weights(hero, {bone.name for bone in made.data.bones})
    refused("linked from", hero)  # by Rig, which would change its bones


run_laws(linked_duplicates_get_weights_of_their_own, linked_objects_and_meshes_are_refused,
         a_linked_armature_gives_weights)
