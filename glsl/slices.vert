// Slices of the volume, cut and projected on the CPU [Thesis §3.4]. The depth comes from the viewport, as in box.vert.
#version 460

// Clip coordinates x, y and w, and the number of the slice.
layout(location = 0) in vec4 corner;

layout(location = 0) flat out float slice;

void main() {
    gl_Position = vec4(corner.xy, 0.0, corner.z);
    slice = corner.w;
}
