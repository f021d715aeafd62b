//! How far apart voxels are: by spacings, directions and the ends of axes.

use crate::kit::{SMALL, nrrd, refusal, says, sized, volume};

const SIZES: [usize; 3] = [4, 5, 6];

/// Without a word.
fn spacing(lines: &str) -> [f64; 3] {
    let volume = volume(&SIZES, lines);
    assert_eq!(volume.warnings, [""; 0], "{lines}");
    volume.spacing
}

#[test]
fn spacings_count_and_unknown_is_one() {
    assert_eq!(spacing(""), [1.0; 3]);
    assert_eq!(spacing("spacings: 0.5 NaN 2"), [0.5, 1.0, 2.0]);
    assert_eq!(spacing("spacings: nan NAN -nan"), [1.0; 3]);
}

#[test]
fn space_directions_give_their_lengths() {
    let lines = "space: left-posterior-superior\nspace directions: (3,4,0) (4, -3, 0) (0,0,0.5)";
    assert_eq!(spacing(lines), [5.0, 5.0, 0.5]);
    let extreme = volume(&[1, 1, 1], "space directions: (1e-30,0,0) (0,1,0) (0,0,1e30)");
    assert_eq!((extreme.spacing, extreme.warnings.len()), ([1e-30, 1.0, 1e30], 0));
    // The squares of these lengths overflow, or vanish.
    for sides in ["(1e-200,0,0) (0,1,0) (0,0,1)", "(1e200,0,0) (0,1,0) (0,0,1)"] {
        assert!(refusal(&nrrd(&format!("{SMALL}\nspace directions: {sides}"), &[0; 4])).contains("has the sides"));
    }
}

#[test]
fn directions_that_are_not_a_number_are_unknown() {
    assert_eq!(spacing("space directions: (nan,nan,nan) (0,2,0) (0,0,0.625)"), [1.0, 2.0, 0.625]);
    assert_eq!(spacing("space directions: (2,0,0) (0,NaN,0) (0,0,0.625)"), [2.0, 1.0, 0.625]);
    let lines = "space directions: (nan,nan,nan) (0,2,0) (0,0,0.625)\nspacings: 3 nan nan";
    assert_eq!(spacing(lines), [3.0, 2.0, 0.625]);
}

#[test]
fn negative_spacings_count_by_their_size_and_are_told_of() {
    let read = volume(&SIZES, "spacings: -1 1 -0.625");
    assert_eq!((read.spacing, read.warnings.len()), ([1.0, 1.0, 0.625], 2));
    assert!(says(&read.warnings, &["`spacings` give axis 0 the negative spacing -1", "not reversed"]));
    assert!(says(&read.warnings, &["axis 2 the negative spacing -0.625"]));
    assert_eq!(crate::kit::bytes(&read), crate::kit::counted(&SIZES));
}

/// (max - min) / size of cells, (max - min) / (size - 1) of nodes; cells where nothing is said.
#[test]
fn the_ends_of_axes_give_spacings_by_where_samples_stand() {
    let ends = "axis mins: 0 -10 100\naxis maxs: 6 10 130";
    assert_eq!(spacing(&format!("{ends}\ncenters: cell cell cell")), [1.5, 4.0, 5.0]);
    assert_eq!(spacing(&format!("{ends}\ncenters: node node node")), [2.0, 5.0, 6.0]);
    assert_eq!(spacing(&format!("{ends}\ncenters: node cell node")), [2.0, 4.0, 6.0]);
    for unsaid in ["", "centers: ??? ??? ???", "centers: none none none"] {
        assert_eq!(spacing(&format!("{ends}\n{unsaid}")), [1.5, 4.0, 5.0]);
    }
    assert_eq!(spacing("axis mins: 0 nan 0\naxis maxs: 8 1 nan\ncenters: cell cell cell"), [2.0, 1.0, 1.0]);
    assert_eq!(spacing("axis mins: 0 0 0"), [1.0; 3]);
}

#[test]
fn ends_that_fall_are_negative_spacings() {
    let read = volume(&SIZES, "axis mins: 8 0 0\naxis maxs: 0 5 6\ncenters: cell cell cell");
    assert_eq!(read.spacing, [2.0, 1.0, 1.0]);
    assert!(says(&read.warnings, &["`axis mins` and `axis maxs` give axis 0 the negative spacing -2"]));
}

/// Where another field tells the spacing, unsaid centers are what fits it.
#[test]
fn unsaid_centers_follow_the_other_field() {
    let ends = "axis mins: 0 0 0\naxis maxs: 6 20 30";
    assert_eq!(spacing(&format!("{ends}\nspacings: 2 5 6")), [2.0, 5.0, 6.0]);
    assert_eq!(spacing(&format!("{ends}\nspacings: 1.5 4 5")), [1.5, 4.0, 5.0]);
    assert_eq!(spacing(&format!("{ends}\nspace directions: (0,2,0) (5,0,0) (0,0,5)\n")), [5.0, 2.0, 5.0]);
    let message = refusal(&nrrd(&sized(&SIZES, &format!("{ends}\nspacings: 3 5 6")), &[0; 120]));
    assert!(message.contains("along axis 0 is 3 by `spacings`, but 2 by `axis mins` and `axis maxs`"), "{message}");
}

/// Numbers that were rounded as they were written contradict nobody.
#[test]
fn rounded_numbers_agree() {
    assert_eq!(
        spacing("spacings: 0.6667 1 1\naxis mins: 0 nan nan\naxis maxs: 2 nan nan\ncenters: node ??? ???")[0],
        0.6667
    );
    assert_eq!(spacing("spacings: 1 1 1\nspace directions: (0.7071,0.7071,0) (-0.7071,0.7071,0) (0,0,1)")[2], 1.0);
    // Far from 0, the difference of the ends is as coarse as the ends.
    let far = "spacings: 0.1 1 1\naxis mins: 100000 nan nan\naxis maxs: 100000.3 nan nan\ncenters: node ??? ???";
    assert_eq!(spacing(far)[0], 0.1);
}

#[test]
fn an_axis_of_one_sample_needs_no_ends_apart() {
    for centers in ["node", "???"] {
        let lines = format!("axis mins: 0 3 0\naxis maxs: 8 3 6\ncenters: cell {centers} cell");
        assert_eq!(volume(&[4, 1, 6], &lines).spacing, [2.0, 1.0, 1.0], "{centers}");
    }
    let lines = "axis mins: 0 3 0\naxis maxs: 8 5 6\ncenters: cell cell cell";
    assert_eq!(volume(&[4, 1, 6], lines).spacing, [2.0, 2.0, 1.0]);
    let message = refusal(&nrrd(&sized(&SIZES, "axis mins: 0 0 0\naxis maxs: 1 1 0"), &[0; 120]));
    assert!(message.contains("axis 2 is 0 by `axis mins` and `axis maxs`"), "{message}");
}
