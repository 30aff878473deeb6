//! What cannot be answered, and why.

/// A request that cannot be answered. The text names the parameter and the index.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// A value that the documentation excludes, for example "poles: pole 17 is not finite".
    InvalidArgument(String),
    /// A request that this version cannot answer.
    Unsupported(String),
    /// Memory that could not be had.
    OutOfMemory,
    /// `should_stop` said so.
    Cancelled,
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::InvalidArgument(text) | Self::Unsupported(text) => f.write_str(text),
            Self::OutOfMemory => f.write_str("out of memory"),
            Self::Cancelled => f.write_str("cancelled by should_stop"),
        }
    }
}

impl std::error::Error for Error {}
