//! Planes and quadrics in implicit form, and what becomes of them when a NURBS piece is put in.
//!
//! ```text
//!   q(x) = y.A y + 2 b.y + c,  y = x - origin          X/W put in, times W^2:  X.A X + 2 B.X W + C W^2
//! ```
//!
//! The result is a polynomial in Bernstein form, of twice the piece's degree (a plane: the same degree), scaled so
//! that its slope in space is about one where it vanishes: a small value is about a distance.
//!
//! Reference: Sederberg, *Implicit and parametric curves and surfaces for computer aided geometric design*, 1983.
//! Limit: a product has at most twice the degree 31.

use crate::bezier::{Bidegree, convolve, convolve_square, scale_down_2d, scale_up_2d};
use crate::bounds::{HALF_ULP, Vector, add, dot, norm, scaled, sub};
use crate::error::Error;
use crate::index::{Frame, position_steps, product_steps};
use crate::portable::SameDigits;

/// A plane or a quadric: `q(x) = y.A y + 2 b.y + c` with `y = x - origin`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadric {
    /// The point from which `y` counts: a centre, an apex, a point of the axis or of the plane.
    pub origin: Vector,
    /// The symmetric matrix A: xx, xy, xz, yy, yz, zz.
    pub matrix: [f64; 6],
    /// The vector b.
    pub linear: Vector,
    /// The number c.
    pub constant: f64,
    /// Size of the gradient where q vanishes, when that is the same everywhere.
    slope: Option<f64>,
}

/// What a length or an angle must be.
fn positive(name: &str, x: f64) -> Result<(), Error> {
    if x.is_finite() && x > 0.0 && x < 1e100 {
        return Ok(());
    }
    Err(Error::InvalidArgument(format!("{name}: {x} is not a finite number above 0")))
}

fn finite(name: &str, v: &[f64]) -> Result<(), Error> {
    match v.iter().position(|x| !x.is_finite() || x.abs() > 1e100) {
        Some(k) => {
            Err(Error::InvalidArgument(format!("{name}: entry {k} is not finite or beyond 1e100")))
        }
        None => Ok(()),
    }
}

/// The unit vector of a direction.
fn unit(name: &str, v: Vector) -> Result<Vector, Error> {
    finite(name, &v)?;
    let length = norm(v);
    if length < 1e-100 {
        return Err(Error::InvalidArgument(format!("{name}: shorter than 1e-100")));
    }
    let once = scaled(v, 1.0 / length);
    Ok(scaled(once, 1.0 / norm(once)))
}

/// `1 - k a a^T` as a symmetric matrix.
fn without_axis(a: Vector, k: f64) -> [f64; 6] {
    let at = |i: usize, j: usize| f64::from(u8::from(i == j)) - k * a[i] * a[j];
    [at(0, 0), at(0, 1), at(0, 2), at(1, 1), at(1, 2), at(2, 2)]
}

impl Quadric {
    /// The plane through a point with a normal of any length.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the entry.
    pub fn plane(origin: Vector, normal: Vector) -> Result<Self, Error> {
        finite("origin", &origin)?;
        let linear = scaled(unit("normal", normal)?, 0.5);
        Ok(Self { origin, matrix: [0.0; 6], linear, constant: 0.0, slope: Some(1.0) })
    }

    /// The sphere about a centre.
    ///
    /// # Errors
    /// As [`Self::plane`].
    pub fn sphere(centre: Vector, radius: f64) -> Result<Self, Error> {
        finite("origin", &centre)?;
        positive("radius", radius)?;
        let matrix = [1.0, 0.0, 0.0, 1.0, 0.0, 1.0];
        let constant = -radius * radius;
        Ok(Self { origin: centre, matrix, linear: [0.0; 3], constant, slope: Some(2.0 * radius) })
    }

    /// The infinite circular cylinder about an axis.
    ///
    /// # Errors
    /// As [`Self::plane`].
    pub fn cylinder(origin: Vector, axis: Vector, radius: f64) -> Result<Self, Error> {
        finite("origin", &origin)?;
        positive("radius", radius)?;
        let matrix = without_axis(unit("axis", axis)?, 1.0);
        let constant = -radius * radius;
        Ok(Self { origin, matrix, linear: [0.0; 3], constant, slope: Some(2.0 * radius) })
    }

    /// The infinite double cone with its apex, axis, and the angle between axis and generatrices, in radians, below a
    /// right angle.
    ///
    /// # Errors
    /// As [`Self::plane`].
    pub fn cone(apex: Vector, axis: Vector, half_angle: f64) -> Result<Self, Error> {
        finite("origin", &apex)?;
        if !(1e-9..std::f64::consts::FRAC_PI_2 - 1e-9).contains(&half_angle) {
            let text = format!("half_angle: {half_angle} is not between 0 and pi / 2");
            return Err(Error::InvalidArgument(text));
        }
        let cosine = half_angle.cosine();
        let matrix = without_axis(unit("axis", axis)?, 1.0 / (cosine * cosine));
        Ok(Self { origin: apex, matrix, linear: [0.0; 3], constant: 0.0, slope: None })
    }

    /// Any quadric by its numbers; A as xx, xy, xz, yy, yz, zz.
    ///
    /// # Errors
    /// As [`Self::plane`]; a form that is constant.
    pub fn general(
        origin: Vector,
        matrix: [f64; 6],
        linear: Vector,
        constant: f64,
    ) -> Result<Self, Error> {
        finite("origin", &origin)?;
        finite("matrix", &matrix)?;
        finite("linear", &linear)?;
        finite("constant", &[constant])?;
        if matrix == [0.0; 6] && linear == [0.0; 3] {
            let text = "matrix: all entries of it and of linear are 0".to_owned();
            return Err(Error::InvalidArgument(text));
        }
        Ok(Self { origin, matrix, linear, constant, slope: None })
    }

    /// Whether there is no quadratic part.
    pub fn is_plane(&self) -> bool {
        self.matrix == [0.0; 6]
    }

    /// `A y`.
    pub fn times(&self, y: Vector) -> Vector {
        let [a, b, c, d, e, f] = self.matrix;
        [
            a * y[0] + b * y[1] + c * y[2],
            b * y[0] + d * y[1] + e * y[2],
            c * y[0] + e * y[1] + f * y[2],
        ]
    }

    /// q at a point.
    pub fn value(&self, x: Vector) -> f64 {
        let y = sub(x, self.origin);
        dot(y, self.times(y)) + 2.0 * dot(self.linear, y) + self.constant
    }

    /// Gradient of q at a point.
    pub fn gradient(&self, x: Vector) -> Vector {
        let y = sub(x, self.origin);
        scaled(add(self.times(y), self.linear), 2.0)
    }

    /// About the distance of a point near the quadric: `|q| / |gradient|`.
    pub fn distance(&self, x: Vector) -> f64 {
        let (value, slope) = (self.value(x).abs(), norm(self.gradient(x)));
        let bend = self.size();
        if value == 0.0 {
            return 0.0;
        }
        // Near an apex the gradient vanishes too: then q is quadratic in the distance.
        if slope * slope >= value * bend { value / slope } else { (value / bend).sqrt() }
    }

    /// Greatest row sum of A.
    pub fn size(&self) -> f64 {
        let [a, b, c, d, e, f] = self.matrix.map(f64::abs);
        (a + b + c).max(b + d + e).max(c + e + f)
    }
}

/// A quadric in the coordinates of a piece, scaled.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    local: Quadric,
    /// Sum of the absolute terms of c.
    constant_size: f64,
}

/// A polynomial in Bernstein form with the error of its coefficients.
#[derive(Clone, Debug)]
pub struct Polynomial {
    /// Coefficients.
    pub values: Vec<f64>,
    /// Their bidegree.
    pub degree: Bidegree,
    /// How far each may be off.
    pub error: f64,
}

impl Form {
    /// The quadric as a piece with this centre (in the index's coordinates) sees it.
    pub fn new(quadric: &Quadric, frame: &Frame, center: Vector) -> Self {
        let unit = 1.0 / frame.scale;
        let e = scaled(add(frame.enter(quadric.origin).map(|x| -x), center), unit);
        let reach = norm(scaled(frame.enter(quadric.origin), unit)) + 2.0 * unit;
        let slope = quadric
            .slope
            .unwrap_or(2.0 * (quadric.size() * reach + norm(quadric.linear)))
            .max(f64::MIN_POSITIVE);
        let k = frame.scale / slope;
        let moved = add(quadric.times(e), quadric.linear);
        let terms = [dot(e, quadric.times(e)), 2.0 * dot(quadric.linear, e), quadric.constant];
        let size = quadric.size() * dot(e, e) + 2.0 * norm(quadric.linear) * norm(e);
        let local = Quadric {
            origin: [0.0; 3],
            matrix: quadric.matrix.map(|a| a * unit * unit * k),
            linear: scaled(moved, unit * k),
            constant: (terms[0] + terms[1] + terms[2]) * k,
            slope: None,
        };
        Self { local, constant_size: (3.0 * size + quadric.constant.abs()) * k }
    }

    /// Whether nothing within this distance of the centre is on the quadric.
    pub fn is_clear_of(&self, radius: f64) -> bool {
        let local = &self.local;
        let reach = local.size() * radius * radius + 2.0 * norm(local.linear) * radius;
        let slack = 1e-13 * (reach + self.constant_size + 2.0 * norm(local.linear));
        local.constant.abs() > reach + slack
    }

    /// The polynomial of a piece: its poles component by component, their greatest distance from the centre.
    pub fn put_in(
        &self,
        poles: &[f64],
        degree: Bidegree,
        rational: bool,
        radius: f64,
    ) -> Polynomial {
        let count = degree.count();
        let local = &self.local;
        let steps = position_steps(degree.s + degree.t);
        let size = local.size() * radius * radius
            + 2.0 * norm(local.linear) * (radius + 4.0)
            + self.constant_size;
        if local.is_plane() {
            let weight = |k: usize| if rational { poles[3 * count + k] } else { 1.0 };
            let at = |k: usize| {
                let x = [poles[k], poles[count + k], poles[2 * count + k]];
                2.0 * dot(local.linear, x) + local.constant * weight(k)
            };
            let values = (0..count).map(at).collect();
            let error = 4.0 * norm(local.linear) * (steps * radius + 16.0 * HALF_ULP)
                + (16.0 * HALF_ULP + if rational { steps } else { 0.0 })
                    * (self.constant_size + 2.0 * norm(local.linear) * radius);
            return Polynomial { values, degree, error: 2.0 * error };
        }
        let twice = degree.times(degree);
        let mut net = poles.to_vec();
        net.resize(4 * count, 1.0);
        for component in net.chunks_exact_mut(count) {
            scale_up_2d(component, degree);
        }
        let part = |c: usize| &net[c * count..(c + 1) * count];
        let mut values = vec![0.0; twice.count()];
        let [xx, xy, xz, yy, yz, zz] = local.matrix;
        for (c, a) in [(0, xx), (1, yy), (2, zz)] {
            if a != 0.0 {
                convolve_square(part(c), degree, a, &mut values);
            }
        }
        for ([c, d], a) in [([0, 1], xy), ([0, 2], xz), ([1, 2], yz)] {
            if a != 0.0 {
                convolve(part(c), degree, part(d), degree, 2.0 * a, &mut values);
            }
        }
        for c in 0..3 {
            if local.linear[c] != 0.0 {
                convolve(part(c), degree, part(3), degree, 2.0 * local.linear[c], &mut values);
            }
        }
        convolve_square(part(3), degree, local.constant, &mut values);
        scale_down_2d(&mut values, twice);
        // The greatest weight is below 2.
        let weight = if rational { 4.0 } else { 1.0 };
        let error = (2.0 * steps + 2.0 * product_steps(10 * count)) * size * weight;
        Polynomial { values, degree: twice, error }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Curve;
    use crate::index::IndexedCurve;

    #[test]
    fn a_line_put_into_a_sphere_is_the_parabola_of_its_distance() {
        let poles = [[1000.0, -2.0, 0.0], [1000.0, 2.0, 0.0]];
        let curve = IndexedCurve::new(Curve::new(&[0., 0., 1., 1.], 1, &poles, None).unwrap());
        let index = curve.index(&mut || false).unwrap();
        let sphere = Quadric::sphere([1000.0, 0.0, 0.0], 1.0).unwrap();
        let segment = &index.segments[0];
        let form = Form::new(&sphere, &index.frame, segment.center);
        let f = form.put_in(index.net(0).poles, Bidegree { s: 0, t: 1 }, false, segment.radius);
        // (4 t - 2)^2 - 1 = 3, -5, 3 in Bernstein form, over the slope 2, in units of 4. The bound counts the worst of all
        // roundings: a few thousand half ulps.
        let expected = [3.0, -5.0, 3.0].map(|x| x / 2.0 / 4.0);
        for (value, wanted) in f.values.iter().zip(expected) {
            assert!((value - wanted).abs() <= f.error && f.error < 1e-12, "{value} {wanted}");
        }
    }

    #[test]
    fn refusals_name_what_is_wrong() {
        let text = |made: Result<Quadric, Error>| made.unwrap_err().to_string();
        assert!(text(Quadric::plane([0.0; 3], [0.0; 3])).starts_with("normal: shorter"));
        assert!(text(Quadric::sphere([f64::NAN, 0.0, 0.0], 1.0)).starts_with("origin: entry 0"));
        assert!(text(Quadric::cylinder([0.0; 3], [1.0; 3], -1.0)).starts_with("radius: -1"));
        assert!(text(Quadric::cone([0.0; 3], [1.0; 3], 2.0)).starts_with("half_angle: 2"));
    }
}
