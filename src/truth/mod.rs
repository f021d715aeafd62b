//! What pictures are held against: the exact integral along a ray, which shares no sampling with the renderers and their
//! twins, and the table of pre-integrated classification that is made with it.

pub mod cell_table;
pub mod exact;
pub mod preintegrated;
