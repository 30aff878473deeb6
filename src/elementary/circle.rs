//! Circular arcs as rational splines of degree 2: poles and weights of the standard forms.
//!
//! ```text
//!   halves    each half turn  (1,0) (1,1) (-1,1) (-1,0), weights 1, 1/2, 1/2, 1, a simple knot in its middle:
//!             4 poles for a half turn, 7 for a full one
//!   arcs(n)   n equal arcs of angle D, each a Bezier piece with weights 1, cos D/2, 1: 2n + 1 poles;
//!             5 for a half turn in two arcs, 9 for a full one in four, 7 for a full one in three
//! ```
//!
//! The parameter runs from 0 to 1. It is not the angle; the relation of both is [`crate::transform::Relation`]'s.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., sections 7.3 and 7.5.

use std::f64::consts::{FRAC_PI_2, PI};

use super::invalid;
use crate::error::Error;
use crate::portable::SameDigits;

/// Most arcs of one circle.
pub const MOST_ARCS: usize = 1000;

/// Largest angle of one arc: at half a turn its middle pole is at infinity.
const LARGEST_ARC: f64 = 3.1;

/// How a circular arc is written as a spline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CircleForm {
    /// Half turns of 4 poles each, which share their ends; for a sweep of one or two half turns.
    Halves,
    /// This many equal arcs.
    Arcs(usize),
}

/// Poles of a unit circle (cosine, sine, weight) and knots from 0 to 1.
pub(super) struct Net {
    pub poles: Vec<[f64; 3]>,
    pub knots: Vec<f64>,
}

impl CircleForm {
    /// Arcs of at most a quarter turn: what most systems write.
    pub fn quarters(sweep: f64) -> Self {
        Self::Arcs(((sweep.abs() / FRAC_PI_2 - 1e-9).ceil() as usize).max(1))
    }

    /// Number of pieces of equal angle for an arc over `sweep` radians.
    ///
    /// # Errors
    /// Halves of a sweep that is not a half or a full turn; too many arcs, or too few for the sweep.
    pub fn pieces(self, sweep: f64) -> Result<usize, Error> {
        match self {
            Self::Halves => {
                let halves = (sweep / PI).round();
                if !(1.0..=2.0).contains(&halves) || (sweep - halves * PI).abs() > 1e-14 {
                    return invalid(format!(
                        "form: half turns cannot make a sweep of {sweep} radians"
                    ));
                }
                Ok(halves as usize)
            }
            Self::Arcs(n) if n == 0 || n > MOST_ARCS => {
                invalid(format!("form: {n} arcs given, 1 to {MOST_ARCS} accepted"))
            }
            Self::Arcs(n) if sweep / n as f64 > LARGEST_ARC => {
                invalid(format!("form: {n} arcs are too few for a sweep of {sweep} radians"))
            }
            Self::Arcs(n) => Ok(n),
        }
    }

    /// Cosine and sine of half the angle of one piece.
    pub fn half_piece(self, sweep: f64) -> Result<[f64; 2], Error> {
        let pieces = self.pieces(sweep)?;
        // Half turns are exact, whatever the rounding of the sweep.
        Ok(match self {
            Self::Halves => [0.0, 1.0],
            Self::Arcs(_) => quadrant_exact(sweep / (2 * pieces) as f64),
        })
    }

    /// The spline of the arc from `start` to `end`.
    pub(super) fn net(self, start: f64, end: f64) -> Result<Net, Error> {
        let sweep = end - start;
        let pieces = self.pieces(sweep)?;
        let [cos, _] = self.half_piece(sweep)?;
        let at = |share: f64| quadrant_exact(start + sweep * share);
        let (mut poles, mut knots) = (Vec::new(), vec![0.0; 3]);
        for k in 0..pieces {
            let share = |part: f64| (k as f64 + part) / pieces as f64;
            let [c, s] = at(share(0.0));
            poles.push([c, s, 1.0]);
            match self {
                Self::Halves => {
                    poles.extend([[c - s, s + c, 0.5], [-c - s, -s + c, 0.5]]);
                    knots.extend([share(0.5), share(1.0), share(1.0)]);
                }
                Self::Arcs(_) => {
                    let [c, s] = at(share(0.5));
                    poles.push([c / cos, s / cos, cos]);
                    knots.extend([share(1.0); 2]);
                }
            }
        }
        // A full turn ends where it began, bit for bit.
        let full = (sweep - 2.0 * PI).abs() <= 1e-14;
        let [c, s] = at(if full { 0.0 } else { 1.0 });
        poles.push([c, s, 1.0]);
        knots.push(1.0);
        Ok(Net { poles, knots })
    }
}

/// Cosine and sine; exact at multiples of a quarter turn as doubles round them.
pub fn quadrant_exact(angle: f64) -> [f64; 2] {
    let quarters = (angle / FRAC_PI_2).round();
    if quarters.abs() <= 64.0 && quarters * FRAC_PI_2 == angle {
        return match (quarters as i64).rem_euclid(4) {
            0 => [1.0, 0.0],
            1 => [0.0, 1.0],
            2 => [-1.0, 0.0],
            _ => [0.0, -1.0],
        };
    }
    let (s, c) = angle.sine_cosine();
    [c, s]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn the_published_forms_come_out_bit_for_bit() {
        let half = CircleForm::Halves.net(0.0, PI).unwrap();
        assert_eq!(
            half.poles,
            [[1.0, 0.0, 1.0], [1.0, 1.0, 0.5], [-1.0, 1.0, 0.5], [-1.0, 0.0, 1.0]]
        );
        assert_eq!(half.knots, [0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0]);
        let full = CircleForm::Halves.net(0.0, TAU).unwrap();
        assert_eq!(full.knots, [0.0, 0.0, 0.0, 0.25, 0.5, 0.5, 0.75, 1.0, 1.0, 1.0]);
        let flat: Vec<[f64; 2]> = full.poles.iter().map(|p| [p[0], p[1]]).collect();
        let published = [[1., 0.], [1., 1.], [-1., 1.], [-1., 0.], [-1., -1.], [1., -1.], [1., 0.]];
        assert_eq!(flat, published);
        let five = CircleForm::Arcs(2).net(0.0, PI).unwrap();
        assert_eq!(five.knots, [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0]);
        for (pole, expected) in
            five.poles.iter().zip([[1., 0.], [1., 1.], [0., 1.], [-1., 1.], [-1., 0.]])
        {
            assert!((pole[0] - expected[0]).abs() < 3e-16 && (pole[1] - expected[1]).abs() < 3e-16);
        }
        assert_eq!(CircleForm::quarters(TAU), CircleForm::Arcs(4));
        assert_eq!(CircleForm::Arcs(4).net(0.0, TAU).unwrap().poles.len(), 9);
    }

    #[test]
    fn forms_that_cannot_be_are_refused() {
        let text = |form: CircleForm, sweep: f64| form.pieces(sweep).unwrap_err().to_string();
        assert!(text(CircleForm::Halves, 1.0).starts_with("form: half turns"));
        assert!(text(CircleForm::Arcs(1), PI).starts_with("form: 1 arcs are too few"));
        assert!(text(CircleForm::Arcs(0), 1.0).starts_with("form: 0 arcs"));
    }
}
