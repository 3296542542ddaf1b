"""What happens at a station of a row in every phase, derived from its elements' equations by one recipe."""
