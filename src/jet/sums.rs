//! What jets are made of: bases, sums over poles, quotients. One body each for single queries and for lanes of many, so that
//! both give the same bits.

use super::Lane;
use crate::bezier::basis;
use crate::simd::{Lanes, Simd};

/// Degrees whose loops have fixed lengths.
pub const FIXED: usize = 5;

/// Degrees up to which the number of columns of a patch is known to the compiler.
pub const EXACT: usize = 9;

/// Degrees whose arrays are half as long as those of the highest.
pub const MIDDLE: usize = 15;

/// Basis values, first and second derivatives.
pub type Basis<V, const N: usize> = [[V; N]; 3];

/// The Bernstein basis of degree `n - 1`, `n <= N`; what is beyond `n` is zero.
#[inline(always)]
pub fn bernstein<V: Lanes<W>, const W: usize, const N: usize>(n: usize, s: V) -> Basis<V, N> {
    match n {
        2 => widened::<V, W, 2, N>(fixed_basis(s)),
        3 => widened::<V, W, 3, N>(fixed_basis(s)),
        4 => widened::<V, W, 4, N>(fixed_basis(s)),
        5 => widened::<V, W, 5, N>(fixed_basis(s)),
        6 => widened::<V, W, 6, N>(fixed_basis(s)),
        7 if N >= 7 => widened::<V, W, 7, N>(power_basis(s)),
        8 if N >= 8 => widened::<V, W, 8, N>(power_basis(s)),
        9 if N >= 9 => widened::<V, W, 9, N>(power_basis(s)),
        10 if N >= 10 => widened::<V, W, 10, N>(power_basis(s)),
        _ => {
            let mut out = [[V::splat(0.0); N]; 3];
            if N <= FIXED + 1 {
                // Not so many poles: nothing to compile.
                return out;
            }
            let [values, first, second] = &mut out;
            basis::<V, W, N>(n - 1, s, &mut values[..n], &mut first[..n], &mut second[..n]);
            out
        }
    }
}

#[inline(always)]
pub fn widened<V: Lanes<W>, const W: usize, const M: usize, const N: usize>(
    basis: Basis<V, M>,
) -> Basis<V, N> {
    let mut out = [[V::splat(0.0); N]; 3];
    for k in 0..3 {
        for i in 0..M.min(N) {
            out[k][i] = basis[k][i];
        }
    }
    out
}

/// As [`basis`], for a degree `M - 1` that the compiler knows: the same steps without loops.
#[inline(always)]
pub fn fixed_basis<V: Lanes<W>, const W: usize, const M: usize>(s: V) -> Basis<V, M> {
    let (zero, unit) = (V::splat(0.0), V::splat(1.0));
    let (p, r) = (M - 1, unit - s);
    let (mut row, mut once, mut twice) = ([zero; M], [zero; M], [zero; M]);
    row[0] = unit;
    for level in 0..p {
        if level + 2 == p {
            twice = row;
        }
        if level + 1 == p {
            once = row;
        }
        let mut carry = zero;
        for i in 0..=level {
            let old = row[i];
            row[i] = carry + r * old;
            carry = s * old;
        }
        row[level + 1] = carry;
    }
    let (n, m) = (V::splat(p as f64), V::splat((p * (p - 1)) as f64));
    let (mut first, mut second) = ([zero; M], [zero; M]);
    for i in 0..M {
        let one = if i > 0 { once[i - 1] } else { zero };
        first[i] = n * (one - once[i]);
        let (one, two) =
            (if i > 0 { twice[i - 1] } else { zero }, if i > 1 { twice[i - 2] } else { zero });
        second[i] = m * (two - V::splat(2.0) * one + twice[i]);
    }
    [row, first, second]
}

/// As [`basis`], for a degree `M - 1` that the compiler knows: the same steps without loops.
#[inline(always)]
fn power_basis<V: Lanes<W>, const W: usize, const M: usize>(s: V) -> Basis<V, M> {
    let [mut values, mut first, mut second] = [[V::splat(0.0); M]; 3];
    basis::<V, W, M>(M - 1, s, &mut values, &mut first, &mut second);
    [values, first, second]
}

/// Value, first and second derivative of a segment, from the basis; values of it are `STRIDE` apart.
#[inline(always)]
pub fn segment_sums<S: Simd, const STRIDE: usize>(lanes: &[Lane], b: [&[f64]; 3]) -> [S::F4; 3] {
    let mut sums = [S::F4::splat(0.0); 3];
    for (k, lane) in lanes.iter().enumerate() {
        let lane = S::F4::load(lane);
        for c in 0..3 {
            sums[c] = sums[c] + S::F4::splat(b[c][k * STRIDE]) * lane;
        }
    }
    sums
}

/// Value, s, t, ss, st, tt of a patch, from the bases; values of them are `STRIDE` apart. `N` is the number of columns, or
/// at least that.
#[inline(always)]
pub fn patch_sums<S: Simd, const N: usize, const STRIDE: usize>(
    lanes: &[Lane],
    columns: usize,
    across: [&[f64]; 3],
    along: [&[f64]; 3],
) -> [S::F4; 6] {
    // Sums over the rows, one a column; then sums over the columns.
    let mut partial = [[S::F4::splat(0.0); N]; 3];
    for (i, row) in lanes.chunks_exact(columns).enumerate() {
        let i = i * STRIDE;
        let (b, b1) = (S::F4::splat(across[0][i]), S::F4::splat(across[1][i]));
        let b2 = S::F4::splat(across[2][i]);
        for j in 0..columns {
            let lane = S::F4::load(&row[j]);
            partial[0][j] = partial[0][j] + b * lane;
            partial[1][j] = partial[1][j] + b1 * lane;
            partial[2][j] = partial[2][j] + b2 * lane;
        }
    }
    let mut sums = [S::F4::splat(0.0); 6];
    for j in 0..columns {
        let (value, s, ss) = (partial[0][j], partial[1][j], partial[2][j]);
        let (b, b1) = (S::F4::splat(along[0][j * STRIDE]), S::F4::splat(along[1][j * STRIDE]));
        let b2 = S::F4::splat(along[2][j * STRIDE]);
        let terms = [b * value, b * s, b1 * value, b * ss, b1 * s, b2 * value];
        for k in 0..6 {
            sums[k] = sums[k] + terms[k];
        }
    }
    sums
}

/// The quotients of three sums and their derivatives by the weights: vector, first and second derivative.
#[inline(always)]
pub fn quotients<V: Lanes<N>, const N: usize>(sums: [V; 3], weights: [V; 3], p: V) -> [V; 3] {
    let [w, w1, w2] = weights;
    let d = (sums[0] - w * p) / w;
    let s = (sums[1] - w1 * p - w1 * d) / w;
    let ss = (sums[2] - w2 * p - V::splat(2.0) * w1 * s - w2 * d) / w;
    [d, s, ss]
}

/// The quotients of six sums by the weights: vector, s, t, ss, st, tt.
#[inline(always)]
pub fn quotients_of_two<V: Lanes<N>, const N: usize>(
    sums: [V; 6],
    weights: [V; 6],
    p: V,
) -> [V; 6] {
    let two = V::splat(2.0);
    let [w, ws, wt, wss, wst, wtt] = weights;
    let d = (sums[0] - w * p) / w;
    let s = (sums[1] - ws * p - ws * d) / w;
    let t = (sums[2] - wt * p - wt * d) / w;
    let ss = (sums[3] - wss * p - two * ws * s - wss * d) / w;
    let st = (sums[4] - wst * p - ws * t - wt * s - wst * d) / w;
    let tt = (sums[5] - wtt * p - two * wt * t - wtt * d) / w;
    [d, s, t, ss, st, tt]
}
