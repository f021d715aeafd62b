//! Sequences of volumes, stacks of pictures, and single pictures.

use depthleap::read::ReadChoice;
use depthleap::scene::settings::Component::Number;

use crate::kit::{bytes, chosen, component, counted, frame, says, volume};

/// What makes the last of four axes number the volumes of a sequence.
const SEQUENCES: [&str; 5] = [
    "kinds: domain domain domain time",
    "kinds: space space space list",
    "kinds: domain domain domain ???",
    "space directions: (1,0,0) (0,1,0) (0,0,1) none",
    "kinds: domain domain domain none\nspace directions: (1,0,0) (0,1,0) (0,0,1) none",
];

#[test]
fn one_volume_of_a_sequence_is_taken_by_its_number() {
    for lines in SEQUENCES {
        for n in 0..5u8 {
            let volume = chosen(&[2, 3, 4, 5], lines, &frame(usize::from(n))).unwrap();
            let expected: Vec<u8> = (24 * n..24 * n + 24).collect();
            assert_eq!((volume.dims, bytes(&volume)), ([2, 3, 4], &expected[..]), "{lines}");
        }
        let message = chosen(&[2, 3, 4, 5], lines, &ReadChoice::default()).unwrap_err().to_string();
        let parts = ["volume.frame (--frame): is needed", "5 volumes", "from 0 to 4"];
        assert!(parts.iter().all(|part| message.contains(part)), "{lines}: {message}");
        let beyond = chosen(&[2, 3, 4, 5], lines, &frame(5)).unwrap_err().to_string();
        assert!(beyond.contains("is 5, and the file holds 5") && beyond.contains("from 0 to 4"), "{beyond}");
    }
    assert_eq!(chosen(&[2, 3, 4], "", &frame(0)).unwrap().dims, [2, 3, 4]);
    let none = chosen(&[2, 3, 4], "", &frame(1)).unwrap_err().to_string();
    assert!(none.contains("is 1, and the file holds one volume") && none.contains("leave it out"), "{none}");
}

/// A time axis is one wherever it stands.
#[test]
fn time_in_front_is_a_sequence_too() {
    let volume = chosen(&[5, 2, 3, 4], "kinds: time domain domain domain", &frame(3)).unwrap();
    let expected: Vec<u8> = (0..24).map(|i| 5 * i + 3).collect();
    assert_eq!((volume.dims, bytes(&volume)), ([2, 3, 4], &expected[..]));
}

#[test]
fn a_component_of_a_frame_is_taken_by_both_numbers() {
    let choice = ReadChoice { component: Some(Number(1)), ..frame(2) };
    for lines in ["kinds: vector domain domain domain time", "kinds: vector space space space list"] {
        let volume = chosen(&[2, 3, 2, 4, 3], lines, &choice).unwrap();
        let expected: Vec<u8> = (0..24).map(|i| 2 * 24 * 2 + 2 * i + 1).collect();
        assert_eq!((volume.dims, bytes(&volume)), ([3, 2, 4], &expected[..]), "{lines}");
    }
}

/// Pictures that follow one another, as ultrasound writes them, are slices unless one is picked.
#[test]
fn pictures_in_a_row_are_slices_as_far_apart_as_their_pixels() {
    let lines = "kinds: domain domain list\nspacings: 0.5 0.25 nan";
    let stack = volume(&[3, 4, 5], lines);
    assert_eq!((stack.dims, stack.spacing, bytes(&stack)), ([3, 4, 5], [0.5, 0.25, 0.25], &counted(&[3, 4, 5])[..]));
    assert!(says(&stack.notes, &["5 pictures", "slices of one volume, 0.25 apart", "--frame"]), "{:?}", stack.notes);
    let picked = chosen(&[3, 4, 5], lines, &frame(2)).unwrap();
    assert_eq!((picked.dims, bytes(&picked)), ([3, 4, 1], &(24..36).collect::<Vec<u8>>()[..]));
    assert!(says(&picked.notes, &["one voxel thick"]), "{:?}", picked.notes);
    let stated = volume(&[3, 4, 5], "kinds: domain domain list\nspacings: 0.5 0.25 7");
    assert_eq!(stated.spacing, [0.5, 0.25, 7.0]);
}

/// Seconds are no distance.
#[test]
fn pictures_in_time_are_slices_as_far_apart_as_their_pixels() {
    for lines in ["kinds: domain domain time\nspacings: 0.5 0.25 30", "kinds: space space time\nspacings: 0.5 0.25 nan"]
    {
        let film = volume(&[3, 4, 5], lines);
        assert_eq!((film.dims, film.spacing), ([3, 4, 5], [0.5, 0.25, 0.25]), "{lines}");
        assert!(says(&film.notes, &["5 pictures", "--frame"]), "{:?}", film.notes);
    }
}

#[test]
fn a_picture_is_one_voxel_thick() {
    for lines in ["", "kinds: domain domain", "space directions: (0.5,0) (0,0.25)"] {
        let picture = volume(&[3, 4], lines);
        assert_eq!((picture.dims, bytes(&picture)), ([3, 4, 1], &counted(&[3, 4])[..]), "{lines}");
        assert!(says(&picture.notes, &["holds a picture"]), "{:?}", picture.notes);
    }
    assert_eq!(volume(&[3, 4], "spacings: 0.5 0.25").spacing, [0.5, 0.25, 0.25]);
    let colours = "kinds: RGB-color domain domain";
    let green = chosen(&[3, 2, 4], colours, &component(Number(1))).unwrap();
    assert_eq!((green.dims, bytes(&green)), ([2, 4, 1], &[1, 4, 7, 10, 13, 16, 19, 22][..]));
    let message = chosen(&[3, 2, 4], colours, &ReadChoice::default()).unwrap_err().to_string();
    assert!(message.contains("--component"), "{message}");
}

#[test]
fn fewer_than_two_axes_of_space_are_refused() {
    for (sizes, lines) in [(&[5][..], ""), (&[3, 5], "kinds: vector domain"), (&[3, 4, 5], "kinds: vector domain time")]
    {
        let message = chosen(sizes, lines, &ReadChoice::default()).unwrap_err().to_string();
        assert!(message.contains("of which 1 may lie in space") && message.contains("(a picture)"), "{message}");
    }
}
