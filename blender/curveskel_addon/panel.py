"""The panel in the sidebar of the 3D view."""

import bpy

PLANS = [(name, name, meaning) for name, meaning in (
    ("auto", "found from the mesh"), ("none", "joints where the curve bends, no roles"),
    ("humanoid", "upright on one pair of legs, with arms"), ("quadruped", "on two pairs of legs"),
    ("bird", "on one pair of legs, with wings"),
    ("biped-with-tail", "on one pair of legs, leaning ahead of a tail"),
    ("fish", "a trunk with fins"), ("other", "none of these"))]
NAMES = [(name, name, meaning) for name, meaning in (
    ("auto", "readable, with .L and .R"), ("rigify", "Rigify's human or wolf"),
    ("vrm", "VRM 1.0"), ("mixamo", "Mixamo"), ("unreal", "Unreal's mannequin"),
    ("unity", "Unity"), ("godot", "Godot"), ("neutral", "joint_001 and so on"))]
AXES = [("auto", "auto", "found from the mesh"),
        *((name, name, "") for name in ("x", "y", "z", "-x", "-y", "-z"))]


class CurveskelSettings(bpy.types.PropertyGroup):
    plan: bpy.props.EnumProperty(name="Plan", items=PLANS, description="How the body is built")
    names: bpy.props.EnumProperty(name="Names", items=NAMES, description="What bones are called")
    up: bpy.props.EnumProperty(name="Up", items=AXES, default="z",
                               description="The body's up; auto also for bodies that lie")
    front: bpy.props.EnumProperty(name="Front", items=AXES, default="auto",
                                  description="Where the body looks")
    follow: bpy.props.FloatProperty(
        name="Followers", default=1.15, min=0, max=100, soft_max=5,
        description="Parts that reach out of the body no farther than this, in its thickness, "
                    "have no bones; 0: all have")
    softness: bpy.props.FloatProperty(
        name="Softness", default=0.5, min=0.05, max=20, soft_max=2,
        description="How gently the skin goes over from one bone to the next, in radii")
    detail: bpy.props.FloatProperty(
        name="Detail", default=0.5, min=0, max=1, description="How small a limb may be and stay")


class CURVESKEL_PT_panel(bpy.types.Panel):
    bl_label = "Curveskel"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Curveskel"

    def draw(self, context):
        settings = context.scene.curveskel
        layout = self.layout
        layout.use_property_split = True
        for name in ("plan", "names", "up", "front", "follow", "softness", "detail"):
            layout.prop(settings, name)
        layout.operator("curveskel.rig", icon="ARMATURE_DATA")
        layout.operator("curveskel.weights", icon="MOD_VERTEX_WEIGHT")
        layout.operator("curveskel.skeleton", icon="OUTLINER_OB_CURVE")


CLASSES = (CurveskelSettings, CURVESKEL_PT_panel)
