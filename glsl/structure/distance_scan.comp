// Distance transform along a further axis: of squared distances f within the columns, to the least of
// max(|i - j| - 1, 0)^2 weight + f(j). One column an invocation. Twins: src/structure/distance.rs for both sides,
// src/structure/octants.rs for one.
//
// A scan goes through the column and asks at each place which of the cells passed so far is nearest; the other half of
// both sides is a scan from the other end. Box distance is index distance to the cells dilated by one: f'(j) is the lesser
// of f(j) and of f at the cell before. Of two candidates the later one, once it is the better, stays the better, so that
// candidates wait in a queue: each with the place at which it overtakes the one before it.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [ONE_SIDED | OCTANT]

#include "shared/slice.glsl"
#include "shared/square.glsl"

layout(set = 0, binding = 13, std430) readonly buffer Squares {
    uint squares[];
} squares;
#ifdef OCTANT
layout(set = 0, binding = 12, std430) readonly buffer Interesting {
    uint words[];
} interesting;
// Two words a cell: a byte for each octant, as in distance_pack.comp.
layout(set = 0, binding = 14, std430) buffer DistanceBytes {
    uint words[];
} distance_bytes;
#else
layout(set = 0, binding = 15, std430) writeonly buffer SquaresAfter {
    uint squares[];
} squares_after;
#endif

// Cells of a column.
layout(constant_id = 0) const uint LENGTH = 1;
// Bit of the axis in the octant.
layout(constant_id = 1) const uint AXIS = 1;

// Candidates: place and the place of overtaking, 16 bits each, and f'.
uint places[LENGTH];
uint feet[LENGTH];

// Least t with t * divisor >= rest; both below 2^30, quotients below 2^16.
uint ceil_divide(uint rest, uint divisor) {
    uint quotient = uint(float(rest) / float(divisor));
    // f32 is off by 1 at the most.
    quotient += uint(quotient * divisor < rest);
    quotient += uint(quotient * divisor < rest);
    return quotient - uint(quotient > 0u && (quotient - 1u) * divisor >= rest);
}

struct Queue {
    uint head;
    uint tail;
    // The last square read.
    uint before;
};

// Puts the cell at place k in, behind all that it does not outdo.
void put(inout Queue queue, uint k, uint foot) {
    uint overtakes = k;
    while (queue.tail > queue.head) {
        uint last = places[queue.tail - 1u];
        uint apart = k - (last & 0xffffu);
        uint there = feet[queue.tail - 1u] + square_of(apart, slice.weight, slice.reach);
        if (foot > there) {
            uint at = k + ceil_divide(foot - there, 2u * slice.weight * apart);
            // The last one is of use only if it overtakes the one before it earlier.
            if (queue.tail - 1u == queue.head || at > last >> 16) {
                overtakes = min(at, 0xffffu);
                break;
            }
        }
        --queue.tail;
    }
    places[queue.tail] = overtakes << 16 | k;
    feet[queue.tail] = foot;
    ++queue.tail;
}

// Next place k of a scan, where the square within the column is f: the least square to a cell passed so far.
uint advance(inout Queue queue, uint k, uint f) {
    uint foot = min(f, queue.before);
    queue.before = f;
    while (queue.tail > queue.head && k - (places[queue.head] & 0xffffu) >= slice.reach) {
        ++queue.head;
    }
    if (foot < FAR_SQUARED) {
        put(queue, k, foot);
    }
    while (queue.tail > queue.head + 1u && places[queue.head + 1u] >> 16 <= k) {
        ++queue.head;
    }
    if (queue.tail == queue.head) {
        return FAR_SQUARED;
    }
    uint apart = k - (places[queue.head] & 0xffffu);
    return min(feet[queue.head] + square_of(apart, slice.weight, slice.reach), FAR_SQUARED);
}

#ifdef OCTANT
bool is_interesting(uint cell) {
    uint x = cell % slice.cells_x;
    uint row = cell / slice.cells_x;
    return (interesting.words[row * words(slice.cells_x) + x / 32u] >> (x & 31u) & 1u) != 0u;
}
#endif

void main() {
    uint column = invocation();
    if (column >= slice.end) {
        return;
    }
    uint begin = column / slice.inner * slice.outer + column % slice.inner;
#if defined(ONE_SIDED) || defined(OCTANT)
    // Rays that go up meet what lies above: the scan comes from there.
    bool from_top = (slice.octant >> AXIS & 1u) == 0u;
    Queue queue = Queue(0u, 0u, FAR_SQUARED);
    for (uint k = 0u; k < LENGTH; ++k) {
        uint at = begin + (from_top ? LENGTH - 1u - k : k) * slice.stride;
        uint square = advance(queue, k, squares.squares[at]);
#ifdef OCTANT
        uint word = 2u * at + (slice.octant >> 2);
        uint byte = slice.octant & 3u;
        // Octants 0 and 4 come first.
        uint others = byte == 0u ? 0u : distance_bytes.words[word];
        uint free = is_interesting(at) ? 0u : free_voxels(square) + 1u;
        distance_bytes.words[word] = others | free << (8u * byte);
#else
        squares_after.squares[at] = square;
#endif
    }
#else
    uint upwards[LENGTH];
    Queue queue = Queue(0u, 0u, FAR_SQUARED);
    for (uint k = 0u; k < LENGTH; ++k) {
        upwards[k] = advance(queue, k, squares.squares[begin + k * slice.stride]);
    }
    queue = Queue(0u, 0u, FAR_SQUARED);
    for (uint k = 0u; k < LENGTH; ++k) {
        uint i = LENGTH - 1u - k;
        uint at = begin + i * slice.stride;
        uint square = advance(queue, k, squares.squares[at]);
        squares_after.squares[at] = min(upwards[i], square);
    }
#endif
}
