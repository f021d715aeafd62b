// What another volume leaves of this one [Stegmaier05 §6]: what is inside, in its box and at values that have reached its level, or
// what is not. Twin: src/twin/clip_volume.rs. Needs samples.glsl and volume.glsl; with SURFACE surface_color.glsl.
//
// Values are interpolated here, in f32, whatever FILTER says: the 8 fractional bits of a texture unit would make steps of the cut.

layout(set = 0, binding = 30) uniform sampler3D clip_volume;

layout(set = 0, binding = 31, std430) readonly buffer ClipVolumePlace {
    // Their products with (x, y, z, 1), of texture coordinates, are voxels of the clip volume, 0 at the centre of the first one.
    vec4 rows[3];
    // Its level and the width of its faces, in voxels.
    vec4 level;
} clip_volume_place;

// Whether what is inside is kept; else what is not.
layout(constant_id = 50) const bool KEEPS_INSIDE = true;

// The value there, that on the nearest face beyond the box.
float clip_value(vec3 voxel) {
    vec3 below = floor(voxel);
    return interpolate(clip_volume, textureSize(clip_volume, 0) - 1, below, voxel - below);
}

// Whether a place of the ray is kept, so many steps from the entry point.
bool is_kept(Ray ray, float steps) {
    vec4 place = vec4(position_at(ray, steps), 1.0);
    vec3 voxel = vec3(dot(clip_volume_place.rows[0], place), dot(clip_volume_place.rows[1], place),
                      dot(clip_volume_place.rows[2], place));
    float reach = 0.5 + clip_volume_place.level.y;
    vec3 high = vec3(textureSize(clip_volume, 0) - 1) + reach;
    bool inside = all(greaterThanEqual(voxel, vec3(-reach))) && all(lessThanEqual(voxel, high))
                  && clip_value(voxel) >= clip_volume_place.level.x;
    return inside == KEEPS_INSIDE;
}

#ifdef SURFACE
// Halvings of a step in which a ray comes into what is kept, or leaves it: they leave a 65536th of it.
const int CUT_HALVINGS = 16;

// What is kept of a stretch, by its two ends.
struct KeptPart {
    // Its begin and its end, in steps.
    vec2 between;
    // Whether there is any.
    bool any_part;
    // Whether the ray comes into it behind the begin of the stretch, so that it meets there what it is within.
    bool enters;
};

// What is kept of a stretch. A cut is sought where one of its ends is kept and one is not, and is the last place that was found to be
// kept; without refinement that is the end of the stretch itself.
KeptPart kept_part(Ray ray, vec2 stretch) {
    bool front = is_kept(ray, stretch.x);
    bool back = is_kept(ray, stretch.y);
    KeptPart part = KeptPart(stretch, front || back, back && !front);
    if (front != back) {
        float kept = front ? stretch.x : stretch.y;
        float clipped = front ? stretch.y : stretch.x;
        for (int i = 0; i < (REFINE == NONE ? 0 : CUT_HALVINGS); ++i) {
            float middle = 0.5 * (kept + clipped);
            if (is_kept(ray, middle)) {
                kept = middle;
            } else {
                clipped = middle;
            }
        }
        part.between = front ? vec2(stretch.x, kept) : vec2(kept, stretch.y);
    }
    return part;
}
#endif
