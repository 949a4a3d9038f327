#!/usr/bin/python3
"""One column density of a snapshot as a picture's numbers, by yt (https://yt-project.org; Debian: python3-yt), on one
thread, for bench_one_view:

    bench/multiview/one_view_by_yt.py universe.hdf5 WIDTH HEIGHT
"""
import os
import sys

os.environ["OMP_NUM_THREADS"] = "1"  # before yt is loaded

import h5py
import numpy as np
import yt

yt.set_log_level("error")
snapshot, width, height = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
with h5py.File(snapshot) as file:
    gas = file["PartType0"]
    box = file["Header"].attrs["BoxSize"]
    mass = file["Header"].attrs["MassTable"][0]
    data = {("io", f"particle_position_{axis}"): (gas["Coordinates"][:, i].astype(float), "cm")
            for i, axis in enumerate("xyz")}
    data["io", "particle_mass"] = (np.full(len(gas["Coordinates"]), mass), "g")
    data["io", "density"] = (gas["Density"][:].astype(float), "g/cm**3")
    data["io", "smoothing_length"] = (gas["SmoothingLength"][:].astype(float), "cm")
universe = yt.load_particles(data, length_unit=1.0, mass_unit=1.0, bbox=np.array([[0, box]] * 3),
                             periodicity=(False, False, False))
universe.add_sph_fields()
picture = universe.proj(("io", "density"), "z").to_frb((box, "cm"), (height, width))["io", "density"].to_ndarray()
if not picture.sum() > 0:
    sys.exit("yt: the picture is empty")
