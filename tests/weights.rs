//! The published formulas, the network, single weights, conics and forms against values worked out by hand.

mod polygons;

use footpoint::curve::Curve;
use footpoint::error::Error;
use footpoint::weights::conic::{conic, weight_of_rho, weights_of_eccentricity};
use footpoint::weights::edit::{move_point, through_point};
use footpoint::weights::form::standard;
use footpoint::weights::network::network;
use footpoint::weights::positive::positive;
use footpoint::weights::published::{general, interpolated};
use footpoint::weights::{Options, Report, State, Wish, flag};
use polygons::{Random, polygon};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

fn bezier(poles: &[[f64; 3]], weights: Option<&[f64]>) -> Curve {
    let degree = poles.len() - 1;
    let mut knots = vec![0.0; degree + 1];
    knots.extend(vec![1.0; degree + 1]);
    Curve::new(&knots, degree, poles, weights).unwrap()
}

/// Poles 4, 6 and 5 above a chord of length 12 on the x axis.
fn arch() -> Curve {
    let poles = [[0., 0., 0.], [3., 4., 0.], [6., 6., 0.], [9., 5., 0.], [12., 0., 0.]];
    bezier(&poles, None)
}

/// Two quadratic spans that meet at (3, 2) with u = 1.
fn two_spans() -> Curve {
    let poles = [[0., 0., 0.], [1., 2., 0.], [5., 2., 0.], [6., 0., 0.]];
    Curve::new(&[0., 0., 0., 1., 2., 2., 2.], 2, &poles, None).unwrap()
}

fn near(found: &[f64], expected: &[f64], limit: f64) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= limit, "{found:?} is not {expected:?}");
    }
}

fn refusal<T: std::fmt::Debug>(result: Result<T, Error>) -> String {
    result.unwrap_err().to_string()
}

#[test]
fn formula_3_gives_the_weights_of_a_table_made_by_hand() {
    let report = general(&arch(), &[0.9, 0.25, 0.5, 0.8, 0.1], &Options::default()).unwrap();
    // 1/0.25 - 1, 1/0.5 - 1, 1/0.8 - 1; both ends lie on the chord.
    near(&report.weights(), &[1.0, 3.0, 1.0, 0.25, 1.0], 1e-15);
    let wishes: Vec<f64> = report.poles[1..4].iter().map(|pole| pole.wish).collect();
    near(&wishes, &[1.0, 3.0, 4.0], 1e-15);
    let chords: Vec<f64> = report.poles.iter().map(|pole| pole.chord_distance).collect();
    near(&chords, &[0.0, 4.0, 6.0, 5.0, 0.0], 1e-15);
    for end in [0, 4] {
        assert_eq!(report.poles[end].flags & flag::ON_CHORD, flag::ON_CHORD);
        assert!(report.poles[end].wish.is_nan() && report.poles[end].state == State::None as u32);
        assert!(report.poles[end].distance < 1e-14);
    }
}

#[test]
fn distances_are_interpolated_evenly_as_in_a_table_made_by_hand() {
    let report = interpolated(&arch(), [1.0, 3.0], &Options::default()).unwrap();
    // Distances 1, 1.5, 2, 2.5, 3 in the order of the poles: 4/1.5 - 1, 6/2 - 1, 5/2.5 - 1.
    near(&report.weights(), &[1.0, 5.0 / 3.0, 2.0, 1.0, 1.0], 1e-15);
    let falling = interpolated(&arch(), [3.0, 1.0], &Options::default()).unwrap();
    // 3, 2.5, 2, 1.5, 1: 4/2.5 - 1, 2, 5/1.5 - 1.
    near(&falling.weights(), &[1.0, 0.6, 2.0, 7.0 / 3.0, 1.0], 1e-15);
    let level = interpolated(&arch(), [2.0, 2.0], &Options::default()).unwrap();
    near(&level.weights(), &[1.0, 1.0, 2.0, 1.5, 1.0], 1e-15);
}

#[test]
fn a_distance_beyond_the_chord_and_one_of_zero_take_the_ends_of_the_range() {
    let options = Options { weight_min: 0.2, weight_max: 30.0, ..Options::default() };
    let far = interpolated(&arch(), [5.0, 5.0], &options).unwrap();
    near(&far.weights(), &[1.0, 0.2, 0.2, 0.2, 1.0], 0.0);
    assert_eq!(far.poles[1].flags & flag::LIMITED, flag::LIMITED);
    assert_eq!(far.poles[1].state, State::NotMet as u32);
    let close = interpolated(&arch(), [0.0, 0.0], &options).unwrap();
    near(&close.weights(), &[1.0, 30.0, 30.0, 30.0, 1.0], 0.0);
}

#[test]
fn the_chord_of_a_pole_is_that_of_its_own_spans() {
    let report = general(&two_spans(), &[0.5; 4], &Options::default()).unwrap();
    // Pole 1 acts from (0,0) to (6,0): distance 2 from that chord. Pole 0 from (0,0) to (3,2): it lies on the chord.
    near(&[report.poles[1].chord_distance, report.poles[2].chord_distance], &[2.0, 2.0], 1e-15);
    near(&report.weights(), &[1.0; 4], 0.0);
    assert_eq!(report.poles[0].flags & flag::ON_CHORD, flag::ON_CHORD);
}

#[test]
fn a_closed_polygon_of_one_span_has_a_point_for_a_chord() {
    let curve = bezier(&[[0.; 3], [3., 4., 0.], [-3., 4., 0.], [0.; 3]], None);
    let report = general(&curve, &[0.5, 0.2, 0.5, 0.5], &Options::default()).unwrap();
    near(&[report.poles[1].chord_distance, report.poles[2].chord_distance], &[5.0, 5.0], 1e-15);
    near(&report.weights(), &[1.0, 4.0, 1.0, 1.0], 1e-14);
}

#[test]
fn reported_distances_are_those_of_the_curve_with_the_reported_weights() {
    let report = general(&arch(), &[0.3; 5], &Options::default()).unwrap();
    let curve = footpoint::index::IndexedCurve::new(report.curve().unwrap().clone());
    for (k, pole) in report.poles.iter().enumerate() {
        let measured = polygons::distance(&curve, curve.curve().poles()[k]);
        assert!((measured - pole.distance).abs() < 1e-12);
        assert!(pole.lower_bound <= pole.distance && pole.distance - pole.lower_bound < 1e-9);
    }
    assert!(report.surface().is_err());
}

fn bits(report: &Report) -> Vec<u64> {
    report.weights().iter().map(|w| w.to_bits()).collect()
}

#[test]
fn a_network_meets_its_wishes_and_keeps_the_others_in_the_range() {
    let wishes = [Wish { pole: 2, distance: 1.5 }];
    let report = network(&arch(), &wishes, [1.0, 2.0], &Options::default()).unwrap();
    // 6/1.5 - 1; 4/2 - 1 .. 4/1 - 1; 5/2 - 1 .. 5/1 - 1.
    near(&[report.weights()[2]], &[3.0], 1e-13);
    assert!((1.0..=3.0).contains(&report.weights()[1]), "{:?}", report.weights());
    assert!((1.5..=4.0).contains(&report.weights()[3]), "{:?}", report.weights());
    assert!(report.iterations < 50, "{} steps", report.iterations);
    assert!(report.poles.iter().all(|pole| pole.flags & flag::UNTRAINED == 0));
}

#[test]
fn a_network_has_the_same_bits_for_the_same_seed_and_others_for_another() {
    let train = |seed| {
        let options = Options { seed, ..Options::default() };
        network(&arch(), &[Wish { pole: 1, distance: 1.2 }], [0.5, 3.0], &options).unwrap()
    };
    assert_eq!(bits(&train(7)), bits(&train(7)));
    assert_ne!(bits(&train(7)), bits(&train(8)));
    // The bits themselves: training uses + - * / and the square root only, so that they hold on every machine.
    assert_eq!(bits(&train(7)), NETWORK_BITS, "{:?}", train(7).weights());
}

const NETWORK_BITS: [u64; 5] = [
    4607182418800017408,
    4612436618365282987,
    4615112217352450568,
    4609556822247325242,
    4607182418800017408,
];

#[test]
fn the_ends_of_a_network_are_no_wishes_all_wishes_and_an_equal_range() {
    let options = Options::default();
    let none = network(&arch(), &[], [1.0, 2.0], &options).unwrap();
    assert!(none.poles.iter().all(|pole| pole.state == State::None as u32));
    let all: Vec<Wish> = (1..4).map(|pole| Wish { pole, distance: 2.0 }).collect();
    let each = network(&arch(), &all, [0.0, 100.0], &options).unwrap();
    near(&each.weights()[1..4], &[1.0, 2.0, 1.5], 1e-13);
    let equal = network(&arch(), &[], [2.0, 2.0], &options).unwrap();
    near(&equal.weights()[1..4], &[1.0, 2.0, 1.5], 1e-13);
    // No room: steps that do not suffice are told, and the weights are in the range all the same.
    let hasty = Options { steps: 1, ..options };
    let report =
        network(&arch(), &[Wish { pole: 1, distance: 0.05 }], [0.05, 2.0], &hasty).unwrap();
    assert_eq!(report.poles[1].flags & flag::UNTRAINED, flag::UNTRAINED);
    near(&[report.weights()[1]], &[79.0], 1e-12);
}

#[test]
fn networks_over_random_polygons_stay_within_the_range() {
    for seed in 0..2_000_u64 {
        polygons::check_network(seed);
    }
}

#[test]
fn bad_input_of_the_formulas_is_named() {
    let (curve, options) = (arch(), Options::default());
    let lambdas = |bad: f64| refusal(general(&curve, &[0.5, 0.5, bad, 0.5, 0.5], &options));
    assert_eq!(lambdas(f64::NAN), "lambdas: lambda 2 = NaN is not between 0 and 1");
    assert_eq!(lambdas(0.0), "lambdas: lambda 2 = 0 is not between 0 and 1");
    assert_eq!(lambdas(1.0), "lambdas: lambda 2 = 1 is not between 0 and 1");
    let short = refusal(general(&curve, &[0.5], &options));
    assert_eq!(short, "lambdas: 1 given, 5 expected");
    let ends = |a: f64, b: f64| refusal(interpolated(&curve, [a, b], &options));
    assert_eq!(ends(-1.0, 1.0), "first_distance: -1 is not a finite distance of at least 0");
    assert_eq!(ends(1.0, f64::NAN), "last_distance: NaN is not a finite distance of at least 0");
    let net = |wishes: &[Wish], range| refusal(network(&curve, wishes, range, &options));
    assert_eq!(net(&[], [2.0, 1.0]), "min_distance: 2 is more than max_distance 1");
    let wish = |pole, distance| Wish { pole, distance };
    assert_eq!(
        net(&[wish(1, 1.0), wish(5, 1.0)], [0.0, 2.0]),
        "wish_poles: wish 1 names pole 5 of 5"
    );
    assert_eq!(
        net(&[wish(1, 1.0), wish(2, -1.0)], [0.0, 2.0]),
        "wish_distances: wish 1: -1 is not a finite distance of at least 0"
    );
    assert_eq!(
        net(&[wish(1, 1.0), wish(1, 1.0)], [0.0, 2.0]),
        "wish_poles: wish 1 names pole 1 again"
    );
    assert_eq!(net(&[wish(3, 5.0)], [0.0, 2.0]), "wish_distances: 5 of pole 3 is not in the range");
    let twice = bezier(&[[0.; 3], [1., 1., 0.], [1., 1., 0.], [2., 0., 0.]], None);
    assert_eq!(
        refusal(interpolated(&twice, [0.1, 0.2], &options)),
        "poles: pole 1 coincides with pole 2, a wish cannot tell them apart"
    );
}

#[test]
fn bad_options_are_named() {
    let with = |options: Options| refusal(interpolated(&arch(), [1.0, 1.0], &options));
    let none = Options::default();
    let least = with(Options { weight_min: -1.0, ..none });
    assert_eq!(least, "weight_min: -1 is not within 1e-12 .. 1e12");
    let most = with(Options { weight_max: f64::NAN, ..none });
    assert_eq!(most, "weight_max: NaN is not within 1e-12 .. 1e12");
    let crossed = with(Options { weight_min: 3.0, weight_max: 2.0, ..none });
    assert_eq!(crossed, "weight_min: 3 is more than weight_max 2");
    let ratio = with(Options { ratio_limit: 0.5, ..none });
    assert_eq!(ratio, "ratio_limit: 0.5 is less than 1");
    let tolerance = with(Options { tolerance: f64::INFINITY, ..none });
    assert_eq!(tolerance, "tolerance: inf is not a finite length of at least 0");
}

#[test]
fn moving_a_point_towards_a_pole_moves_it_by_the_distance() {
    let curve = arch();
    for distance in [0.5, -0.5, 1e-6, 1.2] {
        let weight = move_point(&curve, 0.4, 2, distance).unwrap();
        let moved = bezier(curve.poles(), Some(&[1., 1., weight, 1., 1.]));
        let (before, after) = (curve.evaluate(0.4), moved.evaluate(0.4));
        let left = |p: [f64; 3]| (p[0] - 6.0).hypot(p[1] - 6.0);
        assert!((left(before) - left(after) - distance).abs() < 1e-13);
    }
    assert!(refusal(move_point(&curve, 0.0, 2, 0.1)).starts_with("u: 0 is where"));
    assert!(refusal(move_point(&curve, 0.4, 2, 50.0)).starts_with("distance: 50 is not between"));
    assert!(refusal(move_point(&curve, 0.4, 2, -50.0)).starts_with("distance: -50 is not between"));
    assert_eq!(refusal(move_point(&curve, 0.4, 9, 0.1)), "pole: 9 is not below the count of 5");
    assert!(refusal(move_point(&curve, 2.0, 2, 0.1)).starts_with("u: 2 is outside the domain"));
}

#[test]
fn the_weight_for_a_point_of_a_shape_is_found_again() {
    let wanted = bezier(arch().poles(), Some(&[1., 1., 2.5, 1., 1.]));
    for u in [0.2, 0.5, 0.7] {
        let edit = through_point(&arch(), 2, wanted.evaluate(u), 0.0).unwrap();
        assert!((edit.weight - 2.5).abs() < 1e-12, "{}", edit.weight);
        assert!(edit.foot.distance < 1e-13 && edit.foot.lower_bound <= edit.foot.distance);
    }
    let beyond = refusal(through_point(&arch(), 2, [6.0, 7.0, 0.0], 0.0));
    assert_eq!(beyond, "point: no weight of pole 2 takes the curve there");
    let pole = refusal(through_point(&arch(), 2, [6.0, 6.0, 0.0], 0.0));
    assert_eq!(pole, "point: is pole 2, where no finite weight takes the curve");
}

#[test]
fn the_shape_factors_of_known_conics() {
    let legs = [[1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    let circle = conic(legs, [1.0, HALF, 1.0]).unwrap();
    assert!(circle.eccentricity < 1e-7 && (circle.rho - (2.0_f64.sqrt() - 1.0)).abs() < 1e-15);
    assert_eq!(conic(legs, [4.0, 4.0, 4.0]).unwrap().eccentricity, 1.0);
    // x y = 1 from (1/2, 2) to (2, 1/2): the tangents meet in (4/5, 4/5); a rectangular hyperbola has e = sqrt 2.
    let hyperbola = [[0.5, 2., 0.], [0.8, 0.8, 0.], [2., 0.5, 0.]];
    let found = weights_of_eccentricity(hyperbola, 2.0_f64.sqrt()).unwrap();
    assert!(found.iter().any(|w| (w - 1.25).abs() < 1e-12), "{found:?}");
    assert!(
        (conic(hyperbola, [1.0, 1.25, 1.0]).unwrap().eccentricity - 2.0_f64.sqrt()).abs() < 1e-13
    );
    // A quarter of the ellipse with axes 5 and 3: e = 4/5.
    let ellipse = [[5., 0., 0.], [5., 3., 0.], [0., 3., 0.]];
    assert!((conic(ellipse, [1.0, HALF, 1.0]).unwrap().eccentricity - 0.8).abs() < 1e-13);
    let found = weights_of_eccentricity(ellipse, 0.8).unwrap();
    assert!(found.iter().any(|w| (w - HALF).abs() < 1e-12), "{found:?}");
    let circles = weights_of_eccentricity(legs, 0.0).unwrap();
    assert_eq!(circles.len(), 1);
    assert!((circles[0] - HALF).abs() < 1e-7);
    assert!(weights_of_eccentricity(ellipse, 0.0).unwrap().is_empty());
    assert_eq!(weight_of_rho(0.5).unwrap(), 1.0);
    assert_eq!(refusal(weight_of_rho(1.0)), "rho: 1 is not between 0 and 1");
    let line = [[0., 0., 0.], [1., 1., 0.], [2., 2., 0.]];
    assert_eq!(refusal(conic(line, [1.0; 3])), "poles: poles 0, 1 and 2 are in one line");
    assert_eq!(
        refusal(conic(legs, [1.0, 0.0, 1.0])),
        "weights: weight 1 is not positive and finite"
    );
}

#[test]
fn the_complement_of_an_arc_has_a_positive_form() {
    // The unit circle without its first quarter: middle weight -sqrt(1/2).
    let raw = [[1., 0., 0., 1.], [-HALF, -HALF, 0., -HALF], [0., 1., 0., 1.]];
    let curve = positive(&[0., 0., 0., 1., 1., 1.], 2, &raw).unwrap();
    assert!(curve.weights().unwrap().iter().all(|w| *w > 0.0));
    for i in 0..=100 {
        let [x, y, _] = curve.evaluate(f64::from(i) / 100.0);
        assert!((x.hypot(y) - 1.0).abs() < 1e-14);
        assert!(i == 0 || i == 100 || x < 1e-15 || y < 1e-15);
    }
    let turned = positive(&[0., 0., 0., 1., 1., 1.], 2, &raw.map(|pole| pole.map(|x| -x))).unwrap();
    assert_eq!(turned, curve);
}

#[test]
fn a_denominator_that_vanishes_has_no_positive_form() {
    let knots = [0., 0., 0., 1., 1., 1.];
    let with = |w: [f64; 3]| {
        let poles = [[0., 0., 0., w[0]], [w[1], 0., 0., w[1]], [0., w[2], 0., w[2]]];
        refusal(positive(&knots, 2, &poles))
    };
    assert!(with([1.0, -1.0, 1.0]).contains("at or beside u = 0.5"), "{}", with([1.0, -1.0, 1.0]));
    assert!(with([1.0, 1.0, 0.0]).contains("u = 1"));
    assert!(with([1.0, -3.0, 1.0]).contains("the denominator is 0 or changes its sign"));
    assert_eq!(with([0.0; 3]), "poles: every weight is 0");
    // A double zero between the halvings: not decided, and said so.
    let third = [[0., 0., 0., 1.], [0., 0., 0., -2.], [0., 1., 0., 4.]];
    let text = refusal(positive(&knots, 2, &third));
    assert!(text.contains("u = 0.333333"), "{text}");
    let bad = [[0., 0., 0., 1.], [0., f64::NAN, 0., 1.], [0., 0., 0., 1.]];
    assert_eq!(refusal(positive(&knots, 2, &bad)), "poles: pole 1 is not finite or beyond 1e100");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, rng_seed: RngSeed::Fixed(0x666f_6f74), ..ProptestConfig::with_cases(200) })]

    #[test]
    fn the_standard_form_has_end_weights_one_and_the_same_points(seed: u64) {
        let mut random = Random(seed);
        let (knots, degree, poles) = polygon(&mut random);
        let weights: Vec<f64> = poles.iter().map(|_| 0.1 + 10.0 * random.unit()).collect();
        let curve = Curve::new(&knots, degree, &poles, Some(&weights)).unwrap();
        let form = standard(&curve).unwrap();
        let new = form.weights().unwrap();
        prop_assert_eq!((new[0], new[new.len() - 1]), (1.0, 1.0));
        prop_assert_eq!(form.poles(), curve.poles());
        let form = footpoint::index::IndexedCurve::new(form);
        for i in 0..=20 {
            let point = curve.evaluate(f64::from(i) / 20.0);
            prop_assert!(polygons::distance(&form, point) < 1e-11);
        }
    }

    #[test]
    fn a_positive_form_is_the_same_curve(seed: u64) {
        let mut random = Random(seed);
        let (knots, degree, poles) = polygon(&mut random);
        let raw: Vec<[f64; 4]> = poles
            .iter()
            .map(|[x, y, z]| {
                let w = random.unit() * 1.5 - 0.2;
                [x * w, y * w, z * w, w]
            })
            .collect();
        if let Ok(curve) = positive(&knots, degree, &raw) {
            prop_assert!(curve.weights().unwrap().iter().all(|w| *w > 0.0));
            for i in 0..=20 {
                let u = f64::from(i) / 20.0;
                let (point, expected) = (curve.evaluate(u), homogeneous(&knots, degree, &raw, u));
                let size = expected.iter().fold(10.0, |most: f64, x| most.max(x.abs()));
                for axis in 0..3 {
                    prop_assert!((point[axis] - expected[axis]).abs() < 1e-9 * size * size);
                }
            }
        }
    }
}

/// The point of homogeneous data: numerator and denominator as polynomial curves of their own.
fn homogeneous(knots: &[f64], degree: usize, raw: &[[f64; 4]], u: f64) -> [f64; 3] {
    let top: Vec<[f64; 3]> = raw.iter().map(|p| [p[0], p[1], p[2]]).collect();
    let bottom: Vec<[f64; 3]> = raw.iter().map(|p| [p[3], 0.0, 0.0]).collect();
    let at = |poles: &[[f64; 3]]| Curve::new(knots, degree, poles, None).unwrap().evaluate(u);
    let w = at(&bottom)[0];
    at(&top).map(|x| x / w)
}
