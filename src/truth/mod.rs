//! What pictures are held against: the exact integral along a ray, which shares no sampling with the renderers and their
//! twins, and what is made with it: tables of pre-integrated classification and of ways through cells, and the importance volume.

pub mod cell_table;
pub mod exact;
pub mod importance;
pub mod known;
pub mod preintegrated;
