//! Preimages on a face.

use super::{Face, FaceWorkspace};
use crate::bounds::Vector;
use crate::closest::QueryOptions;
use crate::error::Error;
use crate::index::Poll;
use crate::set::{FootSet, Kind, Member};

/// Places of an arc or a region that are tried in either direction.
const TRIED: usize = 65;
const TRIED_IN_REGION: usize = 17;

impl Face {
    /// All parameters of the face whose point lies within `tolerance` (0: 1e-7 of the surface's box diagonal) of `query`: those of
    /// the surface, [`IndexedSurface::preimage`], that lie in the face or whose point an edge passes within the tolerance.
    ///
    /// The intervals of arcs and regions are those on the surface. One of which only a sliver may belong to the face is
    /// undecided.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when `poll` said so, [`Error::OutOfMemory`].
    ///
    /// [`IndexedSurface::preimage`]: crate::index::IndexedSurface::preimage
    pub fn preimage(
        &self,
        query: Vector,
        tolerance: f64,
        options: &QueryOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        let whole = QueryOptions { domain: None, ..*options };
        let set = self.ground.preimage(query, tolerance, &whole, poll)?;
        let mut workspace = FaceWorkspace::default();
        let mut kept = FootSet::default();
        for member in set.members {
            let at = [member.foot.u, member.foot.v];
            if self.holds(at, &mut workspace) || self.is_on_edge(at, tolerance, &mut workspace) {
                kept.members.push(member);
                continue;
            }
            let area = [member.u[0], member.u[1], member.v[0], member.v[1]];
            if member.kind == Kind::Point || !self.region.may_cross(&area) {
                continue;
            }
            match self.place_inside(&member, &mut workspace) {
                Some(at) => kept.members.push(self.member_at(query, member, at)),
                None => kept.undecided.push(area),
            }
        }
        for area in set.undecided {
            let middle = [0.5 * (area[0] + area[1]), 0.5 * (area[2] + area[3])];
            if self.region.may_cross(&area) || self.holds(middle, &mut workspace) {
                kept.undecided.push(area);
            }
        }
        Ok(kept)
    }

    fn is_on_edge(&self, at: [f64; 2], tolerance: f64, workspace: &mut FaceWorkspace) -> bool {
        let options = QueryOptions { tolerance, ..QueryOptions::default() };
        self.classify(at, &options, workspace).standing == super::Standing::OnEdge
    }

    /// A place of an arc or a region that the face holds.
    fn place_inside(&self, member: &Member, workspace: &mut FaceWorkspace) -> Option<[f64; 2]> {
        let count = match member.kind {
            Kind::Point => [1, 1],
            Kind::ArcU => [TRIED, 1],
            Kind::ArcV => [1, TRIED],
            Kind::Region => [TRIED_IN_REGION; 2],
        };
        let along = |[low, high]: [f64; 2], own: f64, k: usize, count: usize| {
            if count == 1 { own } else { low + (high - low) * (k as f64 / (count - 1) as f64) }
        };
        let places = (0..count[0] * count[1]).map(|n| {
            let (i, j) = (n / count[1], n % count[1]);
            [
                along(member.u, member.foot.u, i, count[0]),
                along(member.v, member.foot.v, j, count[1]),
            ]
        });
        places.into_iter().find(|&at| self.holds(at, workspace))
    }

    fn member_at(&self, query: Vector, member: Member, at: [f64; 2]) -> Member {
        let point = self.support.evaluate(at);
        let distance = self.distance(query, at);
        let lower_bound = member.foot.lower_bound.min(distance);
        let foot = crate::closest::FootPoint {
            u: at[0],
            v: at[1],
            point,
            distance,
            lower_bound,
            ..member.foot
        };
        Member { foot, ..member }
    }
}
