//! A curve against a plane or a quadric in implicit form: zeros of one polynomial on each segment.

use super::curves::COINCIDENT;
use super::hits::{CurveHit, CurveHits, DEFAULT_BUDGET, HitOptions, Nature};
use super::quadric::{Form, Quadric};
use crate::bezier::Bidegree;
use crate::bounds::extent;
use crate::error::Error;
use crate::index::IndexedCurve;
use crate::roots::{Found, zeros_of};

impl IndexedCurve {
    /// Where this curve (w) meets a plane or a quadric: the zeros of a polynomial on each segment, with proof. `u` and `v` are 0.
    ///
    /// # Errors
    /// As [`Self::meet_curve`].
    pub fn meet_quadric(
        &self,
        quadric: &Quadric,
        options: &HitOptions,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<CurveHits, Error> {
        let whole = self.curve().domain();
        let index = match self.index(poll) {
            Err(Error::Cancelled) => {
                return Ok(CurveHits::unreached([0.0, 0.0, 0.0, 0.0, whole.0, whole.1]));
            }
            index => index?,
        };
        let mut budget = if options.budget > 0 { options.budget } else { DEFAULT_BUDGET };
        let asked =
            if options.tolerance > 0.0 { options.tolerance } else { 1e-7 * index.frame.diagonal };
        let mut out = CurveHits::default();
        for (k, segment) in index.segments.iter().enumerate() {
            if k.is_multiple_of(256) && poll() {
                out.undecided.push([0.0, 0.0, 0.0, 0.0, segment.u.ends[0], whole.1]);
                out.stopped = true;
                break;
            }
            let form = Form::new(quadric, &index.frame, segment.center);
            if form.is_clear_of(segment.radius) {
                continue;
            }
            let degree = Bidegree { s: 0, t: index.degree() };
            let f = form.put_in(index.net(k).poles, degree, index.is_rational(), segment.radius);
            let flat = (asked * index.frame.scale * COINCIDENT).max(4.0 * f.error);
            let mut zeros = Vec::new();
            // Values that are none on a whole segment: it lies in the quadric. Elsewhere only rounding hides zeros.
            let whole = extent(&f.values);
            let lies_in = whole.0 >= -flat && whole.1 <= flat;
            zeros_of(
                &f.values,
                f.error,
                &|_, _, _, noise| noise || lies_in,
                &mut budget,
                &mut zeros,
            );
            for zero in zeros {
                let ends = [zero.low[0], zero.high[0]].map(|x| segment.u.global(x));
                let w = segment.u.global(zero.at[0]);
                if zero.found == Found::Undecided {
                    out.undecided.push([0.0, 0.0, 0.0, 0.0, ends[0], ends[1]]);
                    continue;
                }
                let is_root = zero.found == Found::Root;
                let nature = match (is_root, lies_in) {
                    (true, _) => Nature::Transversal,
                    (_, true) => Nature::Overlap,
                    _ => Nature::Tangential,
                };
                let sign = |w: f64| quadric.value(self.curve().evaluate(w)) > 0.0;
                let width = (ends[1] - ends[0]).max(1e-6 * (segment.u.ends[1] - segment.u.ends[0]));
                let side = |x: f64| sign(x.clamp(segment.u.ends[0], segment.u.ends[1]));
                let crosses = || side(ends[0] - width) != side(ends[1] + width);
                let multiplicity = match nature {
                    Nature::Transversal => 1,
                    Nature::Overlap => 0,
                    Nature::Tangential if crosses() => 3,
                    Nature::Tangential => 2,
                };
                let point = self.curve().evaluate(w);
                out.hits.push(CurveHit {
                    u: 0.0,
                    v: 0.0,
                    w,
                    point,
                    distance: quadric.distance(point),
                    u_range: [0.0; 2],
                    v_range: [0.0; 2],
                    w_range: ends,
                    nature,
                    multiplicity,
                });
            }
        }
        join_along(self, &mut out.hits);
        Ok(out)
    }
}

/// Hits of neighbouring segments at their common end are one; overlaps that go on are one.
fn join_along(curve: &IndexedCurve, hits: &mut Vec<CurveHit>) {
    hits.sort_by(|a, b| a.w.total_cmp(&b.w));
    let mut kept: Vec<CurveHit> = Vec::with_capacity(hits.len());
    for hit in hits.drain(..) {
        let Some(last) = kept.last_mut().filter(|last| last.w_range[1] >= hit.w_range[0]) else {
            kept.push(hit);
            continue;
        };
        if last.nature == Nature::Overlap || hit.nature != Nature::Overlap {
            last.w_range[1] = last.w_range[1].max(hit.w_range[1]);
        } else {
            *last = CurveHit { w_range: [last.w_range[0], hit.w_range[1]], ..hit };
        }
    }
    let (first, last) = curve.curve().domain();
    if kept.len() > 1
        && curve.curve().is_closed()
        && kept[0].w_range[0] <= first
        && kept[kept.len() - 1].w_range[1] >= last
        && kept[0].nature != Nature::Overlap
        && kept[kept.len() - 1].nature != Nature::Overlap
    {
        kept.pop();
    }
    *hits = kept;
}
