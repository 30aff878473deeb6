//! Random difficult shapes and queries against an independent search and a verdict in doubled precision.
//!
//! ```text
//!   seed, case -> family's design -> library's shape ----------> answers ---.
//!                       '-> own Bezier pieces -> samples, descents ---------+-> suspect, or one of a hundred?
//!                       '-> de Boor, Newton in doubled precision <----------'   verdict -> tallies, table
//! ```
//!
//! Limit: the search may miss a narrow valley; then nothing is said. What it says is never wrong.

#![allow(dead_code, reason = "each program uses its own part")]

pub mod asks;
pub mod curves;
pub mod design;
pub mod double;
pub mod exact;
pub mod families;
pub mod judge;
pub mod outcome;
pub mod pieces;
pub mod run;
pub mod search;
pub mod sets;
pub mod sheets;
pub mod turned;

#[path = "../../tests/shapes/mod.rs"]
pub mod shapes;
