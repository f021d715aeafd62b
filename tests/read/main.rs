//! Readers of volumes and meshes: what is written comes back, what is wrong is refused by name, and what is doubtful is told.

mod cases;
mod cell_samples;
mod components;
mod ends;
mod files;
mod frames;
mod header;
mod kit;
mod mesh_details;
mod mesh_samples;
mod meshes;
mod messages;
mod orientation;
mod packed;
mod picture;
mod raw;
mod refused;
mod scene_choice;
mod spacing;
mod tetrahedra;
mod text;
mod types;
