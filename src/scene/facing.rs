//! Normals and sides of feet on many members.

use super::{Scene, SceneFoot, Shape};
use crate::bounds::{Vector, norm, sub};
use crate::closest::FootPoint;
use crate::error::Error;
use crate::normal::{Facing, Normals, flag};

impl Scene {
    /// How the member faces at each foot, handed to `tell` with the foot's number: [`Normals::at`] of the member, turned
    /// with it. Feet on curves and feet without a member have no normal. `query` gives the query of a foot.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn facings(
        &self,
        feet: &dyn Fn(usize) -> SceneFoot,
        count: usize,
        query: &dyn Fn(usize) -> Option<Vector>,
        tell: &mut dyn FnMut(usize, Facing),
    ) -> Result<(), Error> {
        // Member by member: what is the same for all feet of one is computed once.
        let mut order = super::reserved(count)?;
        order.extend(0..count);
        order.sort_unstable_by_key(|&i| (feet(i).member, i));
        let mut order = &order[..];
        while let Some(&first) = order.first() {
            let number = feet(first).member;
            let alike = order.partition_point(|&i| feet(i).member == number);
            let (group, rest) = order.split_at(alike);
            order = rest;
            let shape = self.members.get(number as usize).map(|member| &member.shape);
            let normals = match shape {
                Some(Shape::Surface(surface)) => Some(Normals::new(surface.surface())),
                _ => None,
            };
            for &i in group {
                tell(i, self.facing(normals.as_ref(), feet(i), query(i)));
            }
        }
        Ok(())
    }

    fn facing(&self, normals: Option<&Normals>, found: SceneFoot, query: Option<Vector>) -> Facing {
        let SceneFoot { foot, member } = found;
        let away = query.map_or(f64::NAN, |query| norm(sub(query, foot.point)));
        let none = Facing {
            normal: [f64::NAN; 3],
            signed: away,
            flags: flag::UNDEFINED | flag::AMBIGUOUS_SIDE,
        };
        let (Some(normals), Some(member)) = (normals, self.members.get(member as usize)) else {
            return none;
        };
        let (Shape::Surface(surface), true) =
            (&member.shape, foot.u.is_finite() && foot.v.is_finite())
        else {
            return none;
        };
        let point = surface.surface().evaluate(foot.u, foot.v);
        let entered = query.map(|query| member.placement.enter(query));
        let facing = normals.at(&FootPoint { point, ..foot }, entered);
        Facing {
            normal: member.placement.turn(facing.normal),
            signed: if facing.signed < 0.0 { -away } else { away },
            ..facing
        }
    }
}
