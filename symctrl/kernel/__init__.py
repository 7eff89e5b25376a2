"""The independent checker of certificates: the standard library alone, nothing from the rest of symctrl.

Soundness-critical. Last reviewed 2026-11-24. Relies on no theorem itself; each file names its own.

check          the answer about a certificate or a bundle, and the table of kinds of proof
loading        its JSON, read strictly into values (certificate, values, form, closure)
evaluation     the walk over listings in any domain (chain: operations and their derivatives)
replay         that walk over exact values (polynomial, field, generators, functions, conditions)
identity, conforms, combination, squeeze, definite, witness    one file for each kind of proof
sums           identities of sums over any graph
printing       the verified statement as text
"""
