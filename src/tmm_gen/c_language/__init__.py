"""What C asks of whoever writes it: names that are free, number types and their literals, lines that fit."""
