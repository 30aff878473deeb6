//! Many queries on a curve at once.

use crate::bounds::{Vector, norm, sub};
use crate::closest::lockstep::{
    Begin, CurveMemory, FAR, Fate, Flight, Landing, Left, NOWHERE, rows,
};
use crate::closest::settle::settled_on_curve_together;
use crate::closest::sought::{Outcome, Sought};
use crate::closest::{
    FootPoint, QueryOptions, Scope, Workspace, bounded, distance, flag, is_bad, mark_inversion,
    rounding_floor,
};
use crate::index::{Across, CurveIndex, CurveReach, IndexedCurve, position_error};
use crate::refine::{Approach, Method, is_inside};
use crate::simd::{MOST_DEGREE, WIDTH, row};

/// What is asked of a query, by its number.
pub type Asked<'a> = &'a dyn Fn(usize) -> (Vector, Option<[f64; 1]>);

impl IndexedCurve {
    /// As [`Self::closest`] for the queries 0, 1, ... of `out`, bit for bit, in less time.
    ///
    /// `asked` tells a query and its hint. No memory is asked for once the workspace has held as many queries.
    pub fn closest_together(
        &self,
        asked: Asked,
        options: &QueryOptions,
        workspace: &mut Workspace,
        out: &mut [FootPoint],
    ) {
        let memory = workspace.lockstep.curve.get_or_insert_default();
        let mut alone = std::mem::take(&mut memory.alone);
        alone.clear();
        if !self.fly(asked, options, memory, &mut alone, out) {
            for (number, foot) in out.iter_mut().enumerate() {
                let (query, hint) = asked(number);
                *foot = self.closest(query, hint.map(|[u]| u), options, workspace, None);
            }
        }
        if let Ok(index) = self.index(&mut || false) {
            self.go_alone(index, asked, &alone, options, workspace, out);
        }
        workspace.lockstep.curve.get_or_insert_default().alone = alone;
    }

    /// Answers those that lanes have left, one by one; the points of their records are made together.
    fn go_alone(
        &self,
        index: &CurveIndex,
        asked: Asked,
        alone: &[(usize, Option<Left<f64>>)],
        options: &QueryOptions,
        workspace: &mut Workspace,
        out: &mut [FootPoint],
    ) {
        let mut found = [(0, Sought::default()); WIDTH];
        let mut count = 0;
        for (k, &(number, left)) in alone.iter().enumerate() {
            let (query, hint) = asked(number);
            if is_bad(query) {
                out[number] = FootPoint::bad_query();
            } else {
                let hint = hint.map(|[u]| u).filter(|u| u.is_finite());
                let begin = left.map_or_else(|| Begin::at(hint), Begin::On);
                match self.seek(index, query, begin, None, options, workspace, None) {
                    Outcome::Record(foot) => out[number] = foot,
                    Outcome::Place(sought) => {
                        found[count] = (number, sought);
                        count += 1;
                    }
                }
            }
            if count == WIDTH || k + 1 == alone.len() {
                self.record_together(index, asked, &found[..count], options, out);
                count = 0;
            }
        }
    }

    /// The records of up to [`WIDTH`] places that were found.
    fn record_together(
        &self,
        index: &CurveIndex,
        asked: Asked,
        found: &[(usize, Sought<f64>)],
        options: &QueryOptions,
        out: &mut [FootPoint],
    ) {
        if found.is_empty() {
            return;
        }
        let at = row(found, |(_, sought)| sought.at);
        let points = self.curve().evaluate_together(&at, index.grid.level);
        for (q, &(number, sought)) in found.iter().enumerate() {
            let (query, _) = asked(number);
            let point = points.map(|row| row[q]);
            let foot = self.foot_with(index, query, sought.at, point, self.range(options));
            out[number] = self.record(index, query, options, &sought, foot);
        }
    }

    /// As [`Self::invert`] for each, see [`Self::closest_together`].
    pub fn invert_together(
        &self,
        asked: Asked,
        options: &QueryOptions,
        workspace: &mut Workspace,
        out: &mut [FootPoint],
    ) {
        self.closest_together(asked, options, workspace, out);
        if let Ok(index) = self.index(&mut || false) {
            let tolerance = options.tolerance(&index.frame);
            for foot in out.iter_mut().filter(|foot| foot.distance.is_finite()) {
                mark_inversion(foot, tolerance);
            }
        }
    }

    /// Answers what lanes can and notes the rest; false where that is all.
    fn fly(
        &self,
        asked: Asked,
        options: &QueryOptions,
        memory: &mut CurveMemory,
        alone: &mut Vec<(usize, Option<Left<f64>>)>,
        out: &mut [FootPoint],
    ) -> bool {
        let Ok(index) = self.index(&mut || false) else { return false };
        let Some(reach) = &index.reach else { return false };
        let plain = options.scope == Scope::Global
            && options.method == Method::Auto
            && options.domain.is_none();
        if out.len() < 2 || !plain || index.analytic.is_some() || index.degree() > MOST_DEGREE {
            return false;
        }
        memory.flights.clear();
        for number in 0..out.len() {
            match self.launch(index, asked(number), options, number) {
                Ok(flight) => memory.flights.push(flight),
                Err(left) => alone.push((number, left)),
            }
        }
        while !memory.flights.is_empty() {
            memory.landings.clear();
            advance(index, memory, alone);
            for k in (0..memory.landings.len()).step_by(WIDTH) {
                let end = memory.landings.len().min(k + WIDTH);
                self.settle(index, reach, [k, end], memory, asked, options, alone, out);
            }
        }
        true
    }

    /// A query at its start; or where it begins alone, when that is not inside of a piece.
    fn launch(
        &self,
        index: &CurveIndex,
        (query, hint): (Vector, Option<[f64; 1]>),
        options: &QueryOptions,
        number: usize,
    ) -> Result<Flight<f64>, Option<Left<f64>>> {
        if is_bad(query) {
            return Err(None);
        }
        let search = self.search(index, query, options, Self::floor(index, query));
        let hint = hint.map(|[u]| u).filter(|u| u.is_finite());
        let place = hint.map(|at| search.hinted(at)).or_else(|| search.near());
        let (piece, at) = place.ok_or(None)?;
        let is_hinted = hint.is_some();
        if !is_inside(at) || norm(search.query) > FAR {
            let approach = Approach::new(at);
            return Err(Some(Left { piece, approach, is_hinted }));
        }
        let segment = &index.segments[piece];
        let q = sub(search.query, segment.center);
        let sizes = [norm(q), norm(search.query)];
        let position =
            position_error(search.steps, index.is_rational(), segment.radius, sizes[0], sizes[1]);
        Ok(Flight {
            number,
            piece,
            at,
            query: q,
            position,
            worth: None,
            step: None,
            taken: 0,
            is_foot: false,
            is_hinted,
        })
    }

    /// Settles landings `first..end` and makes their records; those whose foot is to be looked at fly on.
    #[allow(clippy::too_many_arguments)]
    fn settle(
        &self,
        index: &CurveIndex,
        reach: &CurveReach,
        [first, end]: [usize; 2],
        memory: &mut CurveMemory,
        asked: Asked,
        options: &QueryOptions,
        alone: &mut Vec<(usize, Option<Left<f64>>)>,
        out: &mut [FootPoint],
    ) {
        let landings = &memory.landings[first..end];
        let parameter = |landing: &Landing<f64, 2>| {
            index.segments[landing.flight.piece].u.global(landing.flight.at)
        };
        let at = row(landings, parameter);
        let points = self.curve().evaluate_together(&at, index.grid.level);
        let landed = &mut memory.landed;
        landed.jets = [0, 1].map(|k| rows(landings, |landing| landing.jet[k]));
        landed.w = row(landings, |landing| landing.w);
        landed.position = row(landings, |landing| landing.flight.position);
        for (q, landing) in landings.iter().enumerate() {
            let Across { axis, bends } = reach.across(landing.flight.piece, landing.seen);
            (0..3).for_each(|c| landed.across.axis[c][q] = axis[c]);
            (0..4).for_each(|k| landed.across.bends[k][q] = bends[k]);
        }
        let bounds = settled_on_curve_together(reach, landed, index.degree(), index.grid.level);
        for (q, (landing, bound)) in landings.iter().zip(bounds).enumerate() {
            let flight = landing.flight;
            let (query, _) = asked(flight.number);
            let [gap, allowed] = self.gaps(index, query, options);
            let Some([bound, _]) = bound.filter(|[bound, d]| *bound >= d - gap) else {
                if landing.seen == flight.at {
                    alone.push(flight.left(true));
                } else {
                    memory.flights.push(Flight { is_foot: true, worth: None, ..flight });
                }
                continue;
            };
            let u = at[q];
            let mut foot = if index.segments[flight.piece].u.holds(u) {
                let point = points.map(|row| row[q]);
                FootPoint { u, v: 0.0, point, distance: distance(query, point), ..NOWHERE }
            } else {
                let (first, last) = self.curve().domain();
                self.foot_at(index, query, u, [first, last])
            };
            bounded(&mut foot, bound.max(0.0), &index.frame, allowed);
            if foot.flags & flag::NOT_PROVEN != 0 {
                alone.push((flight.number, None));
                continue;
            }
            foot.iterations = flight.taken;
            foot.flags |= if flight.is_hinted { flag::HINT_USED } else { 0 };
            out[flight.number] = foot;
        }
    }

    /// The gap that is left to a search, in the index's lengths, and the one that is allowed.
    fn gaps(&self, index: &CurveIndex, query: Vector, options: &QueryOptions) -> [f64; 2] {
        let floor = Self::floor(index, query);
        let gap = options.accuracy(&index.frame).max(floor);
        let allowed = gap.max(floor + rounding_floor(&index.frame, query, 0.0));
        [0.5 * gap * index.frame.scale, allowed]
    }
}

/// One step of every query on its way.
fn advance(
    index: &CurveIndex,
    memory: &mut CurveMemory,
    alone: &mut Vec<(usize, Option<Left<f64>>)>,
) {
    let CurveMemory { flights, landings, jets, steps, .. } = memory;
    let level = index.grid.level;
    let mut kept = 0;
    for first in (0..flights.len()).step_by(WIDTH) {
        let count = (flights.len() - first).min(WIDTH);
        let chunk = &flights[first..first + count];
        let mut nets = [&[][..]; WIDTH];
        for (net, flight) in nets.iter_mut().zip(chunk) {
            *net = index.net(flight.piece).lanes;
        }
        let at = row(chunk, |flight| flight.at);
        jets.look(index.degree(), &nets[..count], &at, level);
        steps.take(jets, &rows(chunk, |flight| flight.query), index.is_rational(), level);
        for q in 0..count {
            let mut flight = flights[first + q];
            let seen = flight.at;
            flight.taken += 1;
            if flight.worth.is_some_and(|before| !steps.is_better(q, before)) {
                alone.push((flight.number, None));
                continue;
            }
            let fate = if flight.is_foot {
                Fate::Landed
            } else {
                flight.follow(steps.course(q, seen, flight.step), steps.worth(q))
            };
            match fate {
                Fate::Alone => alone.push(flight.left(false)),
                Fate::Flies => {
                    flights[kept] = flight;
                    kept += 1;
                }
                Fate::Landed => {
                    let jet = steps.jets.each_ref().map(|jet| jet.map(|row| row[q]));
                    landings.push(Landing { flight, seen, jet, w: steps.w[q] });
                }
            }
        }
    }
    flights.truncate(kept);
}
