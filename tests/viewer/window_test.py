"""The viewer's window, driven by keys and mouse as a person would."""

import json
import os
import pathlib
import shutil
import signal
import sys
import unittest

import numpy
from PIL import Image

SOURCE = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "tests" / "cli"))
from program import TORUS, Y, CommandLineTest, run, write_torus  # noqa: E402
from display import (Display, Window, ask_to_close, different, is_there,  # noqa: E402
                     until)
from drop import drop  # noqa: E402

DONE, DEVICE, INTERRUPTED = 0, 4, 130
CROSS = "v 0 0 0\nv 3 0 0\nv 0 1.2 0\nv -3 0 0\nv 0 -1 0\nl 1 2\nl 1 3\nl 1 4\nl 1 5\n"


def setUpModule():
    global display
    if not is_there():
        raise unittest.SkipTest("needs Xvfb and xdotool")
    display = Display()
    unittest.addModuleCleanup(display.close)


class WindowTest(CommandLineTest):
    def open(self, *words, **options):
        window = Window(display, self.folder, *words, **options)
        self.addCleanup(window.close)
        return window

    def opened(self, mesh=Y):
        """A window with a copy of this surface and its skeleton."""
        file = self.folder / mesh.name
        shutil.copy(mesh, file)
        window = self.open(file)
        window.wait_for_skeleton()
        return window

    def leave(self, window):
        window.key("ctrl+q")
        self.assertEqual(window.exit_code(), DONE)

    def save(self, window, name):
        """By Ctrl-S and a typed name; the file's bytes."""
        file = self.folder / name
        window.type_into_dialogue("ctrl+s", str(file))
        until(file.exists, f"{file}")
        return file.read_bytes()

    def counts(self, window, name):
        saved = json.loads(self.save(window, name))
        return len(saved["nodes"]), len(saved["edges"])


class Looking(WindowTest):
    def test_a_surface_becomes_its_skeleton(self):
        window = self.opened()
        self.assertIn("y.off", window.title())
        self.assertEqual(len(window.tips()), 4)
        self.leave(window)

    def test_drag_turns(self):
        window = self.opened()
        before = window.rest()
        middle = (window.width / 2, 300)
        window.move(*middle)
        display.xdotool("mousedown", 1)
        window.rest()  # the button is seen to be down before the mouse moves
        for step in range(1, 8):
            window.move(middle[0] + 12 * step, middle[1] + 5 * step)
        window.wait_for_change(before, 0.05)
        display.xdotool("mouseup", 1)
        turned = window.rest()
        window.move(middle[0], middle[1])
        window.rest()
        window.away()
        self.assertLess(different(window.rest(), turned), 0.01, "turns without the button")
        self.leave(window)

    def test_wheel_comes_nearer_and_f_fits(self):
        window = self.opened()
        window.away()
        before = window.rest()
        window.move(window.width / 2, 300)
        for _ in range(3):
            display.xdotool("click", 4)
        window.wait_for_change(before, 0.05)
        window.away()
        self.assertGreater(different(window.rest(), before), 0.05)
        window.key("f")
        window.wait_for_likeness(before)
        self.leave(window)

    def test_looks(self):
        window = self.opened()
        window.away()
        first = window.rest()
        for key, times in (("s", 4), ("k", 4), ("l", 2), ("e", 2)):
            for _ in range(times):
                window.changes(key, least=0.0005)
            # Back where it began.
            window.wait_for_likeness(first)
        self.leave(window)

    def test_sides(self):
        window = self.opened()
        window.away()
        first = window.changes("7", least=0.02)
        window.changes("3", least=0.02)
        window.changes("0", least=0.02)
        window.key("7")
        window.wait_for_likeness(first)
        self.leave(window)

    def test_help_comes_and_goes(self):
        window = self.opened()
        window.away()
        before = window.rest()
        window.changes("h", least=0.05)
        window.key("h")
        window.wait_for_likeness(before)
        self.leave(window)

    def test_panels_go_and_come_back(self):
        window = self.opened()
        before = window.rest(window.whole)
        without = window.changes("p", see=window.whole)
        left = numpy.s_[:600, :window.side()]
        self.assertGreater(different(without[left], before[left]), 0.2)
        with_them = window.changes("p", see=window.whole)
        self.assertLess(different(with_them[left], before[left]), 0.01)
        self.leave(window)

    def test_tab_leads_into_the_panels_and_escape_back(self):
        window = self.opened()
        before = window.rest(window.whole)
        window.key("Tab")
        window.wait_for_change(before, 0.0001, window.whole)
        window.key("Home")  # for the panels
        window.rest(window.whole)
        self.assertIn("(skeleton)", window.title())
        dialogue = window.changes("space", least=0.05, see=window.whole)  # presses "Open"
        window.changes("Escape", least=0.05, see=window.whole)
        self.assertGreater(different(dialogue, before), 0.05)
        window.key("Escape")
        window.key("Home")
        window.wait_for_title(r"\(input\)")
        self.leave(window)

    def test_parts_drawn_anew_fit_those_that_are_not(self):
        window = self.opened()
        window.away()
        for key in ("h", "Home", "h", "l", "ctrl+o", "Escape", "End", "s"):
            window.key(key)
            window.rest(window.above_status)
        before = window.rest(window.above_status)
        for width in (window.width + 8, window.width):  # draws all anew
            display.xdotool("windowsize", "--sync", window.id, width, window.height)
            window.rest(window.above_status)
        self.assertEqual(different(window.rest(window.above_status), before), 0)
        self.leave(window)

    def test_pictures_of_windows_of_all_sizes(self):
        window = self.opened()
        sizes = []
        for number, size in enumerate(((1000, 700), (700, 420), (1200, 900), (330, 250)), 1):
            if number > 1:
                before = window.whole()
                display.xdotool("windowsize", "--sync", window.id, *size)
                window.wait_for_change(before, see=window.whole)
                window.width, window.height = size
            window.rest(window.whole)
            window.key("F12")
            file = self.folder / f"y-view-{number}.png"
            until(file.exists, f"{file}")
            with Image.open(file) as picture:
                sizes.append(picture.size)
                pixels = numpy.asarray(picture.convert("RGB")).astype(int)
            self.assertGreater(pixels.max() - pixels.min(), 100)
            # The picture ends where the panels begin.
            self.assertAlmostEqual(sizes[-1][0], size[0] - 2 * window.side(), delta=2)
        self.assertEqual(len(set(sizes)), len(sizes))
        self.leave(window)


class Timeline(WindowTest):
    def test_scrubbing(self):
        window = self.opened()
        window.key("Left")
        window.wait_for_title(r"\(surgery\)")
        window.key("Left")
        last = int(window.wait_for_title(r"\(contraction (\d+)\)")[1])
        window.key("Left")
        window.wait_for_title(rf"\(contraction {last - 1}\)")
        window.key("Right")
        window.wait_for_title(rf"\(contraction {last}\)")
        window.key("Home")
        window.wait_for_title(r"\(input\)")
        start = window.rest()
        window.key("End")
        window.wait_for_title(r"\(skeleton\)")
        self.assertGreater(different(window.rest(), start), 0.005)
        self.leave(window)

    def long_run(self):
        """Hundreds of moments, so that keys come in the middle."""
        file = write_torus(self.folder / "torus.ply", 200, 80)
        window = self.open(file, "--fair", 400)
        window.wait_for_title("fairing .*running")
        return window

    def test_pausing_and_going_on(self):
        window = self.long_run()
        window.key("space")
        at = int(window.wait_for_title(r"fairing (\d+), paused")[1])
        window.rest()
        window.wait_for_title(rf"fairing {at}, paused")
        window.key("Right")
        window.wait_for_title(rf"fairing {at + 1}, paused")
        window.key("Left")
        window.wait_for_title(rf"fairing {at}, paused")
        window.key("space")
        window.wait_for_title("fairing .*running")
        window.wait_for_skeleton()
        self.leave(window)

    def test_stepping_from_the_input(self):
        window = self.open(Y, "--no-run")
        window.wait_for_title(r"\(input\)")
        for number in (0, 1, 2):
            window.key("Right")
            window.wait_for_title(rf"contraction {number}, paused")
        window.key("space")
        window.wait_for_skeleton()
        self.leave(window)

    def test_cancelled_and_run_again(self):
        window = self.long_run()
        window.key("Escape")
        window.wait_for_title(r"fairing \d+\)")
        window.key("space")
        window.wait_for_skeleton()
        self.leave(window)


class Correcting(WindowTest):
    def test_pruning_undoing_and_redoing_what_was_extracted(self):
        window = self.opened()
        first = self.save(window, "first.json")
        nodes, edges = (len(json.loads(first)[what]) for what in ("nodes", "edges"))
        window.click(*window.tips()[0])
        window.changes("Delete")
        pruned = self.counts(window, "pruned.json")
        self.assertEqual(pruned[0] - pruned[1], 1)  # a tree as before
        self.assertLess(pruned[0], nodes - 5)
        window.changes("ctrl+z")
        self.assertEqual(self.save(window, "undone.json"), first)
        window.changes("ctrl+y")
        self.assertEqual(self.counts(window, "redone.json"), pruned)
        window.changes("ctrl+z")
        window.changes("ctrl+shift+z")
        self.assertEqual(self.counts(window, "again.json"), pruned)
        self.assertLess(pruned[1], edges)
        self.leave(window)

    def test_leaving_asks_for_what_is_not_saved(self):
        window, tips, _ = self.cross()
        window.click(*tips[0])
        window.changes("Delete", least=0.0005)
        window.changes("ctrl+q")
        window.changes("Escape")
        self.assertEqual(self.counts(window, "pruned.json")[1], 3)
        window.click(*tips[2])
        window.changes("Delete", least=0.0005)
        before = window.rest()
        ask_to_close(display.name, int(window.id))
        window.wait_for_change(before, 0.002)
        window.key("d")
        self.assertEqual(window.exit_code(), DONE)

    def test_saving_when_asked_leaves_once_it_is_saved(self):
        window, tips, middle = self.cross()
        window.click(*tips[0])
        window.changes("Delete", least=0.0005)
        window.move(*middle)  # where something is described
        window.changes("ctrl+q")
        window.changes("s", least=0.05)
        window.key("ctrl+a")
        file = self.folder / "kept.json"
        display.xdotool("type", "--delay", 5, str(file))
        window.key("Return")
        self.assertEqual(window.exit_code(), DONE)
        self.assertEqual(len(json.loads(file.read_bytes())["edges"]), 3)

    def test_rig_comes_by_a_key_and_is_saved(self):
        window = self.opened()
        window.key("g")
        window.wait_for_title(r"\(rig\)")
        self.assertEqual(self.save(window, "y.glb")[:4], b"glTF")
        window.key("Left")
        window.wait_for_title(r"\(skeleton\)")
        self.leave(window)

    def cross(self):
        file = self.folder / "cross.obj"
        file.write_text(CROSS)
        window = self.open(file)
        window.wait_for_title(r"cross\.obj")
        tips = window.tips()
        middle = (tips[2][0], tips[0][1])
        self.assertEqual(self.counts(window, "cross.json"), (5, 4))
        return window, tips, middle

    def test_cutting_and_joining(self):
        window, tips, middle = self.cross()
        window.click((tips[0][0] + middle[0]) / 2, middle[1])
        window.changes("c", least=0.0005)
        self.assertEqual(self.counts(window, "cut.json")[1], 3)
        window.changes("ctrl+z", least=0.0005)
        self.assertEqual(self.counts(window, "undone.json"), (5, 4))
        window.click(*tips[0])
        window.click(*tips[2], shift=True)
        window.changes("j", least=0.0005)
        self.assertEqual(self.counts(window, "joined.json"), (5, 5))
        self.leave(window)

    def test_merging(self):
        window, tips, _ = self.cross()
        window.click(*tips[0])
        window.click(*tips[2], shift=True)
        window.changes("m", least=0.0005)
        self.assertEqual(self.counts(window, "merged.json")[0], 4)
        self.leave(window)

    def test_splitting_and_removing(self):
        window, tips, middle = self.cross()
        halfway = ((tips[0][0] + middle[0]) / 2, middle[1])
        window.click(*halfway)
        window.key("n")
        self.assertEqual(self.counts(window, "split.json"), (6, 5))
        window.click(*halfway)
        window.key("BackSpace")
        self.assertEqual(self.counts(window, "removed.json"), (5, 4))
        self.leave(window)

    def test_moving_a_node(self):
        window, tips, _ = self.cross()
        window.move(*tips[0])
        window.rest()
        display.xdotool("keydown", "ctrl", "mousedown", 1)
        window.rest()
        window.move(tips[0][0] - 40, tips[0][1] + 60)
        window.rest()
        display.xdotool("mouseup", 1, "keyup", "ctrl")
        window.away()
        moved = json.loads(self.save(window, "moved.json"))
        before = json.loads((self.folder / "cross.json").read_bytes())
        changed = [i for i, (a, b) in enumerate(zip(before["nodes"], moved["nodes"]))
                   if numpy.abs(numpy.subtract(a, b)).max() > 0.1]
        self.assertEqual(len(changed), 1)
        self.assertEqual(moved["edges"], before["edges"])
        self.leave(window)

    def test_a_file_is_not_replaced_unasked(self):
        window, tips, _ = self.cross()
        window.click(*tips[0])
        window.changes("Delete", least=0.0005)
        before = (self.folder / "cross.json").read_bytes()
        window.type_into_dialogue("ctrl+s", str(self.folder / "cross.json"))
        window.changes("Return", least=0.05)  # the answer that is marked: keep it
        self.assertEqual((self.folder / "cross.json").read_bytes(), before)
        self.assertEqual(self.counts(window, "other.json")[1], 3)
        self.leave(window)

    def test_names_without_a_format_are_refused(self):
        window, _, _ = self.cross()
        before = self.files()
        window.type_into_dialogue("ctrl+s", str(self.folder / "cross.txt"))
        until(lambda: is_red(window), "a message that it is refused")
        self.assertEqual(self.files(), before)
        self.leave(window)


def is_red(window):
    """Whether a message of something that went wrong stands in the window."""
    seen = window.whole()
    return (numpy.abs(seen - (170, 35, 30)).max(axis=2) < 40).sum() > 500


class Files(WindowTest):
    def test_that_cannot_be_read_leave_the_window(self):
        broken = self.folder / "broken.off"
        broken.write_text("OFF\n3 1 0\n0 0 0\n1 0")
        for file in (self.folder / "missing.off", broken):
            window = self.open(file)
            until(lambda: is_red(window), "a message of what is wrong")
            self.leave(window)

    def test_are_opened_by_name(self):
        window = self.open()
        window.type_into_dialogue("ctrl+o", str(TORUS))
        window.wait_for_title(r"torus\.off .*\(skeleton\)$")
        self.leave(window)

    def test_dropped_on_the_window_are_opened(self):
        window = self.open()
        for name in ("dropped.off", "a name, 100 % größer.off"):
            file = self.folder / name
            shutil.copy(Y, file)
            self.assertTrue(drop(display.name, int(window.id), [file]))
            window.wait_for_title(rf"{name} .*\(skeleton\)$")
        skeleton = self.folder / "cross.obj"
        skeleton.write_text(CROSS)
        self.assertTrue(drop(display.name, int(window.id), [TORUS, skeleton]))
        window.wait_for_title(r"torus\.off - cross\.obj")
        self.leave(window)

    def test_dropped_that_cannot_be_read_are_a_message(self):
        broken = self.folder / "broken.off"
        broken.write_bytes(bytes(range(256)))
        for bad in ([broken], [self.folder], [self.folder / "missing.off"], [Y, TORUS]):
            with self.subTest(bad):
                window = self.opened()
                drop(display.name, int(window.id), bad)
                until(lambda: is_red(window), "a message of what is wrong")
                self.assertRegex(window.title(), r"y\.off \(skeleton\)$")
                self.leave(window)

    def test_keys_that_follow_a_dialogue_at_once_are_for_the_picture(self):
        window = self.opened()
        for number in range(3):
            file = self.folder / f"saved-{number}.json"
            window.key_at_once("ctrl+s", "ctrl+a", text=file, then=["Return", "Home"])
            window.wait_for_title(r"\(input\)")
            until(file.exists, f"{file}")
            window.key("End")
            window.wait_for_skeleton()
        for key, title in (("Home", "input"), ("End", "skeleton")):
            window.key_at_once("ctrl+o", text="any", then=["Escape", key])
            window.wait_for_title(rf"\({title}\)")
        self.leave(window)

    def test_are_read_again_when_they_change(self):
        file = self.folder / "shape.off"
        shutil.copy(Y, file)
        window = self.open(file)
        window.wait_for_skeleton()
        before = window.rest()
        shutil.copy(TORUS, self.folder / "new.off")
        (self.folder / "new.off").replace(file)
        window.wait_for_title("running")
        window.wait_for_skeleton()
        self.assertGreater(different(window.rest(), before), 0.02)
        file.write_text("OFF\n")  # spoilt: what was shown stays
        until(lambda: is_red(window), "a message of what is wrong")
        self.assertIn("(skeleton)", window.title())
        self.leave(window)


class Leaving(WindowTest):
    BOUND = 10  # seconds; the run that is left takes minutes

    def working(self):
        file = write_torus(self.folder / "big.ply", 1000, 500)
        window = self.open(file)
        window.wait_for_title("running")
        return window

    def test_by_key_in_the_middle_of_a_run(self):
        window = self.working()
        window.key("ctrl+q")
        self.assertEqual(window.exit_code(self.BOUND), DONE)

    def test_by_the_close_button_in_the_middle_of_a_run(self):
        window = self.working()
        ask_to_close(display.name, int(window.id))
        self.assertEqual(window.exit_code(self.BOUND), DONE)

    def test_by_signals(self):
        for number, code in ((signal.SIGINT, INTERRUPTED), (signal.SIGTERM, 143)):
            for window in (self.working(), self.opened()):
                window.process.send_signal(number)
                self.assertEqual(window.exit_code(self.BOUND), code)

    def test_while_a_file_is_being_opened(self):
        window = self.open(write_torus(self.folder / "big.ply", 1500, 1000))
        window.key("ctrl+q")
        self.assertEqual(window.exit_code(self.BOUND), DONE)


class Nowhere(CommandLineTest):
    def test_without_a_display(self):
        without = {name: value for name, value in os.environ.items()
                   if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        for environment in (without, {**without, "DISPLAY": ":4711"}):
            result = run("view", Y, env=environment)
            self.assertEqual(result.code, DEVICE, result.err)
            self.assertIn("--screenshot", result.err)


if __name__ == "__main__":
    unittest.main()
