//! Surface-surface intersection against closed forms.

mod march_shapes;

use footpoint::index::IndexedSurface;
use footpoint::march::{ContactKind, End, Intersection, MarchOptions, intersect};
use march_shapes::{Motion, P, bumps, cone, cylinder, lid, moved, plane, sphere, torus, z_to_x};

fn meet(a: &IndexedSurface, b: &IndexedSurface) -> Intersection {
    intersect(a, b, &MarchOptions::default(), &mut |_, _| false).unwrap()
}

fn show(name: &str, found: &Intersection) {
    println!(
        "{name}: judged {} proven {} exhausted {} contacts {:?} overlaps {} undecided {}",
        found.judged,
        found.is_proven,
        found.exhausted,
        found.contacts.iter().map(|c| (c.kind, c.place.point, c.radius)).collect::<Vec<_>>(),
        found.overlaps.len(),
        found.undecided.len()
    );
    for u in found.undecided.iter().take(4) {
        println!("   undecided {u:?}");
    }
    for b in found.branches.iter().take(8) {
        println!("   {} points, ends {:?} tangential {} gap {:.2e}", b.points.len(), b.ends, b.is_tangential, b.gap);
    }
}

#[test]
fn trial() {
    let whole = |s| IndexedSurface::new(s);
    let p = |z: f64| plane([-3.0, -3.0, z], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0]);
    let tilted = plane([-3.0, -3.0, -0.7], [6.0, 0.3, 0.8], [0.2, 6.0, 0.5]);
    for (name, a, b) in [
        ("sphere plane", sphere(1.0), p(0.3)),
        ("sphere equator", sphere(1.0), p(0.0)),
        ("sphere tilted", sphere(1.0), tilted.clone()),
        ("sphere meridian", sphere(1.0), plane([0.0, -3.0, -3.0], [0.0, 6.0, 0.0], [0.0, 0.0, 6.0])),
        ("sphere touching", sphere(1.0), p(1.0)),
        ("sphere touching side", sphere(1.0), plane([1.0, -3.0, -3.0], [0.0, 6.0, 0.0], [0.0, 0.0, 6.0])),
        ("cylinder tilted", cylinder(1.0, 2.0), tilted.clone()),
        ("cylinder axial", cylinder(1.0, 2.0), plane([0.3, -3.0, -3.0], [0.0, 6.0, 0.0], [0.0, 0.0, 6.0])),
        ("cylinder tangent", cylinder(1.0, 2.0), plane([1.0, -3.0, -3.0], [0.0, 6.0, 0.0], [0.0, 0.0, 6.0])),
        ("cylinders equal", cylinder(1.0, 2.0), moved(&cylinder(1.0, 2.0), &z_to_x([0.0; 3]))),
        ("cylinders", cylinder(1.0, 2.0), moved(&cylinder(0.6, 2.0), &z_to_x([0.0; 3]))),
        ("torus flat", torus(2.0, 0.5), p(0.0)),
        ("torus top", torus(2.0, 0.5), p(0.5)),
        ("concentric", sphere(1.0), sphere(1.5)),
        ("coincident spheres", sphere(1.0), sphere(1.0)),
        ("coincident planes", p(0.0), plane([-1.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0])),
        ("cone plane", cone(0.0, 0.0, 2.0, 1.0), plane([-3.0, -3.0, 0.5], [6.0, 0.0, 0.5], [0.0, 6.0, 0.0])),
    ] {
        if std::env::var("ONLY").is_ok_and(|o| !name.contains(&o)) {
            continue;
        }
        let t = std::time::Instant::now();
        let found = meet(&whole(a), &whole(b));
        print!("{:.2?} ", t.elapsed());
        show(name, &found);
    }
    for gap in [1e-2, 1e-4, 1e-6, 1e-8] {
        let flat = |p: P| p;
        let (a, b) = (whole(bumps(16, flat)), whole(lid(16, 4.0 / 9.0 - gap, flat)));
        let t = std::time::Instant::now();
        let found = meet(&a, &b);
        println!("{:.2?} gap {gap} loops {} judged {} proven {}", t.elapsed(), found.branches.iter().filter(|b| b.is_closed()).count(), found.judged, found.is_proven);
    }
    let _ = (Motion::NONE, ContactKind::Border, End::Closed);
}
