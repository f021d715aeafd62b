// The gradient of the scalar field by central differences, taken in the shader. Twin: src/twin/gradient.rs. Needs frame.glsl,
// samples.glsl and volume.glsl.

// The value at a place, in units of the texture, as `sample_volume` has it.
float value_at(Place place) {
    if (FILTER == HARDWARE) {
        return textureLod(volume, (place.below + place.weight + 0.5) / frame.dims.xyz, 0.0).r;
    }
    return FILTER == NEAREST ? sample_nearest(place) : sample_exact(place);
}

// The place `by` voxels along an axis, but not beyond the outermost voxel centres.
Place beside(Place place, int axis, float by) {
    float last = frame.dims[axis] - 1.0;
    place.below[axis] += by;
    if (place.below[axis] < 0.0 || place.below[axis] >= last) {
        place.below[axis] = place.below[axis] < 0.0 ? 0.0 : last;
        place.weight[axis] = 0.0;
    }
    return place;
}

// A vector along the gradient in volume space: differences of the values a voxel to each side, over the way between the two, in
// units of the texture over the finest spacing. 0 along an axis of one voxel.
vec3 gradient_at(Place place) {
    vec3 gradient = vec3(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        Place up = beside(place, axis, 1.0);
        Place down = beside(place, axis, -1.0);
        float way = (up.below[axis] - down.below[axis]) + (up.weight[axis] - down.weight[axis]);
        if (way > 0.0) {
            // Voxels along this axis in one of the finest spacing.
            float finest = frame.voxel_step[0][axis] / frame.step_voxels;
            gradient[axis] = (value_at(up) - value_at(down)) / way * finest;
        }
    }
    return gradient;
}
