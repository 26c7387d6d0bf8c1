"""blender --background --python blender/to_fbx.py -- RIG.glb OUT.fbx

A rig as FBX, by Blender: bones, weights, shape keys, materials with their pictures inside.
"""

import sys

import bpy
import numpy

# Debian's importer of glTF asks numpy for names that its numpy has no more.
for name, kind in (("bool", bool), ("int", int), ("float", float), ("object", object)):
    if name not in vars(numpy):
        setattr(numpy, name, kind)


def main(source, target):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=source)
    for thing in list(bpy.data.objects):
        if thing.name.startswith("Icosphere"):  # the importer's shape for bones
            bpy.data.objects.remove(thing)
    bpy.ops.export_scene.fbx(filepath=target, add_leaf_bones=False, path_mode="COPY",
                             embed_textures=True)


main(*sys.argv[sys.argv.index("--") + 1:])
