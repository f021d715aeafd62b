//! Submissions, their order, and work that goes from one queue to the other.

use std::collections::VecDeque;
use std::sync::Arc;

use depthleap::glsl;
use depthleap::scene::field::{Field, NanPolicy};
use depthleap::scene::volume::{Volume, Voxels};
use depthleap::shared::Slice;
use depthleap::structure::grid::Grid;
use depthleap::structure::ranges;
use depthleap::vulkan::{
    Bound, Buffer, Commands, ComputePipeline, CopyRegion, DescriptorSet, Device, Image, ImageInfo, ImageShape, Place,
    Queue, Recorded, Sampler, Scope, ShaderModule, vk,
};

use super::kit::{COMPUTE, COPY_READ, COPY_WRITE, buffer, uploaded, words};
use crate::harness::{Test, closed, judged, open, tests};
use crate::shader::shader;

pub fn all() -> Vec<Test> {
    tests![
        dispatch_runs_on_both_queues_with_and_without_a_second_one,
        volume_goes_to_the_compute_queue_and_ranges_come_back,
        later_submissions_see_what_earlier_ones_wrote,
        recording_runs_as_often_as_it_is_submitted,
        what_a_recording_uses_outlives_its_owner,
        hundreds_of_hand_overs_with_drops_right_behind,
    ]
}

/// Runs `test` with a compute queue of its own where there is one, and with one queue for everything.
fn with_both(test: fn(&Arc<Device>)) {
    for single_queue in [false, true] {
        let device = open(single_queue).unwrap();
        if !single_queue && !device.separate_compute() {
            eprintln!("{}: one queue in both runs, the driver has no second one", device.info.name);
        }
        assert!(!(single_queue && device.separate_compute()), "one queue was asked for");
        let result = judged(&device, |device| {
            test(device);
            Ok(())
        });
        assert!(result.is_ok(), "{:?}", result.err().map(|failed| failed.message().map(str::to_owned)));
        assert_eq!(closed(device), [""; 0]);
    }
}

/// A buffer of numbers and a pipeline that does x = 3 x + term to each.
struct Counter {
    numbers: Buffer,
    pipeline: ComputePipeline,
    set: DescriptorSet,
}

const COUNT: usize = 5000;

impl Counter {
    fn new(device: &Arc<Device>) -> Self {
        let numbers: Vec<u32> = (0..COUNT as u32).collect();
        let numbers = uploaded(device, "numbers", bytemuck::cast_slice(&numbers));
        let pipeline = ComputePipeline::new(device, "counter", &shader("vulkan/count.comp"), &[("FACTOR", 3)]).unwrap();
        let resources = [("numbers", Bound::Storage(&numbers))];
        let set = DescriptorSet::new(device, "set of counter", &pipeline.layout, &resources).unwrap();
        Self { numbers, pipeline, set }
    }

    /// One step on `queue`, taken over from the queue `from` and given to `to`, where there are such.
    fn step(
        &self,
        device: &Arc<Device>,
        queue: &Queue,
        term: u32,
        (from, to): (Option<&Queue>, Option<&Queue>),
    ) -> Recorded {
        let mut commands = Commands::begin(device, queue, &format!("step {term}")).unwrap();
        if let Some(from) = from {
            commands.buffer_acquire(&self.numbers, COMPUTE, from);
        }
        commands.bind_compute(&self.pipeline, &self.set);
        commands.push(&self.pipeline.layout, &term.to_ne_bytes());
        commands.dispatch([(COUNT as u32).div_ceil(64), 1, 1]);
        if let Some(to) = to {
            commands.buffer_release(&self.numbers, COMPUTE, to);
        }
        commands.finish().unwrap()
    }
}

/// What the steps make of number `i`.
fn expected(i: u32, terms: impl Iterator<Item = u32>) -> u32 {
    terms.fold(i, |x, term| x.wrapping_mul(3).wrapping_add(term))
}

#[track_caller]
fn assert_counted(numbers: &Buffer, terms: std::ops::Range<u32>) {
    let found = words(&numbers.read().unwrap());
    let wrong = (0..COUNT as u32).find(|&i| found[i as usize] != expected(i, terms.clone()));
    assert_eq!(wrong, None, "of {COUNT} numbers after {terms:?}");
}

fn dispatch_runs_on_both_queues_with_and_without_a_second_one(_: &Arc<Device>) {
    with_both(|device| {
        let counter = Counter::new(device);
        let (graphics, compute) = (&device.graphics, &device.compute);
        let there = counter.step(device, graphics, 0, (None, Some(compute)));
        let back = counter.step(device, compute, 1, (Some(graphics), Some(graphics)));
        let last = counter.step(device, graphics, 2, (Some(compute), None));
        let there = graphics.submit(&there, &[]).unwrap();
        let back = compute.submit(&back, &[&there]).unwrap();
        graphics.submit(&last, &[&back]).unwrap().wait().unwrap();
        assert_counted(&counter.numbers, 0..3);
    });
}

/// A field with no two values alike.
fn field(dims: [usize; 3]) -> Field {
    let count: usize = dims.iter().product();
    let values = (0..count).map(|i| (i * 7919 % 1009) as f32 / 1009.0).collect();
    let volume = Volume::new("hand over", dims, [1.0; 3], Voxels::F32(values)).unwrap();
    Field::new(volume, Some([0.0, 1.0]), NanPolicy::Error).unwrap()
}

/// The whole way of a structure build: upload, release, acquire, build, release, acquire, read back.
fn volume_goes_to_the_compute_queue_and_ranges_come_back(_: &Arc<Device>) {
    with_both(|device| {
        let (graphics, compute) = (&device.graphics, &device.compute);
        let field = field([19, 17, 9]);
        let (_, expected) = ranges::ranges(&field, 8);
        let volume = Image::new(
            device,
            ImageInfo {
                name: "volume".to_owned(),
                extent: field.dims().map(|n| n as u32),
                format: vk::Format::R32_SFLOAT,
                usage: vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST,
                shape: ImageShape::Volume,
                shared: false,
            },
        )
        .unwrap();
        let bytes = expected.len() as u64 * 8;
        let ranges = buffer(device, "cell_range", bytes, Place::Device);
        let result = buffer(device, "result", bytes, Place::Readback);
        let build = glsl::Shader::new("structure/cell_range.comp", []);
        let build = ShaderModule::new(build.file, &glsl::module(&build).unwrap()).unwrap();
        let build = ComputePipeline::new(device, "cell_range", &build, &[]).unwrap();
        let sampler = Sampler::new(device, "nearest", false).unwrap();
        let (empty, to) = (vk::ImageLayout::UNDEFINED, vk::ImageLayout::TRANSFER_DST_OPTIMAL);
        let read = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        let resources = [("volume", Bound::Sampled(&volume, &sampler, read)), ("cell_range", Bound::Storage(&ranges))];
        let set = DescriptorSet::new(device, "cell_range", &build.layout, &resources).unwrap();

        let texels = uploaded(device, "texels", bytemuck::cast_slice(&field.values));
        let mut give = Commands::begin(device, graphics, "give").unwrap();
        give.image_barrier(&volume, Scope::NONE, COPY_WRITE, empty, to);
        give.copy_buffer_to_image(&texels, &volume, CopyRegion::whole(&volume));
        give.image_release(&volume, COPY_WRITE, to, read, compute);
        let given = graphics.submit(&give.finish().unwrap(), &[]).unwrap();

        let mut work = Commands::begin(device, compute, "build").unwrap();
        work.image_acquire(&volume, COMPUTE, to, read, graphics);
        work.bind_compute(&build, &set);
        let grid = Grid::new(&field, 8);
        let [cells_x, cells_y, cells_z] = grid.cells.map(|n| n as u32);
        let all = Slice { end: grid.count() as u32, cells_x, cells_y, cells_z, cell: 8, ..Slice::default() };
        work.push(&build.layout, bytemuck::bytes_of(&all));
        work.dispatch([1; 3]);
        work.buffer_release(&ranges, COMPUTE, graphics);
        let built = compute.submit(&work.finish().unwrap(), &[&given]).unwrap();

        let mut take = Commands::begin(device, graphics, "take").unwrap();
        take.buffer_acquire(&ranges, COPY_READ, compute);
        take.copy_buffer(&ranges, 0, &result, 0, bytes);
        graphics.submit(&take.finish().unwrap(), &[&built]).unwrap().wait().unwrap();
        assert_eq!(bytemuck::cast_slice::<u8, [f32; 2]>(&result.read().unwrap()), expected);
    });
}

fn later_submissions_see_what_earlier_ones_wrote(device: &Arc<Device>) {
    let counter = Counter::new(device);
    let queue = &device.graphics;
    let recorded: Vec<_> = (0..4).map(|term| counter.step(device, queue, term, (None, None))).collect();
    let mut submissions = Vec::new();
    for one in &recorded {
        let after: Vec<_> = submissions.last().into_iter().collect();
        let submission = queue.submit(one, &after).unwrap();
        submissions.push(submission);
    }
    submissions[3].wait().unwrap();
    // A point is reached when all before it are.
    assert!(submissions.iter().all(|one| one.reached().unwrap()));
    assert_counted(&counter.numbers, 0..4);
}

fn recording_runs_as_often_as_it_is_submitted(device: &Arc<Device>) {
    let counter = Counter::new(device);
    let recorded = counter.step(device, &device.graphics, 0, (None, None));
    let first = device.graphics.submit(&recorded, &[]).unwrap();
    let second = device.graphics.submit(&recorded, &[&first]).unwrap();
    assert!(first.reached().unwrap(), "the second submission waits for the first, on the host");
    second.wait().unwrap();
    let found = words(&counter.numbers.read().unwrap());
    assert!(found.iter().enumerate().all(|(i, &x)| x == 9 * i as u32));
}

fn what_a_recording_uses_outlives_its_owner(device: &Arc<Device>) {
    let counter = Counter::new(device);
    let result = buffer(device, "result", counter.numbers.bytes(), Place::Readback);
    let mut commands = Commands::begin(device, &device.graphics, "orphaned").unwrap();
    commands.bind_compute(&counter.pipeline, &counter.set);
    commands.push(&counter.pipeline.layout, &7_u32.to_ne_bytes());
    commands.dispatch([(COUNT as u32).div_ceil(64), 1, 1]);
    commands.buffer_barrier(&counter.numbers, COMPUTE, COPY_READ);
    commands.copy_buffer(&counter.numbers, 0, &result, 0, counter.numbers.bytes());
    drop(counter);
    let recorded = commands.finish().unwrap();
    let submission = device.graphics.submit(&recorded, &[]).unwrap();
    drop(recorded);
    assert!(submission.reached().unwrap(), "dropping a recording waits for it");
    assert_counted(&result, 7..8);
}

/// A driver used to crash here: it looked at semaphores that were gone when the host thought a submission ended.
fn hundreds_of_hand_overs_with_drops_right_behind(_: &Arc<Device>) {
    const STEPS: u32 = 400;
    with_both(|device| {
        let counter = Counter::new(device);
        let queues = [&device.graphics, &device.compute];
        // Up to three are on their way at once; each is dropped when its turn comes, with the point it reached.
        let mut running: VecDeque<Recorded> = VecDeque::new();
        let mut before = None;
        for term in 0..STEPS {
            let [queue, other] = if term % 2 == 0 { queues } else { [queues[1], queues[0]] };
            let from = (term > 0).then_some(other);
            let recorded = counter.step(device, queue, term, (from, Some(other)));
            let after: Vec<_> = before.iter().collect();
            let submission = queue.submit(&recorded, &after).unwrap();
            before = Some(submission);
            running.push_back(recorded);
            if running.len() > (term % 4) as usize {
                running.pop_front();
            }
        }
        drop(running);
        before.unwrap().wait().unwrap();
        assert_counted(&counter.numbers, 0..STEPS);
    });
}
