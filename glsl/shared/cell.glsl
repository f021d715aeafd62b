// Cells: the boxes between neighbouring voxel centres. Twin: src/scene/field.rs. Needs frame.glsl.

// The cell (2x2x2 voxels) a point lies in; border cells reach to the faces.
ivec3 cell_at(vec3 position) {
    ivec3 last = max(ivec3(frame.dims.xyz) - 2, ivec3(0));
    return clamp(ivec3(floor(position * frame.dims.xyz - 0.5)), ivec3(0), last);
}
