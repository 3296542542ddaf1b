"""What is asked of controllers, in a scene's ``[control]``: the optimal control problem, stated once."""
