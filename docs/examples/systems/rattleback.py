"""A rattleback: an ellipsoid that rolls on a plane, whose axes of inertia are turned against those of its shape."""

from sympy import Matrix, diag, sqrt, symbols

from chapsym.mechanics import System, Turned, dot, rate

x, y, heading, pitch, roll = q = symbols("x y heading pitch roll")  # x, y: the centre of mass
mass, gravity, a, b, c, below, A, B, C, skew = symbols("mass gravity a b c below A B C skew")

body = Turned(("z", heading), ("y", pitch), ("x", roll))
up = body.rotation.T * Matrix([0, 0, 1])  # in the axes of the body
support = sqrt(a**2 * up[0] ** 2 + b**2 * up[1] ** 2 + c**2 * up[2] ** 2)
touching = -diag(a**2, b**2, c**2) * up / support + Matrix([0, 0, below])  # from the centre of mass
height = -touching.dot(up)
velocity = Matrix([dot(x), dot(y), rate(height, q)])
slip = velocity + body.rotation * body.spin.cross(touching)
inertia = Matrix([[A, skew, 0], [skew, B, 0], [0, 0, C]])

SYSTEM = System(
    "rattleback",
    coordinates=q,
    lagrangian=mass * velocity.dot(velocity) / 2 + body.spin.dot(inertia * body.spin) / 2 - mass * gravity * height,
    constraints=[slip[0], slip[1]],
    parameters={
        mass: 1, gravity: "9.81", a: "1/5", b: "3/100", c: "1/50", below: "1/100", A: "2e-4", B: "1.6e-3", C: "1.7e-3",
        skew: "-2e-5",
    },
    start={pitch: "1/200", dot(heading): -5},
    step="1/400",
    source="A. Garcia, M. Hubbard, Proc. R. Soc. A 418 (1988) 165",
)  # fmt: skip
