"""LaTeX read into MathML: what the library prints, and whatever else it may be given."""

import re
import xml.etree.ElementTree as ET

from hypothesis import given
from hypothesis import strategies as st

from symctrl.report.difference import marked
from symctrl.report.formula import Element, parse
from symctrl.report.mathml import math, pair, signs
from symctrl.report.prose import prose

SAMPLES = [
    r"\dot{q_{i}} = \frac{\left(q_{0,i} I_{3} + q_{\mathrm{cross},i}\right) \omega_{i}}{2}",
    r"\begin{pmatrix} 0 & -q_{i,3} \\ q_{i,3} & 0 \end{pmatrix} \succ 0",
    r"\sum_{j} \left(q_{i} - q_{j}\right)^{\mathsf T} \left|\tau_{i}\right| \ge 0,\quad \lambda_{\max} \le 1",
    r"K_{v} \operatorname{sgn}\left(\tau_{k}\right) \text{ for every small } \bar{u}_d > 0 \implies x' \to 0",
    r"x \in \mathbb{R}^{3 \times 1},\; \sqrt{2} \cdot 10^{-3} \ne \left\|v\right\|_{\infty}",
]
latex = st.lists(
    st.sampled_from(
        [*SAMPLES, r"\beta", "x_{1}", "-", "+", "=", "2", r"\left(", r"\right)", "{", "}", "^", "_"]
    )
)


def as_xml(html):
    """The pieces of a formula as XML; a page has no other parser for what it is given."""
    return ET.fromstring(f"<r>{re.sub('<wbr>', '', html)}</r>")


def text(html):
    return "".join(as_xml(html).itertext())


def test_what_the_library_prints_is_read():
    for sample in SAMPLES:
        assert "\\" not in text(math(sample))
    assert text(math(SAMPLES[0])) == "q˙i=(q0,iI3+qcross,i)ωi2"


def test_a_dot_is_over_the_letter_and_two_dots_are_one_sign():
    assert str(math(r"\dot{q_{i}}")).startswith("<math><msub><mover")
    assert text(math(r"\dot{\dot{q_{i}}}")) == "q¨i"


def test_a_sign_after_a_relation_is_a_prefix():
    assert '<mo form="prefix">−</mo>' in math("a = -b")
    assert "form" not in math("a - b")


@given(st.text() | latex.map(" ".join))
def test_every_text_gives_well_formed_mathml(source):
    as_xml(math(source))


@given(latex.map(" ".join), latex.map(" ".join))
def test_marks_change_nothing_but_the_tint(a, b):
    left, right = marked(parse(a), parse(b))
    assert leaves(left) == leaves(parse(a))
    assert leaves(right) == leaves(parse(b))
    as_xml(pair(a, b)[0])
    as_xml(pair(a, b)[1])


def leaves(parts):
    return [leaf for p in parts for leaf in (leaves(p.parts) if p.parts else [(p.tag, p.text)])]


def tinted(html, how):
    return ["".join(e.itertext()) for e in as_xml(html).iter("mrow") if e.get("class") == how]


def test_only_what_differs_is_tinted():
    left, right = pair(r"\dot{V} = c \omega", r"\dot{V} = -c \omega")
    assert (tinted(left, "del"), tinted(right, "ins")) == ([], ["−"])
    left, right = pair(r"\beta^{2} < 4 k", r"\beta^{2} < 2 k")
    assert (tinted(left, "del"), tinted(right, "ins")) == (["4"], ["2"])
    left, right = pair(r"q_{4} \to 1", r"q_{4}^{2} \to 1")
    assert (tinted(left, "del"), tinted(right, "ins")) == ([], ["2"])


def test_a_bracket_alone_is_no_difference():
    _, right = pair(r"V = \sum_i a s", r"V = 2 \left(\sum_i a s\right)")
    assert tinted(right, "ins") == ["2"]


def test_equal_formulas_and_those_with_nothing_in_common_are_not_tinted():
    for a, b in [("x = y", "x = y"), ("x = y", r"\sum_{j} \tanh\left(z\right) \ge 0")]:
        assert not tinted(pair(a, b)[0], "del") + tinted(pair(a, b)[1], "ins")


def test_long_formulas_may_break_before_relations_and_signs():
    long = " + ".join(f"a_{{{k}}} b_{{{k}}}" for k in range(12)) + " = 0"
    assert math(long).count("<math") > 3
    assert math("a + b = 0").count("<math") == 1


def test_large_matrices_are_shown_by_their_ends():
    row = " & ".join("1" * 1 for _ in range(8))
    whole = rf"\begin{{pmatrix}} {row} \end{{pmatrix}}"
    assert text(math(whole)) == "(11⋯1)"
    assert signs(whole) < 12


def test_elements_that_are_equal_have_equal_trees():
    assert parse("a+b") == parse(" a + b ")
    assert parse("a") == (Element("mi", text="a"),)


def test_names_of_quantities_in_sentences_are_mathematics():
    said = prose("K_o is beta times lambda_max, q0 <= 1; rate_of_V and I/O stay.")
    assert text(said) == "Ko is β times λmax, q0 <= 1; rate_of_V and I/O stay."
    assert "<msub><mi>K</mi><mi>o</mi></msub>" in said


@given(st.text(alphabet=st.characters(blacklist_categories=("Cs", "Cc"))))
def test_sentences_are_escaped(sentence):
    as_xml(prose(sentence))
