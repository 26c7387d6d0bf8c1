"""Runs a script in Blender."""

import json
import os
import shutil
import subprocess


def result_of(script, folder):
    """The content of result.json, which Blender writes."""
    (folder / "script.py").write_text(script)
    environment = {**os.environ, "PATH": "/usr/local/bin:/usr/bin:/bin"}
    done = subprocess.run(
        [shutil.which("blender"), "--background", "--python-exit-code", "1", "--python",
         folder / "script.py", "--", folder], capture_output=True, text=True,
        stdin=subprocess.DEVNULL, env=environment, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stdout[-2000:] + done.stderr[-2000:])
    return json.loads((folder / "result.json").read_text())
