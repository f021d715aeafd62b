//! `depthleap shells`: iso-surfaces as polygons in a PLY file.

use depthleap::read;

use crate::driverless;

/// The numbers in a column of the table.
fn column(told: &str, number: usize) -> Vec<f64> {
    let cell = |line: &str| line.split_whitespace().nth(number)?.replace(',', "").parse().ok();
    told.lines().filter_map(cell).collect()
}

#[test]
fn each_level_is_a_surface_in_the_file() {
    let place = driverless();
    let told = place.done("shells builtin:gaussian:16 --levels 0.7,0.3 -o a.ply").err;
    assert_eq!(column(&told, 0), [0.3, 0.7], "{told}");
    let mesh = read::mesh(&place.path().join("a.ply")).unwrap();
    let sums = [1, 2].map(|i| column(&told, i).iter().sum::<f64>() as usize);
    assert_eq!([mesh.corners.len(), mesh.triangles.len()], sums, "{told}");
    assert!(mesh.triangles.len() > 500);
    // Each vertex has its level.
    let bytes = place.read("a.ply");
    let end = b"end_header\n";
    let first = bytes.windows(end.len()).position(|part| part == end).unwrap() + end.len();
    let value = |vertex: usize| f64::from_le_bytes(bytes[first + 20 * vertex + 12..][..8].try_into().unwrap());
    assert_eq!([value(0), value(mesh.corners.len() - 1)], [0.3, 0.7]);
    let piped = place.done("shells builtin:gaussian:16 --levels 0.3,0.7 -o -");
    assert!(piped.out == bytes, "standard output has the same");
}

#[test]
fn levels_are_spread_over_the_range() {
    let place = driverless();
    let told = place.done("shells builtin:gaussian:8 --count 2 --range 0,0.8 -o a.ply").err;
    let levels = column(&told, 0);
    let off = levels.iter().zip([0.2, 0.6]).map(|(level, rule)| (level - rule).abs()).fold(0.0, f64::max);
    assert!(levels.len() == 2 && off < 1e-12, "{told}");
}

#[test]
fn levels_that_make_no_surface_come_with_a_warning() {
    let place = driverless();
    let told = place.done("shells builtin:gaussian:8 --levels -3,0.5,7,0.5 -o a.ply").err;
    assert!(told.contains("warning: gaussian:8, ramp: a repeated level is written once"), "{told}");
    assert!(told.contains("all values lie on one side of -3, 7: there is no surface"), "{told}");
    let told = place.done("shells builtin:constant:8 --count 3 -o b.ply").err;
    assert!(told.contains("there is no surface"), "{told}");
    let empty = String::from_utf8_lossy(&place.read("b.ply")).into_owned();
    assert!(empty.contains("element vertex 0\n") && empty.contains("element face 0\n"), "{empty}");
}

#[test]
fn levels_that_make_no_sense_are_refused() {
    let place = driverless();
    let many = vec!["1"; 1000].join(",");
    for (arguments, part) in [
        ("--count 0", "0 levels"),
        ("--count 1000", "1000 levels"),
        (&*format!("--levels {many}"), "1000 levels"),
        ("--levels nan", "not a finite number"),
        ("--levels inf,0.5", "not a finite number"),
        ("--levels 0.5 --count 2", "cannot be used with"),
        ("", "--levels"),
    ] {
        place.refused(&format!("shells builtin:gaussian:8 {arguments} -o a.ply"), 2, &[part]);
    }
    place.refused("shells builtin:gaussian:8 --levels 0.5 -o missing/a.ply", 6, &["missing"]);
    place.refused("shells none.nrrd --levels 0.5 -o a.ply", 3, &["none.nrrd"]);
}

#[test]
fn shells_lie_as_their_volume_does() {
    let place = driverless();
    let header = |directions: &str| {
        format!(
            "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 2 2\nspace: left-posterior-superior\n\
             space directions: {directions}\nencoding: raw\n\n"
        )
    };
    let voxels = [0u8, 0, 200, 200].repeat(4);
    for (name, directions) in [("a", "(1,0,0) (0,1,0) (0,0,1)"), ("b", "(0,1,0) (-1,0,0) (0,0,1)")] {
        place.file(&format!("{name}.nrrd"), [header(directions).as_bytes(), &voxels].concat());
        place.done(&format!("shells {name}.nrrd --levels 100 -o {name}.ply"));
    }
    let wide = |name: &str| {
        let [low, high] = read::mesh(&place.path().join(name)).unwrap().bounds();
        high - low
    };
    // Across the first axis of the file, which is y of the second volume.
    let [a, b] = [wide("a.ply"), wide("b.ply")];
    assert!(a.x < 1e-6 && (a.y - 0.5).abs() < 1e-6, "{a}");
    assert!(b.y < 1e-6 && (b.x - 0.5).abs() < 1e-6, "{b}");
}
