//! Fits of curves: exact where the data are splines, as near as promised where they are not.

use footpoint::fit::{
    Adaptive, Condition, Ends, Spacing, Spline, adaptive, averaged_knots, interpolate,
    interpolate_periodic, interpolate_with, least_squares, least_squares_periodic, of_function,
    parameters, spread_knots,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn gap<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(&b).fold(0.0, |most, (x, y)| most.max((x - y).abs()))
}

fn helix(t: f64) -> [f64; 3] {
    [(3.0 * t).cos(), (3.0 * t).sin(), t]
}

fn even(count: usize) -> Vec<f64> {
    (0..count).map(|i| i as f64 / (count - 1) as f64).collect()
}

prop_compose! {
    /// A spline of any degree to 9 with knots of any multiplicity, not near zero, in four dimensions.
    fn splines()(degree in 1usize..=9)(
        degree in Just(degree),
        steps in prop::collection::vec((0.2..1.0f64, 1..=degree), 0..6),
        poles in prop::collection::vec(prop::array::uniform4(-1.0..1.0f64), 60),
        shift in prop_oneof![Just(0.0), Just(1e3)],
    ) -> Spline<4> {
        let mut knots = vec![2.0; degree + 1];
        let mut u = 2.0;
        for (step, times) in steps {
            u += step;
            knots.extend(std::iter::repeat_n(u, times));
        }
        knots.extend(std::iter::repeat_n(u + 0.5, degree + 1));
        let count = knots.len() - degree - 1;
        let poles = poles.iter().cycle().take(count).map(|p| p.map(|x| x + shift)).collect();
        Spline::new(degree, &knots, poles).unwrap()
    }
}

/// Enough samples of every span.
fn samples(spline: &Spline<4>) -> (Vec<f64>, Vec<[f64; 4]>) {
    let (knots, per_span) = (spline.knots(), 2 * spline.knots().degree() + 3);
    let mut list = Vec::new();
    for span in knots.spans() {
        let [a, b] = [knots.values()[span], knots.values()[span + 1]];
        list.extend((0..per_span).map(|i| a + (b - a) * i as f64 / per_span as f64));
    }
    list.push(knots.domain().1);
    let points = list.iter().map(|&t| spline.evaluate(t)).collect();
    (list, points)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, rng_seed: RngSeed::Fixed(0x666f_6f74), ..ProptestConfig::with_cases(200) })]

    #[test]
    fn samples_of_a_spline_give_it_back(spline in splines(), fixed in any::<bool>()) {
        let (list, points) = samples(&spline);
        let ends = if fixed { Ends::Interpolated } else { Ends::Free };
        let degree = spline.knots().degree();
        let fit = least_squares(degree, spline.knots().values(), &list, &points, ends).unwrap();
        let size = points.iter().flatten().fold(1.0, |m: f64, x| m.max(x.abs()));
        prop_assert!(fit.worst <= 1e-13 * size, "{}", fit.worst);
        for (a, b) in fit.spline.poles().iter().zip(spline.poles()) {
            prop_assert!(gap(*a, *b) < 1e-10 * size);
        }
    }

    #[test]
    fn the_residual_of_least_squares_is_orthogonal_to_every_basis_function(
        spline in splines(),
        noise in prop::collection::vec(prop::array::uniform4(-1.0..1.0f64), 40),
    ) {
        let (list, mut points) = samples(&spline);
        for (point, noise) in points.iter_mut().zip(noise.iter().cycle()) {
            (0..4).for_each(|x| point[x] += noise[x]);
        }
        let (knots, degree) = (spline.knots(), spline.knots().degree());
        let fit = least_squares(degree, knots.values(), &list, &points, Ends::Free).unwrap();
        let mut products = vec![[0.0; 4]; knots.pole_count()];
        let mut row = [0.0; 32];
        for (&t, point) in list.iter().zip(&points) {
            let (span, at) = (knots.span(t), fit.spline.evaluate(t));
            footpoint::basis::values(knots, span, t, &mut row);
            for j in 0..=degree {
                (0..4).for_each(|x| products[span - degree + j][x] += row[j] * (at[x] - point[x]));
            }
        }
        let size = points.iter().flatten().fold(1.0, |m: f64, x| m.max(x.abs()));
        for product in products {
            prop_assert!(gap(product, [0.0; 4]) < 1e-11 * size * list.len() as f64);
        }
    }

    #[test]
    fn interpolants_pass_through_their_points(
        degree in 1usize..=7,
        steps in prop::collection::vec(0.1..1.0f64, 8..60),
        heights in prop::collection::vec(prop::array::uniform2(-1.0..1.0f64), 60),
    ) {
        let mut t = -1.0;
        let list: Vec<f64> = steps.iter().map(|step| { t += step; t }).collect();
        let points = &heights[..list.len()];
        let fit = interpolate(degree, &list, points).unwrap();
        prop_assert!(fit.worst < 1e-9);
        prop_assert_eq!(fit.spline.evaluate(list[0]), points[0]);
        prop_assert_eq!(fit.spline.poles().len(), points.len());
    }
}

#[test]
fn an_adaptive_fit_meets_its_tolerance_with_few_poles() {
    let list = even(2000);
    let points: Vec<[f64; 3]> = list.iter().map(|&t| helix(t)).collect();
    let mut before = 0;
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let fit = adaptive(&list, &points, &Adaptive { tolerance, ..Adaptive::default() }).unwrap();
        assert!(fit.worst <= tolerance, "{tolerance}: {}", fit.worst);
        let count = fit.spline.poles().len();
        assert!(before < count && count < 200, "{count}");
        before = count;
    }
}

#[test]
fn a_break_is_used_where_it_is_given() {
    let list = even(401);
    let corner = |t: f64| [t, (t - 0.5).abs()];
    let points: Vec<[f64; 2]> = list.iter().map(|&t| corner(t)).collect();
    let options = Adaptive { tolerance: 1e-12, breaks: &[(0.5, 3)], ..Adaptive::default() };
    let fit = adaptive(&list, &points, &options).unwrap();
    assert!(fit.worst < 1e-12);
    assert_eq!(fit.spline.poles().len(), 7);
    assert_eq!(fit.spline.curve().unwrap().evaluate(0.25)[2], 0.0);
}

#[test]
fn a_tolerance_that_the_points_do_not_allow_is_told() {
    // Two points at one parameter: no function passes through both.
    let (mut list, mut points) = (even(50), vec![[0.0]; 50]);
    list[20] = list[21];
    points[20] = [1.0];
    let fit = adaptive(&list, &points, &Adaptive::default()).unwrap();
    assert!(fit.worst >= 0.5 - 1e-12);
    let points: Vec<[f64; 3]> = even(100).into_iter().map(helix).collect();
    let options = Adaptive { tolerance: 1e-14, max_poles: 12, ..Adaptive::default() };
    let fit = adaptive(&even(100), &points, &options).unwrap();
    assert!(fit.worst > 1e-14 && fit.spline.poles().len() <= 12);
}

#[test]
fn a_function_is_met_also_between_the_samples() {
    for degree in [2, 3, 5] {
        let options = Adaptive { degree, tolerance: 1e-8, ..Adaptive::default() };
        let fit = of_function(|t| Some(helix(t)), [-1.0, 2.0], &options).unwrap();
        assert!(fit.worst <= 1e-8);
        let missed = (0..=5000).map(|i| -1.0 + 3.0 * i as f64 / 5000.0);
        let worst = missed.map(|t| gap(fit.spline.evaluate(t), helix(t))).fold(0.0, f64::max);
        assert!(worst < 2e-8, "degree {degree}: {worst}");
    }
    let refused = of_function(|t| (t < 0.5).then_some([t]), [0.0, 1.0], &Adaptive::default());
    assert!(refused.unwrap_err().to_string().contains("function: no finite point at parameter"));
}

#[test]
fn parameters_follow_the_distances() {
    let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 4.0]];
    assert_eq!(parameters(Spacing::Uniform, &points).unwrap(), [0.0, 0.5, 1.0]);
    assert_eq!(parameters(Spacing::Chordal, &points).unwrap(), [0.0, 0.2, 1.0]);
    let third = parameters(Spacing::Centripetal, &points).unwrap()[1];
    assert!((third - 1.0 / 3.0).abs() < 1e-15);
    assert!(parameters(Spacing::Chordal, &[[1.0]; 4]).is_err());
}

#[test]
fn knots_for_parameters_are_as_in_the_book() {
    // The NURBS Book, example 9.1: chordal parameters 0, 5/17, 9/17, 14/17, 1; cubic.
    let list = [0.0, 5.0 / 17.0, 9.0 / 17.0, 14.0 / 17.0, 1.0];
    let knots = averaged_knots(3, &list);
    assert_eq!(knots.len(), 9);
    assert!((knots[4] - 28.0 / 51.0).abs() < 1e-15);
    let knots = spread_knots(3, 8, &even(101));
    assert_eq!(knots.len(), 12);
    assert!(knots.windows(2).all(|w| w[0] <= w[1]));
}

#[test]
fn defects_are_named() {
    let points = [[0.0], [1.0], [2.0], [3.0]];
    let list = [0.0, 0.3, 0.6, 1.0];
    let bezier = [0., 0., 0., 0., 1., 1., 1., 1.];
    let text = |degree, knots: &[f64], list: &[f64], points: &[[f64; 1]]| {
        least_squares(degree, knots, list, points, Ends::Interpolated).unwrap_err().to_string()
    };
    assert!(text(3, &bezier, &list[..3], &points).contains("parameters: 3 given, 4 expected"));
    assert!(text(3, &bezier, &[0.0, 0.6, 0.3, 1.0], &points).contains("parameters: parameter 2"));
    assert!(
        text(3, &bezier, &[0.0, 0.3, f64::NAN, 1.0], &points).contains("parameter 2 is not finite")
    );
    assert!(
        text(3, &bezier, &list, &[[0.0], [f64::INFINITY], [0.0], [0.0]])
            .contains("points: point 1")
    );
    assert!(text(3, &bezier, &[0.0, 0.3, 0.6, 1.5], &points).contains("parameter 3 is outside"));
    assert!(text(3, &bezier, &[0.1, 0.3, 0.6, 1.0], &points).contains("parameter 0 is 0.1"));
    assert!(
        text(3, &bezier, &[0.0, 0.0, 1.0, 1.0], &points).contains("too few of them for pole 1")
    );
    assert!(text(3, &[0., 0., 1.], &list, &points).contains("pole_count"));
    assert!(text(usize::MAX, &bezier, &list, &points).contains("degree"));
    let open = [-2., -1., 0., 0., 1., 1., 1., 2.];
    assert!(text(3, &open, &list, &points).contains("on clamped knots only"));
    assert!(
        interpolate(3, &[0.0, 0.5, 0.5, 1.0], &points)
            .unwrap_err()
            .to_string()
            .contains("parameter 2 equals")
    );
    assert!(interpolate(0, &list, &points).is_err() && interpolate(4, &list, &points).is_err());
    let options = Adaptive { breaks: &[(0.5, 4)], ..Adaptive::default() };
    assert!(
        adaptive(&list, &points, &options)
            .unwrap_err()
            .to_string()
            .contains("multiplicity of break 0")
    );
    let options = Adaptive { tolerance: 0.0, ..Adaptive::default() };
    assert!(adaptive(&list, &points, &options).unwrap_err().to_string().contains("tolerance"));
}

#[test]
fn tangents_at_the_ends_are_met() {
    let list = [0.0, 0.2, 0.5, 0.6, 0.9, 1.0, 1.4];
    let points: Vec<[f64; 3]> = list.iter().map(|&t| helix(t)).collect();
    let wanted = [[1.0, -2.0, 3.0], [0.0, 5.0, 0.5]];
    for degree in 2..=6 {
        for given in [[true, true], [true, false], [false, true], [false, false]] {
            let tangents = [0, 1].map(|k| given[k].then_some(wanted[k]));
            let fit =
                interpolate_with(degree, &list, &points, &Condition::Tangents(tangents)).unwrap();
            let mut at = [[0.0; 3]; 2];
            for (k, t) in [0.0, 1.4].into_iter().enumerate() {
                fit.spline.derivatives(t, 1, &mut at);
                assert!(!given[k] || gap(at[1], wanted[k]) < 1e-11, "{degree}: {at:?}");
            }
            assert!(fit.worst < 1e-13);
        }
    }
    // A cubic is its own interpolant with its own tangents.
    let cubic = |t: f64| [t * t * t - t, 2.0 * t * t + 1.0];
    let slope = |t: f64| [3.0 * t * t - 1.0, 4.0 * t];
    let points: Vec<[f64; 2]> = list.iter().map(|&t| cubic(t)).collect();
    let condition = Condition::Tangents([Some(slope(0.0)), Some(slope(1.4))]);
    let fit = interpolate_with(3, &list, &points, &condition).unwrap();
    assert!(
        (0..=14).all(|i| gap(fit.spline.evaluate(0.1 * i as f64), cubic(0.1 * i as f64)) < 1e-14)
    );
}

#[test]
fn natural_splines_end_without_bending() {
    let list = [0.0, 0.2, 0.5, 0.6, 0.9, 1.0, 1.4];
    let points: Vec<[f64; 3]> = list.iter().map(|&t| helix(t)).collect();
    for degree in [1, 3, 5] {
        let fit = interpolate_with(degree, &list, &points, &Condition::Natural).unwrap();
        assert!(fit.worst < 1e-12);
        let mut at = [[0.0; 3]; 6];
        for t in [0.0, 1.4] {
            fit.spline.derivatives(t, degree, &mut at);
            for order in degree.div_ceil(2).max(1)..degree {
                assert!(gap(at[order], [0.0; 3]) < 1e-8, "{degree} {order}: {:?}", at[order]);
            }
        }
    }
    // Second derivatives of the natural cubic by the classical equations of three moments.
    let (y, h) = ([0.0, 1.0, 0.0], [1.0, 2.0]);
    let slopes = [(y[1] - y[0]) / h[0], (y[2] - y[1]) / h[1]];
    let moment = 6.0 * (slopes[1] - slopes[0]) / (2.0 * (h[0] + h[1]));
    let fit = interpolate_with(3, &[0.0, 1.0, 3.0], &y.map(|y| [y]), &Condition::Natural).unwrap();
    let mut at = [[0.0]; 3];
    fit.spline.derivatives(1.0, 2, &mut at);
    assert!((at[2][0] - moment).abs() < 1e-13);
    assert!(interpolate_with(4, &list, &points, &Condition::Natural).is_err());
}

#[test]
fn periodic_splines_close_with_all_their_derivatives() {
    let turn = 2.0 * std::f64::consts::PI;
    let round = |t: f64| [t.cos() + 0.2 * (3.0 * t).sin(), t.sin()];
    for degree in 1..=7 {
        let count = 40;
        let place = |i: usize| turn * (i as f64 + 0.3 * (i as f64).sin()) / count as f64;
        let list: Vec<f64> = (0..count).map(place).chain([place(0) + turn]).collect();
        let points: Vec<[f64; 2]> = list[..count].iter().map(|&t| round(t)).collect();
        let fit = interpolate_periodic(degree, &list, &points).unwrap();
        assert!(fit.worst < 1e-12, "{degree}: {}", fit.worst);
        let (start, end) = fit.spline.knots().domain();
        assert!((end - start - turn).abs() < 1e-14);
        let (mut low, mut high) = ([[0.0; 2]; 8], [[0.0; 2]; 8]);
        fit.spline.derivatives(start, degree, &mut low);
        fit.spline.derivatives(end, degree, &mut high);
        for order in 0..degree {
            let size = 1e-12 * 10f64.powi(order as i32);
            assert!(gap(low[order], high[order]) < size, "{degree} {order}: {low:?} {high:?}");
        }
        assert!(fit.spline.curve().unwrap().is_closed());
        // As many samples as wished, fewer knots.
        let many: Vec<f64> = (0..500).map(|i| turn * i as f64 / 500.0).collect();
        let points: Vec<[f64; 2]> = many.iter().map(|&t| round(t)).collect();
        let breaks: Vec<f64> = (0..=30).map(|i| turn * i as f64 / 30.0).collect();
        let near = least_squares_periodic(degree, &breaks, &many, &points).unwrap();
        assert!(
            near.worst < [0.1, 0.02, 3e-3, 1e-3, 3e-4, 1e-4, 1e-4][degree - 1],
            "{degree}: {}",
            near.worst
        );
    }
    let points = [[0.0], [1.0], [0.5], [0.2]];
    assert!(interpolate_periodic(3, &[0.0, 1.0, 2.0, 3.0], &points).is_err());
    assert!(least_squares_periodic(3, &[0.0, 1.0, 2.0], &[0.0; 4], &points).is_err());
    assert!(least_squares_periodic(1, &[0.0, 1.0, 2.0, 3.0], &[0.0; 4], &points).is_err());
}
