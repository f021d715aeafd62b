// A user's effect (--effect FILE): what the function `effect` of that file makes of each sample that shows, or of each place in which a
// ray meets an iso-surface. It has no twin: f64 cannot run GLSL.
// Needs frame.glsl, samples.glsl, volume.glsl and projection.glsl; of lit samples and of surfaces gradient.glsl too, which it includes
// for others.
//
// An effect is asked only where the transfer function has given an opacity above 0. It can take what shows away, and cannot show what
// does not, so that whatever is leapt over stays lossless.

#if !defined(LIT) && !defined(SURFACE) && !defined(REFRACTION)
#include "shared/gradient.glsl"
#endif

// What an effect is asked about. Axes are those of volume space along the volume's own sides: the centre is the origin, the longest
// side is 1 long. Colours are linear.
struct Sample {
    // Colour, not premultiplied, in light where there are lights, and the opacity for the reference length, above 0; of an iso-surface
    // it is 1, whatever the opacity of that surface is.
    vec4 color;
    // The value, in the volume's own unit.
    float value;
    // The value as a part of the scalar range: 0 at its low end, 1 at its high end, less and more beyond.
    float x;
    // Where it is.
    vec3 position;
    // The same in texture coordinates, 0 to 1 along each side of the volume.
    vec3 coordinate;
    // The same in voxels: the voxel below on each axis, and the way from its centre to the next one.
    Place place;
    // Unit vector along the ray, away from the eye.
    vec3 direction;
    // Length of the ray from where it enters the volume.
    float way;
    // The iso-surface by rising values, from 0 on; -1 of a sample of the volume.
    int surface;
    // Column and row of the pixel in the picture, from the upper left corner.
    ivec2 pixel;
    // Of the frame: the eye (in an orthographic view where the ray comes from), the sides of the volume, and the distance between
    // samples.
    vec3 eye;
    vec3 extent;
    float spacing;
};

// What the user's file defines: the colour in place of `here.color`, not premultiplied, and the opacity for the reference length, which
// is cut off at 0 and 1. Opacity 0 is transparent. Of an iso-surface, which keeps its own opacity,
// the colour alone counts.
vec4 effect(Sample here);

// A vector along the gradient, of which the direction alone counts; 0 where there is none. It costs six interpolated values, or one
// fetch where samples or surfaces in light have their gradients in a texture (--gradients precomputed).
vec3 sample_gradient(Sample here) {
    return gradient_at(here.place);
}

// The unit vector along the gradient that is turned to the eye; 0 where there is no gradient. It costs what the gradient does.
vec3 sample_normal(Sample here) {
    vec3 gradient = sample_gradient(here);
    float steepest = max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z));
    vec3 normal = steepest > 0.0 ? normalize(gradient / steepest) : vec3(0.0);
    return dot(normal, here.direction) > 0.0 ? -normal : normal;
}

// The volume's own value where x is 0, and how much it rises until x is 1.
layout(constant_id = 40) const float EFFECT_LOW = 0.0;
layout(constant_id = 41) const float EFFECT_SPAN = 1.0;

// What an effect is told of the place `steps` from the entry point, whose value is `value` in units of the volume texture.
Sample sample_at(Ray ray, float steps, float value, int surface, vec4 color) {
    Sample here;
    here.color = color;
    here.x = x_of(value);
    here.value = fma(here.x, EFFECT_SPAN, EFFECT_LOW);
    here.coordinate = position_at(ray, steps);
    here.extent = frame.extent[0].xyz;
    here.position = (here.coordinate - 0.5) * here.extent;
    here.place = place_at(ray, steps);
    here.direction = ray.direction;
    here.spacing = 1.0 / frame.inverse_step;
    here.way = steps * here.spacing;
    here.surface = surface;
    here.pixel = this_pixel() + ivec2(frame.first_column, frame.first_row);
#ifdef ORTHOGRAPHIC
    vec2 place = vec2(here.pixel) + 0.5;
    here.eye = frame.origin[0].xyz + place.x * frame.right[0].xyz + place.y * frame.down[0].xyz;
#else
    here.eye = frame.origin[0].xyz;
#endif
    return here;
}

// The colour of a sample and its opacity as the effect has them; `clear` is 1 - opacity. An opacity that the effect leaves as it is
// keeps all of its bits.
vec4 affected_sample(Ray ray, float steps, float value, vec4 color, inout float clear) {
    if (color.a <= 0.0) {
        return color;
    }
    vec4 found = effect(sample_at(ray, steps, value, -1, color));
    if (found.a != color.a) {
        // What is no number is transparent too.
        found = found.a > 0.0 ? vec4(found.rgb, min(found.a, 1.0)) : vec4(0.0);
        clear = 1.0 - found.a;
    }
    return found;
}

// The colour of an iso-surface as the effect has it, `steps` from the entry point.
vec3 affected_surface(Ray ray, float steps, int surface, vec3 color) {
    return effect(sample_at(ray, steps, sample_volume(ray, steps), surface, vec4(color, 1.0))).rgb;
}
