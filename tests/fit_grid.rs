//! Fits of surfaces to grids.

use footpoint::fit::{
    Ends, Grid, GridOptions, Spacing, adaptive_grid, grid_parameters, interpolate_grid,
    least_squares_grid,
};
use footpoint::surface::Surface;

fn even(count: usize) -> Vec<f64> {
    (0..count).map(|i| i as f64 / (count - 1) as f64).collect()
}

fn wave(u: f64, v: f64) -> [f64; 3] {
    [10.0 * u, 6.0 * v, (5.0 * u).sin() * (3.0 * v).cos() + u * v]
}

fn points(u: &[f64], v: &[f64], at: impl Fn(f64, f64) -> [f64; 3]) -> Vec<[f64; 3]> {
    u.iter().flat_map(|&u| v.iter().map(|&v| at(u, v)).collect::<Vec<_>>()).collect()
}

#[test]
fn samples_of_a_surface_give_it_back() {
    let knots_u = [0., 0., 0., 0., 0.3, 0.7, 0.7, 1., 1., 1., 1.];
    let knots_v = [0., 0., 0., 0.5, 1., 1., 1.];
    let poles: Vec<[f64; 3]> =
        (0..28).map(|k| [(k / 4) as f64 + 100.0, (k % 4) as f64, ((k * k) as f64).sin()]).collect();
    let surface = Surface::new(&knots_u, &knots_v, 3, 2, &poles, 7, 4, None).unwrap();
    let (u, v) = (even(31), even(17));
    let list = points(&u, &v, |u, v| surface.evaluate(u, v));
    let grid = Grid::new(&list, 31, 17).unwrap();
    for ends in [Ends::Free, Ends::Interpolated] {
        let fit = least_squares_grid([3, 2], [&knots_u, &knots_v], [&u, &v], &grid, ends).unwrap();
        assert!(fit.worst < 1e-12);
        for (a, b) in fit.surface.poles().iter().zip(&poles) {
            assert!(a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-11), "{a:?} {b:?}");
        }
    }
}

#[test]
fn an_interpolant_passes_through_the_grid() {
    let (u, v) = (even(23), even(12));
    let list = points(&u, &v, wave);
    let grid = Grid::new(&list, 23, 12).unwrap();
    for spacing in [Spacing::Uniform, Spacing::Chordal, Spacing::Centripetal] {
        let [u, v] = grid_parameters(spacing, &grid).unwrap();
        let fit = interpolate_grid([3, 4], [&u, &v], &grid).unwrap();
        assert!(fit.worst < 1e-12, "{}", fit.worst);
        for (i, &u) in u.iter().enumerate() {
            for (j, &v) in v.iter().enumerate() {
                let (a, b) = (fit.surface.evaluate(u, v), list[i * 12 + j]);
                assert!(a.iter().zip(&b).all(|(x, y)| (x - y).abs() < 1e-12));
            }
        }
    }
}

#[test]
fn an_adaptive_fit_of_a_grid_meets_its_tolerance() {
    let (u, v) = (even(120), even(90));
    let list = points(&u, &v, wave);
    let grid = Grid::new(&list, 120, 90).unwrap();
    let mut before = 0;
    for tolerance in [1e-2, 1e-4, 1e-6] {
        let options = GridOptions { tolerance, ..GridOptions::default() };
        let fit = adaptive_grid([&u, &v], &grid, &options).unwrap();
        assert!(fit.worst <= tolerance);
        let mut worst = 0.0f64;
        for (i, &u) in u.iter().enumerate() {
            for (j, &v) in v.iter().enumerate() {
                let (a, b) = (fit.surface.evaluate(u, v), list[i * 90 + j]);
                worst =
                    worst.max(a.iter().zip(&b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt());
            }
        }
        assert!((worst - fit.worst).abs() < 1e-13);
        let count = fit.surface.poles().len();
        assert!(before < count && count < 3000, "{count}");
        before = count;
    }
    // Not reached: told.
    let options = GridOptions { tolerance: 1e-9, max_poles: 8, ..GridOptions::default() };
    let fit = adaptive_grid([&u, &v], &grid, &options).unwrap();
    assert!(fit.worst > 1e-9 && fit.surface.poles().len() <= 64);
}

#[test]
fn defects_are_named() {
    let list = points(&even(5), &even(4), wave);
    assert!(Grid::new(&list, 4, 4).unwrap_err().to_string().contains("points: 20 given"));
    assert!(Grid::new(&list, usize::MAX, 2).is_err() && Grid::new(&list, 20, 1).is_err());
    let grid = Grid::new(&list, 5, 4).unwrap();
    let (u, v) = (even(5), even(4));
    let refused = interpolate_grid([3, 4], [&u, &v], &grid).unwrap_err().to_string();
    assert!(refused.contains("degree_v: 4 given, 1 to 3"), "{refused}");
    let refused =
        interpolate_grid([3, 3], [&u, &[0.0, 0.5, 0.5, 1.0]], &grid).unwrap_err().to_string();
    assert!(refused.contains("parameters_v: parameter 2"), "{refused}");
    let refused = adaptive_grid([&v, &v], &grid, &GridOptions::default()).unwrap_err().to_string();
    assert!(refused.contains("parameters_u: 4 given, 5 expected"), "{refused}");
    let knots = [0., 0., 0., 0., 0.1, 0.15, 1., 1., 1., 1.];
    let refused = least_squares_grid([3, 3], [&knots, &knots], [&u, &v], &grid, Ends::Free);
    assert!(refused.unwrap_err().to_string().contains("parameters_u: too few"));
}
