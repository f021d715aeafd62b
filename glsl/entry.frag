// Pass 1, entry point determination [KW03 §2.1, Thesis §5.2.2]: front faces of the box (with caps where
// the near plane and clip planes cut it), texture coordinates as colour.
//
// Departure: the coordinates are those of the ray through the pixel's centre rather than interpolated from the
// vertices, which rasterisers move to a raster of 1/256 pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [PLANES | SINGLE_RAYS], [ORTHOGRAPHIC]

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"

layout(location = 0) out vec4 entry;

void main() {
    vec2 pixel = gl_FragCoord.xy + vec2(frame.first_column, frame.first_row);
    ViewRay ray = view_ray(pixel);
    entry = vec4(entry_at(ray, box_interval(pixel, ray)), 1.0);
}
