//! Pictures of an environment in files: what is read of them, and that no file makes more than an error.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use depthleap::error::{Error, ErrorKind};
use depthleap::read;
use depthleap::scene::settings::{EnvironmentSettings, Mapping};
use depthleap::scene::{Environment, Polygons};
use glam::{DQuat, DVec3};
use image::{DynamicImage, ImageFormat, Rgb, Rgb32FImage, RgbImage};
use tempfile::TempDir;

/// A folder of its own with a file in it.
fn file(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

/// The environment of a picture.
fn read_from(path: &Path, mapping: Mapping) -> depthleap::Result<Environment> {
    let settings = EnvironmentSettings { image: Some(path.to_owned()), mapping, ..EnvironmentSettings::default() };
    read::environment(&settings, &Polygons::default(), DQuat::IDENTITY).map(|found| found.expect("an environment"))
}

fn read_as(name: &str, bytes: &[u8]) -> depthleap::Result<Environment> {
    let (_folder, path) = file(name, bytes);
    read_from(&path, Mapping::Latlong)
}

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// A picture of these numbers, with a texel of its own in column 1 of row 0.
fn float(size: [u32; 2], first: [f32; 3], second: [f32; 3]) -> DynamicImage {
    let at = |x: u32, y: u32| Rgb(if (x, y) == (1, 0) { second } else { first });
    Rgb32FImage::from_fn(size[0], size[1], at).into()
}

fn codes(size: [u32; 2]) -> DynamicImage {
    RgbImage::from_fn(size[0], size[1], |x, y| Rgb([188, x as u8, y as u8])).into()
}

/// Whole files, one of each format.
fn whole() -> [(&'static str, Vec<u8>); 3] {
    let light = float([6, 3], [0.5, 2.0, 0.25], [8.0, 1.0, 0.125]);
    [
        ("a.png", encoded(&codes([6, 3]), ImageFormat::Png)),
        ("a.hdr", encoded(&light, ImageFormat::Hdr)),
        ("a.exr", encoded(&light, ImageFormat::OpenExr)),
    ]
}

#[test]
fn pictures_of_every_format_are_read_in_linear_light() {
    let [png, hdr, exr] = whole().map(|(name, bytes)| read_as(name, &bytes).unwrap());
    for found in [&png, &hdr, &exr] {
        assert_eq!((found.picture.size, found.reflectivity, found.warnings.len()), ([6, 3], 0.5, 0));
    }
    for found in [hdr, exr] {
        assert_eq!((found.picture.texels[0], found.picture.texels[1]), ([0.5, 2.0, 0.25], [8.0, 1.0, 0.125]));
    }
    // Half of the light of white is code 188 of sRGB, the first codes are a line.
    let [r, g, b] = png.picture.texels[6 + 3];
    let [from_line, first] = [3.0, 1.0].map(|code: f32| code / 255.0 / 12.92);
    assert!((r - 0.502_886).abs() < 1e-5 && (g - from_line).abs() < 1e-7 && (b - first).abs() < 1e-7, "{r} {g} {b}");
}

#[test]
fn picture_is_sought_beside_the_scene_file() {
    let (folder, _) = file("probe.hdr", &whole()[1].1);
    let text = "[surface]\niso = 90\n[environment]\nimage = \"probe.hdr\"\nmapping = \"sphere\"\nreflectivity = 0.25";
    let settings = read::settings_of("a.toml", text, folder.path()).unwrap();
    assert_eq!(settings.environment.image, Some(folder.path().join("probe.hdr")));
    let environment = read::scene(&settings).unwrap().environment.unwrap();
    assert_eq!((environment.mapping, environment.reflectivity), (Mapping::Sphere, 0.25));
    assert!(environment.color(DVec3::Z).iter().zip([0.5, 2.0, 0.25]).all(|(a, b)| (a - b).abs() < 1e-12));
}

#[test]
fn latlong_picture_of_other_sides_comes_with_a_warning() {
    let (_folder, path) = file("wide.png", &encoded(&codes([6, 4]), ImageFormat::Png));
    let warnings = |mapping| read_from(&path, mapping).unwrap().warnings;
    assert!(warnings(Mapping::Latlong)[0].contains("wide.png has 6 x 4 texels"), "{:?}", warnings(Mapping::Latlong));
    assert!(warnings(Mapping::Sphere).is_empty());
}

/// Whether an error names its file and says what to do.
fn is_fit(error: &Error, name: &str) {
    let message = error.to_string();
    assert!(error.kind == ErrorKind::Input && error.input.contains(name), "{message}");
    assert!(!error.remedy.is_empty() && !message.contains(char::is_control), "{message:?}");
}

#[test]
fn what_is_no_picture_is_refused() {
    let hdr = |size: &str| format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n").into_bytes();
    let exr = |first, second| encoded(&float([4, 2], first, second), ImageFormat::OpenExr);
    let gray = [0.5; 3];
    let cases: [(&str, Vec<u8>, &str); 12] = [
        ("empty.png", Vec::new(), "not a picture of a known format"),
        ("text.hdr", b"a sky, and a sun in it".to_vec(), "not a picture of a known format"),
        ("photo.jpg", b"\xff\xd8\xff\xe0 and so on".to_vec(), "not a picture of a known format"),
        ("none.hdr", hdr("-Y 0 +X 8"), "has 8 x 0 texels"),
        ("huge.hdr", hdr("-Y 100000 +X 100000"), "8192 x 4096"),
        ("wide.png", encoded(&codes([8193, 1]), ImageFormat::Png), "8192 x 4096"),
        ("high.exr", encoded(&float([1, 4097], gray, gray), ImageFormat::OpenExr), "has 1 x 4097 texels"),
        ("nan.exr", exr(gray, [1.0, f32::NAN, 0.0]), "in column 1 of row 0"),
        ("infinite.exr", exr(gray, [1.0, f32::INFINITY, 0.0]), "in column 1 of row 0"),
        ("negative.exr", exr([0.5, 0.5, -0.1], gray), "in column 0 of row 0"),
        ("sizes.exr", window(&exr(gray, gray), b"dataWindow", [0, 0, 1 << 30, 1]), "has 1073741825 x 2 texels"),
        ("backwards.exr", window(&exr(gray, gray), b"displayWindow", [5, 0, 1, 1]), "has -3 x 2 texels"),
    ];
    for (name, bytes, says) in cases {
        let error = read_as(name, &bytes).map(|found| found.picture.size).expect_err(name);
        is_fit(&error, name);
        assert!(error.to_string().contains(says), "{error} does not say {says}");
    }
    let absent = read_from(Path::new("absent.hdr"), Mapping::Latlong).unwrap_err();
    is_fit(&absent, "absent.hdr");
    let folder = tempfile::tempdir().unwrap();
    assert!(read_from(folder.path(), Mapping::Latlong).unwrap_err().problem.contains("not a regular file"));
}

/// An OpenEXR file with another window.
fn window(bytes: &[u8], name: &[u8], corners: [i32; 4]) -> Vec<u8> {
    let head = [name, b"\0box2i\0"].concat();
    let at = bytes.windows(head.len()).position(|part| part == head).unwrap() + head.len() + 4;
    let corners: Vec<u8> = corners.iter().flat_map(|corner| corner.to_le_bytes()).collect();
    [&bytes[..at], &corners, &bytes[at + 16..]].concat()
}

#[test]
fn pictures_that_are_cut_off_are_refused_wherever() {
    for (name, bytes) in whole() {
        for length in 0..bytes.len() {
            match read_as(name, &bytes[..length]) {
                Err(error) => is_fit(&error, name),
                // Nothing of the picture stands behind the data of a PNG file: a checksum, and the chunk that ends it.
                Ok(_) => assert!(name == "a.png" && length >= bytes.len() - 20, "{length} of {name}"),
            }
        }
    }
}

#[test]
fn tiles_larger_than_any_picture_are_refused() {
    let (name, bytes) = whole().into_iter().find(|(name, _)| name.ends_with(".exr")).unwrap();
    for (across, down) in [(1_073_741_822u32, 1_073_741_822u32), (0, 16), (16, u32::MAX)] {
        let value = [&across.to_le_bytes()[..], &down.to_le_bytes(), &[0]].concat();
        let attribute = [&b"tiles\0tiledesc\0"[..], &9u32.to_le_bytes(), &value].concat();
        let tiled = [&bytes[..8], &attribute, &bytes[8..]].concat();
        let error = read_as(name, &tiled).unwrap_err();
        assert!(error.to_string().contains("has tiles of"), "{error}");
    }
}

#[test]
fn damaged_pictures_are_read_or_refused() {
    for (name, bytes) in whole() {
        let (_folder, path) = file(name, &bytes);
        let (mut read, mut refused) = (0, 0);
        for at in 0..bytes.len() {
            for odd in [0, 1, 0x7f, 0x80, 0xff] {
                let mut damaged = bytes.clone();
                damaged[at] = odd;
                std::fs::write(&path, damaged).unwrap();
                match read_from(&path, Mapping::Latlong) {
                    Ok(found) => {
                        read += 1;
                        let texels = found.picture.texels.as_flattened();
                        assert_eq!(3 * found.picture.size.iter().product::<usize>(), texels.len());
                        assert!(texels.iter().all(|c| (0.0..=f32::MAX).contains(c)));
                    }
                    Err(error) => {
                        refused += 1;
                        is_fit(&error, name);
                    }
                }
            }
        }
        println!("{name}: {read} read, {refused} refused");
        assert!(read > 0 && refused > 0);
    }
}
