// The vertices and triangles of a level, each at the place that its number gives it; one word of nodes an invocation. Twin:
// src/scene/shells/polygons.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [HOLES]

#include "shared/shell_cells.glsl"

layout(set = 0, binding = 3) uniform sampler3D volume;
layout(set = 0, binding = 38, std430) readonly buffer ShellEdges {
    uint words[];
} shell_edges;
layout(set = 0, binding = 39, std430) readonly buffer ShellSums {
    uvec2 sums[];
} shell_sums;
layout(set = 0, binding = 41, std430) writeonly buffer ShellPolygons {
    // Three numbers a vertex, as bits; then three numbers of vertices a triangle.
    uint words[];
} shell_polygons;

// Vertices and triangles before a word.
uvec2 before(uint word) {
    uvec2 sum = uvec2(0u);
    uint first = 0u;
    uint count = words(slice.cells_x) * slice.cells_y * slice.cells_z;
    while (true) {
        sum += shell_sums.sums[first + word];
        if (count <= SUMMED) {
            return sum;
        }
        first += count;
        count = (count + SUMMED - 1u) / SUMMED;
        word /= SUMMED;
    }
}

// The number of the vertex on the edge that goes up from a node along an axis.
uint vertex(uvec3 node, uint axis) {
    uint word = index_of(Word(node.x / 32u, node.y, node.z));
    uint bit = node.x & 31u;
    uint nodes_before = (1u << bit) - 1u;
    uint number = before(word).x;
    for (uint i = 0u; i < 3u; ++i) {
        uint along = shell_edges.words[3u * word + i];
        number += uint(bitCount(along & nodes_before));
        number += i < axis ? along >> bit & 1u : 0u;
    }
    return number;
}

float value(ivec3 node) {
    return texelFetch(volume, clamp(node - MARGIN, ivec3(0), textureSize(volume, 0) - 1), 0).r;
}

// Where a node lies in volume space.
vec3 position(ivec3 node) {
    vec3 dims = vec3(textureSize(volume, 0));
    vec3 place = clamp(vec3(node - MARGIN) + 0.5, vec3(0.0), dims);
    return (place - 0.5 * dims) * vec3(slice.voxel_x, slice.voxel_y, slice.voxel_z);
}

// Where the level crosses the edge that goes up from a node along an axis.
vec3 place(ivec3 node, int axis) {
    ivec3 further = node;
    further[axis] += 1;
    vec3 from = position(node);
    vec3 to = position(further);
    // Between a node on a face and the one outside.
    if (from == to) {
        return from;
    }
    // The values are on both sides of the level, so that they differ.
    float value_from = value(node);
    float part = (slice.level - value_from) / (value(further) - value_from);
    return from + (to - from) * clamp(part, 0.0, 1.0);
}

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    Word word = word_at(index);
    uvec2 number = before(index);
    uvec3 crossed = uvec3(
        shell_edges.words[3u * index],
        shell_edges.words[3u * index + 1u],
        shell_edges.words[3u * index + 2u]
    );
    for (uint left = crossed.x | crossed.y | crossed.z; left != 0u; left &= left - 1u) {
        int bit = findLSB(left);
        ivec3 node = ivec3(int(word.at) * 32 + bit, word.y, word.z);
        for (int axis = 0; axis < 3; ++axis) {
            if ((crossed[axis] >> bit & 1u) != 0u) {
                uvec3 bits = floatBitsToUint(place(node, axis));
                for (uint i = 0u; i < 3u; ++i) {
                    shell_polygons.words[3u * number.x + i] = bits[i];
                }
                number.x += 1u;
            }
        }
    }
    uint corners[8];
    for (uint left = crossed_cells(word, corners); left != 0u; left &= left - 1u) {
        uint bit = uint(findLSB(left));
        uvec3 node = uvec3(word.at * 32u + bit, word.y, word.z);
#ifdef HOLES
        if (is_hole(ivec3(node))) {
            continue;
        }
#endif
        uvec2 edges = case_of(corners, bit);
        uint count = 3u * triangles_of(edges);
        for (uint i = 0u; i < count; ++i) {
            uint edge = (i < 8u ? edges.x >> (4u * i) : edges.y >> (4u * i - 32u)) & 15u;
            // The edge's axis, and its lower corner by the sides of the other two.
            uint axis = edge >> 2;
            uvec3 corner = uvec3(0u);
            corner[(axis + 1u) % 3u] = edge & 1u;
            corner[(axis + 2u) % 3u] = edge >> 1 & 1u;
            shell_polygons.words[3u * (slice.corners + number.y) + i] = vertex(node + corner, axis);
        }
        number.y += count / 3u;
    }
}
