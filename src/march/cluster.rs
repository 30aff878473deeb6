//! Boxes that were not divided further, gathered, and what is in each group.

use super::contact::{foot, settle};
use super::join::Place;
use super::search::{Open, OpenPair, Search};
use super::watch::Watch;
use crate::bounds::{add, norm, scaled, sub};

/// Boxes beyond this are not gathered: they are all listed.
const MOST_BOXES: usize = 6_000;

/// A group of boxes that touch.
pub struct Cluster {
    /// Box of all, u, v, s, t.
    pub low: [f64; 4],
    /// The other end.
    pub high: [f64; 4],
    /// Whether it has boxes in which the surfaces coincide, touch along a curve, are flat, or were not reached.
    pub has: [bool; 4],
    /// What it holds is not larger than about this, a length.
    pub size: f64,
}

impl Cluster {
    /// Whether a place is in its box.
    pub fn holds(&self, at: [f64; 4]) -> bool {
        (0..4).all(|q| self.low[q] <= at[q] && at[q] <= self.high[q])
    }
}

/// What is found in a small cluster.
pub struct Seen {
    /// The place.
    pub place: Place,
    /// Distance between the surfaces.
    pub gap: f64,
    /// Relative curvatures with the same sign (+1), different ones (-1), or not both (0).
    pub sign: i8,
}

fn touch(a: &OpenPair, b: &OpenPair) -> bool {
    (0..4).all(|q| {
        let slack = 0.75 * (a.high[q] - a.low[q]).max(b.high[q] - b.low[q]);
        a.low[q] <= b.high[q] + slack && b.low[q] <= a.high[q] + slack
    })
}

/// Groups of boxes that touch one another; `None` when there are too many, or the watch says stop.
pub fn clusters(search: &Search, watch: &Watch) -> Option<Vec<Cluster>> {
    let open = &search.open;
    if open.len() > MOST_BOXES {
        return None;
    }
    let mut group: Vec<usize> = (0..open.len()).collect();
    fn root(group: &mut [usize], mut k: usize) -> usize {
        while group[k] != k {
            group[k] = group[group[k]];
            k = group[k];
        }
        k
    }
    for i in 0..open.len() {
        if watch.stops(open.len() - i) {
            return None;
        }
        for j in 0..i {
            if touch(&open[i], &open[j]) {
                let (a, b) = (root(&mut group, i), root(&mut group, j));
                group[a.max(b)] = a.min(b);
            }
        }
    }
    let mut place = vec![usize::MAX; open.len()];
    let mut found: Vec<Cluster> = Vec::new();
    for k in 0..open.len() {
        let r = root(&mut group, k);
        if place[r] == usize::MAX {
            place[r] = found.len();
            found.push(Cluster {
                low: open[k].low,
                high: open[k].high,
                has: [false; 4],
                size: 0.0,
            });
        }
        let cluster = &mut found[place[r]];
        for q in 0..4 {
            cluster.low[q] = cluster.low[q].min(open[k].low[q]);
            cluster.high[q] = cluster.high[q].max(open[k].high[q]);
        }
        cluster.has[match open[k].why {
            Open::Area => 0,
            Open::Curve => 1,
            Open::Flat => 2,
            Open::Left => 3,
        }] = true;
        cluster.size = cluster.size.max(open[k].size);
    }
    for cluster in &mut found {
        let (low, high) = (cluster.low, cluster.high);
        let extent = |k: usize| {
            let at = |q: usize, high_end: bool| if high_end { high[q] } else { low[q] };
            let corner = |n: usize| {
                search.surfaces[k].evaluate(at(2 * k, n & 1 > 0), at(2 * k + 1, n & 2 > 0))
            };
            (0..4)
                .flat_map(|i| (0..i).map(move |j| (i, j)))
                .fold(0.0f64, |m, (i, j)| m.max(norm(sub(corner(i), corner(j)))))
        };
        cluster.size = cluster.size.max(extent(0).min(extent(1)));
    }
    Some(found)
}

/// The place of least gap in a small cluster, when the surfaces meet there but for rounding.
pub fn see(search: &Search, cluster: &Cluster) -> Option<Seen> {
    let [a, b] = search.surfaces;
    let middle = [0, 1, 2, 3].map(|q| 0.5 * (cluster.low[q] + cluster.high[q]));
    let floor = search.touching_gap(4.0);
    let place = |at: [f64; 4]| {
        let (x, y) = (a.evaluate(at[0], at[1]), b.evaluate(at[2], at[3]));
        (Place { x: scaled(add(x, y), 0.5), at }, norm(sub(x, y)))
    };
    if let Some(touch) = settle(a, b, middle, 4.0 * cluster.size.max(floor)) {
        let (place, gap) = place(touch.at);
        if gap <= floor {
            let sign = if touch.rank() < 2 {
                0
            } else {
                (touch.curvature[0] * touch.curvature[1]).signum() as i8
            };
            return Some(Seen { place, gap, sign });
        }
    }
    // No tangent plane, or no stationary gap: the corners and the middle, each with its foot on B and back on A.
    let mut best: Option<Seen> = None;
    for i in 0..3 {
        for j in 0..3 {
            let pick = |q: usize, n: usize| {
                cluster.low[q] + 0.5 * n as f64 * (cluster.high[q] - cluster.low[q])
            };
            let mut uv = [pick(0, i), pick(1, j)];
            let mut st = [middle[2], middle[3]];
            for _ in 0..4 {
                st = foot(b, st, a.evaluate(uv[0], uv[1]));
                uv = foot(a, uv, b.evaluate(st[0], st[1]));
            }
            let (place, gap) = place([uv[0], uv[1], st[0], st[1]]);
            if best.as_ref().is_none_or(|b| gap < b.gap) {
                best = Some(Seen { place, gap, sign: 0 });
            }
        }
    }
    best.filter(|seen| seen.gap <= floor)
}
