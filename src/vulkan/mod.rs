//! The Vulkan layer: devices, memory, images, buffers, shaders and their reflection, render passes, pipelines,
//! queries, command buffers, queues.
//!
//! Every object is a handle and the info it was made from, carries a name (the one errors, the debugger and
//! the validation layer show), and frees itself. What a recording uses is kept alive until its last
//! submission has ended, so dropping an object early is safe. `unsafe` stays in this folder. A misuse that is
//! found while recording is reported by [`Commands::finish`].

mod buffer;
mod commands;
mod descriptor;
mod device;
mod diagnosis;
mod failure;
mod features;
mod format;
mod image;
mod info;
mod instance;
mod layout;
mod marks;
mod messages;
mod owned;
mod pick;
mod pipeline;
mod query;
mod queue;
mod recorded;
mod reflect;
mod render_pass;
mod shader;
mod stages;
mod submission;
mod submit;
mod suppressed;
mod texel_buffer;
mod transfer;
mod version;
mod watch;

pub use ash::vk;

pub use crate::math::blend::Blend;
pub use buffer::{Buffer, BufferInfo, Place};
pub use commands::Commands;
pub use descriptor::{Bound, DescriptorSet};
pub use device::Device;
pub use features::DeviceUse;
pub use format::{aspect, has_stencil, texel_bytes};
pub use image::{Image, ImageInfo, ImageShape, Sampler};
pub use info::{DeviceInfo, DeviceKind, QueueFamily};
pub use instance::Instance;
pub use layout::Layout;
pub use pick::pick;
pub use pipeline::{ComputePipeline, DepthState, GraphicsPipeline, GraphicsPipelineInfo};
pub use query::{QueryKind, QueryPool};
pub use queue::Queue;
pub use recorded::Recorded;
pub use reflect::Binding;
pub use render_pass::{Attachment, Dependency, Framebuffer, RenderPass, RenderPassInfo, Role, Scope};
pub use shader::ShaderModule;
pub use submission::Submission;
pub use suppressed::SUPPRESSED;
pub use texel_buffer::TexelBuffer;
pub use transfer::CopyRegion;
pub use watch::{Watch, exit_at_once, gave_up};
