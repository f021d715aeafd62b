//! Depthleap: a raw Vulkan volume renderer and bench for depth-bounds culling.
//!
//! A frame is data. Read in this order:
//!
//! 1. [`scene`]: what is to be seen: volume, transfer function, camera, sampling, method. Knows no Vulkan.
//! 2. [`plan`]: scene to a flat list of steps anyone can print, with what was left out and why.
//! 3. [`method`], [`feature`] and [`projection`]: what each renderer is, what a frame may have, and how samples become a
//!    pixel, as rows; [`pass`]: each pass said once: its GLSL, what it reads and draws into, its f64 twin in [`twin`];
//!    [`mod@resource`] and [`geometry`]: what passes read, draw into and cover pixels with; [`part`]: the types of all of
//!    these.
//!    [`auto`] chooses a method for a scene that names none.
//! 4. [`frame`]: runs the list, on a device or in f64 through the twins.
//! 5. [`measure`]: counts, times and errors of frames, one record a run.
//! 6. [`report`]: records to tables, claims, pages and plots.
//! 7. [`experiment`]: what is asked of the methods and of a device; [`cli`] takes the arguments.
//!
//! Beside it [`mod@probe`] asks a driver what it culls before shading, without a volume.
//!
//! Imports point one way: `error, math <- scene <- projection <- read, structure, truth <- twin, shared`;
//! `error <- provenance`; `error, cache <- glsl`; `error, math <- vulkan <- probe`; all of these `<- part <- resource <- geometry,
//! feature <- pass <- method <- plan <- auto, frame <- measure <- report
//! <- experiment <- cli`.

pub mod auto;
pub mod cache;
pub mod cli;
pub mod error;
pub mod experiment;
pub mod feature;
pub mod frame;
pub mod geometry;
pub mod glsl;
pub mod math;
pub mod measure;
pub mod method;
pub mod part;
pub mod pass;
pub mod plan;
pub mod probe;
pub mod projection;
pub mod provenance;
pub mod read;

pub mod report;
pub mod resource;
pub mod scene;
pub mod shared;
pub mod structure;
pub mod truth;
pub mod twin;
pub mod vulkan;

pub use error::{Error, Result};
