"""What makes the things that ship: law coefficients, interpolant, certificate, reference points."""
