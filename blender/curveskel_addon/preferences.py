"""The path of the program."""

import bpy

from . import program


class CurveskelPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program", subtype="FILE_PATH",
        description="The program curveskel; empty: the one on the PATH")

    def draw(self, _context):
        self.layout.prop(self, "program")
        self.layout.operator("curveskel.test_program")


def wanted_program(context):
    """The path that the user has set, or ''."""
    addon = context.preferences.addons.get(__package__)
    return bpy.path.abspath(addon.preferences.program) if addon else ""


class CURVESKEL_OT_test_program(bpy.types.Operator):
    bl_idname = "curveskel.test_program"
    bl_label = "Test"
    bl_description = "Ask the program for its version"

    def execute(self, context):
        try:
            self.report({"INFO"}, program.version(wanted_program(context)))
        except program.ProgramError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


CLASSES = (CurveskelPreferences, CURVESKEL_OT_test_program)
