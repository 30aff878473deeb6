mod closed_forms;
use closed_forms::*;
use footpoint::extrema::ExtremaOptions;
#[test]
fn dbg() {
    let o = ExtremaOptions::default();
    let show = |name: &str, s: footpoint::set::FootSet| {
        println!("== {name} undecided {}", s.undecided.len());
        for m in &s.members { println!("  {:?} {:?} d {:.12} u {:?} v {:?} at {} {} flags {}", m.kind, m.nature, m.foot.distance, m.u, m.v, m.foot.u, m.foot.v, m.foot.flags); }
        for b in s.undecided.iter().take(4) { println!("  undecided {b:?}"); }
    };
    show("sphere axis", sphere(1.0).extrema([0.0,0.0,0.4], &o, &mut || false).unwrap());
    show("sphere seam", sphere(1.0).extrema([2.0,0.0,0.4], &o, &mut || false).unwrap());
    show("torus axis", torus(2.0,0.5).extrema([0.0,0.0,0.4], &o, &mut || false).unwrap());
    show("cylinder axis", cylinder(1.0,2.0).extrema([0.0,0.0,0.4], &o, &mut || false).unwrap());
    show("cone axis", cone(1.0,2.0).extrema([0.0,0.0,0.4], &o, &mut || false).unwrap());
}
