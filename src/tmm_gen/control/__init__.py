"""Control of a flexible arm with its generated model: estimators, predictive controllers, baselines.

What is solved is stated in :mod:`tmm_gen.control.task.problem`. Modules that stand here are what users of Python begin
with: a :mod:`~tmm_gen.control.bench`, :mod:`~tmm_gen.control.controllers` by name, and what hands the model over to
other tools. Folders go from the arm to the torque: ``arm``, ``task``, ``sensors``, ``goals``, ``prediction``,
``estimators``, ``quadratic``, ``laws``; ``plant`` is what controllers are tried on.
"""
