//! Comparing pictures, and the files they are written to.

use depthleap::measure::Picture;
use depthleap::measure::compare;
use depthleap::measure::error::difference;
use depthleap::measure::picture::PictureFormat;
use depthleap::measure::write_atomically;
use std::path::Path;

use crate::runs::picture;

mod comparer {
    use super::*;

    #[test]
    fn finds_equal_pictures_equal() {
        let mut a = picture([7, 5]);
        a.pixels[3][0] = f32::NAN;
        let e = compare(&a, &a.clone(), None).unwrap();
        assert_eq!((e.max, e.rmse, e.psnr, e.worst_pixel, e.differing), (0.0, 0.0, None, None, 0));
    }

    #[test]
    fn sees_one_altered_pixel() {
        let a = picture([7, 5]);
        let mut b = a.clone();
        b.pixels[2 * 7 + 4][3] += 0.25;
        let e = compare(&a, &b, None).unwrap();
        assert_eq!((e.max, e.worst_pixel, e.differing), (0.25, Some([4, 2]), 1));
        let rmse = (0.25_f64.powi(2) / 140.0).sqrt();
        assert!((e.rmse - rmse).abs() < 1e-15, "{}", e.rmse);
        assert!((e.psnr.unwrap() - 33.5025).abs() < 1e-3, "{:?}", e.psnr);
    }

    #[test]
    fn leaves_undecided_pixels_out_of_the_maximum_only() {
        let a = picture([7, 5]);
        let mut b = a.clone();
        b.pixels[9][1] = 0.75;
        let mut skip = vec![false; 35];
        skip[9] = true;
        let e = compare(&a, &b, Some(&skip)).unwrap();
        assert_eq!((e.max, e.worst_pixel, e.differing, e.undecided), (0.0, None, 0, 1));
        assert!(e.rmse > 0.0);
    }

    #[test]
    fn finds_what_is_no_number_infinitely_far() {
        let a = picture([7, 5]);
        for bad in [f32::NAN, f32::INFINITY] {
            let mut b = a.clone();
            b.pixels[0][2] = bad;
            let e = compare(&a, &b, None).unwrap();
            assert_eq!((e.max, e.rmse, e.psnr, e.differing), (f64::INFINITY, f64::INFINITY, None, 1));
        }
    }

    #[test]
    fn refuses_other_sizes() {
        assert!(compare(&picture([7, 5]), &picture([5, 7]), None).is_err());
        assert!(compare(&picture([7, 5]), &picture([7, 5]), Some(&[true])).is_err());
        let broken = Picture { size: [7, 5], pixels: Vec::new() };
        assert!(compare(&broken, &picture([7, 5]), None).is_err());
        assert!(Picture::new([0, 5], Vec::new()).is_err());
    }

    #[test]
    fn draws_the_difference() {
        let a = picture([2, 1]);
        let mut b = a.clone();
        b.pixels[1][0] += 0.0625;
        let d = difference(&a, &b, 4.0).unwrap();
        assert_eq!(d.pixels[0], [0.0, 0.0, 0.0, 1.0]);
        assert!((d.pixels[1][1] - 0.25).abs() < 1e-6);
    }
}

mod picture_files {
    use super::*;

    #[test]
    fn png_is_srgb_over_the_background() {
        let p = Picture::new([3, 1], vec![[0.0; 4], [0.2, 0.0, 0.0, 0.5], [2.0, f32::NAN, 0.5, 1.0]]).unwrap();
        let bytes = p.encode(PictureFormat::Png, [1.0, 0.5, 0.0]).unwrap();
        let read = image::load_from_memory(&bytes).unwrap().into_rgb8();
        assert_eq!(read.dimensions(), (3, 1));
        // sRGB of 0.5 is 187.5, of 0.25 136.96, of 0.7 217.9.
        assert_eq!(read.get_pixel(0, 0).0, [255, 188, 0]);
        assert_eq!(read.get_pixel(1, 0).0, [218, 137, 0]);
        assert_eq!(read.get_pixel(2, 0).0, [255, 0, 188]);
    }

    #[test]
    fn exr_holds_the_floats() {
        let p = picture([7, 5]);
        let bytes = p.encode(PictureFormat::Exr, [1.0; 3]).unwrap();
        let read = image::load_from_memory_with_format(&bytes, image::ImageFormat::OpenExr).unwrap().into_rgba32f();
        assert_eq!(read.dimensions(), (7, 5));
        assert_eq!(read.as_raw().as_slice(), p.pixels.as_flattened());
    }

    #[test]
    fn npy_holds_the_floats() {
        let p = picture([7, 5]);
        let bytes = p.encode(PictureFormat::Npy, [1.0; 3]).unwrap();
        let file = npyz::NpyFile::new(&bytes[..]).unwrap();
        assert_eq!(file.shape(), [5, 7, 4]);
        assert_eq!(file.into_vec::<f32>().unwrap(), p.pixels.as_flattened());
    }

    #[test]
    fn appear_whole_under_their_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.png");
        picture([4, 4]).write(&path, [0.0; 3]).unwrap();
        picture([7, 5]).write(&path, [0.0; 3]).unwrap();
        assert_eq!(image::image_dimensions(&path).unwrap(), (7, 5));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "a temporary file was left behind");
    }

    #[test]
    fn of_an_unknown_kind_are_refused() {
        for (name, word) in [("out.jpg", ".jpg"), ("out", "extension")] {
            let error = picture([1, 1]).write(Path::new(name), [0.0; 3]).unwrap_err().to_string();
            assert!(error.contains(word) && error.contains(".png, .exr or .npy"), "{error}");
        }
        assert_eq!(PictureFormat::of(Path::new("-")).unwrap(), PictureFormat::Png);
        assert_eq!(PictureFormat::of(Path::new("-.npy")).unwrap(), PictureFormat::Npy);
        assert_eq!(PictureFormat::of(Path::new("A.EXR")).unwrap(), PictureFormat::Exr);
    }

    #[test]
    fn in_an_impossible_place_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        write_atomically(&file, b"x").unwrap();
        let error = write_atomically(&file.join("below"), b"x").unwrap_err();
        assert_eq!(error.exit_code(), 6);
        assert!(error.to_string().contains("choose another folder"), "{error}");
        assert!(write_atomically(folder.path(), b"x").unwrap_err().to_string().contains("is a folder"));
        assert_eq!(std::fs::read(&file).unwrap(), b"x");
    }

    #[cfg(unix)]
    #[test]
    fn go_through_links_and_into_devices() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        std::fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_atomically(&link, b"new").unwrap();
        assert!(link.is_symlink());
        assert_eq!(std::fs::read(&file).unwrap(), b"new");
        write_atomically(Path::new("/dev/null"), b"gone").unwrap();
        assert!(!Path::new("/dev/null").is_file());
    }
}
