"""The figures and the tables of a gradient."""

import json

from plots_folder import Folder


class GradientFolders(Folder):
    """Which figures there are, and what the report says."""

    def test_a_gradient_by_few_parameters_has_neither_bumps_nor_checks(self):
        self.keep("gradient.csv", "wall.csv")
        wall = (self.folder / "wall.csv").read_text().splitlines()
        (self.folder / "wall.csv").write_text("\n".join(line.rsplit(",", 1)[0] for line in wall) + "\n")
        (self.folder / "gradient.csv").write_text("name,derivative,difference\nmach,-3.1,nan\n")
        (self.folder / "result.json").write_text(
            '{"command": "gradient", "gradient": {"objective": "lco_energy", "value": null,'
            ' "design": [{"name": "mach", "derivative": -3.1}]}}')
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ["gradient-bars", "surface-sensitivity"])
        page, _ = self.page(self.folder / "report.html")
        self.assertIn("Gradient of the energy of the cycle", page.text)
        self.assertNotIn("finite difference", page.text)

    def test_of_many_parameters_the_report_lists_the_first(self):
        self.keep("gradient.csv")
        names = [f"bump {number}" for number in range(1, 1001)]
        (self.folder / "gradient.csv").write_text(
            "name,derivative,difference\n" + "".join(f"{name},0.1,nan\n" for name in names))
        design = [{"name": name, "derivative": 0.1} for name in names]
        (self.folder / "result.json").write_text(json.dumps({"gradient": {"objective": "drag", "design": design}}))
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ["gradient-bars"])
        page, _ = self.page(self.folder / "report.html")
        self.assertIn("bump 40", page.text)
        self.assertNotIn("bump 41", page.text)
        self.assertIn("The first 40 of 1000 parameters; all are in gradient.csv.", page.text)

    def test_a_gradient_that_is_cut_off_or_zero_is_drawn(self):
        self.keep("gradient.csv", "wall.csv", "bumps.csv", "step_study.csv")
        for name in ("gradient.csv", "wall.csv", "bumps.csv", "step_study.csv"):
            lines = (self.folder / name).read_text().splitlines(keepends=True)
            (self.folder / name).write_text("".join(lines[:9]) + lines[9][:9])
        self.assertEqual(self.plot().returncode, 0)
        self.assertEqual(len(self.drawn()), 4)
        (self.folder / "gradient.csv").write_text("name,derivative,difference\nbump 1,0,0\nmach,0,0\n")
        (self.folder / "step_study.csv").write_text("step,difference,relative_error\n0.1,0,0\n")
        self.assertEqual(self.plot().returncode, 0)


class GradientContents(Folder):
    """What the figures show, looked up in their lines."""

    def tearDown(self):
        from style import plt
        plt.close("all")
        super().tearDown()

    def test_bars_are_the_adjoint_and_marks_the_differences_that_were_computed(self):
        import gradient_bars
        import numpy as np
        from read import read_table
        table = read_table(self.folder / "gradient.csv", ["name", "derivative", "difference"])
        bumps, others = gradient_bars.draw(self.folder).axes
        np.testing.assert_allclose([bar.get_height() for bar in bumps.patches[:24]], table["derivative"][:24])
        marks = next(line for line in bumps.lines if line.get_marker() == "D").get_xydata()
        self.assertEqual(sorted(set(range(1, 25)) - set(marks[:, 0])), [5, 17])
        np.testing.assert_allclose(marks[:, 1], table["difference"][marks[:, 0].astype(int) - 1])
        texts = [text.get_text() for text in others.texts]
        for text in ("Mach number", "-3.1482", "gyration radius squared", "0.019312"):
            self.assertIn(text, texts)
        names = [text.get_text() for text in bumps.texts]
        self.assertEqual(names, ["lower surface", "upper surface"])

    def test_many_bumps_are_a_curve_along_the_wall(self):
        import gradient_bars
        import numpy as np
        numbers = np.arange(1, 101)
        (self.folder / "gradient.csv").write_text("name,derivative,difference\n" + "".join(
            f"bump {n},{np.sin(n)},{np.sin(n) if n % 10 == 0 else np.nan}\n" for n in numbers[::-1]))
        (self.folder / "bumps.csv").write_text("bump,s,x,y\n" + "".join(f"{n},{n / 101},0,0\n" for n in numbers))
        axes, = gradient_bars.draw(self.folder).axes
        curve, marks = axes.lines[0].get_xydata(), axes.lines[1].get_xydata()
        np.testing.assert_allclose(curve, np.column_stack([numbers / 101, np.sin(numbers)]))
        self.assertEqual(len(marks), 10)

    def test_crests_are_numbered_outside_the_section_and_one_bump_is_drawn(self):
        import gradient_bumps
        import numpy as np
        above, below = gradient_bumps.draw(self.folder).axes
        self.assertEqual([text.get_text() for text in above.texts], [str(n) for n in range(1, 25)])
        for text in above.texts:  # the section is symmetric: outward is away from y = 0
            self.assertGreater(text.xyann[1] * text.xy[1], 0.0)
        self.assertIn("Bump 21: amplitude 6 % of the chord, 6 times", below.get_title())
        moved = below.lines[0].get_xydata()
        self.assertAlmostEqual(np.max(moved[:, 1]), 0.0935, delta=0.002)
        np.testing.assert_allclose(moved[0], moved[-1])

    def test_surface_sensitivity_is_that_of_the_bump_when_summed_over_it(self):
        import numpy as np
        import surface_sensitivity
        from gradient import read_parameters, read_wall
        wall = read_wall(self.folder, ["area", "derivative_normal", "sample_bump"])
        self.assertEqual((wall["s"][0], wall["s"][-1]), (0.0, 1.0))
        total = np.sum((wall["sample_bump"] * wall["area"] * wall["derivative_normal"])[:-1])
        bumps, _ = read_parameters(self.folder)
        self.assertAlmostEqual(total, bumps["derivative"][20], places=5)
        section, curves, _ = surface_sensitivity.draw(self.folder).axes
        low, high = section.collections[0].get_clim()
        self.assertEqual(low, -high)
        upper, lower = (line.get_xydata() for line in curves.lines[:2])
        self.assertEqual((upper[-1, 0], lower[0, 0]), (1.0, 1.0))
        self.assertEqual(upper[0, 0], lower[-1, 0])

    def test_a_peak_at_the_trailing_edge_leaves_the_frame_with_a_word(self):
        import numpy as np
        import surface_sensitivity
        from gradient import read_wall
        path = self.folder / "wall.csv"
        header, first, *rest = path.read_text().splitlines()
        cells = first.split(",")
        cells[header.split(",").index("derivative_normal")] = "85"
        path.write_text("\n".join([header, ",".join(cells), *rest]) + "\n")
        self.assertEqual(np.max(read_wall(self.folder, ["derivative_normal"])["derivative_normal"]), 85.0)
        section, curves, _ = surface_sensitivity.draw(self.folder).axes
        self.assertLess(section.collections[0].get_clim()[1], 10.0)
        self.assertLess(curves.get_ylim()[1], 10.0)
        self.assertIn("up to 85 at x = 1.000", curves.texts[0].get_text())

    def test_guide_of_the_step_study_has_slope_two(self):
        import gradient_steps
        import numpy as np
        axes, = gradient_steps.draw(self.folder).axes
        guide, study = (line.get_xydata() for line in axes.lines)
        self.assertAlmostEqual(np.ptp(np.log(guide[:, 1])) / np.ptp(np.log(guide[:, 0])), 2.0)
        np.testing.assert_allclose(guide[:, 0], [1e-4, 0.1])  # from the best step to the largest
        self.assertEqual(len(study), 15)
