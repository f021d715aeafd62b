//! Options: help, and what is refused.

use crate::program::Ended;
use crate::{SMALL, driverless};

#[test]
fn rejects_viewports_without_pixels_or_sense() {
    let place = driverless();
    place.refused("render --viewport 0x10 -o a.png", 2, &["--viewport", "[0, 10]", "from 1 to 65535"]);
    place.refused("render --viewport 10x0 -o a.png", 2, &["--viewport", "[10, 0]"]);
    place.refused("render --viewport 70000x10 -o a.png", 2, &["--viewport", "70000"]);
    for odd in ["10", "axb", "-5x5", "1e9x4", "5x5x5", "x", "99999999999x1"] {
        place.refused(&format!("render --viewport {odd} -o a.png"), 2, &["--viewport <WxH>", odd]);
    }
}

#[test]
fn rejects_steps_that_are_none() {
    let place = driverless();
    for odd in ["0", "-1", "nan", "inf", "1e-9", "1e9"] {
        place.refused(&format!("render --step {odd} -o a.png"), 2, &["--step", "from 0.0001 to 1000000"]);
    }
    place.refused("render --step long -o a.png", 2, &["--step <VOXELS>", "'long'"]);
}

#[test]
fn rejects_numbers_out_of_their_range() {
    let place = driverless();
    for (option, parts) in [
        ("--samples-per-pass 65537", ["--samples-per-pass", "from 0 to 65536, or auto"]),
        ("--samples-per-pass many", ["--samples-per-pass", "it is not auto either"]),
        ("--samples-per-pass -1", ["--samples-per-pass", "-1"]),
        ("--passes 65537", ["--passes", "65536"]),
        ("--termination 1.5", ["--termination", "from 0 to 1"]),
        ("--termination nan", ["--termination", "NaN"]),
        ("--reference 0", ["--reference", "from 0.000001 to 1000000"]),
        ("--reference 1e-308", ["--reference", "from 0.000001 to 1000000"]),
        ("--range 5,1", ["--range", "[5, 1]"]),
        ("--range 5", ["--range", "2 ends are needed, and the number given is 1"]),
        ("--background 2,0,0", ["--background", "from 0 to 1"]),
        ("--eye 1,2", ["--eye", "3 numbers are needed, and the number given is 2"]),
        ("--eye 1,2,nan", ["--eye", "`nan`"]),
        ("--eye 0,0,0", ["camera", "eye and target"]),
        ("--eye 0,1,0", ["camera", "--up"]),
        ("--fov 0", ["camera", "field of view"]),
        ("--fov 180", ["camera", "below 180"]),
        ("--ortho-height 0", ["--ortho-height", "from 0.000001 to 1000000"]),
        ("--ortho-height 1 --fov 40", ["--ortho-height", "--fov"]),
        ("--repeats -1", ["--repeats", "-1"]),
        ("--passes 65536 --samples-per-pass 65536", ["4294967296 samples", "fewer passes"]),
        ("--step 0.0001 --samples-per-pass 1", ["main passes", "65536"]),
    ] {
        place.refused(&format!("{SMALL} {option} -o a.png"), 2, &parts);
    }
}

#[test]
fn names_the_nearest_of_an_unknown_word() {
    let place = driverless();
    for (arguments, near) in [
        ("rendr -o a.png", "'render'"),
        ("render --stepp 1 -o a.png", "'--step'"),
        ("render --method nn-omin -o a.png", "'nn-omni'"),
        ("render --cull bound -o a.png", "'bounds'"),
        ("bench --method rc,rc-blok -o a", "'rc-block'"),
        ("render --tf rmap -o a.png", "`ramp`"),
        ("render builtin:shell -o a.png", "`shells`"),
        ("render builtin:engine-geometry:64 -o a.png", "of the scenes, which take no size: engine-geometry"),
    ] {
        place.refused(arguments, 2, &[near]);
    }
}

#[test]
fn help_tells_exit_codes_and_examples() {
    let place = driverless();
    let help = place.done("--help").text();
    for built_in in ["  shells ", "  engine ", "  engine-geometry "] {
        assert!(help.contains(built_in), "{built_in}: {help}");
    }
    for code in ["  0  ", "  2  ", "  3  ", "  4  ", "  5  ", "  6  ", "NO_COLOR"] {
        assert!(help.contains(code), "{code}: {help}");
    }
    for command in ["render", "bench", "compare", "plan", "info"] {
        let help = place.done(&format!("{command} --help")).text();
        assert!(help.contains("Examples:\n  depthleap ") && help.lines().all(|l| l.chars().count() <= 100), "{help}");
    }
    assert_eq!(place.run("").code, Some(2));
}

#[test]
fn no_color_is_honoured() {
    let help = |no_color: Option<&str>| {
        let place = driverless();
        let mut command = place.command("--help");
        command.env("CLICOLOR_FORCE", "1").env_remove("NO_COLOR");
        command.envs(no_color.map(|value| ("NO_COLOR", value)));
        Ended::of(command.output().unwrap()).text()
    };
    assert!(help(None).contains('\u{1b}'));
    assert!(!help(Some("1")).contains('\u{1b}'));
}

#[test]
fn no_driver_at_all_is_told() {
    let place = driverless();
    for arguments in ["info", "render -o a.png", "bench -o out"] {
        place.refused(arguments, 4, &["Vulkan", "VK_DRIVER_FILES names /nonexistent", "unset the variable"]);
    }
}

#[test]
fn a_wrong_file_to_repeat_from_is_refused() {
    let place = driverless();
    place.file("a.json", r#"{"runs": [{"settings": {}}, {"settings": {"sampling": {"setp": 1}}}]}"#);
    place.file("b.json", "what");
    place.refused("render --from a.json -o a.png", 3, &["a.json", "2 runs", "a.json#1"]);
    place.refused("render --from a.json#2 -o a.png", 3, &["none numbered 2"]);
    place.refused("render --from a.json#1 -o a.png", 3, &["`setp`", "did you mean `step`?"]);
    place.refused("render --from b.json -o a.png", 3, &["b.json", "not JSON"]);
    place.refused("render --from c.json -o a.png", 3, &["c.json", "cannot be read"]);
    place.refused("render builtin:shells --from a.json -o a.png", 2, &["--from"]);
}
