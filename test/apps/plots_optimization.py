"""The figures and the report of an optimisation."""

import json
import shutil

from plots_folder import Folder

ALL = ["optimization_branches", "optimization_cost", "optimization_history", "optimization_matrix", "optimization_pk",
       "optimization_pressure", "optimization_roots", "optimization_section"]
OF_THE_FOLDER = ["optimization_cost", "optimization_history", "optimization_roots", "optimization_section"]
BASELINE = {"flutter_speed": 2.0, "drag": 0.002, "lift": 1e-17}
# The count of the iterations begins anew at the third: another root came near.
COUNTS = [0, 1, 2, 2, 3]
SPEEDS = [2.0, 2.2, 2.6, 2.6, 2.8]
DRAGS = [0.002, 0.0021, 0.0018, 0.0018, 0.002]
FIRST_OF_TABLE = 3


def design(row):
    return [0.001 * row, -0.01 if row == 4 else -0.002 * row, 0.1 * row]


def record_lines():
    """What evaluations.jsonl holds: the iterations of both rounds, and two roots from the second on."""
    lines = [{"kind": "case", "keys": {}, "analyses": ["flutter", "steady"], "outputs": ["flutter_speed", "drag"]}]
    for row, count in enumerate(COUNTS):
        outputs = {"flutter_speed": SPEEDS[row], "drag": DRAGS[row]}
        if row >= FIRST_OF_TABLE:
            outputs["flutter_speed 2"] = SPEEDS[row] + 0.1
        roots = [{"reduced_velocity": SPEEDS[row], "frequency_ratio": 0.6, "reduced_frequency": 0.1,
                  "growth_slope": 0.05}]
        if row > 0:
            roots.append({"reduced_velocity": SPEEDS[row] + 0.1, "frequency_ratio": 0.9, "reduced_frequency": 0.2,
                          "growth_slope": -0.02})
        lines += [{"kind": "values", "design": design(row), "status": "solved", "outputs": outputs, "solves": 2,
                   "seconds": {"flutter": 2.0, "steady": 0.5}},
                  {"kind": "iteration", "iteration": count, "design": design(row), "objective": SPEEDS[row],
                   "violation": 0.05 if row == 1 else 0.0, "kkt_error": 10.0**-row, "step": 0.1,
                   "is_restoring": row == 1},
                  {"kind": "roots", "design": design(row), "status": "solved", "roots": roots}]
    return lines


def table_text():
    """optimization.csv: of the second round only."""
    text = ("iteration,objective,flutter_speed,drag,flutter_speed 2,lift,violation,kkt_error,step,barrier,trials,"
            "is_restoring,designs,seconds,bump 1,bump 2,angle_of_attack\n")
    for row in range(FIRST_OF_TABLE, len(COUNTS)):
        cells = [COUNTS[row], SPEEDS[row], SPEEDS[row], DRAGS[row], SPEEDS[row] + 0.1, 0.01 * row, 0, 10.0**-row, 0.1,
                 1e-3, 1, 0, row + 1, 3.0 * row, *design(row)]
        text += ",".join(str(cell) for cell in cells) + "\n"
    return text


def result():
    final = {"flutter_speed": 2.8, "drag": 0.002, "lift": 0.04}
    return {
        "command": "optimize", "status": "converged", "message": "converged: flutter_speed = 2.8", "ranks": 1,
        "wall_seconds": {"total": 60.0},
        "optimization": {
            "objective": "maximize flutter_speed", "objective_initial": 2.0, "objective_final": 2.8,
            "constraints": {
                "drag <= baseline": {"output": "drag", "upper": 0.002, "initial": 0.002, "final": 0.002,
                                     "violation": 0.0, "multiplier": 0.3125},
                "lift >= 0.05": {"output": "lift", "lower": 0.05, "initial": 0.0, "final": 0.04, "violation": 0.2,
                                 "multiplier": 0.0}},
            "kkt_error": 1e-5, "iterations": 3, "evaluations": 9, "failed_evaluations": 1,
            "outputs_baseline": {**BASELINE, "flutter_speed 2": None},
            "outputs_final": {**final, "flutter_speed 2": 2.9},
            "seconds_of_values": {"flutter": 20.0, "steady": 5.0}, "seconds_of_gradients": {"flutter": 8.0},
            "design": [{"name": "bump 1", "value": 0.004}, {"name": "bump 2", "value": -0.01, "bound": "lower"},
                       {"name": "angle_of_attack", "value": 0.4}]},
        "comparison": {"baseline": {"pk": {"status": "converged", "message": ""}},
                       "optimum": {"pk": {"status": "stalled", "message": "too few samples"}}}}


class OptimizationFolder(Folder):
    """A folder of the verb optimize, made up, with runs of all verbs that compare."""

    def setUp(self):
        super().setUp()
        whole, self.folder = self.folder, self.folder.parent / "optimized"
        self.folder.mkdir()
        self.write_result(result())
        (self.folder / "optimization.csv").write_text(table_text())
        (self.folder / "evaluations.jsonl").write_text("".join(json.dumps(line) + "\n" for line in record_lines()))
        (self.folder / "case.toml").write_text("[design]\nbound = 0.01\n[optimize]\ntolerance = 1e-4\n")
        files = {"steady": ["surface.csv"], "lco": ["lco.csv"], "pk": ["pk.csv", "aerodynamic_matrix.csv"]}
        for number, name in enumerate(("baseline", "optimum")):
            section = self.folder / name
            section.mkdir()
            half = 0.05 + 0.01 * number
            (section / "airfoil.dat").write_text(f"# {name}\n1 0\n0.4 {half}\n0 0\n0.4 -{half}\n1 0\n")
            for verb, tables in files.items():
                (section / verb).mkdir()
                for table in tables:
                    shutil.copy(whole / table, section / verb)
                shutil.copy(whole / "result.json", section / verb)

    def write_result(self, values):
        (self.folder / "result.json").write_text(json.dumps(values))

    def remove_comparison(self):
        self.write_result({key: value for key, value in result().items() if key != "comparison"})
        for name in ("baseline", "optimum"):
            for verb in ("steady", "lco", "pk"):
                shutil.rmtree(self.folder / name / verb)

    def tearDown(self):
        from style import plt
        plt.close("all")
        super().tearDown()


class OptimizationFigures(OptimizationFolder):
    """Which figures there are, and what the report says."""

    def test_every_figure_appears_and_the_report_tells_what_was_found(self):
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr, "")
        self.assertEqual(self.drawn(), ALL)
        page, _ = self.page(self.folder / "report.html")
        self.assertEqual(len(page.images), len(ALL))
        told = " ".join(page.text)
        for fact in ("maximize flutter_speed over 3 variables", "1 not solved", "drag <= baseline", "+40",
                     "0.3125", "met", "violated", "on the lower bound: bump 2", "optimiser", "2.8859",
                     "optimum/pk: stalled too few samples", "flutter speed, root 2"):
            self.assertIn(fact, told)

    def test_without_runs_that_compare_the_rest_is_drawn_and_the_missing_named(self):
        self.remove_comparison()
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), OF_THE_FOLDER)
        for file in ("baseline/steady/surface.csv", "optimum/lco/lco.csv", "baseline/pk/pk.csv"):
            self.assertIn(file, run.stderr)
        page, _ = self.page(self.folder / "report.html")
        self.assertNotIn("Optimisation checked", page.text)

    def test_what_was_interrupted_is_drawn_as_far_as_it_came(self):
        self.remove_comparison()
        shutil.rmtree(self.folder / "optimum")
        self.write_result({"command": "optimize", "status": "interrupted", "message": "stopped"})
        path = self.folder / "evaluations.jsonl"
        path.write_text(path.read_text()[:-40])  # cut within a line
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ["optimization_history", "optimization_roots", "optimization_section"])
        page, _ = self.page(self.folder / "report.html")
        self.assertIn("interrupted", page.text)
        self.assertIn("It has not come to a result: the figures show how far it came.", page.text)

    def test_an_interrupted_run_with_its_best_design_names_it_so(self):
        values = result()
        values["status"] = "interrupted"
        self.write_result(values)
        run = self.plot()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.drawn(), ALL)
        page, _ = self.page(self.folder / "report.html")
        self.assertIn("best design", page.text)

    def test_a_column_that_is_missing_is_named(self):
        path = self.folder / "optimization.csv"
        path.write_text(path.read_text().replace("kkt_error", "nothing", 1))
        run = self.plot()
        self.assertEqual(run.returncode, 1)
        self.assertIn("optimization.csv: no column kkt_error", run.stderr)
        self.assertNotIn("Traceback", run.stderr)


class OptimizationContents(OptimizationFolder):
    """What the figures show, looked up in their lines."""

    def test_history_holds_both_rounds_and_breaks_between_them(self):
        import numpy as np
        import optimization_history
        speed, drag, lift, other, errors = self.panels(optimization_history)
        rounds = [line.get_xydata() for line in speed.lines if line.get_marker() == "o"]
        np.testing.assert_allclose(rounds[0], [[0, 0], [1, 10], [2, 30]], atol=1e-9)  # changes in %
        np.testing.assert_allclose(rounds[1], [[2, 30], [3, 40]], atol=1e-9)
        self.assertIn("objective, maximised", speed.get_title(loc="left"))
        self.assertEqual([text.get_text() for text in drag.texts], ["≤ 0.002"])
        self.assertEqual([text.get_text() for text in lift.texts], ["≥ 0.05"])
        self.assertEqual(lift.get_ylabel(), "value")  # of no baseline it can be relative to
        self.assertIn("root 2", other.get_title(loc="left"))
        kkt = errors.lines[0].get_xydata()
        np.testing.assert_allclose(kkt, [[0, 1], [1, 0.1], [2, 0.01]])

    def panels(self, module):
        figure = module.draw(self.folder)
        titles = {axes.get_title(loc="left").split(" $")[0]: axes for axes in figure.axes}
        return (*(titles[name] for name in ("flutter speed", "drag", "lift", "flutter speed, root 2")), figure.axes[-1])

    def test_a_count_that_begins_at_nought_again_goes_on(self):
        import numpy as np
        from optimization import places, restarts
        np.testing.assert_allclose(places([0, 1, 2, 0, 1, 0]), [0, 1, 2, 2, 3, 3])
        np.testing.assert_allclose(places([0, 1, 1, 2]), [0, 1, 1, 2])
        np.testing.assert_array_equal(restarts([0, 1, 1, 2, 0]), [2, 4])
        np.testing.assert_allclose(places([4]), [4])

    def test_a_sum_of_outputs_has_a_panel_of_its_own(self):
        import optimization_history
        values = result()
        values["optimization"]["objective"] = "maximize flutter_speed - 1.1 drag"
        self.write_result(values)
        text = (self.folder / "optimization.csv").read_text().replace("\n2,2.6,", "\n2,0.31,", 1)
        (self.folder / "optimization.csv").write_text(text)
        figure = optimization_history.draw(self.folder)
        self.assertIn("objective, maximised", figure.axes[0].get_title(loc="left"))
        self.assertEqual(len(figure.axes), 6)

    def test_roots_are_filled_where_they_destabilise(self):
        import numpy as np
        import optimization_roots
        speed, _ = optimization_roots.draw(self.folder).axes
        filled, hollow = (line for line in speed.lines if line.get_marker() == "o")
        np.testing.assert_allclose(filled.get_xydata(), np.column_stack([COUNTS, SPEEDS]))
        np.testing.assert_allclose(hollow.get_ydata(), np.array(SPEEDS[1:]) + 0.1)
        self.assertEqual(hollow.get_markerfacecolor(), "white")
        followed = next(line for line in speed.lines if "V_F$ of the optimiser" in line.get_label())
        np.testing.assert_allclose(followed.get_ydata(), SPEEDS)

    def test_bumps_on_a_bound_stand_out_and_outlines_come_from_the_ordinates(self):
        import matplotlib
        import numpy as np
        import optimization_section
        from style import COLOURS
        figure = optimization_section.draw(self.folder)
        true, stretched, bumps = figure.axes
        self.assertAlmostEqual(max(true.patches[1].get_xy()[:, 1]), 0.06)
        self.assertGreaterEqual(stretched.get_aspect(), 2)
        bars = bumps.patches[:2]
        np.testing.assert_allclose([bar.get_height() for bar in bars], [0.4, -1.0])
        self.assertEqual([bar.get_facecolor() for bar in bars],
                         [matplotlib.colors.to_rgba(COLOURS[name]) for name in ("optimum", "bound")])
        self.assertIn("change of the angle of attack: +0.4°", [text.get_text() for text in figure.texts])

    def test_without_ordinates_the_outline_is_the_wall_of_a_run(self):
        import numpy as np
        from optimization_section import outline
        (self.folder / "optimum" / "airfoil.dat").unlink()
        points = outline(self.folder / "optimum")
        np.testing.assert_allclose(points[0], [0.990095, -0.000204526])
        np.testing.assert_array_equal(points[0], points[-1])

    def test_pitch_amplitude_passes_through_the_cycles(self):
        import numpy as np
        import optimization_branches
        from read import read_table
        pitch = optimization_branches.draw(self.folder).axes[2]
        table = read_table(self.folder / "baseline" / "lco" / "lco.csv", ["reduced_velocity", "pitch_amplitude_deg"])
        marks = np.vstack([line.get_xydata() for line in pitch.lines if line.get_marker() == "o"])
        self.assertGreater(len(marks), 3)
        for speed, amplitude in marks:
            near = np.argmin(np.abs(table["pitch_amplitude_deg"] - amplitude))
            self.assertAlmostEqual(amplitude, table["pitch_amplitude_deg"][near], places=3)
            self.assertAlmostEqual(speed, table["reduced_velocity"][near], places=9)
