"""Questions whose numbers lie as close to the middle of two neighbours as is known: docs/golden.md says how close, and why.
    python3 golden/hardest.py binary64|binary32 | contact-oracle annotate - --family hardest -o FILE

Integers and fractions; a float is only a name. The precision is p bits; m / 2^s is such a middle, s = p + 1; D is the squared
distance."""
import json, math, sys
from fractions import Fraction

P, LEAST, END = {"binary64": (53, -1074, 1024), "binary32": (24, -149, 128)}[scalar := sys.argv[1]]  # 2^LEAST is the least number
LARGEST = (2**P - 1) * 2 ** (END - P)


def root_of_minus_one(n):
    """r with r^2 = -1 modulo n, found where n is a prime 4k + 1 (half of all bases give it)."""
    if n % 4 == 1 and n > 1 and pow(3, n - 1, n) == 1:
        return next((r for base in (2, 3, 5, 7, 11, 13) if (r := pow(base, n // 4, n)) ** 2 % n == n - 1), None)


def two_squares(n):
    """y, z with y^2 + z^2 = n, where n is a power of 2 times a prime 4k + 1 (Cornacchia)."""
    twos = (n & -n).bit_length() - 1
    if (root := root_of_minus_one(n >> twos)) is None:
        return None
    a, b = n >> twos, root
    while b * b > n >> twos:
        a, b = b, a % b
    y, z = b, a % b
    for _ in range(twos):
        y, z = y + z, y - z  # times 1 + i
    assert y * y + z * z == n
    return y, z


def question(delta, r1=0, r2=0, contact=0, c1=None):
    """Spheres so far apart, asked both ways round: the points change places. Differences of 2p + 1 bits are split in two."""
    def number(x):
        bits = Fraction(x).numerator.bit_length() - (Fraction(x).numerator & -Fraction(x).numerator).bit_length() + 1
        assert Fraction(float(x)) == x and bits <= P, x
        return float(x)

    def near(x):
        last = 2 ** max(abs(x).bit_length() - P, 0)
        return round(Fraction(x, last)) * last

    c1 = c1 or [near(d) - d for d in delta]
    alarm = min(2 ** (max(int(abs(d)) for d in delta).bit_length() + 1), LARGEST)
    a, b = ({"center": [*map(number, c)], "radius": number(r)} for c, r in ((c1, r1), ([*map(sum, zip(c1, delta))], r2)))
    rest = {"alarm": float(alarm), "contact": number(contact)}
    for a, b in ((a, b), (b, a)):
        print(json.dumps({"pair": "sphere_sphere", "scalar": scalar, "a": a, "b": b, **rest}))


# value, all numbers within p bits: sqrt(x^2 + 1) = x + h - h^2 / 2x + ..   x = 2^(p-1), h = 2^-p. Then 1 + h, beside 1.
question((2 ** (P - 1), 1, 0), r1=2 ** (P - 1) - 2, contact=1)
question((2 ** (P - 1), 1, 0), r1=2 ** (P - 1) - 2, contact=Fraction(1, 2))

# value and point1, any magnitudes: the largest distance, ties but for the square of the least number.
question((2 * LARGEST, Fraction(2) ** LEAST, 0), r1=2 ** (END - P - 1), r2=LARGEST, c1=(-LARGEST, 0, 0))

# normal, all numbers within p bits: convergents y / x of sqrt(4^s - m^2) / m for many odd m, and the closest of those.
def convergent(m, s=P + 1):
    over, under, y, x, last_y, last_x = math.isqrt((4**s - m * m) << 8 * P), m << 4 * P, 1, 0, 0, 1
    while True:
        quotient, rest = divmod(over, under)
        next_y, next_x = quotient * y + last_y, quotient * x + last_x
        if max(next_y, next_x) >= 2**P:
            return x * next_x, x, y
        over, under, y, x, last_y, last_x = under, rest, next_y, next_x, y, x
for _, x, y in sorted(convergent(2**P + 2 * i + 1) for i in range(2**P // 3, 2**P // 3 + 2**17))[-4:]:
    question((x, y, 0))

# normal, coordinates of 2p + 1 bits: 4^s x^2 - m^2 D = -1. So m^2 divides (2^s x)^2 + 1, and D - x^2 is a sum of two squares.
found, m = 0, 2**P + 2 ** (P - 1) + 1
while found < 4:
    m += 4
    if (i := root_of_minus_one(m)) is None:
        continue
    i = (i - (i * i + 1) * pow(2 * i, -1, m * m)) % (m * m)  # Newton: now modulo m^2
    for root in (i, m * m - i):
        x = root * pow(2 ** (P + 1), -1, m * m) % (m * m)
        D = (4 ** (P + 1) * x * x + 1) // (m * m)
        if x < 2 ** (2 * P + 1) and (yz := two_squares(D - x * x)) and max(map(abs, yz)) < 2 ** (2 * P + 1):
            question((x, *yz))
            found += 1

# normal, any magnitudes: x / sqrt(x^2 + y^2) is half the least number but for the square of x.
question((Fraction(2) ** (LEAST + END - 2), 2 ** (END - 1), 0), c1=[Fraction(0)] * 3)

# point, all numbers within p bits: r x / sqrt(D) = a / 4 + 1 / 8a^3 - ..  with a = (y^2 + z^2 + 3) / 2 as large as goes.
root = math.isqrt(2**P) - 1
for y, z in ((root - (root + 1) % 2, root // 4 * 4), (root - (root + 1) % 2 - 2, root // 4 * 4)):
    a = (y * y + z * z + 3) // 2
    question((a - 1, y, z), r1=Fraction(a + 1, 4), r2=1, c1=(-(2**P) + 1, 0, 0))
