"""The actions of the panel's buttons. Each runs the program beside Blender; Escape ends it."""

import json

import bpy

from . import armatures, curves, groups, meshes, parents
from .preferences import wanted_program
from .program import JOINTS, SURFACE, Job, ProgramError

SAME_PLACE = 1e-6  # of the numbers in a matrix


def selected_meshes(context):
    return [thing for thing in context.selected_objects if thing.type == "MESH"]


class Taken:
    """An object as the program gets it. Its name and file are kept, as the scene may change while
    the program runs."""

    def __init__(self, thing, rows=None):
        self.key = thing.name, thing.library.filepath if thing.library else None
        self.frame = thing.matrix_world.copy()
        self.state = self.state_of(thing)
        self.rows = rows

    @staticmethod
    def state_of(thing):
        if thing.type == "ARMATURE":
            return [(bone.name, bone.parent and bone.parent.name, bone.use_deform,
                     tuple(bone.head_local), tuple(bone.tail_local)) for bone in thing.data.bones]
        return meshes.digest(thing)

    def unchanged(self, context):
        """The object, if it is as it was."""
        thing = bpy.data.objects.get(self.key)
        if thing is None or thing.name not in context.view_layer.objects:
            raise ProgramError(f"{self.key[0]} has gone meanwhile; run it again")
        size = max(abs(number) for row in self.frame for number in row)
        is_there = all(abs(a - b) <= SAME_PLACE * size
                       for row, now in zip(self.frame, thing.matrix_world)
                       for a, b in zip(row, now))
        if not is_there or self.state_of(thing) != self.state:
            raise ProgramError(f"{self.key[0]} has changed meanwhile; run it again")
        return thing


def check_local(things):
    for thing in things:
        if thing.library or thing.data.library:
            raise ProgramError(
                f"{thing.name} is linked from {(thing.library or thing.data.library).filepath} "
                "and cannot be changed here; Object > Relations > Make Local > Selected Objects "
                "and Data, or rig it in its own file")


def own_data(things):
    """Vertex groups belong to meshes, bones to armatures' data: objects that share these get their
    own. Returns their names."""
    split = []
    for thing in things:
        if any(other.data == thing.data and other != thing for other in bpy.data.objects):
            thing.data = thing.data.copy()
            split.append(thing.name)
    return split


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
        self.job = None
        is_started = False
        try:
            self.job = Job(wanted_program(context))
            self.prepare(context)
            is_started = True
        except ProgramError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            if self.job and not is_started:
                self.job.close()
        manager = context.window_manager
        self.timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type not in ("ESC", "TIMER"):
            return {"PASS_THROUGH"}
        came = {"CANCELLED"}
        try:
            came = self.step(context, event)
        except ProgramError as error:
            self.report({"ERROR"}, str(error))
        finally:
            if came != {"RUNNING_MODAL"}:
                self.cancel(context)
        return came

    def step(self, context, event):
        if event.type == "ESC":
            self.report({"INFO"}, "cancelled")
            return {"CANCELLED"}
        if not self.job.is_done():
            context.workspace.status_text_set(f"Curveskel: {self.job.stage()}   (Escape ends it)")
            return {"RUNNING_MODAL"}
        if context.mode != "OBJECT":
            raise ProgramError("the result came while Blender was in another mode; run it again "
                               "and stay in object mode")
        self.finish(context)
        return {"FINISHED"}

    def cancel(self, context):
        """The end, however it came; Blender calls it when another file is opened."""
        self.job.close()
        context.window_manager.event_timer_remove(self.timer)
        if context.workspace:
            context.workspace.status_text_set(None)

    def write_meshes(self, context, for_weights=True):
        things = selected_meshes(context)
        rows = meshes.write_obj(context, things, self.job.folder / SURFACE, for_weights)
        if not any(thing.data.polygons for thing in things):
            raise ProgramError("the selected meshes have no faces; select one that has, or apply "
                               "the modifiers that make them")
        self.taken = [Taken(thing, own) for thing, own in zip(things, rows)]

    def unchanged(self, context):
        return [taken.unchanged(context) for taken in self.taken]

    def skin(self, context, armature, hanging, rig, names, old=(), old_bones=frozenset()):
        """Groups, parents and modifiers of the objects; tells the user of what they might not
        expect. `old`: armatures that the add-on made before, and their bones."""
        things = [before.thing for before in hanging]
        split = own_data(things)
        for thing, taken in zip(things, self.taken):
            groups.fill(thing, taken.rows, rig, names, old_bones)
            parents.add_modifier(thing, armature, old)
        kept = parents.hang(context, hanging, armature, old)
        if split:
            self.report({"INFO"}, f"{', '.join(split)}: with a mesh of its own now, as weights "
                                  "belong to it")
        if kept:
            self.report({"WARNING"}, f"{', '.join(thing.name for thing in kept)}: parents kept, so "
                                     f"they move with the bones of {armature.name}, not with the "
                                     "object")

    def tell(self, made):
        """The end, and all that the program warned of: the status bar shows the last of these."""
        warnings = self.job.warnings()
        count = len(warnings)
        said = f", {count} warning{'s' if count > 1 else ''}" if warnings else ""
        self.report({"INFO"}, made + said)
        for number, warning in enumerate(warnings, 1):
            self.report({"WARNING"}, f"{number} of {count}: {warning}" if count > 1 else warning)

    def result(self, name):
        return json.loads((self.job.folder / name).read_text())


def kept_first(old):
    """Of armatures that become one the first stays: that in which the user added something."""
    own = {armature: armatures.users_own(armature) for armature in old}
    changed = [armature for armature in old if own[armature]]
    if len(changed) > 1:
        said = " and ".join(f"{armature.name} ({own[armature]})" for armature in changed[:2])
        raise ProgramError(
            f"{said} would become one armature, and what you added to one of them would go; clear "
            "that, or select the meshes of one armature only")
    return sorted(old, key=lambda armature: armature not in changed)


def check_whole(context, old, things):
    """Bones of these armatures are replaced: all that moves with them must be there."""
    for armature in old:
        if armature.library or armature.data.library:
            raise ProgramError(f"{armature.name} is linked from another file; rig it there")
        if not armature.visible_get(view_layer=context.view_layer):
            raise ProgramError(f"{armature.name}, whose bones would be replaced, is hidden; "
                               "show it")
        for thing in bent_with([armature]):
            if thing.type == "MESH" and thing not in things:
                raise ProgramError(f"{thing.name} moves with {armature.name}, too, whose bones "
                                   "would be replaced; select it as well")


def bent_with(old):
    return [thing for thing in bpy.data.objects
            if thing.users_scene and not set(old).isdisjoint(armatures.bending(thing))]


def check_bent(old, old_bones, names):
    """Lattices and grease pencils go on with groups of the same names; curves and texts have none,
    as they go by envelopes."""
    for thing in bent_with(old):
        gone = [group.name for group in thing.vertex_groups
                if group.name in old_bones and group.name not in names]
        if thing.type != "MESH" and gone:
            raise ProgramError(
                f"{thing.name} moves, too, with bones that would go: {', '.join(gone[:5])}"
                f"{' ...' if len(gone) > 5 else ''}; choose Names as before, or rename or remove "
                "these vertex groups of its own first")


class CURVESKEL_OT_rig(RunsProgram, bpy.types.Operator):
    bl_idname = "curveskel.rig"
    bl_label = "Rig"
    bl_description = ("Give the selected meshes an armature with weights, all of them together; "
                      "bones that this button made before are replaced")

    def old_armatures(self, context, things):
        """Those that the add-on made; with another one the objects are rigged already."""
        check_local(things)
        found = []
        for thing in things:
            for armature in armatures.moving(thing):
                if armatures.MADE not in armature:
                    raise ProgramError(
                        f"{thing.name} moves with {armature.name} already: select that, too, for "
                        "Weights Only, or remove the armature modifier and clear the parent first")
                found.append(armature)
        found = kept_first(dict.fromkeys(found))
        check_whole(context, found, things)
        return found

    def prepare(self, context):
        old = self.old_armatures(context, selected_meshes(context))
        with armatures.at_rest(context, old):
            self.write_meshes(context)
        settings = context.scene.curveskel
        self.job.start("rig", SURFACE, "-o", "out.json", "--bare", "--up", settings.up,
                       "--front", settings.front, "--plan", settings.plan,
                       "--names", settings.names, "--follow", f"{settings.follow:.6g}",
                       "--softness", f"{settings.softness:.6g}",
                       "--detail", f"{settings.detail:.6g}")

    def finish(self, context):
        rig = self.result("out.json")
        things = [bpy.data.objects.get(taken.key) for taken in self.taken]
        old = self.old_armatures(context, [thing for thing in things if thing])
        old_bones = set().union(*(armatures.made_bones(each.data) for each in old))
        with armatures.at_rest(context, old):
            things = self.unchanged(context)
            self.refuse_wrong(things, rig, old, old_bones)
        own_data(old[:1])  # outside: the data that it leaves to others must not stay at rest
        with armatures.at_rest(context, old):
            armature = old[0] if old else armatures.new_armature(
                context, self.taken[0].key[0] + " rig", things[0])
            try:
                names = self.take(context, armature, things, rig, old, old_bones)
            except BaseException:
                if not old:
                    armatures.remove(armature)
                raise
        self.remove_unneeded(old[1:])
        count = len([name for name in names if name])
        self.tell(f"{count} bones in place of the former ones of {armature.name}" if old
                  else f"{count} bones")

    def remove_unneeded(self, old):
        for armature in old:
            if armatures.is_needed(armature):
                self.report({"WARNING"}, f"{armature.name} bends no mesh any more; it stays, as "
                                         "other objects need it")
            else:
                armatures.remove(armature)

    def refuse_wrong(self, things, rig, old, old_bones):
        joints = rig["joints"]
        names = [None if armatures.is_end(joints, number) else joint["name"]
                 for number, joint in enumerate(joints)]
        for thing, taken in zip(things, self.taken):
            groups.check_own(thing, [name for name in names if name], old_bones)
            groups.check_mirrored(thing, taken.rows, rig, names)
        check_bent(old, old_bones, names)

    def take(self, context, armature, things, rig, old, old_bones):
        hanging = [parents.Hanging(thing) for thing in things]
        others = [parents.Hanging(child) for child in armature.children if child not in things]
        bent = [parents.Hanging(thing) for thing in bent_with(old) if thing.type != "MESH"]
        names = armatures.set_bones(context, armature, rig)
        for child in others:
            child.stay(context)
        for before in bent:
            parents.go_over(context, before, armature, old)
        if not old:
            parents.take_parent(context, armature, things)
        self.skin(context, armature, hanging, rig, names, old, old_bones)
        return names


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

    @staticmethod
    def refuse_others(things, armature):
        check_local(things)
        for thing in things:
            for other in armatures.moving(thing):
                if other != armature:
                    raise ProgramError(f"{thing.name} moves with {other.name} already; remove "
                                       "that armature modifier and clear the parent first")

    def prepare(self, context):
        armature = self.armature(context)
        self.refuse_others(selected_meshes(context), armature)
        joints = armatures.joints_of(armature)
        if not joints:
            raise ProgramError(f"{armature.name} has no bone that deforms")
        with armatures.at_rest(context, [armature]):
            self.write_meshes(context)
            self.taken_armature = Taken(armature)
        (self.job.folder / JOINTS).write_text(json.dumps({"joints": joints}))
        self.job.start("rig", SURFACE, "-o", "out.json", "--bare", "--joints", JOINTS,
                       "--softness", f"{context.scene.curveskel.softness:.6g}")

    def finish(self, context):
        rig = self.result("out.json")
        armature = self.taken_armature.unchanged(context)
        bones = {bone.name for bone in armature.data.bones if bone.use_deform}
        names = [joint["name"] if joint["name"] in bones else None for joint in rig["joints"]]
        with armatures.at_rest(context, [armature]):
            things = self.unchanged(context)
            self.refuse_others(things, armature)
            for thing, taken in zip(things, self.taken):
                groups.check_mirrored(thing, taken.rows, rig, names)
            hanging = [parents.Hanging(thing) for thing in things]
            self.skin(context, armature, hanging, rig, names)
        self.tell(f"weights for {len(bones)} bones")


class CURVESKEL_OT_skeleton(RunsProgram, bpy.types.Operator):
    bl_idname = "curveskel.skeleton"
    bl_label = "Skeleton as Curves"
    bl_description = "The curve skeleton of the selected meshes, as thick as its inscribed balls"

    def prepare(self, context):
        self.write_meshes(context, for_weights=False)
        self.job.start("extract", SURFACE, "-o", "out.json",
                       "--detail", f"{context.scene.curveskel.detail:.6g}")

    def finish(self, context):
        skeleton = self.result("out.json")
        curves.build_curve(context, skeleton, self.taken[0].key[0] + " skeleton")
        self.tell(f"{len(skeleton['nodes'])} nodes")


CLASSES = (CURVESKEL_OT_rig, CURVESKEL_OT_weights, CURVESKEL_OT_skeleton)
