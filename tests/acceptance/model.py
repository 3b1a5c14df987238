"""The vehicle of docs/formulation.md, sections 1 and 2, written from that page alone, and its
integration by an implicit method: nothing here is shared with the program it judges."""

from math import atan, ceil, cos, sin, sqrt

M, IZZ, LA, LB = 2688.7, 4110.1, 1.5775, 1.7245
FZF0, FZR0 = 13680.0, 12696.0
KZX, KZYR, KZYF = 806.0, 1076.0, 675.0
EP = 0.01
FZ0 = 35000.0
PCY1 = 1.5874
PDY1, PDY2 = 0.73957, -0.075004
PEY1, PEY2, PEY3 = 0.37562, -0.069325, 0.29168
PKY1, PKY2 = -10.289, 3.3343
PHY1, PHY2 = 0.0056509, -0.0020257
PVY1, PVY2 = 0.015216, -0.010365
OFFSET_FRONT, OFFSET_REAR = 278.2789450759981, 259.95925391136984

PC1 = PCY1
PD1, PD2 = PDY1 - PDY2, PDY2 / FZ0
PE1, PE2, PE3 = PEY1 - PEY2, PEY2 / FZ0, PEY3
PK1, PK2 = PKY1 * FZ0, 1 / (PKY2 * FZ0)
PH1, PH2 = PHY1 - PHY2, PHY2 / FZ0
PV1, PV2 = PVY1 - PVY2, PVY2 / FZ0


def tyre(alpha, load, offset):
    """Lateral force of an axle [N], left positive."""
    a = alpha + PH2 * load + PH1
    d = (PD2 * load + PD1) * load
    b = PK1 * sin(2 * atan(PK2 * load)) / (PC1 * d)
    e = (PE2 * load + PE1) * (1 - PE3 * a / sqrt(a * a + EP * EP))
    magic = d * sin(PC1 * atan(b * a - e * (b * a - atan(b * a))))
    return magic + (PV2 * load + PV1) * load + offset


def forces(state):
    """Lateral axle forces, front and rear, and the axle loads [N]."""
    _, _, v, r, _, sa, ux, ax = state
    load_front = FZF0 - KZX * (ax - v * r)
    load_rear = FZR0 + KZX * (ax - v * r)
    front = tyre(atan((v + LA * r) / (ux + EP)) - sa, load_front, OFFSET_FRONT)
    rear = tyre(atan((v - LB * r) / (ux + EP)), load_rear, OFFSET_REAR)
    return front, rear, load_front, load_rear


def wheel_loads(state):
    """rl, rr, fl, fr [N]."""
    front, rear, load_front, load_rear = forces(state)
    lateral = (front + rear) / M
    return (load_rear / 2 - KZYR * lateral, load_rear / 2 + KZYR * lateral,
            load_front / 2 - KZYF * lateral, load_front / 2 + KZYF * lateral)


def derivative(state, control):
    _, _, v, r, psi, _, ux, ax = state
    sr, jx = control
    front, rear, _, _ = forces(state)
    across = v + LA * r
    return (ux * cos(psi) - across * sin(psi), ux * sin(psi) + across * cos(psi),
            (front + rear) / M - ux * r, (LA * front - LB * rear) / IZZ, r, sr, ax, jx)


# Gauss-Legendre, two stages, order 4.
_C = (0.5 - sqrt(3) / 6, 0.5 + sqrt(3) / 6)
_A = ((0.25, 0.25 - sqrt(3) / 6), (0.25 + sqrt(3) / 6, 0.25))


def _step(state, control, slope, h):
    """One step; the control goes linearly, `control` + t * `slope`."""
    u = [tuple(c + s * ci * h for c, s in zip(control, slope)) for ci in _C]
    k = [derivative(state, u[0])] * 2
    for _ in range(50):
        old = k
        k = [derivative([x + h * (a[0] * k0 + a[1] * k1) for x, k0, k1 in zip(state, *old)], ui)
             for a, ui in zip(_A, u)]
        if max(abs(p - q) * h for new, was in zip(k, old) for p, q in zip(new, was)) < 1e-13:
            return [x + h / 2 * (k0 + k1) for x, k0, k1 in zip(state, *k)]
    raise ArithmeticError("the stages do not converge")


def advance(state, control0, control1, duration, step):
    """The state after `duration` [s], with steps of at most `step` [s], while the control goes
    linearly from control0 to control1."""
    steps = max(1, ceil(duration / step - 1e-9))
    h = duration / steps
    slope = [(b - a) / duration for a, b in zip(control0, control1)]
    for i in range(steps):
        control = [c + s * h * i for c, s in zip(control0, slope)]
        state = _step(state, control, slope, h)
    return state
