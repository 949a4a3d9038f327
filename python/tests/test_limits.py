"""Arguments that are refused, calls that Ctrl-C ends, and interpreters that exit while a film is painted. Run as
test_wheatstone.py."""

import os
import pathlib
import resource
import signal
import subprocess
import sys
import time
import unittest

import numpy as np
import wheatstone
from in_folder import InFolder

NAN, INF = float("nan"), float("inf")
POSITIONS = np.random.default_rng(1).normal(size=(500, 3))


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))


def start(code, folder):
    return subprocess.Popen([sys.executable, "-c", "import numpy as np, wheatstone as w, sys, os, time, threading\n" + code],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=folder, preexec_fn=limit_memory)


def processor_seconds(run):
    """Of a process that runs; 0 once it has ended."""
    try:
        fields = pathlib.Path(f"/proc/{run.pid}/stat").read_text().rpartition(")")[2].split()
    except FileNotFoundError:
        return 0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Limits(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.painting = cls.still.paint("pointillist")
        cls.painting.save(cls.folder / "painting.wst")
        cls.slices = wheatstone.Particles(POSITIONS).slices(size=(64, 36))
        cls.run_program("synth", "film", "--size", "160x120", "--frames", "12", "-o", "film")

    def assert_refused(self, name, call, *arguments, **options):
        """With one readable line that names the argument."""
        with self.subTest(f"{name} {arguments} {options}"):
            with self.assertRaises(ValueError) as refused:
                call(*arguments, **options)
            message = str(refused.exception)
            self.assertIn(name.replace("_", " "), message.replace("_", " "))
            self.assertNotIn("incompatible", message)
            self.assertNotIn("\n", message)
            self.assertLess(len(message), 300)

    def test_numbers_have_the_limits_of_the_command_line(self):
        render = wheatstone.render
        for number in [0, -1, 2.5, NAN, 1001, 10**9, 10**30, "3", None, True]:
            self.assert_refused("views", render, POSITIONS, views=number)
            self.assert_refused("views", self.painting.views, number)
            self.assert_refused("views", self.slices.views, number)
        for number in [NAN, INF, -1, 1e30, 10**400, "1", [1], 1 + 1j]:
            self.assert_refused("span", render, POSITIONS, span=number)
            self.assert_refused("span", self.painting.views, 3, span=number)
            self.assert_refused("span", self.slices.views, 3, span=number)
            self.assert_refused("span", wheatstone.Particles(POSITIONS).slices, span=number)
        for name, numbers in {"zoom": [NAN, INF, -1, 0, 1001], "elevation": [NAN, 91], "azimuth": [NAN, INF, 1e9],
                              "exposure": [INF, 0, -1, NAN]}.items():
            for number in numbers:
                self.assert_refused(name, render, POSITIONS, **{name: number})
        for number in [NAN, INF, 1e30, -1e30, 95, 60000]:
            self.assert_refused("screen_disparity", self.painting.views, 3, screen_disparity=number)
            self.assert_refused("screen_disparity", wheatstone.pack, self.still, screen_disparity=number)

    def test_sizes_are_two_whole_numbers_that_fit_into_memory(self):
        for size in [(10**6, 10**6), (0, 5), (-3, 4), (1, 2, 3), (2.5, 3), 7, None, "ab", (10**20, 1), (NAN, 2)]:
            self.assert_refused("size", wheatstone.render, POSITIONS, size=size)
            self.assert_refused("size", wheatstone.column_density, POSITIONS, size=size)
            self.assert_refused("size", wheatstone.Particles(POSITIONS).slices, size=size)
            self.assert_refused("size", wheatstone.still, size)
        self.assert_refused("views", wheatstone.render, POSITIONS, views=1000, size=(16384, 16384))

    def test_columns_are_numbers_that_mean_something(self):
        for name, numbers in {"smoothing_length": [-1, NAN], "mass": [-1, NAN]}.items():
            for number in numbers:
                self.assert_refused(name, wheatstone.Particles, POSITIONS, **{name: np.full(500, float(number))})
            self.assert_refused(name, wheatstone.Particles, POSITIONS, **{name: np.full(500, 1j)})
        self.assert_refused("positions", wheatstone.Particles, [[0, 0, 0], [1e300, 0, 0]])
        self.assert_refused("positions", wheatstone.Particles, np.ma.masked_array(POSITIONS, POSITIONS > 0))
        self.assert_refused("left", wheatstone.match, np.ma.masked_array(self.still.left), self.still.right)
        self.assert_refused("views", wheatstone.pack, np.zeros((2, 0, 0, 3), np.uint8))
        self.assert_refused("disparity", wheatstone.measure, self.still.left, self.still.right, NAN)
        self.assert_refused("disparity", wheatstone.measure, self.still.left, self.still.right,
                            np.full((72, 96), NAN, np.float32))

    def test_moments_and_budgets_of_films_have_limits(self):
        film = wheatstone.Film(f"{self.folder}/film/left_%04d.png,{self.folder}/film/right_%04d.png")
        for moment in [NAN, INF, -1, "1"]:
            self.assert_refused("start", film.frames, moment)
            self.assert_refused("end", film.frames, end=moment)
            self.assert_refused("depth_budget", film.rotoscope, depth_budget=moment)
        for every in [0, -1, 1.5, 10**20]:
            self.assert_refused("every", film.frames, every=every)

    def test_names_of_files_are_any_bytes(self):
        for name in [b"/dev/null/\xff.png", "x" * 5000]:
            with self.assertRaisesRegex((OSError, ValueError), "dev/null|xxx"):
                wheatstone.save(name, self.still.left)
            with self.assertRaises((OSError, ValueError)):
                wheatstone.render(name)

    def test_what_is_no_argument_of_its_kind_is_named(self):
        for seed in [-1, 1.5, "a", 2**64]:
            self.assert_refused("seed", wheatstone.Style(seed=seed).toml)
            self.assert_refused("seed", wheatstone.still, (32, 32), seed=seed)
        for value in [self.still.left, object(), b"1", [[]], NAN, INF, 10**5000, "a\0b"]:
            self.assert_refused("threshold", wheatstone.Style(threshold=value).toml)
        page = self.folder / "page.html"
        for text in [3, None, b"a", "a\0b", "\ud800"]:
            self.assert_refused("title", wheatstone.share, self.painting, page, title=text)
            self.assert_refused("layout", wheatstone.load, self.folder / "painting.wst", layout=text)
            self.assert_refused("to", wheatstone.pack, self.still, text)
            self.assert_refused("quality", wheatstone.match, self.still.left, self.still.right, text)
        for path in [3, None, "a\0b", []]:
            self.assert_refused("path", self.painting.save, path)
            self.assert_refused("path", wheatstone.save, path, self.still)
            self.assert_refused("path", wheatstone.load, path)
            self.assert_refused("film", wheatstone.rotoscope, path)
        self.assert_refused("match_colour", wheatstone.rectify, self.still.left, self.still.right, match_colour="no")
        self.assert_refused("quilt", wheatstone.pack, self.still, "quilt", quilt=(65536, 65536))
        self.assert_refused("quilt", wheatstone.pack, self.still, "quilt", quilt=3)

    def test_ctrl_c_ends_every_call_within_a_second(self):
        big = ("a = np.random.default_rng(1).integers(0, 255, (3000, 4000, 3), 'uint8'); "
               "q = np.zeros((3000, 4000), 'f4') + 9; v = np.stack([a] * 8)\n")
        points = "x = np.random.default_rng(1).normal(size=(2000000, 3))\n"
        film = "f = 'film/left_%04d.png,film/right_%04d.png'\n"
        for prepare, call in [
                (big, "w.match(a, a, 'best')"), (big, "w.paint(a, a)"), (big, "w.rectify(a, a[::-1].copy())"),
                (big, "w.measure(a, a, q)"), (big, "w.save('big.png', a)"), (big, "w.pack(v, 'quilt', quilt=(4, 2))"),
                (big, "w.save('big.mpo', v)"), (big, "w.share(w.Photograph(v[:2], q), 'p.html')"),
                (points, "w.render(x, views=1000)"), (points, "w.Particles(x).slices(size=(3000, 2000))"),
                (points, "w.column_density(x, size=(8000, 8000))"), ("", "w.still((16000, 16000))"),
                ("p = w.load('painting.wst')\n", "p.views(1000, 50)"), (film, "list(w.rotoscope(f))"),
                (film, "w.rotoscope(f, output='o.mkv').result()")]:
            with self.subTest(call):
                run = start(f"{prepare}print('go', flush=True)\ntry: {call}\nexcept KeyboardInterrupt: print('ended', flush=True)\n",
                            self.folder)
                self.assertEqual(run.stdout.readline(), "go\n")
                time.sleep(0.1)
                computed = processor_seconds(run)
                run.send_signal(signal.SIGINT)
                begin = time.monotonic()
                word, took = run.stdout.readline(), time.monotonic() - begin
                computed = processor_seconds(run) - computed
                errors = run.communicate(timeout=60)[1]
                self.assertEqual((word, errors, run.returncode), ("ended\n", "", 0))
                # On processors that others use as well, a second of work takes longer.
                self.assertLess(min(took, computed / min(os.cpu_count(), 2)), 1)
                self.assertLess(took, 10)
        self.assertEqual([path.name for path in self.folder.iterdir() if "big" in path.name or path.name == "o.mkv"], [])

    def test_an_exit_while_a_film_is_painted_keeps_its_code(self):
        job = "job = w.rotoscope('film/left_%04d.png,film/right_%04d.png', output='painted.mkv')\nwhile not job.step: time.sleep(0.01)\n"
        daemon = "threading.Thread(target=w.still, args=((9000, 9000),), daemon=True).start(); time.sleep(0.3)\n"
        for code, expected in [(job, 0), (job + "sys.exit(3)", 3), (job + "job.cancel()", 0), (daemon + "sys.exit(4)", 4)]:
            with self.subTest(code):
                run = start(code, self.folder)
                errors = run.communicate(timeout=20)[1]
                self.assertEqual((run.returncode, errors), (expected, ""))
        self.assertFalse((self.folder / "painted.mkv").exists())

    def test_a_forked_child_makes_calls(self):
        code = ("w.still((320, 240)).paint('pointillist')\nchild = os.fork()\n"
                "w.still((320, 240)).paint('pointillist')\n"
                "sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) if child else 7)")
        run = start(code, self.folder)
        self.assertEqual((run.communicate(timeout=60)[1], run.returncode), ("", 7))

    def test_threads_and_processes_get_the_same_results(self):
        np.save(self.folder / "points.npy", POSITIONS)
        (self.folder / "work.py").write_text(WORK)
        run = subprocess.run([sys.executable, "work.py"], cwd=self.folder, capture_output=True, text=True, timeout=100)
        self.assertEqual((run.stdout, run.stderr, run.returncode), ("threads\nfork\nforkserver\nspawn\n", "", 0))


# What threads of one process make, and processes that are started while they work.
WORK = """
import concurrent.futures, hashlib, multiprocessing
import numpy as np, wheatstone

def work(seed):
    still = wheatstone.still((96, 72), seed=seed % 3)
    arrays = [still.paint("pointillist").views(3), wheatstone.load("points.npy").positions,
              wheatstone.render("points.npy", views=2, size=(96, 54)),
              wheatstone.match(still.left, still.right, "fast").left_disparity]
    return hashlib.sha256(b"".join(array.tobytes() for array in arrays)).hexdigest()

if __name__ == "__main__":
    expected = [work(seed) for seed in range(3)] * 3
    with concurrent.futures.ThreadPoolExecutor(4) as threads:
        assert list(threads.map(work, range(9))) == expected
        print("threads", flush=True)
        for method in ["fork", "forkserver", "spawn"]:
            beside = [threads.submit(work, seed) for seed in range(9)]
            with multiprocessing.get_context(method).Pool(2) as pool:
                assert pool.map(work, range(9)) == expected
            assert [future.result() for future in beside] == expected
            print(method, flush=True)
"""

if __name__ == "__main__":
    unittest.main()
