"""What several tests use: rows of a report, and what a refusal looks like."""

from symctrl.rows import Row


def row(name, **changed):
    """A proved row that stands, with the given fields changed."""
    fields = {
        "equation": "(7)",
        "statement": "a = b",
        "latex": "a = b",
        "form": "printed",
        "corrects": None,
        "kind": "equal",
        "verdict": "proved",
        "stands": True,
        "conditional": False,
        "reason": "both sides agree",
        "method": "exact",
    }
    return Row(id=name, **{**fields, **changed})


def refused(result, says):
    """The command ended with 2 and one line on standard error that says `says`."""
    code, out, err = result
    assert code == 2
    assert out == ""
    assert err.startswith("symctrl: ")
    assert err.count("\n") == 1
    assert says in err
