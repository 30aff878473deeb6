//! The families of difficult shapes: each hard in one way, that of its name.

use super::design::Design;
use super::shapes::{FAMILIES as NETS, Random, curve, surface};
use super::{curves, sheets, turned};

/// How a design is made.
type Make = fn(&mut Random) -> Design;

#[derive(Clone, Copy)]
pub struct Family {
    pub name: &'static str,
    pub make: Make,
    /// Asked within a box of the parameters.
    pub restricted: bool,
}

const fn of(name: &'static str, make: Make) -> Family {
    Family { name, make, restricted: false }
}

const fn boxed(name: &'static str, make: Make) -> Family {
    Family { name, make, restricted: true }
}

pub const FAMILIES: [Family; 56] = [
    of("c smooth", curves::smooth),
    of("c rational", curves::rational),
    of("c random net", random_curve),
    of("c thread", curves::thread),
    of("c spiral", curves::spiral),
    of("c knotted", curves::knotted),
    of("c weights smooth 1e+-6", curves::smooth_weights),
    of("c weights random 1e+-6", curves::random_weights),
    of("c high degree", curves::high_degree),
    of("c creases", curves::creases),
    of("c cusps", curves::cusps),
    of("c zero spans", curves::zero_spans),
    of("c strips", curves::degenerate),
    of("c double covered", curves::double_covered),
    of("c conics", curves::conic),
    of("c almost circles", curves::almost_circle),
    of("c unclamped", curves::unclamped),
    of("c periodic", curves::periodic),
    of("c wild knots", curves::wild_knots),
    of("c sizes 1e+-9", curves::sized),
    of("c offset 1e8", curves::offset),
    of("c flat", curves::flat),
    boxed("c boxed", any_curve),
    of("s smooth", sheets::smooth),
    of("s rational", sheets::rational),
    of("s random net", random_surface),
    of("s ribbon", sheets::ribbon),
    of("s helicoid", sheets::helicoid),
    of("s rolled", sheets::rolled),
    of("s folded", sheets::folded),
    of("s knotted", sheets::knotted),
    of("s weights smooth 1e+-6", sheets::smooth_weights),
    of("s weights random 1e+-3", sheets::weights_of_three),
    of("s weights random 1e+-6", sheets::weights_of_six),
    of("s heavy middle", sheets::heavy_middle),
    of("s high degree", sheets::high_degree),
    of("s high degree one way", sheets::high_degree_one_way),
    of("s creases", sheets::creases),
    of("s cusps", sheets::cusps),
    of("s zero spans", sheets::zero_spans),
    of("s strips", sheets::strips),
    of("s slivers", sheets::slivers),
    of("s bilinear", sheets::bilinear),
    of("s many pieces", sheets::many_pieces),
    of("s unclamped", sheets::unclamped),
    of("s periodic", sheets::periodic),
    of("s wild knots", sheets::wild_knots),
    of("s flat", sheets::flat),
    of("s collapsed", turned::collapsed),
    of("s almost collapsed", turned::almost_collapsed),
    of("s cones and domes", turned::cone_or_dome),
    of("s spheres and tori", turned::primitive),
    of("s almost turned", turned::almost_primitive),
    of("s sizes 1e+-9", sized_surface),
    of("s offset 1e8", offset_surface),
    boxed("s boxed", any_surface),
];

/// Makers of the tests of laws, all of them.
fn random_curve(r: &mut Random) -> Design {
    let family = &NETS[r.whole(0, NETS.len() - 1)];
    Design::of_curve(&curve(family, r.bits()))
}

fn random_surface(r: &mut Random) -> Design {
    let family = &NETS[r.whole(0, NETS.len() - 1)];
    Design::of_surface(&surface(family, r.bits()))
}

/// Another family's design.
fn any(prefix: &str, r: &mut Random) -> Design {
    loop {
        let family = &FAMILIES[r.whole(0, FAMILIES.len() - 1)];
        if family.name.starts_with(prefix) && !family.restricted {
            return (family.make)(r);
        }
    }
}

fn any_curve(r: &mut Random) -> Design {
    any("c ", r)
}

fn any_surface(r: &mut Random) -> Design {
    any("s ", r)
}

const TAME: [Make; 6] = [
    sheets::smooth,
    sheets::rational,
    sheets::creases,
    sheets::folded,
    turned::primitive,
    turned::collapsed,
];

fn sized_surface(r: &mut Random) -> Design {
    let size = r.scale(-9.0, 9.0);
    TAME[r.whole(0, TAME.len() - 1)](r).moved(size, [0.0; 3])
}

fn offset_surface(r: &mut Random) -> Design {
    let size = r.scale(-3.0, 3.0);
    let center = r.direction().map(|x| x * size * r.scale(5.0, 8.0));
    TAME[r.whole(0, TAME.len() - 1)](r).moved(size, center)
}
