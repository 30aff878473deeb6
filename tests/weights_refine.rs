//! Refined weights: wishes met with proof, impossible ones told, constraints, surfaces.

mod polygons;

use footpoint::closest::{QueryOptions, Workspace};
use footpoint::curve::Curve;
use footpoint::error::Error;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::surface::Surface;
use footpoint::weights::refine::refine;
use footpoint::weights::{Constraint, Net, Options, Report, State, WEIGHT_LIMITS, Wish, flag};

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

fn bezier(poles: &[[f64; 3]], weights: Option<&[f64]>) -> Curve {
    let mut knots = vec![0.0; poles.len()];
    knots.extend(vec![1.0; poles.len()]);
    Curve::new(&knots, poles.len() - 1, poles, weights).unwrap()
}

fn arch() -> Curve {
    bezier(&[[0., 0., 0.], [3., 4., 0.], [6., 6., 0.], [9., 5., 0.], [12., 0., 0.]], None)
}

/// Five poles that are their own mirror image.
fn gate() -> Curve {
    bezier(&[[0., 0., 0.], [2., 5., 0.], [6., 7., 0.], [10., 5., 0.], [12., 0., 0.]], None)
}

fn with(curve: &Curve, wishes: &[Wish], constraints: &[Constraint], options: &Options) -> Report {
    refine(Net::Curve(curve), wishes, constraints, options, &mut || false).unwrap()
}

fn wish(pole: usize, distance: f64) -> Wish {
    Wish { pole, distance }
}

fn refusal(curve: &Curve, wishes: &[Wish], constraints: &[Constraint]) -> String {
    let result = refine(Net::Curve(curve), wishes, constraints, &Options::default(), &mut || false);
    result.unwrap_err().to_string()
}

#[test]
fn the_middle_weight_of_a_quarter_circle_is_found_from_its_distance() {
    let curve = bezier(&[[1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], None);
    let report = with(&curve, &[wish(1, 2.0_f64.sqrt() - 1.0)], &[], &Options::default());
    assert!((report.weights()[1] - HALF).abs() < 1e-12, "{:?}", report.weights());
    assert!((report.weights()[0] - 1.0).abs() < 1e-12 && (report.weights()[2] - 1.0).abs() < 1e-12);
    assert!(report.is_met());
    let point = report.curve().unwrap().evaluate(0.3);
    assert!((point[0].hypot(point[1]) - 1.0).abs() < 1e-12);
}

/// The distance of a pole of the arch from the curve with other weights.
fn known(weights: [f64; 5], pole: usize) -> f64 {
    let curve = bezier(arch().poles(), Some(&weights));
    polygons::distance(&IndexedCurve::new(curve), arch().poles()[pole])
}

#[test]
fn wished_distances_are_the_measured_ones_and_the_other_weights_stay_at_one() {
    let weights = [1.0, 2.0, 1.5, 1.0, 1.0];
    let wanted = [1, 2].map(|pole| known(weights, pole));
    let wishes = [wish(1, wanted[0]), wish(2, wanted[1])];
    let report = with(&arch(), &wishes, &[], &Options::default());
    assert!(report.is_met());
    let curve = IndexedCurve::new(report.curve().unwrap().clone());
    for (pole, wanted) in [(1, wanted[0]), (2, wanted[1])] {
        let measured = polygons::distance(&curve, curve.curve().poles()[pole]);
        assert!((measured - wanted).abs() < 1e-11, "{measured}");
        assert_eq!(report.poles[pole].state, State::Met as u32);
        assert!(report.poles[pole].lower_bound > wanted - 1e-8);
    }
    for (found, weight) in report.weights().iter().zip(weights) {
        assert!((found - weight).abs() < 1e-6, "{:?}", report.weights());
    }
    for pole in [0, 3, 4] {
        assert_eq!(report.poles[pole].state, State::None as u32);
    }
}

#[test]
fn random_wishes_that_exist_are_met_and_none_is_silently_off() {
    let mut tally = polygons::feasible(11, 400);
    tally.show("wishes that exist");
    assert_eq!(tally.wrong, 0);
    assert!(tally.missed <= 1, "{} of 400 missed", tally.missed);
}

#[test]
fn wishes_that_may_exist_are_answered_with_the_truth() {
    let mut tally = polygons::wild(13, 12);
    tally.show("wishes that may exist");
    assert_eq!(tally.wrong, 0);
}

#[test]
fn wishes_that_do_not_exist_are_never_met() {
    let mut tally = polygons::infeasible(12, 60);
    tally.show("wishes that do not exist");
    assert_eq!((tally.wrong, tally.met), (0, 0));
}

#[test]
fn a_wish_beyond_what_the_range_gives_is_proven_impossible_and_the_others_are_met() {
    // Pole 1 is 5 from the first point: no weights take the curve farther. Pole 3 is a corner of the hull: not nearer than 0.
    let report = with(&arch(), &[wish(1, 5.1), wish(2, 1.0)], &[], &Options::default());
    assert_eq!(report.poles[1].state, State::Impossible as u32);
    assert_eq!(report.poles[2].state, State::Met as u32);
    assert!(!report.is_met());
    assert!(report.weights()[1] < 0.05, "as far as the other wish allows: {:?}", report.weights());
    let report = with(&arch(), &[wish(2, 0.0)], &[], &Options::default());
    assert_eq!(report.poles[2].state, State::Impossible as u32);
    assert!((report.weights()[2] - 100.0).abs() < 1e-9 && report.poles[2].distance < 0.1);
    let narrow = Options { weight_min: 0.5, weight_max: 2.0, ..Options::default() };
    let report = with(&arch(), &[wish(2, 0.3)], &[], &narrow);
    assert_eq!(report.poles[2].state, State::Impossible as u32);
    assert_eq!(report.poles[2].flags & flag::AT_LIMIT, flag::AT_LIMIT);
}

#[test]
fn a_proof_of_impossibility_holds_for_every_sampled_weight() {
    let mut random = polygons::Random(5);
    for _ in 0..40 {
        let polygon = polygons::polygon(&mut random);
        let curve = Curve::new(&polygon.0, polygon.1, &polygon.2, None).unwrap();
        let pole = 1 + random.below(polygon.2.len() - 2);
        let wanted = 8.0 * random.unit() * random.unit();
        let options = Options { weight_min: 0.2, weight_max: 5.0, starts: 2, ..Options::default() };
        let report = with(&curve, &[wish(pole, wanted)], &[], &options);
        if report.poles[pole].state != State::Impossible as u32 {
            continue;
        }
        let sample = |random: &mut polygons::Random| {
            let weights: Vec<f64> =
                polygon.2.iter().map(|_| 5_f64.powf(2.0 * random.unit() - 1.0)).collect();
            let fitted = Curve::new(&polygon.0, polygon.1, &polygon.2, Some(&weights)).unwrap();
            polygons::distance(&IndexedCurve::new(fitted), polygon.2[pole])
        };
        let first = sample(&mut random) > wanted;
        for _ in 0..100 {
            assert_eq!(
                sample(&mut random) > wanted,
                first,
                "a wish between two distances that exist"
            );
        }
    }
}

#[test]
fn the_curve_passes_through_a_point_at_a_parameter_and_anywhere() {
    let wanted = bezier(arch().poles(), Some(&[1., 3., 0.5, 2., 1.]));
    let at = [Constraint::PointAt([0.4, 0.0], wanted.evaluate(0.4))];
    let report = with(&arch(), &[], &at, &Options::default());
    assert!(report.is_met() && report.constraints[0].error < 1e-10, "{:?}", report.constraints);
    let through =
        [Constraint::Point(wanted.evaluate(0.3)), Constraint::Point(wanted.evaluate(0.8))];
    let report = with(&arch(), &[], &through, &Options::default());
    assert!(report.is_met(), "{:?}", report.constraints);
    let curve = IndexedCurve::new(report.curve().unwrap().clone());
    assert!(polygons::distance(&curve, wanted.evaluate(0.3)) < 1e-10);
    // Outside the hull of the poles: not met, and said so.
    let beyond = with(
        &arch(),
        &[],
        &[Constraint::Point([6.0, 9.0, 0.0])],
        &Options { starts: 5, ..Options::default() },
    );
    assert!(
        !beyond.is_met() && beyond.constraints[0].met == 0 && beyond.constraints[0].error > 2.9
    );
}

#[test]
fn a_tangent_is_kept_or_turned() {
    let direction = |curve: &Curve, u: f64| {
        let mut out = [[0.0; 3]; 2];
        curve.derivatives(u, 1, &mut out);
        out[1][1].atan2(out[1][0])
    };
    let kept = with(&arch(), &[wish(1, 1.4)], &[Constraint::TangentKept(0.5)], &Options::default());
    assert!(kept.is_met(), "{:?}", kept.constraints);
    let angle = direction(kept.curve().unwrap(), 0.5);
    assert!((angle - direction(&arch(), 0.5)).abs() < 1e-9);
    let free = with(&arch(), &[wish(1, 1.4)], &[], &Options::default());
    assert!((direction(free.curve().unwrap(), 0.5) - direction(&arch(), 0.5)).abs() > 1e-3);
    let level = [Constraint::TangentAt(0.5, [2.0, 0.0, 0.0])];
    let turned = with(&arch(), &[wish(1, 1.4)], &level, &Options::default());
    assert!(turned.is_met() && direction(turned.curve().unwrap(), 0.5).abs() < 1e-9);
    // Against the run of the curve: the sine is 0, the direction is not.
    let back = [Constraint::TangentAt(0.5, [-2.0, 0.0, 0.0])];
    let options = Options { starts: 3, ..Options::default() };
    assert!(!with(&arch(), &[], &back, &options).is_met());
}

#[test]
fn symmetric_weights_are_equal_bit_for_bit() {
    let options = Options { symmetric: true, ..Options::default() };
    let report = with(&gate(), &[wish(1, 0.7), wish(2, 1.1)], &[], &options);
    let weights = report.weights();
    assert!(report.is_met(), "{report:?}");
    assert_eq!((weights[0], weights[1]), (weights[4], weights[3]));
    assert!((report.poles[3].distance - 0.7).abs() < 1e-10);
}

#[test]
fn a_limited_ratio_holds_and_is_scale_free() {
    let options = Options { ratio_limit: 3.0, ..Options::default() };
    let ends = options.range().unwrap();
    assert!(ends[0] < 1.0 && ends[1] > 1.0 && ends[1] / ends[0] <= 3.0);
    let report = with(&arch(), &[wish(1, 1.4), wish(2, 1.2)], &[], &options);
    let weights = report.weights();
    let most = weights.iter().fold(0.0_f64, |a, b| a.max(*b));
    let least = weights.iter().fold(f64::MAX, |a, b| a.min(*b));
    assert!(most / least <= 3.0, "{weights:?}");
    let narrow =
        Options { weight_min: 2.0, weight_max: 50.0, ratio_limit: 4.0, ..Options::default() };
    assert_eq!(narrow.range().unwrap()[0], 2.0);
    let [least, most] = WEIGHT_LIMITS;
    let all = Options { weight_min: least, weight_max: most, ..Options::default() };
    assert_eq!(all.range().unwrap(), [least, most]);
}

#[test]
fn no_wishes_give_weights_of_one_and_the_same_input_the_same_bits() {
    let report = with(&arch(), &[], &[], &Options::default());
    assert_eq!(report.weights(), [1.0; 5]);
    assert!(report.is_met());
    let again = || with(&arch(), &[wish(1, 1.0), wish(3, 2.0)], &[], &Options::default()).weights();
    assert_eq!(again(), again());
}

#[test]
fn wishes_for_all_poles_of_an_unclamped_closed_curve_are_met() {
    // A periodic quadratic over a square, unrolled.
    let poles: Vec<[f64; 3]> = [[0., 0.], [4., 0.], [4., 4.], [0., 4.], [0., 0.], [4., 0.]]
        .iter()
        .map(|p: &[f64; 2]| [p[0], p[1], 0.0])
        .collect();
    let knots: Vec<f64> = (0..9).map(f64::from).collect();
    let curve = Curve::new(&knots, 2, &poles, None).unwrap();
    let report =
        with(&curve, &[wish(1, 0.9), wish(2, 0.5), wish(3, 0.8)], &[], &Options::default());
    assert!(report.is_met(), "{report:?}");
    // Ends on the curve: their distance is 0 whatever the weights are.
    let weights = [1.0, 1.4, 0.7, 2.0, 1.0];
    let all: Vec<Wish> = (0..5).map(|pole| wish(pole, known(weights, pole))).collect();
    let report = with(&arch(), &all, &[], &Options::default());
    assert!(report.is_met(), "{report:?}");
    let off = with(&arch(), &[wish(0, 0.1)], &[], &Options { starts: 3, ..Options::default() });
    assert_eq!(off.poles[0].state, State::Impossible as u32);
}

#[test]
fn bad_wishes_and_constraints_are_named() {
    let curve = arch();
    let nan = f64::NAN;
    let text = refusal(&curve, &[wish(1, 1.0), wish(2, nan)], &[]);
    assert_eq!(text, "wish_distances: wish 1: NaN is not a finite distance of at least 0");
    let text = refusal(&curve, &[wish(9, 1.0)], &[]);
    assert_eq!(text, "wish_poles: wish 0 names pole 9 of 5");
    let text = refusal(&curve, &[], &[Constraint::PointAt([2.0, 0.0], [0.0; 3])]);
    assert_eq!(text, "constraints: constraint 0: [2.0, 0.0] is outside the domain");
    let text = refusal(&curve, &[], &[Constraint::Point([0.0, nan, 0.0])]);
    assert_eq!(text, "constraints: constraint 0: entry 1 is not finite or beyond 1e100");
    let text = refusal(&curve, &[], &[Constraint::TangentAt(0.5, [0.0; 3])]);
    assert_eq!(text, "constraints: constraint 0: has no direction");
    let twice = bezier(&[[0.; 3], [1., 1., 0.], [1., 1., 0.], [2., 0., 0.]], None);
    let text = refusal(&twice, &[wish(2, 0.1)], &[]);
    assert_eq!(text, "poles: pole 2 coincides with pole 1, a wish cannot tell them apart");
    let point = bezier(&[[1.; 3]; 3], None);
    assert_eq!(refusal(&point, &[], &[]), "poles: all of them coincide");
}

#[test]
fn numbers_far_beyond_the_polygon_are_answered() {
    let options = Options { starts: 3, ..Options::default() };
    let tiny = bezier(&[[0.; 3], [1e-60, 1e-60, 0.], [2e-60, 0., 0.]], None);
    let far = with(&tiny, &[wish(1, 1e-61)], &[Constraint::Point([1e100, 0.0, 0.0])], &options);
    assert!(!far.is_met() && far.weights().len() == 3);
    let huge = bezier(&[[0.; 3], [1e99, 1e99, 0.], [2e99, 0., 0.]], None);
    let met = with(&huge, &[wish(1, 4e98)], &[], &Options::default());
    assert!(met.is_met(), "{met:?}");
    let beyond = with(&arch(), &[wish(1, 1e300)], &[], &options);
    assert_eq!(beyond.poles[1].state, State::Impossible as u32);
}

#[test]
fn contradicting_wishes_are_proven_so() {
    // Poles 1 and 3 are less than 6.1 apart: no point is 6.2 nearer to one than to the other.
    let report = with(&arch(), &[wish(1, 0.1), wish(3, 6.3)], &[], &Options::default());
    assert_eq!(report.poles[3].state, State::Impossible as u32);
    // Poles 1 and 2 of the gate are 4.5 apart.
    let report = with(&gate(), &[wish(1, 0.2), wish(2, 4.8)], &[], &Options::default());
    assert!(report.poles[1..3].iter().all(|pole| pole.state == State::Impossible as u32));
}

#[test]
fn a_search_may_be_stopped() {
    let stopped =
        refine(Net::Curve(&arch()), &[wish(1, 1.0)], &[], &Options::default(), &mut || true);
    assert_eq!(stopped.unwrap_err(), Error::Cancelled);
}

/// A bicubic net of 5 x 6 poles over a square with hills.
fn hills(weights: Option<&[f64]>) -> Surface {
    let knots_u = [0., 0., 0., 0., 0.5, 1., 1., 1., 1.];
    let knots_v = [0., 0., 0., 0., 0.4, 0.7, 1., 1., 1., 1.];
    let mut random = polygons::Random(3);
    let mut poles = Vec::new();
    for i in 0..5 {
        for j in 0..6 {
            poles.push([2.0 * f64::from(i), 2.0 * f64::from(j), 4.0 * random.unit()]);
        }
    }
    Surface::new(&knots_u, &knots_v, 3, 3, &poles, 5, 6, weights).unwrap()
}

#[test]
fn a_surface_gets_the_wished_distances() {
    let surface = hills(None);
    let mut random = polygons::Random(8);
    for round in 0..5 {
        let weights: Vec<f64> = (0..30).map(|_| 0.3 + 3.0 * random.unit()).collect();
        let wanted = IndexedSurface::new(hills(Some(&weights)));
        let measure = |surface: &IndexedSurface, pole: usize| {
            let options = QueryOptions::default();
            let query = surface.surface().poles()[pole];
            surface.closest(query, None, &options, &mut Workspace::default(), None).distance
        };
        let wishes: Vec<Wish> = [7, 8, 10, 14, 15, 21].map(|k| wish(k, measure(&wanted, k))).into();
        let report =
            refine(Net::Surface(&surface), &wishes, &[], &Options::default(), &mut || false)
                .unwrap();
        assert!(report.is_met(), "round {round}: {:?}", report.poles);
        let found = IndexedSurface::new(report.surface().unwrap().clone());
        for w in &wishes {
            assert!((measure(&found, w.pole) - w.distance).abs() < 1e-9 * 14.0);
        }
        assert!(report.curve().is_err());
    }
}

#[test]
fn a_surface_passes_through_points_and_keeps_symmetric_weights() {
    let weights: Vec<f64> = (0..30).map(|k| 1.0 + 0.1 * f64::from(k)).collect();
    let (surface, wanted) = (hills(None), hills(Some(&weights)));
    let constraints = [
        Constraint::PointAt([0.3, 0.6], wanted.evaluate(0.3, 0.6)),
        Constraint::Point(wanted.evaluate(0.7, 0.2)),
    ];
    let net = Net::Surface(&surface);
    let report = refine(net, &[], &constraints, &Options::default(), &mut || false).unwrap();
    assert!(report.is_met(), "{:?}", report.constraints);
    let options = Options { symmetric: true, ..Options::default() };
    let report = refine(net, &[wish(14, 0.4)], &[], &options, &mut || false).unwrap();
    let found = report.weights();
    assert_eq!(found[14], found[15]);
    assert!((0..30).all(|k| found[k] == found[(4 - k / 6) * 6 + k % 6]));
    let tangent = [Constraint::TangentKept(0.5)];
    let refused = refine(net, &[], &tangent, &Options::default(), &mut || false).unwrap_err();
    assert!(matches!(refused, Error::Unsupported(_)));
}

#[test]
fn a_proof_of_impossibility_of_a_surface_holds_for_every_sampled_weight() {
    let (surface, options) = (
        hills(None),
        Options { weight_min: 0.2, weight_max: 5.0, starts: 1, ..Options::default() },
    );
    let mut random = polygons::Random(21);
    let mut sampled = vec![[f64::MAX, 0.0_f64]; 30];
    for _ in 0..60 {
        let weights: Vec<f64> = (0..30).map(|_| 5_f64.powf(2.0 * random.unit() - 1.0)).collect();
        let fitted = IndexedSurface::new(hills(Some(&weights)));
        for (k, range) in sampled.iter_mut().enumerate() {
            let query = surface.poles()[k];
            let options = QueryOptions::default();
            let d = fitted.closest(query, None, &options, &mut Workspace::default(), None).distance;
            *range = [range[0].min(d), range[1].max(d)];
        }
    }
    let mut proofs = 0;
    for (k, [least, greatest]) in sampled.into_iter().enumerate() {
        for wanted in [0.5 * least, greatest + 0.5, greatest + 3.0, greatest + 9.0] {
            let report =
                refine(Net::Surface(&surface), &[wish(k, wanted)], &[], &options, &mut || false)
                    .unwrap();
            proofs += usize::from(report.poles[k].state == State::Impossible as u32);
        }
        for wanted in [least, 0.5 * (least + greatest), greatest] {
            let report =
                refine(Net::Surface(&surface), &[wish(k, wanted)], &[], &options, &mut || false)
                    .unwrap();
            assert_ne!(report.poles[k].state, State::Impossible as u32, "pole {k}, {wanted}");
        }
    }
    assert!(proofs > 20, "{proofs} of 120 proven");
}
