//! The boundary as C sees it: every call goes through the exported functions.

use super::curve::*;
use super::options::*;
use super::query::*;
use super::records::*;
use super::surface::*;
use super::*;
use std::ffi::{c_int, c_void};
use std::mem::{MaybeUninit, offset_of, size_of};
use std::ptr::{null, null_mut};
use std::thread::{self, ThreadId};

const NULL: fpt_status = FPT_NULL_ARGUMENT as fpt_status;
const INVALID: fpt_status = FPT_INVALID_ARGUMENT as fpt_status;
const OK: fpt_status = FPT_OK as fpt_status;

/// The text of the last failure of this thread.
fn text() -> String {
    // SAFETY: the function returns a text that ends with NUL and lives as long as the thread.
    unsafe { CStr::from_ptr(fpt_last_error()) }.to_str().unwrap().to_owned()
}

/// Asserts a refusal whose text begins with `begin`.
#[track_caller]
fn refused(status: fpt_status, expected: fpt_status, begin: &str) {
    assert_eq!((status, text().starts_with(begin)), (expected, true), "{}", text());
}

const KNOTS: [f64; 6] = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
const POLES: [f64; 9] = [0.0, 0.0, 0.0, 1.0, 2.0, 0.0, 2.0, 0.0, 0.0];
const LINE: [f64; 4] = [0.0, 0.0, 2.0, 2.0];
const NET: [f64; 18] = [0., 0., 0., 0., 1., 0., 1., 0., 1., 1., 1., 1., 2., 0., 0., 2., 1., 0.];

fn curve_data() -> fpt_curve_data {
    fpt_curve_data {
        struct_size: size_of::<fpt_curve_data>(),
        degree: 2,
        pole_count: 3,
        knots: KNOTS.as_ptr(),
        poles: POLES.as_ptr(),
        weights: null(),
    }
}

/// Quadratic in u, linear in v on [0, 1] x [0, 2].
fn surface_data() -> fpt_surface_data {
    fpt_surface_data {
        struct_size: size_of::<fpt_surface_data>(),
        degree_u: 2,
        degree_v: 1,
        pole_count_u: 3,
        pole_count_v: 2,
        knots_u: KNOTS.as_ptr(),
        knots_v: LINE.as_ptr(),
        poles: NET.as_ptr(),
        weights: null(),
    }
}

/// A handle that its test releases.
struct Curve(*mut fpt_curve);
struct Surface(*mut fpt_surface);

impl Curve {
    fn new() -> Self {
        let mut out = null_mut();
        // SAFETY: the data is complete.
        assert_eq!(unsafe { fpt_curve_new(&curve_data(), &mut out) }, OK);
        Self(out)
    }
}

impl Surface {
    fn new() -> Self {
        let mut out = null_mut();
        // SAFETY: the data is complete.
        assert_eq!(unsafe { fpt_surface_new(&surface_data(), &mut out) }, OK);
        Self(out)
    }

    /// The call that the option tests share: two query points, packed.
    fn closest(&self, options: *const fpt_query_options) -> (fpt_status, [fpt_foot_point; 2]) {
        let points = [0.5, 0.5, 3.0, 1.5, 0.5, 3.0];
        let mut out = untouched();
        // SAFETY: two points and two records.
        let status =
            unsafe { fpt_surface_closest(self.0, points.as_ptr(), 2, options, out.as_mut_ptr()) };
        (status, out)
    }

    #[track_caller]
    fn refuses(&self, options: fpt_query_options, begin: &str) {
        let (status, out) = self.closest(&options);
        refused(status, INVALID, begin);
        assert!(out.iter().all(|foot| foot.flags == MARK), "an output was touched");
    }
}

impl Drop for Curve {
    fn drop(&mut self) {
        // SAFETY: released once.
        unsafe { fpt_curve_free(self.0) }
    }
}

impl Drop for Surface {
    fn drop(&mut self) {
        // SAFETY: released once.
        unsafe { fpt_surface_free(self.0) }
    }
}

const MARK: u32 = 0xdead;

fn untouched() -> [fpt_foot_point; 2] {
    std::array::from_fn(|_| fpt_foot_point {
        u: -7.0,
        v: -7.0,
        point: [-7.0; 3],
        distance: -7.0,
        lower_bound: -7.0,
        flags: MARK,
        iterations: 0,
    })
}

fn options() -> fpt_query_options {
    fpt_query_options::default()
}

#[test]
fn a_shape_gives_back_what_went_in() {
    let (curve, surface) = (Curve::new(), Surface::new());
    let (mut knots, mut poles, mut weights) = ([9.0; 6], [9.0; 18], [9.0; 6]);
    let (mut count, mut yes, mut edges) = (0, 7, [7; 4]);
    // SAFETY: every array has the room that is stated.
    unsafe {
        assert_eq!(fpt_curve_degree(curve.0, &mut count), OK);
        assert_eq!(count, 2);
        assert_eq!(fpt_curve_pole_count(curve.0, &mut count), OK);
        assert_eq!(count, 3);
        assert_eq!(fpt_curve_knots(curve.0, 6, knots.as_mut_ptr()), OK);
        assert_eq!(knots, KNOTS);
        assert_eq!(fpt_curve_poles(curve.0, 18, poles.as_mut_ptr()), OK);
        assert_eq!(poles[..9], POLES);
        assert_eq!(poles[9..], [9.0; 9]);
        assert_eq!(fpt_curve_weights(curve.0, 3, weights.as_mut_ptr()), OK);
        assert_eq!(weights, [1.0, 1.0, 1.0, 9.0, 9.0, 9.0]);
        assert_eq!(fpt_curve_is_rational(curve.0, &mut yes), OK);
        assert_eq!(yes, 0);
        assert_eq!(fpt_surface_degree_u(surface.0, &mut count), OK);
        assert_eq!(count, 2);
        assert_eq!(fpt_surface_degree_v(surface.0, &mut count), OK);
        assert_eq!(count, 1);
        assert_eq!(fpt_surface_pole_count_u(surface.0, &mut count), OK);
        assert_eq!(count, 3);
        assert_eq!(fpt_surface_pole_count_v(surface.0, &mut count), OK);
        assert_eq!(count, 2);
        assert_eq!(fpt_surface_knots_v(surface.0, 4, knots.as_mut_ptr()), OK);
        assert_eq!(knots[..4], LINE);
        assert_eq!(fpt_surface_knots_u(surface.0, 6, knots.as_mut_ptr()), OK);
        assert_eq!(knots, KNOTS);
        assert_eq!(fpt_surface_poles(surface.0, 18, poles.as_mut_ptr()), OK);
        assert_eq!(poles, NET);
        assert_eq!(fpt_surface_collapsed_edges(surface.0, edges.as_mut_ptr()), OK);
        assert_eq!(edges, [0; 4]);
        assert_eq!(fpt_surface_box(surface.0, knots.as_mut_ptr()), OK);
        assert_eq!(knots, [0.0, 0.0, 0.0, 2.0, 1.0, 1.0]);
        assert_eq!(fpt_surface_domain(surface.0, weights.as_mut_ptr()), OK);
        assert_eq!(weights[..4], [0.0, 1.0, 0.0, 2.0]);
    }
}

#[test]
fn a_capacity_that_is_too_small_is_named_and_nothing_is_written() {
    let (curve, mut out) = (Curve::new(), [9.0; 6]);
    // SAFETY: the array has more room than is stated.
    unsafe {
        refused(fpt_curve_knots(curve.0, 5, out.as_mut_ptr()), INVALID, "capacity: 5");
        refused(fpt_curve_poles(curve.0, 0, null_mut()), INVALID, "capacity: 0");
        refused(fpt_curve_weights(curve.0, 2, out.as_mut_ptr()), INVALID, "capacity: 2");
    }
    assert_eq!(out, [9.0; 6]);
}

#[test]
fn every_missing_pointer_is_named() {
    let (curve, surface, mut out) = (Curve::new(), Surface::new(), null_mut());
    let mut records = untouched();
    let feet = records.as_mut_ptr();
    // SAFETY: NULL is refused before anything is read.
    unsafe {
        refused(fpt_curve_new(null(), &mut out), NULL, "data");
        refused(fpt_curve_new(&curve_data(), null_mut()), NULL, "out");
        let data = fpt_curve_data { knots: null(), ..curve_data() };
        refused(fpt_curve_new(&data, &mut out), NULL, "knots");
        let data = fpt_curve_data { poles: null(), ..curve_data() };
        refused(fpt_curve_new(&data, &mut out), NULL, "poles");
        let mut other = null_mut();
        let data = fpt_surface_data { knots_v: null(), ..surface_data() };
        refused(fpt_surface_new(&data, &mut other), NULL, "knots_v");
        refused(fpt_curve_domain(null(), [0.0; 2].as_mut_ptr()), NULL, "curve");
        refused(fpt_curve_domain(curve.0, null_mut()), NULL, "out_u");
        refused(fpt_surface_is_closed_u(surface.0, null_mut()), NULL, "out_is_closed_u");
        refused(fpt_curve_evaluate(curve.0, 0.0, 0, null_mut()), NULL, "out");
        refused(fpt_surface_prepare(null()), NULL, "surface");
        refused(fpt_surface_closest(surface.0, null(), 1, null(), feet), NULL, "points");
        refused(fpt_curve_invert(null(), POLES.as_ptr(), 1, null(), feet), NULL, "curve");
        refused(fpt_curve_closest(curve.0, POLES.as_ptr(), 1, null(), null_mut()), NULL, "out");
        fpt_curve_free(null_mut());
        fpt_surface_free(null_mut());
    }
    assert!(out.is_null());
}

#[test]
fn no_queries_are_no_error_with_any_pointers() {
    let (curve, surface) = (Curve::new(), Surface::new());
    // SAFETY: nothing is read or written.
    unsafe {
        assert_eq!(fpt_curve_closest(curve.0, null(), 0, null(), null_mut()), OK);
        assert_eq!(fpt_surface_invert(surface.0, null(), 0, null(), null_mut()), OK);
        assert_eq!(fpt_surface_evaluate_many(surface.0, null(), 0, 3, null_mut()), OK);
    }
}

#[test]
fn counts_that_overflow_are_refused_before_anything_is_read() {
    let (curve, mut feet) = (Curve::new(), untouched());
    let (mut out, mut other, huge) = (null_mut(), null_mut(), usize::MAX / 2);
    // SAFETY: the counts are refused.
    unsafe {
        let data = fpt_curve_data { pole_count: huge, ..curve_data() };
        refused(fpt_curve_new(&data, &mut out), INVALID, "pole_count: ");
        let data = fpt_curve_data { degree: huge, ..curve_data() };
        refused(fpt_curve_new(&data, &mut out), INVALID, "degree: ");
        let data =
            fpt_surface_data { pole_count_u: 1 << 40, pole_count_v: 1 << 40, ..surface_data() };
        refused(fpt_surface_new(&data, &mut other), INVALID, "poles: ");
        let status = fpt_curve_closest(curve.0, POLES.as_ptr(), huge, null(), feet.as_mut_ptr());
        refused(status, INVALID, "points: ");
        let mut values = [0.0; 3];
        let status = fpt_curve_evaluate_many(
            curve.0,
            POLES.as_ptr(),
            usize::MAX / 4096 + 1,
            31,
            values.as_mut_ptr(),
        );
        refused(status, INVALID, "out: ");
    }
}

#[test]
fn a_bad_number_in_a_shape_is_named_with_its_index() {
    let (mut out, mut other) = (null_mut(), null_mut());
    let mut poles = POLES;
    poles[7] = f64::NAN;
    let data = fpt_curve_data { poles: poles.as_ptr(), ..curve_data() };
    // SAFETY: the arrays are complete.
    refused(unsafe { fpt_curve_new(&data, &mut out) }, INVALID, "poles: pole 2 is not finite");
    let knots = [0.0, 0.0, 2.0, f64::INFINITY];
    let data = fpt_surface_data { knots_v: knots.as_ptr(), ..surface_data() };
    // SAFETY: the arrays are complete.
    refused(unsafe { fpt_surface_new(&data, &mut other) }, INVALID, "knots_v: knot 3");
    let data = fpt_surface_data { weights: [1., 1., -1., 1., 1., 1.].as_ptr(), ..surface_data() };
    // SAFETY: the arrays are complete.
    refused(unsafe { fpt_surface_new(&data, &mut other) }, INVALID, "weights: weight");
    assert!(out.is_null() && other.is_null());
}

#[test]
fn shape_data_must_be_complete() {
    let mut out = null_mut();
    for struct_size in [0, 8, 24, size_of::<fpt_curve_data>() - 8, usize::MAX] {
        let data = fpt_curve_data { struct_size, ..curve_data() };
        // SAFETY: the struct is longer than is believed of it.
        let status = unsafe { fpt_curve_new(&data, &mut out) };
        refused(status, INVALID, "data: struct_size");
    }
    assert!(out.is_null());
}

/// Options followed by a field of a later version.
#[repr(C)]
struct Later {
    known: fpt_query_options,
    field: u64,
}

#[test]
fn options_of_other_versions_follow_the_rule_of_sizes() {
    let surface = Surface::new();
    let known = fpt_query_options { struct_size: size_of::<Later>(), ..options() };
    assert_eq!(surface.closest(std::ptr::from_ref(&Later { known, field: 0 }).cast()).0, OK);
    let (status, _) = surface.closest(std::ptr::from_ref(&Later { known, field: 1 }).cast());
    refused(status, FPT_UNSUPPORTED as fpt_status, "options: struct_size");

    // Cut before `method`, the invalid method is not seen: the default counts.
    let cut = offset_of!(fpt_query_options, method);
    let short = fpt_query_options { struct_size: cut, method: 77, ..options() };
    assert_eq!(surface.closest(&short).0, OK);
    let long = fpt_query_options { struct_size: cut + 4, ..short };
    surface.refuses(long, "method: 77");
    for struct_size in [0, 7, cut + 1, size_of::<fpt_query_options>() - 1, 4097, usize::MAX] {
        surface.refuses(fpt_query_options { struct_size, ..options() }, "options: struct_size");
    }
}

#[test]
fn init_touches_exactly_the_bytes_it_was_given() {
    let full = size_of::<fpt_query_options>();
    for size in [0, 4, 8, 44, full, full + 16] {
        let mut memory = [MaybeUninit::<u64>::new(u64::MAX); 40];
        // SAFETY: the memory is larger than each size and aligned.
        unsafe { fpt_query_options_init(memory.as_mut_ptr().cast(), size) };
        let bytes = memory.iter().flat_map(|word| {
            // SAFETY: every word was written above.
            unsafe { word.assume_init() }.to_ne_bytes()
        });
        let bytes: Vec<u8> = bytes.collect();
        let written = if size < 8 { 0 } else { size };
        assert!(bytes[written..].iter().all(|&byte| byte == 0xff), "size {size}");
        if written > 0 {
            assert_eq!(bytes[..8], size.to_ne_bytes());
            assert!(bytes[8..written].iter().all(|&byte| byte == 0));
        }
    }
}

#[test]
fn options_that_are_excluded_are_named() {
    let surface = Surface::new();
    let o = options();
    surface.refuses(fpt_query_options { method: 4, ..o }, "method: 4");
    surface.refuses(fpt_query_options { scope: 2, ..o }, "scope: 2");
    surface.refuses(fpt_query_options { reserved: 1, ..o }, "reserved: 1");
    for length in [-1.0, f64::NAN, f64::INFINITY] {
        surface.refuses(fpt_query_options { tolerance: length, ..o }, "tolerance: ");
        surface.refuses(fpt_query_options { accuracy: length, ..o }, "accuracy: ");
    }
    let nan = [0.0, 1.0, f64::NAN, 1.0];
    surface.refuses(fpt_query_options { domain: nan, ..o }, "domain: domain[2]");
    for domain in [[0.0, 1.0, 0.0, 3.0], [0.5, 0.5, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]] {
        surface.refuses(fpt_query_options { domain, ..o }, "domain: ");
    }
    for stride in [8, 16, 23, 25, 28] {
        surface.refuses(fpt_query_options { point_stride: stride, ..o }, "point_stride: ");
    }
    let hints = [0.5, 0.5, 0.5, f64::NEG_INFINITY];
    let with = fpt_query_options { hints: hints.as_ptr(), ..o };
    surface.refuses(with, "hints: hint 1 is infinite");
    surface.refuses(fpt_query_options { hint_stride: 8, ..with }, "hint_stride: 8");
}

#[test]
fn on_a_curve_two_ends_of_the_restriction_count() {
    let curve = Curve::new();
    let mut feet = untouched();
    let domain = [0.25, 0.75, f64::NAN, -1.0];
    let options = fpt_query_options { domain, ..options() };
    // SAFETY: three points are there, two are asked for.
    let status =
        unsafe { fpt_curve_closest(curve.0, POLES.as_ptr(), 2, &options, feet.as_mut_ptr()) };
    assert_eq!(status, OK);
    assert!(feet.iter().all(|foot| (0.25..=0.75).contains(&foot.u)));
}

#[test]
fn rows_apart_and_unaligned_give_the_packed_answers() {
    let surface = Surface::new();
    let (_, packed) = surface.closest(null());
    // One byte of another field, then rows of 40 bytes.
    let mut memory = [0xff_u8; 1 + 80];
    for (row, point) in memory[1..].chunks_mut(40).zip([[0.5, 0.5, 3.0], [1.5, 0.5, 3.0_f64]]) {
        for (bytes, x) in row.chunks_mut(8).zip(point) {
            bytes.copy_from_slice(&x.to_ne_bytes());
        }
    }
    let mut apart = untouched();
    let options = fpt_query_options { point_stride: 40, ..options() };
    let points = memory[1..].as_ptr().cast();
    // SAFETY: two rows of 40 bytes.
    let status = unsafe { fpt_surface_closest(surface.0, points, 2, &options, apart.as_mut_ptr()) };
    assert_eq!(status, OK);
    for (a, b) in packed.iter().zip(&apart) {
        assert_eq!((a.u, a.v, a.point, a.flags), (b.u, b.v, b.point, b.flags));
    }
}

#[test]
fn arrays_that_are_read_in_place_must_be_aligned() {
    let mut out = null_mut();
    let memory = [0.0_f64; 8];
    let knots = memory.as_ptr().wrapping_byte_add(4);
    let data = fpt_curve_data { knots, ..curve_data() };
    // SAFETY: 6 numbers are there, though not aligned.
    refused(unsafe { fpt_curve_new(&data, &mut out) }, INVALID, "knots: must be aligned");
}

#[test]
fn evaluation_outside_is_named_and_writes_nothing() {
    let (curve, surface, mut out) = (Curve::new(), Surface::new(), [9.0; 6]);
    let at = out.as_mut_ptr();
    // SAFETY: two points of room.
    unsafe {
        refused(fpt_curve_evaluate(curve.0, 1.5, 0, at), INVALID, "u: 1.5 is outside");
        refused(fpt_curve_evaluate(curve.0, f64::NAN, 0, at), INVALID, "u: NaN is outside");
        refused(fpt_surface_evaluate(surface.0, 0.5, 2.5, 0, at), INVALID, "v: 2.5");
        refused(fpt_surface_evaluate(surface.0, 0.5, 0.5, 32, at), INVALID, "derivatives: 32");
        let us = [0.5, -0.5];
        let status = fpt_curve_evaluate_many(curve.0, us.as_ptr(), 2, 0, at);
        refused(status, INVALID, "parameters: u of entry 1: -0.5");
        let uvs = [0.5, 0.5, 1.0, 2.5];
        let status = fpt_surface_evaluate_many(surface.0, uvs.as_ptr(), 2, 0, at);
        refused(status, INVALID, "parameters: v of entry 1: 2.5");
    }
    assert_eq!(out, [9.0; 6]);
}

#[test]
fn many_evaluations_are_the_single_ones() {
    let surface = Surface::new();
    let uvs = [0.0, 0.0, 0.25, 1.5, 1.0, 2.0];
    let (mut many, mut one) = ([9.0; 3 * 18], [9.0; 18]);
    // SAFETY: 6 vectors for each of 3 pairs.
    unsafe {
        let status = fpt_surface_evaluate_many(surface.0, uvs.as_ptr(), 3, 2, many.as_mut_ptr());
        assert_eq!(status, OK);
        for (uv, values) in uvs.chunks(2).zip(many.chunks(18)) {
            assert_eq!(fpt_surface_evaluate(surface.0, uv[0], uv[1], 2, one.as_mut_ptr()), OK);
            assert_eq!(values, one);
        }
    }
    assert_eq!(many[..3], [0.0; 3]);
    assert_eq!(many[36..39], [2.0, 1.0, 0.0]);
}

/// What the callbacks below write down.
#[derive(Default)]
struct Notes {
    threads: Vec<ThreadId>,
    done: Vec<(usize, usize)>,
    steps: Vec<(usize, u32)>,
    stop_after: usize,
}

/// # Safety
/// `user` is a `Notes` that only this thread uses.
unsafe fn notes<'a>(user: *mut c_void) -> &'a mut Notes {
    // SAFETY: the caller vouches for it.
    unsafe { &mut *user.cast() }
}

unsafe extern "C" fn progress(user: *mut c_void, done: usize, total: usize) {
    // SAFETY: the tests below pass their notes.
    let notes = unsafe { notes(user) };
    notes.threads.push(thread::current().id());
    notes.done.push((done, total));
}

unsafe extern "C" fn should_stop(user: *mut c_void) -> c_int {
    // SAFETY: the tests below pass their notes.
    let notes = unsafe { notes(user) };
    notes.threads.push(thread::current().id());
    c_int::from(notes.done.len() > notes.stop_after)
}

unsafe extern "C" fn trace(user: *mut c_void, query: usize, step: u32, _: f64, _: f64, _: f64) {
    // SAFETY: the tests below pass their notes.
    let notes = unsafe { notes(user) };
    notes.threads.push(thread::current().id());
    notes.steps.push((query, step));
}

#[test]
fn callbacks_run_on_the_calling_thread_and_progress_ends_complete() {
    let (surface, mut notes) = (Surface::new(), Notes { stop_after: 1000, ..Notes::default() });
    let told = fpt_query_options {
        progress: Some(progress),
        should_stop: Some(should_stop),
        user: (&raw mut notes).cast(),
        ..options()
    };
    assert_eq!(surface.closest(&told).0, OK);
    assert_eq!(surface.closest(&fpt_query_options { trace: Some(trace), ..told }).0, OK);
    assert!(notes.threads.iter().all(|&id| id == thread::current().id()));
    assert_eq!(notes.done.last(), Some(&(2, 2)));
    for query in 0..2 {
        assert!(notes.steps.contains(&(query, 0)), "query {query} has no start");
    }
}

#[test]
fn records_that_a_stop_left_out_are_marked() {
    let (surface, mut notes) = (Surface::new(), Notes::default());
    let stopped = fpt_query_options {
        progress: Some(progress),
        should_stop: Some(should_stop),
        user: (&raw mut notes).cast(),
        ..options()
    };
    let (status, out) = surface.closest(&stopped);
    refused(status, FPT_CANCELLED as fpt_status, "cancelled");
    for foot in out {
        assert!(foot.u.is_nan() && foot.point[2].is_nan() && foot.distance.is_nan());
        let not_proven = fpt_foot_flag::FPT_FOOT_NOT_PROVEN as u32;
        assert_eq!((foot.lower_bound, foot.flags), (0.0, not_proven));
    }
    // The handle answers as before.
    assert_eq!(surface.closest(null()).0, OK);
}

#[test]
fn a_panic_becomes_a_status() {
    let internal = FPT_INTERNAL as fpt_status;
    let begin = "internal error, please report: ";
    refused(guard(|| panic!("plain")), internal, &format!("{begin}plain"));
    refused(guard(|| panic!("with {}", 7)), internal, &format!("{begin}with 7"));
    refused(guard(|| std::panic::panic_any(7)), internal, &format!("{begin}a panic without"));
}

#[test]
fn a_text_belongs_to_its_thread_stays_and_is_cut_between_characters() {
    refused(guard(|| Err(Failure::Null("here"))), NULL, "here: must not be NULL");
    thread::spawn(|| assert_eq!(text(), "")).join().unwrap();
    assert_eq!(guard(|| Ok(())), OK);
    assert_eq!(text(), "here: must not be NULL");
    let long = format!("x{}", "\u{e9}".repeat(600));
    assert_eq!(guard(|| Err(Failure::invalid(long))), INVALID);
    assert_eq!((text().len(), text().chars().count()), (TEXT_CAPACITY - 1, 256));
}

#[test]
fn names_and_numbers_of_the_interface() {
    assert_eq!(status_name(0), c"FPT_OK");
    assert_eq!(status_name(99), c"FPT_INTERNAL");
    assert_eq!(status_name(-1), c"FPT_?");
    assert_eq!(number("120"), 120);
    assert_eq!(fpt_version() / 1_000_000, MAJOR);
    assert_eq!(fpt_abi_version(), if MAJOR == 0 { MINOR } else { MAJOR * 1_000 });
}

#[cfg(feature = "panic-test")]
#[test]
fn a_panic_of_a_worker_becomes_a_status() {
    for threads in [1, 4] {
        refused(fpt_panic_test(threads), FPT_INTERNAL as fpt_status, "internal error");
    }
}
