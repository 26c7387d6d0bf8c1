"""What the panel's buttons do. Each runs the program beside Blender; Escape ends it."""

import json

import bpy

from . import armatures, curves, meshes
from .preferences import wanted_program
from .program import Job, ProgramError


def selected_meshes(context):
    return [thing for thing in context.selected_objects if thing.type == "MESH"]


class RunsProgram:
    """An operator that starts a job, waits, and takes what came of it: in the window with a timer,
    else at once. `prepare` starts the job, `finish` takes the result."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and bool(selected_meshes(context))

    def execute(self, context):
        try:
            with Job(wanted_program(context)) as self.job:
                self.prepare(context)
                self.job.wait()
                self.finish(context)
        except ProgramError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def invoke(self, context, _event):
        try:
            self.job = Job(wanted_program(context))
        except ProgramError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        try:
            self.prepare(context)
        except ProgramError as error:
            self.job.close()
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        manager = context.window_manager
        self.timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.end(context)
            self.report({"INFO"}, "cancelled")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            if not self.job.is_done():
                context.workspace.status_text_set(
                    f"Curveskel: {self.job.stage()}   (Escape ends it)")
                return {"RUNNING_MODAL"}
            self.finish(context)
        except ProgramError as error:
            self.end(context)
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.end(context)
        return {"FINISHED"}

    def end(self, context):
        context.window_manager.event_timer_remove(self.timer)
        context.workspace.status_text_set(None)
        self.job.close()

    def write_meshes(self, context, for_weights=True):
        # Names, as the scene may change while the program runs.
        self.things = [thing.name for thing in selected_meshes(context)]
        things = [bpy.data.objects[name] for name in self.things]
        rows = meshes.write_obj(context, things, self.job.folder / "in.obj", for_weights)
        self.firsts = [own.start for own in rows]
        self.counts = [len(thing.data.vertices) for thing in things]

    def rigged_things(self):
        """The meshes, if they are as they were."""
        for name, first, count in zip(self.things, self.firsts, self.counts):
            thing = bpy.data.objects.get(name)
            if thing is None or len(thing.data.vertices) != count:
                raise ProgramError(f"{name} has changed meanwhile; run it again")
            yield thing, first

    def result(self, name):
        return json.loads((self.job.folder / name).read_text())


class CURVESKEL_OT_rig(RunsProgram, bpy.types.Operator):
    bl_idname = "curveskel.rig"
    bl_label = "Rig"
    bl_description = "Give the selected meshes an armature with weights, all of them together"

    def prepare(self, context):
        self.write_meshes(context)
        settings = context.scene.curveskel
        self.job.start("rig", "in.obj", "-o", "out.json", "--bare", "--up", settings.up,
                       "--front", settings.front, "--plan", settings.plan,
                       "--names", settings.names, "--follow", f"{settings.follow:.6g}",
                       "--softness", f"{settings.softness:.6g}",
                       "--detail", f"{settings.detail:.6g}")

    def finish(self, context):
        rig = self.result("out.json")
        things = list(self.rigged_things())
        armature, names = armatures.build_armature(context, rig, self.things[0] + " rig")
        for thing, first in things:
            armatures.fill_groups(thing, first, rig, names)
            armatures.bind(thing, armature)
        self.report({"INFO"}, f"{len([name for name in names if name])} bones")


class CURVESKEL_OT_weights(RunsProgram, bpy.types.Operator):
    bl_idname = "curveskel.weights"
    bl_label = "Weights Only"
    bl_description = ("Weights of the selected meshes for the selected armature: bones stay as "
                      "they are")

    @classmethod
    def poll(cls, context):
        return super().poll(context) and cls.armature(context) is not None

    @staticmethod
    def armature(context):
        return next((thing for thing in context.selected_objects if thing.type == "ARMATURE"),
                    None)

    def prepare(self, context):
        self.write_meshes(context)
        armature = self.armature(context)
        self.armature_name = armature.name
        joints = armatures.joints_of(armature)
        if not joints:
            raise ProgramError(f"{armature.name} has no bone that deforms")
        (self.job.folder / "joints.json").write_text(json.dumps({"joints": joints}))
        self.job.start("rig", "in.obj", "-o", "out.json", "--bare", "--joints", "joints.json",
                       "--softness", f"{context.scene.curveskel.softness:.6g}")

    def finish(self, context):
        rig = self.result("out.json")
        armature = bpy.data.objects.get(self.armature_name)
        if armature is None:
            raise ProgramError(f"{self.armature_name} has gone meanwhile; run it again")
        bones = {bone.name for bone in armature.data.bones if bone.use_deform}
        names = [joint["name"] if joint["name"] in bones else None for joint in rig["joints"]]
        for thing, first in list(self.rigged_things()):
            armatures.fill_groups(thing, first, rig, names)
            armatures.bind(thing, armature)
        self.report({"INFO"}, f"weights for {len(bones)} bones")


class CURVESKEL_OT_skeleton(RunsProgram, bpy.types.Operator):
    bl_idname = "curveskel.skeleton"
    bl_label = "Skeleton as Curves"
    bl_description = "The curve skeleton of the selected meshes, as thick as its inscribed balls"

    def prepare(self, context):
        self.write_meshes(context, for_weights=False)
        self.job.start("extract", "in.obj", "-o", "out.json",
                       "--detail", f"{context.scene.curveskel.detail:.6g}")

    def finish(self, context):
        skeleton = self.result("out.json")
        curves.build_curve(context, skeleton, self.things[0] + " skeleton")
        self.report({"INFO"}, f"{len(skeleton['nodes'])} nodes")


CLASSES = (CURVESKEL_OT_rig, CURVESKEL_OT_weights, CURVESKEL_OT_skeleton)
