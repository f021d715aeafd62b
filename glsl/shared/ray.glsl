// Rays of the view and where they meet the volume's box. Twin: src/math/ray.rs, of the box at planes `cut_interval` there.
// Needs frame.glsl and double_float.glsl. SINGLE_RAYS: single_rays.glsl stands for all of it. PLANES: the interval of a ray is cut at
// clip planes [Thesis §3.1.2]. ORTHOGRAPHIC: rays lie side by side.

#ifdef SINGLE_RAYS
#include "shared/single_rays.glsl"
#else
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

// A ray through a place of the picture: of each axis where it comes from and its direction, double-floats.
struct ViewRay {
    vec2 origin[3];
    vec2 direction[3];
};

ViewRay view_ray(vec2 pixel) {
    ViewRay ray;
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = ray_origin(pixel, axis);
        ray.direction[axis] = ray_direction(pixel, axis);
    }
    return ray;
}

// Which faces a ray meets is found in single floats: where two are met within their rounding, so that the wrong one may be taken, the
// place on it is as near to the box as that.
Interval box_interval(vec2 pixel, ViewRay ray) {
    Interval interval = Interval(vec2(0.0), vec2(0.0), -1, -1);
    float enter = frame.near;
    float leave = FAR_AWAY;
    // Heights over the planes of the faces, and what a unit of depth rises.
    vec2 height_in = vec2(frame.near, 0.0);
    vec2 rise_in = vec2(1.0, 0.0);
    vec2 height_out = vec2(FAR_AWAY, 0.0);
    vec2 rise_out = vec2(1.0, 0.0);
    bool misses = false;
    for (int axis = 0; axis < 3; ++axis) {
        vec2 direction = ray.direction[axis];
        vec2 origin = ray.origin[axis];
        vec2 half_side = 0.5 * vec2(frame.extent[0][axis], frame.extent[1][axis]);
        if (direction.x == 0.0) {
            misses = misses || abs(origin.x) > half_side.x;
            continue;
        }
        vec2 low = df_add(-half_side, -origin);
        vec2 high = df_add(half_side, -origin);
        bool forward = direction.x > 0.0;
        vec2 first = forward ? low : high;
        vec2 second = forward ? high : low;
        float inverse = 1.0 / direction.x;
        if (first.x * inverse > enter) {
            enter = first.x * inverse;
            height_in = first;
            rise_in = direction;
            interval.enter_axis = axis;
        }
        if (second.x * inverse < leave) {
            leave = second.x * inverse;
            height_out = second;
            rise_out = direction;
            interval.leave_axis = axis;
        }
    }
    interval.enter = df_divide(height_in, rise_in);
    interval.leave = misses ? vec2(0.0) : df_divide(height_out, rise_out);
#ifdef PLANES
    cut_at_planes(interval, pixel);
#endif
    return interval;
}

// Texture coordinate along `axis` of the point at `depth`, the sum of two numbers; exactly 0 or 1 on the face the ray meets there.
vec2 texture_coordinate(ViewRay ray, vec2 depth, int axis, int face_axis, bool leaving) {
    vec2 direction = ray.direction[axis];
    vec2 way = two_product(depth.x, direction.x);
    precise float way_low = way.y + (depth.x * direction.y + depth.y * direction.x);
    vec2 point = two_sum(ray.origin[axis].x, way.x);
    precise float point_low = point.y + (ray.origin[axis].y + way_low);
    float inverse = frame.inverse_extent[0][axis];
    vec2 part = two_product(point.x, inverse);
    precise float part_low = part.y + (point.x * frame.inverse_extent[1][axis] + point_low * inverse);
    vec2 coordinate = two_sum(0.5, part.x);
    precise float low = coordinate.y + part_low;
    bool on_face = axis == face_axis;
    return on_face ? vec2((direction.x > 0.0) == leaving ? 1.0 : 0.0, 0.0) : vec2(coordinate.x, low);
}

// Where the ray enters, texture coordinates. Those of the ray through the pixel's centre, not interpolated ones: rasterisers move
// corners to a raster of 1/256 pixel.
vec3 entry_at(ViewRay ray, Interval interval) {
    vec3 begin;
    for (int axis = 0; axis < 3; ++axis) {
        vec2 coordinate = texture_coordinate(ray, interval.enter, axis, interval.enter_axis, false);
        begin[axis] = clamp(coordinate.x + coordinate.y, 0.0, 1.0);
    }
    return begin;
}

// normalize(exit - entry) and the length, both in volume space, of a ray that enters at `begin`; 0 where it misses. Each is the f32
// nearest to the true number: samples far along the ray magnify an error made here.
vec4 direction_from(ViewRay ray, Interval interval, vec3 begin) {
    vec2 way[3];
    vec2 square = vec2(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        vec2 end = texture_coordinate(ray, interval.leave, axis, interval.leave_axis, true);
        vec2 difference = two_sum(end.x, -begin[axis]);
        precise float rest = difference.y + end.y;
        float extent = frame.extent[0][axis];
        vec2 long_way = two_product(difference.x, extent);
        precise float low = long_way.y + (difference.x * frame.extent[1][axis] + rest * extent);
        way[axis] = sum_of_smaller(long_way.x, low);
        vec2 of_axis = two_product(way[axis].x, way[axis].x);
        precise float of_axis_low = of_axis.y + 2.0 * way[axis].x * way[axis].y;
        vec2 sum = two_sum(square.x, of_axis.x);
        square = vec2(sum.x, square.y + (sum.y + of_axis_low));
    }
    bool hits = df_less(interval.enter, interval.leave) && square.x > 0.0;
    vec4 direction = vec4(0.0);
    if (hits) {
        vec2 size = df_sqrt(square);
        float inverse = 1.0 / size.x;
        for (int axis = 0; axis < 3; ++axis) {
            precise float first = way[axis].x * inverse;
            vec2 product = two_product(first, size.x);
            precise float rest = ((way[axis].x - product.x) - product.y) + (way[axis].y - first * size.y);
            direction[axis] = first + rest * inverse;
        }
        direction.w = size.x;
    }
    return direction;
}
#endif
