"""blender --background --python docs/characters.py -- PROGRAM OUT.png FILE.glb...

Rigs the files, poses each as in a step, and draws them on one sheet: the picture of docs/rigging.md.
Needs Blender and Pillow.
"""

import math
import pathlib
import subprocess
import sys
import tempfile

import bpy
import numpy
from mathutils import Matrix, Vector

# Debian's importer of glTF asks numpy for names that its numpy has no more.
numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object
SIDE = 420  # pixels

# Of names of joints: turns in degrees about the world's axes, x to the figure's left, y to its
# back, z up. Arms are held out at first, in humans.
STEP = {
    "upper_leg.L": "x-32", "lower_leg.L": "x18", "upper_leg.R": "x22", "lower_leg.R": "x38",
    "upper_arm.L": "y62 x24", "lower_arm.L": "x-28", "upper_arm.R": "y-62 x-24",
    "lower_arm.R": "x-40", "spine": "z-6", "chest": "z9", "head": "z12 x-4",
    "thigh.L": "x-22", "shin.L": "x14", "thigh.R": "x20", "shin.R": "x16",
    "front_thigh.R": "x-26", "front_shin.R": "x22", "front_thigh.L": "x20", "front_shin.L": "x10",
    "neck": "z10", "tail": "z14", "tail.001": "z16", "tail.002": "z16", "tail.003": "z16",
    "wing_1.L": "y-14", "wing_3.L": "y-12", "wing_1.R": "y14", "wing_3.R": "y12"}


def turn(bone, words):
    for word in words.split():
        rotation = Matrix.Rotation(math.radians(float(word[1:])), 4, word[0].upper())
        head = Matrix.Translation(bone.head)
        bone.matrix = head @ rotation @ head.inverted() @ bone.matrix
        bpy.context.view_layer.update()


def pose(armature):
    names = {bone.name for bone in armature.pose.bones}
    for name, words in STEP.items():
        if name in names:
            turn(armature.pose.bones[name], words)
    if not names & STEP.keys():  # no plan: all bones of the middle sway
        for bone in armature.pose.bones:
            if not bone.name.endswith((".L", ".R")):
                turn(bone, "z7")


def corners():
    graph = bpy.context.evaluated_depsgraph_get()
    places = []
    for thing in bpy.data.objects:
        if thing.type == "MESH" and thing.users_scene and thing.visible_get():
            shown = thing.evaluated_get(graph)
            places += [shown.matrix_world @ vertex.co for vertex in shown.to_mesh().vertices]
            shown.to_mesh_clear()
    return numpy.array(places)


def draw(file):
    scene = bpy.context.scene
    places = corners()
    low, high = places.min(axis=0), places.max(axis=0)
    middle = Vector((low + high) / 2)
    direction = Vector((0.75, -1, 0.35)).normalized()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    camera.data.type = "ORTHO"
    camera.rotation_euler = direction.to_track_quat("Z", "Y").to_euler()
    away = numpy.linalg.norm(high - low)
    camera.location = middle + direction * float(2 * away)
    camera.data.clip_end = float(6 * away)
    bpy.context.view_layer.update()
    frame = numpy.array(camera.matrix_world.inverted())
    seen = places @ frame[:3, :3].T + frame[:3, 3]
    extent = seen.max(axis=0) - seen.min(axis=0)
    centre = (seen.max(axis=0) + seen.min(axis=0)) / 2
    camera.location += camera.matrix_world.to_3x3() @ Vector((centre[0], centre[1], 0))
    camera.data.ortho_scale = float(1.06 * max(extent[:2]))
    for strength, way in ((1.9, (0.6, -1, 0.9)), (0.7, (-1, -0.4, 0.3))):
        light = bpy.data.objects.new("light", bpy.data.lights.new("light", "SUN"))
        light.data.energy = strength
        light.rotation_euler = Vector(way).to_track_quat("Z", "Y").to_euler()
        scene.collection.objects.link(light)
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (1, 1, 1, 1)
    scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0.5
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 12
    scene.cycles.use_denoising = False
    scene.view_settings.view_transform = "Standard"
    scene.render.film_transparent = True
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    scene.render.filepath = str(file)
    bpy.ops.render.render(write_still=True)


def main(program, out, *files):
    from PIL import Image
    across = math.ceil(math.sqrt(1.5 * len(files)))
    down = math.ceil(len(files) / across)
    sheet = Image.new("RGB", (across * SIDE, down * SIDE), (226, 226, 226))
    with tempfile.TemporaryDirectory() as place:
        for number, file in enumerate(files):
            rig, picture = pathlib.Path(place) / "rig.glb", pathlib.Path(place) / "picture.png"
            subprocess.run([program, "rig", file, "-o", rig, "-q"], check=True)
            bpy.ops.wm.read_factory_settings(use_empty=True)
            bpy.ops.import_scene.gltf(filepath=str(rig))
            armature = next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")
            for thing in bpy.data.objects:
                if "Icosphere" in thing.name:  # the importer's shape for bones
                    thing.hide_render = True
                    thing.hide_set(True)
            pose(armature)
            draw(picture)
            drawn = Image.open(picture).convert("RGBA")
            sheet.paste(drawn, (number % across * SIDE, number // across * SIDE), drawn)
    sheet.quantize(200).save(out, optimize=True)


main(*sys.argv[sys.argv.index("--") + 1:])
