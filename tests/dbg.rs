mod closed_forms;
use closed_forms::*;
use footpoint::closest::QueryOptions;
use footpoint::preimage::Line;
#[test]
fn dbg() {
    let o = QueryOptions::default();
    let show = |name: &str, s: footpoint::set::FootSet| {
        println!("== {name} undecided {}", s.undecided.len());
        for m in &s.members {
            println!(
                "  {:?} {:?} d {:.3e} u {:?} v {:?} at {} {} flags {}",
                m.kind, m.nature, m.foot.distance, m.u, m.v, m.foot.u, m.foot.v, m.foot.flags
            );
        }
        for b in s.undecided.iter().take(4) {
            println!("  undecided {b:?}");
        }
    };
    let c = ellipse(1.0, 1.0);
    show("circle seam", c.preimage([1.0, 0.0, 0.0], 0.0, &o, &mut || false).unwrap());
    show("circle", c.preimage([0.6, 0.8, 0.0], 0.0, &o, &mut || false).unwrap());
    show("circle off", c.preimage([0.6, 0.8, 0.1], 0.0, &o, &mut || false).unwrap());
    show("circle big tol", c.preimage([0.6, 0.8, 0.1], 0.2, &o, &mut || false).unwrap());
    show("double", double_circle(1.0).preimage([0.6, 0.8, 0.0], 0.0, &o, &mut || false).unwrap());
    show(
        "double seam",
        double_circle(1.0).preimage([1.0, 0.0, 0.0], 0.0, &o, &mut || false).unwrap(),
    );
    let s = sphere(1.0);
    show("sphere pole", s.preimage([0.0, 0.0, 1.0], 0.0, &o, &mut || false).unwrap());
    show("sphere seam", s.preimage([0.6, 0.0, 0.8], 0.0, &o, &mut || false).unwrap());
    show("sphere gen", s.preimage([0.0, 0.6, 0.8], 0.0, &o, &mut || false).unwrap());
    show("sphere center", s.preimage([0.0, 0.0, 0.0], 1.0, &o, &mut || false).unwrap());
    show("sphere near pole", s.preimage([1e-8, 0.0, 1.0], 1e-7, &o, &mut || false).unwrap());
    show("cone tip", cone(1.0, 2.0).preimage([0.0, 0.0, 0.0], 0.0, &o, &mut || false).unwrap());
    let t = torus(2.0, 0.5);
    show("torus corner", t.preimage([2.5, 0.0, 0.0], 0.0, &o, &mut || false).unwrap());
    let line = |o: [f64; 3], d: [f64; 3]| Line {
        origin: o,
        direction: d,
        reach: [f64::NEG_INFINITY, f64::INFINITY],
    };
    show(
        "line x torus",
        t.on_line(&line([-5.0, 0.1, 0.1], [1.0, 0.0, 0.0]), 0.0, &o, &mut || false).unwrap(),
    );
    show(
        "ray torus",
        t.on_line(
            &Line { reach: [0.0, f64::INFINITY], ..line([0.0, 0.1, 0.1], [1.0, 0.0, 0.0]) },
            0.0,
            &o,
            &mut || false,
        )
        .unwrap(),
    );
    show(
        "line on cylinder",
        cylinder(1.0, 2.0)
            .on_line(&line([0.6, 0.8, 5.0], [0.0, 0.0, 3.0]), 0.0, &o, &mut || false)
            .unwrap(),
    );
    show(
        "line tangent cylinder",
        cylinder(1.0, 2.0)
            .on_line(&line([-7.0, 1.0, 0.5], [1.0, 0.0, 0.0]), 0.0, &o, &mut || false)
            .unwrap(),
    );
    show(
        "line circle",
        c.on_line(&line([-7.0, 0.6, 0.0], [1.0, 0.0, 0.0]), 0.0, &o, &mut || false).unwrap(),
    );
    let mut r = Random(1);
    for (name, f) in [("sphere", &s as &footpoint::index::IndexedSurface), ("torus", &t)] {
        let pts: Vec<[f64; 3]> = (0..2000)
            .map(|_| f.surface().evaluate(r.between(0.0, 4.0), r.between(0.0, 2.0)))
            .collect();
        let t0 = std::time::Instant::now();
        let mut k = 0;
        for p in &pts {
            k += f.preimage(*p, 0.0, &o, &mut || false).unwrap().members.len();
        }
        println!("{name} {} members, {:?} each", k, t0.elapsed() / 2000);
        let t0 = std::time::Instant::now();
        let mut k = 0;
        let mut un = 0;
        for p in &pts {
            let q = [p[0] * 1.1 + 0.01, p[1] * 0.9, p[2] * 0.8];
            let s = f.extrema(q, &Default::default(), &mut || false).unwrap();
            k += s.members.len();
            un += s.undecided.len();
        }
        println!("{name} extrema {} members, {un} undecided, {:?} each", k, t0.elapsed() / 2000);
    }
}
