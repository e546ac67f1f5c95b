"""The accuracy dial: which way to d_norm is the cheapest that is certified to be good enough."""
