"""The inner loops: one step, and many, of one ball.  Plain scalar Python that numba compiles."""

from chapsym.generated import centre_step, compose, rotate, transport

from .branch import small_rotation


def advance(K, g, J, D, q):
    """One step in place: writes the rotation into q and moves K, g (arrays of 3, 3 and 4).

    Returns (status, reach); nothing is written unless the status is 0.
    """
    status, reach, q0, q1, q2, q3 = small_rotation(K[0], K[1], K[2], g[0], g[1], g[2], J[0], J[1], J[2], D)
    if status == 0:
        q[0], q[1], q[2], q[3] = q0, q1, q2, q3
        K[0], K[1], K[2] = transport(q0, q1, q2, q3, K[0], K[1], K[2])
        g[0], g[1], g[2] = transport(q0, q1, q2, q3, g[0], g[1], g[2])
    return status, reach


def follow_body(q, g, attitude, contact, radius):
    """Moves the contact point and the attitude by the step q that begins at the vertical g."""
    s1, s2, s3 = centre_step(q[0], q[1], q[2], q[3], g[0], g[1], g[2])
    x, y, _ = rotate(attitude[0], attitude[1], attitude[2], attitude[3], s1, s2, s3)
    contact[0] += radius * x
    contact[1] += radius * y
    a0, a1, a2, a3 = compose(attitude[0], attitude[1], attitude[2], attitude[3], q[0], q[1], q[2], q[3])
    # One Newton step to length 1: the product of unit quaternions is off by a rounding only.
    scale = 1.5 - 0.5 * (a0 * a0 + a1 * a1 + a2 * a2 + a3 * a3)
    attitude[0], attitude[1], attitude[2], attitude[3] = a0 * scale, a1 * scale, a2 * scale, a3 * scale


def march(
    K, g, J, D, q, first, count, every, momenta, verticals, with_body, attitude, contact, radius, attitudes, traces
):
    """Takes `count` steps from the step `first` on; keeps every `every`-th state in the frame arrays.

    K, g, q, attitude and contact hold the present state and move.  The attitude and the trace are
    touched only when `with_body`.  Returns (taken, status, reach).
    """
    before = g.copy()
    for k in range(first, first + count):
        if with_body:
            before[0], before[1], before[2] = g[0], g[1], g[2]
        status, reach = advance(K, g, J, D, q)
        if status != 0:
            return k - first, status, reach
        if with_body:
            follow_body(q, before, attitude, contact, radius)
        if (k + 1) % every == 0:
            frame = (k + 1) // every
            momenta[frame, 0], momenta[frame, 1], momenta[frame, 2] = K[0], K[1], K[2]
            verticals[frame, 0], verticals[frame, 1], verticals[frame, 2] = g[0], g[1], g[2]
            if with_body:
                for i in range(4):
                    attitudes[frame, i] = attitude[i]
                traces[frame, 0], traces[frame, 1] = contact[0], contact[1]
    return count, 0, 1.0


def advance_all(K, g, J, D, q, status, reach):
    """One step of each ball of a batch, in place: arrays (n, 3), (n, 3), (n, 3), (n,), (n, 4), (n,), (n,)."""
    for i in range(K.shape[0]):
        status[i], reach[i] = advance(K[i], g[i], J[i], D[i], q[i])
