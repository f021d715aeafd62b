//! The parts of a glTF document that say where triangles are.

use glam::{DMat4, DQuat, DVec3};
use serde::Deserialize;
use serde::de::IgnoredAny;

/// Lists that are empty where the document does not have them.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Document {
    pub asset: Asset,
    pub scene: Option<usize>,
    #[serde(default)]
    pub scenes: Vec<Scene>,
    #[serde(default)]
    pub nodes: Vec<Node>,
    #[serde(default)]
    pub meshes: Vec<Primitives>,
    #[serde(default)]
    pub accessors: Vec<Accessor>,
    #[serde(default)]
    pub buffer_views: Vec<View>,
    #[serde(default)]
    pub buffers: Vec<Buffer>,
    #[serde(default)]
    pub extensions_required: Vec<String>,
}

#[derive(Deserialize)]
pub struct Asset {
    pub version: String,
}

#[derive(Deserialize)]
pub struct Scene {
    #[serde(default)]
    pub nodes: Vec<usize>,
}

#[derive(Deserialize)]
pub struct Node {
    #[serde(default)]
    pub children: Vec<usize>,
    pub mesh: Option<usize>,
    pub skin: Option<IgnoredAny>,
    /// Columns, one after the other.
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    /// A quaternion: x, y, z, w.
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

impl Node {
    /// From the axes of the node into those of its parent.
    pub fn transform(&self) -> DMat4 {
        if let Some(columns) = &self.matrix {
            return DMat4::from_cols_array(columns);
        }
        let rotation = self.rotation.map_or(DQuat::IDENTITY, |q| DQuat::from_array(q).normalize());
        let scale = self.scale.map_or(DVec3::ONE, DVec3::from_array);
        DMat4::from_scale_rotation_translation(scale, rotation, DVec3::from_array(self.translation.unwrap_or_default()))
    }
}

/// What glTF calls a mesh.
#[derive(Deserialize)]
pub struct Primitives {
    pub primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
pub struct Primitive {
    pub attributes: Attributes,
    pub indices: Option<usize>,
    #[serde(default = "triangles")]
    pub mode: u32,
    #[serde(default)]
    pub targets: Vec<IgnoredAny>,
}

/// Three corners a triangle.
pub const TRIANGLES: u32 = 4;
/// Each corner makes a triangle with the two before it.
pub const STRIP: u32 = 5;
/// Each corner makes a triangle with the one before it and the first.
pub const FAN: u32 = 6;

fn triangles() -> u32 {
    TRIANGLES
}

#[derive(Deserialize)]
pub struct Attributes {
    #[serde(rename = "POSITION")]
    pub position: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Accessor {
    pub buffer_view: Option<usize>,
    #[serde(default)]
    pub byte_offset: usize,
    pub component_type: u32,
    pub count: usize,
    #[serde(rename = "type")]
    pub shape: String,
    pub sparse: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct View {
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: usize,
    pub byte_length: usize,
    pub byte_stride: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Buffer {
    pub uri: Option<String>,
    pub byte_length: usize,
}
