//! Every case with a proven distance: nothing farther than the truth, no bound above it, and how much is proven.
//!
//! The cases are those of `../shared/cases` when they are there, the committed selection in `tests/data` otherwise.
//! Each query is asked twice, with an accuracy of 1e-9 of the diagonal and with the default one.

#[path = "cases/mod.rs"]
mod cases;

use std::collections::BTreeMap;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use cases::{Case, Row, Shape};
use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag, rounding_floor};
use footpoint::index::{position_error, position_steps};

/// A case and its feet, row by row.
struct Answered {
    case: Case,
    /// With an accuracy of 1e-9 of the diagonal.
    feet: Vec<FootPoint>,
    /// With the default accuracy.
    fine: Vec<FootPoint>,
}

/// All cases, each asked once for all tests of this file, over all cores.
fn answered() -> &'static [Answered] {
    static ALL: OnceLock<Vec<Answered>> = OnceLock::new();
    ALL.get_or_init(|| {
        let folders = cases::folders();
        assert!(folders.len() >= 20, "only {} cases", folders.len());
        let (next, threads) =
            (AtomicUsize::new(0), std::thread::available_parallelism().map_or(2, usize::from));
        let work = || {
            let mut done = Vec::new();
            while let Some(folder) = folders.get(next.fetch_add(1, Ordering::Relaxed)) {
                done.push(answer(cases::read(folder)));
            }
            done
        };
        std::thread::scope(|scope| {
            let handles: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
            handles.into_iter().flat_map(|handle| handle.join().expect("a worker")).collect()
        })
    })
}

fn answer(case: Case) -> Answered {
    let mut workspace = Workspace::default();
    let mut ask = |accuracy: f64| {
        let options = QueryOptions { accuracy, ..QueryOptions::default() };
        let foot = |row: &Row| match &case.shape {
            Shape::Curve(shape) => shape.closest(row.query, None, &options, &mut workspace, None),
            Shape::Surface(shape) => shape.closest(row.query, None, &options, &mut workspace, None),
        };
        case.rows.iter().map(foot).collect()
    };
    let (feet, fine) = (ask(1e-9 * case.diagonal), ask(0.0));
    Answered { case, feet, fine }
}

/// All answers with their case and row; `true` with those of the default accuracy.
fn every() -> impl Iterator<Item = (&'static Case, &'static Row, &'static FootPoint, bool)> {
    answered().iter().flat_map(|a| {
        let pairs = |feet: &'static [FootPoint], fine: bool| {
            a.case.rows.iter().zip(feet).map(move |(row, foot)| (&a.case, row, foot, fine))
        };
        pairs(&a.feet, false).chain(pairs(&a.fine, true))
    })
}

/// Fails with the number of broken rows and the first of them.
fn check(law: impl Fn(&Case, &Row, &FootPoint, bool) -> bool) {
    let broken: Vec<_> =
        every().filter(|(case, row, foot, fine)| !law(case, row, foot, *fine)).collect();
    let first: Vec<String> = broken
        .iter()
        .take(12)
        .map(|(case, row, foot, _)| {
            let (name, class) = (&case.name, &row.class);
            format!(
                "{name} {class} {:?} {:?} truth {:e}: {foot:?}",
                row.query, row.place, row.distance
            )
        })
        .collect();
    assert!(broken.is_empty(), "{} answers, of them\n{}", broken.len(), first.join("\n"));
}

/// What double precision cannot tell apart at this row.
fn rounding(case: &Case, row: &Row) -> f64 {
    let largest = row.query.iter().fold(case.magnitude, |m, x| m.max(x.abs()));
    4e-15 * (largest + row.distance)
}

/// u0, u1 and for surfaces v0, v1.
fn domain(shape: &Shape) -> [f64; 4] {
    match shape {
        Shape::Curve(curve) => {
            let (first, last) = curve.curve().domain();
            [first, last, 0.0, 0.0]
        }
        Shape::Surface(surface) => surface.surface().domain(),
    }
}

/// The documented floor of a shape and query, and the sum of the degrees.
fn floor(case: &Case, row: &Row) -> (f64, usize) {
    let (frame, degrees) = match &case.shape {
        Shape::Curve(curve) => {
            let index = curve.index(&mut || false).expect("an index");
            (&index.frame, curve.curve().degree())
        }
        Shape::Surface(surface) => {
            let index = surface.index(&mut || false).expect("an index");
            (&index.frame, index.degree.s + index.degree.t)
        }
    };
    let away = frame.enter(row.query).iter().map(|x| x * x).sum::<f64>().sqrt();
    let position = position_error(position_steps(degrees), true, 2.0, away + 2.0, away);
    (rounding_floor(frame, row.query, position), degrees)
}

#[test]
fn no_answer_is_farther_than_the_truth() {
    check(|case, row, foot, _| {
        foot.distance <= row.distance + 1e-9 * case.diagonal + rounding(case, row)
    });
}

#[test]
fn no_bound_is_above_the_truth_nor_above_the_distance() {
    check(|case, row, foot, _| {
        let truth = row.distance + 1e-12 * case.diagonal + rounding(case, row);
        foot.lower_bound >= 0.0 && foot.lower_bound <= truth && foot.lower_bound <= foot.distance
    });
}

#[test]
fn the_point_is_the_evaluation_and_the_distance_its_norm_bit_for_bit() {
    check(|case, row, foot, _| {
        let point = match &case.shape {
            Shape::Curve(curve) => curve.curve().evaluate(foot.u),
            Shape::Surface(surface) => surface.surface().evaluate(foot.u, foot.v),
        };
        let away = (0..3).map(|k| row.query[k] - foot.point[k]);
        let norm = away.fold(0.0, |norm: f64, x| norm.hypot(x));
        point.map(f64::to_bits) == foot.point.map(f64::to_bits)
            && (foot.distance - norm).abs() <= 4.0 * f64::EPSILON * norm
    });
}

#[test]
fn parameters_never_leave_the_domain() {
    check(|case, _, foot, _| {
        let [u0, u1, v0, v1] = domain(&case.shape);
        (u0..=u1).contains(&foot.u) && (v0..=v1).contains(&foot.v)
    });
}

#[test]
fn an_answer_is_marked_as_not_proven_exactly_when_its_gap_says_so() {
    check(|case, row, foot, fine| {
        let (floor, degrees) = floor(case, row);
        let size = case.diagonal + case.magnitude + row.distance;
        let asked = case.diagonal * if fine { 1e-10 } else { 1e-9 };
        let open = foot.distance - foot.lower_bound > asked.max(floor) * (1.0 + 1e-12);
        let closed = foot.distance - foot.lower_bound <= asked.max(floor) * (1.0 - 1e-12);
        let marked = foot.flags & flag::NOT_PROVEN != 0;
        floor <= 1e-13 * (degrees + 1) as f64 * size && !(open && !marked) && !(closed && marked)
    });
}

#[test]
fn the_flags_of_the_place_say_where_the_parameters_are() {
    check(|case, _, foot, _| {
        let [u0, u1, v0, v1] = domain(&case.shape);
        let has = |bit: u32| foot.flags & bit != 0;
        let on = [foot.u == u0, foot.u == u1, foot.v == v0, foot.v == v1];
        let (in_u, in_v) = (on[0] || on[1], on[2] || on[3]);
        match &case.shape {
            Shape::Curve(curve) => {
                has(flag::EDGE) == in_u
                    && has(flag::SEAM) == (in_u && curve.curve().is_closed())
                    && !has(flag::CORNER | flag::COLLAPSED)
            }
            Shape::Surface(surface) => {
                let surface = surface.surface();
                let closed = [surface.is_closed_u(), surface.is_closed_v()];
                let collapsed = surface.collapsed_edges();
                has(flag::EDGE) == (in_u || in_v)
                    && has(flag::CORNER) == (in_u && in_v)
                    && has(flag::SEAM) == ((in_u && closed[0]) || (in_v && closed[1]))
                    && has(flag::COLLAPSED) == (0..4).any(|k| on[k] && collapsed[k])
            }
        }
    });
}

/// Off the shape, so that rounding of the query cannot move the foot into the inside; and on edges that are
/// collapsed exactly (where an edge of CAD data is open by a billionth, its neighbourhood is as near as itself).
#[test]
fn a_foot_on_the_border_is_found_there_and_flagged() {
    check(|case, row, foot, _| {
        if row.distance <= 1e-6 * case.diagonal {
            return true;
        }
        let [u0, u1, v0, v1] = domain(&case.shape);
        let [u, v] = row.place;
        let on = [u == Some(u0), u == Some(u1), v == Some(v0), v == Some(v1)];
        let collapsed = |k: usize| match &case.shape {
            Shape::Curve(_) => false,
            Shape::Surface(shape) => {
                let surface = shape.surface();
                surface.collapsed_edges()[k] && surface.collapsed_spread(k) == 0.0
            }
        };
        let bit = match row.class.as_str() {
            "edge" if on.contains(&true) => flag::EDGE,
            "pole" if (0..4).any(|k| on[k] && collapsed(k)) => flag::COLLAPSED,
            _ => 0,
        };
        foot.flags & bit == bit
    });
}

/// Not proven answers and all answers, by `key`.
fn unproven(
    fine: bool,
    key: impl Fn(&'static Case, &'static Row) -> &'static str,
) -> BTreeMap<&'static str, (usize, usize)> {
    let mut shares = BTreeMap::new();
    for (case, row, foot, is_fine) in every() {
        if is_fine == fine {
            let (open, all) = shares.entry(key(case, row)).or_insert((0, 0));
            *open += usize::from(foot.flags & flag::NOT_PROVEN != 0);
            *all += 1;
        }
    }
    shares
}

fn print(title: &str, shares: &BTreeMap<&'static str, (usize, usize)>) {
    let open: usize = shares.values().map(|(open, _)| open).sum();
    let all: usize = shares.values().map(|(_, all)| all).sum();
    println!("{title}: {open} of {all} not proven");
    for (key, (open, all)) in shares.iter().filter(|(_, (open, _))| *open > 0) {
        println!("  {key}: {open} of {all}");
    }
}

#[test]
fn at_most_one_answer_in_a_thousand_of_each_class_is_not_proven_and_none_of_the_simple_classes() {
    let shares = unproven(false, |_, row| row.class.as_str());
    print("by class, accuracy 1e-9 of the diagonal", &shares);
    for (class, (open, all)) in shares {
        let most =
            if ["on", "near", "edge", "far"].contains(&class) { 0 } else { all.div_ceil(1000) };
        assert!(open <= most, "{class}: {open} of {all} not proven");
    }
}

#[test]
fn at_most_one_answer_in_a_hundred_of_each_case_is_not_proven() {
    let shares = unproven(false, |case, _| case.name.as_str());
    print("by case, accuracy 1e-9 of the diagonal", &shares);
    for (case, (open, all)) in shares {
        assert!(open <= all / 100, "{case}: {open} of {all} not proven");
    }
}

#[test]
fn with_the_default_accuracy_too_at_most_one_answer_in_a_hundred_of_each_case_is_not_proven() {
    let shares = unproven(true, |case, _| case.name.as_str());
    print("by case, default accuracy", &shares);
    print("by class, default accuracy", &unproven(true, |_, row| row.class.as_str()));
    for (case, (open, all)) in shares {
        assert!(open <= all / 100, "{case}: {open} of {all} not proven");
    }
}
