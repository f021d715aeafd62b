// Ray casting of a mesh of tetrahedra as a compute shader: a ray an invocation, in tiles of 8 x 8 pixels.
//
// GOES_ON: the ray goes on with what RES holds. SURFACE: iso-surfaces show; IN_VOLUME: within colours. RGBA32F, RGBA16F, RGBA8: the format of RES.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes RGBA32F | RGBA16F | RGBA8
//@takes [GOES_ON], [VALUES | TABLE], [ENDLESS], [FEW_PIECES], [SURFACE], [IN_VOLUME], [FROM_WITHIN], [STORAGE]
// The optimiser of SPIR-V has loops hand on what they hold at their heads, which llvmpipe 22.3 takes through two masks in every turn.
//@unoptimised

#define COMPUTE
#include "shared/tet_loop.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#if defined(RGBA32F)
layout(set = 0, binding = 7, rgba32f) uniform image2D accumulated;
#elif defined(RGBA16F)
layout(set = 0, binding = 7, rgba16f) uniform image2D accumulated;
#else
layout(set = 0, binding = 7, rgba8) uniform image2D accumulated;
#endif

void main() {
    ivec2 pixel = this_pixel();
    if (any(greaterThanEqual(pixel, imageSize(accumulated)))) {
        return;
    }
    vec4 entered = texelFetch(tet_entry, pixel, 0);
#ifdef GOES_ON
    vec4 held = imageLoad(accumulated, pixel);
#ifdef VALUES
    held = held.a == 0.0 && entered.y > 0.0 ? begin_in_mesh() : held;
#endif
#else
    vec4 held = entered.y > 0.0 ? begin_in_mesh() : vec4(0.0);
#endif
    CellRay ray = cell_ray(vec2(pixel) + 0.5);
    imageStore(accumulated, pixel, through_cells(ray, entered, held));
}
