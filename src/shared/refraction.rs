//! What shaders know of indices of refraction.

use crate::scene::texture::TextureMap;
use crate::scene::{RefractiveIndex, Scene};

/// `RefractiveIndex` of `glsl/shared/refraction.glsl`: begin, index, slope and 0 of each piece, in the unit that `map` leads to.
pub fn index_pieces(scene: &Scene, map: TextureMap) -> Vec<[f32; 4]> {
    let pieces = RefractiveIndex::of(scene, map).map_or_else(Vec::new, |index| index.pieces());
    pieces.into_iter().map(|piece| [piece.begin as f32, piece.index as f32, piece.slope as f32, 0.0]).collect()
}
