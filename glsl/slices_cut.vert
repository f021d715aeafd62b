// Slices of the volume, cut here [Thesis §3.4.2]: corner by corner of the polygon in which a plane meets the box around the volume, in
// the order of their angles. The host form is src/scene/slices.rs. The depth comes from the viewport, as in box.vert.
//
// What clip planes cut off, and what is before the near plane, is dropped by the fragment shader.
#version 460

layout(set = 0, binding = 33, std140) uniform SliceCut {
    // Half of the sides of the box, which is somewhat wider than the volume; volume space.
    vec4 reach;
    // Rows that lead from a place, with 1 behind its coordinates, to clip coordinates x, y and w.
    vec4 x;
    vec4 y;
    vec4 w;
    // The normal of all planes, a unit vector.
    vec4 normal;
    // Where slice 0 lies along the normal: of planes that rays meet on their way up, and of those that they meet on their way down.
    vec2 first;
    // Planes on the way up show beyond [0], those on the way down before [1].
    vec2 beyond;
    // From slice to slice.
    float spacing;
} slice_cut;

// The number of the slice, and that of the corner: twelve of triangles on the way up, then as many on the way down.
layout(location = 0) in vec2 number;

layout(location = 0) flat out float slice;

// A plane meets a box in a polygon of so many corners at the most, which is drawn as a fan of triangles.
const int CORNERS = 6;
const int TRIANGLES = CORNERS - 2;

void main() {
    slice = number.x;
    int corner = int(number.y);
    bool up = corner < 3 * TRIANGLES;
    corner -= up ? 0 : 3 * TRIANGLES;
    float by = slice * slice_cut.spacing;
    float at = up ? slice_cut.first.x + by : slice_cut.first.y - by;
    bool shows = up ? at > slice_cut.beyond.x : at < slice_cut.beyond.y;

    vec3 found[CORNERS];
    vec3 middle = vec3(0.0);
    int count = 0;
    for (int edge = 0; edge < 12; ++edge) {
        int axis = edge >> 2;
        vec3 begin = slice_cut.reach.xyz;
        begin[(axis + 1) % 3] *= (edge & 1) == 0 ? 1.0 : -1.0;
        begin[(axis + 2) % 3] *= (edge & 2) == 0 ? 1.0 : -1.0;
        vec3 end = begin;
        end[axis] = -begin[axis];
        float over_begin = dot(slice_cut.normal.xyz, begin) - at;
        float over_end = dot(slice_cut.normal.xyz, end) - at;
        if ((over_begin < 0.0) != (over_end < 0.0) && count < CORNERS) {
            found[count] = begin + over_begin / (over_begin - over_end) * (end - begin);
            middle += found[count];
            ++count;
        }
    }
    // Corner c of triangle t: the first of the polygon, and two neighbours.
    int wanted = corner % 3 == 0 ? 0 : corner / 3 + corner % 3;
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
    if (!shows || count < 3) {
        return;
    }
    wanted = min(wanted, count - 1);
    middle /= float(count);
    vec3 side = normalize(found[0] - middle);
    vec3 other = cross(slice_cut.normal.xyz, side);
    float angles[CORNERS];
    for (int i = 0; i < count; ++i) {
        vec3 arm = found[i] - middle;
        angles[i] = i == 0 ? -4.0 : atan(dot(other, arm), dot(side, arm));
    }
    for (int i = 0; i < count; ++i) {
        int before = 0;
        for (int j = 0; j < count; ++j) {
            bool is_before = angles[j] < angles[i] || angles[j] == angles[i] && j < i;
            before += is_before ? 1 : 0;
        }
        if (before == wanted) {
            vec4 place = vec4(found[i], 1.0);
            gl_Position = vec4(dot(slice_cut.x, place), dot(slice_cut.y, place), 0.0, dot(slice_cut.w, place));
        }
    }
}
