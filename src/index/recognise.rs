//! The carrier of an indexed shape: its pieces as `analytic` sees them.

use super::{CurveIndex, SurfaceIndex, position_error, position_steps};
use crate::analytic::{Analytic, Piece, Pieces};
use crate::bezier::Bidegree;
use crate::jet::BezierPatch;

impl SurfaceIndex {
    /// Looks whether the surface is an elementary one.
    pub fn recognise(&mut self) {
        let steps = position_steps(self.degree.s + self.degree.t);
        let piece = |k: usize| {
            let patch = &self.patches[k];
            let own = position_error(steps, self.rational, patch.radius, 0.0, 0.0);
            Piece { net: self.net(k), center: patch.center, error: own + patch.spread }
        };
        let (rows, columns) = (self.patches.len() / self.columns, self.columns);
        self.analytic =
            Analytic::of(&Pieces { rows, columns, is_curve: false, piece: &piece }).map(Box::new);
    }
}

impl CurveIndex {
    /// Looks whether the curve is an elementary one.
    pub fn recognise(&mut self) {
        let steps = position_steps(self.degree());
        let degree = Bidegree { s: self.degree(), t: 0 };
        let piece = |k: usize| {
            let segment = &self.segments[k];
            let (net, rational) = (self.net(k), self.is_rational());
            let (poles, lanes, level) = (net.poles, net.lanes, net.level);
            Piece {
                net: BezierPatch { degree, rational, poles, lanes, level },
                center: segment.center,
                error: position_error(steps, rational, segment.radius, 0.0, 0.0),
            }
        };
        let rows = self.segments.len();
        self.analytic =
            Analytic::of(&Pieces { rows, columns: 1, is_curve: true, piece: &piece }).map(Box::new);
    }
}
