"""Vial's paper remade: its figures, its fits, and what became of each of its claims."""
