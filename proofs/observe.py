#!/usr/bin/env python3
"""The worst errors of the formulas that proofs bounds, on random numbers.   python3 proofs/observe.py [COUNT]

The formulas of src/kernel/sphere_sphere_formula-inl.h, batch_near_touching-inl.h, sphere_sphere_double_double.hpp and
oracle/truth/double_double.hpp once more in exact arithmetic, each rounding where the code has it, against numbers with 400 bits. Prints
the worst observed value of each bound beside the proved one, and fails where one is exceeded. The seed is fixed.
"""

import math
import random
import sys
from fractions import Fraction
from pathlib import Path

import prove

U = Fraction(1, 2**53)
BITS = 400


def rn(x):
    """x rounded to binary64: a fraction divides correctly rounded."""
    return Fraction(x.numerator / x.denominator)


def root(x):
    """sqrt x, within 2^-400 of itself."""
    shift = BITS - (x.numerator.bit_length() - x.denominator.bit_length()) // 2
    return Fraction(math.isqrt((x.numerator << 2 * shift) // x.denominator), 1 << shift)


def two_sum(a, b):
    high = rn(a + b)
    return high, a + b - high


class Worst:
    def __init__(self):
        self.seen = {}

    def take(self, name, value):
        if value > self.seen.get(name, -1):
            self.seen[name] = value


def shared_root(worst, delta, center, r1, r2, distance):
    """One pair through the vector kernel."""
    high = [rn(d) for d in delta]
    low = [rn(d - h) for d, h in zip(delta, high)]
    if any(d != h + l for d, h, l in zip(delta, high, low)):
        return
    D = sum(d * d for d in delta)
    plain = rn(high[0] * high[0])
    plain = rn(high[1] * high[1] + plain)
    plain = rn(high[2] * high[2] + plain)
    worst.take("plain_d", abs(plain / D - 1))
    reach = rn(rn(r1 + r2) + distance)
    S = (r1 + r2 + distance) ** 2
    worst.take("filter_gap", abs((plain - reach * reach) - (D - S)) / (D + S))
    y = rn(1 / rn(root(plain)))
    s = root(D)
    rho = 1 - D * y * y
    worst.take("rho", abs(rho))
    q = [rn(h * y) for h in high]
    e = [rn(l * y + rn(h * y - k)) for l, h, k in zip(low, high, q)]
    a1 = rn(q[0] * q[0] + 1)
    a2 = rn(q[1] * q[1] + a1)
    rx = rn(q[0] * q[0] - (a1 - 1))
    ry = rn(q[1] * q[1] - (a2 - a1))
    rz = rn(q[2] * q[2] - (2 - a2))
    worst.take("rx", abs(rx))
    worst.take("ry", abs(ry))
    worst.take("rz", abs(rz))
    cross = rn(q[0] * e[0] + rn(q[1] * e[1] + rn(q[2] * e[2])))
    half = -rn(rn(rn(rx + ry) + rz) / 2 + cross)
    worst.take("half_rho_error", abs(half - rho / 2))
    lows = [rn(k * half + x) for k, x in zip(q, e)]
    for d, k, l in zip(delta, q, lows):
        if k:
            worst.take("low", abs(l / k))
            worst.take("normal", abs(d / s - k - l) / abs(k))
    sh = rn(y * plain)
    tau = rn(1 - y * sh)
    sl = rn(sh * rn(tau - half))
    worst.take("root", abs(s - sh - sl) / s)
    # Points and the value.
    for c, d, k, l in zip(center, delta, q, lows):
        w = rn(r1 * k)
        h = rn(c + w)
        p = rn(h - c)
        g = c - (h - p)
        last = rn(g + rn(r1 * l + rn(r1 * k - p)))
        error = abs(c + r1 * d / s - h - last)
        if w:
            worst.take("point_of_w", (error - 3 * U * U * abs(h)) / abs(w))
    radii = two_sum(r1, r2)
    less = two_sum(radii[0], distance)
    T = r1 + r2 + distance
    value = two_sum(sh, -less[0])
    last = rn(value[1] + rn(sl - rn(less[1] + radii[1])))
    worst.take("value_of_s", abs(s - T - value[0] - last) / (s + T))
    return sh, sl


def one_pair(worst, delta, center, r1):
    """One pair through the fast stage of one pair."""
    high = [rn(d) for d in delta]
    low = [rn(d - h) for d, h in zip(delta, high)]
    if any(d != h + l for d, h, l in zip(delta, high, low)):
        return
    D = sum(d * d for d in delta)
    squares = [rn(h * h) for h in high]
    residual = Fraction(0)
    for h, l, square in zip(high, low, squares):
        residual = rn(residual + rn(2 * h * l + rn(h * h - square)))
    xy = two_sum(squares[0], squares[1])
    xyz = two_sum(xy[0], squares[2])
    found = two_sum(xyz[0], rn(rn(xy[1] + xyz[1]) + residual))
    worst.take("pair_d", abs(sum(found) / D - 1))
    s = root(D)
    r = rn(root(found[0]))
    sl = rn(rn(rn(found[0] - r * r) + found[1]) / (2 * r))
    worst.take("pair_root", abs(s - r - sl) / s)
    for c, d, h, l in zip(center, delta, high, low):
        if not h:
            continue
        q = rn(h / r)
        n = two_sum(q, rn(rn(rn(rn(h - q * r) + l) - q * sl) / r))
        worst.take("pair_normal", abs(d / s - sum(n)) / abs(q))
        w = rn(r1 * n[0])
        wl = rn(r1 * n[1] + rn(r1 * n[0] - w))
        at = two_sum(c, w)
        if w:
            worst.take("pair_point_of_w", (abs(c + r1 * d / s - at[0] - rn(at[1] + wl)) - U * U * abs(at[0])) / abs(w))


def near(worst, delta, sh, sl):
    """A radius that nearly touches, through the grids and the quotient."""
    high = [rn(d) for d in delta]
    low = [rn(d - h) for d, h in zip(delta, high)]
    if any(d != h + l for d, h, l in zip(delta, high, low)):
        return
    D = sum(d * d for d in delta)
    s = root(D)
    Th = rn(s * (1 + Fraction(random.choice([0, 1, -1, 5]), 2 ** random.randrange(13, 60))))
    Tl = rn(Th * Fraction(random.randrange(-(2**53), 2**53), 2**107))
    Tt = rn(Tl * Fraction(random.randrange(-(2**53), 2**53), 2**107))
    plain = rn(high[2] * high[2] + rn(high[1] * high[1] + rn(high[0] * high[0])))
    power = Fraction(2) ** (math.frexp(float(plain))[1] - 1)
    first, second = 6 * power, 3 * power / 2**47
    sums = [Fraction(0)] * 3
    for h, l, sign in [*((h, l, 1) for h, l in zip(high, low)), (Th, Tl, -1)]:
        square = rn(h * h)
        on_first = rn(rn(square + first) - first)
        below_first = rn(square - on_first)
        residual = rn(h * h - square)
        below = rn(rn(below_first + second) - second)
        of_residual = rn(rn(residual + second) - second)
        of_cross = rn(rn(2 * h * l + second) - second)
        on_second = rn(rn(below + of_residual) + of_cross)
        remainders = rn(rn(below_first - below) + rn(residual - of_residual))
        under = rn(remainders + rn(l * l + rn(2 * h * l - of_cross)))
        sums = [rn(sums[0] + sign * on_first), rn(sums[1] + sign * on_second), rn(sums[2] + sign * under)]
    rest = rn(sums[2] - 2 * Th * Tt)
    E = D - (Th + Tl + Tt) ** 2
    summed = sums[0] + sums[1] + rest
    worst.take("near_error", abs(summed - E) / power)
    upper = two_sum(sums[0], sums[1])
    total = two_sum(upper[0], rest)
    of_two = two_sum(sh, Th)
    of_two_low = rn(of_two[1] + rn(sl + Tl))
    reciprocal = rn(1 / of_two[0])
    quotient = rn(total[0] * reciprocal)
    if not quotient:
        return
    remainder = rn(total[0] - quotient * of_two[0])
    last = rn(rn(remainder + rn(rn(upper[1] + total[1]) - quotient * of_two_low)) * reciprocal)
    exact = summed / (s + Th + Tl + Tt)
    worst.take("near_quotient", abs(quotient + last - exact) / abs(quotient))


def of_two(worst, x, y):
    """The operations of the oracle's double-double stage."""
    (xh, xl), (yh, yl) = x, y
    p = rn(xh * yh)
    e = xh * yh - p
    exact = (xh + xl) * (yh + yl)
    worst.take("oracle_product", abs(p + rn(e + rn(xl * yh + rn(xh * yl + rn(xl * yl)))) - exact) / abs(exact))
    t = rn(1 / xh)
    found = t + rn(t * rn(rn(1 - xh * t) - xl * t))
    worst.take("oracle_reciprocal", abs(found * (xh + xl) - 1))
    s = rn(root(xh))
    found = s + rn(rn(rn(xh - s * s) + xl) / (2 * s))
    worst.take("oracle_root", abs(found / root(xh + xl) - 1))


def number(spread):
    """A double of a random magnitude, some of them with few bits or beside a power of two."""
    kind = random.randrange(4)
    mantissa = 2**52 + random.getrandbits(52)
    if kind == 0:
        mantissa = 2**52 + random.getrandbits(6)
    elif kind == 1:
        mantissa = 2**53 - 1 - random.getrandbits(6)
    return Fraction(mantissa * random.choice([1, -1])) * Fraction(2) ** (random.randint(-spread, spread) - 52)


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 2000
    random.seed(53)
    worst = Worst()
    for _ in range(count):
        spread = random.choice([0, 1, 3, 30])
        center = [number(spread) for _ in range(3)]
        other = [number(spread) for _ in range(3)]
        if random.randrange(4) == 0:
            other[random.randrange(3)] = center[0]
        delta = [b - a for a, b in zip(center, other)]
        if not any(delta):
            continue
        r1, r2, distance = (abs(number(spread)) for _ in range(3))
        found = shared_root(worst, delta, center, r1, r2, distance)
        one_pair(worst, delta, center, r1)
        if found:
            near(worst, delta, *found)
        pairs = []
        for _ in range(2):
            h = abs(number(3))
            pairs.append(two_sum(h, rn(h * Fraction(random.randrange(-(2**53), 2**53), 2**107))))
        of_two(worst, *pairs)
    values = prove.Table(Path(__file__).resolve().parent).values
    print("| bound | worst observed | proved |\n|---|---|---|")
    for name, value in worst.seen.items():
        print(f"| `{name}` | {prove.shown(value)} | {prove.shown(values[name])} |")
    broken = [name for name, value in worst.seen.items() if value > values[name]]
    if broken:
        print("exceeded:", *broken, file=sys.stderr)
    return bool(broken)


if __name__ == "__main__":
    sys.exit(main())
