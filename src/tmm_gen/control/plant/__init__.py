"""The finer arm that controllers are tried on."""
