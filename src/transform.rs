//! Parameter transforms `T(u, v) = (f(u), g(v))`, optionally with the parameters exchanged: the change from one parametrisation
//! of a surface to another.
//!
//! ```text
//!   Relation     one monotone function with its inverse: linear, circle parameter <-> angle, piecewise, chained, by a function
//!   Transform    one relation for u, one for v, and whether the images change places
//! ```
//!
//! Because T is separable and each relation is monotone, T maps isolines to isolines, disjoint curves to disjoint curves, loops to
//! loops and what is inside to what is inside; it keeps the direction of loops when both relations rise or both fall (and turns it
//! when the parameters are exchanged).
//!
//! Every relation maps the ends of its domain to the ends of its image bit for bit, and both ways agree to a few units in the last
//! place: formulas are evaluated from the nearer end.
//!
//! Reference: Yang, Yong, *Parameter transformation of trimmed surfaces* (Proposition 1, relations of the circle forms).

mod circle;

use std::sync::Arc;

use crate::elementary::CircleForm;
use crate::error::Error;
use circle::Circle;

/// A monotone function given by the caller.
pub type Function = Arc<dyn Fn(f64) -> f64 + Send + Sync>;

/// Places at which a function and its inverse are compared when a relation is made of them.
const SAMPLES: usize = 64;

/// How far a function and its inverse may disagree, as a share of the domain.
pub const INVERSE_TOLERANCE: f64 = 1e-9;

/// How far the image of one relation may be from the domain of the next one, as a share of it.
const CHAIN_TOLERANCE: f64 = 1e-12;

/// A monotone function of one parameter on an interval, with its inverse.
#[derive(Clone)]
pub struct Relation {
    form: Form,
    /// The domain, increasing.
    from: [f64; 2],
    /// The images of its ends, in that order; falling when the relation falls.
    to: [f64; 2],
}

#[derive(Clone)]
enum Form {
    Linear,
    /// From the parameter of a circle form to the angle.
    Angle(Circle),
    /// From the angle to the parameter.
    Parameter(Circle),
    /// One relation after the other along the domain.
    Piecewise(Arc<[Relation]>),
    /// One relation after the other applied.
    Chain(Arc<[Relation]>),
    Function {
        forward: Function,
        backward: Function,
    },
}

impl std::fmt::Debug for Relation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = match &self.form {
            Form::Linear => "linear",
            Form::Angle(_) => "circle parameter to angle",
            Form::Parameter(_) => "angle to circle parameter",
            Form::Piecewise(_) => "piecewise",
            Form::Chain(_) => "chain",
            Form::Function { .. } => "function",
        };
        write!(f, "{name} {:?} -> {:?}", self.from, self.to)
    }
}

impl Relation {
    /// The linear function that maps the ends of `from` to those of `to`; `to` may fall. It is continued outside.
    ///
    /// # Errors
    /// Numbers that are not finite; `from` that does not increase; `to` without length.
    pub fn linear(from: [f64; 2], to: [f64; 2]) -> Result<Self, Error> {
        check_range("from", from)?;
        check_finite("to", to)?;
        if to[0] == to[1] {
            return invalid("to: entry 1 equals entry 0".into());
        }
        Ok(Self { form: Form::Linear, from, to })
    }

    /// The function that changes nothing on an interval.
    ///
    /// # Errors
    /// Numbers that are not finite; an interval that does not increase.
    pub fn identity(range: [f64; 2]) -> Result<Self, Error> {
        Self::linear(range, range)
    }

    /// The reversal of an interval: `x -> from[0] + from[1] - x`.
    ///
    /// # Errors
    /// As [`Self::identity`].
    pub fn reversal([a, b]: [f64; 2]) -> Result<Self, Error> {
        Self::linear([a, b], [b, a])
    }

    /// From the parameter of a circle form to the angle: an arc of `sweep` radians is written in `form` on the parameters
    /// `from`, and its angle is counted from `to[0]` to `to[1]` in any unit (both may be `[0, 1]`).
    ///
    /// # Errors
    /// Numbers that are not finite or do not increase; a form that cannot make the sweep.
    pub fn circle(
        form: CircleForm,
        sweep: f64,
        from: [f64; 2],
        to: [f64; 2],
    ) -> Result<Self, Error> {
        check_range("from", from)?;
        check_range("to", to)?;
        if !(sweep > 0.0 && sweep < 7.0) {
            return invalid(format!("sweep: {sweep} is not between 0 and a full turn"));
        }
        Ok(Self { form: Form::Angle(Circle::new(form, sweep)?), from, to })
    }

    /// Relations one after the other along the domain: each begins where the one before it ends, in domain and image, bit for bit,
    /// and all rise or all fall.
    ///
    /// # Errors
    /// No relation; a gap or a change of direction, by index.
    pub fn piecewise(pieces: Vec<Relation>) -> Result<Self, Error> {
        let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else {
            return invalid("pieces: none given".into());
        };
        let (from, to) = ([first.from[0], last.from[1]], [first.to[0], last.to[1]]);
        for (k, pair) in pieces.windows(2).enumerate() {
            if pair[0].from[1] != pair[1].from[0] || pair[0].to[1] != pair[1].to[0] {
                return invalid(format!(
                    "pieces: piece {} does not begin where piece {k} ends",
                    k + 1
                ));
            }
            if pair[0].is_increasing() != pair[1].is_increasing() {
                return invalid(format!("pieces: piece {} changes the direction", k + 1));
            }
        }
        Ok(Self { form: Form::Piecewise(pieces.into()), from, to })
    }

    /// The piecewise linear relation through values at increasing places.
    ///
    /// # Errors
    /// Fewer than two places; another number of values; numbers that are not finite, places that do not increase or values that do
    /// not all rise or all fall, by index.
    pub fn through(places: &[f64], values: &[f64]) -> Result<Self, Error> {
        if places.len() < 2 || places.len() != values.len() {
            let (a, b) = (places.len(), values.len());
            return invalid(format!("values: {b} given for {a} places, at least 2 needed"));
        }
        let pieces = places.windows(2).zip(values.windows(2)).enumerate().map(|(k, (x, y))| {
            Self::linear([x[0], x[1]], [y[0], y[1]]).map_err(|error| match error {
                Error::InvalidArgument(text) => {
                    Error::InvalidArgument(format!("places: between {k} and {}: {text}", k + 1))
                }
                other => other,
            })
        });
        Self::piecewise(pieces.collect::<Result<_, _>>()?)
    }

    /// A function with its inverse. Both are called from any thread, give the same numbers for the same places, and must not
    /// panic. They are compared at some places here; that the function is monotone between them is the caller's word.
    ///
    /// # Errors
    /// A domain that does not increase; values that are not finite or not monotone; an inverse that is none.
    pub fn function(from: [f64; 2], forward: Function, backward: Function) -> Result<Self, Error> {
        check_range("from", from)?;
        let to = [forward(from[0]), forward(from[1])];
        check_finite("function: value at the ends", to)?;
        if to[0] == to[1] {
            return invalid("function: has the same value at both ends".into());
        }
        let rising = to[0] < to[1];
        let places = (0..=SAMPLES).map(|k| between(from[0], from[1], k as f64 / SAMPLES as f64));
        let pairs: Vec<[f64; 2]> = places.map(|x| [x, forward(x)]).collect();
        for pair in pairs.windows(2) {
            let ([_, y], [x, z]) = (pair[0], pair[1]);
            if !(z.is_finite() && if rising { y < z } else { y > z }) {
                return invalid(format!("function: is not finite or not monotone near {x}"));
            }
        }
        for [x, y] in pairs {
            let off = (backward(y) - x).abs();
            if off.is_nan() || off > INVERSE_TOLERANCE * (from[1] - from[0]) {
                return invalid(format!("inverse: differs from the function's by {off} at {x}"));
            }
        }
        Ok(Self { form: Form::Function { forward, backward }, from, to })
    }

    /// This relation and then another one, whose domain is the image of this one.
    ///
    /// # Errors
    /// Another domain than this image.
    pub fn then(&self, next: &Relation) -> Result<Self, Error> {
        let [low, high] = self.image();
        let slack = CHAIN_TOLERANCE * (high - low);
        if (next.from[0] - low).abs() > slack || (next.from[1] - high).abs() > slack {
            return invalid(format!(
                "next: begins with {:?}, the image before it is [{low}, {high}]",
                next.from
            ));
        }
        let rising = self.is_increasing();
        let to = if rising { next.to } else { [next.to[1], next.to[0]] };
        Ok(Self { form: Form::Chain([self.clone(), next.clone()].into()), from: self.from, to })
    }

    /// The domain, increasing.
    pub fn domain(&self) -> [f64; 2] {
        self.from
    }

    /// The image, increasing.
    pub fn image(&self) -> [f64; 2] {
        let [a, b] = self.to;
        [a.min(b), a.max(b)]
    }

    /// Whether it rises.
    pub fn is_increasing(&self) -> bool {
        self.to[0] < self.to[1]
    }

    /// Whether it is linear on all of its domain.
    pub fn is_linear(&self) -> bool {
        match &self.form {
            Form::Linear => true,
            Form::Piecewise(pieces) => pieces.len() == 1 && pieces[0].is_linear(),
            Form::Chain(links) => links.iter().all(Self::is_linear),
            _ => false,
        }
    }

    /// Whether it changes nothing.
    pub fn is_identity(&self) -> bool {
        matches!(self.form, Form::Linear) && self.from == self.to
    }

    /// The slope of a linear relation.
    pub fn slope(&self) -> f64 {
        (self.to[1] - self.to[0]) / (self.from[1] - self.from[0])
    }

    /// The places inside the domain at which its first derivative may jump.
    pub fn kinks(&self) -> Vec<f64> {
        match &self.form {
            Form::Piecewise(pieces) => {
                let joints = pieces[1..].iter().map(|piece| piece.from[0]);
                joints.chain(pieces.iter().flat_map(Self::kinks)).collect()
            }
            Form::Chain(links) => {
                let back = links[0].inverse();
                let after = links[1].kinks().into_iter().map(|y| back.apply(y));
                after.chain(links[0].kinks()).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Bounds of the absolute values of its first and second derivative between its kinks; none where a function is part of it.
    pub fn derivative_bounds(&self) -> Option<[f64; 2]> {
        let ([a, b], [c, d]) = (self.from, self.to);
        let (length, ratio) = (b - a, ((d - c) / (b - a)).abs());
        match &self.form {
            Form::Linear => Some([ratio, 0.0]),
            Form::Angle(circle) => {
                let [first, second] = circle.angle_bounds();
                Some([ratio * first, ratio / length * second])
            }
            Form::Parameter(circle) => {
                let [first, second] = circle.parameter_bounds();
                Some([ratio * first, ratio / length * second])
            }
            Form::Piecewise(pieces) => pieces.iter().try_fold([0.0f64; 2], |most, piece| {
                let [first, second] = piece.derivative_bounds()?;
                Some([most[0].max(first), most[1].max(second)])
            }),
            Form::Chain(links) => links.iter().try_fold([1.0, 0.0], |[first, second], link| {
                let [f, g] = link.derivative_bounds()?;
                Some([f * first, g * first * first + f * second])
            }),
            Form::Function { .. } => None,
        }
    }

    /// The value at `x`. Linear relations are continued outside of the domain, others give the value at its end.
    pub fn apply(&self, x: f64) -> f64 {
        let ([a, b], [c, d]) = (self.from, self.to);
        if self.is_identity() {
            return x;
        }
        if let Form::Linear = self.form {
            return line(x, [a, b], [c, d]);
        }
        if x <= a {
            return c;
        }
        if x >= b {
            return d;
        }
        let [low, high] = self.image();
        let value = match &self.form {
            Form::Linear => line(x, [a, b], [c, d]),
            Form::Angle(circle) => {
                let share = share_of(x, [a, b]);
                between_shares(c, d, circle.angle(share))
            }
            Form::Parameter(circle) => {
                let share = share_of(x, [a, b]);
                between_shares(c, d, circle.parameter(share))
            }
            Form::Piecewise(pieces) => {
                let k = pieces.partition_point(|piece| piece.from[1] < x).min(pieces.len() - 1);
                pieces[k].apply(x)
            }
            Form::Chain(links) => links.iter().fold(x, |x, link| link.apply(x)),
            Form::Function { forward, .. } => forward(x),
        };
        value.max(low).min(high)
    }

    /// The inverse relation.
    pub fn inverse(&self) -> Self {
        let rising = self.is_increasing();
        let ([a, b], [c, d]) = (self.from, self.to);
        let (from, to) = if rising { ([c, d], [a, b]) } else { ([d, c], [b, a]) };
        let inverses = |list: &[Relation], turned: bool| -> Arc<[Relation]> {
            if turned {
                list.iter().rev().map(Self::inverse).collect()
            } else {
                list.iter().map(Self::inverse).collect()
            }
        };
        let form = match &self.form {
            Form::Linear => Form::Linear,
            Form::Angle(circle) => Form::Parameter(*circle),
            Form::Parameter(circle) => Form::Angle(*circle),
            Form::Piecewise(pieces) => Form::Piecewise(inverses(pieces, !rising)),
            Form::Chain(links) => Form::Chain(inverses(links, true)),
            Form::Function { forward, backward } => {
                Form::Function { forward: backward.clone(), backward: forward.clone() }
            }
        };
        Self { form, from, to }
    }
}

/// The change `(u, v) -> (f(u), g(v))`, or `(g(v), f(u))` when the parameters are exchanged.
#[derive(Clone, Debug)]
pub struct Transform {
    /// f, of the first parameter.
    pub u: Relation,
    /// g, of the second one.
    pub v: Relation,
    /// Whether the images change places.
    pub swap: bool,
}

impl Transform {
    /// The two relations, without exchange.
    pub fn new(u: Relation, v: Relation) -> Self {
        Self { u, v, swap: false }
    }

    /// The transform that changes nothing on a domain u0, u1, v0, v1.
    ///
    /// # Errors
    /// Numbers that are not finite; an empty domain.
    pub fn identity([u0, u1, v0, v1]: [f64; 4]) -> Result<Self, Error> {
        Ok(Self::new(Relation::identity([u0, u1])?, Relation::identity([v0, v1])?))
    }

    /// The exchange of u and v on a domain.
    ///
    /// # Errors
    /// As [`Self::identity`].
    pub fn exchange(domain: [f64; 4]) -> Result<Self, Error> {
        Ok(Self { swap: true, ..Self::identity(domain)? })
    }

    /// The domain u0, u1, v0, v1.
    pub fn domain(&self) -> [f64; 4] {
        let ([u0, u1], [v0, v1]) = (self.u.from, self.v.from);
        [u0, u1, v0, v1]
    }

    /// The image, a domain as well.
    pub fn image(&self) -> [f64; 4] {
        let (first, second) = if self.swap { (&self.v, &self.u) } else { (&self.u, &self.v) };
        let ([s0, s1], [t0, t1]) = (first.image(), second.image());
        [s0, s1, t0, t1]
    }

    /// The image of a place.
    pub fn apply(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let (a, b) = (self.u.apply(u), self.v.apply(v));
        if self.swap { [b, a] } else { [a, b] }
    }

    /// The image of a difference of two places, when both relations are linear.
    pub fn linear_part(&self, [du, dv]: [f64; 2]) -> Option<[f64; 2]> {
        if !self.is_linear() {
            return None;
        }
        let (a, b) = (self.u.slope() * du, self.v.slope() * dv);
        Some(if self.swap { [b, a] } else { [a, b] })
    }

    /// Whether both relations are linear.
    pub fn is_linear(&self) -> bool {
        self.u.is_linear() && self.v.is_linear()
    }

    /// Whether it keeps the direction of loops.
    pub fn keeps_direction(&self) -> bool {
        (self.u.is_increasing() == self.v.is_increasing()) != self.swap
    }

    /// The inverse transform.
    pub fn inverse(&self) -> Self {
        let (u, v) = (self.u.inverse(), self.v.inverse());
        if self.swap { Self { u: v, v: u, swap: true } } else { Self { u, v, swap: false } }
    }

    /// This transform and then another one.
    ///
    /// # Errors
    /// Another domain than this image.
    pub fn then(&self, next: &Transform) -> Result<Self, Error> {
        let (after_u, after_v) = if self.swap { (&next.v, &next.u) } else { (&next.u, &next.v) };
        Ok(Self {
            u: self.u.then(after_u)?,
            v: self.v.then(after_v)?,
            swap: self.swap != next.swap,
        })
    }
}

/// The value at a share, 0 to 1, of the way from a to b; exact at both ends.
pub fn between(a: f64, b: f64, share: f64) -> f64 {
    if share <= 0.0 {
        a
    } else if share >= 1.0 {
        b
    } else if share <= 0.5 {
        a + share * (b - a)
    } else {
        b - (1.0 - share) * (b - a)
    }
}

/// A share of an interval as its distances from both ends: near an end the small one keeps its digits.
type Share = [f64; 2];

fn share_of(x: f64, [a, b]: [f64; 2]) -> Share {
    [(x - a) / (b - a), (b - x) / (b - a)]
}

fn between_shares(c: f64, d: f64, [from_start, from_end]: Share) -> f64 {
    if from_start <= from_end { c + from_start * (d - c) } else { d - from_end * (d - c) }
}

fn line(x: f64, from: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    between_shares(c, d, share_of(x, from))
}

fn check_finite(name: &str, range: [f64; 2]) -> Result<(), Error> {
    match range.iter().position(|x| !x.is_finite() || x.abs() > 1e100) {
        Some(k) => invalid(format!("{name}: entry {k} is not finite or beyond 1e100")),
        None => Ok(()),
    }
}

fn check_range(name: &str, range: [f64; 2]) -> Result<(), Error> {
    check_finite(name, range)?;
    if range[0] >= range[1] {
        return invalid(format!("{name}: entry 0 is not less than entry 1"));
    }
    Ok(())
}

fn invalid<T>(text: String) -> Result<T, Error> {
    Err(Error::InvalidArgument(text))
}

#[cfg(test)]
mod tests;
