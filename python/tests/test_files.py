"""What the package reads, packs, films and shows. Run as test_wheatstone.py."""

import concurrent.futures
import html
import re
import unittest

import numpy as np
import wheatstone
from in_folder import PROGRAM, InFolder


class Files(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.run_program("synth", "film", "--size", "96x72", "--frames", "3", "-o", "film")
        cls.film = f"{cls.folder}/film/left_%04d.png,{cls.folder}/film/right_%04d.png"
        cls.run_program("rotoscope", cls.film, "--style", "pointillist", "--codec", "ffv1", "-o", "painted.mkv")

    def test_load_gives_what_a_file_holds(self):
        at = self.folder / "kinds"
        at.mkdir()
        self.still.paint("pointillist").save(at / "painting.wst")
        wheatstone.save(at / "photograph.mpo", self.still)
        wheatstone.save(at / "photograph_sbs.png", wheatstone.pack(self.still, "left-right"))
        wheatstone.save(at / "picture.png", self.still.left)
        wheatstone.save(at / "quilt_qs2x1a1.33.png", wheatstone.pack(self.still, "quilt", quilt=(2, 1)))
        wheatstone.Particles(np.eye(3)).slices(size=(32, 18)).save(at / "slices.exr")
        np.save(at / "points.npy", np.eye(3))
        kinds = {path.name: type(wheatstone.load(path)) for path in at.iterdir()}
        self.assertEqual(kinds, {
            "painting.wst": wheatstone.Painting, "photograph.mpo": wheatstone.Photograph,
            "photograph_sbs.png": wheatstone.Photograph, "picture.png": np.ndarray,
            "quilt_qs2x1a1.33.png": wheatstone.Photograph, "slices.exr": wheatstone.Slices,
            "points.npy": wheatstone.Particles})
        np.testing.assert_array_equal(wheatstone.load(at / "photograph_sbs.png").views, self.still.views)
        np.testing.assert_array_equal(wheatstone.load(at / "picture.png"), self.still.left)

    def test_pack_gives_the_bytes_of_the_command_line(self):
        wheatstone.save(self.folder / "left.png", self.still.left)
        wheatstone.save(self.folder / "right.png", self.still.right)
        for name in ["anaglyph", "half-colour", "top-bottom-half", "checkerboard"]:
            with self.subTest(name):
                self.run_program("pack", "left.png", "right.png", "--to", name, "-o", f"{name}.png")
                np.testing.assert_array_equal(wheatstone.load(self.folder / f"{name}.png"),
                                              wheatstone.pack((self.still.left, self.still.right), name))

    def test_rectify_brings_matching_points_to_one_row(self):
        moved = wheatstone.still((320, 240))
        right = np.roll(moved.right, 5, axis=0)
        pair = wheatstone.rectify(moved.left, right)
        self.assertGreater(pair.rows_before[0], 4)
        self.assertLess(pair.rows_after[0], 0.5)
        self.assertEqual(pair.left.shape, pair.right.shape)

    def test_measures_tell_a_pair_from_two_pictures(self):
        good = wheatstone.measure(self.still.left, self.still.right, self.still.disparity)
        bad = wheatstone.measure(self.still.left, self.still.right[::-1].copy(), self.still.disparity)
        self.assertLess(3 * good.mean_absolute_difference, bad.mean_absolute_difference)
        self.assertLess(good.bad_1, bad.bad_1)

    def test_films_give_their_frames_each_time_anew(self):
        film = wheatstone.load(self.folder / "painted.mkv")
        self.assertEqual(film.layout, "left-right")
        self.assertAlmostEqual(film.frame_rate, 24, delta=0.5)  # of so few frames, Matroska rounds
        frames = list(film)
        self.assertEqual([frame.left.shape for frame in frames], 3 * [(72, 96, 3)])
        self.assertEqual([frame.right.shape for frame in film], 3 * [(72, 96, 3)])
        np.testing.assert_allclose([frame.seconds for frame in frames], [0, 1 / 24, 2 / 24], atol=1e-3)
        self.assertEqual(len(list(film.frames(every=2))), 2)

    def test_rotoscoping_gives_the_frames_of_the_command_line(self):
        job = wheatstone.rotoscope(self.film, "pointillist", output=self.folder / "job.mkv", codec="ffv1")
        self.assertEqual((job.result()["frames"], job.done), (3, 1))
        files = [wheatstone.load(self.folder / name) for name in ("painted.mkv", "job.mkv")]
        for painted, *films in zip(wheatstone.rotoscope(self.film, "pointillist"), *files, strict=True):
            for frame in films:
                np.testing.assert_array_equal(painted.painting.left, frame.left)
                np.testing.assert_array_equal(painted.painting.right, frame.right)

    def test_a_cancelled_job_ends_and_leaves_no_film(self):
        job = wheatstone.rotoscope(self.film, output=self.folder / "cancelled.mp4")
        job.cancel()
        with self.assertRaises(concurrent.futures.CancelledError):
            job.result()
        self.assertTrue(job.is_finished())
        self.assertFalse((self.folder / "cancelled.mp4").exists())

    def test_a_job_raises_what_went_wrong(self):
        job = wheatstone.rotoscope(self.film, output="/dev/null/painted.mp4")
        with self.assertRaises(OSError):
            job.result()
        with self.assertRaisesRegex(ValueError, "layout is 'round'"):
            wheatstone.rotoscope(self.film, layout="round")

    def test_notebooks_show_everything_as_a_page_and_as_a_picture(self):
        film = wheatstone.load(self.film)
        shown = {"painting": self.still.paint("pointillist"), "photograph": self.still, "views": self.still.views,
                 "slices": wheatstone.Particles(np.eye(3)).slices(size=(32, 18))}
        for name, thing in shown.items():
            with self.subTest(name):
                page = html.unescape(re.fullmatch(r'<iframe srcdoc="([^"]*)" .*></iframe>', thing._repr_html_())[1])
                wheatstone.share(thing, self.folder / "page.html", title="Wheatstone")
                self.assertEqual(page, (self.folder / "page.html").read_text())
                self.assertTrue(thing._repr_png_().startswith(b"\x89PNG"))
        self.assertIsNone(film._repr_html_())  # browsers do not play numbered pictures
        self.assertTrue(film._repr_png_().startswith(b"\x89PNG"))
        self.assertIsNone(self.still.views[0]._repr_html_())


if __name__ == "__main__":
    unittest.main()
