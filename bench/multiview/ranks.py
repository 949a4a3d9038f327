#!/usr/bin/env python3
"""Two ranks of mpirun with one thread each against one process with two threads: speed, memory, bytes.

    bench/multiview/ranks.py build/release/bin/wheatstone [particles]

What a run takes on a thousand particles, the start of mpirun among it, is taken off: times and memory are what grows
with the data.
"""

import filecmp
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time

RUNS = 3
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def note_memory(note, command):
    """Runs a command, as a rank or alone, and notes its peak memory in bytes."""
    code = subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode
    rank = os.environ.get("OMPI_COMM_WORLD_RANK", "0")
    with open(f"{note}.{rank}", "w", encoding="ascii") as file:
        file.write(str(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024))
    return code


def measured(launcher, ranks, command, note):
    """Seconds of the best run, and the largest peak memory of a rank, in bytes."""
    best = float("inf")
    for _ in range(RUNS):
        start = time.monotonic()
        subprocess.run(
            [*launcher, sys.executable, os.path.abspath(__file__), "--note", note, *command],
            check=True,
            env={**os.environ, **AS_ROOT},
        )
        best = min(best, time.monotonic() - start)
    peaks = []
    for rank in range(ranks):
        with open(f"{note}.{rank}", encoding="ascii") as file:
            peaks.append(int(file.read()))
    return best, max(peaks)


def growth(launcher, ranks, program, threads, note):
    """Seconds and bytes that the large file takes more than the small one."""
    results = []
    for name in ("few", "many"):
        command = [program, "--quiet", "--threads", threads, "render", f"{name}.hdf5", "--stream", "--views", "9",
                   "--method", "layered", "-o", f"{name}_{ranks}"]
        results.append(measured(launcher, ranks, command, note))
    (few_s, few_bytes), (many_s, many_bytes) = results
    return many_s - few_s, many_bytes - few_bytes, few_s


def main():
    if sys.argv[1] == "--note":
        return note_memory(sys.argv[2], sys.argv[3:])
    program = os.path.abspath(sys.argv[1])
    particles = sys.argv[2] if len(sys.argv) > 2 else "8000000"
    if shutil.which("mpirun") is None:
        print("ranks: skipped, mpirun is not installed")
        return 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, count in (("few", "1000"), ("many", particles)):
            subprocess.run([program, "--quiet", "synth", "universe", "--particles", count, "-o", f"{name}.hdf5"],
                           check=True, stdout=subprocess.DEVNULL)
        one_s, one_bytes, one_start = growth([], 1, program, "2", "one")
        mpirun = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", "2"]
        two_s, two_bytes, two_start = growth(mpirun, 2, program, "1", "two")
        views = [f"view_{view:03}.png" for view in range(9)]
        same = filecmp.cmpfiles("many_1", "many_2", views, shallow=False)[0] == views
    speed, memory = one_s / two_s, two_bytes / one_bytes
    print(f"{particles} particles, nine views in depth planes: two threads {one_s:.2f} s, two ranks {two_s:.2f} s")
    print(f"  start: {one_start:.2f} s and {two_start:.2f} s; the same bytes: {'yes' if same else 'NO'}")
    print(f"  speed of two ranks over two threads  {speed:.2f}  (at least 0.85)")
    print(f"  memory of a rank over one process's  {memory:.2f}  (at most 0.60)")
    return 0 if same and speed >= 0.85 and memory <= 0.6 else 1


if __name__ == "__main__":
    sys.exit(main())
