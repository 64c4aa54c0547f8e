"""Aerodynamic matrices of the section before and after an optimisation."""

from aerodynamic_matrix import SOURCE as MATRIX
from aerodynamic_matrix import overlay
from optimization import SOURCE, compared_runs

__all__ = ["CAPTION", "NAME", "SOURCE", "draw"]

NAME = "optimization_matrix"
CAPTION = ("Size and phase of the aerodynamic matrix against reduced frequency, of the undeformed (full) and the "
           "optimised section (broken).")


def draw(folder):
    runs = compared_runs(folder, "pk", MATRIX)
    return None if runs is None else overlay(runs)
