"""Clicks in a window: a run that Escape ends, then one that comes to its end, with the panel
drawn."""

import os
import sys
import time
import traceback

import bpy
from scene import armatures, folder, leftovers, select, y_shape
from curveskel_addon.panel import CURVESKEL_PT_panel

bpy.context.preferences.view.show_splash = False
bpy.context.preferences.use_preferences_save = False
drawn = []
draw = CURVESKEL_PT_panel.draw
bpy.utils.unregister_class(CURVESKEL_PT_panel)
CURVESKEL_PT_panel.bl_category = "Item"  # the tab that is open
CURVESKEL_PT_panel.draw = lambda self, context: drawn.append(draw(self, context))
bpy.utils.register_class(CURVESKEL_PT_panel)


def press(window, key, x=400, y=400):
    window.event_simulate(type=key, value="PRESS", x=x, y=y)
    window.event_simulate(type=key, value="RELEASE", x=x, y=y)


def steps():
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    area.spaces[0].show_region_ui = True
    body = y_shape()
    select(body)
    slow = folder / "slow"
    slow.write_text("#!/bin/sh\necho 'contract ...' >&2\nexec sleep 60\n")
    slow.chmod(0o755)
    preferences = bpy.context.preferences.addons["curveskel_addon"].preferences
    preferences.program = str(slow)
    with bpy.context.temp_override(window=window, area=area, region=region):
        assert bpy.ops.curveskel.rig("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield 1
    assert leftovers(), "the run goes on"
    press(window, "ESC")
    yield 1
    assert not leftovers() and not armatures(), "Escape ends it and leaves nothing"
    preferences.program = ""
    with bpy.context.temp_override(window=window, area=area, region=region):
        assert bpy.ops.curveskel.rig("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    begin = time.monotonic()
    while not armatures() and time.monotonic() < begin + 30:
        yield 0.2
    yield 0.5
    assert len(armatures()) == 1 and not leftovers()
    assert drawn, "the panel was not drawn"
    # The user goes on while the program runs: a result for what has changed is not taken.
    slow.write_text(f"#!/bin/sh\nwhile [ ! -e {folder}/go ]; do sleep 0.1; done\n"
                    "exec curveskel \"$@\"\n")
    preferences.program = str(slow)
    from curveskel_addon import armatures as module
    tails = module.tails
    for change in ("edit mode", "moved", "deleted", "error"):
        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)
        body = y_shape()
        with bpy.context.temp_override(window=window, area=area, region=region):
            select(body)
            assert bpy.ops.curveskel.rig("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
            if change == "edit mode":
                bpy.ops.object.mode_set(mode="EDIT")
        yield 0.2
        if change == "moved":
            body.location.x += 5
        if change == "deleted":
            bpy.data.objects.remove(body)
        if change == "error":
            module.tails = lambda joints: 1 / 0
        assert leftovers(), "the run goes on"
        (folder / "go").touch()
        begin = time.monotonic()
        while leftovers() and time.monotonic() < begin + 10:
            yield 0.2
        assert not leftovers(), change
        (folder / "go").unlink()
        assert not armatures(), change
        if change == "edit mode":
            assert bpy.context.mode == "EDIT_MESH"
            with bpy.context.temp_override(window=window, area=area, region=region):
                bpy.ops.object.mode_set(mode="OBJECT")
        if change in ("edit mode", "moved"):
            assert not body.vertex_groups and not body.modifiers and body.parent is None
    module.tails = tails
    bpy.ops.screen.screenshot({"window": window, "area": area, "screen": window.screen},
                              filepath=str(folder / "window.png"))
    assert (folder / "window.png").stat().st_size > 1000


running = steps()


def tick():
    try:
        return next(running)
    except StopIteration:
        os._exit(0)
    except BaseException:
        traceback.print_exc()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(1)


bpy.app.timers.register(tick, first_interval=1)
