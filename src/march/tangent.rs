//! Curves along which the surfaces touch: followed from touching place to touching place, along the direction in which they bend
//! alike.
//!
//! Each place is a stationary point of the gap (`contact`), found by Newton to the last digits; the step is the size of the boxes
//! in which touching was seen. Not proven: the arithmetic cannot tell touching from a gap below its rounding.

use super::contact::{Touch, into_domain, settle};
use super::join::{Place, Stop, distance_to_chord};
use super::search::{Open, Search};
use super::watch::Watch;
use crate::bounds::{Vector, add, dot, norm, scaled, sub};

/// Most steps along one curve.
const MOST_STEPS: usize = 20_000;

/// A touching curve that is shorter and ends inside both surfaces is a contact.
const CUSP: f64 = 1e-3;

/// A tangential curve.
pub struct Ridge {
    /// Places in order.
    pub places: Vec<Place>,
    /// Its ends.
    pub stops: [Stop; 2],
}

struct Tracer<'a, 'b, 'w> {
    search: &'a Search<'b>,
    chord: f64,
    watch: &'a Watch<'w>,
}

impl Tracer<'_, '_, '_> {
    fn place(&self, touch: &Touch) -> Place {
        let at = touch.at;
        let x = self.search.surfaces[0].evaluate(at[0], at[1]);
        let y = self.search.surfaces[1].evaluate(at[2], at[3]);
        Place { x: scaled(add(x, y), 0.5), at }
    }

    /// The touching place near a start, when the surfaces do touch there.
    fn touch(&self, start: [f64; 4], reach: f64) -> Option<Touch> {
        let [a, b] = self.search.surfaces;
        let touch = settle(a, b, start, reach)?;
        let at = touch.at;
        let apart = norm(sub(a.evaluate(at[0], at[1]), b.evaluate(at[2], at[3])));
        let floor = self.search.touching_gap(4.0);
        (touch.gap.abs() <= floor && apart <= floor && touch.rank() == 1).then_some(touch)
    }

    /// The next touching place along `along`, at most `h` away; and whether a border ends it.
    fn step(&self, from: &Touch, along: Vector, h: f64) -> Option<(Touch, bool)> {
        let sign = dot(from.direction[1], along).signum();
        let to = |h: f64| {
            let move_ = [0, 1].map(|k| from.at[k] + sign * h * from.step[1][k]);
            let inside = into_domain(self.search.surfaces[0], move_) == move_;
            let touch = inside
                .then(|| self.touch([move_[0], move_[1], from.at[2], from.at[3]], 2.0 * h))
                .flatten();
            touch.filter(|t| dot(sub(self.place(t).x, self.place(from).x), along) > 0.0)
        };
        if let Some(touch) = to(h) {
            return Some((touch, false));
        }
        let (mut low, mut high, mut best) = (0.0, h, None);
        for _ in 0..48 {
            let middle = 0.5 * (low + high);
            match to(middle) {
                Some(touch) => (low, best) = (middle, Some(touch)),
                None => high = middle,
            }
        }
        best.map(|touch| (touch, true))
    }

    fn side(&self, at: [f64; 4]) -> Option<usize> {
        let [a, b] = self.search.surfaces;
        let (da, db) = (a.domain(), b.domain());
        let ends = [da[0], da[1], da[2], da[3], db[0], db[1], db[2], db[3]];
        (0..8).find(|&side| {
            (at[side / 2] - ends[side]).abs() <= 1e-7 * (ends[side | 1] - ends[side & !1])
        })
    }

    /// Places from `first` on, without it.
    fn run(&self, first: Touch, along: Vector, h: f64) -> (Vec<Touch>, Stop) {
        let (mut at, mut along, mut all) = (first, along, Vec::new());
        let origin = self.place(&first).x;
        while all.len() < MOST_STEPS && !self.watch.stops(0) {
            let here = self.place(&at).x;
            let Some((next, ended)) = self.step(&at, along, h) else {
                return (all, self.side(at.at).map_or(Stop::Open, Stop::Border));
            };
            let there = self.place(&next).x;
            let step = sub(there, here);
            if all.len() > 1
                && distance_to_chord(origin, here, there) < 0.05 * h
                && dot(sub(origin, here), step) > 0.0
            {
                all.push(first);
                return (all, Stop::Closed);
            }
            all.push(next);
            if ended {
                return (all, self.side(next.at).map_or(Stop::Open, Stop::Border));
            }
            let sign = dot(next.direction[1], step).signum();
            along = scaled(next.direction[1], sign);
            at = next;
        }
        (all, Stop::Open)
    }

    /// Places between two, until the chords are near enough.
    fn fill(&self, from: Place, to: Place, depth: u32, out: &mut Vec<Place>) {
        let middle = [0, 1, 2, 3].map(|k| 0.5 * (from.at[k] + to.at[k]));
        let h = norm(sub(to.x, from.x));
        let Some(touch) = self.touch(middle, h).filter(|_| depth < 12) else { return };
        if self.watch.stops(0) {
            return;
        }
        let place = self.place(&touch);
        if distance_to_chord(place.x, from.x, to.x) <= 0.5 * self.chord {
            return;
        }
        self.fill(from, place, depth + 1, out);
        out.push(place);
        self.fill(place, to, depth + 1, out);
    }

    fn ridge(&self, first: Touch, h: f64) -> Ridge {
        let along = first.direction[1];
        let (ahead, end) = self.run(first, along, h);
        let mut all = vec![first];
        let mut stops = [end; 2];
        if end != Stop::Closed {
            let (behind, start) = self.run(first, scaled(along, -1.0), h);
            stops[0] = start;
            all = behind.into_iter().rev().chain(all).collect();
        }
        all.extend(ahead);
        let coarse: Vec<Place> = all.iter().map(|t| self.place(t)).collect();
        let mut places = vec![coarse[0]];
        for pair in coarse.windows(2) {
            self.fill(pair[0], pair[1], 0, &mut places);
            places.push(pair[1]);
        }
        Ridge { places, stops }
    }
}

/// Whether a place is within `reach` of a list of places joined by chords.
pub fn is_near(x: Vector, places: &[Place], reach: f64) -> bool {
    places.windows(2).any(|pair| distance_to_chord(x, pair[0].x, pair[1].x) <= reach)
}

/// Middles of the pairs in which touching along a curve was seen and no curve runs.
pub fn unfollowed(search: &Search, ridges: &[Ridge]) -> Vec<[f64; 4]> {
    let pairs = search.open.iter().filter(|pair| pair.why == Open::Curve);
    let middles = pairs.map(|pair| {
        let at = [0, 1, 2, 3].map(|k| 0.5 * (pair.low[k] + pair.high[k]));
        (at, search.surfaces[0].evaluate(at[0], at[1]), pair.size)
    });
    let is_followed = |x: Vector, size: f64| ridges.iter().any(|r| is_near(x, &r.places, size));
    middles.filter(|&(_, x, size)| !is_followed(x, size)).map(|(at, ..)| at).collect()
}

/// All curves of touching, from the pairs in which it was seen.
pub fn ridges(search: &Search, chord: f64, watch: &Watch) -> Vec<Ridge> {
    let tracer = Tracer { search, chord, watch };
    let mut found: Vec<Ridge> = Vec::new();
    for pair in search.open.iter().filter(|pair| pair.why == Open::Curve) {
        if watch.stops(0) {
            break;
        }
        let middle = [0, 1, 2, 3].map(|k| 0.5 * (pair.low[k] + pair.high[k]));
        let Some(touch) = tracer.touch(middle, pair.size) else { continue };
        let x = tracer.place(&touch).x;
        if found.iter().any(|ridge| is_near(x, &ridge.places, 0.25 * pair.size)) {
            continue;
        }
        found.push(tracer.ridge(touch, 0.5 * pair.size));
    }
    // A short one that ends inside is where branches come together to the last digits: a cusp.
    let is_short = |ridge: &Ridge| {
        let far = |place: &Place| norm(sub(place.x, ridge.places[0].x));
        ridge.stops.contains(&Stop::Open) && ridge.places.iter().map(far).fold(0.0, f64::max) < CUSP
    };
    found.retain(|ridge| !is_short(ridge));
    found
}
