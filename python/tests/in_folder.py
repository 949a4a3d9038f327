"""What tests of the package share: a folder for a class's files, a small still life, and the program, whose path is WHEATSTONE."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import wheatstone

PROGRAM = os.environ["WHEATSTONE"]


class InFolder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.kept.name)
        cls.still = wheatstone.still((96, 72))

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    @classmethod
    def run_program(cls, *words):
        subprocess.run([PROGRAM, *map(str, words), "--quiet"], check=True, cwd=cls.folder, stdout=subprocess.DEVNULL)
