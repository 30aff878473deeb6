//! The same bits with every kind of vector instructions that the machine has.

mod shapes;

use footpoint::closest::{QueryOptions, Workspace};
use footpoint::extrema::ExtremaOptions;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::simd::Level;
use shapes::asked::bits;
use shapes::{FAMILIES, Random, Vector, curve, query, surface};

/// Queries around a shape of the given box, `on` being places of it.
fn queries(
    bounds: (Vector, Vector),
    on: impl Fn(f64, f64) -> Vector,
    r: &mut Random,
) -> Vec<Vector> {
    (0..8).map(|_| query(bounds, on(r.unit(), r.unit()), r)).collect()
}

/// The answers to all queries at one level, hints and ties included, as bits.
type Answers = Vec<[u64; 9]>;

#[test]
fn curves_answer_alike_at_every_level() {
    for (family, seed) in (0..FAMILIES.len()).flat_map(|f| (0..24).map(move |s| (f, s))) {
        let shape = curve(&FAMILIES[family], seed);
        let (u0, u1) = shape.domain();
        let on = |a: f64, _: f64| shape.evaluate(u0 + a * (u1 - u0));
        let asked = queries(shape.bounding_box(), on, &mut Random(!seed));
        let answers = |level: Level| -> Answers {
            let indexed = IndexedCurve::at_level(shape.clone(), level);
            let mut workspace = Workspace::default();
            let options = QueryOptions::default();
            let all = asked.iter().flat_map(|q| {
                let foot = indexed.closest(*q, None, &options, &mut workspace, None);
                let hinted = indexed.closest(*q, Some(foot.u), &options, &mut workspace, None);
                let options = ExtremaOptions::default();
                let set = indexed.extrema(*q, &options, &mut || false).expect("a set");
                let members = set.members.iter().map(|member| bits(&member.foot));
                [bits(&foot), bits(&hinted)].into_iter().chain(members).collect::<Vec<_>>()
            });
            all.collect()
        };
        let portable = answers(Level::PORTABLE);
        for level in Level::available() {
            assert_eq!(answers(level), portable, "{level:?}, family {family}, seed {seed}");
        }
    }
}

#[test]
fn surfaces_answer_alike_at_every_level() {
    for (family, seed) in (0..FAMILIES.len()).flat_map(|f| (0..12).map(move |s| (f, s))) {
        let shape = surface(&FAMILIES[family], seed);
        let [u0, u1, v0, v1] = shape.domain();
        let on = |a: f64, b: f64| shape.evaluate(u0 + a * (u1 - u0), v0 + b * (v1 - v0));
        let asked = queries(shape.bounding_box(), on, &mut Random(!seed));
        let answers = |level: Level| -> Answers {
            let indexed = IndexedSurface::at_level(shape.clone(), level);
            let mut workspace = Workspace::default();
            let options = QueryOptions::default();
            let all = asked.iter().flat_map(|q| {
                let foot = indexed.closest(*q, None, &options, &mut workspace, None);
                let hint = Some([foot.u, foot.v]);
                let hinted = indexed.closest(*q, hint, &options, &mut workspace, None);
                [bits(&foot), bits(&hinted)]
            });
            all.collect()
        };
        let portable = answers(Level::PORTABLE);
        for level in Level::available() {
            assert_eq!(answers(level), portable, "{level:?}, family {family}, seed {seed}");
        }
    }
}
