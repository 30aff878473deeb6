//! Functions whose digits do not depend on the system: angles and powers from `libm`, which is the same code everywhere.
//!
//! Those of the standard library call the mathematics of the operating system, which rounds its own way. `tests/pains.rs` keeps
//! them out. Errors are below one ulp; the price is some ten nanoseconds a call, and none is on the path of a query.

/// See the module.
pub trait SameDigits: Sized {
    /// sin x.
    fn sine(self) -> f64;
    /// cos x.
    fn cosine(self) -> f64;
    /// Both.
    fn sine_cosine(self) -> (f64, f64);
    /// tan x.
    fn tangent(self) -> f64;
    /// In [-pi/2, pi/2].
    fn arcsine(self) -> f64;
    /// In [0, pi].
    fn arccosine(self) -> f64;
    /// In [-pi/2, pi/2].
    fn arctangent(self) -> f64;
    /// The angle of the vector (x, self), in [-pi, pi].
    fn arctangent_over(self, x: f64) -> f64;
    /// e^x.
    fn exponential(self) -> f64;
    /// Natural logarithm.
    fn logarithm(self) -> f64;
    /// self^y.
    fn power(self, y: f64) -> f64;
    /// sqrt(self^2 + y^2) without overflow.
    fn hypotenuse(self, y: f64) -> f64;
    /// Cube root.
    fn cube_root(self) -> f64;
}

impl SameDigits for f64 {
    fn sine(self) -> f64 {
        libm::sin(self)
    }

    fn cosine(self) -> f64 {
        libm::cos(self)
    }

    fn sine_cosine(self) -> (f64, f64) {
        libm::sincos(self)
    }

    fn tangent(self) -> f64 {
        libm::tan(self)
    }

    fn arcsine(self) -> f64 {
        libm::asin(self)
    }

    fn arccosine(self) -> f64 {
        libm::acos(self)
    }

    fn arctangent(self) -> f64 {
        libm::atan(self)
    }

    fn arctangent_over(self, x: f64) -> f64 {
        libm::atan2(self, x)
    }

    fn exponential(self) -> f64 {
        libm::exp(self)
    }

    fn logarithm(self) -> f64 {
        libm::log(self)
    }

    fn power(self, y: f64) -> f64 {
        libm::pow(self, y)
    }

    fn hypotenuse(self, y: f64) -> f64 {
        libm::hypot(self, y)
    }

    fn cube_root(self) -> f64 {
        libm::cbrt(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_within_an_ulp_of_the_systems() {
        for k in -200..200 {
            let x = 0.037 * f64::from(k);
            let near =
                |a: f64, b: f64| assert!((a - b).abs() <= 4e-16 * (1.0 + b.abs()), "{x}: {a} {b}");
            near(x.sine(), x.sin());
            near(x.cosine(), x.cos());
            near(x.arctangent_over(0.7), x.atan2(0.7));
            near(x.hypotenuse(0.3), x.hypot(0.3));
            near((x / 8.0).arcsine(), (x / 8.0).asin());
            near((0.1 * x).exponential(), (0.1 * x).exp());
        }
    }
}
