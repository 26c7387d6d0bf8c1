"""Curveskel in Blender: joints, weights and curve skeletons for the selected meshes, made by the
program `curveskel`, which is installed on its own."""

bl_info = {
    "name": "Curveskel",
    "author": "curveskel",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Curveskel",
    "description": "Rigs, skin weights and curve skeletons of any mesh",
    "category": "Rigging",
}

import bpy

from . import operators, panel, preferences

CLASSES = (*preferences.CLASSES, *operators.CLASSES, *panel.CLASSES)


def register():
    for entry in CLASSES:
        bpy.utils.register_class(entry)
    bpy.types.Scene.curveskel = bpy.props.PointerProperty(type=panel.CurveskelSettings)


def unregister():
    del bpy.types.Scene.curveskel
    for entry in reversed(CLASSES):
        bpy.utils.unregister_class(entry)
