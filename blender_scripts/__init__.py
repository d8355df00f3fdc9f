"""The only package that imports bpy; started as a process, imported by nobody."""
