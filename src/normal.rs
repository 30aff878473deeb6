//! Normals, tangents and sides: how a shape faces at a foot, and on which side of it the query lies.
//!
//! Seen from very near, the surface around a foot is a fan of flat sectors: one at a smooth place, two at a crease, up
//! to four at a corner of patches, a whole cone at a collapsed edge.
//!
//! ```text
//!        q                     r = q - foot
//!         \   n1               N = sum of angle x unit normal over the sectors
//!          \  |                signed distance = sign(r.N) |r|
//!    -------foot--- sector 1
//!            \  -> n2
//!             \ sector 2
//! ```
//!
//! *Why this sign is right.* Let K be the cone behind the fan. Nothing on the surface is nearer to q than the foot, so
//! the half space `r.x > 0` lies wholly in front of the fan or wholly behind it. In front: the outer normals of the
//! part of K in the unit ball sum to zero, which reads `N / 2 + (integral of x over K on the unit sphere) = 0`; there
//! `r.x <= 0`, so `r.N >= 0`, and more than that unless K has no volume. Behind: the same with K's complement and
//! all signs changed. The normal of one sector alone can have the wrong sign, and so can sums with other weights.
//! Nothing is assumed but that the sectors do not cross each other near the foot; that the side is that of a solid
//! follows when the surface bounds one.
//!
//! *Limits.* Where the derivatives vanish or are parallel, normals are limits from inside each sector: the first term
//! of `Su x Sv` along three directions that does not vanish. Where they disagree the sector is no flat one; the cone
//! of its tangents in all directions takes its place. Without tangents the normal is undefined.
//!
//! Reference: Baerentzen, Aanaes, *Signed distance computation using the angle weighted pseudonormal*, 2005, for
//! meshes; the sectors of patches and the cone of a collapsed edge are ours.
//! Limits: a seam that is not parametrised alike on both borders is a border; two sheets folded onto each other have no
//! side at their fold.

mod fan;

mod limit;

mod tip;

mod tangent;

mod extent;

pub use extent::{of_curve, of_surface};
pub use tangent::Tangents;

use std::sync::OnceLock;

use crate::bounds::{Vector, dot, norm, scaled, sub};
use crate::closest::{FootPoint, flag as foot_flag};
use crate::knots::{Knots, Side};
use crate::surface::Surface;
use fan::Fan;
use limit::Corner;

/// Bits that go with normals and tangents.
pub mod flag {
    /// The side of the query cannot be told, or not from this foot alone; the sign is a guess.
    pub const AMBIGUOUS_SIDE: u32 = 1;
    /// Several normals meet: the one given is their mean, weighted by the angles of their sectors. Tangents: the
    /// tangent breaks, the one given leads on.
    pub const CREASE: u32 = 2;
    /// Taken as a limit: the derivatives do not give it.
    pub const LIMIT: u32 = 4;
    /// There is none, not even as a limit; it is NaN.
    pub const UNDEFINED: u32 = 8;
}

/// Normals, or tangents, that differ by less than this angle (radians) are the same.
const LEAST_BREAK: f64 = 1e-6;

/// Less than this share of the distance along the normal tells no side.
const LEAST_ALONG: f64 = 1e-9;

/// More than this share of the distance across the normal, at a border: the query lies beyond the border.
const MOST_ACROSS: f64 = 1e-6;

/// Rounding of a position, in units of its greatest coordinate.
const GRAIN: f64 = 32.0 * f64::EPSILON;

/// Parameters nearer to a knot than this, in units of the greatest parameter, count as the knot.
const SNAP: f64 = 4.0 * f64::EPSILON;

/// Nearer to an end of the domain than this share of it, a limit is that of the end.
const NEAR_END: f64 = 1e-7;

/// How a surface faces at a foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facing {
    /// Unit normal, in the direction of Su x Sv; NaN when undefined.
    pub normal: Vector,
    /// Distance of the query, negative behind the surface; NaN without a query.
    pub signed: f64,
    /// Bits of [`flag`].
    pub flags: u32,
}

impl Facing {
    /// What a foot without parameters has.
    const NONE: Self = Self {
        normal: [f64::NAN; 3],
        signed: f64::NAN,
        flags: flag::UNDEFINED | flag::AMBIGUOUS_SIDE,
    };
}

/// The normals of one surface: what is the same for all feet, computed once.
#[derive(Clone, Debug)]
pub struct Normals<'a> {
    surface: &'a Surface,
    ends: [[f64; 2]; 2],
    closed: [bool; 2],
    /// Whether the edges u0, u1, v0, v1 are collapsed, and their cones, made when a foot lies on them.
    collapsed: [bool; 4],
    tips: [OnceLock<Fan>; 4],
    /// Whether some edge is neither a seam nor collapsed.
    has_border: bool,
    grain: f64,
}

/// From which pieces a parameter can be approached: one when the shape is smooth there or ends there, two at a break.
#[derive(Clone, Copy)]
struct Approach {
    from: [(f64, Side); 2],
    count: usize,
    /// Whether each piece holds one side only.
    halved: bool,
    border: bool,
}

impl<'a> Normals<'a> {
    /// Looks at the borders of the surface.
    pub fn new(surface: &'a Surface) -> Self {
        let [u0, u1, v0, v1] = surface.domain();
        let closed = [surface.is_closed_u(), surface.is_closed_v()];
        let collapsed = surface.collapsed_edges();
        let open = |k: usize| !(closed[k] || collapsed[2 * k] && collapsed[2 * k + 1]);
        let (low, high) = surface.bounding_box();
        let magnitude = low.iter().chain(&high).fold(0.0, |m: f64, x| m.max(x.abs()));
        Self {
            surface,
            ends: [[u0, u1], [v0, v1]],
            closed,
            collapsed,
            tips: Default::default(),
            has_border: open(0) || open(1),
            grain: GRAIN * magnitude,
        }
    }

    /// The normal at a foot and, with its query, the side. Feet that are not numbers have none; parameters lie in the
    /// domain.
    pub fn at(&self, foot: &FootPoint, query: Option<Vector>) -> Facing {
        if !(foot.u.is_finite() && foot.v.is_finite()) {
            return Facing::NONE;
        }
        let fan = self.fan([foot.u, foot.v]);
        let r = query.map(|query| sub(query, foot.point));
        let Some((normal, folded)) = fan.direction() else {
            return Facing { signed: r.map_or(f64::NAN, norm), ..Facing::NONE };
        };
        let mut flags = 0;
        if fan.bent {
            flags |= flag::CREASE;
        }
        if fan.limit {
            flags |= flag::LIMIT;
        }
        let Some(r) = r else { return Facing { normal, signed: f64::NAN, flags } };
        let (distance, along) = (norm(r), dot(r, normal));
        let floor = self.grain + GRAIN * query.map_or(0.0, norm);
        let torn = self.has_border && foot.flags & foot_flag::TIE != 0;
        if folded || torn || is_ambiguous(&fan, normal, r, floor) {
            flags |= flag::AMBIGUOUS_SIDE;
        }
        let signed = if along < 0.0 { -distance } else { distance };
        Facing { normal, signed, flags }
    }

    /// The sectors around a place.
    fn fan(&self, at: [f64; 2]) -> Fan {
        let mut fan = Fan::default();
        for edge in 0..4 {
            let (k, end) = (edge / 2, self.ends[edge / 2][edge % 2]);
            if self.collapsed[edge] && (at[k] - end).abs() <= self.snap(k) {
                let cone = || tip::cone(self.surface, edge, self.closed[1 - k]);
                fan.merge(self.tips[edge].get_or_init(cone));
            }
        }
        if fan.limit {
            return fan;
        }
        let (mut u, mut v) = (self.approach(0, at[0]), self.approach(1, at[1]));
        if !self.collect(&u, &v, &mut fan) {
            (u, v) = (self.split(0, u), self.split(1, v));
            fan = self.limits(&u, &v);
        }
        fan.open = u.border || v.border;
        fan
    }

    /// The sectors of a place where derivatives do not give all normals.
    fn limits(&self, u: &Approach, v: &Approach) -> Fan {
        let mut fan = Fan::of_limits(false);
        for &u_side in &u.from[..u.count] {
            for &v_side in &v.from[..v.count] {
                let corner = Corner::new(self.surface, u_side, v_side);
                match corner.limit_normal() {
                    Some(normal) => fan.add(normal, corner.limit_angle()),
                    None if corner.add_cone(&mut fan) => fan.bent = true,
                    None => fan.undefined = true,
                }
            }
        }
        fan
    }

    /// Collects the sectors; false when the derivatives of one of them give no normal.
    fn collect(&self, u: &Approach, v: &Approach, fan: &mut Fan) -> bool {
        for &u_side in &u.from[..u.count] {
            for &v_side in &v.from[..v.count] {
                let corner = Corner::new(self.surface, u_side, v_side);
                let Some((normal, angle)) = corner.regular() else { return false };
                // Half planes, or the whole plane: equal shares.
                let whole = !u.halved || !v.halved;
                fan.add(normal, if whole { std::f64::consts::PI } else { angle });
            }
        }
        true
    }

    /// Both sides of a parameter at which no knot breaks, one by one. So near to an end of the domain that the
    /// limit is that of the end, the end itself.
    fn split(&self, k: usize, approach: Approach) -> Approach {
        if approach.halved {
            return approach;
        }
        let ([low, high], (x, _)) = (self.ends[k], approach.from[0]);
        let near = NEAR_END * (high - low);
        if x - low <= near {
            return self.approach(k, low);
        }
        if high - x <= near {
            return self.approach(k, high);
        }
        Approach {
            from: [(x, Side::Below), (x, Side::Above)],
            count: 2,
            halved: true,
            border: false,
        }
    }

    fn snap(&self, k: usize) -> f64 {
        SNAP * self.ends[k][0].abs().max(self.ends[k][1].abs())
    }

    fn knots(&self, k: usize) -> &Knots {
        [self.surface.knots_u(), self.surface.knots_v()][k]
    }

    fn approach(&self, k: usize, x: f64) -> Approach {
        let ([low, high], snap) = (self.ends[k], self.snap(k));
        let (at_low, at_high) = (x - low <= snap, high - x <= snap);
        let two = |from| Approach { from, count: 2, halved: true, border: false };
        let one = |from, border| Approach { from: [from; 2], count: 1, halved: border, border };
        if (at_low || at_high) && self.closed[k] {
            two([(high, Side::Below), (low, Side::Above)])
        } else if at_low {
            one((low, Side::Above), true)
        } else if at_high {
            one((high, Side::Below), true)
        } else if let Some(knot) = break_near(self.knots(k), x, snap) {
            two([(knot, Side::Below), (knot, Side::Above)])
        } else {
            one((x, Side::Above), false)
        }
    }
}

/// The knot within `snap` of `x` at which a spline may break: its multiplicity is the degree.
fn break_near(knots: &Knots, x: f64, snap: f64) -> Option<f64> {
    let values = knots.values();
    let knot = *values.get(values.partition_point(|&knot| knot < x - snap))?;
    (knot <= x + snap && knots.multiplicity(knot) >= knots.degree()).then_some(knot)
}

/// Whether the residual `r` tells no side of a fan with the mean normal `normal`.
fn is_ambiguous(fan: &Fan, normal: Vector, r: Vector, floor: f64) -> bool {
    let (distance, along) = (norm(r), dot(r, normal));
    let across = norm(sub(r, scaled(normal, along)));
    // Not a number: a query that is none.
    let clear = distance > floor && along.abs() > LEAST_ALONG * distance + floor;
    let beyond = fan.open && across > MOST_ACROSS * distance + floor;
    // Where the surface is smooth a foot lies straight below its query, or it is not the nearest point.
    let aslant = !fan.bent && along.abs() < 0.5 * distance;
    !clear || beyond || aslant
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closest::FootPoint;

    /// Two planes that meet in the line x = z = 0; the second one leads to (x, z).
    fn bent(x: f64, z: f64) -> Surface {
        let poles: Vec<Vector> = [[-1.0, 0.0], [0.0, 0.0], [x, z]]
            .into_iter()
            .flat_map(|[x, z]| [[x, -1.0, z], [x, 1.0, z]])
            .collect();
        let knots = [0.0, 0.0, 1.0, 2.0, 2.0];
        Surface::new(&knots, &[0.0, 0.0, 1.0, 1.0], 1, 1, &poles, 3, 2, None).unwrap()
    }

    fn facing(surface: &Surface, at: [f64; 2], query: Vector) -> Facing {
        let point = surface.evaluate(at[0], at[1]);
        let foot = FootPoint { u: at[0], v: at[1], point, flags: 0, ..FootPoint::unreached() };
        Normals::new(surface).at(&foot, Some(query))
    }

    #[test]
    fn behind_one_face_of_a_sharp_crease_the_mean_normal_tells_the_side() {
        // An edge of 48 degrees; the query is in front of the first face and behind the plane of the second.
        let above = facing(&bent(-0.9, -1.0), [1.0, 0.5], [0.05, 0.0, 1.0]);
        assert_eq!((above.flags, above.signed > 0.0), (flag::CREASE, true));
        let below = facing(&bent(-0.9, 1.0), [1.0, 0.5], [0.05, 0.0, -1.0]);
        assert_eq!((below.flags, below.signed < 0.0), (flag::CREASE, true));
    }

    #[test]
    fn a_knot_line_without_a_break_is_no_crease() {
        let facing = facing(&bent(1.0, 0.0), [1.0, 0.5], [0.0, 0.0, -2.0]);
        assert_eq!((facing.flags, facing.signed, facing.normal), (0, -2.0, [0.0, 0.0, 1.0]));
    }

    #[test]
    fn beyond_a_border_the_side_is_a_guess() {
        let surface = bent(1.0, 0.0);
        let facing = |query| self::facing(&surface, [0.0, 0.5], query).flags;
        assert_eq!(facing([-1.0, 0.0, 0.0]), flag::AMBIGUOUS_SIDE);
        assert_eq!(facing([-2.0, 0.0, 1.0]), flag::AMBIGUOUS_SIDE);
        assert_eq!(facing([-1.0, 0.0, 1.0]), 0);
    }

    #[test]
    fn a_point_on_the_surface_has_no_side() {
        let facing = facing(&bent(1.0, 0.3), [0.5, 0.5], [-0.5, 0.0, 0.0]);
        assert_eq!((facing.flags, facing.signed), (flag::AMBIGUOUS_SIDE, 0.0));
    }
}
