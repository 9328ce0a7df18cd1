"""Double-double numbers: a pair (high, low) of float64 stands for high + low, 106 bits and more.

x, x_ are the halves of x, and u = 2⁻⁵³.  Barring overflow and underflow

- `two_sum`, `quick_two_sum` and `two_product` are exact (Knuth, Dekker).  Compiled, the product is one fused
  multiply-add: exact as well, so the bits are the same;
- the operations on normalised pairs, |x_| ≤ ½ ulp(x), have proved relative errors.  [JMP] M. Joldes, J.-M. Muller,
  V. Popescu, ACM TOMS 44 (2017) 15res; [LLMPR] V. Lefèvre, N. Louvet, J.-M. Muller, J. Picot, L. Rideau, ACM TOMS 49
  (2023) 1, which has the root;
- the `loose` operations leave out the last normalisation, and err by some u² of the terms: M. Lange and S. Rump's
  pair arithmetic, ACM TOMS 46 (2020) 21.  Sums of products that may cancel can want no more; it is half the cost.
"""

from math import sqrt

SPLITTER = 134217729.0  # 2^27 + 1
SINGLE = {"SPLITTER": 4097.0}  # 2^12 + 1


def two_sum(a, b):
    """a + b exactly."""
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def quick_two_sum(a, b):
    """a + b exactly, where a = 0 or the exponent of a is at least that of b."""
    total = a + b
    return total, b - (total - a)


def two_product(a, b):
    """a·b exactly."""
    return split_product(a, b)


def split_product(a, b):
    """a·b exactly (Dekker's with Veltkamp's splitting), compiled as it stands."""
    product = a * b
    t = SPLITTER * a
    a_high = t - (t - a)
    a_low = a - a_high
    t = SPLITTER * b
    b_high = t - (t - b)
    b_low = b - b_high
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


def add(a, a_, b, b_):
    """a + b within 3u² + 13u³ ([JMP] algorithm 6)."""
    s, s_ = two_sum(a, b)
    t, t_ = two_sum(a_, b_)
    s, s_ = quick_two_sum(s, s_ + t)
    return quick_two_sum(s, t_ + s_)


def subtract(a, a_, b, b_):
    """a - b within 3u² + 13u³."""
    return add(a, a_, -b, -b_)


def multiply(a, a_, b, b_):
    """a·b within 5u² ([JMP] algorithm 10; the bound is Muller and Rideau's, ACM TOMS 48 (2022) 9)."""
    p, p_ = two_product(a, b)
    return quick_two_sum(p, p_ + (a * b_ + a_ * b))


def multiply_float(a, a_, b):
    """a·b for a float b within 3/2 u² + 4u³ ([JMP] algorithm 7)."""
    p, p_ = two_product(a, b)
    s, s_ = quick_two_sum(p, a_ * b)
    return quick_two_sum(s, s_ + p_)


def divide(a, a_, b, b_):
    """a/b within 15u² + 56u³ ([JMP] algorithm 17)."""
    high = a / b
    r, r_ = multiply_float(b, b_, high)
    return quick_two_sum(high, ((a - r) + (a_ - r_)) / b)


def root(a, a_):
    """√a for a ≥ 0 within 25/8 u² ([LLMPR] algorithm SQRTDWtoDW)."""
    if a == 0.0:
        return 0.0, 0.0
    high = sqrt(a)
    p, p_ = two_product(high, high)
    return quick_two_sum(high, (a_ + ((a - p) - p_)) / (2.0 * high))


def loose_add(a, a_, b, b_):
    """a + b; the low half is rounded twice, and not normalised."""
    s, s_ = two_sum(a, b)
    return s, s_ + (a_ + b_)


def loose_subtract(a, a_, b, b_):
    """a - b likewise."""
    s, s_ = two_sum(a, -b)
    return s, s_ + (a_ - b_)


def loose_multiply(a, a_, b, b_):
    """a·b without a_·b_; the low half is rounded four times, and not normalised."""
    p, p_ = two_product(a, b)
    return p, p_ + (a * b_ + a_ * b)


def loose_add_float(a, a_, b):
    """a + b for a float b."""
    s, s_ = two_sum(a, b)
    return s, s_ + a_


def loose_multiply_float(a, a_, b):
    """a·b for a float b."""
    p, p_ = two_product(a, b)
    return p, p_ + a_ * b
