//! Relations: inverses, ends, agreement with circles, monotone composition, refusals.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::*;
use crate::elementary::{Axes, Elementary, ElementarySurface};

/// Form, sweep: a half turn of 4 and of 5 poles, a full one of 7 (two kinds) and of 9 poles, other arcs.
const FORMS: [(CircleForm, f64); 8] = [
    (CircleForm::Halves, PI),
    (CircleForm::Arcs(2), PI),
    (CircleForm::Halves, TAU),
    (CircleForm::Arcs(3), TAU),
    (CircleForm::Arcs(4), TAU),
    (CircleForm::Arcs(1), 1.1),
    (CircleForm::Arcs(2), 3.7),
    (CircleForm::Arcs(7), TAU),
];

fn unit(form: CircleForm, sweep: f64) -> Relation {
    Relation::circle(form, sweep, [0.0, 1.0], [0.0, 1.0]).unwrap()
}

/// Places that crowd at the ends and at the joints of pieces.
fn places() -> Vec<f64> {
    let mut all: Vec<f64> = (0..=20_000).map(|k| f64::from(k) / 20_000.0).collect();
    for joint in [0.0, 0.25, 1.0 / 3.0, 0.5, 0.75, 1.0] {
        for power in 4..60 {
            let step = 0.7f64.powi(power * 2);
            all.extend([joint - step, joint + step]);
        }
    }
    all.retain(|x| (0.0..=1.0).contains(x));
    all
}

#[test]
fn both_ways_agree_to_1e_15_over_the_whole_domain_and_ends_are_exact() {
    for (form, sweep) in FORMS {
        let there = unit(form, sweep);
        let back = there.inverse();
        for (relation, inverse) in [(&there, &back), (&back, &there)] {
            assert_eq!((relation.apply(0.0), relation.apply(1.0)), (0.0, 1.0));
            for x in places() {
                let off = (inverse.apply(relation.apply(x)) - x).abs();
                assert!(off <= 1e-15, "{form:?} {sweep} {x}: {off:e}");
            }
        }
    }
}

#[test]
fn relations_are_the_published_formulas() {
    let quarter = |s: f64| 2.0 * s.atan2(2f64.sqrt() * (1.0 - s) + s);
    for u in places() {
        let half = 2.0 / PI * u.atan2(1.0 - u);
        assert!((unit(CircleForm::Halves, PI).apply(u) - half).abs() <= 5e-16, "{u}");
        let seven = if u <= 0.5 {
            (2.0 * u).atan2(1.0 - 2.0 * u) / PI
        } else {
            0.5 + (2.0 * u - 1.0).atan2(2.0 - 2.0 * u) / PI
        };
        assert!((unit(CircleForm::Halves, TAU).apply(u) - seven).abs() <= 5e-16, "{u}");
        let (s, before) = if u <= 0.5 { (2.0 * u, 0.0) } else { (2.0 * u - 1.0, FRAC_PI_2) };
        let five = (before + quarter(s)) / PI;
        assert!((unit(CircleForm::Arcs(2), PI).apply(u) - five).abs() <= 5e-16, "{u}");
    }
}

#[test]
fn the_angle_is_that_of_the_point_of_the_spline() {
    for (form, sweep) in FORMS {
        let kind = Elementary::Cylinder { axes: Axes::STANDARD, radius: 1.0 };
        let cylinder = ElementarySurface::new(kind, [0.0, sweep, 0.0, 1.0]).unwrap();
        let spline = cylinder.nurbs([form; 2]).unwrap();
        let angle = Relation::circle(form, sweep, [0.0, 1.0], [0.0, sweep]).unwrap();
        for u in places() {
            let ([x, y, _], [c, s, _]) =
                (spline.evaluate(u, 0.0), cylinder.evaluate(angle.apply(u), 0.0));
            assert!((x - c).hypot(y - s) <= 2e-15, "{form:?} {sweep} {u}: {x} {y} {c} {s}");
        }
    }
}

#[test]
fn every_relation_is_monotone_between_neighbouring_places_and_stays_in_its_image() {
    let mut all = places();
    all.sort_by(f64::total_cmp);
    all.dedup();
    for (form, sweep) in FORMS {
        for relation in [unit(form, sweep), unit(form, sweep).inverse()] {
            let values: Vec<f64> = all.iter().map(|&x| relation.apply(x)).collect();
            assert!(values.windows(2).all(|w| w[0] <= w[1]), "{relation:?}");
        }
    }
}

fn several() -> Vec<Relation> {
    let circle = Relation::circle(CircleForm::Arcs(4), TAU, [2.0, 5.0], [0.0, TAU]).unwrap();
    let falling = Relation::linear([0.0, TAU], [7.0, 3.0]).unwrap();
    let broken = Relation::through(&[0.0, 0.2, 1.0, 3.0], &[5.0, 4.0, 3.9, 0.0]).unwrap();
    let (square, root): (Function, Function) = (Arc::new(|x| x * x), Arc::new(f64::sqrt));
    let function = Relation::function([1.0, 3.0], square, root).unwrap();
    vec![
        circle.then(&falling).unwrap(),
        falling.inverse().then(&circle.inverse()).unwrap(),
        circle,
        falling,
        broken.then(&Relation::reversal([0.0, 5.0]).unwrap()).unwrap(),
        broken,
        function,
        Relation::identity([0.3, 0.9]).unwrap(),
    ]
}

#[test]
fn composed_relations_have_inverses_and_exact_ends() {
    for relation in several() {
        let inverse = relation.inverse();
        let ([a, b], [low, high]) = (relation.domain(), relation.image());
        assert_eq!((inverse.domain(), inverse.image()), (relation.image(), relation.domain()));
        let ends = [relation.apply(a), relation.apply(b)];
        assert_eq!(ends, if relation.is_increasing() { [low, high] } else { [high, low] });
        assert_eq!(inverse.inverse().apply(a), relation.apply(a));
        let mut before = ends[0];
        for k in 1..=1000 {
            let x = between(a, b, f64::from(k) / 1000.0);
            let y = relation.apply(x);
            assert!((inverse.apply(y) - x).abs() <= 4e-15 * b.abs().max(1.0), "{relation:?} {x}");
            assert_eq!(before < y, relation.is_increasing(), "{relation:?} {x}");
            before = y;
        }
    }
}

#[test]
fn transforms_compose_and_invert_with_exchanged_parameters() {
    let all = several();
    for swap in [false, true] {
        for (u, v) in all.iter().zip(all.iter().skip(1)) {
            let there = Transform { u: u.clone(), v: v.clone(), swap };
            let back = there.inverse();
            assert_eq!(back.keeps_direction(), there.keeps_direction());
            let [u0, u1, v0, v1] = there.domain();
            let whole = there.then(&back).unwrap();
            assert!(!whole.swap && whole.keeps_direction());
            for k in 0..=10 {
                let share = f64::from(k) / 10.0;
                let at = [between(u0, u1, share), between(v0, v1, 1.0 - share)];
                let again = back.apply(there.apply(at));
                assert_eq!(again, whole.apply(at));
                assert!((again[0] - at[0]).hypot(again[1] - at[1]) < 4e-14, "{there:?} {at:?}");
            }
        }
    }
}

#[test]
fn what_is_no_relation_is_refused_by_name() {
    let text = |made: Result<Relation, Error>| made.unwrap_err().to_string();
    let line = |from, to| text(Relation::linear(from, to));
    assert_eq!(line([0.0, 0.0], [0.0, 1.0]), "from: entry 0 is not less than entry 1");
    assert_eq!(line([0.0, 1.0], [1.0, 1.0]), "to: entry 1 equals entry 0");
    assert_eq!(line([0.0, f64::NAN], [0.0, 1.0]), "from: entry 1 is not finite or beyond 1e100");
    let (double, same): (Function, Function) = (Arc::new(|x| 2.0 * x), Arc::new(|x| x));
    let wrong = text(Relation::function([0.0, 1.0], double.clone(), same));
    assert!(wrong.starts_with("inverse: differs"), "{wrong}");
    let wave: Function = Arc::new(|x| (9.0 * x).sin());
    let wrong = text(Relation::function([0.0, 1.0], wave, double));
    assert!(wrong.starts_with("function: is not finite or not monotone"), "{wrong}");
    let bent = text(Relation::through(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.5]));
    assert_eq!(bent, "pieces: piece 1 changes the direction");
    let gap = Relation::identity([0.0, 1.0]).unwrap();
    let next = Relation::identity([0.0, 2.0]).unwrap();
    assert!(text(gap.then(&next)).starts_with("next: begins with"));
    let sweep = text(Relation::circle(CircleForm::Halves, 1.0, [0.0, 1.0], [0.0, 1.0]));
    assert!(sweep.starts_with("form: half turns"), "{sweep}");
}
