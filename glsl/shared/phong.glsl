// Lights on a surface: the illumination model of Phong [Thesis §4.2.1]. SHADOWS, TRANSLUCENT: what light there is depends on its way
// (light_path.glsl). Twins: src/scene/light.rs, the formula, and
// src/twin/phong.rs, how far f32 may be off.

// Colours of lights are alike in red, green and blue.
layout(constant_id = 21) const bool WHITE_LIGHTS = false;

// Of each light where it is (volume space; in w 1, or 0 for a direction of length 1 to it), and its ambient, diffuse and specular
// colours, with the exponent of the specular part in w; of white ones these four numbers in one row.
layout(set = 0, binding = 20, std430) readonly buffer Lights {
    vec4 rows[];
} lights;

// Rows of a light.
const int LIGHT_ROWS = WHITE_LIGHTS ? 2 : 4;

// x^n for x from 0 to 1, to some units in the last place where x is near 1: there the logarithm is taken of what x lacks.
float power(float x, float n) {
    if (n == 0.0) {
        return 1.0;
    }
    if (x <= 0.0) {
        return 0.0;
    }
    float log_x = x > 0.5 ? log_1_plus(x - 1.0) : log(x);
    return exp(n * log_x);
}

// A surface of that colour in all lights. Its normal is turned to the eye; without one, and by a light in the point itself or
// behind the surface, it has the ambient part alone. The specular part does not take the surface's colour, and is 0 where the
// diffuse one is.
vec3 lit(vec3 color, vec3 gradient, vec3 point, vec3 view) {
    float steepest = max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z));
    vec3 normal = steepest > 0.0 ? normalize(gradient / steepest) : vec3(0.0);
    normal = dot(normal, view) < 0.0 ? -normal : normal;
    vec3 sum = vec3(0.0);
    int count = lights.rows.length() / LIGHT_ROWS;
    // Asked at the end as well: segment.glsl.
    for (int i = 0; i < count;) {
        vec4 place = lights.rows[i * LIGHT_ROWS];
        vec4 parts = lights.rows[i * LIGHT_ROWS + 1];
        vec3 ambient = WHITE_LIGHTS ? parts.xxx : parts.rgb;
        vec3 diffuse = WHITE_LIGHTS ? parts.yyy : lights.rows[i * LIGHT_ROWS + 2].rgb;
        vec3 specular = WHITE_LIGHTS ? parts.zzz : lights.rows[i * LIGHT_ROWS + 3].rgb;
        vec3 way = place.w == 0.0 ? place.xyz : place.xyz - point;
        float distance = length(way);
        float facing = distance > 0.0 ? dot(normal, way) / distance : 0.0;
        sum += color * ambient;
        vec3 reflected = vec3(0.0);
        if (facing > 0.0) {
            vec3 halfway = normalize(way / distance + view);
            reflected = color * diffuse * facing + specular * power(clamp(dot(normal, halfway), 0.0, 1.0), parts.w);
#ifdef SHADOWS
            reflected *= clear_to_light(point, normal, way / distance, place.w == 0.0 ? UNBOUNDED : distance);
#endif
        }
#ifdef TRANSLUCENT
        float through = distance > 0.0 ? through_to_light(point, way / distance, place.w == 0.0 ? UNBOUNDED : distance) : 1.0;
        reflected = mix(reflected, color * diffuse * through, THROUGH);
#endif
        sum += reflected;
        ++i;
        if (i >= count) {
            break;
        }
    }
    return sum;
}
