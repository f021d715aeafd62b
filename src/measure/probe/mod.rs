//! What a probe found, for a terminal, for a reader, and beside what another one found.

mod compare;
mod page;
mod text;

pub use compare::compare;
pub use page::{page, section};
pub use text::{summary, text};
