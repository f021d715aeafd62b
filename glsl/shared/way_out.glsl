// How far a way is inside of what is kept of the volume. Twin: `Scene::way_out` in src/scene/planes.rs. Needs frame.glsl and samples.glsl;
// with PLANES ray.glsl.

// How far it is from a point along a unit vector until the volume is left, or what clip planes keep of it, or a light at a distance
// `reach` is met; volume units.
float way_out(vec3 point, vec3 way, float reach) {
    vec3 faces = mix(vec3(-0.5), vec3(0.5), greaterThan(way, vec3(0.0))) * frame.extent[0].xyz;
    vec3 leaves = mix((faces - point) / way, vec3(UNBOUNDED), equal(way, vec3(0.0)));
    float out_at = min(min(leaves.x, leaves.y), min(leaves.z, reach));
#ifdef PLANES
    for (uint i = 0u; i < clip_planes.planes.length(); ++i) {
        vec4 plane = clip_planes.planes[i].plane;
        float rise = dot(plane.xyz, way);
        if (rise < 0.0) {
            out_at = min(out_at, (dot(plane.xyz, point) + plane.w) / -rise);
        }
    }
#endif
    return out_at;
}
