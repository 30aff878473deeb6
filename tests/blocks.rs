//! An index made in blocks, as huge surfaces have it, answers with the bits of one made as a whole.

#[path = "cases/mod.rs"]
#[allow(dead_code, reason = "surfaces and queries only, without their proven distances")]
mod cases;

use cases::Shape;
use footpoint::closest::{FootPoint, QueryOptions, Workspace};
use footpoint::index::IndexedSurface;

fn bits(foot: &FootPoint) -> ([u64; 7], [u32; 2]) {
    let [x, y, z] = foot.point;
    let numbers = [foot.u, foot.v, x, y, z, foot.distance, foot.lower_bound];
    (numbers.map(f64::to_bits), [foot.flags, foot.iterations])
}

#[test]
fn blocks_answer_with_the_bits_of_the_whole() {
    let mut surfaces = 0;
    for folder in cases::folders() {
        let case = cases::read(&folder);
        let Shape::Surface(whole) = &case.shape else { continue };
        let blocks = IndexedSurface::in_blocks(whole.surface().clone());
        let (options, mut workspace) = (QueryOptions::default(), Workspace::default());
        for row in case.rows.iter().step_by(case.rows.len().div_ceil(25)) {
            let ask = |surface: &IndexedSurface, workspace: &mut Workspace| {
                surface.closest(row.query, None, &options, workspace, None)
            };
            let expected = bits(&ask(whole, &mut workspace));
            assert_eq!(bits(&ask(&blocks, &mut workspace)), expected, "{}", case.name);
        }
        surfaces += 1;
    }
    assert!(surfaces >= 3);
}

#[test]
fn threads_that_meet_in_a_block_get_the_same_bits() {
    let case = cases::folders().iter().map(|folder| cases::read(folder)).find(|case| {
        let Shape::Surface(surface) = &case.shape else { return false };
        surface.surface().knots_u().spans().count() * surface.surface().knots_v().spans().count()
            > 4
    });
    let case = case.expect("a surface of several patches");
    let Shape::Surface(whole) = &case.shape else { unreachable!("a surface") };
    let blocks = IndexedSurface::in_blocks(whole.surface().clone());
    let options = QueryOptions::default();
    let answers = |surface: &IndexedSurface| -> Vec<_> {
        let mut workspace = Workspace::default();
        let rows = case.rows.iter().take(200);
        rows.map(|row| bits(&surface.closest(row.query, None, &options, &mut workspace, None)))
            .collect()
    };
    let expected = answers(whole);
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(|| answers(&blocks))).collect();
        for thread in threads {
            assert_eq!(thread.join().expect("a thread"), expected);
        }
    });
}
