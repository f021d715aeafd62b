//! What a probe found, for a terminal, for a reader, and beside what another one found. Its record is
//! [`Probe`](crate::probe::Probe).

mod compare;
mod page;
mod text;

pub use compare::compare;
pub use page::{page, section};
pub use text::{summary, text};
