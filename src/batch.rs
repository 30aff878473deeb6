//! Stub of the agreed interface: one thread.
#![allow(missing_docs, clippy::missing_errors_doc)]
use crate::closest::{FootPoint, Workspace};
use crate::error::Error;

pub fn run(
    out: &mut [FootPoint],
    _threads: usize,
    work: &(dyn Fn(usize, &mut Workspace) -> FootPoint + Sync),
    poll: &mut dyn FnMut(usize) -> bool,
) -> Result<(), Error> {
    let mut workspace = Workspace;
    for i in 0..out.len() {
        if poll(i) {
            out[i..].fill(FootPoint::unreached());
            return Err(Error::Cancelled);
        }
        out[i] = work(i, &mut workspace);
    }
    Ok(())
}
