// Faces of the boundary of a mesh, by which rays enter. Needs way.glsl.

// Two rows a face: one more than its side (cells.glsl), and its three corners, which go round to the left seen from outside; then the faces
// beside it, over the edges from each of its corners to the next, and the number of the corner opposite to it.
ROWS(64, TetBoundary, usamplerBuffer, uvec4, tet_boundary);

// A face, but for where the ray passes through it, and whether its edges go round the ray to the left, from the first corner on: none does
// where the ray enters by it.
struct Entrance {
    Way way;
    bvec3 lefts;
};

Entrance entrance_by(Line line, uint face) {
    uvec4 row = ROW(tet_boundary, 2u * face);
    Entrance entrance;
    entrance.way.side = row.x;
    entrance.way.apex = ROW(tet_boundary, 2u * face + 1u).w;
    entrance.way.a = seen(line, row.y);
    entrance.way.b = seen(line, row.z);
    entrance.way.c = seen(line, row.w);
    Turn ab = turn(entrance.way.a, entrance.way.b);
    Turn bc = turn(entrance.way.b, entrance.way.c);
    Turn ca = turn(entrance.way.c, entrance.way.a);
    entrance.way.areas = vec3(bc.area, ca.area, ab.area);
    entrance.lefts = bvec3(ab.left, bc.left, ca.left);
    return entrance;
}
