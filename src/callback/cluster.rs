//! Boxes that touch form a cluster: what subdivision leaves around one place, or along one arc.
//!
//! Limit: boxes on the two sides of a seam do not touch.

use super::cell::meet;

/// A group of boxes.
#[derive(Clone, Debug)]
pub struct Cluster {
    /// Which boxes.
    pub members: Vec<usize>,
    /// The least box that holds them.
    pub hull: [f64; 4],
}

/// Groups boxes that touch, directly or through others. Groups and their members are in the order of the boxes.
pub fn clusters(boxes: &[[f64; 4]]) -> Vec<Cluster> {
    let along = longer_direction(boxes);
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|&a, &b| boxes[a][2 * along].total_cmp(&boxes[b][2 * along]).then(a.cmp(&b)));
    let mut parent: Vec<usize> = (0..boxes.len()).collect();
    let mut open: Vec<usize> = Vec::new();
    for &i in &order {
        let a = boxes[i];
        open.retain(|&j| boxes[j][2 * along + 1] >= a[2 * along]);
        for &j in &open {
            let b = boxes[j];
            if meet([a[0], a[1]], [b[0], b[1]]) && meet([a[2], a[3]], [b[2], b[3]]) {
                let (x, y) = (root(&mut parent, i), root(&mut parent, j));
                parent[x.max(y)] = x.min(y);
            }
        }
        open.push(i);
    }
    let mut place = vec![usize::MAX; boxes.len()];
    let mut found: Vec<Cluster> = Vec::new();
    for i in 0..boxes.len() {
        let top = root(&mut parent, i);
        if place[top] == usize::MAX {
            place[top] = found.len();
            found.push(Cluster { members: Vec::new(), hull: boxes[i] });
        }
        let cluster = &mut found[place[top]];
        cluster.members.push(i);
        cluster.hull = hull(cluster.hull, boxes[i]);
    }
    found
}

/// The least box that holds both.
pub fn hull(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [a[0].min(b[0]), a[1].max(b[1]), a[2].min(b[2]), a[3].max(b[3])]
}

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

/// The direction in which the boxes lie farther apart, in their own widths: sweeping along it keeps few of them open.
fn longer_direction(boxes: &[[f64; 4]]) -> usize {
    let Some(all) = boxes.iter().copied().reduce(hull) else { return 0 };
    let steps = |k: usize| {
        let sum: f64 = boxes.iter().map(|b| b[2 * k + 1] - b[2 * k]).sum();
        if sum > 0.0 { (all[2 * k + 1] - all[2 * k]) / sum } else { 0.0 }
    };
    usize::from(steps(1) > steps(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_that_touch_are_one_cluster() {
        let boxes = [
            [0.0, 1.0, 0.0, 1.0],
            [5.0, 6.0, 0.0, 1.0],
            [2.0, 3.0, 1.0, 2.0],
            [1.0, 2.0, 1.0, 1.5],
            [6.0, 7.0, 1.0, 2.0],
            [0.0, 1.0, 8.0, 9.0],
        ];
        let found = clusters(&boxes);
        assert_eq!(found.len(), 3);
        assert_eq!(found[0].members, [0, 2, 3]);
        assert_eq!(found[0].hull, [0.0, 3.0, 0.0, 2.0]);
        assert_eq!(found[1].hull, [5.0, 7.0, 0.0, 2.0]);
        assert_eq!(found[2].members, [5]);
        assert!(clusters(&[]).is_empty());
    }
}
