"""Check certificate files: `python -m symctrl.kernel FILE...`.

Soundness-critical. Last reviewed 2026-11-24. Relies on no theorem: it prints the answers of `check`.
"""

from __future__ import annotations

import sys

from symctrl.kernel.check import check_file, exit_code


def main(paths: list[str]) -> int:
    """Print one answer a file; 0 all valid, 2 one unreadable (or no file), 1 one invalid, 3 one declined."""
    if not paths:
        print("usage: python -m symctrl.kernel FILE...", file=sys.stderr)
    answers = []
    for path in paths:
        answer = check_file(path)
        answers.append(answer)
        print(f"{path}: {answer.status}: {answer.reason}")
        if answer.statement:
            print(answer.statement)
    return exit_code(answers)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
