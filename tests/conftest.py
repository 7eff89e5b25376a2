"""What all tests share: none reads or writes the user's own store of verdicts."""

import pytest


@pytest.fixture(scope="session", autouse=True)
def _store_of_its_own(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SYMCTRL_CACHE", str(tmp_path_factory.mktemp("store")))
        yield
