//! Files of meshes in every format and encoding, written from one list of corners and faces.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// Corners and polygons.
pub struct Solid {
    pub corners: Vec<[f32; 3]>,
    pub faces: Vec<Vec<u32>>,
}

pub fn tetrahedron() -> Solid {
    let corners = vec![[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, -2.25, 0.0], [0.0, 0.0, 1e-3]];
    Solid { corners, faces: [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]].map(Vec::from).to_vec() }
}

/// A cube of quads.
pub fn cube() -> Solid {
    let corner = |i: u8| [0, 1, 2].map(|axis| f32::from(i >> axis & 1));
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Solid { corners: (0..8).map(corner).collect(), faces: faces.map(Vec::from).to_vec() }
}

impl Solid {
    /// The faces as fans.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let fan = |face: &Vec<u32>| face[1..].windows(2).map(|pair| [face[0], pair[0], pair[1]]).collect::<Vec<_>>();
        self.faces.iter().flat_map(fan).collect()
    }

    /// The corners of each triangle.
    pub fn places(&self) -> Vec<[[f32; 3]; 3]> {
        self.triangles().iter().map(|triangle| triangle.map(|corner| self.corners[corner as usize])).collect()
    }

    pub fn ply(&self, format: &str) -> Vec<u8> {
        let (vertices, faces) = (self.corners.len(), self.faces.len());
        let mut file = format!(
            "ply\nformat {format} 1.0\ncomment a solid\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
             property float z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
        )
        .into_bytes();
        for corner in &self.corners {
            match format {
                "ascii" => file.extend(format!("{} {} {}\n", corner[0], corner[1], corner[2]).bytes()),
                "binary_big_endian" => file.extend(corner.iter().flat_map(|x| x.to_be_bytes())),
                _ => file.extend(corner.iter().flat_map(|x| x.to_le_bytes())),
            }
        }
        for face in &self.faces {
            match format {
                "ascii" => file.extend(format!("{} {}\n", face.len(), words(face)).bytes()),
                _ => file.push(face.len() as u8),
            }
            match format {
                "ascii" => {}
                "binary_big_endian" => file.extend(face.iter().flat_map(|x| x.to_be_bytes())),
                _ => file.extend(face.iter().flat_map(|x| x.to_le_bytes())),
            }
        }
        file
    }

    pub fn obj(&self) -> Vec<u8> {
        let vertex = |c: &[f32; 3]| format!("v {} {} {}\n", c[0], c[1], c[2]);
        let face = |face: &Vec<u32>| format!("f {}\n", words(&face.iter().map(|c| c + 1).collect::<Vec<_>>()));
        let vertices: String = self.corners.iter().map(vertex).collect();
        let faces: String = self.faces.iter().map(face).collect();
        format!("# a solid\no solid\n{vertices}s off\n{faces}").into_bytes()
    }

    pub fn stl_text(&self) -> Vec<u8> {
        let vertex = |c: &[f32; 3]| format!("   vertex {} {} {}\n", c[0], c[1], c[2]);
        let facet = |places: &[[f32; 3]; 3]| {
            let vertices: String = places.iter().map(vertex).collect();
            format!(" facet normal 0 0 nan\n  outer loop\n{vertices}  endloop\n endfacet\n")
        };
        let facets: String = self.places().iter().map(facet).collect();
        format!("solid of a test\n{facets}endsolid of a test\n").into_bytes()
    }

    /// The head begins as if it were text, as many do.
    pub fn stl_bytes(&self) -> Vec<u8> {
        let places = self.places();
        let mut file = b"solid".to_vec();
        file.resize(80, b' ');
        file.extend((places.len() as u32).to_le_bytes());
        for triangle in places {
            file.extend([0; 12]);
            file.extend(triangle.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
            file.extend([0; 2]);
        }
        file
    }

    /// Places, then indices of 16 bits.
    pub fn gltf_buffer(&self) -> Vec<u8> {
        let places = self.corners.as_flattened().iter().flat_map(|x| x.to_le_bytes());
        let indices = self.triangles().into_iter().flatten().flat_map(|index| (index as u16).to_le_bytes());
        places.chain(indices).collect()
    }

    /// A document whose buffer is named by `uri`: `"uri": "...",` or nothing.
    pub fn gltf_text(&self, uri: &str) -> String {
        let (vertices, indices) = (self.corners.len(), 3 * self.triangles().len());
        let (places, whole) = (12 * vertices, 12 * vertices + 2 * indices);
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1, "mode": 4}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": {vertices}, "type": "VEC3"}},
{{"bufferView": 1, "componentType": 5123, "count": {indices}, "type": "SCALAR"}}],
"bufferViews": [{{"buffer": 0, "byteLength": {places}}},
{{"buffer": 0, "byteOffset": {places}, "byteLength": {}}}],
"buffers": [{{{uri}"byteLength": {whole}}}]}}"#,
            2 * indices
        )
    }

    pub fn gltf(&self) -> Vec<u8> {
        let data = STANDARD.encode(self.gltf_buffer());
        self.gltf_text(&format!(r#""uri": "data:application/octet-stream;base64,{data}", "#)).into_bytes()
    }

    pub fn glb(&self) -> Vec<u8> {
        glb(&self.gltf_text(""), &self.gltf_buffer())
    }

    /// Every format and encoding, with the ending of its files.
    pub fn files(&self) -> Vec<(&'static str, Vec<u8>)> {
        vec![
            ("ply", self.ply("ascii")),
            ("ply", self.ply("binary_little_endian")),
            ("ply", self.ply("binary_big_endian")),
            ("obj", self.obj()),
            ("stl", self.stl_text()),
            ("stl", self.stl_bytes()),
            ("gltf", self.gltf()),
            ("glb", self.glb()),
        ]
    }
}

/// A binary file of a document and its buffer.
pub fn glb(text: &str, buffer: &[u8]) -> Vec<u8> {
    let (mut text, mut buffer) = (text.as_bytes().to_vec(), buffer.to_vec());
    text.resize(text.len().next_multiple_of(4), b' ');
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let word = |n: usize| (n as u32).to_le_bytes();
    let whole = 12 + 8 + text.len() + 8 + buffer.len();
    let head = [b"glTF", &word(2)[..], &word(whole)].concat();
    let chunks = [&word(text.len())[..], b"JSON", &text, &word(buffer.len()), b"BIN\0", &buffer].concat();
    [head, chunks].concat()
}

fn words(numbers: &[u32]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}
