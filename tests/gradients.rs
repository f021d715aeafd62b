//! Gradients in a texture: what texels hold, how far normals are from closed forms, that values beside gradients stay within what
//! structures allow for, and what is left out. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;
#[path = "random/mod.rs"]
mod random;

use depthleap::method::{METHODS, RC_ERT};
use depthleap::part::rows::Method;
use depthleap::plan::plan;
use depthleap::projection::Shown;
use depthleap::read;
use depthleap::resource::texels::Texels;
use depthleap::scene::gradients::GradientCoding;
use depthleap::scene::settings::{
    Filter, GradientOperator, GradientTexture, Gradients, LightSettings, Refine, Settings, VolumeTexture,
};
use depthleap::scene::texture::{TextureChoice, TextureMap};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Scene, Volume, builtin};
use depthleap::structure::cells::{Values, any_interesting};
use depthleap::structure::gradients::GradientTexels;
use drawn::drawn;
use glam::DVec3;
use random::Random;

const FORMATS: [GradientTexture; 3] = [GradientTexture::Rgba8, GradientTexture::Rgba16f, GradientTexture::Rgba32f];
const OPERATORS: [GradientOperator; 2] = [GradientOperator::Central, GradientOperator::Sobel];

fn settings(volume: &str, change: impl FnOnce(&mut Settings)) -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(volume.to_owned());
    settings.image.size = [60, 48];
    settings.camera.eye = [0.9, 0.65, 1.5];
    settings.sampling.filter = Filter::Exact;
    settings.shading.gradients = Gradients::Precomputed;
    settings.method.name = RC_ERT.name();
    change(&mut settings);
    settings
}

fn scene(volume: &str, change: impl FnOnce(&mut Settings)) -> Scene {
    read::scene(&settings(volume, change)).unwrap()
}

/// One light from above.
fn lit(settings: &mut Settings) {
    settings.lights = vec![LightSettings { direction: Some([0.3, 1.0, 0.5]), ..LightSettings::default() }];
}

fn texels(scene: &Scene) -> GradientTexels {
    let operator = scene.settings.shading.gradient;
    GradientTexels::new(&scene.field, &Texels::of(scene).values, operator, GradientCoding::of(scene))
}

/// Along the gradient, and the value as x.
fn decoded(texels: &GradientTexels, texel: [f32; 4]) -> (DVec3, f64) {
    let [x, y, z, beside] = texel.map(f64::from);
    let zero = if texels.coding.texture == GradientTexture::Rgba8 { 128.0 / 255.0 } else { 0.0 };
    let [times, plus] = texels.coding.to_x;
    (DVec3::new(x, y, z) - zero, times * beside + plus)
}

#[test]
fn ramp_has_one_gradient_and_its_own_values() {
    for texture in FORMATS {
        for gradient in OPERATORS {
            let scene = scene("linear:9x5x4", |s| {
                (s.surface.iso, s.shading.format, s.shading.gradient) = (Some(0.5), texture, gradient);
            });
            let made = texels(&scene);
            for (i, texel) in made.texels.iter().enumerate() {
                let (along, x) = decoded(&made, *texel);
                // The steepest there is, on the faces too.
                let whole = if texture == GradientTexture::Rgba8 { 127.0 / 255.0 } else { 1.0 };
                assert!(along.distance(whole * DVec3::X) < 1e-6, "{texture:?} {gradient:?}: {along}");
                let truth = f64::from(scene.field.values[i]);
                assert!((x - truth).abs() <= made.coding.slack + 1e-6, "{texture:?}: {x} for {truth}");
            }
        }
    }
}

#[test]
fn nothing_that_changes_has_no_gradient() {
    for texture in FORMATS {
        let scene = scene("constant:5", |s| (s.surface.iso, s.shading.format) = (Some(0.5), texture));
        let made = texels(&scene);
        assert!(made.texels.iter().all(|texel| decoded(&made, *texel).0.length() < 1e-6), "{texture:?}");
        // Ambient light alone, as without a texture.
        let (with, without) = (drawn(&scene).1, {
            let mut other = scene.clone();
            other.settings.shading.gradients = Gradients::OnTheFly;
            drawn(&other).1
        });
        assert_eq!(with.pixels, without.pixels, "{texture:?}");
    }
}

/// The root mean square of the angle between normals of an iso-surface and those of the closed form.
fn normal_error(side: usize, operator: GradientOperator, texture: GradientTexture) -> f64 {
    let gaussian = builtin::find("gaussian").unwrap();
    let scene = scene(&format!("gaussian:{side}"), |s| {
        (s.surface.iso, s.surface.refine) = (Some(0.4), Refine::Exact);
        (s.shading.gradient, s.shading.format) = (operator, texture);
    });
    let (plan, frame) = drawn(&scene);
    let (rays, step) = (plan.view.rays, scene.settings.sampling.step * scene.field.finest());
    let mut angles = Vec::new();
    for (i, met) in frame.surfaces.iter().enumerate() {
        let ray = rays.of(i as u32 % plan.view.size[0], i as u32 / plan.view.size[0]);
        let direction = ray.direction;
        let (Some(met), Some((enter, _))) = (met, scene.interval(&ray, rays.near)) else { continue };
        let place = rays.origin + enter * direction + met.steps * step * direction.normalize();
        let truth = gaussian.gradient(2.0 * place).normalize();
        angles.push(met.normal.normalize().cross(truth).length().asin());
    }
    assert!(angles.len() > 100);
    (angles.iter().map(|angle| angle * angle).sum::<f64>() / angles.len() as f64).sqrt()
}

#[test]
fn normals_of_both_operators_are_of_the_second_order() {
    for operator in OPERATORS {
        let errors = [24, 48, 96].map(|side| normal_error(side, operator, GradientTexture::Rgba32f));
        let order = (errors[0] / errors[2]).log2() / 2.0;
        println!("{operator:?}: {errors:?}, order {order:.2}");
        assert!((1.7..2.4).contains(&order), "{operator:?}: order {order} of {errors:?}");
    }
}

#[test]
fn fewer_bits_have_worse_normals() {
    let [rgba8, rgba16f, rgba32f] = FORMATS.map(|texture| normal_error(48, GradientOperator::Central, texture));
    println!("rgba8 {rgba8:.2e}, rgba16f {rgba16f:.2e}, rgba32f {rgba32f:.2e}");
    assert!(rgba8 > 1.5 * rgba32f && (rgba16f / rgba32f - 1.0).abs() < 0.1, "{rgba8} {rgba16f} {rgba32f}");
}

/// Volumes of every type, some of whose values fill little of it.
fn volumes() -> Vec<Volume> {
    let dims = [7, 6, 5];
    let count = dims.iter().product::<usize>();
    let mut random = Random(5);
    let mut numbers =
        |low: f64, high: f64| (0..count).map(|_| low + (high - low) * random.next()).collect::<Vec<f64>>();
    let volume = |name: &str, voxels: Voxels| Volume::new(name, dims, [1.0, 1.5, 0.7], voxels).unwrap();
    vec![
        volume("u8", Voxels::U8(numbers(0.0, 256.0).iter().map(|v| *v as u8).collect())),
        volume("i8", Voxels::I8(numbers(-20.0, 30.0).iter().map(|v| *v as i8).collect())),
        volume("u16", Voxels::U16(numbers(100.0, 5000.0).iter().map(|v| *v as u16).collect())),
        volume("i16", Voxels::I16(numbers(-30000.0, 30000.0).iter().map(|v| *v as i16).collect())),
        volume("f32", Voxels::F32(numbers(-3.0, 17.0).iter().map(|v| *v as f32).collect())),
        volume("f32, large", Voxels::F32(numbers(-3e38, 3e38).iter().map(|v| *v as f32).collect())),
        volume("f32, small", Voxels::F32(numbers(0.0, 1e-38).iter().map(|v| *v as f32).collect())),
        volume("f64", Voxels::F64(numbers(1e99, 2e99))),
    ]
}

#[test]
fn values_beside_gradients_stay_within_what_structures_allow_for() {
    for volume in volumes() {
        for texture in FORMATS {
            for kept in [VolumeTexture::Auto, VolumeTexture::Native, VolumeTexture::R16, VolumeTexture::R32f] {
                let settings = settings("constant:2", |s| {
                    lit(s);
                    (s.shading.format, s.volume.texture) = (texture, kept);
                });
                let scene = read::scene_of(&settings, |_| Ok(volume.clone())).unwrap();
                let (made, slack) = (texels(&scene), scene.value_slack());
                let map = TextureMap::of(&scene.field, TextureChoice::of(&scene).kept);
                let values = Texels::of(&scene).values;
                for (i, texel) in made.texels.iter().enumerate() {
                    assert!(texel.iter().all(|c| c.is_finite()), "{}, {texture:?}, {kept:?}: {texel:?}", volume.name);
                    let kept_x = map.x(match &values {
                        Values::Unorm8(codes) => f64::from(codes[i]) / 255.0,
                        Values::Unorm16(codes) => f64::from(codes[i]) / 65535.0,
                        Values::Float(values) => f64::from(values[i]),
                    });
                    let (along, x) = decoded(&made, *texel);
                    let said = format!("{}, {texture:?}, {kept:?}: {x} for {kept_x}, {slack}", volume.name);
                    assert!((x - kept_x).abs() <= slack + 1e-6 * kept_x.abs().max(1.0), "{said}");
                    assert!(along.abs().max_element() <= 1.0 + 1e-6, "{said}: {along}");
                }
            }
        }
    }
}

#[test]
fn slack_makes_cells_interesting_that_rounding_may_show() {
    // Opacity begins just above a value that 8 bits round up.
    let volume = Volume::new("steps", [4, 2, 2], [1.0; 3], Voxels::F32((0..16).map(|i| i as f32 / 15.0).collect()));
    let volume = volume.unwrap();
    let of = |texture: GradientTexture| {
        let settings = settings("constant:2", |s| {
            lit(s);
            s.shading.format = texture;
            s.transfer.points =
                Some(vec![[0.0, 1.0, 1.0, 1.0, 0.0], [1.001, 1.0, 1.0, 1.0, 0.0], [1.001, 1.0, 1.0, 1.0, 1.0]]);
        });
        read::scene_of(&settings, |_| Ok(volume.clone())).unwrap()
    };
    assert!(any_interesting(&of(GradientTexture::Rgba8)));
    assert!(!any_interesting(&of(GradientTexture::Rgba32f)));
}

/// Samples of a smooth volume that rounding brings across a jump, in cells of which no value is beyond it.
#[test]
fn some_cells_are_interesting_by_the_slack_alone() {
    let scene = scene("gaussian:44", |s| {
        lit(s);
        // Voxels of 0.3322 become the code of 0.3333.
        s.transfer.points = Some(vec![[0.3328, 1.0, 1.0, 1.0, 0.0], [0.3328, 1.0, 1.0, 1.0, 0.9]]);
        s.shading.format = GradientTexture::Rgba8;
    });
    let (made, field) = (texels(&scene), &scene.field);
    let without = Shown::from(&scene.transfer);
    let with = Shown::in_x(&scene);
    let (mut shown, mut by_slack) = (0, 0);
    for corner in 0..field.values.len() {
        let [nx, ny, _] = field.dims();
        let cell = [corner % nx, corner / nx % ny, corner / (nx * ny)];
        if (0..3).any(|axis| cell[axis] + 1 >= field.dims()[axis]) {
            continue;
        }
        let corners = field.corners(cell);
        let least = |of: &dyn Fn(usize) -> f64| corners.into_iter().map(of).fold(f64::INFINITY, f64::min);
        let most = |of: &dyn Fn(usize) -> f64| corners.into_iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let (value, beside) = (|i: usize| f64::from(field.values[i]), |i: usize| decoded(&made, made.texels[i]).1);
        let interesting = with.anywhere(least(&value), most(&value));
        if without.anywhere(least(&beside), most(&beside)) {
            shown += 1;
            assert!(interesting, "{cell:?} shows");
            by_slack += usize::from(!without.anywhere(least(&value), most(&value)));
        }
    }
    assert!(shown > 1000 && by_slack > 0, "{by_slack} of {shown} cells");
}

/// The span of the values has no number in single precision: nothing is known of them, and nothing is skipped.
#[test]
fn values_beyond_all_numbers_are_everywhere() {
    let voxels = Voxels::F32((0..27).map(|i| if i % 2 == 0 { -3e38 } else { 3e38 }).collect());
    let volume = Volume::new("huge", [3; 3], [1.0; 3], voxels).unwrap();
    let settings = settings("constant:2", |s| {
        lit(s);
        s.volume.range = Some([0.0, 1.0].map(Into::into));
        s.transfer.points = Some(vec![[0.0, 1.0, 1.0, 1.0, 0.0], [1.0, 1.0, 1.0, 1.0, 0.0]]);
    });
    let scene = read::scene_of(&settings, |_| Ok(volume.clone())).unwrap();
    assert_eq!(scene.value_slack(), f64::INFINITY);
    let (plan, frame) = drawn(&scene);
    assert!(plan.passes > 0 && frame.pixels.iter().flatten().all(|c| c.is_finite()));
}

#[test]
fn texture_is_left_out_where_nothing_reads_gradients() {
    let names = |scene: &Scene, method: &Method| {
        let mut scene = scene.clone();
        scene.settings.method.name = method.name();
        let plan = plan(&scene, method.papers).unwrap();
        let left = plan.left_out.iter().find(|left| left.what == "gradient texture").map(|left| left.why.clone());
        (plan.resources().iter().any(|resource| resource.name() == "gradients"), left)
    };
    let (precomputed, on_the_fly) = (
        |s: &mut Settings| s.shading.gradients = Gradients::Precomputed,
        |s: &mut Settings| s.shading.gradients = Gradients::OnTheFly,
    );
    for method in METHODS.into_iter().filter(|method| method.takes_samples()) {
        let nothing = scene("shells:12", on_the_fly);
        assert_eq!(names(&nothing, method), (false, None), "{}", method.name);
        let unread = scene("shells:12", precomputed);
        assert_eq!(names(&unread, method), (false, Some("no gradient is read".to_owned())), "{}", method.name);
        let in_shader = scene("shells:12", |s| (on_the_fly(s), lit(s)).1);
        let why = Some("gradients are taken in the shader".to_owned());
        assert_eq!(names(&in_shader, method), (false, why), "{}", method.name);
        let there = scene("shells:12", |s| (precomputed(s), lit(s)).1);
        if (method.takes)(&there).is_err() {
            // Values of 2D textures have no gradients beside them.
            assert!(method.stack().is_some(), "{}", method.name);
            continue;
        }
        assert_eq!(names(&there, method), (true, None), "{}", method.name);
    }
}

#[test]
fn sobel_in_the_shader_is_refused() {
    let scene = scene("shells:12", |s| {
        s.surface.iso = Some(90.0);
        (s.shading.gradients, s.shading.gradient) = (Gradients::OnTheFly, GradientOperator::Sobel);
    });
    let error = plan(&scene, RC_ERT.papers).unwrap_err().to_string();
    assert!(error.contains("--gradient sobel") && error.contains("--gradients precomputed"), "{error}");
}
