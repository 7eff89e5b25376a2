"""Certificates about the Laplacian of a graph (docs/certificates.md)."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from symctrl import certify
from symctrl.spectral.network import Network


def statement(network: Network, name: str, t: Fraction, strict: bool) -> dict[str, Any]:
    """That each eigenvalue is at most t (strict: below t); the graph's nodes are numbered from 1."""
    ends = zip((network.a + 1).tolist(), (network.b + 1).tolist(), strict=True)
    graph = {"nodes": network.nodes, "edges": [list(edge) for edge in ends]}
    words = "below" if strict else "at most"
    return {
        "study": "graph",
        "id": name,
        "text": f"each eigenvalue of the Laplacian of {name} is {words} {t}",
        "graph": {**graph, "sha256": certify.digest(graph)},
        "claim": {"kind": f"eigenvalues_{words.replace(' ', '_')}", "bound": str(t)},
    }


def certificate(statement: Mapping[str, Any], proof: Mapping[str, Any]) -> dict[str, Any]:
    """The whole certificate."""
    return certify.certificate(statement, proof)
