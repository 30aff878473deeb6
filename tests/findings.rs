//! One named test per defect that was found by attack; each failed before its repair.

use footpoint::closest::{FootPoint, QueryOptions, Scope, Workspace, flag};
use footpoint::curve::Curve;
use footpoint::extrema::ExtremaOptions;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::set::{Kind, Nature};
use footpoint::surface::Surface;

const C1_KNOTS: [f64; 10] = [0., 0., 0., 0., 1., 2., 3., 3., 3., 3.];

fn line_of_six() -> IndexedCurve {
    let poles: Vec<[f64; 3]> = (0..6).map(|i| [f64::from(i), 0., 0.]).collect();
    IndexedCurve::new(Curve::new(&C1_KNOTS, 3, &poles, None).unwrap())
}

fn plane_of_36() -> IndexedSurface {
    let poles: Vec<[f64; 3]> = (0..36).map(|k| [f64::from(k / 6), f64::from(k % 6), 0.]).collect();
    IndexedSurface::new(Surface::new(&C1_KNOTS, &C1_KNOTS, 3, 3, &poles, 6, 6, None).unwrap())
}

fn circle() -> IndexedCurve {
    let poles = [[1., 0.], [1., 1.], [-1., 1.], [-1., 0.], [-1., -1.], [1., -1.], [1., 0.]]
        .map(|[x, y]| [x, y, 0.]);
    let knots = [0., 0., 0., 1., 2., 2., 3., 4., 4., 4.];
    let weights = [1., 0.5, 0.5, 1., 0.5, 0.5, 1.];
    IndexedCurve::new(Curve::new(&knots, 2, &poles, Some(&weights)).unwrap())
}

fn within(domain: [f64; 4]) -> QueryOptions {
    QueryOptions { domain: Some(domain), ..QueryOptions::default() }
}

fn ask_curve(
    curve: &IndexedCurve,
    query: [f64; 3],
    hint: Option<f64>,
    options: &QueryOptions,
) -> FootPoint {
    curve.closest(query, hint, options, &mut Workspace::default(), None)
}

#[test]
fn a_restriction_that_ends_on_a_simple_knot_has_a_border_there() {
    let foot = ask_curve(&line_of_six(), [-1., 1., 0.], Some(3.0), &within([1., 3., 0., 0.]));
    assert_eq!((foot.u, foot.flags & flag::NOT_PROVEN), (1.0, 0));
    let query = [-1., -1., 1.];
    let options = within([1., 3., 1., 3.]);
    let foot =
        plane_of_36().closest(query, Some([3., 3.]), &options, &mut Workspace::default(), None);
    assert_eq!(([foot.u, foot.v], foot.flags & flag::NOT_PROVEN), ([1.0, 1.0], 0));
}

#[test]
fn the_seam_rule_does_not_leave_the_restriction() {
    let foot = ask_curve(&circle(), [2., 0.5, 0.], None, &within([2.5, 4., 0., 0.]));
    assert_eq!(foot.u, 4.0);
    assert!(foot.flags & flag::SEAM != 0);
}

#[test]
fn a_restriction_of_a_few_ulps_has_a_foot() {
    for domain in
        [[2.5, 2.5 + 4e-16, 0., 0.], [2.0 - 1e-15, 2.0, 0., 0.], [2.0, 2.0 + 1e-15, 0., 0.]]
    {
        let foot = ask_curve(&circle(), [3., 1., 0.5], None, &within(domain));
        assert!(foot.u >= domain[0] && foot.u <= domain[1], "{domain:?}: {foot:?}");
        assert!(foot.lower_bound <= foot.distance);
        assert_eq!(foot.flags & flag::NOT_PROVEN, 0, "{domain:?} {foot:?}");
    }
    let query = [1., 1., 3.];
    let options = within([1.0, 1.0 + 4e-16, 2.0 - 4e-16, 2.0]);
    let foot = plane_of_36().closest(query, None, &options, &mut Workspace::default(), None);
    assert!(
        foot.u >= 1.0
            && foot.u <= 1.0 + 4e-16
            && foot.v <= 2.0
            && foot.flags & flag::NOT_PROVEN == 0
    );
}

#[test]
fn a_query_whose_square_overflows_has_a_foot() {
    let poles = [[0.; 3], [1e-60, 0., 0.]];
    let curve = IndexedCurve::new(Curve::new(&[0., 0., 1., 1.], 1, &poles, None).unwrap());
    let foot = ask_curve(&curve, [1e99, 0., 0.], None, &QueryOptions::default());
    assert_eq!(foot.distance, 1e99);
    assert!(foot.lower_bound <= foot.distance && foot.lower_bound > 0.99e99);
}

#[test]
fn a_hint_that_is_no_number_is_no_hint() {
    let options = QueryOptions { scope: Scope::Local, ..QueryOptions::default() };
    let foot = ask_curve(&circle(), [0.9, 0.9, 0.], Some(f64::NAN), &options);
    assert!(foot.u.is_finite() && foot.flags & flag::HINT_USED == 0);
}

#[test]
fn an_area_narrower_than_the_grain_of_doubles_leaves_no_hole() {
    const W: f64 = 5.37115158004024e-9;
    const THIRD: f64 = 1.0 / 3.0;
    const TWO_THIRDS: f64 = 2.0 / 3.0;
    let poles = [
        [0., 0., 0.2],
        [0., THIRD, 0.1],
        [0., TWO_THIRDS, 0.1],
        [0., 1., 0.30000000000000004],
        [0.019328801775016148, 0., 0.30000000000000004],
        [0.32768509073257646, THIRD, 0.1],
        [0.0030082055051630086, TWO_THIRDS, 0.30000000000000004],
        [0.013366822334246218, 1., 0.2],
        [1.040308199767788, 0., 0.],
        [0.07866619601542378, THIRD, 0.30000000000000004],
        [0.007769385057732419, TWO_THIRDS, 0.],
        [0.002339676575999944, 1., 0.1],
    ];
    let weights = [1., 1., 1., W, 1., 1., 1., W, W, 1., 1., 1.];
    let knots_u = [0., 0., 0., 1., 1., 1.];
    let knots_v = [-1., -1., -1., -1., 0., 0., 0., 0.];
    let surface = Surface::new(&knots_u, &knots_v, 2, 3, &poles, 3, 4, Some(&weights)).unwrap();
    let surface = IndexedSurface::new(surface);
    let query = [6.050804107674703e-14, 0.8409991172122336, 0.20459947048343183];
    let options = QueryOptions::default();
    let foot = surface.closest(query, None, &options, &mut Workspace::default(), None);
    let there = surface.surface().evaluate(3.5904941586478654e-12, -1.6329295639550141e-9);
    let distance = (0..3).map(|k| (there[k] - query[k]).powi(2)).sum::<f64>().sqrt();
    assert!(foot.lower_bound <= distance + 1e-15, "{foot:?} {distance:e}");
}

#[test]
fn a_restriction_that_ends_near_a_light_pole_is_searched_to_its_end() {
    let (a, b, u1) = (-4.28545346334217, -0.03834660951384494, -0.03834661025701687);
    let poles: Vec<[f64; 3]> =
        (0..5).map(|i| [f64::from(i) / 4.0, 0.1 * f64::from(i * i), 0.]).collect();
    let weights = [1., 1., 1., 1., 5.5533222926328775e-9];
    let knots = [[a; 5], [b; 5]].concat();
    let curve = IndexedCurve::new(Curve::new(&knots, 4, &poles, Some(&weights)).unwrap());
    let query = [1.2, 2.0, 0.1];
    let foot = ask_curve(&curve, query, None, &within([a + 0.3 * (b - a), u1, 0., 0.]));
    let end = curve.curve().evaluate(u1);
    let distance = (0..3).map(|k| (end[k] - query[k]).powi(2)).sum::<f64>().sqrt();
    assert!(foot.lower_bound <= distance + 1e-15, "{foot:?} {distance}");
}

#[test]
fn feet_at_one_distance_on_two_sides_of_a_corner_are_a_tie() {
    let poles = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0., 0., 0.]];
    let knots = [0., 0., 1., 2., 3., 4., 4.];
    let square = IndexedCurve::new(Curve::new(&knots, 1, &poles, None).unwrap());
    for query in [[0.5, 0.5, 0.], [0.3, 0.3, 0.]] {
        let foot = ask_curve(&square, query, None, &QueryOptions::default());
        assert_ne!(foot.flags & flag::TIE, 0, "{foot:?}");
    }
    let foot = ask_curve(&square, [0.5, 0.4, 0.], None, &QueryOptions::default());
    assert_eq!(foot.flags & flag::TIE, 0, "{foot:?}");
}

#[test]
fn weights_whose_squares_underflow_close_no_box() {
    let poles = [
        [0.4013149573371284, 0.7135668477471271, 0.10891257424409562],
        [0.04902048923809199, 0.7117543386391908, 0.17750856214762967],
        [0.3610693054736651, 0.40793976217086825, 0.9344293515950043],
        [0.5143839741633955, 0.5938459186383039, 0.6245794384643272],
        [0.06212802076080781, 0.5783922477423444, 0.14989971007637937],
        [0.9375934344869631, 0.3514372541845734, 0.8885464170927643],
        [0.27666455401417533, 0.24076141158560715, 0.8184669297834566],
        [0.09876788354972954, 0.9568279493429172, 0.19999014239819013],
    ];
    let weights = [1e-100, 1e100, 1e100, 1e100, 1e100, 1e100, 1e100, 1e100];
    let knots = [[0.0; 8], [1.0; 8]].concat();
    let curve = IndexedCurve::new(Curve::new(&knots, 7, &poles, Some(&weights)).unwrap());
    let query = [0.6874654433263584, 0.5204078089163854, 0.28225464030387104];
    let foot = ask_curve(&curve, query, None, &QueryOptions::default());
    // The stretch from pole 0 to pole 1 is run through between u = 1e-202 and 1e-199: sample it geometrically.
    let nearest = (0..4000)
        .map(|k| curve.curve().evaluate(10f64.powf(-203.0 + f64::from(k) * 0.001)))
        .map(|p| (0..3).map(|c| (p[c] - query[c]).powi(2)).sum::<f64>().sqrt())
        .fold(f64::INFINITY, f64::min);
    assert!(foot.lower_bound <= nearest, "{foot:?} {nearest}");
    assert!(
        foot.flags & flag::NOT_PROVEN != 0 || foot.distance <= nearest + 1e-9,
        "{foot:?} {nearest}"
    );
}

#[test]
fn a_gap_above_a_billionth_of_the_diagonal_is_marked_whatever_the_grain() {
    let still = [0.2, -0.22022222783132542, -0.1867324164374119];
    let poles = [
        [0.0, -0.08898207200154067, -0.042374642225009446],
        still,
        still,
        still,
        still,
        [1.0, 0.03239796977105913, 0.0537800585613947],
        [1.2, 0.24572588463085598, 0.126702749904746],
        [1.4, -0.24500434354194536, -0.06461723088626208],
        [1.6, -0.015698730604853803, -0.14903395451257603],
        [1.8, 0.21454269069860513, -0.031963905839379206],
        [2.0, -0.016190190330436692, -0.18846977065063528],
    ];
    let (a, b, end) = (0.3411052747785883, 0.7145233173438154, 0.7145233174438154);
    let knots = [-1., -1., -1., -1., -0.17882572046639722, a, a, a, b, b, b, end, end, end, end];
    let curve = IndexedCurve::new(Curve::new(&knots, 3, &poles, None).unwrap());
    let query = [1.999999976460183, -0.016190189354469694, -0.18846977992746589];
    let foot = ask_curve(&curve, query, Some(b), &QueryOptions::default());
    let diagonal = 2.08;
    let is_marked = foot.flags & flag::NOT_PROVEN != 0;
    assert!(is_marked || foot.distance - foot.lower_bound <= 1e-9 * diagonal, "{foot:?}");
}

/// Distance of the nearest member of all extrema.
fn least_of_extrema(curve: &IndexedCurve, query: [f64; 3]) -> f64 {
    let set = curve.extrema(query, &ExtremaOptions::default(), &mut || false).unwrap();
    assert!(set.is_complete());
    set.members.iter().map(|member| member.foot.distance).fold(f64::INFINITY, f64::min)
}

#[test]
fn all_extrema_of_a_curve_of_degree_9_are_found() {
    let poles = [
        [0.0, -0.21742920378259722, 0.0987646337362143],
        [0.15384615384615385, -0.19282840530584502, -0.051572504800005525],
        [0.3076923076923077, 0.2991350820932468, -0.12013473092573257],
        [0.46153846153846156, 0.22071180683277067, 0.025348711024755534],
        [0.6153846153846154, -0.2359335213272104, -0.05341381330068691],
        [0.7692307692307693, 0.19709916164210642, 0.04166848806280328],
        [0.9230769230769231, -0.15163734249927988, 0.023609736965870588],
        [1.0769230769230769, -0.06994977832199034, -0.12087388282627201],
        [1.2307692307692308, 0.19280933914594953, 0.19693993348829994],
        [1.3846153846153846, -0.16140547074990663, 0.12238133906238141],
        [1.5384615384615385, 0.06764249454363506, -0.02263544861267284],
        [1.6923076923076923, -0.26717052394363733, -0.14254179985773882],
        [1.8461538461538463, -0.19397588880958958, 0.04248449041242002],
        [2.0, 0.2772937747436149, -0.0008809211319166899],
    ];
    let inner = [0.8897921881832074, 1.7041604925659326, 2.058096467953413, 3.0232500512059906];
    let knots = [&[0.0; 10][..], &inner, &[3.6275281993029242; 10]].concat();
    let curve = IndexedCurve::new(Curve::new(&knots, 9, &poles, None).unwrap());
    let query = [0.21177435671056621, 0.07812398654675368, -0.024169443969178472];
    let foot = ask_curve(&curve, query, None, &QueryOptions::default());
    let least = least_of_extrema(&curve, query);
    assert!((least - foot.distance).abs() < 1e-9, "{least} {foot:?}");
}

#[test]
fn corners_that_are_near_in_their_parameters_only_are_two_extrema() {
    let poles = [
        [-0.2938793686617971, -0.20937906224430813, 0.610149241511214],
        [-0.25722210978614135, 0.8379484673243718, -0.3428918374306833],
        [0.06471254249714797, -0.15188918650814176, 0.036051816141388304],
        [0.5373602588540767, 0.4939235955698098, -0.6090487613618087],
        [0.2679370378549766, -0.5404863709420731, 0.33648094465563316],
        [0.05351628793852381, -0.18573699536262067, -0.8954909962958573],
        [-0.19427455966751728, 0.8832589816714613, 0.5758320062191167],
        [0.6020965427036038, 0.883548735342844, 0.417954441016517],
        [0.15648171083593043, -0.4079603205663289, 0.7597594787701172],
    ];
    let last = 3.662557249324592;
    let knots = [
        -1.0,
        -1.0,
        -0.3678752655333153,
        0.3268542147457414,
        1.2935148016208655,
        2.1212976537928934,
        3.050237014604398,
        3.2992359957819186,
        last,
        last + 1e-10,
        last + 1e-10,
    ];
    let curve = IndexedCurve::new(Curve::new(&knots, 1, &poles, None).unwrap());
    let query = [0.5952792608684534, -0.4761749602908608, 1.2233509705363883];
    let least = least_of_extrema(&curve, query);
    assert!((least - 0.6419607450813242).abs() < 1e-9, "{least}");
}

#[test]
fn a_vanishing_derivative_beside_a_tiny_patch_does_not_stop_the_iteration() {
    // Along u the first patch is 4.6e-11 long, and at its end the derivative almost vanishes.
    let short = 4.552872749773262e-11;
    let knots_u = [0., 0., 0., 0., short, 1., 1., 1., 1.];
    let knots_v = [0., 0., 1., 1.];
    let mut poles = Vec::new();
    for [x, z] in [[-0.4, 0.3], [0.0, 0.05], [0.02, 0.0], [0.5, 0.1], [1.0, 0.4]] {
        poles.extend([[x, 0., z], [x + 0.1, 1., z]]);
    }
    let surface = Surface::new(&knots_u, &knots_v, 3, 1, &poles, 5, 2, None).unwrap();
    let surface = IndexedSurface::new(surface);
    for k in 0..40 {
        let query = [-0.3 + 0.01 * f64::from(k), 0.4, -0.5];
        let foot =
            surface.closest(query, None, &QueryOptions::default(), &mut Workspace::default(), None);
        for step in [0.003, 0.01, 0.03, 0.1, 0.3] {
            for u in [foot.u - step * short, foot.u + step * short] {
                let there = surface.surface().evaluate(u.clamp(0.0, 1.0), foot.v);
                let away = (0..3).map(|c| (there[c] - query[c]).powi(2)).sum::<f64>().sqrt();
                assert!(foot.distance <= away + 1e-14, "{foot:?} {u:e} {away}");
            }
        }
    }
}

#[test]
fn a_second_foot_found_first_still_ties() {
    // Two strands of a curve, covered twice, on both sides of the query: four feet, two points.
    let poles = [[0., 0., 0.], [1., 2., 0.], [2., 0., 0.], [1., 2., 0.], [0., 0., 0.]];
    let knots = [0., 0., 0., 1., 1., 2., 2., 2.];
    let curve = IndexedCurve::new(Curve::new(&knots, 2, &poles, None).unwrap());
    let foot = ask_curve(&curve, [1., 0.2, 0.], None, &QueryOptions::default());
    assert_eq!(foot.flags & (flag::TIE | flag::NOT_PROVEN), flag::TIE, "{foot:?}");
    let foot = ask_curve(&curve, [1.01, 0.2, 0.], None, &QueryOptions::default());
    assert_eq!(foot.flags & (flag::TIE | flag::NOT_PROVEN), 0, "{foot:?}");
}

#[test]
fn the_bound_is_as_sharp_far_from_the_origin() {
    let offset = 1e8;
    let poles: Vec<[f64; 3]> = (0..5)
        .map(|i| [offset + f64::from(i), offset - 2.0 * f64::from(i % 2), 0.5 * f64::from(i % 3)])
        .collect();
    let knots = [0., 0., 0., 0., 0.5, 1., 1., 1., 1.];
    let curve = IndexedCurve::new(Curve::new(&knots, 3, &poles, None).unwrap());
    let moved: Vec<[f64; 3]> = poles.iter().map(|p| [p[0] - offset, p[1] - offset, p[2]]).collect();
    let near = IndexedCurve::new(Curve::new(&knots, 3, &moved, None).unwrap());
    for k in 0..20 {
        let query = [0.25 * f64::from(k), 1.5, -0.5 * f64::from(k % 5)];
        let far = [query[0] + offset, query[1] + offset, query[2]];
        let expected = ask_curve(&near, query, None, &QueryOptions::default());
        let foot = ask_curve(&curve, far, None, &QueryOptions::default());
        assert!((foot.u - expected.u).abs() < 1e-13, "{foot:?} {expected:?}");
        assert!((foot.lower_bound - expected.lower_bound).abs() < 1e-9, "{foot:?} {expected:?}");
        assert_eq!(foot.flags & flag::NOT_PROVEN, 0);
    }
}

/// Poles around the axis with three arcs of 120 degrees, each meeting the next at a double knot.
fn turned_in_thirds(
    meridian: &[([f64; 2], f64)],
    knots_v: &[f64],
    centre: [f64; 3],
) -> IndexedSurface {
    const THIRD: f64 = 2.0943951023931953;
    let knots_u =
        [0., 0., 0., THIRD, THIRD, 2. * THIRD, 2. * THIRD, 3. * THIRD, 3. * THIRD, 3. * THIRD];
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for k in 0..7 {
        let (sin, cos) = (0.5 * THIRD * f64::from(k % 6)).sin_cos();
        let (away, weight) = if k % 2 == 0 { (1.0, 1.0) } else { (2.0, 0.5) };
        for &([r, z], w) in meridian {
            poles.push([centre[0] + away * r * cos, centre[1] + away * r * sin, centre[2] + z]);
            weights.push(w * weight);
        }
    }
    let count = meridian.len();
    let made = Surface::new(&knots_u, knots_v, 2, 2, &poles, 7, count, Some(&weights));
    IndexedSurface::new(made.unwrap())
}

/// The nearest and the farthest point of a sphere, and nothing else, for queries beside its axis. Rounding of the centre
/// opens the poles a little.
fn check_beside_the_axis(centre: [f64; 3], radius: f64) {
    let r = 0.5f64.sqrt();
    let half = [([0., -1.], 1.), ([1., -1.], r), ([1., 0.], 1.), ([1., 1.], r), ([0., 1.], 1.)]
        .map(|([x, z], w)| ([radius * x, radius * z], w));
    let sphere = turned_in_thirds(&half, &[0., 0., 0., 1., 1., 2., 2., 2.], centre);
    for k in 0..600 {
        let away = 10f64.powf(-8.5 + 0.005 * f64::from(k)) * radius;
        let angle = 2.39996 * f64::from(k);
        let height = radius * [0.98, -0.99, 0.999, -1.01, 1.3, -0.4][k as usize % 6];
        let from = [away * angle.cos(), away * angle.sin(), height];
        let query = [0, 1, 2].map(|c| centre[c] + from[c]);
        let set = sphere.extrema(query, &ExtremaOptions::default(), &mut || false).unwrap();
        let size = (away * away + height * height).sqrt();
        assert_eq!((set.members.len(), set.undecided.len()), (2, 0), "{k}: {set:?}");
        for (member, sign) in set.members.iter().zip([1.0, -1.0]) {
            let apart = (0..3)
                .map(|c| {
                    (member.foot.point[c] - centre[c] - sign * radius * from[c] / size).powi(2)
                })
                .sum::<f64>()
                .sqrt();
            assert!(apart < 1e-9 * radius, "{k}: {apart:e} {member:?}");
            assert_eq!(member.foot.flags & flag::NOT_PROVEN, 0, "{k}: {member:?}");
        }
    }
}

#[test]
fn beside_a_pole_a_zero_is_seen_once_and_none_is_lost() {
    check_beside_the_axis([0., 0., 0.], 1.0);
    check_beside_the_axis([-72.5, -33.1, 0.25], 2.0);
    check_beside_the_axis([1.11e-14, 3.7e-15, -40.0], 10.0);
}

#[test]
fn beside_an_edge_open_by_rounding_a_zero_is_one_of_the_shape_itself() {
    // A quarter of a disc, slightly bent; the poles of its centre are apart by 1e-13, and the foot is 1e-7 from it.
    let mut poles = Vec::new();
    for i in 0..4 {
        let (x, y) = ([1., 1., 0.55, 0.][i], [0., 0.55, 1., 1.][i]);
        let open = 1e-13 * [0., 1., -1., 0.5][i];
        poles.extend([[0., 0., open], [0.5 * x, 0.5 * y, 0.], [x, y, 0.1]]);
    }
    let knots_u = [0., 0., 0., 0., 1., 1., 1., 1.];
    let knots_v = [0., 0., 0., 1., 1., 1.];
    let surface = Surface::new(&knots_u, &knots_v, 3, 2, &poles, 4, 3, None).unwrap();
    let fan = IndexedSurface::new(surface);
    for k in 1..20 {
        let (sin, cos) = (0.075 * f64::from(k)).sin_cos();
        let query = [1e-7 * cos, 1e-7 * sin, 1e-4];
        let set = fan.extrema(query, &ExtremaOptions::default(), &mut || false).unwrap();
        let inside = set.members.iter().filter(|member| member.foot.flags & flag::EDGE == 0);
        let feet: Vec<_> = inside.map(|member| member.foot).collect();
        assert_eq!((feet.len(), set.is_complete()), (1, true), "{k}: {set:?}");
        let (mut out, foot) = ([[0.0; 3]; 3], &feet[0]);
        fan.surface().partials(foot.u, foot.v, 1, &mut out);
        let d = fan.surface().vector_from(query, foot.u, foot.v);
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        for tangent in [out[1], out[2]] {
            let cosine = dot(d, tangent) / (dot(d, d) * dot(tangent, tangent)).sqrt();
            assert!(cosine.abs() < 1e-9, "{k}: {cosine:e} {foot:?}");
        }
    }
}

#[test]
fn beside_a_collapsed_edge_a_border_is_a_minimum_only_when_the_distance_rises_from_it() {
    // A quarter of a plane disc. The query lies beside its centre: the nearest point is inside, and towards it the distance
    // falls from both borders.
    let r = 0.5f64.sqrt();
    let mut poles = Vec::new();
    for (x, y) in [(1., 0.), (1., 1.), (0., 1.)] {
        poles.extend([[0.; 3], [x, y, 0.]]);
    }
    let (knots_u, knots_v) = ([0., 0., 0., 1., 1., 1.], [0., 0., 1., 1.]);
    let weights = [1., 1., r, r, 1., 1.];
    let surface = Surface::new(&knots_u, &knots_v, 2, 1, &poles, 3, 2, Some(&weights)).unwrap();
    let disc = IndexedSurface::new(surface);
    for away in [1e-9, 1e-7, 1e-5, 1e-3] {
        let set = disc
            .extrema([0.8 * away, 0.6 * away, 1e-2], &ExtremaOptions::default(), &mut || false)
            .unwrap();
        let near = set.members.iter().filter(|member| (1e-12..0.5).contains(&member.foot.v));
        let natures: Vec<Nature> = near.map(|member| member.nature).collect();
        assert_eq!(natures, [Nature::Minimum, Nature::Saddle, Nature::Saddle], "{away}: {set:?}");
    }
}

#[test]
fn a_query_on_the_pole_of_a_cap_is_decided_in_few_boxes() {
    // A cap of 138 degrees in one piece along the meridian; its weights end far below one.
    let half = 0.5 * 138.19f64.to_radians();
    let (sin, cos) = (2.0 * half).sin_cos();
    let meridian =
        [([0., -1.], 1.), ([half.tan(), -1.], half.cos()), ([sin, -cos], 1.)].map(|(p, w)| (p, w));
    let cap = turned_in_thirds(&meridian, &[0., 0., 0., 1., 1., 1.], [1e-16, 1.1e-14, -40.0]);
    let query = cap.surface().evaluate(4.2, 0.0);
    let options = ExtremaOptions { budget: 500, ..ExtremaOptions::default() };
    let set = cap.extrema(query, &options, &mut || false).unwrap();
    assert!(set.is_complete(), "{set:?}");
    assert!(set.members[0].foot.distance < 1e-13, "{set:?}");
}

/// An eighth of a sphere whose poles at the top are 1e-9 apart: along that edge, and along a line beside it, the distance
/// to a query on it is almost constant.
fn open_eighth() -> IndexedSurface {
    let r = 0.5f64.sqrt();
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for ([x, y], w) in [([1., 0.], 1.), ([1., 1.], r), ([0., 1.], 1.)] {
        for ([away, z], v) in [([1., 0.], 1.), ([1., 1.], r), ([1e-9, 1.], 1.)] {
            poles.push([away * x, away * y, z]);
            weights.push(w * v);
        }
    }
    let knots = [0., 0., 0., 1., 1., 1.];
    let surface = Surface::new(&knots, &knots, 2, 2, &poles, 3, 3, Some(&weights)).unwrap();
    IndexedSurface::new(surface)
}

#[test]
fn a_flat_member_that_goes_on_in_an_undecided_box_is_marked_and_no_minimum() {
    let cylinder = oblique_cylinder(2e-4);
    let mut cut = 0;
    for budget in (20..1_000).step_by(7) {
        let options = ExtremaOptions { budget, ..ExtremaOptions::default() };
        let set = cylinder.extrema([0.; 3], &options, &mut || false).unwrap();
        for member in &set.members {
            let ([u0, u1], [v0, v1]) = (member.u, member.v);
            let goes_on = (u0 < u1 || v0 < v1)
                && set
                    .undecided
                    .iter()
                    .any(|b| u0 <= b[1] && b[0] <= u1 && v0 <= b[3] && b[2] <= v1);
            if goes_on && member.kind == Kind::Point {
                let is_marked = member.foot.flags & flag::NOT_PROVEN != 0;
                assert!(is_marked && member.nature == Nature::Flat, "{budget}: {member:?}");
                cut += 1;
            }
        }
    }
    assert!(cut > 0);
}

#[test]
fn beside_an_almost_collapsed_edge_an_oblique_line_of_zeros_takes_few_boxes() {
    let eighth = open_eighth();
    let options = ExtremaOptions { budget: 2_000, ..ExtremaOptions::default() };
    for k in 0..8 {
        let query = eighth.surface().evaluate(0.1 + 0.1 * f64::from(k), 1.0 - 1e-10 * f64::from(k));
        let set = eighth.extrema(query, &options, &mut || false).unwrap();
        assert!(set.is_complete(), "{k}: {set:?}");
        assert!(set.members[0].foot.distance < 2e-10, "{k}: {set:?}");
    }
}

/// A quarter of a cylinder whose circles run obliquely to u, by `oblique` of a radius.
fn oblique_cylinder(oblique: f64) -> IndexedSurface {
    let r = 0.5f64.sqrt();
    let mut poles = Vec::new();
    for (x, y, rise) in [(1., 0., 0.), (1., 1., 0.5), (0., 1., 1.)] {
        poles.extend([[x, y, -1. + oblique * rise], [x, y, 1. + oblique * rise]]);
    }
    let weights = [1., 1., r, r, 1., 1.];
    let (knots_u, knots_v) = ([0., 0., 0., 1., 1., 1.], [0., 0., 1., 1.]);
    let made = Surface::new(&knots_u, &knots_v, 2, 1, &poles, 3, 2, Some(&weights));
    IndexedSurface::new(made.unwrap())
}

#[test]
fn intervals_that_hold_more_than_an_oblique_continuum_are_marked() {
    let cylinder = oblique_cylinder(2e-4);
    let set = cylinder.extrema([0.; 3], &ExtremaOptions::default(), &mut || false).unwrap();
    let mut wide = 0;
    for member in &set.members {
        let ([u0, u1], [v0, v1]) = (member.u, member.v);
        let corners = [[u0, v0], [u0, v1], [u1, v0], [u1, v1]];
        let change = corners.map(|[u, v]| {
            let p = cylinder.surface().evaluate(u, v);
            let away = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
            (away - member.foot.distance).abs()
        });
        let is_level = change.iter().all(|&x| x < 1e-9);
        wide += usize::from(!is_level);
        assert!(is_level || member.foot.flags & flag::NOT_PROVEN != 0, "{member:?} {change:?}");
    }
    assert!(wide > 0, "{set:?}");
}

#[test]
fn a_minimum_on_a_border_inside_a_span_that_doubles_do_not_resolve_is_found() {
    // A band that turns by a right angle within 1e-10 of its parameter: the turn lies in doubles on the knot before it.
    let corner = [[0., 0.], [1., 0.], [2., 0.], [2., 2.]];
    let poles: Vec<[f64; 3]> = corner.iter().flat_map(|&[x, y]| [[x, y, 0.], [x, y, 1.]]).collect();
    let end = 1.0 + 1e-10;
    let knots = [0., 0., 0., 1., end, end, end];
    let band = Surface::new(&knots, &[0., 0., 1., 1.], 2, 1, &poles, 4, 2, None).unwrap();
    let band = IndexedSurface::new(band);
    for z in [0.5f64, 1.5, -0.25] {
        let query = [3., -1., z];
        let height = (z - z.clamp(0., 1.)).abs();
        let distance = (2.0f64 + height * height).sqrt();
        let set = band.extrema(query, &ExtremaOptions::default(), &mut || false).unwrap();
        let nearest = set.members[0];
        assert!(set.is_complete() && nearest.nature == Nature::Minimum, "{z}: {set:?}");
        assert!((nearest.foot.distance - distance).abs() < 1e-9, "{z}: {nearest:?}");
        assert_eq!(nearest.foot.v, z.clamp(0., 1.));
    }
}

/// A cut beside a tip left its parts without coefficients, and a fresh workspace (all zeros) let both be closed unseen.
#[test]
fn a_cut_beside_the_tip_of_a_rational_cone_loses_nothing() {
    let round = [[1., 0.], [1., 1.], [-1., 1.], [-1., 0.], [-1., -1.], [1., -1.], [1., 0.]];
    let knots = [0., 0., 0., 1., 2., 2., 3., 4., 4., 4.];
    let poles: Vec<[f64; 3]> =
        round.iter().flat_map(|&[x, y]| [[0.; 3], [1.1 * x, y, 1.0]]).collect();
    let weights = [1., 0.5, 0.5, 1., 0.5, 0.5, 1.].map(|w: f64| [w, w]).concat();
    let cone = Surface::new(&knots, &[0., 0., 1., 1.], 2, 1, &poles, 7, 2, Some(&weights)).unwrap();
    let (cone, options) = (IndexedSurface::general(cone), QueryOptions::default());
    let mut used = Workspace::default();
    for k in 0..200 {
        let angle = 0.1 * f64::from(k);
        let size = 0.5f64.powi(k % 30);
        let query = [0.3 * size * angle.cos(), 0.2 * size * angle.sin(), 0.4 * size];
        let foot = cone.closest(query, None, &options, &mut Workspace::default(), None);
        assert_eq!(foot, cone.closest(query, None, &options, &mut used, None));
        let apart = |i: i32, j: i32| {
            let s =
                cone.surface().evaluate(4.0 * f64::from(i) / 200.0, f64::from(j) / 200.0 * size);
            (0..3).map(|c| (s[c] - query[c]).powi(2)).sum::<f64>().sqrt()
        };
        let nearest = (0..200).flat_map(|i| (0..=200).map(move |j| apart(i, j)));
        assert!(foot.distance <= nearest.fold(f64::INFINITY, f64::min) + 1e-10, "{k}: {foot:?}");
    }
}
