// Which fragments of a step run. Needs frame.glsl.
//
// Culled by the device (bounds, ztest): declared early, so that no shader starts for a fragment that is out.
// CULL_DISCARD: the shader looks at the stored depth itself; the work stands inside `if`, the discard after it,
// since some drivers go on working after a discard.

#ifdef CULL_DISCARD
layout(set = 0, binding = 6) uniform sampler2D stored;

#ifdef PARTIAL
// Depth of rays that wait for this pass (samples.glsl), and half of what lies between the depths of two parts of rays.
layout(constant_id = 17) const float PARTIAL_DEPTH = 0.75;
layout(constant_id = 19) const float PARTIAL_REACH = 0.0;

bool may_run() {
    return abs(texelFetch(stored, ivec2(gl_FragCoord.xy), 0).r - PARTIAL_DEPTH) <= PARTIAL_REACH;
}
#else
bool may_run() {
    return texelFetch(stored, ivec2(gl_FragCoord.xy), 0).r <= this_step.bound;
}
#endif
#define DROP_UNLESS(runs) if (!(runs)) discard
#else
#define may_run() true
#define DROP_UNLESS(runs)
#endif
