#!/usr/bin/env python3
"""The figures and the report of `wingbeat plot`, on the small synthetic folder test/data/plots.

Exits with 77, which ctest takes for skipped, where no Python has matplotlib.
"""

import importlib.util
import os
import shutil
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True

from plots_folder import HAS_H5PY, Folder, png_size, write_solution  # noqa: E402
from plots_gradient import GradientContents, GradientFolders  # noqa: E402, F401
from plots_optimization import OptimizationContents, OptimizationFigures  # noqa: E402, F401
from plots_sweep import SweepFigures  # noqa: E402, F401

SKIPPED = 77
SYSTEM_PYTHON = "/usr/bin/python3"
FIGURES = ["branch", "phase_portrait", "march", "response", "pk", "aerodynamic_matrix", "loops", "pressure",
           *(["contours"] if HAS_H5PY else []), "gradient-bars", "gradient-bumps", "surface-sensitivity",
           "gradient-steps", "speed_convergence", "convergence", "mesh"]


class Plots(Folder):
    def test_draws_names_and_reports_every_figure(self):
        if HAS_H5PY:
            write_solution(self.folder / "solution.cgns")
        run = self.run_program()
        self.assertEqual(run.returncode, 0, run.stderr)
        paths = [str(self.folder / "plots" / f"{name}.png") for name in FIGURES]
        self.assertEqual(run.stdout.split(), [*paths, str(self.folder / "report.html")])
        for name in FIGURES:
            path = self.folder / "plots" / f"{name}.png"
            self.assertGreater(min(png_size(path)), 500, name)
            self.assertGreater(path.stat().st_size, 40_000, name)  # an empty frame of this size takes 10 000
        page, text = self.page(self.folder / "report.html")
        self.assertEqual(len(page.images), len(FIGURES))
        self.assertTrue(all(image.startswith("data:image/png;base64,") for image in page.images))
        self.assertEqual(page.links, [])
        self.assertFalse(page.tags & {"script", "link", "iframe", "object"})
        self.assertNotIn("url(", text)
        told = " ".join(page.text)
        for fact in ("flutter: synthetic", "a <synthetic> run & its results", "0123456789ab", "2 ranks", "12.5 s",
                     "2.8859", "3.6859", "limit-cycle", "mass_ratio = 75.0", "stalled", "flutter speed", "3e-12",
                     "bump 24", "angle_of_attack_deg"):
            self.assertIn(fact, told)

    def test_draws_only_what_is_there(self):
        self.keep("history.csv", "mesh.csv", "surface.csv")
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ["convergence", "mesh", "pressure", "speed_convergence"])

    def test_a_steady_run_is_one_instance(self):
        lines = (self.folder / "surface.csv").read_text().splitlines(keepends=True)
        (self.folder / "surface.csv").write_text("".join(line for line in lines if line[0] in "i0"))
        self.keep("surface.csv")
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ["pressure"])

    def test_names_each_column_that_is_missing(self):
        changes = {"pk.csv": "damping", "lco.csv": "frequency_ratio", "cycles.csv": "pitch_rate", "march.csv": "energy",
                   "aerodynamic_matrix_forced.csv": "Qha_im", "gradient.csv": "difference", "wall.csv": "normal_x",
                   "step_study.csv": "relative_error"}
        self.keep("mesh.csv", "aerodynamic_matrix.csv", *changes)
        for name, column in changes.items():
            path = self.folder / name
            path.write_text(path.read_text().replace(column, "nothing", 1))
        run = self.plot()
        self.assertEqual(run.returncode, 1)
        self.assertNotIn("Traceback", run.stderr)
        for name, column in changes.items():
            told = [line for line in run.stderr.splitlines() if f"{name}: no column {column}" in line]
            self.assertEqual(len(told), 1, f"{name}: {run.stderr}")
        self.assertEqual(self.drawn(), ["mesh"])

    def test_says_that_there_is_nothing(self):
        self.keep()
        run = self.run_program()
        self.assertEqual(run.returncode, 1)
        self.assertIn("nothing to draw", run.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_without_h5py_contours_are_skipped_with_a_word(self):
        self.keep("case.toml", "mesh.csv")
        (self.folder / "solution.cgns").write_bytes(b"")
        hidden = Path(self.temporary.name) / "hidden"
        hidden.mkdir()
        (hidden / "h5py.py").write_text("raise ModuleNotFoundError('hidden', name='h5py')\n")
        run = self.run_program(PYTHONPATH=str(hidden))
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("skipped, no h5py", run.stderr)
        self.assertEqual(self.drawn(), ["mesh"])

    @unittest.skipUnless(HAS_H5PY, "no h5py")
    def test_a_broken_solution_file_is_told(self):
        self.keep("case.toml")
        (self.folder / "solution.cgns").write_bytes(b"nothing of the kind")
        run = self.plot()
        self.assertEqual(run.returncode, 1)
        self.assertIn("solution.cgns", run.stderr)
        self.assertNotIn("Traceback", run.stderr)

    def test_compares_runs_beside_each_other(self):
        self.study(["lco.csv", "cycles.csv", "result.json"])
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ["branch-compared", "phase_portrait-compared"])
        page, _ = self.page(self.folder / "report.html")
        self.assertEqual(page.links, ["harmonics-2/report.html", "harmonics-10/report.html"])
        self.assertEqual(len(page.images), 2)
        for link in page.links:
            self.assertTrue((self.folder / link).is_file())

    def test_runs_that_ended_early_are_drawn_as_far_as_they_came(self):
        self.keep("march.csv", "lco.csv")
        for name, rows in (("march.csv", 4), ("lco.csv", 2)):
            lines = (self.folder / name).read_text().splitlines(keepends=True)
            (self.folder / name).write_text("".join(lines[:rows]) + lines[rows][:9])  # cut within a row
        (self.folder / "result.json").write_text(
            '{"command": "march", "status": "interrupted", "flutter": null, "lco": [{"energy": null}], "march": {'
            '"reduced_velocity": 2.85, "verdict": "undecided", "growth_rate": null, "frequency_ratio": null}}')
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ["branch", "march", "response"])
        self.page(self.folder / "report.html")

    def test_one_run_is_not_compared(self):
        self.study(["lco.csv", "result.json"])
        shutil.rmtree(self.folder / "harmonics-10")
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), [])
        self.assertTrue((self.folder / "report.html").is_file())


class Contents(Folder):
    """What the figures show, looked up in their lines."""

    def tearDown(self):
        from style import plt
        plt.close("all")
        super().tearDown()

    def test_branch_is_broken_where_the_speed_falls(self):
        import branch
        import numpy as np
        speeds, frequencies = branch.draw(self.folder).axes
        for axes in (speeds, frequencies):
            full, broken = (line.get_xydata() for line in axes.lines[:2])
            # Of the data V = V_F - 20 E + 1000 E^2: least at E = 0.01.
            self.assertLess(np.max(broken[np.isfinite(broken[:, 0]), 1]), 0.01)
            self.assertLess(np.nanmin(full[np.isfinite(full[:, 0]), 1]), 0.0101)
            self.assertGreater(np.nanmin(full[np.isfinite(full[:, 0]), 1]), 0.009)
        line = speeds.lines[0].get_xydata()
        line = line[np.isfinite(line[:, 0])]
        np.testing.assert_allclose(line[:, 0], 2.8859 - 20.0 * line[:, 1] + 1000.0 * line[:, 1] ** 2, atol=2e-3)
        crosses = [line for line in speeds.lines if line.get_marker() == "x"]
        np.testing.assert_allclose(crosses[0].get_xydata(), [[3.9, 0.05]])

    def test_phase_portrait_is_of_the_cycles_asked_for_and_of_the_last_period(self):
        import numpy as np
        import phase_portrait
        plunge, pitch = phase_portrait.draw(self.folder).axes
        curves = [line for line in pitch.lines if line.get_linestyle() == "-"]
        self.assertEqual(len(curves), 4)  # of six points four were asked for
        # pitch = 4 (sin + 0.1 sin 2 theta) deg at omega = 0.70805: its rate at theta = 0 is 4 omega 1.2 deg.
        at_rest = curves[-1].get_xydata()[0]
        np.testing.assert_allclose(at_rest, [0.0, 4.0 * 0.70805 * 1.2], atol=1e-4)
        marched = [line for line in plunge.lines if line.get_linestyle() == "--"]
        self.assertEqual(len(marched), 1)
        # One period of 2 pi/0.70805 at steps of 0.55, and a point more to close it.
        self.assertLessEqual(abs(len(marched[0].get_xdata()) - (2.0 * np.pi / 0.70805 / 0.55 + 1.0)), 1.0)

    def test_marches_are_told_apart_and_grow_at_twice_their_rate(self):
        import march
        import numpy as np
        energies, growth = march.draw(self.folder).axes
        text = [entry.get_text() for entry in energies.get_legend().get_texts()]
        self.assertEqual(len(text), 3)
        self.assertIn("V = 2.8500, decays", text[0])
        self.assertIn("limit cycle, E = 0.039", text[2])
        fits = [line.get_xydata() for line in energies.lines if line.get_linestyle() == "--"]
        rates = [np.log(fit[1, 1] / fit[0, 1]) / (fit[1, 0] - fit[0, 0]) for fit in fits]
        np.testing.assert_allclose(rates, [-0.012, 0.012], rtol=1e-10)
        # and they pass through the energies: 1e-6 exp(2 sigma t), on which 5 % of ripple lies
        for fit, rate in zip(fits, rates):
            np.testing.assert_allclose(fit[:, 1], 1e-6 * np.exp(rate * fit[:, 0]), rtol=0.05)

    def test_speeds_converge_to_their_last(self):
        import numpy as np
        import speed_convergence
        speed, distance = speed_convergence.draw(self.folder).axes
        np.testing.assert_allclose(speed.lines[0].get_ydata(), [2.8857, 2.8858, 2.8859, 2.886])
        np.testing.assert_allclose(distance.lines[0].get_ydata(), [3e-4 / 2.886, 2e-4 / 2.886, 1e-4 / 2.886], rtol=1e-9)

    def test_pressure_of_both_methods_is_compared_at_the_snapshots(self):
        import numpy as np
        import pressure_compare
        from read import read_table
        figure = pressure_compare.compare([self.folder])
        panels = [axes for axes in figure.axes if axes.get_title()]
        self.assertEqual(len(panels), 3)
        table = read_table(self.folder / "surface.csv", ["instance", "cp"])
        for number, axes in enumerate(panels):
            spectral, marched = axes.lines[0].get_ydata(), axes.lines[2].get_ydata()
            # Here the same file serves as both: the harmonics pass through the instances.
            np.testing.assert_allclose(spectral, marched, atol=1e-6)  # the table's phases have six digits
            self.assertIn(marched[0], table["cp"][table["instance"] == number])

    def test_every_comparison_is_drawn_of_two_runs(self):
        import plot
        from runs import runs_in
        self.study([path.name for path in self.folder.iterdir()])
        runs = runs_in(self.folder)
        self.assertEqual([run.name for run in runs], ["harmonics-2", "harmonics-10"])
        figures = {module.NAME: module.compare(runs) for module in plot.COMPARISONS}
        self.assertEqual([name for name, figure in figures.items() if figure is None], [])
        labels = {name: [entry.get_text() for axes in figure.axes if axes.get_legend()
                         for entry in axes.get_legend().get_texts()] for name, figure in figures.items()}
        self.assertEqual(labels["branch"][:2], ["$N_H$ = 2", "$N_H$ = 10"])
        self.assertEqual(labels["branch"][-1], "marched in time")
        self.assertEqual(labels["phase_portrait"][:2], ["$N_H$ = 2, E = 0.04", "$N_H$ = 10, E = 0.04"])
        self.assertEqual(labels["pressure"][0], "time-spectral, $N_H$ = 10")
        self.assertIn("harmonics-2, $V_F$ = 2.8859", labels["pk"])
        self.assertEqual(labels["aerodynamic_matrix"], ["harmonics-2", "harmonics-10"])
        self.assertEqual(len(labels["march"]), 6)
        for module in plot.COMPARISONS:
            self.assertIsNone(module.compare([]))

    @unittest.skipUnless(HAS_H5PY, "no h5py")
    def test_values_at_nodes_do_not_depend_on_how_the_mesh_is_cut(self):
        import contours
        import numpy as np
        found = []
        for zones in (1, 3):
            write_solution(self.folder / "solution.cgns", zones)
            instances, phases = contours.read_zones(self.folder / "solution.cgns")
            np.testing.assert_allclose(phases, [0.0, np.pi])
            values = contours.at_nodes(instances[0], 2)
            x, y = (np.concatenate([zone[i].ravel() for zone in instances[0]]) for i in (0, 1))
            found.append({(round(a, 6) + 0.0, round(b, 6) + 0.0): value
                          for a, b, value in zip(x, y, np.concatenate([part.ravel() for part in values]))})
        self.assertEqual(found[0].keys(), found[1].keys())
        for place, value in found[0].items():
            self.assertAlmostEqual(value, found[1][place], places=12)


class Formulas(unittest.TestCase):
    def test_curve_of_a_loop_passes_through_the_instances(self):
        import numpy as np
        from curves import series
        phases = 2.0 * np.pi * np.arange(5) / 5
        wanted = lambda theta: 0.3 + np.sin(theta) - 0.2 * np.cos(2.0 * theta)
        at = np.array([0.0, 1.0, 4.4])
        np.testing.assert_allclose(series(wanted(phases), at), wanted(at), atol=1e-14)

    def test_piecewise_cubic_is_exact_for_cubics_and_its_guessed_slopes_for_parabolas(self):
        import numpy as np
        from curves import hermite, three_point_slopes
        x, at = np.array([0.0, 0.3, 1.0, 1.2]), np.linspace(0.0, 1.2, 23)
        value, slope = hermite(x, x**3 - x, 3.0 * x**2 - 1.0, at)
        np.testing.assert_allclose(value, at**3 - at, atol=1e-14)
        np.testing.assert_allclose(slope, 3.0 * at**2 - 1.0, atol=1e-13)
        np.testing.assert_allclose(three_point_slopes(x, x**2 - x), 2.0 * x - 1.0, atol=1e-13)

    def test_sonic_pressure_coefficient(self):
        from pressure import sonic_pressure_coefficient
        # At Mach 1 the free stream is sonic; at 0.8 the pressure ratio is (2.256/2.4)^3.5.
        self.assertAlmostEqual(sonic_pressure_coefficient(1.0, 1.4), 0.0, places=14)
        self.assertAlmostEqual(sonic_pressure_coefficient(0.8, 1.4), ((2.256 / 2.4) ** 3.5 - 1.0) / 0.448, places=14)

    def test_energy_of_a_stage_is_in_its_name(self):
        from speed_convergence import energy_of
        nowhere = Path("nowhere")
        self.assertEqual(energy_of(nowhere, "cycle 12, E_0 2.5e-03"), 2.5e-3)
        self.assertIsNone(energy_of(nowhere, "cycle 12"))


if __name__ == "__main__":
    if importlib.util.find_spec("matplotlib") is None:
        if sys.executable != SYSTEM_PYTHON and os.access(SYSTEM_PYTHON, os.X_OK):
            os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])
        print("no Python with matplotlib")
        sys.exit(SKIPPED)
    unittest.main()
