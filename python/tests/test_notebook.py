"""The notebooks of the documentation, executed by a kernel.

Ends with 77, for skipped, where Jupyter's client or its kernel for Python is not installed.
"""

import base64
import json
import os
import pathlib
import sys
import tempfile
import unittest

try:
    import ipykernel  # noqa: F401
    import nbclient
    import nbformat
except ImportError:
    sys.exit(77)

os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # the kernel says nothing of its debugger
os.environ["PATH"] = f"{pathlib.Path(os.environ['WHEATSTONE']).parent}:{os.environ['PATH']}"
SOURCES = pathlib.Path(__file__).parents[2]
NOTEBOOKS = [SOURCES / "docs/python.ipynb", SOURCES / "docs/figure.ipynb"]

# scripts/yt_column_density.py made the values, of the same snapshot: the first row is at the bottom. At the sides of the
# box yt lets kernels end, or go on at the other side.
AGAINST_YT = """
by_yt = np.loadtxt({numbers!r}) * 1e10  # counted in 1e10 Msun
inner = slice(4, -4)
def difference(values):
    ours = values.reshape(32, 16, 32, 16).mean(axis=(1, 3))[::-1]
    return (abs(ours - by_yt)[inner, inner].mean() / by_yt[inner, inner].mean()).item()
[difference(column.values), difference(column.values.T)]
"""


def outputs_of(notebook):
    with tempfile.TemporaryDirectory() as folder:
        nbclient.NotebookClient(notebook, timeout=60, kernel_name="python3",
                                resources={"metadata": {"path": folder}}).execute()
    return [output for cell in notebook.cells for output in cell.get("outputs", [])]


class Notebook(unittest.TestCase):
    def test_it_runs_and_shows_pages(self):
        outputs = outputs_of(nbformat.read(NOTEBOOKS[0], as_version=4))
        shown = [output.data for output in outputs if output.output_type == "execute_result"]
        self.assertEqual(len(shown), 5)
        for data in shown:
            self.assertIn("image/png", data)
        pages = [data["text/html"] for data in shown if "text/html" in data]
        self.assertEqual([page.startswith("<iframe srcdoc=") for page in pages], 4 * [True])
        self.assertEqual([output.name for output in outputs if output.output_type == "stream"], 3 * ["stdout"])

    def test_a_figure_has_panels_with_units_a_pair_and_the_numbers_of_yt(self):
        notebook = nbformat.read(NOTEBOOKS[1], as_version=4)
        numbers = str(SOURCES / "tests/scenes/column_density_by_yt.txt")
        notebook.cells.append(nbformat.v4.new_code_cell(AGAINST_YT.format(numbers=numbers)))
        outputs = outputs_of(notebook)
        results = [output.data for output in outputs if output.output_type == "execute_result"]
        widths = [int.from_bytes(base64.b64decode(data["image/png"])[16:20], "big") for data in results if "image/png" in data]
        self.assertEqual(widths, [960, 960, 960])
        self.assertEqual(sum(data.get("text/html", "").startswith("<iframe srcdoc=") for data in results), 1)
        told = "".join(output.text for output in outputs if output.output_type == "stream")
        for text in ["column density [Msun/kpc**2]: ", "temperature [K]: ", "density [Msun/kpc**3]: ", "kpc 8.38", "Msun/pc**2"]:
            self.assertIn(text, told)
        right, turned = json.loads(results[-1]["text/plain"])
        self.assertLess(right, 0.01)
        self.assertGreater(turned, 0.1)  # another picture is told apart

    def test_outputs_are_not_kept_in_the_repository(self):
        for notebook in NOTEBOOKS:
            for cell in nbformat.read(notebook, as_version=4).cells:
                self.assertFalse(cell.get("outputs"))
                self.assertIsNone(cell.get("execution_count"))


if __name__ == "__main__":
    unittest.main()
