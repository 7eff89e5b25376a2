"""Write the arena: `python -m tests.arena.build`. Each case is a small certificate with its right answer.

good/    right proofs: valid
bad/     every known way to fool a prover: invalid
corner/  what is vacuous, unknown or too large: the answer stands in expected.json
"""

from __future__ import annotations

import json
from pathlib import Path

from tests.arena import arguments, bad, bad_arguments, corner, false_arguments, good, laplacians, polynomials

ROOT = Path(__file__).parent


def main() -> None:
    expected = {}
    rights = {**good.CASES, **arguments.CASES, **laplacians.GOOD, **polynomials.GOOD}
    wrongs = {
        **bad.CASES,
        **bad_arguments.CASES,
        **false_arguments.CASES,
        **laplacians.BAD,
        **polynomials.BAD,
    }
    corners = {**corner.CASES, **bad_arguments.DECLINED, **laplacians.CORNER, **polynomials.CORNER}
    for folder, cases in (("good", rights), ("bad", wrongs), ("corner", corners)):
        for old in (ROOT / folder).glob("*.json"):
            old.unlink()
        (ROOT / folder).mkdir(exist_ok=True)
        for name, case in cases.items():
            status, content = (
                case if folder == "corner" else ("valid" if folder == "good" else "invalid", case)
            )
            text = content if isinstance(content, str) else json.dumps(content, sort_keys=True)
            (ROOT / folder / f"{name}.json").write_text(text + "\n", encoding="utf-8")
            expected[f"{folder}/{name}.json"] = status
    (ROOT / "expected.json").write_text(
        json.dumps(expected, indent=1, sort_keys=True) + "\n", encoding="utf-8"
    )


if __name__ == "__main__":
    main()
