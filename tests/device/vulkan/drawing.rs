//! Render passes, pipelines, and which fragments pass.

use std::sync::Arc;

use depthleap::vulkan::{
    Blend, Buffer, BufferInfo, DepthState, Device, Framebuffer, Place, QueryKind, QueryPool, RenderPass, Role, vk,
};

use super::canvas::{Canvas, Stroke, pass_info, reading_pass_info, rectangle};
use super::kit::{misuse, refused, run};
use crate::harness::{Need, Test, test, tests};

pub fn all() -> Vec<Test> {
    let mut all = tests![
        role_that_does_not_fit_its_format_is_refused,
        second_depth_attachment_is_refused,
        images_that_do_not_fit_their_attachments_are_refused,
        missing_clear_value_is_refused,
        area_outside_the_framebuffer_is_refused,
        depth_test_without_depth_attachment_is_refused,
        colour_lands_inside_the_scissor,
        over_is_front_to_back,
        fragments_read_what_they_blend_into,
        colour_that_is_read_too_in_another_layout_is_refused,
        viewport_depth_is_stored_to_the_bit,
        occlusion_queries_count_every_sample,
        occlusion_queries_count_what_passes_the_depth_test,
        early_read_only_test_keeps_the_depth,
    ];
    all.push(test("depth_bounds_include_both_ends", depth_bounds_include_both_ends).needs(Need::DepthBounds));
    all.push(test("bounds_out_of_order_are_refused", bounds_out_of_order_are_refused).needs(Need::DepthBounds));
    all.push(test("bounds_without_the_feature_are_refused", bounds_are_refused).needs(Need::NoDepthBounds));
    all.push(test("conditional_draw_is_skipped_at_zero", conditional_draw).needs(Need::Conditional));
    all
}

/// 0.25, 0.5, 0.75: exact in every format and sum.
const PAINT: [f32; 4] = [0.25, 0.5, 0.75, 0.5];
const NOTHING: [f32; 4] = [0.0; 4];

fn stroke(canvas: &Canvas) -> Stroke {
    Stroke { color: PAINT, depth: 0.5, area: canvas.area() }
}

fn role_that_does_not_fit_its_format_is_refused(device: &Arc<Device>) {
    let mut info = pass_info();
    info.attachments[0].role = Role::Depth;
    info.attachments.remove(1);
    refused(RenderPass::new(device, info), &["canvas pass", "color is R32G32B32A32_SFLOAT but has role Depth"]);
    let mut info = pass_info();
    info.attachments[1].role = Role::Color;
    refused(RenderPass::new(device, info), &["canvas pass", "depth is D32_SFLOAT but has role Color"]);
}

fn second_depth_attachment_is_refused(device: &Arc<Device>) {
    let mut info = pass_info();
    info.attachments[0] = info.attachments[1].clone();
    refused(RenderPass::new(device, info), &["canvas pass", "more than one depth attachment"]);
}

fn images_that_do_not_fit_their_attachments_are_refused(device: &Arc<Device>) {
    let canvas = Canvas::new(device, [4, 3]);
    let framed = |images: &[_], extent| Framebuffer::new(device, "frame", &canvas.pass, images, extent);
    refused(framed(&[&canvas.color], [4, 3]), &["frame", "1 images for 2 attachments of canvas pass"]);
    refused(framed(&[&canvas.depth, &canvas.color], [4, 3]), &["frame", "depth (D32_SFLOAT", "attachment color"]);
    refused(framed(&[&canvas.color, &canvas.depth], [4, 4]), &["frame", "4 x 3 x 1) does not fit"]);
    refused(framed(&[&canvas.color, &canvas.depth], [0, 3]), &["frame", "0 x 3 pixels"]);
}

fn missing_clear_value_is_refused(device: &Arc<Device>) {
    let canvas = Canvas::new(device, [4, 3]);
    let mut info = pass_info();
    info.attachments[1].load = vk::AttachmentLoadOp::CLEAR;
    let pass = RenderPass::new(device, info).unwrap();
    let clears = [vk::ClearValue::default()];
    let begun =
        misuse(device, |commands| commands.begin_render_pass(&pass, &canvas.framebuffer, canvas.area(), &clears));
    refused(begun, &["canvas pass", "1 clear values, 2 are needed"]);
}

fn area_outside_the_framebuffer_is_refused(device: &Arc<Device>) {
    let canvas = Canvas::new(device, [4, 3]);
    for (offset, extent) in [([1, 0], [4, 3]), ([0, 0], [4, 4]), ([-1, 0], [2, 2]), ([1, 1], [u32::MAX, 1])] {
        let area = rectangle(offset, extent);
        let begun = misuse(device, |commands| commands.begin_render_pass(&canvas.pass, &canvas.framebuffer, area, &[]));
        refused(begun, &["canvas pass", "of 4 x 3 pixels"]);
    }
}

fn depth_test_without_depth_attachment_is_refused(device: &Arc<Device>) {
    let mut canvas = Canvas::new(device, [4, 3]);
    let mut info = pass_info();
    info.attachments.remove(1);
    canvas.pass = RenderPass::new(device, info).unwrap();
    let test = DepthState { test: true, ..DepthState::OFF };
    refused(canvas.painter(device, test, Blend::Replace), &["painter", "canvas pass, which has no depth attachment"]);
}

fn colour_lands_inside_the_scissor(device: &Arc<Device>) {
    let canvas = Canvas::new(device, [4, 3]);
    let pipeline = canvas.painter(device, DepthState::OFF, Blend::Replace).unwrap();
    let inside = Stroke { area: rectangle([1, 1], [2, 2]), ..stroke(&canvas) };
    run(device, "paint", |commands| canvas.draw(device, commands, &pipeline, inside, |c, draw| draw(c)));
    let expected =
        [[NOTHING, NOTHING, NOTHING, NOTHING], [NOTHING, PAINT, PAINT, NOTHING], [NOTHING, PAINT, PAINT, NOTHING]];
    assert_eq!(canvas.colors(device), expected.concat());
}

fn over_is_front_to_back(device: &Arc<Device>) {
    let canvas = Canvas::new(device, [2, 1]);
    let pipeline = canvas.painter(device, DepthState::OFF, Blend::Over).unwrap();
    let behind = Stroke { color: [1.0, 0.0, 0.5, 1.0], ..stroke(&canvas) };
    run(device, "paint", |commands| {
        for stroke in [stroke(&canvas), behind, behind] {
            canvas.draw(device, commands, &pipeline, stroke, |c, draw| draw(c));
        }
    });
    // Half of what lies behind an opacity of 1/2, and nothing of what lies behind that.
    assert_eq!(canvas.colors(device), [[0.25 + 0.5, 0.5, 0.75 + 0.25, 1.0]; 2]);
}

fn fragments_read_what_they_blend_into(device: &Arc<Device>) {
    let canvas = Canvas::of_pass(device, [5, 3], reading_pass_info());
    let pipeline = canvas.adder(device, Blend::Over).unwrap();
    let half = Stroke { area: rectangle([0, 0], [2, 3]), ..stroke(&canvas) };
    run(device, "add", |commands| {
        for stroke in [stroke(&canvas), half] {
            canvas.draw(device, commands, &pipeline, stroke, |c, draw| draw(c));
        }
    });
    // First the paint itself; then, to the left, twice the paint under it.
    let twice = PAINT.map(|c| c + 0.5 * (2.0 * c));
    assert_eq!(canvas.colors(device), [[twice, twice, PAINT, PAINT, PAINT]; 3].concat());
}

fn colour_that_is_read_too_in_another_layout_is_refused(device: &Arc<Device>) {
    let mut info = reading_pass_info();
    info.attachments[0].during = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    refused(RenderPass::new(device, info), &["canvas pass", "color is drawn into and read in", "not GENERAL"]);
}

fn viewport_depth_is_stored_to_the_bit(device: &Arc<Device>) {
    let canvas = Canvas::new(device, [3, 2]);
    let write = DepthState { test: true, write: true, ..DepthState::OFF };
    let pipeline = canvas.painter(device, write, Blend::Replace).unwrap();
    for depth in [0.0, 1.0, 1.0 / 3.0, 0.1, 7.0 / 26.0] {
        let at = Stroke { depth, ..stroke(&canvas) };
        run(device, "paint", |commands| canvas.draw(device, commands, &pipeline, at, |c, draw| draw(c)));
        assert_eq!(canvas.depths(device), [depth; 6]);
    }
}

/// Fragments that pass when `strokes` are drawn, one query each.
fn counted(device: &Arc<Device>, canvas: &Canvas, depth: DepthState, strokes: &[Stroke]) -> Vec<u64> {
    let pipeline = canvas.painter(device, depth, Blend::Replace).unwrap();
    let pool = QueryPool::new(device, "passed", QueryKind::Occlusion, strokes.len() as u32).unwrap();
    run(device, "count", |commands| {
        commands.reset_queries(&pool, 0..strokes.len() as u32);
        for (i, &stroke) in strokes.iter().enumerate() {
            canvas.draw(device, commands, &pipeline, stroke, |commands, draw| {
                commands.begin_query(&pool, i as u32);
                draw(commands);
                commands.end_query(&pool, i as u32);
            });
        }
    });
    pool.read(0..strokes.len() as u32).unwrap()
}

fn occlusion_queries_count_every_sample(device: &Arc<Device>) {
    assert!(device.info.occlusion_precise, "fragments are counted, not only seen");
    let canvas = Canvas::new(device, [61, 47]);
    // Whole, single pixels, edges and odd sides, and nothing at all.
    let areas = [[0, 0, 61, 47], [60, 46, 1, 1], [0, 0, 1, 47], [3, 5, 7, 11], [17, 1, 2, 1], [4, 4, 0, 9]];
    let strokes = areas.map(|[x, y, w, h]| Stroke { area: rectangle([x, y], [w as u32, h as u32]), ..stroke(&canvas) });
    let expected: Vec<u64> = areas.iter().map(|[_, _, w, h]| (w * h) as u64).collect();
    assert_eq!(counted(device, &canvas, DepthState::OFF, &strokes), expected);
}

/// 8 columns and 3 rows with depths 0, 1/8, 2/8 ... 7/8 from left to right.
fn staircase(device: &Arc<Device>) -> Canvas {
    let canvas = Canvas::new(device, [8, 3]);
    let depths: Vec<f32> = (0..24).map(|i| (i % 8) as f32 / 8.0).collect();
    canvas.set_depth(device, &depths);
    canvas
}

fn occlusion_queries_count_what_passes_the_depth_test(device: &Arc<Device>) {
    let canvas = staircase(device);
    let test = DepthState { test: true, compare: vk::CompareOp::GREATER_OR_EQUAL, ..DepthState::OFF };
    let at = |depth| Stroke { depth, ..stroke(&canvas) };
    let between = 2.5 / 8.0;
    // Columns whose stored depth is not greater: 1 of 8 at 0, 3 at 2/8 and just above, all at 1.
    let strokes = [at(0.0), at(0.25), at(between), at(1.0)];
    assert_eq!(counted(device, &canvas, test, &strokes), [3, 9, 9, 24]);
}

fn early_read_only_test_keeps_the_depth(device: &Arc<Device>) {
    let canvas = staircase(device);
    let before = canvas.depths(device);
    let test = DepthState { test: true, compare: vk::CompareOp::GREATER_OR_EQUAL, ..DepthState::OFF };
    counted(device, &canvas, test, &[stroke(&canvas)]);
    assert_eq!(canvas.depths(device), before);
    // Stored 0 to 4/8 is not greater than the 4/8 drawn at.
    let row = [PAINT, PAINT, PAINT, PAINT, PAINT, NOTHING, NOTHING, NOTHING];
    assert_eq!(canvas.colors(device), [row; 3].concat());
}

fn depth_bounds_include_both_ends(device: &Arc<Device>) {
    let bounded = DepthState { test: true, bounds: true, ..DepthState::OFF };
    // Stored 2/8, 3/8 and 4/8 lie in [2/8, 4/8]; one rounding off either end leaves that end's column out.
    let below = |depth: f32| f32::from_bits(depth.to_bits() - 1);
    let above = |depth: f32| f32::from_bits(depth.to_bits() + 1);
    for (min, max, columns) in [
        (0.25, 0.5, 2..5),
        (above(0.25), 0.5, 3..5),
        (0.25, below(0.5), 2..4),
        (0.0, 1.0, 0..8),
        (0.0, 0.0, 0..1),
        (0.9, 1.0, 8..8),
    ] {
        let canvas = staircase(device);
        let before = canvas.depths(device);
        let pipeline = canvas.painter(device, bounded, Blend::Replace).unwrap();
        let pool = QueryPool::new(device, "passed", QueryKind::Occlusion, 1).unwrap();
        run(device, "bounded", |commands| {
            commands.reset_queries(&pool, 0..1);
            canvas.draw(device, commands, &pipeline, stroke(&canvas), |commands, draw| {
                commands.depth_bounds(min, max);
                commands.begin_query(&pool, 0);
                draw(commands);
                commands.end_query(&pool, 0);
            });
        });
        let row: [[f32; 4]; 8] = std::array::from_fn(|i| if columns.contains(&i) { PAINT } else { NOTHING });
        assert_eq!(canvas.colors(device), [row; 3].concat(), "bounds {min}..{max}");
        assert_eq!(pool.read(0..1).unwrap(), [3 * columns.len() as u64], "bounds {min}..{max}");
        assert_eq!(canvas.depths(device), before, "the test writes nothing");
    }
}

fn bounds_out_of_order_are_refused(device: &Arc<Device>) {
    for (min, max) in [(0.5, 0.25), (-0.1, 0.5), (0.5, 1.1), (f32::NAN, 1.0)] {
        refused(misuse(device, |commands| commands.depth_bounds(min, max)), &["misuse", "depth bounds"]);
    }
}

fn bounds_are_refused(device: &Arc<Device>) {
    let canvas = Canvas::new(device, [4, 3]);
    let bounded = DepthState { test: true, bounds: true, ..DepthState::OFF };
    let made = canvas.painter(device, bounded, Blend::Replace);
    refused(made, &["painter", &device.info.name, "has no depth bounds test"]);
}

fn conditional_draw(device: &Arc<Device>) {
    let canvas = Canvas::new(device, [4, 3]);
    let pipeline = canvas.painter(device, DepthState::OFF, Blend::Replace).unwrap();
    let usage = vk::BufferUsageFlags::CONDITIONAL_RENDERING_EXT;
    let info = BufferInfo { name: "predicates".to_owned(), size: 12, usage, place: Place::Upload };
    let predicates = Buffer::new(device, info).unwrap();
    predicates.write(0, bytemuck::cast_slice(&[0_u32, 1, 256])).unwrap();
    let pool = QueryPool::new(device, "passed", QueryKind::Occlusion, 3).unwrap();
    run(device, "conditional", |commands| {
        commands.reset_queries(&pool, 0..3);
        for i in 0..3 {
            canvas.draw(device, commands, &pipeline, stroke(&canvas), |commands, draw| {
                commands.begin_query(&pool, i);
                commands.begin_conditional(&predicates, 4 * u64::from(i));
                draw(commands);
                commands.end_conditional();
                commands.end_query(&pool, i);
            });
        }
    });
    assert_eq!(pool.read(0..3).unwrap(), [0, 12, 12]);
    let beyond = misuse(device, |commands| commands.begin_conditional(&predicates, 12));
    refused(beyond, &["predicates", "4 bytes at 12 of 12"]);
}
