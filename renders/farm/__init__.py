"""Rendering on other machines: plans as folders of plain files, and what comes back."""
