"""A theorem of a study that is made for one test, and what became of it."""

from symctrl import Study, claim
from symctrl.verify import verify


def states(*names):
    """A study with these scalar states."""
    study = Study("loop")
    return (study, *(study.state(name) for name in names))


def theorem(study, then, lines, given=()):
    """The study with one theorem and one argument, whose lines are those of the function."""

    @study.claimed("1")
    def statement():
        """What is claimed."""
        return claim(given=list(given), then=list(then))

    @study.argument(statement)
    def argument(run):
        lines(run)

    return study


def decided(study):
    """The theorem's row, and the roles of the obligations that are not met, with their reasons."""
    rows = verify(study).rows
    (row,) = [row for row in rows if row.id == "statement"]
    unmet = {r.role: r.reason for r in rows if r.form == "obligation" and r.verdict != "proved"}
    return row, unmet


def assert_proved(study):
    row, unmet = decided(study)
    assert (row.verdict, unmet) == ("proved", {}), row.reason
    assert row.stands


def assert_open(study, role, reason):
    """Undecided, with an unmet obligation of this role, or a conclusion that no line gives (role None)."""
    row, unmet = decided(study)
    assert row.verdict == "undecided"
    assert not row.stands
    assert reason in row.reason
    if role is None:
        assert not unmet
        assert "no line gives" in row.reason
    else:
        assert role in unmet


def collector():
    """A list of false theorems, and the decorator that enters one with what is missing and its reason."""
    found = []

    def false(role, reason):
        def enter(build):
            found.append((build, role, reason))
            return build

        return enter

    return found, false
