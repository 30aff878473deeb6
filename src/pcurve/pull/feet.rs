//! Feet along an edge: samples whose parameters go on over seams.

use super::Puller;
use crate::bounds::{Vector, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Scope};
use crate::error::Error;
use crate::unwrap::{PathOutput, change};

/// Samples of a span of the edge and of the whole edge at the beginning, at least.
const SPAN_SAMPLES: usize = 6;
const LEAST_SAMPLES: usize = 32;

/// Most samples at the beginning.
const MOST_SAMPLES: usize = 20_000;

/// Rounds in which wide steps are halved; the last ones are a 2^-16th of the first.
const ROUNDS: usize = 16;

/// A step of a closed direction must be shorter than this share of a turn.
const WIDEST_STEP: f64 = 0.2;

/// A foot found by iteration counts when it is not farther than this many times its neighbours.
const AS_NEAR: f64 = 2.0;

/// A foot on the edge.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Parameter of the edge.
    pub t: f64,
    /// Parameters of the surface, unrolled.
    pub at: [f64; 2],
    /// Distance between the two.
    pub distance: f64,
    /// Proven lower bound of the edge's distance there; 0 where it was not asked for.
    pub lower_bound: f64,
}

impl Puller<'_> {
    /// Samples the edge so finely that no step is wide.
    pub fn sample(
        &mut self,
        hint: Option<[f64; 2]>,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<(), Error> {
        let mut parameters = self.first_parameters();
        let mut feet: Vec<FootPoint> = Vec::new();
        for &t in &parameters {
            if feet.len().is_multiple_of(32) && poll() {
                return Err(Error::Cancelled);
            }
            let hint = feet.last().map(|foot| [foot.u, foot.v]);
            feet.push(self.global(t, hint));
        }
        if let Some(hint) = hint {
            self.begin_at(hint, parameters[0], &mut feet[0]);
        }
        for round in 0.. {
            let wide = self.join(&parameters, &mut feet, poll)?;
            let Some(&first) = wide.first() else { return Ok(()) };
            if round == ROUNDS || parameters.len() > 2 * MOST_SAMPLES {
                let t = parameters[first];
                let text =
                    format!("edge: behind {t:?} its foot jumps to another branch of the surface");
                return Err(Error::InvalidArgument(text));
            }
            for &k in wide.iter().rev() {
                let t = parameters[k] + 0.5 * (parameters[k + 1] - parameters[k]);
                parameters.insert(k + 1, t);
                feet.insert(k + 1, self.global(t, None));
            }
        }
        Ok(())
    }

    fn first_parameters(&self) -> Vec<f64> {
        let knots = self.edge.knots();
        let spans: Vec<usize> = knots.spans().collect();
        let each = LEAST_SAMPLES.div_ceil(spans.len()).max(SPAN_SAMPLES);
        let each = each.min(MOST_SAMPLES.div_ceil(spans.len())).max(2);
        let mut parameters = Vec::with_capacity(each * spans.len() + 1);
        for &span in &spans {
            let [a, b] = [knots.values()[span], knots.values()[span + 1]];
            parameters.extend((0..each).map(|k| a + (b - a) * (k as f64 / each as f64)));
        }
        parameters.push(knots.domain().1);
        parameters.dedup();
        parameters
    }

    fn global(&mut self, t: f64, hint: Option<[f64; 2]>) -> FootPoint {
        let query = self.edge.evaluate(t);
        self.shape.closest(query, hint, &self.options, &mut self.workspace, None)
    }

    /// Takes the caller's place for the start where that is as near.
    fn begin_at(&mut self, hint: [f64; 2], t: f64, foot: &mut FootPoint) {
        let at = [0, 1].map(|k| hint[k].clamp(self.ends[k][0], self.ends[k][1]));
        let query = self.edge.evaluate(t);
        let local = QueryOptions { scope: Scope::Local, ..self.options };
        let found = self.shape.closest(query, Some(at), &local, &mut self.workspace, None);
        if found.distance <= foot.distance + self.tolerance {
            let lower_bound = foot.lower_bound.min(found.distance);
            *foot = FootPoint { lower_bound, flags: foot.flags, ..found };
        }
    }

    /// Joins the feet to samples; the steps that are too wide, by the number of their first foot.
    fn join(
        &mut self,
        parameters: &[f64],
        feet: &mut [FootPoint],
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<Vec<usize>, Error> {
        let count = feet.len();
        let (mut unwrapped, mut changes) = (vec![[0.0; 2]; count], vec![0; count]);
        let output =
            PathOutput { unwrapped: Some(&mut unwrapped[..]), changes: Some(&mut changes[..]) };
        let edge = self.edge;
        let queries = |k: usize| -> Vector { edge.evaluate(parameters[k]) };
        self.shape.join(&queries, feet, &self.options, output, poll)?;
        self.samples = (0..count)
            .map(|k| Sample {
                t: parameters[k],
                at: unwrapped[k],
                distance: feet[k].distance,
                lower_bound: feet[k].lower_bound,
            })
            .collect();
        let is_wide = |k: &usize| {
            let (a, b) = (unwrapped[*k], unwrapped[*k + 1]);
            let through = (changes[*k] | changes[*k + 1]) & change::THROUGH_COLLAPSED != 0;
            let far = (0..2).any(|d| {
                self.index.closed[d] && (b[d] - a[d]).abs() > WIDEST_STEP * self.period(d)
            });
            changes[*k + 1] & change::JUMP != 0 || far && !through
        };
        Ok((0..count - 1).filter(is_wide).collect())
    }

    /// The parameters inside the domain.
    pub fn canonical(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| {
            let [low, high] = self.ends[k];
            let x = if self.index.closed[k] {
                at[k] - ((at[k] - low) / (high - low)).floor() * (high - low)
            } else {
                at[k]
            };
            x.clamp(low, high)
        })
    }

    /// Lengths in space of parameter steps at a place.
    pub fn speeds(&self, at: [f64; 2]) -> [f64; 2] {
        let mut jet = [[0.0; 3]; 3];
        let [u, v] = self.canonical(at);
        self.shape.surface().partials(u, v, 1, &mut jet);
        [norm(jet[1]), norm(jet[2])]
    }

    /// The sample at `t`, between those around it; taken up into the list.
    pub fn sample_at(&mut self, t: f64) -> Sample {
        let place = self.samples.partition_point(|sample| sample.t < t);
        if let Some(known) = self.samples.get(place).filter(|sample| sample.t == t) {
            return *known;
        }
        let after = self.samples[place.min(self.samples.len() - 1)];
        let before = self.samples[place.saturating_sub(1)];
        let sample = self.foot_between(&before, &after, t);
        self.samples.insert(place, sample);
        sample
    }

    /// The foot at `t` that belongs between two samples.
    pub fn foot_between(&mut self, before: &Sample, after: &Sample, t: f64) -> Sample {
        let share = if after.t > before.t { (t - before.t) / (after.t - before.t) } else { 0.0 };
        let guess = [0, 1].map(|k| before.at[k] + share * (after.at[k] - before.at[k]));
        let query = self.edge.evaluate(t);
        let local = QueryOptions { scope: Scope::Local, ..self.options };
        let start = self.canonical(guess);
        let found = self.shape.closest(query, Some(start), &local, &mut self.workspace, None);
        let limit = AS_NEAR * before.distance.max(after.distance) + SNAPPING * self.tolerance;
        if found.distance <= limit {
            return self.placed(t, guess, &found, 0.0);
        }
        let whole = self.global(t, Some(start));
        if found.distance <= whole.distance + SNAPPING * self.tolerance {
            return self.placed(t, guess, &found, whole.lower_bound);
        }
        self.placed(t, guess, &whole, whole.lower_bound)
    }

    fn placed(&self, t: f64, guess: [f64; 2], foot: &FootPoint, lower_bound: f64) -> Sample {
        let at = [0, 1].map(|k| {
            let x = [foot.u, foot.v][k];
            if self.index.closed[k] {
                x + ((guess[k] - x) / self.period(k)).round() * self.period(k)
            } else {
                x
            }
        });
        Sample { t, at, distance: foot.distance, lower_bound }
    }

    /// The point of a collapsed edge.
    pub fn tip(&self, edge: usize) -> Option<Vector> {
        let [[u0, u1], [v0, v1]] = self.ends;
        let [u, v] = [[u0, v0], [u1, v0], [u0, v0], [u0, v1]][edge];
        self.index.collapsed[edge].then(|| self.shape.surface().evaluate(u, v))
    }

    /// Distance of the edge from a point at `t`.
    pub fn apart(&self, t: f64, point: Vector) -> f64 {
        norm(sub(self.edge.evaluate(t), point))
    }
}

/// Share of the tolerance that feet found in different ways may differ by.
const SNAPPING: f64 = 0.01;
