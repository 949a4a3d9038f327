#!/usr/bin/python3
"""Column densities of a small synthetic snapshot by yt (https://yt-project.org, 4.1; Debian: python3-yt), for
the test of src/wheatstone/multiview/mass_test.cpp:

    wheatstone synth universe --particles 20000 --seed 5 -o universe.hdf5
    scripts/yt_column_density.py universe.hdf5 tests/scenes/column_density_by_yt.txt

Each line of the output has one row of bins, from y = 0 on: the mean column density along z in each bin, in the
snapshot's units of mass per length squared.
"""
import sys

import h5py
import numpy as np
import yt

BINS = 32
PIXELS_A_BIN = 16

yt.set_log_level("error")
snapshot, output = sys.argv[1:]
with h5py.File(snapshot) as file:
    gas = file["PartType0"]
    box = file["Header"].attrs["BoxSize"]
    mass = file["Header"].attrs["MassTable"][0]
    count = gas["Coordinates"].shape[0]
    data = {("io", f"particle_position_{axis}"): (gas["Coordinates"][:, i].astype(float), "cm")
            for i, axis in enumerate("xyz")}
    data["io", "particle_mass"] = (np.full(count, mass), "g")
    data["io", "density"] = (gas["Density"][:].astype(float), "g/cm**3")
    data["io", "smoothing_length"] = (gas["SmoothingLength"][:].astype(float), "cm")

universe = yt.load_particles(data, length_unit=1.0, mass_unit=1.0, bbox=np.array([[0, box]] * 3),
                             periodicity=(False, False, False))
universe.add_sph_fields()
side = BINS * PIXELS_A_BIN
projection = universe.proj(("io", "density"), "z")
picture = projection.to_frb((box, "cm"), side)["io", "density"].to_ndarray()
bins = picture.reshape(BINS, PIXELS_A_BIN, BINS, PIXELS_A_BIN).mean(axis=(1, 3))
print("mass in the picture:", bins.sum() * (box / BINS) ** 2 / (mass * count))
np.savetxt(output, bins, fmt="%.6g")
