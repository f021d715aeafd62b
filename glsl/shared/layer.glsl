// The layers of a ray, by what a draw reads of them. Twin: src/twin/layer.rs. Needs pixel.glsl.
//
// LAYER_BEFORE: the part of the ray that is drawn begins at a layer; a ray without that layer has no such part.
// LAYER_BEHIND: it ends at the next layer, where the ray has one. OPAQUE: it ends at the nearest opaque polygon.
//
// CLIPPED: it is not drawn behind a layer that says so.
//
// A texel: near over depth (0 where there is no surface), one more than the triangle's number, the distance from where the
// ray enters the box (volume space, negative in front of it), and below 0 where clip geometry keeps nothing behind the surface.
//
// It is that distance that places a surface, and near over depth by which surfaces are ordered: both are found once a pixel,
// from the triangle's plane in double-floats. A depth buffer's z/w has no digits left for it: at the volume it differs by
// 1e-4 from face to face.

#if defined(LAYER_BEFORE) && defined(LAYER_BEHIND) && defined(OPAQUE)
#define LAYERS 3
#elif defined(LAYER_BEFORE) && defined(LAYER_BEHIND) || defined(LAYER_BEFORE) && defined(OPAQUE) || defined(LAYER_BEHIND) && defined(OPAQUE)
#define LAYERS 2
#elif defined(LAYER_BEFORE) || defined(LAYER_BEHIND) || defined(OPAQUE)
#define LAYERS 1
#endif

#ifdef LAYERS
layout(set = 0, binding = 15) uniform sampler2D layer[LAYERS];

vec4 layer_before() {
#ifdef LAYER_BEFORE
    return texelFetch(layer[0], this_pixel(), 0);
#else
    return vec4(0.0);
#endif
}

// The nearest of what is behind: the next layer where there is one, else the opaque polygon.
vec4 layer_behind() {
    vec4 behind = vec4(0.0);
#ifdef OPAQUE
    behind = texelFetch(layer[LAYERS - 1], this_pixel(), 0);
#endif
#ifdef LAYER_BEHIND
#ifdef LAYER_BEFORE
    vec4 next = texelFetch(layer[1], this_pixel(), 0);
#else
    vec4 next = texelFetch(layer[0], this_pixel(), 0);
#endif
    if (next.x > 0.0) {
        behind = next;
    }
#endif
    return behind;
}
#endif
