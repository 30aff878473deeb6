//! Quadrics and the torus: products of an ellipse and a profile.
//!
//! ```text
//!   pole (c, s; w) of the ellipse x pole (r, h; x) of the profile = O + r (a c X + b s Y) + h Z  of weight w x
//!
//!   ellipsoid             r = cos t   h = z sin t     profile a circle's arc
//!   one sheet             r = cosh t  h = z sinh t    profile a hyperbola's arc
//!   two sheets, a half    r = sinh t  h = z cosh t
//!   paraboloid            r = t       h = z t^2       profile a parabola's arc
//!   elliptic cone         r = t       h = z t         profile a line
//!   elliptic cylinder     r = 1       h = z t
//!   saddle                x^2/a^2 - y^2/b^2           a polynomial of degree 2 by 2
//! ```
//!
//! Circular cylinders, cones, spheres and tori are those of [`crate::elementary`].

use super::conic::{ArcForm, bezier_knots};
use super::{check_interval, check_number, check_positive, invalid};
use crate::bounds::{Vector, add};
use crate::elementary::{Axes, CircleForm, Elementary, ElementarySurface};
use crate::error::Error;
use crate::portable::SameDigits;
use crate::surface::Surface;

/// A quadric with an axis, by its semi-axes a, b across and z along; t is its parameter along the profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quadric {
    /// `cos t`, `sin t`: t is a latitude, within -pi/2 .. pi/2.
    Ellipsoid,
    /// `cosh t`, `sinh t`.
    OneSheet,
    /// `sinh t`, `cosh t`: one of the two halves, t at least 0.
    TwoSheets,
    /// `t`, `t^2`: t at least 0.
    Paraboloid,
    /// `t`, `t`: t at least 0.
    Cone,
    /// `1`, `t`.
    Cylinder,
}

/// Poles (r, h, weight), knots and degree of a profile.
type Profile = (Vec<[f64; 3]>, Vec<f64>, usize);

impl Quadric {
    fn profile(self, [start, end]: [f64; 2]) -> Result<Profile, Error> {
        check_interval("profile", [start, end])?;
        let from_zero = matches!(self, Self::TwoSheets | Self::Paraboloid | Self::Cone);
        if from_zero && start < 0.0 {
            return invalid(format!("profile: it begins at {start}, less than 0"));
        }
        let line = |r: [f64; 2]| {
            let poles = vec![[r[0], start, 1.0], [r[1], end, 1.0]];
            Ok((poles, vec![start, start, end, end], 1))
        };
        match self {
            Self::Ellipsoid => {
                use std::f64::consts::FRAC_PI_2;
                let slack = 4.0 * f64::EPSILON;
                if start < -FRAC_PI_2 - slack || end > FRAC_PI_2 + slack {
                    return invalid("profile: latitudes lie within -pi/2 .. pi/2".into());
                }
                let arc = ArcForm::usual(end - start).unit([start, end])?;
                Ok((arc.poles, arc.knots, arc.degree))
            }
            Self::OneSheet | Self::TwoSheets => {
                let (weight, middle) =
                    ((0.5 * (end - start)).hyperbolic_cosine(), 0.5 * (start + end));
                check_number("profile", weight)?;
                let at = |t: f64, w: f64| match self {
                    Self::OneSheet => [t.hyperbolic_cosine() / w, t.hyperbolic_sine() / w, w],
                    _ => [t.hyperbolic_sine() / w, t.hyperbolic_cosine() / w, w],
                };
                let poles = vec![at(start, 1.0), at(middle, weight), at(end, 1.0)];
                Ok((poles, bezier_knots(2), 2))
            }
            Self::Paraboloid => {
                let poles = vec![
                    [start, start * start, 1.0],
                    [0.5 * (start + end), start * end, 1.0],
                    [end, end * end, 1.0],
                ];
                Ok((poles, vec![start, start, start, end, end, end], 2))
            }
            Self::Cone => line([start, end]),
            Self::Cylinder => line([1.0, 1.0]),
        }
    }
}

/// The part of a quadric between two angles about the axis (u) and two parameters of its profile (v). `semi_axes` are a, b and z.
///
/// # Errors
/// Numbers that are not allowed, by name; a form that cannot make the sweep.
pub fn quadric(
    kind: Quadric,
    axes: &Axes,
    semi_axes: Vector,
    angles: [f64; 2],
    profile: [f64; 2],
    form: ArcForm,
) -> Result<Surface, Error> {
    let axes = axes.checked()?;
    let [a, b, z] = semi_axes;
    check_positive("radius_x", a)?;
    check_positive("radius_y", b)?;
    check_positive("radius_z", z)?;
    let across = form.unit(angles)?;
    let (along, knots_v, degree_v) = kind.profile(profile)?;
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for [c, s, w] in &across.poles {
        for [r, h, x] in &along {
            let local = [r * a * c, r * b * s, h * z];
            let vector =
                |k: usize| local[0] * axes.x[k] + local[1] * axes.y[k] + local[2] * axes.z[k];
            poles.push(add(axes.origin, [vector(0), vector(1), vector(2)]));
            weights.push(w * x);
        }
    }
    Surface::new(
        &across.knots,
        &knots_v,
        across.degree,
        degree_v,
        &poles,
        across.poles.len(),
        along.len(),
        Some(&weights),
    )
}

/// The hyperbolic paraboloid `origin + x X + y Y + (x^2/a^2 - y^2/b^2) Z` over a rectangle of x and y, which are its parameters.
///
/// # Errors
/// Numbers that are not allowed, by name.
pub fn saddle(axes: &Axes, [a, b]: [f64; 2], [x0, x1, y0, y1]: [f64; 4]) -> Result<Surface, Error> {
    let axes = axes.checked()?;
    check_positive("radius_x", a)?;
    check_positive("radius_y", b)?;
    check_interval("domain", [x0, x1])?;
    check_interval("domain", [y0, y1])?;
    // The polar form of a square is a product: exact poles.
    let pairs = |s: f64, t: f64| [[s, s], [s, t], [t, t]];
    let mut poles = Vec::new();
    for [s, t] in pairs(x0, x1) {
        for [p, q] in pairs(y0, y1) {
            let local = [0.5 * (s + t), 0.5 * (p + q), s * t / (a * a) - p * q / (b * b)];
            let vector =
                |k: usize| local[0] * axes.x[k] + local[1] * axes.y[k] + local[2] * axes.z[k];
            poles.push(add(axes.origin, [vector(0), vector(1), vector(2)]));
        }
    }
    let knots = |a: f64, b: f64| [a, a, a, b, b, b];
    Surface::new(&knots(x0, x1), &knots(y0, y1), 2, 2, &poles, 3, 3, None)
}

fn elementary(kind: Elementary, domain: [f64; 4]) -> Result<Surface, Error> {
    let surface = ElementarySurface::new(kind, domain)?;
    surface.nurbs(surface.usual_forms())
}

/// The rectangle `origin + u X + v Y` over u0, u1, v0, v1.
///
/// # Errors
/// Numbers that are not allowed, by name.
pub fn plane(axes: &Axes, domain: [f64; 4]) -> Result<Surface, Error> {
    elementary(Elementary::Plane { axes: *axes }, domain)
}

/// A circular cylinder between two angles and two heights.
///
/// # Errors
/// Numbers that are not allowed, by name.
pub fn cylinder(
    axes: &Axes,
    radius: f64,
    [u0, u1]: [f64; 2],
    [v0, v1]: [f64; 2],
) -> Result<Surface, Error> {
    elementary(Elementary::Cylinder { axes: *axes, radius }, [u0, u1, v0, v1])
}

/// A circular cone of a radius at height 0, between two angles and two lengths along its lines.
///
/// # Errors
/// Numbers that are not allowed, by name.
pub fn cone(
    axes: &Axes,
    radius: f64,
    half_angle: f64,
    [u0, u1]: [f64; 2],
    [v0, v1]: [f64; 2],
) -> Result<Surface, Error> {
    elementary(Elementary::Cone { axes: *axes, radius, half_angle }, [u0, u1, v0, v1])
}

/// A sphere between two longitudes and two latitudes.
///
/// # Errors
/// Numbers that are not allowed, by name.
pub fn sphere(
    axes: &Axes,
    radius: f64,
    [u0, u1]: [f64; 2],
    [v0, v1]: [f64; 2],
) -> Result<Surface, Error> {
    elementary(Elementary::Sphere { axes: *axes, radius }, [u0, u1, v0, v1])
}

/// A torus between two angles about the axis and two about the tube, in a form for each.
///
/// # Errors
/// Numbers that are not allowed, by name.
pub fn torus(
    axes: &Axes,
    [major, minor]: [f64; 2],
    [u0, u1]: [f64; 2],
    [v0, v1]: [f64; 2],
    forms: Option<[CircleForm; 2]>,
) -> Result<Surface, Error> {
    let kind = Elementary::Torus { axes: *axes, major, minor };
    let surface = ElementarySurface::new(kind, [u0, u1, v0, v1])?;
    surface.nurbs(forms.unwrap_or(surface.usual_forms()))
}
