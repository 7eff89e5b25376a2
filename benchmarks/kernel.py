"""What checking costs beside deciding: the kernel on every certificate of every installed study.

Run: python benchmarks/kernel.py
"""

from __future__ import annotations

import json
import time

from symctrl.kernel.check import check_text
from symctrl.registry import installed, load
from symctrl.verify import verify

SLOWEST = 12


def main() -> None:
    """Print the slowest certificates, and the sums of all, each beside the time of deciding the claim."""
    rows = []
    for name in installed():
        study = load(name)
        for row in verify(study).rows:
            if row.certificate is not None:
                text = json.dumps(row.certificate)
                began = time.perf_counter()
                status = check_text(text).status
                rows.append((time.perf_counter() - began, row.seconds, len(text), f"{name}/{row.id}", status))
    rows.sort(reverse=True)
    print(f"{'kernel':>9} {'deciding':>9} {'ratio':>6} {'size':>8}  claim")
    for kernel, deciding, size, claim, status in rows[:SLOWEST]:
        mark = "" if status == "valid" else f"  ({status}!)"
        print(f"{kernel:8.3f}s {deciding:8.3f}s {kernel / deciding:6.2f} {size / 1000:6.1f}kB  {claim}{mark}")
    kernel, deciding = sum(row[0] for row in rows), sum(row[1] for row in rows)
    size = sum(row[2] for row in rows)
    print(f"{kernel:8.3f}s {deciding:8.3f}s {kernel / deciding:6.2f} {size / 1000:6.1f}kB  all {len(rows)}")


if __name__ == "__main__":
    main()
