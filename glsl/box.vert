// The volume's box, clipped and projected on the CPU [KW03 §2.1: "the front faces of the volume bounding box
// are rendered"]. The depth comes from the viewport, whose minimum and maximum are the same number, so that
// it is stored to the bit. SINGLE_RAYS: hands the rays of the view on to fragments.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [SINGLE_RAYS]

layout(location = 0) in vec3 clip_xyw;

#ifdef SINGLE_RAYS
#include "shared/view_rays.glsl"

layout(location = 0) flat out SingleRays view_rays;
#endif

void main() {
    gl_Position = vec4(clip_xyw.xy, 0.0, clip_xyw.z);
#ifdef SINGLE_RAYS
    view_rays = single_rays.of_view;
#endif
}
