// The rays of a view in single floats, all at once: in texture coordinates from the middle of the volume, high parts and low ones; columns
// and rows are in pixels from `center`. The Rust side is src/shared/single_rays.rs.
//
// FROM_VERTICES: box.vert hands them on, since drivers of CPUs read a uniform buffer number by number for every few pixels; else they come
// from that.

struct SingleRays {
    // Where rays are at a depth that is the same for all, and what of that changes by column and by row.
    vec4 place[2];
    vec4 place_right[2];
    vec4 place_down[2];
    // The same of what rays come on in a unit of depth.
    vec4 heading[2];
    vec4 heading_right[2];
    vec4 heading_down[2];
    vec2 center;
    // Where rays begin, in depth from those places.
    float near;
};

#ifdef FROM_VERTICES
layout(location = 0) flat in SingleRays view_rays;
#else
layout(set = 0, binding = 26, std140) uniform ViewRays {
    SingleRays of_view;
} single_rays;
#endif
