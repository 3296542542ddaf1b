"""Control of a flexible arm with its generated model: estimators, predictive controllers, baselines.

What is solved is stated in :mod:`tmm_gen.control.problem`.
"""
