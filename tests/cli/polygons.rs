//! What the command line says of polygons and clip geometry.

use crate::driverless;

const LOOK: &str = "--viewport 24x18 --method cpu";

/// A scene file of a small volume.
fn scene(rest: &str) -> String {
    format!("[volume]\nbuiltin = \"shells:12\"\n{rest}")
}

#[test]
fn layers_that_are_not_peeled_come_with_a_warning() {
    let place = driverless();
    place.file("a.toml", scene("[[mesh]]\nbuiltin = \"sphere\"\nopacity = 0.3\nscale = 0.7\n"));
    let told = place.done(&format!("render a.toml {LOOK} --layers 1 -o a.png --json a.json")).err;
    assert!(told.contains("pixels lack layers of transparent polygons, up to 1 layer, since 1 are peeled"), "{told}");
    assert!(told.contains("raise layers.most (--layers)"), "{told}");
    let warnings = place.json("a.json")["warnings"].to_string();
    assert!(warnings.contains("pixels lack"), "{warnings}");
    let told = place.done(&format!("render a.toml {LOOK} --layers 2 -o a.png")).err;
    assert!(!told.contains("lack"), "{told}");
}

#[test]
fn clip_geometry_that_does_not_cover_the_volume_comes_with_a_warning() {
    let place = driverless();
    place.file("a.toml", scene("[[clip]]\nbuiltin = \"sphere\"\nkeep = \"thesis\"\n"));
    let told = place.done(&format!("render a.toml {LOOK} -o a.png")).err;
    assert!(told.contains("clip geometry does not cover the volume in"), "{told}");
    place.file("b.toml", scene("[[clip]]\nbuiltin = \"sphere\"\nkeep = \"thesis\"\nscale = 3.0\n"));
    let told = place.done(&format!("render b.toml {LOOK} --eye 0,0,4 -o b.png")).err;
    assert!(!told.contains("cover"), "{told}");
    place.file("c.toml", scene("[[clip]]\nbuiltin = \"box\"\nscale = 0.1\ntranslate = [0.0, 2.0, 0.0]\n"));
    let told = place.done(&format!("render c.toml {LOOK} -o c.png")).err;
    assert!(told.contains("the picture is empty: what shows is clipped"), "{told}");
}

#[test]
fn planes_come_from_scene_files_and_options() {
    let place = driverless();
    place.file("a.toml", scene("[[clip]]\nplane = [0, 1, 0, 0.1]\n"));
    assert_eq!(place.done(&format!("render a.toml {LOOK} -o a.png")).err.matches("warning:").count(), 0);
    let told = place.done(&format!("render a.toml {LOOK} --clip-plane 0,-1,0,-0.2 -o a.png")).err;
    assert!(told.contains("the picture is empty: clip planes leave less than one sample"), "{told}");
    let json = place.done(&format!("render a.toml {LOOK} --clip-plane=-1,0,0,0.3 -o a.png --json -")).out;
    let settings = serde_json::from_slice::<serde_json::Value>(&json).unwrap()["settings"]["clip"].take();
    let planes: Vec<_> = settings.as_array().unwrap().iter().map(|clip| clip["plane"][0].as_f64().unwrap()).collect();
    assert_eq!(planes, [0.0, -1.0]);
}

#[test]
fn nothing_is_written_where_geometry_is_wrong() {
    let place = driverless();
    for (rest, says) in [
        ("[[mesh]]\npath = \"none.ply\"\n", "none.ply"),
        ("[[clip]]\nplane = [0, 0, 0, 1]\n", "a normal of length 0"),
        ("[[clip]]\nplane = [0, 0, 1]\n", "3 entries where there have to be 4"),
        ("[[clip]]\nplane = [0, 0, 1, 0]\nbuiltin = \"box\"\n", "stands beside other keys"),
        (&"[[clip]]\nplane = [0, 0, 1, 0]\n".repeat(7), "has 7 planes"),
        ("[[clip]]\nbuiltin = \"spheer\"\n", "did you mean `sphere`"),
        ("[[clip]]\nbuiltin = \"box\"\ntransform = [[1, 0, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0]]\n", "determinant"),
    ] {
        place.file("a.toml", scene(rest));
        let ended = place.run(&format!("render a.toml {LOOK} -o a.png"));
        assert!(ended.code != Some(0) && ended.err.contains(says), "{}", ended.err);
        assert!(!place.path().join("a.png").exists());
    }
}
