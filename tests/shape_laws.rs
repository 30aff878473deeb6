//! Laws of the shapes: what holds for every curve and surface, and closed forms that are known.
//!
//! The reference for positions is the Cox-de Boor recursion in doubled precision, written here on its
//! own, so that a bound of a few eps can be tested honestly.

#[path = "../benches/stress/double.rs"]
mod double;
mod strategies;

use double::Double;
use footpoint::basis;
use footpoint::curve::Curve;
use footpoint::knots::{Knots, MAX_DEGREE};
use footpoint::surface::Surface;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use strategies::{curves, degrees, knots, parameter, surfaces};

const EPS: f64 = f64::EPSILON;

/// All basis functions on the span of `u`, in doubled precision.
fn exact_basis(knots: &Knots, u: f64) -> Vec<Double> {
    let (i, values) = (knots.span(u), knots.values());
    let step = |a: f64, b: f64| Double::sum(a, -b);
    let mut row = vec![Double::of(1.0)];
    for q in 1..=knots.degree() {
        let mut next = vec![Double::of(0.0); q + 1];
        for (r, n) in row.iter().enumerate() {
            let (start, end) = (values[i + 1 + r - q], values[i + 1 + r]);
            let length = step(end, start);
            next[r] = next[r].plus(n.times(step(end, u)).over(length));
            next[r + 1] = next[r + 1].plus(n.times(step(u, start)).over(length));
        }
        row = next;
    }
    row
}

/// Distance of `point` from the exact mean of weighted poles.
fn error_against(net: &[(Double, [f64; 3])], point: [f64; 3]) -> f64 {
    let weight = net.iter().fold(Double::of(0.0), |sum, (w, _)| sum.plus(*w));
    let mut square = 0.0;
    for axis in 0..3 {
        let sum = net.iter().fold(Double::of(0.0), |sum, (w, pole)| {
            sum.plus(w.times(Double::sum(pole[axis], -point[axis])))
        });
        square += sum.over(weight).0.powi(2);
    }
    square.sqrt()
}

fn curve_net(curve: &Curve, u: f64) -> Vec<(Double, [f64; 3])> {
    let first = curve.knots().span(u) - curve.degree();
    let weight = |i: usize| curve.weights().map_or(1.0, |weights| weights[i]);
    let basis = exact_basis(curve.knots(), u).into_iter().enumerate();
    basis.map(|(j, n)| (n.times(Double::of(weight(first + j))), curve.poles()[first + j])).collect()
}

fn surface_net(surface: &Surface, u: f64, v: f64) -> Vec<(Double, [f64; 3])> {
    let (ku, kv) = (surface.knots_u(), surface.knots_v());
    let (first_u, first_v) = (ku.span(u) - ku.degree(), kv.span(v) - kv.degree());
    let basis_v = exact_basis(kv, v);
    let mut net = Vec::new();
    for (i, n) in exact_basis(ku, u).into_iter().enumerate() {
        for (j, m) in basis_v.iter().enumerate() {
            let place = (first_u + i) * kv.pole_count() + first_v + j;
            let weight = surface.weights().map_or(1.0, |weights| weights[place]);
            net.push((n.times(*m).times(Double::of(weight)), surface.poles()[place]));
        }
    }
    net
}

/// Size of the local net, and the largest coordinate in it.
fn size(net: &[(Double, [f64; 3])]) -> (f64, f64) {
    let (mut size, mut far) = (0.0_f64, 0.0_f64);
    for (_, a) in net {
        far = a.iter().fold(far, |far, x| far.max(x.abs()));
        size = net.iter().fold(size, |size, (_, b)| size.max(gap(*a, *b)));
    }
    (size, far)
}

fn gap(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|x| (a[x] - b[x]).powi(2)).sum::<f64>().sqrt()
}

fn config() -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(0x666f_6f74),
        ..ProptestConfig::with_cases(300)
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn basis_functions_are_a_partition_of_unity_and_their_derivatives_sum_to_zero(
        knots in knots(degrees()), share in 0.0..1.0f64,
    ) {
        let (u, width) = (parameter(&knots, share), knots.degree() + 1);
        let mut rows = vec![0.0; 3 * width];
        basis::derivatives(&knots, knots.span(u), u, 2, &mut rows);
        let mut values = vec![0.0; width];
        basis::values(&knots, knots.span(u), u, &mut values);
        prop_assert_eq!(&values, &rows[..width]);
        prop_assert!(values.iter().all(|n| *n >= 0.0));
        prop_assert!((values.iter().sum::<f64>() - 1.0).abs() <= 4.0 * width as f64 * EPS);
        for row in rows[width..].chunks(width) {
            let scale: f64 = row.iter().map(|d| d.abs()).sum();
            prop_assert!(row.iter().sum::<f64>().abs() <= 4.0 * width as f64 * EPS * scale);
        }
    }

    #[test]
    fn a_point_of_a_curve_is_exact_to_a_few_eps_of_the_local_net(
        curve in curves(), share in 0.0..1.0f64,
    ) {
        let u = parameter(curve.knots(), share);
        let net = curve_net(&curve, u);
        let (size, far) = size(&net);
        let error = error_against(&net, curve.evaluate(u));
        prop_assert!(error <= (curve.degree() as f64 + 2.0) * EPS * size + EPS * far, "{error:e}");
    }

    #[test]
    fn a_point_of_a_surface_is_exact_to_a_few_eps_of_the_local_net(
        surface in surfaces(), shares in [0.0..1.0f64, 0.0..1.0f64],
    ) {
        let u = parameter(surface.knots_u(), shares[0]);
        let v = parameter(surface.knots_v(), shares[1]);
        let net = surface_net(&surface, u, v);
        let (size, far) = size(&net);
        let degrees = (surface.knots_u().degree() + surface.knots_v().degree()) as f64;
        let error = error_against(&net, surface.evaluate(u, v));
        prop_assert!(error <= (degrees + 2.0) * EPS * size + EPS * far, "{error:e}");
    }

    #[test]
    fn positions_have_the_same_bits_whatever_is_asked_with_them(
        curve in curves(), surface in surfaces(), shares in [0.0..1.0f64, 0.0..1.0f64], count in 0..=31usize,
    ) {
        let u = parameter(curve.knots(), shares[0]);
        let mut out = vec![[f64::NAN; 3]; count + 1];
        curve.derivatives(u, count, &mut out);
        prop_assert_eq!(out[0].map(f64::to_bits), curve.evaluate(u).map(f64::to_bits));
        let u = parameter(surface.knots_u(), shares[0]);
        let v = parameter(surface.knots_v(), shares[1]);
        let mut out = vec![[f64::NAN; 3]; (count + 1) * (count + 2) / 2];
        surface.partials(u, v, count, &mut out);
        prop_assert_eq!(out[0].map(f64::to_bits), surface.evaluate(u, v).map(f64::to_bits));
    }

    #[test]
    fn inserting_and_splitting_leave_a_curve_where_it_is(
        curve in curves(), at in 0.0..1.0f64, shares in prop::array::uniform4(0.0..1.0f64),
    ) {
        let (at, degree) = (parameter(curve.knots(), at), curve.degree());
        let limit = 2.0 * (degree + 2) as f64 * EPS * 40.0;
        let times = degree.saturating_sub(curve.knots().multiplicity(at));
        let finer = curve.insert_knot(at, times).unwrap();
        let (start, end) = curve.domain();
        let parts = (start < at && at < end).then(|| curve.split(at).unwrap());
        for u in shares.map(|share| parameter(curve.knots(), share)) {
            let truth = curve.evaluate(u);
            prop_assert!(gap(truth, finer.evaluate(u)) <= limit);
            if let Some((left, right)) = &parts {
                let part = if u < at { left } else { right };
                prop_assert!(gap(truth, part.evaluate(u)) <= limit);
                prop_assert_eq!((left.domain(), right.domain()), ((start, at), (at, end)));
            }
        }
    }

    #[test]
    fn inserting_splitting_and_isocurves_agree_with_the_surface(
        surface in surfaces(), at in [0.0..1.0f64, 0.0..1.0f64], shares in [0.0..1.0f64, 0.0..1.0f64],
    ) {
        let (ku, kv) = (surface.knots_u(), surface.knots_v());
        let [u, v] = [parameter(ku, shares[0]), parameter(kv, shares[1])];
        let [at_u, at_v] = [parameter(ku, at[0]), parameter(kv, at[1])];
        let truth = surface.evaluate(u, v);
        let limit = 2.0 * (ku.degree() + kv.degree() + 2) as f64 * EPS * 40.0;
        let mut same = vec![surface.isocurve_u(u).evaluate(v), surface.isocurve_v(v).evaluate(u)];
        let times = |knots: &Knots, u| knots.degree().saturating_sub(knots.multiplicity(u));
        same.push(surface.insert_knot_u(at_u, times(ku, at_u)).unwrap().evaluate(u, v));
        same.push(surface.insert_knot_v(at_v, times(kv, at_v)).unwrap().evaluate(u, v));
        if let Ok((left, right)) = surface.split_u(at_u) {
            same.push(if u < at_u { left } else { right }.evaluate(u, v));
        }
        if let Ok((left, right)) = surface.split_v(at_v) {
            same.push(if v < at_v { left } else { right }.evaluate(u, v));
        }
        for point in same {
            prop_assert!(gap(truth, point) <= limit, "{:e}", gap(truth, point));
        }
    }

    #[test]
    fn derivatives_are_the_limit_of_difference_quotients(
        degree in 1..=6usize, weights in prop::collection::vec(0.2..5.0f64, 8), share in 0.1..0.9f64,
        poles in prop::collection::vec([-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64], 8),
    ) {
        let steps: Vec<f64> = (0..9 + degree).map(|i| i as f64).collect();
        let curve = Curve::new(&steps, degree, &poles, Some(&weights)).unwrap();
        let u = degree as f64 + (share * 0.9).mul_add(1.0, 0.0);
        let (count, h) = (5, 1e-4);
        let at = |u: f64| {
            let mut out = [[0.0; 3]; 8];
            curve.derivatives(u, count + 2, &mut out);
            out
        };
        let (here, left, right) = (at(u), at(u - h), at(u + h));
        for k in 1..=count {
            for x in 0..3 {
                let quotient = (right[k - 1][x] - left[k - 1][x]) / (2.0 * h);
                let scale = here.iter().take(k + 3).flatten().fold(1.0, |m: f64, d| m.max(d.abs()));
                prop_assert!((quotient - here[k][x]).abs() <= 1e-6 * scale, "order {}", k);
            }
        }
    }
}

/// `f(t) = 2 t / (1 + t)` as a rational line; its derivatives of every order are known.
fn hyperbola(t: f64, order: usize) -> f64 {
    let factorial: f64 = (1..=order).map(|i| i as f64).product();
    let sign = if order.is_multiple_of(2) { -2.0 } else { 2.0 };
    let constant = if order == 0 { 2.0 } else { 0.0 };
    constant + sign * factorial / (1.0 + t).powi(order as i32 + 1)
}

#[test]
fn rational_derivatives_to_order_31_are_those_of_a_hyperbola() {
    let poles = [[0.0; 3], [1.0, 1.0, 0.0]];
    let curve = Curve::new(&[0., 0., 1., 1.], 1, &poles, Some(&[1.0, 2.0])).unwrap();
    let mut out = [[0.0; 3]; 32];
    for t in [0.0, 0.3, 1.0] {
        curve.derivatives(t, 31, &mut out);
        for (k, value) in out.iter().enumerate() {
            let truth = hyperbola(t, k);
            assert!((value[0] - truth).abs() <= 1e-13 * truth.abs(), "order {k} at {t}: {value:?}");
        }
    }
}

#[test]
fn mixed_rational_partials_to_order_31_are_products_of_hyperbola_derivatives() {
    let poles = [[0.0; 3], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 1.0, 1.0]];
    let line = [0., 0., 1., 1.];
    let surface = Surface::new(&line, &line, 1, 1, &poles, 2, 2, Some(&[1., 2., 2., 4.])).unwrap();
    let (u, v) = (0.3, 0.8);
    let mut out = [[0.0; 3]; 32 * 33 / 2];
    surface.partials(u, v, 31, &mut out);
    for order in 0..=31 {
        for l in 0..=order {
            let truth = hyperbola(u, order - l) * hyperbola(v, l);
            let value = out[order * (order + 1) / 2 + l][0];
            assert!((value - truth).abs() <= 1e-12 * truth.abs(), "({}, {l})", order - l);
        }
    }
}

#[test]
fn partials_along_one_direction_are_the_derivatives_of_the_isocurve() {
    let (torus, (u, v)) = (torus(), (1.3, 2.6));
    let (mut out, mut along) = ([[0.0; 3]; 28], [[0.0; 3]; 7]);
    torus.partials(u, v, 6, &mut out);
    for (iso, at, in_v) in [(torus.isocurve_v(v), u, false), (torus.isocurve_u(u), v, true)] {
        iso.derivatives(at, 6, &mut along);
        for (k, derivative) in along.iter().enumerate() {
            let value = out[k * (k + 1) / 2 + if in_v { k } else { 0 }];
            let length = gap(*derivative, [0.0; 3]);
            assert!(
                gap(value, *derivative) <= 1e-13 * length,
                "order {k}: {value:?} {derivative:?}"
            );
        }
    }
}

#[test]
fn clamped_ends_are_poles_bit_for_bit() {
    for degree in 1..=MAX_DEGREE {
        let poles: Vec<[f64; 3]> =
            (0..degree + 3).map(|i| [0.1 * i as f64, 1e7 / 3.0, (i as f64).sin() + 2.0]).collect();
        let weights: Vec<f64> = (0..degree + 3).map(|i| 1.0 / (3 + i) as f64).collect();
        let mut knots = vec![0.1; degree + 1];
        knots.extend([0.3, 0.7]);
        knots.extend(vec![49.0 / 37.0; degree + 1]);
        for weights in [None, Some(&weights[..])] {
            let curve = Curve::new(&knots, degree, &poles, weights).unwrap();
            assert_eq!(curve.evaluate(0.1), poles[0]);
            assert_eq!(curve.evaluate(49.0 / 37.0), poles[degree + 2]);
        }
    }
}

const CIRCLE_KNOTS: [f64; 12] = [0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];
const CIRCLE: [[f64; 2]; 9] = [
    [1., 0.],
    [1., 1.],
    [0., 1.],
    [-1., 1.],
    [-1., 0.],
    [-1., -1.],
    [0., -1.],
    [1., -1.],
    [1., 0.],
];

fn circle_weight(i: usize) -> f64 {
    if i.is_multiple_of(2) { 1.0 } else { 0.5_f64.sqrt() }
}

fn circle(radius: f64, centre: [f64; 3]) -> Curve {
    let poles = CIRCLE.map(|[x, y]| [centre[0] + radius * x, centre[1] + radius * y, centre[2]]);
    let weights: [f64; 9] = std::array::from_fn(circle_weight);
    Curve::new(&CIRCLE_KNOTS, 2, &poles, Some(&weights)).unwrap()
}

/// A circle of points (x, z) turned around the z axis; u turns.
fn turned(profile: &Curve) -> Surface {
    let count = profile.poles().len();
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for (i, [x, y]) in CIRCLE.iter().enumerate() {
        for (j, pole) in profile.poles().iter().enumerate() {
            poles.push([pole[0] * x, pole[0] * y, pole[1]]);
            weights.push(circle_weight(i) * profile.weights().map_or(1.0, |weights| weights[j]));
        }
    }
    let (knots, degree) = (profile.knots().values(), profile.degree());
    Surface::new(&CIRCLE_KNOTS, knots, 2, degree, &poles, 9, count, Some(&weights)).unwrap()
}

fn torus() -> Surface {
    turned(&circle(1.0, [3.0, 0.0, 0.0]))
}

#[test]
fn a_circle_is_a_circle_to_4_eps() {
    let circle = circle(1.0, [0.0; 3]);
    for i in 0..=4000 {
        let u = i as f64 / 1000.0;
        let [x, y, _] = circle.evaluate(u);
        assert!(((x * x + y * y).sqrt() - 1.0).abs() <= 4.0 * EPS, "u = {u}");
        let mut out = [[0.0; 3]; 2];
        circle.derivatives(u, 1, &mut out);
        let [dx, dy, _] = out[1];
        assert!((x * dx + y * dy).abs() <= 16.0 * EPS, "u = {u}");
    }
    assert!(circle.is_closed());
    assert_eq!(circle.bounding_box(), ([-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]));
}

#[test]
fn far_from_the_origin_a_circle_keeps_all_but_a_few_units_of_its_coordinates() {
    let far = [1e7, -1e7, 1e7];
    let (here, there) = (circle(1.0, [0.0; 3]), circle(1.0, far));
    let ulp = 1e7 * EPS;
    for i in 0..=4000 {
        let u = i as f64 / 1000.0;
        let (a, b) = (here.evaluate(u), there.evaluate(u));
        for x in 0..3 {
            assert!((b[x] - (far[x] + a[x])).abs() <= 2.0 * ulp, "u = {u}");
        }
    }
    assert!(there.is_closed());
}

#[test]
fn a_periodic_curve_is_closed_and_smooth_across_its_seam() {
    let corners = [[1., 0., 0.], [0., 1., 0.], [-1., 0., 1.], [0., -1., 0.], [0.5, -2., 0.]];
    let poles: Vec<[f64; 3]> = (0..8).map(|i| corners[i % 5]).collect();
    let knots: Vec<f64> = (0..12).map(f64::from).collect();
    let curve = Curve::new(&knots, 3, &poles, None).unwrap();
    let (mut start, mut end) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
    curve.derivatives(3.0, 2, &mut start);
    curve.derivatives(8.0, 2, &mut end);
    assert_eq!(curve.domain(), (3.0, 8.0));
    assert!(curve.is_closed());
    assert!((0..3).all(|k| gap(start[k], end[k]) <= 8.0 * EPS));
    let open = curve.split(5.0).unwrap().0;
    assert!(!open.is_closed());
}

#[test]
fn clamping_an_unclamped_end_shows_its_end_point_as_a_pole() {
    let poles: Vec<[f64; 3]> = (0..7).map(|i| [i as f64, (i * i) as f64, 1.0]).collect();
    let knots: Vec<f64> = (0..11).map(|i| f64::from(i) * 0.7).collect();
    let curve = Curve::new(&knots, 3, &poles, None).unwrap();
    let (start, end) = curve.domain();
    let clamped = curve.insert_knot(start, 3).unwrap().insert_knot(end, 3).unwrap();
    assert_eq!((clamped.domain(), clamped.knots().multiplicity(end)), ((start, end), 4));
    let active = clamped.knots().active_poles();
    assert!(gap(clamped.poles()[active.start], curve.evaluate(start)) <= 40.0 * EPS);
    assert!(gap(clamped.poles()[active.end - 1], curve.evaluate(end)) <= 40.0 * EPS);
    assert!((0..=30).all(|i| {
        let u = start + (end - start) * f64::from(i) / 30.0;
        gap(curve.evaluate(u), clamped.evaluate(u)) <= 100.0 * EPS
    }));
}

#[test]
fn insertion_refuses_what_would_tear_the_shape() {
    let circle = circle(1.0, [0.0; 3]);
    let text = |u: f64, times: usize| circle.insert_knot(u, times).unwrap_err().to_string();
    assert_eq!(text(1.0, 1), "times: more than 2 equal knots at u = 1");
    assert_eq!(text(4.5, 1), "u: 4.5 is outside the domain");
    assert_eq!(text(0.5, usize::MAX), "times: more than 2 equal knots at u = 0.5");
    assert_eq!(circle.insert_knot(0.5, 0).unwrap(), circle);
    assert_eq!(circle.split(4.0).unwrap_err().to_string(), "u: 4 is not inside the domain");
    assert!(circle.split(f64::NAN).is_err() && circle.insert_knot(f64::NAN, 1).is_err());
}

#[test]
fn a_torus_is_closed_both_ways_and_a_part_of_it_one_way() {
    let torus = torus();
    assert_eq!((torus.is_closed_u(), torus.is_closed_v()), (true, true));
    let half = torus.split_u(1.5).unwrap().1;
    assert_eq!((half.is_closed_u(), half.is_closed_v()), (false, true));
    assert_eq!(torus.collapsed_edges(), [false; 4]);
    let piece = half.split_v(2.0).unwrap().0;
    assert_eq!((piece.is_closed_u(), piece.is_closed_v()), (false, false));
}

#[test]
fn a_sphere_has_a_seam_and_two_collapsed_edges() {
    let quarter = 0.5_f64.sqrt();
    let poles = [[0., -1., 0.], [1., -1., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    let weights = [1.0, quarter, 1.0, quarter, 1.0];
    let meridian =
        Curve::new(&[0., 0., 0., 1., 1., 2., 2., 2.], 2, &poles, Some(&weights)).unwrap();
    let sphere = turned(&meridian);
    assert_eq!(sphere.collapsed_edges(), [false, false, true, true]);
    assert_eq!(sphere.collapsed_spread(2), 0.0);
    assert_eq!((sphere.is_closed_u(), sphere.is_closed_v()), (true, false));
    let cut = sphere.split_v(0.5).unwrap().1;
    assert_eq!(cut.collapsed_edges(), [false, false, false, true]);
}

#[test]
fn an_unclamped_periodic_tube_is_closed_by_its_geometry() {
    let ring = [[1., 0.], [0.5, 0.9], [-0.5, 0.9], [-1., 0.], [-0.5, -0.9], [0.5, -0.9]];
    let mut poles = Vec::new();
    for i in 0..9 {
        let [x, y] = ring[i % 6];
        poles.extend((0..4).map(|j| [1e4 + x, y, j as f64]));
    }
    let knots: Vec<f64> = (0..13).map(f64::from).collect();
    let tube = Surface::new(&knots, &knots[..7], 3, 2, &poles, 9, 4, None).unwrap();
    assert_eq!((tube.is_closed_u(), tube.is_closed_v()), (true, false));
    assert_eq!(tube.collapsed_edges(), [false; 4]);
    let open = tube.split_u(5.25).unwrap().0;
    assert!(!open.is_closed_u());
}

#[test]
fn a_pole_that_does_not_reach_the_domain_does_not_count() {
    let knots = [-1., 0., 0., 0., 1., 1., 1., 2.];
    let poles = [[99.0; 3], [0.0; 3], [1.0, 1.0, 0.0], [0.0; 3], [-99.0; 3]];
    let curve = Curve::new(&knots, 2, &poles, None).unwrap();
    assert_eq!(curve.bounding_box(), ([0.0; 3], [1.0, 1.0, 0.0]));
    assert!(curve.is_closed());
    let (left, right) = curve.split(0.25).unwrap();
    assert_eq!(left.evaluate(0.25), right.evaluate(0.25));
}

#[test]
fn at_a_corner_the_right_piece_is_taken() {
    let poles = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    let curve = Curve::new(&[0., 0., 1., 2., 2.], 1, &poles, None).unwrap();
    let mut out = [[0.0; 3]; 2];
    for (u, slope) in [(0.0, [1., 0., 0.]), (1.0, [0., 1., 0.]), (2.0, [0., 1., 0.])] {
        curve.derivatives(u, 1, &mut out);
        assert_eq!(out[1], slope, "u = {u}");
    }
}

#[test]
fn extreme_weights_pull_the_curve_onto_their_pole() {
    let poles = [[0.0; 3], [1.0, 3.0, 0.0], [2.0, 0.0, 0.0]];
    let knots = [0., 0., 0., 1., 1., 1.];
    let heavy = Curve::new(&knots, 2, &poles, Some(&[1e-100, 1e100, 1e-100])).unwrap();
    assert_eq!(heavy.evaluate(0.5), poles[1]);
    assert_eq!((heavy.evaluate(0.0), heavy.evaluate(1.0)), (poles[0], poles[2]));
    let (left, right) = heavy.split(0.5).unwrap();
    assert_eq!((left.evaluate(0.5), right.evaluate(0.5)), (poles[1], poles[1]));
}
