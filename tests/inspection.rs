//! Hausdorff distances, continuity along borders, umbilics, pictures: closed forms.

mod revolved;
mod shapes;

use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::inspect::{
    HausdorffOptions, Pattern, PictureOptions, RangeOptions, Shape, continuity, curvatures,
    hausdorff, picture, umbilics,
};
use footpoint::knots::Side;
use footpoint::surface::Surface;
use revolved::{circle, ellipsoid, revolved};
use shapes::{Random, Vector, norm, sub};

const LINE: [f64; 4] = [0., 0., 1., 1.];

fn plane(corners: [Vector; 4]) -> IndexedSurface {
    IndexedSurface::new(Surface::new(&LINE, &LINE, 1, 1, &corners, 2, 2, None).unwrap())
}

fn ellipse(a: f64, b: f64) -> IndexedCurve {
    let (knots, poles) = circle([0.0; 3], 1.0);
    let moved: Vec<Vector> = poles.iter().map(|(p, _)| [a * p[0], b * p[2], 0.0]).collect();
    let weights: Vec<f64> = poles.iter().map(|p| p.1).collect();
    IndexedCurve::new(Curve::new(&knots, 2, &moved, Some(&weights)).unwrap())
}

fn assert_bounds(bounds: [f64; 2], value: f64, accuracy: f64) {
    let slack = 1e-12 * value;
    assert!(bounds[0] <= value + slack && value <= bounds[1] + slack, "{bounds:?} {value}");
    assert!(bounds[1] - bounds[0] <= accuracy, "{bounds:?} {value}");
}

#[test]
fn the_distance_of_an_ellipse_from_a_circle_is_that_of_its_far_end() {
    let (circle, ellipse) = (ellipse(1.0, 1.0), ellipse(1.3, 0.9));
    let options = HausdorffOptions { accuracy: 1e-4, ..HausdorffOptions::default() };
    let (a, b) = (Shape::Curve(&ellipse), Shape::Curve(&circle));
    let found = hausdorff(a, b, &options, &mut || false).unwrap();
    assert!(found.forward.proven && found.backward.proven, "{found:?}");
    assert_bounds([found.forward.lower, found.forward.upper], 0.3, 1.1e-4);
    assert_bounds(found.bounds(), 0.3, 1.1e-4);
}

#[test]
fn concentric_spheres_are_apart_by_the_difference_of_their_radii() {
    let (inner, outer) = (ellipsoid([1.0; 3]), ellipsoid([1.02; 3]));
    let (inner, outer) = (IndexedSurface::new(inner), IndexedSurface::new(outer));
    let options = HausdorffOptions { accuracy: 2e-3, ..HausdorffOptions::default() };
    let (a, b) = (Shape::Surface(&inner), Shape::Surface(&outer));
    let found = hausdorff(a, b, &options, &mut || false).unwrap();
    println!("{found:?}");
    assert_bounds([found.forward.lower, found.forward.upper], 0.02, 2.1e-3);
    assert_bounds([found.backward.lower, found.backward.upper], 0.02, 2.1e-3);
}

#[test]
fn bounds_of_the_distance_hold_dense_samples_of_random_shapes() {
    let mut random = Random(21);
    for family in shapes::FAMILIES.iter().take(4) {
        let make = |random: &mut Random| {
            let knots = [0., 0., 0., 0., 0.5, 1., 1., 1., 1.];
            let poles: Vec<Vector> = (0..5)
                .map(|i| {
                    let v = random.vector();
                    [i as f64 + v[0], v[1], v[2]]
                })
                .collect();
            let weights: Vec<f64> = (0..5)
                .map(|_| random.scale(-family.weights / 6.0, 0.1 + family.weights / 6.0))
                .collect();
            IndexedCurve::new(Curve::new(&knots, 3, &poles, Some(&weights)).unwrap())
        };
        let (a, b) = (make(&mut random), make(&mut random));
        let found = hausdorff(
            Shape::Curve(&a),
            Shape::Curve(&b),
            &HausdorffOptions::default(),
            &mut || false,
        )
        .unwrap();
        let far = |from: &IndexedCurve, to: &IndexedCurve| {
            (0..=400)
                .map(|k| {
                    let q = from.curve().evaluate(k as f64 / 400.0);
                    (0..=4000)
                        .map(|j| norm(sub(q, to.curve().evaluate(j as f64 / 4000.0))))
                        .fold(f64::INFINITY, f64::min)
                })
                .fold(0.0, f64::max)
        };
        let (forward, backward) = (far(&a, &b), far(&b, &a));
        // A sampled distance is too great by the sampling of the other curve, at most.
        let slack = 2e-3;
        assert!(found.forward.proven && found.backward.proven, "{found:?}");
        assert!(
            forward <= found.forward.upper + slack && found.forward.lower <= forward + slack,
            "{found:?} {forward}"
        );
        assert!(
            backward <= found.backward.upper + slack && found.backward.lower <= backward + slack
        );
        assert!((forward - found.forward.lower).abs() < 0.03, "{found:?} {forward}");
    }
}

#[test]
fn halves_of_a_surface_meet_with_all_derivatives() {
    let knots = [0., 0., 0., 0., 0.3, 0.7, 1., 1., 1., 1.];
    let mut random = Random(4);
    let poles: Vec<Vector> =
        (0..36).map(|k| [(k / 6) as f64, (k % 6) as f64, random.between(-0.5, 0.5)]).collect();
    let whole = Surface::new(&knots, &knots, 3, 3, &poles, 6, 6, None).unwrap();
    let (low, high) = whole.split_u(0.45).unwrap();
    let (low, high) = (IndexedSurface::new(low), IndexedSurface::new(high));
    let found = continuity(&low, 1, &high, 0, &mut || false).unwrap();
    println!("{found:?}");
    assert!(found.gap.lower < 1e-12 && found.gap.upper < 1e-5, "{found:?}");
    assert!(found.angle.lower < 1e-7 && found.angle.upper < 5e-3, "{found:?}");
    assert!(found.curvature.lower < 1e-7 && found.curvature.upper < 0.1, "{found:?}");
}

#[test]
fn planes_meet_in_their_angle_and_a_cylinder_meets_its_tangent_plane_in_its_curvature() {
    let floor = plane([[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]]);
    let angle = 0.4f64;
    let (s, c) = angle.sin_cos();
    let ramp = plane([[1., 0., 0.], [1., 1., 0.], [1. + c, 0., s], [1. + c, 1., s]]);
    let found = continuity(&floor, 1, &ramp, 0, &mut || false).unwrap();
    assert!(found.angle.lower <= angle + 1e-9 && angle <= found.angle.upper + 1e-12, "{found:?}");
    assert!(found.angle.upper - found.angle.lower < 2e-3, "{found:?}");
    // A quarter cylinder of radius 2 that leaves the floor upwards at x = 1.
    let radius = 2.0;
    let half = 0.5f64.sqrt();
    let knots = [0., 0., 0., 1., 1., 1.];
    let arc = [[1.0, 0.0], [1.0 + radius, 0.0], [1.0 + radius, radius]];
    let mut poles = Vec::new();
    for [x, z] in arc {
        poles.push([x, 0.0, z]);
        poles.push([x, 1.0, z]);
    }
    let weights = [1.0, 1.0, half, half, 1.0, 1.0];
    let fillet = Surface::new(&knots, &LINE, 2, 1, &poles, 3, 2, Some(&weights)).unwrap();
    let fillet = IndexedSurface::new(fillet);
    let found = continuity(&floor, 1, &fillet, 0, &mut || false).unwrap();
    assert!(
        found.gap.upper < 1e-5 && found.angle.lower < 1e-7 && found.angle.upper < 2e-3,
        "{found:?}"
    );
    let jump = 1.0 / radius;
    assert!(
        found.curvature.lower <= jump + 1e-9 && jump <= found.curvature.upper + 1e-9,
        "{found:?}"
    );
    assert!(found.curvature.upper - found.curvature.lower < 0.02, "{found:?}");
    let text = continuity(&floor, 4, &ramp, 0, &mut || false).unwrap_err().to_string();
    assert_eq!(text, "side_a: 4 given, 0 to 3 accepted");
}

#[test]
fn an_ellipsoid_has_four_umbilics_where_the_formula_says() {
    let [a, b, c] = [3.0, 2.0, 1.0f64];
    let surface = IndexedSurface::new(ellipsoid([a, b, c]));
    let [u0, u1, v0, v1] = surface.surface().domain();
    let inset = 0.02 * (v1 - v0);
    let options =
        RangeOptions { domain: Some([u0, u1, v0 + inset, v1 - inset]), ..RangeOptions::default() };
    let found = umbilics(&surface, &options, &mut || false).unwrap();
    let x = a * ((a * a - b * b) / (a * a - c * c)).sqrt();
    let z = c * ((b * b - c * c) / (a * a - c * c)).sqrt();
    // The two at u = u0 = u1 are seen from both ends of the seam.
    for place in &found {
        assert!(place.is_small, "{place:?}");
        let [px, py, pz] = surface.surface().evaluate(place.at[0], place.at[1]);
        let gap = norm([px.abs() - x, py, pz.abs() - z]);
        assert!(gap < 1e-2, "{place:?} {gap}");
    }
    let sign = |place: &footpoint::inspect::Umbilic| {
        let p = surface.surface().evaluate(place.at[0], place.at[1]);
        (p[0] > 0.0, p[2] > 0.0)
    };
    for wanted in [(false, false), (false, true), (true, false), (true, true)] {
        assert!(found.iter().any(|place| sign(place) == wanted), "{found:?}");
    }
}

#[test]
fn principal_directions_of_a_torus_run_along_its_circles() {
    let (knots, profile) = circle([3.0, 0.0, 0.0], 1.0);
    let surface = revolved(&knots, 2, &profile);
    let c = curvatures(&surface, [0.4, 0.7], [Side::Above; 2]).unwrap();
    let [x, y, z] = c.point;
    let ring = x.hypot(y);
    let outward: Vector = [(ring - 3.0) * x / ring, (ring - 3.0) * y / ring, z];
    let flip = if shapes::dot(outward, c.normal) > 0.0 { -1.0 } else { 1.0 };
    let around = flip * (ring - 3.0) / ring;
    let mut wanted = [flip, around];
    wanted.sort_by(|a, b| b.total_cmp(a));
    for k in 0..2 {
        assert!((c.principal[k] - wanted[k]).abs() < 1e-12, "{c:?} {wanted:?}");
        let along = [-y / ring, x / ring, 0.0];
        let cosine = shapes::dot(c.directions[k], along).abs();
        let is_around = (c.principal[k] - around).abs() < 1e-9;
        assert!((cosine - if is_around { 1.0 } else { 0.0 }).abs() < 1e-9, "{c:?}");
    }
    assert!((c.gaussian - around * flip).abs() < 1e-12 && !c.is_umbilic);
}

#[test]
fn pictures_show_the_surface_and_refuse_nonsense() {
    let surface = ellipsoid([3.0, 2.0, 1.0]);
    let patterns = [
        Pattern::Shaded,
        Pattern::Zebra,
        Pattern::Isophotes,
        Pattern::ReflectionLines,
        Pattern::HighlightLines,
        Pattern::Greater,
        Pattern::Less,
        Pattern::Mean,
        Pattern::Gaussian,
    ];
    for pattern in patterns {
        let options = PictureOptions { pattern, size: [120, 90], ..PictureOptions::default() };
        let made = picture(&surface, &options).unwrap();
        assert_eq!(made.pixels.len(), 3 * 120 * 90);
        let at = |x: usize, y: usize| &made.pixels[3 * (y * 120 + x)..][..3];
        assert_eq!(at(0, 0), [255; 3], "{pattern:?}");
        let inside = made.pixels.chunks(3).filter(|p| p != &[255; 3]).count();
        assert!(inside > 120 * 90 / 4, "{pattern:?} {inside}");
        if let Some(folder) = std::env::var_os("FOOTPOINT_PICTURES") {
            let options = PictureOptions { pattern, ..PictureOptions::default() };
            let made = picture(&surface, &options).unwrap();
            let mut file = b"P6 640 480 255\n".to_vec();
            file.extend(&made.pixels);
            std::fs::write(std::path::Path::new(&folder).join(format!("{pattern:?}.ppm")), file)
                .unwrap();
        }
    }
    let refused = |change: &dyn Fn(&mut PictureOptions)| {
        let mut options = PictureOptions::default();
        change(&mut options);
        picture(&surface, &options).err().unwrap().to_string()
    };
    assert!(refused(&|o| o.size = [0, 10]).starts_with("size:"));
    assert!(refused(&|o| o.eye = [0.0; 3]).starts_with("eye:"));
    assert!(refused(&|o| o.up = o.eye).starts_with("up:"));
    assert!(refused(&|o| o.light[1] = f64::NAN).starts_with("light:"));
    assert!(refused(&|o| o.bands = 0).starts_with("bands:"));
    assert!(refused(&|o| o.range = [1.0, f64::INFINITY]).starts_with("range:"));
}

/// Brightness of a picture's pixel, 0 to 1.
fn brightness(pixels: &[u8], width: usize, x: usize, y: usize) -> f64 {
    pixels[3 * (y * width + x)..][..3].iter().map(|c| f64::from(*c)).sum::<f64>() / 765.0
}

/// How often a row of brightness goes from light to dark: dark stripes that begin.
fn stripes(row: &[f64]) -> usize {
    let (mut count, mut is_dark) = (0, false);
    for &x in row {
        let now = if is_dark { x < 0.55 } else { x < 0.3 };
        count += usize::from(now && !is_dark);
        is_dark = now;
    }
    count
}

/// A picture seen and lit along z, with y up.
fn from_above(surface: &Surface, pattern: Pattern, bands: usize, range: [f64; 2]) -> Vec<u8> {
    let options = PictureOptions {
        pattern,
        size: [400, 400],
        eye: [0.0, 0.0, 1.0],
        up: [0.0, 1.0, 0.0],
        light: [0.0, 0.0, 1.0],
        bands,
        range,
    };
    picture(surface, &options).unwrap().pixels
}

#[test]
fn isophotes_of_a_sphere_are_circles_one_for_each_band() {
    let pixels = from_above(&ellipsoid([1.0; 3]), Pattern::Isophotes, 8, [0.0; 2]);
    // From the middle outward the angle between normal and light goes from 0 to a right angle; the last band is a pixel wide.
    for (dx, dy) in [(1i64, 0i64), (-1, 0), (0, 1), (0, -1)] {
        let at =
            |k: i64| brightness(&pixels, 400, (200 + dx * k) as usize, (200 + dy * k) as usize);
        let row: Vec<f64> = (0..187).map(at).collect();
        let count = stripes(&row);
        assert!((7..=8).contains(&count), "{dx} {dy} {count}");
        // The middle is the begin of the first band, which is dark; it ends at half of an eighth of a right angle.
        let radius = 188.0 * (0.5 * std::f64::consts::FRAC_PI_2 / 8.0).sin();
        let edge = row.iter().position(|x| *x > 0.5).unwrap() as f64;
        assert!((edge - radius).abs() <= 2.5, "{edge} {radius}");
    }
}

#[test]
fn zebra_stripes_of_a_ball_cross_its_middle_twice_and_a_plane_has_none() {
    let pixels = from_above(&ellipsoid([1.0; 3]), Pattern::Zebra, 10, [0.0; 2]);
    // Up the middle line the reflection goes down to the floor, up to the ceiling and back: twice ten bands.
    let column: Vec<f64> = (13..387).map(|y| brightness(&pixels, 400, 200, y)).collect();
    let count = stripes(&column);
    assert!((16..=21).contains(&count), "{count}");
    let flat = plane([[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]]);
    let pixels = from_above(flat.surface(), Pattern::Zebra, 10, [0.0; 2]);
    let row: Vec<f64> = (20..380).map(|x| brightness(&pixels, 400, x, 200)).collect();
    assert!(row.iter().all(|x| (x - row[0]).abs() < 0.01), "{row:?}");
}

#[test]
fn lamps_over_a_plane_are_straight_lines_at_equal_distances() {
    let flat = plane([[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]]);
    for pattern in [Pattern::ReflectionLines, Pattern::HighlightLines] {
        let pixels = from_above(flat.surface(), pattern, 12, [0.0; 2]);
        let line =
            |y: usize| (14..386).map(|x| brightness(&pixels, 400, x, y)).collect::<Vec<f64>>();
        let row = line(200);
        let count = stripes(&row);
        // The plane is 0.94 of the picture wide: 11.3 lamps.
        assert!((11..=12).contains(&count), "{pattern:?} {count}");
        for y in [30, 120, 350] {
            let off = line(y).iter().zip(&row).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 0.01, "{pattern:?} {y} {off}");
        }
    }
    // Seen in a tube along y:
    let (knots, poles) = circle([0.0; 3], 1.0);
    let poles: Vec<(Vector, f64)> = poles.into_iter().collect();
    let tube: Vec<Vector> =
        poles.iter().flat_map(|(p, _)| [[p[0], 0.0, p[2]], [p[0], 2.0, p[2]]]).collect();
    let weights: Vec<f64> = poles.iter().flat_map(|(_, w)| [*w, *w]).collect();
    let count = poles.len();
    let tube = Surface::new(&knots, &LINE, 2, 1, &tube, count, 2, Some(&weights)).unwrap();
    let pixels = from_above(&tube, Pattern::ReflectionLines, 12, [0.0; 2]);
    let row: Vec<f64> = (14..386).map(|x| brightness(&pixels, 400, x, 200)).collect();
    // The middle is at 186, the radius 188: beyond half a right angle the reflection goes down, where no lamps are.
    let (left, middle, right) =
        (stripes(&row[4..48]), stripes(&row[60..312]), stripes(&row[324..368]));
    assert!(left == 0 && middle >= 6 && right == 0, "{left} {middle} {right}");
}

#[test]
fn colours_tell_the_sign_of_the_curvature_of_a_torus_and_its_value_on_a_sphere() {
    let (knots, profile) = circle([3.0, 0.0, 0.0], 1.0);
    let torus = revolved(&knots, 2, &profile);
    let pixels = from_above(&torus, Pattern::Gaussian, 16, [-0.5, 0.5]);
    let colour = |pixels: &[u8], x: usize, y: usize| {
        let at = 3 * (y * 400 + x);
        [0, 1, 2].map(|c| i32::from(pixels[at + c]))
    };
    // 0.94 of 400 pixels are 8 lengths: 47 pixels a length.
    for (dx, dy) in [(1i32, 0i32), (-1, 0), (0, 1), (0, -1)] {
        let at = |length: f64| {
            let go = |d: i32| (200.0 + f64::from(d) * 47.0 * length) as usize;
            colour(&pixels, go(dx), go(dy))
        };
        let [red, _, blue] = at(3.8);
        assert!(red > blue + 40, "outside {red} {blue}");
        let [red, _, blue] = at(2.2);
        assert!(blue > red + 40, "inside {red} {blue}");
        let [red, green, blue] = at(3.0);
        assert!((red - green).abs() < 25 && (red - blue).abs() < 25, "top {red} {green} {blue}");
        assert_eq!(at(0.0), [255; 3]);
    }
    // Half of the range is white, its ends are red and blue.
    let ball = ellipsoid([2.0; 3]);
    let size = |range| colour(&from_above(&ball, Pattern::Gaussian, 16, range), 200, 200);
    let [red, _, blue] = size([0.0, 0.5]);
    assert!((red - blue).abs() < 12, "{red} {blue}");
    let ([red, _, blue], [cold, _, warm]) = (size([0.0, 0.25]), size([0.25, 0.5]));
    assert!(red > blue + 100 && warm > cold + 100, "{red} {blue} {cold} {warm}");
}
