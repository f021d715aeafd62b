//! Readers of meshes: what is written comes back in every format, what is wrong is refused by name.

use std::path::Path;

use depthleap::Result;
use depthleap::read;
use depthleap::scene::mesh::Mesh;

use crate::kit::{file, says};
use crate::mesh_samples::{Solid, cube, glb, tetrahedron};

fn read_as(name: &str, bytes: &[u8]) -> Result<Mesh> {
    let (_folder, path) = file(name, bytes);
    read::mesh(&path)
}

fn refusal(name: &str, bytes: &[u8]) -> String {
    match read_as(name, bytes) {
        Ok(mesh) => panic!("read {} triangles of {:?}", mesh.triangles.len(), String::from_utf8_lossy(bytes)),
        Err(error) => error.to_string(),
    }
}

/// The corners of each triangle.
fn places(mesh: &Mesh) -> Vec<[[f32; 3]; 3]> {
    mesh.triangles.iter().map(|triangle| triangle.map(|corner| mesh.corners[corner as usize])).collect()
}

/// A text with a part replaced, which has to be there.
fn changed(text: &[u8], from: &str, to: &str) -> Vec<u8> {
    let text = std::str::from_utf8(text).unwrap();
    assert!(text.contains(from), "{from} is not in {text}");
    text.replacen(from, to, 1).into_bytes()
}

#[test]
fn every_format_gives_the_triangles_that_were_written_whatever_its_name() {
    for solid in [tetrahedron(), cube()] {
        for (ending, bytes) in solid.files() {
            for name in [format!("a.{ending}"), format!("a.{}", ending.to_uppercase()), "a.xyz".into(), "a".into()] {
                let mesh = read_as(&name, &bytes).unwrap_or_else(|e| panic!("{ending}: {e}"));
                assert_eq!(places(&mesh), solid.places(), "{ending}");
                assert_eq!(mesh.warnings, [""; 0], "{ending}");
                assert!(mesh.name.ends_with(&name));
                assert!(ending == "stl" || mesh.corners == solid.corners, "{ending}");
            }
        }
    }
}

/// Texts may lose an end that says nothing, or that is only part of a number or a face.
#[test]
fn no_truncation_gives_more_than_was_written() {
    for solid in [tetrahedron(), cube()] {
        for (ending, bytes) in solid.files() {
            let is_text = std::str::from_utf8(&bytes).is_ok();
            for length in 0..bytes.len() {
                match read_as(&format!("a.{ending}"), &bytes[..length]) {
                    Ok(mesh) => {
                        let least = if ending == "obj" { 1 } else { solid.triangles().len() };
                        assert!(is_text && ending != "gltf", "accepted {length} of {} bytes of {ending}", bytes.len());
                        assert!((least..=solid.triangles().len()).contains(&mesh.triangles.len()));
                    }
                    Err(error) => assert!(error.to_string().contains(&format!("a.{ending}")), "{error}"),
                }
            }
        }
    }
}

#[test]
fn vertices_that_lie_nowhere_are_refused() {
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30] {
        let mut solid = tetrahedron();
        solid.corners[1][2] = value;
        for (ending, bytes) in solid.files() {
            let message = refusal(&format!("a.{ending}"), &bytes);
            assert!(message.contains("has vertex number 2 at [1.5, 0.0, "), "{ending}: {message}");
        }
    }
    let double = changed(&tetrahedron().ply("ascii"), "1.5", "1e300");
    assert!(refusal("a.ply", &double).contains("[1e300, "));
}

#[test]
fn indices_out_of_range_are_refused_with_their_value() {
    let mut solid = tetrahedron();
    solid.faces[2][1] = 77;
    let shared = Solid { corners: solid.corners.clone(), faces: solid.faces.clone() };
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let message = refusal("a.ply", &shared.ply(format));
        assert!(message.contains("triangle number 3 at index 77, where there are 4 vertices"), "{message}");
    }
    assert!(refusal("a.obj", &shared.obj()).contains("corner `78`, where there are 4 vertices"));
    for (ending, bytes) in [("gltf", shared.gltf()), ("glb", shared.glb())] {
        assert!(refusal(&format!("a.{ending}"), &bytes).contains("index 77 in a primitive of 4 vertices"));
    }
    let negative = changed(&tetrahedron().ply("ascii"), "3 0 1 2", "3 0 -1 2");
    assert!(refusal("a.ply", &negative).contains("has -1 in row 1 of element face (vertex_indices)"));
}

#[test]
fn corners_of_obj_count_back_from_the_last_vertex() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let mesh =
        read_as("a.obj", format!("{vertices}f -3/1 -2//4 -1/2/3\nv 0 0 1 1\nf -2 \\\n -3 -1\n").as_bytes()).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 3]]);
    for (face, named) in [
        ("f 0 1 2", "`0`"),
        ("f -4 1 2", "`-4`, where there are 3 vertices, 3 of them before in line 4"),
        ("f 1 2 x", "`x`"),
        ("f 1 2 1e2", "`1e2`"),
        ("f 1 2 99999999999999999999", "`99999999999999999999`"),
        ("f 1 2 -9223372036854775808", "`-9223372036854775808`"),
        ("f 1 2", "face of 2 corners in line 4"),
        ("v 1 2", "fewer than three coordinates in line 4"),
        ("v 1 2 y", "coordinate `y` in line 4"),
    ] {
        let message = refusal("a.obj", format!("{vertices}{face}\n").as_bytes());
        assert!(message.contains(named), "{message}");
    }
    let mesh = read_as("a.obj", format!("f 1 2 3\n{vertices}l 1 2\np 1\n").as_bytes()).unwrap();
    assert!(mesh.triangles == [[0, 1, 2]] && says(&mesh.warnings, &["lines", "in 2 lines, which are not read"]));
}

#[test]
fn a_mesh_without_triangles_is_refused() {
    let none = Solid { corners: tetrahedron().corners, faces: Vec::new() };
    for (ending, bytes) in none.files() {
        let message = refusal(&format!("a.{ending}"), &bytes);
        assert!(message.contains("holds no triangles"), "{ending}: {message}");
    }
    for ending in ["ply", "obj", "stl", "gltf", "glb"] {
        assert!(refusal(&format!("a.{ending}"), b"").contains(&format!("a.{ending}: ")));
    }
    let unknown = refusal("a.xyz", b"hello");
    let known = "no known mesh format (5 bytes); give a file of PLY (.ply), glTF (.gltf, .glb), STL (.stl), OBJ (.obj)";
    assert!(unknown.contains(known), "{unknown}");
}

#[test]
fn promises_that_a_file_does_not_keep_are_refused_at_once() {
    let solid = tetrahedron();
    let huge = |bytes: &[u8], from: &str, to: &str| {
        let at = bytes.windows(from.len()).position(|part| part == from.as_bytes()).unwrap();
        [&bytes[..at], to.as_bytes(), &bytes[at + from.len()..]].concat()
    };
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        for (from, count) in [("vertex 4", "4000000000"), ("face 4", "1000000000"), ("face 4", "18446744073709551615")]
        {
            let name = from.split(' ').next().unwrap();
            let message = refusal("a.ply", &huge(&solid.ply(format), from, &format!("{name} {count}")));
            let told = format!("promises {count} rows of element {name}");
            assert!(message.contains(&told) && message.contains("bytes are left"), "{message}");
        }
        let list = huge(&solid.ply(format), "list uchar", "list uint");
        let message = (format != "ascii").then(|| refusal("a.ply", &list));
        assert!(message.iter().all(|m| m.contains("ends in row")), "{message:?}");
    }
    let long = changed(&solid.ply("ascii"), "3 0 1 2", "4000000000 0 1 2");
    assert!(refusal("a.ply", &long).contains("ends in row 1 of element face"));
    let mut stl = solid.stl_bytes();
    stl[80..84].copy_from_slice(&1_000_000_000u32.to_le_bytes());
    assert!(refusal("a.stl", &stl).contains("promises 1000000000 triangles, 50000000084 bytes, where it holds 284"));
    let text = solid.gltf_text("");
    for (from, to, named) in [
        ("\"count\": 4", "\"count\": 1000000000", "promises 1000000000 entries in accessors[0], 12000000000 bytes"),
        ("\"count\": 4", "\"count\": 18446744073709551615", "promises 18446744073709551615 entries in accessors[0]"),
        ("\"byteLength\": 48", "\"byteLength\": 18446744073709551615", "promises 18446744073709551615 bytes from 0"),
        ("\"byteLength\": 72", "\"byteLength\": 4000000000", "promises 4000000000 bytes in buffers[0], which holds 72"),
        ("\"byteOffset\": 48", "\"byteOffset\": 18446744073709551615", "from 18446744073709551615 on"),
    ] {
        let message = refusal("a.glb", &glb(&text.replacen(from, to, 1), &solid.gltf_buffer()));
        assert!(message.contains(named), "{message}");
    }
}

#[test]
fn what_lies_behind_the_triangles_is_told() {
    let solid = tetrahedron();
    for (ending, bytes) in solid.files() {
        if ["obj", "gltf"].contains(&ending) {
            continue;
        }
        let mesh = read_as(&format!("a.{ending}"), &[&bytes[..], b"behind"].concat()).unwrap();
        assert_eq!(places(&mesh), solid.places());
        assert!(says(&mesh.warnings, &["holds 6 bytes behind its triangles"]), "{ending}: {:?}", mesh.warnings);
    }
}

/// Skipped loudly where the data are not there.
#[test]
fn a_scanned_mesh_is_read_whole() {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/lucy_decimated.ply"));
    if !path.exists() {
        eprintln!("SKIPPED: {} is not there", path.display());
        return;
    }
    let begin = std::time::Instant::now();
    let mesh = read::mesh(path).unwrap();
    eprintln!("{} triangles in {:?}", mesh.triangles.len(), begin.elapsed());
    assert_eq!((mesh.corners.len(), mesh.triangles.len()), (49_987, 99_970));
    assert_eq!(mesh.warnings, [""; 0]);
}
