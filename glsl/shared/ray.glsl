// Rays of the view and where they meet the volume's box. Twin: src/math/ray.rs, of the box at planes `cut_interval` there.
// Needs frame.glsl and double_float.glsl. PLANES: the interval of a ray is cut at clip planes [Thesis §3.1.2]. ORTHOGRAPHIC: rays lie
// side by side.

// Beyond every volume, in volume units.
const float FAR_AWAY = 3.0e38;

// One component (0, 1, 2) of what a place of the picture (`pixel` in pixels, centres at + 0.5) adds to its upper left corner.
vec2 ray_shift(vec2 pixel, int axis) {
    vec2 along_x = df_multiply(vec2(pixel.x, 0.0), vec2(frame.right[0][axis], frame.right[1][axis]));
    vec2 along_y = df_multiply(vec2(pixel.y, 0.0), vec2(frame.down[0][axis], frame.down[1][axis]));
    return df_add(along_x, along_y);
}

// One component of the direction through a place of the picture, with component 1 along the view direction.
vec2 ray_direction(vec2 pixel, int axis) {
    vec2 base = vec2(frame.base[0][axis], frame.base[1][axis]);
#ifdef ORTHOGRAPHIC
    return base;
#else
    return df_add(base, ray_shift(pixel, axis));
#endif
}

// One component of where the ray through a place of the picture comes from.
vec2 ray_origin(vec2 pixel, int axis) {
    vec2 origin = vec2(frame.origin[0][axis], frame.origin[1][axis]);
#ifdef ORTHOGRAPHIC
    return df_add(origin, ray_shift(pixel, axis));
#else
    return origin;
#endif
}

#ifdef PLANES
// The height over a clip plane of where the view's rays come from, and what its base, right and down rise by over it: double-floats.
// The plane itself, in volume space: its normal, to where it keeps, and its height over the origin.
struct ClipPlane {
    vec4 heights[2];
    vec4 plane;
};

layout(set = 0, binding = 18, std430) readonly buffer ClipPlanes {
    ClipPlane planes[];
} clip_planes;
#endif

// Depths between which the ray is inside the box, beyond the near plane and where clip planes keep it: enter and leave, and the
// axis whose face it meets there (-1: another plane). A ray that misses has enter >= leave.
struct Interval {
    vec2 enter;
    vec2 leave;
    int enter_axis;
    int leave_axis;
};

#ifdef PLANES
// Cuts the interval at all clip planes.
void cut_at_planes(inout Interval interval, vec2 pixel) {
    for (uint i = 0u; i < clip_planes.planes.length(); ++i) {
        vec4 high = clip_planes.planes[i].heights[0];
        vec4 low = clip_planes.planes[i].heights[1];
        vec2 along_x = df_multiply(vec2(pixel.x, 0.0), vec2(high.z, low.z));
        vec2 along_y = df_multiply(vec2(pixel.y, 0.0), vec2(high.w, low.w));
        vec2 shift = df_add(along_x, along_y);
        vec2 rise = vec2(high.y, low.y);
        vec2 height = vec2(high.x, low.x);
#ifdef ORTHOGRAPHIC
        height = df_add(height, shift);
#else
        rise = df_add(rise, shift);
#endif
        if (rise.x == 0.0) {
            if (height.x < 0.0) {
                interval.leave = vec2(0.0);
            }
            continue;
        }
        vec2 depth = df_divide(-height, rise);
        if (rise.x > 0.0 && df_less(interval.enter, depth)) {
            interval.enter = depth;
            interval.enter_axis = -1;
        }
        if (rise.x < 0.0 && df_less(depth, interval.leave)) {
            interval.leave = depth;
            interval.leave_axis = -1;
        }
    }
}
#endif

Interval box_interval(vec2 pixel) {
    Interval interval = Interval(vec2(frame.near, 0.0), vec2(FAR_AWAY, 0.0), -1, -1);
    for (int axis = 0; axis < 3; ++axis) {
        vec2 direction = ray_direction(pixel, axis);
        vec2 origin = ray_origin(pixel, axis);
        vec2 half_side = 0.5 * vec2(frame.extent[0][axis], frame.extent[1][axis]);
        if (direction.x == 0.0) {
            if (abs(origin.x) > half_side.x) {
                interval.leave = vec2(0.0);
            }
            continue;
        }
        vec2 low = df_divide(df_add(-half_side, -origin), direction);
        vec2 high = df_divide(df_add(half_side, -origin), direction);
        bool forward = direction.x > 0.0;
        vec2 first = forward ? low : high;
        vec2 second = forward ? high : low;
        if (df_less(interval.enter, first)) {
            interval.enter = first;
            interval.enter_axis = axis;
        }
        if (df_less(second, interval.leave)) {
            interval.leave = second;
            interval.leave_axis = axis;
        }
    }
#ifdef PLANES
    cut_at_planes(interval, pixel);
#endif
    return interval;
}

// Texture coordinate (double-float) along `axis` of the point at `depth`; exactly 0 or 1 on the face the
// ray meets there.
vec2 texture_coordinate(vec2 pixel, vec2 depth, int axis, int face_axis, bool leaving) {
    vec2 direction = ray_direction(pixel, axis);
    if (axis == face_axis) {
        return vec2((direction.x > 0.0) == leaving ? 1.0 : 0.0, 0.0);
    }
    vec2 point = df_add(ray_origin(pixel, axis), df_multiply(depth, direction));
    vec2 inverse_extent = vec2(frame.inverse_extent[0][axis], frame.inverse_extent[1][axis]);
    return df_add(df_multiply(point, inverse_extent), vec2(0.5, 0.0));
}

// Where the ray enters, texture coordinates. Those of the ray through the pixel's centre, not interpolated ones: rasterisers move
// corners to a raster of 1/256 pixel.
vec3 entry_at(vec2 pixel, Interval interval) {
    vec3 begin;
    for (int axis = 0; axis < 3; ++axis) {
        vec2 coordinate = texture_coordinate(pixel, interval.enter, axis, interval.enter_axis, false);
        begin[axis] = clamp(coordinate.x + coordinate.y, 0.0, 1.0);
    }
    return begin;
}

// normalize(exit - entry) and the length, both in volume space, of a ray that enters at `begin`; 0 where it misses. Each is the f32
// nearest to the true number: samples far along the ray magnify an error made here.
vec4 direction_from(vec2 pixel, Interval interval, vec3 begin) {
    vec2 way[3];
    vec2 square = vec2(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        vec2 end = texture_coordinate(pixel, interval.leave, axis, interval.leave_axis, true);
        vec2 difference = df_add(end, vec2(-begin[axis], 0.0));
        way[axis] = df_multiply(difference, vec2(frame.extent[0][axis], frame.extent[1][axis]));
        square = df_add(square, df_multiply(way[axis], way[axis]));
    }
    bool hits = df_less(interval.enter, interval.leave) && square.x > 0.0;
    vec4 direction = vec4(0.0);
    if (hits) {
        vec2 size = df_sqrt(square);
        for (int axis = 0; axis < 3; ++axis) {
            direction[axis] = df_divide(way[axis], size).x;
        }
        direction.w = size.x;
    }
    return direction;
}
