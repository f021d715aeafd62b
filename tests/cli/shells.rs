//! `depthleap shells`: iso-surfaces as polygons in a PLY file.

use depthleap::read;

use crate::driverless;

#[test]
fn each_level_is_a_surface_in_the_file() {
    let place = driverless();
    let told = place.done("shells builtin:gaussian:16 --levels 0.7,0.3 -o a.ply").err;
    let rows: Vec<Vec<&str>> = told.lines().map(|line| line.split_whitespace().collect()).collect();
    let levels: Vec<&str> = rows.iter().skip(1).map(|row| row[0]).collect();
    assert_eq!(levels, ["0.3", "0.7"], "{told}");
    let mesh = read::mesh(&place.path().join("a.ply")).unwrap();
    let sum =
        |column: usize| rows.iter().skip(1).map(|row| row[column].replace(',', "").parse::<usize>().unwrap()).sum();
    assert_eq!([mesh.corners.len(), mesh.triangles.len()], [sum(1), sum(2)], "{told}");
    assert!(mesh.triangles.len() > 500);
    // Each vertex has its level.
    let bytes = place.read("a.ply");
    let end = b"end_header\n";
    let first = bytes.windows(end.len()).position(|part| part == end).unwrap() + end.len();
    let value = |vertex: usize| f32::from_le_bytes(bytes[first + 16 * vertex + 12..][..4].try_into().unwrap());
    assert_eq!([value(0), value(mesh.corners.len() - 1)], [0.3, 0.7]);
    let piped = place.done("shells builtin:gaussian:16 --levels 0.3,0.7 -o -");
    assert!(piped.out == bytes, "standard output has the same");
}

#[test]
fn levels_are_spread_over_the_range() {
    let place = driverless();
    let told = place.done("shells builtin:gaussian:8 --count 2 --range 0,0.8 -o a.ply").err;
    assert!(told.contains("\n 0.2 ") || told.contains("  0.2"), "{told}");
    assert!(told.contains("0.6"), "{told}");
}

#[test]
fn levels_that_make_no_surface_come_with_a_warning() {
    let place = driverless();
    let told = place.done("shells builtin:gaussian:8 --levels 0.5,7,-3,0.5 -o a.ply").err;
    assert!(told.contains("warning: gaussian:8: 1 of 4 levels are there twice"), "{told}");
    assert!(told.contains("no value lies on both sides of the level -3, 7: its surface has no polygons"), "{told}");
    let told = place.done("shells builtin:constant:8 --count 3 -o b.ply").err;
    assert!(told.contains("no polygons"), "{told}");
    assert!(read::mesh(&place.path().join("b.ply")).is_err() || place.read("b.ply").starts_with(b"ply\n"));
}

#[test]
fn levels_that_make_no_sense_are_refused() {
    let place = driverless();
    let many = vec!["1"; 1000].join(",");
    for (arguments, part) in [
        ("--count 0", "0 levels"),
        ("--count 1000", "1000 levels"),
        (&*format!("--levels {many}"), "1000 levels"),
        ("--levels nan", "NaN"),
        ("--levels inf,0.5", "inf"),
        ("--levels 0.5 --count 2", "cannot be used with"),
        ("", "--levels"),
    ] {
        place.refused(&format!("shells builtin:gaussian:8 {arguments} -o a.ply"), 2, &[part]);
    }
    place.refused("shells builtin:gaussian:8 --levels 0.5 -o missing/a.ply", 6, &["missing"]);
    place.refused("shells none.nrrd --levels 0.5 -o a.ply", 3, &["none.nrrd"]);
}
