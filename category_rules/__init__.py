"""One TOML file per category: what may vary, and within which bounds."""
