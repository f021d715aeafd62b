//! Layouts, load and store ops and dependencies of every plan, read off its steps; needs no device.

#[path = "plan/cases.rs"]
mod cases;

use std::collections::{HashMap, HashSet};

use cases::cases;
use depthleap::frame::schedule::{Barrier, Scheduled, schedule};
use depthleap::geometry::{BACK_IN_TILES, BOX_BACK, BOX_FRONT, FRONT_IN_TILES};
use depthleap::part::access::{Access, Usage};
use depthleap::part::resource::Resource;
use depthleap::part::{Step, Work};
use depthleap::resource;
use depthleap::scene::settings::{Accumulate, Formats};
use depthleap::vulkan::{Attachment, Role, vk};

/// The steps of a plan that the graphics queue runs, and what stands around them.
struct Scheduling {
    name: &'static str,
    steps: Vec<Step>,
    scheduled: Vec<Scheduled>,
}

fn schedulings() -> Vec<Scheduling> {
    let each = |case: cases::Case| {
        let steps = case.plan.frame().to_vec();
        let scheduled = schedule(&steps, |resource| resource.format(Formats::default()));
        assert_eq!(steps.len(), scheduled.len());
        Scheduling { name: case.name, steps, scheduled }
    };
    cases().into_iter().map(each).collect()
}

impl Scheduling {
    /// All attachments in order: the step's number, what it is and how it is attached.
    fn attachments(&self) -> impl Iterator<Item = (usize, Resource, &Attachment)> {
        self.scheduled.iter().enumerate().flat_map(|(i, one)| {
            let attachments = one.render_pass.iter().flat_map(|pass| &pass.attachments);
            one.targets.iter().copied().zip(attachments).map(move |(target, attachment)| (i, target, attachment))
        })
    }

    /// Whether a step after number `i` uses the target.
    fn used_after(&self, i: usize, target: Resource) -> bool {
        self.steps[i + 1..].iter().any(|step| step.accesses.iter().any(|access| access.resource == target))
    }

    /// Whether step number `i` begins with a target anew, and leaves nothing of it to others.
    fn anew(&self, i: usize, target: Resource) -> bool {
        self.steps[i].accesses.contains(&Usage::DepthAnew.of(target))
    }

    /// A line for each attachment that is not loaded as it should: cleared where nothing was, else kept.
    fn wrongly_loaded(&self) -> Vec<String> {
        let mut there: HashSet<Resource> = HashSet::new();
        let mut found = Vec::new();
        for (i, step) in self.steps.iter().enumerate() {
            for (_, target, attachment) in self.attachments().filter(|(at, ..)| *at == i) {
                let expected = match there.contains(&target) && !self.anew(i, target) {
                    true => vk::AttachmentLoadOp::LOAD,
                    false if target == resource::ENTRY && self.in_the_box_alone(target) => {
                        vk::AttachmentLoadOp::DONT_CARE
                    }
                    false => vk::AttachmentLoadOp::CLEAR,
                };
                if attachment.load != expected {
                    found.push(format!("{}: {} of {}", step.name, target.name(), self.name));
                }
            }
            there.extend(step.accesses.iter().map(|access| access.resource));
        }
        found
    }

    /// Whether all steps that have to do with a target draw the volume's box.
    fn in_the_box_alone(&self, target: Resource) -> bool {
        let mut steps = self.steps.iter().filter(|step| step.accesses.iter().any(|a| a.resource == target));
        let in_box = [&BOX_FRONT, &BOX_BACK, &FRONT_IN_TILES, &BACK_IN_TILES];
        steps.all(|step| step.work.geometry().is_some_and(|of| in_box.contains(&of)))
    }

    /// A line for each attachment that is not stored as it should.
    fn wrongly_stored(&self) -> Vec<String> {
        let mut found = Vec::new();
        for (i, target, attachment) in self.attachments() {
            let left_alone = [Usage::DepthTest, Usage::ColorKept].map(|usage| usage.of(target));
            let tested_only = left_alone.iter().any(|access| self.steps[i].accesses.contains(access));
            // The picture is read after the last step.
            let read_later = self.used_after(i, target) && !self.anew(i, target) || target == resource::ACCUMULATED;
            let expected = match (tested_only, read_later) {
                (true, _) => vk::AttachmentStoreOp::NONE,
                (false, true) => vk::AttachmentStoreOp::STORE,
                (false, false) => vk::AttachmentStoreOp::DONT_CARE,
            };
            if attachment.store != expected {
                found.push(format!("{}: {} of {}", self.steps[i].name, target.name(), self.name));
            }
        }
        found
    }

    /// A line for each layout that is not the one in which the use before left the image, or not the use's own.
    fn broken_chains(&self) -> Vec<String> {
        let mut now: HashMap<Resource, vk::ImageLayout> = HashMap::new();
        let mut found = Vec::new();
        for (i, (step, one)) in self.steps.iter().zip(&self.scheduled).enumerate() {
            let mut fault = |target: Resource, what: &str| {
                found.push(format!("{}: {} of {} {what}", step.name, target.name(), self.name));
            };
            for barrier in &one.barriers {
                if barrier.before != now.get(&barrier.resource).copied().unwrap_or_default() {
                    fault(barrier.resource, "before its barrier");
                }
                now.insert(barrier.resource, barrier.after);
            }
            for access in step.accesses.iter().filter(|access| access.resource.is_target()) {
                let target = access.resource;
                let attachment = self.attachments().find(|(at, of, _)| (*at, *of) == (i, target));
                let needed = access.usage.layout();
                match attachment {
                    Some((_, _, attachment)) => {
                        let left = now.get(&target).copied().filter(|_| !self.anew(i, target));
                        if attachment.before != left.unwrap_or_default() {
                            fault(target, "before its pass");
                        }
                        if attachment.during != needed {
                            fault(target, "in its pass");
                        }
                        now.insert(target, attachment.after);
                    }
                    None if now.get(&target) != Some(&needed) => fault(target, "where it is read"),
                    None => {}
                }
            }
            let told = step.accesses.iter().map(|a| a.resource).filter(|r| r.is_target());
            told.filter(|target| one.layouts.get(target) != now.get(target))
                .for_each(|target| fault(target, "in the list of layouts"));
        }
        found
    }

    /// A line for each use that does not wait for the one before it, by the earlier pass, its own or a barrier; a read may wait for
    /// the last write instead.
    fn unordered(&self) -> Vec<String> {
        let mut last: HashMap<Resource, usize> = HashMap::new();
        let mut written: HashMap<Resource, usize> = HashMap::new();
        let mut found = Vec::new();
        for (i, step) in self.steps.iter().enumerate() {
            for access in step.accesses.iter().filter(|access| access.resource.is_target()) {
                let write = written.get(&access.resource).copied().filter(|_| !access.usage.writes());
                if access.usage.writes() {
                    written.insert(access.resource, i);
                }
                let Some(before) = last.insert(access.resource, i) else { continue };
                if !write.into_iter().chain([before]).any(|before| self.waits(before, i, access)) {
                    found.push(format!("{}: {} of {}", step.name, access.resource.name(), self.name));
                }
            }
        }
        found
    }

    /// Whether a use in step `i` waits for that of the same image in the step `before`.
    fn waits(&self, before: usize, i: usize, access: &Access) -> bool {
        let earlier = self.steps[before].accesses.iter().find(|a| a.resource == access.resource);
        let (from, to) = (earlier.unwrap().usage.scope(), access.usage.scope());
        let (source, target) = (&self.scheduled[before], &self.scheduled[i]);
        let passes = source.render_pass.as_ref().map(|pass| pass.after);
        let own = target.render_pass.as_ref().map(|pass| pass.before);
        let barrier = target.barriers.iter().find(|barrier| barrier.resource == access.resource);
        let by_pass = passes.into_iter().chain(own).any(|dependency| {
            let (source, target) = (dependency.source, dependency.target);
            source.stages.contains(from.0) && target.stages.contains(to.0) && target.access.contains(to.1)
        });
        let barred = |barrier: &Barrier| barrier.source.stages.contains(from.0) && barrier.target.stages.contains(to.0);
        by_pass || barrier.is_some_and(barred)
    }
}

/// Alters one attachment of near-neighbor skipping, by step and target.
fn altered(step: &str, target: Resource, alter: impl FnOnce(&mut Attachment)) -> Scheduling {
    let mut all = schedulings();
    let at = all.iter().position(|one| one.name == "nn-omni_bounds_copy").unwrap();
    let mut one = all.swap_remove(at);
    let i = one.steps.iter().position(|other| other.name == step).unwrap();
    let scheduled = &mut one.scheduled[i];
    let number = scheduled.targets.iter().position(|other| *other == target).unwrap();
    alter(&mut scheduled.render_pass.as_mut().unwrap().attachments[number]);
    one
}

#[test]
fn first_draw_into_a_target_clears_and_later_ones_load() {
    let mut left = 0;
    for one in schedulings() {
        assert_eq!(one.wrongly_loaded(), [""; 0]);
        let loads = |how: vk::AttachmentLoadOp| one.attachments().filter(|(_, _, a)| a.load == how).count();
        let finds_rays = one.steps.iter().any(|step| step.name == "entry");
        let cleared = loads(vk::AttachmentLoadOp::CLEAR);
        assert!(cleared >= 2 || !finds_rays, "direction and the picture, at least, in {}", one.name);
        left += loads(vk::AttachmentLoadOp::DONT_CARE);
    }
    assert!(left > 4, "entries that are not cleared: {left}");
    let wrong = altered("main_pass #1", resource::ACCUMULATED, |a| a.load = vk::AttachmentLoadOp::CLEAR);
    assert_eq!(wrong.wrongly_loaded().len(), 1);
    let wrong = altered("entry", resource::ENTRY, |a| a.load = vk::AttachmentLoadOp::LOAD);
    assert_eq!(wrong.wrongly_loaded().len(), 1);
}

#[test]
fn read_only_depth_stores_none_and_what_nobody_reads_is_not_stored() {
    for one in schedulings() {
        assert_eq!(one.wrongly_stored(), [""; 0]);
        let picture = one.attachments().filter(|(_, target, _)| *target == resource::ACCUMULATED).last();
        // A compute shader attaches nothing.
        assert!(picture.is_some() || one.name.ends_with("+compute"), "RES of {} is drawn", one.name);
        if let Some((_, _, picture)) = picture {
            assert_eq!(picture.store, vk::AttachmentStoreOp::STORE, "RES of {} is kept", one.name);
        }
    }
    let wrong = altered("main_pass #1", resource::STORED, |a| a.store = vk::AttachmentStoreOp::STORE);
    assert_eq!(wrong.wrongly_stored().len(), 1);
    let wrong = altered("main_pass #2", resource::ACCUMULATED, |a| a.store = vk::AttachmentStoreOp::DONT_CARE);
    assert_eq!(wrong.wrongly_stored().len(), 1);
}

#[test]
fn last_marks_of_a_frame_that_nobody_copies_are_not_stored() {
    // The last step gone that uses them, and with it the reason to keep them.
    let case = cases().into_iter().find(|case| case.name == "nn-omni_ztest_copy").unwrap();
    let last = case.plan.steps.iter().rposition(|step| step.name.starts_with("mark_copy")).unwrap();
    let scheduled = schedule(&case.plan.steps[..last], |resource| {
        resource.format(Formats { accumulate: Accumulate::Rgba8, ..Formats::default() })
    });
    let pass = scheduled.last().unwrap().render_pass.as_ref().unwrap();
    let marks = pass.attachments.iter().find(|attachment| attachment.name == "marks").unwrap();
    assert_eq!(marks.store, vk::AttachmentStoreOp::DONT_CARE);
}

#[test]
fn layouts_chain_from_use_to_use() {
    for one in schedulings() {
        assert_eq!(one.broken_chains(), [""; 0]);
    }
    let general = vk::ImageLayout::GENERAL;
    let wrong = altered("near_neighbor #1", resource::MARKS, |a| a.before = general);
    assert_eq!(wrong.broken_chains().len(), 1);
    let wrong = altered("main_pass #0", resource::STORED, |a| a.during = general);
    assert_eq!(wrong.broken_chains().len(), 1);
    // The list of layouts, and the use that follows.
    let wrong = altered("main_pass #0", resource::ACCUMULATED, |a| a.after = general);
    assert!(wrong.broken_chains().len() >= 2);
}

#[test]
fn read_only_depth_stays_in_a_read_only_layout() {
    let read_only = vk::ImageLayout::DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    let mut tested = 0;
    for one in schedulings() {
        for (i, target, attachment) in one.attachments() {
            if one.steps[i].accesses.contains(&Usage::DepthTest.of(target)) {
                tested += 1;
                assert!([resource::STORED, resource::SHELL_DEPTH].contains(&target), "{target:?} of {}", one.name);
                assert_eq!(attachment.during, read_only, "{}", one.name);
            }
        }
    }
    assert!(tested > 20, "{tested}");
}

#[test]
fn every_use_waits_for_the_one_before() {
    for one in schedulings() {
        assert_eq!(one.unordered(), [""; 0]);
    }
    let mut wrong = altered("main_pass #1", resource::ACCUMULATED, |_| ());
    for scheduled in &mut wrong.scheduled {
        let Some(pass) = &mut scheduled.render_pass else { continue };
        pass.before.source = Default::default();
        pass.after.source = Default::default();
    }
    assert!(wrong.unordered().len() > 10, "{:?}", wrong.unordered());
}

#[test]
fn attachments_are_those_a_step_draws_into_or_tests() {
    for one in schedulings() {
        for (step, scheduled) in one.steps.iter().zip(&one.scheduled) {
            let attached = |usage| {
                use Usage::{Color, ColorInput, ColorKept, DepthAnew, DepthTest, DepthWrite};
                matches!(usage, Color | ColorInput | ColorKept | DepthAnew | DepthTest | DepthWrite)
            };
            let drawn: Vec<_> = step.accesses.iter().filter(|a| attached(a.usage)).map(|a| a.resource).collect();
            assert_eq!(scheduled.targets, drawn, "{} of {}", step.name, one.name);
            assert_eq!(scheduled.render_pass.is_some(), matches!(step.work, Work::Draw(_)));
            let Some(pass) = &scheduled.render_pass else { continue };
            let names: Vec<_> = pass.attachments.iter().map(|attachment| attachment.name.as_str()).collect();
            assert_eq!(names, drawn.iter().map(|target| target.name()).collect::<Vec<_>>());
            assert_eq!(pass.name, step.pass_name(), "the same pass, whatever its number");
        }
    }
}

#[test]
fn colour_that_is_read_too_stays_in_the_layout_of_both() {
    let mut read = 0;
    for one in schedulings() {
        for (i, target, attachment) in one.attachments() {
            let both = one.steps[i].accesses.contains(&Usage::ColorInput.of(target));
            assert_eq!(attachment.role == Role::ColorInput, both, "{} of {}", one.steps[i].name, one.name);
            if both {
                read += 1;
                assert_eq!(attachment.during, vk::ImageLayout::GENERAL, "{} of {}", one.steps[i].name, one.name);
            }
        }
    }
    assert!(read > 5, "{read}");
}

#[test]
fn steps_in_the_middle_of_a_frame_share_their_render_pass() {
    // Render passes are made once for all that are equal: number 1 and 2 of the same pass, here.
    for one in schedulings().into_iter().filter(|one| one.name.starts_with("nn-omni_")) {
        let pass = |name: &str| {
            let i = one.steps.iter().position(|step| step.name == name).unwrap();
            one.scheduled[i].render_pass.clone()
        };
        assert_eq!(pass("near_neighbor #1"), pass("near_neighbor #2"), "{}", one.name);
        assert_eq!(pass("main_pass #0"), pass("main_pass #1"), "{}", one.name);
    }
}
