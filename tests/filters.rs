//! Nearest voxels, missing values, ranges and textures without a device: fields against their definition, structures
//! against brute force, the exact integral against closed forms, choices of formats against what a unit can do.

mod random;

use std::sync::Arc;

use depthleap::math::interpolate::{nearest, trilinear};
use depthleap::read;
use depthleap::resource::texels::Texels;
use depthleap::scene::field::{NanPolicy, Normalisation};
use depthleap::scene::range::RangeEnd::{Percentile, Value};
use depthleap::scene::settings::{Filter, Settings, VolumeTexture};
use depthleap::scene::texture::{Coding, FilterError, TexelFormat, TextureChoice};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, Scene, TextureUnit, TransferFunction, Volume};
use depthleap::structure::cells::{self, Values};
use depthleap::structure::grid::Grid;
use depthleap::truth::exact::ExactIntegrator;
use glam::DVec3;
use random::Random;

fn volume(dims: [usize; 3], voxels: Voxels) -> Volume {
    Volume::new("test", dims, [1.0; 3], voxels).unwrap()
}

fn row(voxels: Voxels, how: &Normalisation) -> Field {
    Field::of(volume([voxels.len(), 1, 1], voxels), how).unwrap()
}

fn scene(volume: Volume, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    change(&mut settings);
    read::scene_of(&settings, |_| Ok(volume)).unwrap()
}

#[test]
fn an_empty_range_makes_x_zero_in_every_type_and_texture() {
    let types = [
        Voxels::U8(vec![7; 8]),
        Voxels::I8(vec![-3; 8]),
        Voxels::U16(vec![700; 8]),
        Voxels::I16(vec![-700; 8]),
        Voxels::U32(vec![70_000; 8]),
        Voxels::I32(vec![-70_000; 8]),
        Voxels::F32(vec![0.7; 8]),
        Voxels::F64(vec![-0.7; 8]),
    ];
    let textures = [VolumeTexture::Auto, VolumeTexture::Native, VolumeTexture::R16, VolumeTexture::R32f];
    for (voxels, texture) in types.iter().flat_map(|voxels| textures.map(|texture| (voxels, texture))) {
        for range in [Some([100.0, 100.0].map(Value)), None] {
            // The default range of u8 is its whole one.
            if range.is_none() && matches!(voxels, Voxels::U8(_)) {
                continue;
            }
            let scene = scene(volume([2; 3], voxels.clone()), |s| {
                (s.volume.range, s.volume.texture) = (range, texture);
            });
            assert!(scene.field.values.iter().all(|x| *x == 0.0), "{voxels:?}");
            let texels = Texels::of(&scene);
            let values: Vec<f64> = match &texels.values {
                Values::Unorm8(codes) => codes.iter().map(|c| f64::from(*c) / 255.0).collect(),
                Values::Unorm16(codes) => codes.iter().map(|c| f64::from(*c) / 65535.0).collect(),
                Values::Float(values) => values.iter().map(|v| f64::from(*v)).collect(),
            };
            let transfer = texels.transfer(&scene.transfer);
            for value in values {
                assert_eq!(transfer.evaluate(value), scene.transfer.evaluate(0.0), "{voxels:?}, {texture:?}");
            }
            assert_eq!(TextureChoice::of(&scene).error, 0.0);
        }
    }
}

#[test]
fn the_default_range_is_all_of_u8_and_what_there_is_of_other_types() {
    let range = |voxels, no_data: &[f64]| row(voxels, &Normalisation { no_data, ..Normalisation::default() }).range;
    assert_eq!(range(Voxels::U8(vec![3, 9]), &[]), [0.0, 255.0]);
    assert_eq!(range(Voxels::U16(vec![3, 4095]), &[]), [3.0, 4095.0]);
    assert_eq!(range(Voxels::U16(vec![3, 40, 4095]), &[4095.0]), [3.0, 40.0]);
    assert_eq!(range(Voxels::F32(vec![f32::NAN, -9999.0, 2.5, -1.0]), &[-9999.0]), [-1.0, 2.5]);
    // A decimal that no f32 equals stands for the f32 next to it.
    assert_eq!(range(Voxels::F32(vec![0.1, 2.5, 3.5]), &[0.1]), [2.5, 3.5]);
    assert_eq!(range(Voxels::I16(vec![-9999; 4]), &[-9999.0]), [0.0, 1.0]);
}

#[test]
fn percentiles_are_values_that_so_many_voxels_do_not_exceed() {
    let values: Vec<i16> = (0..200).map(|i| (i * 37 % 200) - 50).collect();
    let of = |range, no_data: &[f64]| {
        let how = Normalisation { range: Some(range), no_data, nan: NanPolicy::Replace };
        row(Voxels::I16(values.clone()), &how).range
    };
    assert_eq!(of([Percentile(0.0), Percentile(100.0)], &[]), [-50.0, 149.0]);
    // Two of two hundred are -50 and -49.
    assert_eq!(of([Percentile(1.0), Percentile(99.0)], &[]), [-49.0, 147.0]);
    assert_eq!(of([Value(-1.5), Percentile(50.0)], &[]), [-1.5, 49.0]);
    assert_eq!(of([Percentile(0.0), Percentile(100.0)], &[-50.0, 149.0]), [-49.0, 148.0]);
    let how = Normalisation { range: Some([Value(500.0), Percentile(50.0)]), ..Normalisation::default() };
    let error = Field::of(volume([200, 1, 1], Voxels::I16(values)), &how).unwrap_err().to_string();
    assert!(error.contains("500, 50%") && error.contains("500 to 49"), "{error}");
}

/// Of 1 to 100 so many per cent do not exceed the value of that number.
#[test]
fn whole_percentiles_of_a_hundred_values_are_the_values() {
    for percent in 0..=100u8 {
        let voxels = Voxels::F32((1..=100u8).map(f32::from).collect());
        let ends = [Percentile(f64::from(percent)), Percentile(100.0)];
        let how = Normalisation { range: Some(ends), ..Normalisation::default() };
        assert_eq!(row(voxels, &how).range, [f64::from(percent.max(1)), 100.0]);
    }
}

#[test]
fn no_data_is_treated_as_nan_by_every_policy() {
    let field = |nan| {
        let how = Normalisation { range: Some([Value(0.0), Value(10.0)]), nan, no_data: &[200.0] };
        Field::of(volume([3, 2, 1], Voxels::U8(vec![5, 200, 10, 0, 5, 200])), &how)
    };
    let replaced = field(NanPolicy::Replace).unwrap();
    assert_eq!((replaced.values.as_slice(), replaced.missing), (&[0.5, 0.0, 1.0, 0.0, 0.5, 0.0][..], 2));
    assert_eq!(field(NanPolicy::Hole).unwrap().holes, Some(vec![true, true]));
    let error = field(NanPolicy::Error).unwrap_err().to_string();
    assert!(error.contains("2 voxels") && error.contains("no data"), "{error}");
}

#[test]
fn textures_hold_what_no_data_became() {
    // -20 is a code of i8 and 0.5 is none.
    for (low, format) in [(-20.0, TexelFormat::R8), (0.5, TexelFormat::R32f)] {
        let voxels = Voxels::I8(vec![-128, 5, 100, -128, 7, 0, 1, 2]);
        let scene = scene(volume([2; 3], voxels), |s| {
            s.volume.range = Some([low, 120.0].map(Value));
            (s.volume.no_data, s.volume.texture) = (vec![-128.0], VolumeTexture::Native);
        });
        assert_eq!(TextureChoice::of(&scene).format, format);
        let texels = Texels::of(&scene);
        let first = match &texels.values {
            Values::Unorm8(codes) => f64::from(codes[0]) / 255.0,
            Values::Float(values) => f64::from(values[0]),
            Values::Unorm16(_) => panic!("16 bits"),
        };
        assert!((first - texels.offset).abs() < 1e-9, "{first} where x = 0 is {}", texels.offset);
    }
}

#[test]
fn the_nearest_voxel_is_that_whose_centre_is() {
    let values = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let at = |x: f64, y: f64| nearest(&values, [3, 2, 1], DVec3::new(x, y, 0.5));
    assert_eq!((at(0.5, 0.5), at(0.999, 0.999), at(1.0, 1.0)), (1.0, 1.0, 5.0));
    assert_eq!((at(-7.0, 0.0), at(9.0, 9.0)), (1.0, 6.0));
}

/// Labels 0, 1 and 2 at random, of which 1 alone shows.
fn labels(dims: [usize; 3]) -> Scene {
    let mut random = Random(5);
    let voxels = (0..dims.iter().product()).map(|_| (random.next() * random.next() * 2.5) as u8 * 100).collect();
    scene(volume(dims, Voxels::U8(voxels)), |s| {
        s.sampling.filter = Filter::Nearest;
        s.transfer.points = Some(vec![
            [0.3, 1.0, 0.0, 0.0, 0.0],
            [0.3, 1.0, 0.0, 0.0, 0.9],
            [0.5, 1.0, 0.0, 0.0, 0.9],
            [0.5, 0.0, 0.0, 0.0, 0.0],
        ]);
    })
}

#[test]
fn a_cell_of_nearest_voxels_is_interesting_when_one_of_them_shows() {
    let scene = labels([9, 7, 6]);
    let texels = Texels::of(&scene);
    for cell in [1, 2, 4] {
        let grid = Grid::new(&scene.field, cell);
        let found = cells::interesting(&scene.field, &texels.values, &texels.shown(&scene), &grid, true);
        for (i, shows) in found.into_iter().enumerate() {
            let at = [i % grid.cells[0], i / grid.cells[0] % grid.cells[1], i / (grid.cells[0] * grid.cells[1])];
            let [x, y, z] =
                [0, 1, 2].map(|a| at[a] * grid.cell..=((at[a] + 1) * grid.cell).min(scene.field.dims()[a] - 1));
            let one = |x: usize, y: usize, z: usize| {
                scene.transfer.evaluate(scene.field.values[(z * 7 + y) * 9 + x].into())[3] > 0.0
            };
            let any = z.clone().any(|z| y.clone().any(|y| x.clone().any(|x| one(x, y, z))));
            assert_eq!(shows, any, "cell {at:?} of {cell}");
        }
    }
}

#[test]
fn nothing_between_labels_is_interesting() {
    let mut scene = labels([8; 3]);
    let far = volume([8; 3], Voxels::U8((0..512).map(|i| if i % 3 == 0 { 200 } else { 0 }).collect()));
    scene.field = Arc::new(Field::new(far, None, NanPolicy::Replace).unwrap());
    assert!(!cells::any_interesting(&scene));
    scene.settings.sampling.filter = Filter::Exact;
    assert!(cells::any_interesting(&scene));
}

#[test]
fn the_exact_integral_of_nearest_voxels_is_a_product_of_their_transparencies() {
    let voxels = Voxels::F32(vec![0.1, 0.4, 0.9, 0.2]);
    let mut scene = scene(volume([4, 1, 1], voxels), |s| {
        (s.sampling.filter, s.volume.range) = (Filter::Nearest, Some([0.0, 1.0].map(Value)));
    });
    scene.transfer = TransferFunction::preset("linear", 1.0).unwrap().unwrap();
    // From a quarter of the first voxel to three quarters of the last.
    let along = |x: f64| DVec3::new(x / 4.0 - 0.5, 0.0, 0.0);
    let [.., alpha] = ExactIntegrator::of(&scene).ray(along(0.25), DVec3::X, 3.5 / 4.0);
    let clear = [(0.1, 0.75), (0.4, 1.0), (0.9, 1.0), (0.2, 0.75)]
        .map(|(a, l): (f64, f64)| (1.0 - f64::from(a as f32)).powf(l));
    assert!((1.0 - alpha - clear.iter().product::<f64>()).abs() < 1e-9, "{alpha}, {clear:?}");
}

/// A unit that rounds R8 to its codes and the others to f32.
fn coarse() -> TextureUnit {
    let fine = Some(FilterError { rounding: 1e-7, weight: 1e-7 });
    TextureUnit { errors: [Some(FilterError { rounding: 7e-3, weight: 4e-3 }), fine, fine], measured: true }
}

#[test]
fn auto_takes_the_smallest_format_that_is_precise_enough() {
    let kept = |voxels: Voxels, unit: TextureUnit, change: fn(&mut Settings)| {
        let mut scene = scene(volume([2; 3], voxels), change);
        scene.unit = unit;
        let choice = TextureChoice::of(&scene);
        (choice.kept, choice.format)
    };
    let mask = || Voxels::U8(vec![0, 1, 0, 1, 1, 0, 0, 1]);
    let fine = TextureUnit::default();
    assert_eq!(kept(mask(), fine, |_| {}), (Coding::Stored, TexelFormat::R8));
    assert_eq!(kept(mask(), coarse(), |_| {}), (Coding::Widened, TexelFormat::R16));
    assert_eq!(kept(mask(), coarse(), |s| s.volume.precision = 0.1), (Coding::Stored, TexelFormat::R8));
    // What a shader interpolates needs no unit.
    assert_eq!(kept(mask(), coarse(), |s| s.sampling.filter = Filter::Exact), (Coding::Stored, TexelFormat::R8));
    // Two codes of 65536 fill the range: f32 itself rounds each to 2^-24 of them all.
    let narrow = || Voxels::U16(vec![60_000, 60_001, 60_000, 60_001, 60_001, 60_000, 60_000, 60_001]);
    assert_eq!(kept(narrow(), coarse(), |_| {}), (Coding::Stretched, TexelFormat::R16));
    // Nothing is interpolated: the codes themselves are exact.
    assert_eq!(kept(narrow(), coarse(), |s| s.sampling.filter = Filter::Nearest), (Coding::Stored, TexelFormat::R16));
    assert_eq!(
        kept(narrow(), coarse(), |s| s.volume.texture = VolumeTexture::Native),
        (Coding::Stored, TexelFormat::R16)
    );
    // Where no format is precise enough, no bytes are spent on it.
    let few_bits = Some(FilterError { rounding: 1e-4, weight: 6e-3 });
    let unit = TextureUnit { errors: [few_bits; 3], measured: true };
    assert_eq!(kept(Voxels::U8(vec![0, 255, 0, 255, 0, 255, 0, 255]), unit, |_| {}), (Coding::Stored, TexelFormat::R8));
}

#[test]
fn the_stated_error_holds_for_codes_and_what_is_spread() {
    let mut random = Random(9);
    for bits in 1..16 {
        let top = (1u32 << bits) as f64;
        let base = random.next() * (65535.0 - top);
        let voxels: Vec<u16> = (0..125).map(|_| (base + top * random.next()) as u16).collect();
        for texture in [VolumeTexture::Native, VolumeTexture::R16, VolumeTexture::Auto] {
            let mut scene = scene(volume([5; 3], Voxels::U16(voxels.clone())), |s| s.volume.texture = texture);
            scene.unit = TextureUnit::default();
            let (choice, texels) = (TextureChoice::of(&scene), Texels::of(&scene));
            let Values::Unorm16(codes) = &texels.values else { panic!("{texture:?}") };
            let values: Vec<f32> = codes.iter().map(|c| f32::from(*c) / 65535.0).collect();
            for _ in 0..200 {
                let at = DVec3::new(random.next(), random.next(), random.next()) * 5.0;
                let x = (f64::from(trilinear(&values, [5; 3], at) as f32) - texels.offset) / texels.scale;
                let right = trilinear(&scene.field.values, [5; 3], at);
                assert!((x - right).abs() <= choice.error, "{texture:?}, {bits} bits: {x} for {right}, {choice:?}");
            }
        }
    }
}
