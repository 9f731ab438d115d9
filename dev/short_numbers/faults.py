#!/usr/bin/env python3
"""Plants faults in the kernels and asks that short numbers find each.   python3 faults.py COMPILER EIGEN INCLUDE [WORD]
                                                                      python3 faults.py --check

Each fault is one change of a copy of the sources: a term dropped, an operation or an operand swapped, a constant too small, a
condition left out. The copy is compiled, and tiny_kernels must find a wrong answer, in its quick run or in the whole one. With
WORD only faults whose text holds it. Prints each fault and what found it; exit status 1 where one was not found.
--check only says which faults cannot be planted, because the sources do not hold their text once.
"""

import concurrent.futures
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FILTER = "../contact/plain_decision.hpp"
PAIR = "sphere_sphere_double_double.hpp"
DOUBLE_DOUBLE = "double_double-inl.h"
FORMULA = "sphere_sphere_formula-inl.h"
VECTOR = "sphere_sphere_one_vector-inl.h"
ARITHMETIC = "batch_arithmetic-inl.h"
NEAR = "batch_near_touching-inl.h"
FINISHING = "batch_finishing-inl.h"
BATCH = "batch_sphere_sphere.cpp"
BOUNDS = "batch_bounds.hpp"
DIVISION = "batch, by division"
ESTIMATE = "batch, by an estimate"

# What is asked, the file, what stands there, and what is put in its place.
FAULTS = [
    # The filter of one pair.
    ("one pair", FILTER, "kGap = 32 * kUnit", "kGap = 0.5 * kUnit"),
    ("one pair", FILTER, " + dz * dz", ""),
    ("one pair", FILTER, "b.center[1] - a.center[1]", "b.center[1] + a.center[1]"),
    ("one pair", FILTER, "(a.radius + b.radius) + alarm", "(a.radius + b.radius)"),
    ("one pair", FILTER, "hit = D < reach2", "hit = D > reach2"),
    ("one pair", FILTER, "+ Bounds<Real>::kFloor) < more", "+ Bounds<Real>::kFloor) < 2 * more"),
    ("filter, rounding up", FILTER, "kGap = 32 * kUnit", "kGap = 1 * kUnit"),
    ("filter, rounding down", FILTER, "kGap = 32 * kUnit", "kGap = 1 * kUnit"),
    ("filter, rounding to zero", FILTER, "kGap = 32 * kUnit", "kGap = 1 * kUnit"),
    # The fast stage of one pair.
    ("one pair", DOUBLE_DOUBLE, "hn::Add(hn::Sub(a, hn::Sub(high, b_part)), hn::Sub(b, b_part))", "hn::Sub(a, hn::Sub(high, b_part))"),
    ("one pair", DOUBLE_DOUBLE, "hn::Add(hn::Sub(a, hn::Sub(high, b_part)), hn::Sub(b, b_part))", "hn::Sub(hn::Sub(a, hn::Sub(high, b_part)), hn::Sub(b, b_part))"),
    ("one pair", PAIR, "kNormalError = 30 * kUnitSquared", "kNormalError = 1 * kUnitSquared"),
    ("one pair", PAIR, "kPointError = 35 * kUnitSquared", "kPointError = 1 * kUnitSquared"),
    ("one pair", PAIR, "(kValueRootError * root.high + kValueLessError * less.high) + kLast", "kLast"),
    ("one pair", PAIR, "kLastSumError = 3 * kUnitSquared", "kLastSumError = 0 * kUnitSquared"),
    ("one pair", PAIR, "low - error", "low"),
    ("one pair", PAIR, "low + error", "low"),
    ("one pair", PAIR, "below == above", "true"),
    ("one pair", PAIR, "fma(signed_radius, n.low, fma(signed_radius, n.high, -w))", "fma(signed_radius, n.high, -w)"),
    ("one pair", PAIR, "fma(signed_radius, n.low, fma(signed_radius, n.high, -w))", "signed_radius * n.low"),
    ("one pair", PAIR, "return {h.high, h.low + w_low,", "return {h.high, w_low,"),
    ("one pair", PAIR, "return {h.high, h.low + w_low,", "return {h.high, h.low,"),
    ("one pair", PAIR, "kPointError * abs(w) + kLastSumError * abs(h.high)", "kPointError * abs(w) * kUnit + kLastSumError * abs(h.high)"),
    ("one pair", PAIR, "h.low + (root.low - less.low)", "(root.low - less.low)"),
    ("one pair", PAIR, "h.low + (root.low - less.low)", "h.low - less.low"),
    ("one pair", PAIR, "h.low + (root.low - less.low)", "h.low + root.low"),
    ("one pair", PAIR, "h.low + (root.low - less.low)", "h.low + (root.low + less.low)"),
    ("one pair", PAIR, "two_sum<Real>(b.center[axis], -a.center[axis])", "two_sum<Real>(b.center[axis], a.center[axis])"),
    ("one pair", PAIR, "fma(2 * high, low, fma(high, high, -square[i]))", "fma(high, high, -square[i])"),
    ("one pair", PAIR, "fma(2 * high, low, fma(high, high, -square[i]))", "2 * high * low"),
    ("one pair", PAIR, "fma(2 * high, low, fma(high, high, -square[i]))", "fma(high, low, fma(high, high, -square[i]))"),
    ("one pair", PAIR, "residual += ", "residual = "),
    ("one pair", PAIR, "(xy.low + xyz.low) + residual", "xyz.low + residual"),
    ("one pair", PAIR, "(xy.low + xyz.low) + residual", "xy.low + residual"),
    ("one pair", PAIR, "(xy.low + xyz.low) + residual", "(xy.low + xyz.low)"),
    ("one pair", PAIR, "(xy.low + xyz.low) + residual", "(xy.low + xyz.low) - residual"),
    ("one pair", PAIR, "(fma(-root, root, D.high) + D.low)", "fma(-root, root, D.high)"),
    ("one pair", PAIR, "(fma(-root, root, D.high) + D.low)", "D.low"),
    ("one pair", PAIR, "/ (2 * root)", "/ root"),
    ("one pair", PAIR, "{less.high, radii.low + less.low}", "{less.high, less.low}"),
    ("one pair", PAIR, "{less.high, radii.low + less.low}", "{less.high, radii.low}"),
    ("one pair", PAIR, "two_sum(radii.high, distances.contact)", "two_sum(radii.high, distances.alarm)"),
    ("one pair", PAIR, "fma(-q, root.high, component.high) + component.low", "fma(-q, root.high, component.high)"),
    ("one pair", PAIR, "fma(-q, root.high, component.high) + component.low", "component.low"),
    ("one pair", PAIR, "fma(-q, root.low, remainder) / root.high", "remainder / root.high"),
    ("one pair", PAIR, "fma(-q, root.low, remainder) / root.high", "fma(q, root.low, remainder) / root.high"),
    ("one pair", PAIR, "fma(-q, root.low, remainder) / root.high", "fma(-q, root.low, remainder) * root.high"),
    # One pair in one vector.
    ("one vector", DOUBLE_DOUBLE, "hn::Add(hn::Sub(a, hn::Sub(high, b_part)), hn::Sub(b, b_part))", "hn::Sub(b, b_part)"),
    ("one vector", DOUBLE_DOUBLE, "hn::Sub(hn::Sub(b, hn::Sub(high, a_part)), hn::Add(a, a_part))", "hn::Sub(b, hn::Sub(high, a_part))"),
    ("one vector", FORMULA, "all<V>(1 - eta)", "all<V>(1)"),
    ("one vector", FORMULA, "all<V>(1 + eta)", "all<V>(1)"),
    ("one vector", FORMULA, "{high, hn::Add(center_lost, w_lost)}", "{high, w_lost}"),
    ("one vector", FORMULA, "{high, hn::Add(center_lost, w_lost)}", "{high, center_lost}"),
    ("one vector", FORMULA, "hn::MulAdd(radius, low, hn::MulSub(radius, q, w_part))", "hn::MulSub(radius, q, w_part)"),
    ("one vector", FORMULA, "hn::MulAdd(radius, low, hn::MulSub(radius, q, w_part))", "hn::Mul(radius, low)"),
    # What the tests of `uncancelled` keep away needs a low part of 2^-30 of its usual size, which no short number has:
    # SphereSphere.a_point_that_cancels_beside_a_low_part_of_hardly_anything_is_right has numbers for both.
    ("one vector", VECTOR, "hn::MulAdd(d.low, all<Axes>(k), hn::MulSub(d.high, all<Axes>(k), q))", "hn::MulSub(d.high, all<Axes>(k), q)"),
    ("one vector", VECTOR, "hn::MulAdd(d.low, all<Axes>(k), hn::MulSub(d.high, all<Axes>(k), q))", "hn::Mul(d.low, all<Axes>(k))"),
    ("one vector", VECTOR, "hn::MulAdd(a, all<Axes>(k), c)", "c"),
    ("one vector", VECTOR, "hn::MulAdd(a, all<Axes>(k), c)", "hn::Mul(a, all<Axes>(k))"),
    ("one vector", FORMULA, "hn::Add(hn::Add(rx, ry), rz)", "hn::Add(ry, rz)"),
    ("one vector", FORMULA, "hn::Add(hn::Add(rx, ry), rz)", "hn::Add(rx, rz)"),
    ("one vector", FORMULA, "hn::Add(hn::Add(rx, ry), rz)", "hn::Add(rx, ry)"),
    ("one vector", FORMULA, "hn::Add(hn::Add(rx, ry), rz), cross)", "hn::Add(hn::Add(rx, ry), rz), hn::Sub(cross, cross))"),
    ("one vector", FORMULA, "hn::NegMulSub(all<Number>(0.5),", "hn::MulAdd(all<Number>(0.5),"),
    ("one vector", FORMULA, "hn::NegMulSub(all<Number>(0.5),", "hn::NegMulSub(all<Number>(1),"),
    ("one vector", FORMULA, "hn::Sub(hn::NegMulAdd(y, root.high, one), half_rho)", "hn::NegMulAdd(y, root.high, one)"),
    ("one vector", FORMULA, "hn::Sub(hn::NegMulAdd(y, root.high, one), half_rho)", "hn::Add(hn::NegMulAdd(y, root.high, one), half_rho)"),
    ("one vector", FORMULA, "hn::Sub(hn::NegMulAdd(y, root.high, one), half_rho)", "hn::Sub(y, hn::Add(y, half_rho))"),
    ("one vector", FORMULA, "hn::Sub(root.low, hn::Add(less.sum.low, less.radii.low))", "hn::Sub(root.low, less.sum.low)"),
    ("one vector", FORMULA, "hn::Sub(root.low, hn::Add(less.sum.low, less.radii.low))", "hn::Sub(root.low, less.radii.low)"),
    ("one vector", FORMULA, "hn::Sub(root.low, hn::Add(less.sum.low, less.radii.low))",
     "hn::Sub(hn::Sub(root.low, root.low), hn::Add(less.sum.low, less.radii.low))"),
    ("one vector", VECTOR, "(bits_of(certain) | 0b1000) & bits_of(last_certain)", "(bits_of(certain) | 0b1000)"),
    ("one vector", VECTOR, "(bits_of(certain) | 0b1000) & bits_of(last_certain)", "bits_of(last_certain)"),
    # The vector kernels: the filter and the shared root.
    (DIVISION, BOUNDS, "kFilterGap = 16 * kUnit", "kFilterGap = 0 * kUnit"),
    (DIVISION, ARITHMETIC, "hn::MulAdd(z, z, hn::MulAdd(y, y, hn::Mul(x, x)))", "hn::MulAdd(y, y, hn::Mul(x, x))"),
    (DIVISION, ARITHMETIC, "hit = hn::Lt(difference, hn::Neg(gap));", "hit = hn::Lt(difference, gap);"),
    (DIVISION, ARITHMETIC, "miss = hn::Gt(difference, gap);", "miss = hn::Gt(difference, hn::Neg(gap));"),
    (DIVISION, DOUBLE_DOUBLE, "hn::Add(hn::Sub(a, hn::Sub(high, b_part)), hn::Sub(b, b_part))", "hn::Sub(a, hn::Sub(high, b_part))"),
    (DIVISION, DOUBLE_DOUBLE, "hn::Sub(hn::Sub(b, hn::Sub(high, a_part)), hn::Add(a, a_part))", "hn::Sub(b, hn::Sub(high, a_part))"),
    (DIVISION, ARITHMETIC, "return hn::Div(all(1), hn::Sqrt(x));", "return hn::Sqrt(hn::Div(all(1), hn::Mul(x, all(1.03125))));"),
    (DIVISION, ARITHMETIC, "hn::MulAdd(d.x.low, k, hn::MulSub(d.x.high, k, q.x))", "hn::MulSub(d.x.high, k, q.x)"),
    (DIVISION, ARITHMETIC, "hn::MulAdd(d.y.low, k, hn::MulSub(d.y.high, k, q.y))", "hn::Mul(d.y.low, k)"),
    (DIVISION, ARITHMETIC, "hn::MulAdd(d.z.low, k, hn::MulSub(d.z.high, k, q.z))", "hn::MulAdd(d.z.low, k, hn::MulAdd(d.z.high, k, q.z))"),
    (DIVISION, FORMULA, "hn::Add(hn::Add(rx, ry), rz)", "hn::Add(ry, rz)"),
    (DIVISION, FORMULA, "hn::Add(hn::Add(rx, ry), rz)", "hn::Add(rx, rz)"),
    (DIVISION, FORMULA, "hn::Add(hn::Add(rx, ry), rz)", "hn::Add(rx, ry)"),
    (DIVISION, FORMULA, "hn::MulAdd(qx, x_of(e), hn::MulAdd(qy, y_of(e), hn::Mul(qz, z_of(e))))", "hn::MulAdd(qy, y_of(e), hn::Mul(qz, z_of(e)))"),
    (DIVISION, FORMULA, "hn::MulAdd(qx, x_of(e), hn::MulAdd(qy, y_of(e), hn::Mul(qz, z_of(e))))", "hn::MulAdd(qx, x_of(e), hn::Mul(qy, y_of(e)))"),
    (DIVISION, FORMULA, "hn::NegMulSub(all<Number>(0.5),", "hn::NegMulSub(all<Number>(0.25),"),
    (DIVISION, FORMULA, "hn::NegMulSub(all<Number>(0.5),", "hn::MulSub(all<Number>(0.5),"),
    (DIVISION, ARITHMETIC, "hn::MulAdd(a.x, k, c.x)", "c.x"),
    (DIVISION, ARITHMETIC, "hn::MulAdd(a.y, k, c.y)", "hn::MulAdd(a.x, k, c.y)"),
    (DIVISION, ARITHMETIC, "hn::MulAdd(a.z, k, c.z)", "hn::Mul(a.z, k)"),
    (DIVISION, FORMULA, "hn::Sub(hn::NegMulAdd(y, root.high, one), half_rho)", "hn::Neg(half_rho)"),
    (DIVISION, FORMULA, "hn::Sub(hn::NegMulAdd(y, root.high, one), half_rho)", "hn::NegMulAdd(y, root.high, one)"),
    (DIVISION, FORMULA, "hn::Sub(hn::NegMulAdd(y, root.high, one), half_rho)", "hn::Add(hn::NegMulAdd(y, root.high, one), half_rho)"),
    # Points, values and the tests of their roundings.
    (DIVISION, FORMULA, "hn::MulAdd(radius, low, hn::MulSub(radius, q, w_part))", "hn::MulSub(radius, q, w_part)"),
    (DIVISION, FORMULA, "hn::MulAdd(radius, low, hn::MulSub(radius, q, w_part))", "hn::MulAdd(radius, low, hn::Sub(w, w_part))"),
    (DIVISION, FORMULA, "{high, hn::Add(center_lost, w_lost)}", "{high, w_lost}"),
    (DIVISION, BOUNDS, "kNormalEta = 2048 * kUnit", "kNormalEta = 0 * kUnit"),
    (DIVISION, BOUNDS, "kSumEta = 1024 * kUnit * two_to(kHalf)", "kSumEta = 0 * kUnit"),
    (DIVISION, FORMULA, "certain = and_equal(certain, above, hn::MulAdd(low, all<V>(1 - eta), high));", "certain = and_equal(certain, above, above);"),
    (DIVISION, FORMULA, "hn::Add(sum.low, hn::Sub(root.low, hn::Add(less.sum.low, less.radii.low)))", "hn::Add(sum.low, hn::Sub(root.low, less.sum.low))"),
    (DIVISION, FORMULA, "hn::Add(sum.low, hn::Sub(root.low, hn::Add(less.sum.low, less.radii.low)))", "hn::Add(sum.low, hn::Sub(root.low, less.radii.low))"),
    (DIVISION, BATCH, "good = and_at_least(good, left, uncancelled);", ""),
    (DIVISION, BATCH, "M good = hn::And(hn::And(hit, axes_agree), value_agrees);", "M good = hn::And(hit, axes_agree);"),
    (DIVISION, BATCH, "M good = hn::And(hn::And(hit, axes_agree), value_agrees);", "M good = hn::And(hit, value_agrees);"),
    (DIVISION, BATCH, "const V radius2 = hn::Mul(in.br, all(job.sign2));\n  write(3", "const V radius2 = hn::Mul(in.br, all(job.sign1));\n  write(3"),
    # What the quick tests leave.
    (DIVISION, BOUNDS, "kPointError = 128 * kUnitSquared", "kPointError = 0.5 * kUnitSquared"),
    (DIVISION, BOUNDS, "kPointSumError = 6 * kUnitSquared", "kPointSumError = 0 * kUnitSquared"),
    (DIVISION, BOUNDS, "kRootError = 160 * kUnitSquared", "kRootError = 0.5 * kUnitSquared"),
    (DIVISION, BOUNDS, "kLowError = 4 * kUnit", "kLowError = 0 * kUnit"),
    (DIVISION, ARITHMETIC, "certain = hn::Eq(above, hn::Add(high, hn::Sub(low, error)));", "certain = hn::Eq(above, above);"),
    (DIVISION, NEAR, "hn::Eq(tail, all(0)), low, hn::BitCast(D(), stepped)", "hn::Eq(all(0), all(0)), low, hn::BitCast(D(), stepped)"),
    (DIVISION, NEAR, "hn::Sub(bits, even), hn::Add(bits, even)", "hn::Add(bits, even), hn::Sub(bits, even)"),
    (DIVISION, FINISHING, "hn::And(hn::And(only_axis, whole), hn::And(hn::Eq(once.low, all(0)), hn::Eq(twice.low, all(0))))",
     "hn::And(only_axis, hn::And(hn::Eq(once.low, all(0)), hn::Eq(twice.low, all(0))))"),
    (DIVISION, FINISHING, "hn::And(hn::And(only_axis, whole), hn::And(hn::Eq(once.low, all(0)), hn::Eq(twice.low, all(0))))",
     "hn::And(hn::And(only_axis, whole), hn::Eq(twice.low, all(0)))"),
    (DIVISION, FINISHING, "hn::And(hn::And(only_axis, whole), hn::And(hn::Eq(once.low, all(0)), hn::Eq(twice.low, all(0))))",
     "hn::And(hn::And(only_axis, whole), hn::Eq(once.low, all(0)))"),
    (DIVISION, FINISHING, "all(2 / bounds::kUnit)", "all(0.03125 / bounds::kUnit)"),
    (DIVISION, FINISHING, "all(1 - bounds::kUnit), all(1 + 2 * bounds::kUnit)", "all(1), all(1 + 2 * bounds::kUnit)"),
    (DIVISION, FINISHING, "all(1 - bounds::kUnit), all(1 + 2 * bounds::kUnit)", "all(1 - bounds::kUnit), all(1)"),
    (DIVISION, FINISHING, "hn::IfThenElse(tiny, hn::Neg(nudged), value)", "hn::IfThenElse(tiny, nudged, value)"),
    (DIVISION, FINISHING, "n = hn::IfThenElse(simple, hn::IfThenZeroElse(none, hn::Xor(all(1), sign)), n);",
     "n = hn::IfThenElse(simple, hn::IfThenZeroElse(none, all(1)), n);"),
    (DIVISION, FINISHING, "hn::IfThenZeroElse(none, hn::Xor(radius, sign))", "hn::IfThenZeroElse(none, radius)"),
    (DIVISION, FINISHING, "hn::Add(second.high, hn::Add(root.low, hn::Sub(second.low, less.tail)))",
     "hn::Add(root.low, hn::Sub(second.low, less.tail))"),
    # Near touching.
    (DIVISION, BOUNDS, "kNearError = 0x1p17 *", "kNearError = 0 *"),
    (DIVISION, BOUNDS, "kFirstGrid = 6;", "kFirstGrid = 0.25;"),
    (DIVISION, NEAR, "hn::Add(hn::Add(below, of_residual), of_cross)", "hn::Add(below, of_residual)"),
    (DIVISION, NEAR, "hn::Add(hn::Add(below, of_residual), of_cross)", "hn::Add(of_residual, of_cross)"),
    (DIVISION, NEAR, "hn::Add(remainders, hn::MulAdd(low, low, hn::MulSub(twice, low, of_cross)))", "all(0)"),
    (DIVISION, NEAR, "grids.add_square<true>(length_high, length_low);", "grids.add_square<true>(length_high, all(0));"),
    (DIVISION, NEAR, "grids.add_square<false>(unit.y.high, unit.y.low);", "grids.add_square<false>(unit.y.high, all(0));"),
    (DIVISION, NEAR, "hn::Lt(hn::Add(difference.high, hn::Add(error, error)), all(0))", "hn::Lt(hn::Sub(difference.high, error), all(0))"),
    (DIVISION, NEAR, "hn::Gt(hn::Sub(difference.high, hn::Add(error, error)), all(0))", "hn::Gt(hn::Add(difference.high, error), all(0))"),
    (DIVISION, NEAR, "zero = hn::And(zero, hn::And(on_grids, proper));", ""),
    (DIVISION, NEAR, "zero = hn::And(zero, hn::And(on_grids, proper));", "zero = hn::And(zero, on_grids);"),
    (DIVISION, NEAR, "hn::Add(sum.low, hn::Add(root.low, length_low))", "sum.low"),
    (DIVISION, NEAR, "hn::Add(remainder, hn::NegMulAdd(quotient, sum_low, difference.low))", "remainder"),
    (DIVISION, NEAR, "hn::Add(remainder, hn::NegMulAdd(quotient, sum_low, difference.low))", "hn::NegMulAdd(quotient, sum_low, difference.low)"),
    (DIVISION, NEAR, "certain = hn::Or(zero, hn::And(near, hn::And(agree, in_range)));", "certain = hn::Or(zero, hn::And(agree, in_range));"),
    # Scaling.
    (DIVISION, BATCH, "if constexpr (kScaled) root = scaled(root, scale_of(delta_of(in)).up);", ""),
    (DIVISION, FINISHING, "hn::Add(hn::Mul(r1, down), hn::Mul(r2, down))", "hn::Mul(r1, down)"),
    (DIVISION, FINISHING, "const Double2 root = kScaled ? scaled(stage.root, scale.up) : stage.root;", "const Double2 root = stage.root;"),
    # AVX-512.
    (ESTIMATE, ARITHMETIC, "all(0.375)), h, all(0.5)", "all(0.375)), h, all(0.25)"),
    (ESTIMATE, ARITHMETIC, "return M{_mm512_mask_cmp_pd_mask(mask.raw, a.raw, b.raw, _CMP_EQ_OQ)};", "return M{_mm512_mask_cmp_pd_mask(mask.raw, a.raw, b.raw, _CMP_GE_OQ)};"),
]
TARGETS = {DIVISION: {"12": "tiny_12", "16": "tiny_16"}, ESTIMATE: {"12": "tiny_12_estimate", "16": "tiny_16_estimate"}}


class Build:
    """Objects in a folder, of the sources as they are, and beside them those of changed copies."""

    def __init__(self, compiler, eigen, include, folder):
        self.compiler = compiler
        self.eigen = eigen
        self.include = include
        self.folder = folder
        for name in ("batch_columns", "batch_kernels", "grids", "harness", "main", "one_pair"):
            self.compile(ROOT / "src", folder, name, name, "-O2")
        for kernel, targets in TARGETS.items():
            for bits in targets:
                self.compile_for(ROOT / "src", folder, kernel, bits)

    def compile(self, sources, to, name, source, *options):
        subprocess.run([self.compiler, "-std=c++20", "-O1", "-ffp-contract=off", "-w", f"-I{sources}", f"-I{ROOT}", f"-I{ROOT / 'include'}", f"-I{self.include}",
                        "-isystem", self.eigen, *options, "-c", str(HERE / f"{source}.cpp"), "-o",
                        str(to / f"{name}.o")], check=True)

    def compile_for(self, sources, to, kernel, bits):
        """The source that holds a kernel of so many bits."""
        if kernel not in TARGETS:
            self.compile(sources, to, "one_pair", "one_pair")
            return
        name = TARGETS[kernel][bits]
        self.compile(sources, to, name, "batch", f"-I{HERE}", f"-DCONTACT_TINY_BITS={bits}",
                     f"-DCONTACT_TINY_ESTIMATE={int(kernel == ESTIMATE)}", f"-DCONTACT_TINY_TARGET={name}", "-DEIGEN_DONT_VECTORIZE", "-DCONTACT_OUT_OF_LINE")

    def link(self, changed):
        """tiny_kernels with the objects of a folder, and those of the sources as they are."""
        objects = [changed / path.name if (changed / path.name).exists() else path for path in sorted(self.folder.glob("*.o"))]
        subprocess.run([self.compiler, *map(str, objects), "-o", str(changed / "tiny_kernels")], check=True)
        return changed / "tiny_kernels"


def wrong_in(program, how, kernel):
    """What a run finds wrong, or None. It is ended then."""
    last = ""
    with subprocess.Popen([program, how, kernel], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as run:
        for line in run.stdout:
            columns = line.rstrip("\n").split("\t")
            if columns[0] in ("wrong", "never"):
                run.kill()
                return f"{how}, {columns[2]} bits, {': '.join(columns[3:])}"
            last = line.strip()
        return f"{how}, {last}" if run.wait() != 0 else None


def found(build, sources, kernel):
    """What finds the fault in `sources`, or None: the quick runs first."""
    changed = sources.parent
    for how in ("quick", "whole"):
        for bits in TARGETS.get(kernel, {"": ""}):
            if how == "quick":
                build.compile_for(sources, changed, kernel, bits)
            what = wrong_in(build.link(changed), how, f"{kernel} {bits}".strip())
            if what:
                return what
    return None


def plant(build, kernel, file, old, new):
    """What finds a fault, or None."""
    with tempfile.TemporaryDirectory() as changed:
        sources = Path(changed) / "src"
        shutil.copytree(ROOT / "src/kernel", sources / "kernel")
        (sources / "contact").mkdir()
        shutil.copy(ROOT / "include/contact/plain_decision.hpp", sources / "contact")
        path = sources / "kernel" / file
        path.write_text(path.read_text().replace(old, new))
        for header in (sources / "kernel").glob("*.hpp"):  # the compiler would refuse a constant below its proved bound
            header.write_text(re.sub(r"static_assert\([^;]*(?:proved|ForDouble)::[^;]*\);", "", header.read_text()))
        return found(build, sources, kernel)


def unplantable():
    """Faults whose text the sources do not hold once."""
    path = lambda file: ROOT / "include/contact/plain_decision.hpp" if file == FILTER else ROOT / "src/kernel" / file
    return [f"{file}: {old}" for _, file, old, _ in FAULTS if path(file).read_text().count(old) != 1]


def main():
    if missing := unplantable():
        print("\n".join(["not once in the sources:", *missing]))
        return 1
    if sys.argv[1:] == ["--check"]:
        return 0
    compiler, eigen, include, *words = sys.argv[1:]
    faults = [fault for fault in FAULTS if not words or any(word in "\t".join(fault) for word in words)]
    missed = 0
    with tempfile.TemporaryDirectory() as temporary, concurrent.futures.ThreadPoolExecutor(2) as pool:
        build = Build(compiler, eigen, include, Path(temporary))
        for (kernel, file, old, new), what in zip(faults, pool.map(lambda fault: plant(build, *fault), faults)):
            missed += what is None
            print(f"{kernel}: {file}: {old}  ->  {new}\n    {what or 'NOT FOUND'}", flush=True)
    print(f"{len(faults)} faults, {missed} not found")
    return 1 if missed or not faults else 0


if __name__ == "__main__":
    sys.exit(main())
