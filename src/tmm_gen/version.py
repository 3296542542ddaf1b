"""The version: the one place it is written, read by the build and by the headers of generated files."""

__all__ = ["__version__"]

__version__ = "0.2.0"
