//! What single formats of meshes have besides corners and faces: further elements, nodes, strips, files beside.

use depthleap::read;
use depthleap::scene::mesh::Mesh;

use crate::kit::{file, says};
use crate::mesh_samples::tetrahedron;

fn read_as(name: &str, text: &str) -> depthleap::Result<Mesh> {
    let (_folder, path) = file(name, text.as_bytes());
    read::mesh(&path)
}

#[test]
fn further_elements_and_columns_of_ply_are_stepped_over() {
    let header = "ply\r\nformat ascii 1.0\r\nobj_info of a test\r\nelement face 3\r\nproperty uchar red\r\n\
                  property list uchar uint vertex_index\r\nelement edge 1\r\nproperty list int double weights\r\n\
                  element nothing 4000000000\r\nelement vertex 5\r\nproperty double z\r\nproperty int8 y\r\n\
                  property uint16 x\r\nproperty float confidence\r\nend_header\r\n";
    let rows = "7 5 0 1 2 3 4\r\n8 2 0 1\r\n9 3 4 3 2\r\n2 0.5 0.25\r\n0 0 0 1\r\n0 0 1 1\r\n0 1 1 1\r\n0 2 0 1\r\n0.5 -1 0 1\r\n";
    let mesh = read_as("a.ply", &[header, rows].concat()).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [4, 3, 2]]);
    assert_eq!((mesh.corners[1], mesh.corners[4]), ([1.0, 0.0, 0.0], [0.0, -1.0, 0.5]));
    assert!(says(&mesh.warnings, &["1 face of fewer than three corners"]), "{:?}", mesh.warnings);
    let longer = [header, &rows.replace("8 2 0 1", "8 2 0 1 1")].concat();
    let message = read_as("a.ply", &longer).unwrap_err().to_string();
    assert!(message.contains("has `1` in line 17, in row 2 of element face"), "{message}");
}

#[test]
fn lying_headers_of_ply_are_refused_by_name() {
    let right = String::from_utf8(tetrahedron().ply("ascii")).unwrap();
    for (from, to, named) in [
        ("format ascii", "format latin", "`format latin 1.0` in line 2"),
        ("format ascii 1.0\n", "", "no `format`"),
        ("element vertex 4", "element vertex -4", "`element vertex -4` in line 4"),
        ("element vertex 4", "element vertices 4", "[vertices, face]"),
        ("property float x", "property float u", "x, y and z"),
        ("float x", "list uchar float x", "x, y and z"),
        ("float x", "real x", "`property real x` in line 5"),
        ("uchar int", "int", "`property list int vertex_indices`"),
        ("vertex_indices", "corners", "vertex_indices"),
        ("end_header", "end_head", "`end_head`"),
        ("3 0 1 2", "3 0 1 two", "`two` in line 15, in row 1 of element face"),
        ("3 0 1 2", "3.5 0 1 2", "has 3.5 in row 1"),
        ("ply\n", "plyx\n", "`plyx`"),
    ] {
        let message = read_as("a.ply", &right.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(message.contains(named), "{to}: {message}");
    }
}

#[test]
fn texts_of_stl_hold_several_solids_and_name_what_is_wrong() {
    let facet =
        "FACET normal 0 0 1 outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop endfacet\n";
    let right = format!("\n Solid\n{facet}endsolid\nsolid again\n{facet}EndSolid again");
    let mesh = read_as("a.stl", &right).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]);
    for (from, to, named) in [
        ("vertex 1 1 0", "vertex 1 one 0", "has `one` in line 6, where a coordinate is asked for"),
        ("vertex 1 1 0", "corner 1 1 0", "has `corner` in line 6, where vertex or endloop"),
        ("endloop", "", "where vertex or endloop is asked for"),
        ("outer", "inner", "has `inner` in line 3, where outer"),
        ("endsolid", "end", "has `end` in line 9, where facet or endsolid"),
        ("EndSolid again", "", "ends in line 17, where facet or endsolid"),
    ] {
        let message = read_as("a.stl", &right.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(message.contains(named), "{to}: {message}");
    }
}

#[test]
fn nodes_move_turn_and_mirror_their_meshes() {
    let text = String::from_utf8(tetrahedron().gltf()).unwrap();
    let nodes = r#""nodes": [{"children": [1, 2], "translation": [10, 0, 0]},
        {"mesh": 0, "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]},
        {"mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}]"#;
    let mesh = read_as("a.gltf", &text.replace(r#""nodes": [{"mesh": 0}]"#, nodes)).unwrap();
    assert_eq!((mesh.corners.len(), mesh.triangles.len()), (8, 8));
    let near = |corner: [f32; 3], place: [f32; 3]| (0..3).all(|a| (corner[a] - place[a]).abs() < 1e-6);
    assert!(near(mesh.corners[1], [10.0, 1.5, 0.0]) && near(mesh.corners[5], [8.5, 0.0, 5.0]), "{:?}", mesh.corners);
    assert_eq!((mesh.triangles[0], mesh.triangles[4]), ([0, 1, 2], [4, 6, 5]));
    for (from, to, named) in [
        (r#""children": [1, 2]"#, r#""children": [1, 1]"#, "nodes[1] in two places"),
        (r#""children": [1, 2]"#, r#""children": [1, 0]"#, "nodes[0] in two places"),
        (r#""children": [1, 2]"#, r#""children": [1, 9]"#, "asks for nodes[9], where there are 3"),
        (r#"{"mesh": 0, "m"#, r#"{"mesh": 3, "m"#, "asks for meshes[3]"),
        (r#""scene": 0"#, r#""scene": 1"#, "asks for scenes[1]"),
        (r#""POSITION": 0"#, r#""POSITION": 2"#, "asks for accessors[2]"),
        (r#""POSITION": 0"#, r#""NORMAL": 0"#, "without POSITION"),
        (r#""bufferView": 1"#, r#""bufferView": 2"#, "asks for bufferViews[2]"),
        (r#""buffer": 0"#, r#""buffer": 1"#, "asks for buffers[1]"),
        ("5126", "5130", "\"VEC3\" of 5130"),
        ("5123", "5126", "\"SCALAR\" of 5126"),
        (";base64,", ",", "`;base64,`"),
        (";base64,", ";base64,!", "not base64"),
        (r#""version": "2.0""#, r#""version": "1.0""#, "version \"1.0\""),
        (r#""scene": 0"#, r#""scene": 0, "extensionsRequired": ["KHR_draco"]"#, "\"KHR_draco\""),
        (r#""type": "VEC3""#, r#""type": "VEC3", "sparse": {}"#, "accessors[0] sparse"),
        (r#""indices": 1"#, r#""mode": 4"#, "duplicate field `mode`"),
    ] {
        let whole = text.replace(r#""nodes": [{"mesh": 0}]"#, nodes);
        assert!(whole.contains(from), "{from}");
        let message = read_as("a.gltf", &whole.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(message.contains(named), "{to}: {message}");
    }
}

#[test]
fn strips_and_fans_are_triangles_of_one_side_and_lines_are_left_out() {
    let text = String::from_utf8(tetrahedron().gltf()).unwrap();
    let with = |mode: &str| read_as("a.gltf", &text.replace(r#", "indices": 1, "mode": 4"#, mode));
    assert_eq!(with(r#", "mode": 5"#).unwrap().triangles, [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(with(r#", "mode": 6"#).unwrap().triangles, [[0, 1, 2], [0, 2, 3]]);
    assert!(with("").unwrap_err().to_string().contains("4 corners, which make no whole triangles"));
    let both = with(r#", "mode": 6}, {"attributes": {}, "mode": 1}, {"attributes": {}, "mode": 0"#).unwrap();
    assert!(says(&both.warnings, &["2 primitives of points or lines"]), "{:?}", both.warnings);
    assert!(with(r#", "mode": 1"#).unwrap_err().to_string().contains("no triangles"));
}

#[test]
fn buffers_of_gltf_lie_in_files_beside_it() {
    let solid = tetrahedron();
    let text = solid.gltf_text(r#""uri": "the%20bytes.bin", "#);
    let (folder, path) = file("a.gltf", text.as_bytes());
    let absent = read::mesh(&path).unwrap_err().to_string();
    assert!(absent.contains("a.gltf: buffers[0] ") && absent.contains("the bytes.bin: cannot be read"), "{absent}");
    std::fs::write(folder.path().join("the bytes.bin"), solid.gltf_buffer()).unwrap();
    assert_eq!(read::mesh(&path).unwrap().triangles, solid.triangles());
    std::fs::write(folder.path().join("the bytes.bin"), &solid.gltf_buffer()[..71]).unwrap();
    assert!(read::mesh(&path).unwrap_err().to_string().contains("promises 72 bytes in buffers[0], which holds 71"));
    let remote = text.replace("the%20", "https://example.org/");
    assert!(read_as("a.gltf", &remote).unwrap_err().to_string().contains("name a file beside this one"));
}

/// A short file may ask for very many copies of its mesh.
#[test]
fn copies_without_end_are_refused() {
    let mut solid = tetrahedron();
    solid.faces = vec![vec![0, 1, 2]; 3000];
    let text = String::from_utf8(solid.gltf()).unwrap();
    let primitive = r#"{"attributes": {"POSITION": 0}, "indices": 1}"#;
    let primitives = vec![primitive; 200].join(", ");
    let begin = text.find(r#"[{"attributes""#).unwrap();
    let end = begin + text[begin..].find(']').unwrap();
    let many = format!("{}[{primitives}{}", &text[..begin], &text[end..]);
    let numbers = (0..200).map(|n| n.to_string()).collect::<Vec<_>>().join(", ");
    let many =
        many.replace(r#""nodes": [{"mesh": 0}]"#, &format!(r#""nodes": [{}]"#, vec![r#"{"mesh": 0}"#; 200].join(", ")));
    let many = many.replace(r#"[{"nodes": [0]}]"#, &format!(r#"[{{"nodes": [{numbers}]}}]"#));
    let message = read_as("a.gltf", &many).unwrap_err().to_string();
    assert!(message.contains("over all copies"), "{message}");
}
