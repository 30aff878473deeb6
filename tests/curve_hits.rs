//! Hits of curves with curves and surfaces against closed forms.

mod known_shapes;

use footpoint::curve::Curve;
use footpoint::index::IndexedCurve;
use footpoint::intersect::{CurveHits, HitOptions, Nature, Quadric};
use known_shapes::{Random, Vector, circle, cylinder, figure_eight, norm, sphere, sub, torus};

fn line(a: Vector, b: Vector) -> IndexedCurve {
    IndexedCurve::new(Curve::new(&[0., 0., 1., 1.], 1, &[a, b], None).unwrap())
}

fn cubic(poles: [Vector; 4]) -> IndexedCurve {
    let knots = [0., 0., 0., 0., 1., 1., 1., 1.];
    IndexedCurve::new(Curve::new(&knots, 3, &poles, None).unwrap())
}

fn mapped(curve: &IndexedCurve, f: impl Fn(Vector) -> Vector) -> IndexedCurve {
    let c = curve.curve();
    let poles: Vec<Vector> = c.poles().iter().map(|&x| f(x)).collect();
    IndexedCurve::new(Curve::new(c.knots().values(), c.degree(), &poles, c.weights()).unwrap())
}

fn meet(a: &IndexedCurve, b: &IndexedCurve) -> CurveHits {
    a.meet_curve(b, &HitOptions::default(), &mut || false).unwrap()
}

fn kinds(hits: &CurveHits) -> Vec<(Nature, u32)> {
    hits.hits.iter().map(|h| (h.nature, h.multiplicity)).collect()
}

#[test]
fn circles_cross_touch_and_coincide() {
    for (scale, far) in [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 1e3)] {
        let place = |x: Vector| x.map(|c| c * scale + far);
        let unit = mapped(&circle(0.0, 1.0, 1.0), place);
        let moved =
            |r: f64, d: f64| mapped(&circle(0.0, 1.0, r), |x| place([x[0] + d, x[1], x[2]]));
        let hits = meet(&unit, &moved(1.0, 1.0));
        assert!(hits.is_complete());
        assert_eq!(kinds(&hits), [(Nature::Transversal, 1); 2], "{scale} {far} {hits:?}");
        for hit in &hits.hits {
            let x = hit.point.map(|c| (c - far) / scale);
            assert!((x[0] - 0.5).abs() < 1e-13 + 1e-15 * far / scale, "{x:?}");
        }
        // Outside, and inside.
        for (r, d) in [(0.5, 1.5), (0.5, 0.5)] {
            let hits = meet(&unit, &moved(r, d));
            assert!(hits.is_complete(), "{r} {d} {hits:?}");
            assert_eq!(kinds(&hits), [(Nature::Tangential, 2)], "{r} {d} {hits:?}");
            let x = hits.hits[0].point.map(|c| (c - far) / scale);
            assert!(norm(sub(x, [1.0, 0.0, 0.0])) < 1e-6, "{x:?}");
        }
        // Nearly: cut by 1e-7, missed by 1e-7.
        let hits = meet(&unit, &moved(0.5, 1.5 - 1e-7));
        assert_eq!(kinds(&hits), [(Nature::Transversal, 1); 2], "{hits:?}");
        // Within the default tolerance of 1e-7 of the diagonal, and not.
        let hits = meet(&unit, &moved(0.5, 1.5 + 1e-7));
        assert_eq!(kinds(&hits), [(Nature::Tangential, 2)], "{hits:?}");
        assert!((hits.hits[0].distance / scale - 1e-7).abs() < 1e-12 + 1e-15 * far, "{hits:?}");
        let hits = meet(&unit, &moved(0.5, 1.5 + 1e-6));
        assert!(hits.hits.is_empty() && hits.is_complete(), "{hits:?}");
    }
}

#[test]
fn the_same_circle_with_another_start_is_an_overlap() {
    let unit = circle(0.0, 1.0, 1.0);
    let turned = mapped(&circle(0.0, 1.0, 1.0), |x| {
        [0.6 * x[0] - 0.8 * x[1], 0.8 * x[0] + 0.6 * x[1], x[2]]
    });
    let hits = meet(&unit, &turned);
    assert!(hits.is_complete());
    // One piece, or two that meet at a seam.
    assert!(!hits.hits.is_empty() && hits.hits.len() <= 2, "{:?}", hits.hits.len());
    assert!(hits.hits.iter().all(|h| h.nature == Nature::Overlap));
    let covered: f64 = hits.hits.iter().map(|h| h.w_range[1] - h.w_range[0]).sum();
    assert!(covered > 1.0 - 1e-6, "{covered}");
}

#[test]
fn pieces_of_one_line_overlap_where_they_do() {
    let a = line([0.0, 0.0, 0.0], [3.0, 1.0, 2.0]);
    let at = |t: f64| [3.0 * t, t, 2.0 * t];
    let hits = meet(&a, &line(at(0.5), at(2.0)));
    assert_eq!(kinds(&hits), [(Nature::Overlap, 0)], "{hits:?}");
    let hit = &hits.hits[0];
    assert!((hit.u_range[0] - 0.5).abs() < 1e-6 && hit.u_range[1] == 1.0, "{hit:?}");
    assert!(hit.w_range[0] == 0.0 && (hit.w_range[1] - 1.0 / 3.0).abs() < 1e-6, "{hit:?}");
    // End to end.
    let hits = meet(&a, &line(at(1.0), at(2.0)));
    assert_eq!(hits.hits.len(), 1, "{hits:?}");
    assert!(hits.is_complete());
    // Parallel.
    let hits = meet(&a, &line([0.0, 0.0, 1e-3], [3.0, 1.0, 2.001]));
    assert!(hits.hits.is_empty() && hits.is_complete());
}

#[test]
fn skew_lines_meet_within_the_tolerance_only() {
    let a = line([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    let b = line([0.0, -1.0, 1e-4], [0.0, 1.0, 1e-4]);
    assert!(meet(&a, &b).hits.is_empty());
    let options = HitOptions { tolerance: 2e-4, ..HitOptions::default() };
    let hits = a.meet_curve(&b, &options, &mut || false).unwrap();
    assert_eq!(hits.hits.len(), 1, "{hits:?}");
    assert!((hits.hits[0].distance - 1e-4).abs() < 1e-15);
}

#[test]
fn a_figure_eight_is_met_at_its_crossing_by_both_branches() {
    let eight = figure_eight(24);
    let hits = meet(&eight, &line([-0.3, 0.1, 0.0], [0.3, -0.1, 0.0]));
    assert!(hits.is_complete());
    let near = hits.hits.iter().filter(|h| norm(h.point) < 1e-9).count();
    assert!(near >= 2, "{hits:?}");
}

#[test]
fn cubics_meet_in_up_to_nine_points() {
    // y = T3-like curve against its mirror: nine crossings.
    let wave = |f: &dyn Fn(f64, f64) -> Vector| {
        cubic([f(-1.0, -1.0), f(-1.0 / 3.0, 5.0), f(1.0 / 3.0, -5.0), f(1.0, 1.0)])
    };
    let a = wave(&|x, y| [x, y, 0.0]);
    let b = wave(&|x, y| [y, x, 0.0]);
    let hits = meet(&a, &b);
    assert!(hits.is_complete());
    assert_eq!(hits.hits.len(), 9, "{hits:?}");
    assert!(hits.hits.iter().all(|h| h.nature == Nature::Transversal));
}

#[test]
fn a_line_cuts_a_cubic_through_its_inflection_three_times_over() {
    // y = x^3 and y = 0.
    let a =
        cubic([[-1.0, -1.0, 0.0], [-1.0 / 3.0, 1.0, 0.0], [1.0 / 3.0, -1.0, 0.0], [1.0, 1.0, 0.0]]);
    let hits = meet(&a, &line([-1.0, 0.0, 0.0], [1.5, 0.0, 0.0]));
    assert!(hits.is_complete());
    assert_eq!(kinds(&hits), [(Nature::Tangential, 3)], "{hits:?}");
    assert!(norm(hits.hits[0].point) < 1e-2);
}

#[test]
fn curves_cross_touch_and_lie_in_surfaces() {
    let ball = sphere([0.0, 1.0]);
    let ask = |curve: &IndexedCurve| {
        ball.meet_curve(curve, &HitOptions::default(), &mut || false).unwrap()
    };
    let mut random = Random(9);
    for _ in 0..50 {
        let (a, b) = (random.point(1.5), random.point(1.5));
        let hits = ask(&line(a, b));
        assert!(hits.is_complete());
        let d = sub(b, a);
        let (p, q, r) =
            (known_shapes::dot(d, d), known_shapes::dot(a, d), known_shapes::dot(a, a) - 1.0);
        let root = q * q - p * r;
        let wanted: Vec<f64> = if root < 0.0 {
            vec![]
        } else {
            [(-q - root.sqrt()) / p, (-q + root.sqrt()) / p]
                .into_iter()
                .filter(|t| (0.0..=1.0).contains(t))
                .collect()
        };
        assert_eq!(hits.hits.len(), wanted.len(), "{a:?} {b:?} {hits:?}");
        for (hit, t) in hits.hits.iter().zip(wanted) {
            assert!((hit.w - t).abs() < 1e-13 && hit.nature == Nature::Transversal, "{hit:?} {t}");
        }
    }
    // A tangent.
    let hits = ask(&line([1.0, -1.0, 0.3 - 0.3], [1.0, 1.5, 0.0]));
    assert_eq!(kinds(&hits), [(Nature::Tangential, 2)], "{hits:?}");
    // The equator, and a meridian through both poles.
    for up in [false, true] {
        let curve = mapped(&circle(0.0, 1.0, 1.0), |x| if up { [x[0], 0.0, x[1]] } else { x });
        let hits = ask(&curve);
        assert!(hits.is_complete(), "{up} {:?}", hits.undecided.len());
        assert!(hits.hits.iter().all(|h| h.nature == Nature::Overlap), "{up} {:?}", kinds(&hits));
        let covered: f64 = hits.hits.iter().map(|h| h.w_range[1] - h.w_range[0]).sum();
        assert!(covered > 0.99, "{covered}");
    }
}

#[test]
fn a_circle_meets_a_torus_and_a_cylinder() {
    let ring = torus();
    let ask = |curve: &IndexedCurve| {
        ring.meet_curve(curve, &HitOptions::default(), &mut || false).unwrap()
    };
    // A circle in the plane y = 0 around (2, 0, 0) with radius 0.6 meets nothing; shifted by 0.3 twice.
    let around = |d: f64| mapped(&circle(0.0, 1.0, 0.6), move |x| [2.0 + d + x[0], 0.0, x[1]]);
    assert!(ask(&around(0.0)).hits.is_empty());
    let hits = ask(&around(0.3));
    assert_eq!(kinds(&hits), [(Nature::Transversal, 1); 2], "{hits:?}");
    let tube = cylinder([0.0, 1.0]);
    let big = mapped(&circle(0.0, 1.0, 1.25), |x| [x[0], 0.0, x[1]]);
    let hits = tube.meet_curve(&big, &HitOptions::default(), &mut || false).unwrap();
    assert_eq!(kinds(&hits), [(Nature::Transversal, 1); 4], "{hits:?}");
}

#[test]
fn a_spent_budget_says_what_is_open() {
    let unit = circle(0.0, 1.0, 1.0);
    let options = HitOptions { budget: 10, ..HitOptions::default() };
    let hits = unit.meet_curve(&unit, &options, &mut || false).unwrap();
    assert!(!hits.is_complete() && !hits.stopped);
}

/// Whether all hits of `whole` are in `part` or in a box that it lists, each parameter in its own place.
fn check_part(whole: &CurveHits, part: &CurveHits, text: &str) {
    for hit in &whole.hits {
        let is_told = |other: &footpoint::intersect::CurveHit| {
            (other.w - hit.w).abs() < 1e-6 && (other.u - hit.u).abs() < 1e-6
        };
        let holds = |b: &[f64; 6]| {
            [hit.u, hit.v, hit.w]
                .iter()
                .enumerate()
                .all(|(k, x)| b[2 * k] - 1e-9 <= *x && *x <= b[2 * k + 1] + 1e-9)
        };
        assert!(
            part.hits.iter().any(is_told) || part.undecided.iter().any(holds),
            "{text}: {hit:?} is lost"
        );
    }
}

#[test]
fn a_stop_or_a_budget_gives_what_was_found_and_lists_the_rest() {
    let (eight, line) = (figure_eight(24), line([-1.2, -0.3, 0.0], [1.2, 0.31, 0.0]));
    let (ring, rod) = (torus(), self::line([-4.0, 0.1, 0.05], [4.0, 0.2, 0.1]));
    let plane = Quadric::plane([0.1, 0.0, 0.0], [1.0, 0.2, 0.0]).unwrap();
    type Ask<'a> = &'a dyn Fn(&HitOptions, &mut dyn FnMut() -> bool) -> CurveHits;
    let asks: [(&str, Ask); 4] = [
        ("eight, line", &|o, poll| eight.meet_curve(&line, o, poll).unwrap()),
        ("eight, itself", &|o, poll| eight.meet_curve(&circle(0.0, 1.0, 0.6), o, poll).unwrap()),
        ("torus, rod", &|o, poll| ring.meet_curve(&rod, o, poll).unwrap()),
        ("eight, plane", &|o, poll| eight.meet_quadric(&plane, o, poll).unwrap()),
    ];
    let (mut some, mut all) = (0, 0);
    for (name, ask) in asks {
        let mut asked = 0;
        let whole = ask(&HitOptions::default(), &mut || {
            asked += 1;
            false
        });
        assert!(whole.is_complete() && !whole.hits.is_empty(), "{name}");
        for n in (1..=asked).step_by((asked as usize).div_ceil(30)) {
            let mut questions = 0;
            let part = ask(&HitOptions::default(), &mut || {
                questions += 1;
                questions >= n
            });
            assert!(part.stopped && questions == n, "{name}: {questions} of {n}");
            check_part(&whole, &part, &format!("{name}, question {n} of {asked}"));
            some += usize::from(!part.hits.is_empty() && !part.is_complete());
            all += 1;
        }
        for budget in [1, 5, 20, 60] {
            let part = ask(&HitOptions { budget, ..HitOptions::default() }, &mut || false);
            check_part(&whole, &part, &format!("{name}, budget {budget}"));
        }
    }
    assert!(some > 5 && all > 20, "{some} of {all}");
}

/// A part of a curve has the hits of the whole that lie in it, at the whole's parameters; a hit on its end counts.
#[test]
fn a_part_of_a_curve_has_the_hits_that_lie_in_it() {
    let mut random = Random(31);
    let (mut all, mut left) = (0, 0);
    for round in 0..60 {
        let mut free = |flat: bool| {
            let poles = [0; 4].map(|_| {
                let x = random.point(1.0);
                [x[0], x[1], if flat { 0.0 } else { x[2] }]
            });
            cubic(poles)
        };
        // In the plane, and in space against a surface.
        let (a, b, ball) = (free(true), free(true), sphere([0.0, 1.0]));
        let ask = |curve: &IndexedCurve| {
            if round % 2 == 0 {
                meet(&a, curve)
            } else {
                ball.meet_curve(curve, &HitOptions::default(), &mut || false).unwrap()
            }
        };
        let b = if round % 2 == 0 { b } else { mapped(&free(false), |x| x.map(|c| 1.6 * c)) };
        let whole = ask(&b);
        assert!(whole.is_complete());
        let [start, end] = [0.23, 0.71];
        let part = ask(&IndexedCurve::new(b.curve().part(start, end).unwrap()));
        assert!(part.is_complete());
        let inside: Vec<f64> =
            whole.hits.iter().map(|h| h.w).filter(|w| (start..=end).contains(w)).collect();
        let found: Vec<f64> = part.hits.iter().map(|h| h.w).collect();
        assert_eq!(found.len(), inside.len(), "{round} {found:?} {inside:?}");
        assert!(found.iter().zip(&inside).all(|(x, y)| (x - y).abs() < 1e-9), "{round}");
        all += whole.hits.len();
        left += part.hits.len();
        if let Some(hit) = whole.hits.iter().find(|h| h.w > 0.05 && h.w < 0.95) {
            let ends = ask(&IndexedCurve::new(b.curve().part(hit.w, 1.0).unwrap()));
            let near = ends.hits.iter().filter(|h| (h.w - hit.w).abs() < 1e-9).count();
            assert_eq!(near, 1, "{round} {hit:?} {ends:?}");
        }
    }
    assert!(left > 20 && all > left + 10, "{all} {left}");
}
