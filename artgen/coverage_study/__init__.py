"""`artgen study coverage`: what the rules really make: parameters, topologies, near-duplicates."""
