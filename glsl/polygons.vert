// Polygons where they are: nothing cuts them but the sides of the view and its near plane. Their fragments know their triangle.
#version 460

layout(set = 0, binding = 14, std140) uniform Placement {
    vec4 eye;
    vec4 x;
    vec4 y;
    vec4 w;
    float near;
} placement;

layout(location = 0) in vec3 corner;

layout(location = 0) flat out uint triangle;

void main() {
    vec3 arm = corner - placement.eye.xyz;
    float w = dot(arm, placement.w.xyz);
    gl_Position = vec4(dot(arm, placement.x.xyz), dot(arm, placement.y.xyz), w - placement.near, w);
    triangle = uint(gl_VertexIndex) / 3u;
}
