"""The intermediate representation: variables over stations, loops, assignments, and passes over them."""
