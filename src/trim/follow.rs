//! A face on another parametrisation of its surface when the change is not separable: every curve is followed by inversion (`course`).
//!
//! A loop stays one closed loop. Where loops cross a seam of the new surface, or the face has a seam of its own that is none there, they are
//! cut and joined anew (`recut`).

use super::course::{Course, Follower};
use super::flat::Scale;
use super::merge::kind_of;
use super::recut::{is_own_seam, recut};
use super::{ChangeOptions, Changed, Coedge, DEFAULT_TOLERANCE, Loop, Support};
use super::{TrimmedSurface, invalid};
use crate::error::Error;
use crate::pcurve::Pcurve;

impl TrimmedSurface {
    /// The face on `support`, which is the same surface in any other parameters, found by inversion along the loops. Loops and face
    /// are turned when the parameters turn; loops that cross a seam of `support` are cut there, with seam edges between the cuts.
    ///
    /// # Errors
    /// A point of a curve that is not on `support`, or whose inversion is not proven; [`Error::Unsupported`] for a curve that passes
    /// through a collapsed edge of `support` between its ends, or a region that leaves the domain where it is not closed.
    pub fn followed(&self, support: Support, options: &ChangeOptions) -> Result<Changed, Error> {
        let diagonal = support.bounding_box()?.diagonal();
        let tolerance = match options.tolerance {
            0.0 => DEFAULT_TOLERANCE * diagonal,
            t if t > 0.0 && t.is_finite() => t,
            t => return invalid(format!("tolerance: {t} is not a positive length")),
        };
        let mut follower = Follower::new(self.support(), &support, tolerance, diagonal)?;
        let turned = follower.is_turned(self)?;
        let mut courses = Vec::new();
        for chain in self.loops() {
            let pcurves = chain.coedges.iter().map(|coedge| &coedge.pcurve);
            courses.push(pcurves.map(|p| follower.course(p)).collect::<Result<Vec<_>, _>>()?);
        }
        let mut all = self.coedges().zip(courses.iter().flatten());
        let cut = all.any(|((k, i, _), course)| {
            let is_line = matches!(course, Course::Line { .. });
            follower.crosses(course) || is_line && is_own_seam(self, [k, i])
        });
        let plain = if cut { None } else { self.plainly(&follower, &courses, turned)? };
        let (edges, loops) = match plain {
            Some(mut loops) => {
                let new = loops.iter().flat_map(|chain| &chain.coedges);
                for (old, new) in self.coedges().zip(new) {
                    follower.prove(&old.2.pcurve, &new.pcurve)?;
                }
                if turned {
                    loops.iter_mut().for_each(super::change::reverse);
                }
                (self.edges().to_vec(), loops)
            }
            None => recut(&mut follower, self, courses, turned)?,
        };
        let (deviation, proven) = (follower.deviation, follower.proven);
        drop(follower);
        let face = Self::new(support, edges, loops, self.is_flipped() != turned)?;
        Ok(Changed { face, deviation, proven, surface_deviation: deviation, surface_proven: false })
    }

    /// The loops with every curve where it is; none when one of them bounds its face from the other side there: a seam or a pole
    /// of the new surface then lies in the face.
    fn plainly(
        &self,
        follower: &Follower,
        courses: &[Vec<Course>],
        turned: bool,
    ) -> Result<Option<Vec<Loop>>, Error> {
        let scale = Scale::of(follower.to)?;
        let mut loops = Vec::new();
        for (chain, courses) in self.loops().iter().zip(courses) {
            let pcurves = follower.settled(courses)?;
            let coedges = chain.coedges.iter().zip(pcurves).map(|(old, pcurve)| {
                let polyline = matches!(pcurve, Pcurve::Polyline(_));
                let same_parameter = old.same_parameter && polyline;
                Coedge { pcurve, same_parameter, ..*old }
            });
            let coedges: Vec<Coedge> = coedges.collect();
            let kind = kind_of(&coedges, &scale, follower.tolerance);
            if (kind == chain.kind) == turned {
                return Ok(None);
            }
            loops.push(Loop { kind: chain.kind, coedges });
        }
        Ok(Some(loops))
    }
}
