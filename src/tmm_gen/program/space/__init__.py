"""From an arm in space to its program."""
