// Cells of a mesh and the way of a ray through them. Twin: src/scene/tetrahedra/walk.rs. Needs seen.glsl and way.glsl.

// Across the face opposite to each corner of a cell, corners by rising numbers: one more than the side there, as its cell times 4 and the
// place of the corner opposite to it, and the number of that corner. 0 on the boundary: some drivers run loops for invocations that nobody
// sees, which read 0 everywhere, and have to end.
ROWS(63, TetAcross, usamplerBuffer, uvec2, tet_across);

// Goes through the cell to the next one. The last cell of a chain has nothing next.
Way leave(Line line, Way way) {
    uint cell = (way.side - 1u) >> 2;
    Seen apex = seen(line, way.apex);
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
    uint place = uint(dropped > next.a.number) + uint(dropped > next.b.number) + uint(dropped > next.c.number);
    uvec2 across = ROW(tet_across, 4u * cell + place).xy;
    next.side = across.x;
    next.apex = across.y;
    next.at = face_point(next);
    return next;
}
