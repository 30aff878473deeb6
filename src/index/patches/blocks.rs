//! The numbers of the patches: all at once, or for a huge surface in blocks that a query makes when it first visits one.
//!
//! ```text
//!   up to 131,072 patches     nets, lanes, tensors of all of them, 1,024 patches a part
//!   more                      [made] [    ] [    ] [made] ...      16 patches a block
//! ```
//!
//! Boxes, spans and flags of every patch are there from the start, so that a walk meets the same patches in the same order
//! either way; a block holds the bits that the whole would. Blocks are never taken away. No thread waits for another one's
//! block: two that need the same one both make it, and one of the two is kept.

use std::sync::OnceLock;

use super::build::{Keep, Plan};
use crate::error::Error;
use crate::jet::Lane;

/// Patches from which on blocks are made on demand: all of them would take more than some 300 MB.
pub const HUGE: usize = 1 << 17;

/// Patches in a part, which one thread makes where all are made at once.
pub const PART: usize = 1 << 10;

/// Patches in a block.
const BLOCK: usize = 16;

/// Nets, lanes and tensors of patches that follow one another.
#[derive(Debug, Default, PartialEq)]
pub struct Numbers {
    /// Homogeneous poles, component by component.
    pub nets: Vec<f64>,
    /// The same, pole by pole.
    pub lanes: Vec<Lane>,
    /// Tensors A, -2 B, C; empty when they are not kept.
    pub tensors: Vec<f64>,
}

impl Numbers {
    /// Bytes held.
    pub fn memory(&self) -> usize {
        (self.nets.capacity() + self.tensors.capacity() + 4 * self.lanes.capacity()) * 8
    }
}

/// Where the numbers of the patches are.
#[derive(Debug)]
pub enum Store {
    /// All of them, part by part.
    Parts(Vec<Numbers>),
    /// Those that have been visited.
    Blocks(Box<Blocks>),
}

impl Store {
    /// The numbers that hold patch `k`, and its place among them.
    #[inline]
    pub fn of(&self, k: usize) -> (&Numbers, usize) {
        match self {
            Self::Parts(parts) => (&parts[k / PART], k % PART),
            Self::Blocks(blocks) => (blocks.block(k / BLOCK), k % BLOCK),
        }
    }

    /// Bytes held now.
    pub fn memory(&self) -> usize {
        match self {
            Self::Parts(parts) => {
                let heads = parts.capacity() * size_of::<Numbers>();
                heads + parts.iter().map(Numbers::memory).sum::<usize>()
            }
            Self::Blocks(blocks) => blocks.memory(),
        }
    }
}

/// Blocks that are made on demand.
#[derive(Debug)]
pub struct Blocks {
    plan: Plan,
    made: Vec<OnceLock<Box<Numbers>>>,
}

impl Blocks {
    /// None made yet.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new(plan: Plan) -> Result<Self, Error> {
        let mut made = crate::index::piece::reserved(plan.count().div_ceil(BLOCK))?;
        made.resize_with(plan.count().div_ceil(BLOCK), OnceLock::new);
        Ok(Self { plan, made })
    }

    #[inline]
    fn block(&self, at: usize) -> &Numbers {
        match self.made[at].get() {
            Some(numbers) => numbers,
            None => self.make(at),
        }
    }

    /// # Panics
    /// When there is no memory for the block: a query has no other way to say so. The C functions turn it into a status.
    #[cold]
    fn make(&self, at: usize) -> &Numbers {
        let range = at * BLOCK..((at + 1) * BLOCK).min(self.plan.count());
        let part = self.plan.part(range, Keep::Numbers, &mut || false);
        let mut part = part.expect("memory for 16 patches of the index");
        let numbers = Box::new(part.numbers.swap_remove(0));
        self.made[at].get_or_init(|| numbers)
    }

    fn memory(&self) -> usize {
        let blocks = self.made.iter().filter_map(OnceLock::get);
        let of_blocks: usize = blocks.map(|numbers| size_of::<Numbers>() + numbers.memory()).sum();
        of_blocks + self.made.capacity() * size_of::<OnceLock<Box<Numbers>>>() + self.plan.memory()
    }
}
