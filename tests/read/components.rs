//! Files with several values a voxel: one is chosen, or they are made one.

use depthleap::read::ReadChoice;
use depthleap::scene::settings::Component::{self, Luminance, Magnitude, Number};
use depthleap::scene::volume::Voxels;

use crate::kit::{bytes, chosen, component, frame, nrrd, read_with, sized, values, volume};

/// What makes the first of four axes number the values of a voxel.
const IN_FRONT: [&str; 7] = [
    "kinds: RGB-color domain domain domain",
    "kinds: vector space space space",
    "kinds: list domain domain domain",
    "kinds: 3-vector ??? none ???",
    "kinds: ??? domain domain domain",
    "space directions: none (1,0,0) (0,1,0) (0,0,1)",
    "kinds: none space space space\nspace directions: none (1,0,0) (0,1,0) (0,0,1)",
];

/// What makes the last do so.
const BEHIND: [&str; 3] = [
    "kinds: domain domain domain RGB-color",
    "kinds: space space space 3-color",
    "kinds: domain domain domain vector\nspace directions: (1,0,0) (0,1,0) (0,0,1) none",
];

const FRONT: [usize; 4] = [3, 2, 4, 5];
const END: [usize; 4] = [2, 4, 5, 3];

#[test]
fn the_default_refuses_and_names_the_choices() {
    for (sizes, lines) in IN_FRONT.map(|lines| (FRONT, lines)).into_iter().chain(BEHIND.map(|lines| (END, lines))) {
        let message = chosen(&sizes, lines, &ReadChoice::default()).unwrap_err().to_string();
        let parts = ["volume.component (--component): is needed", "3 values", "0 to 2, luminance or magnitude"];
        assert!(parts.iter().all(|part| message.contains(part)), "{lines}: {message}");
    }
    let two = chosen(&[2, 3, 4, 5], IN_FRONT[1], &ReadChoice::default()).unwrap_err().to_string();
    assert!(two.contains("choose 0 to 1, or magnitude"), "{two}");
}

#[test]
fn a_component_by_its_number_is_every_nth_value_or_a_block() {
    for n in 0..3u8 {
        let choice = component(Number(usize::from(n)));
        for lines in IN_FRONT {
            let volume = chosen(&FRONT, lines, &choice).unwrap();
            let expected: Vec<u8> = (0..40).map(|i| 3 * i + n).collect();
            assert_eq!((volume.dims, bytes(&volume)), ([2, 4, 5], &expected[..]), "{lines}");
        }
        for lines in BEHIND {
            let volume = chosen(&END, lines, &choice).unwrap();
            let expected: Vec<u8> = (40 * n..40 * n + 40).collect();
            assert_eq!((volume.dims, bytes(&volume)), ([2, 4, 5], &expected[..]), "{lines}");
        }
    }
}

/// Components between the axes of space are picked as well.
#[test]
fn a_component_in_the_middle_is_picked() {
    let volume = chosen(&[2, 3, 4, 5], "kinds: domain vector domain domain", &component(Number(1))).unwrap();
    let expected: Vec<u8> = (0..20).flat_map(|row| [6 * row + 2, 6 * row + 3]).collect();
    assert_eq!((volume.dims, bytes(&volume)), ([2, 4, 5], &expected[..]));
}

#[test]
fn luminance_is_that_of_rec_709_and_magnitude_a_length() {
    let luminance = |i: usize| 0.2126 * (3 * i) as f64 + 0.7152 * (3 * i + 1) as f64 + 0.0722 * (3 * i + 2) as f64;
    let magnitude = |i: usize| (((3 * i).pow(2) + (3 * i + 1).pow(2) + (3 * i + 2).pow(2)) as f64).sqrt();
    let forms: [(Component, &dyn Fn(usize) -> f64); 2] = [(Luminance, &luminance), (Magnitude, &magnitude)];
    for (by, expected) in forms {
        for lines in IN_FRONT {
            let volume = chosen(&FRONT, lines, &component(by)).unwrap();
            assert!(matches!(volume.voxels, Voxels::F32(_)));
            for (i, value) in values(&volume).into_iter().enumerate() {
                // Half a unit in the last place of f32, and f64's own rounding.
                let slack = expected(i) * (0.5f64.powi(24) + 1e-14);
                assert!((value - expected(i)).abs() <= slack, "{by} {i}: {value} {}", expected(i));
            }
        }
    }
}

fn typed(name: &str, data: &[u8], by: Component) -> Voxels {
    let lines = sized(&[3, 1, 1, 1], "kinds: 3-vector domain domain domain\nendian: little").replace("uchar", name);
    read_with("a.nrrd", &nrrd(&lines, data), &component(by)).unwrap().voxels
}

#[test]
fn combined_values_are_exact_where_the_numbers_are() {
    let doubles = |v: [f64; 3]| typed("double", &v.map(f64::to_le_bytes).concat(), Magnitude);
    assert_eq!(doubles([3.0, -4.0, 0.0]), Voxels::F64(vec![5.0]));
    // Squares that overflow or vanish have roots that do not.
    let large = 2f64.powi(1000);
    assert_eq!(doubles([3.0 * large, 4.0 * large, 0.0]), Voxels::F64(vec![5.0 * large]));
    assert_eq!(doubles([3.0 / large, 0.0, -4.0 / large]), Voxels::F64(vec![5.0 / large]));
    assert_eq!(doubles([0.0, 0.0, -5e-324]), Voxels::F64(vec![5e-324]));
    assert_eq!(typed("int8", &[3, 0, 252], Magnitude), Voxels::F32(vec![5.0]));
    assert_eq!(typed("uint16", &[0, 0, 0, 0, 0, 0], Luminance), Voxels::F32(vec![0.0]));
    let ints = [1i32 << 30, 0, 0].map(i32::to_le_bytes).concat();
    assert_eq!(typed("int", &ints, Magnitude), Voxels::F64(vec![f64::from(1 << 30)]));
    let Voxels::F64(white) = typed("int64", &[1000i64; 3].map(i64::to_le_bytes).concat(), Luminance) else { panic!() };
    assert!((white[0] - 1000.0).abs() < 1e-9);
}

/// Three values near the end of f32 make a length beyond it.
#[test]
fn a_length_beyond_f32_stays_finite() {
    let floats = [f32::MAX; 3].map(f32::to_le_bytes).concat();
    let lines = sized(&[3, 1, 1, 1], "kinds: 3-vector domain domain domain\nendian: little").replace("uchar", "float");
    let volume = read_with("a.nrrd", &nrrd(&lines, &floats), &component(Magnitude)).unwrap();
    let expected = f64::from(f32::MAX) * 3f64.sqrt();
    assert!((volume.voxels.get(0) / expected - 1.0).abs() < 1e-7, "{:?}", volume.voxels);
}

/// A value made of parts has none where a part is no data, NaN or, beside NaN, infinite.
#[test]
fn a_combined_value_without_one_of_its_parts_is_none() {
    let floats = [3.0, 4.0, -9999.0, 1.0, f32::NAN, f32::INFINITY, 6.0, 8.0].map(f32::to_le_bytes).concat();
    let lines = sized(&[2, 4, 1, 1], "kinds: vector domain domain domain\nendian: little").replace("uchar", "float");
    let choice = ReadChoice { no_data: &[-9999.0], ..component(Magnitude) };
    let read = values(&read_with("a.nrrd", &nrrd(&lines, &floats), &choice).unwrap());
    assert_eq!((read[0], read[3]), (5.0, 10.0));
    assert!(read[1].is_nan() && read[2].is_nan(), "{read:?}");
}

#[test]
fn choices_that_do_not_fit_are_refused_by_name() {
    for (by, sizes, lines, parts) in [
        (Number(3), FRONT, IN_FRONT[0], ["is 3", "each voxel has 3 values"]),
        (Number(usize::MAX), FRONT, IN_FRONT[0], ["is 18446744073709551615", "0 to 2"]),
        (Luminance, [2, 3, 4, 5], IN_FRONT[1], ["is luminance", "2 values of kind vector, which are not red"]),
        (Luminance, [3, 3, 4, 5], "kinds: HSV-color domain domain domain", ["is luminance", "of kind hsv-color"]),
        (Number(1), [1, 3, 4, 5], IN_FRONT[1], ["is 1, and each voxel has one value", "leave it out"]),
        (Magnitude, [3, 4, 5, 1], "", ["is magnitude, and each voxel has one value", "leave it out"]),
    ] {
        let message = chosen(&sizes, lines, &component(by)).unwrap_err().to_string();
        let named = "a.nrrd: volume.component (--component): ";
        assert!(message.contains(named) && parts.iter().all(|part| message.contains(part)), "{message}");
    }
    let only = chosen(&[1, 3, 4, 5], IN_FRONT[1], &component(Number(0))).unwrap();
    assert_eq!(bytes(&only), (0..60).collect::<Vec<u8>>());
    let twice = chosen(&[2, 2, 3, 4, 5], "kinds: vector RGB-color domain domain domain", &ReadChoice::default());
    assert!(twice.unwrap_err().to_string().contains("axes [0, 1] all number the values of a voxel"));
}

#[test]
fn four_axes_that_say_nothing_are_refused_with_both_choices() {
    let sizes = [3, 2, 4, 5];
    let message = chosen(&sizes, "", &ReadChoice::default()).unwrap_err().to_string();
    let parts = ["has 4 axes", "write `kinds`", "--component 0 to 2", "5 volumes with --frame 0 to 4"];
    assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    let first = chosen(&sizes, "", &component(Number(1))).unwrap();
    assert_eq!((first.dims, &bytes(&first)[..3]), ([2, 4, 5], &[1, 4, 7][..]));
    let last = chosen(&sizes, "", &frame(4)).unwrap();
    assert_eq!((last.dims, &bytes(&last)[..3]), ([3, 2, 4], &[96, 97, 98][..]));
}

#[test]
fn further_axes_of_one_entry_are_dropped_in_front_and_behind() {
    for sizes in [&[1, 2, 3, 4][..], &[2, 3, 4, 1], &[1, 2, 3, 4, 1], &[1, 1, 2, 3, 4], &[2, 3, 4, 1, 1]] {
        let volume = volume(sizes, "");
        assert_eq!((volume.dims, bytes(&volume)), ([2, 3, 4], &crate::kit::counted(sizes)[..]), "{sizes:?}");
    }
    for (sizes, lines) in [
        ([1, 2, 3, 4], "kinds: scalar domain domain domain\nspacings: nan 2 3 4"),
        ([1, 2, 3, 4], "space directions: none (2,0,0) (0,3,0) (0,0,4)"),
        ([2, 3, 4, 1], "kinds: domain domain domain time\nspacings: 2 3 4 nan"),
        ([2, 3, 4, 1], "space directions: (2,0,0) (0,3,0) (0,0,4) none"),
        ([2, 3, 4, 1], "kinds: domain domain domain stub\naxis mins: 0 0 0 nan\naxis maxs: 4 9 16 nan"),
    ] {
        let volume = volume(&sizes, lines);
        assert_eq!((volume.dims, volume.spacing), ([2, 3, 4], [2.0, 3.0, 4.0]), "{lines}");
    }
}
