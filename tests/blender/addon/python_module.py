"""The add-on and the Python module of the program's name, both in one Blender."""

import bpy
from scene import rig, y_shape

assert rig(y_shape()).data.bones
import curveskel

assert curveskel.__version__ == "of the Python module", curveskel.__file__
assert "bl_info" not in vars(curveskel)
assert "curveskel_addon" in bpy.context.preferences.addons
