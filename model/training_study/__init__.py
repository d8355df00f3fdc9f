"""`artgen study ablations`, `scaling` and `shift`: what makes training work, by paired runs."""
