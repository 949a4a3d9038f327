"""The notebook of the documentation, executed by a kernel.

Ends with 77, for skipped, where Jupyter's client or its kernel for Python is not installed.
"""

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
NOTEBOOK = pathlib.Path(__file__).parents[2] / "docs/python.ipynb"


class Notebook(unittest.TestCase):
    def test_it_runs_and_shows_pages(self):
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        with tempfile.TemporaryDirectory() as folder:
            nbclient.NotebookClient(notebook, timeout=60, kernel_name="python3",
                                    resources={"metadata": {"path": folder}}).execute()
        outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
        shown = [output.data for output in outputs if output.output_type == "execute_result"]
        self.assertEqual(len(shown), 5)
        for data in shown:
            self.assertIn("image/png", data)
        pages = [data["text/html"] for data in shown if "text/html" in data]
        self.assertEqual([page.startswith("<iframe srcdoc=") for page in pages], 4 * [True])
        self.assertEqual([output.name for output in outputs if output.output_type == "stream"], 3 * ["stdout"])

    def test_its_outputs_are_not_kept_in_the_repository(self):
        for cell in nbformat.read(NOTEBOOK, as_version=4).cells:
            self.assertFalse(cell.get("outputs"))
            self.assertIsNone(cell.get("execution_count"))


if __name__ == "__main__":
    unittest.main()
