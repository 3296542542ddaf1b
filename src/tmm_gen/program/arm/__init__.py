"""From a row of elements to its program."""
