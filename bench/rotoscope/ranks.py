#!/usr/bin/env python3
"""Two ranks of mpirun against one process on a film of four scenes: speed and bytes.

    bench/rotoscope/ranks.py build/release/bin/wheatstone [frames of a scene]
"""

import filecmp
import os
import shutil
import subprocess
import sys
import tempfile
import time

RUNS = 2
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
TWO_RANKS = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", "2"]


def make_film(program, frames):
    """A film with a cut, and after its end the same once more."""
    subprocess.run([program, "--quiet", "synth", "film", "--size", "480x270", "--frames", str(2 * frames), "--cut",
                    str(frames), "-o", "film"], check=True, stdout=subprocess.DEVNULL)
    for eye in ("left", "right"):
        for i in range(2 * frames):
            shutil.copy(f"film/{eye}_{i:04}.png", f"film/{eye}_{2 * frames + i:04}.png")


def seconds(launcher, program, threads, output):
    """Of the best run."""
    best = float("inf")
    for _ in range(RUNS):
        start = time.monotonic()
        subprocess.run([*launcher, program, "--quiet", "--threads", threads, "rotoscope", "film", "-o", output],
                       check=True, stdout=subprocess.DEVNULL, env={**os.environ, **AS_ROOT})
        best = min(best, time.monotonic() - start)
    return best


def main():
    program = os.path.abspath(sys.argv[1])
    frames = int(sys.argv[2]) if len(sys.argv) > 2 else 12
    if shutil.which("mpirun") is None:
        print("ranks: skipped, mpirun is not installed")
        return 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        make_film(program, frames)
        one_s = seconds([], program, "1", "one.mp4")
        threads_s = seconds([], program, "2", "threads.mp4")
        ranks_s = seconds(TWO_RANKS, program, "1", "ranks.mp4")
        same = filecmp.cmp("one.mp4", "ranks.mp4", shallow=False)
    print(f"four scenes of {frames} frames, 480x270 an eye; the same bytes: {'yes' if same else 'NO'}")
    print(f"  one process, one thread   {one_s:6.2f} s")
    print(f"  one process, two threads  {threads_s:6.2f} s, {one_s / threads_s:.2f} times as fast")
    print(f"  two ranks, one thread     {ranks_s:6.2f} s, {one_s / ranks_s:.2f} times as fast (at least 1.5)")
    return 0 if same and one_s / ranks_s >= 1.5 else 1


if __name__ == "__main__":
    sys.exit(main())
