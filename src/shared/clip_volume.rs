//! What shaders know of a clip volume besides its values.

use crate::scene::ClipVolume;
use crate::scene::clip_volume::FACE_WIDTH;

/// `ClipVolumePlace` of `glsl/shared/clip_volume.glsl`: the rows that lead to its voxels, its level and the width of its faces.
pub fn clip_volume_rows(clip: &ClipVolume) -> [[f32; 4]; 4] {
    let [x, y, z] = clip.rows.map(|row| row.to_array().map(|part| part as f32));
    [x, y, z, [clip.level as f32, FACE_WIDTH as f32, 0.0, 0.0]]
}
