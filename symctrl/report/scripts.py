"""Scripts (thin)."""

from symctrl.report.page import Script
from symctrl.rows import Row

PROGRAM = ""


def script(study: str, row: Row) -> Script:
    return Script(why_not="no script yet")
