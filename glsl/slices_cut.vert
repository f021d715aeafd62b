// Slices of the volume, cut here [Thesis §3.4.2]: corner by corner of the polygon in which a plane meets the box around the volume, in
// the order of their angles. The host form is src/scene/slice_polygons.rs. The depth comes from the viewport, as in box.vert.
//
// What clip planes cut off, and what is before the near plane, is dropped by the fragment shader. Corners are found anew wherever they are
// asked for: llvmpipe of Mesa 22.3 crashes in vertex shaders with arrays that are indexed by what they compute.
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
const int EDGES = 12;

// Where a plane meets an edge of the box; w: whether it does.
vec4 met(int edge, float at) {
    float a = (edge & 1) == 0 ? 1.0 : -1.0;
    float b = (edge & 2) == 0 ? 1.0 : -1.0;
    vec3 begin = edge < 4 ? vec3(1.0, a, b) : edge < 8 ? vec3(a, 1.0, b) : vec3(a, b, 1.0);
    vec3 end = edge < 4 ? vec3(-1.0, a, b) : edge < 8 ? vec3(a, -1.0, b) : vec3(a, b, -1.0);
    begin *= slice_cut.reach.xyz;
    end *= slice_cut.reach.xyz;
    precise float over_begin = dot(slice_cut.normal.xyz, begin) - at;
    precise float over_end = dot(slice_cut.normal.xyz, end) - at;
    bool meets = (over_begin < 0.0) != (over_end < 0.0);
    precise float part = meets ? over_begin / (over_begin - over_end) : 0.0;
    precise vec3 place = begin + part * (end - begin);
    return vec4(place, meets ? 1.0 : 0.0);
}

// Where a place lies around the middle of a polygon. The same to the bit wherever it is asked, since corners are counted by it.
float angle_of(vec3 place, vec3 middle, vec3 side, vec3 other) {
    precise vec3 arm = place - middle;
    precise vec2 at = vec2(dot(side, arm), dot(other, arm));
    precise float angle = atan(at.y, at.x);
    return angle;
}

void main() {
    slice = number.x;
    int corner = int(number.y);
    bool up = corner < 3 * TRIANGLES;
    corner -= up ? 0 : 3 * TRIANGLES;
    float by = slice * slice_cut.spacing;
    float at = up ? slice_cut.first.x + by : slice_cut.first.y - by;
    bool shows = up ? at > slice_cut.beyond.x : at < slice_cut.beyond.y;

    vec4 sum = vec4(0.0);
    for (int edge = 0; edge < EDGES; ++edge) {
        vec4 here = met(edge, at);
        sum += vec4(here.xyz * here.w, here.w);
    }
    int count = int(sum.w);
    vec3 middle = sum.xyz / max(sum.w, 1.0);
    vec3 normal = slice_cut.normal.xyz;
    vec3 side = normalize(abs(normal.x) < 0.5 ? cross(normal, vec3(1.0, 0.0, 0.0)) : cross(normal, vec3(0.0, 1.0, 0.0)));
    vec3 other = cross(normal, side);
    // Corner c of triangle t: the first of the polygon, and two neighbours.
    int wanted = corner % 3 == 0 ? 0 : corner / 3 + corner % 3;
    wanted = min(wanted, count - 1);
    vec4 place = vec4(0.0, 0.0, 0.0, 1.0);
    for (int edge = 0; edge < EDGES; ++edge) {
        vec4 here = met(edge, at);
        float angle = angle_of(here.xyz, middle, side, other);
        int before = 0;
        for (int rival = 0; rival < EDGES; ++rival) {
            vec4 there = met(rival, at);
            float its = angle_of(there.xyz, middle, side, other);
            bool is_before = there.w > 0.0 && rival != edge && (its < angle || its == angle && rival < edge);
            before += is_before ? 1 : 0;
        }
        if (here.w > 0.0 && before == wanted) {
            place.xyz = here.xyz;
        }
    }
    bool drawn = shows && count >= 3;
    vec4 clip = vec4(dot(slice_cut.x, place), dot(slice_cut.y, place), 0.0, dot(slice_cut.w, place));
    gl_Position = drawn ? clip : vec4(0.0, 0.0, 0.0, 1.0);
}
