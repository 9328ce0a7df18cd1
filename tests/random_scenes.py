"""Scenes with physical starts, drawn from a seed: every way to say a body and a start, slow and fast, dense and sparse.

`scene(n)` is the n-th, a dict of tables: the same on every machine.
"""

import math
from random import Random

import numpy as np
from motion_reference import matrix, si

#: How many there are.
COUNT = 40
#: Radians in which a ball near the separatrix has left it.
LONG = 100.0
FOLLOWED = ["omega", "gamma", "attitude", "contact"]


def scene(n):
    """The n-th scene; bodies, starts and lengths go round at different paces, the rest is drawn."""
    r = Random(f"scene {n}")
    if n % 8 == 7:
        return several(r, n)
    ball = body(r, n)
    start = start_of(n)(r, ball)
    found = {"title": f"Random scene {n}", "ball": ball, "start": start}
    if r.random() < 0.4:
        start["position"] = [number(r, -2, 2), "25 cm"] if r.random() < 0.5 else [number(r, -2, 2), number(r, -2, 2)]
    return found | {"run": run(r, n, rate(start, ball), LONG if start_of(n) is near_an_axis else 0.0)}


def several(r, n):
    """Two or three balls, each with its own start or that of all."""
    balls = []
    for i in range(2 + n // 8 % 2):
        ball = body(r, n + 3 * i) | {"name": "abc"[i] * 3}
        if i:
            ball["start"] = start_of(n + 2 * i)(r, ball) | {"position": [number(r, -1, 1), f"{10 * i} cm"]}
        balls.append(ball)
    start = omega(r)
    return {"title": f"Random scene {n}", "ball": balls, "start": start, "run": run(r, n, rate(start, balls[0]))}


def number(r, low, high):
    """A number of five digits."""
    return float(f"{r.uniform(low, high):.5g}")


def direction(r):
    """A unit vector, not near to (0, 0, -1), where the least rotation to the vertical turns with every rounding."""
    z, angle = r.uniform(-0.9, 1.0), r.uniform(0, 2 * math.pi)
    return [math.sqrt(1 - z * z) * math.cos(angle), math.sqrt(1 - z * z) * math.sin(angle), z]


def quaternion(r):
    """A unit quaternion, evenly on the sphere."""
    q = [r.gauss(0, 1) for _ in range(4)]
    return [x / math.hypot(*q) for x in q]


def sized(r):
    """Mass in kg and radius in m, as they are and as texts."""
    mass, radius = number(r, 0.2, 8.0), number(r, 0.03, 0.3)
    pounds, millimetres = number(r, 1, 18), number(r, 40, 200)
    if r.random() < 0.5:
        return {"mass": mass, "radius": radius}, mass, radius
    return {"mass": f"{pounds} lb", "radius": f"{millimetres} mm"}, 0.45359237 * pounds, millimetres / 1000


def moments(r, mass, radius, strongly):
    """(∫x²dm, ∫y²dm, ∫z²dm) within the ball: nearly alike, or of three sizes."""
    shares = (
        [1.0, r.uniform(0.01, 0.3), r.uniform(0.0, 0.01)] if strongly else [1.0, r.uniform(0.7, 1), r.uniform(0.7, 1)]
    )
    r.shuffle(shares)
    whole = r.uniform(0.3, 0.95) * mass * radius**2 / sum(shares)
    return [whole * share for share in shares]


def principal(r, strongly, key="inertia"):
    """Three moments: of inertia, or of mass."""
    words, mass, radius = sized(r)
    x, y, z = moments(r, mass, radius, strongly)
    three = (y + z, x + z, x + y) if key == "inertia" else (x, y, z)
    return {key: [float(f"{a:.6g}") for a in three], **words}


def with_units(r):
    """Moments in kg cm², one of them a fraction."""
    return {
        "inertia": [f"{number(r, 50, 60)} kg cm^2", "131/2 kg cm^2", "0.0081"],
        "mass": "2500 g",
        "radius": "9.5 cm",
    }


def tensor(r, strongly):
    """A full tensor of inertia, symmetric to the last bit."""
    words, mass, radius = sized(r)
    J, Q = moments(r, mass, radius, strongly), matrix(np.array(quaternion(r)))
    inertia = sum(J) * np.eye(3) - Q @ np.diag(J) @ Q.T
    return words | {"inertia": [[float(f"{inertia[min(i, j), max(i, j)]:.9g}") for j in range(3)] for i in range(3)]}


def top(r):
    """A ball that floats, D = 0, beside a contact term of its own."""
    return {"mass_tensor": [number(r, 0.5, 2) for _ in range(3)], "D": r.choice([0.0, number(r, 1, 9)]), "radius": 0.5}


def shell(r):
    thick = {"thickness": f"{number(r, 1, 20)} mm"} if r.random() < 0.5 else {}
    return {"preset": "shell", **sized(r)[0], **thick}


def dumbbell(r):
    words, mass, radius = sized(r)
    inside = {"point_mass": number(r, 0.1, 0.45) * mass, "separation": number(r, 0.5, 1.6) * radius}
    return {"preset": "dumbbell", **words, **inside, "thickness": 0.1 * radius}


def bowling(r):
    block = {"block_mass": number(r, 0.2, 1.0), "block_size": ["6 cm", 0.04, f"{number(r, 20, 80)} mm"]}
    offset = [number(r, 0.005, 0.02), number(r, -0.02, 0.02), number(r, 0.01, 0.035)]
    return {"preset": "bowling", "mass": "15 lb", "radius": "108.5 mm", **block, "block_offset": offset}


BODIES = [
    lambda r: principal(r, False), lambda r: tensor(r, True), lambda r: principal(r, True, "mass_tensor"),
    bowling, with_units, lambda r: tensor(r, False), dumbbell, top, lambda r: principal(r, True), shell,
    lambda r: {"preset": "homogeneous", **sized(r)[0]},
]  # fmt: skip


def body(r, n):
    return BODIES[n % len(BODIES)](r)


def omega(r, ball=None):
    """ω in the body, and γ or nothing."""
    found = {"omega": [number(r, -15, 15) for _ in range(3)]}
    return found | ({"gamma": direction(r)} if r.random() < 0.8 else {})


def in_space(r, ball=None):
    return {"omega": [number(r, -12, 12) for _ in range(3)], "axes": "space", "attitude": quaternion(r)}


def in_space_of_gamma(r, ball=None):
    return {"omega": [number(r, -12, 12) for _ in range(3)], "axes": "space", "gamma": ["2/7", "-3/7", "6/7"]}


def velocity(r, ball=None):
    found = {"velocity": [number(r, -1.5, 1.5), f"{number(r, 1, 6)} km/h"], "attitude": quaternion(r)}
    return found | ({"spin": f"{number(r, -150, 150)} rpm"} if r.random() < 0.8 else {})


def velocity_of_gamma(r, ball=None):
    return {"velocity": [f"{number(r, 10, 90)} cm/s", 0.0], "spin": number(r, -20, 20), "gamma": direction(r)}


def in_units(r, ball=None):
    return {
        "omega": [f"{number(r, 30, 90)} rpm", f"{number(r, -400, 400)} deg/s", number(r, -9, 9)],
        "gamma": direction(r),
    }


def near_an_axis(r, ball):
    """Nearly a rotation about the axis of the middle moment, with γ on it: it leaves this near the separatrix."""
    off = 10.0 ** -r.randint(2, 5)
    known = ball.get("mass_tensor") or ball.get("inertia") or []
    axis = sorted(range(3), key=known.__getitem__)[1] if known and isinstance(known[0], float) else r.randrange(3)
    tilt = [off * r.uniform(-1, 1) if i != axis else 1.0 for i in range(3)]
    spin = [off * r.uniform(-9, 9) if i != axis else number(r, 6, 12) for i in range(3)]
    return {"omega": spin, "gamma": [x / math.hypot(*tilt) for x in tilt]}


def fast(r, ball=None):
    """Some thousand turns a minute."""
    return {"omega": [number(r, -300, 300), f"{number(r, 500, 3000)} rpm", number(r, -300, 300)], "gamma": direction(r)}


def slow(r, ball=None):
    """Of a ball that hardly turns, and rests about two of its axes."""
    return {"omega": [0.0, number(r, -0.2, 0.2), 0.0], "gamma": direction(r)}


STARTS = [
    omega, velocity, near_an_axis, in_space, in_units, velocity_of_gamma, near_an_axis, in_space_of_gamma, slow, fast,
]  # fmt: skip


def start_of(n):
    return STARTS[n % len(STARTS)]


def rate(start, ball):
    """About how fast the ball turns, in rad/s, so that its steps can be as long as they are."""
    if "omega" in start:
        return max(0.1, math.hypot(*(si(x) for x in start["omega"])))
    radius = si(ball["radius"])
    return math.hypot(*(si(x) / radius for x in start["velocity"]), si(start.get("spin", 0.0)))


def run(r, n, rate, least=0.0):
    """[run]: dense and sparse frames, in every way to say them; of 0.7 to 250 radians, and at least so many."""
    turned = max([20.0, 3.0, 80.0, 0.7, 40.0, 250.0, 10.0][n % 7], least)
    kind = n // 3 % 5
    length = r.choice([0.004, 0.02, 0.1])
    step = float(f"{(max(length, turned / 2000) if kind == 0 else length) / rate:.2g}")
    steps = max(round(turned / rate / step), 12)
    words = {"time_step": step if r.random() < 0.5 else f"{1000 * step:.6g} ms"}
    if kind == 0:
        words |= {"steps": steps}
    elif kind == 1:
        words |= {"steps": steps, "every": r.randint(2, 9)}
    else:
        frames = {2: r.randint(2, 9), 3: r.randint(100, 400), 4: 1}[kind]
        every = -(-steps // frames)
        words |= {"time": float(f"{frames * every * step:.12g}"), "frames": frames}
    return words | {"outputs": list(FOLLOWED)}
