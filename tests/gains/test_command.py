"""`symctrl gains` from the command line: what it prints and writes, and one line for what is wrong."""

import json

import pytest

from tests.samples import refused

STUDY = '''\
"""A loop that decays at the rate a + b."""
from symctrl import Study, claim, exponentially

study = Study("decaying")
x, u = study.state("x"), study.input("u")
a, b, idle = study.gain("a", "2"), study.gain("b", "1"), study.gain("idle", "1")
study.motion(x, -a * x + u)


@study.law("law", u)
def feedback():
    return -b * x


@study.claimed("theorem")
def decay():
    """x decays exponentially."""
    return claim(given=[b <= a**2, a + b <= 4], then=[exponentially(x, rate=a + b)])


@study.argument(decay)
def by_comparison(run):
    run.decays(x**2, a=2 * (a + b))
    run.exponentially(x, by=x**2, least=1)
'''
NAMED = '''\
from symctrl import Study
study = Study("named")
fleet = study.fleet()
k = study.gain("k", "2")


@study.condition("1")
def stiff():
    """k exceeds every eigenvalue."""
    return k > fleet.eigenvalue
'''
SWEEP = ["--sweep", "a=1:3:10", "--sweep", "b=1/2:2:9"]


@pytest.fixture
def study(tmp_path):
    (tmp_path / "decaying.py").write_text(STUDY)
    (tmp_path / "named.py").write_text(NAMED)
    return "decaying.py"


def files(folder):
    return sorted(path.name for path in folder.iterdir() if path.is_file())


def test_table_json_and_picture(run, study, tmp_path):
    made = ["--json", "out.json", "--plot", "map.png", "--maximize", "decay"]
    code, out, err = run("gains", study, *SWEEP, *made)
    assert (code, err) == (0, "")
    assert "decaying: ✓ feasible at a = 2, b = 1" in out
    assert "largest decay found: 4 at " in out
    body = json.loads((tmp_path / "out.json").read_text())
    assert (body["verdict"], len(body["map"]["cells"]), body["maximized"]["value"]) == ("feasible", 9, "4")
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")


def test_json_on_standard_output_is_all_that_is_there(run, study):
    code, out, err = run("gains", study, "--json", "-")
    assert (code, err) == (0, "")
    assert json.loads(out)["study"] == "decaying"


@pytest.mark.parametrize(("setting", "code"), [("b=1", 0), ("b=5", 1)])
def test_the_exit_code_is_the_verdict(run, study, setting, code):
    assert run("gains", study, "--set", setting)[0] == code


def test_the_graph_decides(run, study):
    assert run("gains", "named.py", "--graph", "path:1")[0] == 0
    assert run("gains", "named.py", "--graph", "path:2")[0] == 1  # its eigenvalue is 2, and k = 2


@pytest.mark.parametrize(
    ("sweep", "says"),
    [
        ("", "must be like NAME=LO:HI:COUNT"),
        ("a", "must be like NAME=LO:HI:COUNT"),
        ("a=1:2", "must be like NAME=LO:HI:COUNT"),
        ("a=1:2:3:4", "must be like NAME=LO:HI:COUNT"),
        ("=1:2:3", "must be like NAME=LO:HI:COUNT"),
        ("a=3:1:10", "LO must be less than HI"),
        ("a=1:1:10", "LO must be less than HI"),
        ("a=1:2:1", "a whole number of at least 2"),
        ("a=1:2:0", "a whole number of at least 2"),
        ("a=1:2:-5", "a whole number of at least 2"),
        ("a=1:2:2.5", "a whole number of at least 2"),
        ("a=1:2:", "a whole number of at least 2"),
        ("a=1:2:1e3", "a whole number of at least 2"),
        (f"a=1:2:{'9' * 5000}", "a whole number of at least 2"),
        ("a=one:2:10", "'one' is no exact number"),
        ("a=1:1/0:10", "'1/0' is no exact number"),
        ("a=nan:2:10", "'nan' is no exact number"),
        ("a=1:inf:10", "'inf' is no exact number"),
        ("a=1:1e999999999:10", "is no exact number"),
        ("a=:2:10", "is no exact number"),
        ("A=1:2:10", "no parameter of this name; it has a"),
        ("omega=1:2:10", "no parameter of this name"),
        ("x=1:2:10", "no parameter of this name"),
        ("idle=1:2:10", "no condition reads this gain; there are a, b"),
        ("a=1:2:999999999999", "1.00e+12 cells take about 6000.0 GB"),
    ],
)
def test_a_sweep_that_is_none(run, study, tmp_path, sweep, says):
    before = files(tmp_path)
    refused(run("gains", study, "--sweep", sweep, "--json", "out.json", "--plot", "map.png"), says)
    assert files(tmp_path) == before


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--sweep", "a=1:2:3", "--sweep", "b=1:2:3", "--sweep", "idle=1:2:3"], "one or two gains, not 3"),
        (["--sweep", "a=1:2:3", "--sweep", "a=1:2:3"], "a is swept twice"),
        (["--sweep", "a=1:2:30000000", "--sweep", "b=1:2:30000000"], "take fewer cells"),
        (["--set", "a=nan"], "not an exact number"),
        (["--set", "a=0"], "the gain a must be positive"),
        (["--set", "c=1"], "has no parameter c; it has a"),
        (["--set", "a"], "must be like NAME=VALUE"),
        (["--maximize", "speed"], "what can be made largest is decay or margin"),
        (["--plot", "map.png"], "a picture needs a map"),
        ([*SWEEP, "--plot", "map.gif"], "must end in .png, .svg, .pdf"),
        ([*SWEEP, "--plot", "map"], "must end in .png, .svg, .pdf"),
        ([*SWEEP, "--plot", "no/such/map.png"], "cannot be written"),
        ([*SWEEP, "--json", "no/such/out.json"], "cannot be written"),
        ([*SWEEP, "--json", "."], "is a folder"),
        ([*SWEEP, "--json", "map.png", "--plot", "map.png"], "is the file that --json writes"),
        (["--graph", "ring:5"], "has no fleet, so it takes no graph"),
    ],
)
def test_options_that_go_wrong(run, study, tmp_path, options, says):
    before = files(tmp_path)
    refused(run("gains", study, *options), says)
    assert files(tmp_path) == before


def test_decay_of_a_study_without_an_exponential_bound(run, study):
    refused(run("gains", "named.py", "--maximize", "decay"), "no theorem of the study named that stands")


def test_the_eigenvalue_is_no_gain(run, study):
    refused(run("gains", "named.py", "--sweep", "eigenvalue=1:2:3"), "no parameter of this name; it has k")
    refused(run("gains", "named.py", "--set", "eigenvalue=1"), "has no parameter eigenvalue; it has k")


@pytest.mark.parametrize("text", ["a,b\nb,c\n", '{"nodes": []}', "graph { a -- b }", "<graphml/>", ""])
def test_a_graph_in_another_format(run, study, tmp_path, text):
    (tmp_path / "drawn.txt").write_text(text)
    refused(run("gains", "named.py", "--graph", "drawn.txt"), "graph drawn.txt")


def test_a_study_without_conditions(run, tmp_path):
    (tmp_path / "bare.py").write_text('from symctrl import Study\nstudy = Study("bare")\n')
    refused(run("gains", "bare.py"), "has no condition on gains")


def test_a_gain_without_a_value_is_no_reason_to_stop(run, tmp_path):
    (tmp_path / "open.py").write_text(NAMED.replace(', "2"', ""))
    code, out, _ = run("gains", "open.py", "--sweep", "k=1:9:8")
    assert code in (0, 3)
    assert "8 cells" in out


def test_a_parameter_without_a_value_is_asked_for_before_a_map(run, tmp_path):
    text = NAMED.replace('study.gain("k", "2")', 'study.gain("k", "2")\nm = study.parameter("m")')
    (tmp_path / "mass.py").write_text(text.replace("k > fleet", "k > m + fleet"))
    code, out, _ = run("gains", "mass.py")
    assert code == 3
    assert "m has no value" in out.replace("\n", " ")
    refused(run("gains", "mass.py", "--sweep", "k=1:9:8"), "m has no value; give one with --set m=VALUE")


def test_a_picture_without_matplotlib_says_what_to_install(run, study, monkeypatch):
    from symctrl.gains import command

    monkeypatch.setattr(command, "find_spec", lambda _: None)
    refused(run("gains", study, *SWEEP, "--plot", "map.png"), "pip install 'symctrl[plot]'")
