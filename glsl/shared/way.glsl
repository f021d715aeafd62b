// Where a ray is on its way through cells. Twin: src/scene/tetrahedra/walk.rs. Needs seen.glsl.

// Across the boundary.
const uint NOTHING = 0u;

// A ray that enters a cell through a face.
struct Way {
    // One more than its cell times 4 and the place of the corner opposite to the face.
    uint side;
    // The number of that corner.
    uint apex;
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
    // Corners in a row across the ray: it passes the edge that it stands between the ends of, or through a vertex.
    vec2 a = way.a.place;
    vec2 b = way.b.place;
    vec2 c = way.c.place;
    vec3 apart = vec3(dot(b, c), dot(c, a), dot(a, b));
    vec3 far = abs(vec3(a.x, b.x, c.x)) + abs(vec3(a.y, b.y, c.y));
    vec3 in_row = apart.x <= apart.y && apart.x <= apart.z ? vec3(0.0, far.z, far.y)
        : apart.y <= apart.z                               ? vec3(far.z, 0.0, far.x)
                                                           : vec3(far.y, far.x, 0.0);
    // Those of a face that the ray passes within are 0 and less.
    bool sound = max(max(way.areas.x, way.areas.y), way.areas.z) <= 0.0 && way.areas.x + way.areas.y + way.areas.z < 0.0;
    vec3 weights = sound ? way.areas : in_row;
    float sum = weights.x + weights.y + weights.z;
    // Quotients, and no products with an inverse: a ray through a vertex has its x to the bit.
    weights = sum != 0.0 ? weights / sum : vec3(1.0 / 3.0);
    return vec2(dot(weights, vec3(way.a.depth, way.b.depth, way.c.depth)), dot(weights, vec3(way.a.value, way.b.value, way.c.value)));
}
