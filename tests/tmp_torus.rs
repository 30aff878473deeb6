mod revolved;
mod shapes;
use footpoint::index::IndexedSurface;
use footpoint::inspect::*;
use revolved::{circle, revolved};
#[test]
fn look() {
    for (big, small) in [(3.0, 1.25), (3.0, 1.0), (4.0, 0.5)] {
        let (knots, profile) = circle([big, 0.0, 0.0], small);
        let surface = IndexedSurface::new(revolved(&knots, 2, &profile));
        for relative in [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 0.5] {
            let options = RangeOptions { relative, budget: 20000, ..RangeOptions::default() };
            let f = surface_range(&surface, Quantity::Sharpest, &options, &mut || false).unwrap();
            println!("{big} {small} {relative} boxes {} moved {} {:?} {}", f.boxes, f.moved, f.greatest, f.proven);
        }
    }
}
