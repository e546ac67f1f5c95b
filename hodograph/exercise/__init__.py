"""The teaching exercise carried out: from Euler to Runge-Kutta, Scipy and quadratic drag."""
