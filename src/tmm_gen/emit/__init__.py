"""From a program to text: one folder per language. No physics here."""
