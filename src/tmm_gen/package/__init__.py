"""A scene's generated package: its texts from all backends, on disk whole or not at all, remembered."""
