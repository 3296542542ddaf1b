"""Pictures, animations and tables."""
