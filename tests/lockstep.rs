//! Queries asked together have the bits of queries asked one by one: on cases and random shapes, with hints of every kind, at every
//! level, in groups of any size.

#[path = "cases/mod.rs"]
#[allow(dead_code, reason = "shapes and points only")]
mod cases;
mod shapes;

use cases::Shape;
use footpoint::closest::{FootPoint, QueryOptions, Workspace};
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::simd::Level;
use shapes::asked::bits;
use shapes::{FAMILIES, Random, Vector, curve, query, surface};

type Asked<const N: usize> = (Vector, Option<[f64; N]>);

/// Sizes of groups: alone, fewer than lanes, as many, more, a whole group.
const SIZES: [usize; 6] = [1, 2, 7, 8, 9, 128];

/// What one query and what many give, with the same options.
trait Both<const N: usize> {
    fn one(
        &self,
        asked: Asked<N>,
        options: &QueryOptions,
        memory: &mut Workspace,
    ) -> [FootPoint; 2];
    fn many(
        &self,
        asked: &dyn Fn(usize) -> Asked<N>,
        options: &QueryOptions,
        memory: &mut Workspace,
        out: [&mut [FootPoint]; 2],
    );
}

impl Both<1> for IndexedCurve {
    fn one(&self, (q, hint): Asked<1>, o: &QueryOptions, w: &mut Workspace) -> [FootPoint; 2] {
        let hint = hint.map(|[u]| u);
        [self.closest(q, hint, o, w, None), self.invert(q, hint, o, w, None)]
    }

    fn many(
        &self,
        asked: &dyn Fn(usize) -> Asked<1>,
        o: &QueryOptions,
        w: &mut Workspace,
        [closest, inverted]: [&mut [FootPoint]; 2],
    ) {
        self.closest_together(asked, o, w, closest);
        self.invert_together(asked, o, w, inverted);
    }
}

impl Both<2> for IndexedSurface {
    fn one(&self, (q, hint): Asked<2>, o: &QueryOptions, w: &mut Workspace) -> [FootPoint; 2] {
        [self.closest(q, hint, o, w, None), self.invert(q, hint, o, w, None)]
    }

    fn many(
        &self,
        asked: &dyn Fn(usize) -> Asked<2>,
        o: &QueryOptions,
        w: &mut Workspace,
        [closest, inverted]: [&mut [FootPoint]; 2],
    ) {
        self.closest_together(asked, o, w, closest);
        self.invert_together(asked, o, w, inverted);
    }
}

/// Asks all together, in groups of `size`, and compares with the answers to each; the number of feet that are proven.
fn same<const N: usize>(
    shape: &impl Both<N>,
    asked: &[Asked<N>],
    size: usize,
    options: &QueryOptions,
    name: &str,
) -> usize {
    let (mut memory, mut proven) = (Workspace::default(), 0);
    for group in asked.chunks(size) {
        let mut out = [0, 1].map(|_| vec![FootPoint::unreached(); group.len()]);
        let [closest, inverted] = &mut out;
        shape.many(&|k| group[k], options, &mut memory, [closest, inverted]);
        for (k, &query) in group.iter().enumerate() {
            let expected = shape.one(query, options, &mut memory);
            for (found, expected) in out.each_ref().map(|list| &list[k]).iter().zip(&expected) {
                assert_eq!(bits(found), bits(expected), "{name}: {query:?}, groups of {size}");
            }
            proven += usize::from(expected[0].flags & footpoint::closest::flag::NOT_PROVEN == 0);
        }
    }
    proven
}

/// Hints beside the feet and anywhere, none, and such that say nothing.
fn hinted<const N: usize>(
    feet: &[(Vector, [f64; N])],
    ends: [[f64; 2]; N],
    r: &mut Random,
) -> Vec<Asked<N>> {
    let beside = |at: [f64; N], share: f64, r: &mut Random| {
        std::array::from_fn(|k| {
            let [first, last] = ends[k];
            (at[k] + share * (r.unit() - 0.5) * (last - first)).clamp(first, last)
        })
    };
    let hint = |k: usize, at: [f64; N], r: &mut Random| match k % 5 {
        0 => None,
        1 => Some(beside(at, 0.01, r)),
        2 => Some(beside(at, 2.0, r)),
        3 => Some([f64::NAN; N]),
        _ => Some(at),
    };
    feet.iter().enumerate().map(|(k, &(query, at))| (query, hint(k, at, r))).collect()
}

#[test]
fn cases_answer_alike() {
    let options = QueryOptions::default();
    let mut proven = 0;
    for folder in cases::folders() {
        let case = cases::read(&folder);
        let mut r = Random(7);
        let rows = case.rows.iter().take(160);
        let place = |row: &cases::Row| row.place.map(|x| x.unwrap_or(0.0));
        proven += match &case.shape {
            Shape::Curve(curve) => {
                let (first, last) = curve.curve().domain();
                let feet: Vec<_> = rows.map(|row| (row.query, [place(row)[0]])).collect();
                same(curve, &hinted(&feet, [[first, last]], &mut r), 128, &options, &case.name)
            }
            Shape::Surface(surface) => {
                let [u0, u1, v0, v1] = surface.surface().domain();
                let feet: Vec<_> = rows.map(|row| (row.query, place(row))).collect();
                let asked = hinted(&feet, [[u0, u1], [v0, v1]], &mut r);
                same(surface, &asked, 128, &options, &case.name)
            }
        };
    }
    assert!(proven > 1000, "{proven}");
}

#[test]
fn random_shapes_answer_alike_at_every_level_in_groups_of_any_size() {
    for (family, seed) in (0..FAMILIES.len()).flat_map(|f| (0..6).map(move |s| (f, s))) {
        let name = format!("family {family}, seed {seed}");
        let options = [
            QueryOptions::default(),
            QueryOptions { accuracy: 1e-3, tolerance: 1e-2, ..QueryOptions::default() },
        ];
        let (mut r, options) = (Random(!seed), options[seed as usize % 2]);
        let shape = curve(&FAMILIES[family], seed);
        let (u0, u1) = shape.domain();
        let mut feet = Vec::new();
        for k in 0..40 {
            let u = u0 + r.unit() * (u1 - u0);
            let on = shape.evaluate(u);
            let at =
                if k % 9 == 5 { [f64::NAN; 3] } else { query(shape.bounding_box(), on, &mut r) };
            feet.push((if k % 9 == 4 { on } else { at }, [u]));
        }
        for (level, size) in Level::available().into_iter().flat_map(|l| SIZES.map(|s| (l, s))) {
            let indexed = IndexedCurve::at_level(shape.clone(), level);
            same(&indexed, &hinted(&feet, [[u0, u1]], &mut r), size, &options, &name);
        }
        let shape = surface(&FAMILIES[family], seed);
        let [u0, u1, v0, v1] = shape.domain();
        let mut feet = Vec::new();
        for k in 0..40 {
            let (u, v) = (u0 + r.unit() * (u1 - u0), v0 + r.unit() * (v1 - v0));
            let on = shape.evaluate(u, v);
            let at =
                if k % 9 == 5 { [f64::NAN; 3] } else { query(shape.bounding_box(), on, &mut r) };
            feet.push((if k % 9 == 4 { on } else { at }, [u, v]));
        }
        for (level, size) in Level::available().into_iter().zip([128, 7, 9]) {
            let indexed = IndexedSurface::at_level(shape.clone(), level);
            let asked = hinted(&feet, [[u0, u1], [v0, v1]], &mut r);
            same(&indexed, &asked, size, &options, &name);
        }
    }
}
