"""Microcontrollers: cross-compile a scene's C, run it in an emulator, hold bits and cost against host and budget."""

from tmm_gen.target.boards import BOARDS, Board
from tmm_gen.target.budget import BudgetRow, against_budget
from tmm_gen.target.measurement import Measurement, measure
from tmm_gen.target.proof import Proof, prove

__all__ = ["BOARDS", "Board", "BudgetRow", "Measurement", "Proof", "against_budget", "measure", "prove"]
