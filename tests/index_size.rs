//! The index of a surface stays small: at most 4 KiB for a bicubic patch.

use footpoint::index::IndexedSurface;
use footpoint::surface::Surface;

/// A wavy bicubic sheet of `spans` x `spans` patches.
fn sheet(spans: usize, rational: bool) -> IndexedSurface {
    let count = spans + 3;
    let mut knots = vec![0.0; 3];
    knots.extend((0..=spans).map(|k| k as f64));
    knots.extend([spans as f64; 3]);
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for i in 0..count {
        for j in 0..count {
            poles.push([i as f64, j as f64, ((i * 7 + j * 5) % 11) as f64 * 0.1]);
            weights.push(1.0 + ((i * 3 + j) % 4) as f64 * 0.25);
        }
    }
    let weights = rational.then_some(&weights[..]);
    let surface = Surface::new(&knots, &knots, 3, 3, &poles, count, count, weights);
    IndexedSurface::new(surface.unwrap())
}

#[test]
fn a_bicubic_patch_takes_at_most_four_kibibytes() {
    for (spans, rational) in [(20, false), (20, true), (100, false), (100, true)] {
        let surface = sheet(spans, rational);
        let index = surface.index(&mut || false).unwrap();
        assert_eq!(index.patches.len(), spans * spans);
        let each = index.memory() as f64 / index.patches.len() as f64;
        println!("{spans} x {spans} patches, rational {rational}: {each:.0} bytes each");
        assert!(each <= 4096.0);
        // What is counted is at least the poles and the tensors.
        let least = if rational { 8 * (64 + 5 * 49) } else { 8 * (48 + 4 * 49) };
        assert!(each >= least as f64);
    }
}
