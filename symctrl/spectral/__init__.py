"""Extreme eigenvalues between exact rationals, of small matrices and of the Laplacians of large graphs."""
