//! Cholesky's factor by supernodes: columns that are eliminated together, stored as one dense panel.
//!
//! ```text
//!   panel of s   columns b..e         for each panel d below with rows in b..e:
//!     x . .      rows b..e              s -= L_d[rows] L_d[rows in b..e]^T      a dense product, then put where its rows are
//!     x x .                           then the panel itself, column by column
//!     x x x
//!     x x x      rows of the pattern
//! ```
//!
//! Each entry of a product is one sum over the columns of d in their order; lanes of vectors are different entries. So the bits do not depend
//! on the vectors that the compiler takes.

/// Columns b..e of a supernode, its pattern below, and where its panel lies.
#[derive(Debug)]
pub(super) struct Panel {
    pub columns: std::ops::Range<usize>,
    pub pattern: std::ops::Range<usize>,
    pub values: std::ops::Range<usize>,
}

impl Panel {
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    pub fn height(&self) -> usize {
        self.columns.len() + self.pattern.len()
    }
}

/// Columns of a panel that are done together.
pub(super) const BLOCK: usize = 8;

/// Where walks over the panels are, for each panel; one list of numbers for all.
pub(super) struct Walk<'a> {
    /// The panel of each column.
    pub of_column: &'a [usize],
    /// Place of each row in the present panel.
    pub local: &'a mut [usize],
    /// First of the panels that wait for this one, and the next one that waits for the same.
    pub head: &'a mut [usize],
    pub next: &'a mut [usize],
    /// Rows of its pattern that a panel has been taken for.
    pub done: &'a mut [usize],
    /// Room for the greatest product.
    pub product: &'a mut [f64],
}

/// No panel.
const NONE: usize = usize::MAX;

/// Replaces the entries of the matrix by those of the factor; false when it is not positive definite.
pub(super) fn factorise(panels: &[Panel], rows: &[usize], values: &mut [f64], walk: Walk) -> bool {
    let Walk { of_column, local, head, next, done, product } = walk;
    head.fill(NONE);
    for (s, panel) in panels.iter().enumerate() {
        let (width, height) = (panel.width(), panel.height());
        let (begin, end) = (panel.columns.start, panel.columns.end);
        let pattern = &rows[panel.pattern.clone()];
        (begin..end).for_each(|j| local[j] = j - begin);
        pattern.iter().enumerate().for_each(|(i, &row)| local[row] = width + i);
        let (before, own) = values.split_at_mut(panel.values.start);
        let own = &mut own[..panel.values.len()];
        let mut d = head[s];
        while d != NONE {
            let (after, other) = (next[d], &panels[d]);
            let theirs = &rows[other.pattern.clone()];
            let from = done[d];
            let to = from + theirs[from..].iter().take_while(|&&row| row < end).count();
            let size = [theirs.len() - from, to - from];
            let place = other.width() + from;
            multiply(
                product,
                size,
                &before[other.values.clone()],
                other.height(),
                place,
                other.width(),
            );
            for j in 0..size[1] {
                let column = &mut own[local[theirs[from + j]] * height..][..height];
                let terms = &product[j * size[0]..(j + 1) * size[0]];
                for (x, row) in terms[j..].iter().zip(&theirs[from + j..]) {
                    column[local[*row]] -= x;
                }
            }
            done[d] = to;
            if let Some(&row) = theirs.get(to) {
                (next[d], head[of_column[row]]) = (head[of_column[row]], d);
            }
            d = after;
        }
        if !factorise_panel(own, width, height, product) {
            return false;
        }
        done[s] = 0;
        if let Some(&row) = pattern.first() {
            (next[s], head[of_column[row]]) = (head[of_column[row]], s);
        }
    }
    true
}

/// The dense panel: its triangle, and the rows below divided by it.
fn factorise_panel(own: &mut [f64], width: usize, height: usize, product: &mut [f64]) -> bool {
    for first in (0..width).step_by(BLOCK) {
        let block = BLOCK.min(width - first);
        let size = [height - first, block];
        multiply(product, size, own, height, first, first);
        for j in 0..block {
            let column = &mut own[(first + j) * height + first..(first + j + 1) * height];
            let terms = &product[j * size[0]..(j + 1) * size[0]];
            column[j..].iter_mut().zip(&terms[j..]).for_each(|(x, term)| *x -= term);
        }
        for j in first..first + block {
            let (left, right) = own.split_at_mut(j * height);
            let column = &mut right[j..height];
            for k in first..j {
                let done = &left[k * height + j..(k + 1) * height];
                let factor = done[0];
                column.iter_mut().zip(done).for_each(|(x, y)| *x -= factor * y);
            }
            if !(column[0] > 0.0 && column[0].is_finite()) {
                return false;
            }
            let root = column[0].sqrt();
            column[0] = root;
            column[1..].iter_mut().for_each(|x| *x /= root);
        }
    }
    true
}

/// `out = A B^T` with the first `depth` columns of a panel: A its rows from `first` on, B the first `size[1]` of them. Column by column; of
/// the rows above the diagonal some are left as they were.
fn multiply(
    out: &mut [f64],
    size: [usize; 2],
    panel: &[f64],
    height: usize,
    first: usize,
    depth: usize,
) {
    let [m, n] = size;
    for j in (0..n).step_by(4) {
        for i in (j / 8 * 8..m).step_by(8) {
            let (rows, columns) = (8.min(m - i), 4.min(n - j));
            let mut sums = [[0.0; 8]; 4];
            if rows == 8 && columns == 4 {
                for column in panel.chunks_exact(height).take(depth) {
                    let a: &[f64] = &column[first + i..first + i + 8];
                    let b: &[f64] = &column[first + j..first + j + 4];
                    for (sums, b) in sums.iter_mut().zip(b) {
                        sums.iter_mut().zip(a).for_each(|(sum, a)| *sum += a * b);
                    }
                }
            } else {
                for column in panel.chunks_exact(height).take(depth) {
                    let a = &column[first + i..first + i + rows];
                    let b = &column[first + j..first + j + columns];
                    for (sums, b) in sums.iter_mut().zip(b) {
                        sums.iter_mut().zip(a).for_each(|(sum, a)| *sum += a * b);
                    }
                }
            }
            for (k, sums) in sums[..columns].iter().enumerate() {
                out[(j + k) * m + i..][..rows].copy_from_slice(&sums[..rows]);
            }
        }
    }
}

/// Solves with the factor, in place and in the order of its columns: for `N` right-hand sides at once.
pub(super) fn solve<const N: usize>(
    panels: &[Panel],
    rows: &[usize],
    values: &[f64],
    x: &mut [[f64; N]],
) {
    let parts = |panel: &Panel| (panel.height(), &rows[panel.pattern.clone()]);
    for panel in panels {
        let (height, pattern) = parts(panel);
        for (j, column) in values[panel.values.clone()].chunks_exact(height).enumerate() {
            let (upper, lower) = x[panel.columns.start + j..].split_at_mut(panel.width() - j);
            upper[0] = upper[0].map(|x| x / column[j]);
            let (known, offset) = (upper[0], panel.columns.end);
            let subtract = |x: &mut [f64; N], factor: f64| {
                (0..N).for_each(|k| x[k] -= factor * known[k]);
            };
            upper[1..].iter_mut().zip(&column[j + 1..]).for_each(|(x, a)| subtract(x, *a));
            for (row, a) in pattern.iter().zip(&column[panel.width()..]) {
                subtract(&mut lower[row - offset], *a);
            }
        }
    }
    for panel in panels.iter().rev() {
        let (height, pattern) = parts(panel);
        for (j, column) in values[panel.values.clone()].chunks_exact(height).enumerate().rev() {
            let begin = panel.columns.start + j;
            let mut sum = x[begin];
            let mut subtract = |x: &[f64; N], factor: f64| {
                (0..N).for_each(|k| sum[k] -= factor * x[k]);
            };
            let own = &x[begin + 1..panel.columns.end];
            own.iter().zip(&column[j + 1..]).for_each(|(x, a)| subtract(x, *a));
            pattern
                .iter()
                .zip(&column[panel.width()..])
                .for_each(|(&row, a)| subtract(&x[row], *a));
            x[begin] = sum.map(|x| x / column[j]);
        }
    }
}
