//! Boxes around groups of cells, and what they ask of the bounds of a cell far away.

use super::MARGIN;
use super::oriented::Oriented;
use crate::bounds::{Vector, dot, norm, sub};
use crate::error::Error;
use crate::index::piece::reserved;

/// Boxes around groups of cells, in rows and columns.
#[derive(Debug)]
struct Layer {
    size: [usize; 2],
    boxes: Vec<Oriented>,
}

impl Layer {
    /// Groups of two by two of `fine`.
    fn over(fine: &Self) -> Result<Self, Error> {
        let size = fine.size.map(|n| n.div_ceil(2));
        let mut boxes = reserved(size[0] * size[1])?;
        for k in 0..size[0] * size[1] {
            let (i, j) = (k / size[1] * 2, k % size[1] * 2);
            let mut group = fine.boxes[i * fine.size[1] + j];
            for a in i..(i + 2).min(fine.size[0]) {
                for b in j..(j + 2).min(fine.size[1]) {
                    group = group.joined(&fine.boxes[a * fine.size[1] + b]);
                }
            }
            boxes.push(group);
        }
        Ok(Self { size, boxes })
    }
}

/// Groups of cells in rows and columns, from single ones to all of them.
#[derive(Debug)]
pub struct Groups {
    layers: Vec<Layer>,
}

impl Groups {
    /// Over boxes in `size` rows and columns.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new(size: [usize; 2], boxes: Vec<Oriented>) -> Result<Self, Error> {
        let mut layers = vec![Layer { size, boxes }];
        while layers[layers.len() - 1].boxes.len() > 1 {
            layers.push(Layer::over(&layers[layers.len() - 1])?);
        }
        Ok(Self { layers })
    }

    /// As many boxes around everything as there are at most so many.
    pub fn few(&self, most: usize) -> &[Oriented] {
        let layer = self.layers.iter().find(|layer| layer.boxes.len() <= most);
        layer.map_or(&[], |layer| &layer.boxes)
    }

    /// Raises the bounds of the cell in box `from`, two for each of its views, to what all cells ask but those of the groups
    /// (first and last row, first and last column) that are `covered` already.
    pub fn far(
        &self,
        from: &Oriented,
        views: &[View],
        covered: impl Fn([usize; 2], [usize; 2]) -> bool,
        bends: &mut [f64],
    ) {
        let size = self.layers[0].size;
        let mut waiting = [(0usize, 0usize, 0usize); 4 * usize::BITS as usize];
        waiting[0] = (self.layers.len() - 1, 0, 0);
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (layer, i, j) = waiting[count];
            let ends =
                |k: usize, at: usize| [at << layer, (((at + 1) << layer) - 1).min(size[k] - 1)];
            if covered(ends(0, i), ends(1, j)) {
                continue;
            }
            let other = &self.layers[layer].boxes[i * self.layers[layer].size[1] + j];
            let least = bends.iter().fold(f64::INFINITY, |least, x| x.min(least));
            let mut more = false;
            let seen = from.seen(other, least);
            for (view, bends) in views.iter().zip(bends.chunks_exact_mut(2)) {
                for (bend, ask) in bends.iter_mut().zip(view.asked(other, seen)) {
                    more |= ask > *bend;
                    if layer == 0 {
                        *bend = bend.max(ask);
                    }
                }
            }
            if layer == 0 && bends.iter().all(|x| *x == f64::INFINITY) {
                return;
            }
            if layer == 0 || !more {
                continue;
            }
            // The nearest part comes first: what it asks for makes most of the others no matter.
            let fine = &self.layers[layer - 1];
            let first = count;
            for a in 2 * i..(2 * i + 2).min(fine.size[0]) {
                for b in 2 * j..(2 * j + 2).min(fine.size[1]) {
                    waiting[count] = (layer - 1, a, b);
                    count += 1;
                }
            }
            let apart = |&(_, a, b): &(usize, usize, usize)| {
                let move_ = sub(fine.boxes[a * fine.size[1] + b].center, from.center);
                dot(move_, move_)
            };
            waiting[first..count].sort_unstable_by(|x, y| apart(y).total_cmp(&apart(x)));
        }
    }
}

/// A direction of a cell, seen from what is elsewhere.
pub struct View {
    /// Unit vector, and how far the direction of a place may be from it.
    pub axis: Vector,
    pub cone: f64,
    /// How far the places may lie below the middle of the box, along the axis.
    pub depth: f64,
}

/// A box as it is seen from another one.
#[derive(Clone, Copy)]
pub enum Seen {
    /// So far off that it is not looked at any closer: what it asks for in any direction.
    Off(f64),
    /// The move from middle to middle, and the distance.
    At(Vector, f64),
}

impl Oriented {
    /// How another box is seen from here; not looked at any closer when it asks for `least` at most.
    pub fn seen(&self, other: &Self, least: f64) -> Seen {
        let move_ = sub(other.center, self.center);
        let apart = (norm(move_) - self.radius - other.radius) / MARGIN;
        if apart * least >= 1.0 {
            return Seen::Off(1.0 / apart);
        }
        Seen::At(move_, self.distance(other).max(apart))
    }
}

impl View {
    /// What is in a box asks of the bounds of a cell, for the axis and the opposite one: the greatest `N.e / |e|^2` for `|e|` at
    /// least the distance d, and normals N within the cone of A: `A.e / d^2 + |N - A| / d`, and 1 / d.
    pub fn asked(&self, other: &Oriented, seen: Seen) -> [f64; 2] {
        let (move_, distance) = match seen {
            Seen::Off(ask) => return [ask; 2],
            Seen::At(move_, distance) => (move_, distance),
        };
        if distance.is_nan() || distance <= 0.0 {
            return [f64::INFINITY; 2];
        }
        let height = dot(move_, self.axis);
        let reach = (other.reach(self.axis) + 1e-12) * MARGIN + self.depth;
        let near = 1.0 / distance;
        [height, -height].map(|height| {
            let rise = (height + reach).max(0.0);
            (near * (rise * near + self.cone)).min(near) * MARGIN
        })
    }
}
