"""Machinery: checks, the closed form, quadrature, the fall, a whole flight, paths, derivatives."""
