// Ray casting of a mesh of tetrahedra in one pass: the loop of the ray propagation in a fragment shader, for each time that a ray enters
// the mesh [Weiler03 "Ray Propagation Approach", Stegmaier05 §3].
//
// GOES_ON: the ray goes on with what RES holds. SURFACE: iso-surfaces show; IN_VOLUME: within colours.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [GOES_ON], [VALUES | TABLE], [ENDLESS], [FEW_PIECES], [SURFACE], [IN_VOLUME], [FROM_WITHIN], [STORAGE]
// The optimiser of SPIR-V has loops hand on what they hold at their heads, which llvmpipe 22.3 takes through two masks in every turn.
//@unoptimised

#include "shared/tet_loop.glsl"

#ifdef GOES_ON
layout(input_attachment_index = 0, set = 0, binding = 7) uniform subpassInput accumulated;
#endif

layout(location = 0) out vec4 gathered;

void main() {
    vec4 entered = texelFetch(tet_entry, this_pixel(), 0);
#ifdef GOES_ON
    vec4 held = subpassLoad(accumulated);
#ifdef VALUES
    held = held.a == 0.0 && entered.y > 0.0 ? begin_in_mesh() : held;
#endif
#else
    vec4 held = entered.y > 0.0 ? begin_in_mesh() : vec4(0.0);
#endif
    CellRay ray = cell_ray(gl_FragCoord.xy);
    gathered = through_cells(ray, entered, held);
}
