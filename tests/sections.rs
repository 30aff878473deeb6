//! Sections by planes and quadrics against closed forms: under rotations, scales and far from the origin.

mod known_shapes;

use footpoint::index::IndexedSurface;
use footpoint::intersect::{End, Quadric, Section, SectionOptions};
use footpoint::surface::Surface;
use known_shapes::{Random, Vector, cylinder, dot, norm, sphere, sub, torus};

/// A rotation, then a scale, then a move.
#[derive(Clone, Copy, Debug)]
struct Motion {
    rows: [Vector; 3],
    scale: f64,
    offset: Vector,
}

impl Motion {
    const NONE: Self =
        Self { rows: [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]], scale: 1.0, offset: [0.0; 3] };

    fn turn(&self, v: Vector) -> Vector {
        self.rows.map(|row| dot(row, v))
    }

    fn point(&self, x: Vector) -> Vector {
        let y = self.turn(x);
        [0, 1, 2].map(|k| y[k] * self.scale + self.offset[k])
    }

    fn back(&self, x: Vector) -> Vector {
        let y = [0, 1, 2].map(|k| (x[k] - self.offset[k]) / self.scale);
        [0, 1, 2].map(|k| (0..3).map(|i| self.rows[i][k] * y[i]).sum())
    }

    fn surface(&self, shape: &IndexedSurface) -> IndexedSurface {
        let s = shape.surface();
        let poles: Vec<Vector> = s.poles().iter().map(|&x| self.point(x)).collect();
        let (u, v) = (s.knots_u(), s.knots_v());
        let counts = [u.pole_count(), v.pole_count()];
        let degrees = [u.degree(), v.degree()];
        IndexedSurface::new(
            Surface::new(
                u.values(),
                v.values(),
                degrees[0],
                degrees[1],
                &poles,
                counts[0],
                counts[1],
                s.weights(),
            )
            .unwrap(),
        )
    }
}

fn motions() -> Vec<Motion> {
    let mut random = Random(7);
    let mut all = vec![Motion::NONE];
    for (scale, far) in [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 1e3), (1e-3, 1.0), (3.0, 0.1)] {
        let q: [f64; 4] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let n = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        let [a, b, c, d] = q.map(|x| x / n);
        let rows = [
            [a * a + b * b - c * c - d * d, 2. * (b * c - a * d), 2. * (b * d + a * c)],
            [2. * (b * c + a * d), a * a - b * b + c * c - d * d, 2. * (c * d - a * b)],
            [2. * (b * d - a * c), 2. * (c * d + a * b), a * a - b * b - c * c + d * d],
        ];
        all.push(Motion { rows, scale, offset: [far, -2.0 * far, 0.7 * far] });
    }
    all
}

fn cut(shape: &IndexedSurface, quadric: &Quadric) -> Section {
    shape.section(quadric, &SectionOptions::default(), &mut || false).unwrap()
}

fn plane(m: &Motion, origin: Vector, normal: Vector) -> Quadric {
    Quadric::plane(m.point(origin), m.turn(normal)).unwrap()
}

/// All points of all branches lie on what `off` measures, in the unmoved frame, to `within` of the unmoved size.
fn check_points(section: &Section, m: &Motion, within: f64, off: impl Fn(Vector) -> f64) {
    let rounding = 1e-15 * norm(m.offset) / m.scale;
    for branch in &section.branches {
        assert!(branch.points.len() >= 2);
        for p in &branch.points {
            let away = off(m.back(p.point)).abs();
            assert!(away <= within + 8.0 * rounding, "{away:e} {m:?}");
        }
    }
}

fn summary(section: &Section) -> String {
    let ends = |b: &footpoint::intersect::Branch| {
        format!("{:?}{}x{}", b.ends, if b.tangential { "T" } else { "" }, b.points.len())
    };
    let branches: Vec<String> = section.branches.iter().map(ends).collect();
    format!(
        "{branches:?} contacts {:?} junctions {:?} overlaps {:?} undecided {:?}",
        section.contacts, section.junctions, section.overlaps, section.undecided
    )
}

fn loops(section: &Section) -> usize {
    section.branches.iter().filter(|b| b.is_closed()).count()
}

#[test]
fn a_plane_cuts_a_sphere_in_one_circle() {
    let unit = sphere([0.0, 1.0]);
    for m in motions() {
        let shape = m.surface(&unit);
        for (normal, height) in [
            ([0.3, -0.5, 0.8], 0.3),
            ([0.0, 0.0, 1.0], 0.0),
            ([0.0, 0.0, 1.0], 0.25),
            ([1.0, 0.0, 0.0], 0.0),
            ([1.0, 1.0, 0.0], 0.0),
            ([0.4, 0.1, 0.0], 0.0),
            ([0.4, 0.1, 0.2], 0.999_999),
            ([0.4, 0.1, 0.2], 0.0),
        ] {
            let n = normal.map(|x| x / norm(normal));
            let section = cut(&shape, &plane(&m, n.map(|x| x * height), n));
            let text = summary(&section);
            assert!(section.is_complete(), "{normal:?} {height} {m:?} {text}");
            assert_eq!(
                (section.branches.len(), loops(&section)),
                (1, 1),
                "{normal:?} {height} {m:?} {text}"
            );
            assert!(section.contacts.is_empty(), "{text}");
            check_points(&section, &m, 2e-13, |x| dot(x, n) - height);
            check_points(&section, &m, 2e-13, |x| norm(x) - 1.0);
        }
    }
}

#[test]
fn a_plane_touches_a_sphere_in_one_point() {
    let unit = sphere([0.0, 1.0]);
    for m in motions() {
        let shape = m.surface(&unit);
        for normal in
            [[0.3, -0.5, 0.8], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.6, 0.8, 0.0]]
        {
            let n = normal.map(|x| x / norm(normal));
            let section = cut(&shape, &plane(&m, n, n));
            let text = summary(&section);
            assert_eq!(section.contacts.len(), 1, "{normal:?} {m:?} {text}");
            assert!(
                section.branches.is_empty() && section.is_complete(),
                "{normal:?} {m:?} {text}"
            );
            let x = m.back(section.contacts[0].at.point);
            assert!(norm(sub(x, n)) < 1e-6, "{x:?}");
            let none = cut(&shape, &plane(&m, n.map(|x| x * 1.000_001), n));
            assert_eq!(none, Section::default());
        }
    }
}

#[test]
fn planes_cut_a_torus_in_circles_and_ovals() {
    let unit = torus();
    for m in motions() {
        let shape = m.surface(&unit);
        // (normal, height, loops, open, contact branches, junctions)
        let slope = (0.5f64 / 2.0).asin();
        let villarceau = [slope.sin(), 0.0, slope.cos()];
        for (n, height, closed, open, tangential, junctions) in [
            ([0.0, 0.0, 1.0], 0.0, 2, 0, 0, 0),
            ([0.0, 0.0, 1.0], 0.2, 2, 0, 0, 0),
            ([0.0, 0.0, 1.0], 0.5, 1, 0, 1, 0),
            ([1.0, 0.0, 0.0], 0.0, 2, 0, 0, 0),
            ([1.0, 0.0, 0.0], 2.0, 1, 0, 0, 0),
            ([1.0, 0.0, 0.0], 1.4, 2, 0, 0, 0),
            ([1.0, 0.0, 0.0], 1.5, 0, 2, 0, 1),
            ([0.6, 0.8, 0.0], 1.5, 0, 2, 0, 1),
            (villarceau, 0.0, 0, 4, 0, 2),
        ] {
            let section = cut(&shape, &plane(&m, n.map(|x| x * height), n));
            let text = summary(&section);
            let found = (
                loops(&section),
                section.branches.len() - loops(&section),
                section.branches.iter().filter(|b| b.tangential).count(),
                section.junctions.len(),
            );
            assert_eq!(found, (closed, open, tangential, junctions), "{n:?} {height} {m:?} {text}");
            assert!(section.is_complete() && section.contacts.is_empty(), "{text}");
            let within = if tangential > 0 { 1e-9 } else { 3e-13 };
            let within = if junctions > 0 { 1e-10f64.max(within) } else { within };
            check_points(&section, &m, within, |x| dot(x, n) - height);
        }
    }
}

#[test]
fn a_plane_touches_a_cylinder_along_a_line() {
    let unit = cylinder([0.0, 1.0]);
    for m in motions() {
        let shape = m.surface(&unit);
        for n in [[1.0, 0.0, 0.0], [0.6, 0.8, 0.0]] {
            let section = cut(&shape, &plane(&m, n, n));
            let text = summary(&section);
            assert!(section.is_complete() && section.contacts.is_empty(), "{m:?} {text}");
            assert_eq!(section.branches.len(), 1, "{n:?} {m:?} {text}");
            assert!(section.branches[0].tangential, "{text}");
            assert_eq!(section.branches[0].ends, [End::Border; 2]);
            check_points(&section, &m, 1e-9, |x| dot(x, n) - 1.0);
        }
    }
}

#[test]
fn quadrics_cut_cylinders_and_a_surface_lies_in_its_own() {
    let unit = cylinder([0.0, 1.0]);
    for m in motions() {
        let shape = m.surface(&unit);
        let across = |radius: f64| {
            Quadric::cylinder(m.point([0.0; 3]), m.turn([1.0, 0.0, 0.0]), radius * m.scale).unwrap()
        };
        // Thinner: two loops around the x axis.
        let section = cut(&shape, &across(0.5));
        assert!(section.is_complete(), "{}", summary(&section));
        assert_eq!(
            (loops(&section), section.branches.len()),
            (2, 2),
            "{m:?} {}",
            summary(&section)
        );
        check_points(&section, &m, 3e-13, |x| x[1].hypot(x[2]) - 0.5);
        // Its own cylinder.
        let own =
            Quadric::cylinder(m.point([0.0, 0.0, 5.0]), m.turn([0.0, 0.0, 2.0]), m.scale).unwrap();
        let section = cut(&shape, &own);
        assert_eq!(section.overlaps, [[0.0, 1.0, 0.0, 1.0]], "{m:?} {}", summary(&section));
        assert!(section.branches.is_empty() && section.is_complete());
        // A sphere through both borders and one that touches along the waist.
        let ball = |r: f64| Quadric::sphere(m.point([0.0; 3]), r * m.scale).unwrap();
        let section = cut(&shape, &ball(1.25));
        assert_eq!(
            (loops(&section), section.branches.len()),
            (2, 2),
            "{m:?} {}",
            summary(&section)
        );
        check_points(&section, &m, 3e-13, |x| norm(x) - 1.25);
        let section = cut(&shape, &ball(1.0));
        let text = summary(&section);
        assert!(section.is_complete(), "{m:?} {text}");
        assert_eq!((loops(&section), section.branches.len()), (1, 1), "{m:?} {text}");
        assert!(section.branches[0].tangential, "{text}");
        // A cone with its apex on the cylinder's axis below.
        let cone = Quadric::cone(
            m.point([0.0, 0.0, -1.0]),
            m.turn([0.0, 0.0, 1.0]),
            0.25 * std::f64::consts::PI,
        )
        .unwrap();
        let section = cut(&shape, &cone);
        assert_eq!(
            (loops(&section), section.branches.len()),
            (1, 1),
            "{m:?} {}",
            summary(&section)
        );
        check_points(&section, &m, 3e-13, |x| x[2]);
    }
}

#[test]
fn equal_cylinders_cross_in_two_ellipses_with_two_junctions() {
    let unit = cylinder([0.0, 1.0]);
    for m in motions() {
        let shape = m.surface(&unit);
        for turn in [0.0, 0.3] {
            let axis = [f64::cos(turn), f64::sin(turn), 0.0];
            let other = Quadric::cylinder(m.point([0.0; 3]), m.turn(axis), m.scale).unwrap();
            let section = cut(&shape, &other);
            let text = summary(&section);
            // The ellipses reach z = +-1, where the cylinder ends: the arcs meet there on the border.
            assert!(section.is_complete(), "{m:?} {text}");
            assert_eq!(section.junctions.len(), 2, "{turn} {m:?} {text}");
            check_points(&section, &m, 1e-9, |x| {
                let along = dot(x, axis);
                norm(sub(x, axis.map(|a| a * along))) - 1.0
            });
        }
    }
}

/// A sheet with `rows` x `rows` bumps whose tops are at 4/9, bicubic; each top is a single point.
fn bumps(rows: usize) -> IndexedSurface {
    let count = 4 * rows + 3;
    let knots: Vec<f64> = (0..count + 4).map(|k| k as f64 - 3.0).collect();
    let mut poles = Vec::new();
    for i in 0..count {
        for j in 0..count {
            let up = i % 4 == 3 && j % 4 == 3;
            poles.push([i as f64 * 0.25, j as f64 * 0.25, if up { 1.0 } else { 0.0 }]);
        }
    }
    IndexedSurface::new(Surface::new(&knots, &knots, 3, 3, &poles, count, count, None).unwrap())
}

#[test]
fn all_small_loops_are_found_as_loops() {
    for rows in [1, 3, 10] {
        let sheet = bumps(rows);
        for m in motions() {
            if rows == 10 && m.scale != 1.0 {
                continue;
            }
            let shape = m.surface(&sheet);
            for gap in [1e-2, 1e-4, 1e-6, 1e-8] {
                // Far from the origin the poles themselves are rounded by more.
                if gap * m.scale < 1e5 * f64::EPSILON * norm(m.offset) {
                    continue;
                }
                let section = cut(&shape, &plane(&m, [0.0, 0.0, 4.0 / 9.0 - gap], [0.0, 0.0, 1.0]));
                let text = || summary(&section);
                assert!(section.is_complete(), "{rows} {gap} {m:?} {}", text());
                assert_eq!(loops(&section), rows * rows, "{rows} {gap} {m:?}");
                assert_eq!(section.branches.len(), rows * rows, "{rows} {gap} {m:?}");
                let above = plane(&m, [0.0, 0.0, 4.0 / 9.0 + gap], [0.0, 0.0, 1.0]);
                assert_eq!(cut(&shape, &above), Section::default());
            }
        }
    }
}

/// The sheet of [`bumps`] around the z axis at height `up`, mapped by inversion in the unit sphere: curved, rational, bidegree 6. Planes
/// across the axis at height h become spheres through the origin about (0, 0, 1 / 2h).
fn inverted_bumps(rows: usize, up: f64) -> IndexedSurface {
    let sheet = bumps(rows);
    let (surface, spans) = (sheet.surface(), 4 * rows);
    let middle = 0.25 * (4 * rows + 2) as f64 / 2.0;
    let at = |u: f64, v: f64| {
        let x = surface.evaluate(u, v);
        [x[0] - middle, x[1] - middle, x[2] + up]
    };
    // Bernstein coefficients of degree 6 from values at seven places.
    let binomial = [1., 6., 15., 20., 15., 6., 1.];
    let basis = |t: f64| -> [f64; 7] {
        std::array::from_fn(|i| binomial[i] * t.powi(i as i32) * (1.0 - t).powi(6 - i as i32))
    };
    let fit = |values: [f64; 7]| -> [f64; 7] {
        let mut rows: Vec<[f64; 8]> = (0..7)
            .map(|k| {
                let b = basis(k as f64 / 6.0);
                std::array::from_fn(|i| if i < 7 { b[i] } else { values[k] })
            })
            .collect();
        for c in 0..7 {
            let best = (c..7).max_by(|&a, &b| rows[a][c].abs().total_cmp(&rows[b][c].abs()));
            rows.swap(c, best.unwrap());
            for r in (0..7).filter(|&r| r != c) {
                let f = rows[r][c] / rows[c][c];
                (c..8).for_each(|k| rows[r][k] -= f * rows[c][k]);
            }
        }
        std::array::from_fn(|i| rows[i][7] / rows[i][i])
    };
    let count = 6 * spans + 1;
    let (mut poles, mut weights) = (vec![[0.0; 3]; count * count], vec![0.0; count * count]);
    for a in 0..spans {
        for b in 0..spans {
            // The homogeneous point: S, |S|^2.
            let mut net = [[[0.0; 7]; 7]; 4];
            for i in 0..7 {
                for j in 0..7 {
                    let x = at(a as f64 + i as f64 / 6.0, b as f64 + j as f64 / 6.0);
                    (0..3).for_each(|c| net[c][i][j] = x[c]);
                    net[3][i][j] = dot(x, x);
                }
            }
            for part in &mut net {
                *part = part.map(fit);
                for j in 0..7 {
                    let column = fit(std::array::from_fn(|i| part[i][j]));
                    (0..7).for_each(|i| part[i][j] = column[i]);
                }
            }
            for i in 0..7 {
                for j in 0..7 {
                    let k = (6 * a + i) * count + 6 * b + j;
                    weights[k] = net[3][i][j];
                    poles[k] = [0, 1, 2].map(|c| net[c][i][j] / net[3][i][j]);
                }
            }
        }
    }
    let knots: Vec<f64> =
        (0..count + 7).map(|k| (k.max(1) - 1) as f64 / 6.0).map(f64::floor).collect();
    let knots: Vec<f64> = knots.into_iter().map(|k| k.min(spans as f64)).collect();
    let surface = Surface::new(&knots, &knots, 6, 6, &poles, count, count, Some(&weights));
    IndexedSurface::new(surface.unwrap())
}

#[test]
fn all_small_loops_are_found_on_a_curved_rational_sheet_cut_by_a_sphere() {
    for (rows, up) in [(1, 2.0), (3, 4.0)] {
        let sheet = inverted_bumps(rows, up);
        for m in motions().into_iter().take(if rows == 1 { 4 } else { 2 }) {
            let shape = m.surface(&sheet);
            let ball = |gap: f64| {
                let radius = 0.5 / (up + 4.0 / 9.0 - gap);
                Quadric::sphere(m.point([0.0, 0.0, radius]), radius * m.scale).unwrap()
            };
            // The map makes gaps smaller than a hundredth of the default tolerance.
            let fine = SectionOptions { tolerance: 1e-9 * m.scale, ..SectionOptions::default() };
            for gap in [1e-2, 1e-4, 1e-6, 1e-8] {
                let section = shape.section(&ball(gap), &fine, &mut || false).unwrap();
                let text = || summary(&section);
                assert!(section.is_complete(), "{rows} {gap} {m:?} {}", text());
                assert_eq!(section.branches.len(), rows * rows, "{rows} {gap} {m:?} {}", text());
                assert_eq!(loops(&section), rows * rows, "{rows} {gap} {m:?} {}", text());
                let above = shape.section(&ball(-gap), &fine, &mut || false).unwrap();
                assert_eq!(above, Section::default(), "{rows} {gap}");
            }
        }
    }
}

#[test]
fn a_stack_of_planes_is_the_planes_one_by_one_for_any_number_of_threads() {
    let shape = torus();
    let planes: Vec<Quadric> = (0..40)
        .map(|k| Quadric::plane([0.0, 0.0, -0.6 + 0.03 * k as f64], [0.1, 0.2, 1.0]).unwrap())
        .collect();
    let options = SectionOptions { chord: 1e-3, ..SectionOptions::default() };
    let alone: Vec<Section> =
        planes.iter().map(|p| shape.section(p, &options, &mut || false).unwrap()).collect();
    for threads in [1, 3] {
        let together = shape.sections(&planes, &options, threads, &mut |_| false).unwrap();
        assert_eq!(together, alone);
    }
    // A stop after some of them: those are given, of the others the whole domain is undecided.
    for (threads, after) in [(1, 0), (1, 7), (3, 7)] {
        let part = shape.sections(&planes, &options, threads, &mut |done| done >= after).unwrap();
        assert_eq!(part.len(), planes.len());
        let whole: Vec<bool> = part.iter().zip(&alone).map(|(p, a)| !p.stopped && p == a).collect();
        assert!(whole.iter().filter(|&&is| is).count() >= after && whole.contains(&false));
        for (section, is) in part.iter().zip(whole) {
            assert!(is || section.stopped && !section.is_complete());
        }
    }
}

#[test]
fn polylines_keep_to_the_chord_tolerance() {
    let shape = torus();
    let plane = Quadric::plane([0.0, 0.0, 0.1], [0.3, 0.2, 1.0]).unwrap();
    for chord in [1e-2, 1e-4, 1e-6] {
        let options = SectionOptions { chord, ..SectionOptions::default() };
        let section = shape.section(&plane, &options, &mut || false).unwrap();
        for branch in &section.branches {
            for pair in branch.points.windows(2) {
                let middle = [0, 1, 2].map(|k| 0.5 * (pair[0].point[k] + pair[1].point[k]));
                // Distance of the chord's middle from the torus: no more than that from the branch.
                let off = (middle[0].hypot(middle[1]) - 2.0).hypot(middle[2]) - 0.5;
                assert!(off.abs() <= chord, "{chord} {off}");
            }
        }
    }
}

#[test]
fn a_spent_budget_lists_what_is_open() {
    let options = SectionOptions { budget: 3, ..SectionOptions::default() };
    let plane = Quadric::plane([0.0, 0.0, 0.0], [0.25, 0.0, 0.968_245_836_551_854_3]).unwrap();
    let section = torus().section(&plane, &options, &mut || false).unwrap();
    assert!(!section.is_complete());
    assert!(!section.stopped);
    let none = torus().section(&plane, &options, &mut || true).unwrap();
    assert!(none.stopped && !none.is_complete());
    // Corners of patches at which branches were not looked for are no contacts: this plane has none.
    assert!(none.contacts.is_empty());
    for budget in 1..200 {
        let options = SectionOptions { budget, ..SectionOptions::default() };
        let section = torus().section(&plane, &options, &mut || false).unwrap();
        assert!(section.contacts.is_empty(), "budget {budget}: {:?}", section.contacts);
    }
}

#[test]
fn a_stop_within_a_section_gives_the_branches_so_far_and_lists_the_rest() {
    let (shape, options) = (torus(), SectionOptions { chord: 1e-3, ..SectionOptions::default() });
    let plane = Quadric::plane([0.0, 0.0, 0.1], [0.3, 0.2, 1.0]).unwrap();
    let mut asked = 0;
    let mut count = || {
        asked += 1;
        false
    };
    let whole = shape.section(&plane, &options, &mut count).unwrap();
    assert!(whole.contacts.is_empty() && whole.is_complete());
    let mut partial = 0;
    for n in 1..=asked {
        let mut questions = 0;
        let mut stop = || {
            questions += 1;
            questions == n
        };
        let part = shape.section(&plane, &options, &mut stop).unwrap();
        assert!(part.stopped && questions == n);
        partial += usize::from(!part.branches.is_empty() && !part.is_complete());
        assert!(part.contacts.is_empty(), "question {n} of {asked}: {:?}", part.contacts);
        for point in whole.branches.iter().flat_map(|branch| &branch.points) {
            let near = |w: &[footpoint::intersect::BranchPoint]| {
                let (to, along) = (sub(point.point, w[0].point), sub(w[1].point, w[0].point));
                let share = (dot(to, along) / dot(along, along).max(1e-300)).clamp(0.0, 1.0);
                norm([0, 1, 2].map(|k| to[k] - share * along[k])) <= 3e-3
            };
            let [u, v] = point.at;
            let holds = |b: &[f64; 4]| {
                b[0] - 1e-9 <= u && u <= b[1] + 1e-9 && b[2] - 1e-9 <= v && v <= b[3] + 1e-9
            };
            assert!(
                part.undecided.iter().any(holds)
                    || part.branches.iter().any(|branch| branch.points.windows(2).any(near)),
                "question {n} of {asked}: {point:?} is lost"
            );
        }
    }
    assert!(partial > 0, "{asked} questions");
}

/// The sheet of [`bumps`] under the map x / (1 + a x): rational, with planes where planes were.
fn projected_bumps(rows: usize, a: Vector) -> IndexedSurface {
    let sheet = bumps(rows);
    let s = sheet.surface();
    let weights: Vec<f64> = s.poles().iter().map(|&x| 1.0 + dot(a, x)).collect();
    let poles: Vec<Vector> =
        s.poles().iter().zip(&weights).map(|(x, w)| x.map(|c| c / w)).collect();
    let (knots, count) = (s.knots_u().values(), s.knots_u().pole_count());
    let surface = Surface::new(knots, knots, 3, 3, &poles, count, count, Some(&weights));
    IndexedSurface::new(surface.unwrap())
}

#[test]
fn stacks_of_planes_find_all_loops_of_rational_sheets() {
    let (rows, a) = (3, [0.1, -0.03, 0.4]);
    let sheet = projected_bumps(rows, a);
    let top = 4.0 / 9.0;
    let mut heights: Vec<f64> = (1..8).map(|k| top * f64::from(k) / 8.0).collect();
    heights.extend([1e-2, 1e-4, 1e-6, 1e-8].map(|gap| top - gap));
    let options = SectionOptions { chord: 1e-3, ..SectionOptions::default() };
    for m in motions().into_iter().take(2) {
        let shape = m.surface(&sheet);
        // z = h of the sheet is Z + h a X = h of its image.
        let of = |h: f64| {
            let normal = [h * a[0], h * a[1], 1.0 + h * a[2]];
            let square = dot(normal, normal);
            plane(&m, normal.map(|x| x * h / square), normal)
        };
        let planes: Vec<Quadric> = heights.iter().map(|&h| of(h)).collect();
        let stack = shape.sections(&planes, &options, 2, &mut |_| false).unwrap();
        for (section, h) in stack.iter().zip(&heights) {
            let text = || summary(section);
            assert!(section.is_complete() && section.contacts.is_empty(), "{h} {m:?} {}", text());
            assert_eq!(section.branches.len(), rows * rows, "{h} {m:?} {}", text());
            assert_eq!(loops(section), rows * rows, "{h} {m:?} {}", text());
            // Back through the map: a point of the sheet at height h.
            check_points(section, &m, 3e-13, |x| x[2] / (1.0 - dot(a, x)) - h);
            for p in section.branches.iter().flat_map(|b| &b.points) {
                let off = sub(p.point, shape.surface().evaluate(p.at[0], p.at[1]));
                assert!(norm(off) <= 1e-14 * m.scale, "{h} {m:?}");
            }
        }
        let none = shape.sections(&[of(top + 1e-7)], &options, 1, &mut |_| false).unwrap();
        assert_eq!(none, [Section::default()]);
    }
}

#[test]
fn stacks_of_planes_cut_rings_and_balls_in_known_circles() {
    let (ring, ball) = (torus(), sphere([0.0, 1.0]));
    let options = SectionOptions { chord: 1e-3, ..SectionOptions::default() };
    for m in motions().into_iter().take(2) {
        let places: Vec<f64> = (0..20).map(|k| -2.6 + 0.266 * f64::from(k)).collect();
        let stack = |shape: &IndexedSurface, n: Vector| {
            let planes: Vec<Quadric> =
                places.iter().map(|&h| plane(&m, n.map(|x| x * h), n)).collect();
            m.surface(shape).sections(&planes, &options, 2, &mut |_| false).unwrap()
        };
        // Along its axis: two circles; across: two ovals, then one.
        let (up, across) = (stack(&ring, [0.0, 0.0, 1.0]), stack(&ring, [0.6, 0.8, 0.0]));
        let turned = stack(&ball, [0.48, 0.6, 0.64]);
        for (k, &h) in places.iter().enumerate() {
            let wanted = [
                if h.abs() < 0.5 { 2 } else { 0 },
                if h.abs() < 1.5 { 2 } else { usize::from(h.abs() < 2.5) },
                usize::from(h.abs() < 1.0),
            ];
            for (section, count) in [&up[k], &across[k], &turned[k]].into_iter().zip(wanted) {
                let text = summary(section);
                assert!(section.is_complete() && section.contacts.is_empty(), "{h} {m:?} {text}");
                assert_eq!(
                    (loops(section), section.branches.len()),
                    (count, count),
                    "{h} {m:?} {text}"
                );
            }
            check_points(&up[k], &m, 3e-13, |x| {
                ((x[0].hypot(x[1]) - 2.0).abs() - (0.25 - h * h).sqrt()).abs().max((x[2] - h).abs())
            });
            check_points(&turned[k], &m, 3e-13, |x| norm(x) - 1.0);
        }
    }
}
