// Cells of a mesh and the way of a ray through them. Twin: src/scene/tetrahedra/walk.rs. Needs seen.glsl.

// Corners of each cell, by rising numbers.
layout(set = 0, binding = 62, std430) readonly buffer TetCells {
    uvec4 list[];
} tet_cells;

// The side across the face opposite to each corner in that order: its cell times 4, and the place of the corner opposite to it.
layout(set = 0, binding = 63, std430) readonly buffer TetAcross {
    uint list[];
} tet_across;

// Across the boundary.
const uint NOTHING = 0xffffffffu;

// A ray that enters a cell through a face.
struct Way {
    // Its cell times 4, and the place of the corner opposite to the face.
    uint side;
    // The corners of the face, which go round to the right.
    Seen a;
    Seen b;
    Seen c;
    // Twice the areas from the ray to the edges opposite to each.
    vec3 areas;
    // Depth and x where the ray passes through it.
    vec2 at;
};

// Depth and x where the ray passes through the face of a way.
vec2 face_point(Way way) {
    vec3 weights = way.areas / (way.areas.x + way.areas.y + way.areas.z);
    // Corners in a row across the ray: it passes the edge that it stands between the ends of, or through a vertex.
    vec2 a = way.a.place;
    vec2 b = way.b.place;
    vec2 c = way.c.place;
    vec3 apart = vec3(dot(b, c), dot(c, a), dot(a, b));
    vec3 far = abs(vec3(a.x, b.x, c.x)) + abs(vec3(a.y, b.y, c.y));
    vec3 in_row = apart.x <= apart.y && apart.x <= apart.z ? vec3(0.0, far.z, far.y)
        : apart.y <= apart.z                               ? vec3(far.z, 0.0, far.x)
                                                           : vec3(far.y, far.x, 0.0);
    float sum = in_row.x + in_row.y + in_row.z;
    in_row = sum > 0.0 ? in_row / sum : vec3(1.0 / 3.0);
    bool sound = all(greaterThanEqual(weights, vec3(0.0))) && all(lessThanEqual(weights, vec3(1.0)));
    weights = sound ? weights : in_row;
    return vec2(dot(weights, vec3(way.a.depth, way.b.depth, way.c.depth)), dot(weights, vec3(way.a.value, way.b.value, way.c.value)));
}

// Goes through the cell to the next one. The last cell of a chain has nothing next.
Way leave(Line line, Way way) {
    uvec4 corners = tet_cells.list[way.side >> 2];
    uint number = corners.x ^ corners.y ^ corners.z ^ corners.w ^ way.a.number ^ way.b.number ^ way.c.number;
    Seen apex = seen(line, number);
    Turn a = turn(apex, way.a);
    Turn b = turn(apex, way.b);
    Turn c = turn(apex, way.c);
    // Of the three faces at the apex it is the one whose edge the ray passes on the other side of than the two others.
    bool without_c = !a.left && b.left;
    bool without_a = !without_c && !b.left && c.left;
    Way next;
    uint dropped;
    next.a = apex;
    if (without_c) {
        next.b = way.a;
        next.c = way.b;
        next.areas = vec3(way.areas.z, -b.area, a.area);
        dropped = way.c.number;
    } else if (without_a) {
        next.b = way.b;
        next.c = way.c;
        next.areas = vec3(way.areas.x, -c.area, b.area);
        dropped = way.a.number;
    } else {
        next.b = way.c;
        next.c = way.a;
        next.areas = vec3(way.areas.y, -a.area, c.area);
        dropped = way.b.number;
    }
    uint place = uint(dropped > corners.x) + uint(dropped > corners.y) + uint(dropped > corners.z);
    next.side = tet_across.list[(way.side & ~3u) + place];
    next.at = face_point(next);
    return next;
}
