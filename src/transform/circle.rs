//! The relation of the parameter of a circle form and the angle.
//!
//! On one piece of angle D with half angle h = D / 2, at the share s of its parameters and the angle w:
//!
//! ```text
//!   tan(w / 2) = s sin h / ((1 - s) + s cos h)         s = tan(w / 2) / (sin h + tan(w / 2) (1 - cos h))
//! ```
//!
//! A half turn of four poles is one piece with h = pi / 2: `tan(w / 2) = s / (1 - s)`, although its middle pole would be at
//! infinity; a quarter turn has `tan(w / 2) = s / (sqrt 2 (1 - s) + s)`. With atan2 nothing is singular, and since a piece is
//! its own mirror image everything is computed from its nearer end, where shares keep their digits.

use super::Share;
use crate::elementary::CircleForm;
use crate::error::Error;
use crate::portable::SameDigits;

/// Equal pieces of a circular arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Circle {
    pieces: usize,
    /// Cosine and sine of half the angle of a piece, and that half angle.
    cos: f64,
    sin: f64,
    half: f64,
}

impl Circle {
    pub fn new(form: CircleForm, sweep: f64) -> Result<Self, Error> {
        let pieces = form.pieces(sweep)?;
        let [cos, sin] = form.half_piece(sweep)?;
        let half = if form == CircleForm::Halves {
            std::f64::consts::FRAC_PI_2
        } else {
            sweep / (2 * pieces) as f64
        };
        Ok(Self { pieces, cos, sin, half })
    }

    /// From a share of the parameters to a share of the angles.
    pub fn angle(&self, share: Share) -> Share {
        self.by_pieces(share, |s| {
            (s * self.sin).arctangent_over((1.0 - s) + s * self.cos) / self.half
        })
    }

    /// From a share of the angles to a share of the parameters.
    pub fn parameter(&self, share: Share) -> Share {
        self.by_pieces(share, |w| {
            let tan = (w * self.half).tangent();
            tan / (self.sin + tan * (1.0 - self.cos))
        })
    }

    /// Bounds of the first and second derivative of [`Self::angle`]; the second one jumps where pieces meet. With `q = 1 - 2 (1 - cos h) s (1 - s)` on
    /// a piece, from `(1 + cos h) / 2` to 1, the first one is `sin h / (h q)`.
    pub fn angle_bounds(&self) -> [f64; 2] {
        let least = (1.0 + self.cos) / 2.0;
        let first = self.sin / (self.half * least);
        [first, self.pieces as f64 * 2.0 * (1.0 - self.cos) * first / least]
    }

    /// The same of [`Self::parameter`], the inverse function: first `h q / sin h`, second `h^2 q q' / sin^2 h`.
    pub fn parameter_bounds(&self) -> [f64; 2] {
        let first = self.half / self.sin;
        [first, self.pieces as f64 * 2.0 * (1.0 - self.cos) * first * first]
    }

    /// Applies the function of half a piece, [0, 1/2] to itself, to a share of the whole.
    fn by_pieces(&self, [from_start, from_end]: Share, half: impl Fn(f64) -> f64) -> Share {
        // The half of the whole that is nearer its own end, mirrored if it is the second one.
        if from_end < from_start {
            let [a, b] = self.by_pieces([from_end, from_start], half);
            return [b, a];
        }
        let n = self.pieces as f64;
        let scaled = from_start * n;
        let k = scaled.floor().min(n - 1.0);
        let s = scaled - k;
        let mapped = if s < 0.5 {
            half(s).min(0.5)
        } else if s == 0.5 {
            0.5
        } else {
            1.0 - half(1.0 - s).min(0.5)
        };
        let share = (k + mapped) / n;
        [share, 1.0 - share]
    }
}
