// Slices that rays are sampled on [Thesis §3.4]. Twin: src/scene/slices.rs. Part of samples.glsl; needs ray.glsl.

layout(set = 0, binding = 32, std140) uniform Slices {
    // Where slice 0 lies, as double-floats: for rays that go up along the axis of the stack, and for those that go down; the same
    // for both where slices lie across the view direction or about the eye. Volume units.
    vec4 first;
    // From slice to slice, volume units, and in steps.
    vec2 spacing;
    float steps;
    // How many there are.
    uint count;
} slices;

// Planes across an axis of the volume (0, 1, 2), planes at a depth in front of the eye, or spheres at a distance from it.
const int DEPTH = 3;
const int DISTANCE = 4;
layout(constant_id = 51) const int SLICE_SURFACE = DEPTH;

// So far does a slice reach beyond the volume, in its sides and, at clip planes and the near plane, in volume units.
// Twin: SLACK in src/scene/slices.rs.
const float SLICE_SLACK = exp2(-16.0);

// The direction of a ray with component 1 along the view direction, and where it comes from.
vec3 slice_way(vec2 pixel) {
    return vec3(ray_direction(pixel, 0).x, ray_direction(pixel, 1).x, ray_direction(pixel, 2).x);
}

vec3 slice_origin(vec2 pixel) {
    return vec3(ray_origin(pixel, 0).x, ray_origin(pixel, 1).x, ray_origin(pixel, 2).x);
}

// The depth at which the ray of a pixel meets a slice.
vec2 slice_depth(vec2 pixel, float slice) {
    vec2 by = df_multiply(slices.spacing, vec2(slice, 0.0));
    if (SLICE_SURFACE == DEPTH) {
        return df_add(slices.first.xy, by);
    }
    if (SLICE_SURFACE == DISTANCE) {
        vec2 square = vec2(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            vec2 way = ray_direction(pixel, axis);
            square = df_add(square, df_multiply(way, way));
        }
        return df_divide(df_add(slices.first.xy, by), df_sqrt(square));
    }
    vec2 way = ray_direction(pixel, SLICE_SURFACE);
    vec2 place = way.x > 0.0 ? df_add(slices.first.xy, by) : df_add(slices.first.zw, -by);
    return df_divide(df_add(place, -ray_origin(pixel, SLICE_SURFACE)), way);
}

// The same in f32.
float slice_depth_f32(vec3 origin, vec3 way, float slice) {
    float by = slices.spacing.x * slice;
    if (SLICE_SURFACE == DEPTH) {
        return slices.first.x + by;
    }
    if (SLICE_SURFACE == DISTANCE) {
        return (slices.first.x + by) / length(way);
    }
    float place = way[SLICE_SURFACE] > 0.0 ? slices.first.x + by : slices.first.z - by;
    return (place - origin[SLICE_SURFACE]) / way[SLICE_SURFACE];
}

// The number, with a fraction, that a slice at this depth of a ray would have.
float slice_number(vec3 origin, vec3 way, float depth) {
    if (SLICE_SURFACE == DEPTH) {
        return (depth - slices.first.x) / slices.spacing.x;
    }
    if (SLICE_SURFACE == DISTANCE) {
        return (depth * length(way) - slices.first.x) / slices.spacing.x;
    }
    float place = origin[SLICE_SURFACE] + depth * way[SLICE_SURFACE];
    return (way[SLICE_SURFACE] > 0.0 ? place - slices.first.x : slices.first.z - place) / slices.spacing.x;
}

// Steps from slice to slice along a ray.
float slice_stride(vec3 way) {
    if (SLICE_SURFACE == DEPTH) {
        return slices.steps * length(way);
    }
    return SLICE_SURFACE == DISTANCE ? slices.steps : slices.steps * length(way) / abs(way[SLICE_SURFACE]);
}

// Depths between which a ray is in the volume grown by `slack` and where clip planes keep it; none where it begins behind its end.
vec2 slice_interval(vec3 origin, vec3 way, float slack) {
    vec2 between = vec2(frame.near - SLICE_SLACK, FAR_AWAY);
    for (int axis = 0; axis < 3; ++axis) {
        float reach = (0.5 + slack) * frame.extent[0][axis];
        if (way[axis] == 0.0) {
            between.y = abs(origin[axis]) > reach ? 0.0 : between.y;
            continue;
        }
        float low = (-reach - origin[axis]) / way[axis];
        float high = (reach - origin[axis]) / way[axis];
        between = vec2(max(between.x, min(low, high)), min(between.y, max(low, high)));
    }
#ifdef PLANES
    for (uint i = 0u; i < clip_planes.planes.length(); ++i) {
        vec4 plane = clip_planes.planes[i].plane;
        float height = dot(plane.xyz, origin) + plane.w + slack;
        float rise = dot(plane.xyz, way);
        if (rise == 0.0) {
            between.y = height < 0.0 ? 0.0 : between.y;
        } else if (rise > 0.0) {
            between.x = max(between.x, -height / rise);
        } else {
            between.y = min(between.y, -height / rise);
        }
    }
#endif
    return between;
}

// The first slice between two depths of a ray, and one past the last, `more` of a spacing around them.
uvec2 slices_between(vec3 origin, vec3 way, vec2 between, float more) {
    if (!(between.x <= between.y) || SLICE_SURFACE < DEPTH && way[SLICE_SURFACE] == 0.0) {
        return uvec2(0u);
    }
    float count = float(slices.count);
    float first = ceil(slice_number(origin, way, between.x) - more);
    float end = floor(slice_number(origin, way, between.y) + more) + 1.0;
    return first < end ? uvec2(clamp(first, 0.0, count), clamp(end, 0.0, count)) : uvec2(0u);
}

// How many slices a ray meets in the volume.
uint slices_met(vec2 pixel) {
    vec3 origin = slice_origin(pixel);
    vec3 way = slice_way(pixel);
    uvec2 met = slices_between(origin, way, slice_interval(origin, way, SLICE_SLACK), 0.0);
    return met.y - met.x;
}

#ifdef LAYERS
// Depths between which the part of the ray lies that is drawn.
vec2 slice_part(vec2 between) {
    vec4 behind = layer_behind();
    if (behind.x > 0.0) {
        between.y = min(between.y, frame.near / behind.x);
    }
#ifdef LAYER_BEFORE
    vec4 before = layer_before();
    between.x = goes_on(before) ? max(between.x, frame.near / before.x) : FAR_AWAY;
#endif
    return between;
}
#endif

// The ray from its place on a slice to the next one: a ray of one sample, taken where it begins. `exactly`: in more digits than f32 has.
Ray ray_on_slice(vec2 pixel, float slice, bool exactly) {
    Ray ray;
    vec3 origin = slice_origin(pixel);
    vec3 way = slice_way(pixel);
    ray.direction = normalize(way);
    ray.stride = slice_stride(way);
    ray.step_vector = ray.direction * frame.inverse_extent[0].xyz / frame.inverse_step;
    ray.stride_high = vec3(0.0);
    ray.stride_middle = vec3(0.0);
    ray.stride_rest = vec3(0.0);
    ray.steps = ray.stride;
    ray.first = 0u;
    ray.samples = 1u;
    ray.slice = slice;
    ray.pixel = pixel;
    if (exactly) {
        vec2 depth = slice_depth(pixel, slice);
        ray.depth = depth.x;
        ViewRay view = view_ray(pixel);
        for (int axis = 0; axis < 3; ++axis) {
            vec2 sum = texture_coordinate(view, depth, axis, -1, false);
            vec2 coordinate = sum_of_smaller(sum.x, sum.y);
            ray.entry[axis] = coordinate.x;
            vec2 voxel = df_add(df_multiply(coordinate, vec2(frame.dims[axis], 0.0)), vec2(-0.5, 0.0));
            ray.whole[axis] = floor(voxel.x);
            ray.part[axis] = (voxel.x - ray.whole[axis]) + voxel.y;
        }
    } else {
        ray.depth = slice_depth_f32(origin, way, slice);
        ray.entry = (origin + ray.depth * way) * frame.inverse_extent[0].xyz + 0.5;
        vec3 voxel = ray.entry * frame.dims.xyz - 0.5;
        ray.whole = floor(voxel);
        ray.part = voxel - ray.whole;
    }
    return ray;
}

// Whether a place on a slice is in the volume, beyond the near plane and where clip planes keep it, or nearly so.
bool is_inside(Ray ray) {
    bool inside = ray.depth >= frame.near - SLICE_SLACK;
    inside = inside && all(lessThanEqual(abs(ray.entry - 0.5), vec3(0.5 + SLICE_SLACK)));
#ifdef PLANES
    vec3 place = (ray.entry - 0.5) * frame.extent[0].xyz;
    for (uint i = 0u; i < clip_planes.planes.length(); ++i) {
        vec4 plane = clip_planes.planes[i].plane;
        inside = inside && dot(plane.xyz, place) + plane.w >= -SLICE_SLACK;
    }
#endif
    return inside;
}

// Whether it is on the part of the ray that is drawn.
bool is_between_layers(Ray ray) {
#ifdef LAYERS
    float key = frame.near / ray.depth;
#ifdef LAYER_BEFORE
    vec4 before = layer_before();
    if (!goes_on(before) || key > before.x) {
        return false;
    }
#endif
    return key > layer_behind().x;
#else
    return true;
#endif
}
