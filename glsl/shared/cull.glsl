// Which fragments of a step run. Needs frame.glsl.
//
// Culled by the device (bounds, ztest): declared early, so that no shader starts for a fragment that is out.
// CULL_DISCARD: the shader looks at the stored depth itself; the work stands inside `if`, the discard after it,
// since some drivers go on working after a discard.

#ifdef CULL_DISCARD
layout(set = 0, binding = 6) uniform sampler2D stored;

bool may_run() {
    return texelFetch(stored, ivec2(gl_FragCoord.xy), 0).r <= this_step.bound;
}
#define DROP_UNLESS(runs) if (!(runs)) discard
#else
#define may_run() true
#define DROP_UNLESS(runs)
#endif
