//! The image of a pcurve in space, and its nearest point.
//!
//! ```text
//!   isoline of an elementary surface    the isocurve of its NURBS form, whose parameter is brought back: lines and circles stay that
//!   any other curve of a spline         lifted: composed exactly, or fitted with a proven error (`pcurve::lift`)
//!   ... of an elementary surface        the same, on its chart
//!   ... of a function                   the function along the curve, with the bound of its speed if there is one
//! ```

use super::{Face, FaceWorkspace, Place, Standing};
use crate::bounds::{Aabb, Vector, norm, scaled, sub};
use crate::callback::{CURVE_SAMPLES, CallbackCurve, CallbackSurface, CurveBounds};
use crate::closest::{QueryOptions, Within, flag};
use crate::curve::Curve;
use crate::elementary::{CircleForm, part};
use crate::error::Error;
use crate::index::{IndexedCurve, Poll};
use crate::pcurve::compose::Composer;
use crate::pcurve::lift::{LiftOptions, lift_spline};
use crate::pcurve::{Direction, Isoline, Pcurve};
use crate::transform::Relation;
use crate::trim::{ElementarySupport, Support, motion};
use std::sync::Arc;

/// Share of the surface's diagonal within which a fitted image stays: a fifth of the accuracy of an answer.
const FITTED: f64 = 2e-11;

/// Highest degree of exact images; those of higher ones are fitted, whose search is faster.
const EXACT: usize = 9;

/// Images shorter than this share of the diagonal are a point.
const POINT: f64 = 1e-13;

/// Spans of a curve whose image is one: `poll` is asked between such parts, and each has a box of its own.
const SPANS: usize = 64;

/// Ends of curves on functions may lie beyond the domain by this share of it.
const BEYOND: f64 = 1e-6;

/// A coedge, or a part of it, as its image.
#[derive(Debug)]
pub(super) struct Border {
    pcurve: Curve,
    image: Image,
    /// From the parameter of the image to that of `pcurve`, when they differ.
    back: Option<Back>,
    /// From the parameter of `pcurve` to that of the coedge, when they differ: the angle of an arc.
    own: Option<Relation>,
    /// Proven: how far the image may be from that of the pcurve.
    error: f64,
    bounds: Aabb,
    /// Loop and coedge.
    number: [usize; 2],
}

/// The running parameter of an isoline from that of the isocurve, and its sign.
#[derive(Debug)]
struct Back {
    relation: Relation,
    sign: f64,
}

#[derive(Debug)]
enum Image {
    Curve(Box<IndexedCurve>),
    Function(Box<CallbackCurve>),
    /// A collapsed edge.
    Point(Vector),
}

/// What the images of all coedges of a face need.
pub(super) struct Setting<'a> {
    support: &'a Support,
    /// Of the chart; none for a function.
    composer: Option<Composer<'a>>,
    /// Bounds of |Su| and |Sv| of the chart, once they are known.
    speeds: Option<[f64; 2]>,
    error: f64,
    diagonal: f64,
}

impl<'a> Setting<'a> {
    pub fn new(support: &'a Support, diagonal: f64) -> Result<Self, Error> {
        let chart = support.chart()?;
        let composer = chart.map(|chart| Composer::new(chart.surface));
        let error = chart.map_or(0.0, |chart| chart.error);
        Ok(Self { support, composer, speeds: None, error, diagonal })
    }

    /// The borders of one coedge.
    ///
    /// # Errors
    /// A pcurve that leaves the domain; memory that could not be had; [`Error::Cancelled`] when `poll` said so.
    pub fn borders(
        &mut self,
        pcurve: &Pcurve,
        number: [usize; 2],
        poll: Poll,
        out: &mut Vec<Border>,
    ) -> Result<Curve, Error> {
        let spline = pcurve.as_spline()?;
        match (self.support, pcurve) {
            (Support::Callback(function), _) => {
                out.push(self.on_function(function, pcurve, number)?);
            }
            (Support::Elementary(elementary), Pcurve::Isoline(line)) => {
                self.check_inside(&spline)?;
                out.push(self.isoline(elementary, line, spline.clone(), number)?);
            }
            _ => self.lifted(pcurve, &spline, number, poll, out)?,
        }
        Ok(spline)
    }

    fn check_inside(&self, spline: &Curve) -> Result<(), Error> {
        let Some(composer) = &self.composer else { return Ok(()) };
        composer.check_inside(&composer.brought_inside(spline)?.0)
    }

    /// The image of a curve as a spline, in parts of at most [`SPANS`] spans.
    fn lifted(
        &mut self,
        pcurve: &Pcurve,
        spline: &Curve,
        number: [usize; 2],
        poll: Poll,
        out: &mut Vec<Border>,
    ) -> Result<(), Error> {
        let Some(composer) = &mut self.composer else { return Ok(()) };
        let options = LiftOptions { tolerance: FITTED * self.diagonal, exact_degree: EXACT };
        let (inside, moved) = composer.brought_inside(spline)?;
        let mut error = self.error;
        if moved != [0.0; 2] {
            let speeds = *self.speeds.get_or_insert_with(|| composer.speeds());
            error += speeds[0] * moved[0] + speeds[1] * moved[1];
        }
        let knots = spline.knots();
        let starts: Vec<f64> =
            knots.spans().map(|span| knots.values()[span]).step_by(SPANS).collect();
        let ends = starts[1..].iter().copied().chain([knots.domain().1]);
        for (start, end) in starts.iter().copied().zip(ends) {
            if poll() {
                return Err(Error::Cancelled);
            }
            let lifted = lift_spline(composer, &part(&inside, [start, end])?, &options)?;
            let pcurve_part = part(spline, [start, end])?;
            let error = error + lifted.deviation.bound;
            let own = own_parameter(pcurve)?;
            out.push(Border::made(pcurve_part, lifted.curve, error, number, self.diagonal, own));
        }
        Ok(())
    }

    /// The isoline of an elementary surface: the isocurve of its form.
    fn isoline(
        &self,
        elementary: &ElementarySupport,
        line: &Isoline,
        spline: Curve,
        number: [usize; 2],
    ) -> Result<Border, Error> {
        let to_form = elementary.to_form()?;
        let along = if line.fixed == Direction::U { &to_form.v } else { &to_form.u };
        let curve = match elementary.isocurve(line)? {
            Some(curve) => curve,
            None => {
                let point = self.support.evaluate([spline.poles()[0][0], spline.poles()[0][1]]);
                Curve::new(&[0.0, 0.0, 1.0, 1.0], 1, &[point; 2], None)?
            }
        };
        let (low, high) = curve.bounding_box();
        let largest = low.iter().chain(&high).fold(0.0, |most: f64, x| most.max(x.abs()));
        let error = self.error + 64.0 * f64::EPSILON * largest;
        let mut made = Border::made(spline, curve, error, number, self.diagonal, None);
        let sign = if line.from < line.to { 1.0 } else { -1.0 };
        made.back = Some(Back { relation: along.inverse(), sign });
        Ok(made)
    }

    /// The function along a curve.
    fn on_function(
        &self,
        function: &Arc<CallbackSurface>,
        pcurve: &Pcurve,
        number: [usize; 2],
    ) -> Result<Border, Error> {
        let domain = function.domain();
        for (t, place) in [(pcurve.domain().0, pcurve.start()), (pcurve.domain().1, pcurve.end())] {
            for k in 0..2 {
                let room = BEYOND * (domain[2 * k + 1] - domain[2 * k]);
                if place[k] < domain[2 * k] - room || place[k] > domain[2 * k + 1] + room {
                    let (name, x) = (["u", "v"][k], place[k]);
                    let text = format!("pcurve: at {t:?} it leaves the domain, {name} = {x:?}");
                    return Err(Error::InvalidArgument(text));
                }
            }
        }
        // The fastest way along the curve, corner by corner.
        let (a, b) = pcurve.domain();
        let places = [vec![a], pcurve.breaks(), vec![b]].concat();
        let most = places.windows(2).fold([0.0f64; 2], |most, range| {
            let first = motion(pcurve, [range[0], range[1]]).first;
            [most[0].max(first[0]), most[1].max(first[1])]
        });
        let speed = function.bounds().speed.map(|s| s[0] * most[0] + s[1] * most[1]);
        let (support, own) = (self.support.clone(), pcurve.clone());
        let image = move |t: f64, _: usize, out: &mut [Vector; 3]| {
            out[0] = support.evaluate(own.evaluate(t));
            out[0].iter().all(|x| x.is_finite()).then_some(0)
        };
        let bounds = CurveBounds { speed, second: None };
        let image = CallbackCurve::new([a, b], bounds, image)?;
        // Between samples the image leaves their box by no more than half a step.
        let step = (b - a) / (CURVE_SAMPLES - 1) as f64;
        let room = speed.map_or(self.diagonal, |speed| 0.5 * speed * step);
        let bounds = image.bounding_box().grown(room);
        let image = Image::Function(Box::new(image));
        // The parameter of the image is that of the coedge.
        let (pcurve, _) = pcurve.as_spline_in_parameter()?;
        Ok(Border { pcurve, image, back: None, own: None, error: 0.0, bounds, number })
    }
}

/// From the parameter of [`Pcurve::as_spline`] to that of the pcurve. Not inlined: in a loop over coedges the compiler would round the
/// angles up before it has looked whether the curve is an arc, and memory checkers complain of what was never written.
#[inline(never)]
fn own_parameter(pcurve: &Pcurve) -> Result<Option<Relation>, Error> {
    let Pcurve::Arc(arc) = pcurve else { return Ok(None) };
    let sweep = arc.angles[1] - arc.angles[0];
    Relation::circle(CircleForm::quarters(sweep), sweep, arc.angles, arc.angles).map(Some)
}

/// The nearest point of a border.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest {
    /// Parameter of the pcurve; NaN when nothing is near.
    pub t: f64,
    /// Distance from the image of the pcurve there; NaN when nothing is near.
    pub distance: f64,
    /// Nothing on the border is nearer.
    pub lower_bound: f64,
    /// The gap between distance and bound that rounding may leave.
    pub allowed: f64,
    /// The bits of the search's certificate that the answer takes over.
    pub flags: u32,
    /// Evaluations.
    pub iterations: u32,
}

impl Border {
    fn made(
        pcurve: Curve,
        curve: Curve,
        error: f64,
        number: [usize; 2],
        diagonal: f64,
        own: Option<Relation>,
    ) -> Self {
        let (low, high) = curve.bounding_box();
        let size = norm(sub(high, low));
        let (image, error) = if size <= POINT * diagonal {
            (Image::Point(curve.evaluate(curve.domain().0)), error + size)
        } else {
            (Image::Curve(Box::new(IndexedCurve::new(curve))), error)
        };
        let bounds = Aabb { low, high }.grown(error);
        Self { pcurve, image, back: None, own, error, bounds, number }
    }

    /// Spans of the image.
    pub fn spans(&self) -> u64 {
        match &self.image {
            Image::Curve(curve) => curve.curve().knots().spans().count() as u64,
            _ => 1,
        }
    }

    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    pub fn error(&self) -> f64 {
        self.error
    }

    /// The place on the coedge at a parameter of the border.
    pub fn place(&self, t: f64) -> Place {
        let [loop_index, coedge_index] = self.number.map(|k| k as u32);
        let parameter = self.own.as_ref().map_or(t, |relation| relation.apply(t));
        Place { standing: Standing::OnEdge, loop_index, coedge_index, flags: 0, parameter }
    }

    /// Parameters of the surface at a parameter of the pcurve.
    pub fn at(&self, t: f64, [u0, u1, v0, v1]: [f64; 4]) -> [f64; 2] {
        let [u, v, _] = self.pcurve.evaluate(t);
        [u.clamp(u0, u1), v.clamp(v0, v1)]
    }

    /// The nearest point if one is as near as `limit`; `None` when the box already tells that none is.
    pub fn nearest(
        &self,
        face: &Face,
        query: Vector,
        limit: f64,
        options: &QueryOptions,
        workspace: &mut FaceWorkspace,
    ) -> Option<Nearest> {
        let far = box_distance(&self.bounds, query);
        if far > limit {
            return None;
        }
        let domain = face.support.domain();
        let here = |t: f64| face.distance(query, self.at(t, domain));
        let asked = QueryOptions {
            accuracy: face.accuracy(options),
            method: options.method,
            budget: options.budget,
            ..QueryOptions::default()
        };
        let curve = match &self.image {
            Image::Point(point) => {
                let t = self.pcurve.domain().0;
                let lower_bound = (norm(sub(query, *point)) - self.error).max(0.0);
                let distance = here(t);
                let lower_bound = lower_bound.min(distance);
                let allowed = self.error;
                let (flags, iterations) = (0, 1);
                return Some(Nearest { t, distance, lower_bound, allowed, flags, iterations });
            }
            Image::Function(curve) => {
                let foot = curve.closest(query, None, &asked, None);
                let (t, distance, iterations) = (foot.u, foot.distance, foot.iterations);
                let lower_bound = foot.lower_bound.min(distance);
                let flags = foot.flags & (flag::TIE | flag::CONTINUUM | flag::BUDGET);
                let allowed = asked.accuracy;
                return Some(Nearest { t, distance, lower_bound, allowed, flags, iterations });
            }
            Image::Curve(curve) => curve,
        };
        let middle = scaled(crate::bounds::add(self.bounds.low, self.bounds.high), 0.5);
        let towards = sub(middle, query);
        let length = norm(towards);
        let direction = if length > 0.0 { scaled(towards, 1.0 / length) } else { [1.0, 0.0, 0.0] };
        let within =
            limit.is_finite().then_some(Within { distance: limit + self.error, direction });
        let found = curve.closest_within(query, None, within, &asked, &mut workspace.shape);
        let lower_bound = (found.foot.lower_bound - self.error).max(0.0);
        let (t, distance) = if found.foot.distance.is_nan() {
            (f64::NAN, f64::NAN)
        } else {
            let (start, end) = self.pcurve.domain();
            let t = self
                .back
                .as_ref()
                .map_or(found.foot.u, |back| back.sign * back.relation.apply(found.foot.u));
            let t = t.clamp(start, end);
            (t, here(t))
        };
        let flags = found.foot.flags & (flag::TIE | flag::CONTINUUM | flag::BUDGET);
        let lower_bound = if distance < lower_bound { distance } else { lower_bound };
        let (allowed, iterations) = (found.allowed, found.foot.iterations);
        Some(Nearest { t, distance, lower_bound, allowed, flags, iterations })
    }
}

/// Distance to a box, a little less for rounding.
pub(super) fn box_distance(bounds: &Aabb, query: Vector) -> f64 {
    let beside = |k: usize| (bounds.low[k] - query[k]).max(query[k] - bounds.high[k]).max(0.0);
    norm([0, 1, 2].map(beside)) * (1.0 - 1e-15)
}
