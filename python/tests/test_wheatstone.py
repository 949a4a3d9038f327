"""What the Python package promises. Run with PYTHONPATH at the built package, and the program's path as WHEATSTONE."""

import dataclasses
import os
import pathlib
import re
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np
import wheatstone
from in_folder import InFolder
from wheatstone import _wheatstone

SOURCES = pathlib.Path(__file__).parents[2]


class Package(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.run_program("synth", "still", "--size", "240x180", "-o", "still")
        cls.left = wheatstone.load(cls.folder / "still/left.png")
        cls.right = wheatstone.load(cls.folder / "still/right.png")

    @classmethod
    def painted(cls):
        """A file of a small painting."""
        path = cls.folder / "small.wst"
        if not path.exists():
            wheatstone.still((96, 72)).paint("pointillist").save(path)
        return path

    def test_paintings_are_those_of_the_command_line(self):
        self.run_program("paint", "still/left.png", "still/right.png", "--rectify", "never", "-o", "painted")
        painting = wheatstone.paint(self.left, self.right)
        np.testing.assert_array_equal(painting.left, wheatstone.load(self.folder / "painted/left.png"))
        np.testing.assert_array_equal(painting.right, wheatstone.load(self.folder / "painted/right.png"))

    def test_views_have_the_shape_and_bytes_of_the_command_line(self):
        painting = wheatstone.paint(self.left, self.right, wheatstone.Style("impressionist", texture=False))
        views = painting.views(5, span=2)
        self.assertEqual(views.shape, (5, 180, 240, 3))
        path = self.folder / "saved.wst"
        painting.save(path)
        self.run_program("pack", "saved.wst", "--to", "views", "--views", "5", "--span", "2", "-o", "views")
        np.testing.assert_array_equal(views[0], wheatstone.load(self.folder / "views/view_000.png"))
        np.testing.assert_array_equal(views[4], wheatstone.load(self.folder / "views/view_004.png"))
        np.testing.assert_array_equal(wheatstone.load(path).views(5, span=2), views)

    def test_pictures_are_not_copied_out(self):
        painting = wheatstone.paint(self.left, self.right, "pointillist")
        first, again = painting.left, painting.left
        self.assertEqual(first.ctypes.data, again.ctypes.data)
        self.assertFalse(first.flags.owndata)
        del painting
        self.assertGreater(first.max(), 0)  # the array keeps its picture

    def test_match_gives_disparities_in_pixels(self):
        geometry = wheatstone.match(self.left, self.right, quality="fast")
        self.assertEqual(geometry.left_disparity.shape, (180, 240))
        self.assertEqual(geometry.left_disparity.dtype, np.float32)
        self.assertGreater(geometry.found_share, 0.5)

    def test_render_gives_the_views_of_the_command_line(self):
        self.run_program("synth", "universe", "--particles", "3000", "-o", "u.hdf5")
        self.run_program("render", "u.hdf5", "--views", "3", "--size", "96x54", "-o", "gas")
        views = wheatstone.render(self.folder / "u.hdf5", views=3, size=(96, 54))
        self.assertEqual(views.shape, (3, 54, 96, 3))
        np.testing.assert_array_equal(views[2], wheatstone.load(self.folder / "gas/view_002.png"))

    def test_render_takes_positions_far_from_zero(self):
        near = np.random.default_rng(1).normal(size=(2000, 3))
        a = wheatstone.render(near, views=1, size=(64, 36), exposure=0.1)
        b = wheatstone.render(near + 1e8, views=1, size=(64, 36), exposure=0.1)
        self.assertLessEqual(np.abs(a.astype(int) - b).max(), 1)

    def test_column_density_conserves_mass(self):
        rng = np.random.default_rng(2)
        positions, mass = rng.normal(size=(3000, 3)), rng.uniform(1, 2, 3000)
        column = wheatstone.column_density(positions, mass=mass, smoothing_length=np.full(3000, 0.1), size=(200, 200),
                                           zoom=0.8)
        left, right, bottom, top = column.extent
        area = (right - left) * (top - bottom) / column.values.size
        self.assertAlmostEqual(column.values.sum(dtype=float) * area / mass.sum(), 1, delta=1e-3)

    def test_wrong_arguments_are_named(self):
        for call, message in [
            (lambda: wheatstone.paint(self.left[:, :, 0], self.right), r"left is an array of uint8 and shape \(180, 240\)"),
            (lambda: wheatstone.paint(self.left, self.right.astype(float)), "right is an array of float64"),
            (lambda: wheatstone.paint(self.left, "right.png"), "right is str, expected an array of uint8"),
            (lambda: wheatstone.paint(self.left, self.right[::2, ::2].copy()), "expected"),
            (lambda: wheatstone.paint(self.left, self.right, "cubist"), "cubist"),
            (lambda: wheatstone.paint(self.left, self.right, wheatstone.Style(marks="dots")), "marks"),
            (lambda: wheatstone.match(self.left, self.right, "perfect"), "fast, good or best"),
            (lambda: wheatstone.pack([self.left, self.right], "braille"), "expected one of: quilt, lenticular"),
            (lambda: wheatstone.pack([self.left, self.left[1:]]), "expected arrays of one shape"),
            (lambda: wheatstone.measure(self.left, self.right, self.left), r"disparity is .* shape \(height, width\)"),
            (lambda: wheatstone.rectify(self.left, None), "right is NoneType"),
            (lambda: wheatstone.share(self.left, "page.html"), "shown is ndarray, expected a painting"),
            (lambda: wheatstone.load(self.folder / "still/left.png", layout="round"), "round"),
            (lambda: wheatstone.render(np.zeros((4, 2))), r"shape \(number, 3\)"),
            (lambda: wheatstone.render(np.zeros((4, 3)), density=[1, 2]), "4 numbers, one a particle"),
        ]:
            with self.assertRaisesRegex(ValueError, message):
                call()
        with self.assertRaises(OSError):
            wheatstone.paint(self.left, self.right).save("/dev/null/painting.wst")
        with self.assertRaises(FileNotFoundError):
            wheatstone.load("/nowhere/painting.wst")

    def test_a_sliced_painting_is_that_of_the_command_line(self):
        wheatstone.paint(self.left, self.right).save(self.folder / "whole.wst")
        self.run_program("pack", "whole.wst", "--slice-depth", "40%", "--slice-keep", "front", "-o", "sliced")
        painting = wheatstone.load(self.folder / "whole.wst")
        part = painting.sliced("40%", keep="front")
        np.testing.assert_array_equal(part.left, wheatstone.load(self.folder / "sliced/view_000.png"))
        self.assertTrue((part.left != painting.left).any())
        self.assertTrue((painting.sliced(layer=0).left != painting.left).any())
        painting.slice_film(self.folder / "slices.mp4", frames=3, to="top-bottom")
        self.assertEqual(len(list(wheatstone.load(self.folder / "slices.mp4"))), 3)
        for wrong, words in [(lambda: painting.sliced("40"), "from 0% to 100%"),
                             (lambda: painting.sliced(keep="left"), "back or front"),
                             (lambda: painting.sliced(layer=-1), "layer"),
                             (lambda: painting.slice_film(self.folder / "o.mp4", to="mpo"), "top-bottom")]:
            with self.assertRaisesRegex(ValueError, words):
                wrong()

    def test_a_detail_map_makes_a_painting_finer(self):
        still = wheatstone.still((160, 120))
        paint = lambda style, level: wheatstone.paint(
            still.left, still.right, style, disparity=still.disparity, detail=np.full((3, 4), level, np.uint8))
        unlike = lambda level: np.abs(paint("oil", level).left.astype(int) - still.left).mean()
        coarse, even, fine = unlike(90), unlike(128), unlike(170)
        self.assertGreater(coarse, even)
        self.assertGreater(even, fine)
        with self.assertRaisesRegex(ValueError, "takes no detail map"):
            paint("impressionist", 128)
        with self.assertRaisesRegex(ValueError, "detail is an array of float32.*expected an array of uint8"):
            wheatstone.paint(still.left, still.right, detail=np.zeros((3, 4), np.float32))

    def test_other_threads_run_while_it_paints(self):
        beats = []
        done = threading.Event()

        def beat():
            while not done.is_set():
                beats.append(time.monotonic())
                time.sleep(0.002)

        thread = threading.Thread(target=beat)
        thread.start()
        begin = time.monotonic()
        wheatstone.paint(np.tile(self.left, (2, 2, 1)), np.tile(self.right, (2, 2, 1)))
        took = time.monotonic() - begin
        done.set()
        thread.join()
        self.assertGreater(len(beats), 10)
        self.assertLess(max(np.diff(beats)), max(0.5 * took, 0.1))

    def test_ctrl_c_ends_a_long_call(self):
        code = ("import numpy as n, wheatstone as w; a = n.random.default_rng(1).integers(0, 255, (2000, 3000, 3), 'uint8');"
                "print('go', flush=True); w.paint(a, a)")
        run = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        run.stdout.readline()
        time.sleep(0.3)
        run.send_signal(signal.SIGINT)
        errors = run.communicate(timeout=60)[1]
        self.assertIn("KeyboardInterrupt", errors)

    def test_styles_have_every_parameter_of_the_command_line(self):
        names = [field.name.replace("_", "-") for field in dataclasses.fields(wheatstone.Style)]
        self.assertEqual(names, ["preset", *_wheatstone.style_names(), "seed"])

    def test_examples_of_the_documentation_run(self):
        page = (SOURCES / "docs/python.md").read_text()
        blocks = re.findall(r"^```python\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
        self.assertEqual(len(blocks), 3)
        self.run_program("synth", "film", "--size", "96x72", "--frames", "3", "-o", "film")
        run = subprocess.run([sys.executable, "-c", "".join(blocks)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(run.stderr, "")
        self.assertIn("radii = [6, 3]", run.stdout)

    def test_examples_for_people_who_come_from_others_run(self):
        page = (SOURCES / "docs/coming-from.md").read_text()
        self.run_program("synth", "universe", "--particles", "2000", "-o", "snap.hdf5")
        blocks = re.findall(r"^```python\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
        self.assertEqual(len(blocks), 1)
        # What the tables have on the right, as far as it stands by itself.
        calls = re.findall(r"`(gas\.(?:render|column_density)\([^`…]*\))", page)
        self.assertGreater(len(calls), 3)
        code = [blocks[0], "gas = wheatstone.load('snap.hdf5')", *calls]
        run = subprocess.run([sys.executable, "-c", "\n".join(code)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(run.stderr, "")

    def test_show_opens_a_page_in_the_browser(self):
        browser = self.folder / "browser"
        browser.write_text(f"#!/bin/sh\ncp \"${{1#file://}}\" {self.folder}/opened.html\n")
        browser.chmod(0o755)
        code = f"import wheatstone; wheatstone.load({str(self.painted())!r}).show()"
        subprocess.run([sys.executable, "-c", code], check=True, env={**os.environ, "BROWSER": f"{browser} %s"})
        self.assertIn("<!doctype html>", (self.folder / "opened.html").read_text().lower())


if __name__ == "__main__":
    unittest.main()
