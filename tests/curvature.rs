//! Certified ranges of curvatures: closed forms, and dense sampling of all cases.

#[path = "cases/mod.rs"]
#[allow(dead_code, reason = "shapes only, no queries")]
mod cases;
mod revolved;
mod shapes;

use cases::Shape;
use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::inspect::{Quantity, Range, RangeOptions, Side, curve_range, surface_range};
use footpoint::surface::Surface;
use revolved::{circle, ellipsoid, revolved};
use shapes::{Random, Vector, cross, dot, norm};

fn range(surface: &IndexedSurface, quantity: Quantity, domain: Option<[f64; 4]>) -> Range {
    let options = RangeOptions { domain, ..RangeOptions::default() };
    surface_range(surface, quantity, &options, &mut || false).unwrap()
}

/// The bounds hold `least` and `greatest` and are near to each other.
fn assert_range(range: &Range, least: f64, greatest: f64, size: f64) {
    let gap = 1.01e-3 * size;
    let slack = 1e-12 * size;
    assert!(range.proven, "{range:?}");
    for (bounds, value) in [(range.least, least), (range.greatest, greatest)] {
        assert!(bounds[0] <= value + slack && value <= bounds[1] + slack, "{value} {range:?}");
        assert!(bounds[1] - bounds[0] <= gap, "{value} {range:?}");
    }
}

#[test]
fn a_cylinder_bends_as_its_radius_says() {
    let radius = 2.5;
    let profile = [([radius, 0.0, 0.0], 1.0), ([radius, 0.0, 7.0], 1.0)];
    let surface = IndexedSurface::new(revolved(&[0., 0., 1., 1.], 1, &profile));
    let sharpest = range(&surface, Quantity::Sharpest, None);
    assert_range(&sharpest, 1.0 / radius, 1.0 / radius, 1.0 / radius);
    let gaussian = range(&surface, Quantity::Gaussian, None);
    assert!(gaussian.proven && gaussian.least[0] <= 0.0 && gaussian.greatest[1] >= 0.0);
    let greater = range(&surface, Quantity::Greater, None);
    let less = range(&surface, Quantity::Less, None);
    let outer = greater.greatest[1] - less.least[0];
    assert!((outer - 1.0 / radius).abs() <= 3e-3 / radius, "{greater:?} {less:?}");
}

#[test]
fn a_torus_has_its_two_radii_and_its_inner_equator() {
    let (big, small) = (3.0, 1.25);
    let (knots, profile) = circle([big, 0.0, 0.0], small);
    let surface = IndexedSurface::new(revolved(&knots, 2, &profile));
    // An eighth of the turn is enough: the others are alike.
    let part = Some([0.0, 0.5, 0.0, 4.0]);
    let sharpest = range(&surface, Quantity::Sharpest, part);
    assert_range(&sharpest, 1.0 / small, 1.0 / small, 1.0 / small);
    let [inner, outer] = [-1.0 / (big - small), 1.0 / (big + small)];
    // The normal may point either way.
    let less = range(&surface, Quantity::Less, part);
    let greater = range(&surface, Quantity::Greater, part);
    let (along, flip) = if greater.greatest[1] > 0.7 { (less, 1.0) } else { (greater, -1.0) };
    let [low, high] = if flip > 0.0 { [inner, outer] } else { [-outer, -inner] };
    assert_range(&along, low, high, 1.0 / small);
    let gaussian = range(&surface, Quantity::Gaussian, part);
    assert_range(&gaussian, inner / small, outer / small, 1.0);
}

#[test]
fn an_ellipsoid_bends_least_and_most_at_the_ends_of_its_axes() {
    let [a, b, c] = [3.0, 2.0, 1.0];
    // The longest axis away from the collapsed edges, which are left out.
    let surface = IndexedSurface::new(ellipsoid([a, b, c]));
    let [u0, u1, v0, v1] = surface.surface().domain();
    let inset = 0.05 * (v1 - v0);
    let domain = Some([u0, u1, v0 + inset, v1 - inset]);
    let sharpest = range(&surface, Quantity::Sharpest, domain);
    assert!(sharpest.proven, "{sharpest:?}");
    let most = a / (c * c);
    assert!(sharpest.greatest[0] <= most * (1.0 + 1e-12) && most <= sharpest.greatest[1]);
    assert!(sharpest.greatest[1] - sharpest.greatest[0] <= 1.01e-3 * most, "{sharpest:?}");
    let gaussian = range(&surface, Quantity::Gaussian, domain);
    let most = (a / (b * c)).powi(2);
    assert!(gaussian.greatest[0] <= most * (1.0 + 1e-12) && most <= gaussian.greatest[1]);
    assert!(gaussian.greatest[1] - gaussian.greatest[0] <= 1.01e-3 * most, "{gaussian:?}");
}

#[test]
fn a_whole_sphere_has_its_radius_and_a_whole_torus_its_tube() {
    let surface = IndexedSurface::new(ellipsoid([2.0; 3]));
    let sharpest = range(&surface, Quantity::Sharpest, None);
    assert_range(&sharpest, 0.5, 0.5, 0.5);
    // Beside its poles a sphere of rounded numbers is one only up to them.
    assert!(sharpest.excluded.is_empty() && sharpest.moved > 0.0 && sharpest.moved < 1e-12);
    for (big, small) in [(3.0, 1.25), (3.0, 1.0), (4.0, 0.5)] {
        let (knots, profile) = circle([big, 0.0, 0.0], small);
        let surface = IndexedSurface::new(revolved(&knots, 2, &profile));
        let sharpest = range(&surface, Quantity::Sharpest, None);
        assert_range(&sharpest, 1.0 / small, 1.0 / small, 1.0 / small);
        assert!(sharpest.moved == 0.0 && sharpest.boxes < 500, "{sharpest:?}");
    }
}

#[test]
fn a_whole_ellipsoid_is_bounded_at_its_poles_too() {
    let [a, b, c] = [3.0, 2.0, 1.0];
    let surface = IndexedSurface::new(ellipsoid([a, b, c]));
    for (quantity, least, most) in [
        // The greater curvature at the end of the shortest axis.
        (Quantity::Sharpest, c / (b * b), a / (c * c)),
        (Quantity::Gaussian, (c / (a * b)).powi(2), (a / (b * c)).powi(2)),
    ] {
        let found = range(&surface, quantity, None);
        assert!(found.proven && found.moved < 1e-12, "{found:?}");
        assert!(
            found.greatest[0] <= most * (1.0 + 1e-9) && most <= found.greatest[1] * (1.0 + 1e-9)
        );
        assert!(found.greatest[1] - found.greatest[0] <= 1.01e-3 * most, "{found:?}");
        assert!(found.least[0] <= least + 1e-9 && least <= found.least[1] + 1e-9, "{found:?}");
    }
}

#[test]
fn what_is_asked_of_one_side_is_proven_there() {
    let surface = IndexedSurface::new(ellipsoid([3.0, 2.0, 1.0]));
    let both = range(&surface, Quantity::Sharpest, None);
    let options = RangeOptions { side: Side::Greatest, ..RangeOptions::default() };
    let one = surface_range(&surface, Quantity::Sharpest, &options, &mut || false).unwrap();
    assert!(one.proven && one.boxes < both.boxes, "{} {}", one.boxes, both.boxes);
    assert!(one.greatest[1] - one.greatest[0] <= 3.1e-3, "{one:?}");
    assert!(one.least[0] <= both.least[1], "{one:?}");
}

#[test]
fn an_ellipse_bends_between_b_over_a_squared_and_a_over_b_squared() {
    let (knots, poles) = circle([0.0; 3], 1.0);
    let (a, b) = (3.0, 2.0);
    let moved: Vec<Vector> = poles.iter().map(|(p, _)| [a * p[0], 5.0, b * p[2]]).collect();
    let weights: Vec<f64> = poles.iter().map(|p| p.1).collect();
    let curve = IndexedCurve::new(Curve::new(&knots, 2, &moved, Some(&weights)).unwrap());
    let found = curve_range(&curve, &RangeOptions::default(), &mut || false).unwrap();
    assert_range(&found, b / (a * a), a / (b * b), a / (b * b));
}

/// Poles of a fan: a point and a foot, v from the one to the other.
fn fan(foot: &[Vector]) -> IndexedSurface {
    let poles: Vec<Vector> = foot.iter().flat_map(|p| [[0.0; 3], *p]).collect();
    let knots = [0., 0., 0., 1., 1., 1.];
    let line = [0., 0., 1., 1.];
    IndexedSurface::new(Surface::new(&knots, &line, 2, 1, &poles, 3, 2, None).unwrap())
}

#[test]
fn a_tip_has_no_bound_and_what_is_beside_it_has() {
    let surface = fan(&[[1., 0., -1.], [1., 1., -1.3], [0., 1., -1.]]);
    let mut sides = [0, 0];
    for quantity in [Quantity::Sharpest, Quantity::Greater, Quantity::Less, Quantity::Mean] {
        let options = RangeOptions { relative: 1e-2, ..RangeOptions::default() };
        let found = surface_range(&surface, quantity, &options, &mut || false).unwrap();
        assert!(!found.proven && found.excluded.len() == 1, "{quantity:?} {found:?}");
        if found.unbounded.is_empty() {
            assert!(matches!(quantity, Quantity::Greater | Quantity::Less), "{found:?}");
            continue;
        }
        let place = &found.unbounded[0];
        assert!(place.at[1] == 0.0 && place.domain[2] == 0.0 && place.domain[3] < 0.01);
        assert_eq!(found.excluded, [place.domain]);
        match quantity {
            Quantity::Sharpest => assert!(place.grows && !place.falls),
            _ => sides = [sides[0] + usize::from(place.falls), sides[1] + usize::from(place.grows)],
        }
        // Beside the box the bounds hold what is there, and no more than the gap beyond it.
        let rim = (0..=200)
            .filter_map(|k| principal(surface.surface(), k as f64 / 200.0, place.domain[3]))
            .map(|[a, b]| a.abs().max(b.abs()))
            .fold(0.0, f64::max);
        if quantity == Quantity::Sharpest {
            assert!(found.rest_proven, "{found:?}");
            assert!(rim <= found.greatest[1] && found.greatest[1] <= 1.02 * rim, "{rim} {found:?}");
        }
    }
    // A cone bends to one side: one principal curvature is zero, the other one and the mean have no bound there.
    assert!(sides == [2, 0] || sides == [0, 2], "{sides:?}");
}

#[test]
fn a_flat_fan_has_no_curvature_and_a_round_one_is_a_pole() {
    let flat = fan(&[[1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
    let found = range(&flat, Quantity::Sharpest, None);
    assert!(found.proven && found.greatest[1] <= 1e-12 && found.unbounded.is_empty(), "{found:?}");
    // A tilted one is flat up to the rounding of its poles.
    let tilted = fan(&[[1., 0.1, 0.7], [1.3, 1., 0.3], [0., 1.1, -0.4]]
        .map(|[x, y, _]| [x, y, 0.3 * x - 0.7 * y]));
    let found = range(&tilted, Quantity::Sharpest, None);
    assert!(found.proven && found.greatest[1] <= 1e-9 && found.moved < 1e-12, "{found:?}");
}

#[test]
fn a_double_row_of_poles_is_a_cusp_without_bound() {
    // (t^2, t^3) along v, drawn along u: both poles of the first two rows are equal.
    let profile = [[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [3.0, 1.0]];
    let mut poles: Vec<Vector> = Vec::new();
    for x in [0.0, 1.0] {
        poles.extend(profile.map(|[y, z]| [x, y, z]));
    }
    let (line, knots) = ([0., 0., 1., 1.], [0., 0., 0., 0., 1., 1., 1., 1.]);
    let surface = Surface::new(&line, &knots, 1, 3, &poles, 2, 4, None).unwrap();
    let surface = IndexedSurface::new(surface);
    let found = range(&surface, Quantity::Sharpest, None);
    assert!(found.unbounded.iter().any(|place| place.grows && place.at[1] == 0.0), "{found:?}");
    assert!(!found.proven);
}

#[test]
fn bounds_hold_dense_samples_of_random_hostile_surfaces() {
    let mut random = Random(77);
    let (mut proven, mut unbounded) = (0, 0);
    for round in 0..120 {
        let [p, q] = [1 + round % 4, 1 + (round / 4) % 3];
        let (m, n) = (p + 1 + round % 3, q + 1 + round % 2);
        // Spans of very different lengths.
        let knots = |random: &mut Random, degree: usize, count: usize| {
            let mut inner: Vec<f64> = (0..count - degree - 1)
                .map(|_| {
                    if round % 5 == 0 {
                        0.5 + random.scale(-9.0, -2.0)
                    } else {
                        random.between(0.1, 0.9)
                    }
                })
                .collect();
            inner.sort_by(f64::total_cmp);
            let ends = |x: f64| std::iter::repeat_n(x, degree + 1);
            ends(0.0).chain(inner).chain(ends(1.0)).collect::<Vec<f64>>()
        };
        let (u, v) = (knots(&mut random, p, m), knots(&mut random, q, n));
        let bend = random.scale(-4.0, 0.5);
        let far = if round % 6 == 0 { 1e4 } else { 0.0 };
        let mut poles: Vec<Vector> = (0..m * n)
            .map(|k| {
                let r = random.vector();
                let (x, y) = ((k / n) as f64 / m as f64, (k % n) as f64 / n as f64);
                [x + 0.2 * bend * r[0] + far, y + 0.2 * bend * r[1], bend * r[2]]
            })
            .collect();
        if round % 3 == 0 {
            // A tip.
            (0..m).for_each(|i| poles[i * n] = poles[0]);
        }
        let weights: Vec<f64> = (0..m * n).map(|_| random.scale(-0.5, 0.5)).collect();
        let weights = (round % 2 == 0).then_some(&weights[..]);
        let Ok(surface) = Surface::new(&u, &v, p, q, &poles, m, n, weights) else { continue };
        let indexed = IndexedSurface::new(surface);
        let options = RangeOptions { budget: 3_000, ..RangeOptions::default() };
        let found = surface_range(&indexed, Quantity::Sharpest, &options, &mut || false).unwrap();
        proven += usize::from(found.proven);
        unbounded += found.unbounded.len();
        for k in 0..900 {
            let (u, v) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
            let (u, v) = if k % 2 == 0 { (u, v) } else { (u, random.scale(-6.0, 0.0)) };
            let inside = |a: &[f64; 4]| a[0] <= u && u <= a[1] && a[2] <= v && v <= a[3];
            if found.excluded.iter().any(inside) {
                continue;
            }
            let Some([greater, less]) = principal(indexed.surface(), u, v) else { continue };
            let sharp = greater.abs().max(less.abs());
            // A sample far from the origin is rounded too.
            let slack = (1e-6 + 1e-9 * far) * sharp + 1e-9 + 1e-9 * far;
            assert!(sharp <= found.greatest[1] + slack, "{round} {u} {v} {sharp} {found:?}");
            assert!(sharp >= found.least[0] - slack, "{round} {u} {v} {sharp} {found:?}");
        }
    }
    println!("{proven} proven, {unbounded} places without bound");
    assert!(proven > 20 && unbounded > 5, "{proven} {unbounded}");
}

/// Principal curvatures from second derivatives, when the surface is regular there.
fn principal(surface: &Surface, u: f64, v: f64) -> Option<[f64; 2]> {
    let mut d = [[0.0; 3]; 6];
    surface.partials(u, v, 2, &mut d);
    let n = cross(d[1], d[2]);
    let (e, f, g) = (dot(d[1], d[1]), dot(d[1], d[2]), dot(d[2], d[2]));
    let area = norm(n);
    if area <= 1e-6 * (e * g).sqrt() || area == 0.0 {
        return None;
    }
    let [l, m, q] = [3, 4, 5].map(|k| dot(n, d[k]) / area);
    let gaussian = (l * q - m * m) / (area * area);
    let mean = (e * q - 2.0 * f * m + g * l) / (2.0 * area * area);
    let root = (mean * mean - gaussian).max(0.0).sqrt();
    Some([mean + root, mean - root])
}

#[test]
fn bounds_hold_dense_samples_of_every_case() {
    let (mut proven, mut faces, mut slowest) = (0, 0, 0.0f64);
    for folder in cases::folders() {
        let case = cases::read(&folder);
        let Shape::Surface(indexed) = &case.shape else { continue };
        let long = std::env::var_os("FOOTPOINT_LIST").is_some();
        // Products of high degrees and thousands of patches take too long for every day.
        let degree = indexed.surface().knots_u().degree().max(indexed.surface().knots_v().degree());
        if !long && (degree > 5 || indexed.surface().poles().len() > 1_000) {
            continue;
        }
        indexed.prepare(&mut || false).unwrap();
        let options =
            RangeOptions { budget: if long { 20_000 } else { 300 }, ..RangeOptions::default() };
        let start = std::time::Instant::now();
        let found = surface_range(indexed, Quantity::Sharpest, &options, &mut || false).unwrap();
        let time = start.elapsed().as_secs_f64();
        slowest = slowest.max(time);
        faces += 1;
        proven += usize::from(found.proven);
        if std::env::var_os("FOOTPOINT_LIST").is_some() {
            let gap = (found.greatest[1] - found.greatest[0]) / found.greatest[1];
            println!(
                "{:28} {:9.3} ms {:6} boxes  radius {:.6e} gap {:.1e} excluded {} {}",
                case.name,
                time * 1e3,
                found.boxes,
                1.0 / found.greatest[1],
                gap,
                found.excluded.len(),
                found.proven
            );
        }
        let surface = indexed.surface();
        let [u0, u1, v0, v1] = surface.domain();
        for i in 0..=30 {
            for j in 0..=30 {
                let u = (u0 + (u1 - u0) * (i as f64 + 0.5) / 31.0).min(u1);
                let v = (v0 + (v1 - v0) * (j as f64 + 0.5) / 31.0).min(v1);
                let inside = |a: &[f64; 4]| a[0] <= u && u <= a[1] && a[2] <= v && v <= a[3];
                if found.excluded.iter().any(inside) {
                    continue;
                }
                let Some([greater, less]) = principal(surface, u, v) else { continue };
                let sharp = greater.abs().max(less.abs());
                let slack = 1e-6 * sharp + 1e-9 / case.diagonal;
                assert!(
                    sharp <= found.greatest[1] + slack,
                    "{} {u} {v} {sharp} {found:?}",
                    case.name
                );
                assert!(sharp >= found.least[0] - slack, "{} {u} {v} {sharp} {found:?}", case.name);
            }
        }
    }
    println!("{proven} of {faces} proven, slowest {slowest:.3} s");
    // How many close within so few boxes depends on the faces that are there; none would mean that nothing is proven at all.
    assert!(proven > 0, "{proven} of {faces}");
}

/// Processor time of this thread in milliseconds; the clock's where there is none.
fn processor_time(start: std::time::Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let own = text.split_whitespace().next().and_then(|word| word.parse::<f64>().ok());
    own.map_or(start.elapsed().as_secs_f64() * 1e3, |nanoseconds| nanoseconds * 1e-6)
}

/// The table of docs/curvature.md: `FOOTPOINT_LIST=1 cargo test --release --test curvature least_radii -- --nocapture`.
#[test]
fn least_radii_of_every_case() {
    if std::env::var_os("FOOTPOINT_LIST").is_none() {
        return;
    }
    let only = std::env::var("FOOTPOINT_ONLY").unwrap_or_default();
    let start = std::time::Instant::now();
    for folder in cases::folders() {
        let case = cases::read(&folder);
        let Shape::Surface(indexed) = &case.shape else { continue };
        if !case.name.contains(&only) {
            continue;
        }
        indexed.prepare(&mut || false).unwrap();
        let options = RangeOptions { side: Side::Greatest, ..RangeOptions::default() };
        let before = processor_time(start);
        let mut stop = || processor_time(start) > before + 3e3;
        let Ok(found) = surface_range(indexed, Quantity::Sharpest, &options, &mut stop) else {
            println!("{:28} longer than 3 s", case.name);
            continue;
        };
        let time = processor_time(start) - before;
        let [low, high] = found.greatest;
        println!(
            "{:28} {time:9.3} ms {:6} boxes  radius {:.6e} gap {:.1e} excluded {} unbounded {} moved {:.0e} rest {} {}",
            case.name,
            found.boxes,
            1.0 / high,
            (high - low) / high,
            found.excluded.len(),
            found.unbounded.len(),
            found.moved,
            found.rest_proven,
            found.proven
        );
        for place in found.unbounded.iter().take(3) {
            println!("    unbounded near {:?} in {:?}", place.at, place.domain);
        }
        for area in found.excluded.iter().take(3) {
            println!("    excluded {area:?}");
        }
    }
}
