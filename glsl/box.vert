// The volume's box, clipped and projected on the CPU [KW03 §2.1: "the front faces of the volume bounding box
// are rendered"]. The depth comes from the viewport, whose minimum and maximum are the same number, so that
// it is stored to the bit.
#version 460

layout(location = 0) in vec3 clip_xyw;

void main() {
    gl_Position = vec4(clip_xyw.xy, 0.0, clip_xyw.z);
}
