// Polygons where they are: nothing cuts them but the sides of the view and its near plane. Their fragments know their triangle.
#version 460

layout(set = 0, binding = 14, std140) uniform Placement {
    // Where the rays of the view come from.
    vec4 origin;
    // Clip coordinates are the products of these with the arm from there to a point, and with 1.
    vec4 x;
    vec4 y;
    vec4 z;
    vec4 w;
} placement;

layout(location = 0) in vec3 corner;

layout(location = 0) flat out uint triangle;

void main() {
    vec3 arm = corner - placement.origin.xyz;
    mat4x3 rows = mat4x3(placement.x.xyz, placement.y.xyz, placement.z.xyz, placement.w.xyz);
    gl_Position = arm * rows + vec4(placement.x.w, placement.y.w, placement.z.w, placement.w.w);
    triangle = uint(gl_VertexIndex) / 3u;
}
