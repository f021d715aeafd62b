// How bright a shell is [Heidrich95 §2]. Twin: src/twin/shells.rs.
//
// Without a define: the greatest is to be found. Depths are brightness, by the viewport's range, and the depth test keeps the greatest
// [§2.2, equation 5]; shells are drawn in full brightness, which the depth cue dims to what the depth is.
// CROSSINGS: the sum of emissions, each dimmed by the depth cue [§2.1, §3].
// LENGTHS: by how much the emission within the shell exceeds that around it, times the way there. Each fragment brings the way from it to
// one depth for all shells, with the sign of whether the ray enters there or leaves: that depth is the middle of the view, where rays
// begin within the volume their begin or, with OPAQUE, that of the surface that ends the ray. The paper has no such sum; its own goes to
// no integral, however many shells there are.
// SURFACE: where on its ray the shell is, in steps from the entry point, for the lighting pass.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [CROSSINGS | LENGTHS | SURFACE], [OPAQUE], [ORTHOGRAPHIC]

#if defined(CROSSINGS) || defined(LENGTHS) || defined(SURFACE)
#include "shared/frame.glsl"
#endif
#ifdef LENGTHS
#include "shared/logarithm.glsl"
#endif

#if defined(CROSSINGS) || defined(LENGTHS)
struct ShellLevel {
    // phi.
    float emission;
    // By how much the emission within the shell exceeds that around it, half-way between levels.
    float rise;
};

layout(set = 0, binding = 36, std430) readonly buffer ShellLevels {
    ShellLevel list[];
} shell_levels;
#endif

layout(set = 0, binding = 35, std140) uniform ShellCue {
    // The depth cue at the depth 0, and what it rises by to the depth 1.
    vec2 beta;
    // The same as p + q / depth from the eye in perspective, p - q depth in orthographic views.
    vec2 line;
    // From depths of the depth buffer to 1 / depth from the eye in perspective, to depth in orthographic views: at 0, and the rise to 1.
    vec2 depth;
    // What a depth of 1 is in brightness.
    float brightness;
    // Reference lengths in a unit of volume space.
    float lengths;
    // The depth that ways are counted to where no surface ends the ray.
    float middle;
} shell_cue;

#ifdef SURFACE
layout(set = 0, binding = 1) uniform sampler2D entry;
layout(set = 0, binding = 2) uniform sampler2D direction;
#endif

#ifdef OPAQUE
layout(set = 0, binding = 15) uniform sampler2D layer[1];
#endif

// Fragments that are not the greatest, or that lie behind a surface, are not shaded.
layout(early_fragment_tests) in;

layout(location = 0) out vec4 accumulated;

#if defined(LENGTHS) || defined(SURFACE)
// Depth in front of the eye.
float depth_of_fragment() {
    float stored = shell_cue.depth.x + shell_cue.depth.y * gl_FragCoord.z;
#ifdef ORTHOGRAPHIC
    return stored;
#else
    return 1.0 / stored;
#endif
}

// Its place among the pixels of the picture.
vec2 place_in_picture() {
    return gl_FragCoord.xy + vec2(frame.first_column, frame.first_row);
}

// What the ray through the pixel goes on by with each unit of depth, volume space.
vec3 ray_through_pixel() {
#ifdef ORTHOGRAPHIC
    return frame.base[0].xyz;
#else
    vec2 pixel = place_in_picture();
    return frame.base[0].xyz + pixel.x * frame.right[0].xyz + pixel.y * frame.down[0].xyz;
#endif
}
#endif

#ifdef LENGTHS
// The integral of the depth cue between two depths from the eye.
float cue_between(float from, float to) {
#ifdef ORTHOGRAPHIC
    return (to - from) * (shell_cue.line.x - 0.5 * shell_cue.line.y * (to + from));
#else
    return shell_cue.line.x * (to - from) + shell_cue.line.y * logarithm(to / from);
#endif
}

float way_to_end() {
    vec3 ray = ray_through_pixel();
    float from = depth_of_fragment();
    float end = shell_cue.middle;
#ifdef OPAQUE
    float nearness = texelFetch(layer[0], ivec2(gl_FragCoord.xy), 0).x;
    end = nearness > 0.0 ? frame.near / nearness : end;
#endif
    return cue_between(from, end) * length(ray) * shell_cue.lengths;
}
#endif

#ifdef SURFACE
// Steps from where the ray enters the volume.
float steps_from_entry() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec3 origin = frame.origin[0].xyz;
#ifdef ORTHOGRAPHIC
    vec2 pixel = place_in_picture();
    origin += pixel.x * frame.right[0].xyz + pixel.y * frame.down[0].xyz;
#endif
    vec3 place = origin + depth_of_fragment() * ray_through_pixel();
    vec3 begin = (texelFetch(entry, texel, 0).xyz - 0.5) * frame.extent[0].xyz;
    return dot(place - begin, texelFetch(direction, texel, 0).xyz) * frame.inverse_step;
}
#endif

void main() {
#if defined(SURFACE)
    float steps = max(steps_from_entry(), 0.0);
    accumulated = vec4(steps, steps, 0.0, 1.0);
#elif defined(LENGTHS)
    float way = way_to_end() * shell_levels.list[this_step.pass].rise;
    accumulated = vec4(vec3(gl_FrontFacing ? way : -way), 0.0);
#elif defined(CROSSINGS)
    float cue = shell_cue.beta.x + shell_cue.beta.y * gl_FragCoord.z;
    accumulated = vec4(vec3(shell_levels.list[this_step.pass].emission * cue), 0.0);
#else
    accumulated = vec4(vec3(gl_FragCoord.z * shell_cue.brightness), 1.0);
#endif
}
