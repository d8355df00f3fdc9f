"""Parts, joints and how they move."""
