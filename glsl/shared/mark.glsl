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
layout(location = MARK_LOCATION) out float mark;
#define MARK(depth) mark = (depth)
#elif defined(MARK_FRAGDEPTH)
layout(depth_less) out float gl_FragDepth;
#define MARK(depth) gl_FragDepth = (depth)
#elif defined(MARK_FRAGDEPTH_ANY)
#define MARK(depth) gl_FragDepth = (depth)
#elif defined(MARK_NONE)
#define MARK(depth)
#endif

#if (defined(MARK_COPY) || defined(MARK_NONE)) && !defined(CULL_DISCARD)
layout(early_fragment_tests) in;
#endif

// Depth of a ray that is saturated or gone.
const float DEAD = 1.0;
