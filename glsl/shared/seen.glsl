// Vertices of a mesh as a ray sees them, and on which side of an edge it passes, exactly for places across it that are rounded once.
// Twin: src/scene/tetrahedra/seen.rs, where it is told why no ray is lost. Needs frame.glsl, double_float.glsl and ray.glsl.
//
// Departure: depths count from the middle of the mesh, so that places have the digits of f32 where vertices are.

// Vertices in volume space, and their x.
layout(set = 0, binding = 60, std430) readonly buffer TetPoints {
    vec4 list[];
} tet_points;

layout(set = 0, binding = 61, std140) uniform TetView {
    // Of the table of ways: the first value, nodes in a unit of x, and nodes in a reference length.
    vec4 table;
    // Depth of the middle of the mesh, a double-float.
    vec2 middle;
    // Reference lengths in a unit of volume space.
    float lengths;
} tet_view;

struct Line {
    // Where it is at the depth of the middle of the mesh: high parts, low parts.
    vec3 origin;
    vec3 rest;
    // What a unit along the axis that is longest along it is along the two others.
    vec2 shear;
    // The direction along that axis.
    float along;
    // That axis, and whether the direction points down it.
    int axis;
    bool down;
    // The direction, volume space, and its length.
    vec3 direction;
    float stretch;
};

struct Seen {
    uint number;
    vec2 place;
    // From the middle of the mesh.
    float depth;
    float value;
};

// The two axes across a line and the one along, so that they turn as those of space do.
vec3 in_line(Line line, vec3 v) {
    vec3 turned = line.axis == 0 ? v.yzx : line.axis == 1 ? v.zxy : v;
    return line.down ? turned.yxz : turned;
}

// The ray through a place of the picture.
Line line_through(vec2 pixel) {
    Line line;
    vec2 square = vec2(0.0);
    vec2 directions[3];
    vec3 direction;
    for (int axis = 0; axis < 3; ++axis) {
        directions[axis] = ray_direction(pixel, axis);
        direction[axis] = directions[axis].x;
        vec2 origin = df_add(ray_origin(pixel, axis), df_multiply(tet_view.middle, directions[axis]));
        line.origin[axis] = origin.x;
        line.rest[axis] = origin.y;
        square = df_add(square, df_multiply(directions[axis], directions[axis]));
    }
    vec3 size = abs(direction);
    line.axis = size.y > size.x ? (size.z > size.y ? 2 : 1) : size.z > size.x ? 2 : 0;
    vec2 along = line.axis == 0 ? directions[0] : line.axis == 1 ? directions[1] : directions[2];
    line.down = along.x < 0.0;
    vec2 first = line.axis == 0 ? directions[1] : line.axis == 1 ? directions[2] : directions[0];
    vec2 second = line.axis == 0 ? directions[2] : line.axis == 1 ? directions[0] : directions[1];
    precise vec2 shear = vec2(df_divide(first, along).x, df_divide(second, along).x);
    line.shear = line.down ? shear.yx : shear;
    line.along = along.x;
    line.direction = direction;
    line.stretch = df_sqrt(square).x;
    return line;
}

Seen seen(Line line, uint number) {
    vec4 vertex = tet_points.list[number];
    precise vec3 arm = (vertex.xyz - line.origin) - line.rest;
    precise vec3 turned = in_line(line, arm);
    precise vec2 along = line.shear * turned.z;
    precise vec2 place = turned.xy - along;
    return Seen(number, place, turned.z / line.along, vertex.w);
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
