//! Records, pictures, statistics: what is measured, and how it is kept.

mod pictures;
mod records;
mod runs;
