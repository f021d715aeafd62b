// Shells, and surfaces among them [Heidrich95 §2]. Depths go from 0 at the far end of the volume to 1 at the near end of what there is, and
// are linear in the picture after the perspective division. The matrix of equation (5), which scales and shifts them for each shell, is
// the range of depths of the viewport.
#version 460

layout(set = 0, binding = 34, std140) uniform ShellPlacement {
    // As in polygons.vert.
    vec4 origin;
    vec4 x;
    vec4 y;
    vec4 z;
    vec4 w;
} shell_placement;

layout(location = 0) in vec3 corner;

void main() {
    vec3 arm = corner - shell_placement.origin.xyz;
    mat4x3 rows =
        mat4x3(shell_placement.x.xyz, shell_placement.y.xyz, shell_placement.z.xyz, shell_placement.w.xyz);
    gl_Position =
        arm * rows + vec4(shell_placement.x.w, shell_placement.y.w, shell_placement.z.w, shell_placement.w.w);
}
