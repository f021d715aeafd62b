// What a ray has gathered, as passes read it that decide whether it goes on: its colour, or with SURFACE where it has met a surface,
// with opacity 1. Twin: `gathered` in src/twin/surface.rs.

#ifdef SURFACE
// Steps from the entry point to the last place in front of the surface and to the first one on it, 0, and 1; all 0 where there is
// none.
layout(set = 0, binding = 7) uniform sampler2D surface_hit;
#define GATHERED surface_hit
#else
layout(set = 0, binding = 7) uniform sampler2D accumulated;
#define GATHERED accumulated
#endif
