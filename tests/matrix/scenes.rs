//! The scenes of the matrix: tiny ones, of which each differs from the first by what a frame may have or lack.
//!
//! A new feature is given its scenes here, and nowhere else: a test asks that some have it and some lack it. A new
//! projection has its scene by itself.

mod parts;

use std::sync::Arc;

use depthleap::projection::{AVERAGE, MINIP, MIP, PROJECTIONS};
use depthleap::read;
use depthleap::scene::backdrop::Pattern;
use depthleap::scene::environment::Picture;
use depthleap::scene::field::NanPolicy;
use depthleap::scene::mesh::Keep;
use depthleap::scene::settings::{
    Alpha, Classification, ClipSettings, Filter, Find, GradientOperator, GradientTexture, Last, LightSettings, Mapping,
    MeshSettings, Offset, PartialSegments, Refine, Settings, ShellMode, ShellSum, Shows, SurfaceLevel, Tiles,
    Translucency, VolumeTexture,
};
use depthleap::scene::{Backdrop, Effect, Environment, Scene};
use glam::{DQuat, EulerRot};

use parts::{JUMPS, NO_DATA, across, clip, clip_volume, cuboid, gradients, index, level, plane, sheet, two_lights};
pub use parts::{by, forms, methods, views};

type Change = fn(&mut Settings);

/// Opacity in every cell: nothing can be skipped.
const EVERYWHERE: [[f64; 5]; 1] = [[0.5, 0.9, 0.5, 0.1, 0.3]];

/// What each scene changes of the first.
const KINDS: [(&str, Change); 95] = [
    ("as it is", |_| {}),
    ("no colours", |s| preset(s, "ramp")),
    ("nothing to skip", |s| s.transfer.points = Some(EVERYWHERE.to_vec())),
    ("no ray that ends", |s| s.sampling.termination = 1.0),
    ("nothing to skip and no ray that ends", |s| {
        s.transfer.points = Some(EVERYWHERE.to_vec());
        s.sampling.termination = 1.0;
    }),
    // More passes than a batch of them: rays that are left are counted.
    ("many passes", |s| s.sampling.samples_per_pass = 2),
    ("many passes in live tiles", |s| {
        preset(s, "surface");
        (s.sampling.samples_per_pass, s.method.tiles) = (2, Tiles::Live);
    }),
    ("an iso-surface in live tiles", |s| (s.surface.iso, s.method.tiles) = (Some(90.0), Tiles::Live)),
    ("a single pass", |s| s.sampling.samples_per_pass = 64),
    ("more passes than samples", |s| s.sampling.passes = 9),
    // No slice but the first lies in a face between cells by these steps: rounding would decide who is asked.
    ("opacities for another step", |s| s.sampling.step = 0.73),
    ("opacities as they stand", |s| (s.sampling.step, s.sampling.alpha) = (0.73, Alpha::Paper)),
    ("a last sample of its own length", |s| {
        (s.sampling.offset, s.sampling.last) = (Offset::Midpoint, Last::Partial);
        s.sampling.step = 1.3;
    }),
    ("no sample for a step that would leave the volume", |s| (s.sampling.last, s.sampling.step) = (Last::None, 1.3)),
    ("steps classified as a whole", |s| {
        (s.sampling.classification, s.sampling.step) = (Classification::PreIntegrated, 1.7);
    }),
    ("parts of steps classified as a whole", |s| {
        (s.sampling.classification, s.sampling.last) = (Classification::PreIntegrated, Last::Partial);
    }),
    ("nearest voxels", |s| (s.sampling.filter, s.sampling.step) = (Filter::Nearest, 0.93)),
    // How far a texture unit is off, plans state of a picture; where a ray ends by it nobody can tell.
    ("the texture unit", |s| {
        (s.sampling.filter, s.volume.texture) = (Filter::Hardware, VolumeTexture::Auto);
        s.sampling.termination = 1.0;
    }),
    ("holes", |s| (s.volume.no_data, s.volume.nan) = (vec![NO_DATA], NanPolicy::Hole)),
    ("extra fetches", |s| s.sampling.extra_fetches = 2),
    ("larger cells", |s| s.method.cell = 2),
    ("other ways to look ahead", |s| {
        (s.method.block_first, s.method.exit_lookahead) = (true, false);
        s.method.lookups = s.sampling.samples_per_pass;
    }),
    ("nothing left out", |s| s.method.planner = false),
    ("an orthographic view", |s| s.camera.height = Some(1.1)),
    ("an orthographic view along an axis", |s| {
        (s.camera.eye, s.camera.target, s.camera.height) = ([0.0, 0.0, 1.0], [0.0; 3], Some(1.3));
        // All rays are 20 voxels long, which is no whole number of these.
        s.sampling.step = 0.93;
    }),
    ("an orthographic view of boxes and what planes leave", |s| {
        s.meshes = vec![cuboid(0.6, 0.4), MeshSettings { translate: [0.3, -0.1, 0.2], ..cuboid(0.3, 1.0) }];
        s.clips = vec![plane([1.0, 0.3, -0.2, 0.1]), clip(0.7, Keep::Inside)];
        s.camera.height = Some(1.2);
    }),
    ("least values in an orthographic view that a plane cuts", |s| {
        (s.projection.kind, s.camera.height) = (MINIP.name(), Some(1.2));
        s.clips = vec![plane([1.0, 0.3, -0.2, 0.1])];
    }),
    ("a transfer function of many points", |s| {
        let point =
            |i: u32| [f64::from(i) / 24.0, 0.04 * f64::from(i), 0.5, 0.2, if i.is_multiple_of(5) { 0.0 } else { 0.3 }];
        s.transfer.points = Some((0..=24).map(point).collect());
    }),
    ("a slice for each texture of a stack", |s| s.method.between = false),
    ("an orthographic view of an iso-surface", |s| (s.surface.iso, s.camera.height) = (Some(90.0), Some(1.1))),
    ("shells, the greatest by depth, with a box among them", |s| {
        (s.shells.mode, s.shells.a, s.shells.b, s.shells.count) = (Some(ShellMode::Max), 0.7, 0.4, 3);
        s.meshes = vec![across(1.0)];
    }),
    ("shells, the sum of ways, with a box among them, in an orthographic view", |s| {
        (s.shells.mode, s.shells.beta0, s.shells.a, s.shells.count) = (Some(ShellMode::Sum), 0.2, 0.5, 2);
        (s.meshes, s.camera.height) = (vec![across(1.0)], Some(1.2));
    }),
    ("shells, the sum of crossings, with a box among them, at holes", |s| {
        (s.volume.no_data, s.volume.nan) = (vec![NO_DATA], NanPolicy::Hole);
        (s.shells.mode, s.shells.sum, s.shells.a) = (Some(ShellMode::Sum), ShellSum::Crossings, 0.5);
        (s.shells.count, s.meshes) = (2, vec![across(1.0)]);
    }),
    ("shells, the outermost one in light, with a box through it", |s| {
        (s.shells.mode, s.shells.shell_levels) = (Some(ShellMode::Surface), vec![90.0, 150.0]);
        s.meshes = vec![across(1.0)];
    }),
    ("cells of a ring", |s| s.volume.builtin = Some("tets-torus:1".to_owned())),
    ("cells of a ball, without colours and ends, in an orthographic view", |s| {
        (s.volume.builtin, s.camera.height) = (Some("tets-ball:1".to_owned()), Some(1.1));
        s.sampling.termination = 1.0;
        preset(s, "ramp");
    }),
    ("the greatest value of cells", |s| {
        (s.volume.builtin, s.projection.kind) = (Some("tets-torus:1".to_owned()), MIP.name());
    }),
    ("cells by a table of ways", |s| {
        s.volume.builtin = Some("tets-torus:1".to_owned());
        (s.sampling.classification, s.sampling.table) = (Classification::PreIntegrated, 9);
    }),
    ("cells under a transfer function of many points", |s| {
        s.volume.builtin = Some("tets-ball:1".to_owned());
        let point =
            |i: u32| [f64::from(i) / 24.0, 0.04 * f64::from(i), 0.5, 0.2, if i.is_multiple_of(5) { 0.0 } else { 0.3 }];
        s.transfer.points = Some((0..=24).map(point).collect());
    }),
    ("a surface of cells in light", |s| {
        (s.volume.builtin, s.surface.iso) = (Some("tets-torus:1".to_owned()), Some(0.5));
    }),
    ("surfaces of cells within their colours, by a table of ways", |s| {
        s.volume.builtin = Some("tets-ball:1".to_owned());
        (s.sampling.classification, s.sampling.table) = (Classification::PreIntegrated, 9);
        s.surface.volume = true;
        s.surface.levels = vec![SurfaceLevel { opacity: 0.4, ..level(0.5, [0.9, 0.6, 0.3]) }];
    }),
    // Steps of lengths that many places allow, and more passes than rays need.
    ("adaptive steps", |s| {
        (s.adaptive.importance, s.adaptive.tolerance, s.adaptive.shortest) = (true, 0.05, 0.5);
    }),
    ("adaptive steps without colours and ends, cut by a plane in an orthographic view", |s| {
        (s.adaptive.importance, s.adaptive.shortest, s.adaptive.longest) = (true, 0.7, 5.0);
        (s.sampling.termination, s.camera.height) = (1.0, Some(1.2));
        s.clips = vec![plane([1.0, 0.3, -0.2, 0.1])];
        preset(s, "ramp");
    }),
    ("a corner in sight", |s| s.camera.target = [-0.6, -0.5, 0.0]),
    ("a transparent box", |s| s.meshes = vec![cuboid(0.5, 0.4)]),
    ("an opaque box", |s| s.meshes = vec![cuboid(0.45, 1.0)]),
    ("boxes that cut each other and the volume's faces", |s| {
        s.meshes =
            vec![cuboid(0.9, 0.3), across(0.5), MeshSettings { translate: [0.3, -0.1, 0.2], ..cuboid(0.3, 1.0) }];
        (s.sampling.last, s.sampling.offset, s.layers.most) = (Last::Partial, Offset::Midpoint, 3);
    }),
    ("segments that end at a surface, drawn apart", |s| {
        s.meshes = vec![cuboid(0.6, 0.4), MeshSettings { translate: [0.3, -0.1, 0.2], ..cuboid(0.3, 1.0) }];
        (s.layers.partial, s.layers.most) = (PartialSegments::Apart, 2);
    }),
    // Rays end at surfaces only: what was drawn before is of no matter to decisions, and frames begin empty all the same.
    ("surfaces, and no ray that ends", |s| {
        s.meshes = vec![cuboid(0.6, 0.4), MeshSettings { translate: [0.3, -0.1, 0.2], ..cuboid(0.3, 1.0) }];
        (s.layers.partial, s.layers.most, s.sampling.termination) = (PartialSegments::Apart, 2, 1.0);
    }),
    ("what is inside of a box", |s| s.clips = vec![clip(0.6, Keep::Inside)]),
    ("what is outside of boxes that the eye is in", |s| {
        s.clips = vec![clip(0.4, Keep::Outside), ClipSettings { scale: 1.9, ..clip(0.3, Keep::Outside) }];
        s.clips[1].translate = s.camera.eye;
        (s.meshes, s.layers.most) = (vec![cuboid(0.5, 0.4)], 3);
    }),
    ("what is behind the first surface of a box", |s| {
        (s.clips, s.meshes) = (vec![clip(0.8, Keep::Thesis)], vec![across(0.5)]);
    }),
    ("planes", |s| s.clips = vec![plane([1.0, 0.2, 0.1, 0.15]), plane([-0.3, 0.9, -0.2, 0.3])]),
    ("a plane that cuts nothing off", |s| s.clips = vec![plane([0.0, 1.0, 0.0, 0.7])]),
    ("a plane, meshes and clip geometry", |s| {
        s.clips = vec![clip(0.9, Keep::Inside), plane([0.3, -0.2, -1.0, 0.1])];
        (s.meshes, s.layers.most) = (vec![cuboid(0.5, 0.4), across(1.0)], 4);
        (s.sampling.last, s.sampling.offset) = (Last::Partial, Offset::Midpoint);
    }),
    ("planes, and values in place of colours", |s| {
        s.clips = vec![plane([1.0, 0.2, 0.1, 0.15]), plane([0.1, -0.3, -1.0, 0.2])];
        s.projection.kind = MIP.name();
    }),
    ("a plane, and what is behind the first surface of a box", |s| {
        s.clips = vec![clip(0.8, Keep::Thesis), plane([0.5, 0.2, -1.0, 0.2])];
        s.meshes = vec![across(0.5)];
    }),
    ("what is inside of a clip volume", |s| s.clips = vec![clip_volume(Keep::Inside)]),
    ("values outside of a clip volume, with holes", |s| {
        (s.clips, s.projection.kind) = (vec![clip_volume(Keep::Outside)], AVERAGE.name());
        (s.volume.no_data, s.volume.nan) = (vec![NO_DATA], NanPolicy::Hole);
    }),
    ("an iso-surface outside of a clip volume, to the root, with a plane and a mesh", |s| {
        (s.surface.iso, s.surface.refine) = (Some(90.0), Refine::Exact);
        s.clips = vec![clip_volume(Keep::Outside), plane([0.3, -0.2, -1.0, 0.25])];
        s.meshes = vec![cuboid(0.5, 0.4)];
    }),
    ("transparent iso-surfaces in the volume outside of a clip volume, classified as a whole", |s| {
        s.surface.levels = vec![sheet(150.0, [0.9, 0.2, 0.1], 0.5), sheet(60.0, [0.2, 0.8, 0.3], 0.3)];
        (s.surface.volume, s.sampling.classification) = (true, Classification::PreIntegrated);
        s.clips = vec![clip_volume(Keep::Outside)];
    }),
    ("an iso-surface", |s| s.surface.iso = Some(90.0)),
    ("iso-surfaces in colours and coloured light, to the root", |s| {
        s.surface.levels = vec![level(150.0, [0.9, 0.2, 0.1]), level(60.0, [0.2, 0.8, 0.3])];
        s.surface.refine = Refine::Exact;
        s.lights = two_lights();
    }),
    ("a range of values, where samples are", |s| {
        (s.surface.iso, s.surface.find, s.surface.iso_width) = (Some(120.0), Find::Range, Some(70.0));
        (s.surface.refine, s.sampling.step) = (Refine::None, 0.7);
    }),
    ("an iso-surface, and no ray that ends", |s| {
        (s.surface.iso, s.sampling.termination, s.sampling.samples_per_pass) = (Some(90.0), 1.0, 3);
    }),
    ("an iso-surface, nothing left out", |s| (s.surface.iso, s.method.planner) = (Some(90.0), false)),
    ("an iso-surface, meshes, a plane and clip geometry", |s| {
        (s.surface.iso, s.surface.refine) = (Some(90.0), Refine::Exact);
        s.clips = vec![clip(0.9, Keep::Inside), plane([0.3, -0.2, -1.0, 0.1])];
        (s.meshes, s.layers.most) = (vec![cuboid(0.5, 0.4), across(1.0)], 4);
    }),
    ("an iso-surface, and segments that end at a mesh, drawn apart", |s| {
        (s.surface.iso, s.layers.partial, s.layers.most) = (Some(90.0), PartialSegments::Apart, 2);
        s.meshes = vec![cuboid(0.6, 0.4), MeshSettings { translate: [0.3, -0.1, 0.2], ..cuboid(0.3, 1.0) }];
    }),
    ("an iso-surface that reflects the sky", |s| {
        (s.surface.iso, s.environment.builtin) = (Some(90.0), Some("sky".to_owned()));
    }),
    ("an iso-surface that reflects its polygons, refined to the root", |s| {
        (s.surface.iso, s.surface.refine) = (Some(90.0), Refine::Exact);
        (s.environment.builtin, s.environment.reflectivity) = (Some("polygons".to_owned()), 0.3);
        s.meshes = vec![MeshSettings { translate: [0.3, -0.1, 0.2], ..cuboid(0.3, 1.0) }];
    }),
    ("transparent iso-surfaces", |s| {
        s.surface.levels = vec![sheet(150.0, [0.9, 0.2, 0.1], 0.5), sheet(60.0, [0.2, 0.8, 0.3], 0.3)];
        s.lights = two_lights();
    }),
    ("transparent iso-surfaces to the root, with a mesh and a plane", |s| {
        s.surface.levels = vec![sheet(150.0, [0.9, 0.2, 0.1], 1.0), sheet(60.0, [0.2, 0.8, 0.3], 0.3)];
        (s.surface.refine, s.sampling.step) = (Refine::Exact, 1.7);
        (s.meshes, s.clips) = (vec![cuboid(0.5, 0.4)], vec![plane([0.3, -0.2, -1.0, 0.1])]);
    }),
    ("an iso-surface in the volume", |s| (s.surface.iso, s.surface.volume) = (Some(150.0), true)),
    ("transparent iso-surfaces in the volume, classified as a whole", |s| {
        s.surface.levels = vec![sheet(150.0, [0.9, 0.2, 0.1], 0.5), sheet(60.0, [0.2, 0.8, 0.3], 0.3)];
        (s.surface.volume, s.sampling.classification) = (true, Classification::PreIntegrated);
        (s.sampling.step, s.surface.refine) = (1.3, Refine::None);
    }),
    ("an iso-surface that shades itself", |s| {
        (s.surface.iso, s.effects.shadows, s.lights) = (Some(90.0), true, two_lights());
        s.clips = vec![plane([0.3, -0.2, -1.0, 0.1])];
    }),
    ("a translucent iso-surface", |s| {
        (s.surface.iso, s.lights) = (Some(90.0), two_lights());
        s.effects.translucency = Some(Translucency { absorption: 3.0, part: 0.7 });
    }),
    ("translucent and transparent iso-surfaces in the shadow of each other", |s| {
        s.surface.levels = vec![sheet(150.0, [0.9, 0.2, 0.1], 0.5), sheet(60.0, [0.2, 0.8, 0.3], 0.3)];
        (s.surface.refine, s.effects.shadows, s.lights) = (Refine::Exact, true, two_lights());
        s.effects.translucency = Some(Translucency { absorption: 2.0, part: 0.4 });
    }),
    ("places of an iso-surface", |s| {
        (s.surface.iso, s.surface.refine, s.surface.shows) = (Some(90.0), Refine::Exact, Shows::Position);
        s.clips = vec![plane([0.3, -0.2, -1.0, 0.1])];
    }),
    ("normals of an iso-surface", |s| {
        (s.surface.iso, s.surface.shows, s.lights) = (Some(90.0), Shows::Normal, two_lights());
    }),
    ("samples in white light", |s| {
        s.lights = vec![LightSettings { direction: Some([-3.0, 2.0, 1.0]), ..Default::default() }];
    }),
    ("samples in coloured lights, with a mesh", |s| {
        s.lights = two_lights();
        (s.sampling.last, s.meshes) = (Last::Partial, vec![cuboid(0.5, 0.4)]);
    }),
    ("samples in light, by gradients in a texture", |s| {
        s.lights = vec![LightSettings { direction: Some([-3.0, 2.0, 1.0]), ..Default::default() }];
        s.shading = gradients(GradientOperator::Central, GradientTexture::Rgba16f);
    }),
    ("samples in light, by gradients in 8 bits, with opacities that jump", |s| {
        s.lights = vec![LightSettings { direction: Some([-3.0, 2.0, 1.0]), ..Default::default() }];
        s.shading = gradients(GradientOperator::Sobel, GradientTexture::Rgba8);
        // In f32, whose values 8 bits move across the jumps.
        s.volume.builtin = Some("gaussian:22x18x20".to_owned());
        s.transfer.points = Some(JUMPS.to_vec());
    }),
    ("samples in light, by gradients of the texture unit", |s| {
        s.lights = two_lights();
        s.shading = gradients(GradientOperator::Central, GradientTexture::Rgba8);
        (s.sampling.filter, s.volume.texture) = (Filter::Hardware, VolumeTexture::Auto);
        s.sampling.termination = 1.0;
    }),
    ("samples in light, by gradients at the nearest voxels", |s| {
        s.lights = vec![LightSettings { direction: Some([-3.0, 2.0, 1.0]), ..Default::default() }];
        s.shading = gradients(GradientOperator::Central, GradientTexture::Rgba32f);
        s.sampling.filter = Filter::Nearest;
    }),
    ("an iso-surface, by gradients in a texture", |s| {
        (s.surface.iso, s.surface.refine, s.lights) = (Some(90.0), Refine::Exact, two_lights());
        s.shading = gradients(GradientOperator::Sobel, GradientTexture::Rgba32f);
    }),
    ("an iso-surface, by gradients in 8 bits", |s| {
        s.surface.iso = Some(120.0);
        s.shading = gradients(GradientOperator::Central, GradientTexture::Rgba8);
    }),
    ("layers of steps classified as a whole", |s| {
        (s.meshes, s.sampling.classification) = (vec![across(0.5)], Classification::PreIntegrated);
        s.sampling.last = Last::Partial;
    }),
    ("rays that bend in front of a checker", |s| {
        s.effects.refraction = index(&[[0.25, 1.0], [1.0, 1.3]]);
        (s.effects.behind, s.effects.background_squares) = (Some("checker".into()), 5.0);
    }),
    ("rays that bend in light, cut by a plane", |s| {
        (s.effects.refraction, s.lights) = (index(&[[0.3, 1.0], [0.7, 0.8], [1.0, 1.2]]), two_lights());
        (s.clips, s.sampling.last) = (vec![plane([1.0, 0.2, 0.1, 0.15])], Last::Partial);
        s.sampling.offset = Offset::Midpoint;
    }),
    ("rays that bend, steps classified as a whole", |s| {
        s.effects.refraction = index(&[[0.25, 1.0], [1.0, 1.3]]);
        (s.sampling.classification, s.sampling.step) = (Classification::PreIntegrated, 1.7);
    }),
    ("an index of refraction that is the same everywhere, nothing left out", |s| {
        (s.effects.refraction, s.method.planner) = (index(&[[0.0, 1.2], [1.0, 1.2]]), false);
    }),
    ("an iso-surface in front of a checker", |s| {
        (s.surface.iso, s.effects.behind) = (Some(90.0), Some("checker".into()));
        s.effects.background_squares = 5.0;
    }),
    ("the texture unit in an orthographic view", |s| {
        (s.sampling.filter, s.volume.texture) = (Filter::Hardware, VolumeTexture::Auto);
        (s.sampling.termination, s.camera.height) = (1.0, Some(1.1));
    }),
    ("the texture unit, and a mesh that clips as in the thesis", |s| {
        (s.sampling.filter, s.volume.texture) = (Filter::Hardware, VolumeTexture::Auto);
        (s.sampling.termination, s.clips) = (1.0, vec![clip(0.4, Keep::Thesis)]);
    }),
];

fn preset(settings: &mut Settings, name: &str) {
    settings.transfer.points = None;
    settings.transfer.preset = Some(name.to_owned());
}

/// A scene with colours, empty space, empty blocks and rays that end, interpolated as exactly as its twin is.
fn settings(change: Change) -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:22x18x20".to_owned());
    settings.volume.texture = VolumeTexture::R32f;
    settings.transfer.points =
        Some(vec![[0.0, 0.2, 0.4, 1.0, 0.0], [0.25, 0.2, 0.4, 1.0, 0.0], [1.0, 1.0, 0.5, 0.1, 0.5]]);
    settings.image.size = [33, 25];
    // Not along any axis, edge or diagonal.
    settings.camera.eye = [0.8974, 0.6533, 1.2544];
    settings.sampling.filter = Filter::Exact;
    settings.sampling.samples_per_pass = 6;
    settings.sampling.termination = 0.6;
    change(&mut settings);
    settings
}

/// Every scene of the matrix, by name: every kind by the first projection, and the first kind by every other.
pub fn scenes() -> Vec<(String, Scene)> {
    let kinds = KINDS.into_iter().map(|(name, change)| (name, settings(change)));
    let projections = PROJECTIONS.into_iter().skip(1).map(|row| {
        let mut settings = settings(KINDS[0].1);
        settings.projection.kind = row.name();
        (row.name, settings)
    });
    let scene = |(name, settings): (&str, Settings)| (name.to_owned(), read::scene(&settings).expect("a sound scene"));
    kinds.chain(projections).map(scene).chain([mirror_ball(), picture_behind()]).chain(effects()).collect()
}

/// An iso-surface that reflects the picture of a mirror ball, unlike on each of its sides, in axes that are those of no volume.
fn mirror_ball() -> (String, Scene) {
    const SIDE: usize = 24;
    let mut scene = read::scene(&settings(|s| s.surface.iso = Some(90.0))).expect("a sound scene");
    let texel = |i: usize| {
        let [x, y] = [i % SIDE, i / SIDE].map(|at| (at as f32 + 0.5) / SIDE as f32);
        [x, y, 0.5 + 0.5 * x * y]
    };
    scene.environment = Some(Arc::new(Environment {
        picture: Picture { size: [SIDE; 2], texels: (0..SIDE * SIDE).map(texel).collect() },
        mapping: Mapping::Sphere,
        reflectivity: 0.4,
        turn: DQuat::from_euler(EulerRot::XYZ, 0.4, -0.7, 1.1),
        warnings: Vec::new(),
    }));
    ("an iso-surface that reflects a mirror ball, in turned axes".to_owned(), scene)
}

/// Rays that bend in front of a picture, unlike on each of its sides and of other sides than the view.
fn picture_behind() -> (String, Scene) {
    const SIZE: [usize; 2] = [9, 14];
    let mut scene =
        read::scene(&settings(|s| s.effects.refraction = index(&[[0.25, 1.0], [1.0, 1.3]]))).expect("a sound scene");
    let texel = |i: usize| {
        let [x, y] = [(i % SIZE[0]) as f32 / SIZE[0] as f32, (i / SIZE[0]) as f32 / SIZE[1] as f32];
        [x, y, 0.5 + 0.5 * x * y]
    };
    let picture = Picture { size: SIZE, texels: (0..SIZE[0] * SIZE[1]).map(texel).collect() };
    scene.backdrop = Some(Arc::new(Backdrop { pattern: Pattern::Picture(picture), distance: 0.4 }));
    ("rays that bend in front of a picture".to_owned(), scene)
}

/// Scenes with an effect that changes nothing, whose twins are those without.
fn effects() -> [(String, Scene); 3] {
    let effect = Effect::new("same.glsl", "vec4 effect(Sample here) { return here.color; }").expect("a sound effect");
    let with = |name: &str, change: Change| {
        let mut scene = read::scene(&settings(change)).expect("a sound scene");
        scene.effect = Some(Arc::new(effect.clone()));
        (name.to_owned(), scene)
    };
    [
        with("an effect on samples", |_| {}),
        with("an effect on samples in light, by gradients in a texture, with a mesh", |s| {
            (s.lights, s.meshes) = (two_lights(), vec![cuboid(0.5, 0.4)]);
            s.shading = gradients(GradientOperator::Central, GradientTexture::Rgba32f);
        }),
        with("an effect on an iso-surface", |s| s.surface.iso = Some(90.0)),
    ]
}
