"""Where an arm is to go: rests, places of its parts, courses over time."""
