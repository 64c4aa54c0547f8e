"""Frequency and damping of the modes before and after an optimisation."""

from optimization import SOURCE, compared_runs
from pk import SOURCE as MODES
from pk import overlay

__all__ = ["CAPTION", "NAME", "SOURCE", "draw"]

NAME = "optimization_pk"
CAPTION = ("Frequency and damping of the modes against speed by the p-k method, of the undeformed (full) and the "
           "optimised section (broken).")


def draw(folder):
    runs = compared_runs(folder, "pk", MODES)
    return None if runs is None else overlay(runs)
