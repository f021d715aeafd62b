// What a driver is asked whether it culls: a shader that is expensive, and changes what early culling must not be seen
// to change. The rule of what it leaves behind is src/probe/rule.rs.
#version 460
//@takes [EARLY | DISCARDS | FIRST | ALIVE], [BUFFER | IMAGE]
//@takes [DEPTH=depth_any | DEPTH=depth_less | DEPTH=depth_greater | DEPTH=depth_unchanged]

layout(push_constant) uniform Draw {
    // Fragments whose stored depth is greater stay out (mechanisms in the shader).
    float bound;
    // Rounds of work.
    uint work;
} draw;

#ifdef EARLY
layout(early_fragment_tests) in;
#endif
#if defined(FIRST) || defined(ALIVE)
layout(set = 0, binding = 0) uniform sampler2D stored;
#endif
#ifdef BUFFER
layout(set = 0, binding = 1, std430) buffer Counter {
    uint count;
} counter;
#endif
#ifdef IMAGE
layout(set = 0, binding = 2, r32ui) writeonly uniform uimage2D touched;
#endif
#ifdef DEPTH
layout(set = 0, binding = 3) uniform sampler2D written;
layout(DEPTH) out float gl_FragDepth;
#endif

layout(location = 0) out float color;

// In [0, 1), which no compiler knows.
float toil(float x) {
    for (uint i = 0u; i < draw.work; ++i) {
        x = fract(x * 1.61803 + 0.31831);
    }
    return x;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if defined(FIRST) || defined(ALIVE)
    bool alive = texelFetch(stored, pixel, 0).r <= draw.bound;
#else
    const bool alive = true;
#endif
#ifdef FIRST
    if (!alive) {
        discard;
    }
#endif
    float found = 0.0;
    if (alive) {
        found = toil(fract(0.01 * float(pixel.x + 7 * pixel.y)));
#ifdef BUFFER
        atomicAdd(counter.count, 1u);
#endif
#ifdef IMAGE
        imageStore(touched, pixel, uvec4(1u));
#endif
    }
#ifdef ALIVE
    if (!alive) {
        discard;
    }
#endif
#ifdef DISCARDS
    // Never.
    if (found > 2.0) {
        discard;
    }
#endif
#ifdef DEPTH
    gl_FragDepth = texelFetch(written, pixel, 0).r;
#endif
    color = found < 2.0 ? 1.0 : 0.5;
}
