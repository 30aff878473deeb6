//! A symmetric matrix as the entries of its lower triangle.

use crate::curve::insertion::{append, append_all, filled, room};
use crate::error::Error;

/// Lists of unknowns: two that are in one list have an entry in common.
#[derive(Debug, Default)]
pub(crate) struct Groups {
    ends: Vec<usize>,
    members: Vec<usize>,
}

/// The lower triangle, column by column, rows rising; every diagonal entry is there.
#[derive(Debug)]
pub(crate) struct Symmetric {
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

/// Both triangles, row by row.
#[derive(Debug)]
pub(crate) struct Whole {
    starts: Vec<usize>,
    entries: Vec<(usize, f64)>,
}

impl Groups {
    /// One list more; unknowns may be named twice.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn push(&mut self, members: impl Iterator<Item = usize>) -> Result<(), Error> {
        for member in members {
            append(&mut self.members, member)?;
        }
        append(&mut self.ends, self.members.len())
    }

    fn iter(&self) -> impl Iterator<Item = &[usize]> {
        let start = |k: usize| if k == 0 { 0 } else { self.ends[k - 1] };
        (0..self.ends.len()).map(move |k| &self.members[start(k)..self.ends[k]])
    }

    /// The lists that each of `count` unknowns is in: where they begin, and their numbers.
    fn of_each(&self, count: usize) -> Result<(Vec<usize>, Vec<usize>), Error> {
        let mut starts = filled(count + 1, 0)?;
        self.members.iter().for_each(|&i| starts[i + 1] += 1);
        (0..count).for_each(|i| starts[i + 1] += starts[i]);
        let mut next = filled(count, 0)?;
        next.copy_from_slice(&starts[..count]);
        let mut lists = filled(self.members.len(), 0)?;
        for (k, members) in self.iter().enumerate() {
            for &i in members {
                lists[next[i]] = k;
                next[i] += 1;
            }
        }
        Ok((starts, lists))
    }
}

impl Symmetric {
    /// Zeros on the diagonal and where unknowns meet.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new(count: usize, groups: &Groups) -> Result<Self, Error> {
        let (first, lists) = groups.of_each(count)?;
        let members = |k: usize| {
            let start = if k == 0 { 0 } else { groups.ends[k - 1] };
            &groups.members[start..groups.ends[k]]
        };
        let mut starts = room(count + 1)?;
        starts.push(0);
        let mut rows: Vec<usize> = Vec::new();
        let mut seen = filled(count, 0)?;
        for j in 0..count {
            let begin = rows.len();
            append(&mut rows, j)?;
            seen[j] = j + 1;
            for &k in &lists[first[j]..first[j + 1]] {
                for &i in members(k) {
                    if i > j && seen[i] != j + 1 {
                        seen[i] = j + 1;
                        append(&mut rows, i)?;
                    }
                }
            }
            rows[begin..].sort_unstable();
            starts.push(rows.len());
        }
        let values = filled(rows.len(), 0.0)?;
        Ok(Self { starts, rows, values })
    }

    /// Number of unknowns.
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// Where each column begins, and the rows.
    pub fn pattern(&self) -> (&[usize], &[usize]) {
        (&self.starts, &self.rows)
    }

    /// The entries, as [`Self::pattern`] orders them.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Adds to the entry (i, j) = (j, i); what is not there must be nothing.
    pub fn add(&mut self, i: usize, j: usize, x: f64) {
        let (i, j) = if i >= j { (i, j) } else { (j, i) };
        let column = &self.rows[self.starts[j]..self.starts[j + 1]];
        match column.binary_search(&i) {
            Ok(place) => self.values[self.starts[j] + place] += x,
            Err(_) => debug_assert!(x == 0.0, "no entry ({i}, {j})"),
        }
    }

    /// All entries become zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Becomes `a + share b`; all three have the same pattern.
    pub fn set_sum(&mut self, a: &Self, share: f64, b: &Self) {
        let terms = a.values.iter().zip(&b.values);
        self.values.iter_mut().zip(terms).for_each(|(x, (a, b))| *x = a + share * b);
    }

    /// An entry of the diagonal.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.values[self.starts[i]]
    }

    /// Adds `share` times the mean of the diagonal to the diagonal.
    pub fn add_ridge(&mut self, share: f64) {
        let n = self.count();
        let mean = (0..n).map(|i| self.diagonal(i)).sum::<f64>() / n as f64;
        for i in 0..n {
            self.values[self.starts[i]] += share * mean;
        }
    }

    /// A matrix with the same pattern and values.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn copied(&self) -> Result<Self, Error> {
        let mut copy = Self { starts: Vec::new(), rows: Vec::new(), values: Vec::new() };
        append_all(&mut copy.starts, &self.starts)?;
        append_all(&mut copy.rows, &self.rows)?;
        append_all(&mut copy.values, &self.values)?;
        Ok(copy)
    }

    /// Both triangles.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn whole(&self) -> Result<Whole, Error> {
        let n = self.count();
        let mut starts = filled(n + 1, 0)?;
        let columns =
            || (0..n).flat_map(|j| (self.starts[j]..self.starts[j + 1]).map(move |e| (j, e)));
        for (j, e) in columns() {
            starts[self.rows[e] + 1] += 1;
            starts[j + 1] += usize::from(self.rows[e] != j);
        }
        (0..n).for_each(|i| starts[i + 1] += starts[i]);
        let mut next = filled(n, 0)?;
        next.copy_from_slice(&starts[..n]);
        let mut entries = filled(starts[n], (0, 0.0))?;
        let mut put = |i: usize, j: usize, x: f64| {
            entries[next[i]] = (j, x);
            next[i] += 1;
        };
        for (j, e) in columns() {
            put(self.rows[e], j, self.values[e]);
            if self.rows[e] != j {
                put(j, self.rows[e], self.values[e]);
            }
        }
        Ok(Whole { starts, entries })
    }
}

impl Whole {
    /// The entries of a row: column and value.
    pub fn row(&self, i: usize) -> &[(usize, f64)] {
        &self.entries[self.starts[i]..self.starts[i + 1]]
    }
}
