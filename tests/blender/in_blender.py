"""Runs a script in Blender."""

import json
import os
import shutil
import subprocess


# Importers of Blender 3.4 know names that numpy has dropped.
START = """
import json, pathlib, sys
import bpy, numpy
numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object

def open_scene(file):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if file.suffix == ".fbx":
        bpy.ops.import_scene.fbx(filepath=str(file), anim_offset=0)
    elif file.suffix == ".dae":
        bpy.ops.wm.collada_import(filepath=str(file))
    else:
        bpy.ops.import_scene.gltf(filepath=str(file))
"""


def result_of(script, folder):
    """The content of result.json, which the script writes; it begins with what START has."""
    (folder / "script.py").write_text(START + script)
    environment = {**os.environ, "PATH": "/usr/local/bin:/usr/bin:/bin"}
    done = subprocess.run(
        [shutil.which("blender"), "--background", "--python-exit-code", "1", "--python",
         folder / "script.py", "--", folder], capture_output=True, text=True,
        stdin=subprocess.DEVNULL, env=environment, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stdout[-2000:] + done.stderr[-2000:])
    return json.loads((folder / "result.json").read_text())
