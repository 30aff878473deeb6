//! Numbers that array lengths and evaluations depend on, checked before they are used.

use super::Failure;
use super::memory::check_extent;
use crate::knots::MAX_DEGREE;
use std::mem::size_of;

/// A degree and a pole count that array lengths may be computed from. `name` is "degree" with the side
/// of a surface behind it.
pub(super) fn check_degree(name: &str, degree: usize, pole_count: usize) -> Result<(), Failure> {
    if degree == 0 || degree > MAX_DEGREE {
        return Err(Failure::invalid(format!("{name}: {degree} is not 1 to {MAX_DEGREE}")));
    }
    let side = name.trim_start_matches("degree");
    if pole_count <= degree {
        let text = format!("pole_count{side}: {pole_count} is too few for degree {degree}");
        return Err(Failure::invalid(text));
    }
    check_extent(&format!("pole_count{side}"), pole_count, size_of::<[f64; 3]>())
}

/// A highest order of derivatives, as a count.
pub(super) fn check_order(derivatives: u32) -> Result<usize, Failure> {
    if derivatives > MAX_DEGREE as u32 {
        let text = format!("derivatives: {derivatives} is more than {MAX_DEGREE}");
        return Err(Failure::invalid(text));
    }
    Ok(derivatives as usize)
}

/// `u` inside `[from, to]`, which a NaN is not.
pub(super) fn check_inside(name: &str, u: f64, from: f64, to: f64) -> Result<(), Failure> {
    if from <= u && u <= to {
        return Ok(());
    }
    Err(Failure::invalid(format!("{name}: {u:?} is outside the domain {from:?} to {to:?}")))
}

/// As [`check_inside`], for a parameter of entry `i` in an array.
pub(super) fn check_inside_at(
    array: &str,
    i: usize,
    name: &str,
    u: f64,
    from: f64,
    to: f64,
) -> Result<(), Failure> {
    if from <= u && u <= to {
        return Ok(());
    }
    check_inside(&format!("{array}: {name} of entry {i}"), u, from, to)
}
