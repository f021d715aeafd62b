// Within which clip meshes a place of a ray lies. Twin: src/scene/mesh/clip.rs.
//
// By how much more often the ray has entered each mesh than left it, as digits of one number: 63 values a mesh, 0 in the middle,
// so that the number is above 0 whatever they are, and f32 has it exactly. Its sign says whether what is there is kept.

// Clip meshes; none where clip geometry cuts in front of its first surface.
layout(constant_id = 15) const uint CLIP_MESHES = 0u;
// A bit for each clip mesh that keeps what is inside.
layout(constant_id = 16) const uint CLIP_INSIDE = 0u;

const int MOST_WINDINGS = 31;
const int DIGIT = 64;
const int ZERO = 32;

// The windings of all meshes with the sign that says whether all of them keep what is there.
float clip_state(ivec4 windings) {
    int number = 0;
    bool kept = true;
    for (int mesh = int(CLIP_MESHES) - 1; mesh >= 0; --mesh) {
        number = number * DIGIT + ZERO + windings[mesh];
        kept = kept && (windings[mesh] > 0) == (bitfieldExtract(CLIP_INSIDE, mesh, 1) != 0u);
    }
    return kept ? float(number) : -float(number);
}

ivec4 clip_windings(float state) {
    ivec4 windings = ivec4(0);
    int number = int(abs(state));
    for (int mesh = 0; mesh < int(CLIP_MESHES); ++mesh) {
        windings[mesh] = number % DIGIT - ZERO;
        number /= DIGIT;
    }
    return windings;
}

// Where a ray begins that enters each mesh so many times more than it leaves it.
float clip_state_at_begin(vec4 entered) {
    return clip_state(ivec4(clamp(-entered, 0.0, float(MOST_WINDINGS))));
}

// Behind a front or a back of a mesh.
float clip_state_behind(float state, uint mesh, bool front) {
    ivec4 windings = clip_windings(state);
    windings[mesh] = clamp(windings[mesh] + (front ? 1 : -1), -MOST_WINDINGS, MOST_WINDINGS);
    return clip_state(windings);
}
