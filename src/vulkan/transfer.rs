//! Recording: barriers, ownership of queue families, copies.

use ash::vk;

use super::buffer::Buffer;
use super::commands::Commands;
use super::format::{aspect, has_stencil, texel_bytes};
use super::image::{Image, ImageShape, whole};
use super::queue::Queue;
use super::render_pass::Scope;

/// A part of an image and where its texels stand in a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CopyRegion {
    /// Bytes.
    pub buffer_offset: u64,
    /// Texels.
    pub image_offset: [u32; 3],
    /// Texels.
    pub extent: [u32; 3],
    /// Texels from one row to the next in the buffer; 0 where they are tightly packed.
    pub row: u32,
}

impl CopyRegion {
    /// All of the image, at the start of the buffer.
    pub fn whole(image: &Image) -> Self {
        Self { buffer_offset: 0, image_offset: [0; 3], extent: image.info.extent, row: 0 }
    }
}

/// The other side of a transfer between queue families is any command: it waits for a semaphore.
const SEMAPHORE: Scope = Scope::new(vk::PipelineStageFlags2::ALL_COMMANDS, vk::AccessFlags2::NONE);

/// From one family to another; the same one twice is no transfer.
type Families = (u32, u32);
const SAME: Families = (vk::QUEUE_FAMILY_IGNORED, vk::QUEUE_FAMILY_IGNORED);

impl Commands {
    /// Orders what `target` does after what `source` did, and brings the image from one layout to the other.
    pub fn image_barrier(
        &mut self,
        image: &Image,
        source: Scope,
        target: Scope,
        before: vk::ImageLayout,
        after: vk::ImageLayout,
    ) {
        self.record_image_barrier(image, source, target, (before, after), SAME);
    }

    /// Gives the image to the family of `to`, which acquires it with the same layouts after a semaphore. Within
    /// one family the layout changes here.
    pub fn image_release(
        &mut self,
        image: &Image,
        source: Scope,
        before: vk::ImageLayout,
        after: vk::ImageLayout,
        to: &Queue,
    ) {
        let families = image_families(image, self.family, to.family);
        self.record_image_barrier(image, source, SEMAPHORE, (before, after), families);
    }

    /// Takes the image that the family of `from` released with the same layouts.
    pub fn image_acquire(
        &mut self,
        image: &Image,
        target: Scope,
        before: vk::ImageLayout,
        after: vk::ImageLayout,
        from: &Queue,
    ) {
        let families = image_families(image, from.family, self.family);
        let before = if families == SAME { after } else { before };
        self.record_image_barrier(image, SEMAPHORE, target, (before, after), families);
    }

    fn record_image_barrier(
        &mut self,
        image: &Image,
        source: Scope,
        target: Scope,
        layouts: (vk::ImageLayout, vk::ImageLayout),
        families: Families,
    ) {
        self.keep(&image.inner);
        let mut aspects = aspect(image.info.format);
        if has_stencil(image.info.format) {
            aspects |= vk::ImageAspectFlags::STENCIL;
        }
        let barrier = [vk::ImageMemoryBarrier2::default()
            .src_stage_mask(source.stages)
            .src_access_mask(source.access)
            .dst_stage_mask(target.stages)
            .dst_access_mask(target.access)
            .old_layout(layouts.0)
            .new_layout(layouts.1)
            .src_queue_family_index(families.0)
            .dst_queue_family_index(families.1)
            .image(image.handle())
            .subresource_range(whole(aspects))];
        let dependency = vk::DependencyInfo::default().image_memory_barriers(&barrier);
        // SAFETY, here and below: the buffer is being recorded by this thread only (`&mut self`), and what the
        // command uses is kept alive until the last submission has ended.
        unsafe { self.device.raw.cmd_pipeline_barrier2(self.raw, &dependency) };
    }

    /// Orders what `target` does to the buffer after what `source` did.
    pub fn buffer_barrier(&mut self, buffer: &Buffer, source: Scope, target: Scope) {
        self.record_buffer_barrier(buffer, source, target, SAME);
    }

    /// Gives the buffer to the family of `to`, which acquires it after a semaphore.
    pub fn buffer_release(&mut self, buffer: &Buffer, source: Scope, to: &Queue) {
        self.record_buffer_barrier(buffer, source, SEMAPHORE, families(self.family, to.family));
    }

    /// Takes the buffer that the family of `from` released.
    pub fn buffer_acquire(&mut self, buffer: &Buffer, target: Scope, from: &Queue) {
        self.record_buffer_barrier(buffer, SEMAPHORE, target, families(from.family, self.family));
    }

    fn record_buffer_barrier(&mut self, buffer: &Buffer, source: Scope, target: Scope, families: Families) {
        self.keep(&buffer.inner);
        let barrier = [vk::BufferMemoryBarrier2::default()
            .src_stage_mask(source.stages)
            .src_access_mask(source.access)
            .dst_stage_mask(target.stages)
            .dst_access_mask(target.access)
            .src_queue_family_index(families.0)
            .dst_queue_family_index(families.1)
            .buffer(buffer.handle())
            .size(vk::WHOLE_SIZE)];
        let dependency = vk::DependencyInfo::default().buffer_memory_barriers(&barrier);
        // SAFETY: as in `record_image_barrier`.
        unsafe { self.device.raw.cmd_pipeline_barrier2(self.raw, &dependency) };
    }

    /// Fills a colour image that is in layout `TRANSFER_DST_OPTIMAL` with zeros.
    pub fn clear_color(&mut self, image: &Image) {
        self.keep(&image.inner);
        let (layout, range) = (vk::ImageLayout::TRANSFER_DST_OPTIMAL, [whole(vk::ImageAspectFlags::COLOR)]);
        // SAFETY: as in `record_image_barrier`.
        unsafe {
            self.device.raw.cmd_clear_color_image(self.raw, image.handle(), layout, &Default::default(), &range);
        }
    }

    /// The image is in layout `TRANSFER_DST_OPTIMAL`.
    pub fn copy_buffer_to_image(&mut self, buffer: &Buffer, image: &Image, region: CopyRegion) {
        if let Some(region) = self.region(buffer, image, region) {
            let layout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
            let (from, to) = (buffer.handle(), image.handle());
            // SAFETY: as in `record_image_barrier`; the region is inside both.
            unsafe { self.device.raw.cmd_copy_buffer_to_image(self.raw, from, to, layout, &[region]) };
        }
    }

    /// Stencil values, a byte each, tightly packed from byte `offset` on, to all of an image that is in layout `TRANSFER_DST_OPTIMAL`.
    pub fn copy_buffer_to_stencil(&mut self, buffer: &Buffer, offset: u64, image: &Image) {
        let [width, height, depth] = image.info.extent;
        if !has_stencil(image.info.format) {
            self.misused(&image.info.name, format!("{:?} has no stencil", image.info.format));
            return;
        }
        let texels = u64::from(width) * u64::from(height) * u64::from(depth);
        if !self.fits(buffer, offset, texels) {
            return;
        }
        self.keep(&image.inner);
        let layers = vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::STENCIL).layer_count(1);
        let region = vk::BufferImageCopy::default()
            .buffer_offset(offset)
            .image_subresource(layers)
            .image_extent(vk::Extent3D { width, height, depth });
        let layout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        let (from, to) = (buffer.handle(), image.handle());
        // SAFETY: as in `record_image_barrier`; the region is inside both.
        unsafe { self.device.raw.cmd_copy_buffer_to_image(self.raw, from, to, layout, &[region]) };
    }

    /// The image is in layout `TRANSFER_SRC_OPTIMAL`. Of a depth format the depth is copied.
    pub fn copy_image_to_buffer(&mut self, image: &Image, buffer: &Buffer, region: CopyRegion) {
        if let Some(region) = self.region(buffer, image, region) {
            let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
            let (from, to) = (image.handle(), buffer.handle());
            // SAFETY: as in `record_image_barrier`; the region is inside both.
            unsafe { self.device.raw.cmd_copy_image_to_buffer(self.raw, from, layout, to, &[region]) };
        }
    }

    /// Offsets and size in bytes.
    pub fn copy_buffer(&mut self, from: &Buffer, from_offset: u64, to: &Buffer, to_offset: u64, size: u64) {
        if size > 0 && self.fits(from, from_offset, size) && self.fits(to, to_offset, size) {
            let region = vk::BufferCopy { src_offset: from_offset, dst_offset: to_offset, size };
            // SAFETY: as in `record_image_barrier`; the region is inside both.
            unsafe { self.device.raw.cmd_copy_buffer(self.raw, from.handle(), to.handle(), &[region]) };
        }
    }

    /// Fills `size` bytes at `offset` with the word; both are multiples of 4.
    pub fn fill_buffer(&mut self, buffer: &Buffer, offset: u64, size: u64, word: u32) {
        if !offset.is_multiple_of(4) || !size.is_multiple_of(4) {
            self.misused(&buffer.info.name, format!("{size} bytes at {offset} are not whole words"));
        } else if size > 0 && self.fits(buffer, offset, size) {
            // SAFETY: as in `record_image_barrier`; the range is inside the buffer and in whole words.
            unsafe { self.device.raw.cmd_fill_buffer(self.raw, buffer.handle(), offset, size, word) };
        }
    }

    /// The region as Vulkan takes it, when it is inside the image and its texels inside the buffer.
    fn region(&mut self, buffer: &Buffer, image: &Image, region: CopyRegion) -> Option<vk::BufferImageCopy> {
        self.keep(&image.inner);
        let sides = region.image_offset.iter().zip(region.extent).zip(image.info.extent);
        let inside = |((&offset, side), limit): ((&u32, u32), u32)| {
            side > 0 && offset.checked_add(side).is_some_and(|end| end <= limit)
        };
        if !sides.into_iter().all(inside) {
            self.misused(&image.info.name, format!("{region:?} of {:?} texels", image.info.extent));
            return None;
        }
        let [width, height, depth] = region.extent.map(u64::from);
        let row = if region.row == 0 { width } else { region.row.into() };
        if row < width {
            self.misused(&image.info.name, format!("rows of {width} texels in rows of {row}"));
            return None;
        }
        // The last row need not be whole.
        let texels = row.checked_mul(height.checked_mul(depth)?.checked_sub(1)?)?.checked_add(width)?;
        let bytes = texels.checked_mul(texel_bytes(image.info.format)?)?;
        if !self.fits(buffer, region.buffer_offset, bytes) {
            return None;
        }
        let [x, y, z] = region.image_offset;
        let [width, height, depth] = region.extent;
        let layers = vk::ImageSubresourceLayers::default().aspect_mask(aspect(image.info.format));
        let (layers, z, depth) = match image.info.shape {
            ImageShape::Layers => (layers.base_array_layer(z).layer_count(depth), 0, 1),
            ImageShape::Flat | ImageShape::Volume => (layers.layer_count(1), z, depth),
        };
        let [x, y, z] = [x, y, z].map(|offset| offset as i32);
        Some(
            vk::BufferImageCopy::default()
                .buffer_offset(region.buffer_offset)
                .buffer_row_length(region.row)
                .image_subresource(layers)
                .image_offset(vk::Offset3D { x, y, z })
                .image_extent(vk::Extent3D { width, height, depth }),
        )
    }
}

/// An image that is shared belongs to no family.
fn image_families(image: &Image, from: u32, to: u32) -> Families {
    if image.info.shared { SAME } else { families(from, to) }
}

fn families(from: u32, to: u32) -> Families {
    if from == to { SAME } else { (from, to) }
}
