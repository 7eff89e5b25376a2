"""Deciding theorems: closed loops as data, the search for the proofs of their arguments, counterexamples."""
