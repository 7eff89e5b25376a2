"""Named problems with known answers: (polynomial, set, answer); None where an answer is not asked for.

Sources: Reznick, Some concrete aspects of Hilbert's 17th problem (2000), for the forms; the global
optimisation problems are those of Munoz and Narkawicz, Formalization of Bernstein polynomials (JAR 51, 2013);
the two-dimensional test functions are folklore.
"""

MOTZKIN = "x^4*y^2 + x^2*y^4 - 3*x^2*y^2 + 1"
ROBINSON = "x^6 + y^6 + z^6 - (x^4*y^2 + x^4*z^2 + y^4*x^2 + y^4*z^2 + z^4*x^2 + z^4*y^2) + 3*x^2*y^2*z^2"
CHOI_LAM = "w^4 + x^2*y^2 + y^2*z^2 + z^2*x^2 - 4*x*y*z*w"
HORN = (
    "x1^4+x2^4+x3^4+x4^4+x5^4 - 2*(x1^2*x2^2+x2^2*x3^2+x3^2*x4^2+x4^2*x5^2+x5^2*x1^2)"
    " + 2*(x1^2*x3^2+x2^2*x4^2+x3^2*x5^2+x4^2*x1^2+x5^2*x2^2)"
)
GOLDSTEIN = (
    "(1+(x+y+1)^2*(19-14*x+3*x^2-14*y+6*x*y+3*y^2))*(30+(2*x-3*y)^2*(18-32*x+12*x^2+48*y-36*x*y+27*y^2))"
)
HIMMELBLAU = "(x^2+y-11)^2 + (x+y^2-7)^2"
CAMEL = "4*x^2 - 21/10*x^4 + x^6/3 + x*y - 4*y^2 + 4*y^4"
BUTCHER = "x6*x2^2 + x5*x3^2 - x1*x4^2 + x4^3 + x4^2 - x1/3 + 4/3*x4"
BUTCHER_BOX = (
    "x1>=-1,x1<=0,x2>=-0.1,x2<=0.9,x3>=-0.1,x3<=0.5,x4>=-1,x4<=-0.1,x5>=-0.1,x5<=-0.05,x6>=-0.1,x6<=-0.03"
)
CAPRASSE = "-x*z^3 + 4*y*z^2*w + 4*x*z*w^2 + 2*y*w^3 + 4*x*z + 4*z^2 - 10*y*w - 10*w^2 + 2"
CAPRASSE_BOX = "x^2<=1/4, y^2<=1/4, z^2<=1/4, w^2<=1/4"
PROVED, REFUTED, EMPTY = "proved", "refuted", "vacuous"

PROBLEMS: dict[str, tuple[str, str, str | None]] = {
    "motzkin": (MOTZKIN, "", PROVED),
    "motzkin less": (f"{MOTZKIN} - 1e-12", "", REFUTED),
    "robinson": (ROBINSON, "", PROVED),
    "robinson less": (f"{ROBINSON} - 1e-12*x^6", "", REFUTED),
    "choi-lam": (CHOI_LAM, "", PROVED),
    "choi-lam sextic": ("x^4*y^2 + y^4*z^2 + z^4*x^2 - 3*x^2*y^2*z^2", "", PROVED),
    "choi-lam less": (f"{CHOI_LAM} - 1e-12*w^4", "", REFUTED),
    "horn": (HORN, "", PROVED),
    "schmuedgen": (
        "200*((x^3-4*x*z^2)^2+(y^3-4*y*z^2)^2)+(y^2-x^2)*x*(x+2*z)*(x^2-2*x*z+2*y^2-8*z^2)",
        "",
        None,
    ),
    "stengle": ("x^3*z^3 + (y^2*z - x^3 - z^2*x)^2", "", None),
    "scheiderer": (
        "x^4+x*y^3+y^4-3*x^2*y*z-4*x*y^2*z+2*x^2*z^2+x*z^3+y*z^3+z^4",
        "",
        None,
    ),
    "rosenbrock": ("100*(y-x^2)^2 + (1-x)^2", "", PROVED),
    "rosenbrock less": ("100*(y-x^2)^2 + (1-x)^2 - 1e-12", "", REFUTED),
    "himmelblau": (HIMMELBLAU, "", PROVED),
    "himmelblau less": (f"{HIMMELBLAU} - 1e-12", "", REFUTED),
    "three-hump camel": ("2*x^2 - 1.05*x^4 + x^6/6 + x*y + y^2", "", PROVED),
    "six-hump camel": (f"{CAMEL} + 1.0317", "", PROVED),
    "six-hump camel less": (f"{CAMEL} + 1.0316", "", REFUTED),
    "goldstein": (f"{GOLDSTEIN} - 3", "", PROVED),
    "goldstein less": (f"{GOLDSTEIN} - 3.000001", "", REFUTED),
    "irrational zeros": ("(x^2-2)^2 + (y^2-3)^2", "", PROVED),
    "irrational zeros less": ("(x^2-2)^2 + (y^2-3)^2 - 1e-40", "", REFUTED),
    "infimum at infinity": ("(x*y-1)^2 + x^2", "", PROVED),
    "infimum at infinity less": ("(x*y-1)^2 + x^2 - 1e-9", "", REFUTED),
    "butcher": (f"{BUTCHER} + 1.4394", BUTCHER_BOX, PROVED),
    "butcher less": (f"{BUTCHER} + 1.4393", BUTCHER_BOX, REFUTED),
    "caprasse": (f"{CAPRASSE} + 3.1801", CAPRASSE_BOX, PROVED),
    "caprasse less": (f"{CAPRASSE} + 3.18", CAPRASSE_BOX, REFUTED),
    "circle": ("x*y + 1/2", "x^2+y^2 == 1", PROVED),
    "circle less": ("x*y + 1/2 - 1e-12", "x^2+y^2 == 1", REFUTED),
    "sphere": ("x*y + y*z + z*x + 1/2", "x^2+y^2+z^2 == 1", PROVED),
    "sphere less": ("x*y + y*z + z*x + 1/2 - 1e-9", "x^2+y^2+z^2 == 1", REFUTED),
    "two circles": ("a*c + b*d + 1", "a^2+b^2 == 1, c^2+d^2 == 1", PROVED),
    "corners": ("x + y + z + 3", "x^2 == 1, y^2 == 1, z^2 == 1", PROVED),
    "corners less": ("x + y + z + 5/2", "x^2 == 1, y^2 == 1, z^2 == 1", REFUTED),
    "quadrant": ("x*y", "x >= 0, y >= 0", PROVED),
    "ball": ("1 - x*y*z", "1 - x^2 - y^2 - z^2 >= 0", PROVED),
    "parabola": ("y - x^2 + 1", "y == x^2", PROVED),
    "empty disc": ("-1", "x^2 + y^2 <= -1", EMPTY),
    "empty triangle": ("x", "x >= 0, y >= 0, x + y <= -1", EMPTY),
    "line beside a disc": ("x - 5", "x + y >= 3, x^2 + y^2 <= 4", EMPTY),
    "cubic": ("x^3", "x >= 0", PROVED),
    "interval": ("x^2*(1-x^2)*(x+2)", "1-x^2 >= 0", PROVED),
    "interval less": ("x*(1-x) - 1e-15", "x >= 0, x <= 1", REFUTED),
    "double root less": ("x^4 - 4*x^2 + 4 - 1e-60", "", REFUTED),
    "zero": ("0*x", "", PROVED),
    "constant": ("x - x - 1", "", REFUTED),
    "odd": ("x^3 + 10^9*x^2 + 10^20", "", REFUTED),
    "badly scaled": ("10^30*x^4 + 10^-30*y^4 - x^2*y^2".replace("10^-30", "1e-30"), "", PROVED),
    "badly scaled less": ("10^30*x^4 + 1e-30*y^4 - 3*x^2*y^2", "", REFUTED),
}
