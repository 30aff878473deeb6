//! Symmetric positive definite equations with few entries a row: energies and normal equations of splines.
//!
//! ```text
//!   Symmetric   lower triangle, column by column        which entries there are: groups of unknowns that meet
//!   Solver      order of elimination and fill (faer)    once for a pattern
//!               Cholesky's factor, solutions            for each matrix of that pattern
//! ```
//!
//! The order (approximate minimum degree), the elimination tree and the columns that are eliminated together come from the crate `faer`. Its own
//! arithmetic is not used: it picks fused and wider instructions, and blocks as large as the caches, by the machine, so that bits would depend on
//! it, and asks for memory inside products in a way that ends the process. `factor` does these columns in one order, with `+ - * / sqrt` alone.
//!
//! Memory is asked for by the counts of the symbolic factor, before anything is computed.
//!
//! References: Davis, *Direct Methods for Sparse Linear Systems*, 2006; Amestoy, Davis, Duff, *An approximate minimum degree ordering
//! algorithm*, 1996; Ng, Peyton, *Block sparse Cholesky algorithms on advanced uniprocessor computers*, 1993.

mod symmetric;

mod factor;

mod solver;

pub(crate) use solver::Solver;
pub(crate) use symmetric::{Groups, Symmetric};
