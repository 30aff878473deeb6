//! Jets of many queries, each on a piece of its own: bases and quotients lane by lane, sums pole by pole.
//!
//! Bit for bit the jets of [`BezierPatch::jet`](super::BezierPatch::jet) and [`BezierSegment::jet`](super::BezierSegment::jet).

use super::Lane;
use super::sums::{bernstein, patch_sums, quotients, quotients_of_two, segment_sums};
use crate::bezier::Bidegree;
use crate::simd::{Kernel, Lanes, Level, MOST_DEGREE, Row, Simd, WIDTH};

/// Basis values and derivatives of each query.
type Bases = [[Row; MOST_DEGREE + 1]; 3];

const NO_BASES: Bases = [[[0.0; WIDTH]; MOST_DEGREE + 1]; 3];

/// Sums over the poles, of each query.
type Sums<const N: usize> = [[Lane; N]; WIDTH];

/// The jets of some queries on patches of one surface, number by number; room for them, used again and again.
#[derive(Clone, Debug)]
pub struct PatchJets {
    bases: [Bases; 2],
    sums: Sums<6>,
}

/// As [`PatchJets`], on segments of a curve.
#[derive(Clone, Debug)]
pub struct SegmentJets {
    basis: Bases,
    sums: Sums<3>,
}

impl Default for PatchJets {
    fn default() -> Self {
        Self { bases: [NO_BASES; 2], sums: [[[1.0; 4]; 6]; WIDTH] }
    }
}

impl Default for SegmentJets {
    fn default() -> Self {
        Self { basis: NO_BASES, sums: [[[1.0; 4]; 3]; WIDTH] }
    }
}

impl PatchJets {
    /// Sums over the nets at the places (s, t); of places beyond the nets nothing is computed.
    pub fn look(&mut self, degree: Bidegree, nets: &[&[Lane]], at: &[Row; 2], level: Level) {
        let [across, along] = &mut self.bases;
        level.run(FillBases { count: degree.s + 1, at: &at[0], out: across });
        level.run(FillBases { count: degree.t + 1, at: &at[1], out: along });
        level.run(PatchSums { columns: degree.t + 1, nets, across, along, out: &mut self.sums });
    }

    /// d, s, t, ss, st, tt and the weights, lane by lane, for the queries `p`.
    #[inline(always)]
    pub fn jets<V: Lanes<WIDTH>>(&self, p: [V; 3], rational: bool) -> ([[V; 3]; 6], V) {
        let unit = V::splat(1.0);
        let mut jets = [[unit; 3]; 6];
        let mut weights = [unit; 6];
        if rational {
            for k in 0..6 {
                weights[k] = gathered(&self.sums, k, 3);
            }
        }
        for c in 0..3 {
            let mut sums = [unit; 6];
            for k in 0..6 {
                sums[k] = gathered(&self.sums, k, c);
            }
            if rational {
                sums = quotients_of_two(sums, weights, p[c]);
            } else {
                sums[0] = sums[0] - p[c];
            }
            for k in 0..6 {
                jets[k][c] = sums[k];
            }
        }
        (jets, weights[0])
    }
}

impl SegmentJets {
    /// As [`PatchJets::look`].
    pub fn look(&mut self, degree: usize, nets: &[&[Lane]], at: &Row, level: Level) {
        level.run(FillBases { count: degree + 1, at, out: &mut self.basis });
        level.run(SegmentSums { nets, basis: &self.basis, out: &mut self.sums });
    }

    /// d, s, ss and the weight, lane by lane, for the queries `p`.
    #[inline(always)]
    pub fn jets<V: Lanes<WIDTH>>(&self, p: [V; 3], rational: bool) -> ([[V; 3]; 3], V) {
        let unit = V::splat(1.0);
        let mut jets = [[unit; 3]; 3];
        let mut weights = [unit; 3];
        if rational {
            for k in 0..3 {
                weights[k] = gathered(&self.sums, k, 3);
            }
        }
        for c in 0..3 {
            let mut sums = [unit; 3];
            for k in 0..3 {
                sums[k] = gathered(&self.sums, k, c);
            }
            if rational {
                sums = quotients(sums, weights, p[c]);
            } else {
                sums[0] = sums[0] - p[c];
            }
            for k in 0..3 {
                jets[k][c] = sums[k];
            }
        }
        (jets, weights[0])
    }
}

/// Component `c` of sum `k` of all queries.
#[inline(always)]
fn gathered<V: Lanes<WIDTH>, const N: usize>(sums: &Sums<N>, k: usize, c: usize) -> V {
    let mut row = [0.0; WIDTH];
    for q in 0..WIDTH {
        row[q] = sums[q][k][c];
    }
    V::load(&row)
}

struct FillBases<'a> {
    count: usize,
    at: &'a Row,
    out: &'a mut Bases,
}

impl FillBases<'_> {
    #[inline(always)]
    fn fill<V: Lanes<WIDTH>, const N: usize>(self) {
        let bases = bernstein::<V, WIDTH, N>(N, V::load(self.at));
        for k in 0..3 {
            for i in 0..N {
                bases[k][i].store(&mut self.out[k][i]);
            }
        }
    }
}

impl Kernel for FillBases<'_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        match self.count {
            2 => self.fill::<S::F8, 2>(),
            3 => self.fill::<S::F8, 3>(),
            4 => self.fill::<S::F8, 4>(),
            5 => self.fill::<S::F8, 5>(),
            6 => self.fill::<S::F8, 6>(),
            7 => self.fill::<S::F8, 7>(),
            8 => self.fill::<S::F8, 8>(),
            9 => self.fill::<S::F8, 9>(),
            10 => self.fill::<S::F8, 10>(),
            count => unreachable!("{count} poles in lockstep"),
        }
    }
}

/// The values of one query in the bases: `WIDTH` apart.
#[inline(always)]
fn of_query(bases: &Bases, q: usize) -> [&[f64]; 3] {
    [&bases[0].as_flattened()[q..], &bases[1].as_flattened()[q..], &bases[2].as_flattened()[q..]]
}

struct PatchSums<'a> {
    columns: usize,
    nets: &'a [&'a [Lane]],
    across: &'a Bases,
    along: &'a Bases,
    out: &'a mut Sums<6>,
}

impl PatchSums<'_> {
    #[inline(always)]
    fn sum<S: Simd, const N: usize>(self) {
        for (q, net) in self.nets.iter().enumerate() {
            let (across, along) = (of_query(self.across, q), of_query(self.along, q));
            let sums = patch_sums::<S, N, WIDTH>(net, N, across, along);
            for k in 0..6 {
                sums[k].store(&mut self.out[q][k]);
            }
        }
    }
}

impl Kernel for PatchSums<'_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        match self.columns {
            2 => self.sum::<S, 2>(),
            3 => self.sum::<S, 3>(),
            4 => self.sum::<S, 4>(),
            5 => self.sum::<S, 5>(),
            6 => self.sum::<S, 6>(),
            7 => self.sum::<S, 7>(),
            8 => self.sum::<S, 8>(),
            9 => self.sum::<S, 9>(),
            10 => self.sum::<S, 10>(),
            count => unreachable!("{count} columns in lockstep"),
        }
    }
}

struct SegmentSums<'a> {
    nets: &'a [&'a [Lane]],
    basis: &'a Bases,
    out: &'a mut Sums<3>,
}

impl Kernel for SegmentSums<'_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        for (q, net) in self.nets.iter().enumerate() {
            let sums = segment_sums::<S, WIDTH>(net, of_query(self.basis, q));
            for k in 0..3 {
                sums[k].store(&mut self.out[q][k]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jet::{BezierPatch, BezierSegment, lanes};

    struct Gather<'a>(&'a PatchJets, [Row; 3], bool);

    impl Kernel for Gather<'_> {
        type Out = ([[Row; 3]; 6], Row);

        #[inline(always)]
        fn run<S: Simd>(self, _: S) -> Self::Out {
            let p = [S::F8::load(&self.1[0]), S::F8::load(&self.1[1]), S::F8::load(&self.1[2])];
            let (jets, w) = self.0.jets(p, self.2);
            (jets.map(|jet| jet.map(Lanes::array)), w.array())
        }
    }

    struct GatherCurve<'a>(&'a SegmentJets, [Row; 3], bool);

    impl Kernel for GatherCurve<'_> {
        type Out = ([[Row; 3]; 3], Row);

        #[inline(always)]
        fn run<S: Simd>(self, _: S) -> Self::Out {
            let p = [S::F8::load(&self.1[0]), S::F8::load(&self.1[1]), S::F8::load(&self.1[2])];
            let (jets, w) = self.0.jets(p, self.2);
            (jets.map(|jet| jet.map(Lanes::array)), w.array())
        }
    }

    fn number(k: usize) -> f64 {
        ((k * 7919) % 1009) as f64 / 1009.0
    }

    fn poles(count: usize, rational: bool) -> Vec<f64> {
        let all = count * if rational { 4 } else { 3 };
        (0..all).map(|k| number(k) + if k >= 3 * count { 0.5 } else { -0.4 }).collect()
    }

    #[test]
    fn lanes_have_the_bits_of_single_jets() {
        let rows: [Row; 5] = std::array::from_fn(|c| std::array::from_fn(|q| number(c * 31 + q)));
        let p = [rows[2], rows[3], rows[4]];
        for level in Level::available() {
            for (s, t, rational) in (1..=MOST_DEGREE)
                .flat_map(|s| (1..=MOST_DEGREE).flat_map(move |t| [(s, t, false), (s, t, true)]))
            {
                let (poles, degree) = (poles((s + 1) * (t + 1), rational), Bidegree { s, t });
                let lanes: Vec<Lane> = lanes(&poles, rational).collect();
                let patch = BezierPatch { degree, rational, poles: &poles, lanes: &lanes, level };
                let mut together = PatchJets::default();
                together.look(degree, &[&lanes[..]; WIDTH], &[rows[0], rows[1]], level);
                let (jets, w) = level.run(Gather(&together, p, rational));
                for q in 0..WIDTH {
                    let one = patch.jet(rows[0][q], rows[1][q], p.map(|row| row[q]));
                    let all = [one.d, one.s, one.t, one.ss, one.st, one.tt];
                    assert_eq!(jets.map(|jet| jet.map(|row| row[q])), all, "{s} {t} {rational}");
                    assert_eq!(w[q], one.w[0]);
                }
            }
            for (degree, rational) in (1..=MOST_DEGREE).flat_map(|p| [(p, false), (p, true)]) {
                let poles = poles(degree + 1, rational);
                let lanes: Vec<Lane> = lanes(&poles, rational).collect();
                let segment =
                    BezierSegment { degree, rational, poles: &poles, lanes: &lanes, level };
                let mut together = SegmentJets::default();
                together.look(degree, &[&lanes[..]; WIDTH], &rows[0], level);
                let (jets, w) = level.run(GatherCurve(&together, p, rational));
                for q in 0..WIDTH {
                    let one = segment.jet(rows[0][q], p.map(|row| row[q]));
                    let all = [one.d, one.s, one.ss];
                    assert_eq!(jets.map(|jet| jet.map(|row| row[q])), all, "{degree} {rational}");
                    assert_eq!(w[q], one.w[0]);
                }
            }
        }
    }
}
