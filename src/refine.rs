//! Stub of the agreed interface.
#![allow(missing_docs)]

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    #[default]
    Auto,
    Maf,
    Newton,
    Osculating,
}
