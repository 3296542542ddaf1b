"""From a program to text: one folder per language, no physics. docs/architecture.md says how to add a backend."""
