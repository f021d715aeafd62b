//! From the list of steps to layouts and dependencies: what a step waits for and what state it leaves each image
//! in, read off the accesses of the steps before and after it. Knows no device.

use std::collections::HashMap;

use ash::vk;

use crate::part::access::{Access, Usage};
use crate::part::resource::Resource;
use crate::part::{Step, Work};
use crate::resource;
use crate::vulkan::{Attachment, Dependency, RenderPassInfo, Role, Scope};

/// What runs around one step.
#[derive(Clone, Debug)]
pub struct Scheduled {
    /// Images that the step reads or copies and that change layout before it.
    pub barriers: Vec<Barrier>,
    /// The step's render pass, where it draws; attachments in the order of `targets`.
    pub render_pass: Option<RenderPassInfo>,
    pub targets: Vec<Resource>,
    /// Where each image is once the step has run.
    pub layouts: HashMap<Resource, vk::ImageLayout>,
}

#[derive(Clone, Copy, Debug)]
pub struct Barrier {
    pub resource: Resource,
    pub source: Scope,
    pub target: Scope,
    pub before: vk::ImageLayout,
    pub after: vk::ImageLayout,
}

fn scope(usage: Usage) -> Scope {
    let (stages, access) = usage.scope();
    Scope { stages, access }
}

fn join(scopes: impl IntoIterator<Item = Scope>) -> Scope {
    scopes.into_iter().fold(Scope::default(), |a, b| Scope { stages: a.stages | b.stages, access: a.access | b.access })
}

/// Schedules the graphics steps of a frame. `format` gives the format of a target.
pub fn schedule(steps: &[Step], format: impl Fn(Resource) -> vk::Format) -> Vec<Scheduled> {
    let mut layouts: HashMap<Resource, vk::ImageLayout> = HashMap::new();
    // The last use of each target, and whether it was as an attachment (whose render pass has then seen to
    // layout and dependency of the use that follows).
    let mut last: HashMap<Resource, Usage> = HashMap::new();
    let mut scheduled = Vec::with_capacity(steps.len());
    for (i, step) in steps.iter().enumerate() {
        let next = |resource: Resource| -> Option<Access> {
            let of = |s: &Step| s.accesses.iter().copied().find(|a| a.resource == resource);
            steps[i + 1..].iter().find_map(of)
        };
        let mut barriers = Vec::new();
        let mut attachments = Vec::new();
        let mut targets = Vec::new();
        let mut after = Vec::new();
        for &Access { resource, usage } in step.accesses.iter().filter(|a| a.resource.is_target()) {
            let previous = last.insert(resource, usage);
            let before = layouts.get(&resource).copied().unwrap_or(vk::ImageLayout::UNDEFINED);
            let during = usage.layout();
            if !usage.is_attachment() {
                // Two writes in a row, or a write after a read, wait for each other in the same layout too.
                if before != during || usage.is_storage_image() {
                    let source = previous.map_or(Scope::default(), scope);
                    barriers.push(Barrier { resource, source, target: scope(usage), before, after: during });
                }
                layouts.insert(resource, during);
                continue;
            }
            let following = next(resource);
            let leave = following.map_or(during, |a| a.usage.layout());
            let made = attachment(resource, usage, format(resource), before, leave, following.is_some());
            let load = match made.load {
                vk::AttachmentLoadOp::CLEAR if read_where_drawn(step, resource, &steps[i + 1..]) => {
                    vk::AttachmentLoadOp::DONT_CARE
                }
                load => load,
            };
            attachments.push(Attachment { load, ..made });
            targets.push(resource);
            layouts.insert(resource, leave);
            after.extend(following.map(|a| scope(a.usage)));
            // Those that read it as well before it is written again may do so in another stage.
            let uses = steps[i + 1..].iter().flat_map(|s| s.accesses.iter()).filter(|a| a.resource == resource);
            after.extend(uses.take_while(|a| !a.usage.writes()).map(|a| scope(a.usage)));
            last.insert(resource, usage);
        }
        let render_pass = matches!(step.work, Work::Draw(_)).then(|| {
            let earlier = |a: &Access| -> Option<Usage> {
                let of = |s: &Step| s.accesses.iter().find(|b| b.resource == a.resource).map(|b| b.usage);
                steps[..i].iter().rev().find_map(of)
            };
            let cleared = |a: &Attachment| a.load == vk::AttachmentLoadOp::CLEAR;
            let mut here = join(step.accesses.iter().map(|a| scope(a.usage)));
            if attachments.iter().any(|a| a.role == Role::Depth && cleared(a)) {
                here = join([here, scope(Usage::DepthWrite)]);
            }
            let drawn = step.accesses.iter().filter(|a| a.usage.is_attachment()).map(|a| scope(a.usage));
            RenderPassInfo {
                name: step.pass_name().to_owned(),
                before: Dependency { source: join(step.accesses.iter().filter_map(earlier).map(scope)), target: here },
                after: Dependency { source: join(drawn), target: join(after) },
                attachments,
            }
        });
        scheduled.push(Scheduled { barriers, render_pass, targets, layouts: layouts.clone() });
    }
    scheduled
}

/// Whether what a target holds beside what the step draws counts for nobody: the step draws all of the volume's box, and later steps
/// draw in it too and read no more than their pixel. Clearing would take a device as long as drawing.
fn read_where_drawn(step: &Step, resource: Resource, later: &[Step]) -> bool {
    let fills = matches!(&step.work, Work::Draw(draw) if draw.fills);
    let of = |step: &Step| step.accesses.iter().find(|access| access.resource == resource).map(|access| access.usage);
    let in_box = |step: &Step| step.work.geometry().is_some_and(|geometry| geometry.within_box);
    fills && later.iter().all(|step| of(step).is_none_or(|usage| usage == Usage::Sampled && in_box(step)))
}

/// The first step that draws into a target clears it; the last one keeps it only where somebody still reads it.
fn attachment(
    resource: Resource,
    usage: Usage,
    format: vk::Format,
    before: vk::ImageLayout,
    after: vk::ImageLayout,
    used_later: bool,
) -> Attachment {
    let first = before == vk::ImageLayout::UNDEFINED || usage == Usage::DepthAnew;
    // A read-only layout cannot be cleared.
    let usage_now = if first && usage == Usage::DepthTest { Usage::DepthWrite } else { usage };
    let read_only = matches!(usage_now, Usage::DepthTest | Usage::ColorKept);
    // The picture is read back after the last step.
    let kept = used_later && usage != Usage::DepthAnew || resource == resource::ACCUMULATED;
    Attachment {
        name: resource.name().to_owned(),
        format,
        role: match usage {
            _ if usage.is_depth() => Role::Depth,
            Usage::ColorInput => Role::ColorInput,
            _ => Role::Color,
        },
        load: if first { vk::AttachmentLoadOp::CLEAR } else { vk::AttachmentLoadOp::LOAD },
        // A store, even of what only was tested, counts as a write.
        store: match (read_only, kept) {
            (true, _) => vk::AttachmentStoreOp::NONE,
            (false, true) => vk::AttachmentStoreOp::STORE,
            (false, false) => vk::AttachmentStoreOp::DONT_CARE,
        },
        before: if usage == Usage::DepthAnew { vk::ImageLayout::UNDEFINED } else { before },
        during: usage_now.layout(),
        after,
    }
}
