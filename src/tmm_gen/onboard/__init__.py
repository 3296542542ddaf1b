"""Controllers as C for a microcontroller: everything numeric prepared here, only the loop of a sample in C."""
