// How an intermediate pass stores its decision: a depth that later passes are culled by.
//
// MARK_COPY: declared early, written to a colour attachment that is copied into the depth buffer afterwards.
// MARK_FRAGDEPTH: gl_FragDepth; the box is drawn at depth 1, so every written depth is smaller, which
//   `depth_less` promises: with it the bounds test may run before the shader.
// MARK_FRAGDEPTH_ANY: gl_FragDepth without a promise, the thesis' form [Thesis §5.3].
// MARK_NONE: nothing is left to decide, and nothing is stored.

// Of the colour attachment, where others come before it.
#ifndef MARK_LOCATION
#define MARK_LOCATION 0
#endif

#if defined(MARK_COPY)
// Of the codes of the depth buffer, where its format is a normalised one (16 or 24), and the attachment has as many bytes;
// 0 where both are floats.
layout(constant_id = 13) const int DEPTH_BITS = 0;
layout(location = MARK_LOCATION) out vec4 mark;

// The texel that holds the same bytes as the depth buffer's.
vec4 mark_texel(float depth) {
    if (DEPTH_BITS == 0) {
        return vec4(depth);
    }
    float greatest = float((1u << DEPTH_BITS) - 1u);
    uint code = uint(min(round(depth * greatest), greatest));
    // 24 bits of a code and 8 that are ignored, which make it a float that nobody takes for 0.
    return DEPTH_BITS == 24 ? vec4(uintBitsToFloat(0x3f000000u | code)) : vec4(code & 255u, code >> 8, 0u, 0u) / 255.0;
}
#define MARK(depth) mark = mark_texel(depth)
#elif defined(MARK_FRAGDEPTH)
layout(depth_less) out float gl_FragDepth;
#define MARK(depth) gl_FragDepth = (depth)
#elif defined(MARK_FRAGDEPTH_ANY)
#define MARK(depth) gl_FragDepth = (depth)
#elif defined(MARK_NONE)
#define MARK(depth)
#endif

#if (defined(MARK_COPY) || defined(MARK_NONE)) && !defined(CULL_DISCARD) && !defined(BEGINS)
layout(early_fragment_tests) in;
#endif

// Depth of a ray that is saturated or gone.
const float DEAD = 1.0;
// Depth of a ray that has nothing to do in the next segment, and goes on behind it.
const float SKIPPED = 0.5;
