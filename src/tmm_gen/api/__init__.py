"""The Python interface: an arm of a scene file or of tables, and all that can be asked of it.

>>> import tmm_gen as tg
>>> tg.load("scenes/elbow.toml").simulate(2.0, shoulder_torque=0.05).plot("swing.png")  # doctest: +SKIP

What it answers is found by the functions that the command line calls too.
"""
