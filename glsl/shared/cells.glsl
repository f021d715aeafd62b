// Cells of a mesh and the way of a ray through them. Twin: src/scene/tetrahedra/walk.rs. Needs seen.glsl.

// Corners of each cell, right-handed.
layout(set = 0, binding = 62, std430) readonly buffer TetCells {
    uvec4 list[];
} tet_cells;

// The side across the face opposite to each corner: its cell times 4 and its number.
layout(set = 0, binding = 63, std430) readonly buffer TetAcross {
    uvec4 list[];
} tet_across;

// Across the boundary.
const uint NOTHING = 0xffffffffu;

// A ray that enters a cell: by which side, at which depth and x.
struct Way {
    uint side;
    vec2 at;
};

// The corners of a cell in the order of the face opposite to one of them, which is the last here: seen from outside the first three go
// round to the left.
uvec4 from_side(uint side) {
    uvec4 corners = tet_cells.list[side >> 2];
    switch (side & 3u) {
    case 0u:
        return corners.yzwx;
    case 1u:
        return corners.xwzy;
    case 2u:
        return corners.xywz;
    default:
        return corners.xzyw;
    }
}

// The number of a corner in that order.
uint corner_of(uint side, uint place) {
    const uvec3 ORDER[4] = uvec3[4](uvec3(1u, 2u, 3u), uvec3(0u, 3u, 2u), uvec3(0u, 1u, 3u), uvec3(0u, 2u, 1u));
    uvec3 order = ORDER[side & 3u];
    return place == 0u ? order.x : place == 1u ? order.y : order.z;
}

// Goes through the cell to the next one; where it leaves is `to`. The last cell of a chain has nothing next.
Way leave(Line line, Way way, out vec2 to) {
    uvec4 corners = from_side(way.side);
    Seen a = seen(line, corners.x);
    Seen b = seen(line, corners.y);
    Seen c = seen(line, corners.z);
    Seen apex = seen(line, corners.w);
    bool turn = left(a, b);
    bvec3 apart = bvec3(left(apex, a) == turn, left(apex, b) == turn, left(apex, c) == turn);
    // Of the three faces at the apex it is the one whose edge the line passes on the other side of than the two others.
    uint opposite;
    if (apart.x && !apart.y) {
        to = face_point(apex, a, b);
        opposite = 2u;
    } else if (apart.y && !apart.z) {
        to = face_point(apex, b, c);
        opposite = 0u;
    } else {
        to = face_point(apex, c, a);
        opposite = 1u;
    }
    uvec4 across = tet_across.list[way.side >> 2];
    uint corner = corner_of(way.side, opposite);
    uint next = corner == 0u ? across.x : corner == 1u ? across.y : corner == 2u ? across.z : across.w;
    return Way(next, to);
}
