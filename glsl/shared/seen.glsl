// Vertices of a mesh as a ray sees them, and on which side of an edge it passes, exactly for places across it that are rounded once more than
// vertices are. Twin: src/scene/tetrahedra/seen.rs, where it is told why no ray is lost. Needs double_float.glsl.
//
// Departures: 1. Vertices are where the view has them, in columns, rows and depth, so that a place across a ray takes two products: without
// perspective it is what is left of columns and rows, and with it these are times the depth. 2. Depths count from the middle of the mesh,
// so that places have the digits of f32 where vertices are.

#include "shared/rows.glsl"

// Vertices as the view has them: columns and rows from the middle of the picture, times the depth with perspective; the depth; x.
ROWS(60, TetPlaces, samplerBuffer, vec4, tet_places);

layout(set = 0, binding = 61, std140) uniform TetView {
    // Of the table of ways: the first value, nodes in a unit of x, and nodes in a reference length.
    vec4 table;
    // Of the square of what a ray comes on in a unit of depth, in reference lengths: all of it in the middle of the picture, and what the squares
    // of a column and of a row from there add.
    vec3 square;
    // Where rays begin.
    float near;
    // What columns and rows are times in the middle of the mesh, a double-float: its depth with perspective, else 1.
    vec2 middle;
    // Column and row of the upper left corner of targets, from the middle of the picture.
    vec2 corner;
    // What columns and rows are times more a unit of depth behind: 1 with perspective, else 0.
    float slope;
    // The depth of the middle of the mesh.
    float depth;
} tet_view;

// The ray through a place of the picture.
struct Line {
    // What its column and row are times in the middle of the mesh: high parts, low parts.
    vec2 origin;
    vec2 rest;
    // What they are times more a unit of depth behind.
    vec2 shear;
};

struct Seen {
    uint number;
    vec2 place;
    float depth;
    float value;
};

// `pixel`: from the upper left corner of targets, centres at + 0.5.
Line line_through(vec2 pixel) {
    vec2 from_middle = pixel + tet_view.corner;
    Line line;
    for (int axis = 0; axis < 2; ++axis) {
        vec2 product = two_product(from_middle[axis], tet_view.middle.x);
        line.origin[axis] = product.x;
        line.rest[axis] = product.y + from_middle[axis] * tet_view.middle.y;
    }
    line.shear = tet_view.slope * from_middle;
    return line;
}

Seen seen(Line line, uint number) {
    vec4 vertex = ROW(tet_places, number);
    precise vec2 arm = (vertex.xy - line.origin) - line.rest;
    precise vec2 along = line.shear * vertex.z;
    precise vec2 place = arm - along;
    return Seen(number, place, vertex.z, vertex.w);
}

// Which way two vertices go round the line, and twice the area of the triangle from it to them, above 0 to the left.
struct Turn {
    float area;
    bool left;
};

Turn turn(Seen from, Seen to) {
    vec2 p = two_product(from.place.x, to.place.y);
    vec2 q = two_product(from.place.y, to.place.x);
    precise float area = (p.x - q.x) + (p.y - q.y);
    // Of two vertices in a row with the line: by the numbers, so that both directions of an edge give opposite answers. It is what the
    // area grows by as the one of the lower number moves along each axis, then as the other does; as both do it falls.
    bool swapped = from.number > to.number;
    vec2 a = swapped ? to.place : from.place;
    vec2 b = swapped ? from.place : to.place;
    float moved = b.y != 0.0 ? b.y : b.x != 0.0 ? -b.x : a.y != 0.0 ? -a.y : a.x;
    // Products are rounded in their order.
    bool left = p.x != q.x ? p.x > q.x : p.y != q.y ? p.y > q.y : moved > 0.0 != swapped;
    return Turn(area, left);
}
