#!/usr/bin/env python3
"""The figures of `wingbeat plot`, on the small synthetic folder test/data/plots.

Exits with 77, which ctest takes for skipped, where no Python has matplotlib.
"""

import importlib.util
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SKIPPED = 77
SYSTEM_PYTHON = "/usr/bin/python3"
ROOT = Path(__file__).resolve().parents[2]
PLOTS = ROOT / "apps" / "plots"
FIGURES = ["mesh", "pressure", "loops", "pk", "aerodynamic_matrix", "convergence"]


def png_size(path):
    head = path.read_bytes()[:24]
    return struct.unpack(">II", head[16:24]) if head.startswith(b"\x89PNG\r\n\x1a\n") else (0, 0)


class Plots(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name) / "run"
        shutil.copytree(ROOT / "test" / "data" / "plots", self.folder)

    def tearDown(self):
        self.temporary.cleanup()

    def plot(self):
        return subprocess.run([sys.executable, str(PLOTS / "plot.py"), str(self.folder)],
                              capture_output=True, text=True, check=False)

    def drawn(self):
        return sorted(path.stem for path in (self.folder / "plots").glob("*.png"))

    def test_draws_and_names_every_figure(self):
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stdout.split(), [str(self.folder / "plots" / f"{name}.png") for name in FIGURES])
        for name in FIGURES:
            path = self.folder / "plots" / f"{name}.png"
            self.assertGreater(min(png_size(path)), 600, name)
            self.assertGreater(path.stat().st_size, 40_000, name)  # an empty frame of this size takes 10 000

    def test_draws_only_what_is_there(self):
        for name in ("loads.csv", "pk.csv", "aerodynamic_matrix.csv", "result.json", "case.toml"):
            (self.folder / name).unlink()
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ["convergence", "mesh", "pressure"])

    def test_a_steady_run_is_one_instance(self):
        lines = (self.folder / "surface.csv").read_text().splitlines(keepends=True)
        (self.folder / "surface.csv").write_text("".join(line for line in lines if line[0] in "i0"))
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("pressure", self.drawn())

    def test_names_the_column_that_is_missing(self):
        text = (self.folder / "pk.csv").read_text().replace("damping", "dumping")
        (self.folder / "pk.csv").write_text(text)
        run = self.plot()
        self.assertEqual(run.returncode, 1)
        self.assertIn("pk.csv: no column damping", run.stderr)
        self.assertEqual(self.drawn(), sorted(set(FIGURES) - {"pk"}))

    def test_says_that_there_is_nothing(self):
        for table in self.folder.glob("*.csv"):
            table.unlink()
        run = self.plot()
        self.assertEqual(run.returncode, 1)
        self.assertIn("nothing to draw", run.stderr)
        self.assertFalse((self.folder / "plots").exists())

    def test_curve_of_a_loop_passes_through_the_instances(self):
        sys.path.insert(0, str(PLOTS))
        sys.dont_write_bytecode = True
        import numpy as np
        from loops import series
        phases = 2.0 * np.pi * np.arange(5) / 5
        wanted = lambda theta: 0.3 + np.sin(theta) - 0.2 * np.cos(2.0 * theta)
        at = np.array([0.0, 1.0, 4.4])
        np.testing.assert_allclose(series(wanted(phases), at), wanted(at), atol=1e-14)

    def test_sonic_pressure_coefficient(self):
        sys.path.insert(0, str(PLOTS))
        sys.dont_write_bytecode = True
        from pressure import sonic_pressure_coefficient
        # At Mach 1 the free stream is sonic; at 0.8 the pressure ratio is (2.256/2.4)^3.5.
        self.assertAlmostEqual(sonic_pressure_coefficient(1.0, 1.4), 0.0, places=14)
        self.assertAlmostEqual(sonic_pressure_coefficient(0.8, 1.4), ((2.256 / 2.4) ** 3.5 - 1.0) / 0.448, places=14)


if __name__ == "__main__":
    if importlib.util.find_spec("matplotlib") is None:
        if sys.executable != SYSTEM_PYTHON and os.access(SYSTEM_PYTHON, os.X_OK):
            os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])
        print("no Python with matplotlib")
        sys.exit(SKIPPED)
    unittest.main()
