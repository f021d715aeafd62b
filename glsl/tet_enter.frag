// First hit of a ray with the boundary of a mesh of tetrahedra [Weiler03 "First Hit"]: of the faces by which it enters, behind the one
// before, the nearest. A layer for each time that a ray may enter: meshes need not be convex.
//
// Departures: 1. Rasterisers move corners to a raster, so that the face of a fragment may be beside the one that the ray passes through;
// from there it is found over the edges that the ray passes on the wrong side of. 2. Depth is written by the shader, as that of the ray.
// 3. BEGINS: where rays begin within the mesh the face lies behind the eye, and is given (`tet_begin`), so that no face has to be drawn.
//
// LAYER_BEFORE: behind the face of the layer before. AFTER_BEGIN: that is one that rays begin behind, where there is one.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [BEGINS], [LAYER_BEFORE], [AFTER_BEGIN], [STORAGE]

#include "shared/double_float.glsl"
#include "shared/seen.glsl"
#include "shared/way.glsl"

#include "shared/boundary.glsl"

#ifdef BEGINS
// One more than the number of the face by which the ray comes to where it begins; 0 where that is not in the mesh.
layout(set = 0, binding = 65) uniform usampler2D tet_begin;
#else
layout(location = 0) flat in uint triangle;
#endif

#ifdef LAYER_BEFORE
layout(set = 0, binding = 66) uniform sampler2D tet_entry;
#endif

// How near it is (greater is nearer), one more than the number of the face; depth from the middle of the mesh, and x.
layout(location = 0) out vec4 entered;

// Beyond every face.
const uint NO_FACE = 0xffffffffu;

// Faces that are looked at before the ray counts as one that misses: the raster is much finer than faces are.
const int MOST_FACES = 12;

// Depths from the middle of the mesh are less than 1.
float nearness(float depth) {
    return 0.5 - 0.5 * depth;
}

void main() {
    Line line = line_through(gl_FragCoord.xy);
#ifdef BEGINS
    uint face = texelFetch(tet_begin, ivec2(gl_FragCoord.xy), 0).r - 1u;
    bool found = face == NO_FACE;
#else
    uint face = triangle;
    bool found = false;
#endif
    bool shown = false;
    vec2 at = vec2(0.0);
    for (int i = 0; i < MOST_FACES && !found && face != NO_FACE; ++i) {
        Entrance entrance = entrance_by(line, face);
        if (!any(entrance.lefts)) {
            found = true;
            shown = true;
            at = face_point(entrance.way);
        } else if (entrance.way.areas.x + entrance.way.areas.y + entrance.way.areas.z >= 0.0) {
            // Its back is seen: the ray passes beside the mesh.
            found = true;
        } else {
            uvec4 beside = ROW(tet_boundary, 2u * face + 1u);
            face = entrance.lefts.x ? beside.x : entrance.lefts.y ? beside.y : beside.z;
        }
        // Asked at the end as well: shared/segment.glsl.
        if (found || face == NO_FACE) {
            break;
        }
    }
    float near = nearness(at.x);
    float number = float(face) + 1.0;
#ifndef BEGINS
    shown = shown && at.x >= tet_view.near;
#endif
#ifdef LAYER_BEFORE
    vec4 before = texelFetch(tet_entry, ivec2(gl_FragCoord.xy), 0);
#ifdef AFTER_BEGIN
    bool behind = before.y == 0.0 || near < before.x || (near == before.x && number > before.y);
#else
    bool behind = near < before.x || (near == before.x && number > before.y);
#endif
    shown = shown && behind;
#endif
    if (!shown) {
        discard;
    }
    entered = vec4(near, number, at);
#ifndef BEGINS
    gl_FragDepth = near;
#endif
}
