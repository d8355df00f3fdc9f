"""Densities of real materials, kg/m3 (engineering handbooks; effective values say so)."""

STEEL = 7850.0
STAINLESS = 7900.0
ALUMINIUM = 2700.0
GLASS = 2500.0
ABS = 1050.0
POLYPROPYLENE = 905.0
RUBBER = 1150.0
OAK = 720.0
PLYWOOD = 620.0
MDF = 740.0
PARTICLEBOARD = 660.0
ZINC = 6600.0
