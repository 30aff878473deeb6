//! Inspection: curvatures, their ranges, sets of places, distances, continuity, pictures.

use super::curve::{self, fpt_curve};
use super::inspect_records::{
    choice, fpt_inspect_continuity, fpt_inspect_curvature, fpt_inspect_distance, fpt_inspect_kind,
    fpt_inspect_options, fpt_inspect_pattern, fpt_inspect_picture_options, fpt_inspect_place,
    fpt_inspect_quantity, fpt_inspect_range, fpt_inspect_range_flag, fpt_inspect_side,
    fpt_inspect_tooth, sized_or_default,
};
use super::limits::check_inside_at;
use super::memory::{array, output, place, product, shared, write};
use super::options::{check_length, restriction};
use super::query::Callbacks;
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::bounds::Vector;
use crate::index::{IndexedCurve, IndexedSurface};
use crate::inspect::{
    HausdorffOptions, Pattern, PictureOptions, Quantity, Range, RangeOptions, Shape, Side, Trend,
    continuity, curvatures, curve_range, hausdorff, inflections, monotone_pieces, picture,
    plane_normal, surface_range, tooth, umbilics,
};
use crate::knots;

/// Places of one kind, in order. Immutable, owned by the caller, released by fpt_inspect_set_free.
pub struct fpt_inspect_set {
    places: Vec<fpt_inspect_place>,
}

/// The options, checked but for what the core checks; `used` ends of the domain count.
///
/// # Safety
/// As [`super::options::sized`].
unsafe fn read(
    options: *const fpt_inspect_options,
    used: usize,
) -> Result<(fpt_inspect_options, RangeOptions, Callbacks), Failure> {
    // SAFETY: the caller vouches for it.
    let given = unsafe { sized_or_default("options", options) }?;
    check_length("accuracy", given.accuracy)?;
    if given.reserved != 0 {
        return Err(Failure::invalid(format!("reserved: {} must be 0", given.reserved)));
    }
    let budget = if given.budget > 0 { given.budget } else { RangeOptions::default().budget };
    let domain = restriction(&given.domain[..used])?;
    let core = RangeOptions { domain, relative: given.relative, side: side(given.side)?, budget };
    Ok((given, core, Callbacks::stopping(given.should_stop, given.user)))
}

fn side(number: u32) -> Result<Side, Failure> {
    use fpt_inspect_side::*;
    let sides = [
        (FPT_SIDE_BOTH as u32, Side::Both),
        (FPT_SIDE_LEAST as u32, Side::Least),
        (FPT_SIDE_GREATEST as u32, Side::Greatest),
    ];
    choice("side", number, &sides, "an fpt_inspect_side value")
}

fn quantity(number: u32) -> Result<Quantity, Failure> {
    use fpt_inspect_quantity::*;
    let quantities = [
        (FPT_QUANTITY_GREATER as u32, Quantity::Greater),
        (FPT_QUANTITY_LESS as u32, Quantity::Less),
        (FPT_QUANTITY_MEAN as u32, Quantity::Mean),
        (FPT_QUANTITY_GAUSSIAN as u32, Quantity::Gaussian),
        (FPT_QUANTITY_SHARPEST as u32, Quantity::Sharpest),
    ];
    choice("quantity", number, &quantities, "an fpt_inspect_quantity value")
}

fn pattern(number: u32) -> Result<Pattern, Failure> {
    use fpt_inspect_pattern::*;
    let patterns = [
        (FPT_PATTERN_SHADED as u32, Pattern::Shaded),
        (FPT_PATTERN_ZEBRA as u32, Pattern::Zebra),
        (FPT_PATTERN_ISOPHOTES as u32, Pattern::Isophotes),
        (FPT_PATTERN_REFLECTION_LINES as u32, Pattern::ReflectionLines),
        (FPT_PATTERN_HIGHLIGHT_LINES as u32, Pattern::HighlightLines),
        (FPT_PATTERN_GREATER as u32, Pattern::Greater),
        (FPT_PATTERN_LESS as u32, Pattern::Less),
        (FPT_PATTERN_MEAN as u32, Pattern::Mean),
        (FPT_PATTERN_GAUSSIAN as u32, Pattern::Gaussian),
    ];
    choice("pattern", number, &patterns, "an fpt_inspect_pattern value")
}

fn record(range: &Range, domain: [f64; 4]) -> fpt_inspect_range {
    let extent = |[a, b, c, d]: [f64; 4]| (b - a) * if d > c { d - c } else { 1.0 };
    let excluded: f64 = range.excluded.iter().map(|area| extent(*area)).sum();
    fpt_inspect_range {
        least: range.least,
        greatest: range.greatest,
        at_least: range.at_least,
        at_greatest: range.at_greatest,
        excluded: excluded / extent(domain),
        moved: range.moved,
        boxes: range.boxes,
        proven: range.proven.into(),
        flags: flags(range),
    }
}

fn flags(range: &Range) -> u32 {
    use fpt_inspect_range_flag::*;
    let falls = range.unbounded.iter().any(|place| place.falls);
    let grows = range.unbounded.iter().any(|place| place.grows);
    let bit = |is_set: bool, flag: u32| if is_set { flag } else { 0 };
    bit(falls, FPT_RANGE_LEAST_UNBOUNDED as u32)
        | bit(grows, FPT_RANGE_GREATEST_UNBOUNDED as u32)
        | bit(range.rest_proven, FPT_RANGE_REST_PROVEN as u32)
}

/// The excluded boxes: first those in which a place without bound is proven.
fn excluded(range: &Range) -> Vec<fpt_inspect_place> {
    let box_of = |[u0, u1, v0, v1]: [f64; 4], value: [f64; 2], kind: fpt_inspect_kind| {
        fpt_inspect_place { u: [u0, u1], v: [v0, v1], value, kind: kind as u32, reserved: 0 }
    };
    let kind = fpt_inspect_kind::FPT_PLACE_UNBOUNDED;
    let unbounded = range.unbounded.iter().map(|place| box_of(place.domain, place.at, kind));
    let is_told = |area: &&[f64; 4]| range.unbounded.iter().any(|place| place.domain == **area);
    let kind = fpt_inspect_kind::FPT_PLACE_EXCLUDED;
    let others = range.excluded.iter().filter(|area| !is_told(area));
    unbounded.chain(others.map(|area| box_of(*area, [0.0; 2], kind))).collect()
}

/// The range of the curvature of a curve or a part of it, proven: no sampling.
///
/// @param options  domain, relative, budget; NULL: the defaults
/// @return FPT_UNSUPPORTED for a curve from a callback and for degrees above 23, rational ones above 15
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_curve_range(
    curve: *const fpt_curve,
    options: *const fpt_inspect_options,
    out: *mut fpt_inspect_range,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, options and room for a record.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?;
        let (_, options, callbacks) = read(options, 2)?;
        let range = curve_range(curve, &options, &mut || callbacks.poll(0, 0))?;
        let (start, end) = curve.curve().domain();
        write("out", record(&range, [start, end, 0.0, 0.0]), out)
    })
}

/// The range of a curvature over a surface or a part of it, proven: no sampling. 1 / greatest of FPT_QUANTITY_SHARPEST bounds the
/// least radius of curvature.
///
/// Cost: about ten microseconds a box; from a hundred boxes (bicubic, calm) to thousands (constant curvature, many patches).
///
/// @param quantity  a value of fpt_inspect_quantity
/// @param options   domain, relative, budget; NULL: the defaults
/// @return FPT_UNSUPPORTED for a surface from a callback and for degrees above 23, rational ones above 15
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_surface_range(
    surface: *const fpt_surface,
    quantity: u32,
    options: *const fpt_inspect_options,
    out: *mut fpt_inspect_range,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, options and room for a record.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?;
        let quantity = self::quantity(quantity)?;
        let (_, options, callbacks) = read(options, 4)?;
        let range = surface_range(surface, quantity, &options, &mut || callbacks.poll(0, 0))?;
        write("out", record(&range, surface.surface().domain()), out)
    })
}

/// As fpt_inspect_surface_range, and the boxes of the domain that the range excludes, when there are any: beside tips and cusps.
/// Of those of kind FPT_PLACE_UNBOUNDED it is proven that the quantity has no bound there; of those of kind FPT_PLACE_EXCLUDED
/// nothing is.
///
/// @param quantity  a value of fpt_inspect_quantity
/// @param options   domain, relative, budget; NULL: the defaults
/// @param places    the boxes; release the set with fpt_inspect_set_free
/// @return as fpt_inspect_surface_range
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_surface_range_places(
    surface: *const fpt_surface,
    quantity: u32,
    options: *const fpt_inspect_options,
    out: *mut fpt_inspect_range,
    places: *mut *mut fpt_inspect_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, options, room for a record and for a handle.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?;
        let quantity = self::quantity(quantity)?;
        let (_, options, callbacks) = read(options, 4)?;
        let places = place("places", places)?;
        let out = place("out", out)?;
        let range = surface_range(surface, quantity, &options, &mut || callbacks.poll(0, 0))?;
        *out = record(&range, surface.surface().domain());
        hand_over(excluded(&range), places);
        Ok(())
    })
}

/// The teeth of a curvature comb.
///
/// @param parameters  `count` parameters in the domain; at a knot the right-sided piece counts, at the domain's end the left one
/// @param out         room for `count` records
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_comb(
    curve: *const fpt_curve,
    parameters: *const f64,
    count: usize,
    out: *mut fpt_inspect_tooth,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, an array and room for as many records.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?.curve();
        let parameters = array("parameters", parameters, count)?;
        let (start, end) = curve.domain();
        for (i, &u) in parameters.iter().enumerate() {
            check_inside_at("parameters", i, "u", u, start, end)?;
        }
        for (out, &u) in output("out", out, count)?.iter_mut().zip(parameters) {
            let t = tooth(curve, u, knots::Side::Above);
            let (point, tangent, bend) = (t.point, t.tangent, t.bend);
            let (curvature, torsion) = (t.curvature, t.torsion);
            *out = fpt_inspect_tooth { u, point, tangent, bend, curvature, torsion };
        }
        Ok(())
    })
}

/// Curvatures and principal directions at places of a surface.
///
/// @param parameters  `count` pairs u,v in the domain
/// @param out         room for `count` records
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_curvatures(
    surface: *const fpt_surface,
    parameters: *const f64,
    count: usize,
    out: *mut fpt_inspect_curvature,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, an array of pairs and room for as many records.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?.surface();
        product("parameters", count, 2)?;
        let parameters = array("parameters", parameters.cast::<[f64; 2]>(), count)?;
        let [u0, u1, v0, v1] = surface.domain();
        for (i, &[u, v]) in parameters.iter().enumerate() {
            check_inside_at("parameters", i, "u", u, u0, u1)?;
            check_inside_at("parameters", i, "v", v, v0, v1)?;
        }
        for (out, &at) in output("out", out, count)?.iter_mut().zip(parameters) {
            *out = match curvatures(surface, at, [knots::Side::Above; 2]) {
                Some(c) => fpt_inspect_curvature {
                    point: c.point,
                    normal: c.normal,
                    principal: c.principal,
                    directions: std::array::from_fn(|k| c.directions[k / 3][k % 3]),
                    mean: c.mean,
                    gaussian: c.gaussian,
                    is_umbilic: c.is_umbilic.into(),
                    is_singular: 0,
                },
                None => singular(),
            };
        }
        Ok(())
    })
}

fn singular() -> fpt_inspect_curvature {
    let nan = f64::NAN;
    fpt_inspect_curvature {
        point: [nan; 3],
        normal: [nan; 3],
        principal: [nan; 2],
        directions: [nan; 6],
        mean: nan,
        gaussian: nan,
        is_umbilic: 0,
        is_singular: 1,
    }
}

fn hand_over(places: Vec<fpt_inspect_place>, out: &mut *mut fpt_inspect_set) {
    *out = Box::into_raw(Box::new(fpt_inspect_set { places }));
}

/// The pieces of a curve on which the curvature is monotone, in order: kinds FPT_PLACE_RISING to FPT_PLACE_UNKNOWN. Complete: none
/// holds an extremum of the curvature inside, but those of unknown kind.
///
/// @param out  the set; release it with fpt_inspect_set_free
/// @return FPT_UNSUPPORTED for a curve from a callback and for degrees above 17, rational ones above 9
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_monotone_pieces(
    curve: *const fpt_curve,
    out: *mut *mut fpt_inspect_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let pieces = monotone_pieces(curve::indexed(curve)?)?;
        let kind = |trend: Trend| match trend {
            Trend::Rising => fpt_inspect_kind::FPT_PLACE_RISING,
            Trend::Falling => fpt_inspect_kind::FPT_PLACE_FALLING,
            Trend::Constant => fpt_inspect_kind::FPT_PLACE_CONSTANT,
            Trend::Unknown => fpt_inspect_kind::FPT_PLACE_UNKNOWN,
        };
        let record = |piece: &crate::inspect::Monotone| fpt_inspect_place {
            u: piece.u,
            v: [0.0; 2],
            value: piece.curvature,
            kind: kind(piece.trend) as u32,
            reserved: 0,
        };
        hand_over(pieces.iter().map(record).collect(), out);
        Ok(())
    })
}

/// The places where a curve, seen along a direction, changes the side to which it bends or is straight, in order: kinds
/// FPT_PLACE_INFLECTION and FPT_PLACE_STRAIGHT.
///
/// @param normal  3 numbers, not 0; NULL: across the plane that the poles lie in, at least about
/// @param out     the set; release it with fpt_inspect_set_free
/// @return FPT_UNSUPPORTED for a curve from a callback and for degrees above 17, rational ones above 9
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_inflections(
    curve: *const fpt_curve,
    normal: *const f64,
    out: *mut *mut fpt_inspect_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, three numbers or NULL, and room for a handle.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?;
        let normal: Vector = if normal.is_null() {
            plane_normal(curve.curve())
        } else {
            let given = array("normal", normal, 3)?;
            [given[0], given[1], given[2]]
        };
        let out = place("out", out)?;
        let record = |found: &crate::inspect::Inflection| {
            let kind = if found.changes {
                fpt_inspect_kind::FPT_PLACE_INFLECTION
            } else {
                fpt_inspect_kind::FPT_PLACE_STRAIGHT
            };
            let (u, value) = (found.interval, [found.u, 0.0]);
            fpt_inspect_place { u, v: [0.0; 2], value, kind: kind as u32, reserved: 0 }
        };
        hand_over(inflections(curve, normal)?.iter().map(record).collect(), out);
        Ok(())
    })
}

/// Boxes outside of which the principal curvatures of a surface are proven to differ: kinds FPT_PLACE_UMBILIC and
/// FPT_PLACE_UMBILIC_AREA. Planes and spheres are one large box.
///
/// @param options  domain, budget; NULL: the defaults
/// @param out      the set; release it with fpt_inspect_set_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_umbilics(
    surface: *const fpt_surface,
    options: *const fpt_inspect_options,
    out: *mut *mut fpt_inspect_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, options and room for a handle.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?;
        let (_, options, callbacks) = read(options, 4)?;
        let out = place("out", out)?;
        let record = |found: &crate::inspect::Umbilic| {
            let kind = if found.is_small {
                fpt_inspect_kind::FPT_PLACE_UMBILIC
            } else {
                fpt_inspect_kind::FPT_PLACE_UMBILIC_AREA
            };
            let [u0, u1, v0, v1] = found.domain;
            let value = [found.difference, 0.0];
            fpt_inspect_place { u: [u0, u1], v: [v0, v1], value, kind: kind as u32, reserved: 0 }
        };
        let found = umbilics(surface, &options, &mut || callbacks.poll(0, 0))?;
        hand_over(found.iter().map(record).collect(), out);
        Ok(())
    })
}

/// The number of places of a set.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_set_count(
    set: *const fpt_inspect_set,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a number.
    guard(|| unsafe { write("out_count", shared("set", set)?.places.len(), out_count) })
}

/// A place of a set.
///
/// @param index  below the count, else FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_set_get(
    set: *const fpt_inspect_set,
    index: usize,
    out: *mut fpt_inspect_place,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let places = &shared("set", set)?.places;
        let found = places.get(index).copied().ok_or_else(|| {
            let count = places.len();
            Failure::invalid(format!("index: {index} is not below the count of {count}"))
        })?;
        write("out", found, out)
    })
}

/// Releases a set. NULL is fine.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_set_free(set: *mut fpt_inspect_set) {
    if !set.is_null() {
        // SAFETY: made by Box::into_raw and not released before (the header's rule).
        drop(unsafe { Box::from_raw(set) });
    }
}

/// One of two handles.
fn either<'a>(
    names: &'static str,
    curve: Option<&'a IndexedCurve>,
    surface: Option<&'a IndexedSurface>,
) -> Result<Shape<'a>, Failure> {
    match (curve, surface) {
        (Some(curve), None) => Ok(Shape::Curve(curve)),
        (None, Some(surface)) => Ok(Shape::Surface(surface)),
        _ => Err(Failure::invalid(format!("{names}: exactly one of the two must not be NULL"))),
    }
}

/// The Hausdorff distance between two shapes, between proven bounds: it is the greater of both directions. Of each shape exactly one
/// handle is given.
///
/// @param curve_a       the first shape, or NULL
/// @param surface_a     the first shape, or NULL
/// @param curve_b       the second shape, or NULL
/// @param surface_b     the second shape, or NULL
/// @param options       accuracy, budget (for each direction); NULL: the defaults
/// @param out_forward   from the first shape to the second
/// @param out_backward  from the second shape to the first
/// @return FPT_UNSUPPORTED for shapes from callbacks
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_hausdorff(
    curve_a: *const fpt_curve,
    surface_a: *const fpt_surface,
    curve_b: *const fpt_curve,
    surface_b: *const fpt_surface,
    options: *const fpt_inspect_options,
    out_forward: *mut fpt_inspect_distance,
    out_backward: *mut fpt_inspect_distance,
) -> fpt_status {
    // SAFETY: the header asks for live handles or NULL, options and room for two records.
    guard(|| unsafe {
        let curves =
            [curve_a, curve_b].map(|curve| (!curve.is_null()).then(|| curve::indexed(curve)));
        let surfaces = [surface_a, surface_b]
            .map(|surface| (!surface.is_null()).then(|| surface::indexed(surface)));
        let [curve_a, curve_b] = curves.map(Option::transpose);
        let [surface_a, surface_b] = surfaces.map(Option::transpose);
        let first = either("curve_a", curve_a?, surface_a?)?;
        let second = either("curve_b", curve_b?, surface_b?)?;
        let (given, _, callbacks) = read(options, 0)?;
        let options = HausdorffOptions { accuracy: given.accuracy, budget: given.budget };
        let forward = place("out_forward", out_forward)?;
        let backward = place("out_backward", out_backward)?;
        let found = hausdorff(first, second, &options, &mut || callbacks.poll(0, 0))?;
        (*forward, *backward) = (found.forward.into(), found.backward.into());
        Ok(())
    })
}

/// How a border of one surface meets a border of another: gap, angle of the normals, jump of the curvature across, each with bounds.
///
/// @param side_a   border of surface_a: 0 u = u0, 1 u = u1, 2 v = v0, 3 v = v1
/// @param side_b   border of surface_b
/// @param options  should_stop only; NULL: the defaults
/// @return FPT_UNSUPPORTED for surfaces from callbacks and for degrees above 23, rational ones above 15
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_border(
    surface_a: *const fpt_surface,
    side_a: u32,
    surface_b: *const fpt_surface,
    side_b: u32,
    options: *const fpt_inspect_options,
    out: *mut fpt_inspect_continuity,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options and room for a record.
    guard(|| unsafe {
        let (a, b) = (surface::indexed(surface_a)?, surface::indexed(surface_b)?);
        let (_, _, callbacks) = read(options, 0)?;
        let out = place("out", out)?;
        let (side_a, side_b) = (side_a as usize, side_b as usize);
        let found = continuity(a, side_a, b, side_b, &mut || callbacks.poll(0, 0))?;
        *out = fpt_inspect_continuity {
            gap: found.gap.into(),
            angle: found.angle.into(),
            curvature: found.curvature.into(),
            intervals: found.intervals,
        };
        Ok(())
    })
}

/// A picture of a surface: pixels, row by row from above, red, green and blue of each.
///
/// @param options     what is drawn; NULL: the defaults
/// @param capacity    bytes that out_pixels has room for, at least 3 x width x height
/// @param out_pixels  the pixels
/// @param out_range   2 numbers: values of the ends of the colours of curvature, 0 for other patterns; NULL: not wanted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_picture(
    surface: *const fpt_surface,
    options: *const fpt_inspect_picture_options,
    capacity: usize,
    out_pixels: *mut u8,
    out_range: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, options and room for pixels and two numbers.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?.surface();
        let given = sized_or_default("options", options)?;
        let pattern = pattern(given.pattern)?;
        let (width, height) = (given.width as usize, given.height as usize);
        let needed = product("capacity", product("capacity", width, height)?, 3)?;
        if capacity < needed {
            let text = format!("capacity: {capacity} is less than the {needed} bytes asked for");
            return Err(Failure::invalid(text));
        }
        let pixels = output("out_pixels", out_pixels, needed)?;
        let options = PictureOptions {
            pattern,
            size: [width, height],
            eye: given.eye,
            up: given.up,
            light: given.light,
            bands: given.bands as usize,
            range: given.range,
        };
        let made = picture(surface, &options)?;
        if !out_range.is_null() {
            output("out_range", out_range, 2)?.copy_from_slice(&made.range);
        }
        pixels.copy_from_slice(&made.pixels);
        Ok(())
    })
}
