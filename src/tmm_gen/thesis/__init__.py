"""What Gholampour (2018) prints, beside what is derived: coefficients, formulas and what their misprints do."""
