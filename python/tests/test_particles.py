"""Particles, and what other packages give of them. Run as test_wheatstone.py."""

import contextlib
import os
import pathlib
import subprocess
import tempfile
import tracemalloc
import unittest

import numpy as np
import wheatstone
from in_folder import PROGRAM, InFolder

POSITIONS = np.random.default_rng(3).normal(size=(500, 3))


class WithUnits(np.ndarray):
    """What wheatstone asks of an array of unyt: the name of its unit, and itself in another."""

    def __new__(cls, values, units):
        made = np.asarray(values, dtype=float).view(cls)
        made.units = units
        return made

    def to(self, units):
        factors = {("pc", "kpc"): 1e-3, ("kpc", "code_length"): 1, ("pc", "code_length"): 1e-3}
        return WithUnits(np.asarray(self) * factors[str(self.units), str(units)], units)


class Data:
    """What wheatstone asks of a data container of yt: the names of its fields, and a field by its name."""

    def __init__(self, fields):
        self.ds = self
        self.derived_field_list = list(fields)
        self._fields = fields

    def __getitem__(self, name):
        return self._fields[name]


class FromOthers(unittest.TestCase):
    def assert_same(self, given, **columns):
        options = {"size": (64, 36)}
        np.testing.assert_array_equal(wheatstone.render(given, **options), wheatstone.render(POSITIONS, **columns, **options))

    def test_columns_of_files_are_lent_and_not_copied(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "u.hdf5"
            subprocess.run([PROGRAM, "synth", "universe", "--particles", "900", "-o", path, "--quiet"], check=True,
                           stdout=subprocess.DEVNULL)
            gas = wheatstone.load(path)
        first, again = gas.mass, gas.mass
        self.assertEqual(first.ctypes.data, again.ctypes.data)
        self.assertFalse(first.flags.writeable)
        self.assertEqual((gas.positions.shape, gas.positions.dtype), ((len(gas), 3), np.float64))
        total = float(first.sum())
        del gas, again
        self.assertEqual(float(first.sum()), total)  # the array keeps the particles

    def test_views_of_slices_are_those_of_the_particles(self):
        gas = wheatstone.Particles(POSITIONS)
        slices = gas.slices(size=(64, 36), span=2)
        self.assertEqual(slices.views(3, span=2).shape, (3, 36, 64, 3))
        off = slices.views(1).astype(int) - gas.render(views=1, size=(64, 36))
        self.assertLess(np.sqrt((off**2).mean()), 3)

    def test_column_densities_have_the_units_of_arrays(self):
        positions, mass = WithUnits(POSITIONS, "kpc"), WithUnits(np.ones(500), "Msun")
        length = WithUnits(np.full(500, 100), "pc")
        column = wheatstone.column_density(positions, mass=mass, smoothing_length=length, size=(64, 36))
        self.assertEqual((column.units, column.length_units), ("Msun/kpc**2", "kpc"))
        plain = wheatstone.column_density(POSITIONS, mass=np.ones(500), smoothing_length=np.full(500, 0.1), size=(64, 36))
        np.testing.assert_array_equal(column.values, plain.values)
        self.assertEqual(plain.units, "")

    def test_units_are_parsed_by_unyt_and_astropy(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "gas.csv"
            rows = "".join(f"{x:g},{y:g},{z:g},2,0.1\n" for x, y, z in POSITIONS)
            path.write_text("x [kpc],y [kpc],z [kpc],mass [1e10 Msun],hsml\n" + rows)
            column = wheatstone.column_density(path, size=(64, 36))
            path.write_text("x [kpc],y [kpc],z [kpc],hsml\n" + "".join(f"{x},{y},{z},0.1\n" for x, y, z in POSITIONS))
            counted = wheatstone.column_density(path, size=(64, 36))
        self.assertEqual((column.units, column.length_units), ("1e+10*Msun/kpc**2", "kpc"))
        self.assertEqual(counted.units, "1/kpc**2")
        parsed = 0
        with contextlib.suppress(ImportError):
            import unyt
            self.assertAlmostEqual(float((1 * unyt.Unit(column.units)).to("Msun/pc**2").value), 1e4, places=6)
            self.assertEqual(1 * unyt.Unit(counted.units), 1 * unyt.Unit("kpc**-2"))
            parsed += 1
        with contextlib.suppress(ImportError):
            from astropy import units
            self.assertAlmostEqual(units.Unit(column.units).to(units.Msun / units.pc**2), 1e4, places=6)
            self.assertEqual(units.Unit(counted.units), units.kpc**-2)
            self.assertEqual(units.Unit(column.length_units), units.kpc)
            parsed += 1
        if parsed == 0:
            self.skipTest("neither python3-unyt nor python3-astropy is installed")

    def test_quantities_of_astropy_are_taken(self):
        try:
            from astropy import units
        except ImportError:
            self.skipTest("python3-astropy is not installed")
        column = wheatstone.column_density(POSITIONS * units.kpc, mass=np.ones(500) * units.Msun,
                                           smoothing_length=np.full(500, 100) * units.pc, size=(64, 36))
        plain = wheatstone.column_density(POSITIONS, mass=np.ones(500), smoothing_length=np.full(500, 0.1), size=(64, 36))
        np.testing.assert_allclose(column.values, plain.values, rtol=1e-4, atol=1e-4)
        self.assertEqual(units.Unit(column.units), units.Msun / units.kpc**2)

    def test_numbers_beyond_single_precision_are_refused(self):
        with self.assertRaisesRegex(ValueError, "mass has numbers beyond single precision"):
            wheatstone.render(POSITIONS, mass=np.full(500, 2e39))

    def test_data_containers_give_their_gas_or_all_particles(self):
        mass, length = np.arange(1, 501.0), np.full(500, 0.2)
        gas = {("gas", axis): WithUnits(POSITIONS[:, i], "kpc") for i, axis in enumerate("xyz")}
        gas |= {("gas", "mass"): mass, ("gas", "smoothing_length"): WithUnits(200 * np.ones(500), "pc")}
        self.assert_same(Data(gas), mass=mass, smoothing_length=length)
        self.assert_same(Data({("all", "particle_position"): POSITIONS, ("all", "particle_mass"): mass}), mass=mass)
        with self.assertRaisesRegex(ValueError, "has no particles, expected the field"):
            wheatstone.render(Data({("gas", "density"): mass}))
        with self.assertRaisesRegex(ValueError, "mass is given beside a data container"):
            wheatstone.render(Data(gas), mass=mass)

    def test_arrays_of_unyt_are_taken(self):
        try:
            import unyt
        except ImportError:
            self.skipTest("python3-unyt is not installed")
        column = wheatstone.column_density(unyt.unyt_array(POSITIONS, "kpc"), mass=unyt.unyt_array(np.ones(500), "Msun"),
                                           smoothing_length=unyt.unyt_array(np.full(500, 100), "pc"), size=(64, 36))
        plain = wheatstone.column_density(POSITIONS, mass=np.ones(500), smoothing_length=np.full(500, 0.1), size=(64, 36))
        np.testing.assert_allclose(column.values, plain.values, rtol=1e-4, atol=1e-4)
        self.assertEqual(1 * unyt.Unit(column.units), 1 * unyt.Unit("Msun/kpc**2"))


class InPlace(unittest.TestCase):
    """Arrays are read where they lie; what the library keeps is single precision, relative to an origin."""

    def taken(self, positions, mass):
        """Bytes of NumPy's arrays that are made while particles are taken."""
        tracemalloc.start()
        gas = wheatstone.Particles(positions, mass=mass)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return gas, peak

    def test_double_precision_in_any_order_and_single_precision_columns_are_not_copied(self):
        count = 200_000
        positions = np.random.default_rng(3).normal(size=(count, 3))
        mass = np.ones(count, np.float32)
        for name, given in {"rows": positions, "columns": np.asfortranarray(positions),
                            "every other": np.repeat(positions, 2, axis=0)[::2]}.items():
            with self.subTest(name):
                gas, peak = self.taken(given, mass)
                self.assertLess(peak, 100_000)
                np.testing.assert_allclose(gas.positions, positions, rtol=1e-5, atol=1e-5)
        self.assertGreater(self.taken(positions.astype(np.float32), mass)[1], 8 * count)  # is converted, axis by axis

    def test_other_kinds_of_numbers_give_the_same_positions(self):
        for count in (1, 1000, 200_000, 3_000_000):
            positions = np.random.default_rng(5).integers(-1000, 1000, size=(count, 3))
            expected = wheatstone.Particles(positions.astype(np.float64)).positions
            for kind in (np.float32, np.int16, np.int64):
                with self.subTest(f"{count} of {kind.__name__}"):
                    np.testing.assert_array_equal(wheatstone.Particles(positions.astype(kind)).positions, expected)

    def test_units_that_need_no_change_are_not_copied(self):
        for package, quantity, unit in [("unyt", "unyt_array", "kpc"), ("astropy.units", "Quantity", "kpc")]:
            try:
                made = getattr(__import__(package, fromlist=[quantity]), quantity)
            except ImportError:
                continue
            with self.subTest(package):
                positions = made(np.random.default_rng(3).normal(size=(200_000, 3)), unit)
                wheatstone.Particles(positions[:5])  # what the package makes once
                gas, peak = self.taken(positions, np.ones(200_000, np.float32))
                self.assertLess(peak, 200_000)
                self.assertEqual(gas.units["length"], "kpc")

    def test_columns_that_come_back_share_their_memory(self):
        gas = wheatstone.Particles(POSITIONS, mass=np.ones(500))
        self.assertTrue(np.shares_memory(gas.mass, gas.mass))


class FromTheCommandLine(InFolder):
    """render() takes what the command line takes."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.run_program("synth", "universe", "--particles", "2000", "-o", "u.hdf5")
        cls.run_program("synth", "universe", "--particles", "500", "--times", "0.4,0.6,0.8", "-o", "s_%03d.hdf5")
        rows = "\n".join(f"{x:.4f} {y:.4f} {z:.4f} {1 + i % 3} {i % 50}" for i, (x, y, z) in enumerate(POSITIONS))
        (cls.folder / "gas.txt").write_text("# x [kpc] y [kpc] z [kpc] mass [1e10*Msun] age [Gyr]\n" + rows + "\n")

    def test_options_give_the_same_bytes(self):
        for options, words in [
            ({"stretch": "log", "look_at": (100, 200, 300), "projection": "orthographic", "linear_colours": True},
             ["--stretch", "log", "--look-at", "100,200,300", "--projection", "orthographic", "--linear-colours"]),
            ({"depth_mapping": [(0, -50), (0.3, 0), (1, 60)], "smooth_depth": True, "method": "layered", "near": None},
             ["--depth-mapping", "0:-50,0.3:0,1:60", "--smooth-depth", "--method", "layered"]),
            ({"annotate": True, "title": "Gas & <dust>", "annotation_depth": 20, "size": (320, 180), "opaque": False},
             ["--annotate", "--title", "Gas & <dust>", "--annotation-depth", "20", "--size", "320x180"]),
            ({"exposure": 0.2}, ["--look", "thesis", "--exposure", "0.2"]),
        ]:
            with self.subTest(str(options)):
                size = [] if "size" in options else ["--size", "96x54"]
                self.run_program("render", "u.hdf5", *words, *size, "-o", "v")
                options = {"size": (96, 54)} | options
                theirs = wheatstone.load(self.folder / "v/view_001.png")
                np.testing.assert_array_equal(wheatstone.render(self.folder / "u.hdf5", **options)[1], theirs)
                np.testing.assert_array_equal(wheatstone.load(self.folder / "u.hdf5").render(**options)[1], theirs)

    def test_quantities_come_from_files_and_arrays(self):
        options = {"size": (96, 54), "views": 1, "least": 0, "most": 50}
        of_file = wheatstone.render(self.folder / "gas.txt", quantity="age", **options)
        self.assertEqual((of_file.facts["unit"], of_file.facts["quantity"]), ("Gyr", "age"))
        ages, mass = np.arange(500) % 50, 1 + np.arange(500) % 3
        of_arrays = wheatstone.render(np.round(POSITIONS, 4), mass=mass, quantity=ages, **options)
        self.assertLess(np.abs(of_file.astype(int) - of_arrays).mean(), 0.5)
        self.assertGreater(of_file.max(), 100)
        mean = wheatstone.column_density(wheatstone.load(self.folder / "gas.txt"), quantity="age", size=(32, 18))
        self.assertEqual(mean.units, "Gyr")
        self.assertTrue(0 <= np.nanmin(mean.values) <= np.nanmax(mean.values) <= 49)

    def test_types_of_particles_have_colours(self):
        views = wheatstone.render(self.folder / "u.hdf5", type_colours={"gas": "FF0000"}, size=(64, 36))
        self.assertGreater(views[..., 0].max(), 100)
        self.assertEqual(views[..., 1:].max(), 0)
        with self.assertRaisesRegex(ValueError, "several colours"):
            wheatstone.render(self.folder / "u.hdf5", type_colours="gas=FF0000,0=00FF00")

    def test_conditions_choose_from_files_and_arrays(self):
        options = {"size": (64, 36), "views": 1}
        where = "x > 50000 and Density < 1e-7"
        views = wheatstone.render(self.folder / "u.hdf5", where=where, **options)
        self.assertGreater(views.facts["particles"], 10)
        loaded = wheatstone.load(self.folder / "u.hdf5")
        np.testing.assert_array_equal(loaded.render(where=where, **options), views)
        chosen = (loaded.positions[:, 0] > 50000) & (loaded.density < np.float32(1e-7))
        self.assertEqual(views.facts["particles"], chosen.sum())
        mass = np.arange(500.0)
        hot = wheatstone.render(POSITIONS, mass=mass, where="mass >= 250 or z < -1", **options)
        self.assertEqual(hot.facts["particles"], ((mass >= 250) | (POSITIONS[:, 2] < -1)).sum())
        with self.assertRaisesRegex(ValueError, "has no quantity 'Spin', but x, y, z, mass"):
            wheatstone.render(POSITIONS, mass=mass, where="Spin > 1", **options)
        with self.assertRaisesRegex(ValueError, "where: expected one of < <= > >= == != at character 3, '= 1'"):
            wheatstone.render(POSITIONS, where="x = 1", **options)

    def test_units_are_those_of_unyt_and_astropy(self):
        column = wheatstone.load(self.folder / "gas.txt").column_density(size=(32, 18))
        self.assertEqual((column.units, column.length_units), ("1e+10*Msun/kpc**2", "kpc"))
        for package in ("unyt", "astropy.units"):
            try:
                units = __import__(package, fromlist=["Unit"])
            except ImportError:
                continue  # python3-unyt or python3-astropy is not installed
            with self.subTest(package):
                ratio = (1 * units.Unit(column.units)).to(units.Unit("Msun/pc**2"))
                self.assertAlmostEqual(float(getattr(ratio, "value", ratio)), 1e4, delta=1e-6)

    def test_series_have_particles_at_any_time_and_frames(self):
        series = wheatstone.Series(self.folder / "s_%03d.hdf5")
        self.assertEqual(len(series), 3)
        np.testing.assert_allclose(series.times, [0.4, 0.6, 0.8])
        self.assertEqual(len(series[1]), len(series.at(0.5)))
        self.run_program("render", "s_%03d.hdf5", "--frames", "3", "--orbit", "30", "--size", "96x54", "--views", "1",
                         "-o", "f_%d.png")
        frames = list(series.frames(3, orbit=30, size=(96, 54), views=1))
        for number, frame in enumerate(frames):
            np.testing.assert_array_equal(frame[0], wheatstone.load(self.folder / f"f_{number + 1}.png"))
        self.assertAlmostEqual(frames[1].facts["redshift"], 1 / 0.6 - 1)
        with self.assertRaisesRegex(ValueError, "time: is 0.9, expected from 0.4"):
            series.at(0.9)
        with self.assertRaisesRegex(ValueError, "snap_%03d.hdf5"):
            wheatstone.Series(self.folder / "u.hdf5")

    def test_models_and_slices_are_rendered_too(self):
        self.run_program("synth", "model", "--triangles", "500", "-o", "m.obj")
        self.assertGreater(wheatstone.render(self.folder / "m.obj", size=(96, 54), elevation=30).std(), 5)
        wheatstone.Particles(POSITIONS).slices(size=(96, 54)).save(self.folder / "s.exr")
        self.assertEqual(wheatstone.render(self.folder / "s.exr", views=5, near=20, far=30).shape, (5, 54, 96, 3))

    def test_wrong_options_are_named(self):
        render = wheatstone.render
        for options, kind, message in [
            ({"strech": "log"}, TypeError, "'strech'; did you mean 'stretch'"),
            ({"quilt": "3x2"}, TypeError, "'quilt'"),
            ({"stretch": "cubic"}, ValueError, "stretch: is 'cubic', expected asinh|log|linear"),
            ({"title": "Gas"}, ValueError, "^title: has no effect without annotate"),
            ({"focus_gain": 2}, ValueError, "^focus_gain: has no effect without focus"),
            ({"opacity": 0.5}, ValueError, "^opacity: has no effect with look mass"),
            ({"type": "gas"}, ValueError, "these particles are arrays"),
            ({"background": "ffffff"}, ValueError, "^background: has no effect on what is no model"),
        ]:
            with self.subTest(str(options)), self.assertRaisesRegex(kind, message.replace("|", r"\|")):
                render(POSITIONS, size=(32, 18), **options)
        for name in ("stretch", "annotate", "depth_mapping", "look_at"):
            self.assertRegex(render.__doc__, f"\n    {name}[ :]")

    def test_notebooks_show_pairs_and_anaglyphs(self):
        pair = wheatstone.render(POSITIONS, size=(64, 36))
        anaglyph = wheatstone.pack(pair, "anaglyph")
        for shown, width in [(pair, 128), (pair[0], 64), (anaglyph, 64)]:
            png = shown._repr_png_()
            self.assertEqual(int.from_bytes(png[16:20], "big"), width)
        self.assertIsNone(anaglyph[0]._repr_png_())


@unittest.skipUnless(os.environ.get("WHEATSTONE_LONG_TESTS"), "yt takes seconds to be imported")
class FromYt(unittest.TestCase):
    def test_data_containers_of_yt_are_taken(self):
        try:
            import yt
        except ImportError:
            self.skipTest("python3-yt is not installed")
        yt.set_log_level("error")
        data = {f"particle_position_{axis}": POSITIONS[:, i] for i, axis in enumerate("xyz")}
        data["particle_mass"] = np.ones(500)
        dataset = yt.load_particles(data, bbox=np.array(3 * [[-6.0, 6.0]]), length_unit="kpc", mass_unit="Msun")
        column = wheatstone.column_density(dataset.all_data(), size=(64, 36))
        plain = wheatstone.column_density(POSITIONS, size=(64, 36))
        self.assertEqual(column.units, "code_mass/code_length**2")
        np.testing.assert_allclose(column.extent, plain.extent, rtol=1e-4)
        np.testing.assert_allclose(column.values, plain.values, rtol=1e-3, atol=1e-3 * plain.values.max())


if __name__ == "__main__":
    unittest.main()
