"""Particles, and what other packages give of them. Run as test_wheatstone.py."""

import contextlib
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
import wheatstone

PROGRAM = os.environ["WHEATSTONE"]
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
