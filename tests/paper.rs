//! The worked examples of Hu, Sun, Jin, Wang, *An algorithm for NURBS curve and surface point inversion*: the table of
//! the surface, a curve with the behaviour of the lost one, and the trace of every method.

use footpoint::closest::{QueryOptions, Scope, Workspace, flag};
use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::refine::Method;
use footpoint::surface::Surface;

/// Poles of example 2 as printed, u index fastest.
const PRINTED: [[f64; 3]; 28] = [
    [100., 100., 0.],
    [130., 180., 30.],
    [120., 270., 30.],
    [90., 360., 0.],
    [180., 120., 30.],
    [160., 200., 60.],
    [190., 320., 60.],
    [150., 440., 30.],
    [250., 140., 30.],
    [230., 200., 60.],
    [260., 330., 60.],
    [240., 400., 30.],
    [330., 100., 0.],
    [350., 220., 30.],
    [340., 290., 30.],
    [330., 400., 0.],
    [410., 120., 30.],
    [380., 200., 60.],
    [400., 320., 60.],
    [390., 440., 30.],
    [460., 140., 30.],
    [440., 200., 60.],
    [460., 330., 60.],
    [480., 400., 30.],
    [540., 100., 0.],
    [570., 220., 30.],
    [550., 290., 30.],
    [575., 400., 0.],
];

/// Weights of example 2 as printed, u index fastest; the printed point belongs to weights of 1.
const PRINTED_WEIGHTS: [f64; 28] = [
    1., 1., 1., 1., 1.2, 1., 1., 0.8, 1., 1., 1., 1., 1., 0.81, 1., 0.65, 1., 1., 1., 1., 1., 1.6,
    0.89, 1., 1., 1., 1., 1.,
];

const POINT: [f64; 3] = [277.34742334732, 248.13730252438, 28.748699053051];

/// Step, u, v and residual of the published iteration from (0.125, 0.375).
const TABLE: [[f64; 3]; 5] = [
    [0.125, 0.375, 3.123e+01],
    [0.121216582541351, 0.457097140092452, 8.063e-01],
    [0.122985471864912, 0.455999937866988, 5.804e-03],
    [0.122999999150634, 0.455999999961166, 3.407e-07],
    [0.122999999999993, 0.455999999999993, 5.4e-13],
];

fn example_2(weights: bool) -> IndexedSurface {
    let place = |k: usize| 7 * (k % 4) + k / 4;
    let poles: Vec<[f64; 3]> = (0..28).map(|k| PRINTED[place(k)]).collect();
    let values: Vec<f64> = (0..28).map(|k| PRINTED_WEIGHTS[place(k)]).collect();
    let knots_u = [0., 0., 0., 0., 0.25, 0.5, 0.75, 1., 1., 1., 1.];
    let knots_v = [0., 0., 0., 0., 1., 1., 1., 1.];
    let weights = weights.then_some(&values[..]);
    IndexedSurface::new(Surface::new(&knots_u, &knots_v, 3, 3, &poles, 7, 4, weights).unwrap())
}

fn options(method: Method, scope: Scope) -> QueryOptions {
    QueryOptions { method, scope, ..QueryOptions::default() }
}

/// The steps of a local inversion on the surface.
fn trace(
    surface: &IndexedSurface,
    query: [f64; 3],
    hint: Option<[f64; 2]>,
    method: Method,
) -> Vec<[f64; 3]> {
    let mut rows = Vec::new();
    let mut record = |step: u32, u: f64, v: f64, residual: f64| {
        assert_eq!(step as usize, rows.len());
        rows.push([u, v, residual]);
    };
    let options = options(method, Scope::Local);
    let mut workspace = Workspace::default();
    let foot = surface.invert(query, hint, &options, &mut workspace, Some(&mut record));
    let last = rows[rows.len() - 1];
    assert_eq!([foot.u, foot.v], [last[0], last[1]]);
    assert_eq!((foot.lower_bound, foot.flags & flag::NOT_PROVEN), (0.0, flag::NOT_PROVEN));
    rows
}

#[test]
fn maf_reproduces_the_table_of_example_2() {
    let rows = trace(&example_2(false), POINT, Some([0.125, 0.375]), Method::Maf);
    assert!(rows.len() <= 6, "{rows:?}");
    for (row, expected) in rows.iter().zip(&TABLE) {
        assert!((row[0] - expected[0]).abs() < 1e-12, "{row:?} {expected:?}");
        assert!((row[1] - expected[1]).abs() < 1e-12, "{row:?} {expected:?}");
        // Printed with two to four digits; the last one is the rounding of the printed point.
        let digits = if expected[2] < 1e-12 { 1.0 } else { 2e-4 };
        assert!((row[2] / expected[2] - 1.0).abs() < digits, "{row:?} {expected:?}");
    }
}

#[test]
fn a_global_inversion_finds_example_2_without_a_start_with_every_method() {
    let surface = example_2(false);
    for method in [Method::Auto, Method::Maf, Method::Newton, Method::Osculating] {
        let options = options(method, Scope::Global);
        let foot = surface.invert(POINT, None, &options, &mut Workspace::default(), None);
        assert!((foot.u - 0.123).abs() < 1e-12 && (foot.v - 0.456).abs() < 1e-12, "{foot:?}");
        assert_eq!(foot.flags & (flag::NOT_PROVEN | flag::NOT_ON_SHAPE | flag::HINT_USED), 0);
        assert!(foot.distance < 1e-11);
    }
}

#[test]
fn the_published_start_is_a_corner_of_the_sub_piece_that_holds_the_point() {
    let rows = trace(&example_2(false), POINT, None, Method::Maf);
    let [u, v, _] = rows[0];
    assert!([0.09375, 0.125].contains(&u) && [0.375, 0.5].contains(&v), "{u} {v}");
    let [u, v, residual] = rows[rows.len() - 1];
    assert!((u - 0.123).abs() < 1e-12 && (v - 0.456).abs() < 1e-12 && residual < 1e-11);
}

#[test]
fn with_the_printed_weights_a_point_of_the_surface_is_inverted_from_the_same_start() {
    let surface = example_2(true);
    let query = surface.surface().evaluate(0.123, 0.456);
    let apart = |k: usize| (query[k] - POINT[k]).abs();
    assert!((0..3).any(|k| apart(k) > 0.1), "the printed point is not on the rational surface");
    for method in [Method::Auto, Method::Maf, Method::Newton, Method::Osculating] {
        let rows = trace(&surface, query, Some([0.125, 0.375]), method);
        let [u, v, residual] = rows[rows.len() - 1];
        assert!(rows.len() <= 8, "{method:?}: {rows:?}");
        assert!((u - 0.123).abs() < 1e-12 && (v - 0.456).abs() < 1e-12, "{method:?}: {u} {v}");
        assert!(residual < 1e-11, "{method:?}: {residual:e}");
    }
}

/// Off the surface, 20 along the normal: the second-order methods keep their speed, MAF becomes linear.
#[test]
fn off_the_surface_newton_and_osculating_need_fewer_steps_than_maf() {
    let surface = example_2(false);
    let mut out = [[0.0; 3]; 3];
    surface.surface().partials(0.123, 0.456, 1, &mut out);
    let [s, a, b] = out;
    let n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    let query = [0, 1, 2].map(|k| s[k] + 20.0 * n[k] / length);
    let steps = [Method::Maf, Method::Auto, Method::Newton, Method::Osculating].map(|method| {
        let rows = trace(&surface, query, Some([0.125, 0.375]), method);
        let [u, v, distance] = rows[rows.len() - 1];
        assert!((u - 0.123).abs() < 1e-7 && (v - 0.456).abs() < 1e-7, "{method:?}: {u} {v}");
        assert!((distance - 20.0).abs() < 1e-10, "{method:?}: {distance}");
        let falls = rows.windows(2).all(|w| w[1][2] <= w[0][2] * (1.0 + 1e-12));
        assert!(falls, "{method:?}: the distance rises: {rows:?}");
        rows.len()
    });
    assert!(steps[1..].iter().all(|count| *count <= 8 && *count < steps[0]), "{steps:?}");
}

/// Example 1 has lost its data; this cubic behaves as it did: from 0.125 to 0.1234567 in three steps.
#[test]
fn on_a_cubic_maf_goes_from_0_125_to_0_1234567_in_three_steps() {
    let poles = [[0., 0., 0.], [10., 30., 5.], [25., -10., 20.], [40., 15., 0.], [60., 5., 10.]];
    let knots = [0., 0., 0., 0., 0.5, 1., 1., 1., 1.];
    let curve = IndexedCurve::new(Curve::new(&knots, 3, &poles, None).unwrap());
    let query = curve.curve().evaluate(0.1234567);
    let mut rows = Vec::new();
    let mut record = |_: u32, u: f64, v: f64, residual: f64| rows.push([u, v, residual]);
    let options = options(Method::Maf, Scope::Local);
    let foot =
        curve.invert(query, Some(0.125), &options, &mut Workspace::default(), Some(&mut record));
    assert_eq!(rows[0][..2], [0.125, 0.0]);
    assert!((rows[3][0] - 0.1234567).abs() < 1e-14, "{rows:?}");
    assert!((foot.u - 0.1234567).abs() < 1e-15 && rows.len() <= 5, "{foot:?} {rows:?}");
    for pair in rows[..3].windows(2) {
        let [before, after] = [pair[0][2], pair[1][2]];
        assert!(after <= before * before, "not quadratic: {rows:?}");
    }
}

#[test]
fn on_a_cubic_every_method_inverts_globally_without_a_start() {
    let poles = [[0., 0., 0.], [10., 30., 5.], [25., -10., 20.], [40., 15., 0.], [60., 5., 10.]];
    let knots = [0., 0., 0., 0., 0.5, 1., 1., 1., 1.];
    let curve = IndexedCurve::new(Curve::new(&knots, 3, &poles, None).unwrap());
    for u in [0.0, 0.1234567, 0.5, 0.777, 0.999, 1.0] {
        let query = curve.curve().evaluate(u);
        for method in [Method::Auto, Method::Maf, Method::Newton, Method::Osculating] {
            let options = options(method, Scope::Global);
            let foot = curve.invert(query, None, &options, &mut Workspace::default(), None);
            assert!((foot.u - u).abs() < 1e-13, "{method:?} {u}: {foot:?}");
            assert_eq!(foot.flags & (flag::NOT_PROVEN | flag::NOT_ON_SHAPE), 0);
        }
    }
}
