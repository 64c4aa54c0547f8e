"""The figures of a sweep."""

from plots_folder import Folder

HEAD = "flow.mach,reduced_velocity,frequency_ratio,status,speed_index,branch,reason,point,start,seconds\n"
# Two branches of roots, both there at 0.83; 0.84 failed.
ROWS = ("0.81,2.0,0.63,converged,0.50,1,,1,none,1\n0.82,2.4,0.64,converged,0.60,1,,2,point 1,1\n"
        "0.83,2.2,1.05,converged,0.55,2,,3,point 2,1\n0.83,2.8,0.66,converged,0.70,1,,3,point 2,1\n"
        "0.84,,,stalled,,,no root,4,none,1\n0.85,1.9,1.04,converged,0.48,2,,5,point 3,1\n")


class SweepFigures(Folder):
    def test_one_parameter_is_a_curve(self):
        self.keep()
        (self.folder / "sweep.csv").write_text(HEAD + ROWS)
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ["sweep"])
        page, _ = self.page(self.folder / "report.html")
        self.assertIn("Points of the sweep", page.text)

    def test_two_parameters_are_contours(self):
        self.keep()
        rows = "".join(f"{mach},{mass},{2 + mach * mass},0.6,converged,,1,none,1\n"
                       for mach in (0.7, 0.8) for mass in (50, 60, 70))
        (self.folder / "sweep.csv").write_text(
            "flow.mach,structure.mass_ratio,reduced_velocity,frequency_ratio,status,reason,point,start,seconds\n" + rows)
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ["sweep-contour"])

    def test_no_line_is_drawn_across_a_switch(self):
        import sweep

        self.keep()
        (self.folder / "sweep.csv").write_text(HEAD + ROWS)
        keys, table, solved = sweep.read_sweep(self.folder)
        self.assertEqual(keys, ["flow.mach"])
        branches = sweep.branches_of(table, solved.nonzero()[0])
        places, lowest = sweep.lowest_of(table, keys[0], branches)
        self.assertEqual(lowest, [1, 1, 2, 2])
        self.assertEqual(sweep.switches(places, lowest), [(0.82, 0.83)])

    def test_a_table_without_parameters_is_told(self):
        self.keep()
        (self.folder / "sweep.csv").write_text("status,seconds\nconverged,1\n")
        run = self.plot()
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("no column of a parameter", run.stderr)
