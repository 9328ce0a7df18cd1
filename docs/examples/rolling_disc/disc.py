"""The disc that rolls on a plane, from its Lagrangian, the constraint and the Lagrange-d'Alembert principle.

The frames and the names are those of SymPy's documentation: q1 is the heading, about the vertical N.z; q2 the lean,
about Y.x; q3 the turn of the disc about its axis L.y.  The disc touches the plane r below its centre along L.z.
sᵢ and cᵢ are sin qᵢ and cos qᵢ, dᵢ is qᵢ', and aᵢ is qᵢ''.
"""

from functools import cache

import sympy as sp

from chapsym.derive import Quotient
from chapsym.prove import equations, rational_point

s = sp.symbols("s1:4")
c = sp.symbols("c1:4")
d = sp.symbols("d1:4")
a = sp.symbols("a1:4")
u = sp.symbols("u1:4")  # the angular velocity along L.x, L.y, L.z
centre, velocity, acceleration = (sp.symbols(f"{name}1:4") for name in "xvb")
r, m, g = sp.symbols("r m g")

ALGEBRA = Quotient((*s, *c, *d, *a, *u, r, m, g), [x**2 + y**2 - 1 for x, y in zip(s, c, strict=True)])
equal = equations(ALGEBRA)


def by_angle(expr, i):
    """∂/∂qᵢ."""
    return sp.diff(expr, s[i]) * c[i] - sp.diff(expr, c[i]) * s[i]


def by_time(expr):
    """d/dt."""
    moved = sum(by_angle(expr, i) * d[i] + sp.diff(expr, d[i]) * a[i] for i in range(3))
    for now, rate in ((centre, velocity), (velocity, acceleration)):
        moved += sum(sp.diff(expr, x) * y for x, y in zip(now, rate, strict=True))
    return moved


HEADING = sp.Matrix([[c[0], -s[0], 0], [s[0], c[0], 0], [0, 0, 1]])
LEAN = HEADING * sp.Matrix([[1, 0, 0], [0, c[1], -s[1]], [0, s[1], c[1]]])
ATTITUDE = LEAN * sp.Matrix([[c[2], 0, s[2]], [0, 1, 0], [-s[2], 0, c[2]]])
UP = sp.Matrix([0, 0, 1])


@cache
def spin():
    """The angular velocity along L.x, L.y, L.z, of the skew matrix R'Rᵀ."""
    skew = (LEAN.T * ATTITUDE.applyfunc(by_time) * ATTITUDE.T * LEAN).applyfunc(ALGEBRA.normal)
    return sp.Matrix([skew[2, 1], skew[0, 2], skew[1, 0]])


@cache
def inertia():
    """The moments about L.x, L.y, L.z: m (|x|² - x xᵀ), averaged over a thin uniform disc across L.y."""
    distance, angle = sp.symbols("distance angle", positive=True)
    x = distance * sp.Matrix([sp.cos(angle), 0, sp.sin(angle)])
    density = m * (x.dot(x) * sp.eye(3) - x * x.T) * distance / (sp.pi * r**2)
    return density.applyfunc(lambda e: sp.integrate(e, (angle, 0, 2 * sp.pi), (distance, 0, r)))


@cache
def rolling():
    """The velocity of the centre, along L.x, L.y, L.z, for which the point that touches the plane is at rest."""
    return -spin().cross(-r * UP)


@cache
def height():
    """How high the centre is above the plane."""
    return (r * LEAN * UP).dot(UP)


def lagrangian(potential):
    """The kinetic energy of the free disc, less a potential energy."""
    speed = sp.Matrix(velocity)
    return m * speed.dot(speed) / 2 + spin().dot(inertia() * spin()) / 2 - potential


@cache
def principle():
    """For each δqᵢ what the principle sets to 0.

    It says that Σ (d/dt ∂L/∂ẋ - ∂L/∂x) δx = 0 for the variations of angles and centre that the constraint allows:
    those of the centre follow from those of the angles as its velocity does from d.
    """
    free = lagrangian(m * g * centre[2])
    allowed = LEAN * rolling()
    motion = dict(zip(acceleration, allowed.applyfunc(by_time), strict=True))
    push = [by_time(sp.diff(free, v)) - sp.diff(free, x) for x, v in zip(centre, velocity, strict=True)]
    found = []
    for i in range(3):
        own = by_time(sp.diff(free, d[i])) - by_angle(free, i)
        carried = sum(f.xreplace(motion) * sp.diff(w, d[i]) for f, w in zip(push, allowed, strict=True))
        found.append(ALGEBRA.normal(sp.expand(own + carried)))
    return found


@cache
def matrix():
    """The coefficients of q1'', q2'', q3'' in the equations of the principle."""
    return sp.Matrix(principle()).jacobian(a)


@cache
def accelerations():
    """q1'', q2'', q3'', where cos q2 and m r are not 0."""
    rest = -sp.Matrix(principle()).xreplace(dict.fromkeys(a, sp.S.Zero))
    solved = matrix().adjugate() * rest / matrix().det()
    return [ALGEBRA.normal(sp.numer(e)) / ALGEBRA.normal(sp.denom(e)) for e in map(sp.cancel, solved)]


def in_motion(expr):
    """With the accelerations of the disc for aᵢ."""
    return expr.xreplace(dict(zip(a, accelerations(), strict=True)))


def by_spin(expr):
    """With the rates of the angles written in u1, u2, u3."""
    return expr.xreplace(sp.solve([x - y for x, y in zip(spin(), u, strict=True)], d))


#: What the principle sets to 0, as a statement that carries the accelerations.
LINEAR = "the equations of the principle are linear in q1'', q2'', q3''"


def moving(p):
    """That the principle determines the accelerations, as lemmas of a proof."""
    p.assume("m, r and cos q2 are not 0: the disc does not lie flat", *(sp.Ne(x, 0) for x in (m, r, c[1])))
    rest = sp.Matrix(principle()).xreplace(dict.fromkeys(a, sp.S.Zero))
    p.lemma(
        equal(LINEAR, principle(), matrix() * sp.Matrix(a) + rest),
        equal("the determinant of the equations of the principle", matrix().det(), 15 * m**3 * r**6 * c[1] ** 2 / 32),
        equal("the accelerations solve them", [in_motion(e) for e in principle()], [0, 0, 0]),
    )


def seen_moving():
    """An exact point of the motion of the disc: angles, rates, and the accelerations that the principle gives."""
    values = dict(zip(d, (1, 2, -1), strict=True)) | {r: sp.Rational(1, 2), m: 3, g: 10}
    for i, (sine, cosine) in enumerate((("5/13", "12/13"), ("3/5", "4/5"), ("8/17", "15/17"))):
        values |= {s[i]: sp.Rational(sine), c[i]: sp.Rational(cosine)}
    values |= {x: in_motion(x).xreplace(values) for x in a}
    return rational_point(
        values,
        [
            equal("sin² + cos² = 1", [x**2 + y**2 for x, y in zip(s, c, strict=True)], [1, 1, 1]),
            equal("the principle", principle(), [0, 0, 0]),
        ],
    )
