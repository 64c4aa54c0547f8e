"""Pressure in steady flow on the section before and after an optimisation."""

from optimization import SOURCE, compared_runs
from pressure import SOURCE as SURFACE
from pressure import mark_sonic, plot_instance, read_instances
from read import case_value, read_case, read_result
from style import COLOURS, plt

__all__ = ["CAPTION", "NAME", "SOURCE", "draw"]

NAME = "optimization_pressure"
CAPTION = ("Pressure coefficient in steady flow on the undeformed and the optimised section, suction upwards; full: "
           "upper surface, broken: lower.")


def label_of(name, run):
    drag = (read_result(run).get("steady") or {}).get("cd")
    return name + (f", $C_D$ = {drag:.4g}" if drag is not None else "")


def draw(folder):
    runs = compared_runs(folder, "steady", SURFACE)
    if runs is None:
        return None
    figure, axes = plt.subplots(figsize=(8, 5.4), layout="constrained")
    for name, run in runs:
        found = read_instances(run)
        if found is not None:
            table, instances = found
            plot_instance(axes, table["x_body"], table["cp"], instances[0][1], COLOURS[name], label_of(name, run))
    axes.plot([], [], color=COLOURS["line"], linestyle=(0, (4, 2)), label="lower surface")
    mark_sonic(axes, runs[0][1])
    axes.invert_yaxis()
    mach = case_value(read_case(runs[0][1]), "flow", "mach")
    axes.set(xlabel="x / c", ylabel=r"pressure coefficient $C_p$")
    axes.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    figure.suptitle("Pressure in steady flow" + (f", Mach {mach:g}" if mach else ""), fontsize=11)
    return figure
