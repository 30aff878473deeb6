//! The walk over the members, nearest first, and what is done with each.

use super::contest::{Contest, Entry, direction, tree_limit};
use super::{Member, Scene, Shape};
use crate::bounds::{HALF_ULP, Vector, norm, sub};
use crate::closest::{
    FootPoint, QueryOptions, Scope, Within, Workspace, flag, is_bad, mark_inversion, tree_slack,
};
use crate::tree::Queue;

/// Where a query may begin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hint {
    /// The member that is searched first.
    pub member: u32,
    /// Parameters near the foot, on curves (u, anything); `None`: only the member is known.
    pub at: Option<[f64; 2]>,
}

/// A foot and whose it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneFoot {
    /// The record; `u` and `v` are the member's, `point` is where it stands.
    pub foot: FootPoint,
    /// The member's number, or [`super::NO_MEMBER`].
    pub member: u32,
}

/// A member that waits for its turn.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    /// Square of at most its distance.
    key: f64,
    member: u32,
    /// Whether a look at its cells would tell more.
    is_rough: bool,
}

/// Reusable memory of one thread. No query allocates once it has grown to the scene.
#[derive(Clone, Debug, Default)]
pub struct SceneWorkspace {
    queue: Queue,
    /// Members that wait for their turn, and their keys.
    ready: Vec<Waiting>,
    member: Workspace,
}

impl Scene {
    /// The nearest point of all members, with proof.
    ///
    /// Every member must be prepared, or its index is built by the first query that comes to it. A hint changes the
    /// time and, between ties, which foot is returned. The restriction in `options` is not looked at.
    /// In local scope only the hint's member is iterated on, without a hint one whose box is nearest.
    pub fn closest(
        &self,
        query: Vector,
        hint: Option<Hint>,
        options: &QueryOptions,
        workspace: &mut SceneWorkspace,
    ) -> SceneFoot {
        if is_bad(query) {
            return SceneFoot::without_member(FootPoint::bad_query());
        }
        let hint = hint.filter(|hint| (hint.member as usize) < self.members.len());
        let hint = hint
            .map(|hint| Hint { at: hint.at.filter(|at| at.iter().all(|x| x.is_finite())), ..hint });
        let mut found = match options.scope {
            Scope::Local => self.local(query, hint, options, workspace),
            Scope::Global => self.global(query, hint, options, workspace),
        };
        if hint.is_some() {
            found.foot.flags |= flag::HINT_USED;
        }
        found
    }

    /// As [`Self::closest`], for a query that should lie on a member: beyond the tolerance the foot is marked.
    pub fn invert(
        &self,
        query: Vector,
        hint: Option<Hint>,
        options: &QueryOptions,
        workspace: &mut SceneWorkspace,
    ) -> SceneFoot {
        let mut found = self.closest(query, hint, options, workspace);
        if found.foot.distance.is_finite() {
            let default = 1e-7 * self.frame.diagonal;
            let tolerance = if options.tolerance > 0.0 { options.tolerance } else { default };
            mark_inversion(&mut found.foot, tolerance);
        }
        found
    }

    fn local(
        &self,
        query: Vector,
        hint: Option<Hint>,
        options: &QueryOptions,
        workspace: &mut SceneWorkspace,
    ) -> SceneFoot {
        let number = hint.map_or_else(|| self.nearest_box(query, workspace), |hint| hint.member);
        let Member { shape, placement } = &self.members[number as usize];
        let options = QueryOptions { domain: None, ..*options };
        let entered = placement.enter(query);
        let at = hint.and_then(|hint| hint.at);
        let foot = shape.local(entered, at, &options, &mut workspace.member);
        let point = placement.place(foot.point);
        SceneFoot {
            foot: FootPoint { point, distance: norm(sub(query, point)), ..foot },
            member: number,
        }
    }

    /// A member whose box is nearest.
    fn nearest_box(&self, query: Vector, workspace: &mut SceneWorkspace) -> u32 {
        let leaf = nearest_leaf(&self.tree, self.frame.enter(query), &mut workspace.queue);
        self.order[leaf.map_or(0, |(_, leaf)| leaf)]
    }

    fn global(
        &self,
        query: Vector,
        hint: Option<Hint>,
        options: &QueryOptions,
        workspace: &mut SceneWorkspace,
    ) -> SceneFoot {
        let default = 1e-10 * self.frame.diagonal;
        let accuracy = if options.accuracy > 0.0 { options.accuracy } else { default };
        let options = QueryOptions { accuracy, domain: None, ..*options };
        let contest = Contest::new(accuracy);
        let mut search = Search { scene: self, query, options: &options, contest, workspace };
        if let Some(hint) = hint {
            search.ask(hint.member, hint.at);
        }
        search.walk(hint.map(|hint| hint.member));
        if search.contest.best().is_none() {
            // Squares overflow in the frame of the scene: any foot will do, but each has a bound.
            (0..self.members.len() as u32).for_each(|member| search.ask(member, None));
        }
        let outcome = search.contest.outcome();
        outcome.unwrap_or_else(|| SceneFoot::without_member(FootPoint::unreached()))
    }
}

/// One global search.
struct Search<'a> {
    scene: &'a Scene,
    query: Vector,
    options: &'a QueryOptions,
    contest: Contest,
    workspace: &'a mut SceneWorkspace,
}

impl Search<'_> {
    /// Asks every member that may hold the foot or a tie, but `asked`, who was first.
    ///
    /// Members wait for their turn with the distance of the nearest box around a part of them, not of their own: where those
    /// overlap that tells which of them to ask first, and which not at all.
    fn walk(&mut self, asked: Option<u32>) {
        let (scene, scale) = (self.scene, self.scene.frame.scale);
        let place = scene.frame.enter(self.query);
        let slack = tree_slack(place);
        scene.tree.start(&mut self.workspace.queue);
        self.workspace.ready.clear();
        loop {
            let limit = tree_limit(self.contest.reach() * scale, slack);
            let in_tree = self.workspace.queue.nearest().unwrap_or(f64::INFINITY);
            if let Some(k) =
                self.nearest_ready().filter(|&k| self.workspace.ready[k].key <= in_tree)
            {
                let Waiting { key, member, is_rough } = self.workspace.ready.swap_remove(k);
                if key > limit {
                    return;
                }
                if is_rough {
                    let key = self.key(member).max(key);
                    self.workspace.ready.push(Waiting { key, member, is_rough: false });
                } else {
                    self.ask(member, None);
                }
                continue;
            }
            let Some(next) = self.workspace.queue.pop().filter(|next| next.key <= limit) else {
                return;
            };
            let Some(leaf) = next.piece() else {
                scene.tree.open(next, place, limit, &mut self.workspace.queue);
                continue;
            };
            let member = scene.order[leaf];
            if asked == Some(member) {
                continue;
            }
            let key = self.rough_key(member).max(next.key);
            if key <= limit {
                self.workspace.ready.push(Waiting { key, member, is_rough: true });
            }
        }
    }

    /// The place in the list of the member with the least key, by number among equals.
    fn nearest_ready(&self) -> Option<usize> {
        let ready = &self.workspace.ready;
        let rank = |k: usize| (ready[k].key, ready[k].member);
        (0..ready.len()).reduce(|a, b| if rank(b) < rank(a) { b } else { a })
    }

    /// The square of at most the distance to a member, in the frame of the scene: of boxes around its parts.
    fn key(&mut self, member: u32) -> f64 {
        let (place, Member { shape, .. }) =
            (self.place(member), &self.scene.members[member as usize]);
        let bound = shape.cells_distance(place, false).or_else(|| {
            let (key, _) = nearest_leaf(shape.tree()?.0, place, self.workspace.member.queue())?;
            Some(key.sqrt() * (1.0 - 8.0 * HALF_ULP) - tree_slack(place))
        });
        self.square(member, bound)
    }

    /// As [`Self::key`], of few boxes.
    fn rough_key(&self, member: u32) -> f64 {
        let bound =
            self.scene.members[member as usize].shape.cells_distance(self.place(member), true);
        self.square(member, bound)
    }

    /// The query in the frame of a member's index.
    fn place(&self, member: u32) -> Vector {
        let Member { shape, placement } = &self.scene.members[member as usize];
        let place = placement.enter(self.query);
        shape.tree().map_or(place, |(_, frame)| frame.enter(place))
    }

    /// The square of a distance that a member's index bounds, in the frame of the scene.
    fn square(&self, member: u32, bound: Option<f64>) -> f64 {
        let Member { shape, placement } = &self.scene.members[member as usize];
        let (Some(bound), Some((_, frame))) = (bound, shape.tree()) else { return 0.0 };
        let bound = placement.bound(bound / frame.scale, placement.offset(self.query)).max(0.0);
        let bound = bound * self.scene.frame.scale;
        bound * bound * (1.0 - 8.0 * HALF_ULP)
    }

    /// Searches a member within the best distance so far.
    fn ask(&mut self, number: u32, at: Option<[f64; 2]>) {
        let Member { shape, placement } = &self.scene.members[number as usize];
        let entered = placement.enter(self.query);
        let offset = placement.offset(self.query);
        let within = self.contest.best().map(|best| Within {
            distance: best.foot.distance + offset,
            direction: direction(placement.turn_back(best.d)),
        });
        let at = at.map(|at| moved(at, shape));
        let found =
            shape.closest_within(entered, at, within, self.options, &mut self.workspace.member);
        let mut foot = found.foot;
        foot.point = placement.place(foot.point);
        let d = sub(foot.point, self.query);
        foot.distance = norm(sub(self.query, foot.point));
        let bound = placement.bound(foot.lower_bound, offset);
        let entry = Entry { member: number, foot, d, window: found.window };
        self.contest.take(entry, bound, found.allowed);
    }
}

/// A hint moved to the domain.
fn moved(at: [f64; 2], shape: &Shape) -> [f64; 2] {
    let [u0, u1, v0, v1] = shape.domain();
    [at[0].clamp(u0, u1), at[1].clamp(v0, v1)]
}

/// The nearest leaf of a tree, and its key.
fn nearest_leaf(
    tree: &crate::tree::Tree,
    place: Vector,
    queue: &mut Queue,
) -> Option<(f64, usize)> {
    tree.start(queue);
    while let Some(next) = queue.pop() {
        match next.piece() {
            Some(leaf) => return Some((next.key, leaf)),
            None => tree.open(next, place, f64::INFINITY, queue),
        }
    }
    None
}
