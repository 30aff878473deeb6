//! Sets on the case folders: the stored parameters of points on seams, collapsed edges and singular places are in the
//! preimage, the stored feet among the extrema.

#[path = "cases/mod.rs"]
mod cases;
mod sets;
mod shapes;

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use cases::{Case, Row};
use footpoint::closest::QueryOptions;
use footpoint::extrema::ExtremaOptions;
use footpoint::set::{FootSet, Kind, Member};
use sets::{Asked, complaint, extrema, preimage};
use shapes::asked::Shape;
use shapes::{norm, sub};

/// Classes that ask for more than one parameter.
const CLASSES: [&str; 3] = ["seam", "pole", "sing"];

#[derive(Default)]
struct Tally {
    asked: usize,
    undecided: usize,
    wrong: Vec<String>,
}

impl Tally {
    fn put(&mut self, set: &FootSet, broken: Option<String>) {
        self.asked += 1;
        self.undecided += usize::from(!set.is_complete());
        self.wrong.extend(broken);
    }
}

/// Runs through all rows of the classes with all cores.
fn every(check: impl Fn(&Case, &Shape, &Row, &mut Tally) + Sync) -> Tally {
    let (folders, next) = (cases::folders(), AtomicUsize::new(0));
    let all = Mutex::new(Tally::default());
    let work = || {
        while let Some(folder) = folders.get(next.fetch_add(1, Ordering::Relaxed)) {
            let (case, shape) = taken_apart(cases::read(folder));
            let mut tally = Tally::default();
            for row in case.rows.iter().filter(|row| CLASSES.contains(&row.class.as_str())) {
                check(&case, &shape, row, &mut tally);
            }
            let mut sum = all.lock().expect("a tally");
            sum.asked += tally.asked;
            sum.undecided += tally.undecided;
            sum.wrong.extend(tally.wrong);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(work);
        }
    });
    all.into_inner().expect("a tally")
}

/// The case with its shape as the other tests know it.
fn taken_apart(mut case: Case) -> (Case, Shape) {
    let empty = footpoint::curve::Curve::new(&[0., 0., 1., 1.], 1, &[[0.; 3], [1.; 3]], None);
    let empty = cases::Shape::Curve(footpoint::index::IndexedCurve::new(empty.expect("a line")));
    let shape = match std::mem::replace(&mut case.shape, empty) {
        cases::Shape::Curve(curve) => Shape::Curve(curve),
        cases::Shape::Surface(surface) => Shape::Surface(surface),
    };
    (case, shape)
}

fn place(row: &Row) -> [f64; 2] {
    row.place.map(|x| x.unwrap_or(0.0))
}

fn is_inside(interval: [f64; 2], x: f64, slack: f64) -> bool {
    interval[0] - slack <= x && x <= interval[1] + slack
}

fn holds(m: &Member, at: [f64; 2], slack: f64) -> bool {
    is_inside(m.u, at[0], slack) && is_inside(m.v, at[1], slack)
}

/// A tolerance that the stored distance leaves room in.
fn tolerance(case: &Case, row: &Row) -> f64 {
    row.distance + 1e-7 * case.diagonal
}

fn close(name: &str, tally: Tally, most_undecided: f64) {
    let (asked, undecided, wrong) = (tally.asked, tally.undecided, tally.wrong.len());
    println!("{name}: {asked} asked, {wrong} wrong, {undecided} with undecided boxes");
    let first = tally.wrong.iter().take(8).cloned().collect::<Vec<_>>().join("\n");
    assert!(wrong == 0, "{name}: {wrong} of {asked} wrong, the first are\n{first}");
    assert!(asked > 0 && undecided as f64 <= most_undecided * asked as f64);
}

/// Only queries on the shape: farther ones have a whole disc within the tolerance.
#[test]
fn stored_parameters_are_in_the_preimage() {
    let tally = every(|case, shape, row, tally| {
        if row.distance > 1e-6 * case.diagonal {
            return;
        }
        let limit = tolerance(case, row);
        let set = preimage(shape, row.query, limit, &QueryOptions::default());
        let at = place(row);
        let stored = shape.evaluate(at);
        let rounding = 4e-15 * (case.magnitude + case.diagonal);
        // Stored digits may put the place outside.
        let is_on = norm(sub(stored, row.query)) <= limit;
        let found = set.members.iter().any(|m| holds(m, at, 0.0))
            || set.undecided.iter().any(|b| {
                is_inside([b[0], b[1]], at[0], 0.0) && is_inside([b[2], b[3]], at[1], 0.0)
            });
        let far =
            set.members.iter().find(|m| norm(sub(m.foot.point, row.query)) > limit + rounding);
        let text = |what: &str| format!("{} {} {row:?} {what}: {set:?}", case.name, row.class);
        let broken = if is_on && !found {
            Some(text("misses the stored place"))
        } else if let Some(m) = far {
            Some(text(&format!("is too far: {m:?}")))
        } else {
            complaint(shape, &set, &Asked::Preimage(row.query)).map(|c| text(&c))
        };
        tally.put(&set, broken);
    });
    close("preimages", tally, 0.02);
}

/// The nearest of the minima has the stored distance.
#[test]
fn stored_feet_are_among_the_minima() {
    let tally = every(|case, shape, row, tally| {
        let options = ExtremaOptions { minima_only: true, ..ExtremaOptions::default() };
        let set = extrema(shape, row.query, &options);
        let rounding =
            4e-15 * (case.magnitude + row.query.iter().fold(0.0, |m: f64, x| m.max(x.abs())));
        let limit = 1e-9 * case.diagonal + rounding;
        let at = place(row);
        let near = |m: &Member| {
            let point = norm(sub(m.foot.point, shape.evaluate(at)));
            (m.foot.distance - row.distance).abs() <= limit
                && (point <= 1e-4 * case.diagonal || (m.kind != Kind::Point && holds(m, at, 1e-6)))
        };
        let least = set.members.first().map_or(f64::INFINITY, |m| m.foot.distance);
        let found = set.members.iter().any(near)
            || set.undecided.iter().any(|b| {
                is_inside([b[0], b[1]], at[0], 0.0) && is_inside([b[2], b[3]], at[1], 0.0)
            });
        let text = |what: &str| {
            format!(
                "{} {} {row:?} {what}: {:?} {:?}",
                case.name, row.class, set.members, set.undecided
            )
        };
        let broken = if set.is_complete() && least > row.distance + limit {
            Some(text("the nearest is too far"))
        } else if !found {
            // Another foot of the same distance may be the stored one's equal.
            (least > row.distance + limit || least < row.distance - limit)
                .then(|| text("no stored foot"))
        } else {
            complaint(shape, &set, &Asked::Extrema(row.query)).map(|c| text(&c))
        };
        tally.put(&set, broken);
    });
    close("extrema", tally, 0.05);
}
